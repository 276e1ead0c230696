// A mechanism compiled to floating point, and its posture at a pose (method.md section 1). This folder never looks at
// the symbolic derivation or the traced curves: it is their independent witness.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/locus_map.hpp"
#include "mechanism/mechanism.hpp"
#include "numeric/elimination.hpp"
#include "numeric/tape.hpp"

namespace clearloci::numeric {

using core::Point2;
using Eigen::Vector3d;

/// Components of a vector along x, y and z as registers of the tape; in the plane the third is the constant 0.
using Triple = std::array<Register, 3>;

/// An external force or couple. `weight`: from gravity, not from the file's loads. `inner`: of a spring or an actuator
/// of known effort, with its opposite on another link or the ground.
struct LoadRegisters {
  mechanism::LinkIndex link = 0;
  std::optional<mechanism::PointIndex> at;  ///< may be absent from a pure couple
  Triple force{}, couple{};
  bool weight = false;
  bool inner = false;
  int spring = -1;  ///< of an inner one: which
};

/// Points that close together: their coordinates are inputs of the tape, of which equations are zero.
struct GroupBlock {
  int first_input = 0;
  int begin = 0, end = 0;           ///< instructions from its first unknown to its last derivative
  std::vector<Register> unknowns;   ///< inputs
  std::vector<Register> equations;  ///< as many
  std::vector<Register> jacobian;   ///< row after row
};
class GroupStarts;

/// A mechanism of the plane or of space: a link has three rows, fx, fy, mz, or six.
struct NumericModel {
  mechanism::Mechanism mechanism;
  std::vector<mechanism::Unknown> unknowns;  ///< columns of A; in space: of equations.hpp
  std::vector<mechanism::PointIndex> dyads;  ///< dyads and sliders: the working mode has a sign for each
  std::vector<std::array<double, 2>> box;    ///< lower, upper of each free coordinate: rad of an angle, else m
  Tape tape;  ///< inputs: free coordinates, then the signs of the working mode, then the unknowns of the groups
  std::vector<GroupBlock> groups;
  std::shared_ptr<GroupStarts> group_starts;  ///< of their unknowns (group_solution.hpp)
  int posture_size = 0;                       ///< instructions that compute points and loads
  int reaction_size = 0;                      ///< and with them the reactions; the rest serves the unit wrenches
  /// Finite where every point can be placed, every axis has a direction and no limit is broken.
  std::vector<Register> placed;
  /// Of every limit what is left to its lower and upper end, negative beyond it; none where no pose is beyond.
  std::vector<std::array<std::optional<Register>, 2>> slack;
  /// A and the loads as they stand before anything is eliminated, with the instructions that compute them; and where
  /// the rows of the links are among theirs (equations.hpp).
  SparseEquations equations;
  int equations_size = 0;
  std::vector<std::size_t> link_rows;
  Elimination elimination;
  /// The same matrix under a unit of each component of a wrench on the end effector, 3 or 6.
  std::vector<Elimination> unit_wrenches;

  std::vector<Triple> points;        ///< of every point
  std::vector<LoadRegisters> loads;  ///< the file's in order, then springs and actuators, then the weights
  /// Of every joint: the unit vector of its axis, of a universal joint of the first; in the plane k where none is
  /// written. Nothing for a ball.
  std::vector<std::optional<Triple>> axes;
  /// Of every joint that bears a couple about one direction alone: that direction.
  std::vector<std::optional<Triple>> couple_axes;
  /// Of universal joints the second axis, of `to`: a unit vector.
  std::vector<std::optional<Triple>> second_axes;
  std::optional<Triple> gravity;
  /// Of every joint in space: the Cartesian directions, 0 to 2, of its components 1 and 2 across the axis.
  std::vector<std::array<int, 2>> across;

  int inputs() const {
    std::size_t count = box.size() + dyads.size();
    for (const GroupBlock& group : groups) count += group.unknowns.size();
    return static_cast<int>(count);
  }
};

/// Requires as many unknowns as equations. Throws core::InputError otherwise.
NumericModel compile(const mechanism::Mechanism& mechanism);

/// The column of a joint's reaction; -1 where it has none of that kind.
int column_of(const NumericModel& model, mechanism::JointIndex joint, core::Quantity quantity);

/// A force (N) and a couple (N m) applied to a link from outside the mechanism.
struct AppliedLoad {
  mechanism::LinkIndex link = 0;
  Vector3d at = Vector3d::Zero();
  Vector3d force = Vector3d::Zero(), couple = Vector3d::Zero();
  bool weight = false;
  bool inner = false;  ///< as LoadRegisters
  int spring = -1;     ///< likewise
};

inline Point2 in_plane(const Vector3d& v) { return {v[0], v[1]}; }

/// An end of a limit.
struct LimitEnd {
  std::size_t limit = 0;
  bool upper = false;
  double slack = 0;  ///< what is left to it, negative beyond; of a distance over its size, of an angle in its cosine
};

/// Every point and load at one pose, in m, in the ground's frame; of the plane with z = 0.
struct Posture {
  std::vector<Vector3d> points;                      ///< as mechanism.points; NaN from the unreachable one on
  std::vector<AppliedLoad> loads;                    ///< as NumericModel::loads
  std::vector<Vector3d> axes, couple_axes;           ///< as NumericModel's; zero without one
  Vector3d gravity = Vector3d::Zero();               ///< m/s²
  std::optional<mechanism::PointIndex> unreachable;  ///< the first point that cannot be placed
  std::optional<mechanism::JointIndex> undirected;   ///< the first joint with an axis that has no direction
  std::optional<LimitEnd> broken;                    ///< the first limit that the pose is beyond

  bool reachable() const { return !unreachable && !undirected && !broken; }
};

/// `pose`: one value a free coordinate; `mode`: +1 (left) or -1 (right) a dyad. A pose on the workspace boundary is
/// reachable; one where a dyad's two base points coincide is not, for its apex is then undefined.
Posture posture(const NumericModel& model, std::span<const double> pose, std::span<const int> mode);

/// The end of a limit that the pose is farthest beyond, or that is nearest where it keeps all; none where there is no
/// limit or some point cannot be placed. Of mechanisms of the plane and of space.
std::optional<LimitEnd> tightest_limit(const NumericModel& model, std::span<const double> pose,
                                       std::span<const int> mode);

/// The median length of the links, m: a scale for pictures. 1 where no link has a length.
double typical_length(const NumericModel& model, const Posture& posture);

/// Signs of the model's dyads in a traced mode: entries of `length` roots are dropped, the rest matched by point name.
/// Throws core::InputError if the tower lacks one of the dyads.
std::vector<int> dyad_signs(const NumericModel& model, const core::TowerNames& tower, const core::WorkingMode& mode);

}  // namespace clearloci::numeric
