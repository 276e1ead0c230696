#include "tests/laws/law_subject.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/frame.hpp"

namespace clearloci::test {

std::vector<double> Witness::at_home(std::span<const double> pose) const {
  std::vector<double> at_home(pose.begin(), pose.end());
  for (std::size_t c = 0; c < at_home.size(); ++c) at_home[c] -= shift_.at(c);
  return at_home;
}

std::optional<numeric::Reactions> Witness::at(std::span<const double> pose, const std::vector<int>& sides) const {
  const numeric::Posture here = posture(pose, sides);
  if (!here.reachable()) return {};
  return numeric::solve_reactions(model_, here);
}

double Witness::value_of(const numeric::Reactions& reactions, const core::Vanishing& what) const {
  const auto value = [&](core::Quantity quantity) {
    for (std::size_t k = 0; k < model_.unknowns.size(); ++k)
      if (name_of(model_.unknowns[k].joint) == what.joint && model_.unknowns[k].quantity == quantity)
        return reactions.values[static_cast<Eigen::Index>(k)];
    return std::numeric_limits<double>::quiet_NaN();
  };
  if (what.quantity == core::Quantity::f)
    return has_force(what.joint) ? std::hypot(value(core::Quantity::fx), value(core::Quantity::fy))
                                 : std::hypot(value(core::Quantity::N), value(core::Quantity::T));
  if (!core::is_guide_end(what.quantity)) return value(what.quantity);
  const double n = value(core::Quantity::N), t = value(core::Quantity::T) / half_length(what.joint);
  return (what.quantity == core::Quantity::end_ahead ? n + t : n - t) / 2;
}

bool Witness::has_force(const std::string& joint) const {
  return std::any_of(model_.unknowns.begin(), model_.unknowns.end(), [&](const mechanism::Unknown& unknown) {
    return name_of(unknown.joint) == joint && unknown.quantity == core::Quantity::fx;
  });
}

double Witness::half_length(const std::string& joint) const {
  for (const auto& j : model_.mechanism.joints)
    if (j.name == joint && j.clearance)
      return core::to_double(mechanism::value_of(j.clearance->half_length, model_.mechanism));
  return 1;
}

namespace {

LociRequest request_of(const LawDesign& design, const mechanism::Mechanism& mechanism) {
  LociRequest request;
  request.joints = design.joints;
  if (!design.quantities.empty()) request.quantities = design.quantities;
  request.min_force = design.min_force;
  request.min_couple = design.min_couple;
  if (!design.sides.empty()) request.working_modes = {design.sides};
  request.all_working_modes = design.all_modes;
  request.tolerance = 1e-5 * mechanism::frame_of(mechanism).scale_value();
  return request;
}

}  // namespace

Subject::Subject(const LawDesign& law_design, Report& report_to)
    : design(law_design),
      report(report_to),
      mechanism(mechanism::parse_mechanism(law_design.text, "design.yaml")),
      witness(mechanism::parse_mechanism(law_design.home_text, "home.yaml"), law_design.shift),
      request(request_of(law_design, mechanism)) {}

std::vector<std::vector<double>> Subject::scattered(int n) const {
  std::vector<std::vector<double>> poses;
  const double first = std::numbers::sqrt2 - 1, second = std::numbers::phi - 1;
  const auto along = [&](std::size_t c, double part) { return lower(c) + part / n * (upper(c) - lower(c)); };
  for (int i = 0; i < n; ++i) {
    if (mechanism.coordinates.size() == 1) poses.push_back({along(0, i + first)});
    for (int k = 0; mechanism.coordinates.size() == 2 && k < n; ++k)
      poses.push_back({along(0, i + first), along(1, k + second)});
  }
  return poses;
}

double Subject::size() const {
  double greatest = 0;
  for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c) greatest = std::max(greatest, upper(c) - lower(c));
  return greatest;
}

double Subject::spacing() const {
  double farthest = 0;
  for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c)
    farthest = std::max({farthest, std::abs(lower(c)), std::abs(upper(c))});
  return std::numeric_limits<double>::epsilon() * farthest;
}

std::optional<core::LocusMap> loci_of(Subject& subject, core::Certificate* certificate) {
  try {
    core::LocusMap map =
        subject.report.in_patience([&] { return trace_loci(subject.mechanism, subject.request, certificate); });
    if (map.complete) return map;
    subject.report.uncertified("not complete");
    return map;
  } catch (const core::InputError& refused) {
    subject.report.refused(refused.what());
    is_rightly_refused(subject, refused.what());
    return std::nullopt;
  }
}

void is_rightly_refused(Subject& subject, const std::string& message) {
  const bool unreachable = message.find("unreachable") != std::string::npos;
  const bool singular = message.find("singular in every pose") != std::string::npos;
  // What is documented to be beyond a command (docs/reference/limitations.md) is no contradiction.
  if (!unreachable && !singular) return;
  bool every_mode = true;  // a request of several modes is refused where all of them are
  for (const DyadSides& sides : requested_modes(subject.mechanism, subject.request)) {
    bool wrong = false;
    for (const auto& pose : subject.scattered(subject.mechanism.coordinates.size() == 1 ? 2000 : 40)) {
      const numeric::BoundedNumerators at = subject.witness.bounded(pose, sides);
      if (!at.reachable) continue;
      wrong = wrong || unreachable || std::abs(at.determinant.value) > 1e3 * at.determinant.error;
    }
    every_mode = every_mode && !wrong;
    if (!subject.request.all_working_modes && wrong)
      Report::Line(subject.report) << "refused without cause: " << message;
  }
  if (subject.request.all_working_modes && unreachable && !every_mode)
    Report::Line(subject.report) << "refused without cause: " << message;
}

double area_of(const core::Polyline& ring) {
  double twice = 0;
  for (std::size_t i = 1; i < ring.size(); ++i)
    twice += (ring[i - 1][0] - ring[0][0]) * (ring[i][1] - ring[0][1]) -
             (ring[i][0] - ring[0][0]) * (ring[i - 1][1] - ring[0][1]);
  return twice / 2;
}

bool inside(const core::Polyline& ring, const Point2& at) {
  bool result = false;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const Point2 &a = ring[i - 1], &b = ring[i];
    if ((a[1] > at[1]) != (b[1] > at[1]) && at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1]))
      result = !result;
  }
  return result;
}

bool inside(const core::Zone& zone, const Point2& at) {
  return inside(zone.outer, at) && std::none_of(zone.holes.begin(), zone.holes.end(),
                                                [&](const core::Polyline& hole) { return inside(hole, at); });
}

}  // namespace clearloci::test
