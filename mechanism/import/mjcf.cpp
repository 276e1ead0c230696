// MJCF (mujoco.readthedocs.io, "XML Reference"): bodies in a tree with their joints, and equalities that close loops.
// Several joints of a body follow each other through parts without mass; two hinges across each other are a universal
// joint, three a ball.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/errors.hpp"
#include "mechanism/import/common.hpp"
#include "mechanism/import/formats.hpp"
#include "mechanism/import/mjcf_settings.hpp"
#include "mechanism/import/xml.hpp"

namespace clearloci::mechanism::imports {
namespace {

/// A joint of the tree, of which the posture may be another than the model's.
struct TreeJoint {
  std::string name, type;
  std::vector<int> joints;  ///< of the source
  double reference = 0;
  double value = 0;  ///< in the posture, from that of the model
};

/// A joint that follows another one of the tree: value = constant + slope value of the leader.
struct TreeFollower {
  std::size_t joint = 0, leader = 0;
  double constant = 0, slope = 1;
  int line = 0;
};

struct Body {
  std::string name;
  int link = ground_link, parent = -1;
  Pose pose;
};

class Reader : private MjcfSettings {
 public:
  explicit Reader(const SourceText& given) : MjcfSettings(given.file), root_(parse_xml(given.text, given.file)) {}

  Source read() {
    root_.read = true;
    s_.name = root_.get("model", "");
    if (const XmlElement* include = find(root_, "include"))
      refuse(*include, "the model includes another file", "put it in its place");
    for (const XmlElement* element : root_.all("compiler")) compiler(*element);
    for (const XmlElement* element : root_.all("option")) option(*element);
    s_.gravity = gravity_;
    for (const XmlElement* element : root_.all("default")) defaults(*element, "main", {});
    bodies_.push_back({"world", ground_link, -1, {}});
    for (const XmlElement* element : root_.all("worldbody")) contents(*element, 0, {}, "main", 0);
    if (s_.links.empty()) refuse(root_, "the model has no bodies", "name an MJCF file of a mechanism");
    for (const XmlElement* element : root_.all("equality")) equality(*element);
    for (const XmlElement* element : root_.all("actuator")) actuators(*element);
    for (const auto& [name, site] : sites_)
      if (!used_sites_.contains(name) && bodies_[static_cast<std::size_t>(site.first)].link != ground_link)
        s_.points.push_back({name, bodies_[static_cast<std::size_t>(site.first)].link, site.second.at, true});
    for (const XmlElement* element : root_.all("keyframe")) keyframe(*element);
    for (const TreeFollower& follower : followers_) follow(follower);
    count_ranges();
    if (const auto left = unread(root_); !left.empty()) {
      std::string text;
      for (const std::string& word : left) text += (text.empty() ? "" : ", ") + word;
      s_.note("left out: " + text);
    }
    if (!without_mass_.empty())
      s_.note("no mass is known of " + enumerated(without_mass_) + ", whose shapes are meshes or have none");
    return std::move(s_);
  }

 private:
  static const XmlElement* find(const XmlElement& at, const std::string& name) {
    for (const XmlElement& child : at.children) {
      if (child.name == name) return &child;
      if (const XmlElement* below = find(child, name)) return below;
    }
    return nullptr;
  }

  // --- bodies

  /// The joints and shapes of a body, within frames too.
  struct Parts {
    std::vector<std::pair<const XmlElement*, std::pair<Pose, std::string>>> joints, shapes;
    const XmlElement* inertial = nullptr;
    Pose inertial_frame;
  };

  void contents(const XmlElement& at, int body, const Pose& pose, const std::string& childclass, int depth) {
    for (const char* unknown : {"composite", "flexcomp", "replicate", "attach", "include"})
      if (const XmlElement* element = at.first(unknown))
        refuse(*element, "<" + element->name + "> makes bodies that are not written", "write the bodies themselves");
    if (const XmlElement* element = at.first("freejoint"))
      refuse(*element, "body " + bodies_[static_cast<std::size_t>(body)].name + " is free (freejoint)",
             "fix its base: take the free joint out");
    for (const XmlElement* element : at.all("site")) {
      const std::string name = element->get("name", "");
      if (!name.empty()) sites_[name] = {body, pose * pose_of(*element, childclass)};
    }
    for (const XmlElement* element : at.all("frame"))
      contents(*element, body, pose * pose_of(*element, childclass), element->get("childclass", childclass), depth + 1);
    for (const XmlElement* element : at.all("body"))
      body_of(*element, body, pose * pose_of(*element, childclass), element->get("childclass", childclass), depth + 1);
  }

