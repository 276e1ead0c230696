// Parts of certificates over any coordinates, read with limits on everything. Private to check/.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "check/certificate.hpp"
#include "check/pose_task.hpp"
#include "core/errors.hpp"

namespace clearloci::check {

class ClaimReader {
 public:
  explicit ClaimReader(const std::string& file) : file_(file) {}

 protected:
  using Json = nlohmann::json;
  using Rational = core::Rational;

  static constexpr std::size_t most_variables = 32, most_demands = 10'000;

  [[noreturn]] void fail(const std::string& what) const {
    throw core::InputError({file_}, "this is no certificate that can be read: " + what,
                           "write it anew with --certificate");
  }
  const Json& at(const Json& json, const char* key) const {
    if (!json.is_object() || !json.contains(key)) fail(fmt::format("'{}' is missing", key));
    return json[key];
  }
  const Json& item(const Json& json, std::size_t i) const {
    if (!json.is_array() || i >= json.size()) fail("a list is too short");
    return json[i];
  }
  const Json& list(const Json& json, std::size_t most) const {
    if (!json.is_array() || json.size() > most) fail("a list is missing, or too long");
    return json;
  }
  std::string text(const Json& json) const {
    if (!json.is_string()) fail("a text is missing");
    return json.get<std::string>();
  }
  Rational rational(const Json& json) const {
    const std::string digits = text(json);
    const std::optional<Rational> value = fraction_of(digits);
    if (!value) fail("'" + digits.substr(0, 40) + "' is no fraction");
    return *value;
  }
  std::vector<Rational> rationals(const Json& json) const {
    std::vector<Rational> all;
    for (const Json& value : list(json, most_variables)) all.push_back(rational(value));
    return all;
  }
  core::Quantity quantity(const std::string& name) const {
    for (const core::Quantity q : core::all_quantities)
      if (core::to_string(q) == name) return q;
    fail("an unknown quantity");
  }
  std::size_t index(const Json& json) const {
    if (!json.is_number_unsigned() || json.get<std::size_t>() >= most_variables)
      fail("a number is missing, or too large");
    return json.get<std::size_t>();
  }

  /// The model and the coordinates.
  void read_head(const Json& root, PoseTaskClaim& claim) const {
    claim.model = text(at(at(root, "model"), "text"));
    for (const Json& pair : list(at(at(root, "model"), "set"), most_variables))
      claim.overrides.emplace_back(text(item(pair, 0)), text(item(pair, 1)));
    for (const Json& name : list(at(root, "coordinates"), most_variables)) claim.coordinates.push_back(text(name));
  }
  std::vector<int> sides(const Json& json) const {
    std::vector<int> all;
    for (const Json& side : list(json, 10 * most_variables)) {
      if (side != 1 && side != -1) fail("a side is 1 or -1");
      all.push_back(side.get<int>());
    }
    return all;
  }
  std::vector<core::TaskDemand> demands(const Json& json) const {
    std::vector<core::TaskDemand> all;
    for (const Json& value : list(json, most_demands))
      all.push_back({text(item(value, 0)), quantity(text(item(value, 1))), rational(item(value, 2))});
    return all;
  }

 private:
  const std::string& file_;
};

}  // namespace clearloci::check
