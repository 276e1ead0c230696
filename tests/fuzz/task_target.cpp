#include <cmath>
#include <string>

#include "mechanism/read_task.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/fuzz/sample_mechanisms.hpp"
#include "tests/fuzz/targets.hpp"

namespace clearloci::fuzz {
namespace {

bool is_finite(const core::Rational& value) { return std::isfinite(core::to_double(value)); }

void check_accepted(const core::Task& task, const mechanism::Mechanism& mechanism) {
  std::vector<core::Rational> weights;
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates)
    weights.push_back(coordinate.angle ? task.angle_length.value_or(1) : core::Rational(1));
  const auto [lower, upper] = core::bounds(task.shape, weights);
  require(lower.size() == mechanism.coordinates.size(), "a task has a value for every free coordinate");
  const bool mesh = std::holds_alternative<core::TaskMesh>(task.shape);  // within the roundings of its floats
  for (std::size_t c = 0; c < lower.size() && !mesh; ++c)
    require(mechanism.coordinates[c].lower <= lower[c] && lower[c] <= upper[c] &&
                upper[c] <= mechanism.coordinates[c].upper,
            "a task lies in the mechanism's box");
  require(task.margin >= 0 && is_finite(task.margin), "a margin is finite and not negative");
  for (const auto& least : {task.min_force, task.min_couple, task.pose_error, task.angle_length})
    require(!least || (*least > 0 && is_finite(*least)), "a least effort is finite and positive");
  if (task.loads)
    for (const core::RationalPose& end : {task.loads->first, task.loads->second}) {
      bool any = false;
      for (const core::Rational& part : end) {
        require(is_finite(part), "a load is finite");
        any = any || part != 0;
      }
      require(any, "a load is not zero");
    }
}

}  // namespace

void task_target(std::string_view bytes) {
  const std::string text(bytes);
  for (const mechanism::Mechanism& mechanism : sample_mechanisms()) {
    const auto task = value_or_complaint([&] { return mechanism::parse_task(text, "t.yaml", mechanism); });
    if (task) check_accepted(*task, mechanism);
  }
}

}  // namespace clearloci::fuzz
