// How large reactions are over a cell of poses and designs, and how far the end effector is displaced
// (task_cell.hpp).
#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "loci/tasks/task_cell.hpp"
#include "loci/tasks/task_functions.hpp"

namespace clearloci::loci {
namespace {

using core::Interval;
using core::TaskCondition;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

/// By the method of Frank and Wolfe: towards the load that takes most off the reaction, as far as that helps.
TaskCell::WorstLoad TaskCell::worst_load(const TaskCondition& condition) const {
  const auto values = [&](const std::vector<int>& functions) {
    std::vector<double> list;
    for (const int f : functions) list.push_back(middle_value(f));
    return list;
  };
  const std::vector<double> first = values(condition.parts.front()), last = values(condition.parts.back());
  std::vector<std::vector<double>> directions;
  for (const std::vector<int>& direction : condition.directions) directions.push_back(values(direction));
  WorstLoad worst;
  worst.t = nearest_part(first, last);
  worst.factors.assign(directions.size(), 0.0);
  for (std::size_t i = 0; i < first.size(); ++i) worst.reaction.push_back(first[i] + worst.t * (last[i] - first[i]));
  constexpr int rounds = 40;
  for (int round = 0; round < rounds && !extent_.balls.empty(); ++round) {
    const std::vector<double>& w = worst.reaction;
    WorstLoad to;
    to.t = dot(w, first) <= dot(w, last) ? 0.0 : 1.0;
    to.factors.assign(directions.size(), 0.0);
    for (const core::LoadBall& ball : extent_.balls) {
      double size = 0;
      for (std::size_t d = ball.first; d < ball.first + ball.count; ++d) {
        to.factors[d] = dot(w, directions[d]);
        size = std::hypot(size, to.factors[d]);
      }
      for (std::size_t d = ball.first; d < ball.first + ball.count && size > 0; ++d)
        to.factors[d] *= -ball.radius / size;
    }
    to.reaction = to.t > 0 ? last : first;
    for (std::size_t d = 0; d < directions.size(); ++d)
      for (std::size_t i = 0; i < w.size(); ++i) to.reaction[i] += to.factors[d] * directions[d][i];
    const double part = nearest_part(w, to.reaction);
    if (part < 1e-12) break;
    const auto move = [&](double& value, double there) { value += part * (there - value); };
    move(worst.t, to.t);
    for (std::size_t d = 0; d < directions.size(); ++d) move(worst.factors[d], to.factors[d]);
    for (std::size_t i = 0; i < w.size(); ++i) move(worst.reaction[i], to.reaction[i]);
  }
  return worst;
}

/// Not less than n.w / |n| for any n; not more than under any one load.
Interval TaskCell::least_size_of(const TaskCondition& condition, const Interval& share) {
  const WorstLoad worst = worst_load(condition);
  const std::vector<double>& n = worst.reaction;
  Interval length = 0;
  for (const double component : n) length = length + squared(Interval(component));
  double lower = 0;
  if (length.lower() > 0) {
    const Interval taken = reach_of_balls(condition, n, true);
    lower = std::numeric_limits<double>::infinity();
    for (const std::vector<int>& parts : condition.parts) {
      Sum sum;
      for (std::size_t i = 0; i < parts.size(); ++i) sum.emplace_back(Interval(n[i]), parts[i]);
      lower = std::min(lower, ((combined(sum, true) - taken) * inverse(square_root(length)) * share).lower());
    }
  }
  std::vector<Interval> there;
  for (std::size_t i = 0; i < n.size(); ++i) {
    Sum sum = {{Interval(1.0) - Interval(worst.t), condition.parts.front()[i]},
               {Interval(worst.t), condition.parts.back()[i]}};
    for (std::size_t d = 0; d < worst.factors.size(); ++d) {
      // Within the balls, whose radii were rounded up and whose shares of several steps are sums.
      const double inwards = worst.factors[d] * (1 - 0x1p-40);
      if (inwards != 0) sum.emplace_back(Interval(inwards), condition.directions[d][i]);
    }
    there.push_back(combined(sum, true));
  }
  const double upper = (size_of_vector(there) * share).upper();
  return {std::min(std::max(0.0, lower), upper), upper};
}

/// Of one component: |N| and all that the balls add to it. Of two the same bound, component by component.
Interval TaskCell::greatest_size_of(const TaskCondition& condition, const Interval& share) {
  Interval greatest = 0;
  for (const std::vector<int>& parts : condition.parts) {
    std::vector<Interval> intervals;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      std::vector<double> unit(parts.size(), 0.0);
      unit[i] = 1;
      const Interval value = combined({{Interval(1), parts[i]}}, true);
      intervals.push_back(square_root(squared(value)) + reach_of_balls(condition, unit, true));
    }
    const Interval size = size_of_vector(intervals) * share;
    // Two components may not be at their most under one load.
    const double bound = parts.size() == 1 || extent_.balls.empty() ? size.lower() : 0.0;
    greatest = Interval(std::max(greatest.lower(), bound), std::max(greatest.upper(), size.upper()));
  }
  return greatest;
}

Interval TaskCell::size_of(int index, bool least) {
  const TaskCondition& condition = conditions_.conditions[static_cast<std::size_t>(index)];
  core::ensure(condition.denominator >= 0, "a condition with a least size");
  if (condition.parts.empty()) return 0.0;
  differentiate();
  Interval below = combined({{Interval(1), condition.denominator}}, true);
  if (condition.squared_axis >= 0) below = below * square_root(value(condition.squared_axis));
  const Interval share = inverse(square_root(squared(below)));
  return least ? least_size_of(condition, share) : greatest_size_of(condition, share);
}

}  // namespace clearloci::loci
