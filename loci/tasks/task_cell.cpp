#include "loci/tasks/task_cell.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "loci/tasks/task_functions.hpp"

namespace clearloci::loci {
namespace {

using core::Interval;
using core::Point2;
using core::TaskCondition;
using core::TaskConditions;

}  // namespace

TaskCell::TaskCell(const TaskConditions& conditions, const core::WorkingMode& mode, TaskExtent extent)
    : conditions_(conditions), extent_(std::move(extent)), program_(program_of(conditions)), mode_(mode) {
  for (const TaskCondition& condition : conditions.conditions)
    least_.push_back(sheet::constant_as(condition.least, static_cast<Interval*>(nullptr)));
  watch_signs();
}

bool TaskCell::differentiate() {
  if (!has_slopes_ && alone_ && cell_ == &*alone_) {
    cell_->differentiate();
    has_slopes_ = true;
  }
  wants_slopes_ = wants_slopes_ || !has_slopes_;
  differentiated_ = has_slopes_;
  return has_slopes_;
}

bool TaskCell::nonzero(int function) {
  if (cell_->value(function).sign() != 0) return true;
  if (differentiate() && cell_->centred(function).sign() != 0) return true;
  in_doubt_.push_back(function);
  return false;
}

Interval TaskCell::combined(const Sum& sum, bool with_slopes) const {
  Interval plain = 0;
  for (const auto& [weight, function] : sum) plain = plain + weight * value(function);
  if (!with_slopes) return plain;
  Interval centred = 0;
  for (const auto& [weight, function] : sum) centred = centred + weight * cell_->middle_value(function);
  // The slopes of the sum, not a sum of enclosures: what cancels does so before the cell's width multiplies it.
  for (int c = 0; c < cell_->dimension(); ++c) {
    if (cell_->local(c).width() == 0) continue;
    Interval slope = 0;
    for (const auto& [weight, function] : sum) slope = slope + weight * cell_->slope(function, c);
    centred = centred + slope * (cell_->local(c) - Interval(cell_->middle(c)));
  }
  return meet(centred, plain);
}

double TaskCell::middle_value(int function) const {
  return (differentiated_ ? cell_->middle_value(function) : value(function)).middle();
}

void TaskCell::take_values(const std::vector<int>& functions, std::vector<double>& list) const {
  list.clear();
  for (const int f : functions) list.push_back(middle_value(f));
}

bool TaskCell::holds(const TaskCondition& condition) {
  if (!condition.unloaded.empty()) return false;
  if (!std::all_of(condition.factors.begin(), condition.factors.end(), [&](int f) { return nonzero(f); })) return false;
  if (condition.parts.empty()) return true;
  falls_.clear();
  for (const bool with_slopes : {false, true}) {
    if (with_slopes && !differentiate()) return false;
    const std::vector<Sum>* const sums = sums_of(condition, with_slopes);
    if (sums == nullptr) continue;
    const bool balls = !extent_.balls.empty();
    const Interval taken = balls ? reach_of_balls(condition, ends_[0], with_slopes) : Interval(0);
    if (std::all_of(sums->begin(), sums->end(), [&](const Sum& sum) {
          const Interval all = combined(sum, with_slopes);
          return (balls ? all - taken : all).lower() > 0;
        }))
      return true;
    if (with_slopes)
      for (const auto& [weight, function] : sums->front()) falls_.emplace_back(weight.middle(), function);
  }
  for (const std::vector<int>& parts : condition.parts) in_doubt_.insert(in_doubt_.end(), parts.begin(), parts.end());
  return false;
}

const std::vector<TaskCell::Sum>* TaskCell::sums_of(const TaskCondition& condition, bool with_slopes) {
  auto& [a, b] = ends_;
  take_values(condition.parts.front(), a);
  take_values(condition.parts.back(), b);
  const double t = nearest_part(a, b);
  Interval square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] += t * (b[i] - a[i]);
    square = square + squared(Interval(a[i]));
  }
  if (!(square.lower() > 0)) return nullptr;
  const bool size = condition.least > 0;
  // n is no unit vector: |n.w| <= |n| |w|.
  Interval share = 0;
  if (size) {
    Interval length = square_root(square);
    if (condition.squared_axis >= 0) length = length * square_root(cell_->value(condition.squared_axis));
    const Interval& d = with_slopes ? cell_->middle_value(condition.denominator) : cell_->value(condition.denominator);
    // The cell proves that |A| has a sign; so has D, a part of it.
    if (d.sign() == 0) return nullptr;
    share = least_[static_cast<std::size_t>(&condition - conditions_.conditions.data())] * length *
            Interval(d.sign() > 0 ? -1.0 : 1.0);
  }
  sums_.resize(condition.parts.size());
  for (std::size_t load = 0; load < sums_.size(); ++load) {
    const std::vector<int>& parts = condition.parts[load];
    sums_[load].clear();
    for (std::size_t i = 0; i < parts.size(); ++i) sums_[load].emplace_back(Interval(a[i]), parts[i]);
    if (size) sums_[load].emplace_back(share, condition.denominator);
  }
  return &sums_;
}

