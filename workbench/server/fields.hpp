// The fields of a request's JSON as values. Whatever is wrong with one is a Refusal that names it.
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "clearloci/exact.hpp"

namespace clearloci::workbench {

using Json = nlohmann::ordered_json;

/// The body of a request: an object, not nested deeper than any question needs.
Json parse_body(const std::string& body);

class Fields {
 public:
  explicit Fields(const Json& body) : body_(body) {}

  bool has(const char* name) const;
  std::string text(const char* name) const;
  std::string text(const char* name, const std::string& absent) const;
  bool flag(const char* name) const;  ///< false where absent
  double number(const char* name, double absent, double least, double most) const;
  int count(const char* name, int absent, int least, int most) const;
  std::vector<std::string> words(const char* name) const;  ///< empty where absent
  std::vector<double> numbers(const char* name) const;
  std::map<std::string, std::string> files(const char* name) const;  ///< {"part.stl": bytes in base64}
  std::optional<Rational> positive(const char* name) const;          ///< an exact number above zero, written as a text

 private:
  const Json& find(const char* name) const;

  const Json& body_;
};

}  // namespace clearloci::workbench
