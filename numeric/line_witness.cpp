#include "numeric/line_witness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clearloci::numeric {

std::array<Bounded, 3> components(const BoundedNumerators& numerators, const WitnessColumns& columns) {
  const auto value = [&](int column) {
    return column < 0 ? Bounded(0.0) : numerators.values[static_cast<std::size_t>(column)];
  };
  if (columns.lever != 0) return {value(columns.first) + Bounded(columns.lever) * value(columns.second), 0.0, 0.0};
  const std::array<Bounded, 3> all = {value(columns.first), value(columns.second), value(columns.third)};
  // Out of reach there are no axes.
  const auto pin = static_cast<std::size_t>(columns.pin);
  return columns.pin < 0 || pin >= numerators.axes.size() ? all : across(numerators.axes[pin], all);
}

bool is_decided(const BoundedNumerators& numerators, const WitnessColumns& columns) {
  for (const Bounded& n : components(numerators, columns))
    if (std::abs(n.value) > n.error) return true;
  return false;
}

const BoundedNumerators& LineWitness::at(double position) {
  const auto found = known_.find(position);
  if (found != known_.end()) return found->second;
  return known_.emplace(position, bounded_numerators(model_, point(position), mode_)).first->second;
}

bool LineWitness::reachable_around(double position, double radius) {
  if (reachable(position)) return true;
  for (std::size_t across = 0; across < std::max<std::size_t>(2, base_.size()); ++across) {
    if (across == along_) continue;
    for (int k = 0; k < 8; ++k) {
      const double angle = k * std::numbers::pi / 4;
      std::vector<double> p = point(position + radius * std::cos(angle));
      if (across < p.size()) p[across] += radius * std::sin(angle);
      if (numeric::reachable(model_, p, mode_)) return true;
    }
  }
  return false;
}

bool LineWitness::reachable_between(double a, double b, int samples) {
  for (int k = 1; k <= samples; ++k) {
    if (!numeric::reachable(model_, point(a + (b - a) * k / (samples + 1)), mode_)) return false;
  }
  return true;
}

bool LineWitness::decided(const WitnessColumns& columns, double position) {
  const BoundedNumerators& n = at(position);
  return n.reachable && is_decided(n, columns);
}

ForceNumerators LineWitness::force(const WitnessColumns& columns, double position) {
  const std::array<Bounded, 3> n = components(at(position), columns);
  return {n[0].value, n[1].value, n[2].value};
}

Parity LineWitness::sign_changes(const WitnessColumns& columns, double a, double b) {
  if (columns.single()) return (force(columns, a)[0] > 0) == (force(columns, b)[0] > 0) ? Parity::even : Parity::odd;
  constexpr int pieces = 16;  // a turn that cancels a flip over the whole stretch does not do so over each piece
  int odd = 0;
  double from = a;
  for (int k = 1; k <= pieces; ++k) {
    const double to = k == pieces ? b : a + (b - a) * k / pieces;
    if (!decided(columns, to)) return Parity::unknown;
    const Parity piece = flips(columns, from, to);
    if (piece == Parity::unknown) return piece;
    odd += piece == Parity::odd;
    from = to;
  }
  return odd % 2 == 0 ? Parity::even : Parity::odd;
}

bool LineWitness::cancels(const WitnessColumns& columns, double a, double b) {
  if (!columns.single()) return false;
  constexpr int pieces = 16;  // factors of |A| may vanish side by side
  bool odd = false;
  double from = a;
  int before = determinant_sign(a);
  for (int k = 1; k <= pieces; ++k) {
    const double to = k == pieces ? b : a + (b - a) * k / pieces;
    const int here = determinant_sign(to);
    if (here == 0) continue;  // the next piece begins before it
    // Two zeros of |A| within one piece leave its sign; the numerator changes its own at one of them.
    if (before * here < 0 ? cancels_between(columns, from, to) : cancels_at_flip(columns, from, to)) odd = !odd;
    before = here;
    from = to;
  }
  return odd || cancels_at_flip(columns, a, b);
}

