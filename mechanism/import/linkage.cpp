// Linkage by David Rector (.linkage2): an XML file of connectors (points) and links between them, as
// CLinkageDoc::ReadIn of github.com/rectorsquid/Linkage reads it. Places are in 96ths of an inch, times `scalefactor`;
// layer 16 is the mechanism, layer 1 a drawing. A slider is a connector that runs along the line between two connectors
// of another link; an actuator grows from its drawn length by `throw`, or shrinks where `cpm` is negative.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "core/errors.hpp"
#include "mechanism/import/common.hpp"
#include "mechanism/import/formats.hpp"
#include "mechanism/import/xml.hpp"

namespace clearloci::mechanism::imports {
namespace {

using core::InputError;

struct Connector {
  int id = 0, line = 0;
  std::string name;
  Vec at{};
  bool anchor = false, input = false, draw = false, slider = false, drawing = false;
  double rpm = 0;
  std::vector<int> limits;  ///< connectors by number
  std::vector<int> links;   ///< of the source
  int fastened_to = -2;     ///< a link
};

class Reader {
 public:
  explicit Reader(const SourceText& given) : file_(given.file), root_(parse_xml(given.text, given.file)) {}

  Source read() {
    if (root_.name != "linkage2")
      throw InputError({file_, root_.line}, "the file has no <linkage2>", "save it in Linkage again");
    root_.read = true;
    s_.planar = true;
    program();
    for (const XmlElement* element : root_.all("connector")) connector(*element);
    for (const char* name : {"Link", "link", "element"})
      for (const XmlElement* element : root_.all(name)) link(*element);
    for (const XmlElement* element : root_.all("ratios")) ratios(*element);
    for (const XmlElement* element : root_.all("selected")) element->take_whole();
    connect();
    fasten();
    if (!lone_.empty()) s_.note("left out, because they have only one connector: links " + enumerated(lone_));
    if (!drawings_.empty()) s_.note("left out, because they are drawings or measures: " + enumerated(drawings_));
    if (const auto left = unread(root_); !left.empty())
      s_.note("left out, because they do not affect the motion: " + enumerated_all(left));
    return std::move(s_);
  }

 private:
  static std::string enumerated_all(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
  }

  double number(const XmlElement& at, const char* attribute, double otherwise) const {
    const auto text = at.get(attribute);
    if (!text || trimmed(*text).empty()) return otherwise;
    return numbers_of(*text, at, std::string(attribute) + " of <" + at.name + ">", file_, 1, 1).front();
  }
  int whole(const XmlElement& at, const char* attribute, int otherwise) const {
    const double value = number(at, attribute, otherwise);
    if (value != std::floor(value) || std::abs(value) > 4294967295.0)
      throw InputError({file_, at.line}, std::string(attribute) + " of <" + at.name + "> is no whole number",
                       "save the file in Linkage again");
    return static_cast<int>(std::clamp(value, -2147483647.0, 2147483647.0));
  }
  static bool flag(const XmlElement& at, const char* attribute) { return at.get(attribute, "") == "true"; }
  static bool is_drawing(int layer) {
    constexpr int drawing_layer = 1, mechanism_layer = 16;
    return (layer & drawing_layer) != 0 && (layer & mechanism_layer) == 0;
  }

  void program() {
    scale_ = 25.4 / 96;
    s_.unit = "mm";
    for (const XmlElement* element : root_.all("program")) {
      for (const char* view : {"zoom", "xoffset", "yoffset", "viewlayers", "editlayers"}) (void)element->get(view);
      const bool inches = element->get("units", "").starts_with("Inch");
      const double factor = number(*element, "scalefactor", 1);
      s_.unit = inches ? "in" : "mm";
      scale_ = (inches ? 1.0 : 25.4) / 96 * (factor > 0 ? factor : 1);
    }
  }

  static std::string name_of(const XmlElement& at, const char* letter, int id) {
    const std::string name(trimmed(at.get("name", "")));
    const bool says =
        std::any_of(name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; });
    return says ? name : letter + std::to_string(id);
  }

