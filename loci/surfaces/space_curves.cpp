#include "loci/surfaces/space_curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <utility>

#include "loci/curves/curves.hpp"
#include "loci/search/search.hpp"
#include "loci/surfaces/curve_search.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusFactor;
using core::LocusMap;
using core::LocusProblem;
using core::Quantity;
using core::SpaceArc;
using core::SpaceCurve;
using space::SpacePoint;

/// What a set of one chart came to.
struct Found {
  space::FoundCurves curves;
  space::FoundPoints points;
};

sheet::SheetFunction function_of(const LocusFactor& factor) { return {factor.sheet, factor.line}; }

space::Equations equations_of(const LocusProblem& problem, const ForceZeros& zeros) {
  space::Equations equations;
  for (const LocusFactor* factor : zeros.factors()) equations.system.push_back(function_of(*factor));
  for (const LocusFactor& factor : problem.factors)
    if (factor.role == FactorRole::direct_singularity) equations.determinant.push_back(function_of(factor));
  return equations;
}

/// Undecided cells that are open for another reason than |A| = 0.
std::ptrdiff_t open_cells(const std::vector<space::UndecidedCell>& cells) {
  return std::count_if(cells.begin(), cells.end(), [](const auto& cell) { return !cell.near_singularity; });
}

/// Three equations of which one depends on the others vanish along curves: those of two of them on which the third
/// vanishes too, to rounding.
space::FoundCurves dependent_curves(const LocusProblem& problem, const core::WorkingMode& mode,
                                    const space::Equations& equations, const space::SearchLimits& limits) {
  space::FoundCurves best;
  for (std::size_t third = 0; third < 3; ++third) {
    space::Equations two;
    for (std::size_t i = 0; i < 3; ++i) (i == third ? two.also : two.system).push_back(equations.system[i]);
    two.determinant = equations.determinant;
    space::FoundCurves curves = find_curves(problem, mode, two, limits);
    std::erase_if(curves.arcs, [&](const space::ChartArc& arc) {
      return !vanishes_along(problem, mode, equations.system[third], arc);
    });
    for (space::ChartArc& arc : curves.arcs) arc.certified = false;
    const bool better = curves.arcs.empty() == best.arcs.empty()
                            ? open_cells(curves.undecided) < open_cells(best.undecided)
                            : best.arcs.empty();
    if (third == 0 || better) best = std::move(curves);
  }
  return best;
}

/// Of a force that keeps to a plane: the third equation holds along the curves of the others, except where they meet
/// the zeros of the normal's part. If they may do that, the curves are not proven.
space::FoundCurves curves_in_plane(const LocusProblem& problem, const core::WorkingMode& mode, const ForceZeros& zeros,
                                   const space::SearchLimits& limits) {
  space::Equations two = equations_of(problem, zeros);
  two.also.push_back(std::move(two.system.back()));
  two.system.pop_back();
  space::FoundCurves curves = find_curves(problem, mode, two, limits);
  if (curves.arcs.empty()) return curves;
  space::Equations with_normal = two;
  with_normal.system.push_back({*zeros.normal});
  const space::FoundPoints meetings = find_points(problem, mode, with_normal, limits);
  if (meetings.points.empty() && open_cells(meetings.undecided) == 0) return curves;
  std::erase_if(curves.arcs,
                [&](const space::ChartArc& arc) { return !vanishes_along(problem, mode, two.also.front(), arc); });
  for (space::ChartArc& arc : curves.arcs) arc.certified = false;
  return curves;
}

Found search(const LocusProblem& problem, const core::WorkingMode& mode, const ForceZeros& zeros,
             const std::function<bool()>& stop) {
  const space::Equations equations = equations_of(problem, zeros);
  const space::SearchLimits limits{.tolerance = problem.tolerance, .stop = stop};
  Found found;
  if (zeros.third == nullptr) {
    found.curves = find_curves(problem, mode, equations, limits);
    return found;
  }
  if (zeros.normal != nullptr) {
    found.curves = curves_in_plane(problem, mode, zeros, limits);
    return found;
  }
  found.points = find_points(problem, mode, equations, limits);
  if (open_cells(found.points.undecided) > 0) {
    found.curves = dependent_curves(problem, mode, equations, limits);
    if (!found.curves.arcs.empty()) found.points.undecided.clear();
  }
  return found;
}

/// All along an arc the components of these joints' forces vanish though the forces need not.
bool is_undirected(const LocusProblem& problem, const core::WorkingMode& mode,
                   const std::vector<core::Vanishing>& vanishing, const space::ChartArc& arc) {
  const auto is_pin = [](const core::Vanishing& v) { return v.quantity == Quantity::f; };
  return std::all_of(vanishing.begin(), vanishing.end(), [&](const core::Vanishing& v) {
    return !is_pin(v) || std::any_of(problem.factors.begin(), problem.factors.end(), [&](const LocusFactor& factor) {
      return is_undirected_pin(factor, v.joint) && vanishes_along(problem, mode, {factor.sheet, factor.line}, arc);
    });
  });
}

