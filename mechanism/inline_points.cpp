#include "mechanism/inline_points.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace clearloci::mechanism {
namespace {

/// What stands under a key of a section's entries: one point, a list of points, a list that begins with one, or
/// entries of their own.
enum class Slot { one, list, first, entries };

using Slots = std::map<std::string, Slot>;

/// By section, whose entries are those of a mapping or of a list.
const std::map<std::string, Slots>& sections() {
  static const std::map<std::string, Slots> table = {
      {"frames", {{"at", Slot::one}}},   {"links", {{"points", Slot::list}, {"masses", Slot::entries}}},
      {"joints", {{"at", Slot::one}}},   {"loads", {{"at", Slot::one}}},
      {"springs", {{"at", Slot::list}}}, {"limits", {{"angle", Slot::list}, {"distance", Slot::list}}}};
  return table;
}

const Slots& slots_of_a_point() {
  static const Slots slots = {
      {"dyad", Slot::list}, {"on", Slot::list}, {"mean", Slot::list}, {"slider", Slot::first}, {"from", Slot::one}};
  return slots;
}

/// The text of a node without its place, to tell what reads alike.
std::string written(const Node& node) {
  if (node.IsScalar()) return node.Scalar();
  std::string text = node.IsMap() ? "{" : "[";
  for (const Node& item : node.items()) text += written(item) + ",";
  for (const auto& [key, content] : node.pairs()) text += written(key) + ":" + written(content) + ",";
  return text + (node.IsMap() ? "}" : "]");
}

class Hoist {
 public:
  explicit Hoist(const Value& document) : document_(document) {
    for (const char* name_of_part : {"points", "drawn"}) {
      const Node points = part(name_of_part);
      for (const auto& [name, form] : points.pairs())
        if (name.IsScalar()) names_.insert(name.Scalar());
    }
  }

  Value run() {
    // A frame stands at points that are known before those in it; the others come where they are needed first. Joints
    // before links, so that a joint's place has the joint's name.
    std::map<std::string, Node> read;
    read.emplace("frames", section("frames"));
    read.emplace("points", points());
    for (const char* name : {"joints", "end_effector", "links", "loads", "springs", "limits"})
      read.emplace(name, section(name));
    if (named_.empty()) return document_;
    read.at("points") = Node::map(std::move(found_), part("points").where());
    std::vector<Node::Pair> pairs;
    for (const auto& [key, content] : document_.node.pairs()) {
      const auto found = key.IsScalar() ? read.find(key.Scalar()) : read.end();
      pairs.emplace_back(key, found == read.end() ? content : found->second);
    }
    if (!document_.node.has("points"))  // of a drawing
      pairs.emplace_back(Node::scalar("points", document_.node.where()), read.at("points"));
    return {Node::map(std::move(pairs), document_.node.where()), document_.what, document_.where};
  }

 private:
  Node part(const std::string& name) const {
    for (const auto& [key, content] : document_.node.pairs())
      if (key.IsScalar() && key.Scalar() == name) return content;
    return {};
  }

  Node points() {
    const Node named = part("points");
    for (const auto& [key, form] : named.pairs()) {
      const Node renamed = entry(form, slots_of_a_point(), key.IsScalar() ? key.Scalar() : "");
      found_.emplace_back(key, renamed);
    }
    return {};
  }

  Node section(const std::string& name) {
    const Node content = part(name);
    if (name == "end_effector") return entry(content, {{"at", Slot::one}}, "E");
    return entries_of(content, sections().at(name), name.substr(0, name.size() - 1));
  }
  Node entries_of(const Node& content, const Slots& slots, const std::string& name) {
    if (content.IsMap()) {
      std::vector<Node::Pair> pairs;
      for (const auto& [key, one] : content.pairs())
        pairs.emplace_back(key, entry(one, slots, key.IsScalar() ? key.Scalar() : name));
      return Node::map(std::move(pairs), content.where());
    }
    if (!content.IsSequence()) return content;
    std::vector<Node> items;
    for (const Node& one : content.items()) items.push_back(entry(one, slots, owner_of(one, name, items.size() + 1)));
    return Node::sequence(std::move(items), content.where());
  }

  /// The name of an entry of a list; where it has none, what it is with its number: "spring1".
  static std::string owner_of(const Node& item, const std::string& kind, std::size_t number) {
    if (item.IsMap())
      for (const auto& [key, content] : item.pairs())
        if (key.IsScalar() && key.Scalar() == "name" && content.IsScalar()) return content.Scalar();
    return kind + std::to_string(number);
  }

  /// `owner` gives the new points their names.
  Node entry(const Node& content, const Slots& slots, const std::string& owner) {
    if (!content.IsMap()) return content;
    std::vector<Node::Pair> pairs;
    for (const auto& [key, value] : content.pairs()) {
      const auto slot = key.IsScalar() ? slots.find(key.Scalar()) : slots.end();
      // A cable has two ends.
      const bool ends = content.has("cable") && key.IsScalar() && key.Scalar() == "at";
      pairs.emplace_back(key, slot == slots.end() ? value : replaced(value, ends ? Slot::list : slot->second, owner));
    }
    return Node::map(std::move(pairs), content.where());
  }

  Node replaced(const Node& value, Slot slot, const std::string& owner) {
    if (slot == Slot::entries) return entries_of(value, {{"at", Slot::one}}, owner);
    if (slot == Slot::one) return name_of_point(value, owner);
    if (!value.IsSequence()) return value;
    std::vector<Node> items = value.items();
    for (std::size_t i = 0; i < items.size() && (slot == Slot::list || i == 0); ++i)
      items[i] = name_of_point(items[i], owner);
    return Node::sequence(std::move(items), value.where());
  }

  /// A name stays; a description becomes a point.
  Node name_of_point(const Node& node, const std::string& owner) {
    if (!node.IsSequence() && !node.IsMap()) return node;
    const Node form = node.IsMap() ? entry(node, slots_of_a_point(), owner) : node;
    const std::string text = written(form);
    auto found = named_.find(text);
    if (found == named_.end()) {
      found = named_.emplace(text, free_name(owner)).first;
      found_.emplace_back(Node::scalar(found->second, node.where()), form);
    }
    return Node::scalar(found->second, node.where());
  }

  /// The owner's name where no point has it: a joint A described at [0, 0] makes a point A.
  std::string free_name(const std::string& owner) {
    std::string name = owner;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_'; },
        '_');
    if (names_.insert(name).second) return name;
    for (int k = 1;; ++k)
      if (std::string numbered = name + "_" + std::to_string(k); names_.insert(numbered).second) return numbered;
  }

  std::set<std::string> names_;               ///< taken
  std::map<std::string, std::string> named_;  ///< by description
  std::vector<Node::Pair> found_;             ///< the points, in order
  const Value& document_;
};

}  // namespace

Value name_inline_points(const Value& document) { return Hoist(document).run(); }

}  // namespace clearloci::mechanism
