#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "check/certificate.hpp"
#include "check/pose_task.hpp"
#include "core/errors.hpp"

namespace clearloci::check {
namespace {

using Json = nlohmann::json;
using core::Rational;

constexpr std::size_t most_variables = 32, most_points = 10'000, most_demands = 10'000, most_law_cells = 20'000;

class PoseTaskReader {
 public:
  explicit PoseTaskReader(const std::string& file) : file_(file) {}

  PoseTaskClaim read(const Json& root) const {
    PoseTaskClaim claim;
    claim.model = text(at(at(root, "model"), "text"));
    for (const Json& pair : list(at(at(root, "model"), "set"), most_variables))
      claim.overrides.emplace_back(text(item(pair, 0)), text(item(pair, 1)));
    for (const Json& name : list(at(root, "coordinates"), most_variables)) claim.coordinates.push_back(text(name));
    const Json& task = at(root, "pose_task");
    claim.shape = shape(task);
    if (const Json& own = at(task, "angle_length"); !own.is_null()) claim.angle_length = rational(own);
    for (const Json& side : list(at(task, "sides"), 10 * most_variables)) {
      if (side != 1 && side != -1) fail("a side is 1 or -1");
      claim.sides.push_back(side.get<int>());
    }
    for (const Json& own : list(at(task, "parameters"), most_variables))
      claim.parameters.push_back({text(item(own, 0)), rational(item(own, 1)), rational(item(own, 2))});
    for (const Json& own : list(at(task, "demands"), most_demands))
      claim.demands.push_back({text(item(own, 0)), quantity(text(item(own, 1))), rational(item(own, 2))});
    for (const Json& own : list(at(task, "unchecked"), most_variables)) claim.unchecked.push_back(text(own));
    if (task.contains("loads_from"))
      for (const Json& own : list(task["loads_from"], 2)) claim.loads_from.push_back(rationals(own));
    if (task.contains("loads_within"))
      for (const Json& own : list(task["loads_within"], most_variables))
        claim.loads_within.push_back({index(item(own, 0)), rational(item(own, 1)), rational(item(own, 2))});
    if (task.contains("law")) claim.law = law(task["law"], claim.coordinates.size());
    if (!claim.shape.is_shape(claim.coordinates.size()) || (claim.angle_length && *claim.angle_length <= 0))
      fail("the task has no shape");
    return claim;
  }

 private:
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
    for (const Json& own : list(json, most_variables)) all.push_back(rational(own));
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
  ClaimedShape shape(const Json& task) const {
    ClaimedShape own;
    own.name = text(at(task, "shape"));
    for (const Json& point : list(at(task, "points"), most_points)) own.points.push_back(rationals(point));
    own.radius = rational(at(task, "radius"));
    own.margin = rational(at(task, "margin"));
    if (task.contains("across")) own.across = {index(item(task["across"], 0)), index(item(task["across"], 1))};
    if (task.contains("above")) own.above = rationals(task["above"]);
    return own;
  }

  std::vector<std::vector<Rational>> efforts(const Json& json, std::size_t most, std::size_t joints) const {
    std::vector<std::vector<Rational>> all;
    for (const Json& own : list(json, most))
      if (all.push_back(rationals(own)); all.back().size() != joints) fail("a law has not one effort a joint");
    return all;
  }
  PoseTaskClaim::Law law(const Json& json, std::size_t coordinates) const {
    PoseTaskClaim::Law own;
    for (const Json& joint : list(at(json, "joints"), most_variables)) own.joints.push_back(text(joint));
    for (const Json& each : list(at(json, "cells"), most_law_cells)) {
      const std::vector<Rational> lower = rationals(item(each, 0)), upper = rationals(item(each, 1));
      if (lower.size() != coordinates || upper.size() != coordinates) fail("a cell of a law is of other coordinates");
      Cell& cell = own.cells.emplace_back();
      for (std::size_t c = 0; c < coordinates; ++c) cell.push_back({around(lower[c])[0], around(upper[c])[1]});
      own.efforts.push_back(
          {efforts(item(each, 2), 2, own.joints.size()), efforts(item(each, 3), most_variables, own.joints.size())});
      if (own.efforts.back().at_loads.empty()) fail("a cell of a law has no efforts");
    }
    return own;
  }

  const std::string& file_;
};

}  // namespace

PoseTaskClaim read_pose_task(const Json& root, const std::string& file) { return PoseTaskReader(file).read(root); }

}  // namespace clearloci::check
