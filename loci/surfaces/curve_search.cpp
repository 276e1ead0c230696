#include "loci/surfaces/curve_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angle_chart.hpp"
#include "core/errors.hpp"
#include "loci/surfaces/space_search.hpp"

namespace clearloci::loci::space {
namespace {

/// At every point looked at one of the rows is zero, to rounding and to first order.
bool one_vanishes_along(LiftedCell& lifted, std::size_t first_row, std::size_t end_row, const SpaceCell& box,
                        const std::vector<SpacePoint>& points) {
  constexpr double vanishes_within = 1e-8;  // of the box
  constexpr std::size_t looked_at = 24;
  const std::size_t step = std::max<std::size_t>(1, points.size() / looked_at);
  for (std::size_t i = 0; i < points.size(); i += step) {
    SpaceCell cell;
    for (std::size_t c = 0; c < 3; ++c) cell[c] = Interval(points[i][c]);
    const std::optional<LiftedBox> at = lifted.lift(cell);
    if (!at || !lifted.enter(*at)) continue;
    lifted.differentiate();
    bool vanishes = false;
    for (std::size_t row = first_row; row < end_row; ++row) {
      double slope = 0;
      for (std::size_t c = 0; c < 3; ++c) slope += lifted.slope(row, c).magnitude() * box[c].width();
      vanishes = vanishes || lifted.value(row).mignitude() <= vanishes_within * slope;
    }
    if (!vanishes) return false;
  }
  return true;
}

class PointSearch : public SpaceSearch {
 public:
  using SpaceSearch::SpaceSearch;

  FoundPoints run() {
    FoundPoints result;
    search(result, [&](const OpenCell& open, const LiftedBox& box, bool singular) {
      if (singular || open.depth == 0) return false;
      Square system{equations(), {}};
      for (std::size_t d = 0; d < box.size(); ++d) system.free.push_back(d);
      LiftedBox wide, image;
      for (const Interval& range : box) wide.push_back(widened(range));
      const Zeros count = krawczyk(lifted_, system, wide, image);
      if (count == Zeros::unique) add(narrowed(lifted_, system, image), box, result);
      return count != Zeros::unknown;
    });
    return result;
  }

 private:
  void add(const LiftedBox& zero, const LiftedBox& box, FoundPoints& result) {
    for (std::size_t d = 0; d < box.size(); ++d)
      if (disjoint(zero[d], box[d])) return;
    // Of two cells that share a side either may have it; on a side of the box, to rounding, it counts as inside.
    ChartPoint point;
    for (std::size_t i = 0; i < 3; ++i) {
      point.at[i] = zero[i].middle();
      if (disjoint(zero[i], box_[i])) return;
    }
    for (const ChartPoint& chart_point : result.points) {
      bool equal = true;
      for (std::size_t i = 0; i < 3; ++i)
        equal = equal && std::abs(chart_point.at[i] - point.at[i]) <= one_zero * box_[i].width();
      if (equal) return;
    }
    result.points.push_back(point);
  }
};

/// A cell in which the curve is known.
struct CurveCell {
  SpaceCell cell;
  std::size_t parameter = 0;
  bool singular = false;
  std::vector<Crossing> crossings;  ///< by the parameter; two and two bound a stretch
};

class CurveSearch : public SpaceSearch {
 public:
  using SpaceSearch::SpaceSearch;

  FoundCurves run() {
    search(result_, [&](const OpenCell& open, const LiftedBox& box, bool singular) {
      // Where |A| vanishes too, cells are small before that is left open.
      constexpr int singular_depth = 8;
      if (open.depth < (singular ? singular_depth : limits_.least_depth)) return false;
      std::optional<CurveCell> cell = solved(open.cell, box);
      if (!cell) return false;
      cell->singular = singular;
      if (singular) settled_singular_.push_back(open.cell);
      if (!cell->crossings.empty()) found_.push_back(std::move(*cell));
      return true;
    });
    string_together();
    return std::move(result_);
  }

