// A document as the text of a file: sections as blocks, what stands in them a line each.
#include <algorithm>
#include <cctype>

#include "mechanism/assembly/assemble.hpp"

namespace clearloci::mechanism {
namespace {

/// A scalar that reads back as itself, within brackets too.
std::string quoted(const std::string& text) {
  const bool dash = !text.empty() && text.front() == '-' && (text.size() == 1 || text[1] == ' ' || text[1] == '-');
  const bool plain = !text.empty() && text.front() != ' ' && text.back() != ' ' && !dash &&
                     std::all_of(text.begin(), text.end(),
                                 [](char c) {
                                   return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                                          std::string("_.+-*/^() ").find(c) != std::string::npos;
                                 }) &&
                     text.front() != '*';
  if (plain) return text;
  if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; })) {
    std::string escaped = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\') escaped += '\\';
      if (c == '\n')
        escaped += "\\n";
      else if (c == '\t')
        escaped += "\\t";
      else if (c == '\r')
        escaped += "\\r";
      else
        escaped += c;
    }
    return escaped + "\"";
  }
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string flow(const Node& node) {
  if (node.IsScalar()) return quoted(node.Scalar());
  if (node.IsNull()) return "";
  std::string text = node.IsMap() ? "{" : "[";
  for (const Node& item : node.items()) text += (text.size() > 1 ? ", " : "") + flow(item);
  for (const auto& [key, content] : node.pairs())
    text += (text.size() > 1 ? ", " : "") + quoted(key.Scalar()) + ": " + flow(content);
  return text + (node.IsMap() ? "}" : "]");
}

}  // namespace

std::string written_document(const Value& document, const std::map<std::string, std::string>& comments) {
  std::string text;
  for (const auto& [key, content] : document.node.pairs()) {
    text += quoted(key.Scalar()) + ":";
    const bool block = key.Scalar() != "units" && key.Scalar() != "end_effector" && key.Scalar() != "gravity";
    if (block && content.IsMap() && content.size() > 0) {
      text += "\n";
      for (const auto& [name, entry] : content.pairs()) {
        text += "  " + quoted(name.Scalar()) + ": " + flow(entry);
        const auto comment = key.Scalar() == "points" ? comments.find(name.Scalar()) : comments.end();
        text += comment == comments.end() ? "\n" : "  # " + comment->second + "\n";
      }
    } else if (block && content.IsSequence() && content.size() > 0) {
      text += "\n";
      for (const Node& item : content.items()) text += "  - " + flow(item) + "\n";
    } else {
      text += " " + flow(content) + "\n";
    }
  }
  return text;
}

}  // namespace clearloci::mechanism
