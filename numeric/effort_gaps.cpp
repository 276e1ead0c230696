#include "numeric/effort_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/rational.hpp"
#include "numeric/task_witness.hpp"
#include "numeric/witness_rounding.hpp"

namespace clearloci::numeric {
namespace {

struct Ends {
  double from = 0, to = 0;
  double rounding = 0;
};
constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr Ends every = {-unbounded, unbounded, 0};

Ends around(const Bounded& a, const Bounded& b) {
  return {std::min(a.value - a.error, b.value - b.error), std::max(a.value + a.error, b.value + b.error),
          2 * std::max(a.error, b.error)};
}

/// Where |a + e b| is at most `least`.
std::optional<Ends> gap_of(const Bounded& a, const Bounded& b, const Bounded& least) {
  if (!is_zero(b)) return around((least - a) / b, (-least - a) / b);
  if (std::abs(a.value) - a.error > least.value + least.error) return std::nullopt;
  return every;
}

/// Where a + e b, which has to be positive, is not.
std::optional<Ends> gap_below(const Bounded& a, const Bounded& b) {
  if (is_zero(b)) return a.value - a.error > 0 ? std::nullopt : std::optional(every);
  const Bounded zero = -a / b;
  return b.value > 0 ? Ends{-unbounded, zero.value + zero.error, 2 * zero.error}
                     : Ends{zero.value - zero.error, unbounded, 2 * zero.error};
}

/// The same of vectors a and b: where the line passes through the ball.
std::optional<Ends> gap_of(const std::vector<Bounded>& a, const std::vector<Bounded>& b, const Bounded& least) {
  if (a.size() == 1) return gap_of(a[0], b[0], least);
  Bounded aa, ab, bb;
  for (std::size_t k = 0; k < a.size(); ++k) {
    aa = aa + a[k] * a[k];
    ab = ab + a[k] * b[k];
    bb = bb + b[k] * b[k];
  }
  if (std::all_of(b.begin(), b.end(), is_zero)) {
    if (aa.value - aa.error > least.value * least.value) return std::nullopt;
    return every;
  }
  const Bounded nearest = -ab / bb;
  Bounded off;
  bool passes = true;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Bounded part = a[k] + nearest * b[k];
    passes = passes && is_zero(part);
    off = off + part * part;
  }
  if (least.value == 0) return passes ? std::optional(around(nearest, nearest)) : std::nullopt;
  const Bounded left = least * least - off;
  if (left.value + left.error < 0) return std::nullopt;
  // Where the ball is just touched, as far as it may be entered.
  const Bounded half = sqrt(Bounded(std::max(left.value, 0.0), left.error)) / sqrt(bb);
  return around(nearest - half, nearest + half);
}

}  // namespace

std::vector<EffortGap> effort_gaps(const NumericModel& none, const NumericModel& one, std::span<const Bounded> at,
                                   std::span<const int> mode, const std::vector<core::TaskDemand>& demands) {
  const BoundedNumerators without = bounded_numerators(none, at, mode), with = bounded_numerators(one, at, mode);
  const bool positive = without.determinant.value > 0;
  std::vector<EffortGap> gaps;
  if (!without.reachable || is_zero(without.determinant)) return gaps;
  const Bounded size(std::abs(without.determinant.value), without.determinant.error);
  for (const core::TaskDemand& demand : demands) {
    const std::vector<Bounded> a = demanded_parts(none, demand, without);
    std::vector<Bounded> b = demanded_parts(one, demand, with);
    for (std::size_t k = 0; k < b.size(); ++k) b[k] = b[k] - a[k];
    const double least = core::to_double(demand.least);
    const auto signed_by_determinant = [&](const Bounded& part) { return positive ? part : -part; };
    if (const auto ends = demand.bound ? gap_below(signed_by_determinant(a[0]), signed_by_determinant(b[0]))
                                       : gap_of(a, b, size * Bounded(least, unit_roundoff * least)))
      gaps.push_back({ends->from, ends->to, demand, ends->rounding,
                      b.size() != 1 || is_zero(b[0]) ? 0
                      : (b[0].value > 0) == positive ? 1
                                                     : -1});
  }
  return gaps;
}

}  // namespace clearloci::numeric
