#include "numeric/spatial_take_up.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mechanism/joint_traits.hpp"
#include "numeric/evaluator.hpp"

namespace clearloci::numeric {

namespace {

using core::Quantity;
using Eigen::Matrix3d;
using Eigen::Vector3d;

bool slides(const SpatialJoint& joint) { return mechanism::traits(joint.type).slides; }

/// One clearance: the end effector moves by `way` times any vector of length up to one.
using Reach = Eigen::Matrix<double, 6, 3>;

std::vector<Reach> reaches(const std::vector<SpatialJoint>& joints, const std::vector<JointInfluence>& influence) {
  std::vector<Reach> all;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const SpatialJoint& joint = joints[j];
    const bool about_axis = mechanism::traits(joint.type).turns_about_axis();
    const Matrix3d across =
        Matrix3d::Identity() - (about_axis ? Matrix3d(joint.axis * joint.axis.transpose()) : Matrix3d::Zero());
    if (joint.presses()) all.emplace_back(joint.clearance.radial * influence[j].force * across);
    if (!joint.plays()) continue;
    all.emplace_back(Reach::Zero());
    all.back().col(0) =
        joint.clearance.angular * (slides(joint) ? influence[j].force : influence[j].couple) * joint.axis;
  }
  return all;
}

/// Bounds are handed out above what doubles make of their few hundred operations.
double rounded_up(double bound) { return bound * (1 + 512 * std::numeric_limits<double>::epsilon()); }

/// The support function of the places that a sum of reaches leads to; `row`: of the first of its three components.
class Support {
 public:
  Support(const std::vector<Reach>& all, int row) {
    for (const Reach& reach : all)
      if (!reach.middleRows<3>(row).isZero(0)) parts_.emplace_back(reach.middleRows<3>(row));
  }
  double operator()(const Vector3d& n) const {
    double sum = 0;
    for (const Matrix3d& part : parts_) sum += (part.transpose() * n).norm();
    return sum;
  }

  /// The direction of the place that is farthest along n: it is at least as far away as h(n), so is h there.
  Vector3d direction_of_farthest(const Vector3d& n) const {
    Vector3d place = Vector3d::Zero();
    for (const Matrix3d& part : parts_) {
      const Vector3d along = part.transpose() * n;
      if (along.norm() > 0) place += part * along.normalized();
    }
    return place.norm() > 0 ? Vector3d(place.normalized()) : n;
  }

  /// An upper bound of h in every direction, tight where n is the one in which h is largest and its terms change alike:
  /// |w| <= (|w|^2/c + c)/2 with c = |w| at n, so h is at most half an eigenvalue and half h(n). Infinite where a term
  /// is 0 at n.
  double bound_everywhere(const Vector3d& n) const {
    Matrix3d form = Matrix3d::Zero();
    double sum = 0;
    for (const Matrix3d& part : parts_) {
      const double size = (part.transpose() * n).norm();
      if (!(size > 1e-7 * part.norm())) return std::numeric_limits<double>::infinity();
      form += part * part.transpose() / size;
      sum += size;
    }
    return (Eigen::SelfAdjointEigenSolver<Matrix3d>(form, Eigen::EigenvaluesOnly).eigenvalues()(2) + sum) / 2;
  }

 private:
  std::vector<Matrix3d> parts_;
};

struct Triangle {
  std::array<Vector3d, 3> corners;  ///< unit vectors
  std::array<double, 3> values;     ///< h there
  double bound = 0;                 ///< of h inside
  bool operator<(const Triangle& other) const { return bound < other.bound; }
};

/// The largest value on the arc from p to q of the linear function that is a at p and b at q.
double bound_on_arc(const Vector3d& p, const Vector3d& q, double a, double b) {
  const double c = p.dot(q);
  if (b < a * c || a < b * c) return std::max(a, b);
  return std::sqrt((a * a + b * b - 2 * a * b * c) / (p.cross(q)).squaredNorm());
}

/// The largest value of the linear function inside the triangle.
double bound(const Triangle& t) {
  Matrix3d corners;
  for (int i = 0; i < 3; ++i) corners.row(i) = t.corners[static_cast<std::size_t>(i)].transpose();
  const Matrix3d inverse = corners.inverse();
  const Vector3d gradient = inverse * Vector3d(t.values[0], t.values[1], t.values[2]);
  // Inside: a combination of the corners with no negative part.
  if (((gradient.transpose() * inverse).array() >= 0).all()) return gradient.norm();
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    most = std::max(most, bound_on_arc(t.corners[i], t.corners[k], t.values[i], t.values[k]));
  }
  return most;
}

