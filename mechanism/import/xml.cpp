#include "mechanism/import/xml.hpp"

#include <algorithm>
#include <cctype>
#include <pugixml.hpp>

#include "core/errors.hpp"
#include "mechanism/import/formats.hpp"

namespace clearloci::mechanism::imports {
namespace {

using core::InputError;

constexpr int deepest = 200;
constexpr std::size_t most_elements = 200000;

/// White space before an attribute that follows a quote at once: `zoom="1"xoffset="81"`, as programs have written it.
/// As many letters as before: the space takes the place of nothing, so lines stay.
std::string mended(const std::string& text) {
  std::string result;
  result.reserve(text.size() + text.size() / 16);
  char quote = 0;
  bool in_tag = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (!in_tag && text.compare(i, 4, "<!--") == 0) {
      const std::size_t end = text.find("-->", i);
      const std::size_t last = end == std::string::npos ? text.size() : end + 3;
      result.append(text, i, last - i);
      i = last - 1;
      continue;
    }
    result += c;
    if (quote != 0) {
      if (c == quote) {
        quote = 0;
        const char next = i + 1 < text.size() ? text[i + 1] : ' ';
        if (std::isalpha(static_cast<unsigned char>(next)) != 0) result += ' ';
      }
    } else if (in_tag && (c == '"' || c == '\'')) {
      quote = c;
    } else if (c == '<') {
      in_tag = true;
    } else if (c == '>') {
      in_tag = false;
    }
  }
  return result;
}

class Builder {
 public:
  explicit Builder(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') ends_.push_back(static_cast<std::ptrdiff_t>(i));
  }

  int line_at(std::ptrdiff_t offset) const {
    return static_cast<int>(std::lower_bound(ends_.begin(), ends_.end(), offset) - ends_.begin()) + 1;
  }

  XmlElement element(const pugi::xml_node& node, const std::string& file, int depth) {
    XmlElement result;
    result.name = node.name();
    result.line = line_at(node.offset_debug());
    if (depth > deepest || ++count_ > most_elements)
      throw InputError({file, result.line}, "the file is nested too deeply or has too many elements",
                       "take a part of it");
    for (const pugi::xml_attribute& attribute : node.attributes())
      result.attributes.push_back({attribute.name(), attribute.value()});
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() == pugi::node_element) result.children.push_back(element(child, file, depth + 1));
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) result.text += child.value();
    }
    return result;
  }

 private:
  std::vector<std::ptrdiff_t> ends_;
  std::size_t count_ = 0;
};

/// pugixml walks down by calling itself: what is nested too deeply is refused before.
int depth_of(const std::string& text) {
  int depth = 0, most = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] != '<') continue;
    if (text[i + 1] == '/')
      --depth;
    else if (text[i + 1] != '!' && text[i + 1] != '?')
      most = std::max(most, ++depth);
    const std::size_t end = text.find('>', i);
    if (end == std::string::npos) break;
    if (text[end - 1] == '/' && text[i + 1] != '/') --depth;
  }
  return most;
}

}  // namespace

XmlElement parse_xml(const std::string& text, const std::string& file) {
  constexpr int too_deep = 10000;
  if (depth_of(text) > too_deep)
    throw InputError({file}, "the file is nested too deeply", "name a file of a mechanism");
  const std::string repaired = mended(text);
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(repaired.data(), repaired.size(), pugi::parse_default | pugi::parse_trim_pcdata);
  Builder builder(repaired);
  if (!result)
    throw InputError({file, builder.line_at(result.offset)}, "the file is no XML: " + std::string(result.description()),
                     "correct it, or write it anew with the program that it is from");
  const pugi::xml_node root = document.document_element();
  if (!root) throw InputError({file}, "the file has no elements", "name a file of a mechanism");
  return builder.element(root, file, 0);
}

std::optional<std::string> XmlElement::get(std::string_view attribute) const {
  for (const Attribute& entry : attributes)
    if (entry.name == attribute) {
      entry.read = true;
      return entry.value;
    }
  return std::nullopt;
}

std::string XmlElement::get(std::string_view attribute, const std::string& otherwise) const {
  return get(attribute).value_or(otherwise);
}

bool XmlElement::has(std::string_view attribute) const {
  return std::any_of(attributes.begin(), attributes.end(),
                     [&](const Attribute& candidate) { return candidate.name == attribute; });
}

std::vector<const XmlElement*> XmlElement::all(std::string_view child) const {
  std::vector<const XmlElement*> found;
  for (const XmlElement& element : children)
    if (element.name == child) {
      element.read = true;
      found.push_back(&element);
    }
  return found;
}

const XmlElement* XmlElement::first(std::string_view child) const {
  for (const XmlElement& element : children)
    if (element.name == child) {
      element.read = true;
      return &element;
    }
  return nullptr;
}

void XmlElement::take_whole() const {
  read = true;
  for (const Attribute& attribute : attributes) attribute.read = true;
  for (const XmlElement& child : children) child.take_whole();
}

namespace {

void collect(const XmlElement& element, std::map<std::string, int>& counts) {
  for (const XmlElement::Attribute& attribute : element.attributes)
    if (!attribute.read) ++counts[attribute.name + " of <" + element.name + ">"];
  for (const XmlElement& child : element.children) {
    if (child.read)
      collect(child, counts);
    else
      ++counts["<" + child.name + "> in <" + element.name + ">"];
  }
}

}  // namespace

std::vector<std::string> unread(const XmlElement& root) {
  std::map<std::string, int> counts;
  collect(root, counts);
  std::vector<std::string> words;
  for (const auto& [what, count] : counts)
    words.push_back(count > 1 ? what + " (" + std::to_string(count) + ")" : what);
  return words;
}

std::vector<double> numbers_of(const std::string& text, const XmlElement& at, const std::string& what,
                               const std::string& file, std::size_t least, std::size_t most) {
  std::vector<double> values;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t first = text.find_first_not_of(" \t\r\n,", start);
    if (first == std::string::npos) break;
    std::size_t end = text.find_first_of(" \t\r\n,", first);
    if (end == std::string::npos) end = text.size();
    double value = 0;
    if (!number_of(std::string_view(text).substr(first, end - first), value) || std::abs(value) > 1e12)
      throw InputError({file, at.line},
                       what + ": '" + text.substr(first, std::min<std::size_t>(end - first, 40)) + "' is no number",
                       "correct it in <" + at.name + ">");
    values.push_back(value);
    start = end;
  }
  if (values.size() < least || values.size() > most)
    throw InputError(
        {file, at.line}, what + " has " + std::to_string(values.size()) + " numbers",
        "write " + (least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most)) +
            " of them");
  return values;
}

}  // namespace clearloci::mechanism::imports
