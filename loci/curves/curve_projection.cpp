#include "loci/curves/curve_projection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "loci/curves/plane_curve.hpp"
#include "loci/curves/tracer.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusKind;
using core::Point2;

/// Relative to the region: a point is on the workspace boundary to the rounding of ends.
constexpr double on_rim = 1e-9;
/// Of a branch that leaves the boundary: the least share of the root in its tangent that tells on which side it does.
constexpr double clear_share = 1e-3;
/// Relative to the region: the error of what is followed.
constexpr double followed = 1e-13;
/// Of tangents at both ends of what was followed: the cosine of the angle by which it may turn.
constexpr double least_cosine = 0.5;

/// Doubles hold the values of an implicit polynomial up to this degree well enough.
constexpr int low_degree = 8;

core::Point2 unit(double x, double y) {
  const double length = std::hypot(x, y);
  return length > 0 && std::isfinite(length) ? core::Point2{x / length, y / length} : core::Point2{};
}

/// What is followed: the factor, or where that is a root alone the root's square, for beside the boundary the root says
/// badly where it is zero.
sheet::SheetFunction followed_function(const core::RootTower& tower, const core::LocusFactor& factor) {
  const std::vector<core::Term>& terms = factor.sheet.terms;
  for (std::size_t j = 0; j < tower.roots.size() && terms.size() == 1; ++j) {
    std::vector<int> alone(terms.front().exponents.size(), 0);
    alone[2 + j] = 1;
    if (!tower.roots[j].is_angle() && terms.front().exponents == alone)
      return sheet::square_of(tower, static_cast<int>(j), {});
  }
  return {factor.sheet, factor.line};
}

}  // namespace

/// Newton's method on the lifted curve, in the plane across its tangent.
struct CurveProjection::OnSheet {
  OnSheet(const core::LocusProblem& problem, const core::LocusCurve& curve, const sheet::SheetFunction& function)
      : part(sheet::subtower(problem.tower, curve.mode, {function.polynomial})),
        program(part.tower, std::vector{sheet::narrowed(function, part)}),
        size(size_of(problem)),
        follower(program, size),
        registers(program.registers<double>()) {}

  static double size_of(const core::LocusProblem& problem) {
    return std::max(core::to_double(problem.upper[0] - problem.lower[0]),
                    core::to_double(problem.upper[1] - problem.lower[1]));
  }

  sheet::LiftedPoint lifted(const Point2& near) {
    sheet::LiftedPoint point = {near[0], near[1]};
    registers.set(0, near[0]);
    registers.set(1, near[1]);
    for (int j = 0; j < program.roots(); ++j) {
      registers.run_square(j);
      const double root = part.mode[static_cast<std::size_t>(j)] * std::sqrt(std::max(0.0, registers.square(j)));
      registers.set(2 + j, root);
      point.push_back(root);
    }
    return point;
  }

  CurvePoint project(const Point2& near) {
    sheet::LiftedPoint point = lifted(near);
    const sheet::LiftedPoint across = follower.tangent(point);
    if (across.empty() || !follower.correct(point, across, sheet::dot(across, point))) return {near, {}};
    const sheet::LiftedPoint tangent = follower.tangent(point);
    return {{point[0], point[1]}, tangent.empty() ? Point2{} : unit(tangent[0], tangent[1])};
  }

  /// The roots that vanish at a point, to the rounding of ends; registers hold it.
  std::vector<std::size_t> roots_at_rim() {
    registers.run_gradients();
    std::vector<std::size_t> list;
    for (int j = 0; j < program.roots(); ++j) {
      double slope = 0;
      for (int v = 0; v < program.variables(); ++v) slope = std::max(slope, std::abs(registers.square_partial(j, v)));
      if (std::abs(registers.square(j)) <= on_rim * size * slope) list.push_back(static_cast<std::size_t>(j));
    }
    return list;
  }

  bool in_mode(const sheet::LiftedPoint& point) const {
    for (std::size_t j = 0; j < part.mode.size(); ++j)
      if (part.mode[j] * point[2 + j] <= 0) return false;
    return true;
  }

