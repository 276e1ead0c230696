// Arcs lie in the box, on their curves and in their modes, and what is said to vanish on them, and at points, tends to
// zero there. Over one coordinate points are where signs change.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/errors.hpp"
#include "tests/laws/law_subject.hpp"
#include "tests/laws/same_topology.hpp"

namespace clearloci::test {
namespace {

using core::ArcEnd;
using core::LocusKind;

/// Up to this degree the exact engine is quick.
constexpr int exact_degree = 8;

std::string describe(const core::LocusMap& map, const core::LocusCurve& curve) {
  std::string modes;
  for (const auto& [point, side] : core::describe_mode(map.tower, curve.mode)) modes += " " + point + " " + side;
  return curve.id + " " + to_string(curve.kind) + " " + curve.factor.substr(0, 60) + modes +
         (curve.certified ? "" : ", not certified");
}

/// Distance of a point from an implicit curve, to first order, in exact arithmetic; where the curve is singular the
/// size of the polynomial beside its second derivatives.
double distance_from(const core::Polynomial& implicit, const Point2& at) {
  const std::vector<core::Rational> exact = {core::Rational(at[0]), core::Rational(at[1])};
  const auto value = [&](const core::Polynomial& p) { return core::to_double(core::evaluate(p, exact)); };
  const core::Polynomial dx = core::derivative(implicit, 0), dy = core::derivative(implicit, 1);
  const double slope = std::hypot(value(dx), value(dy)), f = std::abs(value(implicit));
  const double bend =
      std::hypot(value(core::derivative(dx, 0)), value(core::derivative(dy, 1)), value(core::derivative(dx, 1)));
  // Near a double point the distance is about sqrt(f / bend); Newton's step is the bound elsewhere.
  const double newton = slope > 0 ? f / slope : f;
  return bend > 0 ? std::min(newton, std::sqrt(f / bend)) : newton;
}

class LocusLaws {
 public:
  LocusLaws(Subject& subject, const core::LocusMap& map)
      : s_(subject),
        map_(map),
        slack_(std::max(1e-12 * subject.size(), 4 * subject.spacing())),
        near_(std::max(1e-8 * subject.size(), 100 * subject.spacing())) {}

  void arcs_are_where_they_should_be() {
    for (const core::LocusCurve& curve : map_.curves)
      for (const core::Arc& arc : curve.arcs) check_arc(curve, arc);
  }

  /// What vanishes on an arc tends to zero where its pose comes near from either side (method.md section 10).
  void claims_hold() {
    for (const core::LocusCurve& curve : map_.curves) {
      const std::vector<int> sides = s_.sides_of(map_, curve.mode);
      for (const core::Arc& arc : curve.arcs) {
        const std::size_t n = arc.points.size();
        if (n < 5) continue;  // inside of a chord the curve is known to the tolerance only
        int wrong = 0, tried = 0;
        std::string last;
        for (const std::size_t i : {n / 4, n / 2, 3 * n / 4}) {
          const std::string fault = fault_beside(curve, sides, arc.points[i], arc.points[i - 1], arc.points[i + 1]);
          ++tried;
          if (!fault.empty()) ++wrong, last = fault;
        }
        ++claims_;
        // One of the three may lie beside a crossing with something else.
        if (wrong == tried) Report::Line(s_.report) << last << " on " << describe(map_, curve);
      }
    }
  }

  /// Nor is a point said to be one of contact loss where a force stays, from whatever side it is approached.
  void points_hold() {
    for (const core::IsolatedPoint& point : map_.isolated_points) {
      if (point.kind != LocusKind::contact_loss && point.kind != LocusKind::backlash) continue;
      if (!point.certified) continue;  // a place that is neither proven nor excluded, and said to be
      const std::vector<int> sides = s_.sides_of(map_, point.mode);
      for (int k = 0; k < 6; ++k) {
        const double direction = 1 + 2 * k * std::numbers::pi / 6;
        const auto beside = [&](double by) {
          return Point2{point.at[0] + by * std::cos(direction), point.at[1] + by * std::sin(direction)};
        };
        const auto a = s_.witness.at(beside(1e4 * near_), sides);
        auto b = s_.witness.at(beside(10 * near_), sides);
        if (!a || !b) continue;
        // On the boundary a force goes with the root of the distance, and may be small by chance at the first place.
        if (const auto c = s_.witness.at(beside(std::max(0.01 * near_, 10 * s_.spacing())), sides)) b = c;
        ++claims_;
        for (const core::Vanishing& what : point.vanishing) {
          const double wa = std::abs(s_.witness.value_of(*a, what)), wb = std::abs(s_.witness.value_of(*b, what));
          if (!(wb > 0.2 * wa + 1e-6 * b->values.cwiseAbs().maxCoeff())) continue;
          Report::Line(s_.report) << what.joint << "." << core::to_string(what.quantity) << " is " << wa << " and "
                                  << wb << " beside the point (" << point.at[0] << ", " << point.at[1] << ")";
          break;
        }
      }
    }
  }

