#include "loci/tasks/design_cell.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "loci/tasks/task_functions.hpp"

namespace clearloci::loci {

using core::Interval;
using core::TaskCondition;
using core::TaskConditions;

DesignCell::DesignCell(const TaskConditions& conditions, const core::WorkingMode& mode,
                       std::vector<core::LoadBall> balls, double most_displaced)
    : conditions_(conditions),
      balls_(std::move(balls)),
      program_(program_of(conditions)),
      mode_(mode),
      over_(program_.registers<Interval>()),
      at_middle_(program_.registers<Interval>()),
      half_inverse_(static_cast<std::size_t>(program_.roots())),
      gradient_(static_cast<std::size_t>(program_.variables())),
      slopes_(static_cast<std::size_t>(program_.functions())),
      has_slopes_(static_cast<std::size_t>(program_.functions())),
      most_displaced_(most_displaced) {
  core::ensure(static_cast<int>(mode_.size()) == program_.roots(), "a working mode has a sign for every root");
  const auto watch = [&](int function, int condition) { watched_.push_back({function, condition, groups_}); };
  for (const int f : conditions.determinant) {
    watch(f, -1);
    ++groups_;
  }
  for (std::size_t i = 0; i < conditions.conditions.size(); ++i) {
    const TaskCondition& condition = conditions.conditions[i];
    least_.push_back(sheet::constant_as(condition.least, static_cast<Interval*>(nullptr)));
    for (const int f : condition.factors) {
      watch(f, static_cast<int>(i));
      ++groups_;
    }
    if (condition.parts.empty() || condition.parts.front().size() != 1) continue;
    for (const auto& parts : condition.parts) watch(parts.front(), static_cast<int>(i));
    ++groups_;
  }
}

DesignCell::State DesignCell::enter(std::span<const Interval> box, std::vector<Interval> clearances) {
  differentiated_ = false;
  displacement_in_doubt_ = false;
  parts_of_loads_ = 0;
  clearances_ = std::move(clearances);
  unmet_ = -1;
  in_doubt_.clear();
  falls_.clear();
  box_.assign(box.begin(), box.end());
  for (std::size_t c = 0; c < box_.size(); ++c) over_.set(static_cast<int>(c), box_[c]);
  for (int j = 0; j < program_.roots(); ++j) {
    over_.run_square(j);
    const Interval& square = over_.square(j);
    if (square.upper() < 0) return State::outside;
    if (square.sign() <= 0) in_doubt_.push_back(-1 - j);
    over_.set(program_.coordinates() + j,
              mode_[static_cast<std::size_t>(j)] > 0 ? square_root(square) : -square_root(square));
  }
  if (!in_doubt_.empty()) return State::boundary;
  over_.run_values();
  const auto all_nonzero = [&](const std::vector<int>& functions) {
    return std::all_of(functions.begin(), functions.end(), [&](int f) { return nonzero(f); });
  };
  if (!all_nonzero(conditions_.denominators)) return State::boundary;
  if (!all_nonzero(conditions_.determinant)) return State::singular;
  for (std::size_t i = 0; i < conditions_.conditions.size(); ++i) {
    if (holds(static_cast<int>(i))) continue;
    unmet_ = static_cast<int>(i);
    return State::unmet;
  }
  if (clearances_.empty() || most_displaced_ == std::numeric_limits<double>::infinity()) return State::proven;
  if (displaced_within(most_displaced_)) return State::proven;
  displacement_in_doubt_ = true;
  return State::unmet;
}

void DesignCell::doubt(int function) { in_doubt_.push_back(function); }

const std::vector<int>& DesignCell::downhill() {
  downhill_.assign(box_.size(), 0);
  clearances_downhill_.assign(clearances_.size(), 0);
  if (displacement_in_doubt_) {
    const auto way = [](const Interval& slope) { return slope.middle() > 0 ? 1 : slope.middle() < 0 ? -1 : 0; };
    if (squared_.smooth) std::transform(squared_.slopes.begin(), squared_.slopes.end(), downhill_.begin(), way);
    std::transform(per_clearance_.begin(), per_clearance_.end(), clearances_downhill_.begin(), way);
    return downhill_;
  }
  if (in_doubt_.empty()) return downhill_;
  std::vector<double> slope(box_.size(), 0.0);
  if (in_doubt_.front() < 0) {
    over_.run_values();
    over_.run_gradients();
    for (std::size_t c = 0; c < slope.size(); ++c)
      slope[c] = over_.square_partial(-1 - in_doubt_.front(), static_cast<int>(c)).middle();
  } else {
    differentiate();
    if (falls_.empty()) falls_ = {{middle_value(in_doubt_.front()), in_doubt_.front()}};
    for (const auto& [weight, function] : falls_)
      for (std::size_t c = 0; c < slope.size(); ++c) slope[c] += weight * slopes(function)[c].middle();
  }
  for (std::size_t c = 0; c < slope.size(); ++c) downhill_[c] = slope[c] > 0 ? -1 : slope[c] < 0 ? 1 : 0;
  return downhill_;
}

void DesignCell::differentiate() {
  if (differentiated_) return;
  differentiated_ = true;
  over_.run_gradients();
  std::fill(has_slopes_.begin(), has_slopes_.end(), false);
  for (int j = 0; j < program_.roots(); ++j)
    half_inverse_[static_cast<std::size_t>(j)] = inverse(Interval(2.0) * over_.root(j));
  middle_.clear();
  for (std::size_t c = 0; c < box_.size(); ++c) {
    middle_.push_back(std::clamp(box_[c].middle(), box_[c].lower(), box_[c].upper()));
    at_middle_.set(static_cast<int>(c), Interval(middle_.back()));
  }
  centred_.assign(slopes_.size(), std::nullopt);
  offsets_.clear();
  for (std::size_t c = 0; c < box_.size(); ++c)
    offsets_.push_back(box_[c].lower() == box_[c].upper() ? Interval(0.0) : box_[c] - Interval(middle_[c]));
  for (int j = 0; j < program_.roots(); ++j) {
    at_middle_.run_square(j);
    const Interval root = square_root(meet(at_middle_.square(j), over_.square(j)));
    // The box proves Q_j > 0; rounding at the middle cannot matter beyond that.
    at_middle_.set(program_.coordinates() + j,
                   meet(mode_[static_cast<std::size_t>(j)] > 0 ? root : -root, over_.root(j)));
  }
  at_middle_.run_values();
}

const std::vector<Interval>& DesignCell::slopes(int function) {
  const auto f = static_cast<std::size_t>(function);
  std::vector<Interval>& own = slopes_[f];
  if (has_slopes_[f]) return own;
  has_slopes_[f] = true;
  const int n = program_.coordinates();
  for (int v = 0; v < program_.variables(); ++v) gradient_[static_cast<std::size_t>(v)] = over_.partial(function, v);
  // ds_j/dv = (dQ_j/dv + sum_{i<j} dQ_j/ds_i ds_i/dv) / (2 s_j)
  for (int j = program_.roots() - 1; j >= 0; --j) {
    const auto root = static_cast<std::size_t>(j), first = static_cast<std::size_t>(n);
    const Interval factor = gradient_[first + root] * half_inverse_[root];
    if (factor.lower() == 0 && factor.upper() == 0) continue;
    for (int v = 0; v < n + j; ++v) {
      Interval& slope = gradient_[static_cast<std::size_t>(v)];
      slope = slope + factor * over_.square_partial(j, v);
    }
  }
  own.assign(gradient_.begin(), gradient_.begin() + n);
  return own;
}

double DesignCell::middle_value(int function) const {
  return differentiated_ ? at_middle_.value(function).middle() : value(function).middle();
}

bool DesignCell::nonzero(int function) {
  if (value(function).sign() != 0) return true;
  if (combined({{Interval(1), function}}, true).sign() != 0) return true;
  doubt(function);
  falls_ = {{middle_value(function), function}};
  return false;
}

Interval DesignCell::combined(const std::vector<std::pair<Interval, int>>& sum, bool with_slopes) {
  Interval plain = 0;
  for (const auto& [weight, function] : sum) plain = plain + weight * value(function);
  if (!with_slopes) return plain;
  differentiate();
  Interval centred = 0;
  for (const auto& [weight, function] : sum) centred = centred + weight * at_middle_.value(function);
  // The slopes of the sum, not a sum of enclosures: what cancels does so before the box's width multiplies it.
  for (std::size_t c = 0; c < box_.size(); ++c) {
    if (box_[c].lower() == box_[c].upper()) continue;
    Interval slope = 0;
    for (const auto& [weight, function] : sum) slope = slope + weight * slopes(function)[c];
    centred = centred + slope * (box_[c] - Interval(middle_[c]));
  }
  return meet(centred, plain);
}

Interval DesignCell::reach_of_balls(const TaskCondition& condition, const std::vector<double>& n, bool with_slopes) {
  const auto along = [&](int direction) {
    if (direction < 0) return Interval(0);
    std::vector<std::pair<Interval, int>> sum;
    const std::vector<int>& parts = condition.directions[static_cast<std::size_t>(direction)];
    for (std::size_t i = 0; i < parts.size(); ++i) sum.emplace_back(Interval(n[i]), parts[i]);
    return combined(sum, with_slopes);
  };
  Interval reach = 0;
  for (const core::LoadBall& ball : balls_) {
    if (ball.force > 0) reach = reach + Interval(ball.force) * size_of_vector({along(ball.fx), along(ball.fy)});
    if (ball.couple_size > 0) reach = reach + Interval(ball.couple_size) * size_of_vector({along(ball.couple)});
  }
  return reach;
}

bool DesignCell::holds(int index) {
  const TaskCondition& condition = conditions_.conditions[static_cast<std::size_t>(index)];
  if (!condition.unloaded.empty()) return false;
  if (!std::all_of(condition.factors.begin(), condition.factors.end(), [&](int f) { return nonzero(f); })) return false;
  if (condition.parts.empty()) return true;
  const Interval& least = least_[static_cast<std::size_t>(index)];
  falls_.clear();
  if (holds(condition, least, false) || holds(condition, least, true)) return true;
  for (const std::vector<int>& parts : condition.parts)
    for (const int f : parts) doubt(f);
  return false;
}

bool DesignCell::holds(const TaskCondition& condition, const Interval& least, bool with_slopes) {
  if (with_slopes) differentiate();
  const auto values = [&](const std::vector<int>& functions) {
    std::vector<double> list;
    for (const int f : functions) list.push_back(middle_value(f));
    return list;
  };
  const std::vector<double> a = values(condition.parts.front()), b = values(condition.parts.back());
  const double t = nearest_part(a, b);
  std::vector<double> n;
  Interval square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    n.push_back(a[i] + t * (b[i] - a[i]));
    square = square + squared(Interval(n.back()));
  }
  if (!(square.lower() > 0)) return false;
  // n is no unit vector: |n.w| <= |n| |w|.
  Interval share = 0;
  if (condition.least > 0) {
    Interval length = square_root(square);
    if (condition.squared_axis >= 0) length = length * square_root(value(condition.squared_axis));
    const Interval& d = with_slopes ? at_middle_.value(condition.denominator) : value(condition.denominator);
    // The box proves that |A| has a sign; so has D, a part of it.
    if (d.sign() == 0) return false;
    share = least * length * Interval(d.sign() > 0 ? -1.0 : 1.0);
  }
  if (with_slopes) {
    falls_.clear();
    for (std::size_t i = 0; i < n.size(); ++i) falls_.emplace_back(n[i], condition.parts.front()[i]);
    if (condition.least > 0) falls_.emplace_back(share.middle(), condition.denominator);
  }
  const Interval taken = balls_.empty() ? Interval(0) : reach_of_balls(condition, n, with_slopes);
  return std::all_of(condition.parts.begin(), condition.parts.end(), [&](const std::vector<int>& parts) {
    std::vector<std::pair<Interval, int>> sum;
    for (std::size_t i = 0; i < parts.size(); ++i) sum.emplace_back(Interval(n[i]), parts[i]);
    if (condition.least > 0) sum.emplace_back(share, condition.denominator);
    return (combined(sum, with_slopes) - taken).lower() > 0;
  });
}

