#include "loci/task_cell.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "loci/task_functions.hpp"

namespace clearloci::loci {
namespace {

using core::Interval;
using core::Point2;
using core::TaskCondition;
using core::TaskConditions;

}  // namespace

TaskCell::TaskCell(const TaskConditions& conditions, const core::WorkingMode& mode)
    : conditions_(conditions), program_(program_of(conditions)), side_by_side_(program_, mode) {
  for (const TaskCondition& condition : conditions.conditions)
    least_.push_back(sheet::constant_as(condition.least, static_cast<Interval*>(nullptr)));
}

bool TaskCell::differentiate() {
  wants_slopes_ = wants_slopes_ || !has_slopes_;
  differentiated_ = has_slopes_;
  return has_slopes_;
}

bool TaskCell::nonzero(int function) {
  if (cell_->value(function).sign() != 0) return true;
  return differentiate() && cell_->centred(function).sign() != 0;
}

bool TaskCell::positive(const std::vector<std::pair<Interval, int>>& sum, bool with_slopes) {
  Interval value = 0;
  for (const auto& [weight, function] : sum)
    value = value + weight * (with_slopes ? cell_->middle_value(function) : cell_->value(function));
  if (!with_slopes) return value.lower() > 0;
  // The slopes of the sum, not a sum of enclosures: what cancels does so before the cell's width multiplies it.
  for (int c = 0; c < cell_->dimension(); ++c) {
    Interval slope = 0;
    for (const auto& [weight, function] : sum) slope = slope + weight * cell_->slope(function, c);
    value = value + slope * (cell_->local(c) - Interval(cell_->middle(c)));
  }
  return value.lower() > 0;
}

std::vector<double> TaskCell::values(const std::vector<int>& functions) const {
  std::vector<double> list;
  for (const int f : functions)
    list.push_back(differentiated_ ? cell_->middle_value(f).middle() : cell_->value(f).middle());
  return list;
}

bool TaskCell::holds(const TaskCondition& condition) {
  if (!condition.unloaded.empty()) return false;
  if (!std::all_of(condition.factors.begin(), condition.factors.end(), [&](int f) { return nonzero(f); })) return false;
  if (condition.parts.empty()) return true;
  const bool size = condition.least > 0;
  for (const bool with_slopes : {false, true}) {
    if (with_slopes && !differentiate()) return false;
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
    if (size) {
      Interval length = square_root(square);
      if (condition.squared_axis >= 0) length = length * square_root(cell_->value(condition.squared_axis));
      const Interval& d =
          with_slopes ? cell_->middle_value(condition.denominator) : cell_->value(condition.denominator);
      // The cell proves that |A| has a sign; so has D, a part of it.
      if (d.sign() == 0) continue;
      share = least_[static_cast<std::size_t>(&condition - conditions_.conditions.data())] * length *
              Interval(d.sign() > 0 ? -1.0 : 1.0);
    }
    const auto clear = [&](const std::vector<int>& parts) {
      std::vector<std::pair<Interval, int>> sum;
      for (std::size_t i = 0; i < parts.size(); ++i) sum.emplace_back(Interval(n[i]), parts[i]);
      if (size) sum.emplace_back(share, condition.denominator);
      return positive(sum, with_slopes);
    };
    if (std::all_of(condition.parts.begin(), condition.parts.end(), clear)) return true;
  }
  return false;
}

/// Nothing where slopes are wanted that are not there.
std::optional<TaskCell::Judgement> TaskCell::look(sheet::SheetCell& cell, bool inside, bool has_slopes) {
  cell_ = &cell;
  has_slopes_ = has_slopes;
  differentiated_ = wants_slopes_ = false;
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

std::vector<TaskCell::Judgement> TaskCell::judge(const std::vector<std::array<Interval, 2>>& cells) {
  constexpr std::size_t size = sheet::SheetCells::size;
  std::vector<Judgement> judgements(cells.size());
  std::vector<std::size_t> open;  // slopes are wanted
  const auto judge_batch = [&](const std::size_t* indices, std::size_t count, bool with_slopes) {
    std::array<sheet::SheetCells::Place, size> places;
    for (std::size_t lane = 0; lane < count; ++lane) places[lane] = {cells[indices[lane]][0], cells[indices[lane]][1]};
    side_by_side_.enter(places, count);
    if (with_slopes) side_by_side_.differentiate();
    for (std::size_t lane = 0; lane < count; ++lane) {
      const auto judgement = look(side_by_side_[lane], side_by_side_.inside(lane), with_slopes);
      judgement ? void(judgements[indices[lane]] = *judgement) : open.push_back(indices[lane]);
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
  const Watched& own = watched_[watched];
  if (own.function >= 0) return cell_.value(own.function).sign();
  const TaskCondition& condition = conditions_.conditions[static_cast<std::size_t>(own.condition)];
  const auto part = [&](std::size_t load, std::size_t i) { return cell_.value(condition.parts[load][i]); };
  // Where the ends point into one half plane the way between them does not pass through zero, whatever their area.
  const Interval dot = part(0, 0) * part(1, 0) + part(0, 1) * part(1, 1);
  if (dot.sign() >= 0) return 0;
  return (part(0, 0) * part(1, 1) - part(0, 1) * part(1, 0)).sign();
}

bool TaskPoint::step(int condition, Point2& at, double& load) {
  const TaskCondition& own = conditions_.conditions[static_cast<std::size_t>(condition)];
  if (own.parts.empty() || !enter(at)) return false;
  cell_.differentiate();
  if (cell_.dimension() != 2) return false;
  const bool range = own.parts.size() > 1;
  // Normal equations of J delta = -w, with a hair on the diagonal so that they can be solved where J has less rank.
  double m[3][4] = {};
  for (std::size_t i = 0; i < own.parts.front().size(); ++i) {
    const int f = own.parts.front()[i], g = own.parts.back()[i];
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
