#include "numeric/reactions.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"

namespace clearloci::numeric {

namespace {

const Point2& point_of(const Posture& posture, int index) { return posture.points[static_cast<std::size_t>(index)]; }

/// Moment about the end-effector point of `force` at `at`.
double moment(const NumericModel& model, const Posture& posture, const Point2& at, const Point2& force) {
  const Point2& reference = point_of(posture, model.mechanism.end_effector_point);
  return (at[0] - reference[0]) * force[1] - (at[1] - reference[1]) * force[0];
}

}  // namespace

Eigen::MatrixXd newton_euler_matrix(const NumericModel& model, const Posture& posture) {
  core::ensure(posture.reachable(), "the posture is reachable");
  const auto size = static_cast<Eigen::Index>(model.unknowns.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index column = 0; column < size; ++column) {
    const auto& unknown = model.unknowns[static_cast<std::size_t>(column)];
    const auto& joint = model.mechanism.joints[static_cast<std::size_t>(unknown.joint)];
    Eigen::Vector3d wrench(0, 0, 1);  // of a unit couple
    if (unknown.quantity != core::Quantity::M) {
      const Point2 force = unknown.quantity == core::Quantity::fx ? Point2{1, 0} : Point2{0, 1};
      wrench = {force[0], force[1], moment(model, posture, point_of(posture, joint.at), force)};
    }
    if (joint.to != mechanism::ground) A.block<3, 1>(3 * joint.to, column) += wrench;
    if (joint.from != mechanism::ground) A.block<3, 1>(3 * joint.from, column) -= wrench;
  }
  return A;
}

Eigen::VectorXd load_column(const NumericModel& model, const Posture& posture) {
  core::ensure(posture.reachable(), "the posture is reachable");
  Eigen::VectorXd w = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.unknowns.size()));
  for (const auto& load : posture.loads) {
    const double couple = load.couple + moment(model, posture, load.at, load.force);
    w.segment<3>(3 * load.link) -= Eigen::Vector3d(load.force[0], load.force[1], couple);
  }
  return w;
}

Reactions solve_reactions(const NumericModel& model, const Posture& posture) {
  const Eigen::MatrixXd A = newton_euler_matrix(model, posture);
  const Eigen::VectorXd b = load_column(model, posture);
  return solve_reactions(A, b, Eigen::PartialPivLU<Eigen::MatrixXd>(A));
}

Reactions solve_reactions(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                          const Eigen::PartialPivLU<Eigen::MatrixXd>& lu) {
  Reactions r;
  r.values = lu.solve(b);
  r.determinant = lu.determinant();
  const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(A).singularValues();
  r.condition = singular(0) / singular(singular.size() - 1);
  const double scale =
      A.cwiseAbs().rowwise().sum().maxCoeff() * r.values.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff();
  r.residual = scale == 0 ? 0 : (A * r.values - b).cwiseAbs().maxCoeff() / scale;
  return r;
}

namespace {

/// Registers, core and numerators of `Lanes` poses at once: scratch that lives as long as a call.
template <class T, int Lanes>
class Evaluator {
 public:
  Evaluator(const NumericModel& model, std::span<const int> mode)
      : model_(model),
        size_(model.elimination.core_unknowns.size()),
        inputs_(static_cast<std::size_t>(model.inputs()) * Lanes),
        registers_(model.tape.code.size() * Lanes),
        numerators_((model.unknowns.size() + 1) * Lanes),
        core_(size_ * (size_ + 1)),
        kernel_(size_ + 1) {
    core::ensure(mode.size() == model.dyads.size(), "a working mode has one sign for each dyad");
    for (std::size_t i = 0; i < mode.size(); ++i) {
      std::fill_n(inputs_.begin() + static_cast<std::ptrdiff_t>((model.box.size() + i) * Lanes), Lanes, T(mode[i]));
    }
  }

  T& input(std::size_t coordinate, int lane) { return inputs_[coordinate * Lanes + static_cast<std::size_t>(lane)]; }
  const T& numerator(std::size_t unknown, int lane) const {
    return numerators_[unknown * Lanes + static_cast<std::size_t>(lane)];
  }
  const T& determinant(int lane) const { return numerator(model_.unknowns.size(), lane); }

  void evaluate() {
    run<T, Lanes>(model_.tape, 0, static_cast<int>(model_.tape.code.size()), inputs_.data(), registers_.data());
    solve_core();
    for (const auto& step : model_.elimination.steps) substitute(step);
  }

  /// All points finite. Only after evaluate().
  bool reachable(int lane) const {
    double witness = 0;  // stays 0 unless something is infinite or NaN
    for (const auto& [x, y] : model_.points) witness += 0 * nominal(*at(x, lane)) + 0 * nominal(*at(y, lane));
    return witness == 0;
  }

 private:
  const T* at(Register r, int lane = 0) const {
    return registers_.data() + static_cast<std::ptrdiff_t>(r) * Lanes + lane;
  }
  T* out(int unknown) { return numerators_.data() + static_cast<std::ptrdiff_t>(unknown) * Lanes; }

