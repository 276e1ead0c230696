#include "numeric/error_map.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
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

/// Errors of a row of cells, field after field.
struct RowErrors {
  std::vector<std::vector<double>> fields;
  std::vector<bool> reachable;
};

RowErrors row_of(const NumericModel& model, std::span<const double> poses, std::span<const int> mode, bool under_load,
                 const ErrorGrid& grid, double usual) {
  const ErrorSamples s =
      error_samples(model, poses, mode, under_load, grid.worst_case, grid.worst_case_accuracy, usual);
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
  FieldRows(const NumericModel& model, std::span<const int> mode, const ErrorGrid& grid)
      : model_(model), mode_(mode), grid_(grid), map_(empty_error_map(model, middles_of(model, grid.cells))) {}

  ErrorMap run() {
    ErrorMap result;
    result.never_loaded = joints_never_loaded(model_, mode_, samples());
    const bool under_load = result.never_loaded.empty();
    map_.fields = error_fields(model_.mechanism.space, under_load, grid_.worst_case);
    for (core::Field& field : map_.fields) field.values.assign(map_.size(), nan);
    const double usual = usual_determinant(model_, mode_);
    const std::size_t columns = map_.axes.front().size(), lines = map_.size() / columns;
    std::vector<std::array<std::size_t, 2>> counts(lines);  // reachable, undefined
    tbb::task_arena arena(grid_.threads > 0 ? grid_.threads : tbb::task_arena::automatic);
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, lines, [&](std::size_t line) {
        if (grid_.deadline && std::chrono::steady_clock::now() >= *grid_.deadline)
          throw core::LimitReached("the errors could not be computed within the time limit; ask for fewer cells");
        const std::vector<double> poses = poses_of(line * columns, columns);
        const RowErrors row = row_of(model_, poses, mode_, under_load, grid_, usual);
        for (std::size_t f = 0; f < row.fields.size(); ++f)
          std::copy(row.fields[f].begin(), row.fields[f].end(),
                    map_.fields[f].values.begin() + static_cast<std::ptrdiff_t>(line * columns));
        for (std::size_t i = 0; i < row.reachable.size(); ++i) {
          if (!row.reachable[i]) continue;
          ++counts[line][0];
          if (!row.fields.empty() && std::isnan(row.fields[0][i])) ++counts[line][1];
        }
      });
    });
    for (const auto& [reachable, undefined] : counts) {
      result.reachable += reachable;
      result.undefined += undefined;
    }
    result.map = std::move(map_);
    return result;
  }

 private:
  static std::vector<std::vector<double>> middles_of(const NumericModel& model, const std::vector<int>& cells) {
    if (cells.size() != model.box.size())
      throw core::InputError({model.mechanism.file},
                             "the grid has " + std::to_string(cells.size()) + " numbers of cells, and " +
                                 std::to_string(model.box.size()) + " coordinates are free",
                             "give one for each");
    std::vector<std::vector<double>> axes;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (cells[c] < 1) throw core::InputError({}, "the grid has no cells", "ask for 1x1 at least");
      const auto& [low, high] = model.box[c];
      std::vector<double>& axis = axes.emplace_back();
      for (int i = 0; i < cells[c]; ++i) axis.push_back(low + (i + 0.5) * (high - low) / cells[c]);
    }
    return axes;
  }

  std::vector<double> poses_of(std::size_t first, std::size_t count) const {
    std::vector<double> poses;
    poses.reserve(model_.box.size() * count);
    for (std::size_t cell = first; cell < first + count; ++cell) {
      const std::array<std::size_t, 3> at = map_.cell(cell);
      for (std::size_t c = 0; c < map_.axes.size(); ++c) poses.push_back(map_.axes[c][at[c]]);
    }
    return poses;
  }

  /// Some hundred places, spread over the cells.
  std::vector<std::vector<double>> samples() const {
    const std::size_t n = map_.axes.size(), each = n == 1 ? 576 : n == 2 ? 24 : 9;
    core::FieldMap spread;
    for (const std::vector<double>& axis : map_.axes) {
      std::vector<double>& some = spread.axes.emplace_back();
      for (std::size_t i = 0; i < each; ++i) some.push_back(axis[i * axis.size() / each]);
    }
    std::vector<std::vector<double>> poses;
    for (std::size_t k = 0; k < spread.size(); ++k) poses.push_back(spread.place(k));
    return poses;
  }

  const NumericModel& model_;
  std::span<const int> mode_;
  const ErrorGrid& grid_;
  core::FieldMap map_;
};

}  // namespace

std::vector<core::Field> error_fields(mechanism::Space space, bool under_load, bool worst_case) {
  std::vector<core::Field> components = {{"dx", "error in x", "m", true, {}}, {"dy", "error in y", "m", true, {}}};
  if (space == mechanism::Space::planar) {
    components.push_back({"dalpha", "error in orientation", "rad", true, {}});
  } else {
    components.push_back({"dz", "error in z", "m", true, {}});
    for (const std::string axis : {"x", "y", "z"})
      components.push_back({"dalpha_" + axis, "rotation about " + axis, "rad", true, {}});
  }
  components.push_back({"dp", "distance from the nominal place", "m", false, {}});
  std::vector<core::Field> fields;
  if (under_load) fields = components;
  for (std::size_t c = 0; worst_case && c < components.size(); ++c)
    fields.push_back({"worst_" + components[c].name,
                      "largest " + components[c].label + " under any load",
                      components[c].unit,
                      false,
                      {}});
  return fields;
}

core::FieldMap empty_error_map(const NumericModel& model, std::vector<std::vector<double>> axes) {
  if (!any_clearance(joint_clearances(model.mechanism)))
    throw core::InputError({model.mechanism.file, 0, 0}, "no joint has a clearance, so there is no error",
                           "write such as clearance: {radial: 10e-6} at a joint");
  core::FieldMap map;
  for (std::size_t c = 0; c < model.box.size(); ++c) {
    map.coordinates.push_back(model.mechanism.coordinates[c].name);
    map.angles.push_back(model.mechanism.coordinates[c].angle);
    map.lower.push_back(model.box[c][0]);
    map.upper.push_back(model.box[c][1]);
  }
  map.axes = std::move(axes);
  return map;
}

ErrorMap error_map(const NumericModel& model, std::span<const int> mode, const ErrorGrid& grid) {
  return FieldRows(model, mode, grid).run();
}

}  // namespace clearloci::numeric
