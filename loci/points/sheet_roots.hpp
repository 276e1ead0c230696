// Zeros of a function on a working mode's sheet over one coordinate, without eliminating its roots: enclosures exclude
// cells or show the function to be monotone in them. Next to a place t0 where a root of the tower comes down to zero
// as sqrt(t - t0) the cell's coordinate is u, t = t0 +- u^2, in which function and root are smooth.
#pragma once

#include <optional>
#include <vector>

#include "core/locus_factor.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {

/// Of a simple zero, the only one of the function between the ends; or of a place that is open.
struct SheetRoot {
  core::Rational lower, upper;
};

/// An end of a stretch of the coordinate: enclosed, with the roots of the tower that are zero there.
struct StretchEnd {
  core::Rational lower, upper;
  std::vector<bool> vanishing;    ///< one a root
  bool function_is_zero = false;  ///< exactly
  bool may_own_zero = false;      ///< a zero that is not told from the end is the end's, and told there
};

/// What is known of the zeros between two ends, ascending.
struct StretchZeros {
  std::vector<SheetRoot> zeros;
  std::vector<SheetRoot> open;  ///< there may be others in these
};

class SheetRoots {
 public:
  /// The tower outlives this. Required: one coordinate. `keeps_open`: after the first place that is not decided the
  /// others are searched, too.
  SheetRoots(const core::RootTower& tower, const core::WorkingMode& mode, const core::LocusFactor& factor,
             bool keeps_open = false);

  /// Its registers are of its program.
  SheetRoots(const SheetRoots&) = delete;
  SheetRoots& operator=(const SheetRoots&) = delete;

  /// The zeros strictly between two ends, narrowed to `width`, or to `enough` where signs are not told beyond.
  /// Required: no root that the function holds is zero between them, and the mode reaches all of it, as far as these
  /// tell. Places are not decided at a zero of higher order, for example.
  StretchZeros between(const StretchEnd& from, const StretchEnd& to, const core::Rational& width,
                       const core::Rational& enough);

  /// Of the function at a number where the roots that it holds are real; 0: not told.
  int sign(const core::Rational& at) { return sign_at(at, at, {}); }

 private:
  struct StretchCell {
    double lower, upper;
    bool first, last;  ///< its ends are those of the stretch
  };
  struct Search;

  /// Squares of others are computed, since what they share with the function is, and are not asked for.
  bool is_held(int root) const { return is_held_[static_cast<std::size_t>(root)]; }
  bool excluded(const StretchCell& cell);
  /// Sign of the function's derivative all over the cell; 0: not told.
  int slope_sign(const StretchCell& cell, const Search& search);
  /// Of the function; 0: not told.
  int sign_at(const core::Rational& lower, const core::Rational& upper, const std::vector<bool>& vanishing);
  bool is_of_end(const StretchCell& cell, const Search& search, int before, int behind, double whole);
  bool narrow(SheetRoot& root, int sign_below, const core::Rational& width, const core::Rational& enough);

  core::WorkingMode mode_;
  bool keeps_open_;
  sheet::SheetProgram program_;
  std::vector<bool> is_held_;  ///< of every root: the function may hold it
  sheet::SheetProgram::Registers<sheet::Jet> jets_;
  sheet::SheetProgram::Registers<core::Interval> intervals_;
  sheet::SheetProgram::Registers<sheet::MultiInterval> exact_;
};

}  // namespace clearloci::loci
