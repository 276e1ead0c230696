#include "analysis/request_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

#include "analysis/loci.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "core/task.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/idle.hpp"

namespace clearloci {
namespace {

using core::InputError;

void check_positive(const std::optional<Rational>& value, const std::string& what, const std::string& unit) {
  if (!value) return;
  if (*value <= 0) throw InputError({}, what + " is not above zero", "give " + unit + ", more than 0");
  if (const auto reason = mechanism::unusable(*value))
    throw InputError({}, what + " " + *reason, "give " + unit + " as they occur");
}

void check_margin(const Rational& margin) {
  if (margin < 0) throw InputError({}, "the task's margin is negative", "give 0 or more");
  if (const auto reason = mechanism::unusable(margin))
    throw InputError({}, "the task's margin " + *reason, "give one as it occurs");
}

[[noreturn]] void refuse_foreign(const mechanism::Mechanism& mechanism, const std::string& why) {
  throw InputError({mechanism.file}, "the task is one of another mechanism: " + why, "read the task with this one");
}

void check_inside(const mechanism::Mechanism& mechanism, std::size_t c, const Rational& lower, const Rational& upper) {
  const mechanism::Coordinate& coordinate = mechanism.coordinates[c];
  if (lower > upper || lower < coordinate.lower || upper > coordinate.upper)
    refuse_foreign(mechanism, "it is not within the range of " + coordinate.name);
}

void check_size(const mechanism::Mechanism& mechanism, std::size_t values) {
  if (values != mechanism.coordinates.size())
    refuse_foreign(mechanism, "its poses have " + std::to_string(values) + " values, and " +
                                  std::to_string(mechanism.coordinates.size()) + " coordinates are free");
}

void check_one_force(const mechanism::Mechanism& mechanism) {
  if (mechanism.loads.size() != 1 || mechanism.loads.front().force.empty())
    refuse_foreign(mechanism, "a range of loads takes the place of a single force");
}

/// Every pose that a shape is told by.
std::vector<core::RationalPose> poses_of(const core::TaskShape& shape) {
  if (const auto* box = std::get_if<core::TaskBox>(&shape)) return {box->lower, box->upper};
  if (const auto* ball = std::get_if<core::TaskBall>(&shape)) return {ball->centre};
  if (const auto* polygon = std::get_if<core::TaskPolygon>(&shape)) return polygon->corners;
  if (const auto* path = std::get_if<core::TaskPath>(&shape)) return path->points;
  return {};
}

void check_polygon(const mechanism::Mechanism& mechanism, const core::TaskPolygon& polygon) {
  for (const std::size_t c : polygon.across)
    if (c >= mechanism.coordinates.size() || mechanism.coordinates[c].angle)
      refuse_foreign(mechanism, "a polygon lies in two lengths");
  if (polygon.across[0] == polygon.across[1]) refuse_foreign(mechanism, "a polygon lies in two lengths");
  if (polygon.corners.size() < 3) throw InputError({}, "the polygon has no three corners", "give three at least");
  if (!polygon.above.empty()) check_size(mechanism, polygon.above.size());
  if (const auto side = core::crossed_side(polygon))
    throw InputError({}, "the polygon crosses itself: side " + std::to_string(*side + 1),
                     "give its corners in their order round it");
}

void check_mesh(const mechanism::Mechanism& mechanism, const core::TaskMesh& mesh) {
  if (mechanism.coordinates.size() != 3) refuse_foreign(mechanism, "a mesh is one of three lengths");
  if (mesh.triangles.empty()) throw InputError({}, "the mesh has no triangles", "give a closed surface");
  for (const std::array<double, 3>& corner : mesh.corners)
    for (const double value : corner)
      if (!std::isfinite(value)) throw InputError({}, "a corner of the mesh is no point", "give finite numbers");
  for (const std::array<int, 3>& triangle : mesh.triangles)
    for (const int corner : triangle)
      if (corner < 0 || static_cast<std::size_t>(corner) >= mesh.corners.size())
        throw InputError({}, "a triangle of the mesh has no corner " + std::to_string(corner),
                         "count its corners from 0");
  if (const auto open = core::open_surface(mesh))
    throw InputError({}, "the surface of the mesh " + *open, "give a watertight one");
}

/// What joints of free effort are asked to exert.
void check_preload(const mechanism::Mechanism& mechanism, const core::Task& task) {
  const std::vector<mechanism::JointIndex> joints = mechanism::preloaded_joints(mechanism);
  for (std::size_t i = 0; i < task.preload.size(); ++i) {
    const std::string& name = task.preload[i].first;
    const bool is_free = std::any_of(joints.begin(), joints.end(), [&](const mechanism::JointIndex j) {
      return mechanism.joints[static_cast<std::size_t>(j)].name == name;
    });
    if (!is_free) refuse_foreign(mechanism, "no joint of free effort is called " + name);
    for (std::size_t k = 0; k < i; ++k)
      if (task.preload[k].first == name) throw InputError({}, name + " has two efforts", "give one");
  }
  if (task.controlled_preload && joints.empty()) refuse_foreign(mechanism, "no joint has a free effort");
  if (task.knows_load && !task.controlled_preload)
    throw InputError({}, "only a preload that varies with the pose may vary with the load",
                     "set controlled_preload, or leave knows_load out");
}

void check_shape(const mechanism::Mechanism& mechanism, const core::Task& task) {
  const std::size_t count = mechanism.coordinates.size();
  const std::vector<core::RationalPose> poses = poses_of(task.shape);
  for (const core::RationalPose& pose : poses) check_size(mechanism, pose.size());
  if (const auto* mesh = std::get_if<core::TaskMesh>(&task.shape)) return check_mesh(mechanism, *mesh);
  if (poses.empty()) throw InputError({}, "the task has no pose", "give one at least");
  if (const auto* ball = std::get_if<core::TaskBall>(&task.shape)) check_positive(ball->radius, "the radius", "m");
  if (const auto* polygon = std::get_if<core::TaskPolygon>(&task.shape)) check_polygon(mechanism, *polygon);
  std::vector<Rational> weights;
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates)
    weights.push_back(coordinate.angle ? task.angle_length.value_or(1) : Rational(1));
  const auto [lower, upper] = core::bounds(task.shape, weights);
  for (std::size_t c = 0; c < count; ++c) check_inside(mechanism, c, lower[c], upper[c]);
}

}  // namespace

