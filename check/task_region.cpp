#include "check/task_region.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "check/certificate.hpp"
#include "check/interval.hpp"
#include "check/plane.hpp"
#include "core/errors.hpp"

namespace clearloci::check {
namespace {

constexpr std::size_t most_cells_of_task = 1'000'000;
/// Of the whole: cells are not cut further.
constexpr double finest = 1e-9;

/// Where a cut helps most; all of them where the cell is too fine.
std::size_t chosen(const Cell& cell, const Cell& whole, const std::vector<double>& spreads) {
  constexpr double share_of_width = 1e-3;
  std::size_t best = cell.size();
  double most = -1, total = 0;
  for (const double spread : spreads) total += spread;
  if (!(total > 0) || !std::isfinite(total)) total = 1;
  for (std::size_t c = 0; c < cell.size(); ++c) {
    const double width = cell[c][1] - cell[c][0], all = whole[c][1] - whole[c][0];
    if (!(width > finest * all) || !(width > 0x1p-50 * std::max(std::abs(cell[c][0]), std::abs(cell[c][1])))) continue;
    const double spread = (std::isfinite(spreads[c]) ? spreads[c] : 0) + share_of_width * total * width / all;
    if (spread > most) {
      most = spread;
      best = c;
    }
  }
  return best;
}

}  // namespace

std::array<double, 2> around(const core::Rational& value) {
  const Interval interval(value, cell_bits);
  return {interval.lower(), interval.upper()};
}

bool ClaimedShape::is_shape(std::size_t coordinates) const {
  const std::size_t count = points.size();
  const bool round = name == "ball" || name == "circle";
  const bool counted = (name == "box" && count == 2) || (round && count == 1) || (name == "path" && count >= 2) ||
                       (name == "polygon" && count >= 3);
  if (!counted || margin < 0 || radius < 0) return false;
  if (!std::all_of(points.begin(), points.end(), [&](const auto& point) { return point.size() == coordinates; }))
    return false;
  if (name == "box") {
    for (std::size_t c = 0; c < coordinates; ++c)
      if (points[0][c] > points[1][c]) return false;
  }
  if (name != "polygon") return true;
  const auto [i, j] = across;
  if (i == j || i >= coordinates || j >= coordinates || (!above.empty() && above.size() != coordinates)) return false;
  for (const auto& point : points)
    for (std::size_t c = 0; c < coordinates; ++c)
      if (c != i && c != j && point[c] != points[0][c]) return false;
  return std::all_of(above.begin(), above.end(), [](const core::Rational& value) { return value >= 0; });
}

TaskRegion::TaskRegion(ClaimedShape shape, std::vector<double> weights, std::vector<bool> grows)
    : shape_(std::move(shape)), weights_(std::move(weights)), grows_(std::move(grows)) {
  const std::size_t coordinates = weights_.size();
  for (const auto& point : shape_.points) {
    points_.emplace_back();
    for (const core::Rational& value : point) points_.back().push_back(value.get_d());
  }
  for (std::size_t c = 0; c < coordinates; ++c) {
    std::array<double, 2> hull = around(shape_.points[0][c]);
    for (const auto& point : shape_.points) {
      const std::array<double, 2> next = around(point[c]);
      hull = {std::min(hull[0], next[0]), std::max(hull[1], next[1])};
    }
    if (!shape_.above.empty()) hull[1] = std::max(hull[1], around(shape_.points[0][c] + shape_.above[c])[1]);
    sides_.push_back(hull);
  }
}

double TaskRegion::reach() const {
  const bool round = shape_.name == "ball" || shape_.name == "circle";
  return around(shape_.margin + (round ? shape_.radius : core::Rational(0)))[1] * (1 + 1e-12);
}

/// Of the task's own numbers.
double TaskRegion::rounding() const {
  double size = 0;
  for (std::size_t c = 0; c < weights_.size(); ++c)
    for (const double end : sides_[c]) size = std::max(size, weights_[c] * std::abs(end));
  return 1e-14 * size;
}

Cell TaskRegion::whole() const {
  Cell cell = sides_;
  const bool round = shape_.name == "ball" || shape_.name == "circle";
  for (std::size_t c = 0; c < cell.size(); ++c) {
    if (!(grows_[c] || round) || !(reach() > 0)) continue;
    const double more = reach() / weights_[c] * (1 + 1e-12);
    cell[c] = {std::nextafter(cell[c][0] - more, -HUGE_VAL), std::nextafter(cell[c][1] + more, HUGE_VAL)};
  }
  return cell;
}

bool TaskRegion::is_apart(const Cell& cell) const {
  const double nearest = shape_.name == "box"       ? to_box(cell, grows_)
                         : shape_.name == "polygon" ? to_polygon(cell)
                                                    : to_segments(cell);
  return nearest > reach() + rounding();
}

double TaskRegion::to_box(const Cell& cell, const std::vector<bool>& counts) const {
  double square = 0;
  for (std::size_t c = 0; c < weights_.size(); ++c) {
    const double off = std::max({0.0, cell[c][0] - sides_[c][1], sides_[c][0] - cell[c][1]});
    square += counts[c] ? std::pow(weights_[c] * off, 2) : 0.0;
  }
  return std::sqrt(square) * (1 - 1e-12);
}

double TaskRegion::to_polygon(const Cell& cell) const {
  const auto [i, j] = shape_.across;
  const core::Point2 middle = {0.5 * (cell[i][0] + cell[i][1]), 0.5 * (cell[j][0] + cell[j][1])};
  const double half = 0.5 * std::hypot(cell[i][1] - cell[i][0], cell[j][1] - cell[j][0]);
  double nearest = HUGE_VAL;
  bool in = false;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const std::vector<double>& before = points_[k == 0 ? points_.size() - 1 : k - 1];
    const core::Point2 a = {before[i], before[j]}, b = {points_[k][i], points_[k][j]};
    nearest = std::min(nearest, distance_to_segment(middle, a, b));
    if ((a[1] > middle[1]) != (b[1] > middle[1]) &&
        middle[0] < a[0] + (middle[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      in = !in;
  }
  // A middle within rounding of a side may seem to be outside: nothing is subtracted from 0 then.
  const double across = in ? 0.0 : std::max(0.0, nearest * (1 - 1e-12) - half * (1 + 1e-12));
  std::vector<bool> others = grows_;
  others[i] = others[j] = false;
  return std::hypot(across, to_box(cell, others)) * (1 - 1e-12);
}

double TaskRegion::to_segments(const Cell& cell) const {
  double half = 0;
  std::vector<double> middle;
  for (std::size_t c = 0; c < weights_.size(); ++c) {
    middle.push_back(0.5 * (cell[c][0] + cell[c][1]));
    half += std::pow(weights_[c] * 0.5 * (cell[c][1] - cell[c][0]), 2);
  }
  double nearest = distance(middle, points_[0], points_[0]);
  for (std::size_t i = 1; i < points_.size(); ++i)
    nearest = std::min(nearest, distance(middle, points_[i - 1], points_[i]));
  return nearest * (1 - 1e-12) - std::sqrt(half) * (1 + 1e-12);
}

double TaskRegion::distance(const std::vector<double>& p, const std::vector<double>& a,
                            const std::vector<double>& b) const {
  double along = 0, square = 0;
  for (std::size_t c = 0; c < weights_.size(); ++c) {
    const double w = weights_[c] * weights_[c];
    along += w * (p[c] - a[c]) * (b[c] - a[c]);
    square += w * (b[c] - a[c]) * (b[c] - a[c]);
  }
  const double t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
  double sum = 0;
  for (std::size_t c = 0; c < weights_.size(); ++c) sum += std::pow(weights_[c] * (p[c] - a[c] - t * (b[c] - a[c])), 2);
  return std::sqrt(sum);
}

std::string described(const Cell& cell, const std::vector<std::string>& names) {
  std::vector<std::string> parts;
  for (std::size_t c = 0; c < cell.size(); ++c)
    parts.push_back(fmt::format("{} {:.6g} to {:.6g}", names[c], cell[c][0], cell[c][1]));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::size_t covered(const Cell& whole, const std::vector<std::string>& names,
                    const std::function<bool(const Cell&)>& is_apart, const Holds& holds, const Deadline& deadline) {
  std::vector<Cell> open = {whole};
  std::size_t cells = 0;
  for (std::size_t count = 0; !open.empty(); ++count) {
    const Cell cell = std::move(open.back());
    open.pop_back();
    if (deadline && std::chrono::steady_clock::now() >= *deadline)
      throw core::LimitReached("the time limit was reached before every claim was looked at");
    if (is_apart(cell)) continue;
    std::vector<double> spreads(cell.size(), 0.0);
    if (holds(cell, spreads)) {
      ++cells;
      continue;
    }
    const std::size_t along = chosen(cell, whole, spreads);
    if (count >= most_cells_of_task || along == cell.size())
      throw FalseClaim("task: that it keeps clear is not shown in " + described(cell, names));
    Cell low = cell, high = cell;
    low[along][1] = high[along][0] = 0.5 * (cell[along][0] + cell[along][1]);
    open.push_back(std::move(high));
    open.push_back(std::move(low));
  }
  return cells;
}

}  // namespace clearloci::check
