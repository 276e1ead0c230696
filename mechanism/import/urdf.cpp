// URDF (wiki.ros.org/urdf/XML): a tree of links, their poses in the posture of all joints at 0. Loops come from a
// second file, as github.com/Gepetto/example-parallel-robots has them: `closed_loop:` pairs of frames, `type:` 3d (a
// ball) or 6d (a weld) for each, `name_mot:` words in the names of joints with motors, `joint_name:` and `joint_type:`
// joints that are balls.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/errors.hpp"
#include "mechanism/import/common.hpp"
#include "mechanism/import/formats.hpp"
#include "mechanism/import/xml.hpp"
#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism::imports {
namespace {

using core::InputError;

struct Branch {
  std::string name, type, parent, child;
  int line = 0;
  Pose origin;
  Vec axis{1, 0, 0};
  std::optional<std::array<double, 2>> limits;
  bool motor = false;
  std::string leader = {};  ///< of a joint that follows: value = multiplier value of the leader + offset
  double multiplier = 1, offset = 0;
};

class Reader {
 public:
  explicit Reader(const SourceText& given) : given_(given), root_(parse_xml(given.text, given.file)) {}

  Source read() {
    if (root_.name != "robot")
      throw InputError({given_.file, root_.line}, "the file has no <robot>", "name a URDF file");
    root_.read = true;
    s_.name = root_.get("name", "");
    refuse_macros(root_);
    for (const XmlElement* element : root_.all("link")) link(*element);
    for (const XmlElement* element : root_.all("joint")) joint(*element);
    if (s_.links.empty()) throw InputError({given_.file, root_.line}, "the robot has no links", "name a URDF file");
    for (const XmlElement* element : root_.all("transmission")) transmission(*element);
    place_links();
    add_joints();
    for (const XmlElement* extension : root_.all("gazebo"))
      for (const XmlElement* element : extension->all("joint")) sdf_joint(*element);
    if (!given_.side.empty()) loops();
    tools();
    constexpr double g = 9.81;
    s_.gravity = Vec{0, 0, -g};
    s_.note("a URDF has no gravity: 9.81 m/s^2 along -z was taken");
    if (const auto left = unread(root_); !left.empty()) s_.note("left out: " + all_of(left));
    return std::move(s_);
  }

 private:
  static std::string all_of(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
  }

  void refuse_macros(const XmlElement& at) const {
    for (const XmlElement& child : at.children) {
      if (child.name.starts_with("xacro:"))
        throw InputError({given_.file, child.line}, "<" + child.name + "> is a macro of xacro",
                         "write the URDF that it makes: xacro FILE > robot.urdf");
      refuse_macros(child);
    }
  }

  Vec vector(const XmlElement& at, const char* attribute, const Vec& otherwise) const {
    const auto text = at.get(attribute);
    if (!text) return otherwise;
    const auto v = numbers_of(*text, at, std::string(attribute) + " of <" + at.name + ">", given_.file, 3, 3);
    return {v[0], v[1], v[2]};
  }
  double number(const XmlElement& at, const char* attribute, double otherwise) const {
    const auto text = at.get(attribute);
    return text ? numbers_of(*text, at, std::string(attribute) + " of <" + at.name + ">", given_.file, 1, 1).front()
                : otherwise;
  }
  Pose origin_of(const XmlElement& at) const {
    const XmlElement* origin = at.first("origin");
    if (origin == nullptr) return {};
    const Vec rpy = vector(*origin, "rpy", {});
    return {roll_pitch_yaw(rpy[0], rpy[1], rpy[2]), vector(*origin, "xyz", {})};
  }
  std::string name_of(const XmlElement& at) const {
    const auto name = at.get("name");
    if (!name || name->empty()) throw InputError({given_.file, at.line}, "a <" + at.name + "> has no name", "name it");
    return *name;
  }