bool TaskCell::positive(const Bound& bound) const {
  Interval all = bound.value;
  for (int c = 0; c < 2; ++c)
    all = all + bound.slopes[static_cast<std::size_t>(c)] * (cell_->local(c) - Interval(cell_->middle(c)));
  return all.lower() > 0;
}

TaskCell::Bound TaskCell::square_bound(int lifted) const {
  // s^2 less the bond, which depends on the other lifted roots alone.
  Bound bound{squared(Interval(cell_->middle(2 + lifted))) - cell_->middle_bond(lifted),
              {-cell_->bond_slope(lifted, 0), -cell_->bond_slope(lifted, 1)}};
  for (int c = 2; c < cell_->dimension(); ++c)
    if (c != 2 + lifted)
      bound.value = bound.value - cell_->bond_slope(lifted, c) * (cell_->local(c) - Interval(cell_->middle(c)));
  return bound;
}

void TaskCell::add_bounds(const Sum& sum, const Judgement& what, bool either_side, Doubt& doubt) const {
  Interval middle = 0;
  for (const auto& [weight, function] : sum) middle = middle + weight * cell_->middle_value(function);
  std::vector<Interval> slopes, changes;  // along each coordinate, over the cell
  for (int c = 0; c < cell_->dimension(); ++c) {
    Interval slope = 0;
    for (const auto& [weight, function] : sum) slope = slope + weight * cell_->slope(function, c);
    slopes.push_back(slope);
    changes.push_back(slope * (cell_->local(c) - Interval(cell_->middle(c))));
  }
  /// At the middle of some coordinates, anywhere along the others.
  const auto without = [&](auto at_middle) {
    Interval value = middle;
    for (std::size_t c = 0; c < changes.size(); ++c)
      if (!at_middle(c)) value = value + changes[c];
    return value;
  };
  const Interval value = without([](std::size_t c) { return c < 2; });
  std::vector<Bound> bounds = {{value, {slopes[0], slopes[1]}}};
  if (either_side) bounds.push_back({-value, {-slopes[0], -slopes[1]}});
  for (std::size_t c = 2; c < slopes.size(); ++c) {
    // Where it grows with a root's size r it is positive but for the least r: r^2 <= square.
    const int variable = static_cast<int>(c);
    const double side = cell_->mode()[static_cast<std::size_t>(cell_->lifted()[c - 2])];
    const int sign = (Interval(side) * slopes[c]).sign();
    if (sign == 0 || (sign < 0 && !either_side)) continue;
    const Interval growth = Interval(sign * side) * slopes[c];
    const double rest = (Interval(sign) * without([&](std::size_t k) { return k == c; })).lower();
    const double least = (Interval(side * cell_->middle(variable)) -
                          Interval(rest) * inverse(Interval(rest > 0 ? growth.upper() : growth.lower())))
                             .upper();
    if (least < 0) return;
    Bound bound = square_bound(variable - 2);
    bound.value = bound.value - squared(Interval(least));
    bounds.push_back(bound);
  }
  if (std::none_of(bounds.begin(), bounds.end(), [&](const Bound& bound) { return positive(bound); }))
    doubt.unproven.push_back({what, std::move(bounds), either_side, either_side});
}

