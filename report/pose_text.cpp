// The tables of a pose: those of the plane and of space differ in their columns.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "report/file_units.hpp"
#include "report/pose.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::Quantity;

constexpr std::string_view axes = "xyz";

template <class... Values>
void put(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

/// Nine digits; "unbounded" for infinities and NaN.
std::string number(double value) {
  constexpr int digits = 9;
  return std::isfinite(value) ? engineering(value, digits) : "unbounded";
}

/// Of a take-up: NaN where it is undefined.
std::string played(double value) { return std::isnan(value) ? "undefined" : number(value); }

std::string played(const std::optional<double>& value) { return value ? played(*value) : std::string(); }

const core::ReactionComponent* component(const core::JointReaction& reaction, Quantity quantity) {
  const auto& all = reaction.components;
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.quantity == quantity; });
  return found == all.end() ? nullptr : &*found;
}

/// Nothing where the joint has no such component.
std::string entry(const core::JointReaction& reaction, Quantity quantity) {
  const core::ReactionComponent* const own = component(reaction, quantity);
  return own == nullptr ? std::string() : number(own->value);
}

/// Why no pose error is defined: "contact is lost at A1, B1; M = 0 at A1", or that it is a direct singularity.
std::string undefined_words(const core::Pose& pose) {
  if (pose.singular) return "|A| = 0 here: the reactions are unbounded or have no limit";
  const std::vector<std::pair<Quantity, std::string>> wordings = {{Quantity::f, "contact is lost at "},
                                                                  {Quantity::end_ahead, "the end ahead lifts at "},
                                                                  {Quantity::end_behind, "the end behind lifts at "},
                                                                  {Quantity::M, "M = 0 at "},
                                                                  {Quantity::F, "F = 0 at "}};
  std::string words;
  for (const auto& [quantity, start] : wordings) {
    std::string joints;
    for (const core::Vanishing& one : pose.vanishing)
      if (one.quantity == quantity) joints += (joints.empty() ? "" : ", ") + one.joint;
    if (!joints.empty()) words += (words.empty() ? "" : "; ") + start + joints;
  }
  return words;
}

void put_head(std::string& text, const core::Pose& pose, const std::string& at) {
  put(text, "{} at ({})", pose.mechanism, at);
  for (const auto& [point, side] : pose.working_mode) put(text, ", {} {}", point, side);
  put(text, "\n\n{:<12}", "point");
  for (std::size_t c = 0; c < pose.worst.displacement.size(); ++c)
    put(text, "{:>18}", fmt::format("{} [{}]", axes[c], pose.units.length.name));
  put(text, "\n");
  for (const core::PosePoint& point : pose.points) {
    put(text, "{:<12}", point.name);
    for (const double value : point.at) put(text, "{:>18}", number(value));
    put(text, "\n");
  }
}

// ---- Plane

/// Of a reaction in the units of the file: couples are in N m.
std::string unit_of(Quantity quantity, const core::Units& units) {
  const std::string si = core::unit_of(quantity);
  return si == "N" ? units.force.name : si;
}

/// "dx [mm]".
std::string head(std::string_view name, const std::string& unit) { return fmt::format("{} [{}]", name, unit); }

/// "N 12.5 N, T 0 N m, F 3 N".
void put_prismatic(std::string& text, const core::JointReaction& reaction, const core::Units& units) {
  std::vector<std::string> parts;
  for (const core::ReactionComponent& c : reaction.components)
    parts.push_back(fmt::format("{} {} {}", core::to_string(c.quantity), number(c.value), unit_of(c.quantity, units)));
  put(text, "{:<12}      {}\n", reaction.joint, fmt::join(parts, ", "));
}