  void link(const XmlElement& at) {
    SourceLink link;
    link.name = name_of(at);
    link.line = at.line;
    if (const XmlElement* inertial = at.first("inertial")) {
      const Pose origin = origin_of(*inertial);
      if (const XmlElement* mass = inertial->first("mass")) link.mass = number(*mass, "value", 0);
      if (link.mass < 0)
        throw InputError({given_.file, inertial->line}, "the mass of link " + link.name + " is negative",
                         "write 0 or more");
      link.centre = origin.at;
      if (const XmlElement* i = inertial->first("inertia"))
        link.inertia = turned(origin.turned, {number(*i, "ixx", 0), number(*i, "iyy", 0), number(*i, "izz", 0),
                                              number(*i, "ixy", 0), number(*i, "ixz", 0), number(*i, "iyz", 0)});
    }
    if (!index_.emplace(link.name, static_cast<int>(s_.links.size())).second)
      throw InputError({given_.file, at.line}, "two links are called " + link.name, "rename one of them");
    s_.links.push_back(std::move(link));
  }

  void joint(const XmlElement& at) {
    Branch branch;
    branch.name = name_of(at);
    branch.line = at.line;
    branch.type = at.get("type", "");
    static const std::vector<std::string> types = {"revolute", "continuous", "prismatic", "fixed"};
    if (std::find(types.begin(), types.end(), branch.type) == types.end())
      throw InputError({given_.file, at.line}, "joint " + branch.name + " is of type '" + branch.type + "'",
                       "use revolute, continuous, prismatic or fixed");
    if (const XmlElement* mimic = at.first("mimic"); mimic != nullptr && branch.type != "fixed") {
      branch.leader = mimic->get("joint", "");
      branch.multiplier = number(*mimic, "multiplier", 1);
      branch.offset = number(*mimic, "offset", 0);
    }
    const XmlElement *parent = at.first("parent"), *child = at.first("child");
    if (parent == nullptr || child == nullptr)
      throw InputError({given_.file, at.line}, "joint " + branch.name + " has no parent or no child",
                       "name both links");
    branch.parent = parent->get("link", "");
    branch.child = child->get("link", "");
    for (const std::string& name : {branch.parent, branch.child})
      if (!index_.contains(name))
        throw InputError({given_.file, at.line},
                         "joint " + branch.name + " names link '" + name + "', which is not there",
                         "add the link, or correct the name");
    branch.origin = origin_of(at);
    if (const XmlElement* axis = at.first("axis")) branch.axis = vector(*axis, "xyz", {1, 0, 0});
    if (branch.type != "fixed" && !(norm(branch.axis) > 1e-9))
      throw InputError({given_.file, at.line}, "the axis of joint " + branch.name + " has no direction",
                       "write such as xyz=\"0 0 1\"");
    if (const XmlElement* limit = at.first("limit"); limit != nullptr && branch.type != "continuous") {
      const double lower = number(*limit, "lower", 0), upper = number(*limit, "upper", 0);
      if (lower < upper) branch.limits = std::array<double, 2>{lower, upper};
    }
    branches_.push_back(std::move(branch));
  }

  void transmission(const XmlElement& at) {
    for (const XmlElement* joint : at.all("joint")) {
      const std::string name = joint->get("name", "");
      const auto found =
          std::find_if(branches_.begin(), branches_.end(), [&](const Branch& branch) { return branch.name == name; });
      if (found == branches_.end())
        throw InputError({given_.file, joint->line}, "a transmission drives joint '" + name + "', which is not there",
                         "correct the name");
      found->motor = true;
    }
  }

  static bool turns(const Branch& branch) { return branch.type == "revolute" || branch.type == "continuous"; }

  std::size_t branch_named(const std::string& name, const Branch& follower) const {
    const auto found =
        std::find_if(branches_.begin(), branches_.end(), [&](const Branch& branch) { return branch.name == name; });
    if (found == branches_.end() || found->type == "fixed")
      throw InputError({given_.file, follower.line},
                       "joint " + follower.name + " follows joint '" + name + "' (mimic), which is no joint that moves",
                       "correct the name");
    return static_cast<std::size_t>(found - branches_.begin());
  }

