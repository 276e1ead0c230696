#include <algorithm>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/instant_equations.hpp"

namespace clearloci::numeric {
namespace {

/// The guide in which a link with a single point turns: an axis of a prismatic joint is fixed in both of its links.
mechanism::JointIndex guide_of(const mechanism::Mechanism& mechanism, mechanism::LinkIndex link) {
  if (mechanism.links[static_cast<std::size_t>(link)].points.size() > 1) return -1;
  const auto found = std::find_if(mechanism.joints.begin(), mechanism.joints.end(), [&](const mechanism::Joint& joint) {
    return mechanism::traits(joint).slides && !mechanism::is_slot(mechanism, joint) && !mechanism::is_cable(joint) &&
           (joint.from == link || joint.to == link);
  });
  return found == mechanism.joints.end() ? -1 : static_cast<mechanism::JointIndex>(found - mechanism.joints.begin());
}

/// The links that turn with a link, which guides hold to it; itself first.
std::vector<mechanism::LinkIndex> turning_with(const mechanism::Mechanism& m, mechanism::LinkIndex link) {
  std::vector<mechanism::LinkIndex> all = {link};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const mechanism::Joint& joint : m.joints) {
      if (joint.type != mechanism::JointType::prismatic || (joint.from != all[i] && joint.to != all[i])) continue;
      const mechanism::LinkIndex other = joint.from == all[i] ? joint.to : joint.from;
      if (std::find(all.begin(), all.end(), other) == all.end()) all.push_back(other);
    }
  return all;
}

/// Points first, then axes along which it slides, then the others.
std::vector<BodyDirection> directions_of(const NumericModel& model, const std::vector<mechanism::LinkIndex>& links) {
  const mechanism::Mechanism& m = model.mechanism;
  const auto holds = [&](mechanism::LinkIndex link) {
    return std::find(links.begin(), links.end(), link) != links.end();
  };
  std::vector<BodyDirection> all;
  for (const mechanism::LinkIndex link : links) {
    if (link == mechanism::ground) continue;
    const std::vector<mechanism::PointIndex>& points = m.links[static_cast<std::size_t>(link)].points;
    for (std::size_t k = 1; k < points.size(); ++k) all.push_back({points[0], points[k]});
  }
  for (const bool slides : {true, false})
    for (std::size_t j = 0; j < m.joints.size(); ++j) {
      const mechanism::Joint& joint = m.joints[j];
      if (mechanism::traits(joint).slides != slides || mechanism::holds_idle_freedom(joint)) continue;
      // Lines of action and of cables turn by themselves.
      if (mechanism::traits(joint).meshes || mechanism::is_cable(joint)) continue;
      // Not fixed in `to`, which turns against it.
      const bool crossed = joint.type == mechanism::JointType::universal || mechanism::is_slot(m, joint);
      if (model.axes[j] && (holds(joint.from) || (holds(joint.to) && !crossed))) all.push_back({0, 0, model.axes[j]});
      if (crossed && model.second_axes[j] && holds(joint.to)) all.push_back({0, 0, model.second_axes[j]});
    }
  return all;
}

Motion motion_of(const mechanism::Mechanism& mechanism, Timeline timeline, std::vector<int> mode) {
  Motion motion;
  motion.model = compile(mechanism);
  motion.mode = std::move(mode);
  motion.timeline = std::move(timeline);
  core::ensure(motion.mode.size() == motion.model.dyads.size(), "a working mode has one sign for each dyad");
  std::vector<bool> turns(mechanism.links.size(), false);
  for (const mechanism::Link& link : mechanism.links) {
    motion.mass.push_back(core::to_double(mechanism::value_of(link.mass, mechanism)));
    motion.inertia.push_back(link.inertia ? core::to_double(mechanism::value_of(*link.inertia, mechanism))
                                          : slender_rod);
    motion.guide.push_back(guide_of(mechanism, static_cast<int>(motion.guide.size())));
    turns[motion.mass.size() - 1] = link.inertia ? motion.inertia.back() > 0 : false;
  }
  for (std::size_t i = 0; i < mechanism.links.size(); ++i)
    for (const mechanism::PointMass& point : mechanism.links[i].masses)
      motion.point_masses.push_back({static_cast<mechanism::LinkIndex>(i), point.at,
                                     core::to_double(mechanism::value_of(point.mass, mechanism))});
  for (const mechanism::Payload& payload : motion.timeline.trajectory.payloads)
    if (payload.inertia > 0) turns[static_cast<std::size_t>(payload.link)] = true;
  const bool planar = mechanism.space == mechanism::Space::planar;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const std::vector<mechanism::LinkIndex> links = turning_with(mechanism, static_cast<mechanism::LinkIndex>(i));
    motion.directions.push_back(directions_of(motion.model, links));
    motion.still.push_back(std::find(links.begin(), links.end(), mechanism::ground) != links.end());
    const bool shown = planar ? mechanism.links[i].points.size() > 1 || motion.guide[i] >= 0
                              : motion.still.back() || motion.directions.back().size() > 1;
    if (turns[i] && !shown) refuse_rotation(mechanism.links[i]);
  }
  motion.columns = joint_columns(motion.model);
  motion.clearances = joint_clearances(mechanism);
  return motion;
}

}  // namespace

Motion compile_motion(const mechanism::Mechanism& mechanism, const mechanism::Trajectory& trajectory,
                      std::vector<int> mode) {
  Motion motion = motion_of(mechanism, compile_timeline(trajectory, mechanism), std::move(mode));
  motion.idle = idle_parts(motion);
  return motion;
}

Motion compile_motion(const mechanism::Mechanism& mechanism, std::vector<int> mode) {
  return motion_of(mechanism, {}, std::move(mode));
}

}  // namespace clearloci::numeric
