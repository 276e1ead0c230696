// Functions on the sheet of a working mode over a cell: enclosures of their values and of their slopes.
// Private to check/.
//
// A root s_j = +-sqrt(Q_j) that is far from 0 on the cell is a function of (x, y) and of earlier roots,
//     ds_j = dQ_j / (2 s_j);
// one that is not becomes a coordinate of its own ("lifted"), bound by G_j = s_j^2 - Q_j = 0, for there its slope has
// no bound. The local coordinates of a cell are (x, y, lifted roots).
#pragma once

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "check/interval.hpp"
#include "core/root_tower.hpp"

namespace clearloci::check {

/// Programs and a mode: what a Sheet is made of. All of them outlive it.
struct SheetParts {
  const std::vector<core::StraightLine>* squares = nullptr;  ///< Q_j over (x, y, s1...s_{j-1})
  std::vector<int> signs;                                    ///< of the roots
  std::vector<int> at_zero;  ///< roots that are 0 on this sheet: their Q_j = 0 is not asked for
  /// Angles of torsion springs, as roots, each with the limit beyond which it is another: they go together.
  std::vector<std::pair<int, int>> slits = {};
  std::optional<std::chrono::steady_clock::time_point> deadline = {};  ///< then core::LimitReached is thrown
};

class Sheet {
 public:
  Sheet(const SheetParts& parts, const std::vector<const core::StraightLine*>& functions, mpfr_prec_t bits = cell_bits);

  /// Moves to a cell. False: some Q_j is negative all over it. `lift`: a root to lift in any case.
  bool enter(const Interval& x, const Interval& y, int lift = -1);
  /// To a box in given local coordinates, the roots of `lifted` of either sign. False: another root may be 0.
  bool enter_local(const std::vector<Interval>& local, const std::vector<int>& lifted);

  int dimension() const { return static_cast<int>(local_.size()); }
  const std::vector<int>& lifted() const { return lifted_; }
  const Interval& local(int c) const { return local_[static_cast<std::size_t>(c)]; }
  const Interval& value(int f) const { return values_[results_[static_cast<std::size_t>(f)]]; }
  const Interval& root(int j) const { return values_[2 + static_cast<std::size_t>(j)]; }
  bool uses(int root) const { return used_[static_cast<std::size_t>(root)]; }
  /// Q_j of a root in use.
  const Interval& square(int j) const { return squares_[static_cast<std::size_t>(j)]; }
  /// Every root in use is away from 0.
  bool is_inner() const;

  /// Slopes over the cell and values at its middle; wanted by what follows.
  void differentiate();
  const Interval& slope(int f, int c) const {
    return slopes_[results_[static_cast<std::size_t>(f)]][static_cast<std::size_t>(c)];
  }
  /// Of G_l, the l-th lifted root's.
  const Interval& bond(int l, int c) const { return bonds_[static_cast<std::size_t>(l)][static_cast<std::size_t>(c)]; }
  const Interval& at_middle(int f) const { return middle_values_[results_[static_cast<std::size_t>(f)]]; }
  const Interval& bond_at_middle(int l) const { return middle_bonds_[static_cast<std::size_t>(l)]; }
  Interval middle(int c) const { return middle_of(local(c)); }
  /// f(m) + sum slope_c (X_c - m_c), met with the plain enclosure.
  Interval centred(int f) const;
  /// The minor of (slopes of f, slopes of G) without column c: where it is free of 0, every value of coordinate c is
  /// taken at most once on f = 0 in the cell.
  Interval tangent(int f, int c) const;
  /// f has no zero in the cell that was entered, by its value or its slopes, or all of the cell is beyond the limit of
  /// a slit.
  bool is_free(int f);

 private:
  struct Step {
    core::StraightLine::Operation operation;
    std::size_t first, second, result;
  };
  std::size_t append(const core::StraightLine& line);
  void run(std::size_t stage, std::vector<Interval>& values) const;
  void run_slopes(std::size_t stage);
  void set_root(std::size_t j, bool lift);
  bool is_beyond_slit() const;

  SheetParts parts_;
  mpfr_prec_t bits_;
  std::vector<Step> steps_;
  std::vector<std::size_t> stage_end_;  // of every root, then of the functions
  std::vector<std::size_t> square_results_, results_;
  std::vector<bool> used_, is_constant_;
  std::vector<bool> bounds_only_;  // limits of slits that no function depends on: nothing's slope needs them lifted
  std::vector<Interval> values_, middle_values_, squares_, local_, middle_bonds_;
  std::vector<std::vector<Interval>> slopes_, bonds_;  // by local coordinate
  std::vector<int> lifted_;
};

Interval determinant(const std::vector<std::vector<Interval>>& matrix);

}  // namespace clearloci::check