/// Ends of arcs at a seam between two charts.
class Joining {
 public:
  Joining(const std::vector<const LocusProblem*>& charts, std::vector<SpaceArc>& arcs) : arcs_(arcs) {
    for (std::size_t i = 0; i < 3; ++i) {
      lower_[i] = std::numeric_limits<double>::infinity();
      upper_[i] = -lower_[i];
    }
    for (const LocusProblem* chart : charts) {
      SpacePoint lower{}, upper{};
      for (std::size_t i = 0; i < 3; ++i) {
        lower[i] = core::to_double(chart->lower[i]);
        upper[i] = core::to_double(chart->upper[i]);
      }
      lower = space::placed(*chart, lower), upper = space::placed(*chart, upper);
      for (std::size_t i = 0; i < 3; ++i) {
        lower_[i] = std::min(lower_[i], lower[i]);
        upper_[i] = std::max(upper_[i], upper[i]);
      }
    }
  }

  void join() {
    while (join_any()) {
    }
    for (SpaceArc& arc : arcs_)
      for (std::size_t end = 0; end < 2; ++end)
        if (arc.ends[end] == core::ArcEnd::box && !on_side(end == 0 ? arc.points.front() : arc.points.back()))
          arc.ends[end] = core::ArcEnd::none;
  }

 private:
  static constexpr double same = 1e-8;  ///< as a part of the box

  bool near(const core::Point3& a, const core::Point3& b) const {
    for (std::size_t i = 0; i < 3; ++i)
      if (std::abs(a[i] - b[i]) > same * (upper_[i] - lower_[i])) return false;
    return true;
  }
  bool on_side(const core::Point3& at) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const double slack = same * (upper_[i] - lower_[i]);
      if (at[i] <= lower_[i] + slack || at[i] >= upper_[i] - slack) return true;
    }
    return false;
  }
  static void turn(SpaceArc& arc) {
    std::reverse(arc.points.begin(), arc.points.end());
    std::swap(arc.ends[0], arc.ends[1]);
  }

  bool join_any() {
    for (std::size_t a = 0; a < arcs_.size(); ++a)
      for (const bool last : {true, false})
        if (join_at(a, last)) return true;
    return false;
  }

  /// With another arc that goes on at the last or first point of `a`, or with itself.
  bool join_at(std::size_t a, bool last) {
    SpaceArc& arc = arcs_[a];
    if (arc.closed || arc.ends[last ? 1 : 0] != core::ArcEnd::box) return false;
    const core::Point3 at = last ? arc.points.back() : arc.points.front();
    if (on_side(at)) return false;
    if (arc.ends[last ? 0 : 1] == core::ArcEnd::box && arc.points.size() > 2 &&
        near(arc.points.front(), arc.points.back())) {
      arc.closed = true;
      return true;
    }
    for (std::size_t b = 0; b < arcs_.size(); ++b) {
      SpaceArc& other = arcs_[b];
      if (b == a || other.closed) continue;
      const bool front = other.ends[0] == core::ArcEnd::box && near(other.points.front(), at);
      if (!front && !(other.ends[1] == core::ArcEnd::box && near(other.points.back(), at))) continue;
      if (!last) turn(arc);
      if (!front) turn(other);
      arc.points.insert(arc.points.end(), other.points.begin() + 1, other.points.end());
      arc.ends[1] = other.ends[1];
      arc.certified = arc.certified && other.certified;
      arcs_.erase(arcs_.begin() + static_cast<std::ptrdiff_t>(b));
      return true;
    }
    return false;
  }

  std::vector<SpaceArc>& arcs_;
  SpacePoint lower_{}, upper_{};
};

double length_of(const std::vector<core::Point3>& points) {
  double length = 0;
  for (std::size_t p = 1; p < points.size(); ++p) {
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) square += (points[p][i] - points[p - 1][i]) * (points[p][i] - points[p - 1][i]);
    length += std::sqrt(square);
  }
  return length;
}

std::string names_of(const std::vector<core::Vanishing>& vanishing) {
  std::string names;
  for (const core::Vanishing& v : vanishing)
    if (v.quantity == Quantity::f) names += (names.empty() ? "" : ", ") + v.joint;
  return names;
}