  void body_of(const XmlElement& at, int parent, const Pose& pose, const std::string& childclass, int depth) {
    Body body;
    body.name = at.get("name", "body" + std::to_string(bodies_.size()));
    body.parent = parent;
    body.pose = pose;
    if (at.get("mocap", "false") == "true")
      s_.note("body " + body.name + " is moved from outside (mocap); it stands still here");
    s_.links.push_back({body.name, at.line, 0, {}, {}, false, false});
    body.link = static_cast<int>(s_.links.size()) - 1;
    const int index = static_cast<int>(bodies_.size());
    bodies_.push_back(body);
    // Joints and masses of this body come before those of its children.
    Parts parts;
    gather(at, pose, childclass, parts, depth);
    join(at, body, parts);
    weigh(at, body, parts);
    contents(at, index, pose, childclass, depth);
  }

  void gather(const XmlElement& at, const Pose& pose, const std::string& childclass, Parts& parts, int depth) {
    for (const XmlElement* element : at.all("joint")) parts.joints.push_back({element, {pose, childclass}});
    for (const XmlElement* element : at.all("geom")) parts.shapes.push_back({element, {pose, childclass}});
    if (const XmlElement* element = at.first("inertial")) {
      parts.inertial = element;
      parts.inertial_frame = pose;
    }
    for (const XmlElement* element : at.all("frame"))
      gather(*element, pose * pose_of(*element, childclass), element->get("childclass", childclass), parts, depth + 1);
  }

  struct Single {
    std::string name, type;
    int line = 0;
    Vec at{}, axis{};
    std::optional<std::array<double, 2>> range;
    double reference = 0;
  };

  Single single(const XmlElement& at, const Pose& pose, const std::string& childclass) const {
    Single single;
    single.type = value(at, "type", childclass).value_or("hinge");
    single.name = at.get("name", "");
    single.line = at.line;
    single.at = pose * vector(at, "pos", {}, childclass);
    const Vec axis = vector(at, "axis", {0, 0, 1}, childclass);
    if (!(norm(axis) > 1e-9)) refuse(at, "the axis of a joint has no direction", "write such as axis=\"0 0 1\"");
    single.axis = pose.turned * unit(axis);
    const std::string called = single.name.empty() ? "a joint without a name" : "joint " + single.name;
    if (single.type == "free") refuse(at, called + " leaves its body free", "fix its base: take the free joint out");
    if (single.type != "hinge" && single.type != "slide" && single.type != "ball")
      refuse(at, called + " is of type '" + single.type + "'", "use hinge, slide or ball");
    const bool turns = single.type == "hinge";
    if (const auto text = value(at, "ref", childclass))
      single.reference = numbers(at, "ref", *text, 1, 1).front() * (turns ? angle(1) : 1);
    const std::string limited = value(at, "limited", childclass).value_or("auto");
    if (const auto text = value(at, "range", childclass); text && single.type != "ball") {
      const auto v = numbers(at, "range", *text, 2, 2);
      const double unit = turns ? angle(1) : 1;
      if (v[0] < v[1] && (limited == "true" || (limited == "auto" && limits_by_range_)))
        single.range = std::array<double, 2>{unit * v[0] - single.reference, unit * v[1] - single.reference};
    }
    return single;
  }

  int add(SourceKind kind, const Single& single, int from, int to) {
    add_joint(s_, single.name, single.line, kind, from, to, single.at, single.axis).range = single.range;
    return static_cast<int>(s_.joints.size()) - 1;
  }

