#include "numeric/reactions.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/evaluator.hpp"
#include "numeric/wrench_rows.hpp"

namespace clearloci::numeric {

namespace {

using core::Quantity;
using mechanism::JointIndex;

Vector3d arm_of(const NumericModel& model, const Posture& posture, const Vector3d& at) {
  return at - posture.points[static_cast<std::size_t>(model.mechanism.end_effector_point)];
}

/// Every unit force and couple that a joint in space bears, its actuator's effort last of each kind.
void add_columns(const mechanism::Joint& joint, JointIndex j, const Vector3d& u, const Vector3d& couple_axis,
                 std::vector<ReactionColumn>& columns) {
  const Vector3d none = Vector3d::Zero();
  const auto force = [&](const Vector3d& v) { columns.push_back({j, v, none, false}); };
  const auto couple = [&](const Vector3d& v) { columns.push_back({j, none, v, false}); };
  const std::array<Vector3d, 3> unit = {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  const std::array<Vector3d, 2> across = {u.unitOrthogonal(), u.cross(u.unitOrthogonal())};
  const mechanism::JointTraits& traits = mechanism::traits(joint);
  if (mechanism::is_cable(joint)) {
    for (std::size_t c = 0; c < 3 && joint.holds_turning; ++c) couple(unit[c]);
    if (joint.actuated) columns.push_back({j, u, none, true});
    return;
  }
  if (traits.slides)
    for (const Vector3d& v : across) force(v);
  else
    for (const Vector3d& v : unit) force(v);
  if (joint.actuated && traits.slides) columns.push_back({j, u, none, true});
  if (traits.couple == mechanism::BorneCouple::any)
    for (const Vector3d& v : unit) couple(v);
  if (traits.turns_about_axis())
    for (const Vector3d& v : across) couple(v);
  if (traits.couple == mechanism::BorneCouple::cross) couple(couple_axis);
  if (joint.actuated && !traits.slides) columns.push_back({j, none, u, true});
}

/// The force of a gear, which has to push, or the couple of a belt.
struct Teeth {
  std::size_t column = 0;
  std::size_t determinant = 0;
  double most = 0;  ///< of a belt, N m; 0 of a gear
};

std::vector<Teeth> teeth_of(const NumericModel& model) {
  std::vector<Teeth> all;
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    const mechanism::Joint& joint = model.mechanism.joints[static_cast<std::size_t>(model.unknowns[k].joint)];
    if (!joint.meshing) continue;
    const bool gear = joint.meshing->flank.has_value();
    all.push_back({k, model.unknowns.size(),
                   gear ? 0 : core::to_double(mechanism::value_of(joint.meshing->most, model.mechanism))});
  }
  return all;
}

double least(double value) { return value; }
/// What it may be: a value that cannot be told from zero is no reason to refuse a pose.
double least(const Bounded& bounded) { return bounded.value + bounded.error; }

/// The first flank of the working mode that does not bear, or belt with a slack span; the end: none.
/// `numerator`: of a column.
template <class Numerator>
std::vector<Teeth>::const_iterator unmet(const std::vector<Teeth>& all, const Numerator& numerator) {
  return std::find_if(all.begin(), all.end(), [&](const Teeth& teeth) {
    const auto n = numerator(teeth.column), d = numerator(teeth.determinant);
    if (teeth.most == 0) return least(n * d) < 0;
    return least(d * d * decltype(d)(teeth.most * teeth.most) - n * n) < 0;
  });
}

/// Of a planar joint with the axis u, k where it turns: N across the guide, along k × u.
ReactionColumn planar_column(JointIndex j, Quantity quantity, const Vector3d& u) {
  const Vector3d none = Vector3d::Zero(), k = Vector3d::UnitZ();
  switch (quantity) {
    case Quantity::fx:
      return {j, Vector3d::UnitX(), none, false};
    case Quantity::fy:
      return {j, Vector3d::UnitY(), none, false};
    case Quantity::N:
      return {j, {-u.y(), u.x(), 0}, none, false};
    case Quantity::F:
      return {j, u, none, true};
    default:
      return {j, none, k, quantity == Quantity::M};
  }
}

}  // namespace

std::vector<ReactionColumn> reaction_columns(const mechanism::Mechanism& m, const std::vector<Vector3d>& axes,
                                             const std::vector<Vector3d>& couple_axes) {
  std::vector<ReactionColumn> columns;
  if (m.space == mechanism::Space::planar) {
    for (const auto& [j, quantity] : mechanism::unknowns(m))
      columns.push_back(planar_column(j, quantity, axes[static_cast<std::size_t>(j)]));
    return columns;
  }
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    add_columns(m.joints[j], static_cast<JointIndex>(j), axes[j], couple_axes[j], columns);
  return columns;
}

std::vector<ReactionColumn> reaction_columns(const NumericModel& model, const Posture& posture) {
  return reaction_columns(model.mechanism, posture.axes, posture.couple_axes);
}

std::vector<ReactionColumn> unknown_columns(const NumericModel& model, const std::vector<Vector3d>& axes,
                                            const std::vector<Vector3d>& couple_axes) {
  if (model.mechanism.space == mechanism::Space::planar) return reaction_columns(model.mechanism, axes, couple_axes);
  std::vector<ReactionColumn> columns;
  for (const auto& [j, quantity] : model.unknowns) {
    const Vector3d none = Vector3d::Zero();
    const int component = static_cast<int>(quantity);
    constexpr int force = static_cast<int>(Quantity::fx), couple = static_cast<int>(Quantity::mx);
    if (component >= force && component < force + 3)
      columns.push_back({j, Vector3d::Unit(component - force), none, false});
    else if (component >= couple && component < couple + 3)
      columns.push_back({j, none, Vector3d::Unit(component - couple), false});
    else if (quantity == Quantity::T)
      columns.push_back({j, none, couple_axes[static_cast<std::size_t>(j)], false});
    else if (mechanism::is_cable(model.mechanism.joints[static_cast<std::size_t>(j)]))
      columns.push_back({j, axes[static_cast<std::size_t>(j)], none, true});
    else
      columns.push_back({j, none, none, true});
  }
  return columns;
}

Eigen::MatrixXd newton_euler_matrix(const NumericModel& model, const Posture& posture) {
  core::ensure(posture.reachable(), "the posture is reachable");
  const mechanism::Mechanism& m = model.mechanism;
  const std::vector<ReactionColumn> columns = reaction_columns(model, posture);
  const Eigen::Index size = rows_of_link(m) * static_cast<Eigen::Index>(m.links.size());
  core::ensure(static_cast<Eigen::Index>(columns.size()) == size, "the equations are square");
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const ReactionColumn& column = columns[static_cast<std::size_t>(k)];
    const mechanism::Joint& joint = m.joints[static_cast<std::size_t>(column.joint)];
    const Vector3d arm = arm_of(model, posture, posture.points[static_cast<std::size_t>(joint.at)]);
    const Vector6 wrench = wrench_of(arm, column.force, column.couple);
    add_wrench(m, joint.to, wrench, 1, A.col(k));
    add_wrench(m, joint.from, wrench, -1, A.col(k));
  }
  return A;
}

