#include "numeric/pose_error.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "numeric/end_effector.hpp"

namespace clearloci::numeric {

namespace {

/// Bounds are handed out above what doubles make of their few dozen operations.
double rounded_up(double bound) { return bound * (1 + 64 * std::numeric_limits<double>::epsilon()); }

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
        add({radial * H(0, fx), radial * H(1, fx), radial * H(0, fy), radial * H(1, fy)});
      if (angular > 0 && couple >= 0) add({angular * H(0, couple), angular * H(1, couple), 0, 0});
      if (gap > 0 && normal >= 0) {
        // Each end moves by ±g: half along the normal, and a tilt of ±g/(2 h).
        for (const double sign : {1.0, -1.0}) {
          const auto way = [&](int row) { return gap / 2 * (H(row, normal) + sign * H(row, tilt) / half_length); };
          add({way(0), way(1), 0, 0});
        }
      }
    }
  }

  /// h(n) at n = (cos angle, sin angle).
  double support(double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    double sum = 0;
    for (const Term& term : terms_) sum += term.size(c, s);
    return sum;
  }

  /// The direction of the place that is farthest along n: it is at least as far away as h(n), so is h there.
  double direction_of_farthest(double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    Point2 place{};
    for (const Term& term : terms_) {
      const double first = term.first(c, s), second = term.second(c, s), size = term.size(c, s);
      if (!(size > 0)) continue;
      place[0] += (first * term.xx + second * term.xy) / size;
      place[1] += (first * term.yx + second * term.yy) / size;
    }
    return std::atan2(place[1], place[0]);
  }

  /// An upper bound of h between two directions, good where every term changes little from `middle` on:
  /// sqrt(q) <= (q/c + c)/2 with c = sqrt(q) there, and q is a sinusoid of twice the angle. Infinite where a term is 0.
  double sinusoid_bound(double from, double middle, double to) const {
    const double c = std::cos(middle), s = std::sin(middle);
    double constant = 0, cosine = 0, sine = 0;
    for (const Term& term : terms_) {
      const double size = term.size(c, s);
      const double a = term.xx * term.xx + term.xy * term.xy, d = term.yx * term.yx + term.yy * term.yy;
      const double b = term.xx * term.yx + term.xy * term.yy;
      if (!(size > 1e-7 * std::sqrt(a + d))) return std::numeric_limits<double>::infinity();
      constant += ((a + d) / 2 / size + size) / 2;
      cosine += (a - d) / 4 / size;
      sine += b / 2 / size;
    }
    const double amplitude = std::hypot(cosine, sine);
    const double peak = std::remainder(std::atan2(sine, cosine) / 2 - middle, std::numbers::pi);
    if (std::abs(peak) <= (to - from) / 2 * (1 + 1e-9) + 1e-12) return constant + amplitude;
    const auto at = [&](double angle) { return constant + cosine * std::cos(2 * angle) + sine * std::sin(2 * angle); };
    return std::max(at(from), at(to));
  }

 private:
  /// A clearance moves the point by (xx, yx) u + (xy, yy) v, u^2 + v^2 <= 1.
  struct Term {
    double xx, yx, xy, yy;
    double first(double c, double s) const { return c * xx + s * yx; }
    double second(double c, double s) const { return c * xy + s * yy; }
    double size(double c, double s) const {
      const double u = first(c, s), v = second(c, s);
      return std::sqrt(u * u + v * v);
    }
  };
  void add(const Term& term) {
    if (term.xx != 0 || term.yx != 0 || term.xy != 0 || term.yy != 0) terms_.push_back(term);
  }

  std::vector<Term> terms_;
};

struct Sector {
  double from, to;                   ///< angles of two directions
  double at_from, at_middle, at_to;  ///< h there
  double bound;                      ///< of h in between
  bool operator<(const Sector& other) const { return bound < other.bound; }

  double middle() const { return (from + to) / 2; }
};

