// What do the joints bear at one pose, and how far is the end effector from where it should be? Posture, reactions, the
// take-up of the clearances and the pose error that follows from it (docs/background/method.md sections 1, 2 and 6;
// docs/reference/results.md, pose --json), of mechanisms of the plane and of space alike.
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     const clearloci::Pose pose = clearloci::solve_pose(model, {0.25, -0.7});
//     if (pose.error) std::cout << "dx " << pose.error->displacement[0] << " m\n";
//     for (const clearloci::Vanishing& lost : pose.vanishing) std::cout << "contact is lost at " << lost.joint << "\n";
//
// Places and displacements have two components in the plane and three in space, in m; rotations one (counter-clockwise)
// and three (about x, y, z), in rad; forces are in N, couples in N m.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clearloci/mechanism.hpp"
#include "clearloci/quantity.hpp"
#include "clearloci/table.hpp"
#include "clearloci/units.hpp"

namespace clearloci::inline core {

struct PosePoint {
  std::string name;
  std::vector<double> at;  ///< m
};

/// One component of what a joint's link `from` exerts on its link `to`.
struct ReactionComponent {
  Quantity quantity = Quantity::fx;
  double value = 0;  ///< N or N m, by unit_of(quantity); infinite or NaN where |A| = 0
};

/// In the plane fx, fy or, of a prismatic joint, N, T; then the actuator's M or F. In space the force and the couple
/// without the actuator's share, and that as M or F.
struct JointReaction {
  std::string joint;
  std::vector<ReactionComponent> components;
};

/// How one joint takes up its clearance: `to` relative to `from`. A part that the joint has no play for is empty or
/// absent; it is NaN where it has, and the reaction that would decide it vanishes.
struct JointTakeUp {
  std::string joint;
  std::vector<double> displacement;  ///< of the pin, m
  std::optional<double> beta;        ///< direction of a planar pin's displacement, from the y axis towards x, rad
  std::optional<double> rotation;    ///< play of an actuator that turns, rad
  std::optional<double> normal;      ///< across a planar guide, m
  std::optional<double> tilt;        ///< in a planar guide, rad
  std::optional<double> axial;       ///< play of an actuator that slides, m
};

/// Efforts of a free actuator from one at which a demanded reaction fails to the next, N or N m.
struct EffortRange {
  double from = 0, to = 0;  ///< infinite where nothing ends it
  std::vector<Vanishing> below,
      above;  ///< what fails at either end; empty where the motor's own range ends, or nothing
};

/// Which efforts of one free actuator keep every demanded reaction at a pose, the efforts of other free ones held
/// (preload.md). At each end of a range a reaction vanishes or, where a least one is asked for, has it: known to
/// rounding, on the range's side.
struct FeasibleEfforts {
  std::string joint;
  bool force = false;  ///< N, else N m
  bool cable = false;  ///< a tension: then the others are not held, and the one range is all that it may be
  double effort = 0;   ///< that the pose is of
  bool given = false;  ///< else chosen: the smallest that is feasible
  std::optional<std::array<double, 2>> within = {};
  std::vector<EffortRange> ranges = {};  ///< in order
  std::vector<Vanishing> never = {};     ///< fail at every effort, or exclude each other: then there are no ranges
};

/// Of the end effector.
struct PoseError {
  std::vector<double> displacement;  ///< of its point, m
  std::vector<double> rotation;      ///< rad
};

/// Upper bounds over all take-ups: for a designer who does not know the load. Infinite at a direct singularity.
struct WorstCase {
  std::vector<double> displacement;  ///< of each component, m
  std::vector<double> rotation;      ///< of each component, rad
  double distance = 0;               ///< of the displacement's length, m
  double angle = 0;                  ///< of the rotation's size, rad
};

/// Where a link's points are with the clearances taken up.
struct DisplacedLink {
  std::string link;
  std::vector<PosePoint> points;
};

/// Beyond the linear step: the pose in which the mechanism closes with its clearances taken up, its reactions being
/// those of that same displaced geometry. Planar.
struct ActualPose {
  bool converged = false;
  std::string reason;  ///< why not, as a clause; then nothing else is known
  PoseError error;
  PoseError beyond_linear;  ///< `error` minus that of the linear step
  std::vector<JointTakeUp> take_up;
  std::vector<DisplacedLink> links;
  int iterations = 0;
  double residual = 0;  ///< what is left open of the closure: the largest of all distances in m and turns in rad
};

struct Pose {
  std::string mechanism;
  std::vector<std::pair<std::string, std::string>> parameters;    ///< name, exact value ("1/2", "3 N/mm")
  std::vector<double> at;                                         ///< of each coordinate: rad of an angle, else m
  std::vector<bool> angles;                                       ///< which coordinates are angles
  std::vector<std::pair<std::string, std::string>> working_mode;  ///< {"B1", "right"}, ...
  /// The first point that cannot be placed: the pose is out of reach, and nothing below is known. Else empty.
  std::string unreachable;
  /// The limit that the pose is beyond: "distance A1-P at 0.52 m"; then nothing below is known either. Else empty.
  std::string beyond_limit;
  std::vector<PosePoint> points;
  std::vector<JointReaction> reactions;  ///< of every joint in the file's order
  double determinant = 0;                ///< |A|, of the equations in SI units
  double condition = 0;                  ///< 2-norm condition number of A
  bool singular = false;                 ///< |A| cannot be told from zero
  std::vector<JointTakeUp> take_up;      ///< of the joints with a clearance
  std::optional<PoseError> error;        ///< to the first order; absent where a take-up is undefined
  WorstCase worst;
  std::vector<std::string> undefined;         ///< joints whose take-up is
  std::vector<Vanishing> vanishing;           ///< reactions that leave it so
  std::optional<ActualPose> actual;           ///< where it is asked for
  std::vector<FeasibleEfforts> efforts = {};  ///< of free actuators, at rest and where |A| is not zero
  std::string relative_to = {};               ///< the link that errors are relative to; empty: the ground
  Units units = {};                           ///< of the mechanism file: what tables speak in
  std::vector<std::string> notes = {};        ///< such as what a clearance stands for
};

/// A pose in one of the working modes.
struct ModePose {
  std::vector<std::pair<std::string, std::string>> working_mode;  ///< {"B1", "right"}, ...
  std::optional<Pose> pose;
  std::string why_not = {};  ///< where there is none, as a clause: "point B1 cannot be placed"
};

/// A pose in every working mode.
struct PoseInModes {
  std::string mechanism;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name, exact value ("1/2", "3 N/mm")
  std::vector<ModePose> modes;
};

/// Scalar reactions at many poses.
struct Reactions {
  /// One a column: "fA1x", "fA1y", ..., "MA1", as the equations name their unknowns; N or N m. NaN where a pose is out
  /// of reach, infinite or NaN where |A| = 0.
  Table table;
  std::vector<std::string> joints;   ///< of each column
  std::vector<Quantity> quantities;  ///< of each column
};

}  // namespace clearloci::inline core

