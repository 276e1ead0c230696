#include "check/sheet.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace clearloci::check {

using core::StraightLine;
using Operation = core::StraightLine::Operation;

// A root is lifted where its square varies by more than this ratio over the cell.
constexpr double lift_ratio = 0.25;

Interval determinant(const std::vector<std::vector<Interval>>& matrix) {
  if (matrix.size() == 1) return matrix[0][0];
  Interval sum(matrix[0][0].bits());
  for (std::size_t skipped = 0; skipped < matrix.size(); ++skipped) {
    std::vector<std::vector<Interval>> minor(matrix.begin() + 1, matrix.end());
    for (auto& row : minor) row.erase(row.begin() + static_cast<std::ptrdiff_t>(skipped));
    const Interval term = matrix[0][skipped] * determinant(minor);
    sum = skipped % 2 == 0 ? sum + term : sum - term;
  }
  return sum;
}

Sheet::Sheet(const SheetParts& parts, const std::vector<const StraightLine*>& functions, mpfr_prec_t bits)
    : parts_(parts), bits_(bits) {
  const std::size_t roots = parts_.squares->size();
  const auto is_zero = [&](std::size_t j) {
    return std::find(parts_.at_zero.begin(), parts_.at_zero.end(), static_cast<int>(j)) != parts_.at_zero.end();
  };
  used_.assign(roots, false);
  const auto use = [&](const StraightLine& line) {
    for (std::size_t j = 0; j < roots; ++j)
      used_[j] = used_[j] || (!is_zero(j) && core::depends_on(line, 2 + static_cast<int>(j)));
  };
  for (const StraightLine* function : functions) use(*function);
  bounds_only_.assign(roots, false);
  for (const auto& [angle, limit] : parts_.slits) {
    const auto end = static_cast<std::size_t>(limit);
    bounds_only_[end] = !used_[end] && used_[static_cast<std::size_t>(angle)] && !is_zero(end);
    used_[end] = used_[end] || bounds_only_[end];
  }
  for (std::size_t j = roots; j-- > 0;)
    if (used_[j]) use((*parts_.squares)[j]);
  values_.assign(2 + roots, Interval(bits_));
  for (std::size_t v = 0; v < values_.size(); ++v) is_constant_.push_back(v >= 2 && is_zero(v - 2));
  squares_.assign(roots, Interval(bits_));
  square_results_.assign(roots, 0);
  for (std::size_t j = 0; j < roots; ++j) {
    if (used_[j]) square_results_[j] = append((*parts_.squares)[j]);
    stage_end_.push_back(steps_.size());
  }
  for (const StraightLine* function : functions) results_.push_back(append(*function));
  stage_end_.push_back(steps_.size());
  middle_values_ = values_;
  slopes_.assign(values_.size(), std::vector<Interval>(2 + roots, Interval(bits_)));
}

std::size_t Sheet::append(const StraightLine& line) {
  std::vector<std::size_t> place;
  for (const StraightLine::Step& step : line.steps) {
    if (step.operation == Operation::variable) {
      place.push_back(static_cast<std::size_t>(step.first));
      continue;
    }
    place.push_back(values_.size());
    values_.emplace_back(bits_);
    is_constant_.push_back(step.operation == Operation::constant);
    if (step.operation == Operation::constant) {
      const core::Rational lower = step.value() - step.radius(), upper = step.value() + step.radius();
      mpfi_interv_q(values_.back().get(), lower.get_mpq_t(), upper.get_mpq_t());
      continue;
    }
    const std::size_t first = place.at(static_cast<std::size_t>(step.first));
    const bool one = step.operation == Operation::inverse;
    steps_.push_back(
        {step.operation, first, one ? first : place.at(static_cast<std::size_t>(step.second)), place.back()});
  }
  return place.back();
}

