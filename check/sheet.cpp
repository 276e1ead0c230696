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
  if (matrix.size() == 2) return matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
  Interval sum(matrix[0][0].bits());
  for (std::size_t skipped = 0; skipped < matrix.size(); ++skipped) {
    std::vector<std::vector<Interval>> minor;
    for (std::size_t row = 1; row < matrix.size(); ++row) {
      minor.emplace_back();
      for (std::size_t column = 0; column < matrix.size(); ++column)
        if (column != skipped) minor.back().push_back(matrix[row][column]);
    }
    const Interval term = matrix[0][skipped] * determinant(minor);
    sum = skipped % 2 == 0 ? sum + term : sum - term;
  }
  return sum;
}

Sheet::Sheet(const SheetParts& parts, const std::vector<const StraightLine*>& functions, mpfr_prec_t bits)
    : parts_(parts), bits_(bits) {
  const std::size_t roots = parts_.squares->size();
  used_.assign(roots, false);
  is_zero_.assign(roots, false);
  for (const int j : parts_.at_zero) is_zero_.at(static_cast<std::size_t>(j)) = true;
  const auto use = [&](const StraightLine& line) {
    for (std::size_t j = 0; j < roots; ++j)
      used_[j] = used_[j] || (!is_zero_[j] && core::depends_on(line, 2 + static_cast<int>(j)));
  };
  for (const StraightLine* function : functions) use(*function);
  for (std::size_t j = roots; j-- > 0;)
    if (used_[j]) use((*parts_.squares)[j]);
  values_.assign(2 + roots, Interval(bits_));
  squares_.assign(roots, Interval(bits_));
  square_results_.assign(roots, 0);
  for (std::size_t j = 0; j < roots; ++j) {
    if (used_[j]) square_results_[j] = append((*parts_.squares)[j]);
    stage_end_.push_back(steps_.size());
  }
  for (const StraightLine* function : functions) results_.push_back(append(*function));
  stage_end_.push_back(steps_.size());
  scratch_ = values_;
  depends_.assign(values_.size(), 0);
  const std::size_t variables = 2 + roots;
  partials_.assign(values_.size(), {});
  for (std::size_t v = 0; v < variables; ++v) {
    partials_[v].assign(variables, Interval(bits_));
    partials_[v][v] = Interval(1.0, bits_);
    depends_[v] = 1u << v;
    if (v >= 2 && is_zero_[v - 2]) depends_[v] = 0;
  }
  for (const Step& step : steps_) {
    partials_[step.result].assign(variables, Interval(bits_));
    depends_[step.result] = depends_[step.first] | depends_[step.second];
  }
  square_partials_.assign(roots, {});
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

void Sheet::run(std::size_t begin, std::size_t end, std::vector<Interval>& values) const {
  for (std::size_t i = begin; i < end; ++i) {
    const Step& step = steps_[i];
    mpfi_srcptr a = values[step.first].get();
    mpfi_srcptr b = values[step.second].get();
    mpfi_ptr r = values[step.result].get();
    switch (step.operation) {
      case Operation::add:
        mpfi_add(r, a, b);
        break;
      case Operation::subtract:
        mpfi_sub(r, a, b);
        break;
      case Operation::multiply:
        if (step.first == step.second)
          mpfi_sqr(r, a);
        else
          mpfi_mul(r, a, b);
        break;
      case Operation::inverse:
        mpfi_inv(r, a);
        break;
      case Operation::constant:
      case Operation::variable:
        break;
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
  std::size_t begin = 0;
  for (std::size_t j = 0; j < used_.size(); ++j) {
    if (!used_[j]) continue;
    run(begin, stage_end_[j], values_);
    begin = stage_end_[j];
    squares_[j] = values_[square_results_[j]];
    if (squares_[j].below()) return false;
    set_root(j, static_cast<int>(j) == lift || !(squares_[j].lower() > lift_ratio * squares_[j].upper()));
  }
  run(begin, stage_end_.back(), values_);
  return true;
}

bool Sheet::enter_local(const std::vector<Interval>& local, const std::vector<int>& lifted) {
  values_[0] = local[0];
  values_[1] = local[1];
  local_ = local;
  lifted_ = lifted;
  std::size_t begin = 0, next = 0;
  for (std::size_t j = 0; j < used_.size(); ++j) {
    if (!used_[j]) continue;
    run(begin, stage_end_[j], values_);
    begin = stage_end_[j];
    squares_[j] = values_[square_results_[j]];
    if (next < lifted.size() && lifted[next] == static_cast<int>(j)) {
      values_[2 + j] = local_[2 + next++];
      continue;
    }
    if (squares_[j].sign() <= 0) return false;
    set_root(j, false);
  }
  run(begin, stage_end_.back(), values_);
  return true;
}

bool Sheet::is_inner() const {
  for (std::size_t j = 0; j < used_.size(); ++j)
    if (used_[j] && squares_[j].sign() <= 0) return false;
  return true;
}

void Sheet::run_slopes(std::size_t begin, std::size_t end) {
  const std::size_t variables = 2 + used_.size();
  Interval product(bits_);
  for (std::size_t i = begin; i < end; ++i) {
    const auto& [operation, a, b, r] = steps_[i];
    for (std::size_t v = 0; v < variables; ++v) {
      const bool in_a = (depends_[a] >> v & 1u) != 0, in_b = (depends_[b] >> v & 1u) != 0;
      if (!in_a && !in_b) continue;
      mpfi_ptr slope = partials_[r][v].get();
      switch (operation) {
        case Operation::add:
        case Operation::subtract:
          if (in_a)
            mpfi_set(slope, partials_[a][v].get());
          else
            mpfi_set_ui(slope, 0);
          if (in_b && operation == Operation::add) mpfi_add(slope, slope, partials_[b][v].get());
          if (in_b && operation == Operation::subtract) mpfi_sub(slope, slope, partials_[b][v].get());
          break;
        case Operation::multiply:
          if (a == b) {
            mpfi_mul(slope, partials_[a][v].get(), values_[a].get());
            mpfi_mul_2ui(slope, slope, 1);
            break;
          }
          mpfi_set_ui(slope, 0);
          if (in_a) mpfi_mul(slope, partials_[a][v].get(), values_[b].get());
          if (in_b) mpfi_mul(product.get(), values_[a].get(), partials_[b][v].get());
          if (in_b) mpfi_add(slope, slope, product.get());
          break;
        case Operation::inverse:
          mpfi_sqr(product.get(), values_[r].get());
          mpfi_mul(slope, partials_[a][v].get(), product.get());
          mpfi_neg(slope, slope);
          break;
        case Operation::constant:
        case Operation::variable:
          break;
      }
    }
  }
}

/// Roots that are not lifted are functions of what comes before them.
std::vector<Interval> Sheet::along_local(std::vector<Interval> partials) const {
  const auto is_lifted = [&](std::size_t j) {
    return std::find(lifted_.begin(), lifted_.end(), static_cast<int>(j)) != lifted_.end();
  };
  for (std::size_t j = used_.size(); j-- > 0;) {
    if (!used_[j] || is_lifted(j)) continue;
    const Interval factor = partials[2 + j] * (Interval(0.5, bits_) / values_[2 + j]);
    for (std::size_t v = 0; v < 2 + j; ++v)
      if ((depends_[square_results_[j]] >> v & 1u) != 0) partials[v] = partials[v] + factor * square_partials_[j][v];
  }
  std::vector<Interval> slopes = {partials[0], partials[1]};
  for (const int j : lifted_) slopes.push_back(partials[2 + static_cast<std::size_t>(j)]);
  return slopes;
}

void Sheet::differentiate() {
  run_slopes(0, steps_.size());
  const std::size_t variables = 2 + used_.size();
  const auto partials_of = [&](std::size_t value) {
    std::vector<Interval> partials;
    for (std::size_t v = 0; v < variables; ++v)
      partials.push_back((depends_[value] >> v & 1u) != 0 ? partials_[value][v] : Interval(bits_));
    return partials;
  };
  for (std::size_t j = 0; j < used_.size(); ++j)
    if (used_[j]) square_partials_[j] = partials_of(square_results_[j]);
  projected_.clear();
  for (const std::size_t result : results_) projected_.push_back(along_local(partials_of(result)));
  bonds_.clear();
  for (const int lifted : lifted_) {
    const auto j = static_cast<std::size_t>(lifted);
    std::vector<Interval> partials;
    for (const Interval& partial : square_partials_[j]) partials.push_back(-partial);
    partials[2 + j] = partials[2 + j] + Interval(2.0, bits_) * values_[2 + j];
    bonds_.push_back(along_local(std::move(partials)));
  }

  for (std::size_t v = 0; v < 2; ++v) scratch_[v] = middle(static_cast<int>(v));
  middle_bonds_.clear();
  std::size_t begin = 0, next = 0;
  for (std::size_t j = 0; j < used_.size(); ++j) {
    if (!used_[j]) continue;
    run(begin, stage_end_[j], scratch_);
    begin = stage_end_[j];
    const Interval& square = scratch_[square_results_[j]];
    if (next < lifted_.size() && lifted_[next] == static_cast<int>(j)) {
      scratch_[2 + j] = middle(2 + static_cast<int>(next++));
      middle_bonds_.push_back(squared(scratch_[2 + j]) - square);
    } else {
      const Interval root = root_of(square);
      scratch_[2 + j] = meet(parts_.signs[j] > 0 ? root : -root, values_[2 + j]);
    }
  }
  run(begin, stage_end_.back(), scratch_);
  middle_values_.clear();
  for (const std::size_t result : results_) middle_values_.push_back(scratch_[result]);
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

}  // namespace clearloci::check
