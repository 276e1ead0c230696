// The search behind isolated_zeros and behind the crossings of curves with cell edges: subdivision, exclusion, and
// Krawczyk's proof of existence and uniqueness.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "loci/search/touch_search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

/// Cells that touch, merged into the hulls of their clusters.
std::vector<PlaneCell> clusters(std::vector<PlaneCell> cells);

struct FoundZeros {
  std::vector<std::vector<Interval>> enclosures;  ///< of (x, y, s1...sm), one a zero, in the order found
  /// Where the two curves touch, or come so near to touching that they cross twice in what counts as one point.
  std::vector<Touch> touches;
  std::vector<PlaneCell> undecided;
  bool gave_up = false;
};

class ZeroSearch {
 public:
  /// Two functions with both coordinates free, or one function along one of them.
  ZeroSearch(const SheetProgram& program, const core::WorkingMode& mode, System system);

  struct Limits {
    double smallest;  ///< width below which a cell is left undecided
    /// More live cells than that of one size, of which the next two halvings leave nearly twice as many, mean that the
    /// functions share a curve.
    std::size_t most_cells;
    double accuracy;                  ///< width of enclosures that is worth multi-precision to get below
    std::function<bool()> stop = {};  ///< asked now and then; true: leave the rest undecided
    TouchSearch* touches = nullptr;   ///< settles places where the curves touch; none: they stay undecided
    /// Of a cell next to a touch: in wider ones none is looked for.
    double widest_at_touch = std::numeric_limits<double>::infinity();
  };

  /// All zeros in the seeds, which are thin in the coordinates that are not free.
  FoundZeros run(const std::vector<PlaneCell>& seeds, const Limits& limits);
  /// The same of many searches, each with seeds of its own: what one finds does not depend on the others, but their
  /// cells are enclosed side by side.
  std::vector<FoundZeros> run_each(const std::vector<std::vector<PlaneCell>>& seeds, const Limits& limits);

  const core::WorkingMode& mode() const { return cell_.mode(); }

 private:
  struct CertifiedZero {
    std::vector<int> lifted;
    std::vector<Interval> unique;     // local coordinates of a box that holds this zero only
    std::vector<Interval> enclosure;  // of all variables
  };

  /// A cell, and ranges of its roots (none: all that the cell allows). Next to Q_j = 0 a cell of width h has s_j up to
  /// the root of h; halving that range too keeps boxes of good proportions.
  struct Box {
    PlaneCell cell;
    std::vector<Interval> roots;
    std::size_t search = 0;
  };

  /// What one of the searches has come to.
  struct State {
    std::vector<CertifiedZero> zeros;
    std::vector<CertifiedZero> settled;  ///< boxes in which there is nothing else
    std::vector<Touch> touches;
    std::size_t touch_trials = 0;
    std::vector<PlaneCell> undecided;
    std::size_t seeds = 0, live = 0;         ///< how many there were, and cells there are now
    std::array<std::size_t, 2> before = {};  ///< cells there were two halvings ago, and one
    bool gave_up = false;
  };

  /// A box under examination.
  struct Candidate {
    const Box* searched = nullptr;
    bool excluded = false;
    std::vector<Interval> all;  ///< enclosures of all variables, where the cell may hold zeros
    std::vector<int> lifted;
    std::vector<Interval> roots;       ///< ranges that its halves inherit
    std::vector<Interval> box, image;  ///< around it, of Krawczyk's operator
    int axis = 0;                      ///< to be cut
    bool has_box = false;              ///< `box` is small enough to work on
    ZeroCount count = ZeroCount::unknown;
  };
  /// Candidates by their place among those under examination.
  using Group = std::vector<std::size_t>;

  void run_some(std::span<const std::vector<PlaneCell>> seeds, std::vector<FoundZeros>& result);
  /// Boxes [first, last): what enclosures tell of each, which does not depend on the others; then, in turn, what is to
  /// be done with it.
  void examine(const Box* first, const Box* last, std::vector<Box>& next);
  void settle(Candidate& candidate, std::vector<Box>& next);
  void exclude_by_values(Candidate& candidate, const SheetCell& cell, bool inside);
  void exclude_by_slopes(Candidate& candidate, const SheetCell& cell);
  void put_box_around(Candidate& candidate) const;
  void count_in_box(Candidate& candidate, SheetCell& cell, bool has_box);
  /// Leaves of the candidate's cell what may hold zeros by mean-value forms over its box.
  void contract(Candidate& candidate, const SheetCell& cell) const;
  /// Moves to all of each candidate's cell, or to its box, side by side where there are several, and shows its cell.
  enum class Extent { cell, box };
  template <class Show>
  void enclose(const Group& group, Extent extent, bool with_slopes, const Show& show);
  template <class Function>
  bool excludes_zero(const Function& enclosure) const;
  /// The cell is next to a place where the curves touch or nearly do, in a box that is settled from now on.
  bool settle_touch(const Box& box, const std::vector<Interval>& roots, const std::vector<int>& lifted);
  /// Leaves of candidates' cells what forms of all equations together (form_cells.hpp) do not exclude.
  void contract_by_forms(const Group& group);
  template <std::size_t N>
  void contract_by_forms(const Group& group, std::optional<FormCells<N>>& cells);
  /// Makes the candidate's cell what is left of it, but not too slender.
  static void leave(Candidate& candidate, const std::vector<Interval>& left);
  /// By second-order enclosures.
  void exclude_smoothly(const Group& group);
  int axis_to_cut(const SheetCell& cell, const PlaneCell& place) const;
  /// Makes the box hold its image. False: that is no use.
  static bool widen(Candidate& candidate);
  bool owns(const CertifiedZero& zero, const std::vector<Interval>& all) const;
  bool known(const Candidate& candidate) const;
  /// Takes the cells of searches that have too many away.
  void give_up(std::vector<Box>& live);
  static FoundZeros found(State& state);
  static void split(const Box& box, int axis, std::vector<Box>& next);
  double width(const PlaneCell& cell) const;
  /// Narrows the enclosures of the zeros that candidates have, side by side.
  void narrow_all(const Group& group);
  bool accept(const Candidate& candidate);

  const SheetProgram* program_;
  System system_;
  SheetCell cell_;
  std::optional<SheetCells> side_by_side_;  // once there are several candidates
  bool is_smooth_worthwhile_;
  std::optional<SmoothCell> smooth_;                // once it is asked for
  std::optional<SmoothCells> smooth_side_by_side_;  // likewise
  std::optional<FormCells<2>> forms_;               // likewise, as the next two
  std::optional<FormCells<3>> forms_at_rims_;
  std::optional<FormCells<4>> forms_at_corners_;
  Limits limits_{};
  std::vector<State> states_;          // of the searches
  std::vector<Candidate> candidates_;  // under examination
};

}  // namespace clearloci::loci::sheet
