// The exact model of a mechanism: what its file says, checked, with every name resolved. See mechanism-file.md.
// Units are SI throughout: m, kg, s, N, N m, rad.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "clearloci/quantity.hpp"
#include "clearloci/units.hpp"
#include "core/errors.hpp"
#include "core/expression.hpp"
#include "core/rational.hpp"

namespace clearloci::mechanism {

using core::Expression;
using core::Rational;

using PointIndex = int;
using LinkIndex = int;
using JointIndex = int;
inline constexpr LinkIndex ground = -1;

enum class Space { planar, spatial };

/// Powers of length, angle, force, mass and time in what is measured.
struct Dimension {
  int length = 0, angle = 0, force = 0, mass = 0, time = 0;

  bool operator==(const Dimension&) const = default;
};

/// A named exact number. `value` equals the expression where that is rational, else is within 1e-30 of it.
struct Parameter {
  std::string name;
  Expression expression;
  Rational value;
  bool exact = true;
  Dimension dimension = {};  ///< of the units that its expression carries; none: a plain number of the file's
};

/// A free coordinate of the end effector and the range to search, m or (angle) rad.
struct Coordinate {
  std::string name;
  bool angle = false;
  Expression lower_expression, upper_expression;
  Rational lower, upper;
};

enum class Side { left, right };

/// Explicit coordinates: polynomials in the free coordinates (and cos, sin of an angle), with parameters.
struct ExplicitPoint {
  std::vector<Expression> coordinates;  ///< 2 (planar) or 3 (spatial)
};
/// A vector as the user wrote it: components, or made from points, such as `cross([1, 0, 0], B - A)`.
struct VectorExpression {
  enum class Kind { components, point, add, negate, scale, cross };
  Kind kind = Kind::components;
  std::vector<Expression> numbers;          ///< the components, 2 or 3; of `scale` the one factor
  PointIndex point = 0;                     ///< of `point`: its place
  std::vector<VectorExpression> arguments;  ///< two of add and cross, one of negate and scale
};

/// Every expression that a vector is made of.
std::vector<Expression> numbers_of(const VectorExpression& vector);

/// The point at distance `from_length` from `from` and `to_length` from `to`, on the named side of from -> to. In space
/// it turns about the `axis` through `from`, on the circle across it; left is as seen against the axis.
struct DyadPoint {
  PointIndex from, to;
  Expression from_length, to_length;
  Side side;
  std::optional<VectorExpression> axis = {};  ///< none in the plane
  /// In the plane: no `to_length`, but a right angle at the point, where the way on to `to` passes `from` at a
  /// distance.
  bool right_angle = false;
};
/// In the frame of first -> second: `along` m along it and `left` m to its left.
struct OffsetPoint {
  PointIndex first, second;
  Expression along, left;
};
struct MeanPoint {
  PointIndex first, second;
};
/// On the line through `base` along `along`, at distance `length` from `from`: of the two places the one farther along
/// (`ahead`) or the other.
struct SliderPoint {
  PointIndex base, from;
  VectorExpression along;
  Expression length;
  bool ahead = true;
};
/// At `by` from another point: parallelograms, and links that slide without turning.
struct ShiftedPoint {
  PointIndex from;
  VectorExpression by;  ///< its numbers may vary with the pose
};
/// In the plane: where the line through `first` along `along_first` meets that through `second` along `along_second`.
struct CrossingPoint {
  PointIndex first, second;
  VectorExpression along_first, along_second;
};
/// One of the points that close together: its place is unknown before theirs.
struct GroupPoint {
  int group = 0;
};
using PointForm = std::variant<ExplicitPoint, DyadPoint, OffsetPoint, MeanPoint, SliderPoint, ShiftedPoint,
                               CrossingPoint, GroupPoint>;

/// Points are in an order in which each uses only earlier ones. `auxiliary` points (centres of mass) were not named by
/// the user; they stand last.
struct Point {
  std::string name;
  PointForm form;
  bool auxiliary = false;
  core::SourcePosition where;
};

/// Points that close together, none before the others (method.md section 14): as many equations as unknowns,
///     |Q - P|^2 = length^2 of every distance,   (P - Q) x u = 0 of every line
/// The points are `first` and the `count` - 1 behind it; the equations may name points up to `last`, which are built on
/// these. Of all assemblies it is the one that holds the posture `near`.
struct Group {
  struct Distance {
    PointIndex first = 0, second = 0;
    Expression length;
    core::SourcePosition where = {};
  };
  /// In the plane: `point` on the line through `base` along `along`.
  struct Line {
    PointIndex point = 0, base = 0;
    VectorExpression along = {};
    core::SourcePosition where = {};
  };
  std::string name;
  PointIndex first = 0, last = 0;
  std::size_t count = 0;
  std::vector<Distance> distances = {};
  std::vector<Line> lines = {};
  std::vector<std::array<Rational, 3>> near = {};  ///< a place a point, at the pose Mechanism::near
  core::SourcePosition where = {};
};

/// A mass at a point of a link.
struct PointMass {
  PointIndex at = 0;
  Expression mass;  ///< kg
};

struct Link {
  std::string name;
  std::vector<PointIndex> points;     ///< first: origin of the link's frame, second: its direction
  Expression mass;                    ///< kg
  PointIndex centre_of_mass = 0;      ///< default: midpoint of the first two points
  std::optional<Expression> inertia;  ///< kg m^2 about the centre of mass; default: slender rod, m l^2/12
  core::SourcePosition where;
  std::vector<PointMass> masses = {};  ///< besides `mass`
};

/// A clearance given as a fit of ISO 286: somewhere between two values, of which `radial` is the larger.
struct Fit {
  std::string name;         ///< "H7/g6"
  Rational diameter;        ///< m
  Rational least, largest;  ///< difference of the radii, m
};

/// Clearances of a joint, m and rad; 0 where absent. A prismatic joint touches its guide in two places, `half_length`
/// to both sides of its point, each free to move by `gap` to either side; `axial` is the play of its actuator. A pin in
/// a slot has half of the slot's gap for its `radial`.
struct Clearance {
  Expression radial;
  Expression angular;
  Expression gap = {};
  Expression half_length = {};
  Expression axial = {};
  std::optional<Fit> fit = {};  ///< that `radial` was taken from
};

enum class JointType { revolute, prismatic, universal, spherical, cylindrical, slot, gear, belt, cable };

/// "revolute", ..., the key of the file.
std::string to_string(JointType type);

/// Of an actuator whose effort is chosen and not determined: the preload (docs/guide/preload.md). It is the value of a
/// parameter, and there are no forces where none is given.
struct FreeEffort {
  std::string parameter;                                     ///< preload_ and the joint's name, N m or N
  std::optional<std::pair<Rational, Rational>> within = {};  ///< what the motor can exert
  bool given = false;
};

/// Two wheels, or a wheel and a rack, whose teeth touch at the pitch point; or two pulleys. The joint's axis is the
/// line of action; a belt over pulleys of one size has none and carries a couple.
struct Meshing {
  PointIndex first = 0;                     ///< centre of `from`
  std::optional<PointIndex> second;         ///< centre of `to`; none of a rack
  std::optional<PointIndex> flank;          ///< of a gear: where the line of action touches the base circle of `from`
  Expression most = {};                     ///< of a belt: the couple or force beyond which a span is slack, N m or N
  Expression radius = {};                   ///< of the pitch circle of `from`, m
  std::optional<Expression> distance = {};  ///< of the centres, m, where the file gives it
};

/// The reaction is what link `from` exerts on link `to`, at point `at`. Axes: one of a prismatic and a cylindrical
/// joint, of a slot, of a gear (its line of action) and of a spatial revolute joint, two of a universal joint (the one
/// fixed in `from` first), none otherwise. Their lengths are of no consequence. A cable pulls along its axis, from its
/// end on `to` to that on `from`, with what its actuator exerts, and bears nothing else.
struct Joint {
  std::string name;
  JointType type = JointType::revolute;
  LinkIndex from = ground, to = ground;
  PointIndex at = 0;
  std::vector<VectorExpression> axes;
  bool actuated = false;  ///< what its actuator exerts is an unknown
  std::optional<Clearance> clearance;
  core::SourcePosition where;
  /// Of an actuator of known effort, N m or N, on `to` along its axis: a load between the two links, and no unknown.
  std::optional<Expression> effort = {};
  std::optional<FreeEffort> free_effort = {};                ///< with `effort`: the symbol of its parameter
  std::optional<std::pair<Rational, Rational>> within = {};  ///< of an actuator whose effort is determined: N m or N
  /// Of a free effort that is given by a law: what its actuator can exert, N m or N. Poses beyond are not of the
  /// workspace.
  std::optional<std::pair<Rational, Rational>> law_within = {};
  PointIndex other_end = 0;    ///< of a cable: its end on `from`; `at` is that on `to`
  bool holds_turning = false;  ///< of a cable: it bears a couple too, in place of the turning of a link without extent
  std::optional<Meshing> meshing = {};  ///< of a gear, which is actuated: its force is an unknown along its axis
};

/// Components are polynomials in the free coordinates (and cos, sin of an angle).
struct Load {
  LinkIndex link = 0;
  std::optional<PointIndex> at;   ///< required with `force`
  std::vector<Expression> force;  ///< empty, 2 or (spatial) 3 components, N
  Expression couple;              ///< N m, counter-clockwise; planar
  core::SourcePosition where;
  std::vector<Expression> couple_vector = {};         ///< empty or 3 components, N m; spatial
  std::optional<VectorExpression> force_vector = {};  ///< in place of `force`: a vector over points, N

