#include "cli/coordinate_errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/loci_json.hpp"
#include "report/wording.hpp"

namespace clearloci::cli {
namespace {

using Json = nlohmann::ordered_json;
using numeric::RangePose;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// How near to an event the lines are drawn, as a part of the range.
constexpr double beside_event = 1e-9;

struct ErrorColumn {
  const char *name, *label, *unit;
};
constexpr std::array<ErrorColumn, 8> error_columns = {
    {{"dx", "error in x", "m"},
     {"dy", "error in y", "m"},
     {"dalpha", "error in orientation", "rad"},
     {"dp", "distance from the nominal place", "m"},
     {"worst_dx", "largest error in x under any load", "m"},
     {"worst_dy", "largest error in y under any load", "m"},
     {"worst_dalpha", "largest error in orientation under any load", "rad"},
     {"worst_dp", "largest distance from the nominal place under any load", "m"}}};

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

void put_take_up(ColumnRows& row, const numeric::NumericModel& model, const RangePose& pose) {
  const std::vector<numeric::JointClearance> clearances = numeric::joint_clearances(model.mechanism);
  const std::vector<numeric::JointColumns> unknowns = numeric::joint_columns(model);
  for (std::size_t j = 0; j < clearances.size(); ++j) {
    const std::string& name = model.mechanism.joints[j].name;
    const numeric::TakeUp* own = pose.reachable ? &pose.accuracy.take_up[j] : nullptr;
    const bool guide = unknowns[j].normal >= 0;
    if (clearances[j].radial > 0) row.put("beta_" + name, own != nullptr && own->beta ? *own->beta : nan);
    if (clearances[j].angular > 0 && unknowns[j].couple >= 0)
      row.put((guide ? "travel_" : "theta_") + name, own != nullptr && !own->couple_vanishes ? own->rotation : nan);
    if (clearances[j].gap > 0) {
      const bool known = own != nullptr && !own->guide_vanishes;
      row.put("normal_" + name, known ? own->normal : nan);
      row.put("tilt_" + name, known ? own->tilt : nan);
    }
  }
}

Columns columns_of(const numeric::NumericModel& model, const std::vector<RangePose>& poses,
                   const std::vector<core::IsolatedPoint>& events, bool worst_case) {
  Columns table;
  ColumnRows row(table);
  for (RangePose pose : poses) {
    // On an event nothing is told: what has a limit there has the same one in the rows beside it.
    const bool on_event = std::any_of(events.begin(), events.end(), [&](const auto& e) { return e.at[0] == pose.at; });
    pose.reachable = pose.reachable && !on_event;
    const numeric::Accuracy& own = pose.accuracy;
    const auto value = [&](double v) { return pose.reachable && std::isfinite(v) ? v : nan; };
    row.put(model.mechanism.coordinates.front().name, pose.at);
    for (std::size_t k = 0; k < model.unknowns.size(); ++k)
      row.put(unknown_name(model.mechanism, model.unknowns[k]),
              pose.reachable ? value(own.reactions.values(static_cast<Eigen::Index>(k))) : nan);
    put_take_up(row, model, pose);
    row.put("dx", value(own.error.dx));
    row.put("dy", value(own.error.dy));
    row.put("dalpha", value(own.error.dalpha));
    row.put("dp", value(own.error.dp()));
    if (worst_case) {
      row.put("worst_dx", value(own.worst.dx));
      row.put("worst_dy", value(own.worst.dy));
      row.put("worst_dalpha", value(own.worst.dalpha));
      row.put("worst_dp", value(own.worst.dp));
    }
    row.end_row();
  }
  return table;
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
numeric::PoseError without_noise(numeric::PoseError jump, const Columns& table) {
  const auto largest = [&](const char* column) {
    double most = 0;
    for (const double value : table.at(column))
      if (std::isfinite(value)) most = std::max(most, std::abs(value));
    return most;
  };
  const double place = std::max(largest("dx"), largest("dy"));
  for (double* part : {&jump.dx, &jump.dy})
    if (std::abs(*part) <= least_jump * place) *part = 0;
  if (std::abs(jump.dalpha) <= least_jump * largest("dalpha")) jump.dalpha = 0;
  return jump;
}

/// Sizes of one column: median, 90 %, and the largest with its place.
Json sizes_json(const Columns& table, const ErrorColumn& column) {
  const std::vector<double>&at = table.columns.front(), &values = table.at(column.name);
  std::vector<double> sizes;
  std::size_t largest = values.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    sizes.push_back(std::abs(values[i]));
    if (largest == values.size() || sizes.back() > std::abs(values[largest])) largest = i;
  }
  if (sizes.empty()) return {{"unit", column.unit}, {"median", nullptr}};
  std::sort(sizes.begin(), sizes.end());
  const auto part = [&](double p) {
    return sizes[static_cast<std::size_t>(p * static_cast<double>(sizes.size() - 1))];
  };
  return {{"unit", column.unit},
          {"median", part(0.5)},
          {"percentile_90", part(0.9)},
          {"largest", values[largest]},
          {"at", {at[largest]}}};
}

Json mode_json(const CoordinateResult& result, const CoordinateErrors& mode) {
  Json fields = Json::object();
  for (const ErrorColumn& column : error_columns)
    if (mode.columns.has(column.name)) fields[column.name] = sizes_json(mode.columns, column);
  Json jumps_here = Json::array();
  for (const CoordinateEvent& event : mode.events) {
    if (!jumps(event.point)) continue;
    jumps_here.push_back({{"at", event.point.at},
                          {"kind", core::to_string(event.point.kind)},
                          {"vanishing", report::vanishing_array(event.point.vanishing)},
                          {"dx", number_json(event.jump.dx)},
                          {"dy", number_json(event.jump.dy)},
                          {"dalpha", number_json(event.jump.dalpha)}});
  }
  return {{"working_mode", report::mode_object(result.loci.tower, mode.mode)},
          {"never_loaded", mode.never_loaded},
          {"fields", std::move(fields)},
          {"jumps", std::move(jumps_here)},
          {"samples", columns_json(mode.columns)}};
}

bool is_angle(const CoordinateResult& result) { return result.mechanism.coordinates.front().angle; }

void print_jumps(const CoordinateResult& result, const CoordinateErrors& mode) {
  const double factor = is_angle(result) ? 180 / std::numbers::pi : 1;
  bool first = true;
  for (const CoordinateEvent& event : mode.events) {
    if (!jumps(event.point)) continue;
    if (first)
      fmt::print("{:>14}{:>14}{:>14}{:>16}  what lets go\n",
                 result.loci.tower.coordinates.front() + (is_angle(result) ? "/deg" : "/m"), "jump in x/m",
                 "jump in y/m", "turn/rad");
    first = false;
    fmt::print("{:>14.9g}{:>14.4g}{:>14.4g}{:>16.4g}  {}\n", factor * event.point.at.front(), event.jump.dx,
               event.jump.dy, event.jump.dalpha, report::vanishing_words(event.point.kind, event.point.vanishing));
  }
  if (!first) fmt::print("\n");
}

}  // namespace

CoordinateResult coordinate_errors(const mechanism::Mechanism& mechanism, core::LocusMap loci,
                                   const std::vector<DyadSides>& modes, int steps, bool worst_case) {
  CoordinateResult result{mechanism, std::move(loci), {}, steps};
  const numeric::NumericModel model = numeric::compile(mechanism);
  for (const DyadSides& sides : modes) {
    CoordinateErrors one;
    one.mode = result.loci.tower.roots.empty() ? sides : mode_of(sides, result.loci.tower);
    const std::vector<core::IsolatedPoint> events = events_of(result.loci, one.mode);
    const std::vector<RangePose> poses =
        numeric::error_range(model, sides, values_of(model.box.front(), steps, events));
    one.columns = columns_of(model, poses, events, worst_case);
    one.never_loaded = numeric::never_loaded(model, poses);
    for (std::size_t i = 0; i < events.size(); ++i) {
      const double free = free_beside(events, i, model.box.front());
      const numeric::PoseError jump = numeric::error_jump(model, sides, events[i].at.front(), free);
      one.events.push_back({events[i], without_noise(jump, one.columns)});
    }
    result.modes.push_back(std::move(one));
  }
  return result;
}

Json coordinate_errors_json(const CoordinateResult& result) {
  Json modes = Json::array();
  for (const CoordinateErrors& mode : result.modes) modes.push_back(mode_json(result, mode));
  return {{"format", 1},
          {"mechanism", result.mechanism.name},
          {"coordinates", {result.mechanism.coordinates.front().name}},
          {"complete", result.loci.complete},
          {"units", {is_angle(result) ? "rad" : "m"}},
          {"box", {{core::to_double(result.loci.lower[0]), core::to_double(result.loci.upper[0])}}},
          {"steps", result.steps},
          {"modes", std::move(modes)}};
}

void print_coordinate_errors(const CoordinateResult& result) {
  const std::string& coordinate = result.mechanism.coordinates.front().name;
  const double factor = is_angle(result) ? 180 / std::numbers::pi : 1;
  for (const CoordinateErrors& one : result.modes) {
    const std::string mode = report::mode_words(result.loci.tower, one.mode);
    fmt::print("{}: pose error over {} in {} steps{}\n\n", result.mechanism.name, coordinate, result.steps,
               mode.empty() ? "" : "; " + mode);
    if (!one.never_loaded.empty())
      fmt::print("No error under the load: {} bear{} nothing in any pose, so the take-up is undefined.\n\n",
                 fmt::join(one.never_loaded, ", "), one.never_loaded.size() == 1 ? "s" : "");
    fmt::print("{:<66}{:>12}{:>12}{:>12}  at {}\n", "absolute values", "median", "90 %", "largest",
               coordinate + (is_angle(result) ? "/deg" : "/m"));
    for (const ErrorColumn& column : error_columns) {
      if (!one.columns.has(column.name)) continue;
      const Json sizes = sizes_json(one.columns, column);
      if (sizes["median"].is_null()) continue;
      fmt::print("{:<66}{:>12.4g}{:>12.4g}{:>12.4g}  {:.6g}\n", fmt::format("{} [{}]", column.label, column.unit),
                 sizes["median"].get<double>(), sizes["percentile_90"].get<double>(),
                 std::abs(sizes["largest"].get<double>()), factor * sizes["at"][0].get<double>());
    }
    fmt::print("\n");
    print_jumps(result, one);
  }
}

}  // namespace clearloci::cli
