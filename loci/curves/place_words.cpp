#include "loci/curves/place_words.hpp"

#include <cmath>
#include <cstdio>

namespace clearloci::loci {
namespace {

/// To nine decimals, away from what is between the ends of a range.
std::string decimals(double value, double (*rounded)(double)) {
  constexpr double unit = 1e-9;
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.12g", rounded(value / unit) * unit);
  return text.data();
}

double down(double value) { return std::floor(value); }
double up(double value) { return std::ceil(value); }
double nearest(double value) { return std::round(value); }

}  // namespace

std::string place_words(const std::array<double, 4>& box) {
  if (box[0] == box[1] && box[2] == box[3])
    return "at (" + decimals(box[0], nearest) + ", " + decimals(box[2], nearest) + ")";
  const auto range = [&](std::size_t c) {
    return "[" + decimals(box[2 * c], down) + ", " + decimals(box[2 * c + 1], up) + "]";
  };
  return "in " + range(0) + " x " + range(1);
}

std::string place_words(const core::LocusProblem& problem, const std::array<double, 4>& box) {
  std::array<double, 4> in_user_units = box;
  for (std::size_t c = 0; c < 2; ++c)
    if (c < problem.charts.size() && problem.charts[c])
      for (const std::size_t i : {2 * c, 2 * c + 1}) in_user_units[i] = core::angle_at(*problem.charts[c], box[i]);
  return place_words(in_user_units);
}

std::string curve_words(core::LocusKind kind, const std::vector<core::Vanishing>& vanishing, const std::string& factor,
                        const std::string& cause) {
  constexpr std::size_t longest = 60;
  if (!cause.empty()) return cause;
  if (!factor.empty() && factor.size() <= longest) return factor;
  if (vanishing.empty()) return kind == core::LocusKind::direct_singularity ? "|A| = 0" : core::to_string(kind);
  std::string words;
  for (const core::Vanishing& v : vanishing)
    words += (words.empty() ? "" : ", ") + core::to_string(v.quantity) + "_" + v.joint;
  return kind == core::LocusKind::margin ? "margin of " + words : words + " = 0";
}

}  // namespace clearloci::loci
