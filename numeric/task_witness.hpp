// Whether a pose fails a task, for certain, by reactions solved in floating point with bounds on their rounding errors:
// the witness without whom no task is called refuted. It knows the mechanism, not the enclosures or the curves. Poses
// have one to six coordinates; of open designs (mechanism/open_design.hpp) variables follow them.
//
// A reaction's numerator and |A| vary continuously with the pose wherever the mechanism is assembled: if the sign of
// either is certain at both ends of a way and differs, then on that way it vanishes or the mechanism does not follow.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/task_conditions.hpp"
#include "numeric/reactions.hpp"

namespace clearloci::numeric {

struct TaskFailure {
  enum class Kind {
    unreachable,  ///< the mechanism does not reach the pose
    boundary,     ///< it does, but not one within rounding of it
    singular,     ///< |A| is zero, to rounding
    vanishing,    ///< the reaction is zero, to rounding
    too_small,    ///< it is less than it has to be
    beyond_bound  ///< the effort is not within its bound
  };
  Kind kind = Kind::unreachable;
  core::TaskDemand demand = {};      ///< of the last two kinds, like what follows
  double load = 0;                   ///< t, from the first load to the last
  double size = 0;                   ///< of the reaction there, or the effort, N or N m
  std::vector<double> changes = {};  ///< where loads may differ within balls: of each direction, N or N m
};

/// The loads under which a task is asked for. All models must outlive what uses them.
struct WitnessLoads {
  std::vector<const NumericModel*> ends = {};  ///< the mechanism under the one load, or under the first and the last
  std::vector<const NumericModel*> directions = {};  ///< under unit loads
  std::vector<core::LoadBall> balls = {};            ///< what may come on top, by the directions
};

/// The components of what is demanded, times |A|: two of a guide's contact as a whole, one of either end of it; of an
/// effort with a bound side (w - at).
std::vector<Bounded> demanded_parts(const NumericModel& model, const core::TaskDemand& demand,
                                    const BoundedNumerators& numerators);

class TaskWitness {
 public:
  /// How far from a pose others are that cannot be told from it, by rounding.
  enum class Rounding {
    of_plane,       ///< the first two values are a place in the plane; what follows them is a variable
    of_coordinates  ///< each value is a coordinate, measured alone
  };

  /// `demands`: without those of reactions that are zero whatever the pose. `usual`: poses that say how large |A| is,
  /// besides those of the workspace, and coordinates.
  TaskWitness(WitnessLoads loads, std::vector<int> mode, std::vector<core::TaskDemand> demands,
              const std::vector<std::vector<double>>& usual, Rounding rounding);

  /// All that fail at a pose; one that has no demand, if any, alone. Nothing where the pose is good, or doubles cannot
  /// tell. It stands for every pose within a few roundings, and for variables within their errors. `closely`: also
  /// whether the boundary of the workspace passes through it.
  std::vector<TaskFailure> failures(std::span<const Bounded> at, bool closely) const;

  /// The first of them.
  std::optional<TaskFailure> failure(std::span<const double> at, bool closely) const;

  /// The same of one demand; of -1, of |A| and the workspace alone.
  std::optional<TaskFailure> failure_of(std::span<const double> at, int demand) const;

  /// Whether a sign differs, for certain, at two poses: of |A| with demand -1, else of the one component of a reaction,
  /// of its part along the pins of a two-force link, or of |A|.
  bool differs(std::span<const double> a, std::span<const double> b, int demand) const;

  /// Of a reaction at some poses: zero at all of them, as closely as rounding lets tell; within the bounds of rounding
  /// only; or other than zero at one.
  enum class Loaded { never, perhaps, sometimes };
  Loaded is_loaded(int demand, const std::vector<std::vector<double>>& poses) const;

  const std::vector<core::TaskDemand>& demands() const { return demands_; }

 private:
  /// Under the ends of the loads and under the directions.
  struct Solved {
    std::vector<BoundedNumerators> ends, directions;
  };

  /// Where all of a demanded force is along the pins of a two-force link: the way between them at two poses.
  std::optional<std::array<std::array<Bounded, 3>, 2>> lines_of_force(const core::TaskDemand& demand,
                                                                      std::span<const double> a,
                                                                      std::span<const double> b) const;
  double rounding_at(std::span<const Bounded> at, std::size_t c) const;
  std::size_t coordinates(std::span<const Bounded> at) const;
  /// How many of the poses that cannot be told from one are within reach, and of how many.
  std::pair<int, int> reached_around(std::span<const Bounded> at, double many) const;
  std::vector<BoundedNumerators> numerators(const std::vector<const NumericModel*>& models, std::span<const Bounded> at,
                                            double many) const;
  /// What fails whatever is demanded; else `solved` is filled where demands can be judged.
  std::optional<TaskFailure> failure_of_pose(std::span<const Bounded> at, bool closely,
                                             std::optional<Solved>& solved) const;
  std::optional<TaskFailure> judged(int demand, const Solved& solved) const;
  std::vector<TaskFailure> some_failures(std::span<const Bounded> at, bool closely, std::size_t most) const;

  WitnessLoads loads_;
  std::vector<int> mode_;
  std::vector<core::TaskDemand> demands_;
  Rounding rounding_;
  double usual_determinant_ = 0;
  std::vector<double> extents_;  ///< of every value the largest among the usual poses
};

}  // namespace clearloci::numeric