  std::optional<Point2> at_distance(const Point2& centre, const Point2& next, double radius) {
    sheet::LiftedPoint start = lifted(centre);
    const std::vector<std::size_t> vanishing = roots_at_rim();
    if (vanishing.size() > 1) return std::nullopt;
    sheet::LiftedPoint row = follower.tangent(start);
    if (row.empty()) return std::nullopt;
    if (!vanishing.empty()) {
      row.assign(start.size(), 0.0);
      row[2 + vanishing.front()] = 1;
      start[2 + vanishing.front()] = 0;
    }
    if (!follower.correct(start, row, sheet::dot(row, start))) return std::nullopt;
    if (std::hypot(start[0] - centre[0], start[1] - centre[1]) > on_rim * size) return std::nullopt;
    sheet::LiftedPoint tangent = follower.tangent(start);
    if (tangent.empty()) return std::nullopt;
    double direction = tangent[0] * (next[0] - centre[0]) + tangent[1] * (next[1] - centre[1]);
    if (!vanishing.empty()) {
      const std::size_t j = vanishing.front();
      if (std::abs(tangent[2 + j]) > clear_share) direction = part.mode[j] * tangent[2 + j];
    }
    if (direction < 0)
      for (double& entry : tangent) entry = -entry;
    return followed_to(start, tangent, centre, next, radius);
  }

  /// The point at that distance from the centre, of the branch that leaves `start` along the tangent.
  std::optional<Point2> followed_to(const sheet::LiftedPoint& start, const sheet::LiftedPoint& tangent,
                                    const Point2& centre, const Point2& next, double radius) {
    constexpr int most_steps = 20;
    constexpr double least_speed = 0.1;
    double ahead = radius / std::max(least_speed, std::hypot(tangent[0], tangent[1]));
    for (int step = 0; step < most_steps; ++step) {
      sheet::LiftedPoint point = start;
      for (std::size_t i = 0; i < point.size(); ++i) point[i] += ahead * tangent[i];
      if (!follower.correct(point, tangent, sheet::dot(tangent, start) + ahead) || !in_mode(point)) return std::nullopt;
      const sheet::LiftedPoint there = follower.tangent(point);
      const double cosine = there.empty() ? 0 : sheet::dot(there, tangent);
      if (std::abs(cosine) < least_cosine) return std::nullopt;
      const Point2 off = {point[0] - centre[0], point[1] - centre[1]};
      const double distance = std::hypot(off[0], off[1]);
      if (off[0] * (next[0] - centre[0]) + off[1] * (next[1] - centre[1]) <= 0) return std::nullopt;
      if (std::abs(distance - radius) <= followed * size) return Point2{point[0], point[1]};
      const double speed = (off[0] * there[0] + off[1] * there[1]) / (distance * cosine);
      if (!(speed > 0)) return std::nullopt;
      ahead += (radius - distance) / speed;
      if (!(ahead > 0)) return std::nullopt;
    }
    return std::nullopt;
  }

  std::optional<Point2> between(const Point2& a, const Point2& b) {
    const sheet::LiftedPoint from = lifted(a), to = lifted(b);
    sheet::LiftedPoint point = from, chord = to;
    double largest = 0;
    for (std::size_t i = 0; i < point.size(); ++i) {
      point[i] += (to[i] - from[i]) / 2;
      chord[i] -= from[i];
      largest = std::max(largest, std::abs(chord[i]));
    }
    if (largest == 0) return std::nullopt;
    for (double& entry : chord) entry /= largest;
    if (!follower.correct(point, chord, sheet::dot(chord, point)) || !in_mode(point)) return std::nullopt;
    return Point2{point[0], point[1]};
  }

  sheet::Subtower part;
  sheet::SheetProgram program;
  double size;
  sheet::SheetFollower follower;
  sheet::SheetProgram::Registers<double> registers;
};

struct CurveProjection::Implementation {
  std::vector<core::Circle> circles;
  std::optional<core::LineForm> line;
  std::unique_ptr<PlaneCurve> plane;
  std::unique_ptr<OnSheet> sheet;
};

CurveProjection::CurveProjection(const core::LocusProblem& problem, const core::LocusCurve& curve,
                                 const core::LocusFactor* factor)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& self = *implementation_;
  self.circles = core::circles_of(curve.closed_form);
  if (const auto* line = std::get_if<core::LineForm>(&curve.closed_form)) self.line = *line;
  if (!self.circles.empty() || self.line) return;
  const bool low = !curve.implicit.is_zero() && core::total_degree(curve.implicit) <= low_degree;
  if (low || factor == nullptr) self.plane = std::make_unique<PlaneCurve>(curve.implicit);
  if (factor != nullptr)
    self.sheet = std::make_unique<OnSheet>(problem, curve, followed_function(problem.tower, *factor));
}

