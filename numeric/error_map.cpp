#include "numeric/error_map.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "numeric/evaluator.hpp"
#include "numeric/spatial_errors.hpp"

namespace clearloci::numeric {

namespace {

constexpr int lanes = 32;  // as in reaction_field
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Lane = std::array<double, lanes>;

/// Errors of up to `lanes` poses at once.
class BatchAccuracy {
 public:
  BatchAccuracy(const NumericModel& model, std::span<const int> mode)
      : model_(model),
        columns_(joint_columns(model)),
        clearances_(joint_clearances(model.mechanism)),
        evaluator_(model, mode, static_cast<int>(model.tape.code.size())),
        loads_((model.unknowns.size() + 1) * lanes) {
    for (auto& unit : units_) unit.resize((model.unknowns.size() + 1) * lanes);
  }

  double& input(std::size_t coordinate, int lane) { return evaluator_.input(coordinate, lane); }
  bool reachable(int lane) const { return evaluator_.reachable(lane); }

  void evaluate() {
    evaluator_.run_tape();
    for (std::size_t c = 0; c < 3; ++c) evaluator_.solve(model_.unit_wrenches[c], units_[c].data());
  }

  /// dx, dy, dα under the loads. |A| H Δ_C / |A|; the take-up needs the signs of N/|A| alone.
  std::array<Lane, 3> under_load() {
    evaluator_.solve(model_.elimination, loads_.data());
    std::array<Lane, 3> error{};
    const double* const determinant = row(loads_, model_.elimination.unknowns);
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      const auto& [fx, fy, couple, normal, tilt] = columns_[j];
      if (clearances_[j].radial > 0) add_force(fx, fy, clearances_[j].radial, determinant, error);
      if (clearances_[j].angular > 0 && couple >= 0) add_couple(couple, clearances_[j].angular, determinant, error);
      if (clearances_[j].gap > 0 && normal >= 0) add_guide(normal, tilt, clearances_[j], determinant, error);
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const double* const d = row(units_[c], model_.elimination.unknowns);
      for (std::size_t l = 0; l < lanes; ++l) error[c][l] /= d[l];
    }
    return error;
  }

  WorstCase worst(int lane, double accuracy) const {
    const auto l = static_cast<std::size_t>(lane);
    Influence H(3, static_cast<Eigen::Index>(model_.unknowns.size()));
    for (std::size_t c = 0; c < 3; ++c) {
      const double determinant = row(units_[c], model_.elimination.unknowns)[l];
      for (Eigen::Index k = 0; k < H.cols(); ++k)
        H(static_cast<Eigen::Index>(c), k) = row(units_[c], static_cast<int>(k))[l] / determinant;
    }
    return worst_case(H, columns_, clearances_, accuracy);
  }

 private:
  static const double* row(const std::vector<double>& numerators, int unknown) {
    return numerators.data() + static_cast<std::ptrdiff_t>(unknown) * lanes;
  }

  /// 0/0 where the force vanishes: the error is then not a number, as it should.
  void add_force(int fx, int fy, double radial, const double* determinant, std::array<Lane, 3>& error) const {
    const double *x = row(loads_, fx), *y = row(loads_, fy);
    Lane scale;
    for (std::size_t l = 0; l < lanes; ++l)
      scale[l] = -std::copysign(radial, determinant[l]) / std::sqrt(x[l] * x[l] + y[l] * y[l]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double *hx = row(units_[c], fx), *hy = row(units_[c], fy);
      for (std::size_t l = 0; l < lanes; ++l) error[c][l] += scale[l] * (x[l] * hx[l] + y[l] * hy[l]);
    }
  }

  void add_couple(int couple, double angular, const double* determinant, std::array<Lane, 3>& error) const {
    const double* m = row(loads_, couple);
    Lane turn;
    for (std::size_t l = 0; l < lanes; ++l)
      turn[l] = m[l] == 0 ? nan : -std::copysign(angular, m[l]) * std::copysign(1.0, determinant[l]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double* h = row(units_[c], couple);
      for (std::size_t l = 0; l < lanes; ++l) error[c][l] += turn[l] * h[l];
    }
  }

  void add_guide(int normal, int tilt, const JointClearance& clearance, const double* determinant,
                 std::array<Lane, 3>& error) const {
    const double *n = row(loads_, normal), *m = row(loads_, tilt);
    std::array<Lane, 2> way;
    for (std::size_t l = 0; l < lanes; ++l) {
      const auto ends = guide_ends(n[l], m[l], clearance.half_length);
      for (std::size_t e = 0; e < 2; ++e)
        way[e][l] = ends[e] == 0 ? nan : -std::copysign(clearance.gap, ends[e]) * std::copysign(1.0, determinant[l]);
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const double *h = row(units_[c], normal), *turn = row(units_[c], tilt);
      for (std::size_t l = 0; l < lanes; ++l)
        error[c][l] +=
            (way[0][l] + way[1][l]) / 2 * h[l] + (way[0][l] - way[1][l]) / (2 * clearance.half_length) * turn[l];
    }
  }

