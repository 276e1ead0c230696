// 5R manipulators drawn by RapidCheck, half of them on the lattice: lengths and bases multiples of 1/4, legs often
// alike, loads along an axis. Engineers write such numbers.
#pragma once

#include <rapidcheck.h>

#include <cmath>

#include "tests/numeric/designs.hpp"

namespace clearloci::test {

/// Over the whole range from the first try on: RapidCheck's own ranges grow with the size of the test.
inline double between(double low, double high) {
  return low + (high - low) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 100000)) / 100000;
}

/// A multiple of 1/4.
inline double quarter_between(double low, double high) {
  return *rc::gen::inRange(static_cast<int>(std::ceil(4 * low)), static_cast<int>(std::floor(4 * high)) + 1) / 4.0;
}

inline FiveBar random_five_bar() {
  const bool on_lattice = *rc::gen::arbitrary<bool>();
  const auto number = [&](double low, double high) {
    return on_lattice ? quarter_between(low, high) : between(low, high);
  };
  FiveBar d;
  d.base_x = number(0.2, 1.0), d.base_y = number(-0.5, 0.5);
  d.a1 = number(0.3, 1), d.b1 = number(0.3, 1), d.a2 = number(0.3, 1), d.b2 = number(0.3, 1);
  if (on_lattice && *rc::gen::arbitrary<bool>()) d.b1 = d.a1;
  if (on_lattice && *rc::gen::arbitrary<bool>()) d.a2 = d.a1, d.b2 = d.b1;
  d.side1 = *rc::gen::arbitrary<bool>() ? Side::left : Side::right;
  d.side2 = *rc::gen::arbitrary<bool>() ? Side::left : Side::right;
  d.fx = between(-50, 50), d.fy = between(-50, 50), d.couple = *rc::gen::element(0.0, 3.0);
  if (on_lattice && *rc::gen::arbitrary<bool>()) (*rc::gen::arbitrary<bool>() ? d.fx : d.fy) = 0;
  d.weighs = *rc::gen::arbitrary<bool>();
  return d;
}

}  // namespace clearloci::test