/// The steps of a root's square, or the functions'.
void Sheet::run(std::size_t stage, std::vector<Interval>& values) const {
  for (std::size_t i = stage == 0 ? 0 : stage_end_[stage - 1]; i < stage_end_[stage]; ++i) {
    const Step& step = steps_[i];
    mpfi_srcptr a = values[step.first].get();
    mpfi_srcptr b = values[step.second].get();
    mpfi_ptr r = values[step.result].get();
    if (step.operation == Operation::add)
      mpfi_add(r, a, b);
    else if (step.operation == Operation::subtract)
      mpfi_sub(r, a, b);
    else if (step.operation == Operation::inverse)
      mpfi_inv(r, a);
    else if (step.operation == Operation::angle)
      values[step.result] = angle_of(values[step.first], values[step.second]);
    else if (step.first == step.second)
      mpfi_sqr(r, a);
    else
      mpfi_mul(r, a, b);
  }
}

void Sheet::run_slopes(std::size_t stage) {
  Interval product(bits_);
  for (std::size_t i = stage == 0 ? 0 : stage_end_[stage - 1]; i < stage_end_[stage]; ++i) {
    const auto& [operation, a, b, r] = steps_[i];
    const bool in_a = !is_constant_[a], in_b = !is_constant_[b] && operation != Operation::inverse;
    for (std::size_t c = 0; c < local_.size(); ++c) {
      mpfi_ptr slope = slopes_[r][c].get();
      mpfi_srcptr da = slopes_[a][c].get();
      mpfi_srcptr db = slopes_[b][c].get();
      mpfi_set_ui(slope, 0);
      if (operation == Operation::multiply) {
        if (in_a) mpfi_mul(slope, da, values_[b].get());
        if (in_b) mpfi_mul(product.get(), values_[a].get(), db);
        if (in_b) mpfi_add(slope, slope, product.get());
      } else if (operation == Operation::angle) {  // of (y, x): (x dy - y dx) / (x^2 + y^2)
        if (in_a) mpfi_mul(slope, da, values_[b].get());
        if (in_b) mpfi_mul(product.get(), values_[a].get(), db);
        if (in_b) mpfi_sub(slope, slope, product.get());
        mpfi_mul(slope, slope, angle_slope(values_[a], values_[b]).get());
      } else if (operation == Operation::inverse) {
        mpfi_sqr(product.get(), values_[r].get());
        mpfi_mul(slope, da, product.get());
        mpfi_neg(slope, slope);
      } else {
        if (in_a) mpfi_set(slope, da);
        if (in_b && operation == Operation::add) mpfi_add(slope, slope, db);
        if (in_b && operation == Operation::subtract) mpfi_sub(slope, slope, db);
      }
    }
  }
}

void Sheet::set_root(std::size_t j, bool lift) {
  const Interval root = root_of(squares_[j]);
  values_[2 + j] = parts_.signs.at(j) > 0 ? root : -root;
  if (!lift) return;
  lifted_.push_back(static_cast<int>(j));
  local_.push_back(values_[2 + j]);
}

bool Sheet::enter(const Interval& x, const Interval& y, int lift) {
  if (parts_.deadline && std::chrono::steady_clock::now() > *parts_.deadline)
    throw core::LimitReached("the time limit was reached before every claim was looked at");
  values_[0] = x;
  values_[1] = y;
  local_ = {x, y};
  lifted_.clear();
  for (std::size_t j = 0; j < used_.size(); ++j) {
    if (!used_[j]) continue;
    run(j, values_);
    squares_[j] = values_[square_results_[j]];
    if (squares_[j].below()) return false;
    const bool varies = !(squares_[j].lower() > lift_ratio * squares_[j].upper());
    set_root(j, static_cast<int>(j) == lift || (varies && !bounds_only_[j]));
  }
  run(used_.size(), values_);
  return true;
}

