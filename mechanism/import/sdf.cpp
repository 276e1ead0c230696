// SDFormat 1.4 to 1.11 (sdformat.org/spec): a model's links, frames and joints, each with a pose relative to another
// one; loops are joints like all others. Before 1.5 axes are written in the frame of the model, from then on in that of
// the joint, or in the one that `expressed_in` (1.7) or `use_parent_model_frame` (1.5, 1.6) says.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/errors.hpp"
#include "mechanism/import/common.hpp"
#include "mechanism/import/formats.hpp"
#include "mechanism/import/xml.hpp"

namespace clearloci::mechanism::imports {
namespace {

using core::InputError;

class Reader {
 public:
  explicit Reader(const SourceText& given) : file_(given.file), root_(parse_xml(given.text, given.file)) {}

  Source read() {
    root_.read = true;
    version();
    const XmlElement& model = the_model();
    s_.name = model.get("name", "");
    refuse_others(model);
    for (const XmlElement* element : model.all("link")) add(*element, "link");
    for (const XmlElement* element : model.all("frame")) add(*element, "frame");
    for (const XmlElement* element : model.all("joint")) add(*element, "joint");
    motors(model);
    for (const XmlElement* element : model.all("link")) link(*element);
    if (s_.links.empty())
      throw InputError({file_, model.line}, "the model has no links", "name an SDF file of a mechanism");
    for (const XmlElement* element : model.all("joint"))
      element->get("type", "") == "gearbox" ? gearbox(*element) : joint(*element);
    couple();
    ground();
    if (const auto left = unread(root_); !left.empty()) {
      std::string text;
      for (const std::string& word : left) text += (text.empty() ? "" : ", ") + word;
      s_.note("left out: " + text);
    }
    return std::move(s_);
  }

 private:
  [[noreturn]] void refuse(const XmlElement& at, const std::string& problem, const std::string& mend) const {
    throw InputError({file_, at.line}, problem, mend);
  }

  void version() {
    const std::string text = root_.get("version", "1.6");
    double value = 0;
    const std::size_t dot = text.find('.');
    double minor = 0;
    if (dot == std::string::npos || !number_of(text.substr(0, dot), value) || !number_of(text.substr(dot + 1), minor) ||
        value != 1)
      refuse(root_, "the SDF version is '" + text + "'", "write it as 1.4 to 1.11");
    minor_ = static_cast<int>(minor);
    if (minor_ < 4 || minor_ > 12)
      refuse(root_, "the SDF version is " + text, "convert it to 1.4 to 1.11: gz sdf -p FILE");
  }

  const XmlElement& the_model() {
    constexpr double g = 9.8;
    s_.gravity = Vec{0, 0, -g};
    std::vector<const XmlElement*> models = root_.all("model");
    for (const XmlElement* world : root_.all("world")) {
      (void)world->get("name");
      if (const XmlElement* gravity = world->first("gravity")) s_.gravity = vector(*gravity, gravity->text);
      if (const XmlElement* include = world->first("include"))
        refuse(*include, "the world includes another file", "name that file, or put its model in");
      for (const XmlElement* element : world->all("model")) models.push_back(element);
    }
    std::erase_if(models, [&](const XmlElement* element) {
      const XmlElement* fixed = element->first("static");
      const bool still = fixed != nullptr && (trimmed(fixed->text) == "1" || trimmed(fixed->text) == "true");
      if (still) {
        s_.note("model " + element->get("name", "") + " stands still and was left out");
        element->take_whole();
      }
      return still;
    });
    if (models.empty()) refuse(root_, "the SDF file has no model that moves", "name an SDF file of a mechanism");
    if (models.size() > 1)
      refuse(*models[1],
             "the SDF file has several models: " + models[0]->get("name", "") + " and " + models[1]->get("name", ""),
             "take the others out");
    // Of the model's own pose the turn matters: what weighs stays upright.
    if (const XmlElement* pose = models.front()->first("pose"); pose != nullptr && !trimmed(pose->text).empty())
      s_.gravity = pose_text(*pose).turned.transposed() * *s_.gravity;
    return *models.front();
  }

