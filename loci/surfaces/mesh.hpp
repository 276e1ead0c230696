// Triangles in the unit cube, and what can be counted on them. Private to loci/surfaces.
#pragma once

#include <array>
#include <vector>

#include "loci/surfaces/field.hpp"

namespace clearloci::loci::surface {

using Triangle = std::array<int, 3>;

struct Mesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
};

inline Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator*(double factor, const Point& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Point middle_of(const Mesh& mesh, const Triangle& triangle) {
  const auto at = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(triangle[i])]; };
  return 1.0 / 3 * (at(0) + at(1) + at(2));
}

/// Without the points that no triangle has; the others keep their order.
Mesh compact(const Mesh& mesh);

/// Edges as pairs of points, the smaller first, each with the number of its triangles; ascending.
struct MeshEdge {
  int from = 0, to = 0, triangles = 0;
};
std::vector<MeshEdge> edges_of(const Mesh& mesh);

/// The component of every triangle, from 0 on in the order of the first triangles; triangles that share a point are of
/// one component.
std::vector<int> components_of(const Mesh& mesh);

/// Of the triangles with true flags.
Mesh part_of(const Mesh& mesh, const std::vector<bool>& wanted);

}  // namespace clearloci::loci::surface