void put_reactions(std::string& text, const core::Pose& pose) {
  const std::string& force = pose.units.force.name;
  put(text, "\n{:<12}{:>18}{:>18}{:>18}{:>18}\n", "joint", head("fx", force), head("fy", force), head("|f|", force),
      "M [N m]");
  for (const core::JointReaction& reaction : pose.reactions) {
    const core::ReactionComponent *const fx = component(reaction, Quantity::fx), *const fy =
                                                                                     component(reaction, Quantity::fy);
    if (fx == nullptr || fy == nullptr) {
      put_prismatic(text, reaction, pose.units);
      continue;
    }
    const bool finite = std::isfinite(fx->value) && std::isfinite(fy->value);
    put(text, "{:<12}{:>18}{:>18}{:>18}{:>18}\n", reaction.joint, number(fx->value), number(fy->value),
        finite ? number(std::hypot(fx->value, fy->value)) : "unbounded", entry(reaction, Quantity::M));
  }
}

void put_error(std::string& text, const std::string& what, const std::vector<double>& displacement, double rotation) {
  put(text, "{:<18}{:>16}{:>18}{:>18}\n", what, number(displacement[0]), number(displacement[1]), number(rotation));
}

void put_error(std::string& text, const std::string& what, const core::PoseError& error) {
  put_error(text, what, error.displacement, error.rotation.front());
}

void put_take_up(std::string& text, const core::JointTakeUp& own, const core::Units& units) {
  if (!own.displacement.empty()) {
    put(text, "{:<12}{:>18}{:>18}{:>18}{:>18}\n", own.joint, played(own.displacement[0]), played(own.displacement[1]),
        played(own.beta), played(own.rotation));
    return;
  }
  std::vector<std::string> parts;
  const auto add = [&](const char* name, const std::optional<double>& value, const std::string& unit) {
    if (value) parts.push_back(fmt::format("{} {} {}", name, played(value), unit));
  };
  add("normal", own.normal, units.length.name);
  add("tilt", own.tilt, units.angle.name);
  add("axial", own.axial, units.length.name);
  put(text, "{:<12}      {}\n", own.joint, fmt::join(parts, ", "));
}

/// What the errors are relative to, where it is not the ground.
void put_base(std::string& text, const core::Pose& pose) {
  if (!pose.relative_to.empty()) put(text, "relative to link {}\n", pose.relative_to);
}

void put_accuracy(std::string& text, const core::Pose& pose) {
  if (pose.take_up.empty()) return;
  const std::string &length = pose.units.length.name, &angle = pose.units.angle.name;
  put(text, "\n{:<12}{:>18}{:>18}{:>18}{:>18}\n", "take-up", head("dx", length), head("dy", length),
      head("beta", angle), head("dtheta", angle));
  for (const core::JointTakeUp& own : pose.take_up) put_take_up(text, own, pose.units);
  put(text, "\n{:<18}{:>16}{:>18}{:>18}\n", "pose error", head("dx", length), head("dy", length),
      head("dalpha", angle));
  put_base(text, pose);
  if (pose.error)
    put_error(text, "linear", *pose.error);
  else
    put(text, "undefined: {}\n", undefined_words(pose));
  if (pose.actual) {
    put_error(text, "iterated", pose.actual->error);
    put_error(text, "  difference", pose.actual->beyond_linear);
    put(text, "  {} iterations, closure within {:.2g}\n", pose.actual->iterations, pose.actual->residual);
  }
  put_error(text, "worst, any load", pose.worst.displacement, pose.worst.rotation.front());
  put(text, "{:<18}{:>16}  largest distance\n", "", number(pose.worst.distance));
}

// ---- Space

void put_space_reactions(std::string& text, const core::Pose& pose) {
  const std::string& force = pose.units.force.name;
  put(text, "\n{:<12}{:>16}{:>16}{:>16}{:>16}{:>16}{:>16}  actuator\n", "joint", head("fx", force), head("fy", force),
      head("fz", force), "mx [N m]", "my [N m]", "mz [N m]");
  for (const core::JointReaction& reaction : pose.reactions) {
    put(text, "{:<12}", reaction.joint);
    for (const Quantity q : {Quantity::fx, Quantity::fy, Quantity::fz, Quantity::mx, Quantity::my, Quantity::mz})
      put(text, "{:>16}", entry(reaction, q));
    for (const Quantity q : {Quantity::F, Quantity::M})
      if (const core::ReactionComponent* const own = component(reaction, q))
        put(text, "  {} {} {}", core::to_string(q), number(own->value), unit_of(q, pose.units));
    put(text, "\n");
  }
}

