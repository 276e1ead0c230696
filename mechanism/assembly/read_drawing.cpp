// The drawn form of mechanism-file.md, as far as its words go.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "mechanism/assembly/drawn_pose.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/reader.hpp"
#include "mechanism/units.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

/// Every word in a node's values that could be a name.
void add_words(const Node& node, std::set<std::string>& words) {
  if (node.IsScalar()) {
    std::string word;
    for (const char c : node.Scalar() + " ") {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_')
        word += c;
      else if (!word.empty())
        words.insert(std::exchange(word, ""));
    }
  }
  for (const Node& item : node.items()) add_words(item, words);
  for (const auto& [key, content] : node.pairs()) add_words(content, words);
}

class DrawingReader {
 public:
  DrawingReader(const Value& document, const std::vector<Override>& overrides, PlainSections& plain)
      : document_(document), plain_(plain) {
    for (const Entry& entry : entries(document)) sections_.emplace(entry.key, entry.value);
    Mechanism& m = result_.mechanism;
    m.file = document.where.file;
    m.units = read_units(section("units"));
    if (const auto space = section("space")) m.space = text_of(*space) == "spatial" ? Space::spatial : Space::planar;
    read_parameters(m, section("parameters"), free_effort_parameters(required("joints"), {}), overrides);
    result_.unit = length_unit();
    coordinates_.emplace(section("workspace"), required("joints"), document.where, result_);
    plain_.workspace = coordinates_->plain_workspace();
    read_workspace(m, {plain_.workspace, "'workspace'", plain_.workspace.where(), "workspace"});
    read_points();
    read_links();
    read_gear_points(m, required("joints"));
    read_belt_points(m, required("joints"));
    read_joints(m, required("joints"));
    set_cables_and_meshes_apart();
    check_size();
    place_axes();
    coordinates_->resolve();
  }

  Drawing take() { return std::move(result_); }

 private:
  std::optional<Value> section(const std::string& name) const {
    const auto found = sections_.find(name);
    if (found == sections_.end()) return std::nullopt;
    Value value = found->second;
    if (is_field(name)) value.field = name;
    return value;
  }
  Value required(const std::string& name) const {
    if (const auto found = section(name)) return *found;
    throw InputError(document_.where, "the key '" + name + "' is missing in the file", "add " + name + ": ...");
  }

  Rational length_unit() const {
    const Value one{Node("1"), "a length", document_.where, "length"};
    return read_number(result_.mechanism, one, Sign::any).value;
  }

  /// Freedoms are counted in matrices as wide as there are links; nobody draws more by hand.
  void check_size() const {
    constexpr std::size_t most_links = 60, most_points = 200;
    if (result_.mechanism.links.size() > most_links || result_.points.size() > most_points)
      throw InputError(required("drawn").where,
                       "the drawing has " + std::to_string(result_.mechanism.links.size()) + " links and " +
                           std::to_string(result_.points.size()) + " points",
                       "draw 60 links and 200 points at most, or write constructions");
  }

  // --- points

  void read_points() {
    Mechanism& m = result_.mechanism;
    const std::vector<Entry> drawn = entries(required("drawn"));
    if (drawn.empty()) throw InputError(required("drawn").where, "nothing is drawn", "write such as A: [0, 0]");
    std::map<std::string, Entry> built;
    std::vector<std::string> order;
    if (const auto points = section("points"); points && !points->node.IsNull())
      for (const Entry& entry : entries(*points)) {
        built.emplace(entry.key, entry);
        order.push_back(entry.key);
      }
    for (const Entry& entry : drawn) {
      add_drawn(entry, built);
      read_known_frames(m, section("frames"));
    }
    for (const std::string& name : order) add_built(built.at(name));
    for (const std::string& name : order) note_uses(built.at(name));
    place_built();
    double size = 0;
    for (std::size_t p = 0; p < result_.points.size(); ++p)
      for (std::size_t q = 0; q < p; ++q)
        if (result_.points[p].has_place && result_.points[q].has_place)
          size = std::max(size, distance(result_.posture[p], result_.posture[q]));
    if (!(size > 0)) throw InputError(drawn.front().where, "all points are drawn in one place", "draw them apart");
    result_.size = size;
    m.body_frames.clear();
  }

  static double distance(const std::array<double, 3>& p, const std::array<double, 3>& q) {
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }

  void add_drawn(const Entry& entry, const std::map<std::string, Entry>& built) {
    check_label(entry.key, entry.where, "a point");
    Value place = entry.value;
    place.what = "the drawn place of " + entry.key;
    place.field = "points";
    if (!place.is_sequence())
      throw InputError(place.where, place.what + " is no place",
                       result_.is_spatial() ? "write [x, y, z]; constructions stand under points"
                                            : "write [x, y]; constructions stand under points");
    DrawnPoint point;
    point.is_exact = true;
    point.form = place.node;
    ExplicitPoint form;
    const std::vector<Value> parts = elements(place, static_cast<int>(dimension(result_.mechanism)));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Number number = read_number(result_.mechanism, parts[i], Sign::any);
      form.coordinates.push_back(number.expression);
      point.at[i] = amount(number, parts[i]);
    }
    if (const auto construction = built.find(entry.key); construction != built.end()) {
      point.built = true;
      point.form = construction->second.value.node;
    }
    result_.mechanism.points.push_back({entry.key, std::move(form), false, entry.where});
    result_.points.push_back(std::move(point));
  }

  /// In the file's units: a rational number where no parameter is in it.
  Amount amount(const Number& number, const Value& value) const {
    const ExactValue exact = evaluate(number.expression, result_.mechanism.parameters);
    const Rational in_file = exact.value / result_.unit;
    if (symbols(number.expression).empty() && exact.exact) return Amount(in_file);
    return Amount::expression(text_of(value), core::to_double(in_file));
  }

  void add_built(const Entry& entry) {
    Mechanism& m = result_.mechanism;
    const auto drawn =
        std::find_if(m.points.begin(), m.points.end(), [&](const Point& p) { return p.name == entry.key; });
    if (drawn != m.points.end()) {
      read_known_frames(m, section("frames"));
      return;
    }
    check_label(entry.key, entry.where, "a point");
    Value form = entry.value;
    form.what = "point " + entry.key;
    DrawnPoint point;
    point.built = true;
    point.form = form.node;
    m.points.push_back({entry.key, read_point_form(m, form), false, entry.where});
    point.moves = !coordinates_of(m, static_cast<PointIndex>(m.points.size()) - 1).empty();
    point.held = form.is_sequence() || form.node.has("in");
    point.has_place = !point.moves;
    if (form.is_sequence() && !point.moves) {
      point.is_exact = true;
      std::vector<Value> parts = elements(form);
      for (std::size_t i = 0; i < parts.size() && i < 3; ++i) {
        parts[i].field = "points";
        point.at[i] = amount(read_number(m, parts[i], Sign::any), parts[i]);
      }
    }
    result_.points.push_back(std::move(point));
    read_known_frames(m, section("frames"));
  }

  void note_uses(const Entry& entry) {
    if (entry.value.is_sequence()) return;
    std::set<std::string> words;
    add_words(entry.value.node, words);
    if (const auto frames = section("frames"); frames && frames->is_map())
      for (const Entry& frame : entries(*frames))
        if (words.contains(frame.key)) add_words(frame.value.node, words);
    const auto& points = result_.mechanism.points;
    std::size_t index = 0;
    while (points[index].name != entry.key) ++index;
    for (std::size_t p = 0; p < points.size(); ++p)
      if (p != index && words.contains(points[p].name))
        result_.points[index].uses.push_back(static_cast<PointIndex>(p));
  }

  /// Where constructions put their points, the others being drawn.
  void place_built() {
    const Mechanism& m = result_.mechanism;
    const std::vector<double> pose = result_.pose = pose_of_drawing(result_, *coordinates_);
    const auto placed = sample_points(m, pose);
    for (std::size_t p = 0; p < result_.points.size(); ++p) {
      if (!placed[p] && result_.points[p].has_place)
        throw InputError(m.points[p].where, "point " + m.points[p].name + " cannot be built in the drawn posture",
                         "draw its base points within reach of each other");
      result_.posture.push_back(placed[p].value_or(std::array<double, 3>{}));
    }
  }

  // --- links

  void read_links() {
    std::vector<Node::Pair> pairs;
    std::vector<std::pair<std::optional<Value>, std::optional<Value>>> given;
    const Value links = required("links");
    for (const Entry& entry : entries(links)) {
      Node content = entry.value.node;
      std::optional<Value> one, several;
      if (entry.value.is_map()) {
        std::vector<Node::Pair> kept;
        for (const Entry& part : entries(entry.value)) {
          if (part.key == "length") one = part.value;
          if (part.key == "lengths") several = part.value;
        }
        for (const Node::Pair& pair : content.pairs())
          if (!pair.first.IsScalar() || (pair.first.Scalar() != "length" && pair.first.Scalar() != "lengths"))
            kept.push_back(pair);
        content = Node::map(std::move(kept), content.where());
      }
      pairs.emplace_back(text_node(entry.key, entry.where), content);
      given.emplace_back(one, several);
    }
    plain_.links = Node::map(std::move(pairs), links.where);
    mechanism::read_links(result_.mechanism, {plain_.links, links.what, links.where, links.field});
    for (std::size_t l = 0; l < given.size(); ++l)
      result_.lengths.push_back(lengths_of(static_cast<LinkIndex>(l), given[l].first, given[l].second));
  }

  GivenLength length_of(PointIndex first, PointIndex second, Value value) const {
    value.what = "the length " + result_.name(first) + "-" + result_.name(second);
    value.field = "length";
    const Number number = read_number(result_.mechanism, value, Sign::positive);
    return {first, second, amount(number, value), core::to_double(number.value), value.where};
  }

  std::vector<GivenLength> lengths_of(LinkIndex index, const std::optional<Value>& one,
                                      const std::optional<Value>& several) const {
    const Link& link = result_.link(index);
    std::vector<GivenLength> result;
    if (one) {
      if (link.points.size() != 2 || several)
        throw InputError(
            one->where,
            "link " + link.name + " has " + std::to_string(link.points.size()) + " points" +
                (several ? " and both length and lengths" : ", of which one length says too little or nothing"),
            "write lengths: {A-B: ..., ...} for the pairs of its points, or two points");
      result.push_back(length_of(link.points[0], link.points[1], *one));
      return result;
    }
    if (!several) return result;
    for (const Entry& entry : entries(*several)) {
      const std::size_t dash = entry.key.find('-');
      const auto point = [&](const std::string& name) {
        for (const PointIndex candidate : link.points)
          if (result_.name(candidate) == name) return candidate;
        throw InputError(entry.where,
                         "the lengths of link " + link.name + ": '" + entry.key + "' is no pair of its points",
                         "write such as " + result_.name(link.points[0]) + "-" + result_.name(link.points.back()));
      };
      if (dash == std::string::npos) (void)point(entry.key + "-");
      const PointIndex first = point(entry.key.substr(0, dash)), second = point(entry.key.substr(dash + 1));
      if (first == second) (void)point(entry.key);
      result.push_back(length_of(first, second, entry.value));
    }
    return result;
  }

  /// Cables hold nothing, and wheels hold no point of each other.
  void set_cables_and_meshes_apart() {
    Mechanism& m = result_.mechanism;
    result_.cabled.assign(m.links.size(), false);
    const std::vector<Entry> written = entries(required("joints"));
    std::vector<Joint> kept;
    for (std::size_t j = 0; j < m.joints.size(); ++j) {
      Joint& joint = m.joints[j];
      if (joint.meshing) {
        result_.meshes.push_back({std::move(joint), j, teeth_of(m, written.at(j))});
        continue;
      }
      if (!is_cable(joint)) {
        result_.written.push_back(j);
        kept.push_back(std::move(joint));
        continue;
      }
      ++result_.cables;
      for (const LinkIndex link : {joint.from, joint.to})
        if (link != ground) result_.cabled[static_cast<std::size_t>(link)] = true;
    }
    m.joints = std::move(kept);
    for (DrawnMesh& mesh : result_.meshes) {
      mesh.carrier = carrier_of(result_, mesh.joint);
      refuse_phase(written[mesh.written]);
    }
  }

  void refuse_phase(const Entry& gear) const {
    if (!gear.value.node.has("phase") || section("frames")) return;
    throw InputError(gear.where, "joint " + gear.key + " has a phase, but the drawing says how its wheels are turned",
                     "leave the phase out");
  }

  /// Axes as they are written, for the file that is made of the drawing.
  void place_axes() {
    const std::vector<Entry> joints = entries(required("joints"));
    for (const std::size_t place : result_.written) {
      const Entry& entry = joints[place];
      std::vector<Node> nodes;
      for (const Entry& part : entries(entry.value)) {
        if (part.key == "axis") nodes.push_back(part.value.node);
        if (part.key == "axes")
          for (const Value& axis : elements(part.value)) nodes.push_back(axis.node);
      }
      result_.axes.push_back(std::move(nodes));
    }
  }

  const Value& document_;
  PlainSections& plain_;
  std::map<std::string, Value> sections_;
  Drawing result_;
  std::optional<CoordinateReader> coordinates_;
};

}  // namespace

Drawing read_drawing(const Value& document, const std::vector<Override>& overrides, PlainSections& plain) {
  return DrawingReader(document, overrides, plain).take();
}

}  // namespace clearloci::mechanism
