#include "numeric/pose_error.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace clearloci::numeric {

namespace {

/// The support function of the positions that the end effector's point can take.
class Reach {
 public:
  Reach(const Influence& H, const std::vector<JointColumns>& columns, const std::vector<JointClearance>& clearances) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const int fx = columns[j].fx, fy = columns[j].fy, couple = columns[j].couple;
      const int normal = columns[j].normal, tilt = columns[j].tilt;
      const double radial = clearances[j].radial, angular = clearances[j].angular;
      const double gap = clearances[j].gap, half_length = clearances[j].half_length;
      if (radial > 0 && fx >= 0 && fy >= 0)
        terms_.push_back({radial * H(0, fx), radial * H(1, fx), radial * H(0, fy), radial * H(1, fy)});
      if (angular > 0 && couple >= 0) terms_.push_back({angular * H(0, couple), angular * H(1, couple), 0, 0});
      if (gap > 0 && normal >= 0) {
        // Each end moves by ±g: half along the normal, and a tilt of ±g/(2 h).
        for (const double sign : {1.0, -1.0}) {
          const auto way = [&](int row) { return gap / 2 * (H(row, normal) + sign * H(row, tilt) / half_length); };
          terms_.push_back({way(0), way(1), 0, 0});
        }
      }
    }
  }

  /// h(n) at n = (cos angle, sin angle).
  double support(double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    double sum = 0;
    for (const auto& [xx, yx, xy, yy] : terms_) {
      const double first = c * xx + s * yx, second = c * xy + s * yy;
      sum += std::sqrt(first * first + second * second);
    }
    return sum;
  }

 private:
  std::vector<std::array<double, 4>> terms_;
};

struct Sector {
  double from, to;        ///< angles of two directions
  double at_from, at_to;  ///< h there
};

/// An upper bound of h over the directions of the sector (pose_error.hpp), written without cancellation.
double bound(const Sector& s) {
  const double width = s.to - s.from, c = std::cos(width);
  const bool corner_inside = s.at_to >= s.at_from * c && s.at_from >= s.at_to * c;
  if (!corner_inside) return std::max(s.at_from, s.at_to);
  const double half = std::sin(width / 2), difference = s.at_from - s.at_to;
  return std::sqrt(difference * difference + 4 * s.at_from * s.at_to * half * half) / std::sin(width);
}

/// The corner of so narrow a sector lies farther out than its sides by less than a rounding error: 1 - cos(width/2).
constexpr double narrowest_sector = 1e-8;

double farthest(const Reach& reach, double accuracy) {
  constexpr int sectors = 8;  // of the half turn after which h repeats
  constexpr double width = std::numbers::pi / sectors;
  std::vector<Sector> open;
  double best = 0, last = reach.support(0);
  for (int i = 0; i < sectors; ++i) {
    const double next = reach.support((i + 1) * width);
    open.push_back({i * width, (i + 1) * width, last, next});
    best = std::max({best, last, next});
    last = next;
  }
  while (!open.empty()) {
    const Sector s = open.back();
    open.pop_back();
    if (s.to - s.from < narrowest_sector || bound(s) <= best * (1 + accuracy)) continue;
    const double middle = (s.from + s.to) / 2, there = reach.support(middle);
    best = std::max(best, there);
    open.push_back({s.from, middle, s.at_from, there});
    open.push_back({middle, s.to, there, s.at_to});
  }
  return best;
}

}  // namespace

PoseError pose_error(const Influence& H, const Eigen::VectorXd& clearance_displacements) {
  const Eigen::Vector3d error = H * clearance_displacements;
  return {error(2), error(0), error(1)};
}

WorstCase worst_case(const Influence& H, const std::vector<JointColumns>& columns,
                     const std::vector<JointClearance>& clearances, double accuracy) {
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  if (!H.allFinite()) return {unbounded, unbounded, unbounded, unbounded};
  Eigen::Vector3d most = Eigen::Vector3d::Zero();
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const auto& [fx, fy, couple, normal, tilt] = columns[j];
    const auto& [radial, angular, gap, half_length] = clearances[j];
    for (int row = 0; row < 3; ++row) {
      if (radial > 0 && fx >= 0 && fy >= 0) most(row) += radial * std::hypot(H(row, fx), H(row, fy));
      if (angular > 0 && couple >= 0) most(row) += angular * std::abs(H(row, couple));
      if (gap > 0 && normal >= 0)
        most(row) += gap * std::max(std::abs(H(row, normal)), std::abs(H(row, tilt)) / half_length);
    }
  }
  return {most(2), most(0), most(1), farthest(Reach(H, columns, clearances), accuracy)};
}

Accuracy pose_accuracy(const NumericModel& model, const Posture& posture, const std::vector<bool>& vanishing) {
  const Eigen::MatrixXd A = newton_euler_matrix(model, posture);
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(A);
  const std::vector<JointClearance> clearances = joint_clearances(model.mechanism);
  Accuracy result;
  result.reactions = solve_reactions(A, load_column(model, posture), lu);
  result.take_up = take_up(model, clearances, result.reactions.values, vanishing);
  result.undefined = undefined_take_up(model, clearances, result.take_up);

  Eigen::MatrixXd unit_wrenches = Eigen::MatrixXd::Zero(A.rows(), 3);
  unit_wrenches.middleRows<3>(3 * model.mechanism.end_effector_link).setIdentity();
  result.influence = lu.solve(unit_wrenches).transpose();
  result.worst = worst_case(result.influence, joint_columns(model), clearances);
  if (result.undefined.empty()) {
    const Eigen::VectorXd displacements = clearance_displacements(model, result.take_up);
    result.link_displacements = lu.transpose().solve(displacements);
    const Eigen::Vector3d own = result.link_displacements.segment<3>(3 * model.mechanism.end_effector_link);
    result.error = {own(2), own(0), own(1)};
  } else {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    result.link_displacements.setConstant(A.rows(), nan);
    result.error = {nan, nan, nan};
  }
  return result;
}

}  // namespace clearloci::numeric