  const NumericModel& model_;
  std::vector<JointColumns> columns_;
  std::vector<JointClearance> clearances_;
  Evaluator<double, lanes> evaluator_;
  std::vector<double> loads_;
  std::array<std::vector<double>, 3> units_;
};

/// Which joints have a clearance that is not taken up at a pose, as far as rounding tells.
std::vector<bool> unloaded(const NumericModel& model, std::span<const int> mode, std::span<const Bounded> pose) {
  std::vector<bool> result;
  if (model.mechanism.space == mechanism::Space::spatial) {
    const std::vector<SpatialJoint> joints = spatial_joints(model.mechanism);
    const std::vector<LostContact> lost = lost_contacts(model, mode, pose);
    for (std::size_t j = 0; j < joints.size(); ++j)
      result.push_back((joints[j].presses() && lost[j].force) || (joints[j].plays() && lost[j].actuator));
    return result;
  }
  const std::vector<JointColumns> columns = joint_columns(model);
  const std::vector<JointClearance> clearances = joint_clearances(model.mechanism);
  const std::vector<bool> zero = vanishing_unknowns(model, pose, mode);
  const auto bears = [&](int column) { return column >= 0 && !zero[static_cast<std::size_t>(column)]; };
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const bool force = clearances[k].radial == 0 || bears(columns[k].fx) || bears(columns[k].fy);
    const bool couple = clearances[k].angular == 0 || bears(columns[k].couple);
    const bool guide = clearances[k].gap == 0 || bears(columns[k].normal) || bears(columns[k].tilt);
    result.push_back(!force || !couple || !guide);
  }
  return result;
}

/// Joints with a clearance whose reaction is decided at none of some reachable cells.
std::vector<std::string> joints_never_loaded(const NumericModel& model, std::span<const int> mode,
                                             const core::FieldMap& map) {
  constexpr int samples = 24;  // along each coordinate
  std::vector<bool> loaded(model.mechanism.joints.size(), false);
  bool any = false;
  for (int j = 0; j < samples; ++j) {
    for (int i = 0; i < samples; ++i) {
      const std::array pose = {map.x(i * map.nx / samples), map.y(j * map.ny / samples)};
      if (!reachable(model, pose, mode)) continue;
      any = true;
      const std::vector<bool> here = unloaded(model, mode, std::vector<Bounded>(pose.begin(), pose.end()));
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

}  // namespace

ErrorSamples error_samples(const NumericModel& model, std::span<const double> poses, std::span<const int> mode,
                           bool under_load, bool worst_case, double worst_case_accuracy) {
  const std::size_t coordinates = model.box.size();
  core::ensure(coordinates > 0 && poses.size() % coordinates == 0, "a pose has one value for each free coordinate");
  const std::size_t count = poses.size() / coordinates;
  ErrorSamples s;
  for (auto* values : {&s.dx, &s.dy, &s.dalpha}) values->assign(under_load ? count : 0, nan);
  for (auto* values : {&s.worst_dx, &s.worst_dy, &s.worst_dalpha, &s.worst_dp})
    values->assign(worst_case ? count : 0, nan);
  s.reachable.assign(count, false);
  BatchAccuracy batch(model, mode);
  for (std::size_t first = 0; first < count; first += lanes) {
    const int used = static_cast<int>(std::min<std::size_t>(lanes, count - first));
    for (int l = 0; l < lanes; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(std::min(l, used - 1));
      for (std::size_t c = 0; c < coordinates; ++c) batch.input(c, l) = poses[pose * coordinates + c];
    }
    batch.evaluate();
    const std::array<Lane, 3> error = under_load ? batch.under_load() : std::array<Lane, 3>{};
    for (int l = 0; l < used; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(l);
      if (!batch.reachable(l)) continue;
      s.reachable[pose] = true;
      if (under_load) {
        const auto lane = static_cast<std::size_t>(l);
        const bool defined = std::isfinite(error[0][lane]) && std::isfinite(error[1][lane]);
        s.dx[pose] = defined ? error[0][lane] : nan;
        s.dy[pose] = defined ? error[1][lane] : nan;
        s.dalpha[pose] = defined ? error[2][lane] : nan;
      }
      if (worst_case) {
        const WorstCase w = batch.worst(l, worst_case_accuracy);
        s.worst_dx[pose] = w.dx;
        s.worst_dy[pose] = w.dy;
        s.worst_dalpha[pose] = w.dalpha;
        s.worst_dp[pose] = w.dp;
      }
    }
  }
  return s;
}

namespace {

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

RowErrors planar_row(const NumericModel& model, std::span<const double> poses, std::span<const int> mode,
                     bool under_load, const ErrorGrid& grid) {
  const ErrorSamples s = error_samples(model, poses, mode, under_load, grid.worst_case, grid.worst_case_accuracy);
  RowErrors row{{}, s.reachable};
  if (under_load) {
    std::vector<double> distance(s.dx.size());
    for (std::size_t i = 0; i < distance.size(); ++i) distance[i] = std::sqrt(s.dx[i] * s.dx[i] + s.dy[i] * s.dy[i]);
    row.fields = {s.dx, s.dy, s.dalpha, distance};
  }
  if (grid.worst_case)
    for (const auto* values : {&s.worst_dx, &s.worst_dy, &s.worst_dalpha, &s.worst_dp}) row.fields.push_back(*values);
  return row;
}

RowErrors spatial_row(const NumericModel& model, std::span<const int> mode, std::span<const double> poses,
                      bool under_load, const ErrorGrid& grid) {
  const SpatialErrors s = spatial_errors(model, mode, poses, under_load, grid.worst_case, grid.worst_case_accuracy);
  RowErrors row{{}, s.reachable};
  const auto add = [&](const auto& values, const auto& of) {
    std::vector<double>& field = row.fields.emplace_back();
    for (const auto& value : values) field.push_back(of(value));
  };
  if (under_load) {
    for (std::size_t c = 0; c < 6; ++c) add(s.error, [&](const auto& e) { return e[c]; });
    add(s.error, [](const auto& e) { return std::hypot(e[0], e[1], e[2]); });
  }
  if (grid.worst_case) {
    for (std::size_t c = 0; c < 6; ++c) add(s.worst, [&](const auto& e) { return e[c]; });
    add(s.worst_distance, [](double distance) { return distance; });
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
      const RowErrors row = spatial ? spatial_row(model, mode, poses, under_load, grid)
                                    : planar_row(model, poses, mode, under_load, grid);
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
