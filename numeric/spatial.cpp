#include "numeric/spatial.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/end_effector.hpp"
#include "numeric/tape.hpp"

namespace clearloci::numeric {

namespace {

using Eigen::Vector3d;
using mechanism::Mechanism;
using Vector6 = Eigen::Matrix<double, 6, 1>;

Vector6 wrench_of(const Vector3d& arm, const Vector3d& force, const Vector3d& couple) {
  Vector6 wrench;
  wrench << force, arm.cross(force) + couple;
  return wrench;
}

/// A column of A: what a unit of one unknown exerts at its joint.
struct Column {
  std::size_t joint;
  Vector3d force, couple;
  bool actuator;
};

class Solver {
 public:
  Solver(const Mechanism& m, std::span<const double> pose, std::span<const int> mode) : m_(m) {
    core::ensure(pose.size() == m.coordinates.size(), "a pose has one value for each free coordinate");
    for (const auto& parameter : m.parameters) values_[parameter.name] = core::to_double(parameter.value);
    for (std::size_t i = 0; i < pose.size(); ++i) values_[m.coordinates[i].name] = pose[i];
    const std::vector<mechanism::PointIndex> built = mechanism::dyad_points(m);
    const std::vector<int> own = mechanism::working_mode(m);
    core::ensure(mode.empty() || mode.size() == own.size(), "a working mode has one sign for each dyad");
    for (std::size_t i = 0; i < m.points.size(); ++i) {
      const auto found = std::find(built.begin(), built.end(), static_cast<mechanism::PointIndex>(i)) - built.begin();
      const auto k = static_cast<std::size_t>(found);
      points_.push_back(place(m.points[i].form, k == built.size() ? 0 : mode.empty() ? own[k] : mode[k]));
      if (!points_.back().allFinite() && !unreachable_) unreachable_ = static_cast<mechanism::PointIndex>(i);
    }
  }

  SpatialPosture solve() {
    if (unreachable_) {
      SpatialPosture nowhere;
      nowhere.points = points_;
      nowhere.unreachable = unreachable_;
      return nowhere;
    }
    for (std::size_t j = 0; j < m_.joints.size(); ++j) add_columns(j);
    const auto size = static_cast<Eigen::Index>(6 * m_.links.size());
    if (static_cast<Eigen::Index>(columns_.size()) != size)
      throw core::InputError({m_.file, 0, 0},
                             std::to_string(size) + " equations for " + std::to_string(columns_.size()) + " unknowns",
                             "change the joints or actuators");
    const Eigen::MatrixXd A = matrix(size);
    const Eigen::VectorXd b = loads(size);
    lu_.compute(A);
    const Eigen::VectorXd w = lu_.solve(b);
    SpatialPosture result;
    result.points = points_;
    result.determinant = lu_.determinant();
    const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(A).singularValues();
    result.condition = singular(0) / singular(size - 1);
    const double scale = A.cwiseAbs().rowwise().sum().maxCoeff() * w.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff();
    result.residual = scale == 0 ? 0 : (A * w - b).cwiseAbs().maxCoeff() / scale;
    result.reactions.resize(m_.joints.size());
    for (Eigen::Index k = 0; k < size; ++k) {
      const Column& column = columns_[static_cast<std::size_t>(k)];
      SpatialReaction& reaction = result.reactions[column.joint];
      if (column.actuator) {
        reaction.actuator = w(k);
        continue;
      }
      reaction.force += w(k) * column.force;
      reaction.couple += w(k) * column.couple;
    }
    return result;
  }

