#include "numeric/error_map.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "numeric/error_samples.hpp"
#include "numeric/wrench_rows.hpp"

namespace clearloci::numeric {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Which joints have a clearance that is not taken up at a pose, as far as rounding tells.
std::vector<bool> unloaded(const std::vector<JointContact>& joints, const std::vector<LostContact>& lost) {
  std::vector<bool> result;
  for (std::size_t j = 0; j < joints.size(); ++j)
    result.push_back((joints[j].presses() && lost[j].force) || (joints[j].plays() && lost[j].actuator) ||
                     (joints[j].is_guided() && lost[j].guide));
  return result;
}

/// Joints with a clearance whose reaction is decided at none of some reachable cells.
std::vector<std::string> joints_never_loaded(const NumericModel& model, std::span<const int> mode,
                                             const core::FieldMap& map) {
  constexpr int samples = 24;  // along each coordinate
  std::vector<bool> loaded(model.mechanism.joints.size(), false);
  const std::vector<JointContact> joints =
      joint_contacts(model.mechanism, std::vector<Vector3d>(loaded.size(), Vector3d::Zero()));
  bool any = false;
  for (int j = 0; j < samples; ++j) {
    for (int i = 0; i < samples; ++i) {
      const std::array pose = {map.x(i * map.nx / samples), map.y(j * map.ny / samples)};
      if (!reachable(model, pose, mode)) continue;
      any = true;
      const std::vector<bool> here =
          unloaded(joints, lost_contacts(model, std::vector<Bounded>(pose.begin(), pose.end()), mode));
      for (std::size_t k = 0; k < loaded.size(); ++k)
        if (!here[k]) loaded[k] = true;
    }
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; any && k < loaded.size(); ++k)
    if (!loaded[k]) names.push_back(model.mechanism.joints[k].name);
  return names;
}

void check_model(const NumericModel& model, const ErrorGrid& grid) {
  const auto refuse = [&](const std::string& problem, const std::string& mend) {
    throw core::InputError({model.mechanism.file, 0, 0}, problem, mend);
  };
  if (grid.nx < 1 || grid.ny < 1) throw core::InputError({}, "the grid has no cells", "ask for 1x1 at least");
  if (model.box.size() != 2)
    refuse("an error map needs two free coordinates, and the workspace has " + std::to_string(model.box.size()),
           "write the others as parameters, or use clearloci pose");
  if (!any_clearance(joint_clearances(model.mechanism)))
    refuse("no joint has a clearance, so there is no error", "write such as clearance: {radial: 10e-6} at a joint");
}

/// Errors of a row of cells, field after field.
struct RowErrors {
  std::vector<std::vector<double>> fields;
  std::vector<bool> reachable;
};

void add_fields(core::FieldMap& map, bool spatial, bool under_load, bool worst_case) {
  struct Component {
    const char *name, *label, *unit;
  };
  const std::vector<Component> components =
      spatial ? std::vector<Component>{{"dx", "error in x", "m"},
                                       {"dy", "error in y", "m"},
                                       {"dz", "error in z", "m"},
                                       {"dalpha_x", "rotation about x", "rad"},
                                       {"dalpha_y", "rotation about y", "rad"},
                                       {"dalpha_z", "rotation about z", "rad"}}
              : std::vector<Component>{
                    {"dx", "error in x", "m"}, {"dy", "error in y", "m"}, {"dalpha", "error in orientation", "rad"}};
  const std::size_t cells = static_cast<std::size_t>(map.nx) * static_cast<std::size_t>(map.ny);
  const auto add = [&](const std::string& name, const std::string& label, const char* unit, bool is_signed) {
    map.fields.push_back({name, label, unit, is_signed, std::vector<double>(cells, nan)});
  };
  if (under_load) {
    for (const Component& c : components) add(c.name, c.label, c.unit, true);
    add("dp", "distance from the nominal place", "m", false);
  }
  if (!worst_case) return;
  for (const Component& c : components)
    add(std::string("worst_") + c.name, std::string("largest ") + c.label + " under any load", c.unit, false);
  add("worst_dp", "largest distance from the nominal place under any load", "m", false);
}

RowErrors row_of(const NumericModel& model, std::span<const double> poses, std::span<const int> mode, bool under_load,
                 const ErrorGrid& grid) {
  const ErrorSamples s = error_samples(model, poses, mode, under_load, grid.worst_case, grid.worst_case_accuracy);
  RowErrors row{{}, s.reachable};
  const auto add = [&](const auto& values, const auto& of) {
    std::vector<double>& field = row.fields.emplace_back();
    for (const auto& value : values) field.push_back(of(value));
  };
  const auto add_components = [&](const auto& values) {
    for (const Eigen::Index c : wrench_rows(model.mechanism.space))
      add(values, [&](const auto& e) { return c < 3 ? e.dp(c) : e.dalpha(c - 3); });
  };
  if (under_load) {
    add_components(s.error);
    add(s.error, [](const PoseError& e) { return e.dp.norm(); });
  }
  if (grid.worst_case) {
    add_components(s.worst);
    add(s.worst, [](const WorstCase& w) { return w.distance; });
  }
  return row;
}

}  // namespace

ErrorMap error_map(const NumericModel& model, std::span<const int> mode, const ErrorGrid& grid) {
  check_model(model, grid);
  ErrorMap result;
  core::FieldMap& map = result.map;
  map.mechanism = model.mechanism.name;
  map.nx = grid.nx;
  map.ny = grid.ny;
  for (std::size_t c = 0; c < 2; ++c) {
    map.coordinates[c] = model.mechanism.coordinates[c].name;
    map.lower[c] = model.box[c][0];
    map.upper[c] = model.box[c][1];
  }
  result.never_loaded = joints_never_loaded(model, mode, map);
  const bool under_load = result.never_loaded.empty();
  const bool spatial = model.mechanism.space == mechanism::Space::spatial;
  add_fields(map, spatial, under_load, grid.worst_case);

  std::vector<std::array<std::size_t, 2>> counts(static_cast<std::size_t>(grid.ny));  // reachable, undefined
  tbb::task_arena arena(grid.threads > 0 ? grid.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, grid.ny, [&](int j) {
      std::vector<double> poses;
      poses.reserve(2 * static_cast<std::size_t>(grid.nx));
      for (int i = 0; i < grid.nx; ++i) poses.insert(poses.end(), {map.x(i), map.y(j)});
      const RowErrors row = row_of(model, poses, mode, under_load, grid);
      for (std::size_t f = 0; f < row.fields.size(); ++f)
        std::copy(row.fields[f].begin(), row.fields[f].end(),
                  map.fields[f].values.begin() + static_cast<std::ptrdiff_t>(map.index(0, j)));
      for (std::size_t i = 0; i < row.reachable.size(); ++i) {
        if (!row.reachable[i]) continue;
        ++counts[static_cast<std::size_t>(j)][0];
        if (under_load && std::isnan(row.fields[0][i])) ++counts[static_cast<std::size_t>(j)][1];
      }
    });
  });
  for (const auto& [reachable, undefined] : counts) {
    result.reachable += reachable;
    result.undefined += undefined;
  }
  return result;
}

}  // namespace clearloci::numeric
