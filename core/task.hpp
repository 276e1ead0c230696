// What a design is verified for (results.md): where the pose moves, in the plane of two free coordinates, and what it
// must keep clear of.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::core {

using RationalPoint = std::array<Rational, 2>;

struct TaskBox {
  RationalPoint lower, upper;
};
struct TaskCircle {
  RationalPoint centre;
  Rational radius;
};
/// A simple polygon; the last corner is joined to the first.
struct TaskPolygon {
  std::vector<RationalPoint> corners;
};
/// Straight from point to point; it has no interior.
struct TaskPath {
  std::vector<RationalPoint> points;
};
using TaskShape = std::variant<TaskBox, TaskCircle, TaskPolygon, TaskPath>;

/// The load turns from one vector to the other: every (1 - t) first + t second, N.
struct LoadRange {
  RationalPoint first, second;
};

struct Task {
  std::string file;
  TaskShape shape;
  Rational margin = 0;                 ///< m that must be left to the nearest locus
  std::optional<Rational> min_force;   ///< N, that every wanted joint keeps
  std::optional<Rational> min_couple;  ///< N m
  std::optional<LoadRange> loads;      ///< instead of the force of the mechanism's one load
};

/// "box", "circle", "polygon" or "path".
std::string kind_of(const TaskShape& shape);

TaskShape translated(const TaskShape& shape, const RationalPoint& by);

/// The corners of the smallest box around it.
std::array<RationalPoint, 2> bounds(const TaskShape& shape);

}  // namespace clearloci::core
