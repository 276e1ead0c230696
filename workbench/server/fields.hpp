// The fields of a request's JSON as values. Whatever is wrong with one is a Refusal that names it.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"

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
  std::optional<Rational> positive(const char* name) const;  ///< an exact number above zero, written as a text

 private:
  const Json& find(const char* name) const;

  const Json& body_;
};

/// `text`, `file`: the mechanism of the request.
Model model_of(const Fields& fields);

/// `mode`: +1 or -1 for each dyad and slider; empty: the file's.
DyadSides sides_of(const Fields& fields);

/// `joints`, `quantities`, `mode`, `all_modes`, `min_force`, `min_couple`, `tolerance` (a part of the box),
/// `mesh_size`.
LociRequest loci_request(const Fields& fields, const Model& model);

}  // namespace clearloci::workbench
