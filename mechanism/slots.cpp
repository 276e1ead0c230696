// The pin of a slot runs along one line of the slot's link, which the points have to hold: nothing else does.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mechanism/joint_traits.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using Place = std::array<double, 3>;

constexpr std::size_t slot_postures = 16;
/// Of the slot's link and the way of its pin: what rounding and constructions leave.
constexpr double off_line = 1e-7;

double side_of(const Place& u, const Place& v) { return u[0] * v[1] - u[1] * v[0]; }

/// A slot in one posture, seen from its link: from its first point, in the direction to its second one.
struct SeenSlot {
  double sine = 0, cosine = 0;  ///< of the axis, to the link's direction
  double distance = 0;          ///< of the pin's line from the link's first point, to the left of the axis, m
  double size = 0;              ///< m
};

SeenSlot seen(const Mechanism& mechanism, const Joint& joint, const Place& axis, const PosturePoints& points) {
  Place origin{}, direction = {1, 0, 0};
  const Place& pin = points[static_cast<std::size_t>(joint.at)];
  if (joint.from != ground) {
    const std::vector<PointIndex>& base_points = mechanism.links[static_cast<std::size_t>(joint.from)].points;
    origin = points[static_cast<std::size_t>(base_points.front())];
    direction = axis;
    if (base_points.size() > 1) {
      const Place& second = points[static_cast<std::size_t>(base_points[1])];
      direction = {second[0] - origin[0], second[1] - origin[1], 0};
    }
  }
  const double length = std::hypot(axis[0], axis[1]), size = std::hypot(direction[0], direction[1]);
  const Place way = {pin[0] - origin[0], pin[1] - origin[1], 0};
  return {side_of(direction, axis) / (length * size),
          (direction[0] * axis[0] + direction[1] * axis[1]) / (length * size), side_of(axis, way) / length,
          std::hypot(way[0], way[1])};
}

void check_slot(const Mechanism& mechanism, const Joint& joint, const std::vector<SampledPosture>& postures) {
  std::vector<SeenSlot> all;
  for (const SampledPosture& posture : postures)
    if (const auto axis = sample_vector(mechanism, joint.axes.front(), posture.pose))
      if (std::hypot((*axis)[0], (*axis)[1]) > 0) all.push_back(seen(mechanism, joint, *axis, posture.points));
  if (all.empty()) return;
  double size = 0;
  for (const SeenSlot& slot : all) size = std::max(size, slot.size);
  const std::string link =
      joint.from == ground ? "the ground" : "link " + mechanism.links[static_cast<std::size_t>(joint.from)].name;
  for (const SeenSlot& slot : all) {
    const SeenSlot& first = all.front();
    if (std::abs(slot.sine - first.sine) > off_line || std::abs(slot.cosine - first.cosine) > off_line)
      throw core::InputError(joint.where, "the axis of slot " + joint.name + " turns in " + link + ", which carries it",
                             "write the way between two points of " + link);
    if (std::abs(slot.distance - first.distance) <= off_line * size) continue;
    const auto [least, most] = std::minmax_element(
        all.begin(), all.end(), [](const SeenSlot& a, const SeenSlot& b) { return a.distance < b.distance; });
    char text[80];
    const double unit = mechanism.units.length.size;
    std::snprintf(text, sizeof text, "from %.6g to %.6g %s", least->distance / unit, most->distance / unit,
                  mechanism.units.length.name.c_str());
    throw core::InputError(joint.where,
                           "the pin of slot " + joint.name + " leaves its line in " + link +
                               ": its distance from the line changes over the workspace, " + text,
                           "place " + mechanism.points[static_cast<std::size_t>(joint.at)].name +
                               " on the slot: by a slider, a crossing, or coordinates");
  }
}

}  // namespace

void check_slots(const Mechanism& mechanism) {
  const auto slot = [&](const Joint& joint) { return is_slot(mechanism, joint); };
  if (std::none_of(mechanism.joints.begin(), mechanism.joints.end(), slot)) return;
  const std::vector<SampledPosture> postures = sample_poses(mechanism, working_mode(mechanism), slot_postures);
  for (const Joint& joint : mechanism.joints)
    if (slot(joint)) check_slot(mechanism, joint, postures);
}

}  // namespace clearloci::mechanism
