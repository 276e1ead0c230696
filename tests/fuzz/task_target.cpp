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
  require(mechanism.coordinates.size() == 2, "a task lies in a plane");
  const auto [lower, upper] = core::bounds(task.shape);
  for (std::size_t c = 0; c < 2; ++c)
    require(mechanism.coordinates[c].lower <= lower[c] && lower[c] <= upper[c] &&
                upper[c] <= mechanism.coordinates[c].upper,
            "a task lies in the mechanism's box");
  require(task.margin >= 0 && is_finite(task.margin), "a margin is finite and not negative");
  for (const auto& least : {task.min_force, task.min_couple})
    require(!least || (*least > 0 && is_finite(*least)), "a least effort is finite and positive");
  if (task.loads)
    for (const core::RationalPose& end : {task.loads->first, task.loads->second})
      require(is_finite(end[0]) && is_finite(end[1]) && (end[0] != 0 || end[1] != 0), "a load is finite and not zero");
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