  SpatialAccuracy accuracy(const std::vector<LostContact>& lost) {
    core::ensure(!unreachable_, "a reachable pose");
    SpatialAccuracy result;
    result.posture = solve();
    result.joints = spatial_joints(m_);
    for (std::size_t j = 0; j < result.joints.size(); ++j) {
      SpatialJoint& joint = result.joints[j];
      if (!m_.joints[j].axes.empty()) joint.axis = axis(m_.joints[j], 0);
      const SpatialReaction& r = result.posture.reactions[j];
      const bool slides = mechanism::traits(joint.type).slides;
      const Vector3d share = r.actuator * joint.axis;
      result.take_up.push_back(take_up(joint, {slides ? Vector3d(r.force + share) : r.force, r.couple + share},
                                       lost.empty() ? LostContact{} : lost[j]));
      if (result.take_up.back().force_vanishes || result.take_up.back().actuator_vanishes)
        result.undefined.push_back(m_.joints[j].name);
    }
    add_influence(result);
    add_displacements(result);
    result.worst = worst_case(result.joints, result.influence);
    return result;
  }

 private:
  Eigen::MatrixXd matrix(Eigen::Index size) const {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index k = 0; k < size; ++k) {
      const Column& column = columns_[static_cast<std::size_t>(k)];
      const auto& joint = m_.joints[column.joint];
      const Vector6 wrench = wrench_of(arm(joint.at), column.force, column.couple);
      if (joint.to != mechanism::ground) A.block<6, 1>(6 * joint.to, k) += wrench;
      if (joint.from != mechanism::ground) A.block<6, 1>(6 * joint.from, k) -= wrench;
    }
    return A;
  }

  void add_influence(SpatialAccuracy& result) const {
    const auto size = static_cast<Eigen::Index>(columns_.size());
    const Eigen::MatrixXd H = lu_.solve(unit_wrenches<6>(m_, size)).transpose();
    result.influence.resize(m_.joints.size());
    for (Eigen::Index k = 0; k < size; ++k) {
      const Column& column = columns_[static_cast<std::size_t>(k)];
      result.influence[column.joint].force += H.col(k) * column.force.transpose();
      result.influence[column.joint].couple += H.col(k) * column.couple.transpose();
    }
  }

  void add_displacements(SpatialAccuracy& result) const {
    const auto size = static_cast<Eigen::Index>(columns_.size());
    if (!result.undefined.empty()) {
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      result.link_displacements.setConstant(size, nan);
      result.error.dp.setConstant(nan);
      result.error.dalpha.setConstant(nan);
      return;
    }
    Eigen::VectorXd relative(size);
    for (Eigen::Index k = 0; k < size; ++k) {
      const Column& column = columns_[static_cast<std::size_t>(k)];
      const SpatialTakeUp& own = result.take_up[column.joint];
      relative(k) = column.force.dot(own.displacement) + column.couple.dot(own.rotation);
    }
    result.link_displacements = lu_.transpose().solve(relative);
    const Vector6 own = end_effector_displacement<6>(m_, result.link_displacements);
    result.error = {own.tail<3>(), own.head<3>()};
  }

  double value(const core::Expression& expression) const {
    TapeBuilder tape;
    const Register result = tape.compile(expression, [&](const std::string& name) {
      const auto found = values_.find(name);
      core::ensure(found != values_.end(), "an expression of a mechanism uses no unknown name");
      return tape.constant(found->second);
    });
    std::vector<double> registers(static_cast<std::size_t>(tape.size()));
    run<double, 1>(tape.tape(), 0, tape.size(), nullptr, registers.data());
    return registers[static_cast<std::size_t>(result)];
  }

  const Vector3d& at(mechanism::PointIndex point) const { return points_[static_cast<std::size_t>(point)]; }
  Vector3d arm(mechanism::PointIndex point) const { return at(point) - at(m_.end_effector_point); }

  Vector3d components(const std::vector<core::Expression>& expressions) const {
    Vector3d result = Vector3d::Zero();
    for (std::size_t i = 0; i < expressions.size(); ++i) result(static_cast<Eigen::Index>(i)) = value(expressions[i]);
    return result;
  }

