// A parallel projection of a box in space onto the page, and triangles shaded in it.
// Private to report/.
#pragma once

#include <cstdint>
#include <vector>

#include "core/locus_map.hpp"
#include "report/groups.hpp"

namespace clearloci::report {

/// Seen from `toward`; all lengths in one scale, angles such that the box is about as high as wide.
struct View {
  core::Point3 centre{}, scale{};  ///< of the coordinates to those of space
  core::Point3 right{}, up{}, toward{};
  double zoom = 1;        ///< pt a unit of space
  core::Point2 origin{};  ///< page place of the centre

  core::Point3 space(const core::Point3& place) const;
  core::Point2 page(const core::Point3& place) const;
  double nearness(const core::Point3& place) const;  ///< larger is nearer
};

/// `azimuth`, `elevation` in rad, of where it is seen from; zoom and origin are left to the caller.
View view_of(const core::LocusMap& map, double azimuth, double elevation);

/// A surface as it is shaded.
struct ShadedSurface {
  const core::LocusSurface* surface = nullptr;
  Colour colour;
  double opacity = 1;
};

/// Where height lines are drawn on surfaces: at multiples of `step` of the third coordinate; 0: none.
struct Shading {
  double height_step = 0;
};

/// Pixels of Cairo's ARGB32, premultiplied, rows without gaps. Everything that lies behind shows through in the order
/// of depth. `left`, `top`: page place of the image; `per_point`: pixels a point.
std::vector<std::uint32_t> shade(const View& view, const std::vector<ShadedSurface>& surfaces, const Shading& shading,
                                 core::Point2 left_top, int width, int height, double per_point);

}  // namespace clearloci::report
