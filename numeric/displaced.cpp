#include "numeric/displaced.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/wrench_rows.hpp"

namespace clearloci::numeric {

namespace {

constexpr int most_iterations = 200;

/// A step below this many unit roundoffs of the mechanism's size is rounding: the pose is a fixed point.
constexpr double settled = 32 * unit_roundoff;

/// Beyond this condition number the take-up moves the end effector by more than 1e6 times itself or so: what is left of
/// the linear step is no starting point.
constexpr double most_condition = 1e12;

class DisplacedMechanism {
 public:
  DisplacedMechanism(const NumericModel& model, const Posture& posture, const Eigen::VectorXd& u)
      : model_(model), posture_(posture), u_(u) {}

  Point2 reference() const { return point(model_.mechanism.end_effector_point); }
  Point2 point(mechanism::PointIndex index) const { return in_plane(posture_.points[static_cast<std::size_t>(index)]); }

  /// p' - (E + t_i): the arm of a point of link i; of the ground, p - E.
  Point2 arm(mechanism::LinkIndex link, const Point2& p) const {
    const Point2 E = reference();
    const Point2 r = {p[0] - E[0], p[1] - E[1]};
    if (link == mechanism::ground) return r;
    const double c = std::cos(u_(3 * link + 2)), s = std::sin(u_(3 * link + 2));
    return {c * r[0] - s * r[1], s * r[0] + c * r[1]};
  }

  /// p' - E. Differences of such points keep the digits that absolute coordinates would lose.
  Point2 moved(mechanism::LinkIndex link, const Point2& p) const {
    const Point2 r = arm(link, p);
    return link == mechanism::ground ? r : Point2{r[0] + u_(3 * link), r[1] + u_(3 * link + 1)};
  }

  Eigen::MatrixXd matrix() const {
    const auto size = static_cast<Eigen::Index>(model_.unknowns.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index column = 0; column < size; ++column) {
      const mechanism::Unknown& unknown = model_.unknowns[static_cast<std::size_t>(column)];
      const mechanism::Joint& joint = model_.mechanism.joints[static_cast<std::size_t>(unknown.joint)];
      for (const int sign : {1, -1}) {
        const mechanism::LinkIndex link = sign > 0 ? joint.to : joint.from;
        if (link == mechanism::ground) continue;
        const Point2 r = arm(link, point(joint.at));
        const Eigen::Vector3d wrench = unknown.quantity == core::Quantity::fx   ? Eigen::Vector3d(1, 0, -r[1])
                                       : unknown.quantity == core::Quantity::fy ? Eigen::Vector3d(0, 1, r[0])
                                                                                : Eigen::Vector3d(0, 0, 1);
        A.block<3, 1>(3 * link, column) += sign * wrench;
      }
    }
    return A;
  }

  Eigen::VectorXd load_column() const {
    Eigen::VectorXd w = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model_.unknowns.size()));
    for (const AppliedLoad& load : posture_.loads) {
      if (load.spring >= 0) continue;
      const Point2 r = arm(load.link, in_plane(load.at));
      w.segment<3>(3 * load.link) -=
          Vector3d(load.force[0], load.force[1], load.couple[2] + r[0] * load.force[1] - r[1] * load.force[0]);
    }
    for (const mechanism::Spring& spring : model_.mechanism.springs) add_spring(spring, w);
    return w;
  }

  /// Relative displacements of the joints minus those that the take-up wants.
  Eigen::VectorXd closure(const Eigen::VectorXd& wanted) const {
    Eigen::VectorXd r = -wanted;
    for (Eigen::Index k = 0; k < r.size(); ++k) {
      const mechanism::Unknown& unknown = model_.unknowns[static_cast<std::size_t>(k)];
      const mechanism::Joint& joint = model_.mechanism.joints[static_cast<std::size_t>(unknown.joint)];
      const Point2 p = point(joint.at);
      const auto value = [&](mechanism::LinkIndex link) {
        if (unknown.quantity == core::Quantity::M) return link == mechanism::ground ? 0.0 : u_(3 * link + 2);
        return moved(link, p)[unknown.quantity == core::Quantity::fx ? 0 : 1];
      };
      r(k) += value(joint.to) - value(joint.from);
    }
    return r;
  }

 private:
  double value(const core::Expression& e) const { return core::to_double(mechanism::value_of(e, model_.mechanism)); }
  double turned(mechanism::LinkIndex link) const { return link == mechanism::ground ? 0 : u_(3 * link + 2); }

  /// Springs pull with the length, and turn with the angle, that they have now.
  void add_spring(const mechanism::Spring& spring, Eigen::VectorXd& w) const {
    if (spring.kind == mechanism::Spring::Kind::torsion) {
      const auto own = static_cast<int>(&spring - model_.mechanism.springs.data());
      const double more = value(spring.stiffness) * (turned(spring.to) - turned(spring.from));
      for (const AppliedLoad& load : posture_.loads)
        if (load.spring == own) w(3 * load.link + 2) -= load.couple[2] + (load.link == spring.to ? -more : more);
      return;
    }
    const Point2 p = moved(spring.from, point(spring.from_point)), q = moved(spring.to, point(spring.to_point));
    const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
    const double tension = spring.kind == mechanism::Spring::Kind::constant_force
                               ? value(spring.force)
                               : value(spring.stiffness) * (length - value(spring.free_length));
    if (length == 0) return;
    const Point2 force = {tension * (q[0] - p[0]) / length, tension * (q[1] - p[1]) / length};
    const auto put = [&](mechanism::LinkIndex link, mechanism::PointIndex at, double sign) {
      if (link == mechanism::ground) return;
      const Point2 r = arm(link, point(at));
      w.segment<3>(3 * link) -= sign * Eigen::Vector3d(force[0], force[1], r[0] * force[1] - r[1] * force[0]);
    };
    put(spring.from, spring.from_point, 1);
    put(spring.to, spring.to_point, -1);
  }