  /// In the posture: 0 but for what follows with an offset.
  double value_of(const Branch& branch, std::size_t depth = 0) const {
    if (branch.leader.empty()) return 0;
    if (depth > branches_.size())
      throw InputError({given_.file, branch.line}, "joint " + branch.name + " follows itself (mimic)",
                       "name another joint");
    return branch.multiplier * value_of(branches_[branch_named(branch.leader, branch)], depth + 1) + branch.offset;
  }

  void place_links() {
    std::vector<bool> is_child(s_.links.size());
    for (const Branch& branch : branches_) {
      const auto child = static_cast<std::size_t>(index_.at(branch.child));
      if (is_child[child])
        throw InputError({given_.file, branch.line}, "link " + branch.child + " is the child of two joints",
                         "close loops by a file of loops (closed_loop:), not by the tree");
      is_child[child] = true;
    }
    std::vector<std::string> roots;
    for (std::size_t l = 0; l < s_.links.size(); ++l)
      if (!is_child[l]) roots.push_back(s_.links[l].name);
    if (roots.size() != 1)
      throw InputError({given_.file, root_.line},
                       roots.empty() ? "every link is the child of a joint: there is no base"
                                     : "links " + enumerated(roots) + " have no parent",
                       "write a tree with one base link");
    base_ = index_.at(roots.front());
    s_.note("link " + roots.front() + " is the base and stands still");
    poses_.resize(s_.links.size());
    std::vector<bool> placed(s_.links.size());
    placed[static_cast<std::size_t>(base_)] = true;
    for (bool more = true; more;) {
      more = false;
      for (const Branch& branch : branches_) {
        const auto parent = static_cast<std::size_t>(index_.at(branch.parent)),
                   child = static_cast<std::size_t>(index_.at(branch.child));
        if (!placed[parent] || placed[child]) continue;
        poses_[child] = poses_[parent] * branch.origin;
        if (const double value = value_of(branch); value != 0 && turns(branch))
          poses_[child] = poses_[child] * Pose{turn(unit(branch.axis), value), {}};
        placed[child] = more = true;
      }
    }
    for (std::size_t l = 0; l < placed.size(); ++l)
      if (!placed[l])
        throw InputError({given_.file, s_.links[l].line}, "link " + s_.links[l].name + " hangs in a circle of joints",
                         "write a tree with one base link");
    for (std::size_t l = 0; l < s_.links.size(); ++l) {
      SourceLink& link = s_.links[l];
      if (link.centre) link.centre = poses_[l] * *link.centre;
      if (link.inertia) link.inertia = turned(poses_[l].turned, *link.inertia);
    }
  }

  int source_link(const std::string& name) const {
    const int index = index_.at(name);
    return index == base_ ? ground_link : index;
  }

  void add_joints() {
    static const std::map<std::string, SourceKind> kinds = {{"revolute", SourceKind::revolute},
                                                            {"continuous", SourceKind::revolute},
                                                            {"prismatic", SourceKind::prismatic},
                                                            {"fixed", SourceKind::fixed}};
    for (const Branch& branch : branches_) {
      const Pose& pose = poses_[static_cast<std::size_t>(index_.at(branch.child))];
      SourceJoint& joint = add_joint(s_, branch.name, branch.line, kinds.at(branch.type), source_link(branch.parent),
                                     source_link(branch.child), pose.at, pose.turned * branch.axis);
      joint.range = branch.limits;
      if (const double value = value_of(branch); joint.range && value != 0)
        joint.range = std::array<double, 2>{(*joint.range)[0] - value, (*joint.range)[1] - value};
      joint.actuated = branch.motor && joint.kind != SourceKind::fixed;
    }
    for (std::size_t j = 0; j < branches_.size(); ++j)
      if (const Branch& branch = branches_[j]; !branch.leader.empty()) {
        if (branch.multiplier == 0)
          throw InputError({given_.file, branch.line}, "joint " + branch.name + " follows another one by 0 (mimic)",
                           "fix the joint");
        s_.followers.push_back({j, branch_named(branch.leader, branch), branch.multiplier, branch.line});
      }
    s_.links[static_cast<std::size_t>(base_)].dropped = true;
  }

