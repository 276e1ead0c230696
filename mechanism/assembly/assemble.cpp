#include "mechanism/assembly/assemble.hpp"

#include <algorithm>

#include "mechanism/assembly/construction.hpp"

namespace clearloci::mechanism {
namespace {

Node merged(const Node& old, const std::vector<WrittenPoint>& more, const core::SourcePosition& where) {
  std::vector<Node::Pair> pairs = old.pairs();
  for (const WrittenPoint& point : more) pairs.emplace_back(Node::scalar(point.name, where), point.form);
  return Node::map(std::move(pairs), where);
}

/// Nodes that the construction made have no place: it is that of what they are found for.
Node placed(const Node& node, const core::SourcePosition& where) {
  const core::SourcePosition& position = node.where().line > 0 ? node.where() : where;
  if (node.IsScalar()) return Node::scalar(node.Scalar(), position);
  if (node.IsSequence()) {
    std::vector<Node> items;
    for (const Node& item : node.items()) items.push_back(placed(item, where));
    return Node::sequence(std::move(items), position);
  }
  if (!node.IsMap()) return node;
  std::vector<Node::Pair> pairs;
  for (const auto& [key, content] : node.pairs()) pairs.emplace_back(placed(key, where), placed(content, where));
  return Node::map(std::move(pairs), position);
}

Node points_of(const FoundConstruction& found, const Drawing& drawing, const core::SourcePosition& where) {
  std::vector<Node::Pair> pairs;
  for (const WrittenPoint& written_point : found.points) {
    core::SourcePosition place = where;
    for (const Point& point : drawing.mechanism.points)
      if (point.name == written_point.name) place = point.where;
    pairs.emplace_back(Node::scalar(written_point.name, place), placed(written_point.form, place));
  }
  return Node::map(std::move(pairs), where);
}

Node joints_of(const Node& joints, const std::vector<std::size_t>& written, const FoundConstruction& found) {
  std::vector<Node::Pair> pairs = joints.pairs();
  for (const auto& [place, distance] : found.distances) {
    Node& gear = pairs[place].second;
    if (gear.has("distance")) continue;
    std::vector<Node::Pair> keys = gear.pairs();
    keys.emplace_back(Node::scalar("distance", gear.where()), Node::scalar(distance, gear.where()));
    gear = Node::map(std::move(keys), gear.where());
  }
  for (const auto& [index, texts] : found.axes) {
    Node& joint = pairs[written[static_cast<std::size_t>(index)]].second;
    std::vector<Node::Pair> keys = joint.pairs();
    for (auto& [key, content] : keys) {
      if (key.Scalar() == "axis") content = Node::scalar(texts.front(), content.where());
      if (key.Scalar() != "axes") continue;
      std::vector<Node> items = content.items();
      for (std::size_t i = 0; i < items.size() && i < texts.size(); ++i)
        if (!texts[i].empty()) items[i] = Node::scalar(texts[i], items[i].where());
      content = Node::sequence(std::move(items), content.where());
    }
    joint = Node::map(std::move(keys), joint.where());
  }
  return Node::map(std::move(pairs), joints.where());
}

}  // namespace

bool is_drawn(const Value& document) { return document.node.has("drawn"); }

Assembled assemble(const Value& document, const std::vector<Override>& overrides) {
  PlainSections plain;
  Drawing drawing = read_drawing(document, overrides, plain);
  check_drawing(drawing);
  close_loops(drawing);
  const FoundConstruction found = drawing.is_spatial() ? construct_in_space(drawing) : construct_in_plane(drawing);
  Assembled result;
  result.notes = drawing.mechanism.notes;
  for (const WrittenPoint& point : found.points)
    if (!point.comment.empty()) result.comments[point.name] = point.comment;
  std::vector<Node::Pair> pairs;
  bool has_frames = false, has_workspace = false;
  core::SourcePosition where = document.where;
  for (const auto& [key, content] : document.node.pairs()) {
    const std::string name = key.Scalar();
    if (name == "drawn") where = key.where();
  }
  for (const auto& [key, content] : document.node.pairs()) {
    const std::string name = key.Scalar();
    if (name == "points") continue;
    if (name == "drawn") {
      if (!found.frames.empty() && !document.node.has("frames"))
        pairs.emplace_back(Node::scalar("frames", where), merged(Node::map({}, where), found.frames, where));
      pairs.emplace_back(Node::scalar("points", where), points_of(found, drawing, where));
    } else if (name == "workspace") {
      has_workspace = true;
      pairs.emplace_back(key, plain.workspace);
    } else if (name == "links") {
      pairs.emplace_back(key, plain.links);
    } else if (name == "joints") {
      pairs.emplace_back(key, joints_of(content, drawing.written, found));
    } else if (name == "frames") {
      has_frames = true;
      pairs.emplace_back(key, merged(content, found.frames, content.where()));
    } else {
      pairs.emplace_back(key, content);
    }
  }
  (void)has_frames;
  if (!has_workspace) pairs.emplace_back(Node::scalar("workspace", where), plain.workspace);
  result.document = {Node::map(std::move(pairs), document.node.where()), document.what, document.where};
  return result;
}

}  // namespace clearloci::mechanism
