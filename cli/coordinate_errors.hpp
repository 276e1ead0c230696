// `clearloci error` over a single free coordinate: take-up and pose error over its range, and the jumps at the loci.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/loci.hpp"
#include "cli/columns.hpp"
#include "numeric/error_range.hpp"
#include "report/chart.hpp"

namespace clearloci::cli {

/// Something that happens at one value of the coordinate, and by how much the end effector jumps there.
struct CoordinateEvent {
  core::IsolatedPoint point;
  numeric::PoseError jump;  ///< NaN where the error has no limit on both sides
};

/// One working mode. `columns`: the coordinate; reactions; beta_J, theta_J, travel_J, normal_J, tilt_J of the joints'
/// take-up; dx, dy, dalpha, dp and their worst cases; SI units. A row without values at every event, where the lines
/// are broken.
struct CoordinateErrors {
  core::WorkingMode mode;
  Columns columns;
  std::vector<std::string> never_loaded;
  std::vector<CoordinateEvent> events;
};

struct CoordinateResult {
  mechanism::Mechanism mechanism;
  core::LocusMap loci;
  std::vector<CoordinateErrors> modes;
  int steps = 0;
};

/// Requires: one free coordinate, planar. `loci`: its map, or one without loci. Throws core::InputError where no joint
/// has a clearance.
CoordinateResult coordinate_errors(const mechanism::Mechanism& mechanism, core::LocusMap loci,
                                   const std::vector<DyadSides>& modes, int steps, bool worst_case);

nlohmann::ordered_json coordinate_errors_json(const CoordinateResult& result);
void print_coordinate_errors(const CoordinateResult& result);

/// error, take-up, reactions of every mode, over the coordinate.
std::vector<report::NamedChart> coordinate_charts(const CoordinateResult& result);

}  // namespace clearloci::cli
