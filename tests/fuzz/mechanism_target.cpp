#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "mechanism/evaluate.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/read.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/fuzz/targets.hpp"

namespace clearloci::fuzz {
namespace {

using mechanism::Mechanism;

void require_finite(const core::Rational& value, const std::string& what) {
  require(std::isfinite(core::to_double(value)), what + " is finite in double precision");
}

/// Whether no coordinate of the pose stands in it: loads may change over the workspace.
bool is_constant(const core::Expression& expression, const Mechanism& mechanism) {
  const std::set<std::string> names = core::symbols(expression);
  return std::ranges::none_of(mechanism.coordinates,
                              [&](const mechanism::Coordinate& coordinate) { return names.contains(coordinate.name); });
}

/// Every index names something, every number is finite, and as many unknowns as equations.
void check_accepted(const Mechanism& mechanism) {
  for (const mechanism::Parameter& parameter : mechanism.parameters) require_finite(parameter.value, "a parameter");
  require(!mechanism.coordinates.empty() && mechanism.coordinates.size() <= 6, "one to six coordinates");
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
    require_finite(coordinate.lower, "the lower end of a coordinate");
    require_finite(coordinate.upper, "the upper end of a coordinate");
    require(coordinate.lower < coordinate.upper, "a coordinate's range is not empty");
  }
  const auto is_point = [&](int index) { return index >= 0 && index < static_cast<int>(mechanism.points.size()); };
  const auto is_link = [&](int index) { return index >= 0 && index < static_cast<int>(mechanism.links.size()); };
  for (const mechanism::Link& link : mechanism.links) {
    require(is_point(link.centre_of_mass), "a centre of mass is a point");
    for (const int point : link.points) require(is_point(point), "a link's points are points");
    require_finite(mechanism::value_of(link.mass, mechanism), "a mass");
  }
  for (const mechanism::Joint& joint : mechanism.joints) {
    require(is_point(joint.at), "a joint is at a point");
    require(is_link(joint.from) || is_link(joint.to), "a joint has a link");
    require(joint.from != joint.to, "a joint joins two links");
  }
  require(is_link(mechanism.end_effector_link) && is_point(mechanism.end_effector_point), "the end effector is there");
  for (const mechanism::Load& load : mechanism.loads) {
    require(is_link(load.link), "a load acts on a link");
    require(!load.at || is_point(*load.at), "a load acts at a point");
    for (const core::Expression& component : load.force)
      if (is_constant(component, mechanism)) require_finite(mechanism::value_of(component, mechanism), "a force");
  }
  require(unknowns(mechanism).size() == equations_per_link(mechanism) * mechanism.links.size(),
          "as many unknowns as equations");
  for (const std::vector<double>& pose : mechanism::spread_poses(mechanism, 4))
    require(mechanism::sample_points(mechanism, pose).size() == mechanism.points.size(), "a place for every point");
}

}  // namespace

void mechanism_target(std::string_view bytes) {
  const std::string text(bytes);
  const auto read = value_or_complaint([&] { return mechanism::parse_mechanism(text, "m.yaml"); });
  if (read) check_accepted(*read);
}

}  // namespace clearloci::fuzz