  void join(const XmlElement& at, const Body& body, const Parts& parts) {
    const int parent = bodies_[static_cast<std::size_t>(body.parent)].link;
    std::vector<Single> list;
    for (const auto& [element, frame] : parts.joints) {
      list.push_back(single(*element, frame.first, frame.second));
      if (list.back().name.empty())
        list.back().name = body.name + (parts.joints.size() > 1 ? "_" + std::to_string(list.size()) : "");
    }
    if (list.empty()) {
      Single weld;
      weld.name = body.name + "_weld";
      weld.line = at.line;
      weld.at = body.pose.at;
      weld.axis = {0, 0, 1};
      add(SourceKind::fixed, weld, parent, body.link);
      return;
    }
    const auto across = [&](std::size_t i, std::size_t j) {
      return std::abs(dot(list[i].axis, list[j].axis)) < 1e-9 && distance(list[i].at, list[j].at) < 1e-9;
    };
    const bool hinges = std::all_of(list.begin(), list.end(), [](const Single& one) { return one.type == "hinge"; });
    if (hinges && list.size() == 2 && across(0, 1)) {
      const int joint = add(SourceKind::universal, list[0], parent, body.link);
      s_.joints.back().on_to.frame = frame_along(list[1].axis);
      s_.joints.back().range.reset();
      s_.note("hinges " + list[0].name + " and " + list[1].name + " of body " + body.name + " are one universal joint");
      for (const Single& one : list) tree_.push_back({one.name, one.type, {joint}, one.reference});
      return;
    }
    if (hinges && list.size() == 3 && across(0, 1) && across(0, 2) && across(1, 2)) {
      const int joint = add(SourceKind::spherical, list[0], parent, body.link);
      s_.joints.back().range.reset();
      s_.note("the three hinges of body " + body.name + " are one ball");
      for (const Single& one : list) tree_.push_back({one.name, one.type, {joint}, one.reference});
      return;
    }
    int from = parent;
    for (std::size_t i = 0; i < list.size(); ++i) {
      int to = body.link;
      if (i + 1 < list.size()) {
        s_.links.push_back({body.name + "_part" + std::to_string(i + 1), at.line, 0, {}, {}, false, true});
        to = static_cast<int>(s_.links.size()) - 1;
      }
      const SourceKind kind = list[i].type == "hinge"   ? SourceKind::revolute
                              : list[i].type == "slide" ? SourceKind::prismatic
                                                        : SourceKind::spherical;
      tree_.push_back({list[i].name, list[i].type, {add(kind, list[i], from, to)}, list[i].reference});
      // The axes of a ball are those of its body, for a posture that turns it.
      if (kind == SourceKind::spherical)
        s_.joints.back().on_from.frame = s_.joints.back().on_to.frame = body.pose.turned;
      from = to;
    }
  }

  // --- masses

  void weigh(const XmlElement& at, const Body& body, const Parts& parts) {
    SourceLink& link = s_.links[static_cast<std::size_t>(body.link)];
    if (parts.inertial != nullptr && from_shapes_ != "true") {
      const XmlElement& inertial = *parts.inertial;
      const Pose frame =
          parts.inertial_frame * Pose{orientation(inertial, "main"), vector(inertial, "pos", {}, "main")};
      link.mass = numbers(inertial, "mass", inertial.get("mass", "0"), 1, 1).front();
      if (link.mass < 0) refuse(inertial, "the mass of body " + body.name + " is negative", "write 0 or more");
      link.centre = frame.at;
      Tensor tensor;
      if (const auto text = inertial.get("fullinertia")) {
        const auto v = numbers(inertial, "fullinertia", *text, 6, 6);
        tensor = {v[0], v[1], v[2], v[3], v[4], v[5]};
      } else if (const auto diagonal = inertial.get("diaginertia")) {
        const auto v = numbers(inertial, "diaginertia", *diagonal, 3, 3);
        tensor = {v[0], v[1], v[2], 0, 0, 0};
      }
      link.inertia = turned(frame.turned, tensor);
      return;
    }
    if (from_shapes_ == "false") return;
    bool is_named = false;
    for (const auto& [element, frame] : parts.shapes)
      is_named = shape(*element, frame.first, frame.second, link) || is_named;
    if (!is_named) without_mass_.push_back(body.name);
    (void)at;
  }

  // --- loops, motors, posture

  const Body& body_named(const XmlElement& at, const std::string& name) const {
    for (const Body& body : bodies_)
      if (body.name == name) return body;
    refuse(at, "<" + at.name + "> names body '" + name + "', which is not there", "correct the name");
  }