  void refuse_others(const XmlElement& model) const {
    if (const XmlElement* element = model.first("include"))
      refuse(*element, "model " + s_.name + " includes another file", "put what it includes in its place");
    if (const XmlElement* element = model.first("model"))
      refuse(*element, "model " + element->get("name", "") + " is nested in another one",
             "write its links into the outer one");
    for (const char* loop : {"drake:linear_bushing_rpy", "drake:ball_constraint", "drake:joint"})
      if (const XmlElement* element = model.first(loop))
        refuse(*element, "<" + element->name + "> is an extension of one program that connects two links",
               "write a joint of SDF in its place");
    if (const XmlElement* element = model.first("gripper")) element->take_whole();
  }

  Vec vector(const XmlElement& at, const std::string& text) const {
    const auto v = numbers_of(text, at, "<" + at.name + ">", file_, 3, 3);
    return {v[0], v[1], v[2]};
  }
  double number(const XmlElement& at) const {
    return numbers_of(at.text, at, "<" + at.name + ">", file_, 1, 1).front();
  }

  /// x y z roll pitch yaw, or x y z and a quaternion x y z w.
  Pose pose_text(const XmlElement& at) const {
    if (trimmed(at.text).empty()) return {};
    const bool quaternions = at.get("rotation_format", "euler_rpy") == "quat_xyzw";
    const bool degrees = at.get("degrees", "false") == "true" || at.get("degrees", "") == "1";
    const auto v = numbers_of(at.text, at, "<pose>", file_, quaternions ? 7 : 6, quaternions ? 7 : 6);
    if (quaternions) return {quaternion(v[6], v[3], v[4], v[5]), {v[0], v[1], v[2]}};
    const double unit = degrees ? std::acos(-1.0) / 180 : 1;
    return {roll_pitch_yaw(unit * v[3], unit * v[4], unit * v[5]), {v[0], v[1], v[2]}};
  }

  // --- poses

  struct Entity {
    const XmlElement* at;
    std::string kind;
  };

  void add(const XmlElement& at, const std::string& kind) {
    const std::string name = at.get("name", "");
    if (name.empty()) refuse(at, "a <" + kind + "> has no name", "name it");
    if (!entities_.emplace(name, Entity{&at, kind}).second)
      refuse(at, "two elements of the model are called " + name, "rename one of them");
  }

  std::string word(const XmlElement& at, const char* child) const {
    const XmlElement* element = at.first(child);
    return element == nullptr ? "" : std::string(trimmed(element->text));
  }

  /// In the frame of the model.
  Pose pose_of(const std::string& name, const XmlElement& where, int depth = 0) const {
    if (name.empty() || name == "__model__" || name == "world") return {};
    const auto found = entities_.find(name);
    if (found == entities_.end())
      refuse(where, "<" + where.name + "> refers to '" + name + "', which is not there", "correct the name");
    constexpr int deepest = 100;
    if (depth > deepest)
      refuse(where, "the poses of " + name + " and others refer to each other in a circle",
             "give one of them relative to the model");
    const Entity& entity = found->second;
    const XmlElement* pose = entity.at->first("pose");
    std::string base;
    if (pose != nullptr) base = pose->get("relative_to", pose->get("frame", ""));
    if (base.empty() && entity.kind == "frame") base = entity.at->get("attached_to", "");
    if (base.empty() && entity.kind == "joint") base = word(*entity.at, "child");
    const Pose outer = pose_of(base, *entity.at, depth + 1);
    return pose == nullptr ? outer : outer * pose_text(*pose);
  }

