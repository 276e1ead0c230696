// Pose errors over the workspace, by the compiled elimination: reactions, take-up and H Δ_C of many poses at once.
#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/field_map.hpp"
#include "numeric/pose_error.hpp"

namespace clearloci::numeric {

/// The fields of errors without values. Of the plane dx, dy, dalpha, dp, of space dx, dy, dz, dalpha_x, dalpha_y,
/// dalpha_z, dp, `under_load`; with the worst case worst_ of each.
std::vector<core::Field> error_fields(mechanism::Space space, bool under_load, bool worst_case);

/// A map over the model's box without values; `axes`: as of core::FieldMap. Throws core::InputError where no joint has
/// a clearance.
core::FieldMap empty_error_map(const NumericModel& model, std::vector<std::vector<double>> axes);

struct ErrorGrid {
  std::vector<int> cells;             ///< along each coordinate
  int threads = 0;                    ///< 0: as many as the machine has
  bool worst_case = true;             ///< also the worst case over all take-ups
  double worst_case_accuracy = 1e-9;  ///< relative: how far the bound of |Δp| may be above the true value
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
};

struct ErrorMap {
  core::FieldMap map;         ///< in the middles of the cells; NaN outside the workspace
  std::size_t reachable = 0;  ///< cells with a posture
  std::size_t undefined = 0;  ///< of those, cells on a locus to rounding: no error there
  /// Joints whose reaction is zero in every pose, to rounding: their take-up is undefined everywhere, and the map has
  /// the worst case alone.
  std::vector<std::string> never_loaded;
};

/// `mode`: a sign a dyad. Throws core::InputError where no joint has a clearance, where there are no cells, or not as
/// many numbers of them as coordinates; core::LimitReached where the deadline comes first.
ErrorMap error_map(const NumericModel& model, std::span<const int> mode, const ErrorGrid& grid);

}  // namespace clearloci::numeric
