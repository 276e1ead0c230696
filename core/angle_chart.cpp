#include "core/angle_chart.hpp"

#include <cmath>
#include <numbers>

namespace clearloci::inline core {

double angle_at(const AngleChart& chart, double t) { return chart.half_turns * std::numbers::pi + 2 * std::atan(t); }

double parameter_at(const AngleChart& chart, double angle) {
  return std::tan((angle - chart.half_turns * std::numbers::pi) / 2);
}

std::string parameter_name(const AngleChart& chart, const std::string& angle) {
  if (chart.half_turns == 0) return "tan(" + angle + "/2)";
  const int turns = std::abs(chart.half_turns);
  const std::string shift = turns == 1 ? "pi" : std::to_string(turns) + "*pi";
  return "tan((" + angle + (chart.half_turns > 0 ? " - " : " + ") + shift + ")/2)";
}

}  // namespace clearloci::inline core