  /// `side`: of a dyad or slider.
  Vector3d place(const mechanism::PointForm& form, int side) const {
    if (const auto* dyad = std::get_if<mechanism::DyadPoint>(&form)) return elbow(*dyad, side);
    if (const auto* slider = std::get_if<mechanism::SliderPoint>(&form)) {
      // Where the line meets the sphere of radius l about C.
      const Vector3d u = vector(slider->along).normalized(), way = at(slider->base) - at(slider->from);
      const double p = u.dot(way), l = value(slider->length);
      return at(slider->base) + (-p + side * std::sqrt(p * p - way.squaredNorm() + l * l)) * u;
    }
    if (const auto* e = std::get_if<mechanism::ExplicitPoint>(&form)) return components(e->coordinates);
    if (const auto* mean = std::get_if<mechanism::MeanPoint>(&form)) return (at(mean->first) + at(mean->second)) / 2;
    const auto* offset = std::get_if<mechanism::OffsetPoint>(&form);
    core::ensure(offset != nullptr, "a construction of space");
    return at(offset->first) + value(offset->along) * (at(offset->second) - at(offset->first)).normalized();
  }

  /// The circle of radius a about A across the axis meets the sphere of radius b about P: in the angle t from the
  /// direction e of P in the circle's plane, a^2 + |P - A|^2 - b^2 = 2 a |e-part of P - A| cos t.
  Vector3d elbow(const mechanism::DyadPoint& dyad, int side) const {
    const Vector3d n = vector(*dyad.axis).normalized(), way = at(dyad.to) - at(dyad.from);
    const Vector3d in_plane = way - n.dot(way) * n, e = in_plane.normalized();
    const double a = value(dyad.from_length), b = value(dyad.to_length);
    const double t = side * std::acos((a * a + way.squaredNorm() - b * b) / (2 * a * in_plane.norm()));
    return at(dyad.from) + a * (std::cos(t) * e + std::sin(t) * n.cross(e));
  }

  Vector3d vector(const mechanism::VectorExpression& v) const {
    using Kind = mechanism::VectorExpression::Kind;
    switch (v.kind) {
      case Kind::components:
        return components(v.numbers);
      case Kind::point:
        return at(v.point);
      case Kind::add:
        return vector(v.arguments[0]) + vector(v.arguments[1]);
      case Kind::negate:
        return -vector(v.arguments[0]);
      case Kind::scale:
        return value(v.numbers[0]) * vector(v.arguments[0]);
      case Kind::cross:
        return vector(v.arguments[0]).cross(vector(v.arguments[1]));
    }
    return Vector3d::Zero();
  }

  Vector3d axis(const mechanism::Joint& joint, std::size_t i) const {
    const Vector3d v = vector(joint.axes.at(i));
    if (!(v.norm() > 0))
      throw core::InputError({m_.file, 0, 0}, "an axis of joint " + joint.name + " has no direction at this pose",
                             "choose another pose");
    return v.normalized();
  }