bool DesignCell::brought_down(const TaskCondition& condition, const std::vector<int>& parts,
                              const Interval& asked) const {
  if (parts.size() != 2) return false;
  const Interval &w0 = value(parts[0]), &w1 = value(parts[1]);
  for (const core::LoadBall& ball : balls_) {
    if (!(ball.force > 0)) continue;
    const std::vector<int>&a = condition.directions[static_cast<std::size_t>(ball.fx)],
          &b = condition.directions[static_cast<std::size_t>(ball.fy)];
    const Interval &a0 = value(a[0]), &a1 = value(a[1]), &b0 = value(b[0]), &b1 = value(b[1]);
    // The force that takes it to nothing, by Cramer's rule, lies in the ball.
    const Interval determinant = a0 * b1 - a1 * b0;
    const Interval x = w1 * b0 - w0 * b1, y = w0 * a1 - w1 * a0;
    const double radius = ball.force * (1 - 0x1p-40);  // within what was asked, rounded up or not
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

int DesignCell::failed() const {
  for (std::size_t i = 0; i < conditions_.conditions.size(); ++i) {
    const TaskCondition& condition = conditions_.conditions[i];
    if (!condition.unloaded.empty()) return static_cast<int>(i);
    for (const std::vector<int>& parts : condition.parts) {
      std::vector<Interval> own;
      for (const int f : parts) own.push_back(value(f));
      const Interval size = size_of_vector(own);
      Interval asked = 0;
      if (condition.least > 0 && condition.denominator >= 0) {
        asked = least_[i] * square_root(squared(value(condition.denominator)));
        if (condition.squared_axis >= 0) asked = asked * square_root(value(condition.squared_axis));
        if (size.upper() < asked.lower()) return static_cast<int>(i);
      }
      if (!balls_.empty() && brought_down(condition, parts, asked)) return static_cast<int>(i);
      // A scalar reaction that a load of the ball brings down to nothing.
      if (parts.size() != 1) continue;
      double reach = 0;
      for (const core::LoadBall& ball : balls_) {
        const auto along = [&](int direction) {
          return direction < 0 ? 0.0 : value(condition.directions[static_cast<std::size_t>(direction)][0]).mignitude();
        };
        reach += (ball.force * std::hypot(along(ball.fx), along(ball.fy)) + ball.couple_size * along(ball.couple)) *
                 (1 - 0x1p-40);  // the roundings of these few operations
      }
      if (reach > 0 && size.upper() < reach) return static_cast<int>(i);
    }
  }
  return -1;
}

const std::vector<double>& DesignCell::spreads() {
  const std::size_t n = box_.size();
  spreads_.assign(n, 0.0);
  clearance_spreads_.clear();
  if (displacement_in_doubt_) {
    for (std::size_t k = 0; k < clearances_.size(); ++k)
      clearance_spreads_.push_back(per_clearance_[k].magnitude() * clearances_[k].width());
    if (squared_.smooth) {
      for (std::size_t c = 0; c < n; ++c) spreads_[c] = squared_.slopes[c].magnitude() * box_[c].width();
      return spreads_;
    }
    // A direction in which a clearance is taken up is not known: what it is the direction of.
    for (const TaskCondition& own : conditions_.take_ups)
      for (const std::vector<int>& parts : own.parts)
        for (const int f : parts) doubt(f);
  }
  const bool boundary = !in_doubt_.empty() && in_doubt_.front() < 0;
  if (!boundary) differentiate();
  for (const int f : in_doubt_) {
    if (f < 0) continue;
    const std::vector<Interval>& own = slopes(f);
    for (std::size_t c = 0; c < n; ++c) spreads_[c] += own[c].magnitude() * box_[c].width();
  }
  if (!boundary) return spreads_;
  over_.run_values();
  over_.run_gradients();
  // Of a dyad on a dyad what comes by way of the root below is left out: it says where to cut, and proves nothing.
  for (const int own : in_doubt_)
    for (std::size_t c = 0; c < n; ++c)
      spreads_[c] += over_.square_partial(-1 - own, static_cast<int>(c)).magnitude() * box_[c].width();
  return spreads_;
}

}  // namespace clearloci::loci
