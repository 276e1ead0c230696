#include "mechanism/write_values.hpp"

#include <algorithm>

#include "mechanism/reader.hpp"
#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism {
namespace {

/// Where a line begins.
std::size_t begin_of_line(const std::string& text, int line) {
  std::size_t at = 0;
  for (int i = 1; i < line && at != std::string::npos; ++i) {
    at = text.find('\n', at);
    if (at != std::string::npos) ++at;
  }
  return at;
}

struct Place {
  std::size_t begin = 0, size = 0;
};

/// The value as it stands in the text, its quotes included.
Place place_of(const std::string& text, const Value& value) {
  const std::string& written = value.node.Scalar();
  std::size_t at = begin_of_line(text, value.where.line);
  if (at != std::string::npos) at += static_cast<std::size_t>(std::max(0, value.where.column - 1));
  if (at < text.size() && text.compare(at, written.size(), written) == 0 && !written.empty())
    return {at, written.size()};
  if (at < text.size() && (text[at] == '"' || text[at] == '\'') && text.compare(at + 1, written.size(), written) == 0 &&
      text[at + 1 + written.size()] == text[at])
    return {at, written.size() + 2};
  throw core::InputError(value.where, value.what + " cannot be replaced where it stands",
                         "write it on one line, as a number or an expression");
}

}  // namespace

std::string with_values(std::string text, const std::string& file, const std::vector<Override>& values) {
  const Value document = parse_document(text, file);
  std::vector<std::pair<Place, std::string>> changes;
  const std::vector<Entry> keys = entries(document);
  std::vector<Entry> places;
  for (const Entry& key : keys) {
    if (key.key == "parameters")
      for (Entry& entry : entries(key.value)) places.push_back(std::move(entry));
    if (key.key == "joints")
      for (Entry& effort : written_free_efforts(key.value)) places.push_back(std::move(effort));
  }
  for (const auto& [name, value] : values) {
    bool found = false;
    for (const Entry& place : places)
      if (place.key == name) {
        changes.emplace_back(place_of(text, place.value), value);
        found = true;
      }
    if (!found)
      throw core::InputError({file}, "there is no parameter '" + name + "' in the file", "vary one that it has");
  }
  // From the last on, so that places stay.
  std::sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) { return a.first.begin > b.first.begin; });
  for (const auto& [place, value] : changes) text.replace(place.begin, place.size, value);
  return text;
}

}  // namespace clearloci::mechanism
