#include "numeric/surface_passages.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace clearloci::numeric {
namespace {

using core::LocusSurface;
using core::Point2;
using core::Point3;

struct Corner {
  int number = 0;  ///< among the surface's vertices
  Point2 across{};
  double along = 0;
};
using Corners = std::array<Corner, 3>;

/// Whether p is to the left of the way from a to b; of two triangles at one edge the same to both, with the ends
/// exchanged the opposite.
bool is_left(const Corner& a, const Corner& b, const Point2& p) {
  const bool turned = a.number > b.number;
  const Point2 &from = (turned ? b : a).across, &to = (turned ? a : b).across;
  const double area = (to[0] - from[0]) * (p[1] - from[1]) - (to[1] - from[1]) * (p[0] - from[0]);
  return (area > 0) != turned;
}

double distance(const Point2& p, const Point2& a, const Point2& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(a[0] + t * dx - p[0], a[1] + t * dy - p[1]);
}

/// Nothing where the line is farther than `reach` from the triangle.
bool pass(const Corners& corners, const Point2& line, double reach, Passage& passage) {
  const std::array<bool, 3> left = {is_left(corners[0], corners[1], line), is_left(corners[1], corners[2], line),
                                    is_left(corners[2], corners[0], line)};
  passage.crosses = left[0] == left[1] && left[1] == left[2];
  double off = passage.crosses ? 0 : reach * 2;
  for (std::size_t k = 0; k < 3 && !passage.crosses; ++k)
    off = std::min(off, distance(line, corners[k].across, corners[(k + 1) % 3].across));
  if (off > reach) return false;
  const auto [least, most] = std::minmax({corners[0].along, corners[1].along, corners[2].along});
  passage.low = least - reach;
  passage.high = most + reach;
  // The plane of the triangle over the other two coordinates; one that stands along the line is met all along.
  const auto &a = corners[0].across, &b = corners[1].across, &c = corners[2].across;
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  passage.at = 0.5 * (least + most);
  if (area == 0) return true;
  const double rise_b = corners[1].along - corners[0].along, rise_c = corners[2].along - corners[0].along;
  const double u = (rise_b * (c[1] - a[1]) - rise_c * (b[1] - a[1])) / area,
               v = (rise_c * (b[0] - a[0]) - rise_b * (c[0] - a[0])) / area;
  const double at = corners[0].along + u * (line[0] - a[0]) + v * (line[1] - a[1]);
  const double doubt = reach * (1 + std::hypot(u, v));
  if (passage.crosses) passage.at = std::clamp(at, least, most);
  passage.low = std::max(passage.low, at - doubt);
  passage.high = std::min(passage.high, at + doubt);
  return passage.low <= passage.high;
}

/// First and last node within [low, high].
std::pair<int, int> nodes_between(const GridAxis& axis, double low, double high) {
  const double last = axis.nodes;
  return {static_cast<int>(std::clamp(std::ceil((low - axis.origin) / axis.step), 0.0, last)),
          static_cast<int>(std::clamp(std::floor((high - axis.origin) / axis.step), -1.0, last - 1))};
}

}  // namespace

std::vector<std::vector<Passage>> find_passages(const std::array<GridAxis, 3>& axes, std::size_t along,
                                                const std::vector<LocusSurface>& surfaces, std::span<const int> numbers,
                                                double reach) {
  const std::size_t u = along == 0 ? 1 : 0, v = along == 2 ? 1 : 2;
  const auto columns = static_cast<std::size_t>(axes[u].nodes);
  std::vector<std::vector<Passage>> lines(columns * static_cast<std::size_t>(axes[v].nodes));
  for (const int number : numbers) {
    const LocusSurface& surface = surfaces[static_cast<std::size_t>(number)];
    for (const auto& triangle : surface.triangles) {
      Corners corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const Point3& at = surface.vertices[static_cast<std::size_t>(triangle[k])];
        corners[k] = {triangle[k], {at[u], at[v]}, at[along]};
      }
      std::array<std::pair<int, int>, 2> range;
      for (std::size_t c = 0; c < 2; ++c) {
        const auto [least, most] = std::minmax({corners[0].across[c], corners[1].across[c], corners[2].across[c]});
        range[c] = nodes_between(axes[c == 0 ? u : v], least - reach, most + reach);
      }
      for (int j = range[1].first; j <= range[1].second; ++j)
        for (int i = range[0].first; i <= range[0].second; ++i) {
          Passage passage;
          passage.curve = number;
          if (pass(corners, {axes[u].at(i), axes[v].at(j)}, reach, passage))
            lines[static_cast<std::size_t>(i) + static_cast<std::size_t>(j) * columns].push_back(passage);
        }
    }
  }
  for (auto& line : lines)
    std::sort(line.begin(), line.end(), [](const Passage& a, const Passage& b) {
      return std::tie(a.low, a.high, a.at, a.curve) < std::tie(b.low, b.high, b.at, b.curve);
    });
  return lines;
}

}  // namespace clearloci::numeric
