// That a mechanism keeps clear of every locus over a task of poses, over one to six coordinates, and of the parameters
// that vary within tolerances and loads that vary within ranges: cells that cover the task and its margin, each shown
// by equations of the checker's own; groups are in the assembly of their file (check/group_sheet.hpp).
// Private to check/.
//
// Over a cell with the middle m, C is an inverse of A(m) in doubles, w0 one of the solution, and E = I - C A. With
// rho = C (b - A w0) each solution w over the cell has
//     w - w0 = rho + E (w - w0),   |w - w0| <= d where |rho| + |E| d <= d
// and A is regular where |E| d < d for a d above 0 (Neumaier, Interval Methods for Systems of Equations, section 4.1).
// rho and the sums of reactions keep their slopes, so that what is left of a cell shrinks with its square.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "check/group_sheet.hpp"
#include "check/refutation.hpp"
#include "check/task_region.hpp"
#include "core/rational.hpp"
#include "core/task_conditions.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::check {

/// Exact numbers in m and rad.
struct PoseTaskClaim {
  std::string model;  ///< its text
  std::vector<std::pair<std::string, std::string>> overrides;
  std::vector<std::string> coordinates;
  ClaimedShape shape;
  std::optional<core::Rational> angle_length;
  std::vector<int> sides;  ///< one a dyad or slider
  struct Range {
    std::string parameter;
    core::Rational lower, upper;
  };
  std::vector<Range> parameters;
  /// None, or what the force of the model's one load turns from and to, N.
  std::vector<std::vector<core::Rational>> loads_from;
  /// A force that differs from a load's in any direction by so much, N, and a couple, N m.
  struct LoadWithin {
    std::size_t load = 0;
    core::Rational force, couple;
  };
  std::vector<LoadWithin> loads_within;
  std::vector<core::TaskDemand> demands;
  std::vector<std::string> unchecked;
  /// Free efforts that are constant in each cell of poses, in N or N m.
  struct Law {
    std::vector<Cell> cells;
    struct Efforts {
      std::vector<std::string> joints;                    ///< whose efforts are chosen; those of others follow
      std::vector<std::vector<core::Rational>> at_loads;  ///< at the load, or at the first and the last of loads_from
      std::vector<std::vector<core::Rational>> gains;     ///< of each part of loads_within: what it adds, a unit
      bool operator==(const Efforts&) const = default;
    };
    std::vector<Efforts> efforts;  ///< one a cell
  };
  std::optional<Law> law;
  std::optional<Refutation> refutation;  ///< then the claim is that no free efforts keep the task clear
};

/// Throws core::InputError where the object is none.
PoseTaskClaim read_pose_task(const nlohmann::json& root, const std::string& file);

/// Throws FalseClaim for what is not shown, core::InputError for what check does not know, core::LimitReached where the
/// deadline comes first.
void check_pose_task(const mechanism::Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline,
                     Examination& examination);

/// What has to hold all over a task: that the mechanism closes; that A is regular, too; that it is clear of every locus
/// and keeps to all bounds.
enum class Holding { closure, regular, clear };

/// That it does, over cells; returns how many. `shown`: poses of the sides of the claim, to which it adds. Throws as
/// check_pose_task.
std::size_t check_poses(const mechanism::Mechanism& m, const PoseTaskClaim& claim, Holding holding,
                        const Deadline& deadline, GroupPlaces& shown);

/// At a pose that is all of a claim's task. Throws as check_pose_task where the mechanism does not close.
struct PoseSigns {
  int determinant = 0;  ///< of |A|; 0: not known
  /// Of the reactions of one component, and of forces along the link that bears them; 0: not known, or of several.
  std::vector<int> demands;
};
PoseSigns signs_at(const mechanism::Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline,
                   GroupPlaces& shown);

/// What the components of demands are within at such a pose, N or N m. Throws likewise, and where A is not regular.
std::vector<std::vector<std::array<double, 2>>> reactions_at(const mechanism::Mechanism& m, const PoseTaskClaim& claim,
                                                             const Deadline& deadline, GroupPlaces& shown);

/// Whether a pose is one of the task or of its margin, or within rounding of them.
bool may_be_pose_of(const mechanism::Mechanism& m, const PoseTaskClaim& claim, const std::vector<core::Rational>& pose);

/// Tensions of as many cables as the model leaves free are chosen, and those of the others follow. Throws FalseClaim
/// where there are other numbers of them.
void choose_cables(mechanism::Mechanism& m, const std::vector<std::string>& joints);

/// Throws as check_pose_task.
void check_refutation(const mechanism::Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline,
                      Examination& examination);

/// The sizes together of cells of a task over one coordinate in which it is not shown that no pose is within reach: of
/// a mechanism with groups all of it.
double maybe_reached(const mechanism::Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline);

}  // namespace clearloci::check
