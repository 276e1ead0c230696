#include "mechanism/yaml_input.hpp"

#include <algorithm>
#include <map>

#include "mechanism/other_words.hpp"
#include "mechanism/units.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using core::SourcePosition;

// Of one mapping (points, links, parameters) and one list (a path): more is no mechanism that a person describes.
constexpr std::size_t most_entries = 1000, longest_list = 10000;

std::string kind_of(const Node& node) {
  if (node.IsMap()) return "a mapping";
  if (node.IsSequence()) return "a list";
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  return "nothing";
}

/// Number of insertions, deletions, replacements and swaps of neighbours that turn a into b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1, 0));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// "write it such as units: {length: mm}", where there is an example.
std::string form_of(const Value& value, const std::string& otherwise) {
  return value.example.empty() ? otherwise : "write it such as " + value.example;
}

/// "write it as {radial: ...}; its keys are radial, angular".
std::string form_with(const std::vector<std::string>& keys) {
  return "write it as {" + keys.front() + ": ...}" + (keys.size() > 1 ? "; its keys are " + join(keys) : "");
}

std::vector<Entry> entries_of(const Value& value, const std::string& form) {
  if (!value.is_map())
    throw InputError(value.where, value.what + " should be a mapping, not " + kind_of(value.node),
                     form_of(value, form));
  if (value.node.size() > most_entries)
    throw InputError(value.where, value.what + " has " + std::to_string(value.node.size()) + " entries",
                     "write 1000 at most");
  std::vector<Entry> result;
  std::map<std::string, SourcePosition> first;
  for (const auto& [name, content] : value.node.pairs()) {
    const SourcePosition& where = name.where();
    if (!name.IsScalar()) throw InputError(where, "a key of " + value.what + " is no name", "write a name");
    const std::string& key = name.Scalar();
    const auto [earlier, is_new] = first.emplace(key, where);
    if (!is_new)
      throw InputError(
          where,
          "'" + key + "' is there twice in " + value.what + ": first in line " + std::to_string(earlier->second.line),
          "rename or remove one of them");
    // An empty value has no place of its own.
    const SourcePosition& place = content.IsNull() ? where : content.where();
    result.push_back({key, where, {content, "'" + key + "'", place, value.field}});
  }
  return result;
}

}  // namespace

Value parse_document(const std::string& text, const std::string& file) {
  const Node document = load_document(text, file);
  return {document, "the file", document.where()};
}

std::vector<Entry> entries(const Value& value) { return entries_of(value, "write it as name: value"); }

std::vector<Value> elements(const Value& value, int size) {
  const std::string wanted = size < 0 ? "a list" : "a list of " + std::to_string(size);
  if (!value.is_sequence())
    throw InputError(value.where, value.what + " should be " + wanted + ", not " + kind_of(value.node),
                     form_of(value, "write it in brackets: [ , ]"));
  if (size >= 0 && static_cast<int>(value.node.size()) != size)
    throw InputError(value.where, value.what + " should be " + wanted + ", not of " + std::to_string(value.node.size()),
                     "write " + std::to_string(size) + " entries in the brackets");
  if (value.node.size() > longest_list)
    throw InputError(value.where, value.what + " has " + std::to_string(value.node.size()) + " entries",
                     "write 10000 at most");
  std::vector<Value> result;
  for (const Node& element : value.node.items()) result.push_back({element, value.what, element.where(), value.field});
  return result;
}

std::string text_of(const Value& value) {
  if (value.node.IsNull()) throw InputError(value.where, value.what + " is empty", "write its value or remove its key");
  if (!value.is_scalar())
    throw InputError(value.where, value.what + " should be a single value, not " + kind_of(value.node),
                     "write one name or expression");
  return value.node.Scalar();
}

void check_format(const Value& value) {
  const std::string text = text_of(value);
  if (text != "1")
    throw InputError(value.where, "the format is '" + text + "', but this version reads format 1", "write format: 1");
}

bool boolean_of(const Value& value) {
  const std::string text = text_of(value);
  if (text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "false" || text == "False" || text == "FALSE") return false;
  throw InputError(value.where, value.what + " is neither true nor false but '" + text + "'", "write true or false");
}

Mapping::Mapping(const Value& value, const std::vector<std::string>& known_keys, bool has_examples)
    : value_(value), has_examples_(has_examples), entries_(entries_of(value, form_with(known_keys))) {
  std::vector<std::string> left = known_keys;  // to be meant by another word
  std::erase_if(left, [&](const std::string& key) {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
  });
  for (const Entry& entry : entries_) {
    if (std::find(known_keys.begin(), known_keys.end(), entry.key) == known_keys.end())
      throw InputError(entry.where, "unknown key '" + entry.key + "' in " + value.what,
                       suggest(entry.key, left.empty() ? known_keys : left, "keys", known_keys));
  }
}

std::optional<Value> Mapping::find(const std::string& key) const {
  for (const Entry& entry : entries_) {
    if (entry.key != key) continue;
    Value found = entry.value;
    if (is_field(key)) found.field = key;
    if (has_examples_) found.example = example(key);
    found.what = value_.what == "the file" ? "'" + key + "'" : "the " + key + " of " + value_.what;
    return found;
  }
  return std::nullopt;
}

std::string Mapping::example(const std::string& key) const {
  const std::optional<std::string> example = has_examples_ ? example_of(key) : std::nullopt;
  return key + ": " + example.value_or(key == "format" ? "1" : "...");
}

Value Mapping::at(const std::string& key) const {
  if (auto found = find(key)) return *found;
  throw InputError(value_.where, "the key '" + key + "' is missing in " + value_.what, "add " + example(key));
}

void Mapping::require(const std::vector<std::string>& keys) const {
  std::vector<std::string> missing;
  for (const std::string& key : keys)
    if (!find(key)) missing.push_back(key);
  if (missing.empty()) return;
  if (missing.size() == 1) (void)at(missing.front());
  throw InputError(value_.where, "the keys " + join(missing) + " are missing in " + value_.what,
                   "add " + example(missing.front()) + " and the others");
}

std::string suggest(const std::string& wrong, const std::vector<std::string>& names, const std::string& plural,
                    const std::vector<std::string>& listed) {
  if (names.empty()) return "there are no " + plural;
  const auto distance = [&wrong](const std::string& name) {
    return edit_distance(lower_case(wrong), lower_case(name));
  };
  const auto nearest = std::min_element(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return distance(a) < distance(b);
  });
  const std::size_t limit = std::max<std::size_t>(1, nearest->size() / 3);
  if (wrong.size() > 1 && distance(*nearest) <= limit) return "did you mean '" + *nearest + "'?";
  if (plural == "keys")
    if (const auto instead = what_to_write_for(wrong, names)) return *instead;
  return "the " + plural + " are " + join(listed.empty() ? names : listed);
}

std::string join(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace clearloci::mechanism
