// Does the mechanism keep clear of its loci over a task: over poses of one to six free coordinates? Proven for every
// pose of the task and every load, refuted by a witness that is confirmed numerically, or left undecided, and said to
// be (docs/reference/results.md, verify.json).
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     const clearloci::Task task = clearloci::read_task("tasks/pick_and_place.yaml", model);
//     const clearloci::Verification answer = clearloci::verify(model, task);
//     if (answer.verified()) std::cout << "free of loci, and " << *answer.margin << " m around it\n";
//
// Lengths in m, angles in rad, forces in N, couples in N m. Poses are lists of one value a free coordinate.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/zones.hpp"

namespace clearloci::inline core {

using RationalPose = std::vector<Rational>;

struct TaskBox {
  RationalPose lower, upper;
};
/// Distances are those of the task's metric: an angle counts `angle_length` m a radian. A circle is a ball of two
/// lengths.
struct TaskBall {
  RationalPose centre;
  Rational radius;
};
/// A simple polygon over two lengths; the last corner is joined to the first. Over more coordinates it goes with a
/// range of each of the others: from its value at the corners, which is one, to so much above it.
struct TaskPolygon {
  std::vector<RationalPose> corners;
  std::array<std::size_t, 2> across = {0, 1};  ///< the two lengths
  RationalPose above = {};                     ///< over more than two coordinates; 0 of the two
};
/// Straight from pose to pose, coordinate by coordinate; it has no interior.
struct TaskPath {
  std::vector<RationalPose> points;
};
/// Over three lengths, a solid by its closed surface: every point that the surface winds around, whatever the sense of
/// its triangles, and the surface itself. What a shell within the solid encloses the other way round is a hollow.
struct TaskMesh {
  std::string file;
  std::vector<std::array<double, 3>> corners;  ///< m; each differs from the others
  std::vector<std::array<int, 3>> triangles;   ///< every edge as often one way as the other
};
using TaskShape = std::variant<TaskBox, TaskBall, TaskPolygon, TaskPath, TaskMesh>;

/// The load turns from one vector to the other: every (1 - t) first + t second, N.
struct LoadRange {
  RationalPose first, second;  ///< of two components in the plane, of three in space
};

/// A parameter of the mechanism file, and how far below and above its value designs may be (below <= 0 <= above).
struct Tolerance {
  std::string parameter;
  Rational below, above;
};

/// Any force that differs from a load's by at most `force`, N, in any direction, and any couple by `couple`, N m.
struct LoadWithin {
  std::size_t load = 0;  ///< of the mechanism file, from 0
  Rational force = 0, couple = 0;
};

struct Task {
  std::string file;
  TaskShape shape;
  /// m around the task that must be left to the nearest locus; rad where every coordinate is an angle and there is no
  /// `angle_length`
  Rational margin = 0;
  std::optional<Rational> min_force = {};   ///< N, that every wanted joint keeps
  std::optional<Rational> min_couple = {};  ///< N m
  std::optional<LoadRange> loads = {};      ///< instead of the force of the mechanism's one load
  std::vector<Tolerance> tolerances = {};
  std::vector<LoadWithin> loads_within = {};
  std::optional<Rational> pose_error = {};    ///< m, that the clearances may displace the end effector at most
  std::optional<Rational> angle_length = {};  ///< m a radian; without it margins are of lengths alone
  /// Joints of free effort and what each exerts, N or N m. Of the others one choice for the whole task is looked for.
  std::vector<std::pair<std::string, Rational>> preload = {};
  /// Efforts that vary with the pose are looked for instead; with `knows_load` also with the load, affine in it.
  bool controlled_preload = false, knows_load = false;
};

/// What is not proven is never called refuted.
enum class Verdict { verified, refuted, undecided };

/// "verified", "refuted", "undecided".
std::string to_string(Verdict verdict);

/// What is done with a task that fails where it lies.
enum class TaskFit {
  none,
  nearest,  ///< moved along the lengths, where there are any, to the nearest place that verifies
  best,     ///< moved to the place of the largest margin
  largest,  ///< scaled about its middle, to one part in 100
};

/// One load of the mechanism file at a witness.
struct WitnessLoad {
  std::size_t load = 0;        ///< from 0
  std::vector<double> force;   ///< N
  std::vector<double> couple;  ///< N m: one number in the plane, three in space
};

/// A pose of the task, or of the margin around it, at which it fails, confirmed by numeric/.
struct TaskWitness {
  enum class Kind {
    unreachable,  ///< the mechanism does not reach it
    boundary,     ///< the boundary of the workspace passes there
    singular,     ///< |A| vanishes
    vanishing,    ///< the reactions `vanishing` do
    too_small,    ///< the reactions `too_small` bear less than they have to
    displaced,    ///< the clearances displace the end effector farther than they may
    beyond_bound  ///< the effort `beyond_bound` is not within its bounds
  };
  Kind kind = Kind::unreachable;
  std::vector<double> at = {};
  std::vector<Vanishing> vanishing = {};
  std::vector<double> load = {};  ///< N; of a range of loads, where it takes one
  std::vector<Vanishing> too_small = {};
  std::vector<Vanishing> beyond_bound = {};
  /// Of the first of them, N or N m; of the displacement, m. Without one, those of `too_small` bear nothing in any
  /// pose.
  std::optional<double> size = {};
  std::optional<Rational> least = {};  ///< that is asked of it, N or N m; of an effort its lower bound
  std::optional<Rational> most = {};   ///< that the displacement may be, m; of an effort its upper bound
  double distance = 0;                 ///< from the task
  std::string limit = {};              ///< of the first two kinds, the one that is broken: "distance A1-P at 0.52 m"
  std::vector<std::pair<std::string, double>> design = {};  ///< parameters that have a tolerance
  std::vector<WitnessLoad> loads = {};                      ///< those that may differ
};

/// The nearest locus that was found: the margin is at most `distance`.
struct NearestOfTask {
  std::string curve = {};  ///< LocusCurve::id; empty: an isolated point, or not among the traced loci
  LocusKind kind = LocusKind::contact_loss;
  std::vector<Vanishing> vanishing = {};
  std::vector<double> at = {};
  double distance = 0;     ///< in the task's metric; negative: its depth inside the task
  bool isolated = false;   ///< a point of contact loss
  std::string limit = {};  ///< of a boundary, the limit that makes it
};

/// What a reaction has at least over the task: proven, and the least that was met.
struct LeastReaction {
  Vanishing reaction;
  double proven = 0, met = 0;  ///< N or N m
};

/// What a verdict of `undecided` leaves open; the rest of the task and of its margin is proven.
struct OpenTask {
  enum class Reason { time, cells, doubles };  ///< ran out, or tell no more apart there
  std::size_t cells = 0;                       ///< that stayed open
  std::vector<double> lower, upper;            ///< the box around them
  Reason reason = Reason::doubles;
};

/// Values of one quantity, joined, that all verify, with an enclosure of either end. Beyond an enclosure all fail,
/// proven, or what was looked at ends.
struct ProvenRange {
  std::array<double, 2> from{}, to{};
  std::string below = {}, above = {};  ///< why values beyond fail; empty where what was looked at ends there
};

/// An effort that varies with the pose and keeps a task free of loci.
struct PreloadLaw {
  std::string expression;          ///< in the coordinates, with units: "-6.1 N m + 25 N*(x - 0.05 m)"
  std::array<double, 2> within{};  ///< what it takes over the task: between these, proven
};

/// Of free efforts lambda, N or N m: that sign * reaction = offset + slope . lambda must be positive, or above its
/// least.
struct PreloadRow {
  std::string reaction;  ///< "M_A1"
  int sign = 1;
  bool bound = false;         ///< of a bound, or of the size of a preload: what is left to it
  std::vector<double> at;     ///< the pose; empty: of an effort itself
  std::vector<double> load;   ///< what the loads differ by there, as in the task's loads_within
  std::vector<double> slope;  ///< one a free effort
  double offset = 0;
  double multiplier = 0;  ///< positive; with those of the other rows slopes cancel and offsets add up below zero
};

/// What is known of preloads under which reactions have certain signs all over a task.
struct PreloadPattern {
  std::vector<std::pair<std::string, int>> signs;  ///< of reactions of one component
  Verdict verdict = Verdict::undecided;            ///< verified: some preload verifies; refuted: none, proven
  std::array<double, 2> size{};                    ///< of the smallest that verifies, at least and at most: proven
  std::optional<std::vector<double>> value = {};   ///< a constant one that verifies, of the second size
  std::vector<PreloadRow> refutation = {};         ///< rows that exclude each other: of all, or of smaller sizes
  std::vector<std::string> joints = {};            ///< whose efforts their slopes are of; other cables follow
};

/// A cell of a law: efforts that are proven in all of it.
struct PreloadLawCell {
  std::vector<double> lower, upper;          ///< poses
  std::vector<std::string> joints;           ///< whose efforts are chosen; those of others follow
  std::vector<std::vector<double>> efforts;  ///< under the first load of a range and under the last
  std::vector<std::vector<double>> gains;    ///< of each part of loads_within what it adds to the efforts, a unit
};

/// Which constant efforts of the free actuators make a task verify (docs/guide/preload.md), or which law. The size of a
/// preload is the largest of its efforts, each as a part of the larger bound of its `within`, or of 1 N or 1 N m where
/// it has none.
struct PreloadAnswer {
  std::vector<std::string> joints;   ///< of free effort, those without a value
  std::vector<bool> forces;          ///< N, else N m
  std::vector<double> lower, upper;  ///< where each was looked for
  /// The smallest that was found: what the rest of the answer is of. None: no preload was found.
  std::optional<std::vector<double>> value;
  /// What the smallest size that verifies is at least and at most: proven. Without `value` the second is infinite.
  std::array<double, 2> size{};
  std::vector<ProvenRange> ranges;  ///< of one free effort: all that verify, in order
  long cells = 0;                   ///< boxes of efforts, or laws, that were looked at
  /// Of a task with `controlled_preload`; `value` and `ranges` are empty then. `size` is that of any law, at least and
  /// at most.
  std::optional<PreloadLaw> law = {};
  bool of_poses = false;                          ///< of a task with `controlled_preload`: efforts chosen cell by cell
  std::vector<PreloadLawCell> cells_of_law = {};  ///< then, where it is verified: they cover the task
  std::vector<PreloadPattern> patterns = {};      ///< of all signs that some preload gives at a pose of the task
};

struct Verification {
  Task task;  ///< as verified: moved and scaled where a place was looked for
  std::string mechanism;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name, exact value ("1/2", "3 N/mm")
  std::vector<std::string> coordinates;
  std::vector<bool> angles;
  std::vector<std::pair<std::string, std::string>> working_mode;  ///< as describe_mode
  Verdict verdict = Verdict::undecided;
  /// Proven to be free around the task: m in the task's metric; over lengths and angles without `angle_length` m with
  /// the angles of the task, and rad with its lengths. None where not verified, or where there is no such coordinate.
  std::optional<double> margin, angle_margin;
  std::optional<double> pose_error;  ///< m, a proven upper bound over the task, where it asks for one
  std::string zone;                  ///< Zone::id; empty where not verified, or not over two lengths
  std::optional<NearestOfTask> nearest;
  std::optional<TaskWitness> witness;  ///< where refuted
  std::optional<OpenTask> open;        ///< where undecided
  std::optional<RationalPose> moved_by;
  std::optional<Rational> scaled_by;
  std::vector<LeastReaction> least;      ///< where verified by cells of poses
  std::optional<PreloadAnswer> preload;  ///< where efforts are free and the task gives none
  long cells = 0;                        ///< that were looked at for the verdict
  WorkingMode mode;                      ///< of `map`
  Zones map;  ///< over two lengths the loci (of the file's load) and zones, for pictures; may be empty
  std::vector<std::string> notes;
  Units units = {};  ///< of the mechanism file: what the text speaks in

