// The exact model of a mechanism: what its file says, checked, with every name resolved. See mechanism-format.md.
// Units are SI throughout: m, kg, s, N, N m, rad.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/errors.hpp"
#include "core/expression.hpp"
#include "core/quantity.hpp"
#include "core/rational.hpp"

namespace clearloci::mechanism {

using core::Expression;
using core::Rational;

using PointIndex = int;
using LinkIndex = int;
using JointIndex = int;
inline constexpr LinkIndex ground = -1;

enum class Space { planar, spatial };

/// A named exact number. `value` equals the expression where that is rational, else is within 1e-30 of it.
struct Parameter {
  std::string name;
  Expression expression;
  Rational value;
  bool exact = true;
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
/// The point at distance `from_length` from `from` and `to_length` from `to`, on the named side of from -> to.
struct DyadPoint {
  PointIndex from, to;
  Expression from_length, to_length;
  Side side;
};
/// In the frame of first -> second: `along` m along it and `left` m to its left.
struct OffsetPoint {
  PointIndex first, second;
  Expression along, left;
};
struct MeanPoint {
  PointIndex first, second;
};
using PointForm = std::variant<ExplicitPoint, DyadPoint, OffsetPoint, MeanPoint>;

/// Points are in an order in which each uses only earlier ones. `auxiliary` points (centres of mass) were not named by
/// the user; they stand last.
struct Point {
  std::string name;
  PointForm form;
  bool auxiliary = false;
  core::SourcePosition where;
};

struct Link {
  std::string name;
  std::vector<PointIndex> points;     ///< first: origin of the link's frame, second: its direction
  Expression mass;                    ///< kg
  PointIndex centre_of_mass = 0;      ///< default: midpoint of the first two points
  std::optional<Expression> inertia;  ///< kg m^2 about the centre of mass; default: slender rod, m l^2/12
  core::SourcePosition where;
};

/// Clearances of a joint, m and rad; 0 where absent.
struct Clearance {
  Expression radial;
  Expression angular;
};

enum class JointType { revolute };

/// The reaction is what link `from` exerts on link `to`, at point `at`.
struct Joint {
  std::string name;
  JointType type = JointType::revolute;
  LinkIndex from = ground, to = ground;
  PointIndex at = 0;
  bool actuated = false;
  std::optional<Clearance> clearance;
  core::SourcePosition where;
};

struct Load {
  LinkIndex link = 0;
  std::optional<PointIndex> at;   ///< required with `force`
  std::vector<Expression> force;  ///< empty or 2 components, N
  Expression couple;              ///< N m, counter-clockwise
  core::SourcePosition where;
};

/// A scalar unknown of the Newton-Euler equations: a component of the joint's reaction, or its actuator's.
struct Unknown {
  JointIndex joint = 0;
  core::Quantity quantity = core::Quantity::fx;
};

struct Mechanism {
  std::string name;
  std::string file;
  Space space = Space::planar;
  std::vector<Parameter> parameters;
  std::vector<Coordinate> coordinates;
  std::vector<Point> points;
  std::vector<Link> links;
  std::vector<Joint> joints;
  LinkIndex end_effector_link = 0;
  PointIndex end_effector_point = 0;
  std::vector<Load> loads;
  std::vector<Expression> gravity;  ///< empty: links are weightless
};

/// Unknowns in column order: fx, fy of every joint in the file's order, then the couples of the actuated ones.
std::vector<Unknown> unknowns(const Mechanism& mechanism);

/// "fA1x", "MA1".
std::string unknown_name(const Mechanism& mechanism, const Unknown& unknown);

/// Indices of the dyad points, in order: root j of the tower places the j-th of them.
std::vector<PointIndex> dyad_points(const Mechanism& mechanism);

/// The file's working mode: +1 left, -1 right, one a dyad point.
std::vector<int> working_mode(const Mechanism& mechanism);

}  // namespace clearloci::mechanism
