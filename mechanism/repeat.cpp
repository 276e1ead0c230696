#include "mechanism/repeat.hpp"

#include <algorithm>
#include <cctype>

namespace clearloci::mechanism {
namespace {

using core::InputError;
using core::SourcePosition;

const std::string placeholder = "{i}";

// Copies of copies would fill the memory; a file written out by hand is refused above 4 MB too.
constexpr std::size_t most_values = 100, most_text = std::size_t{4} << 20;

/// One block of `repeat`, with what is left to copy of the text that a file may have.
class Block {
 public:
  Block(const Value& value, const std::vector<std::string>& sections, std::size_t& text_left) : text_left_(text_left) {
    std::vector<std::string> keys = {"i", "table"};
    keys.insert(keys.end(), sections.begin(), sections.end());
    const Mapping mapping(value, keys);
    read_values(mapping.at("i"));
    table_ = mapping.find("table");
    for (const Entry& entry : entries(value))
      if (entry.key != "i" && entry.key != "table") parts_.push_back(entry);
  }

  /// The document's sections, each followed by the copies that belong to it.
  void append_to(std::vector<Node::Pair>& document) const {
    if (table_) append_table(section(document, "parameters", Node::Kind::map, table_->where));
    for (const std::string& value : values_)
      for (const Entry& part : parts_) append_part(document, part, value);
  }

 private:
  struct Section {
    std::vector<Node::Pair> pairs;
    std::vector<Node> items;
  };

  void read_values(Value value) {
    value.what = "i of repeat";
    for (const Value& one : elements(value)) {
      const std::string& text = text_of(one);
      const bool is_word = !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
      });
      if (!is_word)
        throw InputError(one.where, "'" + text + "' cannot be the end of a name", "use letters, digits and _ only");
      if (std::find(values_.begin(), values_.end(), text) != values_.end())
        throw InputError(one.where, value.what + " is " + text + " twice", "write each value once");
      values_.push_back(text);
    }
    if (values_.empty()) throw InputError(value.where, value.what + " has no value", "write such as i: [1, 2, 3]");
    if (values_.size() > most_values)
      throw InputError(value.where, value.what + " has " + std::to_string(values_.size()) + " values",
                       "write 100 at most");
  }

  static SourcePosition place_of(const SourcePosition& where, const std::string& value) {
    SourcePosition place = where;
    place.file += " (i = " + value + ")";
    return place;
  }

  void spend(const SourcePosition& where, std::size_t text) const {
    if (text > text_left_)
      throw InputError(where, "repeat makes more than 4 MB of text", "write fewer values of i or less to repeat");
    text_left_ -= text;
  }

  std::string filled(const Node& node, const std::string& value) const {
    std::string text = node.Scalar();
    for (std::size_t at = text.find(placeholder); at != std::string::npos; at = text.find(placeholder, at)) {
      text.replace(at, placeholder.size(), value);
      at += value.size();
    }
    if (const std::size_t brace = text.find_first_of("{}"); brace != std::string::npos)
      throw InputError(place_of(node.where(), value), "'" + node.Scalar() + "' has a brace that is not that of {i}",
                       "write {i} where the value of i belongs");
    return text;
  }

  Node copy(const Node& node, const std::string& value) const {
    spend(node.where(), 1 + node.Scalar().size() + value.size());
    const SourcePosition where = place_of(node.where(), value);
    if (node.IsScalar()) return Node::scalar(filled(node, value), where);
    if (node.IsNull()) return Node::null(where);
    std::vector<Node> items;
    for (const Node& item : node.items()) items.push_back(copy(item, value));
    if (node.IsSequence()) return Node::sequence(std::move(items), where);
    std::vector<Node::Pair> pairs;
    for (const auto& [key, content] : node.pairs()) pairs.emplace_back(copy(key, value), copy(content, value));
    return Node::map(std::move(pairs), where);
  }