void put_space_error(std::string& text, const char* what, const std::vector<double>& displacement,
                     const std::vector<double>& rotation) {
  put(text, "{:<18}", what);
  for (const std::vector<double>* const part : {&displacement, &rotation})
    for (const double value : *part) put(text, "{:>16}", number(value));
  put(text, "\n");
}

void put_space_accuracy(std::string& text, const core::Pose& pose) {
  if (pose.take_up.empty()) return;
  const std::string &length = pose.units.length.name, &angle = pose.units.angle.name;
  put(text, "\n{:<12}{:>18}{:>18}{:>18}  actuator\n", "take-up", head("dx", length), head("dy", length),
      head("dz", length));
  for (const core::JointTakeUp& own : pose.take_up) {
    put(text, "{:<12}", own.joint);
    for (std::size_t c = 0; c < 3; ++c)
      put(text, "{:>18}", own.displacement.empty() ? std::string() : played(own.displacement[c]));
    const auto add = [&](const char* name, const std::optional<double>& value, const std::string& unit) {
      if (value) put(text, "  {} {}{}", name, played(value), std::isnan(*value) ? "" : " " + unit);
    };
    add("axial", own.axial, length);
    add("dtheta", own.rotation, angle);
    put(text, "\n");
  }
  put(text, "\n{:<18}{:>16}{:>16}{:>16}{:>16}{:>16}{:>16}\n", "pose error", head("dx", length), head("dy", length),
      head("dz", length), head("dalpha_x", angle), head("dalpha_y", angle), head("dalpha_z", angle));
  put_base(text, pose);
  if (pose.error)
    put_space_error(text, "linear", pose.error->displacement, pose.error->rotation);
  else
    put(text, "undefined: {}\n", undefined_words(pose));
  if (pose.actual) {
    put_space_error(text, "iterated", pose.actual->error.displacement, pose.actual->error.rotation);
    put_space_error(text, "  difference", pose.actual->beyond_linear.displacement, pose.actual->beyond_linear.rotation);
    put(text, "  {} iterations, closure within {:.2g}\n", pose.actual->iterations, pose.actual->residual);
  }
  put_space_error(text, "worst, any load", pose.worst.displacement, pose.worst.rotation);
  put(text, "{:<18}{:>16} {} largest distance, {} {} largest rotation\n", "", number(pose.worst.distance), length,
      number(pose.worst.angle), angle);
}

/// Components that are rounding beside the largest reaction are shown as 0; mechanisms are some metres large, so that
/// couples and forces compare.
void drop_rounding(core::Pose& pose) {
  constexpr double rounding = 1e-13;
  double largest = 0;
  for (const core::JointReaction& reaction : pose.reactions)
    for (const core::ReactionComponent& part : reaction.components)
      if (std::isfinite(part.value)) largest = std::max(largest, std::abs(part.value));
  for (core::JointReaction& reaction : pose.reactions)
    for (core::ReactionComponent& part : reaction.components)
      if (std::abs(part.value) <= rounding * largest) part.value = 0;
}

}  // namespace

std::string pose_text(const core::Pose& in_si) {
  core::Pose pose = in_file_units(in_si);
  drop_rounding(pose);
  const bool space = pose.worst.displacement.size() == 3;
  const double length = pose.units.declared ? 1 / pose.units.length.size : 1;
  constexpr double degrees = 180 / std::numbers::pi;
  std::vector<std::string> values;
  for (std::size_t c = 0; c < pose.at.size(); ++c) {
    const bool angle = c < pose.angles.size() && pose.angles[c];
    values.push_back(number(pose.at[c] * (angle ? degrees : length)) + (angle ? " deg" : ""));
  }
  std::string text;
  put_head(text, pose, fmt::format("{}", fmt::join(values, ", ")));
  space ? put_space_reactions(text, pose) : put_reactions(text, pose);
  put(text, "\n|A| = {}, condition number {}\n", number(pose.determinant), number(pose.condition));
  space ? put_space_accuracy(text, pose) : put_accuracy(text, pose);
  for (const std::string& note : pose.notes) put(text, "{}\n", note);
  return text;
}

}  // namespace clearloci::report
