#include "loci/sheet/pose_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clearloci::loci::pose {

PosePoint::PosePoint(const core::PoseStatics& statics)
    : statics_(&statics),
      n_(static_cast<std::size_t>(statics.unknowns)),
      values_(statics.program),
      matrix_(n_ * n_),
      solution_(statics.loads, std::vector<double>(n_)) {
  using Operation = core::PoseProgram::Operation;
  for (const core::PoseProgram::Step& step : statics.program.steps)
    if (step.operation == Operation::square_root && step.varies) closures_.push_back(step.first);
  closures_.insert(closures_.end(), statics.positive.begin(), statics.positive.end());
}

bool PosePoint::within_limits() const {
  return std::all_of(statics_->positive.begin(), statics_->positive.end(), [&](int limit) { return step(limit) > 0; });
}

/// Gauss with partial pivoting, of A and of all loads together.
bool PosePoint::solve(At& result) {
  std::fill(matrix_.begin(), matrix_.end(), 0.0);
  for (std::size_t i = 0; i < n_; ++i) {
    const core::LinearRow& row = statics_->equations[i];
    for (const core::LinearRow::Term& term : row.terms)
      matrix_[i * n_ + static_cast<std::size_t>(term.unknown)] = step(term.step);
    for (std::size_t load = 0; load < statics_->loads; ++load) solution_[load][i] = step(row.free[load]);
  }
  result.determinant = 1;
  for (std::size_t k = 0; k < n_; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n_; ++i)
      if (std::abs(matrix_[i * n_ + k]) > std::abs(matrix_[pivot * n_ + k])) pivot = i;
    const double value = matrix_[pivot * n_ + k];
    if (value == 0 || !std::isfinite(value)) return false;
    if (value < 0) result.determinant = -result.determinant;
    result.logarithm += std::log(std::abs(value));
    if (pivot != k) {
      result.determinant = -result.determinant;
      std::swap_ranges(matrix_.begin() + static_cast<std::ptrdiff_t>(pivot * n_),
                       matrix_.begin() + static_cast<std::ptrdiff_t>((pivot + 1) * n_),
                       matrix_.begin() + static_cast<std::ptrdiff_t>(k * n_));
      for (std::vector<double>& column : solution_) std::swap(column[pivot], column[k]);
    }
    for (std::size_t i = k + 1; i < n_; ++i) {
      const double factor = matrix_[i * n_ + k] / value;
      if (factor == 0) continue;
      for (std::size_t j = k + 1; j < n_; ++j) matrix_[i * n_ + j] -= factor * matrix_[k * n_ + j];
      for (std::vector<double>& column : solution_) column[i] -= factor * column[k];
    }
  }
  for (std::vector<double>& column : solution_)
    for (std::size_t i = n_; i-- > 0;) {
      for (std::size_t j = i + 1; j < n_; ++j) column[i] -= matrix_[i * n_ + j] * column[j];
      column[i] /= matrix_[i * n_ + i];
      if (!std::isfinite(column[i])) return false;
    }
  return true;
}

std::optional<PosePoint::At> PosePoint::at(const std::vector<double>& pose) {
  return values_.run(pose, statics_->sheet.start) ? solved() : std::nullopt;
}

std::optional<PosePoint::At> PosePoint::at(const std::vector<double>& pose, core::BlockUnknowns& unknowns) {
  // Of moves near rounding the ratio of two says nothing.
  constexpr double quick = 0.25, near = 0.1, hardly = 1e-9;
  if (!values_.close(pose, unknowns)) return std::nullopt;
  const double moved = values_.moved() / core::size_of(statics_->program, unknowns);
  if (moved > near || (moved > hardly && values_.contraction() > quick)) return std::nullopt;
  return solved();
}

std::optional<PosePoint::At> PosePoint::solved() {
  At result;
  result.orientation = values_.orientation();
  if (!within_limits() || !solve(result)) return std::nullopt;
  for (const int closure : closures_) result.closures.push_back(step(closure));
  for (const core::PoseDemand& demand : statics_->demands) {
    auto& by_load = result.components.emplace_back(statics_->loads);
    for (std::size_t load = 0; load < statics_->loads; ++load)
      for (const core::LinearRow& row : demand.components) {
        double value = step(row.free[load]);
        for (const core::LinearRow::Term& term : row.terms)
          value += step(term.step) * solution_[load][static_cast<std::size_t>(term.unknown)];
        by_load[load].push_back(value);
      }
  }
  return result;
}

}  // namespace clearloci::loci::pose