 private:
  /// The curve in a cell that was examined last; nothing where it is not told.
  std::optional<CurveCell> solved(const SpaceCell& cell, const LiftedBox& box) {
    CurveCell result{cell, 0, false, {}};
    const std::vector<std::size_t> rows = equations();
    const std::optional<std::size_t> parameter = parameter_of(lifted_, rows, box);
    if (!parameter) return std::nullopt;
    result.parameter = *parameter;
    for (std::size_t face = 0; face < box.size(); ++face)
      for (const bool upper : {false, true}) {
        double at = upper ? box[face].upper() : box[face].lower();
        if (face >= 3) {
          // Of a root the side at 0 is the workspace boundary; at the other the square is at its largest.
          if (at != 0) continue;
          at = 0;
        }
        LiftedBox range = box;
        range[face] = Interval(at);
        Square system{rows, {}};
        for (std::size_t d = 0; d < box.size(); ++d)
          if (d != face) system.free.push_back(d);
        const auto found = zeros(system, range);
        if (!found) return std::nullopt;
        for (const LiftedBox& zero : *found) {
          Crossing crossing;
          for (const Interval& d : zero) crossing.at.push_back(d.middle());
          if (face >= 3)
            crossing.end = core::ArcEnd::boundary;
          else if (at == (upper ? box_[face].upper() : box_[face].lower()))
            crossing.end = core::ArcEnd::box;
          result.crossings.push_back(std::move(crossing));
        }
      }
    std::sort(result.crossings.begin(), result.crossings.end(),
              [&](const Crossing& a, const Crossing& b) { return a.at[*parameter] < b.at[*parameter]; });
    // On an edge of the box both of its faces have the crossing.
    const auto same_place = [&](const Crossing& a, const Crossing& b) {
      for (std::size_t i = 0; i < 3; ++i)
        if (std::abs(a.at[i] - b.at[i]) > one_zero * box_[i].width()) return false;
      return a.end == core::ArcEnd::box && b.end == core::ArcEnd::box;
    };
    result.crossings.erase(std::unique(result.crossings.begin(), result.crossings.end(), same_place),
                           result.crossings.end());
    if (result.crossings.size() % 2 != 0) return std::nullopt;
    return result;
  }

  // ---- Pieces strung together

  struct Node {
    SpacePoint at{};
    core::ArcEnd end = core::ArcEnd::none;
    std::vector<std::size_t> stretches;
  };
  struct Stretch {
    std::size_t cell = 0, crossing = 0;  ///< and the next
    std::array<std::size_t, 2> nodes{};
  };

  std::size_t node_at(const Crossing& crossing) {
    const SpacePoint at = {crossing.at[0], crossing.at[1], crossing.at[2]};
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      bool equal = true;
      for (std::size_t i = 0; i < 3; ++i)
        equal = equal && std::abs(nodes_[n].at[i] - at[i]) <= one_zero * box_[i].width();
      if (equal) return n;
    }
    nodes_.push_back({at, crossing.end, {}});
    return nodes_.size() - 1;
  }

  void string_together() {
    for (std::size_t c = 0; c < found_.size(); ++c)
      for (std::size_t p = 0; p + 1 < found_[c].crossings.size(); p += 2) {
        Stretch stretch{c, p, {node_at(found_[c].crossings[p]), node_at(found_[c].crossings[p + 1])}};
        for (const std::size_t node : stretch.nodes) nodes_[node].stretches.push_back(stretches_.size());
        stretches_.push_back(stretch);
      }
    used_.assign(stretches_.size(), false);
    // Open ones from their ends, then what is left closes.
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      if (nodes_[n].stretches.size() != 2)
        for (const std::size_t stretch : nodes_[n].stretches)
          if (!used_[stretch]) follow(stretch, n);
    for (std::size_t p = 0; p < stretches_.size(); ++p)
      if (!used_[p]) follow(p, stretches_[p].nodes[0]);
  }

  void follow(std::size_t stretch, std::size_t from) {
    ChartArc arc;
    arc.certified = true;
    arc.points = {nodes_[from].at};
    std::size_t node = from;
    while (true) {
      used_[stretch] = true;
      const Stretch& stretch_data = stretches_[stretch];
      const CurveCell& cell = found_[stretch_data.cell];
      const bool forwards = stretch_data.nodes[0] == node;
      const Crossing &first = cell.crossings[stretch_data.crossing + (forwards ? 0 : 1)],
                     &last = cell.crossings[stretch_data.crossing + (forwards ? 1 : 0)];
      add_vertices(cell, first.at, last.at, 0, arc.points);
      arc.certified = arc.certified && !cell.singular;
      node = stretch_data.nodes[forwards ? 1 : 0];
      arc.points.push_back(nodes_[node].at);
      const std::vector<std::size_t>& here = nodes_[node].stretches;
      if (node == from || here.size() != 2) break;
      const std::size_t next = here[0] == stretch ? here[1] : here[0];
      if (used_[next]) break;
      stretch = next;
    }
    arc.closed = node == from && nodes_[from].stretches.size() == 2;
    if (!arc.closed) {
      arc.ends = {end_at(from), end_at(node)};
      for (const std::size_t n : {from, node})
        arc.certified = arc.certified && nodes_[n].end != core::ArcEnd::none && nodes_[n].stretches.size() == 1;
    }
    if (!is_singular(arc)) cut_at_singularity(std::move(arc));
  }