  void connector(const XmlElement& at) {
    Connector c;
    c.id = whole(at, "id", 0);
    c.line = at.line;
    c.name = name_of(at, "C", c.id);
    c.at = {scale_ * number(at, "x", 0), scale_ * number(at, "y", 0), 0};
    c.anchor = flag(at, "anchor");
    c.input = flag(at, "input");
    c.draw = flag(at, "draw");
    c.slider = flag(at, "slider");
    c.rpm = number(at, "rpm", 0);
    c.drawing = is_drawing(whole(at, "layer", 16)) || flag(at, "measurementelement");
    if (const double radius = number(at, "slideradius", 0); radius != 0 && c.slider && !c.drawing)
      throw InputError({file_, at.line}, "connector " + c.name + " slides along an arc (slideradius)",
                       "make its slot straight, or put a link from the centre of the arc in its place");
    for (const XmlElement* limit : at.all("slidelimit")) c.limits.push_back(whole(*limit, "id", -1));
    for (const char* key : {"fasten", "fastenlink"})
      if (at.has(key)) c.fastened_to = whole(at, key, -2);
    if (c.drawing) drawings_.push_back("connector " + c.name);
    if (!index_.emplace(c.id, connectors_.size()).second && !c.drawing)
      throw InputError({file_, at.line}, "two connectors have the id " + std::to_string(c.id),
                       "save the file in Linkage again");
    connectors_.push_back(std::move(c));
  }

  void link(const XmlElement& at) {
    const int id = whole(at, "id", 0);
    const std::string name = name_of(at, "L", id);
    const bool drawing = is_drawing(whole(at, "layer", 16)) || flag(at, "measurementelement");
    std::vector<int> connectors, fastened;
    for (const XmlElement* child : at.all("connector")) connectors.push_back(connector_named(*child));
    for (const XmlElement* child : at.all("fastenconnector")) fastened.push_back(connector_named(*child));
    const bool gear = flag(at, "gear"), actuator = flag(at, "actuator");
    const double stroke = number(at, "throw", 0), cpm = number(at, "cpm", 15);
    const int to_link = at.has("fastenlink") ? whole(at, "fastenlink", -2) : -2;
    const int to_connector = at.has("fastenconnector") ? whole(at, "fastenconnector", -2) : -2;
    if (drawing) {
      drawings_.push_back("link " + name);
      return;
    }
    if (connectors.empty()) {
      s_.note("link " + name + " has no connectors and was left out");
      return;
    }
    if (actuator) {
      add_actuator(at, name, connectors, stroke, cpm);
      return;
    }
    if (connectors.size() == 1 && fastened.empty() && to_link == -2 && to_connector == -2 && !gear) {
      lone_.push_back(name);
      return;
    }
    const int index = add_link(name, at.line, connectors);
    by_id_.emplace(id, index);
    if (gear) wheels_.push_back({id, index, at.line, connectors_[static_cast<std::size_t>(connectors.front())].at});
    for (const int c : fastened)
      if (!connectors_[static_cast<std::size_t>(c)].drawing) attach(index, c);
    if (to_link != -2) fastened_links_.emplace_back(index, to_link);
    if (to_connector != -2) fastened_connectors_.emplace_back(index, to_connector);
  }

  int connector_named(const XmlElement& at) const {
    const int id = whole(at, "id", -1);
    const auto found = index_.find(id);
    if (found == index_.end())
      throw InputError({file_, at.line}, "there is no connector with the id " + std::to_string(id),
                       "save the file in Linkage again");
    return static_cast<int>(found->second);
  }

  int add_link(const std::string& name, int line, const std::vector<int>& connectors) {
    s_.links.push_back({name, line, 0, {}, {}, false, false});
    const int index = static_cast<int>(s_.links.size()) - 1;
    for (const int c : connectors) attach(index, c);
    return index;
  }
  void attach(int link, int c) {
    auto& links = connectors_[static_cast<std::size_t>(c)].links;
    if (std::find(links.begin(), links.end(), link) == links.end()) links.push_back(link);
  }

