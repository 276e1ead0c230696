#include "loci/place_words.hpp"

#include <cmath>
#include <numbers>

namespace clearloci::loci {
namespace {

bool is_angle(const core::LocusProblem& problem, std::size_t coordinate) {
  return coordinate < problem.charts.size() && problem.charts[coordinate].has_value();
}

/// To six decimals, away from what is between the ends of a range.
std::string decimals(double value, double (*rounded)(double)) {
  constexpr double unit = 1e-6;
  return std::to_string(rounded(value / unit) * unit);
}

double down(double value) { return std::floor(value); }
double up(double value) { return std::ceil(value); }
double nearest(double value) { return std::round(value); }

}  // namespace

std::string place_words_of_angles(const core::LocusProblem& problem, const std::array<double, 4>& box) {
  constexpr double degrees = 180 / std::numbers::pi;
  const bool is_point = box[0] == box[1] && box[2] == box[3];
  std::string words = is_point ? "at (" : "in (";
  for (std::size_t c = 0; c < 2; ++c) {
    const bool angle = is_angle(problem, c);
    const double unit = angle ? degrees : 1, lower = unit * box[2 * c], upper = unit * box[2 * c + 1];
    if (c > 0) words += ", ";
    words += is_point ? decimals(lower, nearest) : decimals(lower, down) + " to " + decimals(upper, up);
    if (angle) words += " deg";
  }
  return words + ")";
}

std::string place_words(const core::LocusProblem& problem, const std::array<double, 4>& box) {
  std::array<double, 4> own = box;
  for (std::size_t c = 0; c < 2; ++c)
    if (is_angle(problem, c))
      for (const std::size_t i : {2 * c, 2 * c + 1}) own[i] = core::angle_at(*problem.charts[c], box[i]);
  return place_words_of_angles(problem, own);
}

}  // namespace clearloci::loci
