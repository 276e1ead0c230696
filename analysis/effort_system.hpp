// The reactions that a task asks for, as they depend on the free efforts and on what loads may differ by
// (docs/background/method.md section 15):
//     w = a(q) + B(q) lambda + C(q) p,        |p| <= R in every ball of loads_within
// in enclosures over cells (loci/tasks/effort_proof.hpp), and at single places with bounds on their rounding.
// Private to analysis/.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/effort_polytope.hpp"
#include "analysis/wanted_efforts.hpp"
#include "analysis/widened_task.hpp"
#include "core/interval.hpp"
#include "loci/tasks/tasks.hpp"
#include "numeric/model.hpp"

namespace clearloci {

/// Of reactions of one component and of backlash in free motors, by "M_A1": the sign that they keep all over a task.
using SignPattern = std::map<std::string, int>;

/// A row offset + slope . lambda >= 0, and what asks for it.
struct EffortInequality {
  std::string reaction;           ///< "M_A1"
  int sign = 1;                   ///< of the reaction; of a bound its side
  bool bound = false;             ///< of an effort's bound, or of what was looked at
  std::vector<double> at = {};    ///< pose, then design; empty: of an effort itself
  std::vector<double> load = {};  ///< what the load differs by
  std::size_t base = 0;           ///< under the first load of a range, or the last
  numeric::Bounded offset;
  std::vector<numeric::Bounded> slope = {};
};

/// Rows that exclude each other: sum y_i (offset_i + slope_i . lambda) < 0 for every lambda that is looked at.
struct EffortExclusion {
  std::vector<EffortInequality> rows;
  std::vector<double> multipliers;  ///< y, of the same length, each above zero
};

class EffortSystem {
 public:
  /// Of the joints without a preload of a mechanism, which are those of `wanted`. Throws core::InputError as
  /// WidenedTask.
  EffortSystem(const mechanism::Mechanism& mechanism, std::vector<WantedEffort> wanted, const core::Task& task,
               const DyadSides& sides, const LociRequest& request);
  EffortSystem(const EffortSystem&) = delete;
  EffortSystem& operator=(const EffortSystem&) = delete;

  const loci::pose::EffortStatics& statics() const { return statics_; }
  const std::vector<WantedEffort>& wanted() const { return wanted_; }
  const mechanism::Mechanism& mechanism() const { return mechanism_; }
  const std::vector<core::TaskDemand>& demands() const { return demands_; }
  const std::vector<std::string>& notes() const { return notes_; }
  /// Ranges of the designs' variables.
  loci::pose::PoseBox designs() const;
  /// A pose with the middle of all designs, and with some of their corners.
  std::vector<loci::pose::Pose> places(const loci::pose::Pose& pose) const;
  /// Of a free motor the couple that its own backlash asks for; none without play.
  const std::optional<double>& own_least(std::size_t effort) const { return own_leasts_[effort]; }

  /// Which load a row is of.
  struct OneLoad {
    std::size_t base = 0;
    std::vector<double> parts;
  };
  /// Rows of the reactions whose sign the pattern has, at a place: of every load the worst, or those under one load.
  /// Nothing where |A| cannot be told from zero.
  std::optional<std::vector<EffortInequality>> rows(const loci::pose::Pose& place, const SignPattern& signs,
                                                    const std::optional<OneLoad>& load = {}) const;
  /// All columns at a place, as they are; nothing likewise.
  std::optional<loci::pose::EffortColumns> columns(const loci::pose::Pose& place) const;
  /// Loads at which one reaction or another is worst.
  std::vector<OneLoad> extreme_loads(const loci::pose::Pose& place, const SignPattern& signs) const;
  /// What efforts may be themselves, as parts of `share` of their range, and the backlash of their motors.
  std::vector<EffortInequality> rows_of_efforts(const SignPattern& signs) const;
  /// A reaction that bears less than it has to at a pose under all efforts of a box; null where none does for certain.
  const core::TaskDemand* too_small(const loci::pose::Pose& pose, const std::vector<std::array<double, 2>>& box) const;
  /// The names of signs that are to be chosen.
  std::vector<std::string> signed_reactions() const;
  /// The largest effort that is looked at, N or N m.
  double largest(std::size_t effort) const;

 private:
  using Columns = std::vector<std::vector<numeric::Bounded>>;  ///< component, column
  using Solved = std::vector<Columns>;                         ///< one a demand
  bool is_too_small(const Columns& columns, double least, const OneLoad& load,
                    const std::vector<std::array<double, 2>>& box) const;
  std::vector<double> relieving_load(const Columns& columns, std::size_t base,
                                     const std::vector<std::array<double, 2>>& box) const;
  std::optional<Solved> solved(const loci::pose::Pose& place) const;
  std::vector<double> worst_load(const std::vector<numeric::Bounded>& columns, int sign) const;
  EffortInequality row_of(std::size_t demand, const std::vector<numeric::Bounded>& columns, int sign, OneLoad load,
                          const loci::pose::Pose& place) const;

  mechanism::Mechanism mechanism_;
  std::vector<WantedEffort> wanted_;
  DyadSides sides_;
  core::Task without_balls_;
  WidenedTask widened_;
  std::vector<numeric::NumericModel> models_;  ///< a column each
  std::vector<core::TaskDemand> demands_;
  std::vector<std::optional<double>> own_leasts_;
  loci::pose::EffortStatics statics_;
  std::vector<std::string> notes_;
  std::size_t poses_ = 0;
};

/// "M_A1".
std::string reaction_name(const core::TaskDemand& demand);
/// The sign that a pattern has for a demand; 0: none, or of several components. Of a bound its side.
int sign_of(const core::PoseDemand& demand, const SignPattern& signs);

/// Whether no efforts of a box meet a row, for certain.
bool all_fail(const EffortInequality& row, const std::vector<core::Interval>& box);
/// How far the efforts that meet a row are from a box of which none does, in floating point.
double distance_beyond(const EffortInequality& row, const std::vector<core::Interval>& box);

/// Whether no efforts that are looked at meet all rows, for certain: multipliers of a linear program, under which what
/// is left of the slopes is too small for any of these efforts to matter.
std::optional<EffortExclusion> excluded(const EffortSystem& system, const std::vector<EffortInequality>& rows);

/// The smallest size of efforts that meet all rows: not above it for certain, and the efforts. Nothing where there are
/// none.
struct SmallestEfforts {
  double size = 0;
  std::vector<double> efforts;
  EffortExclusion below;  ///< why smaller ones fail; empty where `size` is 0
};
std::optional<SmallestEfforts> smallest_efforts(const EffortSystem& system, const std::vector<EffortInequality>& rows);

}  // namespace clearloci