/// An upper bound of h over the directions of a sector (pose_error.hpp), written without cancellation.
double corner_bound(double width, double at_from, double at_to) {
  const double c = std::cos(width);
  const bool corner_inside = at_to >= at_from * c && at_from >= at_to * c;
  if (!corner_inside) return std::max(at_from, at_to);
  const double half = std::sin(width / 2), difference = at_from - at_to;
  return std::sqrt(difference * difference + 4 * at_from * at_to * half * half) / std::sin(width);
}

Sector sector(const Reach& reach, double from, double to, double at_from, double at_to) {
  Sector s{from, to, at_from, reach.support((from + to) / 2), at_to, 0};
  const double half = (to - from) / 2;
  s.bound = std::min(std::max(corner_bound(half, at_from, s.at_middle), corner_bound(half, s.at_middle, at_to)),
                     reach.sinusoid_bound(from, s.middle(), to));
  // The difference of two values is known to their roundings, and is divided by the width.
  const double rounding = 8 * std::numeric_limits<double>::epsilon() / (to - from);
  s.bound = std::max({s.bound, at_from, s.at_middle, at_to}) * (1 + rounding);
  return s;
}

/// The corner of so narrow a sector lies farther out than its sides by less than a rounding error: 1 - cos(width/2).
constexpr double narrowest_sector = 1e-8;

/// Not less than the largest value of h, nor more than `accuracy` above it.
double farthest(const Reach& reach, double accuracy) {
  constexpr int sectors = 8;  // of the half turn after which h repeats
  constexpr int steps = 12;   // towards a largest value, before cells prove that there is none larger
  constexpr double width = std::numbers::pi / sectors;
  std::vector<Sector> open;
  double best = 0, at_best = 0, last = reach.support(0);
  for (int i = 0; i < sectors; ++i) {
    const double next = reach.support((i + 1) * width);
    open.push_back(sector(reach, i * width, (i + 1) * width, last, next));
    for (const auto& [value, angle] : {std::pair{next, (i + 1) * width}, {open.back().at_middle, open.back().middle()}})
      if (value > best) best = value, at_best = angle;
    last = next;
  }
  for (int i = 0; i < steps; ++i) {
    at_best = reach.direction_of_farthest(at_best);
    best = std::max(best, reach.support(at_best));
  }
  std::make_heap(open.begin(), open.end());
  while (true) {
    const Sector s = open.front();
    if (s.to - s.from < narrowest_sector || s.bound <= best * (1 + accuracy))
      return rounded_up(std::max(best, s.bound));
    std::pop_heap(open.begin(), open.end());
    open.pop_back();
    for (const Sector& half : {sector(reach, s.from, s.middle(), s.at_from, s.at_middle),
                               sector(reach, s.middle(), s.to, s.at_middle, s.at_to)}) {
      best = std::max(best, half.at_middle);
      open.push_back(half);
      std::push_heap(open.begin(), open.end());
    }
  }
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
  return {rounded_up(most(2)), rounded_up(most(0)), rounded_up(most(1)),
          farthest(Reach(H, columns, clearances), accuracy)};
}

Accuracy pose_accuracy(const NumericModel& model, const Posture& posture, const std::vector<bool>& vanishing) {
  const Eigen::MatrixXd A = newton_euler_matrix(model, posture);
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(A);
  const std::vector<JointClearance> clearances = joint_clearances(model.mechanism);
  Accuracy result;
  result.reactions = solve_reactions(A, load_column(model, posture), lu);
  result.take_up = take_up(model, clearances, result.reactions.values, vanishing);
  result.undefined = undefined_take_up(model, clearances, result.take_up);

  result.influence = lu.solve(unit_wrenches<3>(model.mechanism, A.rows())).transpose();
  result.worst = worst_case(result.influence, joint_columns(model), clearances);
  if (result.undefined.empty()) {
    const Eigen::VectorXd displacements = clearance_displacements(model, result.take_up);
    result.link_displacements = lu.transpose().solve(displacements);
    const Eigen::Vector3d own = end_effector_displacement<3>(model.mechanism, result.link_displacements);
    result.error = {own(2), own(0), own(1)};
  } else {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    result.link_displacements.setConstant(A.rows(), nan);
    result.error = {nan, nan, nan};
  }
  return result;
}

}  // namespace clearloci::numeric