  void equality(const XmlElement& at) {
    int count = 0;
    for (const XmlElement& child : at.children) {
      child.read = true;
      ++count;
      const std::string name = child.get("name", child.name + std::to_string(count));
      if (child.get("active", "true") == "false") {
        s_.note("equality " + name + " is not active and was left out");
        child.take_whole();
        continue;
      }
      if (child.name == "joint") {
        joint_equality(child, name);
        continue;
      }
      if (child.name != "connect" && child.name != "weld")
        refuse(child, "equality " + name + " is a <" + child.name + ">", "use connect, weld or joint");
      SourceJoint joint;
      joint.name = name;
      joint.line = child.line;
      joint.kind = child.name == "weld" ? SourceKind::fixed : SourceKind::spherical;
      if (child.has("site1") || child.has("site2")) {
        const auto site = [&](const char* key) {
          const auto found = sites_.find(child.get(key, ""));
          if (found == sites_.end())
            refuse(child, "equality " + name + " names site '" + child.get(key, "") + "', which is not there",
                   "correct the name");
          used_sites_.insert(found->first);
          return found->second;
        };
        const auto a = site("site1"), b = site("site2");
        joint.from = bodies_[static_cast<std::size_t>(a.first)].link;
        joint.to = bodies_[static_cast<std::size_t>(b.first)].link;
        joint.on_from = {a.second.at, a.second.turned};
        joint.on_to = {b.second.at, b.second.turned};
      } else {
        const Body &a = body_named(child, child.get("body1", "")), &b = body_named(child, child.get("body2", "world"));
        joint.from = a.link;
        joint.to = b.link;
        const auto anchor = numbers(child, "anchor", child.get("anchor", "0 0 0"), 3, 3);
        const Vec local = {anchor[0], anchor[1], anchor[2]};
        if (joint.kind == SourceKind::spherical) {
          place(joint, a.pose * local, {0, 0, 1});
        } else {
          joint.on_to = {b.pose.at, b.pose.turned};
          joint.on_from = joint.on_to;
          if (const auto text = child.get("relpose")) {
            const auto v = numbers(child, "relpose", *text, 7, 7);
            if (v[3] != 0 || v[4] != 0 || v[5] != 0 || v[6] != 0) {
              const Pose pose = a.pose * Pose{quaternion(v[3], v[4], v[5], v[6]), {v[0], v[1], v[2]}};
              joint.on_from = {pose.at, pose.turned};
            }
          }
        }
      }
      s_.joints.push_back(std::move(joint));
    }
  }

  std::size_t hinge_named(const XmlElement& at, const std::string& equality, const std::string& name) const {
    const auto found =
        std::find_if(tree_.begin(), tree_.end(), [&](const TreeJoint& joint) { return joint.name == name; });
    if (found == tree_.end())
      refuse(at, "equality " + equality + " names joint '" + name + "', which is not there", "correct the name");
    if (s_.joints[static_cast<std::size_t>(found->joints.front())].kind != SourceKind::revolute)
      refuse(at, "equality " + equality + " is of joint " + name + ", which is no hinge alone", "tie two hinges");
    return static_cast<std::size_t>(found - tree_.begin());
  }

  /// A hinge whose angle is a constant, or one plus a multiple of that of another hinge.
  void joint_equality(const XmlElement& at, const std::string& name) {
    std::vector<double> c = numbers(at, "polycoef", at.get("polycoef", "0 1 0 0 0"), 1, 5);
    c.resize(5);
    const std::size_t joint = hinge_named(at, name, at.get("joint1", ""));
    if (!at.has("joint2")) {
      followers_.push_back({joint, joint, c[0], 0, at.line});
      return;
    }
    if (c[2] != 0 || c[3] != 0 || c[4] != 0 || c[1] == 0)
      refuse(at, "equality " + name + " is of two joints in no constant ratio (polycoef)",
             "write 0 for the coefficients of second to fourth order");
    followers_.push_back({joint, hinge_named(at, name, at.get("joint2", "")), c[0], c[1], at.line});
  }

  /// Turns what follows to where it has to be in the posture.
  void follow(const TreeFollower& follower) {
    TreeJoint& joint = tree_[follower.joint];
    const auto index = static_cast<std::size_t>(joint.joints.front());
    const double off = follower.constant + follower.slope * tree_[follower.leader].value - joint.value;
    if (std::abs(off) > 1e-12) {
      const SourceJoint pin = s_.joints[index];
      for (const int link : below(pin.to)) move_link(s_, link, pin.at(), {}, turn(pin.axis(), off));
      joint.value += off;
      s_.note("joint " + joint.name + " was turned by " + shortest_decimal(off, 1e-9) + " rad to where it follows");
    }
    if (follower.joint == follower.leader) {
      SourceJoint& held = s_.joints[index];
      held.kind = SourceKind::fixed;
      held.actuated = false;
      held.on_to.frame = held.on_from.frame;
      return;
    }
    s_.followers.push_back(
        {index, static_cast<std::size_t>(tree_[follower.leader].joints.front()), follower.slope, follower.line});
  }