  const NumericModel& model_;
  const Posture& posture_;
  const Eigen::VectorXd& u_;
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

std::vector<std::vector<Point2>> displaced_points(const NumericModel& model, const DisplacedMechanism& displaced) {
  std::vector<std::vector<Point2>> all;
  const Point2 E = displaced.reference();
  for (std::size_t i = 0; i < model.mechanism.links.size(); ++i) {
    std::vector<Point2> points;
    for (const mechanism::PointIndex p : model.mechanism.links[i].points) {
      const Point2 r = displaced.moved(static_cast<int>(i), displaced.point(p));
      points.push_back({E[0] + r[0], E[1] + r[1]});
    }
    all.push_back(std::move(points));
  }
  return all;
}

class Iteration {
 public:
  Iteration(const NumericModel& model, const Posture& posture, const Accuracy& linear)
      : model_(model), posture_(posture), contacts_(linear.contacts), linear_(linear) {
    size_ = typical_length(model, posture);
  }

  ActualPose run() {
    if (!linear_.undefined.empty()) return refuse("the take-up of " + names(linear_.undefined) + " is undefined here");
    if (!(linear_.reactions.condition < most_condition)) return refuse("the pose is at a direct singularity");
    u_ = linear_.link_displacements;
    result_.take_up = linear_.take_up;
    for (result_.iterations = 1; result_.iterations <= most_iterations; ++result_.iterations) {
      const double step = advance();
      if (!result_.reason.empty()) return refuse(result_.reason);
      if (step <= settled * (1 + u_.cwiseAbs().maxCoeff() / size_)) return finish();
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

  /// One step; its size in units of the mechanism's (lengths) and in rad.
  double advance() {
    const DisplacedMechanism displaced(model_, posture_, u_);
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(displaced.matrix());
    const double determinant = lu.determinant();
    if (!std::isfinite(determinant) || determinant * linear_.reactions.determinant <= 0) {
      result_.reason = "taking up the clearances leads through a direct singularity";
      return 0;
    }
    result_.reactions = lu.solve(displaced.load_column());
    std::vector<TakeUp> next =
        take_up(contacts_, joint_reactions(contacts_.size(), linear_.columns, result_.reactions));
    if (const auto undefined = undefined_take_up(model_.mechanism, contacts_, next); !undefined.empty()) {
      result_.reason = "the take-up of " + names(undefined) + " becomes undefined in the displaced geometry";
      return 0;
    }
    reversed_ = reversed_couple(model_, result_.take_up, next);
    result_.take_up = std::move(next);
    const Eigen::VectorXd residual = displaced.closure(clearance_displacements(linear_.columns, result_.take_up));
    const Eigen::VectorXd step = lu.transpose().solve(residual);
    u_ -= step;
    double most = 0;
    for (Eigen::Index i = 0; i < step.size(); ++i) most = std::max(most, std::abs(step(i)) / (i % 3 == 2 ? 1 : size_));
    // A link that turns by a radian has left the neighbourhood in which the linear step means anything.
    if (!(u_.cwiseAbs().maxCoeff() < 1e3 * size_) || !std::isfinite(most))
      result_.reason = "the displaced mechanism cannot be closed near this pose";
    return most;
  }

  ActualPose finish() {
    const DisplacedMechanism displaced(model_, posture_, u_);
    result_.converged = true;
    result_.residual =
        displaced.closure(clearance_displacements(linear_.columns, result_.take_up)).cwiseAbs().maxCoeff();
    result_.displacements = u_;
    const Vector6 own = end_effector_displacement(model_.mechanism, u_);
    result_.error = {own.tail<3>(), own.head<3>()};
    result_.beyond_linear = {result_.error.dalpha - linear_.error.dalpha, result_.error.dp - linear_.error.dp};
    result_.link_points = displaced_points(model_, displaced);
    return result_;
  }

  const NumericModel& model_;
  const Posture& posture_;
  std::vector<JointContact> contacts_;
  const Accuracy& linear_;
  double size_ = 1;
  Eigen::VectorXd u_;
  std::string reversed_;
  ActualPose result_;
};

}  // namespace

ActualPose actual_pose(const NumericModel& model, const Posture& posture, const Accuracy& linear) {
  core::ensure(posture.reachable(), "the posture is reachable");
  for (const mechanism::Joint& joint : model.mechanism.joints) {
    if (!mechanism::traits(joint).slides) continue;
    ActualPose refused;
    refused.reason = "joint " + joint.name + " is prismatic, and only revolute joints are closed with their clearances";
    return refused;
  }
  return Iteration(model, posture, linear).run();
}

}  // namespace clearloci::numeric
