#include "loci/zones/inscribed_circle.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

namespace clearloci::loci {

std::vector<core::Circle> voronoi_circles(const core::Polyline& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangulation = CGAL::Delaunay_triangulation_2<Kernel>;
  std::vector<Kernel::Point_2> sites;
  for (const core::Point2& p : points) sites.emplace_back(p[0], p[1]);
  const Triangulation triangulation(sites.begin(), sites.end());
  std::vector<core::Circle> circles;
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
    const Kernel::Point_2 centre = triangulation.circumcenter(face);
    const Kernel::Point_2& site = face->vertex(0)->point();
    const double radius = std::hypot(centre.x() - site.x(), centre.y() - site.y());
    if (std::isfinite(radius)) circles.push_back({{centre.x(), centre.y()}, radius});
  }
  std::sort(circles.begin(), circles.end(), [](const core::Circle& a, const core::Circle& b) {
    return a.radius != b.radius ? a.radius > b.radius : a.centre < b.centre;
  });
  return circles;
}

}  // namespace clearloci::loci