  /// Between neighbouring poses a scalar reaction changes its sign where a point says so, and |A| too.
  void points_are_sign_changes() {
    const std::vector<std::vector<double>> poses = s_.scattered(2000);
    for (const core::ReachableInterval& interval : map_.reachable) {
      const std::vector<int> sides = s_.sides_of(map_, interval.mode);
      const auto point_between = [&](double a, double b, const auto& is_it) {
        return std::any_of(map_.isolated_points.begin(), map_.isolated_points.end(), [&](const auto& point) {
          if (point.mode != interval.mode || !is_it(point)) return false;
          for (const int turn : {-1, 0, 1}) {
            const double at = point.at.front() + 2 * turn * std::numbers::pi;
            if (at >= a - 1e-9 && at <= b + 1e-9) return true;
          }
          return false;
        });
      };
      std::optional<numeric::BoundedNumerators> before;
      for (std::size_t i = 0; i < poses.size(); ++i) {
        numeric::BoundedNumerators at = s_.witness.bounded(poses[i], sides);
        const bool both =
            before && before->reachable && at.reachable && poses[i - 1][0] > interval.from && poses[i][0] < interval.to;
        if (both) sign_changes_between(poses[i - 1][0], poses[i][0], *before, at, point_between);
        before = std::move(at);
      }
    }
  }

  void tell() const {
    s_.report.held("claims", claims_);
    s_.report.held("vertices", vertices_);
  }

 private:
  double lower(std::size_t c) const { return core::to_double(map_.lower[c]); }
  double upper(std::size_t c) const { return core::to_double(map_.upper[c]); }

  void check_arc(const core::LocusCurve& curve, const core::Arc& arc) {
    const auto fault = [&](const std::string& what, const Point2& at) {
      Report::Line(s_.report) << what << " (" << at[0] << ", " << at[1] << ") on " << describe(map_, curve);
    };
    if (arc.points.size() < 2) return fault("an arc without points", {});
    // A loop may begin and end in one crossing or cone; at the box it cannot.
    const bool same = arc.points.front() == arc.points.back();
    if (arc.closed != same && !(same && arc.ends[0] == arc.ends[1] && arc.ends[0] != ArcEnd::box))
      fault("closed or not", arc.points.front());
    if (arc.closed && arc.ends[0] != ArcEnd::none) fault("ends", arc.points.front());
    // Of an uncertified arc it may not be known where it ends.
    if (!arc.closed && curve.certified && (arc.ends[0] == ArcEnd::none || arc.ends[1] == ArcEnd::none))
      fault("ends", arc.points.front());
    double length = 0;
    for (std::size_t i = 0; i < arc.points.size(); ++i) {
      const Point2& p = arc.points[i];
      if (i > 0) length += std::hypot(p[0] - arc.points[i - 1][0], p[1] - arc.points[i - 1][1]);
      for (std::size_t c = 0; c < 2; ++c)
        if (p[c] < lower(c) - slack_ || p[c] > upper(c) + slack_) return fault("outside the box", p);
    }
    vertices_hold(curve, arc);
    // Engines drop arcs that are shorter than 1e-10 of the box.
    if (length <= 1e-10 * s_.size() - 4 * s_.spacing()) fault("an arc of no length", arc.points.front());
    if (!(std::abs(arc.length - length) <= 1e-3 * length + 10 * map_.tolerance))
      fault("length " + std::to_string(arc.length) + " for " + std::to_string(length), arc.points.front());
    for (const std::size_t end : {0u, 1u}) {
      if (arc.ends[end] != ArcEnd::box) continue;
      const Point2& p = end == 0 ? arc.points.front() : arc.points.back();
      bool on_a_side = false;
      for (std::size_t c = 0; c < 2; ++c)
        on_a_side = on_a_side || std::abs(p[c] - lower(c)) <= slack_ || std::abs(p[c] - upper(c)) <= slack_;
      if (!on_a_side) fault("an end at the box that is not", p);
    }
  }

