#include "loci/plane_curve.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::loci {

PlaneCurve::PlaneCurve(const core::Polynomial& implicit) {
  // A common scale keeps huge integer coefficients within the range of doubles.
  core::Rational scale = 1;
  for (const core::Term& term : implicit.terms) scale = std::max(scale, core::Rational(abs(term.coefficient)));
  for (const core::Term& term : implicit.terms) {
    const int i = term.exponents[0], j = term.exponents[1];
    terms_.push_back({i, j, core::to_double(term.coefficient / scale)});
    degree_x_ = std::max(degree_x_, i);
    degree_y_ = std::max(degree_y_, j);
  }
}

PlaneCurve::Jet PlaneCurve::jet(const core::Point2& at) const {
  constexpr std::size_t capacity = 64;
  std::array<double, capacity> fixed_x{}, fixed_y{};
  std::vector<double> large_x, large_y;
  const auto powers = [](double base, int degree, std::array<double, capacity>& fixed, std::vector<double>& large) {
    double* table = fixed.data();
    if (static_cast<std::size_t>(degree) >= capacity) {
      large.resize(static_cast<std::size_t>(degree) + 1);
      table = large.data();
    }
    table[0] = 1;
    for (int k = 1; k <= degree; ++k) table[k] = table[k - 1] * base;
    return table;
  };
  const double* x = powers(at[0], degree_x_, fixed_x, large_x);
  const double* y = powers(at[1], degree_y_, fixed_y, large_y);
  Jet jet;
  for (const auto& [i, j, c] : terms_) {
    const double dx = i > 0 ? i * x[i - 1] : 0, dy = j > 0 ? j * y[j - 1] : 0;
    jet.f += c * x[i] * y[j];
    jet.fx += c * dx * y[j];
    jet.fy += c * x[i] * dy;
    jet.fxy += c * dx * dy;
    if (i > 1) jet.fxx += c * i * (i - 1) * x[i - 2] * y[j];
    if (j > 1) jet.fyy += c * j * (j - 1) * x[i] * y[j - 2];
  }
  return jet;
}

double PlaneCurve::Jet::slope() const { return std::hypot(fx, fy); }

double PlaneCurve::Jet::curvature() const {
  const double g = slope();
  if (g == 0) return 0;
  return std::abs(fxx * fy * fy - 2 * fxy * fx * fy + fyy * fx * fx) / (g * g * g);
}

double PlaneCurve::Jet::distance() const {
  const double g = slope();
  const double bend = std::sqrt(fxx * fxx + 2 * fxy * fxy + fyy * fyy);
  // Newton's step is trustworthy where it changes the gradient by little.
  return g > 0 && std::abs(f) * bend <= 0.1 * g * g ? std::abs(f) / g : -1;
}

}  // namespace clearloci::loci
