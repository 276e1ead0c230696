// Does the mechanism keep clear of its loci over a task? Proven for every pose of the task and every load, refuted by a
// witness that is confirmed numerically, or left undecided, and said to be (docs/results.md, verify.json).
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     const clearloci::Task task = clearloci::read_task("tasks/pick_and_place.yaml", model);
//     const clearloci::Verification answer = clearloci::verify_task(model, task);
//     if (answer.verified()) std::cout << "free of loci, and " << answer.margin << " m around it\n";
//
// Lengths in m, forces in N, couples in N m.
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
  Rational margin = 0;                 ///< m that must be left to the nearest locus
  std::optional<Rational> min_force;   ///< N, that every wanted joint keeps
  std::optional<Rational> min_couple;  ///< N m
  std::optional<LoadRange> loads;      ///< instead of the force of the mechanism's one load
  std::vector<Tolerance> tolerances = {};
  std::vector<LoadWithin> loads_within = {};
  std::optional<Rational> pose_error = {};  ///< m, that the clearances may displace the end effector at most
};

/// What is not proven is never called refuted.
enum class Verdict { verified, refuted, undecided };

/// "verified", "refuted", "undecided".
std::string to_string(Verdict verdict);

/// Where a task is moved to that fails where it lies: the nearest place that verifies, or the one of the largest
/// margin.
enum class FitGoal { nearest, best };

/// One load of the mechanism file at a witness.
struct WitnessLoad {
  std::size_t load = 0;  ///< from 0
  Point2 force{};        ///< N
  double couple = 0;     ///< N m
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
  };
  Kind kind = Kind::unreachable;
  Point2 at{};
  std::vector<Vanishing> vanishing = {};
  std::optional<Point2> load = {};  ///< N; of a range of loads, where it takes one
  std::vector<Vanishing> too_small = {};
  std::optional<double> size = {};     ///< of the first of them, N or N m; of the displacement, m
  std::optional<Rational> least = {};  ///< that is asked of it, N or N m
  std::optional<Rational> most = {};   ///< that the displacement may be, m
  double distance = 0;                 ///< m from the task
  std::string limit = {};              ///< of the first two kinds, the one that is broken: "distance A1-P at 0.52 m"
  std::vector<std::pair<std::string, double>> design = {};  ///< parameters that have a tolerance
  std::vector<WitnessLoad> loads = {};                      ///< those that may differ
};

struct NearestOfTask {
  std::string curve;  ///< LocusCurve::id; empty: an isolated point, or not among the traced loci
  LocusKind kind = LocusKind::contact_loss;
  std::vector<Vanishing> vanishing;
  Point2 at{};
  double distance = 0;    ///< m; negative: its depth inside the task
  bool isolated = false;  ///< a point of contact loss
  std::string limit;      ///< of a boundary, the limit that makes it
};

/// What a verdict of `undecided` leaves open; the rest of the task and of its margin is proven.
struct OpenTask {
  enum class Reason { time, cells, doubles };  ///< ran out, or tell no more apart there
  std::size_t cells = 0;                       ///< that stayed open
  Point2 lower{}, upper{};                     ///< the box around them
  Reason reason = Reason::doubles;
  int looked_at = 0;  ///< cells in all
};

struct Verification {
  Task task;  ///< as verified: moved by `by` where a place was looked for
  WorkingMode mode;
  Verdict verdict = Verdict::undecided;
  double margin = 0;                      ///< m, proven to be free; 0 where not even the task is
  std::optional<double> pose_error = {};  ///< m, a proven upper bound over the task, where it asks for one
  std::string zone;                       ///< Zone::id; empty where not verified
  std::optional<NearestOfTask> nearest;
  std::optional<TaskWitness> witness;  ///< where refuted
  std::optional<OpenTask> open;        ///< where undecided
  std::optional<RationalPoint> by;     ///< the translation found
  ZoneMap map;                         ///< the loci (of the file's load) and zones, for pictures; may be empty
  std::vector<std::string> notes;
  Units units = {};  ///< of the mechanism file: what the text speaks in

  bool verified() const { return verdict == Verdict::verified; }
};

}  // namespace clearloci::inline core

namespace clearloci {

/// Throws InputError, with file, line, column, problem and mend, for whatever is wrong with the file: among that a
/// shape that is empty, crosses itself or leaves the mechanism's box.
Task read_task(const std::string& path, const Model& model);
/// The same for a text; `file` is the name that errors show.
Task parse_task(const std::string& text, const Model& model, const std::string& file = "task");

/// In the first of the request's working modes. The task's `min_force` and `min_couple` take the place of the
/// request's. Where the request's deadline comes first, what is not proven is undecided. Throws as trace_loci.
Verification verify_task(const Model& model, const Task& task, const LociRequest& request = {});

/// The verdict and the margin alone: no locus is traced, and `map` is empty.
Verification decide_task(const Model& model, const Task& task, const LociRequest& request = {});

/// As verify_task for the best translation of the task in the box by that goal. Without `by`: none was found that
/// verifies; there is none, apart from places that a five thousandth of the box separates from others that fail, or
/// that cannot be decided. The verdict is then of the task where it lies. Throws LimitReached where the deadline comes
/// before the loci are traced.
Verification fit_task(const Model& model, const Task& task, const LociRequest& request = {},
                      FitGoal goal = FitGoal::nearest);

}  // namespace clearloci