  /// On the curve to 1e-12 of the box or four spacings of doubles: by its polynomial, and by what vanishes.
  void vertices_hold(const core::LocusCurve& curve, const core::Arc& arc) {
    const std::size_t n = arc.points.size();
    if (!curve.implicit.is_zero() && curve.variables.empty()) {
      const std::size_t step = core::total_degree(curve.implicit) > exact_degree ? 1 + n / 12 : 1;
      for (std::size_t i = 0; i < n; i += step) {
        ++vertices_;
        const double off = distance_from(curve.implicit, arc.points[i]);
        if (off > 2 * slack_)
          return void(Report::Line(s_.report) << "off its curve by " << off << " (" << arc.points[i][0] << ", "
                                              << arc.points[i][1] << ") on " << describe(map_, curve));
      }
    }
    if (curve.kind > LocusKind::component) return;
    const std::vector<int> sides = s_.sides_of(map_, curve.mode);
    for (std::size_t i = 0; i < n; ++i) vertex_is_a_zero(curve, sides, arc, i);
  }

  /// Where a scalar reaction's numerator changes its sign across the arc, its zero is where the vertex is.
  void vertex_is_a_zero(const core::LocusCurve& curve, const std::vector<int>& sides, const core::Arc& arc,
                        std::size_t i) {
    const Point2 &at = arc.points[i], &a = arc.points[i == 0 ? 0 : i - 1],
                 &b = arc.points[std::min(i + 1, arc.points.size() - 1)];
    const double l = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (l == 0) return;
    const double step = std::max(1e-6 * s_.size(), 1e4 * s_.spacing());
    const auto beside = [&](double by) {
      return s_.witness.bounded(std::array{at[0] - by * (b[1] - a[1]) / l, at[1] + by * (b[0] - a[0]) / l}, sides);
    };
    const numeric::BoundedNumerators here = beside(0), left = beside(step), right = beside(-step);
    if (!here.reachable || !left.reachable || !right.reachable) return;
    const auto& unknowns = s_.witness.model().unknowns;
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const std::string& joint = s_.mechanism.joints[static_cast<std::size_t>(unknowns[k].joint)].name;
      const bool named = std::any_of(curve.vanishing.begin(), curve.vanishing.end(), [&](const core::Vanishing& what) {
        return what.joint == joint && what.quantity == unknowns[k].quantity;
      });
      const double p = left.values[k].value, q = right.values[k].value, slope = std::abs(p - q) / (2 * step);
      if (!named || !(p * q < 0) || std::min(std::abs(p), std::abs(q)) < 0.3 * std::max(std::abs(p), std::abs(q)))
        continue;
      ++vertices_;
      const double off = (std::abs(here.values[k].value) - here.values[k].error) / slope;
      // The slope is that of a secant: where a closure is undefined beside it, it says nothing of the vertex.
      if (off > 10 * slack_ && !changes_sign_about(at, sides, k))
        Report::Line(s_.report) << core::to_string(unknowns[k].quantity) << " of " << joint << " vanishes " << off
                                << " beside the vertex (" << at[0] << ", " << at[1] << ") of " << describe(map_, curve);
    }
  }

  /// Whether a numerator has either sign on the circle round a vertex that it is to be zero in.
  bool changes_sign_about(const Point2& at, const std::vector<int>& sides, std::size_t unknown) const {
    constexpr int directions = 32;
    bool positive = false, negative = false;
    for (int k = 0; k < directions; ++k) {
      const double direction = 0.1 + 2 * k * std::numbers::pi / directions;
      const numeric::BoundedNumerators there = s_.witness.bounded(
          std::array{at[0] + slack_ * std::cos(direction), at[1] + slack_ * std::sin(direction)}, sides);
      if (!there.reachable) continue;
      const numeric::Bounded& value = there.values[unknown];
      positive = positive || value.value > value.error;
      negative = negative || value.value < -value.error;
    }
    return positive && negative;
  }

  /// Of the dyads and sliders the one nearest to stretched out or folded: half the way to where its apex would be in
  /// the other working mode.
  double least_height(const Point2& at, const std::vector<int>& sides) const {
    const numeric::Posture here = s_.witness.posture(at, sides);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < sides.size(); ++i) {
      std::vector<int> other = sides;
      other[i] = -other[i];
      const auto apex = static_cast<std::size_t>(s_.witness.model().dyads[i]);
      const auto there = s_.witness.posture(at, other);
      least = std::min(least, (here.points[apex] - there.points[apex]).norm() / 2);
    }
    return least;
  }

  /// How far apart the points are in the postures at two places.
  double jump(const Point2& from, const Point2& to, const std::vector<int>& sides) const {
    const numeric::Posture here = s_.witness.posture(from, sides), there = s_.witness.posture(to, sides);
    double most = 0;
    for (std::size_t i = 0; i < here.points.size(); ++i)
      most = std::max(most, (here.points[i] - there.points[i]).norm());
    return most;
  }