CurveProjection::~CurveProjection() = default;
CurveProjection::CurveProjection(CurveProjection&&) noexcept = default;
CurveProjection& CurveProjection::operator=(CurveProjection&&) noexcept = default;

CurvePoint CurveProjection::operator()(const Point2& near) const {
  const Implementation& self = *implementation_;
  if (self.line) {
    const double a = core::to_double(self.line->a), b = core::to_double(self.line->b);
    const double off = (a * near[0] + b * near[1] + core::to_double(self.line->c)) / (a * a + b * b);
    return {{near[0] - off * a, near[1] - off * b}, unit(-b, a)};
  }
  if (!self.circles.empty()) {
    CurvePoint best = {near, {}};
    double least = -1;
    for (const auto& [centre, radius] : self.circles) {
      const double dx = near[0] - centre[0], dy = near[1] - centre[1], d = std::hypot(dx, dy);
      if (d == 0 || (least >= 0 && std::abs(d - radius) >= least)) continue;
      least = std::abs(d - radius);
      best = {{centre[0] + dx * radius / d, centre[1] + dy * radius / d}, unit(-dy, dx)};
    }
    return best;
  }
  if (self.sheet) {
    const CurvePoint on = self.sheet->project(near);
    if (!self.plane || on.tangent != Point2{}) return on;
  }
  const Point2 at = self.plane->project(near);
  const PlaneCurve::Jet jet = self.plane->jet(at);
  return {at, unit(-jet.fy, jet.fx)};
}

std::optional<Point2> CurveProjection::at_distance(const Point2& centre, const Point2& next, double radius) const {
  if (!implementation_->sheet) return std::nullopt;
  return implementation_->sheet->at_distance(centre, next, radius);
}

std::optional<Point2> CurveProjection::between(const Point2& a, const Point2& b) const {
  if (implementation_->sheet) return implementation_->sheet->between(a, b);
  const CurvePoint on = (*this)({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2});
  if (on.tangent == Point2{}) return std::nullopt;
  return on.at;
}

bool is_beside_chord(const Point2& at, const Point2& from, const Point2& to, double reach) {
  const Point2 way = {to[0] - from[0], to[1] - from[1]}, gone = {at[0] - from[0], at[1] - from[1]};
  const double square = way[0] * way[0] + way[1] * way[1];
  const double along = gone[0] * way[0] + gone[1] * way[1], across = gone[0] * way[1] - gone[1] * way[0];
  return along > 0 && along < square && std::abs(across) <= reach * std::sqrt(square);
}

const CurveProjection& CurveProjections::of(int curve) {
  const auto found = known_.find(curve);
  if (found != known_.end()) return found->second;
  const core::LocusCurve& locus_curve = map_->curves[static_cast<std::size_t>(curve)];
  return known_.emplace(curve, CurveProjection(*problem_, locus_curve, factor_of(*problem_, locus_curve)))
      .first->second;
}

const core::LocusFactor* factor_of(const core::LocusProblem& problem, const core::LocusCurve& curve) {
  const core::LocusFactor* owner = nullptr;
  for (const core::LocusFactor& factor : problem.factors) {
    const FactorRole role = curve.kind == LocusKind::direct_singularity   ? FactorRole::direct_singularity
                            : curve.kind == LocusKind::margin             ? FactorRole::margin
                            : curve.kind == LocusKind::preload            ? FactorRole::preload
                            : curve.kind == LocusKind::workspace_boundary ? FactorRole::workspace_boundary
                                                                          : FactorRole::reaction;
    if (role == FactorRole::workspace_boundary || factor.role != role) continue;
    const bool is_named = factor.expression == curve.factor;
    // The two senses of a least force have one polynomial.
    if (role == FactorRole::margin && !is_named) continue;
    if (curve.implicit.is_zero()
            ? factor.implicit.empty() && is_named
            : std::find(factor.implicit.begin(), factor.implicit.end(), curve.implicit) != factor.implicit.end()) {
      // Two factors may own one polynomial, each on sheets on which the other one does not vanish.
      if (is_named) return &factor;
      if (owner == nullptr) owner = &factor;
    }
  }
  return owner;
}

}  // namespace clearloci::loci
