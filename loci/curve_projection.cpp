#include "loci/curve_projection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "loci/plane_curve.hpp"
#include "loci/sheet/sheet_follower.hpp"
#include "loci/sheet/subtower.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusKind;
using core::Point2;

/// Doubles hold the values of an implicit polynomial up to this degree well enough.
constexpr int low_degree = 8;

core::Point2 unit(double x, double y) {
  const double length = std::hypot(x, y);
  return length > 0 && std::isfinite(length) ? core::Point2{x / length, y / length} : core::Point2{};
}

}  // namespace

/// Newton's method on the lifted curve, in the plane across its tangent.
struct CurveProjection::OnSheet {
  OnSheet(const core::LocusProblem& problem, const core::LocusCurve& curve, const core::LocusFactor& factor)
      : part(sheet::subtower(problem.tower, curve.mode, {factor.sheet})),
        program(part.tower, std::vector{sheet::narrowed(sheet::SheetFunction{factor.sheet, factor.line}, part)}),
        follower(program, size_of(problem)),
        registers(program.registers<double>()) {}

  static double size_of(const core::LocusProblem& problem) {
    return std::max(core::to_double(problem.upper[0] - problem.lower[0]),
                    core::to_double(problem.upper[1] - problem.lower[1]));
  }

  CurvePoint project(const Point2& near) {
    sheet::LiftedPoint point = {near[0], near[1]};
    registers.set(0, near[0]);
    registers.set(1, near[1]);
    for (int j = 0; j < program.roots(); ++j) {
      registers.run_square(j);
      const double root = part.mode[static_cast<std::size_t>(j)] * std::sqrt(std::max(0.0, registers.square(j)));
      registers.set(2 + j, root);
      point.push_back(root);
    }
    const sheet::LiftedPoint across = follower.tangent(point);
    if (across.empty() || !follower.correct(point, across, sheet::dot(across, point))) return {near, {}};
    const sheet::LiftedPoint tangent = follower.tangent(point);
    return {{point[0], point[1]}, tangent.empty() ? Point2{} : unit(tangent[0], tangent[1])};
  }

  sheet::Subtower part;
  sheet::SheetProgram program;
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
  if (factor != nullptr) self.sheet = std::make_unique<OnSheet>(problem, curve, *factor);
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

const CurveProjection& CurveProjections::of(int curve) {
  const auto found = known_.find(curve);
  if (found != known_.end()) return found->second;
  const core::LocusCurve& own = map_->curves[static_cast<std::size_t>(curve)];
  return known_.emplace(curve, CurveProjection(*problem_, own, factor_of(*problem_, own))).first->second;
}

const core::LocusFactor* factor_of(const core::LocusProblem& problem, const core::LocusCurve& curve) {
  for (const core::LocusFactor& factor : problem.factors) {
    const FactorRole role = curve.kind == LocusKind::direct_singularity   ? FactorRole::direct_singularity
                            : curve.kind == LocusKind::margin             ? FactorRole::margin
                            : curve.kind == LocusKind::workspace_boundary ? FactorRole::workspace_boundary
                                                                          : FactorRole::reaction;
    if (role == FactorRole::workspace_boundary || factor.role != role) continue;
    // The two senses of a least force have one polynomial.
    if (role == FactorRole::margin && factor.expression != curve.factor) continue;
    if (std::find(factor.implicit.begin(), factor.implicit.end(), curve.implicit) != factor.implicit.end())
      return &factor;
  }
  return nullptr;
}

}  // namespace clearloci::loci
