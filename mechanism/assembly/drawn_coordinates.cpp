#include "mechanism/assembly/drawn_coordinates.hpp"

#include <algorithm>
#include <array>

#include "mechanism/reader.hpp"

namespace clearloci::mechanism {

using core::InputError;
using CoordinateKind = DrawnCoordinate::Kind;

Node text_node(const std::string& text, const core::SourcePosition& where) { return Node::scalar(text, where); }

namespace {

Node list_node(const std::vector<std::string>& texts, const core::SourcePosition& where) {
  std::vector<Node> items;
  for (const std::string& text : texts) items.push_back(text_node(text, where));
  return Node::sequence(std::move(items), where);
}

}  // namespace

CoordinateReader::CoordinateReader(const std::optional<Value>& workspace, const Value& joints,
                                   const core::SourcePosition& file, Drawing& drawing)
    : drawing_(drawing), file_(file) {
  std::vector<Node::Pair> pairs;
  if (!workspace || workspace->node.IsNull()) {
    add_motors(joints, pairs);
  } else {
    for (const Entry& entry : entries(*workspace)) {
      written_.push_back(entry);
      pairs.emplace_back(text_node(entry.key, entry.where), plain_coordinate(entry));
    }
  }
  workspace_ = Node::map(std::move(pairs), workspace ? workspace->where : file);
}

std::size_t CoordinateReader::axis_of(const std::string& name) {
  static const std::array<std::string, 3> names = {"x", "y", "z"};
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::optional<std::pair<std::string, std::string>> CoordinateReader::place_of(std::size_t coordinate) const {
  if (drawing_.coordinates[coordinate].kind != CoordinateKind::place) return std::nullopt;
  std::pair<std::string, std::string> place;
  for (const Entry& part : entries(written_[coordinate].value)) {
    if (part.key == "place") place.first = text_of(part.value);
    if (part.key == "of") place.second = text_of(part.value);
  }
  return place;
}

void CoordinateReader::resolve() const {
  for (std::size_t c = 0; c < drawing_.coordinates.size(); ++c) resolve(drawing_.coordinates[c], written_[c].value);
  check_order_of_turns();
}

Node CoordinateReader::plain_coordinate(const Entry& entry) {
  DrawnCoordinate& coordinate = drawing_.coordinates.emplace_back();
  coordinate.name = entry.key;
  coordinate.where = entry.where;
  if (!entry.value.is_map()) return entry.value.node;
  Value value = entry.value;
  value.what = "coordinate " + entry.key;
  const auto range_of = [&](const Mapping& mapping, const char* key) {
    Value range = mapping.at(key);
    (void)elements(range, 2);
    return range.node;
  };
  const auto angle = [&](const Node& range) {
    return Node::map({{text_node("angle", entry.where), range}}, entry.value.where);
  };
  if (value.node.has("place")) {
    coordinate.kind = CoordinateKind::place;
    return range_of(Mapping(value, {"place", "of", "within"}), "within");
  }
  if (value.node.has("stroke")) {
    coordinate.kind = CoordinateKind::stroke;
    return range_of(Mapping(value, {"stroke", "of"}), "stroke");
  }
  if (value.node.has("turn")) {
    coordinate.kind = CoordinateKind::turn;
    return angle(range_of(Mapping(value, {"turn", "of", "within"}), "within"));
  }
  if (!value.node.has("of")) return entry.value.node;
  coordinate.kind = CoordinateKind::direction;
  return angle(range_of(Mapping(value, {"angle", "of"}), "angle"));
}

void CoordinateReader::add_motors(const Value& joints, std::vector<Node::Pair>& pairs) {
  for (const Entry& entry : entries(joints)) {
    if (!entry.value.is_map()) continue;
    bool actuated = false;
    std::string type;
    Node links;
    for (const Entry& part : entries(entry.value)) {
      if (part.key == "actuated" && part.value.is_scalar()) actuated = boolean_of(part.value);
      if (part.key == "revolute" || part.key == "prismatic" || part.key == "cylindrical") {
        type = part.key;
        links = part.value.node;
      }
    }
    if (!actuated) continue;
    if (type != "revolute")
      throw InputError(entry.where, "the motor " + entry.key + " is a coordinate without a range",
                       "write workspace: {" + entry.key + ": {stroke: [least, greatest], of: " + entry.key + "}}");
    DrawnCoordinate& coordinate = drawing_.coordinates.emplace_back();
    coordinate.name = entry.key;
    coordinate.where = entry.where;
    coordinate.kind = CoordinateKind::direction;
    written_.push_back(
        {entry.key,
         entry.where,
         {Node::map({{text_node("of", entry.where), links}}, entry.where), "coordinate " + entry.key, entry.where}});
    pairs.emplace_back(
        text_node(entry.key, entry.where),
        Node::map({{text_node("angle", entry.where), list_node({"0", "360 deg"}, entry.where)}}, entry.where));
  }
  if (pairs.empty())
    throw InputError(file_, "there is no workspace, and no joint is actuated",
                     "write workspace: {theta: {angle: [0, 360 deg], of: a link}}, or actuated: true at a joint");
}

LinkIndex CoordinateReader::link_named(const Value& value, const DrawnCoordinate& coordinate, bool or_ground) const {
  Value name = value;
  name.what = "coordinate " + coordinate.name;
  const LinkIndex link = read_link_name(drawing_.mechanism, name, or_ground);
  if (link != ground && drawing_.mechanism.space == Space::planar && drawing_.link(link).points.size() < 2)
    throw InputError(value.where,
                     "coordinate " + coordinate.name + " is the direction of link " + drawing_.link(link).name +
                         ", which has a single point",
                     "name a link of two points, or add a second point to it");
  return link;
}

void CoordinateReader::resolve(DrawnCoordinate& coordinate, const Value& written) const {
  if (coordinate.kind == CoordinateKind::plain) return;
  Value value = written;
  value.what = "coordinate " + coordinate.name;
  const Mapping mapping(value, {"angle", "place", "stroke", "turn", "of", "within"});
  Value of = mapping.at("of");
  if (coordinate.kind == CoordinateKind::direction) {
    if (of.is_sequence()) {
      const std::vector<Value> pair = elements(of, 2);
      coordinate.other = link_named(pair[0], coordinate, true);
      coordinate.link = link_named(pair[1], coordinate, true);
      if (coordinate.link == ground) std::swap(coordinate.link, coordinate.other);
      if (coordinate.link == coordinate.other)
        throw InputError(of.where, "coordinate " + coordinate.name + " is the angle of a link from itself",
                         "name two different links");
    } else {
      coordinate.link = link_named(of, coordinate, false);
    }
  } else if (coordinate.kind == CoordinateKind::place) {
    const Value axis = mapping.at("place");
    coordinate.axis = axis_of(text_of(axis));
    if (coordinate.axis >= dimension(drawing_.mechanism))
      throw InputError(axis.where, "coordinate " + coordinate.name + ": the place is '" + text_of(axis) + "'",
                       dimension(drawing_.mechanism) == 2 ? "write place: x or y" : "write place: x, y or z");
    coordinate.point = read_point_name(drawing_.mechanism, of);
  } else if (coordinate.kind == CoordinateKind::stroke) {
    coordinate.joint = joint_named(of, coordinate);
  } else {
    coordinate.link = link_named(of, coordinate, false);
    read_turn(mapping.at("turn"), coordinate);
  }
}

JointIndex CoordinateReader::joint_named(const Value& of, const DrawnCoordinate& coordinate) const {
  std::vector<std::string> allowed;
  for (std::size_t j = 0; j < drawing_.mechanism.joints.size(); ++j) {
    const Joint& joint = drawing_.mechanism.joints[j];
    if (joint.type != JointType::prismatic && joint.type != JointType::cylindrical) continue;
    if (joint.name == text_of(of)) return static_cast<JointIndex>(j);
    allowed.push_back(joint.name);
  }
  throw InputError(of.where, "coordinate " + coordinate.name + ": there is no prismatic joint '" + text_of(of) + "'",
                   suggest(text_of(of), allowed, "prismatic joints"));
}

void CoordinateReader::read_turn(const Value& turn, DrawnCoordinate& coordinate) {
  const std::string text = text_of(turn);
  std::string sorted = text.substr(0, 3);
  std::sort(sorted.begin(), sorted.end());
  if (text.size() != 5 || sorted != "xyz" || text[3] != '.' || text[4] < '1' || text[4] > '3')
    throw InputError(turn.where, "coordinate " + coordinate.name + ": the turn is '" + text + "'",
                     "write such as turn: zyx.1, the first angle of the order z, y, x");
  coordinate.order = text.substr(0, 3);
  coordinate.axis = static_cast<std::size_t>(text[4] - '1');
}

void CoordinateReader::check_order_of_turns() const {
  for (const DrawnCoordinate& coordinate : drawing_.coordinates) {
    if (coordinate.kind != CoordinateKind::turn) continue;
    if (!drawing_.is_spatial())
      throw InputError(coordinate.where,
                       "coordinate " + coordinate.name + " is a turn in space, but the mechanism is planar",
                       "write {angle: [...], of: " + drawing_.name_of(coordinate.link) + "}");
    for (const DrawnCoordinate& other : drawing_.coordinates)
      if (other.kind == CoordinateKind::turn && other.link == coordinate.link && other.order != coordinate.order)
        throw InputError(other.where,
                         "coordinates " + coordinate.name + " and " + other.name + " turn link " +
                             drawing_.name_of(coordinate.link) + " in two orders",
                         "write one order for all of its angles");
  }
}

}  // namespace clearloci::mechanism