  void actuators(const XmlElement& at) {
    std::vector<std::string> others;
    for (const XmlElement& child : at.children) {
      child.read = true;
      const std::string name = child.get("name", child.name);
      const std::string target = child.get("joint", child.get("jointinparent", ""));
      if (target.empty()) {
        others.push_back(name);
        continue;
      }
      const auto found =
          std::find_if(tree_.begin(), tree_.end(), [&](const TreeJoint& joint) { return joint.name == target; });
      if (found == tree_.end())
        refuse(child, "actuator " + name + " drives joint '" + target + "', which is not there", "correct the name");
      SourceJoint& joint = s_.joints[static_cast<std::size_t>(found->joints.front())];
      if (joint.kind != SourceKind::revolute && joint.kind != SourceKind::prismatic)
        refuse(child, "actuator " + name + " drives joint " + target + ", which has several axes here",
               "drive a hinge or a slide alone");
      joint.actuated = true;
    }
    if (!others.empty()) s_.note("left out, since they drive no joint: actuators " + enumerated(others));
  }

  void keyframe(const XmlElement& at) {
    const XmlElement* key = at.first("key");
    if (key == nullptr) return;
    (void)key->get("name");
    const auto text = key->get("qpos");
    if (!text) return;
    std::size_t wanted = 0;
    for (const TreeJoint& joint : tree_) wanted += joint.type == "ball" ? 4 : 1;
    const auto q = numbers(*key, "qpos", *text, wanted, wanted);
    s_.note("the posture is that of keyframe " + key->get("name", "1"));
    std::size_t at_q = 0;
    for (TreeJoint& tree_joint : tree_) {
      const SourceJoint joint = s_.joints[static_cast<std::size_t>(tree_joint.joints.front())];
      Rotation r;
      Vec shift{};
      if (tree_joint.type == "ball") {
        const Rotation& frame = joint.on_from.frame;
        r = frame * quaternion(q[at_q], q[at_q + 1], q[at_q + 2], q[at_q + 3]) * frame.transposed();
        at_q += 4;
      } else {
        const double value = q[at_q++] - tree_joint.reference;
        tree_joint.value = value;
        if (tree_joint.type == "slide")
          shift = value * joint.axis();
        else
          r = turn(joint.axis(), value);
      }
      if (joint.kind == SourceKind::universal || (joint.kind == SourceKind::spherical && tree_joint.type == "hinge")) {
        s_.note("the keyframe's value of " + tree_joint.name + " was left out: it is part of a joint of several axes");
        continue;
      }
      for (const int link : below(joint.to)) move_link(s_, link, joint.at(), shift, r);
      // The side on the parent stays where it is; it is the child that moves.
    }
  }

  /// From the posture on, not from the zeros of the joints.
  void count_ranges() {
    for (const TreeJoint& tree_joint : tree_)
      if (auto& range = s_.joints[static_cast<std::size_t>(tree_joint.joints.front())].range)
        for (double& end : *range) end -= tree_joint.value;
  }

  /// A link and all that hang on it in the tree.
  std::vector<int> below(int link) const {
    std::vector<int> found = {link};
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (const TreeJoint& joint : tree_)
        for (const int j : joint.joints)
          if (s_.joints[static_cast<std::size_t>(j)].from == found[i])
            found.push_back(s_.joints[static_cast<std::size_t>(j)].to);
      for (const SourceJoint& joint : s_.joints)
        if (joint.kind == SourceKind::fixed && joint.from == found[i] && joint.name.ends_with("_weld") &&
            std::find(found.begin(), found.end(), joint.to) == found.end())
          found.push_back(joint.to);
      if (found.size() > 10000) break;
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  XmlElement root_;
  Source s_;
  std::vector<Body> bodies_;
  std::vector<TreeJoint> tree_;
  std::vector<TreeFollower> followers_;
  std::map<std::string, std::pair<int, Pose>> sites_;
  std::set<std::string> used_sites_;
  std::vector<std::string> without_mass_;
};

}  // namespace

bool is_mjcf(std::string_view text) { return is_xml_of(text, "mujoco"); }

Source read_mjcf(const SourceText& text) { return Reader(text).read(); }

}  // namespace clearloci::mechanism::imports
