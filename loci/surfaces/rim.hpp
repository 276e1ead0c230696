// Where a surface ends on the workspace boundary Q_j = 0. Private to loci/surfaces.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "loci/surfaces/mesh.hpp"

namespace clearloci::loci::surface {

/// The root on whose boundary Q_j = 0 the whole surface lies, if it does.
std::optional<int> boundary_of(Field& field, const Mesh& mesh);

/// The part of a mesh with every Q_j >= 0, but for `boundary`, on which the surface lies; it ends on the curves where
/// the function and a Q_j vanish together.
class Clipping {
 public:
  Clipping(Field& field, Mesh mesh, std::optional<int> boundary);
  Clipping(Clipping&&) noexcept;
  Clipping& operator=(Clipping&&) noexcept;
  ~Clipping();

  const Mesh& mesh() const { return mesh_; }
  /// Points in triangles that may end otherwise than the surface does. Where the mesh that was given is isotopic to the
  /// surface as it goes on beyond the boundary, regular along its end (isotopy.hpp), the part is isotopic to the
  /// surface but for these: docs/background/exactness.md, Surfaces.
  std::vector<Point> unproven();

 private:
  class Clipper;

  Mesh mesh_;
  std::vector<std::unique_ptr<Clipper>> clippers_;  ///< one a root
};

}  // namespace clearloci::loci::surface