  bool verified() const { return verdict == Verdict::verified; }
  /// Whether distances of the task's metric are in rad: every coordinate is an angle, and none counts as a length.
  bool margin_of_angles() const {
    for (const bool angle : angles)
      if (!angle) return false;
    return !angles.empty() && !task.angle_length;
  }
};

}  // namespace clearloci::inline core

namespace clearloci {

/// How much is asked. Each has what those before it have.
enum class VerifyDepth {
  verdict,     ///< with its witness, or what is open
  margin,      ///< what is proven to be free around the task
  everything,  ///< the nearest locus, the zone and the picture; what reactions have at least
};

struct VerifyRequest {
  /// Joints, deadline, progress, and the first of the working modes. The task's `min_force` and `min_couple` take the
  /// place of these here. Where the deadline comes first, what is not proven is undecided.
  LociRequest loci = {};
  VerifyDepth depth = VerifyDepth::everything;
  TaskFit fit = TaskFit::none;
};

/// Throws InputError, with file, line, column, problem and mend, for whatever is wrong with the file: among that a
/// shape that is empty, crosses itself or leaves the mechanism's box.
Task read_task(const std::string& path, const Model& model);
/// The same for a text; `file` is the name that errors show.
Task parse_task(const std::string& text, const Model& model, const std::string& file = "task");

/// Throws as trace_loci, and InputError for what is not asked of such a mechanism. A fit says what is proven of the
/// task where it was put; that nothing nearer, better or larger verifies is proven over two lengths alone, apart from
/// places that a five thousandth of the box separates from others that fail. Without `moved_by` and `scaled_by` none
/// was found, and the answer is of the task where it lies. A fit throws LimitReached where the deadline comes before
/// the loci are traced.
Verification verify(const Model& model, const Task& task, const VerifyRequest& request = {});

}  // namespace clearloci
