// What the file of another program describes, in words that all formats share: links, joints, where everything is in
// one posture, motors, loads. Lengths are in the unit that the source names, everything else in SI units; directions
// and places are those of the posture, in the frame of the source. Private to mechanism/.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/import/geometry.hpp"

namespace clearloci::mechanism::imports {

constexpr int ground_link = -1;

struct SourceLink {
  std::string name;
  int line = 0;
  double mass = 0;  ///< kg
  std::optional<Vec> centre;
  std::optional<Tensor> inertia;  ///< about the centre of mass, kg m²
  bool dropped = false;           ///< merged into another one
  bool helper = false;            ///< the source has no such part: a block in a slot
};

/// A place of a link that matters though no joint is there.
struct SourcePoint {
  std::string name;
  int link = ground_link;
  Vec at{};
  bool traced = false;  ///< the source draws its path
};

enum class SourceKind { revolute, prismatic, spherical, universal, cylindrical, fixed, slot };

/// A joint as one of its links has it: z of the frame is the axis.
struct JointSide {
  Vec at{};
  Rotation frame;
};

struct SourceJoint {
  std::string name;
  std::string point;  ///< what its place is called; "" as the joint
  int line = 0;
  SourceKind kind = SourceKind::revolute;
  int from = ground_link, to = ground_link;
  JointSide on_from, on_to;  ///< the same once the posture is closed; of a universal joint z is the axis in that link
  bool actuated = false;
  bool chosen = false;                         ///< to drive, where the source names no motor
  std::optional<std::array<double, 2>> range;  ///< from the posture onwards: rad, or the source's length
  bool range_is_distance = false;              ///< of a guide: the range is that of the way between its two sides
  bool either_way = false;                     ///< a leg between balls: no sense of its axis is meant
  std::optional<double> speed;                 ///< rad/s or m/s
  std::optional<std::pair<Vec, Vec>> along;    ///< of a guide or slot: two places of `from` on it
  std::optional<double> half_length;           ///< of a guide
  bool dropped = false;

  bool slides() const {
    return kind == SourceKind::prismatic || kind == SourceKind::cylindrical || kind == SourceKind::slot;
  }
  /// Of a guide the place on what slides: the sides of all others meet.
  const Vec& at() const { return slides() ? on_to.at : on_from.at; }
  const Vec& axis() const { return on_from.frame.z; }
};

struct SourceLoad {
  int link = ground_link;
  Vec at{};
  Vec force{};         ///< N
  Vec couple{};        ///< N m
  bool turns = false;  ///< with the link
  std::string name;
};

/// Between two places: k (length - free_length), N/m, the source's length.
struct SourceSpring {
  std::string name;
  std::array<int, 2> links{ground_link, ground_link};
  std::array<Vec, 2> at{};
  double stiffness = 0, free_length = 0;
};

/// Two wheels, each with its centre, in a plane; or two pulleys, whose radii have the ratio of `teeth`. From what has
/// both centres they turn by
///     teeth[0] turn[0] + teeth[1] turn[1] = 0,   teeth[0] turn[0] = teeth[1] turn[1] of pulleys
struct SourceMesh {
  std::string name;
  int line = 0;
  std::array<int, 2> links{ground_link, ground_link};
  std::array<Vec, 2> at{};
  std::array<long, 2> teeth{1, 1};  ///< the second of a ring is negative
  bool belt = false;
};

/// A joint whose angle is `ratio` times that of another one, but for a number: it follows in the posture of the source.
struct SourceFollower {
  std::size_t joint = 0, leader = 0;  ///< of Source::joints
  double ratio = 1;
  int line = 0;
};

struct Source {
  std::string format;  ///< "PMKS+"
  std::string name;
  std::string unit = "m";  ///< of lengths: m, cm, mm or in
  bool planar = false;     ///< x and y alone are meant
  /// Places of bodies are guesses: the joints say where they are.
  bool open_posture = false;
  std::vector<SourceLink> links;
  std::vector<SourcePoint> points;
  std::vector<SourceJoint> joints;
  std::vector<SourceLoad> loads;
  std::vector<SourceSpring> springs;
  std::vector<SourceMesh> meshes;
  std::vector<SourceFollower> followers;
  std::optional<Vec> gravity;
  std::vector<std::string> notes;  ///< what was interpreted, and what was left out

  double metres() const { return unit == "mm" ? 1e-3 : unit == "cm" ? 1e-2 : unit == "in" ? 0.0254 : 1; }
  void note(std::string text) { notes.push_back(std::move(text)); }
};

/// The largest distance between places of joints and points; 0 where there is one place alone.
double size_of(const Source& source);

/// Both sides of a joint where they meet.
inline void place(SourceJoint& joint, const Vec& at, const Vec& axis) {
  joint.on_from = {at, frame_along(unit(axis))};
  joint.on_to = joint.on_from;
}

/// Adds a joint whose sides meet at a place.
inline SourceJoint& add_joint(Source& source, std::string name, int line, SourceKind kind, int from, int to,
                              const Vec& at, const Vec& axis) {
  SourceJoint& joint = source.joints.emplace_back();
  joint.name = std::move(name);
  joint.line = line;
  joint.kind = kind;
  joint.from = from;
  joint.to = to;
  place(joint, at, axis);
  return joint;
}

}  // namespace clearloci::mechanism::imports
