#include "mechanism/redundant_rods.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using core::SourcePosition;
using Pairs = std::vector<Node::Pair>;

const Node* part_of(const Node& map, const std::string& key) {
  for (const auto& [name, content] : map.pairs())
    if (name.IsScalar() && name.Scalar() == key) return &content;
  return nullptr;
}

struct Rod {
  std::string name, first, second;  ///< with the names of its points
  SourcePosition where;
  std::optional<Node> within = {};
};

[[noreturn]] void refuse(const Rod& rod, const std::string& what) {
  throw InputError(rod.where, "the redundant rod " + rod.name + " " + what,
                   "write redundant: true at a link of two points with one joint at each");
}

Node text(const std::string& word, const SourcePosition& where) { return Node::scalar(word, where); }

Node list(const std::string& first, const std::string& second, const SourcePosition& where) {
  return Node::sequence({text(first, where), text(second, where)}, where);
}

/// `link` without the key; the rod where it says true, or {within: [least, most]}.
std::optional<Rod> marked(const std::string& name, const SourcePosition& where, Node& link) {
  if (!link.IsMap()) return std::nullopt;
  const Node* const mark = part_of(link, "redundant");
  if (mark == nullptr) return std::nullopt;
  Rod rod{name, {}, {}, where};
  bool is_marked = true;
  if (mark->IsMap()) {
    const Mapping keys({*mark, "the mark of redundant rod " + name, mark->where()}, {"within"});
    rod.within = keys.at("within").node;
  } else {
    is_marked = boolean_of({*mark, "redundant of link " + name, mark->where()});
  }
  Pairs kept;
  for (const auto& [key, content] : link.pairs())
    if (!key.IsScalar() || key.Scalar() != "redundant") kept.emplace_back(key, content);
  const Node* const points = part_of(link, "points");
  if (is_marked && (points == nullptr || !points->IsSequence() || points->size() != 2 ||
                    !points->items()[0].IsScalar() || !points->items()[1].IsScalar()))
    refuse(rod, "has not two points");
  if (is_marked) {
    rod.first = points->items()[0].Scalar();
    rod.second = points->items()[1].Scalar();
  }
  link = Node::map(std::move(kept), link.where());
  return is_marked ? std::optional(rod) : std::nullopt;
}

/// A joint of the rod: at one of its points, of one that turns. At the second point it is of the end there.
bool is_of(const Node& joint, const Rod& rod, const std::string& point) {
  if (!joint.IsMap()) return false;
  const Node* const at = part_of(joint, "at");
  if (at == nullptr || !at->IsScalar() || at->Scalar() != point) return false;
  for (const char* type : {"revolute", "spherical", "universal"})
    if (const Node* const links = part_of(joint, type); links != nullptr && links->IsSequence())
      return std::any_of(links->items().begin(), links->items().end(),
                         [&](const Node& link) { return link.IsScalar() && link.Scalar() == rod.name; });
  return false;
}

std::string end_of(const Rod& rod) { return rod.name + "_end"; }

Node of_end(const Node& joint, const Rod& rod) {
  Pairs keys;
  for (const auto& [key, content] : joint.pairs()) {
    if (!content.IsSequence() || !key.IsScalar() || key.Scalar() == "axes" || key.Scalar() == "axis") {
      keys.emplace_back(key, content);
      continue;
    }
    std::vector<Node> items = content.items();
    for (Node& item : items)
      if (item.IsScalar() && item.Scalar() == rod.name) item = text(end_of(rod), item.where());
    keys.emplace_back(key, Node::sequence(std::move(items), content.where()));
  }
  return Node::map(std::move(keys), joint.where());
}

/// The telescope: its actuator pulls the end towards the rest of the rod.
Node telescope(const Rod& rod) {
  Pairs actuator = {{text("effort", rod.where), text("free", rod.where)}};
  if (rod.within) actuator.emplace_back(text("within", rod.where), *rod.within);
  return Node::map({{text("prismatic", rod.where), list(rod.name, end_of(rod), rod.where)},
                    {text("at", rod.where), text(rod.second, rod.where)},
                    {text("axis", rod.where), list(rod.second, rod.first, rod.where)},
                    {text("actuated", rod.where), Node::map(std::move(actuator), rod.where)}},
                   rod.where);
}

void add_end(const Rod& rod, Pairs& links, Pairs& joints) {
  std::size_t first = 0, second = 0;
  for (auto& [key, joint] : joints) {
    if (is_of(joint, rod, rod.first)) ++first;
    if (!is_of(joint, rod, rod.second)) continue;
    ++second;
    joint = of_end(joint, rod);
  }
  if (first != 1 || second != 1) refuse(rod, "has not one joint at either point that turns");
  Node points = Node::sequence({text(rod.second, rod.where)}, rod.where);
  links.emplace_back(text(end_of(rod), rod.where),
                     Node::map({{text("points", rod.where), std::move(points)}}, rod.where));
  joints.emplace_back(text(rod.name, rod.where), telescope(rod));
}

}  // namespace

Value telescoped_rods(const Value& document) {
  if (!document.is_map()) return document;
  const Node* const written_links = part_of(document.node, "links");
  const Node* const written_joints = part_of(document.node, "joints");
  if (written_links == nullptr || written_joints == nullptr || !written_links->IsMap() || !written_joints->IsMap())
    return document;
  Pairs links = written_links->pairs(), joints = written_joints->pairs();
  std::vector<Rod> rods;
  bool any = false;
  for (auto& [key, link] : links) {
    any = any || (link.IsMap() && part_of(link, "redundant") != nullptr);
    if (auto rod = marked(key.Scalar(), key.where(), link)) rods.push_back(std::move(*rod));
  }
  if (!any) return document;
  for (const Rod& rod : rods) add_end(rod, links, joints);
  Pairs sections;
  for (const auto& [key, content] : document.node.pairs()) {
    const std::string name = key.Scalar();
    sections.emplace_back(key, name == "links"    ? Node::map(links, content.where())
                               : name == "joints" ? Node::map(joints, content.where())
                                                  : content);
  }
  return {Node::map(std::move(sections), document.node.where()), document.what, document.where, document.field};
}

}  // namespace clearloci::mechanism
