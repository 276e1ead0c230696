// What a cell of poses and designs tells beyond a cell of poses (task_cell.hpp): balls of loads, where it is in doubt,
// what fails in it for certain.
#include <algorithm>
#include <cmath>

#include "loci/tasks/task_cell.hpp"
#include "loci/tasks/task_functions.hpp"

namespace clearloci::loci {

using core::Interval;
using core::TaskCondition;
using core::TaskConditions;

void TaskCell::watch_signs() {
  const auto watch = [&](int function, int condition) { watched_.push_back({function, condition, groups_}); };
  for (const int f : conditions_.determinant) {
    watch(f, -1);
    ++groups_;
  }
  for (std::size_t i = 0; i < conditions_.conditions.size(); ++i) {
    const TaskCondition& condition = conditions_.conditions[i];
    for (const int f : condition.factors) {
      watch(f, static_cast<int>(i));
      ++groups_;
    }
    if (condition.parts.empty() || condition.parts.front().size() != 1) continue;
    for (const auto& parts : condition.parts) watch(parts.front(), static_cast<int>(i));
    ++groups_;
  }
}

TaskCell::State TaskCell::enter(std::span<const Interval> box, std::vector<Interval> clearances) {
  if (!alone_) alone_.emplace(program_, mode_, sheet::Lifting::at_rims);
  displacement_in_doubt_ = false;
  parts_of_loads_ = 0;
  clearances_ = std::move(clearances);
  offsets_.clear();
  const Judgement judgement = *look(*alone_, alone_->enter(box), false);
  unmet_ = judgement.unmet;
  is_outside_ = judgement.state == State::outside;
  if (judgement.state != State::proven || clearances_.empty() ||
      extent_.most_displaced == std::numeric_limits<double>::infinity())
    return judgement.state;
  if (displaced_within(extent_.most_displaced)) return State::proven;
  displacement_in_doubt_ = true;
  return State::unmet;
}

Interval TaskCell::reach_of_balls(const TaskCondition& condition, const std::vector<double>& n, bool with_slopes) {
  Interval reach = 0;
  for (const core::LoadBall& ball : extent_.balls) {
    std::vector<Interval> along;
    for (std::size_t d = ball.first; d < ball.first + ball.count; ++d) {
      Sum sum;
      const std::vector<int>& parts = condition.directions[d];
      for (std::size_t i = 0; i < parts.size(); ++i) sum.emplace_back(Interval(n[i]), parts[i]);
      along.push_back(combined(sum, with_slopes));
    }
    reach = reach + Interval(ball.radius) * size_of_vector(along);
  }
  return reach;
}

bool TaskCell::brought_down(const TaskCondition& condition, const std::vector<int>& parts,
                            const Interval& asked) const {
  if (parts.size() != 2) return false;
  const Interval &w0 = value(parts[0]), &w1 = value(parts[1]);
  for (const core::LoadBall& ball : extent_.balls) {
    if (ball.count != 2) continue;
    const std::vector<int>&a = condition.directions[ball.first], &b = condition.directions[ball.first + 1];
    const Interval &a0 = value(a[0]), &a1 = value(a[1]), &b0 = value(b[0]), &b1 = value(b[1]);
    // The force that takes it to nothing, by Cramer's rule, lies in the ball.
    const Interval determinant = a0 * b1 - a1 * b0;
    const Interval x = w1 * b0 - w0 * b1, y = w0 * a1 - w1 * a0;
    const double radius = ball.radius * (1 - 0x1p-40);  // within what was asked, rounded up or not
    if (determinant.sign() != 0 &&
        (squared(x) + squared(y)).upper() < (Interval(radius) * Interval(radius) * squared(determinant)).lower())
      return true;
    if (!(asked.lower() > 0)) continue;
    // The force of the ball's edge that takes most off the reaction, to first order; part of it where that is too much.
    const double n0 = w0.middle(), n1 = w1.middle();
    const double gx = n0 * a0.middle() + n1 * a1.middle(), gy = n0 * b0.middle() + n1 * b1.middle();
    const double size = std::hypot(gx, gy);
    if (!(size > 0)) continue;
    const double fx = -radius * gx / size * (1 - 0x1p-40), fy = -radius * gy / size * (1 - 0x1p-40);
    const double d0 = fx * a0.middle() + fy * b0.middle(), d1 = fx * a1.middle() + fy * b1.middle();
    const double part = std::clamp(-(n0 * d0 + n1 * d1) / (d0 * d0 + d1 * d1), 0.0, 1.0);
    const Interval x_of = part * fx, y_of = part * fy;
    if (size_of_vector({w0 + x_of * a0 + y_of * b0, w1 + x_of * a1 + y_of * b1}).upper() < asked.lower()) return true;
  }
  return false;
}

int TaskCell::failed() const {
  for (std::size_t i = 0; i < conditions_.conditions.size(); ++i) {
    const TaskCondition& condition = conditions_.conditions[i];
    if (!condition.unloaded.empty()) return static_cast<int>(i);
    for (const std::vector<int>& parts : condition.parts) {
      std::vector<Interval> intervals;
      for (const int f : parts) intervals.push_back(value(f));
      const Interval size = size_of_vector(intervals);
      Interval asked = 0;
      if (condition.least > 0 && condition.denominator >= 0) {
        asked = least_[i] * square_root(squared(value(condition.denominator)));
        if (condition.squared_axis >= 0) asked = asked * square_root(value(condition.squared_axis));
        if (size.upper() < asked.lower()) return static_cast<int>(i);
      }
      if (!extent_.balls.empty() && brought_down(condition, parts, asked)) return static_cast<int>(i);
      // A scalar reaction that a load of the ball brings down to nothing.
      if (parts.size() != 1) continue;
      double reach = 0;
      for (const core::LoadBall& ball : extent_.balls) {
        double along = 0;
        for (std::size_t d = ball.first; d < ball.first + ball.count; ++d)
          along = std::hypot(along, value(condition.directions[d][0]).mignitude());
        reach += ball.radius * along * (1 - 0x1p-40);  // the roundings of these few operations
      }
      if (reach > 0 && size.upper() < reach) return static_cast<int>(i);
    }
  }
  return -1;
}

const std::vector<int>& TaskCell::downhill() {
  downhill_.assign(static_cast<std::size_t>(cell_->coordinates()), 0);
  clearances_downhill_.assign(clearances_.size(), 0);
  if (displacement_in_doubt_) {
    const auto way = [](const Interval& slope) { return slope.middle() > 0 ? 1 : slope.middle() < 0 ? -1 : 0; };
    if (squared_.smooth) std::transform(squared_.slopes.begin(), squared_.slopes.end(), downhill_.begin(), way);
    std::transform(per_clearance_.begin(), per_clearance_.end(), clearances_downhill_.begin(), way);
    return downhill_;
  }
  const bool at_rim = !cell_->lifted().empty();
  if (in_doubt_.empty() && !at_rim) return downhill_;
  differentiate();
  if (falls_.empty() && !at_rim) falls_ = {{middle_value(in_doubt_.front()), in_doubt_.front()}};
  for (int c = 0; c < cell_->coordinates(); ++c) {
    double slope = at_rim ? -cell_->bond_slope(0, c).middle() : 0;
    for (const auto& [weight, function] : falls_) slope += weight * cell_->slope(function, c).middle();
    downhill_[static_cast<std::size_t>(c)] = slope > 0 ? -1 : slope < 0 ? 1 : 0;
  }
  return downhill_;
}

const std::vector<double>& TaskCell::spreads() {
  const auto n = static_cast<std::size_t>(cell_->coordinates());
  spreads_.assign(n, 0.0);
  clearance_spreads_.clear();
  if (is_outside_) return spreads_;
  const auto add = [&](const auto& slope) {
    for (std::size_t c = 0; c < n; ++c) {
      const int variable = static_cast<int>(c);
      spreads_[c] += slope(variable).magnitude() * cell_->local(variable).width();
    }
  };
  if (displacement_in_doubt_) {
    for (std::size_t k = 0; k < clearances_.size(); ++k)
      clearance_spreads_.push_back(per_clearance_[k].magnitude() * clearances_[k].width());
    if (squared_.smooth) {
      add([&](int c) { return squared_.slopes[static_cast<std::size_t>(c)]; });
      return spreads_;
    }
    // A direction in which a clearance is taken up is not known: what it is the direction of.
    for (const TaskCondition& condition : conditions_.take_ups)
      for (const std::vector<int>& parts : condition.parts)
        in_doubt_.insert(in_doubt_.end(), parts.begin(), parts.end());
  }
  differentiate();
  for (const int f : in_doubt_) add([&](int c) { return cell_->slope(f, c); });
  for (int l = 0; l < cell_->dimension() - cell_->coordinates(); ++l)
    add([&](int c) { return cell_->bond_slope(l, c); });
  return spreads_;
}

}  // namespace clearloci::loci
