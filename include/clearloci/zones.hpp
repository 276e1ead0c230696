// Where can the mechanism move without losing contact? Its discontinuity-free zones: the parts into which the loci, the
// workspace boundary and the direct singularities cut the workspace of a working mode, over one to three free
// coordinates. Over two lengths they are the faces of an arrangement of curves (method.md section 9); over other
// coordinates they are found by cells, with bounds from inside and from outside (section 13). results.md,
// zones.json.
//
//     const clearloci::Zones found = clearloci::find_zones(clearloci::Model::read("three_upu.yaml"));
//     std::cout << found.zones.front().at_least << " to " << found.zones.front().at_most << " m^3\n";
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/pose.hpp"

namespace clearloci::inline core {

/// What borders a zone. A curve that ends inside the zone borders it from both sides.
struct ZoneBorder {
  std::string curve = {};                 ///< over two lengths LocusCurve::id, or "box"; by cells empty, or "box"
  double length = 0;                      ///< m, all stretches of a curve together; 0 by cells
  std::optional<LocusKind> kind = {};     ///< nothing: a side of the box
  std::vector<Vanishing> vanishing = {};  ///< there; by cells what may vanish there
  /// Over two lengths the zones on the other side; empty where a fold cuts the plane into sheets.
  std::vector<std::string> beside = {};
  std::string cause = {};  ///< by cells, of a bound of an effort: "tension of K1 at 60 N"
};

/// An end of a zone over one coordinate: the locus that ends it, and how far the end effector jumps across it.
struct ZoneEnd {
  double at = 0;
  LocusKind kind = LocusKind::contact_loss;
  std::vector<Vanishing> vanishing = {};
  /// The limit beyond which no pose is reached: "spring S, whose ends G1 and G2 meet", "flank of gear W".
  std::string limit = {};
  std::optional<PoseError> jump = {};  ///< behind minus before, where joints have clearances and both sides have errors
  bool turns = false;                  ///< what vanishes has another sign, or turns round, from one side to the other
  bool certified = false;              ///< of a dead centre: it is proven to be one
  std::string cause = {};              ///< "dead centre of group hip"
  /// Where what turns vanishes, computed in floating point: between this end and that of the zone beyond it.
  std::optional<double> zero = {};
};

/// Distances are of the coordinates as they stand, m and rad alike.
struct ZoneBall {
  std::vector<double> centre;
  double radius = 0;
};

/// Which choices of the free efforts keep every demanded reaction, and all bounds of efforts, at a zone's sample, of a
/// mechanism with free efforts without a value. At other poses of the zone the ranges are others, but there are as
/// many, with the same signs, and the same reactions end them.
struct ZonePreload {
  bool feasible = false;
  /// Of one free effort what it may be; of several what each may be while the others suit it, of cables all of them.
  /// Known to rounding.
  std::vector<FeasibleEfforts> efforts;
  std::optional<double> smallest;  ///< size of the smallest choice (docs/guide/preload.md); none where there is none
  /// The signs of the demanded reactions that have one component: of one free effort for every range, of several
  /// motors every choice of signs that is possible.
  std::vector<std::vector<std::pair<Vanishing, int>>> patterns;
};

/// Sizes are products of the coordinates' units: m^2 over two lengths, rad over one angle, m^3 over three lengths.
struct Zone {
  std::string id;  ///< "z1": within a mode the largest comes first
  WorkingMode mode;
  int assembly_mode = 0;                         ///< sign of |A|
  std::vector<std::pair<Vanishing, int>> signs;  ///< of every couple, axial force or normal force wanted
  std::vector<Vanishing> too_small;              ///< what is smaller than --min-force or --min-couple in it
  double size = 0;                               ///< over two lengths the area; by cells `at_least`
  /// Bounds of the size. Where a zone over two lengths is certified both are its area; where it is not they are 0 and
  /// the area of the box. By cells: what is proven to hang together without a locus, and that with all in doubt that
  /// may belong to it.
  double at_least = 0, at_most = 0;
  /// The borders and how they meet are proven; by cells: it is proven to be another zone than all others.
  bool certified = false;
  std::vector<std::string> perhaps_one_with = {};  ///< by cells: zones of the same signs that only doubt parts from it
  /// The box around it, by cells around what is proven; over one coordinate the zone.
  std::vector<double> lower, upper;
  std::vector<double> sample;  ///< a pose inside
  /// The largest ball inside that was found, over two lengths the largest circle without isolated points. Radius 0: it
  /// is too thin, or over one coordinate.
  ZoneBall ball;
  std::vector<ZoneBorder> borders;   ///< over two lengths longest first
  std::vector<int> isolated_points;  ///< over two lengths: those inside, by their place in LocusMap::isolated_points

