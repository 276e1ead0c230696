// From a mechanism to its discontinuity loci in one call (clearloci/loci.hpp). Joins the modules and adds nothing:
//     Mechanism -> symbolic::locus_problem -> loci::trace -> LocusMap
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/validate.hpp"
#include "core/certificate.hpp"
#include "core/locus_map.hpp"
#include "core/sketch.hpp"
#include "loci/trace.hpp"
#include "mechanism/read.hpp"
#include "numeric/validate.hpp"
#include "symbolic/locus_problem.hpp"

namespace clearloci {

/// What of a request symbolic/ is asked for.
symbolic::Selection selection_of(const LociRequest& request);

/// The discontinuity loci of a mechanism: points over one free coordinate, curves over two, surfaces over three.
/// Throws core::InputError where the mechanism has no loci to speak of: a system that is not square, a determinant that
/// vanishes in every pose, an unknown joint, a working mode of the wrong length.
/// `certificate`: over two lengths, where what is claimed of cells goes; may be null.
core::LocusMap trace_loci(const mechanism::Mechanism& mechanism, const LociRequest& request = {},
                          core::Certificate* certificate = nullptr);

/// The loci together with the problem that they solve, for work that goes on from there. The problem is empty where
/// the deadline came first. Coordinates are those of the mechanism itself, however far from the origin: callers put it
/// into its frame first (analysis/framed.hpp).
struct TracedSheet {
  core::LocusProblem problem;
  core::LocusMap map;
};
/// `sheets`: where roots of the tower depend on one another (symbolic/locus_problem.hpp) there are several problems
/// over two lengths, and `map` is theirs together; `problem` is then the first. Else empty.
struct TracedProblem {
  core::LocusProblem problem;
  core::LocusMap map;
  std::vector<TracedSheet> sheets = {};
};
/// A sketch is for pictures and names, where something else proves what counts (loci::TraceOptions::sketch).
enum class TraceEffort { full, sketch };
/// What else there may be, each null where there is none: a certificate to fill in, what was found for another
/// tolerance (loci::TraceOptions), the family that the mechanism is a member of, who wants to know the problems.
struct TraceMeans {
  core::Certificate* certificate = nullptr;
  loci::sheet::KnownSearches* searches = nullptr;
  const symbolic::LocusFamily* family = nullptr;
  /// Told of the problems before they are traced; may be empty.
  std::function<void(const std::vector<symbolic::DerivedProblem>&)> derived = {};
};
TracedProblem trace_problem(const mechanism::Mechanism& mechanism, const LociRequest& request = {},
                            const TraceMeans& means = {}, TraceEffort effort = TraceEffort::full);

/// The same for a member of a family of designs, whose equations are derived already.
core::LocusMap trace_loci(const mechanism::Mechanism& member, const symbolic::LocusFamily& family,
                          const LociRequest& request = {});

/// What a request traces, in the coordinates of the mechanism. `family`: may be null.
std::vector<symbolic::DerivedProblem> derived_problems(const mechanism::Mechanism& mechanism,
                                                       const LociRequest& request,
                                                       const symbolic::LocusFamily* family = nullptr);

/// The coordinates of the mechanism in place of those of the charts.
void name_coordinates(const mechanism::Mechanism& mechanism, core::LocusMap& map);

/// Throws core::InputError, saying what has no meaning here, where the number of free coordinates is another, or where
/// ranges and lengths differ by more than doubles resolve beside each other.
void require_coordinates(const mechanism::Mechanism& mechanism, std::size_t least, std::size_t most,
                         const std::string& what);

/// Throws core::InputError where a mode of the request has not one side, +1 or -1, for each dyad, or where all modes
/// are too many.
void check_sides(const mechanism::Mechanism& mechanism, const LociRequest& request);

/// The working modes that a request means, as sides of the dyads: the file's own where it names none.
std::vector<DyadSides> requested_modes(const mechanism::Mechanism& mechanism, const LociRequest& request);

/// Sides of the dyads as a mode of the tower, whose roots of lengths have no side to choose.
core::WorkingMode mode_of(const DyadSides& sides, const core::TowerNames& tower);

/// A map without loci: the box, the coordinates and the names of the working mode, for pictures of something else.
core::LocusMap empty_map(const mechanism::Mechanism& mechanism);

/// The map of work that a limit ended before there was a locus to show: complete = false, `reason` among its notes.
core::LocusMap unfinished_map(const mechanism::Mechanism& mechanism, const std::string& reason);

/// The scalar reactions (fx, fy, and M where actuated) of the joints that a request means, in the file's order.
/// `request.joints` empty: every joint with a clearance, or all where none has one; in space then without the couples
/// across a joint's axes, of which no clearance depends.
std::vector<numeric::TracedReaction> selected_reactions(const mechanism::Mechanism& mechanism,
                                                        const LociRequest& request);

/// Traces every scalar reaction of the request's joints and holds the arcs, over one coordinate the points, over three
/// the surfaces, against reactions solved numerically. Throws core::LimitReached where the request's deadline comes
/// before they are complete.
core::Validation validate_loci(const mechanism::Mechanism& mechanism, LociRequest request,
                               const numeric::GridSpec& grid = {});

/// Whether the free coordinates are x and y of the end effector's point: a picture over them then shows the mechanism.
bool pose_is_place_of_end_effector(const mechanism::Mechanism& mechanism);

/// The mechanism in a sample posture of every working mode of the map, for its pictures: in the plane of the loci where
/// the free coordinates are the place of the end effector's point, else beside them.
std::vector<core::ModeSketch> sample_sketches(const mechanism::Mechanism& mechanism, const core::LocusMap& map);

}  // namespace clearloci