Eigen::VectorXd load_column(const NumericModel& model, const Posture& posture) {
  core::ensure(posture.reachable(), "the posture is reachable");
  const mechanism::Mechanism& m = model.mechanism;
  Eigen::VectorXd w = Eigen::VectorXd::Zero(rows_of_link(m) * static_cast<Eigen::Index>(m.links.size()));
  for (const AppliedLoad& load : posture.loads)
    add_wrench(m, load.link, wrench_of(arm_of(model, posture, load.at), load.force, load.couple), -1, w);
  return w;
}

std::vector<JointReaction> joint_reactions(std::size_t joints, const std::vector<ReactionColumn>& columns,
                                           const Eigen::VectorXd& values) {
  std::vector<JointReaction> all(joints);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double w = values(static_cast<Eigen::Index>(k));
    JointReaction& reaction = all[static_cast<std::size_t>(columns[k].joint)];
    if (columns[k].actuator) {
      reaction.actuator = w;
      continue;
    }
    reaction.force += w * columns[k].force;
    reaction.couple += w * columns[k].couple;
  }
  return all;
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

  const std::vector<Teeth> teeth = teeth_of(model);
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
      const bool here =
          evaluator.reachable(l) && unmet(teeth, [&](std::size_t k) { return numerator(k, l); }) == teeth.end();
      field.determinants[pose] = here ? numerator(model.unknowns.size(), l) : nan;
      for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
        field.numerators[k * field.poses + pose] = here ? numerator(k, l) : nan;
      }
    }
  }
}

std::array<Bounded, 3> across(const std::array<Bounded, 3>& u, std::span<const Bounded> f) {
  std::array<Bounded, 3> parts;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    parts[i] = u[j] * f[k] - u[k] * f[j];
  }
  return parts;
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
  const std::vector<Teeth> teeth = teeth_of(model);
  if (const auto broken = unmet(teeth, [&](std::size_t k) { return result.values[k]; });
      result.reachable && broken != teeth.end()) {
    result.reachable = false;
    result.unmet = model.unknowns[broken->column].joint;
  }
  result.values.pop_back();
  if (model.mechanism.space == mechanism::Space::planar || !result.reachable) return result;
  for (const std::optional<Triple>& axis : model.axes) {
    std::array<Bounded, 3>& values = result.axes.emplace_back();
    for (std::size_t c = 0; axis && c < 3; ++c) values[c] = evaluator.value((*axis)[c], 0);
  }
  return result;
}

std::array<Bounded, 3> bounded_way(const NumericModel& model, const std::array<mechanism::PointIndex, 2>& points,
                                   std::span<const double> pose, std::span<const int> mode) {
  Evaluator<Bounded, 1> evaluator(model, mode, model.posture_size);
  for (std::size_t c = 0; c < pose.size(); ++c) evaluator.input(c, 0) = Bounded(pose[c]);
  evaluator.run_tape();
  const auto place = [&](std::size_t which, std::size_t c) {
    return evaluator.value(model.points[static_cast<std::size_t>(points[which])][c], 0);
  };
  return {place(1, 0) - place(0, 0), place(1, 1) - place(0, 1), place(1, 2) - place(0, 2)};
}

bool reachable(const NumericModel& model, std::span<const double> pose, std::span<const int> mode) {
  core::ensure(pose.size() == model.box.size(), "a pose has one value for each free coordinate");
  if (!teeth_of(model).empty()) return bounded_numerators(model, pose, mode).reachable;
  Evaluator<double, 1> evaluator(model, mode, model.posture_size);
  for (std::size_t c = 0; c < pose.size(); ++c) evaluator.input(c, 0) = pose[c];
  evaluator.run_tape();
  return evaluator.reachable(0);
}

}  // namespace clearloci::numeric