  std::optional<ZonePreload> preload = {};  ///< over two lengths

  // Its shape: over one coordinate from `lower` to `upper`, with its ends; over two lengths rings; by cells over two
  // and three coordinates the outside of what is proven.
  std::vector<ZoneEnd> ends = {};  ///< the lower and the upper one, where a locus is known there
  Polyline outer;                  ///< counter-clockwise, first point repeated
  std::vector<Polyline> holes;     ///< clockwise, first point repeated
  /// Over three coordinates convex polygons, counter-clockwise from outside, over two segments.
  std::vector<std::vector<std::array<double, 3>>> faces = {};
};

/// Zones with preload loci alone between them in which efforts with the same signs of the demanded reactions exist:
/// there an effort that varies continuously with the pose keeps these signs.
struct PreloadRegion {
  WorkingMode mode;
  std::vector<std::pair<Vanishing, int>> signs;  ///< as one of ZonePreload::patterns
  std::vector<std::string> zones;
  double size = 0;  ///< of them together, m^2
};

/// How much of the box the zones of a mode account for, in the unit of their sizes.
struct ZonedMode {
  WorkingMode mode;
  double workspace = 0;  ///< what the mode reaches in the box; by cells all that is not proven to be out of reach
  double outside = 0;    ///< the rest of the box
  /// Of the workspace: in zones that are not certified, in no zone, or in more than one; by cells in no zone. 0: the
  /// zones are proven, and cover it.
  double in_doubt = 0;
  long cells = 0;  ///< that were looked at, by cells
  /// By cells, in the middles of the grid of Zones::grid, the first coordinate fastest: the zone by its place in
  /// Zones::zones from 1 on, 0 what is in doubt, -1 out of reach.
  std::vector<int> labels = {};
};

struct Zones {
  /// Over two lengths what cuts; ids of borders are its curves'. By cells without loci: what remains are mechanism,
  /// coordinates, box, units and notes, and `complete`, false where the deadline came first.
  LocusMap loci;
  bool by_cells = false;                            ///< else by curves, over two lengths
  std::vector<Zone> zones;                          ///< by mode, then size, largest first
  std::vector<PreloadRegion> preload_regions = {};  ///< with one free effort without a value: largest first in a mode
  std::vector<ZonedMode> modes = {};                ///< one a mode
  std::vector<int> grid = {};  ///< by cells: of ZonedMode::labels, the number of cells along each coordinate
};

}  // namespace clearloci::inline core

namespace clearloci {

struct ZoneRequest {
  LociRequest loci = {};  ///< what cuts, working modes, deadline, progress; and how loci over two lengths are traced
  long cells = 300'000;   ///< by cells: how many are looked at in each mode; more part zones sharper
  bool by_cells = false;  ///< over two lengths, too
  /// By cells: of ZonedMode::labels; the larger, the better are the balls. Empty: 1024, 256 x 256 or 64 x 64 x 64.
  std::vector<int> grid = {};
};

/// The zones of the request's modes. Over two lengths polylines are finer than the request's tolerance where areas
/// correct to 1e-6 need it. Throws as trace_loci, InputError where more than three coordinates are free, and over two
/// lengths LimitReached where the deadline comes first.
Zones find_zones(const Model& model, const ZoneRequest& request = {});

}  // namespace clearloci
