// Loci and zones over one coordinate: intervals that are clear of every locus, each shown as a task
// (check/pose_task.hpp), and points between them:
//     a reaction that is continuous between two poses at which it has different signs vanishes between them;
//     |A|, wherever the mechanism closes between them, likewise.
// What lies between the intervals and is no point is out of reach. Private to check/.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "check/certificate.hpp"
#include "check/pose_task.hpp"
#include "core/locus_map.hpp"

namespace clearloci::check {

/// In m and rad.
struct PoseRangeClaim {
  PoseTaskClaim head;  ///< the model and the coordinate
  /// An interval without loci: a zone, or a part of one.
  struct Free {
    std::string name;
    core::Rational from, to;
    int assembly_mode = 0;  ///< the sign of |A|, up to one that is the same all over the certificate; 0: not claimed
    std::vector<std::tuple<std::string, core::Quantity, int>> signs;
    std::vector<Reaction> too_small;  ///< smaller than their least size: all that is claimed of them is that they are
                                      ///< not zero
  };
  struct Point {
    core::LocusKind kind = core::LocusKind::contact_loss;
    std::vector<Reaction> vanishing;
    core::Rational at;
    bool certified = false;
  };
  struct Mode {
    std::vector<int> sides;
    std::vector<core::TaskDemand> demands;
    std::vector<Free> free;
    std::vector<Point> points;
    std::vector<std::pair<core::Rational, core::Rational>> open;  ///< nothing is claimed there
  };
  std::vector<Mode> modes;
};

/// Throws core::InputError where the object is none.
PoseRangeClaim read_pose_range(const nlohmann::json& root, const std::string& file);

/// Throws as check_pose_task.
void check_pose_range(const mechanism::Mechanism& m, const PoseRangeClaim& claim, const Deadline& deadline,
                      Examination& examination);

}  // namespace clearloci::check
