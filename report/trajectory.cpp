#include "report/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/file_units.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/plot.hpp"
#include "report/table_json.hpp"
#include "report/text_table.hpp"
#include "report/trajectory_plots.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

Json losses_json(const core::TrajectoryResult& result) {
  Json all = Json::array();
  for (const core::ContactLoss& loss : result.losses) {
    Json one = {{"time", loss.time},
                {"distance", loss.distance},
                {"stage", loss.stage},
                {"joint", loss.joint},
                {"quantity", core::to_string(loss.quantity)},
                {"kind", core::to_string(loss.kind)}};
    if (loss.kind == core::LossKind::minimum) {
      one["force"] = loss.force;
      one["from"] = loss.from;
      one["to"] = loss.to;
      one["earles_wu"] = number_json(loss.earles_wu);
    }
    if (loss.kind == core::LossKind::jump) one["by"] = loss.payload ? "payload" : "acceleration";
    one["crossed"] = loss.crossed;
    one["jump"] = {{"displacement", loss.displacement}, {"rotation", loss.rotation}};
    all.push_back(std::move(one));
  }
  return all;
}

Json stages_json(const core::TrajectoryResult& result) {
  Json all = Json::array();
  for (const core::TrajectoryStage& stage : result.stages) {
    Json one = {{"from", stage.from},
                {"to", stage.to},
                {"begins", stage.begins},
                {"ends", stage.ends},
                {"length", stage.stops_at - stage.starts_at},
                {"carried", stage.carried},
                {"critical_period", number_json(stage.critical_period)}};
    if (stage.lost_last)
      one["lost_last"] = {{"joint", stage.lost_last->joint},
                          {"quantity", core::to_string(stage.lost_last->quantity)},
                          {"distance", stage.lost_last->distance}};
    all.push_back(std::move(one));
  }
  return all;
}

/// Distances along the path as they are shown: angles in degrees.
struct ShownDistance {
  double scale = 1;
  std::string unit;  ///< with the space before it

  explicit ShownDistance(const std::string& of)
      : scale(of == "rad" ? 180 / std::numbers::pi : 1),
        unit(of == "rad"  ? " deg"
             : of.empty() ? ""
                          : " " + of) {}
};

std::string loss_words(const core::ContactLoss& loss, const std::string& force) {
  const std::string what = reaction_name({loss.joint, loss.quantity});
  switch (loss.kind) {
    case core::LossKind::zero:
      return what + " = 0";
    case core::LossKind::minimum:
      if (!std::isfinite(loss.earles_wu)) return what + " = 0";
      return what + fmt::format(" down to {} {}, turning {} rad/(N s)", engineering(loss.force, 4), force,
                                engineering(loss.earles_wu, 3));
    case core::LossKind::jump:
      break;
  }
  return what + (loss.payload ? " reversed by the payload" : " reversed as the acceleration jumps");
}

std::string notes_text(const core::TrajectoryResult& result) {
  std::string text;
  for (const std::string& note : result.notes) text += note + "\n";
  return text;
}

}  // namespace

Json trajectory_object(const core::TrajectoryResult& result) {
  Json json = {{"format", 1},
               {"mechanism", result.mechanism},
               {"parameters", parameters_object(result.parameters)},
               {"trajectory", result.trajectory},
               {"law", result.law},
               {"period", result.period},
               {"length", result.length},
               {"min_force", result.min_force},
               {"stages", stages_json(result)},
               {"contact_losses", losses_json(result)}};
  if (result.units.declared) json["units"] = "SI";
  if (!result.notes.empty()) json["notes"] = result.notes;
  if (result.sweep) {
    const std::vector<double>& periods = result.sweep->periods;
    json["periods"] = {{"from", periods.front()}, {"to", periods.back()}, {"count", periods.size()}};
  }
  json["samples"] = table_object(result.samples);
  return json;
}

