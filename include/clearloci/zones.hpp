// Where can the mechanism move without losing contact? Its discontinuity-free zones (docs/method.md section 9;
// docs/results.md, zones.json): the faces into which the loci, the workspace boundary and the direct singularities cut
// the workspace of a working mode.
//
//     const clearloci::ZoneMap map = clearloci::find_zones(clearloci::Model::read("five_bar.yaml"));
//     std::cout << map.zones.size() << " zones, the largest of " << map.zones.front().area << " m^2\n";
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "clearloci/loci.hpp"

namespace clearloci::inline core {

/// A stretch of a zone's border on one curve. A curve that ends inside the zone borders it from both sides.
struct ZoneBorder {
  std::string curve;  ///< LocusCurve::id, or "box"
  double length = 0;  ///< m, all stretches together
};

struct Zone {
  std::string id;  ///< "z1": within a mode the largest comes first
  WorkingMode mode;
  int assembly_mode = 0;                         ///< sign of |A|
  std::vector<std::pair<Vanishing, int>> signs;  ///< of every couple, axial force or normal force wanted
  double area = 0;                               ///< m^2
  Polyline outer;                                ///< counter-clockwise, first point repeated
  std::vector<Polyline> holes;                   ///< clockwise, first point repeated
  Circle inscribed;                              ///< the largest without isolated points; radius 0: too thin
  Point2 sample{};                               ///< a pose inside: the centre of `inscribed`
  std::vector<ZoneBorder> borders;               ///< longest first
  std::vector<int> isolated_points;              ///< inside, by their place in LocusMap::isolated_points
  bool certified = false;                        ///< the borders and how they meet are proven
};

/// How much of a mode's workspace inside the box its zones account for.
struct ModeArea {
  WorkingMode mode;
  double workspace = 0;  ///< m^2
  /// Of that: in zones that are not certified, in no zone, or in more than one. 0: the zones are proven, and cover it.
  double in_doubt = 0;
};

struct ZoneMap {
  LocusMap loci;                     ///< what cuts; ids of borders are its curves'
  std::vector<Zone> zones;           ///< by mode, then area, largest first
  std::vector<ModeArea> areas = {};  ///< one a mode
};

}  // namespace clearloci::inline core

namespace clearloci {

/// The zones of the request's modes, over two lengths. Polylines are finer than the request's tolerance where areas
/// correct to 1e-6 need it. Throws as trace_loci, InputError where a free coordinate is an angle or there are not two,
/// and LimitReached where the deadline comes first.
ZoneMap find_zones(const Model& model, const LociRequest& request = {});

}  // namespace clearloci