  /// Empty where everything is as the curve says.
  std::string fault_beside(const core::LocusCurve& curve, const std::vector<int>& sides, const Point2& at,
                           const Point2& before, const Point2& after) const {
    const double dx = after[0] - before[0], dy = after[1] - before[1], l = std::hypot(dx, dy);
    if (l == 0) return {};
    int alive = 0;
    bool grows = false;
    std::ostringstream fault;
    fault.precision(10);
    const auto beside = [&](double by) { return Point2{at[0] - by * dy / l, at[1] + by * dx / l}; };
    // A root of the distance shrinks by 30 in between, and its zero is still far above rounding errors.
    const double far = 1e3 * near_, nearest = std::max(1e-3 * near_, 10 * s_.spacing());
    for (const double side : {1.0, -1.0}) {
      const auto a = s_.witness.at(beside(side * far), sides), b = s_.witness.at(beside(side * near_), sides);
      if (b) ++alive;
      if (!a || !b) continue;
      const double scale = b->values.cwiseAbs().maxCoeff();
      grows = grows || scale > 5 * a->values.cwiseAbs().maxCoeff();
      // Where bases nearly coincide reactions grow in the last thousandth of that way, or |A| vanishes before it.
      const auto c = s_.witness.at(beside(side * nearest), sides);
      if (c) grows = grows || c->values.cwiseAbs().maxCoeff() > 5 * scale;
      if (curve.kind == LocusKind::direct_singularity && !(std::abs(b->determinant) <= 0.2 * std::abs(a->determinant)))
        fault << "|A| is " << a->determinant << " and " << b->determinant;
      // What vanishes next to |A| = 0, nearer to it than these places are, has there the value that it tends to.
      if (!curve.certified && curve.kind != LocusKind::direct_singularity && c &&
          std::abs(c->determinant) <= 0.2 * std::abs(b->determinant))
        continue;
      for (const core::Vanishing& what : curve.vanishing) {
        const double wa = std::abs(s_.witness.value_of(*a, what)), wb = std::abs(s_.witness.value_of(*b, what));
        if (curve.kind == LocusKind::margin) {
          // A linear drive bears a force.
          const auto& least = what.quantity == core::Quantity::M ? s_.request.min_couple : s_.request.min_force;
          const auto is_between = [&](double nearer, double farther) {
            const double bound = core::to_double(*least);
            return std::abs(nearer - bound) <= 1e-4 * bound + std::abs(nearer - farther);
          };
          // Beside a boundary a force may change all that it does within the nearer place.
          if (least && !is_between(wb, wa) && !(c && is_between(std::abs(s_.witness.value_of(*c, what)), wb)))
            fault << what.joint << "." << core::to_string(what.quantity) << " is " << wb << " on a margin";
        } else if (!(wb <= 0.2 * wa + 1e-6 * scale) && !(c && std::abs(s_.witness.value_of(*c, what)) <= 0.2 * wb)) {
          // The last is what rounding may leave of a zero among reactions of that size.
          fault << what.joint << "." << core::to_string(what.quantity) << " is " << wa << " and " << wb << " of "
                << scale;
        }
      }
      if (!fault.str().empty()) break;
    }
    // Where roots depend on one another a leg may be stretched out and the mechanism goes on: a fold. Where the ends of
    // a dyad meet all along a curve, its point is elsewhere beyond.
    const auto folds = [&] { return least_height(beside(near_), sides) <= 0.2 * least_height(beside(far), sides); };
    const auto jumps = [&] {
      return jump(beside(near_), beside(-near_), sides) >= 0.5 * jump(beside(far), beside(-far), sides);
    };
    if (curve.kind == LocusKind::workspace_boundary && alive != 1 && !(alive == 2 && (folds() || jumps())))
      fault << "a boundary with a posture on " << alive << " sides";
    if (alive == 0) fault << "no posture";
    if (curve.kind == LocusKind::direct_singularity && alive > 0 && curve.excited != grows)
      fault << "reactions " << (grows ? "grow" : "stay finite");
    if (fault.str().empty()) return {};
    std::ostringstream place;
    place.precision(12);
    place << fault.str() << " at (" << at[0] << ", " << at[1] << ")";
    return place.str();
  }