  void add_actuator(const XmlElement& at, const std::string& name, const std::vector<int>& connectors, double stroke,
                    double cpm) {
    if (connectors.size() != 2)
      throw InputError({file_, at.line},
                       "actuator " + name + " has " + std::to_string(connectors.size()) + " connectors", "give it two");
    if (!(stroke > 0))
      throw InputError({file_, at.line}, "actuator " + name + " has no throw", "give it one in Linkage");
    const int body = add_link(name + "_body", at.line, {connectors[0]}),
              rod = add_link(name + "_rod", at.line, {connectors[1]});
    const Vec a = connectors_[static_cast<std::size_t>(connectors[0])].at,
              b = connectors_[static_cast<std::size_t>(connectors[1])].at;
    const double length = distance(a, b), reach = scale_ * stroke;
    if (!(length > 0))
      throw InputError({file_, at.line}, "actuator " + name + " has no length", "draw it longer in Linkage");
    if (cpm < 0 && reach >= length)
      throw InputError({file_, at.line}, "actuator " + name + " shrinks by more than its length",
                       "give it a smaller throw, or a positive speed");
    SourceJoint& guide = imports::add_joint(s_, name, at.line, SourceKind::prismatic, body, rod, b, b - a);
    guide.actuated = true;
    guide.range = cpm < 0 ? std::array<double, 2>{-reach, 0.0} : std::array<double, 2>{0.0, reach};
    guide.speed = cpm / 60 * 2 * reach * s_.metres();
  }

  // --- what is connected

  SourceJoint& add_joint(const Connector& c, SourceKind kind, int from, int to, const Vec& axis) {
    return imports::add_joint(s_, c.name, c.line, kind, from, to, c.at, axis);
  }

  void connect() {
    std::vector<std::string> shared, alone;
    for (const Connector& c : connectors_) {
      if (c.drawing) continue;
      if (c.links.empty()) {
        if (!c.slider || !c.anchor) alone.push_back(c.name);
        continue;
      }
      const bool pinned = c.anchor;
      const int base = pinned ? ground_link : c.links.front();
      bool driven = false;
      for (std::size_t i = pinned ? 0 : 1; i < c.links.size(); ++i) {
        SourceJoint& joint = add_joint(c, SourceKind::revolute, base, c.links[i], {0, 0, 1});
        if (!c.input || driven) continue;
        driven = true;
        joint.actuated = true;
        if (c.rpm != 0) joint.speed = c.rpm * std::numbers::pi / 30;
      }
      if (c.input && !driven)
        s_.note("connector " + c.name + " is an input between fewer than two links and drives nothing");
      if (c.links.size() + (pinned ? 1 : 0) > 2) shared.push_back(c.name);
      if (c.draw)
        s_.points.push_back({c.name, c.links.front(), c.at, true});
      else if (c.links.size() == 1 && !pinned && !c.slider)
        s_.points.push_back({c.name, c.links.front(), c.at, false});
    }
    sliders();
    if (!alone.empty()) s_.note("left out, since no link has them: connectors " + enumerated(alone));
    if (!shared.empty())
      s_.note("more than two links meet at " + enumerated(shared) +
              ": all are pinned to the ground or to the first of them; other pairings share the forces differently");
  }

  /// The link that has both ends of a slot; the ground where both are anchors and none has.
  int carrier_of(const Connector& c, const Connector& a, const Connector& b) const {
    for (const int link : a.links)
      if (std::find(b.links.begin(), b.links.end(), link) != b.links.end() &&
          std::find(c.links.begin(), c.links.end(), link) == c.links.end())
        return link;
    if (a.anchor && b.anchor) return ground_link;
    throw InputError(
        {file_, c.line},
        "connector " + c.name + " slides between connectors " + a.name + " and " + b.name + ", which no link joins",
        "join them by a link in Linkage");
  }

