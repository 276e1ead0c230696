#include "loci/sheet/sheet_follower.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::loci::sheet {

namespace {

constexpr int most_steps = 12;
// Steps this small, relative to the region, are rounding.
constexpr double converged = 1e-15;
// Next steps that are smaller than this share of what is asked for are not taken.
constexpr double beyond_need = 1e-3;

}  // namespace

double dot(const LiftedPoint& a, const LiftedPoint& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

SheetFollower::SheetFollower(const SheetProgram& program, double size)
    : program_(&program),
      registers_(program.registers<double>()),
      size_(size),
      n_(program.variables()),
      residual_(n_),
      entries_(static_cast<std::size_t>(n_) * (n_ + 1)),
      rows_(n_) {
  for (int r = 0; r < n_; ++r) rows_[r] = entries_.data() + r * (n_ + 1);
}

void SheetFollower::evaluate(const LiftedPoint& point) {
  if (point != evaluated_) {
    evaluated_ = point;
    for (int v = 0; v < n_; ++v) registers_.set(v, point[v]);
    for (int j = 0; j < program_->roots(); ++j) registers_.run_square(j);
    registers_.run_values();
    registers_.run_gradients();
  }
  residual_[0] = registers_.value(0);
  for (int v = 0; v < n_; ++v) entry(0, v) = registers_.partial(0, v);
  for (int j = 0; j < program_->roots(); ++j) {
    residual_[1 + j] = point[2 + j] * point[2 + j] - registers_.square(j);
    for (int v = 0; v < n_; ++v) entry(1 + j, v) = -registers_.square_partial(j, v);
    entry(1 + j, 2 + j) += 2 * point[2 + j];
  }
}

bool SheetFollower::correct(LiftedPoint& point, const LiftedPoint& row, double value, double within) {
  const int coordinates = program_->coordinates();
  double last = 0;
  for (int step = 0; step < most_steps; ++step) {
    evaluate(point);
    for (int r = 0; r + 1 < n_; ++r) entry(r, n_) = -residual_[r];
    std::copy(row.begin(), row.end(), rows_[n_ - 1]);
    entry(n_ - 1, n_) = value - dot(row, point);
    for (int r = 0; r < n_; ++r) {
      double largest = 0;
      for (int c = 0; c < n_; ++c) largest = std::max(largest, std::abs(entry(r, c)));
      if (largest == 0) return false;
      for (int c = 0; c <= n_; ++c) entry(r, c) /= largest;
    }
    for (int c = 0; c < n_; ++c) {
      int pivot = c;
      for (int r = c + 1; r < n_; ++r)
        if (std::abs(entry(r, c)) > std::abs(entry(pivot, c))) pivot = r;
      std::swap(rows_[pivot], rows_[c]);
      if (std::abs(entry(c, c)) < 1e-14) return false;
      for (int r = c + 1; r < n_; ++r) {
        const double factor = entry(r, c) / entry(c, c);
        if (factor == 0) continue;
        for (int k = c + 1; k <= n_; ++k) entry(r, k) -= factor * entry(c, k);
      }
    }
    double size = 0;
    for (int c = n_ - 1; c >= 0; --c) {
      double delta = entry(c, n_);
      for (int k = c + 1; k < n_; ++k) delta -= entry(c, k) * residual_[k];
      delta /= entry(c, c);
      residual_[c] = delta;  // reused for the step
      point[c] += delta;
      // Roots may be much larger than the region, and their rounding with them.
      size = std::max(
          size, c < coordinates ? std::abs(delta) : std::abs(delta) * size_ / std::max(size_, std::abs(point[c])));
    }
    if (!std::isfinite(size)) return false;
    if (size <= converged * size_) return true;
    // Newton's method converges quadratically: the next step would be about this large. The steps before may have
    // been along little curvature, and one alone tells nothing: no less is counted on than of a curve that bends over
    // no less than a thousandth of the region.
    const double bent = size * (size / size_);
    const double next = step > 0            ? std::max(bent, size * (size / last) * (size / last))
                        : within > accuracy ? bent
                                            : size;
    if (next <= beyond_need * within * size_) return true;
    if (step > 2 && size > 0.5 * last) return size <= within * size_;
    last = size;
  }
  return last <= within * size_;
}

LiftedPoint SheetFollower::tangent(const LiftedPoint& point) {
  evaluate(point);
  std::vector<int> order(n_);  // columns, pivots first
  for (int c = 0; c < n_; ++c) order[c] = c;
  for (int r = 0; r + 1 < n_; ++r) {
    double largest = 0;
    for (int c = 0; c < n_; ++c) largest = std::max(largest, std::abs(entry(r, c)));
    if (largest == 0) return {};
    for (int c = 0; c < n_; ++c) entry(r, c) /= largest;
  }
  for (int r = 0; r + 1 < n_; ++r) {
    int best_row = r, best_column = r;
    double best = 0;
    for (int i = r; i + 1 < n_; ++i)
      for (int c = r; c < n_; ++c)
        if (std::abs(entry(i, order[c])) > best) best = std::abs(entry(i, order[c])), best_row = i, best_column = c;
    if (best < 1e-14) return {};
    std::swap(rows_[r], rows_[best_row]);
    std::swap(order[r], order[best_column]);
    for (int i = r + 1; i + 1 < n_; ++i) {
      const double factor = entry(i, order[r]) / entry(r, order[r]);
      for (int c = r; c < n_; ++c) entry(i, order[c]) -= factor * entry(r, order[c]);
    }
  }
  LiftedPoint result(n_);
  result[order[n_ - 1]] = 1;
  for (int r = n_ - 2; r >= 0; --r) {
    double sum = 0;
    for (int c = r + 1; c < n_; ++c) sum -= entry(r, order[c]) * result[order[c]];
    result[order[r]] = sum / entry(r, order[r]);
  }
  const double norm = std::sqrt(dot(result, result));
  for (double& entry : result) entry /= norm;
  return result;
}

}  // namespace clearloci::loci::sheet
