#include "mechanism/other_words.hpp"

#include <algorithm>
#include <map>
#include <string_view>

namespace clearloci::mechanism {
namespace {

struct OtherWords {
  std::vector<std::string_view> words;  ///< in lower case, without _, - and a plural's s
  std::string_view key;                 ///< that exists for it where it is among the known ones; empty: anywhere
  std::string_view instead;
};

const std::vector<OtherWords>& table() {
  static const std::vector<OtherWords> all = {
      {{"pin", "hinge", "pivot", "rotary", "rotational", "rotation", "turning", "bearing", "r"},
       "revolute",
       "write revolute: [from, to]"},
      {{"slider", "slide", "sliding", "translational", "translation", "linear", "telescope", "cylinder", "piston", "p"},
       "prismatic",
       "write prismatic: [from, to], with its axis"},
      {{"ball", "balljoint", "socket", "ballandsocket", "s"}, "spherical", "write spherical: [from, to]"},
      {{"cardan", "hooke", "gimbal", "cross", "u"}, "universal", "write universal: [from, to], with its axes"},
      {{"ball", "balljoint", "spherical", "universal", "cardan", "cylindrical"},
       "revolute",
       "in the plane write revolute: [from, to], or write space: spatial"},
      {{"fixed", "fix", "weld", "welded", "rigid", "clamp", "clamped", "bolted", "lock"},
       "",
       "list the points of both parts in one link"},
      {{"gears", "rack", "pinion", "cogwheel", "spur"},
       "gear",
       "write gear: [wheel, wheel] with centres and teeth, or gear: [wheel, rack] with centre, radius and along"},
      {{"gear", "belt", "chain", "pulley", "sprocket", "rack", "pinion", "gearbox", "transmission", "ratio",
        "differential"},
       "",
       "no joint goes through gears, a belt or a chain here: actuate the joint that they turn, with their play as its "
       "angular clearance; in the plane write a gear or a belt"},
      {{"pininslot", "follower", "roller", "track", "groove"},
       "slot",
       "a pin in a straight slot is slot: [carrier, follower], with the axis of the slot"},
      {{"cam", "slot", "pininslot", "follower", "roller", "track", "groove"},
       "",
       "a pin in a straight slot is a small link of its own: revolute at the pin, prismatic along the slot"},
      {{"screw", "helical", "ballscrew", "leadscrew", "spindle"},
       "",
       "write the prismatic joint that the screw moves, actuated: its axial force is the couple of the screw over its "
       "lead"},
      {{"rope", "tendon", "wire", "string", "muscle"},
       "",
       "write cable: [from, to], with its two ends at and its tension: [least, most]"},
      {{"damper", "damping", "viscosity", "dashpot"},
       "",
       "dampers are not modelled: reactions are those of equilibrium"},
      {{"friction", "mu", "stiction"}, "", "friction is not modelled; reactions are those of frictionless joints"},
      {{"elasticity", "young", "material", "stiffnes", "flexure", "compliance"},
       "",
       "links are rigid; a compliant joint is a revolute joint with a torsion spring: springs: [{joint: J, stiffness: "
       "c}]"},
      {{"motor", "actuator", "drive", "driven", "driver", "input", "servo"}, "actuated", "write actuated: true"},
      {{"motor", "actuator", "drive", "driven", "driver", "input", "servo"},
       "joints",
       "write actuated: true at the joint that it drives"},
      {{"effort", "torque", "couple"}, "actuated", "a motor of known effort is actuated: {effort: ...}"},
      {{"torque", "moment", "m", "t"}, "couple", "write couple: ..."},
      {{"couple", "torque", "moment"}, "effort", "write effort: ..."},
      {{"weight", "m"}, "mass", "write mass: ...; gravity: [0, -9.81] at the end of the file gives it its weight"},
      {{"length", "width", "size"},
       "com",
       "a link has the lengths between its points: those of a dyad are its lengths: [a, b]"},
      {{"backlash", "play", "slack"}, "angular", "write angular: ... of a revolute joint, the play to either side"},
      {{"backlash", "play", "slack"}, "axial", "write axial: ... of a prismatic joint, the play to either side"},
      {{"play", "gap", "slack"}, "radial", "write radial: ..., the difference of the radii of hub and pin"},
      {{"position", "pos", "place", "location", "point", "coordinate"}, "at", "write at: and a point"},
      {{"direction", "along", "dir"}, "axis", "write axis: and a vector"},
      {{"body", "part", "bar", "rod", "member", "element"}, "links", "write links:"},
      {{"body", "part", "bar"}, "link", "write link:"},
      {{"node", "vertice", "position"}, "points", "write points:"},
      {{"force", "external", "wrench"}, "loads", "write loads: [{link: ..., at: ..., force: [fx, fy]}]"},
      {{"range", "bound", "box", "coordinate", "variable", "dof"},
       "workspace",
       "write workspace: {x: [from, to], ...}"},
      {{"variable", "constant", "dimension"}, "parameters", "write parameters:"},
      {{"stop", "stroke"}, "limits", "write limits: [{distance: [A, B], within: [least, greatest]}]"},
      {{"tool", "endeffector", "tcp", "platform", "output"},
       "end_effector",
       "write end_effector: {link: ..., at: ...}"},
      {{"k", "c", "rate"}, "stiffness", "write stiffness: ..."},
      {{"l0", "restlength", "naturallength", "length"}, "free_length", "write free_length: ..."},
  };
  return all;
}

/// "Ball_Joints" as "balljoint".
std::string plain(const std::string& key) {
  std::string text;
  for (const char c : key)
    if (c != '_' && c != '-' && c != ' ') text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (text.size() > 3 && text.back() == 's') text.pop_back();
  return text;
}

}  // namespace

std::optional<std::string> what_to_write_for(const std::string& key, const std::vector<std::string>& names) {
  const std::string word = plain(key);
  for (const OtherWords& row : table()) {
    if (std::find(row.words.begin(), row.words.end(), word) == row.words.end()) continue;
    if (row.key.empty() || std::find(names.begin(), names.end(), row.key) != names.end())
      return std::string(row.instead);
  }
  return std::nullopt;
}

std::optional<std::string> example_of(const std::string& key) {
  static const std::map<std::string_view, std::string_view> all = {
      {"units", "{length: mm}"},
      {"parameters", "{a: 300, b: 220}"},
      {"workspace", "{x: [-100, 100], y: [50, 200]}"},
      {"points", "{O: [0, 0], A: {dyad: [O, B], lengths: [300, 400], side: left}}"},
      {"links", "{crank: {points: [O, A]}}"},
      {"joints", "{O: {revolute: [ground, crank], at: O, actuated: true}}"},
      {"end_effector", "{link: rod, at: P}"},
      {"loads", "[{link: rod, at: P, force: [0, -10]}]"},
      {"springs", "[{between: [A, B], stiffness: 2, free_length: 50}]"},
      {"limits", "[{distance: [A, B], within: [200, 500]}]"},
      {"gravity", "[0, -9.81]"},
  };
  const auto row = all.find(key);
  return row == all.end() ? std::nullopt : std::optional<std::string>(row->second);
}

}  // namespace clearloci::mechanism
