#include "numeric/error_samples.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <optional>

#include "core/errors.hpp"
#include "numeric/evaluator.hpp"

namespace clearloci::numeric {

namespace {

constexpr int lanes = 16;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class Batch {
 public:
  Batch(const NumericModel& model, std::span<const int> mode)
      : model_(model),
        axes_(model.axes.size(), Vector3d::Zero()),
        couple_axes_(axes_),
        contacts_(joint_contacts(model.mechanism, axes_)),
        evaluator_(model, mode, static_cast<int>(model.tape.code.size())),
        values_(static_cast<Eigen::Index>(model.unknowns.size())),
        H_(static_cast<Eigen::Index>(model.unit_wrenches.size()), values_.size()) {}

  double& input(std::size_t coordinate, int lane) { return evaluator_.input(coordinate, lane); }
  void run() { evaluator_.run_tape(); }
  bool reachable(int lane) const { return evaluator_.reachable(lane); }

  /// Axes and influence at a lane; the calls below are about that pose.
  void turn_to(int lane) {
    lane_ = lane;
    factorised_ = nullptr;
    bool turned = columns_.empty();  // revolute joints in the plane never are
    const auto follow = [&](const std::optional<Triple>& at, Vector3d& axis) {
      if (!at) return;
      const Vector3d now = vector(*at);
      turned = turned || now != axis;
      axis = now;
    };
    for (std::size_t j = 0; j < axes_.size(); ++j) {
      follow(model_.axes[j], axes_[j]);
      follow(model_.couple_axes[j], couple_axes_[j]);
      contacts_[j].axis = axes_[j];
    }
    if (turned) columns_ = unknown_columns(model_, axes_, couple_axes_);
    for (std::size_t row = 0; row < model_.unit_wrenches.size(); ++row)
      H_.row(static_cast<Eigen::Index>(row)) = solve(model_.unit_wrenches[row]).transpose();
  }

  PoseError under_load() {
    const std::vector<JointReaction> reactions = joint_reactions(contacts_.size(), columns_, solve(model_.elimination));
    const std::vector<TakeUp> all = take_up(contacts_, reactions);
    if (any_lost(contacts_, all)) return {Vector3d::Constant(nan), Vector3d::Constant(nan)};
    return pose_error(model_.mechanism.space, H_, clearance_displacements(columns_, all));
  }

  WorstCase worst(double accuracy) const {
    return worst_case(contacts_, joint_influence(model_.mechanism, columns_, H_), accuracy, false);
  }

 private:
  Vector3d vector(const Triple& v) const {
    return {evaluator_.value(v[0], lane_), evaluator_.value(v[1], lane_), evaluator_.value(v[2], lane_)};
  }

  /// Whether two eliminations leave the same matrix, so that one factorisation serves both.
  static bool same_matrix(const Elimination& a, const Elimination& b) {
    if (a.core_unknowns != b.core_unknowns) return false;
    const std::size_t width = a.core_unknowns.size() + 1;
    for (std::size_t i = 0; i < a.core.size(); ++i)
      if (i % width + 1 != width && a.core[i] != b.core[i]) return false;
    return true;
  }

  /// Every unknown, not multiplied by |A|.
  const Eigen::VectorXd& solve(const Elimination& e) {
    const auto size = static_cast<Eigen::Index>(e.core_unknowns.size());
    const auto core = [&](Eigen::Index row, Eigen::Index column) {
      return evaluator_.value(e.core[static_cast<std::size_t>(row * (size + 1) + column)], lane_);
    };
    if (factorised_ == nullptr || !same_matrix(*factorised_, e)) {
      Eigen::MatrixXd matrix(size, size);
      for (Eigen::Index row = 0; row < size; ++row)
        for (Eigen::Index column = 0; column < size; ++column) matrix(row, column) = core(row, column);
      if (size > 0) lu_.compute(matrix);
      factorised_ = &e;
    }
    Eigen::VectorXd load(size);
    for (Eigen::Index row = 0; row < size; ++row) load(row) = core(row, size);
    const Eigen::VectorXd w = size > 0 ? Eigen::VectorXd(lu_.solve(load)) : load;
    for (Eigen::Index i = 0; i < size; ++i) values_(e.core_unknowns[static_cast<std::size_t>(i)]) = w(i);
    for (const BackSubstitution& step : e.steps) {
      double sum = step.load >= 0 ? evaluator_.value(step.load, lane_) : 0.0;
      for (const auto& [factor, unknown] : step.terms) sum -= evaluator_.value(factor, lane_) * values_(unknown);
      values_(step.unknown) = step.pivot * sum;
    }
    return values_;
  }

  const NumericModel& model_;
  std::vector<Vector3d> axes_, couple_axes_;
  std::vector<JointContact> contacts_;
  std::vector<ReactionColumn> columns_;
  Evaluator<double, lanes> evaluator_;
  int lane_ = 0;
  const Elimination* factorised_ = nullptr;  ///< whose matrix lu_ holds
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::VectorXd values_;
  Influence H_;
};

}  // namespace

ErrorSamples error_samples(const NumericModel& model, std::span<const double> poses, std::span<const int> mode,
                           bool under_load, bool worst_case, double worst_case_accuracy) {
  const std::size_t coordinates = model.box.size();
  core::ensure(coordinates > 0 && poses.size() % coordinates == 0, "a pose has one value for each free coordinate");
  const std::size_t count = poses.size() / coordinates;
  const Vector3d none = Vector3d::Constant(nan);
  ErrorSamples samples;
  samples.error.assign(under_load ? count : 0, {none, none});
  samples.worst.assign(worst_case ? count : 0, {none, none, nan, nan});
  samples.reachable.assign(count, false);
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
      samples.reachable[pose] = true;
      batch.turn_to(l);
      if (under_load)
        if (const PoseError e = batch.under_load(); e.dp.allFinite() && e.dalpha.allFinite()) samples.error[pose] = e;
      if (worst_case) samples.worst[pose] = batch.worst(worst_case_accuracy);
    }
  }
  return samples;
}

}  // namespace clearloci::numeric