/// Where the corners are this near, rounding says more about the bound than the function does.
constexpr double narrowest_triangle = 1e-7;

/// More triangles than this are not looked at: the bound is then less tight, and still one.
constexpr int most_triangles = 20'000;

/// Not less than the largest value of h, and mostly not more than `accuracy` above it.
double farthest(const Support& support, double accuracy) {
  std::vector<Triangle> open;
  double best = 0, everywhere = std::numeric_limits<double>::infinity();
  Vector3d at_best = Vector3d::UnitX();
  const auto at = [&](const Vector3d& n) {
    const double value = support(n);
    if (value > best) best = value, at_best = n;
    return value;
  };
  const auto put = [&](Triangle t) {
    // Values at the corners are known to their roundings, and their differences are divided by the sides.
    const double side = std::min({(t.corners[1] - t.corners[0]).norm(), (t.corners[2] - t.corners[1]).norm(),
                                  (t.corners[0] - t.corners[2]).norm()});
    t.bound = std::max({bound(t), t.values[0], t.values[1], t.values[2]}) *
              (1 + 64 * std::numeric_limits<double>::epsilon() / side);
    open.push_back(t);
    std::push_heap(open.begin(), open.end());
  };
  // From a direction to where it leads, again and again: a largest value, before triangles prove that none is larger.
  const auto climb = [&](Vector3d n) {
    constexpr int steps = 60;
    for (int i = 0; i < steps; ++i) {
      const double before = at(n);
      n = support.direction_of_farthest(n);
      if (at(n) <= before * (1 + 1e-15)) break;
    }
    everywhere = std::min(everywhere, support.bound_everywhere(at_best));
  };
  // Half an octahedron: h is the same at n and -n.
  for (const double sx : {1.0, -1.0}) {
    for (const double sy : {1.0, -1.0}) {
      const std::array<Vector3d, 3> c = {Vector3d(sx, 0, 0), Vector3d(0, sy, 0), Vector3d(0, 0, 1)};
      put({c, {at(c[0]), at(c[1]), at(c[2])}});
      climb((c[0] + c[1] + c[2]).normalized());
    }
  }
  for (int looked_at = 0;; ++looked_at) {
    const Triangle t = open.front();
    const double most = std::max(best, std::min(t.bound, everywhere));
    const auto& c = t.corners;
    // Into two at the middle of the longest side.
    std::size_t i = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if ((c[(k + 1) % 3] - c[k]).squaredNorm() > (c[(i + 1) % 3] - c[i]).squaredNorm()) i = k;
    const std::size_t j = (i + 1) % 3;
    if ((c[j] - c[i]).norm() < narrowest_triangle || most <= best * (1 + accuracy) || looked_at >= most_triangles)
      return rounded_up(most);
    std::pop_heap(open.begin(), open.end());
    open.pop_back();
    const Vector3d middle = (c[i] + c[j]).normalized();
    const double before = best, value = at(middle);
    if (best > before) climb(middle);
    for (const std::size_t replaced : {i, j}) {
      Triangle half = t;
      half.corners[replaced] = middle;
      half.values[replaced] = value;
      put(half);
    }
  }
}

}  // namespace

Vector3d SpatialJoint::pressing(const Vector3d& force) const {
  const bool about_axis = mechanism::traits(type).turns_about_axis();
  return about_axis ? Vector3d(force - axis.dot(force) * axis) : force;
}

std::vector<SpatialJoint> spatial_joints(const mechanism::Mechanism& mechanism) {
  const std::vector<JointClearance> clearances = joint_clearances(mechanism);
  std::vector<SpatialJoint> joints;
  for (std::size_t j = 0; j < clearances.size(); ++j)
    joints.push_back({mechanism.joints[j].type, mechanism.joints[j].actuated, clearances[j], Vector3d::Zero()});
  return joints;
}

