#include "numeric/displaced.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/displaced_wheels.hpp"
#include "numeric/wrench_rows.hpp"

namespace clearloci::numeric {

namespace {

constexpr int most_iterations = 200;

/// A step below this many unit roundoffs of the mechanism's size is rounding: the pose is a fixed point.
constexpr double settled = 32 * unit_roundoff;

/// Beyond this condition number the take-up moves the end effector by more than 1e6 times itself or so: what is left of
/// the linear step is no starting point.
constexpr double most_condition = 1e12;

constexpr const char* far_away = "the displaced mechanism cannot be closed near this pose";

/// Every link moved from the nominal posture.
struct LinkMotion {
  Vector3d t = Vector3d::Zero();
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
};

Eigen::Quaterniond turned_by(const Vector3d& rotation) {
  const double angle = rotation.norm();
  return angle > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle)) : Eigen::Quaterniond::Identity();
}

/// Of less than a whole turn.
Vector3d rotation_vector(const Eigen::Quaterniond& q) {
  const double sine = q.vec().norm();
  return sine > 0 ? Vector3d(2 * std::atan2(sine, q.w()) / sine * q.vec()) : Vector3d::Zero();
}

class DisplacedMechanism {
 public:
  DisplacedMechanism(const NumericModel& model, const Posture& posture, const Accuracy& linear,
                     const std::vector<LinkMotion>& links)
      : model_(model), posture_(posture), links_(links), columns_(linear.columns), contacts_(linear.contacts) {
    for (std::size_t j = 0; j < contacts_.size(); ++j) contacts_[j].axis = rotation(joint(j).from) * contacts_[j].axis;
    for (ReactionColumn& column : columns_) turn(column);
    for (std::size_t j = 0; j < contacts_.size(); ++j) mesh(j);
  }

  const std::vector<ReactionColumn>& columns() const { return columns_; }
  const std::vector<JointContact>& contacts() const { return contacts_; }
  const Vector3d& reference() const { return point(model_.mechanism.end_effector_point); }
  const Vector3d& point(mechanism::PointIndex index) const { return posture_.points[static_cast<std::size_t>(index)]; }

  /// p' - E. Differences of such points keep the digits that absolute coordinates would lose.
  Vector3d moved(mechanism::LinkIndex link, const Vector3d& p) const { return translation(link) + arm(link, p); }

  Eigen::MatrixXd matrix() const {
    const auto size = static_cast<Eigen::Index>(columns_.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index k = 0; k < size; ++k) {
      const ReactionColumn& column = columns_[static_cast<std::size_t>(k)];
      const mechanism::Joint& joint_data = joint(static_cast<std::size_t>(column.joint));
      Vector3d to = arm(joint_data.to, point(joint_data.at)), from = arm(joint_data.from, point(joint_data.at));
      // What slides bears where its `to` is now.
      if (mechanism::traits(joint_data).slides)
        from = moved(joint_data.to, point(joint_data.at)) - translation(joint_data.from);
      if (const auto& line = meshes_[static_cast<std::size_t>(column.joint)]) {
        to = line->at - translation(joint_data.to);
        from = line->at - translation(joint_data.from);
      }
      add_wrench(model_.mechanism, joint_data.to, wrench_of(to, column.force, column.couple), 1, A.col(k));
      add_wrench(model_.mechanism, joint_data.from, wrench_of(from, column.force, column.couple), -1, A.col(k));
    }
    return A;
  }