namespace clearloci {

struct PoseRequest {
  DyadSides working_mode = {};  ///< empty: the file's
  bool iterate = false;         ///< also `actual`
  /// Rates of the coordinates, one each, m/s and m/s^2 or rad/s and rad/s^2; empty: at rest. Not
  /// with `iterate`. Reactions, take-up and error then are those with the links' inertia.
  std::vector<double> velocity = {};
  std::vector<double> acceleration = {};
  /// What the efforts of free actuators are to keep in every joint, N and N m.
  std::optional<Rational> min_force = {}, min_couple = {};
};

/// `at`: one value a free coordinate, m or, of an angle (Model::coordinates), rad. A double stands for the shortest
/// decimal that reads back as it: 0.1 is 1/10, and a pose on a locus there is told to be on it. A free effort without a
/// value is the smallest feasible one, or 0, and a note says so.
/// Throws InputError where the number of values or of sides is wrong, a value is no finite number, the equations are
/// not square, or |A| vanishes in every pose of the working mode.
Pose solve_pose(const Model& model, const std::vector<double>& at, const PoseRequest& request = {});

/// Throws core::InputError, of `option`, where the pose error was to be iterated and does not settle.
void require_iterated(const Pose& pose, const std::string& option);

/// The same in every working mode: where a mode has no such pose, why. Throws likewise for what is wrong in all of
/// them; `request.working_mode` is passed over.
PoseInModes solve_pose_in_modes(const Model& model, const std::vector<double>& at, const PoseRequest& request = {});

/// `poses`: pose after pose, each with one value a free coordinate as of solve_pose. Planar mechanisms by the compiled
/// elimination, some million poses a second. Throws as solve_pose.
Reactions reactions(const Model& model, std::span<const double> poses, const DyadSides& working_mode = {});

}  // namespace clearloci