bool Sheet::enter_local(const std::vector<Interval>& local, const std::vector<int>& lifted) {
  values_[0] = local[0];
  values_[1] = local[1];
  local_ = local;
  lifted_ = lifted;
  std::size_t next = 0;
  for (std::size_t j = 0; j < used_.size(); ++j) {
    if (!used_[j]) continue;
    run(j, values_);
    squares_[j] = values_[square_results_[j]];
    if (next < lifted.size() && lifted[next] == static_cast<int>(j)) {
      values_[2 + j] = local_[2 + next++];
      continue;
    }
    if (squares_[j].sign() <= 0) return false;
    set_root(j, false);
  }
  run(used_.size(), values_);
  return true;
}

bool Sheet::is_inner() const {
  for (std::size_t j = 0; j < used_.size(); ++j)
    if (used_[j] && squares_[j].sign() <= 0) return false;
  return true;
}

void Sheet::differentiate() {
  const auto unit = [&](std::size_t value, std::size_t coordinate) {
    for (std::size_t c = 0; c < local_.size(); ++c) slopes_[value][c] = Interval(c == coordinate ? 1.0 : 0.0, bits_);
  };
  for (const std::size_t v : {0u, 1u}) {
    unit(v, v);
    middle_values_[v] = middle(static_cast<int>(v));
  }
  bonds_.clear();
  middle_bonds_.clear();
  for (std::size_t j = 0; j < used_.size(); ++j) {
    if (!used_[j]) continue;
    run_slopes(j);
    run(j, middle_values_);
    const std::vector<Interval>& square = slopes_[square_results_[j]];
    const Interval& middle_square = middle_values_[square_results_[j]];
    Interval& root = middle_values_[2 + j];
    const std::size_t coordinate = 2 + bonds_.size();
    if (bonds_.size() < lifted_.size() && lifted_[bonds_.size()] == static_cast<int>(j)) {
      unit(2 + j, coordinate);
      bonds_.emplace_back();
      for (std::size_t c = 0; c < local_.size(); ++c) bonds_.back().push_back(-square[c]);
      bonds_.back()[coordinate] = bonds_.back()[coordinate] + Interval(2.0, bits_) * values_[2 + j];
      root = middle(static_cast<int>(coordinate));
      middle_bonds_.push_back(squared(root) - middle_square);
    } else {
      const Interval factor = Interval(0.5, bits_) / values_[2 + j];
      for (std::size_t c = 0; c < local_.size(); ++c) slopes_[2 + j][c] = factor * square[c];
      const Interval positive = root_of(middle_square);
      root = meet(parts_.signs[j] > 0 ? positive : -positive, values_[2 + j]);
    }
  }
  run_slopes(used_.size());
  run(used_.size(), middle_values_);
}

Interval Sheet::centred(int f) const {
  Interval sum = at_middle(f);
  for (int c = 0; c < dimension(); ++c) sum = sum + slope(f, c) * (local(c) - middle(c));
  return meet(sum, value(f));
}

Interval Sheet::tangent(int f, int c) const {
  std::vector<std::vector<Interval>> minor;
  for (int row = -1; row < static_cast<int>(lifted_.size()); ++row) {
    minor.emplace_back();
    for (int column = 0; column < dimension(); ++column)
      if (column != c) minor.back().push_back(row < 0 ? slope(f, column) : bond(row, column));
  }
  return determinant(minor);
}

/// By the slopes of what is left to the limit; the angle itself is any there.
bool Sheet::is_beyond_slit() const {
  return std::any_of(parts_.slits.begin(), parts_.slits.end(), [&](const auto& slit) {
    const auto limit = static_cast<std::size_t>(slit.second);
    if (!used_[limit]) return false;
    const std::size_t square = square_results_[limit];
    Interval left = middle_values_[square];
    for (int c = 0; c < dimension(); ++c)
      left = left + slopes_[square][static_cast<std::size_t>(c)] * (local(c) - middle(c));
    return left.below();
  });
}

bool Sheet::is_free(int f) {
  if (!value(f).contains_zero()) return true;
  differentiate();
  return !centred(f).contains_zero() || is_beyond_slit();
}

}  // namespace clearloci::check
