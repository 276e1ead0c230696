#include "analysis/flanks.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/widened_task.hpp"
#include "core/errors.hpp"
#include "loci/tasks/tasks.hpp"
#include "mechanism/evaluate.hpp"
#include "numeric/reactions.hpp"

namespace clearloci {

bool meshes(const mechanism::Mechanism& mechanism) {
  return std::any_of(mechanism.joints.begin(), mechanism.joints.end(),
                     [](const mechanism::Joint& joint) { return joint.meshing.has_value(); });
}

bool has_teeth(const mechanism::Joint& joint) { return joint.meshing && joint.meshing->flank; }

std::optional<double> most_of_belt(const mechanism::Mechanism& mechanism, const mechanism::Joint& joint) {
  if (!joint.meshing || has_teeth(joint)) return std::nullopt;
  return std::abs(core::to_double(mechanism::value_of(joint.meshing->most, mechanism)));
}

std::vector<std::string> pulled_gears(const mechanism::Mechanism& mechanism, const Pose& pose) {
  std::vector<std::string> pulled;
  for (const mechanism::Joint& joint : mechanism.joints) {
    if (!has_teeth(joint)) continue;
    for (const JointReaction& reaction : pose.reactions)
      for (const ReactionComponent& part : reaction.components)
        if (reaction.joint == joint.name && part.quantity == Quantity::F && part.value < 0)
          pulled.push_back(joint.name);
  }
  return pulled;
}

std::vector<DyadSides> modes_of_flanks(const mechanism::Mechanism& mechanism, const DyadSides& sides) {
  const std::vector<mechanism::PointIndex> points = mechanism::dyad_points(mechanism);
  std::vector<DyadSides> modes = {sides};
  for (const mechanism::Joint& joint : mechanism.joints) {
    if (!has_teeth(joint)) continue;
    const auto place = std::find(points.begin(), points.end(), *joint.meshing->flank) - points.begin();
    for (std::size_t i = 0, count = modes.size(); i < count; ++i) {
      DyadSides other = modes[i];
      other[static_cast<std::size_t>(place)] *= -1;
      modes.push_back(std::move(other));
    }
  }
  return modes;
}

DyadSides sides_that_push(const mechanism::Mechanism& mechanism, const DyadSides& sides,
                          const std::vector<double>& pose) {
  const numeric::NumericModel model = numeric::compile(mechanism);
  for (const DyadSides& dyad_sides : modes_of_flanks(mechanism, sides))
    if (numeric::bounded_numerators(model, pose, dyad_sides).reachable) return dyad_sides;
  return sides;
}

DyadSides sides_that_push(const mechanism::Mechanism& mechanism, const core::Task& task, const DyadSides& sides) {
  if (std::none_of(mechanism.joints.begin(), mechanism.joints.end(), has_teeth)) return sides;
  const WidenedTask widened(mechanism, task);
  const loci::pose::PoseRegion region(task.shape, widened.metric(mechanism, task), widened.beside());
  const std::vector<double> at = widened.settled(region.samples().front());
  return sides_that_push(widened.at_place(at, 0), sides, at);
}

std::string words_of_pulled(const std::vector<std::string>& gears) {
  std::string names;
  for (const std::string& name : gears) names += (names.empty() ? "" : ", ") + name;
  return gears.size() == 1 ? "the load presses the other flank of gear " + names
                           : "the load presses the other flanks of gears " + names;
}

std::vector<std::string> slack_belts(const mechanism::Mechanism& mechanism, const Pose& pose) {
  std::vector<std::string> slack;
  for (const mechanism::Joint& joint : mechanism.joints) {
    const std::optional<double> most = most_of_belt(mechanism, joint);
    if (!most) continue;
    for (const JointReaction& reaction : pose.reactions)
      for (const ReactionComponent& part : reaction.components)
        if (reaction.joint == joint.name && part.quantity == mechanism::actuator_quantity(joint) &&
            std::abs(part.value) > *most)
          slack.push_back(joint.name);
  }
  return slack;
}

void refuse_gears(const mechanism::Mechanism& mechanism, const std::string& what, const std::string& mend) {
  for (const mechanism::Joint& joint : mechanism.joints)
    if (joint.meshing)
      throw core::InputError({mechanism.file},
                             what + " for mechanisms without gears and belts alone, and " + joint.name + " is a " +
                                 mechanism::to_string(joint.type),
                             mend);
}

}  // namespace clearloci
