#include "tests/laws/design_parts.hpp"

namespace clearloci::test {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string line_of(const JointText& joint) {
  std::string text =
      "  " + joint.name + ": {" + joint.type + ": [" + joint.from + ", " + joint.to + "], at: " + joint.at;
  if (!joint.axis.empty()) text += ", axis: " + joint.axis;
  if (joint.actuated) text += ", actuated: true";
  if (!joint.effort.empty()) text += ", actuated: {effort: " + joint.effort + "}";
  if (!joint.clearance.empty()) text += ", clearance: {" + joined(joint.clearance) + "}";
  return text + "}\n";
}

std::string list_of(const std::string& key, const std::vector<std::string>& entries) {
  if (entries.empty()) return {};
  std::string text = key + ":\n";
  for (const std::string& entry : entries) text += "  - " + entry + "\n";
  return text;
}

}  // namespace

std::string text_of(const core::Rational& value) { return core::to_string(value); }
std::string text_of(const Place& place) { return "[" + text_of(place.x) + ", " + text_of(place.y) + "]"; }

std::string micrometres(int value, const core::Rational& unit) {
  core::Rational length(value, 1000000);
  length.canonicalize();
  return text_of(core::Rational(length * unit));
}

std::string text_of(const DesignParts& parts) {
  std::string text = "format: 1\nname: " + parts.name + "\nspace: planar\n";
  if (!parts.units.empty()) text += "units: " + parts.units + "\n";
  if (!parts.parameters.empty()) text += "parameters: {" + parts.parameters + "}\n";
  text += "workspace:\n" + parts.workspace;
  if (!parts.frames.empty()) text += "frames:\n" + parts.frames;
  text += "points:\n";
  for (const PointText& point : parts.points)
    text += "  " + point.name + ": " + (point.fixed ? text_of(*point.fixed) : point.form) + "\n";
  text += "links:\n";
  for (const LinkText& link : parts.links)
    text += "  " + link.name + ": {points: [" + joined(link.points) + "]" + link.more + "}\n";
  text += "joints:\n";
  for (const JointText& joint : parts.joints) text += line_of(joint);
  text += parts.repeat;
  text += "end_effector: {link: " + parts.end_link + ", at: " + parts.end_point +
          (parts.relative_to.empty() ? "" : ", relative_to: " + parts.relative_to) + "}\n";
  text += list_of("loads", parts.loads) + list_of("springs", parts.springs) + list_of("limits", parts.limits);
  if (!parts.gravity.empty()) text += "gravity: " + parts.gravity + "\n";
  return text;
}

}  // namespace clearloci::test
