#include "numeric/timed_motion.hpp"

#include "core/errors.hpp"

namespace clearloci::numeric {

namespace {

/// Second derivatives at the knots of the natural spline: with steps h_i and slopes d_i,
///     h_{i-1} m_{i-1} + 2 (h_{i-1} + h_i) m_i + h_i m_{i+1} = 6 (d_i - d_{i-1}),   m_0 = m_n = 0
std::vector<double> bendings_of(const std::vector<double>& knots, const std::vector<double>& values) {
  const std::size_t n = knots.size();
  std::vector<double> diagonal(n, 1), right(n, 0), upper(n, 0), m(n, 0);
  const auto step = [&](std::size_t i) { return knots[i + 1] - knots[i]; };
  const auto slope = [&](std::size_t i) { return (values[i + 1] - values[i]) / step(i); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double below = i == 1 ? 0 : step(i - 1) / diagonal[i - 1];
    diagonal[i] = 2 * (step(i - 1) + step(i)) - below * upper[i - 1];
    right[i] = 6 * (slope(i) - slope(i - 1)) - below * right[i - 1];
    upper[i] = step(i);
  }
  for (std::size_t i = n - 1; i-- > 1;) m[i] = (right[i] - upper[i] * m[i + 1]) / diagonal[i];
  return m;
}

/// The time as a series in the part of the duration.
Series time_at(const CompiledTimed& timed, double tau) {
  Series t(timed.start + tau * timed.duration);
  t.c[1] = timed.duration;
  return t;
}

}  // namespace

CompiledTimed compile(const mechanism::TimedMotion& timed, const mechanism::Mechanism& mechanism, double period) {
  CompiledTimed compiled;
  compiled.duration = period;
  for (const core::Expression& expression : timed.coordinates) {
    TapeBuilder tape;
    compiled.results.push_back(tape.compile(expression, [&](const std::string& name) {
      if (name == "t") return tape.input(0);
      for (const mechanism::Parameter& parameter : mechanism.parameters)
        if (parameter.name == name) return tape.compile(core::Expression::number(parameter.value), {});
      core::ensure(false, "an expression of time uses no unknown name");
      return Register{};
    }));
    compiled.tapes.push_back(tape.tape());
  }
  if (timed.times.empty()) return compiled;
  for (const core::Rational& time : timed.times) compiled.knots.push_back(core::to_double(time));
  compiled.start = compiled.knots.front();
  for (std::size_t c = 0; c < timed.rows.front().size(); ++c) {
    CompiledSpline& spline = compiled.splines.emplace_back();
    for (const std::vector<core::Rational>& row : timed.rows) spline.values.push_back(core::to_double(row[c]));
    spline.bendings = bendings_of(compiled.knots, spline.values);
  }
  return compiled;
}

std::vector<Series> place_at(const CompiledTimed& timed, std::size_t piece, double tau) {
  const Series t = time_at(timed, tau);
  std::vector<Series> place;
  for (std::size_t c = 0; c < timed.tapes.size(); ++c) {
    const auto size = static_cast<int>(timed.tapes[c].code.size());
    std::vector<Series> registers(static_cast<std::size_t>(size));
    run<Series, 1>(timed.tapes[c], 0, size, &t, registers.data());
    place.push_back(registers[static_cast<std::size_t>(timed.results[c])]);
  }
  for (const CompiledSpline& spline : timed.splines) {
    const double from = timed.knots[piece], h = timed.knots[piece + 1] - from;
    const double a = spline.bendings[piece], b = spline.bendings[piece + 1];
    const double slope = (spline.values[piece + 1] - spline.values[piece]) / h - h * (2 * a + b) / 6;
    const Series u = t - Series(from);
    place.push_back(Series(spline.values[piece]) + u * (Series(slope) + u * (Series(a / 2) + ((b - a) / (6 * h)) * u)));
  }
  return place;
}

}  // namespace clearloci::numeric
