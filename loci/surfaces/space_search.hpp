// What the searches for curves and for points over three coordinates have in common: boxes that are cut until it is
// known of each what is in it. Private to surfaces/.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "loci/surfaces/curve_search.hpp"

namespace clearloci::loci::space {

/// Two enclosures of one zero, as a part of the box: far above their width and below the distance of two.
constexpr double one_zero = 1e-9;

struct OpenCell {
  SpaceCell cell;
  int depth = 0;
  std::shared_ptr<const LiftedLook> look = {};  ///< once it was looked at
  bool empty = false;                           ///< then: there is no zero in it
  bool singular = false;                        ///< and: |A| may vanish in it
};

/// A range and a tenth of its width on either side: zeros beside it are then as good as others.
Interval widened(const Interval& range);

/// What touches a cell in which |A| may vanish, over a few others, is open for that reason; a curve that stays open
/// farther on is for another. `settled`: such cells that are known but for |A|.
void spread_singularity(std::vector<UndecidedCell>& cells, const std::vector<SpaceCell>& settled);

SpaceCell box_of(const core::LocusProblem& problem);

/// What the searches for curves and for points have in common.
class SpaceSearch {
 public:
  SpaceSearch(const core::LocusProblem& problem, const core::WorkingMode& mode, const Equations& equations,
              const SearchLimits& limits);

 protected:
  static std::vector<sheet::SheetFunction> functions_of(const Equations& equations);

  /// Looks at the first cells of a queue, side by side.
  void look_at(std::deque<OpenCell>& queue);

  /// Whether there is no zero in a cell, and whether |A| may vanish in it.
  void judge(const LiftedLook& look, OpenCell& cell);

  /// No factor of |A| vanishes where the equations do.
  bool excludes_singularity(const LiftedLook& look, const std::vector<std::size_t>& all);

  /// Cuts the box until `settle` says of every cell that is left, with its box and whether |A| may vanish in it, that
  /// it is known. Cells in which |A| may vanish come last: they may be many.
  template <class Result, class Settle>
  void search(Result& result, const Settle& settle) {
    std::deque<OpenCell> regular = {{box_, 0}}, singular;
    long looked_at[2] = {0, 0};
    while (!regular.empty() || !singular.empty()) {
      const bool late = regular.empty();
      std::deque<OpenCell>& from = late ? singular : regular;
      if (!from.front().look) look_at(from);
      OpenCell cell = std::move(from.front());
      from.pop_front();
      if (cell.empty) continue;
      if (cell.singular && !late && cell.depth >= limits_.least_depth) {
        singular.push_back(std::move(cell));
        continue;
      }
      lifted_.take(*cell.look);
      if (settle(cell, cell.look->box, cell.singular)) continue;
      const bool spent = ++looked_at[late ? 1 : 0] > (late ? limits_.most_cells / 2 : limits_.most_cells);
      if (cell.depth >= limits_.most_depth || spent) {
        result.undecided.push_back({cell.cell, cell.singular});
        result.gave_up = result.gave_up || (spent && !late);
        continue;
      }
      cut(cell, late && cell.singular ? singular : regular);
    }
    if (!result.gave_up) spread_singularity(result.undecided, settled_singular_);
  }

  bool is_determinant(std::size_t row) const {
    return row >= first_determinant_ && row < static_cast<std::size_t>(lifted_.functions());
  }

  /// The system's rows and those of the lifted roots.
  std::vector<std::size_t> equations() const;

  void cut(const OpenCell& open, std::deque<OpenCell>& to) const;

  /// Zeros of a square system over a part of the cell lifted last; empty where that stays open. `range`: what they have
  /// to lie in.
  std::optional<std::vector<LiftedBox>> zeros(const Square& system, const LiftedBox& range);

  bool has_none(const Square& system, const LiftedBox& box);

  /// On a side of the box itself, to rounding, counts as inside.
  std::optional<bool> lies_within(const LiftedBox& zero, const LiftedBox& range,
                                  const std::vector<std::size_t>& free) const;

  bool same(const LiftedBox& a, const LiftedBox& b) const;

  const core::LocusProblem& problem_;
  SearchLimits limits_;
  LiftedCell lifted_;
  std::vector<std::size_t> system_;
  std::size_t first_determinant_ = 0;
  SpaceCell box_;
  long cells_ = 0;
  std::vector<SpaceCell> settled_singular_;
};
}  // namespace clearloci::loci::space