  struct Slot {
    const Connector* pin;
    const Connector *a, *b;
    int carrier, follower;
  };

  void sliders() {
    std::vector<Slot> slots;
    for (const Connector& c : connectors_) {
      if (c.drawing || !c.slider || (c.links.empty() && !c.anchor)) continue;
      if (c.limits.size() != 2 || !index_.contains(c.limits[0]) || !index_.contains(c.limits[1]))
        throw InputError({file_, c.line}, "connector " + c.name + " slides, but not between two connectors",
                         "give it two ends in Linkage");
      const Connector &a = connectors_[index_.at(c.limits[0])], &b = connectors_[index_.at(c.limits[1])];
      if (!(distance(a.at, b.at) > 0))
        throw InputError({file_, c.line}, "the slot of connector " + c.name + " has no length",
                         "draw it longer in Linkage");
      slots.push_back({&c, &a, &b, carrier_of(c, a, b), c.anchor ? ground_link : c.links.front()});
    }
    std::vector<bool> done(slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (done[i]) continue;
      for (std::size_t j = i + 1; j < slots.size() && !done[i]; ++j)
        if (!done[j] && slots[i].carrier == slots[j].carrier && slots[i].follower == slots[j].follower &&
            in_line(slots[i], slots[j])) {
          one_guide(slots[i], slots[j]);
          done[i] = done[j] = true;
        }
      if (!done[i]) slot(slots[i]);
    }
  }

  static bool in_line(const Slot& p, const Slot& q) {
    const Vec u = unit(p.b->at - p.a->at), v = unit(q.b->at - q.a->at);
    const double apart = distance(p.pin->at, q.pin->at), length = distance(p.a->at, p.b->at);
    return norm(cross(u, v)) < 1e-6 && apart > 1e-6 * length && norm(cross(u, q.pin->at - p.pin->at)) < 1e-4 * apart;
  }

  /// Two pins of one link in one slot: a guide that touches at both.
  void one_guide(const Slot& p, const Slot& q) {
    Connector middle = *p.pin;
    middle.at = 0.5 * (p.pin->at + q.pin->at);
    middle.name = p.pin->name + "_" + q.pin->name;
    SourceJoint& guide = add_joint(middle, SourceKind::prismatic, p.carrier, p.follower, p.b->at - p.a->at);
    guide.along = std::pair{p.a->at, p.b->at};
    guide.half_length = distance(p.pin->at, q.pin->at) / 2;
    s_.note("connectors " + p.pin->name + " and " + q.pin->name + " run in one slot: one guide, which bears at both");
  }

  void slot(const Slot& at) {
    const Connector& c = *at.pin;
    if (at.carrier == at.follower) {
      s_.note("the slot of connector " + c.name + " is on the ground, as its pin is: it was left out");
      return;
    }
    SourceJoint& slot = add_joint(c, SourceKind::slot, at.carrier, at.follower, at.b->at - at.a->at);
    slot.name = c.name + "_slot";
    slot.point = c.name;
    slot.along = std::pair{at.a->at, at.b->at};
  }

  // --- gears and chains

  void ratios(const XmlElement& at) {
    for (const XmlElement* element : at.all("ratio")) ratio(*element);
    for (const Wheel& wheel : wheels_)
      if (!wheel.turns)
        s_.note("gear " + s_.links[static_cast<std::size_t>(wheel.link)].name + " has no other one and is a link here");
  }