  bool has_force() const { return !force.empty() || force_vector.has_value(); }

  /// The components of its couple, to be changed: one in the plane, three in space.
  std::vector<Expression*> couple_parts(Space space) {
    if (space == Space::planar) return {&couple};
    couple_vector.resize(3, Expression::number(0));
    return {&couple_vector[0], &couple_vector[1], &couple_vector[2]};
  }

  /// visit(expression, power of m in its unit): its numbers but those of `force_vector`.
  template <typename Visit>
  void each_number(const Visit& visit) {
    for (Expression& component : force) visit(component, 0);
    visit(couple, 1);
    for (Expression& component : couple_vector) visit(component, 1);
  }
};

/// Pulls its two ends together with stiffness (length - free length) or with a constant force; in a joint, turns its
/// links back to the angle `rest` with stiffness (angle - rest), the angle within half a turn of `rest`.
struct Spring {
  enum class Kind { linear, constant_force, torsion };
  std::string name;
  Kind kind = Kind::linear;
  LinkIndex from = ground, to = ground;
  PointIndex from_point = 0, to_point = 0;  ///< none of a torsion spring
  JointIndex joint = 0;                     ///< of a torsion spring
  Expression stiffness;                     ///< N/m; N m/rad of a torsion spring
  Expression free_length;                   ///< m
  Expression force;                         ///< N, of a constant-force spring
  Expression rest;                          ///< rad, of a torsion spring
  core::SourcePosition where;