  std::vector<double> determinants_at(const SpacePoint& at) {
    std::vector<double> values;
    const std::optional<LiftedBox> box = lifted_.lift({Interval(at[0]), Interval(at[1]), Interval(at[2])});
    if (!box || !lifted_.enter(*box)) return values;
    for (std::size_t row = first_determinant_; row < static_cast<std::size_t>(lifted_.functions()); ++row)
      values.push_back(lifted_.value(row).middle());
    return values;
  }

  /// Between two points where a factor of |A| has opposite signs: where it vanishes, by Newton's method from between.
  SpacePoint where_singular(std::size_t factor, const SpacePoint& from, double before, const SpacePoint& to,
                            double behind) {
    SpacePoint at{};
    const double part = before / (before - behind);
    for (std::size_t i = 0; i < 3; ++i) at[i] = from[i] + part * (to[i] - from[i]);
    const std::optional<LiftedBox> start = lifted_.lift({Interval(at[0]), Interval(at[1]), Interval(at[2])});
    if (!start) return at;
    LiftedBox box = *start;
    Square system{equations(), {}};
    system.rows.push_back(first_determinant_ + factor);
    for (std::size_t d = 0; d < box.size(); ++d) system.free.push_back(d);
    constexpr int steps = 6;
    for (int step = 0; step < steps; ++step) {
      const std::optional<std::vector<double>> moved = newton(lifted_, system, box);
      if (!moved) return at;
      for (std::size_t d = 0; d < box.size(); ++d) box[d] = Interval((*moved)[d]);
    }
    SpacePoint found{};
    double apart = 0, way = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      found[i] = box[i].middle();
      apart += std::abs(found[i] - at[i]);
      way += std::abs(to[i] - from[i]);
    }
    return apart <= way ? found : at;
  }

  /// Where |A| changes its sign the force has no limit: arcs end there.
  void cut_at_singularity(ChartArc arc) {
    std::vector<ChartArc> parts = {arc};
    parts.back().points = {arc.points.front()};
    std::vector<double> before = determinants_at(arc.points.front());
    for (std::size_t p = 1; p < arc.points.size(); ++p) {
      const std::vector<double> behind = determinants_at(arc.points[p]);
      for (std::size_t f = 0; f < before.size() && f < behind.size(); ++f) {
        if (!(before[f] * behind[f] < 0)) continue;
        const SpacePoint at = where_singular(f, arc.points[p - 1], before[f], arc.points[p], behind[f]);
        parts.back().points.push_back(at);
        parts.back().ends[1] = core::ArcEnd::direct_singularity;
        parts.push_back({false, {core::ArcEnd::direct_singularity, arc.ends[1]}, arc.certified, {at}});
        break;
      }
      parts.back().points.push_back(arc.points[p]);
      before = behind;
    }
    if (arc.closed && parts.size() > 1) {
      // The last goes on where the first began.
      ChartArc& last = parts.back();
      last.points.insert(last.points.end(), parts.front().points.begin() + 1, parts.front().points.end());
      last.ends[1] = parts.front().ends[1];
      parts.erase(parts.begin());
    }
    for (ChartArc& part : parts) {
      part.closed = arc.closed && parts.size() == 1 && part.ends[0] == core::ArcEnd::none;
      result_.arcs.push_back(std::move(part));
    }
  }

  core::ArcEnd end_at(std::size_t node) const {
    if (nodes_[node].end != core::ArcEnd::none) return nodes_[node].end;
    const SpacePoint& at = nodes_[node].at;
    for (const UndecidedCell& cell : result_.undecided) {
      bool touches = cell.near_singularity;
      for (std::size_t i = 0; i < 3; ++i)
        touches = touches && !disjoint(cell.cell[i], Interval(at[i] - one_zero * box_[i].width(),
                                                              at[i] + one_zero * box_[i].width()));
      if (touches) return core::ArcEnd::direct_singularity;
    }
    return core::ArcEnd::none;
  }

  /// |A| vanishes all along: the reactions have no limit there.
  bool is_singular(const ChartArc& arc) {
    return one_vanishes_along(lifted_, first_determinant_, static_cast<std::size_t>(lifted_.functions()), box_,
                              arc.points);
  }

