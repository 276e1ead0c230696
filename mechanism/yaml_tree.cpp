#include "mechanism/yaml_tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

namespace clearloci::mechanism {
namespace {

using core::InputError;
using core::SourcePosition;

// No text that a person writes comes near; brackets in brackets would take the stack when the tree is left.
constexpr std::size_t deepest_nesting = 200;

SourcePosition position(const YAML::Mark& mark, const std::string& file) {
  if (mark.is_null()) return {file, 0, 0};
  return {file, mark.line + 1, mark.column + 1};
}

/// Builds the tree of one document from what the parser finds. YAML::LoadAll never ends on a text that begins with a
/// stray comma: it reads one empty document after the other, so the parser is asked for one document at a time.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const std::string& file) : file_(file) {}

  std::optional<Node> root;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& at, YAML::anchor_t anchor) override { add(Node::null(position(at, file_)), anchor); }
  void OnAlias(const YAML::Mark& at, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end())
      throw InputError(position(at, file_), "this part of the file contains itself", "write it out without the alias");
    add(found->second, 0);
  }
  void OnScalar(const YAML::Mark& at, const std::string& tag, YAML::anchor_t anchor, const std::string& text) override {
    SourcePosition where = position(at, file_);
    if (tag == "!") ++where.column;  // marked at its quote
    add(Node::scalar(text, std::move(where)), anchor);
  }
  void OnSequenceStart(const YAML::Mark& at, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(at, anchor, false);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& at, const std::string&, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    open(at, anchor, true);
  }
  void OnMapEnd() override { close(); }

 private:
  /// A sequence or map of which the end has not come: of a map keys and values in turn.
  struct Open {
    SourcePosition where;
    YAML::anchor_t anchor;
    bool is_map;
    std::vector<Node> parts = {};
  };

  void add(const Node& node, YAML::anchor_t anchor) {
    if (anchor != 0) anchors_.insert_or_assign(anchor, node);
    if (open_.empty())
      root = node;
    else
      open_.back().parts.push_back(node);
  }

  void open(const YAML::Mark& at, YAML::anchor_t anchor, bool is_map) {
    if (open_.size() >= deepest_nesting)
      throw InputError(position(at, file_), "not YAML: brackets nested more than 200 deep", "write it in fewer levels");
    open_.push_back({position(at, file_), anchor, is_map});
  }

  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    if (!done.is_map) {
      add(Node::sequence(std::move(done.parts), std::move(done.where)), done.anchor);
      return;
    }
    std::vector<Node::Pair> pairs;
    for (std::size_t i = 0; i + 1 < done.parts.size(); i += 2) pairs.emplace_back(done.parts[i], done.parts[i + 1]);
    add(Node::map(std::move(pairs), std::move(done.where)), done.anchor);
  }

  const std::string& file_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Node> anchors_;
};

/// In a line with {i}, which YAML takes for a mapping within brackets, the mend is another one.
std::string mend_of(const std::string& text, int line) {
  std::istringstream lines(text);
  std::string one;
  for (int k = 0; k <= line; ++k) std::getline(lines, one);
  if (one.find("{i}") != std::string::npos) return "in brackets put quotes round what holds {i}: ['x{i}', 'y{i}']";
  return "check brackets, colons and indentation at this place";
}

}  // namespace

Node::Node() : Node(std::make_shared<const Content>()) {}
Node::Node(std::string text) : Node(scalar(std::move(text), {})) {}

Node Node::null(SourcePosition where) {
  return Node(std::make_shared<const Content>(Content{.kind = Kind::null, .where = std::move(where)}));
}

Node Node::scalar(std::string text, SourcePosition where) {
  return Node(std::make_shared<const Content>(
      Content{.kind = Kind::scalar, .where = std::move(where), .text = std::move(text)}));
}

Node Node::sequence(std::vector<Node> items, SourcePosition where) {
  return Node(std::make_shared<const Content>(
      Content{.kind = Kind::sequence, .where = std::move(where), .items = std::move(items)}));
}

Node Node::map(std::vector<Pair> pairs, SourcePosition where) {
  return Node(std::make_shared<const Content>(
      Content{.kind = Kind::map, .where = std::move(where), .pairs = std::move(pairs)}));
}

bool Node::has(const std::string& key) const {
  return std::any_of(pairs().begin(), pairs().end(),
                     [&key](const Pair& pair) { return pair.first.IsScalar() && pair.first.Scalar() == key; });
}

Node load_document(const std::string& text, const std::string& file) {
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    TreeBuilder first(file), second(file);
    if (!parser.HandleNextDocument(first))
      throw InputError({file, 1, 1}, "the file is empty", "start with the line format: 1");
    if (!first.root || first.root->IsNull())
      throw InputError(first.root ? first.root->where() : SourcePosition{file, 0, 0},
                       "no mechanism can be read from here", "start with the line format: 1");
    if (parser.HandleNextDocument(second))
      throw InputError(second.root ? second.root->where() : SourcePosition{file, 0, 0}, "a second document in the file",
                       "remove the line --- and keep one mechanism a file");
    return *first.root;
  } catch (const YAML::Exception& error) {
    throw InputError(position(error.mark, file), "not YAML: " + error.msg, mend_of(text, error.mark.line));
  }
}

}  // namespace clearloci::mechanism