bool TaskCell::add_bounds(const TaskCondition& condition, const Judgement& what, Doubt& doubt) {
  if (!condition.unloaded.empty()) return false;
  for (const int f : condition.factors)
    if (!nonzero(f)) add_bounds({{1, f}}, what, true, doubt);
  if (condition.parts.empty()) return true;
  const std::vector<Sum>* const sums = sums_of(condition, true);
  if (sums == nullptr) return false;
  // A single component under a single load keeps away from zero on either side of it.
  const bool either_side = sums->size() == 1 && sums->front().size() == 1;
  for (const Sum& sum : *sums) add_bounds(sum, what, either_side, doubt);
  return true;
}

TaskCell::Doubt TaskCell::doubt() {
  Doubt doubt;
  doubt.middle = {cell_->middle(0), cell_->middle(1)};
  differentiated_ = true;
  const Judgement boundary{State::boundary}, singular{State::singular};
  for (int l = 0; l + 2 < cell_->dimension(); ++l)
    if (cell_->square(cell_->lifted()[static_cast<std::size_t>(l)]).sign() <= 0)
      if (const Bound bound = square_bound(l); !positive(bound)) doubt.unproven.push_back({boundary, {bound}, true});
  const auto nonzero_or_bounded = [&](const std::vector<int>& functions, const Judgement& what) {
    for (const int f : functions)
      if (!nonzero(f)) add_bounds({{1, f}}, what, true, doubt);
  };
  nonzero_or_bounded(conditions_.denominators, boundary);
  nonzero_or_bounded(conditions_.determinant, singular);
  doubt.anywhere = false;
  for (std::size_t i = 0; i < conditions_.conditions.size(); ++i) {
    const TaskCondition& condition = conditions_.conditions[i];
    if (!holds(condition) && !add_bounds(condition, {State::unmet, static_cast<int>(i)}, doubt)) doubt.anywhere = true;
  }
  return doubt;
}

/// Nothing where slopes are wanted that are not there.
std::optional<TaskCell::Judgement> TaskCell::look(sheet::SheetCell& cell, bool inside, bool has_slopes) {
  cell_ = &cell;
  has_slopes_ = has_slopes;
  differentiated_ = wants_slopes_ = false;
  in_doubt_.clear();
  falls_.clear();
  const auto told = [&](State state, int unmet = -1) -> std::optional<Judgement> {
    if (wants_slopes_) return std::nullopt;
    return Judgement{state, unmet};
  };
  if (!inside) return told(State::outside);
  for (int j = 0; j < program_.roots(); ++j)
    if (cell.square(j).sign() <= 0) return told(State::boundary);
  const auto all_nonzero = [&](const std::vector<int>& functions) {
    return std::all_of(functions.begin(), functions.end(), [&](int f) { return nonzero(f); });
  };
  if (!all_nonzero(conditions_.denominators)) return told(State::boundary);
  if (!all_nonzero(conditions_.determinant)) return told(State::singular);
  for (std::size_t i = 0; i < conditions_.conditions.size(); ++i)
    if (!holds(conditions_.conditions[i])) return told(State::unmet, static_cast<int>(i));
  return told(State::proven);
}