  template <typename PointBetween>
  void sign_changes_between(double a, double b, const numeric::BoundedNumerators& p,
                            const numeric::BoundedNumerators& q, const PointBetween& point_between) {
    const auto sign = [](const numeric::Bounded& value) {
      return std::abs(value.value) > value.error ? (value.value > 0 ? 1 : -1) : 0;
    };
    const int turn = sign(p.determinant) * sign(q.determinant);
    if (turn == 0) return;
    const bool singular =
        point_between(a, b, [](const auto& point) { return point.kind == LocusKind::direct_singularity; });
    if (turn < 0 && !singular)
      Report::Line(s_.report) << "|A| changes its sign between " << a << " and " << b << " rad, where no point is";
    ++claims_;
    const auto wanted = [&](const std::string& joint) {
      const auto& joints = s_.request.joints;
      return joints.empty() || std::find(joints.begin(), joints.end(), joint) != joints.end();
    };
    const auto& asked = s_.request.quantities;
    if (std::find(asked.begin(), asked.end(), core::Quantity::M) == asked.end()) return;
    // Across a singularity a reaction may change its sign without a zero, whatever |A| does: both may be even at a
    // fold.
    for (std::size_t k = 0; k < p.values.size() && turn > 0 && !singular; ++k) {
      const mechanism::Unknown& unknown = s_.witness.model().unknowns[k];
      const mechanism::Joint& joint = s_.mechanism.joints[static_cast<std::size_t>(unknown.joint)];
      if (unknown.quantity != core::Quantity::M || !joint.clearance || !wanted(joint.name)) continue;
      if (sign(p.values[k]) * sign(q.values[k]) >= 0) continue;
      if (!point_between(a, b, [&](const auto& point) {
            return std::any_of(point.vanishing.begin(), point.vanishing.end(), [&](const core::Vanishing& what) {
              return what.joint == joint.name && what.quantity == unknown.quantity;
            });
          }))
        Report::Line(s_.report) << "M of " << joint.name << " changes its sign between " << a << " and " << b
                                << " rad, where no point is";
    }
  }

  Subject& s_;
  const core::LocusMap& map_;
  double slack_, near_;
  long claims_ = 0, vertices_ = 0;
};

}  // namespace

void judge_loci(Subject& subject) {
  const std::optional<core::LocusMap> map = loci_of(subject);
  if (!map) return;
  const auto open = [](const auto& list) {
    return std::any_of(list.begin(), list.end(), [](const auto& candidate) { return !candidate.certified; });
  };
  if (open(map->curves) || open(map->isolated_points)) subject.report.uncertified("loci");
  LocusLaws laws(subject, *map);
  if (subject.mechanism.coordinates.size() == 1) {
    laws.points_are_sign_changes();
  } else {
    laws.arcs_are_where_they_should_be();
    laws.claims_hold();
    laws.points_hold();
  }
  laws.tell();
}

void judge_validation(Subject& subject) {
  if (subject.mechanism.coordinates.size() == 1) return;
  try {
    const Validation validation = subject.report.in_patience(
        [&] { return validate_loci(subject.mechanism, subject.request, {.nx = 60, .ny = 60}); });
    subject.report.held("edges", static_cast<long>(validation.report.held));
    if (validation.report.disputed == 0) return;
    Report::Line line(subject.report);
    line << validation.report.disputed << " edges disputed";
    if (validation.report.disputed_edges.empty()) return;
    const numeric::DisputedEdge& edge = validation.report.disputed_edges.front();
    line << ", the first of " << edge.reaction.joint << "." << core::to_string(edge.reaction.quantity) << " at ("
         << edge.from[0] << ", " << edge.from[1] << ")";
  } catch (const core::InputError& refused) {
    subject.report.refused(refused.what());
  }
}

/// Where degrees are small both engines tell the same.
void judge_engines(Subject& subject) {
  if (!subject.is_plane()) return;
  const std::optional<core::LocusMap> map = loci_of(subject);
  if (!map || !map->complete) return;
  for (const core::LocusCurve& curve : map->curves)
    if (curve.implicit.is_zero() || core::total_degree(curve.implicit) > exact_degree) return;
  subject.request.engine = Engine::exact;
  const std::optional<core::LocusMap> exact = loci_of(subject);
  if (!exact || !exact->complete) return;
  subject.report.held("compared engines");
  LocusLaws(subject, *exact).arcs_are_where_they_should_be();
  const std::vector<std::string> differences = test::differences(*exact, *map, test::EndsOnSides::by_place);
  for (std::size_t i = 0; i < std::min<std::size_t>(differences.size(), 4); ++i)
    Report::Line(subject.report) << "exact engine first, adaptive second: " << differences[i];
}

}  // namespace clearloci::test
