// The library's front door: from a mechanism to its discontinuity loci in one call. Joins the modules and adds nothing:
//     Mechanism -> symbolic::locus_problem -> loci::trace -> LocusMap
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "core/locus_map.hpp"
#include "core/sketch.hpp"
#include "loci/trace.hpp"
#include "mechanism/read.hpp"
#include "symbolic/locus_problem.hpp"

namespace clearloci {

/// Signs of a mechanism's dyads, in the order of mechanism::dyad_points: +1 left, -1 right.
using DyadSides = std::vector<int>;

struct LociRequest {
  symbolic::Selection selection;         ///< joints, quantities, margins
  double tolerance = 1e-5;               ///< largest distance of a chord from its curve, m
  std::vector<DyadSides> working_modes;  ///< empty: the file's
  bool all_working_modes = false;        ///< every combination of sides, the file's first
  loci::Engine engine = loci::Engine::automatic;
  std::optional<std::chrono::steady_clock::time_point> deadline;          ///< then: what is known, complete = false
  std::function<void(double fraction, std::string_view stage)> progress;  ///< may be empty
};

/// The discontinuity loci of a mechanism with two free coordinates (or, with one, their points).
/// Throws core::InputError where the mechanism has no loci to speak of: a system that is not square, a determinant that
/// vanishes in every pose, an unknown joint, a working mode of the wrong length.
core::LocusMap trace_loci(const mechanism::Mechanism& mechanism, const LociRequest& request = {});

/// The mechanism in a sample posture of every working mode of the map, in the map's order of modes; for pictures.
std::vector<core::Sketch> sample_sketches(const mechanism::Mechanism& mechanism, const core::LocusMap& map);

}  // namespace clearloci