  // --- loops

  /// What stands in an element of a joint of SDF: a link.
  int link_in(const XmlElement& at, const char* side) const {
    const XmlElement* element = at.first(side);
    const std::string name(element == nullptr ? std::string_view() : trimmed(element->text));
    if (!index_.contains(name))
      throw InputError({given_.file, at.line},
                       "a joint in <gazebo> names link '" + name + "' as its " + side + ", which is not there",
                       "correct the name");
    return index_.at(name);
  }

  /// <gazebo> may hold a joint in the words of SDF, which closes a loop: its pose is that in the child.
  void sdf_joint(const XmlElement& at) {
    static const std::map<std::string, SourceKind> kinds = {{"revolute", SourceKind::revolute},
                                                            {"continuous", SourceKind::revolute},
                                                            {"prismatic", SourceKind::prismatic},
                                                            {"ball", SourceKind::spherical},
                                                            {"fixed", SourceKind::fixed}};
    SourceJoint joint;
    joint.name = name_of(at);
    joint.line = at.line;
    const auto kind = kinds.find(at.get("type", ""));
    if (kind == kinds.end())
      throw InputError({given_.file, at.line}, "joint " + joint.name + " is of type '" + at.get("type", "") + "'",
                       "use revolute, continuous, prismatic, ball or fixed");
    joint.kind = kind->second;
    const int parent = link_in(at, "parent"), child = link_in(at, "child");
    joint.from = parent == base_ ? ground_link : parent;
    joint.to = child == base_ ? ground_link : child;
    const auto six = [&](const XmlElement& element, std::size_t count) {
      return numbers_of(element.text, element, "<" + element.name + ">", given_.file, count, count);
    };
    Pose pose = poses_[static_cast<std::size_t>(child)];
    if (const XmlElement* element = at.first("pose")) {
      const auto v = six(*element, 6);
      pose = pose * Pose{roll_pitch_yaw(v[3], v[4], v[5]), {v[0], v[1], v[2]}};
    }
    Vec axis = {0, 0, 1};
    if (const XmlElement* element = at.first("axis"))
      if (const XmlElement* xyz = element->first("xyz")) {
        const auto v = six(*xyz, 3);
        axis = {v[0], v[1], v[2]};
      }
    if (!(norm(axis) > 1e-9))
      throw InputError({given_.file, at.line}, "the axis of joint " + joint.name + " has no direction",
                       "write such as <xyz>0 0 1</xyz>");
    place(joint, pose.at, pose.turned * axis);
    s_.joints.push_back(std::move(joint));
  }

  struct Frame {
    int link;
    Pose pose;
  };
  Frame frame_named(const std::string& name, const Value& where) const {
    if (const auto link = index_.find(name); link != index_.end())
      return {source_link(name), poses_[static_cast<std::size_t>(link->second)]};
    for (const Branch& branch : branches_)
      if (branch.name == name)
        return {source_link(branch.child), poses_[static_cast<std::size_t>(index_.at(branch.child))]};
    throw InputError(where.where, "closed_loop names frame '" + name + "', which is no link and no joint of the robot",
                     "correct the name");
  }

