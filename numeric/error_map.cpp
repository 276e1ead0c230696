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

/// Joints with a clearance whose reaction is decided at none of some reachable poses.
std::vector<std::string> joints_never_loaded(const NumericModel& model, std::span<const int> mode,
                                             const std::vector<std::vector<double>>& poses) {
  std::vector<bool> loaded(model.mechanism.joints.size(), false);
  const std::vector<JointContact> joints =
      joint_contacts(model.mechanism, std::vector<Vector3d>(loaded.size(), Vector3d::Zero()));
  bool any = false;
  for (const std::vector<double>& pose : poses) {
    if (!reachable(model, pose, mode)) continue;
    any = true;
    const std::vector<bool> here =
        unloaded(joints, lost_contacts(model, std::vector<Bounded>(pose.begin(), pose.end()), mode));
    for (std::size_t k = 0; k < loaded.size(); ++k)
      if (!here[k]) loaded[k] = true;
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; any && k < loaded.size(); ++k)
    if (!loaded[k]) names.push_back(model.mechanism.joints[k].name);
  return names;
}

void check_model(const NumericModel& model, std::size_t coordinates, const std::string& what) {
  const auto refuse = [&](const std::string& problem, const std::string& mend) {
    throw core::InputError({model.mechanism.file, 0, 0}, problem, mend);
  };
  if (model.box.size() != coordinates)
    refuse(what + " free coordinates, and the workspace has " + std::to_string(model.box.size()),
           "write the others as parameters, or use clearloci pose");
  if (!any_clearance(joint_clearances(model.mechanism)))
    refuse("no joint has a clearance, so there is no error", "write such as clearance: {radial: 10e-6} at a joint");
}

/// Errors of a row of cells, field after field.
struct RowErrors {
  std::vector<std::vector<double>> fields;
  std::vector<bool> reachable;
};

std::vector<core::Field> fields_of(mechanism::Space space, bool under_load, bool worst_case, std::size_t cells) {
  const std::vector<core::ErrorComponent> components = error_components(space, worst_case);
  const std::size_t first = under_load ? 0 : error_components(space, false).size();
  std::vector<core::Field> fields;
  for (std::size_t c = first; c < components.size(); ++c) {
    const core::ErrorComponent& own = components[c];
    fields.push_back({own.name, own.label, own.unit, own.is_signed, std::vector<double>(cells, nan)});
  }
  return fields;
}

RowErrors row_of(const NumericModel& model, std::span<const double> poses, std::span<const int> mode, bool under_load,
                 const VolumeGrid& grid) {
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

/// Fields over a grid, a row of cells along the first coordinate at a time.
class FieldRows {
 public:
  FieldRows(const NumericModel& model, std::span<const int> mode, const VolumeGrid& grid)
      : model_(model), mode_(mode), grid_(grid) {
    for (const int n : grid.cells)
      if (n < 1) throw core::InputError({}, "the grid has no cells", "ask for 1x1 at least");
  }

  ErrorVolume run() {
    ErrorVolume result;
    result.never_loaded = joints_never_loaded(model_, mode_, samples());
    const bool under_load = result.never_loaded.empty();
    const int columns = grid_.cells[0];
    const std::size_t lines = static_cast<std::size_t>(grid_.cells[1]) * static_cast<std::size_t>(grid_.cells[2]);
    std::vector<core::Field>& fields = result.volume.fields;
    fields = fields_of(model_.mechanism.space, under_load, grid_.worst_case, lines * static_cast<std::size_t>(columns));
    std::vector<std::array<std::size_t, 2>> counts(lines);  // reachable, undefined
    tbb::task_arena arena(grid_.threads > 0 ? grid_.threads : tbb::task_arena::automatic);
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, lines, [&](std::size_t line) {
        if (grid_.deadline && std::chrono::steady_clock::now() >= *grid_.deadline)
          throw core::LimitReached("the errors could not be computed within the time limit; ask for fewer cells");
        const std::vector<double> poses = poses_of(line);
        const RowErrors row = row_of(model_, poses, mode_, under_load, grid_);
        for (std::size_t f = 0; f < row.fields.size(); ++f)
          std::copy(row.fields[f].begin(), row.fields[f].end(),
                    fields[f].values.begin() + static_cast<std::ptrdiff_t>(line * static_cast<std::size_t>(columns)));
        for (std::size_t i = 0; i < row.reachable.size(); ++i) {
          if (!row.reachable[i]) continue;
          ++counts[line][0];
          if (under_load && std::isnan(row.fields[0][i])) ++counts[line][1];
        }
      });
    });
    for (const auto& [reachable, undefined] : counts) {
      result.reachable += reachable;
      result.undefined += undefined;
    }
    return result;
  }

 private:
  double at(std::size_t coordinate, int cell) const {
    const auto& [low, high] = model_.box[coordinate];
    return low + (cell + 0.5) * (high - low) / grid_.cells[coordinate];
  }

  std::vector<double> poses_of(std::size_t line) const {
    const auto rows = static_cast<std::size_t>(grid_.cells[1]);
    std::vector<double> poses;
    poses.reserve(model_.box.size() * static_cast<std::size_t>(grid_.cells[0]));
    for (int i = 0; i < grid_.cells[0]; ++i) {
      poses.push_back(at(0, i));
      poses.push_back(at(1, static_cast<int>(line % rows)));
      if (model_.box.size() > 2) poses.push_back(at(2, static_cast<int>(line / rows)));
    }
    return poses;
  }

  /// Middles of some cells, the last coordinate slowest.
  std::vector<std::vector<double>> samples() const {
    const std::size_t n = model_.box.size();
    const int each = n > 2 ? 9 : 24;
    std::vector<std::vector<double>> poses;
    const int layers = n > 2 ? each : 1;
    for (int k = 0; k < layers; ++k)
      for (int j = 0; j < each; ++j)
        for (int i = 0; i < each; ++i) {
          std::vector<double> pose;
          const std::array<int, 3> part = {i, j, k};
          for (std::size_t c = 0; c < n; ++c) pose.push_back(at(c, part[c] * grid_.cells[c] / each));
          poses.push_back(std::move(pose));
        }
    return poses;
  }

  const NumericModel& model_;
  std::span<const int> mode_;
  const VolumeGrid& grid_;
};

}  // namespace