double finest_tolerance(const mechanism::Mechanism& mechanism) {
  constexpr double spacings = 64 * std::numeric_limits<double>::epsilon();
  double largest = 0;
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates)
    if (!coordinate.angle)
      largest =
          std::max({largest, std::abs(core::to_double(coordinate.lower)), std::abs(core::to_double(coordinate.upper))});
  return spacings * (largest > 0 ? largest : 1);
}

void check_positive(double value, const std::string& what, const std::string& unit) {
  if (!std::isfinite(value)) throw InputError({}, what + " is no number", "give " + unit + ", more than 0");
  check_positive(std::optional(Rational(value)), what, unit);
}

void check_least(const std::optional<Rational>& min_force, const std::optional<Rational>& min_couple) {
  check_positive(min_force, "min_force", "N");
  check_positive(min_couple, "min_couple", "N m");
}

void check_request(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  const double finest = finest_tolerance(mechanism);
  if (!(request.tolerance >= finest && std::isfinite(request.tolerance))) {
    std::ostringstream least;
    least << "give " << finest << " m or more";
    throw InputError({}, "the tolerance is no number that doubles can keep in this box", least.str());
  }
  if (!(request.mesh_size > 0 && std::isfinite(request.mesh_size)))
    throw InputError({}, "the mesh size is no positive number", "give a part of the box, such as 0.03");
  check_least(request.min_force, request.min_couple);
  if (request.quantities.empty()) throw InputError({}, "no quantity is asked for", "give one of f, M, F, N, T, ...");
  check_sides(mechanism, request);
}

void check_request(const mechanism::Mechanism& mechanism, const ErrorRequest& request) {
  check_request(mechanism, request.loci);
  check_cells(request.zone_cells);
  if (request.grid.empty()) return;
  const std::size_t count = mechanism.coordinates.size();
  if (request.grid.size() != count)
    throw InputError({},
                     "the grid has " + std::to_string(request.grid.size()) + " numbers of cells, and " +
                         std::to_string(count) + " coordinates are free",
                     "give one for each");
  check_nodes(request.grid, 1);
}

void check_cells(long cells) {
  if (cells < 1) throw InputError({}, std::to_string(cells) + " cells are looked at", "give one at least");
}

void check_nodes(const std::vector<int>& nodes, int least) {
  constexpr double most = 1e8;  // some hundred bytes a node are as much as a machine of today holds
  double all = 1;
  for (const int count : nodes) {
    if (count < least)
      throw InputError({}, "a grid has " + std::to_string(count) + " nodes along a coordinate",
                       "give " + std::to_string(least) + " at least");
    all *= count;
  }
  if (all > most) throw InputError({}, "the grid has more nodes than there is memory for", "give fewer");
}

void check_task(const mechanism::Mechanism& mechanism, const core::Task& task) {
  check_positive(task.angle_length, "angle_length", "m");
  check_shape(mechanism, task);
  check_margin(task.margin);
  check_least(task.min_force, task.min_couple);
  check_positive(task.pose_error, "pose_error", "m");
  for (const core::Tolerance& tolerance : task.tolerances) {
    const auto& parameters = mechanism.parameters;
    if (std::none_of(parameters.begin(), parameters.end(),
                     [&](const auto& candidate) { return candidate.name == tolerance.parameter; }))
      refuse_foreign(mechanism, "there is no parameter '" + tolerance.parameter + "'");
    if (std::count_if(task.tolerances.begin(), task.tolerances.end(),
                      [&](const core::Tolerance& other) { return other.parameter == tolerance.parameter; }) > 1)
      throw InputError({}, tolerance.parameter + " has two tolerances", "give one");
    if (tolerance.below > 0 || tolerance.above < 0)
      throw InputError({}, "the tolerance of " + tolerance.parameter + " leaves out its own value",
                       "give one below and one above 0");
  }
  if (task.loads) {
    check_one_force(mechanism);
    const auto dimension = static_cast<std::size_t>(mechanism::dimension(mechanism));
    if (task.loads->first.size() != dimension || task.loads->second.size() != dimension)
      refuse_foreign(mechanism, "its loads have other components");
  }
  check_preload(mechanism, task);
  for (const core::LoadWithin& within : task.loads_within) {
    if (within.load >= mechanism.loads.size())
      refuse_foreign(mechanism, "there is no load " + std::to_string(within.load + 1));
    if (std::count_if(task.loads_within.begin(), task.loads_within.end(),
                      [&](const core::LoadWithin& other) { return other.load == within.load; }) > 1)
      throw InputError({}, "load " + std::to_string(within.load + 1) + " is varied twice", "give one entry a load");
    if (within.force < 0 || within.couple < 0)
      throw InputError({}, "what a load may differ by is negative", "give 0 or more");
    const mechanism::LinkIndex link = mechanism.loads[within.load].link;
    if (within.couple > 0 && mechanism::turns_idly(mechanism, link))
      throw InputError({},
                       "loads_within has a couple on link " + mechanism.links[static_cast<std::size_t>(link)].name +
                           ", which nothing holds against it",
                       "leave the couple out");
  }
}

}  // namespace clearloci
