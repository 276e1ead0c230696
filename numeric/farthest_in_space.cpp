#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "numeric/reach.hpp"

namespace clearloci::numeric {

namespace {

using Eigen::Matrix3d;

/// Of a bound: a few hundred.
constexpr double operations = 512;

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

}  // namespace

double farthest_in_space(const std::vector<Reach>& all, int row, double accuracy) {
  const Support support(all, row);
  std::vector<Triangle> open;
  double best = 0, everywhere = std::numeric_limits<double>::infinity();
  Vector3d at_best = Vector3d::UnitX();
  const auto at = [&](const Vector3d& n) {
    const double value = support(n);
    if (value > best) best = value, at_best = n;
    return value;
  };
  const auto put = [&](Triangle t) {
    const std::array<double, 3> sides = {(t.corners[1] - t.corners[0]).norm(), (t.corners[2] - t.corners[1]).norm(),
                                         (t.corners[0] - t.corners[2]).norm()};
    const double highest = std::max({t.values[0], t.values[1], t.values[2]}), longest = std::ranges::max(sides);
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    // Values at the corners are known to their roundings, and their differences are divided by the sides.
    const double linear = std::max(bound(t), highest) * (1 + 64 * epsilon / std::ranges::min(sides));
    // h is convex, and no point of the flat triangle is nearer to the origin than sqrt(1 - longest^2/3): for slivers,
    // where rounding says more about the other bound than h does.
    const double flat = longest < 1 ? highest * (1 + 8 * epsilon) / std::sqrt(1 - longest * longest / 3)
                                    : std::numeric_limits<double>::infinity();
    t.bound = std::min(linear, flat);
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
      return rounded_up(most, operations);
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

}  // namespace clearloci::numeric