  /// A section of the document, made where it has none, as something that can grow.
  static Node& section(std::vector<Node::Pair>& document, const std::string& name, Node::Kind kind,
                       const SourcePosition& where) {
    const Node empty = kind == Node::Kind::map ? Node::map({}, where) : Node::sequence({}, where);
    for (auto& [key, content] : document) {
      if (!key.IsScalar() || key.Scalar() != name) continue;
      if (content.IsNull()) content = empty;
      if (content.IsMap() != empty.IsMap() || content.IsSequence() != empty.IsSequence())
        throw InputError(where,
                         name + " of repeat are " + (empty.IsMap() ? "a mapping" : "a list") + ", and " + name +
                             " of the file are not",
                         "write both alike");
      return content;
    }
    document.emplace_back(Node::scalar(name, where), empty);
    return document.back().second;
  }

  void append_table(Node& parameters) const {
    std::vector<Node::Pair> pairs = parameters.pairs();
    for (const Entry& row : entries(*table_)) {
      Value list = row.value;
      list.what = "row " + row.key + " of the table";
      const std::vector<Value> cells = elements(list);
      if (cells.size() != values_.size())
        throw InputError(
            list.where,
            list.what + " has " + std::to_string(cells.size()) + " values, but i has " + std::to_string(values_.size()),
            "write one value for each of i");
      for (std::size_t k = 0; k < cells.size(); ++k)
        pairs.emplace_back(Node::scalar(row.key + values_[k], place_of(row.where, values_[k])),
                           copy(cells[k].node, values_[k]));
    }
    parameters = Node::map(std::move(pairs), parameters.where());
  }

  void append_part(std::vector<Node::Pair>& document, const Entry& part, const std::string& value) const {
    if (!part.value.is_map() && !part.value.is_sequence())
      throw InputError(part.value.where, part.value.what + " of repeat is neither a mapping nor a list",
                       "write it as in the file without repeat");
    const bool is_map = part.value.is_map();
    Node& whole = section(document, part.key, is_map ? Node::Kind::map : Node::Kind::sequence, part.where);
    const Node copied = copy(part.value.node, value);
    if (!is_map) {
      std::vector<Node> items = whole.items();
      items.insert(items.end(), copied.items().begin(), copied.items().end());
      whole = Node::sequence(std::move(items), whole.where());
      return;
    }
    for (const Entry& entry : entries(part.value))
      if (entry.key.find(placeholder) == std::string::npos && values_.size() > 1)
        throw InputError(entry.where, "'" + entry.key + "' of repeat would exist once for every i",
                         "write a name with {i}, such as '" + entry.key + "{i}'");
    std::vector<Node::Pair> pairs = whole.pairs();
    pairs.insert(pairs.end(), copied.pairs().begin(), copied.pairs().end());
    whole = Node::map(std::move(pairs), whole.where());
  }

  std::size_t& text_left_;
  std::vector<std::string> values_;
  std::optional<Value> table_;
  std::vector<Entry> parts_;
};

}  // namespace

Value expand_repeat(const Value& document, const std::vector<std::string>& sections) {
  std::optional<Value> repeat;
  std::vector<Node::Pair> pairs;
  for (const Entry& entry : entries(document))
    if (entry.key == "repeat") repeat = entry.value;
  if (!repeat) return document;
  for (const Node::Pair& pair : document.node.pairs())
    if (!pair.first.IsScalar() || pair.first.Scalar() != "repeat") pairs.push_back(pair);
  repeat->what = "repeat";
  std::size_t text_left = most_text;
  const std::vector<Value> blocks = repeat->is_sequence() ? elements(*repeat) : std::vector<Value>{*repeat};
  for (const Value& block : blocks) Block(block, sections, text_left).append_to(pairs);
  return {Node::map(std::move(pairs), document.node.where()), document.what, document.where};
}

InputError told_of_file(const InputError& error, const std::string& file) {
  SourcePosition place = error.position();
  if (place.file.size() <= file.size() || place.file.compare(0, file.size(), file) != 0) return error;
  const std::string of = place.file.substr(file.size());
  place.file = file;
  return {place, error.problem() + of, error.mend()};
}

}  // namespace clearloci::mechanism
