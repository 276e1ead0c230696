// Where a mechanism moves in a plane, and what drives one that names no motors.
#include <algorithm>
#include <cmath>
#include <optional>

#include "mechanism/import/common.hpp"

namespace clearloci::mechanism::imports {
namespace {

constexpr double parallel = 1e-9;  ///< of unit vectors

/// Every pin along n, every guide across it.
std::optional<Vec> normal_of(const Source& source) {
  std::optional<Vec> n;
  for (const SourceJoint& joint : source.joints)
    if (!joint.dropped && joint.kind == SourceKind::revolute && !n) n = joint.axis();
  if (!n) return n;
  for (const SourceJoint& joint : source.joints) {
    if (joint.dropped) continue;
    if (joint.kind == SourceKind::revolute && norm(cross(*n, joint.axis())) > parallel) return std::nullopt;
    if (joint.kind == SourceKind::prismatic && std::abs(dot(*n, joint.axis())) > parallel) return std::nullopt;
  }
  return n;
}

/// Whether pins and guides alone hold every link in the plane.
bool held_in_plane(const Source& source) {
  std::vector<bool> held(source.links.size());
  const auto is_held = [&](int link) { return link == ground_link || held[static_cast<std::size_t>(link)]; };
  bool more = true;
  while (more) {
    more = false;
    for (const SourceJoint& joint : source.joints) {
      if (joint.dropped || (joint.kind != SourceKind::revolute && joint.kind != SourceKind::prismatic)) continue;
      if (is_held(joint.from) == is_held(joint.to)) continue;
      held[static_cast<std::size_t>(is_held(joint.from) ? joint.to : joint.from)] = true;
      more = true;
    }
  }
  for (std::size_t l = 0; l < held.size(); ++l)
    if (!held[l] && !source.links[l].dropped) return false;
  return true;
}

/// x and y of the plane, so that it is seen as people draw it: x to the right, z or y up.
Rotation plane_of(const Vec& n) {
  std::size_t most = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(n[i]) > std::abs(n[most])) most = i;
  const Vec to_right = most == 0 ? Vec{0, 1, 0} : Vec{1, 0, 0};
  const Vec x = unit(to_right - dot(to_right, n) * n);
  const Vec up = most == 2 ? Vec{0, 1, 0} : Vec{0, 0, 1};
  Vec y = cross(n, x);
  if (dot(y, up) < 0) y = -y;
  return {x, y, cross(x, y)};
}

std::string axis_words(const Vec& v) {
  static const char* const names[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(v[i]) > 1 - parallel) return (v[i] < 0 ? "-" : "") + std::string(names[i]);
  return "(" + shortest_decimal(v[0], 1e-6) + ", " + shortest_decimal(v[1], 1e-6) + ", " +
         shortest_decimal(v[2], 1e-6) + ")";
}

void turn_joint(SourceJoint& joint, const Rotation& back) {
  const Vec before = back * joint.axis();
  for (JointSide* side : {&joint.on_from, &joint.on_to}) {
    side->at = back * side->at;
    side->at[2] = 0;
    side->frame = back * side->frame;
  }
  if (joint.along)
    for (Vec* at : {&joint.along->first, &joint.along->second}) {
      *at = back * *at;
      (*at)[2] = 0;
    }
  // A pin that turns about -z turns the other way about z.
  if (joint.kind == SourceKind::revolute && before[2] < 0) {
    if (joint.range) joint.range = std::array<double, 2>{-(*joint.range)[1], -(*joint.range)[0]};
    if (joint.speed) joint.speed = -*joint.speed;
  }
}

}  // namespace

void go_planar(Source& source) {
  const std::optional<Vec> n = normal_of(source);
  if (source.planar || !n || !held_in_plane(source)) return;
  const Rotation plane = plane_of(*n), back = plane.transposed();
  std::vector<std::string> changed;
  for (SourceJoint& joint : source.joints) {
    if (joint.dropped || joint.kind == SourceKind::revolute || joint.kind == SourceKind::prismatic) continue;
    const bool guides = joint.kind == SourceKind::cylindrical && std::abs(dot(joint.axis(), *n)) <= parallel;
    joint.kind = guides ? SourceKind::prismatic : SourceKind::revolute;
    if (!guides) place(joint, joint.at(), plane.z);
    changed.push_back(joint.name);
  }
  if (!changed.empty())
    source.note("in the plane " + enumerated(changed) +
                (changed.size() == 1 ? " is a pin or guide" : " are pins or guides"));
  for (SourceJoint& joint : source.joints) turn_joint(joint, back);
  for (SourcePoint& point : source.points) {
    point.at = back * point.at;
    point.at[2] = 0;
  }
  bool across = false;
  for (SourceLink& link : source.links) {
    if (link.centre) {
      link.centre = back * *link.centre;
      (*link.centre)[2] = 0;
    }
    if (link.inertia) link.inertia = turned(back, *link.inertia);
  }
  for (SourceLoad& load : source.loads) {
    load.at = back * load.at;
    load.force = back * load.force;
    load.couple = back * load.couple;
    across = across || std::abs(load.force[2]) > 1e-9 * norm(load.force);
    load.force[2] = 0;
    load.couple = {0, 0, load.couple[2]};
    load.at[2] = 0;
  }
  for (SourceSpring& spring : source.springs)
    for (Vec& at : spring.at) {
      at = back * at;
      at[2] = 0;
    }
  for (SourceMesh& mesh : source.meshes)
    for (Vec& at : mesh.at) {
      at = back * at;
      at[2] = 0;
    }
  if (source.gravity) {
    source.gravity = back * *source.gravity;
    across = across || std::abs((*source.gravity)[2]) > 1e-9 * norm(*source.gravity);
    (*source.gravity)[2] = 0;
  }
  source.planar = true;
  source.note("all links move in one plane: x of this file is " + axis_words(plane.x) + " of the source, y is " +
              axis_words(plane.y));
  if (across)
    source.note("forces and weights at a right angle to the plane were left out: planar joints do not bear them");
}

void choose_motors(Source& source) {
  for (const SourceJoint& joint : source.joints)
    if (!joint.dropped && joint.actuated) return;
  RowSpace held;
  for (std::vector<double>& row : constraint_rows(source)) held.add(std::move(row));
  std::size_t columns = 0;
  for (const SourceLink& link : source.links) columns += link.dropped ? 0 : 6;
  // Guides with a range are legs that are driven.
  const auto order = [](const SourceJoint& joint) {
    return joint.slides() && joint.range ? 0 : joint.from == ground_link || joint.to == ground_link ? 1 : 2;
  };
  for (int turn = 0; turn < 3; ++turn)
    for (SourceJoint& joint : source.joints) {
      if (held.rank() >= columns) break;
      const bool may = joint.kind == SourceKind::revolute || (joint.slides() && joint.kind != SourceKind::slot);
      if (joint.dropped || joint.actuated || !may) continue;
      if (order(joint) != turn) continue;
      if (!held.add(motor_row(source, joint))) continue;
      joint.actuated = joint.chosen = true;
    }
}

}  // namespace clearloci::mechanism::imports
