#include "mechanism/write_task.hpp"

#include <algorithm>
#include <variant>

#include "core/errors.hpp"
#include "core/task.hpp"
#include "mechanism/open_design.hpp"
#include "mechanism/written_unit.hpp"

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
  std::string forces(const std::vector<Rational>& parts) const {
    return listed(parts.size(), [&](std::size_t c) { return force(parts[c]); });
  }
  /// A number of the task's metric.
  std::string distance(const Rational& value, const core::Task& task) const {
    std::size_t angle = 0;
    for (std::size_t c = 0; c < mechanism_.coordinates.size(); ++c)
      if (!mechanism_.coordinates[angle = c].angle) return length(value);
    return task.angle_length ? length(value) : coordinate(value, angle);
  }

  std::string shape(const core::Task& task) const {
    if (const auto* box = std::get_if<core::TaskBox>(&task.shape)) return "box: " + ranges(*box, {});
    if (const auto* ball = std::get_if<core::TaskBall>(&task.shape))
      return core::kind_of(task.shape) + ": {centre: " + pose(ball->centre) +
             ", radius: " + distance(ball->radius, task) + "}";
    if (const auto* polygon = std::get_if<core::TaskPolygon>(&task.shape)) {
      const auto& [i, j] = polygon->across;
      const auto corner = [&, i = i, j = j](std::size_t k) {
        return "[" + length(polygon->corners[k][i]) + ", " + length(polygon->corners[k][j]) + "]";
      };
      std::string text = "polygon: " + listed(polygon->corners.size(), corner);
      if (polygon->above.empty()) return text;
      core::TaskBox others{polygon->corners.front(), polygon->corners.front()};
      for (std::size_t c = 0; c < others.upper.size(); ++c) others.upper[c] += polygon->above[c];
      return text + "\nbox: " + ranges(others, {i, j});
    }
    const auto& points = std::get<core::TaskPath>(task.shape).points;
    return "path: " + listed(points.size(), [&](std::size_t k) { return pose(points[k]); });
  }

 private:
  template <class Part>
  static std::string listed(std::size_t count, const Part& part) {
    std::string text = "[";
    for (std::size_t k = 0; k < count; ++k) text += (k == 0 ? "" : ", ") + part(k);
    return text + "]";
  }

  /// A plain angle is in rad unless the file says otherwise.
  std::string coordinate(const Rational& value, std::size_t c) const {
    if (!mechanism_.coordinates[c].angle) return length(value);
    return number(value) + (mechanism_.units.angle_declared ? " rad" : "");
  }
  std::string pose(const core::RationalPose& at) const {
    return listed(at.size(), [&](std::size_t c) { return coordinate(at[c], c); });
  }
  std::string ranges(const core::TaskBox& box, const std::vector<std::size_t>& without) const {
    std::string text;
    for (std::size_t c = 0; c < box.lower.size(); ++c)
      if (std::find(without.begin(), without.end(), c) == without.end())
        text += (text.empty() ? "{" : ", ") + mechanism_.coordinates[c].name + ": [" + coordinate(box.lower[c], c) +
                ", " + coordinate(box.upper[c], c) + "]";
    return text + "}";
  }

  const Mechanism& mechanism_;
  Rational length_, force_;
};

}  // namespace

Rational length_unit(const Units& units) { return exact(units.length); }

std::string task_text(const core::Task& task, const Mechanism& mechanism) {
  core::ensure(!std::holds_alternative<core::TaskMesh>(task.shape), "a task whose shape is numbers");
  const Writer write(mechanism);
  std::string text = "format: 1\n" + write.shape(task) + "\n";
  if (task.margin != 0) text += "margin: " + write.distance(task.margin, task) + "\n";
  if (task.angle_length) text += "angle_length: " + write.length(*task.angle_length) + "\n";
  if (task.min_force) text += "min_force: " + write.force(*task.min_force) + "\n";
  if (task.min_couple) text += "min_couple: " + number(*task.min_couple) + "\n";
  if (task.loads)
    text += "loads_from: [" + write.forces(task.loads->first) + ", " + write.forces(task.loads->second) + "]\n";
  for (std::size_t i = 0; i < task.tolerances.size(); ++i) {
    const core::Tolerance& tolerance = task.tolerances[i];
    const Parameter* parameter = parameter_named(mechanism, tolerance.parameter);
    core::ensure(parameter != nullptr, "a tolerance of a parameter of the mechanism");
    text += (i == 0 ? "tolerances: {" : ", ") + tolerance.parameter + ": [" +
            value_words(*parameter, tolerance.below, mechanism.units) + ", " +
            value_words(*parameter, tolerance.above, mechanism.units) + "]";
  }
  if (!task.tolerances.empty()) text += "}\n";
  for (std::size_t i = 0; i < task.loads_within.size(); ++i) {
    const core::LoadWithin& load_range = task.loads_within[i];
    text += (i == 0 ? "loads_within: [{load: " : ", {load: ") + std::to_string(load_range.load + 1) +
            ", radius: " + write.force(load_range.force) + ", couple: " + number(load_range.couple) + "}";
  }
  if (!task.loads_within.empty()) text += "]\n";
  if (task.pose_error) text += "pose_error: " + write.length(*task.pose_error) + "\n";
  return text;
}

}  // namespace clearloci::mechanism