  /// Every unit force and couple that a joint bears.
  void add_columns(std::size_t j) {
    const auto& joint = m_.joints[j];
    const Vector3d none = Vector3d::Zero();
    const auto force = [&](const Vector3d& v) { columns_.push_back({j, v, none, false}); };
    const auto couple = [&](const Vector3d& v) { columns_.push_back({j, none, v, false}); };
    const std::array<Vector3d, 3> unit = {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
    const Vector3d u = joint.axes.empty() ? none : axis(joint, 0);
    const std::array<Vector3d, 2> across = {u.unitOrthogonal(), u.cross(u.unitOrthogonal())};
    const mechanism::JointTraits& own = mechanism::traits(joint);
    if (own.slides)
      for (const Vector3d& v : across) force(v);
    else
      for (const Vector3d& v : unit) force(v);
    if (joint.actuated && own.slides) columns_.push_back({j, u, none, true});
    if (own.couple == mechanism::BorneCouple::any)
      for (const Vector3d& v : unit) couple(v);
    if (own.turns_about_axis())
      for (const Vector3d& v : across) couple(v);
    if (own.couple == mechanism::BorneCouple::cross)
      couple(mechanism::holds_idle_freedom(joint) ? u : Vector3d(u.cross(axis(joint, 1)).normalized()));
    if (joint.actuated && !own.slides) columns_.push_back({j, none, u, true});
  }

  Eigen::VectorXd loads(Eigen::Index size) const {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
    for (const auto& load : m_.loads) {
      const Vector3d r = load.at ? arm(*load.at) : Vector3d::Zero();
      const Vector3d force = load.force_vector ? vector(*load.force_vector) : components(load.force);
      b.segment<6>(6 * load.link) -= wrench_of(r, force, components(load.couple_vector));
    }
    for (const auto& action : mechanism::actions(m_)) add_action(action, b);
    if (m_.gravity.empty()) return b;
    const Vector3d g = components(m_.gravity);
    for (const mechanism::Mass& body : mechanism::masses(m_)) {
      const double mass = value(body.mass);
      if (mass == 0) continue;
      b.segment<6>(6 * body.link) -= wrench_of(arm(body.at), mass * g, Vector3d::Zero());
    }
    return b;
  }

  /// What a spring or an actuator of known effort exerts on its two links.
  void add_action(const mechanism::Action& action, Eigen::VectorXd& b) const {
    using Law = mechanism::Action::Law;
    Vector3d force = Vector3d::Zero();
    if (action.law == Law::torsion) {
      const Vector3d u = axis(m_.joints[static_cast<std::size_t>(m_.springs[action.index].joint)], 0);
      force = -value(action.stiffness) * beyond_rest(action, u) * u;
    } else {
      const Vector3d v = vector(*action.along);
      const double tension = action.law == Law::constant
                                 ? value(action.effort)
                                 : value(action.stiffness) * (v.norm() - value(action.free_length));
      if (tension != 0) force = tension * v.normalized();
    }
    const auto put = [&](mechanism::LinkIndex link, mechanism::PointIndex at, const Vector3d& f) {
      if (link == mechanism::ground) return;
      b.segment<6>(6 * link) -=
          action.couple ? wrench_of(Vector3d::Zero(), Vector3d::Zero(), f) : wrench_of(arm(at), f, Vector3d::Zero());
    };
    put(action.on, action.on_point, force);
    put(action.by, action.by_point, -force);
  }

  Vector3d direction_of(mechanism::LinkIndex link) const {
    if (link == mechanism::ground) return Vector3d::UnitX();
    const auto& points = m_.links[static_cast<std::size_t>(link)].points;
    return at(points.at(1)) - at(points.at(0));
  }

  /// The angle about u from `by` to `on` less that at rest, within half a turn.
  double beyond_rest(const mechanism::Action& action, const Vector3d& u) const {
    const Vector3d a = Eigen::AngleAxisd(value(action.rest), u) * direction_of(action.by), b = direction_of(action.on);
    return std::atan2(u.dot(a.cross(b)), a.dot(b) - u.dot(a) * u.dot(b));
  }

  const Mechanism& m_;
  std::map<std::string, double> values_;
  std::vector<Vector3d> points_;
  std::optional<mechanism::PointIndex> unreachable_;
  std::vector<Column> columns_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

Solver solver(const Mechanism& m, std::span<const double> pose, std::span<const int> mode) {
  if (m.space != mechanism::Space::spatial)
    throw core::InputError({m.file, 0, 0}, "the mechanism is planar", "use the planar solver");
  return {m, pose, mode};
}

}  // namespace

SpatialPosture spatial_posture(const Mechanism& m, std::span<const double> pose, std::span<const int> mode) {
  return solver(m, pose, mode).solve();
}

SpatialAccuracy spatial_accuracy(const Mechanism& m, std::span<const double> pose, const std::vector<LostContact>& lost,
                                 std::span<const int> mode) {
  return solver(m, pose, mode).accuracy(lost);
}

}  // namespace clearloci::numeric