  void loops() {
    const Value document = parse_document(given_.side, given_.side_file);
    if (!document.is_map()) return;
    std::optional<Value> pairs, types, motors, joints, joint_types;
    std::vector<std::string> other;
    for (const Entry& entry : entries(document)) {
      if (entry.key == "closed_loop")
        pairs = entry.value;
      else if (entry.key == "type")
        types = entry.value;
      else if (entry.key == "name_mot")
        motors = entry.value;
      else if (entry.key == "joint_name")
        joints = entry.value;
      else if (entry.key == "joint_type")
        joint_types = entry.value;
      else
        other.push_back(entry.key);
    }
    if (!pairs && !motors) return;  // another file that lies beside
    if (!other.empty()) s_.note("left out of " + given_.side_file + ": " + enumerated(other));
    if (pairs && !pairs->node.IsNull()) {
      std::vector<Value> list = elements(*pairs);
      if (!list.empty() && list.front().is_scalar()) list = {*pairs};
      std::vector<Value> kinds = types && types->is_sequence() ? elements(*types) : std::vector<Value>{};
      for (std::size_t i = 0; i < list.size(); ++i) {
        const std::vector<Value> pair = elements(list[i], 2);
        const std::string kind = i < kinds.size()              ? text_of(kinds[i])
                                 : types && types->is_scalar() ? text_of(*types)
                                                               : "6d";
        if (kind != "3d" && kind != "3D" && kind != "6d" && kind != "6D")
          throw InputError(list[i].where, "the type of a closed loop is '" + kind + "'", "write 3d or 6d");
        const Frame a = frame_named(text_of(pair[0]), pair[0]), b = frame_named(text_of(pair[1]), pair[1]);
        looped_.insert({text_of(pair[0]), text_of(pair[1])});
        SourceJoint joint;
        joint.name = "loop_" + text_of(pair[0]);
        joint.line = 0;
        joint.kind = kind[0] == '3' ? SourceKind::spherical : SourceKind::fixed;
        joint.from = a.link;
        joint.to = b.link;
        joint.on_from = {a.pose.at, a.pose.turned};
        joint.on_to = {b.pose.at, b.pose.turned};
        s_.joints.push_back(std::move(joint));
      }
    }
    if (joints && joints->is_sequence()) retype(*joints, joint_types);
    if (!motors || motors->node.IsNull()) return;
    std::vector<std::string> words;
    if (motors->is_sequence())
      for (const Value& element : elements(*motors)) words.push_back(text_of(element));
    else
      words.push_back(text_of(*motors));
    for (SourceJoint& joint : s_.joints)
      joint.actuated = joint.actuated || (joint.kind != SourceKind::fixed && joint.kind != SourceKind::spherical &&
                                          std::any_of(words.begin(), words.end(), [&](const std::string& word) {
                                            return !word.empty() && joint.name.find(word) != std::string::npos;
                                          }));
  }

  /// joint_name and joint_type: joints that are balls, which a URDF has not.
  void retype(const Value& joints, const std::optional<Value>& types) {
    const std::vector<Value> names = elements(joints);
    if (names.empty()) return;
    if (!types)
      throw InputError(joints.where, "joint_name has no joint_type beside it",
                       "write a list of types, such as [SPHERICAL]");
    const std::vector<Value> list = elements(*types, static_cast<int>(names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto found = std::find_if(s_.joints.begin(), s_.joints.end(),
                                      [&](const SourceJoint& joint) { return joint.name == text_of(names[i]); });
      if (found == s_.joints.end())
        throw InputError(names[i].where, "joint_name names '" + text_of(names[i]) + "', which is no joint of the robot",
                         "correct the name");
      if (text_of(list[i]) != "SPHERICAL")
        throw InputError(list[i].where, "the type of joint " + found->name + " is '" + text_of(list[i]) + "'",
                         "write SPHERICAL, or the type in the URDF");
      found->kind = SourceKind::spherical;
      found->actuated = false;
      found->range.reset();
    }
  }

  /// Links welded to the end of a branch are frames that people put there: tools.
  void tools() {
    for (const Branch& branch : branches_) {
      const bool leaf = std::none_of(branches_.begin(), branches_.end(),
                                     [&](const Branch& other) { return other.parent == branch.child; });
      if (branch.type == "fixed" && leaf && !looped_.contains(branch.child) && !looped_.contains(branch.name))
        s_.points.push_back({branch.child, source_link(branch.child),
                             poses_[static_cast<std::size_t>(index_.at(branch.child))].at, true});
    }
  }

  const SourceText& given_;
  XmlElement root_;
  Source s_;
  std::map<std::string, int> index_;
  std::set<std::string> looped_;
  std::vector<Branch> branches_;
  std::vector<Pose> poses_;
  int base_ = 0;
};

}  // namespace

bool is_urdf(std::string_view text) { return is_xml_of(text, "robot"); }

Source read_urdf(const SourceText& text) { return Reader(text).read(); }

}  // namespace clearloci::mechanism::imports
