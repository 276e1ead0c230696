// Does the mechanism keep clear of its loci over a task of poses: of one to six free coordinates, angles among them?
// What clearloci/verify.hpp asks over two lengths, asked of intervals, volumes and volumes with orientations, by proofs
// over cells and without traced loci.
//
//     const clearloci::Model model = clearloci::Model::read("hexapod.yaml");
//     const clearloci::PoseTask task = clearloci::read_pose_task("poses.yaml", model);
//     const clearloci::PoseVerification answer = clearloci::verify_poses(model, task);
//
// Lengths in m, angles in rad, forces in N, couples in N m. Poses are lists of one value a free coordinate.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "clearloci/verify.hpp"

namespace clearloci::inline core {

using RationalPose = std::vector<Rational>;

struct PoseBoxShape {
  RationalPose lower, upper;
};
/// Distances are those of the task's metric: an angle counts `angle_length` m a radian.
struct PoseBallShape {
  RationalPose centre;
  Rational radius;
};
/// Straight from pose to pose, coordinate by coordinate.
struct PosePathShape {
  std::vector<RationalPose> points;
};
/// Over three lengths, a solid by its closed surface: every point that the surface winds around, whatever the sense of
/// its triangles, and the surface itself. What a shell within the solid encloses the other way round is a hollow.
struct PoseMeshShape {
  std::string file;
  std::vector<std::array<double, 3>> corners;  ///< m; each differs from the others
  std::vector<std::array<int, 3>> triangles;   ///< every edge as often one way as the other
};
using PoseShape = std::variant<PoseBoxShape, PoseBallShape, PosePathShape, PoseMeshShape>;

/// "box", "ball", "path", "mesh".
std::string kind_of(const PoseShape& shape);

struct PoseTask {
  std::string file;
  PoseShape shape;
  Rational margin = 0;  ///< m around the task; rad where every coordinate is an angle and there is no `angle_length`
  std::optional<Rational> angle_length;  ///< m a radian; without it margins are of lengths alone
  std::optional<Rational> min_force;     ///< N, that every wanted joint keeps
  std::optional<Rational> min_couple;    ///< N m
  /// Instead of the force of the mechanism's one load: every (1 - t) first + t second, N.
  std::optional<std::pair<RationalPose, RationalPose>> loads;
};

/// A pose of the task or its margin at which it fails, confirmed by numeric/ (TaskWitness has the kinds).
struct PoseTaskWitness {
  TaskWitness::Kind kind = TaskWitness::Kind::unreachable;
  std::vector<double> at;
  std::vector<Vanishing> reactions;  ///< that vanish or are too small
  std::optional<double> size;        ///< of the first of them, N or N m
  std::optional<Rational> least;     ///< that is asked of it
  std::vector<double> load;          ///< N; of a range of loads, where it takes one
  double distance = 0;               ///< from the task
  std::string limit = {};  ///< that it is beyond, or that passes there: "distance A1-P at 0.92 m"; may be empty
};

/// A locus that was found near the task: the margin is at most `distance`.
struct NearestToPoses {
  LocusKind kind = LocusKind::contact_loss;
  std::vector<Vanishing> reactions;
  std::vector<double> at;
  double distance = 0;
};

/// What a reaction has at least over the task: proven, and the least that was met.
struct LeastReaction {
  Vanishing reaction;
  double proven = 0, met = 0;  ///< N or N m
};

/// What a verdict of `undecided` leaves open.
struct OpenPoses {
  std::size_t cells = 0;
  std::vector<double> lower, upper;  ///< of the box around them
  OpenTask::Reason reason = OpenTask::Reason::doubles;
};

struct PoseVerification {
  PoseTask task;
  std::string mechanism;
  std::vector<std::string> coordinates;
  std::vector<bool> angles;
  std::vector<std::pair<std::string, std::string>> working_mode;  ///< as describe_mode
  Verdict verdict = Verdict::undecided;
  /// Proven to be free around the task: m in the task's metric; without `angle_length` in m with the angles of the
  /// task, and in rad with its lengths. None where not verified, or where there is no such coordinate.
  std::optional<double> margin, angle_margin;
  std::optional<NearestToPoses> nearest;
  std::optional<PoseTaskWitness> witness;  ///< where refuted
  std::optional<OpenPoses> open;           ///< where undecided
  /// What fit_poses has done to the task, which is told as it is then: moved by so much, scaled by that. None where it
  /// was not asked for, or nothing was found.
  std::optional<std::vector<double>> by;
  std::optional<double> scale;
  std::vector<LeastReaction> least;  ///< where verified
  long cells = 0;                    ///< that were looked at for the verdict
  std::vector<std::string> notes;
  Units units = {};  ///< of the mechanism file

  bool verified() const { return verdict == Verdict::verified; }
};

}  // namespace clearloci::inline core

namespace clearloci {

/// Throws InputError for whatever is wrong with the file, and for mechanisms of two lengths in the plane, whose tasks
/// are those of clearloci/verify.hpp.
PoseTask read_pose_task(const std::string& path, const Model& model);
PoseTask parse_pose_task(const std::string& text, const Model& model, const std::string& file = "task");

/// In the first of the request's working modes. The task's `min_force` and `min_couple` take the place of the
/// request's. Where the request's deadline comes first, what is not proven is undecided.
PoseVerification verify_poses(const Model& model, const PoseTask& task, const LociRequest& request = {});

enum class PoseFit {
  nearest,  ///< moved along the lengths, where there are any, as little as was found to be enough
  best,     ///< moved to where the nearest locus found is farthest
  largest,  ///< scaled about its middle, to one part in 100
};

/// Moved or scaled within the mechanism's box, so that it is verified, and as verify_poses; where no place or scale was
/// found that is, as it lies. What it says of the task is proven; that nothing nearer, better or larger is verified is
/// not.
PoseVerification fit_poses(const Model& model, const PoseTask& task, PoseFit goal, const LociRequest& request = {});

/// The verdict alone, with its witness or what is open: no margin and no least reactions.
PoseVerification decide_poses(const Model& model, const PoseTask& task, const LociRequest& request = {});

}  // namespace clearloci
