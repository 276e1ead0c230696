#include "loci/curves/isolated_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "loci/curves/edge_labels.hpp"
#include "loci/curves/force_zeros.hpp"
#include "loci/curves/no_limit.hpp"
#include "loci/curves/open_regions.hpp"
#include "loci/curves/place_words.hpp"
#include "loci/curves/trace_sheet.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/search/search.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::IsolatedPoint;
using core::LocusKind;
using core::LocusMap;
using core::LocusProblem;
using core::Quantity;
using core::WorkingMode;
using sheet::MultiInterval;

/// Whether a curve passes within `reach` of a point.
bool passes(const core::LocusCurve& curve, const core::Point2& at, double reach) {
  for (const core::Arc& arc : curve.arcs) {
    for (std::size_t i = 1; i < arc.points.size(); ++i) {
      const core::Point2 &a = arc.points[i - 1], &b = arc.points[i];
      const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
      const double t = length2 > 0 ? std::clamp(((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0.0;
      if (std::hypot(a[0] + t * dx - at[0], a[1] + t * dy - at[1]) <= reach) return true;
    }
  }
  return false;
}

/// Whether a contact-loss curve of the joint passes within `reach` of a point.
bool on_contact_loss_curve(const LocusMap& map, const WorkingMode& mode, const std::string& joint,
                           const core::Point2& at, double reach) {
  return std::any_of(map.curves.begin(), map.curves.end(), [&](const core::LocusCurve& curve) {
    return curve.mode == mode && passes(curve, at, reach) &&
           std::any_of(curve.vanishing.begin(), curve.vanishing.end(),
                       [&](const auto& v) { return v.joint == joint && v.quantity == Quantity::f; });
  });
}

/// By its steps where they are fewer than the terms of its polynomial.
MultiInterval square_of(const core::Root& root, const std::vector<MultiInterval>& at) {
  if (root.square.terms.size() > root.line.steps.size())
    if (std::optional<MultiInterval> value = evaluate(root.line, at)) return *value;
  return evaluate(root.square, at);
}

/// The point on the mode's sheet; empty where it lies outside the workspace.
std::vector<MultiInterval> on_sheet(const core::RootTower& tower, const WorkingMode& mode, const PointEnclosure& at) {
  std::vector<MultiInterval> variables;
  for (std::size_t i = 0; i < 2; ++i) variables.emplace_back(at.lower[i], at.upper[i]);
  variables.resize(static_cast<std::size_t>(tower.variables()), MultiInterval(core::Rational(0)));
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    if (tower.roots[j].is_angle()) {
      variables[2 + j] = sheet::angle_root(tower.roots[j], variables);
      continue;
    }
    const MultiInterval square = square_of(tower.roots[j], variables);
    if (!square.non_negative()) return {};
    const MultiInterval root = square_root(square);
    variables[2 + j] = mode[j] > 0 ? root : -root;
  }
  return variables;
}

/// Whether enclosures tell that a factor does not vanish: of the polynomial, or of what is computed, which is sharper
/// where terms of a long polynomial all but cancel.
bool is_nonzero(const core::LocusFactor& factor, const std::vector<MultiInterval>& at) {
  if (evaluate(factor.sheet, at).sign() != 0) return true;
  const std::optional<MultiInterval> value = evaluate(factor.line, at);
  return value && value->sign() != 0;
}

/// The point of a zero on the mode's sheet, enclosed; empty where it lies outside the workspace.
std::vector<MultiInterval> at_zero(const LocusProblem& problem, const WorkingMode& mode, const sheet::SheetZero& zero) {
  const core::Rational x(zero.x), y(zero.y), radius(std::max(zero.radius, 1e-15));
  return on_sheet(problem.tower, mode, {{x - radius, y - radius}, {x + radius, y + radius}});
}

/// Where |A| vanishes too the numerators say nothing about the reaction, 0/0: every joint's vanish there together.
bool on_direct_singularity(const LocusProblem& problem, const WorkingMode& mode, const sheet::SheetZero& zero) {
  const std::vector<MultiInterval> at = at_zero(problem, mode, zero);
  return !at.empty() &&
         std::any_of(problem.factors.begin(), problem.factors.end(), [&](const core::LocusFactor& factor) {
           return factor.role == FactorRole::direct_singularity && !is_nonzero(factor, at);
         });
}

/// Whether the construction, or the direction of a force along a way, may be undefined: there numerators vanish
/// whatever the reaction does.
bool may_be_undefined(const core::RootTower& tower, const std::vector<MultiInterval>& at) {
  return std::any_of(tower.denominators.begin(), tower.denominators.end(),
                     [&](const core::Polynomial& denominator) { return evaluate(denominator, at).sign() == 0; });
}

/// Whether the components of a joint's force may vanish at a zero though the force does not.
bool may_be_undirected(const LocusProblem& problem, const WorkingMode& mode, const std::string& joint,
                       const core::Point2& at, double radius) {
  const core::Rational x(at[0]), y(at[1]), r(std::max(radius, 1e-15));
  return std::any_of(problem.factors.begin(), problem.factors.end(), [&](const core::LocusFactor& factor) {
    if (!is_undirected_pin(factor, joint)) return false;
    const auto there = on_sheet(problem.tower, mode, {{x - r, y - r}, {x + r, y + r}});
    return !there.empty() && evaluate(factor.sheet, there).sign() == 0;
  });
}

/// Whether an arc of a reaction ends on a direct singularity at a point: then its end says that there is no limit.
bool ends_on_singularity(const LocusMap& map, const WorkingMode& mode, const core::Point2& at, double same) {
  for (const core::LocusCurve& curve : map.curves) {
    if (curve.mode != mode) continue;
    for (const core::Arc& arc : curve.arcs)
      for (const std::size_t end : {0u, 1u}) {
        const core::Point2& p = end == 0 ? arc.points.front() : arc.points.back();
        if (arc.ends[end] == core::ArcEnd::direct_singularity && std::hypot(p[0] - at[0], p[1] - at[1]) <= same)
          return true;
      }
  }
  return false;
}

bool names_all(const std::vector<core::Vanishing>& list, const std::vector<core::Vanishing>& wanted) {
  return std::all_of(wanted.begin(), wanted.end(), [&](const core::Vanishing& vanishing) {
    return std::any_of(list.begin(), list.end(), [&](const core::Vanishing& v) {
      return v.joint == vanishing.joint && v.quantity == vanishing.quantity;
    });
  });
}

/// Whether one of the map's certified points is this place, and says as much.
bool is_proven_at(const LocusMap& map, const WorkingMode& mode, const std::string& joint, const core::Point2& at,
                  double same) {
  return std::any_of(map.isolated_points.begin(), map.isolated_points.end(), [&](const IsolatedPoint& point) {
    return point.certified && point.mode == mode && point.kind == LocusKind::contact_loss &&
           std::hypot(point.at[0] - at[0], point.at[1] - at[1]) <= same &&
           names_all(point.vanishing, {{joint, Quantity::f, 1}});
  });
}

/// Joins a joint to a point already found, or adds the point; its place among the points. `shares`: whether what is
/// proven of one of the joints there is proven of the other.
std::size_t add_point(LocusMap& map, std::size_t first, const IsolatedPoint& point, double same,
                      const std::function<bool(std::size_t)>& shares = {}) {
  for (std::size_t i = first; i < map.isolated_points.size(); ++i) {
    IsolatedPoint& isolated_point = map.isolated_points[i];
    if (isolated_point.mode != point.mode || isolated_point.kind != point.kind ||
        (isolated_point.certified != point.certified && !(shares && shares(i))) ||
        std::hypot(isolated_point.at[0] - point.at[0], isolated_point.at[1] - point.at[1]) > same) {
      continue;
    }
    isolated_point.certified = isolated_point.certified || point.certified;
    for (const core::Vanishing& v : point.vanishing) {
      if (std::find(isolated_point.vanishing.begin(), isolated_point.vanishing.end(), v) ==
          isolated_point.vanishing.end()) {
        isolated_point.vanishing.push_back(v);
      }
    }
    return i;
  }
  map.isolated_points.push_back(point);
  return map.isolated_points.size() - 1;
}

/// Relative to the box: Newton's method in doubles finds multiple zeros no better, such as the place where the axis of
/// a guide is undefined and every numerator vanishes.
constexpr double multiple_zero = 1e-7;
/// Nearer than this, relative to the box, two points are one.
constexpr double same_point = 1e-9;

/// A common zero of two sheet polynomials by Newton's method in doubles, within `reach` of the start.
std::optional<core::Point2> newton(const core::RootTower& tower, const WorkingMode& mode, const core::Polynomial& first,
                                   const core::Polynomial& second, const core::Point2& start, double reach) {
  const auto values = [&](const core::Point2& p) -> std::optional<core::Point2> {
    std::vector<double> at = {p[0], p[1]};
    at.resize(static_cast<std::size_t>(tower.variables()), 0.0);
    for (std::size_t j = 0; j < tower.roots.size(); ++j) {
      const std::optional<double> root = core::root_value(tower.roots[j], mode[j], at);
      if (!root) return std::nullopt;
      at[2 + j] = *root;
    }
    return core::Point2{core::evaluate(first, std::span<const double>(at)),
                        core::evaluate(second, std::span<const double>(at))};
  };
  core::Point2 p = start;
  for (int i = 0; i < 30; ++i) {
    const double h = std::max(1e-7 * reach, 1e-9);
    const auto f = values(p), fx = values({p[0] + h, p[1]}), fy = values({p[0], p[1] + h});
    if (!f || !fx || !fy) return std::nullopt;
    const double a = ((*fx)[0] - (*f)[0]) / h, b = ((*fy)[0] - (*f)[0]) / h;
    const double c = ((*fx)[1] - (*f)[1]) / h, d = ((*fy)[1] - (*f)[1]) / h;
    const double determinant = a * d - b * c;
    const core::Point2 step = {((*f)[0] * d - b * (*f)[1]) / determinant, (a * (*f)[1] - c * (*f)[0]) / determinant};
    if (!std::isfinite(step[0]) || !std::isfinite(step[1])) return std::nullopt;
    p = {p[0] - step[0], p[1] - step[1]};
    if (std::hypot(p[0] - start[0], p[1] - start[1]) > reach) return std::nullopt;
    if (std::hypot(step[0], step[1]) < 1e-13 * std::max(1.0, std::hypot(p[0], p[1]))) return p;
  }
  return std::nullopt;
}

/// A point in a cell: on an axis where that is within it.
core::Point2 point_in(const sheet::PlaneCell& cell) {
  const auto number_in = [](const Interval& range) { return range.contains(0) ? 0 : range.middle(); };
  return {number_in(cell.x), number_in(cell.y)};
}

std::array<double, 4> box_of(const sheet::PlaneCell& cell) {
  return {cell.x.lower(), cell.x.upper(), cell.y.lower(), cell.y.upper()};
}

/// Where points may be that nothing was proven of: once for all joints along a chain, whose forces vanish together.
class Doubts {
 public:
  /// `where`: a box round all of the places.
  void add(const std::string& joint, std::size_t places, const std::string& box) {
    const std::string where = "an isolated point is neither proven nor excluded " +
                              (places == 1 ? box : "in " + std::to_string(places) + " places, all " + box);
    const auto found = std::find_if(all_.begin(), all_.end(), [&](const auto& doubt) { return doubt.first == where; });
    if (found == all_.end())
      all_.push_back({where, {joint}});
    else if (found->second.back() != joint)
      found->second.push_back(joint);
  }

  void tell(std::vector<std::string>& notes) const {
    for (const auto& [where, joints] : all_) {
      std::string names = joints.front();
      for (std::size_t i = 1; i < joints.size(); ++i) names += ", " + joints[i];
      notes.push_back("contact loss of " + names + ": " + where);
    }
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> all_;
};

/// Whether the force is proven to vanish at a proven zero of the first two factors; nothing where it is proven not to.
std::optional<bool> vanishes_at(const LocusProblem& problem, const WorkingMode& mode, const ForceZeros& zeros,
                                const sheet::SheetZero& zero) {
  if (zeros.third == nullptr) return true;
  const std::vector<MultiInterval> at = at_zero(problem, mode, zero);
  if (at.empty()) return false;
  if (is_nonzero(*zeros.third, at)) return std::nullopt;
  return zeros.normal != nullptr && evaluate(*zeros.normal, at).sign() != 0;
}

}  // namespace

void add_contact_loss_points(const LocusProblem& problem, const WorkingMode& mode, LocusMap& map,
                             const std::function<bool()>& stop, int most_cells, sheet::KnownSearches* known_searches) {
  if (std::find(problem.quantities.begin(), problem.quantities.end(), Quantity::f) == problem.quantities.end()) return;
  const std::size_t first = map.isolated_points.size();
  const std::vector<sheet::Star> cones = sheet::enclosed_cones(problem.tower, mode, problem.lower, problem.upper);
  const double size = std::max(core::to_double(problem.upper[0] - problem.lower[0]),
                               core::to_double(problem.upper[1] - problem.lower[1]));
  std::vector<std::pair<std::string, ForceZeros>> asked;
  // Joints along one chain bear the same force: the same factors are searched once.
  std::map<std::vector<const core::LocusFactor*>, sheet::ZeroSet> zeros;
  for (const std::string& joint : problem.joints)
    for (const ForceZeros& of_joint : zeros_of_force(problem, joint)) {
      asked.emplace_back(joint, of_joint);
      zeros.try_emplace(of_joint.factors());
    }
  std::vector<std::pair<const std::vector<const core::LocusFactor*>, sheet::ZeroSet>*> searches;
  for (auto& search : zeros) searches.push_back(&search);
  run_in_order(searches.size(), [&](std::size_t i) {
    auto& [factors, found] = *searches[i];
    std::vector<sheet::SheetFunction> functions;
    for (const core::LocusFactor* factor : factors) functions.push_back({factor->sheet, factor->line});
    // Where both have gradients a leg without length is a common zero like others. |A| vanishes there, too.
    std::vector<sheet::Star> stars = cones;
    std::erase_if(stars, [&functions](const sheet::Star& star) {
      return star.no_length && !star.is_sheared() && sheet::is_smooth_at(star, functions[0].polynomial) &&
             sheet::is_smooth_at(star, functions[1].polynomial);
    });
    found = sheet::isolated_zeros(problem.tower, mode, functions[0], functions[1], problem.lower, problem.upper,
                                  {.most_cells = most_cells,
                                   .special = std::move(stars),
                                   .also = {functions.begin() + 2, functions.end()},
                                   .touches = true,
                                   .stop = stop,
                                   .searches = known_searches});
  });
  Doubts doubts;
  std::set<std::size_t> proven_of_all;  // points without a limit
  for (const auto& joint_and_factors : asked) {
    const std::string& joint = joint_and_factors.first;
    const ForceZeros& factors = joint_and_factors.second;
    const sheet::ZeroSet& found = zeros.at(factors.factors());
    const auto add = [&](const core::Point2& at, bool certified) {
      if (on_contact_loss_curve(map, mode, joint, at, 2 * problem.tolerance)) return false;
      if (may_be_undirected(problem, mode, joint, at, 1e-12 * size)) return false;
      add_point(map, first, {LocusKind::contact_loss, {{joint, Quantity::f, 1}}, {at[0], at[1]}, mode, certified},
                same_point * size);
      return true;
    };
    // Where |A| is zero too, and not only to the last bit, there is no limit.
    const auto add_without_limit = [&](const sheet::SheetZero& at, bool is_proven) {
      if (ends_on_singularity(map, mode, {at.x, at.y}, 1e-7 * size)) return;
      const NoLimit proven = is_proven ? no_limit(problem, mode, joint, factors, at) : NoLimit::unknown;
      const auto shares = [&](std::size_t i) {
        const IsolatedPoint& known = map.isolated_points[i];
        const bool is_named = names_all(known.vanishing, {{joint, Quantity::f, 1}});
        return proven == NoLimit::of_all || proven_of_all.contains(i) ||
               (is_named && (known.certified || known.vanishing.size() == 1));
      };
      const std::size_t place = add_point(
          map, first, {LocusKind::no_limit, {{joint, Quantity::f, 1}}, {at.x, at.y}, mode, proven != NoLimit::unknown},
          same_point * size, shares);
      if (proven == NoLimit::of_all) proven_of_all.insert(place);
    };
    for (const sheet::SheetZero& zero : found.zeros) {
      const std::optional<bool> vanishes = vanishes_at(problem, mode, factors, zero);
      if (!vanishes) continue;
      if (on_direct_singularity(problem, mode, zero)) {
        add_without_limit(zero, *vanishes);
        continue;
      }
      const std::vector<MultiInterval> pose = at_zero(problem, mode, zero);
      const bool is_proven = *vanishes && (pose.empty() || !may_be_undefined(problem.tower, pose));
      const bool added = add({zero.x, zero.y}, is_proven);
      if (added && !is_proven)
        leave_point_open(joint, mode,
                         {zero.x - zero.radius, zero.x + zero.radius, zero.y - zero.radius, zero.y + zero.radius}, map);
    }
    if (stop && stop()) {
      map.out_of_time = true;
      return;
    }
    // Whether the force vanishes at a double zero of its components, no enclosure tells.
    std::vector<sheet::PlaneCell> undecided = found.undecided;
    for (const sheet::SheetZero& touch : found.touches) {
      if (!vanishes_at(problem, mode, factors, touch)) continue;
      if (on_direct_singularity(problem, mode, touch))
        add_without_limit(touch, false);
      else
        undecided.push_back(
            {{touch.x - touch.radius, touch.x + touch.radius}, {touch.y - touch.radius, touch.y + touch.radius}});
    }
    // An undecided cell in which Newton's method finds a point shows that point, and stays an open place besides.
    std::size_t open = 0;
    sheet::PlaneCell hull;
    for (const sheet::PlaneCell& cell : undecided) {
      const core::Point2 centre = point_in(cell);
      const double reach = 4 * std::max({cell.x.width(), cell.y.width(), 1e-9 * size});
      auto at = newton(problem.tower, mode, factors.system[0]->sheet, factors.system[1]->sheet, centre, reach);
      if (at && !vanishes_at(problem, mode, factors, {(*at)[0], (*at)[1], {}, multiple_zero * size})) at.reset();
      // That it leads back to a proven point says nothing of the rest of the cell.
      const bool is_proven = at && is_proven_at(map, mode, joint, *at, same_point * size);
      if (at && !is_proven && !on_direct_singularity(problem, mode, {(*at)[0], (*at)[1], {}, multiple_zero * size})) {
        if (add(*at, false)) leave_point_open(joint, mode, box_of(cell), map);
        continue;
      }
      leave_point_open(joint, mode, box_of(cell), map);
      hull = open == 0 ? cell : sheet::PlaneCell{core::hull(hull.x, cell.x), core::hull(hull.y, cell.y)};
      ++open;
    }
    if (open > 0) doubts.add(joint, open, place_words(problem, box_of(hull)));
  }
  doubts.tell(map.notes);
}

namespace {

/// |A| vanishes at a star of the box; added where no curve of the map with |A| = 0 passes within `reach` in the mode.
void add_singular_point(const LocusProblem& problem, const WorkingMode& mode, const sheet::Star& star, double reach,
                        bool certified, LocusMap& map) {
  const double size = std::max(core::to_double(problem.upper[0] - problem.lower[0]),
                               core::to_double(problem.upper[1] - problem.lower[1]));
  const core::Point2 at = {core::to_double(star.x), core::to_double(star.y)};
  const bool reached = std::any_of(map.curves.begin(), map.curves.end(), [&](const core::LocusCurve& curve) {
    return curve.mode == mode && curve.kind == LocusKind::direct_singularity && passes(curve, at, reach);
  });
  if (!reached) add_point(map, 0, {LocusKind::direct_singularity, {}, {at[0], at[1]}, mode, certified}, 1e-9 * size);
}

}  // namespace

void add_singular_points(const LocusProblem& problem, const WorkingMode& mode, LocusMap& map) {
  const double size = std::max(core::to_double(problem.upper[0] - problem.lower[0]),
                               core::to_double(problem.upper[1] - problem.lower[1]));
  // Empty: no pose of the box.
  const auto pose_of = [&](const sheet::Star& star) -> std::vector<MultiInterval> {
    const core::Rational r = star.apex ? star.apex->radius : core::Rational(0);
    const PointEnclosure at = {{star.x - r, star.y - r}, {star.x + r, star.y + r}};
    for (std::size_t c = 0; c < 2; ++c)
      if (at.lower[c] < problem.lower[c] || problem.upper[c] < at.upper[c]) return {};
    return on_sheet(problem.tower, mode, at);
  };
  for (const sheet::Star& touch : sheet::touches(problem.tower)) {
    std::vector<core::Rational> exact(static_cast<std::size_t>(problem.tower.variables()), core::Rational(0));
    exact[0] = touch.x;
    exact[1] = touch.y;
    const auto vanishes = [&](const core::Polynomial& sheet) {
      for (std::size_t j = 0; j < problem.tower.roots.size(); ++j)
        if (touch.power_of_root(static_cast<int>(j)) == 0 && core::depends_on(sheet, 2 + static_cast<int>(j)))
          return false;
      return core::evaluate(sheet, exact) == 0;
    };
    const bool singular =
        std::any_of(problem.factors.begin(), problem.factors.end(), [&](const core::LocusFactor& factor) {
          return factor.role == FactorRole::direct_singularity && vanishes(factor.sheet);
        });
    if (singular && !pose_of(touch).empty()) add_singular_point(problem, mode, touch, 1e-9 * size, true, map);
  }
  for (const sheet::Star& star : sheet::enclosed_cones(problem.tower, mode, problem.lower, problem.upper)) {
    if (!star.no_length) continue;
    const std::vector<MultiInterval> at = pose_of(star);
    const auto may_vanish = [&](FactorRole role) {
      return std::any_of(problem.factors.begin(), problem.factors.end(), [&](const core::LocusFactor& factor) {
        return factor.role == role && !is_nonzero(factor, at);
      });
    };
    // All of |A| vanishes there exactly; which part of it does not, where efforts are free. Where a curve is smooth it
    // need have no vertex.
    if (!at.empty() && may_vanish(FactorRole::direct_singularity))
      add_singular_point(problem, mode, star, 2 * problem.tolerance, !may_vanish(FactorRole::preload), map);
  }
}

void drop_points_on_curves(LocusMap& map) {
  const double size =
      std::max(core::to_double(map.upper[0] - map.lower[0]), core::to_double(map.upper[1] - map.lower[1]));
  std::erase_if(map.isolated_points, [&](const IsolatedPoint& point) {
    return point.kind <= LocusKind::component &&
           std::any_of(map.curves.begin(), map.curves.end(), [&](const core::LocusCurve& curve) {
             return curve.mode == point.mode && names_all(curve.vanishing, point.vanishing) &&
                    passes(curve, {point.at[0], point.at[1]}, same_point * size);
           });
  });
}

bool reaches(const LocusProblem& problem, const WorkingMode& mode, const core::LocusFactor& factor,
             const sheet::Star& star) {
  const std::array<double, 4> box = {core::to_double(problem.lower[0]), core::to_double(problem.upper[0]),
                                     core::to_double(problem.lower[1]), core::to_double(problem.upper[1])};
  return sheet::reaches(problem.tower, mode, {factor.sheet, factor.line}, star, box);
}

void add_isolated_curve_points(const LocusProblem& problem, const WorkingMode& mode,
                               const CurveArrangement& arrangement,
                               const std::vector<std::vector<int>>& curves_of_factor,
                               const std::vector<sheet::Star>& stars, LocusMap& map) {
  for (const ArrangementPoint& point : arrangement.isolated_points()) {
    const std::vector<MultiInterval> at = on_sheet(problem.tower, mode, point.enclosure);
    if (at.empty()) continue;
    const auto star = std::find_if(stars.begin(), stars.end(), [&](const sheet::Star& candidate) {
      const core::Rational radius = candidate.apex ? candidate.apex->radius : core::Rational(0);
      return point.enclosure.lower[0] <= candidate.x + radius && candidate.x - radius <= point.enclosure.upper[0] &&
             point.enclosure.lower[1] <= candidate.y + radius && candidate.y - radius <= point.enclosure.upper[1];
    });
    std::vector<core::Vanishing> components;
    LocusKind kind = LocusKind::workspace_boundary;
    for (std::size_t f = 0; f < problem.factors.size(); ++f) {
      const core::LocusFactor& factor = problem.factors[f];
      const auto& curves = curves_of_factor[f];
      if (std::find(curves.begin(), curves.end(), point.curve) == curves.end()) continue;
      if (evaluate(factor.sheet, at).sign() != 0) continue;
      if (star != stars.end() && !reaches(problem, mode, factor, *star)) continue;
      if (factor.role == FactorRole::reaction) {
        components.insert(components.end(), factor.vanishing.begin(), factor.vanishing.end());
      }
      if (factor.role == FactorRole::direct_singularity) kind = LocusKind::direct_singularity;
      if (factor.role == FactorRole::margin) kind = LocusKind::margin;
      if (factor.role == FactorRole::preload) kind = LocusKind::preload;
    }
    const std::vector<core::Vanishing> vanishing = wanted_vanishing(problem, components);
    if (!vanishing.empty()) kind = gravest_kind(vanishing);
    if (kind == LocusKind::workspace_boundary) continue;
    // Around an enclosed place only what is recognised is told.
    const bool is_exact = star != stars.end() && (!star->apex || star->apex->exact);
    const bool is_proven = is_exact || !may_be_undefined(problem.tower, at);
    map.isolated_points.push_back({kind, vanishing, {point.at[0], point.at[1]}, mode, is_proven});
  }
}

}  // namespace clearloci::loci
