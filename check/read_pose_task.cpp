#include "check/claim_reader.hpp"

namespace clearloci::check {
namespace {

using core::Rational;

constexpr std::size_t most_points = 10'000, most_law_cells = 200'000;

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
    if (task.contains("refutation")) claim.refutation = refutation(task["refutation"]);
    if (!claim.shape.is_shape(claim.coordinates.size()) || (claim.angle_length && *claim.angle_length <= 0))
      fail("the task has no shape");
    return claim;
  }

 private:
  int sign(const Json& json) const {
    if (json != 1 && json != -1) fail("a sign is 1 or -1");
    return json.get<int>();
  }
  bool flag(const Json& json) const {
    if (!json.is_boolean()) fail("true or false is missing");
    return json.get<bool>();
  }

  Refutation refutation(const Json& json) const {
    Refutation refutation;
    for (const Json& joint : list(at(json, "joints"), most_variables)) refutation.joints.push_back(text(joint));
    for (const Json& range : list(at(json, "ranges"), most_variables))
      refutation.ranges.push_back({rational(item(range, 0)), rational(item(range, 1))});
    refutation.controlled = flag(at(json, "controlled"));
    refutation.knows_load = flag(at(json, "knows_load"));
    for (const Json& each : list(at(json, "patterns"), most_points)) {
      Refutation::Pattern& pattern = refutation.patterns.emplace_back();
      for (const Json& pair : list(at(each, "signs"), most_demands))
        pattern.signs[text(item(pair, 0))] = sign(item(pair, 1));
      pattern.joints = joints(at(each, "joints"));
      for (const Json& row : list(at(each, "rows"), most_variables))
        pattern.rows.push_back({text(at(row, "reaction")), sign(at(row, "sign")), flag(at(row, "bound")),
                                rationals(at(row, "at")), rationals(at(row, "load")), rational(at(row, "multiplier"))});
    }
    return refutation;
  }

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
  std::vector<std::string> joints(const Json& json) const {
    std::vector<std::string> names;
    for (const Json& joint : list(json, most_variables)) names.push_back(text(joint));
    return names;
  }
  PoseTaskClaim::Law law(const Json& json, std::size_t coordinates) const {
    PoseTaskClaim::Law law;
    const std::vector<std::string> usual = joints(at(json, "joints"));
    for (const Json& each : list(at(json, "cells"), most_law_cells)) {
      const std::vector<Rational> lower = rationals(item(each, 0)), upper = rationals(item(each, 1));
      if (lower.size() != coordinates || upper.size() != coordinates) fail("a cell of a law is of other coordinates");
      Cell& cell = law.cells.emplace_back();
      for (std::size_t c = 0; c < coordinates; ++c) cell.push_back({around(lower[c])[0], around(upper[c])[1]});
      const std::vector<std::string> names = each.size() > 4 ? joints(item(each, 4)) : usual;
      law.efforts.push_back(
          {names, efforts(item(each, 2), 2, names.size()), efforts(item(each, 3), most_variables, names.size())});
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
