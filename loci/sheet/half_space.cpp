#include "loci/sheet/half_space.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::loci::pose {
namespace {

/// Entries of `way` that are smaller than this part of the largest count as their worst.
constexpr double least_entry = 1e-3;

double middle(const std::array<double, 2>& range) { return range[0] + 0.5 * (range[1] - range[0]); }
double half(const std::array<double, 2>& range) { return 0.5 * (range[1] - range[0]); }

}  // namespace

HalfSpace HalfSpace::within(const std::array<double, Affine::noises>& way, double beyond) {
  double most = 0;
  for (const double slope : way) most = std::max(most, std::abs(slope));
  HalfSpace part{way, beyond};
  for (double& slope : part.way) {
    if (!(std::abs(slope) < least_entry * most)) continue;
    part.beyond += std::abs(slope);
    slope = 0;
  }
  return part;
}

/// Of u in the unit cube:  |{sum a_i u_i <= s}| = sum over subsets S (-1)^|S| max(0, s - sum_S a_i)^n / (n! prod a_i)
double share_of(const HalfSpace& part) {
  std::vector<double> a;
  double sum = 0, product = 1;
  for (const double slope : part.way)
    if (slope != 0) {
      a.push_back(std::abs(slope));
      sum += std::abs(slope);
      product *= std::abs(slope) * static_cast<double>(a.size());
    }
  const double s = 0.5 * (part.beyond + sum);
  if (s <= 0) return 1;
  if (s >= sum) return 0;
  double below = 0;
  for (std::size_t subset = 0; subset < std::size_t{1} << a.size(); ++subset) {
    double left = s, sign = 1;
    for (std::size_t i = 0; i < a.size(); ++i)
      if ((subset >> i & 1U) != 0) {
        left -= a[i];
        sign = -sign;
      }
    if (left > 0) below += sign * std::pow(left, static_cast<double>(a.size()));
  }
  return std::clamp(1 - below / product, 0.0, 1.0);
}

PoseBox box_around(const HalfSpace& part, const PoseBox& cell) {
  double sum = 0;
  for (const double slope : part.way) sum += std::abs(slope);
  PoseBox box = cell;
  for (std::size_t p = 0; p < cell.size(); ++p) {
    const double slope = part.way[p];
    if (slope == 0) continue;
    // The others help as much as they can.
    const double least = std::max(-1.0, (part.beyond - (sum - std::abs(slope))) / std::abs(slope));
    if (least <= -1) continue;
    const double end = middle(cell[p]) + (slope > 0 ? least : -least) * half(cell[p]);
    box[p][slope > 0 ? 0 : 1] = std::clamp(end, cell[p][0], cell[p][1]);
  }
  return box;
}

Pose inner_pose(const HalfSpace& part, const PoseBox& cell) {
  double sum = 0;
  for (const double slope : part.way) sum += std::abs(slope);
  // Half way from the part's end to the corner of the cell that lies farthest in it.
  const double out = sum > 0 ? std::max(0.0, 0.5 * (1 + part.beyond / sum)) : 0.0;
  Pose pose;
  for (std::size_t p = 0; p < cell.size(); ++p) {
    const double e = part.way[p] == 0 ? 0 : part.way[p] > 0 ? out : -out;
    pose.push_back(middle(cell[p]) + e * half(cell[p]));
  }
  return pose;
}

double height(const HalfSpace& part, const PoseBox& cell, const std::array<double, 3>& pose) {
  double sum = -part.beyond;
  for (std::size_t p = 0; p < cell.size(); ++p)
    if (part.way[p] != 0) sum += part.way[p] * (pose[p] - middle(cell[p])) / half(cell[p]);
  return sum;
}

double height_slack(const PoseBox& cell) {
  double slack = 1e-9;
  for (const auto& range : cell) slack += std::max(std::abs(range[0]), std::abs(range[1])) * 0x1p-48 / half(range);
  return slack;
}

Polygon corners_of(const PoseBox& face) {
  std::vector<std::size_t> wide;
  std::array<double, 3> first{};
  for (std::size_t p = 0; p < face.size() && p < 3; ++p) {
    first[p] = face[p][0];
    if (face[p][1] > face[p][0]) wide.push_back(p);
  }
  Polygon polygon = {first};
  for (const std::size_t p : wide) {
    Polygon other = polygon;
    for (auto& corner : other) corner[p] = face[p][1];
    polygon.insert(polygon.end(), other.rbegin(), other.rend());
  }
  return polygon;
}

Polygon clipped(const Polygon& polygon, const HalfSpace& part, const PoseBox& cell, double least, bool inside) {
  Polygon result;
  const auto above = [&](const std::array<double, 3>& at) {
    const double excess = height(part, cell, at) - least;
    return inside ? excess : -excess;
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double of_a = above(a), of_b = above(b);
    if (of_a > 0) result.push_back(a);
    if ((of_a > 0) == (of_b > 0)) continue;
    const double t = of_a / (of_a - of_b);
    std::array<double, 3> between{};
    for (std::size_t c = 0; c < 3; ++c) between[c] = a[c] == b[c] ? a[c] : a[c] + t * (b[c] - a[c]);
    result.push_back(between);
  }
  return result;
}

Polygon cut_of(const HalfSpace& part, const PoseBox& cell) {
  if (cell.size() == 2) {
    const Polygon corners = corners_of(cell);
    Polygon ends;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const double of_a = height(part, cell, a), of_b = height(part, cell, b);
      if ((of_a > 0) == (of_b > 0)) continue;
      const double t = of_a / (of_a - of_b);
      ends.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), 0});
    }
    return ends;
  }
  // Crossings of the cell's edges, in a circle about their middle.
  Polygon points;
  for (std::size_t along = 0; along < 3; ++along)
    for (std::size_t corner = 0; corner < 4; ++corner) {
      std::array<double, 3> a{}, b{};
      for (std::size_t c = 0; c < 3; ++c) {
        const bool high = c != along && (corner >> ((c + 2 - along) % 3) & 1U) != 0;
        a[c] = b[c] = cell[c][high ? 1 : 0];
      }
      b[along] = cell[along][1];
      const double of_a = height(part, cell, a), of_b = height(part, cell, b);
      if ((of_a > 0) == (of_b > 0)) continue;
      a[along] += of_a / (of_a - of_b) * (b[along] - a[along]);
      points.push_back(a);
    }
  if (points.size() < 3) return {};
  std::array<double, 3> centre{}, normal{};
  for (const auto& point : points)
    for (std::size_t c = 0; c < 3; ++c) centre[c] += point[c] / static_cast<double>(points.size());
  for (std::size_t c = 0; c < 3; ++c) normal[c] = -part.way[c] / half(cell[c]);
  const std::size_t steep = static_cast<std::size_t>(
      std::max_element(normal.begin(), normal.end(), [](double x, double y) { return std::abs(x) < std::abs(y); }) -
      normal.begin());
  const std::size_t u = (steep + 1) % 3, v = (steep + 2) % 3;
  const double turn = normal[steep] > 0 ? 1 : -1;
  std::sort(points.begin(), points.end(), [&](const auto& x, const auto& y) {
    const auto angle = [&](const auto& p) { return std::atan2(turn * (p[v] - centre[v]), p[u] - centre[u]); };
    return angle(x) < angle(y);
  });
  return points;
}

}  // namespace clearloci::loci::pose