  /// visit(expression, power of m in its unit).
  template <typename Visit>
  void each_number(const Visit& visit) {
    visit(stiffness, kind == Kind::torsion ? 1 : -1);
    visit(free_length, 1);
    visit(force, 0);
    visit(rest, 0);
  }
};

/// Keeps a distance of two points, or the angle between the ways from the second point to the first and the third
/// (0 to 180 deg), within two numbers: what is beyond is no part of the workspace.
struct Limit {
  std::vector<PointIndex> points;  ///< two of a distance, three of an angle
  Expression lower, upper;         ///< rad of an angle (is_angle), else m
  Rational lower_value, upper_value;
  core::SourcePosition where;
  /// Of a distance: links that meet in a joint never bring the points nearer, or farther apart.
  bool lower_out_of_reach = false, upper_out_of_reach = false;

  bool is_angle() const { return points.size() == 3; }
  /// Whether anything is beyond its ends: no angle is below 0 or above 180 deg, and no distance below 0.
  bool keeps_lower() const { return lower_value > 0 && !lower_out_of_reach; }
  bool keeps_upper() const { return is_angle() ? core::to_double(upper_value) < half_turn : !upper_out_of_reach; }
  static constexpr double half_turn = 3.14159265358979312;  ///< the double next to pi
};

/// A scalar unknown of the Newton-Euler equations: a component of the joint's reaction, or its actuator's.
struct Unknown {
  JointIndex joint = 0;
  core::Quantity quantity = core::Quantity::fx;
};

/// A frame of the file, in which points of a platform are placed: p = p_origin + R p', R row after row.
struct BodyFrame {
  std::string name;
  PointIndex origin = 0;                 ///< an explicit point
  std::vector<Expression> rotation;      ///< 4 or 9
  std::optional<Expression> angle = {};  ///< of its rotation in the plane, rad
};

/// A change of coordinates (mechanism/frame.hpp): place p = origin + scale p', free length q = from + scale q'.
struct Frame {
  std::array<Rational, 3> origin{};
  std::vector<Rational> from;  ///< one a free coordinate; 0 of an angle
  Rational scale = 1;