  /// The link that an entity is part of.
  std::string link_of(std::string name, const XmlElement& where) const {
    for (int depth = 0; depth < 100; ++depth) {
      if (name == "world") return name;
      const auto found = entities_.find(name);
      if (found == entities_.end()) break;
      if (found->second.kind == "link") return name;
      if (found->second.kind == "joint") {
        name = word(*found->second.at, "child");
        continue;
      }
      const XmlElement* pose = found->second.at->first("pose");
      std::string base = found->second.at->get("attached_to", "");
      if (base.empty() && pose != nullptr) base = pose->get("relative_to", "");
      if (base.empty()) break;
      name = base;
    }
    refuse(where, "<" + where.name + "> names '" + name + "', which is no link of the model", "correct the name");
  }

  // --- links and joints

  void link(const XmlElement& at) {
    SourceLink link;
    link.name = at.get("name", "");
    link.line = at.line;
    const Pose pose = pose_of(link.name, at);
    if (const XmlElement* inertial = at.first("inertial")) {
      const XmlElement* offset = inertial->first("pose");
      const Pose centre = offset == nullptr ? pose : pose * pose_text(*offset);
      link.mass = 1;
      if (const XmlElement* mass = inertial->first("mass")) link.mass = number(*mass);
      if (link.mass < 0) refuse(*inertial, "the mass of link " + link.name + " is negative", "write 0 or more");
      link.centre = centre.at;
      if (const XmlElement* i = inertial->first("inertia")) {
        const auto part = [&](const char* name, double otherwise) {
          const XmlElement* value = i->first(name);
          return value == nullptr ? otherwise : number(*value);
        };
        link.inertia = turned(centre.turned, {part("ixx", 1), part("iyy", 1), part("izz", 1), part("ixy", 0),
                                              part("ixz", 0), part("iyz", 0)});
      }
    }
    index_.emplace(link.name, static_cast<int>(s_.links.size()));
    s_.links.push_back(std::move(link));
  }

  void motors(const XmlElement& model) {
    for (const XmlElement* plugin : model.all("plugin")) {
      (void)plugin->get("name");
      (void)plugin->get("filename");
      for (const XmlElement* element : plugin->all("joint_name")) motors_.insert(std::string(trimmed(element->text)));
    }
  }

  int side_of(const XmlElement& at, const char* which) const {
    const XmlElement* element = at.first(which);
    if (element == nullptr) refuse(at, "joint " + at.get("name", "") + " has no <" + which + ">", "name both links");
    const std::string link = link_of(std::string(trimmed(element->text)), *element);
    return link == "world" ? ground_link : index_.at(link);
  }

  Vec axis_of(const XmlElement& axis, const Pose& pose) const {
    const XmlElement* xyz = axis.first("xyz");
    const Vec v = xyz == nullptr ? Vec{0, 0, 1} : vector(*xyz, xyz->text);
    if (!(norm(v) > 1e-9)) refuse(axis, "the axis of a joint has no direction", "write such as <xyz>0 0 1</xyz>");
    const std::string frame = xyz == nullptr ? "" : xyz->get("expressed_in", "");
    if (!frame.empty()) return pose_of(frame, axis).turned * v;
    const std::string flag = word(axis, "use_parent_model_frame");
    if (minor_ < 5 || ((minor_ == 5 || minor_ == 6) && (flag == "1" || flag == "true"))) return v;
    return pose.turned * v;
  }

  double number_in(const XmlElement& at, const char* child, double otherwise) const {
    const XmlElement* element = at.first(child);
    return element == nullptr ? otherwise : number(*element);
  }

