// The tree of a YAML text, each node with its place. The library's own nodes lose their place when they are copied, and
// `repeat` copies parts of the tree. Private to mechanism/.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"

namespace clearloci::mechanism {

/// A node, shared where the text has an alias. Immutable.
class Node {
 public:
  enum class Kind { null, scalar, sequence, map };
  using Pair = std::pair<Node, Node>;

  Node();                           ///< nothing, at no place
  explicit Node(std::string text);  ///< a scalar at no place
  static Node null(core::SourcePosition where);
  static Node scalar(std::string text, core::SourcePosition where);
  static Node sequence(std::vector<Node> items, core::SourcePosition where);
  static Node map(std::vector<Pair> pairs, core::SourcePosition where);

  bool IsNull() const;
  bool IsScalar() const;
  bool IsSequence() const;
  bool IsMap() const;
  const std::string& Scalar() const;  ///< empty unless a scalar
  /// Of a sequence, and of a map in the text's order. Not of a temporary: a loop over them would outlive the node.
  const std::vector<Node>& items() const&;
  const std::vector<Node>& items() && = delete;
  const std::vector<Pair>& pairs() const&;
  const std::vector<Pair>& pairs() && = delete;
  std::size_t size() const;                ///< of items or pairs
  bool has(const std::string& key) const;  ///< a map with this key
  /// Of a scalar its text, within the quotes if it has any.
  const core::SourcePosition& where() const;

 private:
  struct Content;
  explicit Node(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

  std::shared_ptr<const Content> content_;
};

struct Node::Content {
  Kind kind = Kind::null;
  core::SourcePosition where = {};
  std::string text = {};
  std::vector<Node> items = {};
  std::vector<Pair> pairs = {};
};

inline bool Node::IsNull() const { return content_->kind == Kind::null; }
inline bool Node::IsScalar() const { return content_->kind == Kind::scalar; }
inline bool Node::IsSequence() const { return content_->kind == Kind::sequence; }
inline bool Node::IsMap() const { return content_->kind == Kind::map; }
inline const std::string& Node::Scalar() const { return content_->text; }
inline const std::vector<Node>& Node::items() const& { return content_->items; }
inline const std::vector<Node::Pair>& Node::pairs() const& { return content_->pairs; }
inline std::size_t Node::size() const { return content_->items.size() + content_->pairs.size(); }
inline const core::SourcePosition& Node::where() const { return content_->where; }

/// The one document of a text. Throws core::InputError for wrong YAML, for an empty text, for several documents, and
/// for a node that contains itself.
Node load_document(const std::string& text, const std::string& file);

}  // namespace clearloci::mechanism
