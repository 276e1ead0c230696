// Where can the mechanism move without losing contact, over one to three free coordinates with angles among them? The
// zones of a working mode by cells: what clearloci/zones.hpp cuts exactly over two lengths, here with bounds from
// inside and from outside (docs/method.md section 13).
//
//     const clearloci::PoseZones map = clearloci::find_pose_zones(clearloci::Model::read("three_upu.yaml"));
//     std::cout << map.zones.front().at_least << " to " << map.zones.front().at_most << " m^3\n";
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/pose.hpp"

namespace clearloci::inline core {

struct PoseZoneBound {
  LocusKind kind = LocusKind::contact_loss;
  std::vector<Vanishing> reactions;
};

/// An end of a zone over one coordinate: the locus that ends it, and how far the end effector jumps across it.
struct PoseZoneEnd {
  double at = 0;
  LocusKind kind = LocusKind::contact_loss;
  std::vector<Vanishing> reactions;
  std::optional<PoseError> jump = {};  ///< behind minus before, where joints have clearances and both sides have errors
};

struct PoseZoneBall {
  std::vector<double> centre;
  double radius = 0;
};

/// Sizes are products of the coordinates' units: rad over one angle, m over one length, m^3 over three lengths.
struct PoseZone {
  std::string id;                                ///< "z1": the largest comes first
  int assembly_mode = 0;                         ///< sign of |A|
  std::vector<std::pair<Vanishing, int>> signs;  ///< of every couple, axial or normal force wanted
  double at_least = 0;                           ///< proven: of cells and parts free of loci that hang together
  double at_most = 0;                            ///< with all in doubt that may belong to it
  std::vector<double> lower, upper;              ///< the box around what is proven; over one coordinate the zone itself
  std::vector<double> sample;                    ///< a pose inside
  std::vector<PoseZoneBound> bounds;             ///< what may vanish beside it
  bool at_side = false;                          ///< the box of the mechanism file cuts it
  /// Zones that are not proven to be another one: no sign differs, and only cells in doubt lie between.
  std::vector<std::string> perhaps_one_with;
  std::vector<PoseZoneEnd> ends = {};  ///< over one coordinate, at its lower and upper end where a locus is known there
  /// The outside of what is proven: over three coordinates convex polygons, counter-clockwise from outside, over two
  /// segments.
  std::vector<std::vector<std::array<double, 3>>> faces = {};
  /// Over two and three coordinates the largest ball in what is proven that was found: proven to be inside. Distances
  /// are of the coordinates as they stand, m and rad alike.
  std::optional<PoseZoneBall> ball = {};
};

struct PoseZones {
  std::string mechanism;
  std::vector<std::string> coordinates;
  std::vector<bool> angles;
  std::vector<double> lower, upper;
  std::vector<std::pair<std::string, std::string>> working_mode;  ///< as describe_mode
  std::vector<PoseZone> zones;
  double outside = 0;   ///< proven to be out of reach
  double in_doubt = 0;  ///< neither that nor in a zone
  long cells = 0;
  /// A grid over the box, for pictures and volumes: the numbers of cells along each coordinate and, the first fastest,
  /// what is in the middle of each: the zone's place in `zones` from 1 on, 0 what is in doubt, -1 out of reach.
  std::vector<int> grid = {};
  std::vector<int> labels = {};
  bool complete = true;  ///< false: a deadline came first
  std::vector<std::string> notes;
  Units units = {};
};

}  // namespace clearloci::inline core

namespace clearloci {

/// In the first of the request's working modes. `cells`: how many are looked at. Throws as trace_loci, and InputError
/// where more than three coordinates are free.
PoseZones find_pose_zones(const Model& model, const LociRequest& request = {}, long cells = 300'000);

}  // namespace clearloci