bool LineWitness::cancels_at_flip(const WitnessColumns& columns, double a, double b) {
  const auto sign = [&](double position) { return force(columns, position)[0] > 0; };
  const bool first = sign(a);
  if (sign(b) == first) return false;
  const double least = a, most = b;
  while (b - a > smallest_ / 1024) {
    const double middle = (a + b) / 2;
    if (!decided(columns, middle)) break;
    (sign(middle) == first ? a : b) = middle;
  }
  // |A| is of as little certainty there: out to where both its signs are known, but not as far as its next zero.
  const double place = (a + b) / 2;
  for (double radius = b - a; radius <= 64 * smallest_; radius *= 2) {
    const int before = determinant_sign(std::max(least, place - radius)),
              after = determinant_sign(std::min(most, place + radius));
    if (before != 0 && after != 0) return before != after;
  }
  return false;
}

bool LineWitness::touches_zero(const WitnessColumns& columns, double position, double reach) {
  if (!columns.single() || !reachable(position)) return false;
  constexpr double part = 0.25;  // where the zero is as far off as may be, 1/49 of the value 8 times as far away
  const double value = std::abs(force(columns, position)[0]);
  for (double radius = 8 * reach; radius <= 128 * reach; radius *= 2) {
    const double before = position - radius, after = position + radius;
    if (!decided(columns, before) || !decided(columns, after)) continue;
    const double n = force(columns, before)[0], m = force(columns, after)[0];
    if ((n > 0) != (m > 0)) return false;
    if (value < part * std::min(std::abs(n), std::abs(m))) return true;
  }
  return false;
}

int LineWitness::determinant_sign(double position) {
  const Bounded& d = at(position).determinant;
  return std::abs(d.value) <= d.error ? 0 : d.value > 0 ? 1 : -1;
}

bool LineWitness::cancels_between(const WitnessColumns& columns, double a, double b) {
  const int first = determinant_sign(a);
  const double least = a, most = b;
  constexpr int halvings = 60;  // more than a double has digits
  for (int k = 0; k < halvings; ++k) {
    const double middle = (a + b) / 2;
    if (middle == a || middle == b || !reachable(middle)) break;
    const int here = determinant_sign(middle);
    if (here == 0) {
      a = b = middle;
      break;
    }
    (here == first ? a : b) = middle;
  }
  // Both rounding errors hide where exactly: out from there to where the numerator is decided on both sides.
  const double place = (a + b) / 2;
  for (double radius = std::max(b - a, smallest_ / 1024); radius <= 1024 * smallest_; radius *= 2) {
    const double before = std::max(least, place - radius), after = std::min(most, place + radius);
    if (determinant_sign(before) * determinant_sign(after) >= 0) continue;
    if (!decided(columns, before) || !decided(columns, after)) continue;
    const double n = force(columns, before)[0], m = force(columns, after)[0];
    // An even zero is hidden by rounding, or is told by how small the numerator is there beside its neighbours.
    constexpr double part = 0.25;
    return (n > 0) != (m > 0) || !decided(columns, place) ||
           std::abs(force(columns, place)[0]) < part * std::min(std::abs(n), std::abs(m));
  }
  return !decided(columns, place);
}

/// A direction that merely turns does so by little between near enough positions; one that flips does not, however near
/// they are.
Parity LineWitness::flips(const WitnessColumns& columns, double a, double b) {
  const ForceNumerators n_a = force(columns, a), n_b = force(columns, b);
  if (turn_cosine(n_a, n_b) > least_cosine) return Parity::even;
  if (std::abs(b - a) < smallest_) return turn_cosine(n_a, n_b) > 0 ? Parity::even : Parity::odd;
  const double middle = a + (std::numbers::sqrt2 - 1) * (b - a);  // off centre, where symmetric designs flip
  if (!decided(columns, middle)) return Parity::unknown;
  const Parity left = flips(columns, a, middle), right = flips(columns, middle, b);
  if (left == Parity::unknown || right == Parity::unknown) return Parity::unknown;
  return left == right ? Parity::even : Parity::odd;
}

double turn_cosine(const ForceNumerators& p, const ForceNumerators& q) {
  return (p[0] * q[0] + p[1] * q[1] + p[2] * q[2]) / (std::hypot(p[0], p[1], p[2]) * std::hypot(q[0], q[1], q[2]));
}

}  // namespace clearloci::numeric