void note_undecided(const LocusProblem& problem, const EdgeLabel& label, const std::vector<space::UndecidedCell>& cells,
                    bool gave_up, LocusMap& map) {
  std::size_t count = 0;
  const space::UndecidedCell* first = nullptr;
  for (const space::UndecidedCell& cell : cells)
    if (!cell.near_singularity) {
      ++count;
      if (first == nullptr) first = &cell;
    }
  if (count == 0) return;
  const SpacePoint at =
      space::placed(problem, {first->cell[0].middle(), first->cell[1].middle(), first->cell[2].middle()});
  std::ostringstream text;
  text.precision(4);
  text << "contact loss of " << names_of(label.vanishing) << ": in " << count << (count == 1 ? " cell" : " cells")
       << " it is neither proven nor excluded, the first around (" << at[0] << ", " << at[1] << ", " << at[2] << ")";
  if (gave_up) text << "; the components may vanish together all over a surface";
  map.notes.push_back(text.str());
}

/// By what vanishes: the arcs of all charts and of all sets of factors.
struct Group {
  EdgeLabel label;
  std::vector<SpaceArc> arcs;
};

class ModeCurves {
 public:
  ModeCurves(const std::vector<const LocusProblem*>& charts, const core::WorkingMode& mode,
             const std::function<bool()>& stop)
      : charts_(charts), mode_(mode), stop_(stop) {}

  void run(LocusMap& map) {
    std::vector<std::pair<std::size_t, ForceZeros>> tasks;  // chart, factors
    for (std::size_t c = 0; c < charts_.size(); ++c)
      for (const std::string& joint : charts_[c]->joints)
        for (const ForceZeros& zeros : zeros_of_force(*charts_[c], joint)) {
          const auto known = std::find_if(tasks.begin(), tasks.end(), [&](const auto& task) {
            return task.first == c && task.second.factors() == zeros.factors();
          });
          if (known == tasks.end())
            tasks.emplace_back(c, zeros);
          else if (known->second.normal == nullptr)
            known->second = zeros;
        }
    std::vector<Found> found(tasks.size());
    run_in_order(tasks.size(),
                 [&](std::size_t t) { found[t] = search(*charts_[tasks[t].first], mode_, tasks[t].second, stop_); });
    for (std::size_t t = 0; t < tasks.size(); ++t) add(*charts_[tasks[t].first], tasks[t].second, found[t], map);
    for (Group& group : groups_) {
      Joining(charts_, group.arcs).join();
      SpaceCurve curve;
      curve.kind = group.label.kind;
      curve.vanishing = group.label.vanishing;
      curve.factor = group.label.factor;
      curve.cause = group.label.cause;
      curve.mode = mode_;
      curve.certified = true;
      for (SpaceArc& arc : group.arcs) {
        if (arc.closed) arc.ends = {core::ArcEnd::none, core::ArcEnd::none};
        arc.length = length_of(arc.points);
        curve.certified = curve.certified && arc.certified;
      }
      curve.arcs = std::move(group.arcs);
      if (!curve.arcs.empty()) map.space_curves.push_back(std::move(curve));
    }
  }

 private:
  void add(const LocusProblem& problem, const ForceZeros& zeros, const Found& found, LocusMap& map) {
    const EdgeLabel label = reaction_label(problem, zeros.factors());
    if (label.vanishing.empty()) return;
    note_undecided(problem, label, found.curves.undecided, found.curves.gave_up, map);
    note_undecided(problem, label, found.points.undecided, found.points.gave_up, map);
    for (const space::ChartPoint& point : found.points.points) {
      space::ChartArc here;
      here.points = {point.at};
      if (is_undirected(problem, mode_, label.vanishing, here)) continue;
      const SpacePoint at = space::placed(problem, point.at);
      map.isolated_points.push_back({label.kind, label.vanishing, {at[0], at[1], at[2]}, mode_, true});
    }
    if (found.curves.arcs.empty()) return;
    auto group = std::find_if(groups_.begin(), groups_.end(),
                              [&](const Group& other) { return other.label.vanishing == label.vanishing; });
    if (group == groups_.end()) group = groups_.insert(group, {label, {}});
    for (const space::ChartArc& arc : found.curves.arcs) {
      if (is_undirected(problem, mode_, label.vanishing, arc)) continue;
      SpaceArc space_arc;
      space_arc.closed = arc.closed;
      space_arc.ends = arc.ends;
      space_arc.certified = arc.certified;
      for (const SpacePoint& at : arc.points) space_arc.points.push_back(space::placed(problem, at));
      group->arcs.push_back(std::move(space_arc));
    }
  }

  const std::vector<const LocusProblem*>& charts_;
  const core::WorkingMode& mode_;
  const std::function<bool()>& stop_;
  std::vector<Group> groups_;
};

}  // namespace

void add_space_curves(const std::vector<const LocusProblem*>& charts, const core::WorkingMode& mode,
                      const std::function<bool()>& stop, LocusMap& map) {
  const std::vector<Quantity>& quantities = charts.front()->quantities;
  if (std::find(quantities.begin(), quantities.end(), Quantity::f) == quantities.end()) return;
  ModeCurves(charts, mode, stop).run(map);
}

}  // namespace clearloci::loci
