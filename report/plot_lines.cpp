#include "report/plot_lines.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace clearloci::report {

core::Polyline line(const std::vector<double>& x, const std::vector<double>& y, double factor) {
  core::Polyline points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], factor * y[i]});
  return points;
}

core::Polyline angle_line(const std::vector<double>& x, const std::vector<double>& y) {
  constexpr double degrees = 180 / std::numbers::pi, nan = std::numeric_limits<double>::quiet_NaN();
  core::Polyline points;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i > 0 && std::abs(y[i] - y[i - 1]) > 1.5 * std::numbers::pi) points.push_back({nan, nan});
    points.push_back({x[i], degrees * y[i]});
  }
  return points;
}

std::vector<double> lengths(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < x.size(); ++i) sizes.push_back(std::hypot(x[i], y[i]));
  return sizes;
}

}  // namespace clearloci::report
