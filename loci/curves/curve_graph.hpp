// The curve's topology: crossings (points where it meets cell edges, the box, the workspace boundary, stars) joined by
// stretches, each inside one cell where it is proven to be a single graph over one variable.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

/// A chart with the program of the curve in its coordinates (function 0), and its subdivision. Copies share both.
struct Patch {
  Chart chart;
  PlaneCell domain;
  std::shared_ptr<const SheetProgram> program;
  std::shared_ptr<const CellTree> tree;
};

struct Crossing {
  enum class Kind { seam, box, rim, star, node, cut, edge };
  Kind kind = Kind::seam;
  core::Point2 at{};
  int star = -1;                            ///< of a star
  core::ArcEnd label = core::ArcEnd::none;  ///< of a cut; of a star where a cutter reaches it in the same direction
  core::ArcEnd alone = core::ArcEnd::none;  ///< of a region's edge: what an arc that goes no further ends at
  std::array<std::optional<double>, 2> fixed = {};  ///< of a box's side: the coordinate that it tells
};

/// One end of a stretch: the crossing, enclosed in the coordinates and roots of the stretch's patch.
struct StretchEnd {
  int crossing = -1;
  std::vector<Interval> enclosure;

  LiftedPoint middle() const;
};

/// `leaf` -1: through or into an undecided cluster, where nothing is proven.
struct Stretch {
  int patch = 0;
  int leaf = -1;
  int along = 0;
  StretchEnd ends[2];  ///< in ascending order of variable `along`
};

/// An undecided cluster wider than this, relative to the patch, is what a spent budget left: nothing to be seen yet.
inline constexpr double widest_place = 1e-6;

/// An undecided cluster: of size rounding, or what a spent budget left.
struct Cluster {
  int patch = 0;
  PlaneCell cell;       ///< in the patch's coordinates
  int node = -1;        ///< crossing at which more than two branches meet in it
  bool lonely = false;  ///< no branch reaches it
};

struct CurveGraph {
  std::vector<Patch> patches;
  std::vector<Crossing> crossings;
  std::vector<Stretch> stretches;
  std::vector<Cluster> clusters;
  std::vector<PlaneCell> undecided;  ///< in the plane, clusters included
  /// In the plane: where the curve of another working mode touches this mode's sheet, on the rim of a root.
  std::vector<PlaneCell> touched_from_beyond;
  bool stopped = false;         ///< by TreeOptions::stop or the budget
  bool open_at_corner = false;  ///< all that is open may be so because a branch leaves a star towards a corner of it
};

/// The patches of a sheet over a box, charted and compiled. `box`: x0, x1, y0, y1.
std::vector<Patch> make_patches(const core::RootTower& tower, const SheetFunction& curve, const Partition& parts);

/// Subdivides the patches and joins what crosses. Tries again with other cuts where rounding leaves an incidence open;
/// what remains open after that is in `undecided`.
CurveGraph curve_graph(const core::RootTower& tower, const SheetFunction& curve, const core::WorkingMode& mode,
                       const Partition& parts, const TreeOptions& options);

/// Cuts the stretch that holds the place (in the coordinates of patch `patch`) at a new crossing, which gets its place
/// on the curve. False: rounding does not tell which stretch that is.
bool cut_stretch(CurveGraph& graph, int patch, std::vector<Interval> enclosure, Crossing crossing);

}  // namespace clearloci::loci::sheet