  /// value = multiplier (value of the leader - reference) + offset, by which joints are placed at 0.
  void mimic(const XmlElement& at, const std::string& joint) {
    std::vector<const XmlElement*> places = {&at};
    if (const XmlElement* element = at.first("axis")) places.push_back(element);
    for (const XmlElement* place : places)
      for (const char* word : {"mimic", "drake:mimic"}) {
        const XmlElement* element = place->first(word);
        if (element == nullptr) continue;
        const auto attribute = [&](const char* name, double otherwise) {
          const auto text = element->get(name);
          return text ? numbers_of(*text, *element, name, file_, 1, 1).front() : otherwise;
        };
        (void)element->get("axis");
        const double multiplier = attribute("gear_ratio", number_in(*element, "multiplier", 1)),
                     offset = attribute("offset", number_in(*element, "offset", 0)) -
                              multiplier * number_in(*element, "reference", 0);
        if (multiplier == 0 || std::abs(offset) > 1e-12)
          refuse(*element,
                 "joint " + joint + " follows another one (mimic) by 0, or is not where it follows with all at 0",
                 "place its links where they follow, with offset and reference 0");
        followers_.push_back({element, s_.joints.size(), element->get("joint", ""), multiplier});
      }
    if (const XmlElement* second = at.first("axis2"))
      for (const char* word : {"mimic", "drake:mimic"})
        if (const XmlElement* element = second->first(word))
          refuse(*element, "the second axis of joint " + joint + " follows another joint (mimic)", "take it out");
  }

  struct NamedFollower {
    const XmlElement* at;
    std::size_t joint;
    std::string leader;
    double multiplier;
  };
  struct Gearbox {
    const XmlElement* at;
    int parent, child, body;
    double ratio;
    Vec first, second;  ///< axes of parent and child
  };

  void gearbox(const XmlElement& at) {
    const std::string name = at.get("name", "");
    const Pose pose = pose_of(name, at);
    const XmlElement *axis = at.first("axis"), *second = at.first("axis2");
    const std::string body = word(at, "gearbox_reference_body");
    if (axis == nullptr || body.empty())
      refuse(at, "gearbox " + name + " has no <axis> or no <gearbox_reference_body>", "write both");
    const Vec first = axis_of(*axis, pose);
    const std::string link = link_of(body, at);
    gearboxes_.push_back({&at, side_of(at, "parent"), side_of(at, "child"),
                          link == "world" ? ground_link : index_.at(link), number_in(at, "gearbox_ratio", 1), first,
                          second == nullptr ? first : axis_of(*second, pose)});
  }

  /// The pin of a wheel on the reference body, and whether it turns as the axis says.
  std::pair<std::size_t, double> pin_of(const Gearbox& gearbox, int wheel, const Vec& axis) const {
    for (std::size_t j = 0; j < s_.joints.size(); ++j) {
      const SourceJoint& joint = s_.joints[j];
      const bool forward = joint.from == gearbox.body && joint.to == wheel;
      if (joint.kind != SourceKind::revolute || (!forward && (joint.to != gearbox.body || joint.from != wheel)))
        continue;
      return {j, (forward ? 1.0 : -1.0) * (dot(joint.axis(), axis) < 0 ? -1 : 1)};
    }
    refuse(*gearbox.at,
           "gearbox " + gearbox.at->get("name", "") + " joins " + link_words(s_, wheel) +
               ", which has no revolute joint with " + link_words(s_, gearbox.body) + ", its reference body",
           "add that joint");
  }

  void couple() {
    for (const NamedFollower& follower : followers_) {
      const auto leader = std::find_if(s_.joints.begin(), s_.joints.end(),
                                       [&](const SourceJoint& joint) { return joint.name == follower.leader; });
      if (leader == s_.joints.end())
        refuse(*follower.at, "<mimic> names joint '" + follower.leader + "', which is not there", "correct the name");
      s_.followers.push_back({follower.joint, static_cast<std::size_t>(leader - s_.joints.begin()), follower.multiplier,
                              follower.at->line});
    }
    for (const Gearbox& gearbox : gearboxes_) {
      if (gearbox.ratio == 0)
        refuse(*gearbox.at, "gearbox " + gearbox.at->get("name", "") + " has a ratio of 0", "correct it");
      const auto [leader, sense] = pin_of(gearbox, gearbox.parent, gearbox.first);
      const auto [follower, other] = pin_of(gearbox, gearbox.child, gearbox.second);
      s_.followers.push_back({follower, leader, -gearbox.ratio * sense * other, gearbox.at->line});
    }
  }

