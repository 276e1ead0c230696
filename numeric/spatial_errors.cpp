#include "numeric/spatial_errors.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "numeric/evaluator.hpp"

namespace clearloci::numeric {

namespace {

using core::Quantity;
using Eigen::Vector3d;

constexpr int lanes = 16;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Columns of a joint's force and couple in Cartesian components; -1 where it has none.
struct CartesianColumns {
  std::array<int, 3> force{}, couple{};
};

class Batch {
 public:
  Batch(const NumericModel& model, std::span<const int> mode)
      : model_(model), joints_(spatial_joints(model.mechanism)), evaluator_(model, mode, tape_size(model)) {
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      CartesianColumns columns;
      constexpr std::array forces = {Quantity::fx, Quantity::fy, Quantity::fz};
      constexpr std::array couples = {Quantity::mx, Quantity::my, Quantity::mz};
      for (std::size_t c = 0; c < 3; ++c) {
        columns.force[c] = column_of(model, static_cast<int>(j), forces[c]);
        columns.couple[c] = column_of(model, static_cast<int>(j), couples[c]);
      }
      columns_.push_back(columns);
    }
    influence_.resize(joints_.size());
  }

  double& input(std::size_t coordinate, int lane) { return evaluator_.input(coordinate, lane); }
  void run() { evaluator_.run_tape(); }
  bool reachable(int lane) const { return evaluator_.reachable(lane); }

  /// Axes and influence at a lane; the calls below are about that pose.
  void turn_to(int lane) {
    lane_ = lane;
    factorised_ = nullptr;
    for (std::size_t j = 0; j < joints_.size(); ++j)
      for (std::size_t c = 0; model_.axes[j] && c < 3; ++c)
        joints_[j].axis(static_cast<Eigen::Index>(c)) = evaluator_.value((*model_.axes[j])[c], lane);
    for (std::size_t row = 0; row < 6; ++row) {
      solve(model_.unit_wrenches[row]);
      for (std::size_t j = 0; j < joints_.size(); ++j) {
        const auto r = static_cast<Eigen::Index>(row);
        influence_[j].force.row(r) = part(columns_[j].force).transpose();
        influence_[j].couple.row(r) = part(columns_[j].couple).transpose();
      }
    }
  }

  std::array<double, 6> under_load() {
    solve(model_.elimination);
    std::vector<SpatialTakeUp> all;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      all.push_back(take_up(joints_[j], {part(columns_[j].force), part(columns_[j].couple)}));
      if (all.back().force_vanishes || all.back().actuator_vanishes) return {nan, nan, nan, nan, nan, nan};
    }
    const SpatialPoseError e = pose_error(influence_, all);
    return {e.dp(0), e.dp(1), e.dp(2), e.dalpha(0), e.dalpha(1), e.dalpha(2)};
  }

  SpatialWorstCase worst(double accuracy) const { return worst_case(joints_, influence_, accuracy, false); }

 private:
  static int tape_size(const NumericModel& model) { return static_cast<int>(model.tape.code.size()); }

  /// Whether two eliminations leave the same matrix, so that one factorisation serves both.
  static bool same_matrix(const Elimination& a, const Elimination& b) {
    if (a.core_unknowns != b.core_unknowns) return false;
    const std::size_t width = a.core_unknowns.size() + 1;
    for (std::size_t i = 0; i < a.core.size(); ++i)
      if (i % width + 1 != width && a.core[i] != b.core[i]) return false;
    return true;
  }

  /// Every unknown, not multiplied by |A|.
  void solve(const Elimination& e) {
    const auto size = static_cast<Eigen::Index>(e.core_unknowns.size());
    const auto core = [&](Eigen::Index row, Eigen::Index column) {
      return evaluator_.value(e.core[static_cast<std::size_t>(row * (size + 1) + column)], lane_);
    };
    if (factorised_ == nullptr || !same_matrix(*factorised_, e)) {
      Eigen::MatrixXd matrix(size, size);
      for (Eigen::Index row = 0; row < size; ++row)
        for (Eigen::Index column = 0; column < size; ++column) matrix(row, column) = core(row, column);
      lu_.compute(matrix);
      factorised_ = &e;
    }
    Eigen::VectorXd load(size);
    for (Eigen::Index row = 0; row < size; ++row) load(row) = core(row, size);
    const Eigen::VectorXd w = lu_.solve(load);
    values_.assign(model_.unknowns.size(), 0.0);
    for (Eigen::Index i = 0; i < size; ++i) values_[index(e.core_unknowns[static_cast<std::size_t>(i)])] = w(i);
    for (const BackSubstitution& step : e.steps) {
      double sum = step.load >= 0 ? evaluator_.value(step.load, lane_) : 0.0;
      for (const auto& [factor, unknown] : step.terms) sum -= evaluator_.value(factor, lane_) * values_[index(unknown)];
      values_[index(step.unknown)] = step.pivot * sum;
    }
  }

  static std::size_t index(int unknown) { return static_cast<std::size_t>(unknown); }

  Vector3d part(const std::array<int, 3>& columns) const {
    Vector3d v = Vector3d::Zero();
    for (std::size_t c = 0; c < 3; ++c)
      if (columns[c] >= 0) v(static_cast<Eigen::Index>(c)) = values_[index(columns[c])];
    return v;
  }

  const NumericModel& model_;
  std::vector<SpatialJoint> joints_;
  std::vector<CartesianColumns> columns_;
  Evaluator<double, lanes> evaluator_;
  int lane_ = 0;
  const Elimination* factorised_ = nullptr;  ///< whose matrix lu_ holds
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  std::vector<double> values_;
  std::vector<JointInfluence> influence_;
};

}  // namespace

SpatialErrors spatial_errors(const NumericModel& model, std::span<const int> mode, std::span<const double> poses,
                             bool under_load, bool worst_case, double worst_case_accuracy) {
  const std::size_t coordinates = model.box.size();
  core::ensure(coordinates > 0 && poses.size() % coordinates == 0, "a pose has one value for each free coordinate");
  const std::size_t count = poses.size() / coordinates;
  constexpr std::array<double, 6> none = {nan, nan, nan, nan, nan, nan};
  SpatialErrors errors;
  errors.error.assign(under_load ? count : 0, none);
  errors.worst.assign(worst_case ? count : 0, none);
  errors.worst_distance.assign(worst_case ? count : 0, nan);
  errors.reachable.assign(count, false);
  Batch batch(model, mode);
  for (std::size_t first = 0; first < count; first += lanes) {
    const int used = static_cast<int>(std::min<std::size_t>(lanes, count - first));
    for (int l = 0; l < lanes; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(std::min(l, used - 1));
      for (std::size_t c = 0; c < coordinates; ++c) batch.input(c, l) = poses[pose * coordinates + c];
    }
    batch.run();
    for (int l = 0; l < used; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(l);
      if (!batch.reachable(l)) continue;
      errors.reachable[pose] = true;
      batch.turn_to(l);
      if (under_load) {
        const std::array<double, 6> e = batch.under_load();
        if (std::all_of(e.begin(), e.end(), [](double v) { return std::isfinite(v); })) errors.error[pose] = e;
      }
      if (worst_case) {
        const SpatialWorstCase w = batch.worst(worst_case_accuracy);
        errors.worst[pose] = {w.dp(0), w.dp(1), w.dp(2), w.dalpha(0), w.dalpha(1), w.dalpha(2)};
        errors.worst_distance[pose] = w.distance;
      }
    }
  }
  return errors;
}

}  // namespace clearloci::numeric