  void ratio(const XmlElement& at) {
    const std::string type = at.get("type", "gears");
    for (const char* word : {"sizetype", "sizeasradius", "radius"}) (void)at.get(word);
    SourceMesh mesh;
    mesh.line = at.line;
    mesh.belt = type.starts_with("chain") || type.starts_with("belt");
    const std::string what = mesh.belt ? "chain" : "gear";
    if (!mesh.belt && !type.starts_with("gear"))
      throw InputError({file_, at.line}, "a ratio is of type '" + type + "'", "use gears or a chain");
    const std::vector<const XmlElement*> both = at.all("link");
    if (both.size() != 2)
      throw InputError({file_, at.line}, "a ratio is of " + std::to_string(both.size()) + " links", "name two gears");
    std::array<double, 2> sizes{};
    for (std::size_t i = 0; i < 2; ++i) {
      Wheel& wheel = wheel_named(*both[i]);
      sizes[i] = number(*both[i], "size", 1);
      mesh.links[i] = wheel.link;
      mesh.at[i] = wheel.centre;
      wheel.turns = true;
    }
    mesh.name = what + "_" + s_.links[static_cast<std::size_t>(mesh.links[0])].name + "_" +
                s_.links[static_cast<std::size_t>(mesh.links[1])].name;
    if (!(sizes[0] > 0) || !(sizes[1] > 0))
      throw InputError({file_, at.line}, mesh.name + " has a size that is not positive", "correct it in Linkage");
    const bool same = std::abs(sizes[0] - sizes[1]) <= 1e-9 * sizes[0];
    if (!mesh.belt || !same) mesh.teeth = teeth_of(sizes[0], sizes[1], mesh.name, file_, at.line);
    s_.meshes.push_back(std::move(mesh));
  }

  struct Wheel {
    int id = 0, link = ground_link, line = 0;
    Vec centre{};
    bool turns = false;
  };
  Wheel& wheel_named(const XmlElement& at) {
    const int id = whole(at, "id", -1);
    const auto found = std::find_if(wheels_.begin(), wheels_.end(), [&](const Wheel& wheel) { return wheel.id == id; });
    if (found == wheels_.end())
      throw InputError({file_, at.line}, "a ratio is of link " + std::to_string(id) + ", which is no gear",
                       "save the file in Linkage again");
    return *found;
  }

  void fasten() {
    const auto weld = [&](int link, int to, const std::string& what, int line, const Vec& at) {
      imports::add_joint(s_, what, line, SourceKind::fixed, to, link, at, {0, 0, 1});
    };
    const auto linked = [&](int id, const std::string& what, int line) {
      const auto found = by_id_.find(id);
      if (found == by_id_.end())
        throw InputError({file_, line}, what + " is fastened to link " + std::to_string(id) + ", which is not there",
                         "fasten it again in Linkage");
      return found->second;
    };
    for (const auto& [link, id] : fastened_links_) {
      const SourceLink& source_link = s_.links[static_cast<std::size_t>(link)];
      weld(link, linked(id, "link " + source_link.name, source_link.line), "fastening_" + source_link.name,
           source_link.line, {});
    }
    for (const auto& [link, id] : fastened_connectors_) {
      const SourceLink& source_link = s_.links[static_cast<std::size_t>(link)];
      const auto found = index_.find(id);
      if (found == index_.end() || !connectors_[found->second].anchor)
        throw InputError(
            {file_, source_link.line},
            "link " + source_link.name + " is fastened to connector " + std::to_string(id) + ", which is no anchor",
            "fasten it to a link");
      weld(link, ground_link, "fastening_" + source_link.name, source_link.line, {});
    }
    for (const Connector& c : connectors_)
      if (!c.drawing && c.fastened_to != -2 && !c.links.empty())
        weld(c.links.front(), linked(c.fastened_to, "connector " + c.name, c.line), "fastening_" + c.name, c.line,
             c.at);
  }

  std::string file_;
  XmlElement root_;
  Source s_;
  double scale_ = 1;
  std::vector<Connector> connectors_;
  std::map<int, std::size_t> index_;
  std::map<int, int> by_id_;
  std::vector<std::pair<int, int>> fastened_links_, fastened_connectors_;
  std::vector<std::string> drawings_, lone_;
  std::vector<Wheel> wheels_;
};

}  // namespace

bool is_linkage(std::string_view text) { return is_xml_of(text, "linkage2"); }

Source read_linkage(const SourceText& text) { return Reader(text).read(); }

}  // namespace clearloci::mechanism::imports
