// The tables of a pose: those of the plane and of space differ in their columns.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report/pose.hpp"

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
  return std::isfinite(value) ? fmt::format("{:.9g}", value + 0.0) : "unbounded";  // no -0
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
  for (std::size_t c = 0; c < pose.worst.displacement.size(); ++c) put(text, "{:>18}", fmt::format("{} [m]", axes[c]));
  put(text, "\n");
  for (const core::PosePoint& point : pose.points) {
    put(text, "{:<12}", point.name);
    for (const double value : point.at) put(text, "{:>18}", number(value));
    put(text, "\n");
  }
}

// ---- Plane

/// "N 12.5 N, T 0 N m, F 3 N".
void put_prismatic(std::string& text, const core::JointReaction& reaction) {
  std::vector<std::string> parts;
  for (const core::ReactionComponent& c : reaction.components)
    parts.push_back(fmt::format("{} {} {}", core::to_string(c.quantity), number(c.value), core::unit_of(c.quantity)));
  put(text, "{:<12}      {}\n", reaction.joint, fmt::join(parts, ", "));
}

void put_reactions(std::string& text, const core::Pose& pose) {
  put(text, "\n{:<12}{:>18}{:>18}{:>18}{:>18}\n", "joint", "fx [N]", "fy [N]", "|f| [N]", "M [N m]");
  for (const core::JointReaction& reaction : pose.reactions) {
    const core::ReactionComponent *const fx = component(reaction, Quantity::fx), *const fy =
                                                                                     component(reaction, Quantity::fy);
    if (fx == nullptr || fy == nullptr) {
      put_prismatic(text, reaction);
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

void put_take_up(std::string& text, const core::JointTakeUp& own) {
  if (!own.displacement.empty()) {
    put(text, "{:<12}{:>18}{:>18}{:>18}{:>18}\n", own.joint, played(own.displacement[0]), played(own.displacement[1]),
        played(own.beta), played(own.rotation));
    return;
  }
  std::vector<std::string> parts;
  const auto add = [&](const char* name, const std::optional<double>& value, const char* unit) {
    if (value) parts.push_back(fmt::format("{} {} {}", name, played(value), unit));
  };
  add("normal", own.normal, "m");
  add("tilt", own.tilt, "rad");
  add("axial", own.axial, "m");
  put(text, "{:<12}      {}\n", own.joint, fmt::join(parts, ", "));
}

void put_accuracy(std::string& text, const core::Pose& pose) {
  if (pose.take_up.empty()) return;
  put(text, "\n{:<12}{:>18}{:>18}{:>18}{:>18}\n", "take-up", "dx [m]", "dy [m]", "beta [rad]", "dtheta [rad]");
  for (const core::JointTakeUp& own : pose.take_up) put_take_up(text, own);
  put(text, "\n{:<18}{:>16}{:>18}{:>18}\n", "pose error", "dx [m]", "dy [m]", "dalpha [rad]");
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
  put(text, "\n{:<12}{:>16}{:>16}{:>16}{:>16}{:>16}{:>16}  actuator\n", "joint", "fx [N]", "fy [N]", "fz [N]",
      "mx [N m]", "my [N m]", "mz [N m]");
  for (const core::JointReaction& reaction : pose.reactions) {
    put(text, "{:<12}", reaction.joint);
    for (const Quantity q : {Quantity::fx, Quantity::fy, Quantity::fz, Quantity::mx, Quantity::my, Quantity::mz})
      put(text, "{:>16}", entry(reaction, q));
    for (const Quantity q : {Quantity::F, Quantity::M})
      if (const core::ReactionComponent* const own = component(reaction, q))
        put(text, "  {} {} {}", core::to_string(q), number(own->value), core::unit_of(q));
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
  put(text, "\n{:<12}{:>18}{:>18}{:>18}  actuator\n", "take-up", "dx [m]", "dy [m]", "dz [m]");
  for (const core::JointTakeUp& own : pose.take_up) {
    put(text, "{:<12}", own.joint);
    for (std::size_t c = 0; c < 3; ++c)
      put(text, "{:>18}", own.displacement.empty() ? std::string() : played(own.displacement[c]));
    const auto add = [&](const char* name, const std::optional<double>& value, const char* unit) {
      if (value) put(text, "  {} {}{}", name, played(value), std::isnan(*value) ? "" : unit);
    };
    add("axial", own.axial, " m");
    add("dtheta", own.rotation, " rad");
    put(text, "\n");
  }
  put(text, "\n{:<18}{:>16}{:>16}{:>16}{:>16}{:>16}{:>16}\n", "pose error", "dx [m]", "dy [m]", "dz [m]",
      "dalpha_x [rad]", "dalpha_y [rad]", "dalpha_z [rad]");
  if (pose.error)
    put_space_error(text, "linear", pose.error->displacement, pose.error->rotation);
  else
    put(text, "undefined: {}\n", undefined_words(pose));
  put_space_error(text, "worst, any load", pose.worst.displacement, pose.worst.rotation);
  put(text, "{:<18}{:>16} m largest distance, {} rad largest rotation\n", "", number(pose.worst.distance),
      number(pose.worst.angle));
}

}  // namespace

std::string pose_text(const core::Pose& pose) {
  const bool space = pose.worst.displacement.size() == 3;
  std::vector<std::string> values;
  for (const double value : pose.at) values.push_back(space ? fmt::format("{}", value) : number(value));
  std::string text;
  put_head(text, pose, fmt::format("{}", fmt::join(values, ", ")));
  space ? put_space_reactions(text, pose) : put_reactions(text, pose);
  put(text, "\n|A| = {}, condition number {}\n", number(pose.determinant), number(pose.condition));
  space ? put_space_accuracy(text, pose) : put_accuracy(text, pose);
  return text;
}

}  // namespace clearloci::report
