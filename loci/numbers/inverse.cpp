#include "loci/numbers/inverse.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clearloci::loci {

bool invert(std::span<double> a, std::span<double> y, std::size_t n, double least_pivot, int* sign) {
  if (sign) *sign = 1;
  std::fill(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n * n), 0.0);
  for (std::size_t i = 0; i < n; ++i) y[i * n + i] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k])) pivot = i;
    const double value = a[pivot * n + k], scale = 1 / value;
    if (!std::isfinite(scale)) return false;
    double largest = 0;
    for (std::size_t j = k; j < n && least_pivot > 0; ++j) largest = std::max(largest, std::abs(a[pivot * n + j]));
    if (!(std::abs(value) > least_pivot * largest)) return false;
    if (sign && (value < 0) != (pivot != k)) *sign = -*sign;
    for (std::size_t j = 0; j < n && pivot != k; ++j) {
      std::swap(a[pivot * n + j], a[k * n + j]);
      std::swap(y[pivot * n + j], y[k * n + j]);
    }
    for (std::size_t j = 0; j < n; ++j) a[k * n + j] *= scale, y[k * n + j] *= scale;
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = a[i * n + k];
      if (i == k || factor == 0) continue;
      for (std::size_t j = 0; j < n; ++j) {
        a[i * n + j] -= factor * a[k * n + j];
        y[i * n + j] -= factor * y[k * n + j];
      }
    }
  }
  return std::all_of(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n * n),
                     [](double x) { return std::isfinite(x); });
}

}  // namespace clearloci::loci
