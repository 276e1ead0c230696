#include "numeric/grid_passages.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace clearloci::numeric {

namespace {

using core::Point2;

/// First and last line within [low, high]; empty if first > last.
std::pair<int, int> lines_between(const GridAxis& axis, double low, double high) {
  const auto clamp = [&](double line) {
    return static_cast<int>(std::clamp(line, -1.0, static_cast<double>(axis.nodes)));
  };
  return {std::max(0, clamp(std::ceil((low - axis.origin) / axis.step))),
          std::min(axis.nodes - 1, clamp(std::floor((high - axis.origin) / axis.step)))};
}

/// Passages of the segment p q on the lines where coordinate `across` is constant; positions are the other coordinate.
void pass(const GridAxis& lines, std::size_t across, const Point2& p, const Point2& q, int curve, double reach,
          std::vector<std::vector<Passage>>& out) {
  const std::size_t along = 1 - across;
  const double least = std::min(p[across], q[across]), most = std::max(p[across], q[across]);
  const auto [first, last] = lines_between(lines, least - reach, most + reach);
  const double rise = q[across] - p[across];
  const auto position = [&](double level) {
    const double t = rise == 0 ? 0.0 : std::clamp((level - p[across]) / rise, 0.0, 1.0);
    return p[along] + t * (q[along] - p[along]);
  };
  for (int line = first; line <= last; ++line) {
    const double level = lines.at(line);
    Passage passage;
    // The part of the segment within reach of the line; all of it where the segment runs along the line.
    double u = rise == 0 ? p[along] : position(level - reach);
    double v = rise == 0 ? q[along] : position(level + reach);
    if (u > v) std::swap(u, v);
    passage.low = u - reach;
    passage.high = v + reach;
    passage.crosses = (p[across] < level) != (q[across] < level);
    passage.at = passage.crosses ? position(level) : (u + v) / 2;
    passage.curve = curve;
    out[static_cast<std::size_t>(line)].push_back(passage);
  }
}

void sort_lines(std::vector<std::vector<Passage>>& lines) {
  for (auto& line : lines) {
    std::sort(line.begin(), line.end(), [](const Passage& a, const Passage& b) {
      return std::tie(a.low, a.high, a.at, a.curve) < std::tie(b.low, b.high, b.at, b.curve);
    });
  }
}

}  // namespace

GridPassages find_passages(const Grid& grid, const std::vector<core::LocusCurve>& curves, std::span<const int> numbers,
                           double reach) {
  GridPassages result;
  result.rows.resize(static_cast<std::size_t>(grid.y.nodes));
  result.columns.resize(static_cast<std::size_t>(grid.x.nodes));
  for (const int number : numbers) {
    for (const auto& arc : curves[static_cast<std::size_t>(number)].arcs) {
      for (std::size_t i = 1; i < arc.points.size(); ++i) {
        pass(grid.y, 1, arc.points[i - 1], arc.points[i], number, reach, result.rows);
        pass(grid.x, 0, arc.points[i - 1], arc.points[i], number, reach, result.columns);
      }
    }
  }
  sort_lines(result.rows);
  sort_lines(result.columns);
  return result;
}

}  // namespace clearloci::numeric
