// What happens along a motion? Reactions with the links' inertia, take-up, actual path, and where the parts of a joint
// lose contact, along a trajectory file; from which cycle time on they no longer do; and the pose error over a range of
// cycle times (docs/background/method.md section 7).
//
//     const clearloci::Model model = clearloci::Model::read("manipulator.yaml");
//     const clearloci::TrajectoryResult motion = follow_trajectory(model, "path.yaml", {.period = 0.8});
//     for (const auto& loss : motion.losses) std::cout << loss.joint << " at " << loss.time << " s\n";
//     std::cout << "error in x at the start: " << motion.samples.at("dx").front() << " m\n";
//
// Times in s, lengths in m, angles in rad, forces in N, couples in N m. Distances along the path are those of the free
// coordinates: in m where these are lengths, in rad where they are angles (TrajectoryResult::distance_unit).
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/table.hpp"

namespace clearloci::inline core {

enum class LossKind {
  zero,     ///< a number passes through zero
  minimum,  ///< |f_J| has a minimum at or below the threshold
  jump,     ///< a number changes its sign, or f_J turns by more than a right angle, between the two sides of an instant
};

/// "zero", "minimum", "jump".
std::string to_string(LossKind kind);

struct ContactLoss {
  LossKind kind = LossKind::zero;
  std::string joint;
  Quantity quantity = Quantity::f;  ///< f, M, F, end_ahead or end_behind
  double time = 0;                  ///< s, within 1e-9 s
  double distance = 0;              ///< along the path, in distance_unit
  int stage = 0;                    ///< from 1 on; 0: while dwelling
  double force = 0;                 ///< of a minimum: |f_J|, N
  double from = 0, to = 0;          ///< of a minimum: times between which |f_J| is at or below the threshold, s
  bool payload = false;             ///< of a jump: a body is picked or placed there; else the acceleration jumps
  /// How far the joint's parts go across their clearance, m; rad of an actuator that turns. Of a minimum: while the
  /// force is at or below the threshold.
  double crossed = 0;
  double displacement = 0, rotation = 0;  ///< how far the end effector jumps with that, m and rad
  /// Of a minimum: how fast the force's direction turns, over its size, rad/(N s): what Earles and Wu (1975) judge by.
  /// Infinite where the force vanishes.
  double earles_wu = 0;
};

/// What of a stage's reactions is the last to let go as the cycle gets slower.
struct LostLast {
  std::string joint;
  Quantity quantity = Quantity::f;
  double distance = 0;  ///< along the path, in distance_unit
};

/// From one stop to the next.
struct TrajectoryStage {
  std::string from, to;                ///< names of the waypoints, or their numbers from 1 on
  double begins = 0, ends = 0;         ///< s
  double starts_at = 0, stops_at = 0;  ///< distances along the path, in distance_unit
  double carried = 0;                  ///< kg
  /// The least period above which the stage is free of contact losses, jumps by payloads aside, s: 0 where it always
  /// is, infinite where contact is lost at rest too.
  double critical_period = 0;
  std::optional<LostLast> lost_last;
};

/// Pose errors over the distance at several periods.
struct PeriodSweep {
  std::vector<double> periods;             ///< s
  std::vector<double> distance;            ///< of the samples, in distance_unit; two at a seam of the motion
  std::vector<double> dx, dy, dz, dalpha;  ///< by period, then sample: m, rad. NaN where a take-up is undefined. In
                                           ///< space dalpha is the rotation's size; in the plane there is no dz

  std::size_t index(std::size_t period, std::size_t sample) const { return period * distance.size() + sample; }
};

/// Where, over distance and period, a joint loses contact.
struct LossCurve {
  std::string joint;
  Quantity quantity = Quantity::f;
  std::vector<Polyline> lines;  ///< of {distance in distance_unit, period in s}
};

struct TrajectoryResult {
  std::string mechanism, trajectory;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name, exact value ("1/2", "3 N/mm")
  std::string law;    ///< "cycloidal", "3-4-5", "trapezoidal", "s-curve", "constant", "expression", "table"
  double period = 0;  ///< s, of the whole cycle
  double length = 0;  ///< of the path, in distance_unit
  /// "m", "rad"; empty where coordinates of both kinds are free, and taken as they are. "s" where the coordinates are
  /// given in time: the time since the start then stands for the distance.
  std::string distance_unit;
  double min_force = 0;             ///< N: a contact force at or below it is lost
  std::vector<std::string> joints;  ///< in the file's order
  std::vector<TrajectoryStage> stages;
  std::vector<ContactLoss> losses;  ///< of the joints with a clearance, in order of time
  /// One row a sample, at the seams of the motion two, the limits from both sides: time, distance, stage (0: dwelling);
  /// q_<coordinate> and px, py of the end effector's point, each with _rate and _acceleration; actual_px, actual_py;
  /// the error dx, dy, dalpha; reactions; beta_J and beta_rate_J of the joints with a radial clearance. In space pz,
  /// actual_pz, dz, the rotation dalphax, dalphay, dalphaz, and no beta.
  Table samples;
  std::optional<PeriodSweep> sweep;     ///< where periods are asked for
  std::vector<LossCurve> loss_curves;   ///< with it
  std::vector<std::string> notes = {};  ///< such as what a clearance stands for
  Units units = {};                     ///< of the mechanism file: what tables and pictures speak in
};

}  // namespace clearloci::inline core

namespace clearloci {

struct TrajectoryRequest {
  DyadSides working_mode = {};           ///< empty: the file's
  std::optional<double> period = {};     ///< s; else the trajectory's
  int samples = 2000;                    ///< instants a cycle, from 10 on
  std::optional<double> min_force = {};  ///< N; else 1 % of the largest contact force at rest
  std::vector<double> periods = {};      ///< s, ascending: those of the sweep; empty: none
  std::optional<std::chrono::steady_clock::time_point> deadline = {};  ///< looked at from step to step
};

/// `path`: the trajectory file. Throws InputError, with file, line, column, problem and mend, for whatever is wrong
/// with it; where its working mode has a determinant of zero everywhere; where the path
/// leaves the workspace or meets a direct singularity; and where a number of the request is wrong. Throws LimitReached
/// where the deadline comes first.
TrajectoryResult follow_trajectory(const Model& model, const std::string& path, const TrajectoryRequest& request = {});

/// The same for a text; `file` is the name that errors show.
TrajectoryResult follow_trajectory_text(const Model& model, const std::string& text,
                                        const TrajectoryRequest& request = {}, const std::string& file = "trajectory");

}  // namespace clearloci
