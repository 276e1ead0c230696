// Pose errors over the workspace, by the compiled elimination: reactions, take-up and H Δ_C of many poses at once.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/field_map.hpp"
#include "numeric/pose_error.hpp"

namespace clearloci::numeric {

/// Of the plane dx, dy, dalpha, dp, of space dx, dy, dz, dalpha_x, dalpha_y, dalpha_z, dp; with the worst case worst_
/// of each behind them.
std::vector<core::ErrorComponent> error_components(mechanism::Space space, bool worst_case);

struct ErrorGrid {
  int nx = 400, ny = 400;
  int threads = 0;                    ///< 0: as many as the machine has
  bool worst_case = true;             ///< also the worst case over all take-ups
  double worst_case_accuracy = 1e-9;  ///< relative: how far the bound of |Δp| may be above the true value
};

struct ErrorMap {
  /// dx, dy, dalpha, dp; worst_dx, worst_dy, worst_dalpha, worst_dp. In space dx, dy, dz, dalpha_x, dalpha_y, dalpha_z,
  /// dp; worst_ of each.
  core::FieldMap map;
  std::size_t reachable = 0;  ///< cells with a posture
  std::size_t undefined = 0;  ///< of those, cells on a locus to the last bit: no error there
  /// Joints whose reaction is zero in every pose, to rounding: their take-up is undefined everywhere, and the map has
  /// the worst case alone.
  std::vector<std::string> never_loaded;
};

/// `mode`: a sign a dyad. Fields are NaN outside the workspace. Throws core::InputError where the
/// mechanism has no clearance or not two free coordinates.
ErrorMap error_map(const NumericModel& model, std::span<const int> mode, const ErrorGrid& grid = {});

struct ErrorVolume {
  core::FieldVolume volume;  ///< fields as of ErrorMap
  std::size_t reachable = 0, undefined = 0;
  std::vector<std::string> never_loaded;
};

struct VolumeGrid {
  std::array<int, 3> cells = {40, 40, 40};
  int threads = 0;
  bool worst_case = true;
  double worst_case_accuracy = 1e-9;
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
};

/// Over three free coordinates; likewise. Throws core::LimitReached where the deadline comes first.
ErrorVolume error_volume(const NumericModel& model, std::span<const int> mode, const VolumeGrid& grid = {});

}  // namespace clearloci::numeric
