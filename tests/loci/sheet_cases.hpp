// Curves and sheets with known answers for the tests of loci/sheet.
#pragma once

#include <string>
#include <vector>

#include "core/polynomial.hpp"
#include "core/root_tower.hpp"

namespace clearloci::loci::sheet::testing {

using core::Polynomial;
using core::Rational;
using core::RootTower;

/// Polynomials in (x, y) or (x, y, s1, s2) written with operators.
struct Ring {
  int variables = 2;
  Polynomial operator()(const Rational& value) const { return core::constant_polynomial(variables, value); }
  Polynomial x() const { return core::variable_polynomial(variables, 0); }
  Polynomial y() const { return core::variable_polynomial(variables, 1); }
  Polynomial s(int j) const { return core::variable_polynomial(variables, 1 + j); }
};

/// The plane, with nothing above it.
inline RootTower plane() {
  RootTower tower;
  tower.coordinates = {"x", "y"};
  return tower;
}

/// One root over the plane: s1^2 = square, given in (x, y, s1).
inline RootTower one_root(const Polynomial& square) {
  RootTower tower = plane();
  tower.roots.push_back({"s1", "B1", core::RootRole::working_mode, square});
  return tower;
}

/// Multilinear in the roots: every sj^2 replaced by Qj.
inline Polynomial reduced(Polynomial p, const RootTower& tower) {
  for (int j = static_cast<int>(tower.roots.size()) - 1; j >= 0; --j) {
    const int v = 2 + j;
    while (core::degree_in(p, v) >= 2) {
      Polynomial low{p.variables, {}}, high{p.variables, {}};
      for (core::Term term : p.terms) {
        if (term.exponents[v] >= 2) {
          term.exponents[v] -= 2;
          high = high + Polynomial{p.variables, {term}};
        } else {
          low = low + Polynomial{p.variables, {term}};
        }
      }
      p = low + high * tower.roots[j].square;
    }
  }
  return p;
}

/// A planar 5R: bases (0, 0) and (d, 0), |A1B1| = a1, |B1P| = b1, |A2B2| = a2, |B2P| = b2; every link weighs `weight` N
/// at its middle; force (fx, fy) at P on PB2. Numerators are written out from statics by hand, with the denominators
/// D1, D2 cleared.
struct FiveBar {
  Rational d = Rational(1, 2), a1 = Rational(1, 2), b1 = Rational(1, 2), a2 = Rational(1, 2), b2 = Rational(1, 2);
  Rational weight = 0, fx = 0, fy = -100;
};

struct FiveBarSheet {
  RootTower tower;
  Polynomial determinant, moment_A1, moment_A2;
  Polynomial force_A1[2], force_B1[2], force_P[2], force_B2[2], force_A2[2];
};

inline FiveBarSheet five_bar_sheet(const FiveBar& design) {
  using Vector = std::vector<Polynomial>;
  const Ring r{4};
  const auto cross = [](const Vector& a, const Vector& b) { return a[0] * b[1] - a[1] * b[0]; };
  const auto plus = [](const Vector& a, const Vector& b) { return Vector{a[0] + b[0], a[1] + b[1]}; };
  const auto minus = [](const Vector& a, const Vector& b) { return Vector{a[0] - b[0], a[1] - b[1]}; };
  const auto times = [](const Polynomial& c, const Vector& a) { return Vector{c * a[0], c * a[1]}; };

  FiveBarSheet sheet;
  sheet.tower = plane();
  struct Leg {
    Vector p, b, u;  // P - A, 2D (B - A), 2D (P - B)
    Polynomial D;
  };
  const auto leg = [&](int j, const Rational& base, const Rational& a, const Rational& b) {
    Leg l;
    l.p = {r.x() - r(base), r.y()};
    l.D = l.p[0] * l.p[0] + l.p[1] * l.p[1];
    const Polynomial k = r(a * a - b * b) + l.D;
    sheet.tower.roots.push_back({std::string("s").append(std::to_string(j)), std::string("B").append(std::to_string(j)),
                                 core::RootRole::working_mode, r(4 * a * a) * l.D - k * k});
    sheet.tower.denominators.push_back(l.D);
    l.b = plus(times(k, l.p), times(r.s(j), {r(-1) * l.p[1], l.p[0]}));
    l.u = minus(times(r(2) * l.D, l.p), l.b);
    return l;
  };
  const Leg one = leg(1, 0, design.a1, design.b1), two = leg(2, design.d, design.a2, design.b2);
  const Vector W = {r(0), r(-design.weight)}, F = {r(design.fx), r(design.fy)};
  const Vector half = times(r(Rational(1, 2)), W);
  // u x f = alpha, v x f = beta for the force f that PB2 exerts on B1P at P: f = (alpha v - beta u) / (u x v).
  const Polynomial alpha = r(-1) * cross(one.u, half), beta = cross(two.u, plus(F, half));
  const Vector f = minus(times(alpha, two.u), times(beta, one.u));
  const Polynomial det = cross(one.u, two.u);
  const auto store = [&](Polynomial(&out)[2], const Vector& v) {
    for (int c = 0; c < 2; ++c) out[c] = reduced(v[c], sheet.tower);
  };
  const Vector weight = times(det, W);
  const Vector f_B1 = minus(times(r(-1), f), weight), f_A1 = minus(f_B1, weight);
  const Vector f_B2 = minus(minus(f, times(det, F)), weight), f_A2 = minus(f_B2, weight);
  store(sheet.force_P, f);
  store(sheet.force_B1, f_B1);
  store(sheet.force_A1, f_A1);
  store(sheet.force_B2, f_B2);
  store(sheet.force_A2, f_A2);
  sheet.determinant = reduced(det, sheet.tower);
  const auto moment = [&](const Leg& l, const Vector& force) {
    const Polynomial polynomial = cross(l.b, W) + l.D * cross(l.p, W);
    return reduced(r(2) * l.D * cross(l.p, force) + det * polynomial, sheet.tower);
  };
  sheet.moment_A1 = moment(one, f);
  sheet.moment_A2 = moment(two, minus(times(det, F), f));
  return sheet;
}

}  // namespace clearloci::loci::sheet::testing