SpatialTakeUp take_up(const SpatialJoint& joint, const SpatialLoad& load, const LostContact& lost) {
  SpatialTakeUp result;
  if (joint.presses()) {
    const Vector3d force = joint.pressing(load.force);
    const double size = force.norm();
    result.force_vanishes = lost.force || !(size > 0) || !std::isfinite(size);
    if (!result.force_vanishes) result.displacement = -joint.clearance.radial / size * force;
  }
  if (joint.plays()) {
    const double along = (slides(joint) ? load.force : load.couple).dot(joint.axis);
    result.actuator_vanishes = lost.actuator || along == 0 || !std::isfinite(along);
    if (!result.actuator_vanishes) result.actuator = -std::copysign(joint.clearance.angular, along);
    (slides(joint) ? result.displacement : result.rotation) += result.actuator * joint.axis;
  }
  return result;
}

std::vector<LostContact> lost_contacts(const NumericModel& model, std::span<const int> mode,
                                       std::span<const Bounded> pose) {
  Evaluator<Bounded, 1> evaluator(model, mode, model.reaction_size);
  for (std::size_t c = 0; c < pose.size(); ++c) evaluator.input(c, 0) = pose[c];
  evaluator.run_tape();
  std::vector<Bounded> numerators(model.unknowns.size() + 1);
  evaluator.solve(model.elimination, numerators.data());
  const auto zero = [](const Bounded& b) { return !(std::abs(b.value) > b.error); };
  const bool singular = zero(numerators.back());
  const auto part = [&](std::size_t joint, Quantity quantity) {
    const int column = column_of(model, static_cast<int>(joint), quantity);
    return column < 0 ? Bounded(0.0) : numerators[static_cast<std::size_t>(column)];
  };
  std::vector<SpatialJoint> joints = spatial_joints(model.mechanism);
  std::vector<LostContact> lost(joints.size(), {singular, singular});
  for (std::size_t j = 0; j < joints.size() && !singular; ++j) {
    const SpatialJoint& joint = joints[j];
    std::array<Bounded, 3> force = {part(j, Quantity::fx), part(j, Quantity::fy), part(j, Quantity::fz)};
    if (mechanism::traits(joint.type).turns_about_axis()) {
      std::array<Bounded, 3> u;
      for (std::size_t c = 0; c < 3; ++c) u[c] = evaluator.value((*model.axes[j])[c], 0);
      const Bounded along = force[0] * u[0] + force[1] * u[1] + force[2] * u[2];
      for (std::size_t c = 0; c < 3; ++c) force[c] = force[c] - along * u[c];
    }
    lost[j].force = std::all_of(force.begin(), force.end(), zero);
    lost[j].actuator = joint.actuated && zero(part(j, mechanism::actuator_quantity(model.mechanism.joints[j])));
  }
  return lost;
}

SpatialPoseError pose_error(const std::vector<JointInfluence>& influence, const std::vector<SpatialTakeUp>& take_up) {
  Eigen::Matrix<double, 6, 1> error = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t j = 0; j < take_up.size(); ++j)
    error += influence[j].force * take_up[j].displacement + influence[j].couple * take_up[j].rotation;
  return {error.tail<3>(), error.head<3>()};
}

SpatialWorstCase worst_case(const std::vector<SpatialJoint>& joints, const std::vector<JointInfluence>& influence,
                            double accuracy, bool rotation) {
  const std::vector<Reach> all = reaches(joints, influence);
  SpatialWorstCase worst;
  Eigen::Matrix<double, 6, 1> most = Eigen::Matrix<double, 6, 1>::Zero();
  for (const Reach& reach : all) most += reach.rowwise().norm();
  for (Eigen::Index c = 0; c < 6; ++c) (c < 3 ? worst.dp(c) : worst.dalpha(c - 3)) = rounded_up(most(c));
  if (!most.allFinite()) {
    worst.rotation = worst.distance = std::numeric_limits<double>::infinity();
    return worst;
  }
  worst.distance = farthest(Support(all, 0), accuracy);
  if (rotation) worst.rotation = farthest(Support(all, 3), accuracy);
  return worst;
}

}  // namespace clearloci::numeric
