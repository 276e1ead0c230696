#include "numeric/reactions.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "numeric/evaluator.hpp"

namespace clearloci::numeric {

namespace {

const Point2& point_of(const Posture& posture, int index) { return posture.points[static_cast<std::size_t>(index)]; }

/// Moment about the end-effector point of `force` at `at`.
double moment(const NumericModel& model, const Posture& posture, const Point2& at, const Point2& force) {
  const Point2& reference = point_of(posture, model.mechanism.end_effector_point);
  return (at[0] - reference[0]) * force[1] - (at[1] - reference[1]) * force[0];
}

/// Force and moment of a unit of an unknown.
Eigen::Vector3d unit_wrench(const NumericModel& model, const Posture& posture, const mechanism::Unknown& unknown) {
  using core::Quantity;
  const auto& joint = model.mechanism.joints[static_cast<std::size_t>(unknown.joint)];
  const Point2& u = posture.axes[static_cast<std::size_t>(unknown.joint)];
  Point2 force{};
  switch (unknown.quantity) {
    case Quantity::fx:
      force = {1, 0};
      break;
    case Quantity::fy:
      force = {0, 1};
      break;
    case Quantity::N:
      force = {-u[1], u[0]};
      break;
    case Quantity::F:
      force = u;
      break;
    default:
      return {0, 0, 1};  // a couple
  }
  return {force[0], force[1], moment(model, posture, point_of(posture, joint.at), force)};
}

}  // namespace

Eigen::MatrixXd newton_euler_matrix(const NumericModel& model, const Posture& posture) {
  core::ensure(posture.reachable(), "the posture is reachable");
  const auto size = static_cast<Eigen::Index>(model.unknowns.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index column = 0; column < size; ++column) {
    const auto& unknown = model.unknowns[static_cast<std::size_t>(column)];
    const auto& joint = model.mechanism.joints[static_cast<std::size_t>(unknown.joint)];
    const Eigen::Vector3d wrench = unit_wrench(model, posture, unknown);
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

  Evaluator<double, lanes> evaluator(model, mode, model.reaction_size);
  std::vector<double> numerators((model.unknowns.size() + 1) * lanes);
  const auto numerator = [&](std::size_t k, int lane) {
    return numerators[k * lanes + static_cast<std::size_t>(lane)];
  };
  for (std::size_t first = 0; first < field.poses; first += lanes) {
    const int count = static_cast<int>(std::min<std::size_t>(lanes, field.poses - first));
    for (int l = 0; l < lanes; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(std::min(l, count - 1));
      for (std::size_t c = 0; c < coordinates; ++c) evaluator.input(c, l) = poses[pose * coordinates + c];
    }
    evaluator.run_tape();
    evaluator.solve(model.elimination, numerators.data());
    for (int l = 0; l < count; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(l);
      const bool here = evaluator.reachable(l);
      field.determinants[pose] = here ? numerator(model.unknowns.size(), l) : nan;
      for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
        field.numerators[k * field.poses + pose] = here ? numerator(k, l) : nan;
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
  Evaluator<Bounded, 1> evaluator(model, mode, model.reaction_size);
  for (std::size_t c = 0; c < pose.size(); ++c) evaluator.input(c, 0) = pose[c];
  evaluator.run_tape();
  BoundedNumerators result;
  result.reachable = evaluator.reachable(0);
  result.values.resize(model.unknowns.size() + 1);
  evaluator.solve(model.elimination, result.values.data());
  result.determinant = result.values.back();
  result.values.pop_back();
  return result;
}

bool reachable(const NumericModel& model, std::span<const double> pose, std::span<const int> mode) {
  core::ensure(pose.size() == model.box.size(), "a pose has one value for each free coordinate");
  Evaluator<double, 1> evaluator(model, mode, model.posture_size);
  for (std::size_t c = 0; c < pose.size(); ++c) evaluator.input(c, 0) = pose[c];
  evaluator.run_tape();
  return evaluator.reachable(0);
}

}  // namespace clearloci::numeric
