#include "mechanism/write_task.hpp"

#include <variant>

#include "core/errors.hpp"

namespace clearloci::mechanism {
namespace {

Rational exact(const core::Unit& unit) {
  // Units of a file are decimals, but for inches and degrees rounded ones of few digits.
  return core::simplest_rational_near(Rational(unit.size), Rational(unit.size) / 1000000000);
}

/// The number as a decimal where it has a short one, else as a fraction.
std::string number(const Rational& value) {
  constexpr int most_places = 15;
  Rational scaled = value;
  for (int places = 0; places <= most_places; ++places, scaled *= 10) {
    if (scaled.get_den() != 1) continue;
    std::string digits = core::Integer(abs(scaled.get_num())).get_str();
    if (places > 0) {
      const auto count = static_cast<std::size_t>(places);
      if (digits.size() <= count) digits.insert(0, count + 1 - digits.size(), '0');
      digits.insert(digits.size() - count, ".");
    }
    return (sgn(value) < 0 ? "-" : "") + digits;
  }
  return core::to_string(value);
}

class Writer {
 public:
  explicit Writer(const Mechanism& mechanism)
      : mechanism_(mechanism), length_(length_unit(mechanism.units)), force_(exact(mechanism.units.force)) {}

  std::string length(const Rational& value) const { return number(value / length_); }
  std::string force(const Rational& value) const { return number(value / force_); }
  std::string place(const core::RationalPoint& at) const { return "[" + length(at[0]) + ", " + length(at[1]) + "]"; }
  std::string places(const std::vector<core::RationalPoint>& all) const {
    std::string text;
    for (const core::RationalPoint& at : all) text += (text.empty() ? "[" : ", ") + place(at);
    return text + "]";
  }

  std::string shape(const core::TaskShape& shape) const {
    if (const auto* box = std::get_if<core::TaskBox>(&shape)) {
      const auto range = [&](std::size_t c) {
        return mechanism_.coordinates[c].name + ": [" + length(box->lower[c]) + ", " + length(box->upper[c]) + "]";
      };
      return "box: {" + range(0) + ", " + range(1) + "}";
    }
    if (const auto* circle = std::get_if<core::TaskCircle>(&shape))
      return "circle: {centre: " + place(circle->centre) + ", radius: " + length(circle->radius) + "}";
    if (const auto* polygon = std::get_if<core::TaskPolygon>(&shape)) return "polygon: " + places(polygon->corners);
    return "path: " + places(std::get<core::TaskPath>(shape).points);
  }

 private:
  const Mechanism& mechanism_;
  Rational length_, force_;
};

}  // namespace

Rational length_unit(const Units& units) { return exact(units.length); }

std::string task_text(const core::Task& task, const Mechanism& mechanism) {
  core::ensure(task.tolerances.empty() && task.loads_within.empty() && !task.pose_error, "a task that can be moved");
  const Writer write(mechanism);
  std::string text = "format: 1\n" + write.shape(task.shape) + "\n";
  if (task.margin != 0) text += "margin: " + write.length(task.margin) + "\n";
  if (task.min_force) text += "min_force: " + write.force(*task.min_force) + "\n";
  if (task.min_couple) text += "min_couple: " + number(*task.min_couple) + "\n";
  if (task.loads) {
    const auto load = [&](const core::RationalPoint& own) {
      return "[" + write.force(own[0]) + ", " + write.force(own[1]) + "]";
    };
    text += "loads_from: [" + load(task.loads->first) + ", " + load(task.loads->second) + "]\n";
  }
  return text;
}

}  // namespace clearloci::mechanism
