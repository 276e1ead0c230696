#include "loci/surfaces/mesh.hpp"

#include <algorithm>

#include "core/parts.hpp"

namespace clearloci::loci::surface {

Mesh compact(const Mesh& mesh) {
  std::vector<int> place(mesh.points.size(), -1);
  for (const Triangle& triangle : mesh.triangles)
    for (const int corner : triangle) place[static_cast<std::size_t>(corner)] = 0;
  Mesh result;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] < 0) continue;
    place[i] = static_cast<int>(result.points.size());
    result.points.push_back(mesh.points[i]);
  }
  for (const Triangle& t : mesh.triangles)
    result.triangles.push_back({place[static_cast<std::size_t>(t[0])], place[static_cast<std::size_t>(t[1])],
                                place[static_cast<std::size_t>(t[2])]});
  return result;
}

std::vector<MeshEdge> edges_of(const Mesh& mesh) {
  std::vector<std::array<int, 2>> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      sides.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  std::sort(sides.begin(), sides.end());
  std::vector<MeshEdge> edges;
  for (const auto& side : sides) {
    if (edges.empty() || edges.back().from != side[0] || edges.back().to != side[1])
      edges.push_back({side[0], side[1], 0});
    ++edges.back().triangles;
  }
  return edges;
}

std::vector<int> components_of(const Mesh& mesh) {
  core::Parts parts(mesh.points.size());
  for (const Triangle& t : mesh.triangles)
    for (const int corner : {t[1], t[2]}) parts.join(t[0], corner);
  std::vector<int> number(mesh.points.size(), -1), result;
  int next = 0;
  for (const Triangle& t : mesh.triangles) {
    int& label = number[static_cast<std::size_t>(parts.of(t[0]))];
    if (label < 0) label = next++;
    result.push_back(label);
  }
  return result;
}

Mesh part_of(const Mesh& mesh, const std::vector<bool>& wanted) {
  Mesh part;
  part.points = mesh.points;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (wanted[i]) part.triangles.push_back(mesh.triangles[i]);
  return compact(part);
}

}  // namespace clearloci::loci::surface