std::vector<core::ErrorComponent> error_components(mechanism::Space space, bool worst_case) {
  std::vector<core::ErrorComponent> components = {{"dx", "error in x", "m", true}, {"dy", "error in y", "m", true}};
  if (space == mechanism::Space::planar) {
    components.push_back({"dalpha", "error in orientation", "rad", true});
  } else {
    components.push_back({"dz", "error in z", "m", true});
    for (const std::string axis : {"x", "y", "z"})
      components.push_back({"dalpha_" + axis, "rotation about " + axis, "rad", true});
  }
  components.push_back({"dp", "distance from the nominal place", "m"});
  const std::size_t under_load = components.size();
  for (std::size_t c = 0; worst_case && c < under_load; ++c) {
    const core::ErrorComponent own = components[c];
    components.push_back({"worst_" + own.name, "largest " + own.label + " under any load", own.unit});
  }
  return components;
}

ErrorMap error_map(const NumericModel& model, std::span<const int> mode, const ErrorGrid& grid) {
  check_model(model, 2, "an error map needs two");
  ErrorVolume own = FieldRows(model, mode,
                              {.cells = {grid.nx, grid.ny, 1},
                               .threads = grid.threads,
                               .worst_case = grid.worst_case,
                               .worst_case_accuracy = grid.worst_case_accuracy})
                        .run();
  ErrorMap result{{}, own.reachable, own.undefined, std::move(own.never_loaded)};
  core::FieldMap& map = result.map;
  map.mechanism = model.mechanism.name;
  map.nx = grid.nx;
  map.ny = grid.ny;
  map.fields = std::move(own.volume.fields);
  for (std::size_t c = 0; c < 2; ++c) {
    map.coordinates[c] = model.mechanism.coordinates[c].name;
    map.lower[c] = model.box[c][0];
    map.upper[c] = model.box[c][1];
  }
  return result;
}

ErrorVolume error_volume(const NumericModel& model, std::span<const int> mode, const VolumeGrid& grid) {
  check_model(model, 3, "an error volume needs three");
  ErrorVolume result = FieldRows(model, mode, grid).run();
  core::FieldVolume& volume = result.volume;
  volume.mechanism = model.mechanism.name;
  volume.cells = grid.cells;
  for (std::size_t c = 0; c < 3; ++c) {
    volume.coordinates[c] = model.mechanism.coordinates[c].name;
    volume.angles[c] = model.mechanism.coordinates[c].angle;
    volume.lower[c] = model.box[c][0];
    volume.upper[c] = model.box[c][1];
  }
  return result;
}

}  // namespace clearloci::numeric
