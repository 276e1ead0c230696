#include "loci/zones/largest_ball.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clearloci::loci::pose {
namespace {

using Point = std::array<double, 3>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double to_segment(const Point& p, const Point& a, const Point& b) {
  const Point way = b - a, off = p - a;
  const double length2 = dot(way, way), t = length2 > 0 ? std::clamp(dot(off, way) / length2, 0.0, 1.0) : 0.0;
  const Point rest = {off[0] - t * way[0], off[1] - t * way[1], off[2] - t * way[2]};
  return std::sqrt(dot(rest, rest));
}

/// From a convex polygon, or a segment.
double to_face(const Point& p, const Polygon& face) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < face.size(); ++i)
    least = std::min(least, to_segment(p, face[i], face[(i + 1) % face.size()]));
  if (face.size() < 3) return least;
  Point normal{};
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    const Point point = cross(face[i] - face[0], face[i + 1] - face[0]);
    for (std::size_t c = 0; c < 3; ++c) normal[c] += point[c];
  }
  const double size = std::sqrt(dot(normal, normal));
  if (!(size > 0)) return least;
  for (std::size_t i = 0; i < face.size(); ++i)
    if (dot(cross(face[(i + 1) % face.size()] - face[i], p - face[i]), normal) < 0) return least;
  return std::min(least, std::abs(dot(p - face[0], normal)) / size);
}

class Faces {
 public:
  explicit Faces(const std::vector<Polygon>& faces) : faces_(faces) {
    for (const Polygon& polygon : faces) {
      std::array<Point, 2> around = {polygon.front(), polygon.front()};
      for (const Point& corner : polygon)
        for (std::size_t c = 0; c < 3; ++c) {
          around[0][c] = std::min(around[0][c], corner[c]);
          around[1][c] = std::max(around[1][c], corner[c]);
        }
      around_.push_back(around);
    }
  }
  double distance(const Point& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      double off = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double distance = std::max({around_[i][0][c] - p[c], p[c] - around_[i][1][c], 0.0});
        off += distance * distance;
      }
      if (off < least * least) least = std::min(least, to_face(p, faces_[i]));
    }
    return least;
  }

 private:
  const std::vector<Polygon>& faces_;
  std::vector<std::array<Point, 2>> around_;
};

/// Squares of distances along one more coordinate: the least of f(j) + (width (i - j))^2 along every line.
void spread(std::vector<double>& squares, const std::vector<int>& n, std::size_t along, double width) {
  std::size_t stride = 1;
  for (std::size_t c = 0; c < along; ++c) stride *= static_cast<std::size_t>(n[c]);
  const auto count = static_cast<std::size_t>(n[along]);
  std::vector<double> line(count);
  for (std::size_t first = 0; first < squares.size(); ++first) {
    if (first / stride % count != 0) continue;
    for (std::size_t i = 0; i < count; ++i) line[i] = squares[first + i * stride];
    for (std::size_t i = 0; i < count; ++i) {
      // Outwards, as long as something nearer may come; beyond the ends all is outside.
      const double ends = width * (static_cast<double>(std::min(i, count - 1 - i)) + 0.5);
      double least = std::min(line[i], ends * ends);
      for (std::size_t off = 1; off < count; ++off) {
        const double square = width * width * static_cast<double>(off * off);
        if (square >= least) break;
        if (off <= i) least = std::min(least, line[i - off] + square);
        if (i + off < count) least = std::min(least, line[i + off] + square);
      }
      squares[first + i * stride] = least;
    }
  }
}

}  // namespace

std::optional<core::ZoneBall> largest_ball(const CellZone& zone, std::size_t number, const std::vector<int>& raster,
                                           const std::vector<int>& cells, const Pose& lower, const Pose& upper) {
  const std::size_t n = cells.size();
  if (n < 2 || zone.faces.empty()) return std::nullopt;
  const int label = static_cast<int>(number) + 1;
  Pose widths;
  for (std::size_t c = 0; c < n; ++c) widths.push_back((upper[c] - lower[c]) / cells[c]);
  std::vector<double> squares;
  for (const int pixel : raster) squares.push_back(pixel == label ? std::numeric_limits<double>::infinity() : 0);
  for (std::size_t c = 0; c < n; ++c) spread(squares, cells, c, widths[c]);
  const auto best = static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
  if (!(squares[best] > 0)) return std::nullopt;
  Point centre{};
  std::size_t index = best;
  for (std::size_t c = 0; c < n; ++c) {
    const auto cell = static_cast<std::size_t>(cells[c]);
    centre[c] = lower[c] + (static_cast<double>(index % cell) + 0.5) * widths[c];
    index /= cell;
  }
  const Faces faces(zone.faces);
  double radius = faces.distance(centre);
  // A way of less than the radius crosses no face: the centre stays in the zone.
  constexpr double finest = 1e-3;
  double step = 0.5;  // of the radius
  while (step > finest) {
    bool better = false;
    for (std::size_t c = 0; c < n; ++c)
      for (const double way : {1.0, -1.0}) {
        Point other = centre;
        other[c] += way * step * radius;
        const double distance = faces.distance(other);
        if (distance <= radius * (1 + 0.1 * step)) continue;
        centre = other;
        radius = distance;
        better = true;
      }
    if (!better) step *= 0.5;
  }
  constexpr double rounding = 1e-9;  // of a place of the raster: its middle is on a face
  if (radius <= rounding * *std::min_element(widths.begin(), widths.end())) return std::nullopt;
  return core::ZoneBall{{centre.begin(), centre.begin() + static_cast<std::ptrdiff_t>(n)}, radius * (1 - 1e-12)};
}

}  // namespace clearloci::loci::pose
