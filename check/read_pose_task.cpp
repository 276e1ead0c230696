#include "check/claim_reader.hpp"

namespace clearloci::check {
namespace {

using core::Rational;

constexpr std::size_t most_points = 10'000, most_law_cells = 20'000;

class PoseTaskReader : ClaimReader {
 public:
  using ClaimReader::ClaimReader;

  PoseTaskClaim read(const Json& root) const {
    PoseTaskClaim claim;
    read_head(root, claim);
    const Json& task = at(root, "pose_task");
    claim.shape = shape(task);
    if (const Json& value = at(task, "angle_length"); !value.is_null()) claim.angle_length = rational(value);
    claim.sides = sides(at(task, "sides"));
    for (const Json& value : list(at(task, "parameters"), most_variables))
      claim.parameters.push_back({text(item(value, 0)), rational(item(value, 1)), rational(item(value, 2))});
    claim.demands = demands(at(task, "demands"));
    for (const Json& value : list(at(task, "unchecked"), most_variables)) claim.unchecked.push_back(text(value));
    if (task.contains("loads_from"))
      for (const Json& value : list(task["loads_from"], 2)) claim.loads_from.push_back(rationals(value));
    if (task.contains("loads_within"))
      for (const Json& value : list(task["loads_within"], most_variables))
        claim.loads_within.push_back({index(item(value, 0)), rational(item(value, 1)), rational(item(value, 2))});
    if (task.contains("law")) claim.law = law(task["law"], claim.coordinates.size());
    if (!claim.shape.is_shape(claim.coordinates.size()) || (claim.angle_length && *claim.angle_length <= 0))
      fail("the task has no shape");
    return claim;
  }

 private:
  ClaimedShape shape(const Json& task) const {
    ClaimedShape shape;
    shape.name = text(at(task, "shape"));
    for (const Json& point : list(at(task, "points"), most_points)) shape.points.push_back(rationals(point));
    shape.radius = rational(at(task, "radius"));
    shape.margin = rational(at(task, "margin"));
    if (task.contains("across")) shape.across = {index(item(task["across"], 0)), index(item(task["across"], 1))};
    if (task.contains("above")) shape.above = rationals(task["above"]);
    return shape;
  }

  std::vector<std::vector<Rational>> efforts(const Json& json, std::size_t most, std::size_t joints) const {
    std::vector<std::vector<Rational>> all;
    for (const Json& value : list(json, most))
      if (all.push_back(rationals(value)); all.back().size() != joints) fail("a law has not one effort a joint");
    return all;
  }
  PoseTaskClaim::Law law(const Json& json, std::size_t coordinates) const {
    PoseTaskClaim::Law law;
    for (const Json& joint : list(at(json, "joints"), most_variables)) law.joints.push_back(text(joint));
    for (const Json& each : list(at(json, "cells"), most_law_cells)) {
      const std::vector<Rational> lower = rationals(item(each, 0)), upper = rationals(item(each, 1));
      if (lower.size() != coordinates || upper.size() != coordinates) fail("a cell of a law is of other coordinates");
      Cell& cell = law.cells.emplace_back();
      for (std::size_t c = 0; c < coordinates; ++c) cell.push_back({around(lower[c])[0], around(upper[c])[1]});
      law.efforts.push_back(
          {efforts(item(each, 2), 2, law.joints.size()), efforts(item(each, 3), most_variables, law.joints.size())});
      if (law.efforts.back().at_loads.empty()) fail("a cell of a law has no efforts");
    }
    return law;
  }
};

}  // namespace

PoseTaskClaim read_pose_task(const nlohmann::json& root, const std::string& file) {
  return PoseTaskReader(file).read(root);
}

}  // namespace clearloci::check
