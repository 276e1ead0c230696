// The arithmetic of a tower of square roots, over polynomials with rational coefficients (ring.hpp) or modulo a prime
// (residue_poly.hpp). A root has a `variable`, a `square` and says whether it `is_angle()`, whose square is none.
// Private to symbolic/.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/errors.hpp"

namespace clearloci::symbolic {

/// N = a + b s for a reduced N.
template <class P>
std::pair<P, P> split(const P& p, int variable) {
  std::vector<P> parts = p.coefficients(variable);
  core::ensure(parts.size() <= 2, "a polynomial reduced in its roots");
  if (parts.size() == 1) parts.emplace_back(p.ring());
  return {std::move(parts[0]), std::move(parts[1])};
}

/// The parts of p without and with an odd power of a root, each with its square put in: p = even + odd s.
template <class P>
std::pair<P, P> even_and_odd(const P& p, int variable, const P& square) {
  const std::vector<P> powers = p.coefficients(variable);
  P even(p.ring()), odd(p.ring()), square_power(p.ring(), 1);
  for (std::size_t k = 0; k < powers.size(); ++k) {
    P& part = k % 2 == 0 ? even : odd;
    if (k < 2) {
      part = powers[k];
      continue;
    }
    if (k % 2 == 0) square_power *= square;
    part += powers[k] * square_power;
  }
  return {std::move(even), std::move(odd)};
}

/// With no root to more than its first power. From the last root down: a square may hold earlier roots only.
template <class P, class Roots>
P reduced_in(P p, const Roots& roots) {
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
    if (root->is_angle() || p.degree(root->variable) < 2) continue;
    auto [even, odd] = even_and_odd(p, root->variable, root->square);
    p = std::move(even) + odd * P::variable(p.ring(), root->variable);
  }
  return p;
}

/// A place put in for up to three coordinates, times its denominator to the power `degree`; reduced. `pair` has the
/// variables x, y, z, of which y and z may be -1, and the `place` (x, y, z) / w.
template <class P, class Pair, class Roots>
P with_place(const P& natural, const Pair& pair, int degree, const Roots& roots) {
  const auto powers = [&](const P& base) {
    std::vector<P> list(1, P(natural.ring(), 1));
    for (int i = 0; i < degree; ++i) list.push_back(i == 0 ? base : reduced_in(list.back() * base, roots));
    return list;
  };
  const auto product = [&](const P& a, const P& b) { return reduced_in(a * b, roots); };
  const auto coefficients = [](const P& p, int variable) {
    return variable < 0 ? std::vector<P>(1, p) : p.coefficients(variable);
  };
  const std::vector<P> xs = powers(pair.place.x), ys = powers(pair.place.y), zs = powers(pair.place.z),
                       ws = powers(pair.place.w);
  // A term of degree i in x, j in y and k in z takes X^i Y^j Z^k W^(degree - i - j - k): multiplied out and reduced
  // before it meets the term's long coefficient.
  P sum(natural.ring());
  const std::vector<P> by_x = coefficients(natural, pair.x);
  for (std::size_t i = 0; i < by_x.size(); ++i) {
    if (by_x[i].is_zero()) continue;
    const std::vector<P> by_y = coefficients(by_x[i], pair.y);
    for (std::size_t j = 0; j < by_y.size(); ++j) {
      if (by_y[j].is_zero()) continue;
      const std::vector<P> by_z = coefficients(by_y[j], pair.z);
      for (std::size_t k = 0; k < by_z.size(); ++k) {
        if (by_z[k].is_zero()) continue;
        const P& w = ws[static_cast<std::size_t>(degree) - i - j - k];
        sum += by_z[k] * product(product(xs[i], ys[j]), product(zs[k], w));
      }
    }
  }
  return reduced_in(std::move(sum), roots);
}

/// p / divisor in the field of the tower; nothing where it is no polynomial over the tower.
///     (a + b s)(q + r s) = c + d s:  r = (a d - b c) / (a^2 - b^2 s^2),  q = (d - a r) / b
template <class P, class Roots>
std::optional<P> quotient_in(const P& p, const P& divisor, const Roots& roots) {
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
    if (!divisor.depends_on(root->variable)) continue;
    const auto [a, b] = split(divisor, root->variable);
    const auto [c, d] = split(p, root->variable);
    const P norm = reduced_in(a * a - b * b * root->square, roots);
    const std::optional<P> r = quotient_in(reduced_in(a * d - b * c, roots), norm, roots);
    if (!r) return std::nullopt;
    const std::optional<P> q = quotient_in(reduced_in(d - a * *r, roots), b, roots);
    if (!q) return std::nullopt;
    return *q + *r * P::variable(p.ring(), root->variable);
  }
  P result(p.ring());
  if (divisor.is_zero() || !p.divides(divisor, result)) return std::nullopt;
  return result;
}

}  // namespace clearloci::symbolic