  void solve_core() {
    const auto& e = model_.elimination;
    T* const determinant = out(e.unknowns);
    const T sign(e.sign);
    if (size_ == 2) {  // the cross product of the two rows, the same over all lanes
      const T *m00 = at(e.core[0]), *m01 = at(e.core[1]), *b0 = at(e.core[2]);
      const T *m10 = at(e.core[3]), *m11 = at(e.core[4]), *b1 = at(e.core[5]);
      T *n0 = out(e.core_unknowns[0]), *n1 = out(e.core_unknowns[1]);
      for (int l = 0; l < Lanes; ++l) {
        n0[l] = sign * (b0[l] * m11[l] - m01[l] * b1[l]);
        n1[l] = sign * (m00[l] * b1[l] - b0[l] * m10[l]);
        determinant[l] = sign * (m00[l] * m11[l] - m01[l] * m10[l]);
      }
      return;
    }
    for (int l = 0; l < Lanes; ++l) {
      for (std::size_t i = 0; i < e.core.size(); ++i) core_[i] = *at(e.core[i], l);
      kernel_vector<T>(static_cast<int>(size_), core_.data(), kernel_.data());
      for (std::size_t i = 0; i < size_; ++i) out(e.core_unknowns[i])[l] = sign * kernel_[i];
      determinant[l] = -(sign * kernel_[size_]);
    }
  }

  void substitute(const BackSubstitution& step) {
    const T* const determinant = out(model_.elimination.unknowns);
    T* const result = out(step.unknown);
    if (step.load >= 0) {
      const T* const load = at(step.load);
      for (int l = 0; l < Lanes; ++l) result[l] = load[l] * determinant[l];
    } else {
      std::fill(result, result + Lanes, T(0.0));
    }
    for (const auto& [factor, unknown] : step.terms) {
      const T* const a = at(factor);
      const T* const n = out(unknown);
      for (int l = 0; l < Lanes; ++l) result[l] = result[l] - a[l] * n[l];
    }
    const T pivot(step.pivot);
    for (int l = 0; l < Lanes; ++l) result[l] = pivot * result[l];
  }

  const NumericModel& model_;
  std::size_t size_;  ///< of the core
  std::vector<T> inputs_, registers_, numerators_, core_, kernel_;
};

}  // namespace

void reaction_field(const NumericModel& model, std::span<const double> poses, std::span<const int> mode,
                    ReactionField& field) {
  constexpr int lanes = 32;  // a few hundred registers of 32 doubles stay within the second-level cache
  // A mechanism without free coordinates has no poses to run through.
  const std::size_t coordinates = std::max<std::size_t>(1, model.box.size());
  core::ensure(coordinates == model.box.size() && poses.size() % coordinates == 0,
               "a pose has one value for each free coordinate");
  field.poses = poses.size() / coordinates;
  field.unknowns = static_cast<int>(model.unknowns.size());
  field.numerators.resize(field.poses * model.unknowns.size());
  field.determinants.resize(field.poses);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  Evaluator<double, lanes> evaluator(model, mode);
  for (std::size_t first = 0; first < field.poses; first += lanes) {
    const int count = static_cast<int>(std::min<std::size_t>(lanes, field.poses - first));
    for (int l = 0; l < lanes; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(std::min(l, count - 1));
      for (std::size_t c = 0; c < coordinates; ++c) evaluator.input(c, l) = poses[pose * coordinates + c];
    }
    evaluator.evaluate();
    for (int l = 0; l < count; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(l);
      const bool here = evaluator.reachable(l);
      field.determinants[pose] = here ? evaluator.determinant(l) : nan;
      for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
        field.numerators[k * field.poses + pose] = here ? evaluator.numerator(k, l) : nan;
      }
    }
  }
}

BoundedNumerators bounded_numerators(const NumericModel& model, std::span<const double> pose,
                                     std::span<const int> mode) {
  return bounded_numerators(model, std::vector<Bounded>(pose.begin(), pose.end()), mode);
}

BoundedNumerators bounded_numerators(const NumericModel& model, std::span<const Bounded> pose,
                                     std::span<const int> mode) {
  core::ensure(pose.size() == model.box.size(), "a pose has one value for each free coordinate");
  Evaluator<Bounded, 1> evaluator(model, mode);
  for (std::size_t c = 0; c < pose.size(); ++c) evaluator.input(c, 0) = pose[c];
  evaluator.evaluate();
  BoundedNumerators result;
  result.reachable = evaluator.reachable(0);
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) result.values.push_back(evaluator.numerator(k, 0));
  result.determinant = evaluator.determinant(0);
  return result;
}

bool reachable(const NumericModel& model, std::span<const double> pose, std::span<const int> mode) {
  return posture(model, pose, mode).reachable();
}

}  // namespace clearloci::numeric
