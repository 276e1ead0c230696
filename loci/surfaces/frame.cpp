#include "loci/surfaces/frame.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::loci::surface {

using core::LocusProblem;

namespace {

/// Two ends of charts are one seam: they are the same angle but for rounding.
constexpr double same_angle = 1e-9;

}  // namespace

const std::optional<core::AngleChart>* chart_of(const LocusProblem& problem, std::size_t i) {
  return problem.charts.empty() || !problem.charts[i] ? nullptr : &problem.charts[i];
}

double coordinate_at(const LocusProblem& problem, std::size_t i, const core::Rational& variable) {
  const double value = core::to_double(variable);
  const auto* chart = chart_of(problem, i);
  return chart == nullptr ? value : core::angle_at(**chart, value);
}

double variable_at(const LocusProblem& problem, std::size_t i, double coordinate, double& slope) {
  slope = 1;
  const auto* chart = chart_of(problem, i);
  if (chart == nullptr) return coordinate;
  const double t = core::parameter_at(**chart, coordinate);
  slope = (1 + t * t) / 2;
  return t;
}

Point Frame::place(const Point& unit) const {
  Point result{};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = unit[i] == 0 ? lower[i] : unit[i] == 1 ? upper[i] : lower[i] + unit[i] * width(i);
  return result;
}

Frame frame_of(const std::vector<const LocusProblem*>& charts) {
  Frame frame;
  for (std::size_t i = 0; i < 3; ++i) {
    frame.angle[i] = chart_of(*charts.front(), i) != nullptr;
    frame.lower[i] = coordinate_at(*charts.front(), i, charts.front()->lower[i]);
    frame.upper[i] = coordinate_at(*charts.front(), i, charts.front()->upper[i]);
    for (const LocusProblem* chart : charts) {
      frame.lower[i] = std::min(frame.lower[i], coordinate_at(*chart, i, chart->lower[i]));
      frame.upper[i] = std::max(frame.upper[i], coordinate_at(*chart, i, chart->upper[i]));
    }
  }
  return frame;
}

bool are_neighbours(const LocusProblem& a, const LocusProblem& b) {
  int seams = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (chart_of(a, i) == nullptr) continue;
    const double from_a = coordinate_at(a, i, a.lower[i]), to_a = coordinate_at(a, i, a.upper[i]);
    const double from_b = coordinate_at(b, i, b.lower[i]), to_b = coordinate_at(b, i, b.upper[i]);
    if (std::abs(from_a - from_b) < same_angle) continue;
    if (std::abs(to_a - from_b) > same_angle && std::abs(to_b - from_a) > same_angle) return false;
    ++seams;
  }
  return seams == 1;
}

}  // namespace clearloci::loci::surface
