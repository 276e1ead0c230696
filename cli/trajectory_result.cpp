#include "cli/trajectory_result.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"

namespace clearloci::cli {
namespace {

using Json = nlohmann::ordered_json;
using numeric::Instant;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void put_motion(ColumnRows& row, const numeric::Motion& motion, const Instant& at, double period) {
  const auto put = [&](const std::string& name, const numeric::Series& s) {
    row.put(name, s.c[0]);
    row.put(name + "_rate", s.c[1] / period);
    row.put(name + "_acceleration", 2 * s.c[2] / (period * period));
  };
  for (std::size_t c = 0; c < at.coordinates.size(); ++c)
    put("q_" + motion.model.mechanism.coordinates[c].name, at.coordinates[c]);
  const auto& p = at.points[static_cast<std::size_t>(motion.model.mechanism.end_effector_point)];
  put("px", p[0]);
  put("py", p[1]);
}

void put_joints(ColumnRows& row, const numeric::Motion& motion, const Instant& at, double period,
                const std::vector<numeric::TakeUp>& take_up) {
  const Eigen::VectorXd w = at.reactions(period), rates = at.reaction_rates(period);
  for (std::size_t k = 0; k < motion.model.unknowns.size(); ++k)
    row.put(unknown_name(motion.model.mechanism, motion.model.unknowns[k]), w(static_cast<Eigen::Index>(k)));
  for (std::size_t j = 0; j < motion.columns.size(); ++j) {
    if (!(motion.clearances[j].radial > 0)) continue;
    const int fx = motion.columns[j].fx, fy = motion.columns[j].fy;
    const std::string& name = motion.model.mechanism.joints[j].name;
    const double size = w(fx) * w(fx) + w(fy) * w(fy);
    row.put("beta_" + name, take_up[j].beta ? *take_up[j].beta : nan);
    // tan β = f_x / f_y
    row.put("beta_rate_" + name, size > 0 ? (rates(fx) * w(fy) - w(fx) * rates(fy)) / size : nan);
  }
}

Columns columns_of(const TrajectoryResult& result) {
  Columns table;
  ColumnRows row(table);
  for (const auto& instants : result.samples) {
    for (const Instant& at : instants) {
      const numeric::InstantError e = numeric::instant_error(result.motion, at, result.period);
      row.put("time", at.tau * result.period);
      row.put("distance", at.distance.value());
      const int stage = result.motion.timeline.intervals[at.interval].stage;
      row.put("stage", stage < 0 ? 0 : stage + 1);  // 0: dwelling
      put_motion(row, result.motion, at, result.period);
      const auto& p = at.points[static_cast<std::size_t>(result.motion.model.mechanism.end_effector_point)];
      row.put("actual_px", p[0].value() + e.error.dx);
      row.put("actual_py", p[1].value() + e.error.dy);
      row.put("dx", e.error.dx);
      row.put("dy", e.error.dy);
      row.put("dalpha", e.error.dalpha);
      put_joints(row, result.motion, at, result.period, e.take_up);
      row.end_row();
    }
  }
  return table;
}

std::string waypoint_name(const TrajectoryResult& result, int waypoint) {
  const std::string& name = result.motion.timeline.trajectory.waypoints[static_cast<std::size_t>(waypoint)].name;
  return name.empty() ? std::to_string(waypoint + 1) : name;
}

const char* kind_name(numeric::LossKind kind) {
  switch (kind) {
    case numeric::LossKind::zero:
      return "zero";
    case numeric::LossKind::minimum:
      return "minimum";
    default:
      return "jump";
  }
}

Json losses_json(const TrajectoryResult& result) {
  Json all = Json::array();
  for (const numeric::ContactLoss& loss : result.losses) {
    Json one = {{"time", loss.time},
                {"distance", loss.distance},
                {"stage", loss.stage + 1},
                {"joint", result.motion.model.mechanism.joints[static_cast<std::size_t>(loss.joint)].name},
                {"quantity", core::to_string(loss.quantity)},
                {"kind", kind_name(loss.kind)}};
    if (loss.kind == numeric::LossKind::minimum) {
      one["force"] = loss.force;
      one["from"] = loss.from;
      one["to"] = loss.to;
    }
    if (loss.kind == numeric::LossKind::jump) one["by"] = loss.payload ? "payload" : "acceleration";
    all.push_back(std::move(one));
  }
  return all;
}

Json stages_json(const TrajectoryResult& result) {
  Json all = Json::array();
  for (std::size_t k = 0; k < result.motion.timeline.stages.size(); ++k) {
    const numeric::Stage& stage = result.motion.timeline.stages[k];
    const numeric::CriticalPeriod& critical = result.critical[k];
    double carried = 0;
    for (const int p : stage.carried)
      carried += core::to_double(result.motion.timeline.trajectory.payloads[static_cast<std::size_t>(p)].mass);
    Json one = {{"from", waypoint_name(result, stage.from_waypoint)},
                {"to", waypoint_name(result, stage.to_waypoint)},
                {"begins", stage.begin * result.period},
                {"ends", stage.end * result.period},
                {"length", stage.to - stage.from},
                {"carried", carried},
                {"critical_period", number_json(critical.period)}};
    if (critical.joint >= 0)
      one["lost_last"] = {
          {"joint", result.motion.model.mechanism.joints[static_cast<std::size_t>(critical.joint)].name},
          {"quantity", core::to_string(critical.quantity)},
          {"distance", critical.distance}};
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

std::string loss_name(const TrajectoryResult& result, mechanism::JointIndex joint, core::Quantity quantity) {
  return core::to_string(quantity) + "_" + result.motion.model.mechanism.joints[static_cast<std::size_t>(joint)].name;
}

TrajectoryResult follow_trajectory(const mechanism::Mechanism& mechanism, const mechanism::Trajectory& trajectory,
                                   const TrajectoryRequest& request) {
  TrajectoryResult result;
  result.motion = numeric::compile_motion(mechanism, trajectory, request.mode);
  result.period = request.period;
  result.samples = numeric::sample(result.motion, request.samples);
  result.thresholds = numeric::default_thresholds(result.motion, result.samples);
  if (request.min_force) result.thresholds.force = *request.min_force;
  result.losses = numeric::contact_losses(result.motion, result.samples, result.period, result.thresholds);
  result.critical = numeric::critical_periods(result.motion, result.samples, result.thresholds);
  result.columns = columns_of(result);
  if (request.periods.empty()) return result;
  result.sweep = numeric::period_sweep(result.motion, result.samples, request.periods);
  result.loss_curves = numeric::loss_curves(result.motion, result.samples, result.thresholds, request.periods.front(),
                                            request.periods.back());
  return result;
}

Json trajectory_json(const TrajectoryResult& result) {
  const mechanism::Trajectory& trajectory = result.motion.timeline.trajectory;
  Json json = {{"format", 1},
               {"mechanism", result.motion.model.mechanism.name},
               {"trajectory", trajectory.name},
               {"law", to_string(trajectory.law.kind)},
               {"period", result.period},
               {"length", result.motion.timeline.path.length()},
               {"min_force", result.thresholds.force},
               {"stages", stages_json(result)},
               {"contact_losses", losses_json(result)}};
  if (result.sweep) {
    const auto& periods = result.sweep->periods;
    json["periods"] = {{"from", periods.front()}, {"to", periods.back()}, {"count", periods.size()}};
  }
  json["samples"] = columns_json(result.columns);
  return json;
}

Columns sweep_columns(const numeric::PeriodSweep& sweep) {
  Columns table{{"period", "distance", "dx", "dy", "dalpha"}, std::vector<std::vector<double>>(5)};
  for (const double period : sweep.periods) {
    table.columns[0].insert(table.columns[0].end(), sweep.distance.size(), period);
    table.columns[1].insert(table.columns[1].end(), sweep.distance.begin(), sweep.distance.end());
  }
  table.columns[2] = sweep.dx;
  table.columns[3] = sweep.dy;
  table.columns[4] = sweep.dalpha;
  return table;
}

void print_trajectory(const TrajectoryResult& result) {
  const mechanism::Trajectory& trajectory = result.motion.timeline.trajectory;
  fmt::print("{}: {}, {} law, period {:.6g} s, length {:.6g} m\n\n", result.motion.model.mechanism.name,
             trajectory.name, to_string(trajectory.law.kind), result.period, result.motion.timeline.path.length());
  fmt::print("{:<6}{:<18}{:>12}{:>12}{:>14}{:>16}  lost last\n", "stage", "from - to", "begins [s]", "ends [s]",
             "carried [kg]", "free above [s]");
  const Json stages = stages_json(result);
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const Json& s = stages[k];
    const std::string critical =
        s["critical_period"].is_null() ? "never" : fmt::format("{:.6g}", s["critical_period"].get<double>());
    fmt::print("{:<6}{:<18}{:>12.6g}{:>12.6g}{:>14.6g}{:>16}  {}\n", k + 1,
               s["from"].get<std::string>() + " - " + s["to"].get<std::string>(), s["begins"].get<double>(),
               s["ends"].get<double>(), s["carried"].get<double>(), critical,
               s.contains("lost_last")
                   ? s["lost_last"]["quantity"].get<std::string>() + "_" + s["lost_last"]["joint"].get<std::string>() +
                         fmt::format(" at {:.4g} m", s["lost_last"]["distance"].get<double>())
                   : "");
  }
  fmt::print("\ncontact is lost where M, F or an end of a guide passes through 0 or |f| falls to {:.4g} N: {} times\n",
             result.thresholds.force, result.losses.size());
  if (result.losses.empty()) return;
  fmt::print("{:>14}{:>14}{:>8}  {:<10}\n", "time [s]", "distance [m]", "stage", "what");
  for (const numeric::ContactLoss& loss : result.losses) {
    std::string what = loss_name(result, loss.joint, loss.quantity);
    if (loss.kind == numeric::LossKind::zero) what += " = 0";
    if (loss.kind == numeric::LossKind::minimum) what += fmt::format(" down to {:.4g} N", loss.force);
    if (loss.kind == numeric::LossKind::jump)
      what += loss.payload ? " reversed by the payload" : " reversed as the acceleration jumps";
    fmt::print("{:>14.9f}{:>14.6f}{:>8}  {}\n", loss.time, loss.distance, loss.stage + 1, what);
  }
}

}  // namespace clearloci::cli