std::vector<TaskCell::Judgement> TaskCell::judge(const std::vector<std::array<Interval, 2>>& cells,
                                                 std::vector<Doubt>* doubts) {
  if (doubts != nullptr) doubts->assign(cells.size(), {});
  constexpr std::size_t size = sheet::SheetCells::size;
  if (!side_by_side_) side_by_side_.emplace(program_, mode_);
  std::vector<Judgement> judgements(cells.size());
  std::vector<std::size_t> open;  // slopes are wanted
  const auto judge_batch = [&](const std::size_t* indices, std::size_t count, bool with_slopes) {
    std::array<sheet::SheetCells::Target, size> places;
    for (std::size_t lane = 0; lane < count; ++lane) places[lane] = {cells[indices[lane]]};
    side_by_side_->enter(places, count);
    if (with_slopes) side_by_side_->differentiate();
    for (std::size_t lane = 0; lane < count; ++lane) {
      const auto judgement = look((*side_by_side_)[lane], side_by_side_->inside(lane), with_slopes);
      const bool doubtful = judgement && judgement->state != State::proven && judgement->state != State::outside;
      if (judgement && (doubts == nullptr || !doubtful || with_slopes))
        judgements[indices[lane]] = *judgement;
      else
        open.push_back(indices[lane]);
      if (doubts != nullptr && doubtful && with_slopes) (*doubts)[indices[lane]] = doubt();
    }
  };
  std::vector<std::size_t> all(cells.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  for (std::size_t i = 0; i < all.size(); i += size) judge_batch(all.data() + i, std::min(size, all.size() - i), false);
  const std::vector<std::size_t> rest = std::move(open);
  open.clear();
  for (std::size_t i = 0; i < rest.size(); i += size)
    judge_batch(rest.data() + i, std::min(size, rest.size() - i), true);
  return judgements;
}

TaskPoint::TaskPoint(const TaskConditions& conditions, const core::WorkingMode& mode)
    : conditions_(conditions), program_(program_of(conditions)), cell_(program_, mode) {
  const auto watch = [&](int function) {
    if (std::none_of(watched_.begin(), watched_.end(), [&](const Watched& w) { return w.function == function; }))
      watched_.push_back({function, -1});
  };
  for (const int f : conditions.determinant) watch(f);
  for (std::size_t i = 0; i < conditions.conditions.size(); ++i) {
    const TaskCondition& condition = conditions.conditions[i];
    for (const int f : condition.factors) watch(f);
    for (const auto& parts : condition.parts)
      if (parts.size() == 1) watch(parts.front());
    if (condition.parts.size() == 2 && condition.parts.front().size() == 2)
      watched_.push_back({-1, static_cast<int>(i)});
  }
}

bool TaskPoint::enter(const Point2& at) {
  if (!cell_.enter(Interval(at[0]), Interval(at[1]))) return false;
  for (int j = 0; j < program_.roots(); ++j)
    if (cell_.square(j).sign() <= 0) return false;
  return true;
}

int TaskPoint::sign(std::size_t watched) const {
  const Watched& watch = watched_[watched];
  if (watch.function >= 0) return cell_.value(watch.function).sign();
  const TaskCondition& condition = conditions_.conditions[static_cast<std::size_t>(watch.condition)];
  const auto part = [&](std::size_t load, std::size_t i) { return cell_.value(condition.parts[load][i]); };
  // Where the ends point into one half plane the way between them does not pass through zero, whatever their area.
  const Interval dot = part(0, 0) * part(1, 0) + part(0, 1) * part(1, 1);
  if (dot.sign() >= 0) return 0;
  return (part(0, 0) * part(1, 1) - part(0, 1) * part(1, 0)).sign();
}

bool TaskPoint::step(int condition, Point2& at, double& load) {
  const TaskCondition& task_condition = conditions_.conditions[static_cast<std::size_t>(condition)];
  if (task_condition.parts.empty() || !enter(at)) return false;
  cell_.differentiate();
  if (cell_.dimension() != 2) return false;
  const bool range = task_condition.parts.size() > 1;
  // Normal equations of J delta = -w, with a hair on the diagonal so that they can be solved where J has less rank.
  double m[3][4] = {};
  for (std::size_t i = 0; i < task_condition.parts.front().size(); ++i) {
    const int f = task_condition.parts.front()[i], g = task_condition.parts.back()[i];
    const auto mix = [&](const Interval& a, const Interval& b) { return (1 - load) * a.middle() + load * b.middle(); };
    const double row[3] = {mix(cell_.slope(f, 0), cell_.slope(g, 0)), mix(cell_.slope(f, 1), cell_.slope(g, 1)),
                           range ? cell_.value(g).middle() - cell_.value(f).middle() : 0.0};
    const double value = mix(cell_.value(f), cell_.value(g));
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) m[r][c] += row[r] * row[c];
      m[r][3] -= row[r] * value;
    }
  }
  const double hair = 1e-13 * (m[0][0] + m[1][1] + m[2][2]);
  if (!(hair > 0)) return false;
  for (int r = 0; r < 3; ++r) m[r][r] += hair;
  for (int c = 0; c < 3; ++c)  // positive definite: no pivoting
    for (int r = 0; r < 3; ++r) {
      if (r == c) continue;
      const double factor = m[r][c] / m[c][c];
      for (int k = c; k < 4; ++k) m[r][k] -= factor * m[c][k];
    }
  for (std::size_t c = 0; c < 2; ++c) at[c] += m[c][3] / m[c][c];
  load = std::clamp(load + m[2][3] / m[2][2], 0.0, 1.0);
  return std::isfinite(at[0]) && std::isfinite(at[1]);
}

}  // namespace clearloci::loci
