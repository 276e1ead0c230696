#include "report/trajectory_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/plot_lines.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

enum MarkStyle { stop_mark, couple_mark, force_mark, jump_mark };

std::string subtitle(const core::TrajectoryResult& result) {
  return fmt::format("{}, {} law, period {:.4g} s", result.trajectory, result.law, result.period);
}

Plot frame(const core::TrajectoryResult& result, const std::string& what) {
  Plot plot;
  plot.title = result.mechanism + ": " + what;
  plot.subtitle = subtitle(result);
  return plot;
}

/// "distance along the path (m)", "angle turned along the path (deg)", "time (s)".
std::string distance_label(const core::TrajectoryResult& result, const std::string& angle_unit) {
  if (result.distance_unit == "s") return "time (s)";
  if (result.distance_unit == "rad") return "angle turned along the path (" + angle_unit + ")";
  return result.distance_unit.empty() ? "distance along the path" : "distance along the path (m)";
}

/// Degrees in a radian where the path is one of angles.
double shown_scale(const core::TrajectoryResult& result) {
  return result.distance_unit == "rad" ? 180 / std::numbers::pi : 1;
}

/// Stops and contact losses, over time or distance.
void add_marks(const core::TrajectoryResult& result, Plot& plot, bool over_time) {
  const double scale = over_time ? 1 : shown_scale(result);
  plot.mark_labels = {"stop", "M = 0: backlash crossed", fmt::format("|f| down to {:.3g} N", result.min_force),
                      "reaction reversed at once"};
  for (const core::TrajectoryStage& stage : result.stages)
    plot.marks.push_back({scale * (over_time ? stage.ends : stage.stops_at), stop_mark});
  for (const core::ContactLoss& loss : result.losses) {
    const int style = loss.kind == core::LossKind::zero      ? couple_mark
                      : loss.kind == core::LossKind::minimum ? force_mark
                                                             : jump_mark;
    plot.marks.push_back({scale * (over_time ? loss.time : loss.distance), style});
  }
}

NamedPlot path_plot(const core::TrajectoryResult& result) {
  Plot plot = frame(result, "path, nominal and actual");
  plot.x_label = "x (m)";
  plot.equal_scales = true;
  PlotPanel panel;
  panel.y_label = "y (m)";
  const core::Table& c = result.samples;
  panel.series.push_back({"nominal", {line(c.at("px"), c.at("py"))}, -1, true});
  const auto &x = c.at("actual_px"), &y = c.at("actual_py"), &stage = c.at("stage");
  for (std::size_t k = 0; k < result.stages.size(); ++k) {
    core::Polyline points;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (stage[i] == static_cast<double>(k + 1)) points.push_back({x[i], y[i]});
    panel.series.push_back({fmt::format("actual, stage {}", k + 1), {std::move(points)}, static_cast<int>(k)});
  }
  plot.panels.push_back(std::move(panel));
  return {"trajectory-path", std::move(plot)};
}

NamedPlot error_plot(const core::TrajectoryResult& result) {
  Plot plot = frame(result, "pose error");
  plot.x_label = distance_label(result, "deg");
  const core::Table& c = result.samples;
  std::vector<double> distance = c.at("distance");
  for (double& value : distance) value *= shown_scale(result);
  const auto add = [&](const char* column, const char* label, const char* y_label, int number) {
    PlotPanel panel;
    panel.y_label = y_label;
    panel.series.push_back({label, {line(distance, c.at(column), 1e3)}, number});
    plot.panels.push_back(std::move(panel));
  };
  add("dx", "error in x", "mm", 0);
  add("dy", "error in y", "mm", 1);
  add("dalpha", "error in orientation", "mrad", 2);
  add_marks(result, plot, false);
  return {"trajectory-error", std::move(plot)};
}

NamedPlot take_up_plot(const core::TrajectoryResult& result) {
  Plot plot = frame(result, "direction of the take-up");
  plot.x_label = "time (s)";
  const core::Table& c = result.samples;
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    const std::string& name = result.joints[j];
    if (!c.has("beta_" + name)) continue;
    PlotPanel panel;
    panel.y_label = "β (deg)";
    panel.degrees = true;
    panel.y_range = {-190, 190};
    panel.series.push_back({"β of " + name, {angle_line(c.at("time"), c.at("beta_" + name))}, static_cast<int>(j)});
    plot.panels.push_back(std::move(panel));
  }
  add_marks(result, plot, true);
  plot.panel_height = 80;
  return {"trajectory-take-up", std::move(plot)};
}

NamedPlot reactions_plot(const core::TrajectoryResult& result) {
  Plot plot = frame(result, "reactions");
  plot.x_label = "time (s)";
  const core::Table& c = result.samples;
  PlotPanel forces, couples;
  forces.y_label = "|f| (N)";
  couples.y_label = "M (N m)";
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    const std::string &name = result.joints[j], fx = "f" + name + "x", fy = "f" + name + "y";
    if (c.has(fx) && c.has(fy))
      forces.series.push_back({"f_" + name, {line(c.at("time"), lengths(c.at(fx), c.at(fy)))}, static_cast<int>(j)});
    for (const char* const actuator : {"M", "F"})
      if (c.has(actuator + name))
        couples.series.push_back({"M_" + name, {line(c.at("time"), c.at(actuator + name))}, static_cast<int>(j)});
  }
  plot.panels.push_back(std::move(forces));
  if (!couples.series.empty()) plot.panels.push_back(std::move(couples));
  add_marks(result, plot, true);
  plot.panel_height = 190;
  return {"trajectory-reactions", std::move(plot)};
}

