// Poses, one and many; the cycle of a linkage; a trajectory.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "clearloci/error.hpp"
#include "clearloci/handed_files.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/sketch.hpp"
#include "clearloci/trajectory.hpp"
#include "report/error.hpp"
#include "report/pose.hpp"
#include "report/trajectory.hpp"
#include "report/viewer.hpp"
#include "workbench/server/questions.hpp"
#include "workbench/server/refusal.hpp"

namespace clearloci::workbench {
namespace {

constexpr int most_poses = 5000;

Json numbers_json(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
  return list;
}

Json error_json(const Pose& pose) {
  if (!pose.error) return nullptr;
  Json values = numbers_json(pose.error->displacement);
  for (const Json& value : numbers_json(pose.error->rotation)) values.push_back(value);
  return values;
}

/// Poses of a sweep, one after the other, from a list that runs through all their values.
std::vector<std::vector<double>> poses_of(const Fields& fields, const Model& model) {
  const std::vector<double> values = fields.numbers("poses");
  const std::size_t width = model.coordinates().size();
  if (values.empty() || values.size() % width != 0)
    throw Refusal(400, "'poses' is to have one value a free coordinate, pose after pose");
  if (values.size() / width > most_poses)
    throw Refusal(400, "'poses' has more than " + std::to_string(most_poses) + " poses");
  std::vector<std::vector<double>> poses;
  for (std::size_t i = 0; i < values.size(); i += width) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(i);
    poses.emplace_back(first, first + static_cast<std::ptrdiff_t>(width));
  }
  return poses;
}

/// The reactions at the poses of a list, in parts, so that the watch is kept.
Reactions watched_reactions(const Model& model, const std::vector<double>& poses, const DyadSides& sides,
                            const Watch& watch) {
  constexpr std::size_t part = 256;
  const std::size_t values = part * model.coordinates().size();
  Reactions all;
  for (std::size_t first = 0; first < poses.size(); first += values) {
    check(watch);
    const std::size_t count = std::min(values, poses.size() - first);
    Reactions some = reactions(model, std::span(poses).subspan(first, count), sides);
    if (first == 0) {
      all = std::move(some);
      continue;
    }
    for (std::size_t k = 0; k < all.table.columns.size(); ++k) {
      std::vector<double>& column = all.table.columns[k];
      column.insert(column.end(), some.table.columns[k].begin(), some.table.columns[k].end());
    }
  }
  return all;
}

}  // namespace

Json answer_pose(const Json& body, const Watch&) {
  const Fields fields(body);
  const Model model = model_of(fields);
  const std::vector<double> at = fields.numbers("at");
  const DyadSides sides = sides_of(fields);
  const Pose pose = solve_pose(model, at,
                               {.working_mode = sides,
                                .iterate = fields.flag("iterate"),
                                .min_force = fields.positive("min_force"),
                                .min_couple = fields.positive("min_couple")});
  require_iterated(pose, "iterate");
  Json answer = report::pose_object(pose);
  answer["unreachable"] = pose.unreachable;
  if (pose.unreachable.empty() && !model.spatial())
    answer["sketch"] = report::sketch_object(sketch_pose(model, at, sides));
  return answer;
}

/// Of every pose the reactions, the pose error and the place of the point `follow`.
Json answer_sweep(const Json& body, const Watch& watch) {
  const Fields fields(body);
  const Model model = model_of(fields);
  const DyadSides sides = sides_of(fields);
  const std::string followed = fields.text("follow", "");
  const std::vector<std::vector<double>> poses = poses_of(fields, model);
  const Reactions forces = watched_reactions(model, fields.numbers("poses"), sides, watch);
  Json errors = Json::array(), places = Json::array();
  for (const std::vector<double>& at : poses) {
    check(watch);
    const Pose pose = solve_pose(model, at, {.working_mode = sides});
    errors.push_back(error_json(pose));
    Json place = nullptr;
    for (const PosePoint& point : pose.points)
      if (point.name == followed) place = numbers_json(point.at);
    places.push_back(std::move(place));
  }
  Json columns = Json::object();
  for (std::size_t k = 0; k < forces.table.names.size(); ++k)
    columns[forces.table.names[k]] = {{"joint", forces.joints[k]},
                                      {"quantity", to_string(forces.quantities[k])},
                                      {"unit", forces.table.units[k]},
                                      {"values", numbers_json(forces.table.columns[k])}};
  return {{"reactions", std::move(columns)}, {"errors", std::move(errors)}, {"places", std::move(places)}};
}

/// Errors over the one coordinate, with the loci as marks.
Json answer_cycle(const Json& body, const Watch& watch) {
  const Fields fields(body);
  const Model model = model_of(fields);
  ErrorRequest request;
  request.grid = {fields.count("steps", 720, 8, most_poses)};
  request.loci = watched(loci_request(fields, model), watch);
  return report::error_object(find_errors(model, request));
}

/// Every working mode with a posture to show it by, up to a screenful.
Json answer_modes(const Json& body, const Watch& watch) {
  constexpr std::size_t most_dyads = 5;
  const Fields fields(body);
  const Model model = model_of(fields);
  const std::size_t dyads = model.dyads().size();
  Json list = Json::array();
  if (dyads > most_dyads) return {{"modes", std::move(list)}, {"dyads", dyads}};
  for (std::size_t pattern = 0; pattern < std::size_t{1} << dyads; ++pattern) {
    check(watch);
    DyadSides sides;
    for (std::size_t j = 0; j < dyads; ++j) sides.push_back((pattern >> (dyads - 1 - j) & 1) != 0 ? -1 : 1);
    const auto sample = sample_pose(model, sides);
    Json one = {{"mode", sides}, {"sample", sample ? Json(*sample) : Json(nullptr)}};
    if (sample && !model.spatial()) one["sketch"] = report::sketch_object(sketch_pose(model, *sample, sides));
    list.push_back(std::move(one));
  }
  return {{"modes", std::move(list)}, {"dyads", dyads}};
}

Json answer_trajectory(const Json& body, const Watch& watch) {
  const Fields fields(body);
  const Model model = model_of(fields);
  TrajectoryRequest request;
  request.working_mode = sides_of(fields);
  request.samples = fields.count("samples", 600, 10, most_poses);
  request.deadline = watch.deadline;
  if (fields.has("period")) request.period = fields.number("period", 1, 1e-3, 1e6);
  const TrajectoryResult result =
      follow_trajectory_text(model, fields.text("trajectory"), request, fields.files("files"));
  return report::trajectory_object(result);
}

}  // namespace clearloci::workbench
