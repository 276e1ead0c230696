#include "workbench/server/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "clearloci/exact_number.hpp"
#include "workbench/server/refusal.hpp"

namespace clearloci::workbench {
namespace {

constexpr std::size_t longest_list = 200'000;

[[noreturn]] void refuse(const char* name, const char* wanted) {
  throw Refusal(400, fmt::format("'{}' is to be {}", name, wanted));
}

std::optional<std::string> bytes_of_base64(const std::string& text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr unsigned bits_of_digit = 6, bits_of_byte = 8;
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : std::string_view(text).substr(0, text.find('='))) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos) return std::nullopt;
    bits = (bits << bits_of_digit | static_cast<unsigned>(digit)) & 0xffffU;
    count += bits_of_digit;
    if (count < bits_of_byte) continue;
    count -= bits_of_byte;
    bytes += static_cast<char>(bits >> count & 0xffU);
  }
  return bytes;
}

}  // namespace

Json parse_body(const std::string& body) {
  constexpr int deepest = 16;
  bool deep = false;
  Json value = Json::parse(
      body,
      [&](int depth, Json::parse_event_t, Json&) {
        if (depth > deepest) deep = true;
        return !deep;
      },
      false);
  if (deep) throw Refusal(400, "the request is nested too deeply");
  if (!value.is_object()) throw Refusal(400, "the request is no JSON object");
  return value;
}

const Json& Fields::find(const char* name) const {
  static const Json absent;
  const auto found = body_.find(name);
  return found == body_.end() ? absent : *found;
}

bool Fields::has(const char* name) const { return !find(name).is_null(); }

std::string Fields::text(const char* name) const {
  const Json& value = find(name);
  if (!value.is_string()) refuse(name, "a text");
  return value.get<std::string>();
}

std::string Fields::text(const char* name, const std::string& absent) const { return has(name) ? text(name) : absent; }

bool Fields::flag(const char* name) const {
  const Json& value = find(name);
  if (!value.is_null() && !value.is_boolean()) refuse(name, "true or false");
  return value.is_boolean() && value.get<bool>();
}

double Fields::number(const char* name, double absent, double least, double most) const {
  const Json& value = find(name);
  if (value.is_null()) return absent;
  if (!value.is_number()) refuse(name, "a number");
  const double number = value.get<double>();
  if (!(number >= least && number <= most))
    throw Refusal(400, fmt::format("'{}' is to be from {} to {}", name, least, most));
  return number;
}

int Fields::count(const char* name, int absent, int least, int most) const {
  const double value = number(name, absent, least, most);
  if (value != std::floor(value)) refuse(name, "a whole number");
  return static_cast<int>(value);
}

std::vector<std::string> Fields::words(const char* name) const {
  const Json& value = find(name);
  if (value.is_null()) return {};
  if (!value.is_array() || value.size() > longest_list) refuse(name, "a list of texts");
  std::vector<std::string> list;
  for (const Json& one : value) {
    if (!one.is_string()) refuse(name, "a list of texts");
    list.push_back(one.get<std::string>());
  }
  return list;
}

std::vector<double> Fields::numbers(const char* name) const {
  const Json& value = find(name);
  if (value.is_null()) return {};
  if (!value.is_array() || value.size() > longest_list) refuse(name, "a list of numbers");
  std::vector<double> list;
  for (const Json& one : value) {
    if (!one.is_number()) refuse(name, "a list of numbers");
    list.push_back(one.get<double>());
  }
  return list;
}

std::map<std::string, std::string> Fields::files(const char* name) const {
  const Json& value = find(name);
  if (value.is_null()) return {};
  if (!value.is_object()) refuse(name, "an object of files in base64, by name");
  std::map<std::string, std::string> files;
  for (const auto& [file, text] : value.items()) {
    const std::optional<std::string> bytes = text.is_string() ? bytes_of_base64(text.get<std::string>()) : std::nullopt;
    if (!bytes) refuse(name, "an object of files in base64, by name");
    files[file] = *bytes;
  }
  return files;
}

std::optional<Rational> Fields::positive(const char* name) const {
  if (!has(name)) return std::nullopt;
  std::optional<Rational> value = exact_number(text(name));
  if (!value || *value <= 0) refuse(name, "a number above zero, such as 5, 0.25 or 7/20");
  return value;
}

}  // namespace clearloci::workbench