  bool is_usual() const;  ///< nothing changes
  double scale_value() const { return core::to_double(scale); }
};

struct Mechanism {
  std::string name;
  std::string file;
  Units units = {};
  Space space = Space::planar;
  std::vector<Parameter> parameters;
  std::vector<Coordinate> coordinates;
  std::vector<BodyFrame> body_frames;
  std::vector<Point> points;
  std::vector<Group> groups = {};   ///< in the order of their points
  std::vector<Rational> near = {};  ///< the pose of their postures; none without groups
  std::vector<Link> links;
  std::vector<Joint> joints;
  LinkIndex end_effector_link = 0;
  PointIndex end_effector_point = 0;
  LinkIndex relative_to = ground;  ///< the link that pose errors are relative to
  std::vector<Load> loads;
  std::vector<Expression> gravity;  ///< empty: links are weightless
  std::vector<Spring> springs = {};
  std::vector<Limit> limits = {};
  std::vector<std::string> notes = {};  ///< what its reader says of it, a line each
  /// The frame that it is seen in, if not its own: expressions are printed in the coordinates outside it.
  std::optional<Frame> frame = {};
};

/// The joints whose effort is free.
std::vector<JointIndex> preloaded_joints(const Mechanism& mechanism);
/// Those of which no value is given: none has forces before.
std::vector<JointIndex> joints_without_preload(const Mechanism& mechanism);
/// Of a joint whose effort is free: gives it this one, N or N m.
void give_effort(Mechanism& mechanism, JointIndex joint, const Rational& effort);

/// Whether the effort of some actuator is determined and has bounds: poses beyond them are not of the workspace.
bool has_effort_bounds(const Mechanism& mechanism);
/// The slack of a belt's spans as bounds of what it carries, for proofs that know no limits by efforts.
Mechanism with_bounded_belts(Mechanism mechanism);

/// A mass of a link and where it sits: that of its body and its point masses.
struct Mass {
  LinkIndex link = 0;
  PointIndex at = 0;
  Expression mass;  ///< kg
};

/// Every mass that is not written as 0, link after link.
std::vector<Mass> masses(const Mechanism& mechanism);

/// Unknowns in column order. Planar: fx, fy of every revolute joint, N, T of every prismatic one and N of every slot in
/// the file's order, then M or F of the actuated ones. Spatial: the components of every joint's force, then of its
/// couple. A force or couple that may have any direction has components x, y, z; one across an axis has two, 1 and 2;
/// the couple of a universal joint, across both of its axes, is T. The actuator of a revolute or prismatic joint fills
/// up its couple or force. The tensions of cables, F, come last.
std::vector<Unknown> unknowns(const Mechanism& mechanism);

/// The columns of one joint, without a planar joint's actuator.
std::vector<core::Quantity> reaction_components(const Mechanism& mechanism, const Joint& joint);

/// What the actuator of a joint, the teeth of a gear or a belt exerts: M or F.
core::Quantity actuator_quantity(const Joint& joint);

/// Force components that vanish together where contact is lost: in space those across the axis of a pin or a sleeve.
/// Empty for a prismatic joint.
std::vector<core::Quantity> force_components(const Mechanism& mechanism, const Joint& joint);

inline std::size_t dimension(const Mechanism& mechanism) { return mechanism.space == Space::spatial ? 3 : 2; }

/// Equations of one link: 3, or 6 in space.
inline std::size_t equations_per_link(const Mechanism& mechanism) { return mechanism.space == Space::spatial ? 6 : 3; }

/// "fA1x", "MA1".
std::string unknown_name(const Mechanism& mechanism, const Unknown& unknown);

/// Indices of the dyad and slider points, in order: each has two places, and the working mode a side for it.
std::vector<PointIndex> dyad_points(const Mechanism& mechanism);

/// The file's working mode: +1 left or ahead, -1 right or behind, one a point of dyad_points.
std::vector<int> working_mode(const Mechanism& mechanism);

/// "left", "right"; of a slider "ahead", "behind".
std::string side_name(const Mechanism& mechanism, PointIndex point, int sign);

}  // namespace clearloci::mechanism