  Eigen::VectorXd load_column() const {
    Eigen::VectorXd w = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns_.size()));
    for (const AppliedLoad& load : posture_.loads)
      if (load.spring < 0)
        add_wrench(model_.mechanism, load.link, wrench_of(arm(load.link, load.at), load.force, load.couple), -1, w);
    for (const mechanism::Spring& spring : model_.mechanism.springs) add_spring(spring, w);
    return w;
  }

  /// Relative displacements of the joints, in the directions of the columns, minus those that the take-up wants.
  Eigen::VectorXd closure(const std::vector<TakeUp>& take_up) const {
    Eigen::VectorXd r = -clearance_displacements(columns_, take_up);
    for (Eigen::Index k = 0; k < r.size(); ++k) {
      const ReactionColumn& column = columns_[static_cast<std::size_t>(k)];
      const auto j = static_cast<std::size_t>(column.joint);
      const mechanism::Joint& joint_data = joint(j);
      if (meshes_[j])
        r(k) += meshes_[j]->apart;
      else if (column.force != Vector3d::Zero())
        r(k) +=
            column.force.dot(moved(joint_data.to, point(joint_data.at)) - moved(joint_data.from, point(joint_data.at)));
      else if (is_cross(joint_data))
        r(k) += cross_closure(j);
      else
        r(k) += column.couple.dot(relative_rotation(joint_data));
    }
    return r;
  }

 private:
  const mechanism::Joint& joint(std::size_t j) const { return model_.mechanism.joints[j]; }
  const Eigen::Quaterniond& rotation(mechanism::LinkIndex link) const {
    static const Eigen::Quaterniond none = Eigen::Quaterniond::Identity();
    return link == mechanism::ground ? none : links_[static_cast<std::size_t>(link)].q;
  }
  Vector3d translation(mechanism::LinkIndex link) const {
    return link == mechanism::ground ? Vector3d::Zero() : links_[static_cast<std::size_t>(link)].t;
  }
  /// p' - (E + t_i): the arm of a point of link i; of the ground, p - E.
  Vector3d arm(mechanism::LinkIndex link, const Vector3d& p) const { return rotation(link) * (p - reference()); }
  Vector3d relative_rotation(const mechanism::Joint& joint) const {
    return rotation_vector(rotation(joint.to) * rotation(joint.from).conjugate());
  }

  static bool is_cross(const mechanism::Joint& joint) {
    return joint.type == mechanism::JointType::universal && !mechanism::holds_idle_freedom(joint);
  }

  double value(const core::Expression& e) const { return core::to_double(mechanism::value_of(e, model_.mechanism)); }

  /// Of constants and points, as axes are.
  Vector3d vector(const mechanism::VectorExpression& v) const {
    using Kind = mechanism::VectorExpression::Kind;
    switch (v.kind) {
      case Kind::components:
        return {value(v.numbers[0]), value(v.numbers[1]), v.numbers.size() > 2 ? value(v.numbers[2]) : 0};
      case Kind::point:
        return point(v.point);
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
  Vector3d second_axis(const mechanism::Joint& joint) const { return vector(joint.axes[1]).normalized(); }

  /// A column of the nominal posture in the displaced one.
  void turn(ReactionColumn& column) const {
    const auto j = static_cast<std::size_t>(column.joint);
    const mechanism::Joint& joint_data = joint(j);
    const Eigen::Quaterniond& q = rotation(joint_data.from);
    if (mechanism::traits(joint_data).slides) column.force = q * column.force;
    if (is_cross(joint_data) && column.couple != Vector3d::Zero())
      column.couple = contacts_[j].axis.cross(rotation(joint_data.to) * second_axis(joint_data)).normalized();
    else if (mechanism::traits(joint_data).turns_about_axis() || column.actuator)
      column.couple = q * column.couple;
  }

  /// A relative turn by a small rotation w changes u1' . u2' by -w . (u1' x u2').
  double cross_closure(std::size_t j) const {
    const Vector3d &first = posture_.axes[j], second = second_axis(joint(j));
    const Vector3d now = rotation(joint(j).to) * second;
    // u1' . u2' - u1 . u2 without the digits that such a difference would lose.
    const double difference = (contacts_[j].axis - first).dot(now) + first.dot(now - second);
    return -difference / first.cross(second).norm();
  }

  /// Springs pull with the length, and turn with the angle, that they have now.
  void add_spring(const mechanism::Spring& spring, Eigen::VectorXd& w) const {
    const mechanism::Mechanism& m = model_.mechanism;
    if (spring.kind == mechanism::Spring::Kind::torsion) {
      const auto index = static_cast<int>(&spring - m.springs.data());
      const auto j = static_cast<std::size_t>(spring.joint);
      const Vector3d& axis = contacts_[j].axis;
      const double more = value(spring.stiffness) * axis.dot(relative_rotation(joint(j)));
      for (const AppliedLoad& load : posture_.loads) {
        if (load.spring != index) continue;
        const Vector3d couple = rotation(joint(j).from) * load.couple + (load.link == spring.to ? -more : more) * axis;
        add_wrench(m, load.link, wrench_of(Vector3d::Zero(), Vector3d::Zero(), couple), -1, w);
      }
      return;
    }
    const Vector3d p = moved(spring.from, point(spring.from_point)), q = moved(spring.to, point(spring.to_point));
    const double length = (q - p).norm();
    const double tension = spring.kind == mechanism::Spring::Kind::constant_force
                               ? value(spring.force) * share_along(spring)
                               : value(spring.stiffness) * (length - value(spring.free_length));
    if (length == 0) return;
    const Vector3d force = tension / length * (q - p);
    const auto put = [&](mechanism::LinkIndex link, mechanism::PointIndex at, double sign) {
      if (link == mechanism::ground) return;
      add_wrench(m, link, wrench_of(arm(link, point(at)), force, Vector3d::Zero()), -sign, w);
    };
    put(spring.from, spring.from_point, 1);
    put(spring.to, spring.to_point, -1);
  }

  /// Of a belt, whose spans are inclined to the line of the centres: what they pull along it now over what they did.
  double share_along(const mechanism::Spring& spring) const {
    const auto& joints = model_.mechanism.joints;
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (meshes_[j] && joints[j].name == spring.name) return meshes_[j]->along;
    return 1;
  }

  double turned(mechanism::LinkIndex link) const { return rotation_vector(rotation(link)).z(); }

  /// Teeth and belts with another force than along a constant line, where their wheels are now.
  void mesh(std::size_t j) {
    meshes_.emplace_back();
    const mechanism::Joint& joint_data = joint(j);
    if (!joint_data.meshing || joint_data.axes.empty()) return;
    const mechanism::Meshing& wheels = *joint_data.meshing;
    const Wheels before{point(wheels.first) - reference(), wheels.second ? point(*wheels.second) - reference() : none(),
                        point(joint_data.at) - reference(), posture_.axes[j]};
    const Vector3d first = moved(joint_data.from, point(wheels.first));
    if (!wheels.flank)
      meshes_[j] = before.belt(first, moved(joint_data.to, point(*wheels.second)), value(wheels.radius),
                               turned(joint_data.from), turned(joint_data.to));
    else if (wheels.second)
      meshes_[j] = before.teeth(first, moved(joint_data.to, point(*wheels.second)), turned(joint_data.from),
                                turned(joint_data.to));
    else
      meshes_[j] = before.rack(first, moved(joint_data.to, point(joint_data.at)), rotation(joint_data.to),
                               turned(joint_data.from), turned(joint_data.to));
    for (ReactionColumn& column : columns_)
      if (column.joint == static_cast<mechanism::JointIndex>(j)) column.force = meshes_[j]->force;
    contacts_[j].axis = meshes_[j]->force / meshes_[j]->force.squaredNorm();
  }
  static Vector3d none() { return Vector3d::Zero(); }

  const NumericModel& model_;
  const Posture& posture_;
  const std::vector<LinkMotion>& links_;
  std::vector<ReactionColumn> columns_;
  std::vector<JointContact> contacts_;
  std::vector<std::optional<Meshed>> meshes_;
};

/// Couples of clearance joints that changed sign between two iterates.
std::string reversed_couple(const NumericModel& model, const std::vector<TakeUp>& a, const std::vector<TakeUp>& b) {
  for (std::size_t j = 0; j < a.size(); ++j)
    if (a[j].turn * b[j].turn < 0) return model.mechanism.joints[j].name;
  return {};
}

std::string names(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& name : list) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::vector<std::vector<Vector3d>> displaced_points(const NumericModel& model, const DisplacedMechanism& displaced) {
  std::vector<std::vector<Vector3d>> all;
  for (std::size_t i = 0; i < model.mechanism.links.size(); ++i) {
    std::vector<Vector3d> points;
    for (const mechanism::PointIndex p : model.mechanism.links[i].points)
      points.emplace_back(displaced.reference() + displaced.moved(static_cast<int>(i), displaced.point(p)));
    all.push_back(std::move(points));
  }
  return all;
}

class Iteration {
 public:
  Iteration(const NumericModel& model, const Posture& posture, const Accuracy& linear)
      : model_(model), posture_(posture), linear_(linear), rows_(rows_of_link(model.mechanism)) {
    size_ = typical_length(model, posture);
    links_.resize(model.mechanism.links.size());
  }

  ActualPose run() {
    if (!linear_.undefined.empty()) return refuse("the take-up of " + names(linear_.undefined) + " is undefined here");
    if (!(linear_.reactions.condition < most_condition)) return refuse("the pose is at a direct singularity");
    if (!is_near(linear_.link_displacements)) return refuse(far_away);
    move(linear_.link_displacements);
    result_.take_up = linear_.take_up;
    for (result_.iterations = 1; result_.iterations <= most_iterations; ++result_.iterations) {
      const double step = advance();
      if (!result_.reason.empty()) return refuse(result_.reason);
      if (step <= settled * (1 + displacements().cwiseAbs().maxCoeff() / size_)) return finish();
    }
    result_.iterations = most_iterations;
    if (!reversed_.empty())
      return refuse("the couple of " + reversed_ + " changes its sign as the clearances are taken up, again and again");
    return refuse("the take-up does not settle: a reaction turns faster than the geometry follows");
  }

 private:
  ActualPose refuse(const std::string& reason) {
    result_.converged = false;
    result_.reason = reason;
    return result_;
  }

  /// A link that turns by a radian, or moves as far as its length or so, has left the neighbourhood in which the linear
  /// step means anything: what is closed there is another posture.
  bool is_near(const Eigen::VectorXd& u) const {
    double most = 0;
    for (Eigen::Index i = 0; i < u.size(); ++i) most = std::max(most, size_of(u, i));
    return most < 1;
  }
  /// Of one component of displacements, in units of the mechanism's (lengths) and in rad.
  double size_of(const Eigen::VectorXd& u, Eigen::Index i) const {
    const bool length = wrench_rows(model_.mechanism.space)[static_cast<std::size_t>(i % rows_)] < 3;
    return std::isfinite(u(i)) ? std::abs(u(i)) / (length ? size_ : 1) : std::numeric_limits<double>::infinity();
  }

  void move(const Eigen::VectorXd& by) {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const Vector6 displacement =
          six_of(model_.mechanism.space, by.segment(rows_ * static_cast<Eigen::Index>(i), rows_));
      links_[i].t += displacement.head<3>();
      links_[i].q = (turned_by(displacement.tail<3>()) * links_[i].q).normalized();
    }
  }

  Eigen::VectorXd displacements() const {
    const std::vector<Eigen::Index>& rows = wrench_rows(model_.mechanism.space);
    Eigen::VectorXd u(rows_ * static_cast<Eigen::Index>(links_.size()));
    for (std::size_t i = 0; i < links_.size(); ++i) {
      Vector6 displacement;
      displacement << links_[i].t, rotation_vector(links_[i].q);
      for (Eigen::Index r = 0; r < rows_; ++r)
        u(rows_ * static_cast<Eigen::Index>(i) + r) = displacement(rows[static_cast<std::size_t>(r)]);
    }
    return u;
  }

  /// One step; its size in units of the mechanism's (lengths) and in rad.
  double advance() {
    const DisplacedMechanism displaced(model_, posture_, linear_, links_);
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(displaced.matrix());
    const double determinant = lu.determinant();
    if (!std::isfinite(determinant) || determinant * linear_.reactions.determinant <= 0) {
      result_.reason = "taking up the clearances leads through a direct singularity";
      return 0;
    }
    result_.reactions = lu.solve(displaced.load_column());
    std::vector<TakeUp> next = take_up(
        displaced.contacts(), joint_reactions(model_.mechanism.joints.size(), displaced.columns(), result_.reactions));
    if (const auto undefined = undefined_take_up(model_.mechanism, displaced.contacts(), next); !undefined.empty()) {
      result_.reason = "the take-up of " + names(undefined) + " becomes undefined in the displaced geometry";
      return 0;
    }
    reversed_ = reversed_couple(model_, result_.take_up, next);
    result_.take_up = std::move(next);
    const Eigen::VectorXd step = lu.transpose().solve(displaced.closure(result_.take_up));
    move(-step);
    double most = 0;
    for (Eigen::Index i = 0; i < step.size(); ++i) most = std::max(most, size_of(step, i));
    if (!is_near(displacements())) result_.reason = far_away;
    return most;
  }

  /// A gear whose teeth would have to pull in the displaced geometry; empty without one.
  std::string pulled(const DisplacedMechanism& displaced) const {
    for (std::size_t k = 0; k < displaced.columns().size(); ++k) {
      const mechanism::Joint& joint = model_.mechanism.joints[static_cast<std::size_t>(displaced.columns()[k].joint)];
      const bool teeth = joint.meshing && joint.meshing->flank;
      const double was = linear_.reactions.values(static_cast<Eigen::Index>(k));
      if (teeth && result_.reactions(static_cast<Eigen::Index>(k)) * was < 0) return joint.name;
    }
    return {};
  }

  ActualPose finish() {
    const DisplacedMechanism displaced(model_, posture_, linear_, links_);
    if (const std::string gear = pulled(displaced); !gear.empty())
      return refuse("the load presses the other flank of gear " + gear + " as the clearances are taken up");
    result_.converged = true;
    result_.residual = displaced.closure(result_.take_up).cwiseAbs().maxCoeff();
    result_.displacements = displacements();
    const Vector6 displacement = end_effector_displacement(model_.mechanism, result_.displacements);
    result_.error = {displacement.tail<3>(), displacement.head<3>()};
    result_.beyond_linear = {result_.error.dalpha - linear_.error.dalpha, result_.error.dp - linear_.error.dp};
    result_.link_points = displaced_points(model_, displaced);
    return result_;
  }

  const NumericModel& model_;
  const Posture& posture_;
  const Accuracy& linear_;
  Eigen::Index rows_;
  double size_ = 1;
  std::vector<LinkMotion> links_;
  std::string reversed_;
  ActualPose result_;
};

}  // namespace

ActualPose actual_pose(const NumericModel& model, const Posture& posture, const Accuracy& linear) {
  core::ensure(posture.reachable(), "the posture is reachable");
  return Iteration(model, posture, linear).run();
}

}  // namespace clearloci::numeric
