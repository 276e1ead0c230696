#include "loci/points/sheet_roots.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/reduced.hpp"

namespace clearloci::loci {
namespace {

using core::Interval;
using core::Rational;
using sheet::Jet;
using sheet::MultiInterval;

/// Cells of one stretch, after which what is left is open: a simple zero takes some tens.
constexpr int most_cells = 4000;
/// Relative width at which doubles no longer tell a cell's ends apart.
constexpr double least_width = 0x1p-48;

double below(const Rational& x) { return std::nextafter(core::to_double(x), -HUGE_VAL); }
double above(const Rational& x) { return std::nextafter(core::to_double(x), HUGE_VAL); }

std::vector<core::StraightLine> lines_of(const core::LocusFactor& factor) { return {factor.line}; }

/// Where a cell is cut: at no number that a designer writes, for a zero there has no sign on either side.
double cut_of(double lower, double upper) { return lower + 0.48730127 * (upper - lower); }

}  // namespace

struct SheetRoots::Search {
  const StretchEnd& from;
  const StretchEnd& to;
};

SheetRoots::SheetRoots(const core::RootTower& tower, const core::WorkingMode& mode, const core::LocusFactor& factor,
                       bool keeps_open)
    : mode_(mode),
      keeps_open_(keeps_open),
      program_(tower, {factor.sheet}, lines_of(factor)),
      jets_(program_.registers<Jet>()),
      intervals_(program_.registers<Interval>()),
      exact_(program_.registers<MultiInterval>()) {
  core::ensure(program_.coordinates() == 1, "one free coordinate");
  const std::vector<std::size_t> held = core::roots_under(factor.sheet, tower);
  for (std::size_t j = 0; j < tower.roots.size(); ++j)
    is_held_.push_back(!is_root_of_angle(tower, j) || std::find(held.begin(), held.end(), j) != held.end());
}

bool SheetRoots::excluded(const StretchCell& cell) {
  jets_.set(0, Jet(Interval(cell.lower, cell.upper), 0));
  for (int j = 0; j < program_.roots(); ++j) {
    jets_.run_square(j);
    if (!is_held(j)) continue;
    const Jet& square = jets_.square(j);
    if (!square.bounded || square.value.upper() < 0) return false;
    // A root that may be zero is a number of which its enclosure alone is known.
    const Jet root = square.value.lower() > 0 ? square_root(square) : Jet(square_root(square.value));
    jets_.set(1 + j, mode_[static_cast<std::size_t>(j)] > 0 ? root : -root);
  }
  jets_.run_values();
  return jets_.value(0).bounded && jets_.value(0).value.sign() != 0;
}

int SheetRoots::slope_sign(const StretchCell& cell, const Search& search) {
  const auto roots = static_cast<std::size_t>(program_.roots());
  const auto is_rooted = [this](const StretchEnd& end) {
    for (std::size_t j = 0; j < end.vanishing.size(); ++j)
      if (end.vanishing[j] && is_held_[j]) return true;
    return false;
  };
  const bool at_from = cell.first && is_rooted(search.from), at_to = cell.last && is_rooted(search.to);
  if (at_from && at_to) return 0;
  const bool blown_up = at_from || at_to;
  const Interval range(cell.lower, cell.upper);
  const std::vector<bool>& vanishing = at_from ? search.from.vanishing : search.to.vanishing;
  // dt/du with t = t0 + u^2 or t0 - u^2; u = t in other cells.
  const Interval reach(0.0, 2 * std::sqrt(above(Rational(cell.upper) - Rational(cell.lower))) * (1 + 0x1p-50));
  const Interval dt_du = !blown_up ? Interval(1.0) : at_from ? reach : -reach;
  intervals_.set(0, range);
  jets_.set(0, Jet(range, 0));
  struct Slope {
    Interval by_u, by_t;
    bool in_t = true;  ///< false: unbounded next to the end
  };
  std::vector<Slope> slopes(roots);
  std::vector<Interval> values(roots);
  // First the roots' values, then all partial derivatives, which the program gives together.
  for (std::size_t j = 0; j < roots; ++j) {
    const int root = static_cast<int>(j);
    jets_.run_square(root);
    intervals_.run_square(root);
    if (!is_held(root)) continue;
    if (!jets_.square(root).bounded) return 0;
    const Interval square = meet(jets_.square(root).value, intervals_.square(root));
    const bool is_zero_at_end = blown_up && vanishing[j];
    if (square.upper() < 0 || (!is_zero_at_end && square.lower() <= 0)) return 0;
    const Interval positive = square_root(square);
    values[j] = mode_[j] > 0 ? positive : -positive;
    intervals_.set(1 + root, values[j]);
    const Jet jet =
        square.lower() > 0 && jets_.square(root).value.lower() > 0 ? square_root(jets_.square(root)) : Jet(positive);
    jets_.set(1 + root, mode_[j] > 0 ? jet : -jet);
  }
  intervals_.run_values();
  intervals_.run_gradients();
  for (std::size_t j = 0; j < roots; ++j) {
    const int root = static_cast<int>(j);
    if (!is_held(root)) continue;
    Interval by_t = intervals_.square_partial(root, 0), by_u = by_t * dt_du;
    bool in_t = true;
    for (std::size_t k = 0; k < j; ++k) {
      const Interval& partial = intervals_.square_partial(root, 1 + static_cast<int>(k));
      if (partial.lower() == 0 && partial.upper() == 0) continue;
      by_u = by_u + partial * slopes[k].by_u;
      in_t = in_t && slopes[k].in_t;
      if (in_t) by_t = by_t + partial * slopes[k].by_t;
    }
    if (blown_up && vanishing[j]) {
      // s = u sqrt(q) for a mean value q of |dQ/dt|, so that ds/du = |dQ/dt| / sqrt(q).
      const Interval steep = at_from ? by_t : -by_t;
      if (!in_t || steep.lower() <= 0) return 0;
      const Interval rate = steep * inverse(square_root(steep));
      slopes[j] = {mode_[j] > 0 ? rate : -rate, Interval(0.0), false};
    } else {
      const Interval halved = inverse(Interval(2.0) * values[j]);
      slopes[j] = {by_u * halved, by_t * halved, in_t};
    }
  }
  Interval slope = intervals_.partial(0, 0) * dt_du;
  for (std::size_t j = 0; j < roots; ++j) {
    const Interval& partial = intervals_.partial(0, 1 + static_cast<int>(j));
    if (partial.lower() != 0 || partial.upper() != 0) slope = slope + partial * slopes[j].by_u;
  }
  return slope.sign();
}

int SheetRoots::sign_at(const Rational& lower, const Rational& upper, const std::vector<bool>& vanishing) {
  exact_.set(0, MultiInterval(lower, upper));
  for (int j = 0; j < program_.roots(); ++j) {
    exact_.run_square(j);
    if (!is_held(j)) continue;
    MultiInterval root(0.0);
    if (vanishing.empty() || !vanishing[static_cast<std::size_t>(j)]) {
      if (exact_.square(j).sign() <= 0) return 0;
      root = square_root(exact_.square(j));
    }
    exact_.set(1 + j, mode_[static_cast<std::size_t>(j)] > 0 ? root : -root);
  }
  exact_.run_values();
  return exact_.value(0).sign();
}

bool SheetRoots::narrow(SheetRoot& root, int sign_below, const Rational& width, const Rational& enough) {
  while (root.upper - root.lower > width) {
    const Rational span = root.upper - root.lower;
    int sign = 0;
    Rational at;
    // Where one number is the zero itself, or next to it, another one is not.
    for (const int eighths : {4, 3, 5}) {
      at = root.lower + span * core::reduced(eighths, 8);
      sign = sign_at(at, at, {});
      if (sign != 0) break;
    }
    if (sign == 0) return span <= enough;
    (sign == sign_below ? root.lower : root.upper) = at;
  }
  return true;
}

/// Whether the only zero that a monotone cell may have is at the end of the stretch, as near as doubles tell: the sign
/// of its other side, the only one of the two that is told, goes on up to there.
bool SheetRoots::is_of_end(const StretchCell& cell, const Search& search, int before, int behind, double whole) {
  const bool at_from = before == 0 && behind != 0 && cell.first && search.from.may_own_zero;
  const bool at_to = behind == 0 && before != 0 && cell.last && search.to.may_own_zero;
  if (!at_from && !at_to) return false;
  const double end = at_from ? cell.lower : cell.upper;
  for (double side = at_from ? cell.upper : cell.lower; std::abs(side - end) >= least_width * whole;) {
    side = cut_of(end, side);
    if (sign_at(Rational(side), Rational(side), {}) != (at_from ? behind : before)) return false;
  }
  return true;
}

StretchZeros SheetRoots::between(const StretchEnd& from, const StretchEnd& to, const Rational& width,
                                 const Rational& enough) {
  const Search search{from, to};
  // One end has a sign, or is a zero of the function, which the monotone cells next to it have no other of.
  const auto end_sign = [&](const StretchEnd& end) -> std::optional<int> {
    if (end.function_is_zero) return 0;
    const int sign = sign_at(end.lower, end.upper, end.vanishing);
    return sign == 0 ? std::nullopt : std::optional<int>(sign);
  };
  const auto inner_sign = [&](double at) -> std::optional<int> {
    const int sign = sign_at(Rational(at), Rational(at), {});
    return sign == 0 ? std::nullopt : std::optional<int>(sign);
  };
  StretchZeros found;
  const auto range = [&](const StretchCell& cell) {
    return SheetRoot{cell.first ? from.upper : Rational(cell.lower), cell.last ? to.lower : Rational(cell.upper)};
  };
  const auto leave_open = [&](const StretchCell& cell) {
    const SheetRoot place = range(cell);
    if (!found.open.empty() && found.open.back().upper == place.lower)
      found.open.back().upper = place.upper;
    else
      found.open.push_back(place);
  };
  const double whole = core::to_double(to.upper - from.lower);
  std::vector<StretchCell> pending = {{below(from.lower), above(to.upper), true, true}};
  for (int cells = 0; !pending.empty() && (keeps_open_ || found.open.empty()); ++cells) {
    const StretchCell cell = pending.back();
    pending.pop_back();
    if (excluded(cell)) continue;
    if (slope_sign(cell, search) != 0) {
      const std::optional<int> before = cell.first ? end_sign(from) : inner_sign(cell.lower),
                               behind = cell.last ? end_sign(to) : inner_sign(cell.upper);
      if (before && behind) {
        if (*before * *behind >= 0) continue;
        SheetRoot root = range(cell);
        if (root.lower >= root.upper || !narrow(root, *before, width, enough))
          leave_open(cell);
        else
          found.zeros.push_back(std::move(root));
        continue;
      }
      if (is_of_end(cell, search, before.value_or(0), behind.value_or(0), whole)) continue;
    }
    if (cells > most_cells || cell.upper - cell.lower < least_width * whole) {
      leave_open(cell);
      continue;
    }
    const double cut = cut_of(cell.lower, cell.upper);
    pending.push_back({cut, cell.upper, false, cell.last});
    pending.push_back({cell.lower, cut, cell.first, false});
  }
  return found;
}

}  // namespace clearloci::loci