NamedPlot motion_plot(const core::TrajectoryResult& result) {
  Plot plot = frame(result, "motion of the end effector");
  plot.x_label = "time (s)";
  const core::Table& c = result.samples;
  const auto add = [&](const char* y_label, const std::string& ending, const std::string& what) {
    PlotPanel panel;
    panel.y_label = y_label;
    panel.series.push_back({what + " in x", {line(c.at("time"), c.at("px" + ending))}, 0});
    panel.series.push_back({what + " in y", {line(c.at("time"), c.at("py" + ending))}, 1});
    plot.panels.push_back(std::move(panel));
  };
  add("m", "", "place");
  add("m/s", "_rate", "velocity");
  add("m/s²", "_acceleration", "acceleration");
  return {"trajectory-motion", std::move(plot)};
}

/// The sample at a distance: of the two at a seam, the one on that side.
std::size_t sample_at(const core::PeriodSweep& sweep, double distance) {
  const auto right = std::upper_bound(sweep.distance.begin(), sweep.distance.end(), distance);
  if (right == sweep.distance.begin()) return 0;
  const auto k = static_cast<std::size_t>(right - sweep.distance.begin());
  if (k == sweep.distance.size()) return k - 1;
  return distance - sweep.distance[k - 1] < sweep.distance[k] - distance ? k - 1 : k;
}

NamedPlot sweep_plot(const core::TrajectoryResult& result, const std::string& name, const std::string& label,
                     const std::vector<double>& values, bool is_signed, const std::string& unit) {
  const core::PeriodSweep& sweep = *result.sweep;
  Plot plot = frame(result, label);
  plot.subtitle = "Free of contact loss above";
  for (std::size_t k = 0; k < result.stages.size(); ++k) {
    const double critical = result.stages[k].critical_period;
    plot.subtitle += std::isfinite(critical) ? fmt::format("{} {:.3g} s (stage {})", k == 0 ? "" : ",", critical, k + 1)
                                             : fmt::format("{} no period (stage {})", k == 0 ? "" : ",", k + 1);
  }
  plot.x_label = distance_label(result, "rad");
  const double half = sweep.periods.size() > 1 ? (sweep.periods[1] - sweep.periods[0]) / 2 : 0.5 * sweep.periods[0];
  const double lowest = sweep.periods.front() - half, highest = sweep.periods.back() + half;
  plot.x_range = {0, result.length};
  PlotPanel panel;
  panel.y_label = "period (s)";
  panel.y_range = {lowest, highest};
  const std::size_t rows = sweep.periods.size();
  panel.field = {label, unit, is_signed, values, [&sweep, values, lowest, highest, rows](double x, double y) {
                   const double place = (y - lowest) / (highest - lowest) * static_cast<double>(rows);
                   const auto row = static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(rows) - 0.5));
                   return values[sweep.index(row, sample_at(sweep, x))];
                 }};
  int number = 0;
  for (const core::LossCurve& curve : result.loss_curves) {
    const std::string what = reaction_name({curve.joint, curve.quantity});
    const bool is_number = curve.quantity != core::Quantity::f;
    const std::string words = is_number ? what + " = 0" : fmt::format("|{}| = {:.3g} N", what, result.min_force);
    const auto joint = std::find(result.joints.begin(), result.joints.end(), curve.joint) - result.joints.begin();
    panel.series.push_back({words, curve.lines, is_number ? number++ : 2 + static_cast<int>(joint), !is_number});
  }
  plot.panels.push_back(std::move(panel));
  for (const core::TrajectoryStage& stage : result.stages) plot.marks.push_back({stage.stops_at, stop_mark});
  plot.mark_labels = {"stop"};
  return {name, std::move(plot)};
}

}  // namespace

std::vector<NamedPlot> trajectory_plots(const core::TrajectoryResult& result) {
  std::vector<NamedPlot> plots = {path_plot(result), error_plot(result), take_up_plot(result), reactions_plot(result),
                                  motion_plot(result)};
  if (!result.sweep) return plots;
  const core::PeriodSweep& sweep = *result.sweep;
  plots.push_back(sweep_plot(result, "periods-dx", "error in x", sweep.dx, true, "m"));
  plots.push_back(sweep_plot(result, "periods-dy", "error in y", sweep.dy, true, "m"));
  plots.push_back(sweep_plot(result, "periods-dalpha", "error in orientation", sweep.dalpha, true, "rad"));
  plots.push_back(
      sweep_plot(result, "periods-dp", "distance from the nominal place", lengths(sweep.dx, sweep.dy), false, "m"));
  return plots;
}

}  // namespace clearloci::report