  void joint(const XmlElement& at) {
    static const std::map<std::string, SourceKind> kinds = {
        {"revolute", SourceKind::revolute}, {"continuous", SourceKind::revolute}, {"prismatic", SourceKind::prismatic},
        {"ball", SourceKind::spherical},    {"universal", SourceKind::universal}, {"fixed", SourceKind::fixed}};
    SourceJoint joint;
    joint.name = at.get("name", "");
    joint.line = at.line;
    const std::string type = at.get("type", "");
    const auto kind = kinds.find(type);
    if (kind == kinds.end())
      refuse(at, "joint " + joint.name + " is of type '" + type + "'",
             "use revolute, continuous, prismatic, ball, universal or fixed");
    joint.kind = kind->second;
    mimic(at, joint.name);
    joint.from = side_of(at, "parent");
    joint.to = side_of(at, "child");
    if (joint.from == joint.to) refuse(at, "joint " + joint.name + " joins a link to itself", "name two links");
    const Pose pose = pose_of(joint.name, at);
    place(joint, pose.at, {0, 0, 1});
    const XmlElement *axis = at.first("axis"), *second = at.first("axis2");
    const bool turns = joint.kind == SourceKind::revolute || joint.kind == SourceKind::prismatic ||
                       joint.kind == SourceKind::universal;
    if (turns && axis == nullptr) refuse(at, "joint " + joint.name + " has no <axis>", "write one");
    if (turns) place(joint, pose.at, axis_of(*axis, pose));
    if (joint.kind == SourceKind::universal) {
      if (second == nullptr) refuse(at, "joint " + joint.name + " has no <axis2>", "write one");
      joint.on_to.frame = frame_along(unit(axis_of(*second, pose)));
    }
    if (axis != nullptr)
      if (const XmlElement* limit = axis->first("limit")) {
        const XmlElement *lower = limit->first("lower"), *upper = limit->first("upper");
        constexpr double endless = 1e6;
        if (lower != nullptr && upper != nullptr && type != "continuous") {
          const double low = bound(*lower), high = bound(*upper);
          if (low < high && high - low < endless) joint.range = std::array<double, 2>{low, high};
        }
      }
    joint.actuated = motors_.contains(joint.name) && joint.kind != SourceKind::fixed &&
                     joint.kind != SourceKind::spherical && joint.kind != SourceKind::universal;
    s_.joints.push_back(std::move(joint));
  }

  /// 1e16 and inf say that there is none.
  double bound(const XmlElement& at) const {
    const std::string text(trimmed(at.text));
    if (text == "inf" || text == "+inf") return 1e16;
    if (text == "-inf") return -1e16;
    double value = 0;
    if (!number_of(text, value))
      refuse(at, "<" + at.name + ">: '" + text.substr(0, 40) + "' is no number", "correct it");
    return value;
  }

  /// A model that is not joined to the world stands on its first link that is no child.
  void ground() {
    for (const SourceJoint& joint : s_.joints)
      if (joint.from == ground_link || joint.to == ground_link) return;
    std::set<int> children;
    for (const SourceJoint& joint : s_.joints) children.insert(joint.to);
    int base = 0;
    for (std::size_t l = s_.links.size(); l-- > 0;)
      if (!children.contains(static_cast<int>(l))) base = static_cast<int>(l);
    s_.note("no joint joins the model to the world: link " + s_.links[static_cast<std::size_t>(base)].name +
            " stands still");
    merge_links(s_, ground_link, base);
  }

  std::string file_;
  XmlElement root_;
  Source s_;
  int minor_ = 6;
  std::map<std::string, Entity> entities_;
  std::map<std::string, int> index_;
  std::set<std::string> motors_;
  std::vector<NamedFollower> followers_;
  std::vector<Gearbox> gearboxes_;
};

}  // namespace

bool is_sdf(std::string_view text) { return is_xml_of(text, "sdf") || is_xml_of(text, "gazebo"); }

Source read_sdf(const SourceText& text) { return Reader(text).read(); }

}  // namespace clearloci::mechanism::imports
