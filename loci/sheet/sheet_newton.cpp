#include "loci/sheet/sheet_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "loci/sheet/chain_rule.hpp"

namespace clearloci::loci::sheet {

namespace {

constexpr int most_newton_steps = 10;
/// Steps this small, in parts of the sizes, are rounding.
constexpr double newton_converged = 1e-12;
/// Where rounding is larger, after all steps.
constexpr double newton_accepted = 1e-10;
/// Of an equation that is a sum of others, to rounding.
constexpr double dependent = 1e-13;
/// Roots of the other sign that are larger than this, in parts of their size, are those of another sheet.
constexpr double clear_of_rim = 1e-9;

}  // namespace

SheetNewton::SheetNewton(const core::RootTower& tower, core::WorkingMode mode,
                         const std::vector<SheetFunction>& functions, std::vector<double> sizes)
    : program_(tower, functions),
      registers_(program_.registers<double>()),
      mode_(std::move(mode)),
      sizes_(std::move(sizes)),
      point_(static_cast<std::size_t>(program_.variables())),
      used_(static_cast<std::size_t>(program_.roots()), false) {
  const int n = program_.coordinates();
  for (int j = 0; j < program_.roots(); ++j) {
    const core::Root& root = tower.roots[static_cast<std::size_t>(j)];
    std::vector<bool>& depends = on_.emplace_back(used_.size(), false);
    for (int k = 0; k < j; ++k)
      depends[static_cast<std::size_t>(k)] =
          core::depends_on(root.square, n + k) || (!root.line.empty() && core::depends_on(root.line, n + k));
    for (int f = 0; f < program_.functions(); ++f)
      used_[static_cast<std::size_t>(j)] = used_[static_cast<std::size_t>(j)] || program_.depends(f, n + j);
  }
  sizes_.resize(point_.size(), 1.0);
}

/// Beyond the rim with the root of |Q|: Newton's method then returns to the sheet, or goes on to the other one.
void SheetNewton::lift(std::span<const double> place) {
  const int n = program_.coordinates();
  for (int v = 0; v < n; ++v) {
    point_[static_cast<std::size_t>(v)] = place[static_cast<std::size_t>(v)];
    registers_.set(v, place[static_cast<std::size_t>(v)]);
  }
  for (int j = 0; j < program_.roots(); ++j) {
    registers_.run_square(j);
    const double root = mode_[static_cast<std::size_t>(j)] * std::sqrt(std::abs(registers_.square(j)));
    point_[static_cast<std::size_t>(n) + static_cast<std::size_t>(j)] = root;
    registers_.set(n + j, root);
  }
}

/// By how much the square changes over the sizes of what is before it; registers hold the gradients.
double SheetNewton::square_slope(int root) {
  double sum = 0;
  for (int v = 0; v < program_.coordinates() + root; ++v)
    sum += std::pow(registers_.square_partial(root, v) * sizes_[static_cast<std::size_t>(v)], 2);
  return std::sqrt(sum);
}

void SheetNewton::measure_roots() {
  registers_.run_values();
  registers_.run_gradients();
  for (int j = 0; j < program_.roots(); ++j) {
    const auto variable = static_cast<std::size_t>(program_.coordinates()) + static_cast<std::size_t>(j);
    const double size = std::max(std::abs(point_[variable]), std::sqrt(square_slope(j)));
    sizes_[variable] = size > 0 && std::isfinite(size) ? size : 1;
  }
}

void SheetNewton::need_roots(std::span<const Held> held) {
  const int n = program_.coordinates();
  needed_ = used_;
  for (const Held& one : held)
    if (one.variable >= n) needed_[static_cast<std::size_t>(one.variable - n)] = true;
  for (std::size_t j = needed_.size(); j-- > 0;)
    for (std::size_t k = 0; needed_[j] && k < j; ++k) needed_[k] = needed_[k] || on_[j][k];
  unknowns_.clear();
  for (int v = 0; v < n; ++v) unknowns_.push_back(v);
  for (int j = 0; j < program_.roots(); ++j)
    if (needed_[static_cast<std::size_t>(j)]) unknowns_.push_back(n + j);
}

/// The least step u with rows u = the last column: u = rows^T y, (rows rows^T) y = the last column.
bool SheetNewton::solve() {
  const std::size_t width = unknowns_.size() + 1;
  for (std::size_t r = 0; r < equations_; ++r) {
    double* const row = rows_.data() + r * width;
    double norm = 0;
    for (std::size_t c = 0; c + 1 < width; ++c) norm += row[c] * row[c];
    norm = std::sqrt(norm);
    if (!(norm > 0) || !std::isfinite(norm)) return false;
    for (std::size_t c = 0; c < width; ++c) row[c] /= norm;
  }
  const std::size_t across = equations_ + 1;
  normal_.assign(equations_ * across, 0.0);
  for (std::size_t r = 0; r < equations_; ++r) {
    for (std::size_t k = 0; k < equations_; ++k)
      for (std::size_t c = 0; c + 1 < width; ++c)
        normal_[r * across + k] += rows_[r * width + c] * rows_[k * width + c];
    normal_[r * across + equations_] = rows_[r * width + width - 1];
  }
  for (std::size_t p = 0; p < equations_; ++p) {  // symmetric and definite: no pivots are looked for
    const double pivot = normal_[p * across + p];
    if (!(pivot > dependent)) return false;
    for (std::size_t r = p + 1; r < equations_; ++r) {
      const double factor = normal_[r * across + p] / pivot;
      for (std::size_t c = p; c < across; ++c) normal_[r * across + c] -= factor * normal_[p * across + c];
    }
  }
  step_.assign(width - 1, 0.0);
  for (std::size_t p = equations_; p-- > 0;) {
    double value = normal_[p * across + equations_];
    for (std::size_t c = p + 1; c < equations_; ++c)
      value -= normal_[p * across + c] * normal_[c * across + equations_];
    value /= normal_[p * across + p];
    normal_[p * across + equations_] = value;
    for (std::size_t c = 0; c + 1 < width; ++c) step_[c] += value * rows_[p * width + c];
  }
  return true;
}

bool SheetNewton::move(std::span<double> place, std::span<const Held> held) {
  const int n = program_.coordinates();
  lift(place);
  measure_roots();
  need_roots(held);
  const std::size_t width = unknowns_.size() + 1;
  for (int count = 1; count <= most_newton_steps; ++count) {
    rows_.clear();
    const auto add_row = [&](auto&& slope, double residual) {
      for (const int v : unknowns_) rows_.push_back(slope(v) * sizes_[static_cast<std::size_t>(v)]);
      rows_.push_back(-residual);
    };
    for (int f = 0; f < program_.functions(); ++f)
      add_row([&](int v) { return registers_.partial(f, v); }, registers_.value(f));
    for (const Held& one : held)
      add_row([&](int v) { return v == one.variable ? 1.0 : 0.0; },
              point_[static_cast<std::size_t>(one.variable)] - one.value);
    for (int j = 0; j < program_.roots(); ++j) {
      if (!needed_[static_cast<std::size_t>(j)]) continue;
      const double root = point_[static_cast<std::size_t>(n) + static_cast<std::size_t>(j)];
      add_row([&](int v) { return (v == n + j ? 2 * root : 0.0) - registers_.square_partial(j, v); },
              root * root - registers_.square(j));
    }
    equations_ = rows_.size() / width;
    if (equations_ > unknowns_.size() || !solve()) return false;
    double length = 0;
    for (std::size_t c = 0; c < unknowns_.size(); ++c) {
      const auto v = static_cast<std::size_t>(unknowns_[c]);
      length = std::max(length, std::abs(step_[c]));
      point_[v] += step_[c] * sizes_[v];
    }
    if (!std::isfinite(length)) return false;
    for (int v = 0; v < n; ++v)
      if (std::abs(point_[static_cast<std::size_t>(v)] - place[static_cast<std::size_t>(v)]) >
          farthest * sizes_[static_cast<std::size_t>(v)])
        return false;
    if (length <= (count < most_newton_steps ? newton_converged : newton_accepted)) {
      std::copy_n(point_.begin(), n, place.begin());
      return true;
    }
    for (int v = 0; v < program_.variables(); ++v) registers_.set(v, point_[static_cast<std::size_t>(v)]);
    for (int j = 0; j < program_.roots(); ++j) registers_.run_square(j);
    registers_.run_values();
    registers_.run_gradients();
  }
  return false;
}

bool SheetNewton::is_on_sheet(std::span<const double> place) {
  const int n = program_.coordinates();
  for (int j = 0; j < program_.roots(); ++j) {
    if (!needed_[static_cast<std::size_t>(j)]) continue;
    const auto variable = static_cast<std::size_t>(n) + static_cast<std::size_t>(j);
    if (!(mode_[static_cast<std::size_t>(j)] * point_[variable] >= -clear_of_rim * sizes_[variable])) return false;
  }
  lift(place);
  registers_.run_values();
  registers_.run_gradients();
  for (int j = 0; j < program_.roots(); ++j) {
    const double square = registers_.square(j);
    if (!std::isfinite(square) || square < -clear_of_rim * square_slope(j)) return false;
  }
  return true;
}

double SheetNewton::distance(std::span<const double> place) {
  lift(place);
  measure_roots();
  need_roots({});
  const int n = program_.coordinates();
  std::vector<double> slopes(point_.size());
  for (std::size_t v = 0; v < slopes.size(); ++v) slopes[v] = registers_.partial(0, static_cast<int>(v));
  double half = 0;
  const auto half_inverse = [&](int j) {
    half = 1 / (2 * point_[static_cast<std::size_t>(n) + static_cast<std::size_t>(j)]);
    return &half;
  };
  eliminate_roots(slopes, n, half_inverse, [&](int j, int v) { return registers_.square_partial(j, v); });
  double sum = 0;
  for (int v = 0; v < n; ++v)
    sum += std::pow(slopes[static_cast<std::size_t>(v)] * sizes_[static_cast<std::size_t>(v)], 2);
  const double result = std::abs(registers_.value(0)) / std::sqrt(sum);
  return std::isfinite(result) ? result : std::numeric_limits<double>::infinity();
}

SheetNewton::NearestRoot SheetNewton::nearest_root(std::span<const double> place) {
  lift(place);
  measure_roots();
  NearestRoot nearest;
  for (int j = 0; j < program_.roots(); ++j) {
    const double distance = std::abs(registers_.square(j)) / square_slope(j);
    if (std::isfinite(distance) && (nearest.root < 0 || distance < nearest.distance)) nearest = {j, distance};
  }
  return nearest;
}

}  // namespace clearloci::loci::sheet