core::Table sweep_table(const core::TrajectoryResult& result) {
  const core::PeriodSweep& sweep = *result.sweep;
  core::Table table{{"period", "distance"}, {"s", result.distance_unit}, std::vector<std::vector<double>>(2)};
  for (const double period : sweep.periods) {
    table.columns[0].insert(table.columns[0].end(), sweep.distance.size(), period);
    table.columns[1].insert(table.columns[1].end(), sweep.distance.begin(), sweep.distance.end());
  }
  const auto add = [&table](const std::string& name, const std::string& unit, const std::vector<double>& values) {
    table.names.push_back(name);
    table.units.push_back(unit);
    table.columns.push_back(values);
  };
  add("dx", "m", sweep.dx);
  add("dy", "m", sweep.dy);
  if (!sweep.dz.empty()) add("dz", "m", sweep.dz);
  add("dalpha", "rad", sweep.dalpha);
  return table;
}

std::string trajectory_text(const core::TrajectoryResult& given) {
  const core::TrajectoryResult result = in_file_units(given);
  const std::string force = shown_unit("N", result.units).name;
  const ShownDistance shown(result.distance_unit);
  std::string text =
      fmt::format("{}: {}, {} law, period {} s, length {}{}\n{}\n", result.mechanism, result.trajectory, result.law,
                  engineering(result.period, size_digits), engineering(shown.scale * result.length, size_digits),
                  shown.unit, parameter_line(result.parameters));
  std::vector<Row> stages;
  for (std::size_t k = 0; k < result.stages.size(); ++k) {
    const core::TrajectoryStage& s = result.stages[k];
    stages.push_back({std::to_string(k + 1), s.from + " - " + s.to, engineering(s.begins, size_digits),
                      engineering(s.ends, size_digits), engineering(s.carried, size_digits),
                      std::isfinite(s.critical_period) ? engineering(s.critical_period, size_digits) : "never",
                      s.lost_last ? reaction_name({s.lost_last->joint, s.lost_last->quantity}) + " at " +
                                        engineering(shown.scale * s.lost_last->distance, few_digits) + shown.unit
                                  : ""});
  }
  text += format_filled_columns({{"stage"},
                                 {"from - to"},
                                 {"begins [s]", 0, Alignment::point},
                                 {"ends [s]", 0, Alignment::point},
                                 {"carried [kg]", 0, Alignment::point},
                                 {"free above [s]", 0, Alignment::point},
                                 {"lost last"}},
                                stages);
  text += fmt::format(
      "\ncontact is lost where M, F or an end of a guide passes through 0 or |f| falls to {} {}: {} times\n",
      engineering(result.min_force, 4), force, result.losses.size());
  if (result.losses.empty()) return text + notes_text(result);
  const std::string heading = shown.unit == " deg" ? "angle [deg]"
                              : shown.unit.empty() ? "distance"
                                                   : "distance [" + shown.unit.substr(1) + "]";
  double largest = 0;
  for (const core::ContactLoss& loss : result.losses) largest = std::max(largest, loss.displacement);
  const ShownUnit jump =
      result.units.declared ? ShownUnit{shown_unit("m", result.units).name, 1} : table_unit("m", result.units, largest);
  constexpr double rounding = 1e-9;  // of the largest jump: what is left of one that moves other links only
  std::vector<Row> losses;
  for (const core::ContactLoss& loss : result.losses)
    losses.push_back(
        {engineering(loss.time, place_digits), engineering(shown.scale * loss.distance, place_digits),
         std::to_string(loss.stage),
         loss.displacement <= rounding * largest ? "0" : engineering(loss.displacement * jump.per_si, few_digits),
         loss_words(loss, force)});
  text += format_rows({{"time [s]", 0, Alignment::point},
                       {heading, 0, Alignment::point},
                       {"stage", 0, Alignment::right},
                       {"jump [" + jump.name + "]", 0, Alignment::point},
                       {"what"}},
                      losses);
  return text + notes_text(result);
}

std::string shown_csv(const core::Table& table, const core::Units& units) {
  if (!units.declared) return table_csv(table.names, table.columns);
  const core::Table shown = in_file_units(table, units);
  std::vector<std::string> heads;
  for (std::size_t c = 0; c < shown.names.size(); ++c)
    heads.push_back(shown.units[c].empty() ? shown.names[c] : shown.names[c] + " (" + shown.units[c] + ")");
  return table_csv(heads, shown.columns);
}

}  // namespace clearloci::report