  /// Between two points of one stretch: halved along its parameter until the chords are close enough.
  void add_vertices(const CurveCell& cell, const std::vector<double>& from, const std::vector<double>& to, int depth,
                    std::vector<SpacePoint>& points) {
    constexpr int most_halvings = 10;
    if (depth >= most_halvings) return;
    const std::optional<std::vector<double>> middle = between(cell, from, to);
    if (!middle) return;
    const SpacePoint a = placed(problem_, {from[0], from[1], from[2]}), b = placed(problem_, {to[0], to[1], to[2]}),
                     point = placed(problem_, {(*middle)[0], (*middle)[1], (*middle)[2]});
    double along = 0, length = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      along += (point[i] - a[i]) * (b[i] - a[i]);
      length += (b[i] - a[i]) * (b[i] - a[i]);
    }
    double off = 0;
    const double t = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double d = point[i] - a[i] - t * (b[i] - a[i]);
      off += d * d;
    }
    if (std::sqrt(off) <= limits_.tolerance) return;
    add_vertices(cell, from, *middle, depth + 1, points);
    points.push_back({(*middle)[0], (*middle)[1], (*middle)[2]});
    add_vertices(cell, *middle, to, depth + 1, points);
  }

  /// The point half way along the parameter, by Newton's method in the cell.
  std::optional<std::vector<double>> between(const CurveCell& cell, const std::vector<double>& from,
                                             const std::vector<double>& to) {
    const std::optional<LiftedBox> range = lifted_.lift(cell.cell);
    if (!range) return std::nullopt;
    LiftedBox at;
    for (std::size_t d = 0; d < from.size(); ++d) at.emplace_back(0.5 * (from[d] + to[d]));
    Square system{equations(), {}};
    for (std::size_t d = 0; d < at.size(); ++d)
      if (d != cell.parameter) system.free.push_back(d);
    constexpr int most_steps = 20;
    for (int step = 0; step < most_steps; ++step) {
      LiftedBox image;
      if (!newton_step(system, at, image)) return std::nullopt;
      double moved = 0;
      for (const std::size_t d : system.free) {
        moved = std::max(moved, std::abs(image[d].middle() - at[d].middle()) / (*range)[d].width());
        if (!widened((*range)[d]).contains(image[d].middle())) return std::nullopt;
      }
      at = image;
      constexpr double settled = 1e-11;
      if (moved < settled) {
        std::vector<double> result;
        for (const Interval& d : at) result.push_back(d.middle());
        return result;
      }
    }
    return std::nullopt;
  }

  /// Krawczyk's operator on a point is Newton's step.
  bool newton_step(const Square& system, const LiftedBox& at, LiftedBox& next) {
    const std::optional<std::vector<double>> moved = newton(lifted_, system, at);
    if (!moved) return false;
    next = at;
    for (std::size_t i = 0; i < system.free.size(); ++i) next[system.free[i]] = Interval((*moved)[i]);
    return true;
  }

  std::vector<CurveCell> found_;
  std::vector<Node> nodes_;
  std::vector<Stretch> stretches_;
  std::vector<bool> used_;
  FoundCurves result_;
};

}  // namespace

SpacePoint placed(const core::LocusProblem& problem, const SpacePoint& variables) {
  SpacePoint place = variables;
  for (std::size_t i = 0; i < 3; ++i)
    if (i < problem.charts.size() && problem.charts[i]) place[i] = core::angle_at(*problem.charts[i], variables[i]);
  return place;
}

FoundCurves find_curves(const core::LocusProblem& problem, const core::WorkingMode& mode, const Equations& equations,
                        const SearchLimits& limits) {
  core::ensure(equations.system.size() == 2, "a curve of two equations");
  return CurveSearch(problem, mode, equations, limits).run();
}

bool vanishes_along(const core::LocusProblem& problem, const core::WorkingMode& mode,
                    const sheet::SheetFunction& function, const ChartArc& arc) {
  LiftedCell lifted(problem, mode, {function});
  return one_vanishes_along(lifted, 0, 1, box_of(problem), arc.points);
}

FoundPoints find_points(const core::LocusProblem& problem, const core::WorkingMode& mode, const Equations& equations,
                        const SearchLimits& limits) {
  core::ensure(equations.system.size() == 3, "points of three equations");
  return PointSearch(problem, mode, equations, limits).run();
}

}  // namespace clearloci::loci::space
