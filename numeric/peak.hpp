// Where a function of time is greatest. Private to numeric/.
#pragma once

#include <functional>

namespace clearloci::numeric {

/// Part of the period to which an instant is located: 1e-12 s for a period of a second, well within the promised 1e-9.
constexpr double located = 1e-12;

/// The point of [a, b] where a function with one peak is greatest: thirds, until they are one.
inline double peak(const std::function<double(double)>& g, double a, double b) {
  while (b - a > located) {
    const double p = a + (b - a) / 3, q = b - (b - a) / 3;
    const bool rises = g(p) < g(q);
    (rises ? a : b) = rises ? p : q;
  }
  return (a + b) / 2;
}

}  // namespace clearloci::numeric
