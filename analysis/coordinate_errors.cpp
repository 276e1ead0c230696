#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/coordinate_errors.hpp"
#include "analysis/pose.hpp"
#include "analysis/reaction_rows.hpp"
#include "numeric/error_map.hpp"
#include "numeric/error_range.hpp"

namespace clearloci {
namespace {

using numeric::RangePose;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// How near to an event the lines are drawn, as a part of the range.
constexpr double beside_event = 1e-9;

/// A jump this much smaller than the errors is none, but rounding.
constexpr double least_jump = 1e-8;

/// Where an error may jump: what vanishes there has its take-up reversed.
bool jumps(const core::IsolatedPoint& point) {
  return point.kind == core::LocusKind::contact_loss || point.kind == core::LocusKind::backlash;
}

std::vector<core::IsolatedPoint> events_of(const core::LocusMap& loci, const core::WorkingMode& mode) {
  std::vector<core::IsolatedPoint> events;
  for (const core::IsolatedPoint& point : loci.isolated_points)
    if (point.mode == mode && point.kind != core::LocusKind::component && point.kind != core::LocusKind::margin)
      events.push_back(point);
  std::sort(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
  return events;
}

/// The range in equal steps, every event, and both sides of those at which the error may jump.
std::vector<double> values_of(const std::array<double, 2>& range, int steps,
                              const std::vector<core::IsolatedPoint>& events) {
  const double width = range[1] - range[0], beside = beside_event * width;
  std::vector<double> values;
  for (int i = 0; i <= steps; ++i) values.push_back(i == steps ? range[1] : range[0] + width * i / steps);
  for (const core::IsolatedPoint& event : events) {
    const double at = event.at.front();
    values.erase(std::remove_if(values.begin(), values.end(), [&](double v) { return std::abs(v - at) <= beside; }),
                 values.end());
    values.push_back(at);
    if (!jumps(event)) continue;  // near a singularity values say how near, and nothing else
    for (const double value : {at - beside, at + beside})
      if (range[0] <= value && value <= range[1]) values.push_back(value);
  }
  std::sort(values.begin(), values.end());
  return values;
}

void put_reactions(TableRows& row, const numeric::NumericModel& model, const RangePose& pose) {
  const mechanism::Mechanism& m = model.mechanism;
  if (m.space == mechanism::Space::spatial) {
    const numeric::JointReaction unknown{numeric::Vector3d::Constant(nan), numeric::Vector3d::Constant(nan), nan};
    for (std::size_t j = 0; j < m.joints.size(); ++j)
      put_joint_in_space(row, m, j, pose.reachable ? pose.accuracy.of_joints[j] : unknown);
    return;
  }
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    const double value = pose.reachable ? pose.accuracy.reactions.values(static_cast<Eigen::Index>(k)) : nan;
    row.put(mechanism::unknown_name(m, model.unknowns[k]), core::unit_of(model.unknowns[k].quantity),
            std::isfinite(value) ? value : nan);
  }
}

void put_take_up(TableRows& row, const numeric::NumericModel& model, const RangePose& pose) {
  const std::vector<numeric::JointClearance> clearances = numeric::joint_clearances(model.mechanism);
  for (std::size_t j = 0; j < clearances.size(); ++j) {
    const std::string& name = model.mechanism.joints[j].name;
    const numeric::TakeUp* take_up = pose.reachable ? &pose.accuracy.take_up[j] : nullptr;
    if (clearances[j].radial > 0 && model.mechanism.space == mechanism::Space::planar)
      row.put("beta_" + name, "rad", take_up != nullptr && take_up->beta ? *take_up->beta : nan);
    if (clearances[j].radial > 0 && model.mechanism.space == mechanism::Space::spatial) {
      const bool pressed = take_up != nullptr && !take_up->force_vanishes;
      for (const Eigen::Index c : {0, 1, 2})
        row.put("d_" + name + "_" + "xyz"[c], "m", pressed ? take_up->displacement(c) : nan);
    }
    const bool driven = take_up != nullptr && !take_up->actuator_vanishes;
    if (clearances[j].angular > 0) row.put("theta_" + name, "rad", driven ? take_up->turn : nan);
    if (clearances[j].axial > 0) row.put("travel_" + name, "m", driven ? take_up->travel : nan);
    if (clearances[j].gap > 0) {
      const bool is_bounded = take_up != nullptr && !take_up->guide_vanishes();
      row.put("normal_" + name, "m", is_bounded ? take_up->normal : nan);
      row.put("tilt_" + name, "rad", is_bounded ? take_up->tilt : nan);
    }
  }
}

/// A row a pose.
core::Table take_up_of(const numeric::NumericModel& model, const std::vector<RangePose>& poses) {
  core::Table table;
  TableRows row(table);
  for (const RangePose& pose : poses) {
    put_reactions(row, model, pose);
    put_take_up(row, model, pose);
    row.end_row();
  }
  return table;
}

/// Of numeric::error_fields.
std::vector<double> values_of(mechanism::Space space, const RangePose& pose, bool under_load, bool worst_case) {
  std::vector<double> values;
  const auto add = [&](const numeric::PoseError& error, double distance) {
    const PoseError parts = error_of(space, error);
    values.insert(values.end(), parts.displacement.begin(), parts.displacement.end());
    values.insert(values.end(), parts.rotation.begin(), parts.rotation.end());
    values.push_back(distance);
  };
  const numeric::Accuracy& accuracy = pose.accuracy;
  if (under_load) add(accuracy.error, accuracy.error.dp.norm());
  if (worst_case) add({accuracy.worst.dalpha, accuracy.worst.dp}, accuracy.worst.distance);
  for (double& value : values)
    if (!pose.reachable || !std::isfinite(value)) value = nan;
  return values;
}

void put_values(const numeric::NumericModel& model, const std::vector<RangePose>& poses, bool worst_case,
                ModeErrors& errors) {
  const mechanism::Space space = model.mechanism.space;
  const bool under_load = errors.never_loaded.empty();
  std::vector<core::Field>& fields = errors.map.fields;
  fields = numeric::error_fields(space, under_load, worst_case);
  for (const RangePose& pose : poses) {
    const std::vector<double> values = values_of(space, pose, under_load, worst_case);
    for (std::size_t f = 0; f < fields.size(); ++f) fields[f].values.push_back(values[f]);
  }
}

/// The error is smooth from an event to its neighbours, or to the ends of the range.
double free_beside(const std::vector<core::IsolatedPoint>& events, std::size_t i, const std::array<double, 2>& range) {
  const double at = events[i].at.front();
  double free = range[1] - range[0];
  for (const double end : range)
    if (end != at) free = std::min(free, std::abs(end - at));
  for (const core::IsolatedPoint& other : events)
    if (other.at.front() != at) free = std::min(free, std::abs(other.at.front() - at));
  return free;
}

/// The jump without what is rounding only.
PoseError without_noise(PoseError jump, const core::FieldMap& map) {
  // Of the largest displacement, or rotation, in any direction. A platform that cannot turn does so by rounding: by a
  // displacement's last digits over a metre.
  constexpr double rounding = 1e-12;  // 1/m
  double displaced = 0;
  const auto drop = [&](std::vector<double>& parts, const std::string& unit) {
    double most = 0;
    for (const core::Field& field : map.fields)
      if (field.is_signed && field.unit == unit)
        for (const double value : field.values)
          if (std::isfinite(value)) most = std::max(most, std::abs(value));
    for (double& part : parts)
      if (std::abs(part) <= std::max(least_jump * most, rounding * displaced)) part = 0;
    displaced = most;
  };
  drop(jump.displacement, "m");
  drop(jump.rotation, "rad");
  return jump;
}

}  // namespace

ModeErrors coordinate_errors(const numeric::NumericModel& model, const DyadSides& sides, const core::LocusMap& loci,
                             const ErrorRequest& request) {
  const std::array<double, 2> range = model.box.front();
  ModeErrors errors;
  errors.mode = mode_in(loci, sides);
  const std::vector<core::IsolatedPoint> events = events_of(loci, errors.mode);
  errors.map = numeric::empty_error_map(model, {values_of(range, request.grid.front(), events)});
  std::vector<RangePose> poses = numeric::error_range(model, sides, errors.map.axes.front(), request.loci.deadline);
  errors.never_loaded = numeric::never_loaded(model, poses);
  for (RangePose& pose : poses) {
    if (pose.reachable) ++errors.reachable;
    // On an event nothing is told: what has a limit there has the same one in the rows beside it.
    const bool on_event = std::any_of(events.begin(), events.end(), [&](const auto& e) { return e.at[0] == pose.at; });
    const bool defined = !on_event && pose.accuracy.undefined.empty();
    if (pose.reachable && errors.never_loaded.empty() && !defined) ++errors.undefined;
    pose.reachable = pose.reachable && !on_event;
  }
  errors.take_up = take_up_of(model, poses);
  put_values(model, poses, request.worst_case, errors);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const numeric::PoseError jump =
        numeric::error_jump(model, sides, events[i].at.front(), free_beside(events, i, range));
    errors.events.push_back(
        {events[i], jumps(events[i]), without_noise(error_of(model.mechanism.space, jump), errors.map)});
  }
  return errors;
}

}  // namespace clearloci
