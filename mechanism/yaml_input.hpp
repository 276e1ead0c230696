// The YAML tree with its places: every complaint about it becomes a core::InputError that says where, what and how to
// mend it. Private to mechanism/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "mechanism/yaml_tree.hpp"

namespace clearloci::mechanism {

/// A node of the tree. `what` names it in messages: "the mass of link A1B1".
struct Value {
  Node node;
  std::string what;
  core::SourcePosition where;
  std::string field = {};    ///< the key that says what its numbers measure (mechanism/units.hpp)
  std::string example = {};  ///< such as "units: {length: mm}", where it stands under a key that has one

  bool is_scalar() const { return node.IsScalar(); }
  bool is_sequence() const { return node.IsSequence(); }
  bool is_map() const { return node.IsMap(); }
};

/// One `key: value` of a mapping.
struct Entry {
  std::string key;
  core::SourcePosition where;  ///< of the key
  Value value;
};

/// The whole document. Throws for wrong YAML, for an empty text and for several documents in one text.
Value parse_document(const std::string& text, const std::string& file);

/// The entries in the file's order. `what` of a value is its key until the caller says better. Throws where the value
/// is no mapping or a key occurs twice.
std::vector<Entry> entries(const Value& value);

/// The elements of a list. Throws where the value is no list or its length differs from `size` (if >= 0).
std::vector<Value> elements(const Value& value, int size = -1);

/// A scalar's text. Throws for a list, a mapping or nothing.
std::string text_of(const Value& value);

/// Of a file's key format. Throws core::InputError where it is another than is read.
void check_format(const Value& value);

/// `true` or `false`.
bool boolean_of(const Value& value);

/// A mapping with a fixed set of keys.
class Mapping {
 public:
  /// Throws for an unknown key, naming the nearest known one. `what`: "link A1B1". `has_examples`: refusals show what
  /// example_of (mechanism/other_words.hpp) says of the keys.
  Mapping(const Value& value, const std::vector<std::string>& known_keys, bool has_examples = false);

  /// The value under a key, if present; its `what` becomes "the <key> of <mapping>".
  std::optional<Value> find(const std::string& key) const;
  /// The value under a key. Throws where it is missing.
  Value at(const std::string& key) const;
  /// Throws where some of the keys are missing, and names them all.
  void require(const std::vector<std::string>& keys) const;

 private:
  std::string example(const std::string& key) const;

  Value value_;
  bool has_examples_;
  std::vector<Entry> entries_;
};

/// How to mend an unknown name: "did you mean 'A1B1'?", or the list of what is known ("the links are A, B").
/// `listed`: all of them, where only some of these may be meant.
std::string suggest(const std::string& wrong, const std::vector<std::string>& names, const std::string& plural,
                    const std::vector<std::string>& listed = {});

/// "a, b, c".
std::string join(const std::vector<std::string>& names);

}  // namespace clearloci::mechanism
