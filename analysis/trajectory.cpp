#include "analysis/trajectory.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <utility>

#include "analysis/flank_motions.hpp"
#include "analysis/framed.hpp"
#include "analysis/model.hpp"
#include "analysis/pose.hpp"
#include "analysis/reaction_rows.hpp"
#include "analysis/request_limits.hpp"
#include "analysis/singular_modes.hpp"
#include "clearloci/handed_files.hpp"
#include "core/errors.hpp"
#include "core/unloaded_words.hpp"
#include "mechanism/fits.hpp"
#include "mechanism/handed_files.hpp"
#include "mechanism/written_unit.hpp"

namespace clearloci {
namespace {

using numeric::Instant;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const std::string& joint_name(const numeric::Motion& motion, mechanism::JointIndex joint) {
  return motion.model.mechanism.joints[static_cast<std::size_t>(joint)].name;
}

/// "m", "rad", or nothing where coordinates of both kinds are free.
std::string distance_unit(const numeric::Motion& motion) {
  const mechanism::Mechanism& mechanism = motion.model.mechanism;
  if (motion.timeline.timed) return "s";
  const auto angles = std::count_if(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                                    [](const mechanism::Coordinate& coordinate) { return coordinate.angle; });
  if (angles == 0) return "m";
  return static_cast<std::size_t>(angles) == mechanism.coordinates.size() ? "rad" : "";
}

// ---- Samples

std::size_t dimension(const numeric::Motion& motion) {
  return motion.model.mechanism.space == mechanism::Space::planar ? 2 : 3;
}

std::string axis_named(const std::string& name, std::size_t component) { return name + "xyz"[component]; }

void put_components(TableRows& row, const numeric::Motion& motion, const std::string& name, const std::string& unit,
                    const Eigen::Vector3d& v) {
  for (std::size_t c = 0; c < dimension(motion); ++c)
    row.put(axis_named(name, c), unit, v(static_cast<Eigen::Index>(c)));
}

void put_motion(TableRows& row, const numeric::Motion& motion, const Instant& at, double period) {
  const auto put = [&](const std::string& name, const std::string& unit, const numeric::Series& s) {
    row.put(name, unit, s.c[0]);
    row.put(name + "_rate", unit + "/s", s.c[1] / period);
    row.put(name + "_acceleration", unit + "/s^2", 2 * s.c[2] / (period * period));
  };
  for (std::size_t c = 0; c < at.coordinates.size(); ++c) {
    const mechanism::Coordinate& coordinate = motion.model.mechanism.coordinates[c];
    put("q_" + coordinate.name, coordinate.angle ? "rad" : "m", at.coordinates[c]);
  }
  const auto& p = at.points[static_cast<std::size_t>(motion.model.mechanism.end_effector_point)];
  for (std::size_t c = 0; c < dimension(motion); ++c) put(axis_named("p", c), "m", p[c]);
}

void put_joints(TableRows& row, const numeric::Motion& motion, const Instant& at, double period,
                const std::vector<numeric::TakeUp>& take_up) {
  const Eigen::VectorXd w = at.reactions(period), rates = at.reaction_rates(period);
  if (motion.model.mechanism.space == mechanism::Space::spatial) {
    const std::vector<numeric::JointReaction> of_joints = numeric::joint_reactions(motion, at, w);
    for (std::size_t j = 0; j < of_joints.size(); ++j) put_joint_in_space(row, motion.model.mechanism, j, of_joints[j]);
    return;
  }
  for (std::size_t k = 0; k < motion.model.unknowns.size(); ++k)
    row.put(mechanism::unknown_name(motion.model.mechanism, motion.model.unknowns[k]),
            core::unit_of(motion.model.unknowns[k].quantity), w(static_cast<Eigen::Index>(k)));
  for (std::size_t j = 0; j < motion.columns.size(); ++j) {
    if (!(motion.clearances[j].radial > 0)) continue;
    const int fx = motion.columns[j].fx, fy = motion.columns[j].fy;
    const std::string& name = motion.model.mechanism.joints[j].name;
    const double size = w(fx) * w(fx) + w(fy) * w(fy);
    row.put("beta_" + name, "rad", take_up[j].beta ? *take_up[j].beta : nan);
    // tan β = f_x / f_y
    row.put("beta_rate_" + name, "rad/s", size > 0 ? (rates(fx) * w(fy) - w(fx) * rates(fy)) / size : nan);
  }
}

core::Table table_of(const numeric::Motion& motion, const InstantSamples& samples, double period) {
  core::Table table;
  TableRows row(table);
  const std::string along = distance_unit(motion);
  for (const auto& instants : samples) {
    for (const Instant& at : instants) {
      const numeric::InstantError e = numeric::instant_error(motion, at, period);
      row.put("time", "s", at.tau * period);
      row.put("distance", along, at.distance.value());
      const int stage = motion.timeline.intervals[at.interval].stage;
      row.put("stage", "", stage < 0 ? 0 : stage + 1);  // 0: dwelling
      put_motion(row, motion, at, period);
      const auto& p = at.points[static_cast<std::size_t>(motion.model.mechanism.end_effector_point)];
      const Eigen::Vector3d nominal(p[0].value(), p[1].value(), p[2].value());
      put_components(row, motion, "actual_p", "m", nominal + e.error.dp);
      put_components(row, motion, "d", "m", e.error.dp);
      if (dimension(motion) == 2)
        row.put("dalpha", "rad", e.error.dalpha[2]);
      else
        put_components(row, motion, "dalpha", "rad", e.error.dalpha);
      put_joints(row, motion, at, period, e.take_up);
      row.end_row();
    }
  }
  return table;
}

// ---- Stages and losses

std::string waypoint_name(const numeric::Motion& motion, int waypoint) {
  const std::string& name = motion.timeline.trajectory.waypoints[static_cast<std::size_t>(waypoint)].name;
  return name.empty() ? std::to_string(waypoint + 1) : name;
}

std::vector<TrajectoryStage> stages_of(const numeric::Motion& motion, double period,
                                       const std::vector<numeric::CriticalPeriod>& critical) {
  std::vector<TrajectoryStage> stages;
  for (std::size_t k = 0; k < motion.timeline.stages.size(); ++k) {
    const numeric::Stage& stage = motion.timeline.stages[k];
    TrajectoryStage trajectory_stage;
    trajectory_stage.from = waypoint_name(motion, stage.from_waypoint);
    trajectory_stage.to = waypoint_name(motion, stage.to_waypoint);
    trajectory_stage.begins = stage.begin * period;
    trajectory_stage.ends = stage.end * period;
    trajectory_stage.starts_at = stage.from;
    trajectory_stage.stops_at = stage.to;
    for (const int p : stage.carried)
      trajectory_stage.carried +=
          core::to_double(motion.timeline.trajectory.payloads[static_cast<std::size_t>(p)].mass);
    trajectory_stage.critical_period = critical[k].period;
    if (critical[k].joint >= 0)
      trajectory_stage.lost_last =
          LostLast{joint_name(motion, critical[k].joint), critical[k].quantity, critical[k].distance};
    stages.push_back(std::move(trajectory_stage));
  }
  return stages;
}

LossKind kind_of(numeric::LossKind kind) {
  switch (kind) {
    case numeric::LossKind::zero:
      return LossKind::zero;
    case numeric::LossKind::minimum:
      return LossKind::minimum;
    case numeric::LossKind::jump:
      break;
  }
  return LossKind::jump;
}

std::vector<ContactLoss> losses_of(const numeric::Motion& motion, const std::vector<numeric::ContactLoss>& found) {
  std::vector<ContactLoss> losses;
  for (const numeric::ContactLoss& loss : found) {
    ContactLoss contact_loss{kind_of(loss.kind),
                             joint_name(motion, loss.joint),
                             loss.quantity,
                             loss.time,
                             loss.distance,
                             loss.stage + 1,
                             loss.force,
                             loss.from,
                             loss.to,
                             loss.payload};
    contact_loss.crossed = loss.effect.crossed;
    contact_loss.displacement = loss.effect.jump.dp.norm();
    contact_loss.rotation = loss.effect.jump.dalpha.norm();
    contact_loss.earles_wu = loss.earles_wu;
    losses.push_back(std::move(contact_loss));
  }
  return losses;
}

void add_sweep(const FlankMotions& motions, const numeric::LossThresholds& thresholds,
               const std::vector<double>& periods, TrajectoryResult& result) {
  numeric::PeriodSweep sweep = motions.sweep(periods);
  result.sweep = PeriodSweep{std::move(sweep.periods), std::move(sweep.distance), std::move(sweep.dx),
                             std::move(sweep.dy),      std::move(sweep.dz),       std::move(sweep.dalpha)};
  for (numeric::LossCurve& curve : motions.loss_curves(thresholds, periods.front(), periods.back()))
    result.loss_curves.push_back({joint_name(motions.motion(), curve.joint), curve.quantity, std::move(curve.lines)});
}

/// "S1, S2 bear nothing all along the path ...", "end_ahead of G2 is zero all along the path: ...".
std::vector<std::string> idle_notes(const numeric::Motion& motion) {
  std::vector<std::string> notes, joints;
  for (std::size_t j = 0; j < motion.columns.size(); ++j)
    for (const core::Quantity quantity : numeric::idle_quantities(motion, j)) {
      const std::string& name = motion.model.mechanism.joints[j].name;
      if (quantity == core::Quantity::f)
        joints.push_back(name);
      else
        notes.push_back(core::to_string(quantity) + " of " + name +
                        " is zero all along the path: its take-up, and with it the pose error, is undefined");
    }
  if (!joints.empty())
    notes.push_back(core::words_of_idle(joints) + " all along the path" + core::undefined_take_up_words);
  return notes;
}

// ---- Request

void check(const TrajectoryRequest& request) {
  if (request.period) check_positive(*request.period, "the period", "s");
  if (request.min_force) check_positive(*request.min_force, "the least force", "N");
  for (const double period : request.periods) check_positive(period, "a period of the sweep", "s");
  if (std::adjacent_find(request.periods.begin(), request.periods.end(), std::greater_equal<>()) !=
      request.periods.end())
    throw core::InputError({}, "the periods of a sweep are not in order", "give them ascending, each once");
  constexpr int most_samples = 10'000'000;
  if (request.samples < 10 || request.samples > most_samples)
    throw core::InputError({}, std::to_string(request.samples) + " instants a cycle", "give 10 to 10000000");
}

}  // namespace

TrajectoryResult follow_trajectory(const mechanism::Mechanism& mechanism, const mechanism::Trajectory& trajectory,
                                   const TrajectoryRequest& request) {
  check(request);
  if (const std::optional<Framed> framed = framed_where_far(mechanism))
    return from_frame(follow_trajectory(framed->mechanism, in_frame(trajectory, framed->frame), request), mechanism,
                      framed->frame);
  const auto check_deadline = [&request] {
    if (request.deadline && std::chrono::steady_clock::now() > *request.deadline)
      throw core::LimitReached("the time limit was reached");
  };
  const DyadSides sides = sides_of(mechanism, request.working_mode);
  require_regular(mechanism, sides);
  check_deadline();
  const FlankMotions motions(mechanism, trajectory, sides, request.samples);
  const numeric::Motion& motion = motions.motion();
  const double duration = trajectory.speed ? motion.timeline.length() / core::to_double(*trajectory.speed)
                                           : core::to_double(trajectory.period);
  const double period = request.period.value_or(duration);
  const InstantSamples samples = motions.samples(period);
  numeric::LossThresholds thresholds =
      numeric::default_thresholds(motion, motions.samples(std::numeric_limits<double>::infinity()));
  if (request.min_force) thresholds.force = *request.min_force;
  check_deadline();

  TrajectoryResult result;
  result.mechanism = mechanism.name;
  result.parameters = mechanism::told_parameters(mechanism);
  result.units = mechanism.units;
  result.notes = mechanism::fit_notes(mechanism);
  result.trajectory = trajectory.name;
  result.law = mechanism::to_string(trajectory.law.kind);
  result.period = period;
  result.length = motion.timeline.length();
  result.distance_unit = distance_unit(motion);
  result.min_force = thresholds.force;
  for (const mechanism::Joint& joint : mechanism.joints) result.joints.push_back(joint.name);
  result.losses = losses_of(motion, motions.contact_losses(period, thresholds));
  check_deadline();
  result.stages = stages_of(motion, period, motions.critical_periods(thresholds));
  for (std::string& note : motions.slack_notes(samples, period)) result.notes.push_back(std::move(note));
  for (std::string& note : idle_notes(motion)) result.notes.push_back(std::move(note));
  if (!numeric::are_dense(motion, samples))
    result.notes.push_back("the path turns round between the " + std::to_string(request.samples) +
                           " instants that it is followed at: contact losses may be missing, and periods wrong; "
                           "take more (--samples)");
  check_deadline();
  result.samples = table_of(motion, samples, period);
  if (!request.periods.empty()) add_sweep(motions, thresholds, request.periods, result);
  return result;
}

TrajectoryResult follow_trajectory(const Model& model, const std::string& path, const TrajectoryRequest& request) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  return follow_trajectory(mechanism, mechanism::read_trajectory(path, mechanism), request);
}

TrajectoryResult follow_trajectory_text(const Model& model, const std::string& text, const TrajectoryRequest& request,
                                        const std::string& file) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  return follow_trajectory(mechanism, mechanism::parse_trajectory(text, file, mechanism), request);
}

TrajectoryResult follow_trajectory_text(const Model& model, const std::string& text, const TrajectoryRequest& request,
                                        const HandedFiles& handed, const std::string& file) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  return follow_trajectory(mechanism, mechanism::parse_trajectory(text, file, mechanism, handed), request);
}

}  // namespace clearloci
