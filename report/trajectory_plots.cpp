#include "report/trajectory_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "report/file_units.hpp"
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
  return "distance along the path" + (result.distance_unit.empty() ? "" : " (" + result.distance_unit + ")");
}

/// Degrees in a radian where the path is one of angles.
double shown_scale(const core::TrajectoryResult& result) {
  return result.distance_unit == "rad" ? 180 / std::numbers::pi : 1;
}

/// What lengths and forces are shown in; the result is in these already.
std::string length_name(const core::TrajectoryResult& result) { return shown_unit("m", result.units).name; }
std::string force_name(const core::TrajectoryResult& result) { return shown_unit("N", result.units).name; }

std::string least_force_words(const core::TrajectoryResult& result) {
  return fmt::format("|f| down to {} {}", engineering(result.min_force, 3), force_name(result));
}

/// Stops and contact losses, over time or distance.
void add_marks(const core::TrajectoryResult& result, Plot& plot, bool over_time) {
  const double scale = over_time ? 1 : shown_scale(result);
  std::vector<core::Quantity> zeros;
  for (const core::ContactLoss& loss : result.losses)
    if (loss.kind == core::LossKind::zero) zeros.push_back(loss.quantity);
  plot.mark_labels = {"stop", zero_words(zeros), least_force_words(result), "reaction reversed at once"};
  for (const core::TrajectoryStage& stage : result.stages)
    plot.marks.push_back({scale * (over_time ? stage.ends : stage.stops_at), stop_mark});
  for (const core::ContactLoss& loss : result.losses) {
    const int style = loss.kind == core::LossKind::zero      ? couple_mark
                      : loss.kind == core::LossKind::minimum ? force_mark
                                                             : jump_mark;
    plot.marks.push_back({scale * (over_time ? loss.time : loss.distance), style});
  }
}

double largest_size(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

/// 1, 2 or 5 times a power of ten: by how much errors are magnified to be seen beside a path; 1 where they are seen.
double magnification(const core::Table& c) {
  constexpr double seen = 0.05;  // of the path's extent
  double extent = 0, error = 0;
  for (const std::string axis : {"x", "y", "z"}) {
    if (!c.has("p" + axis)) continue;
    const auto& place = c.at("p" + axis);
    const auto [least, most] = std::minmax_element(place.begin(), place.end());
    extent = std::max(extent, *most - *least);
    error = std::max(error, largest_size(c.at("d" + axis)));
  }
  if (!(error > 0) || !(extent > 0)) return 1;
  const double wanted = seen * extent / error, power = std::pow(10.0, std::floor(std::log10(wanted)));
  if (wanted < 2) return 1;
  return wanted >= 5 * power ? 5 * power : wanted >= 2 * power ? 2 * power : power;
}

/// As seen along the third direction.
NamedPlot path_plot(const core::TrajectoryResult& result, char across, char up) {
  Plot plot = frame(result, "path, nominal and actual");
  plot.x_label = fmt::format("{} ({})", across, length_name(result));
  plot.equal_scales = true;
  PlotPanel panel;
  panel.y_label = fmt::format("{} ({})", up, length_name(result));
  const core::Table& c = result.samples;
  const auto &x = c.at(std::string("p") + across), &y = c.at(std::string("p") + up),
             &dx = c.at(std::string("d") + across), &dy = c.at(std::string("d") + up), &stage = c.at("stage");
  panel.series.push_back({"nominal", {line(x, y)}, -1, true});
  const double factor = magnification(c);
  const std::string how = factor > 1 ? fmt::format(", errors × {}", factor) : "";
  for (std::size_t k = 0; k < result.stages.size(); ++k) {
    core::Polyline points;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (stage[i] == static_cast<double>(k + 1)) points.push_back({x[i] + factor * dx[i], y[i] + factor * dy[i]});
    panel.series.push_back({fmt::format("actual, stage {}{}", k + 1, how), {std::move(points)}, static_cast<int>(k)});
  }
  plot.panels.push_back(std::move(panel));
  const bool only_view = !c.has("pz");
  return {only_view ? "trajectory-path" : fmt::format("trajectory-path-{}{}", across, up), std::move(plot)};
}

/// What small lengths are shown in, and how many of it the unit of lengths is: µm or mm where that is metric.
std::pair<std::string, double> small_length(const core::TrajectoryResult& result) {
  const ShownUnit length = shown_unit("m", result.units);
  if (length.name != "m" && length.name != "mm") return {length.name, 1};
  double most = 0;
  for (const std::string error : {"dx", "dy", "dz"})
    if (result.samples.has(error)) most = std::max(most, largest_size(result.samples.at(error)) / length.per_si);
  constexpr double coarse = 1e-4;  // m
  return most < coarse ? std::pair("µm", 1e6 / length.per_si) : std::pair("mm", 1e3 / length.per_si);
}

NamedPlot error_plot(const core::TrajectoryResult& result) {
  Plot plot = frame(result, "pose error");
  plot.x_label = distance_label(result, "deg");
  const core::Table& c = result.samples;
  std::vector<double> distance = c.at("distance");
  for (double& value : distance) value *= shown_scale(result);
  const auto [length, per_length] = small_length(result);
  const ShownUnit turn = core::told_unit("rad", result.units);
  const auto add = [&, per_length = per_length](const char* column, const char* label, const std::string& y_label,
                                                int number) {
    PlotPanel panel;
    panel.y_label = y_label;
    const double factor = y_label == turn.name ? turn.per_si : per_length;
    panel.series.push_back({label, {line(distance, c.at(column), factor)}, number});
    plot.panels.push_back(std::move(panel));
  };
  add("dx", "error in x", length, 0);
  add("dy", "error in y", length, 1);
  if (c.has("dz")) {
    add("dz", "error in z", length, 2);
    add("dalphax", "rotation about x", turn.name, 3);
    add("dalphay", "rotation about y", turn.name, 4);
    add("dalphaz", "rotation about z", turn.name, 5);
  } else {
    add("dalpha", "error in orientation", turn.name, 2);
  }
  share_ranges(plot);
  add_marks(result, plot, false);
  return {"trajectory-error", std::move(plot)};
}

NamedPlot take_up_plot(const core::TrajectoryResult& result) {
  Plot plot = frame(result, "direction of the take-up");
  plot.x_label = "time (s)";
  const core::Table& c = result.samples;
  PlotPanel panel;
  panel.y_label = "β (deg)";
  panel.degrees = true;
  panel.y_range = {-190, 190};
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    const std::string& name = result.joints[j];
    if (!c.has("beta_" + name)) continue;
    panel.series.push_back({"β of " + name, {angle_line(c.at("time"), c.at("beta_" + name))}, static_cast<int>(j)});
  }
  if (!panel.series.empty()) plot.panels.push_back(std::move(panel));
  add_marks(result, plot, true);
  return {"trajectory-take-up", std::move(plot)};
}

struct Effort {
  PlotSeries series;
  double largest = 0;
};

/// Panels of efforts of like size, the largest first: what is less than a tenth of a panel's largest would be a line
/// along its axis.
void add_by_size(std::vector<Effort> efforts, const std::string& y_label, Plot& plot) {
  constexpr double alike = 0.1;
  std::stable_sort(efforts.begin(), efforts.end(),
                   [](const Effort& a, const Effort& b) { return a.largest > b.largest; });
  double most = 0;
  for (Effort& effort : efforts) {
    if (most == 0 || (effort.largest < alike * most && effort.largest > 0)) {
      PlotPanel& panel = plot.panels.emplace_back();
      panel.y_label = y_label;
      most = effort.largest;
    }
    plot.panels.back().series.push_back(std::move(effort.series));
  }
}

NamedPlot reactions_plot(const core::TrajectoryResult& result) {
  Plot plot = frame(result, "reactions");
  plot.x_label = "time (s)";
  const core::Table& c = result.samples;
  std::vector<Effort> forces, couples, thrusts;
  const auto add = [&](std::vector<Effort>& efforts, const std::string& label, const std::vector<double>& values,
                       std::size_t number) {
    efforts.push_back({{label, {line(c.at("time"), values)}, static_cast<int>(number)}, largest_size(values)});
  };
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    const std::string &name = result.joints[j], fx = "f" + name + "x", fy = "f" + name + "y";
    if (c.has(fx) && c.has(fy)) {
      std::vector<double> sizes = lengths(c.at(fx), c.at(fy));
      if (const std::string fz = "f" + name + "z"; c.has(fz)) sizes = lengths(sizes, c.at(fz));
      add(forces, "f_" + name, sizes, j);
    }
    if (c.has("M" + name)) add(couples, "M_" + name, c.at("M" + name), j);
    if (c.has("F" + name)) add(thrusts, "F_" + name, c.at("F" + name), j);
  }
  add_by_size(std::move(forces), "|f| (" + force_name(result) + ")", plot);
  add_by_size(std::move(thrusts), "F (" + force_name(result) + ")", plot);
  add_by_size(std::move(couples), "M (N m)", plot);
  add_marks(result, plot, true);
  plot.panel_height = 190;
  return {"trajectory-reactions", std::move(plot)};
}

NamedPlot motion_plot(const core::TrajectoryResult& result) {
  Plot plot = frame(result, "motion of the end effector");
  plot.x_label = "time (s)";
  const core::Table& c = result.samples;
  const auto add = [&](const std::string& y_label, const std::string& ending, const std::string& what) {
    PlotPanel panel;
    panel.y_label = y_label;
    panel.series.push_back({what + " in x", {line(c.at("time"), c.at("px" + ending))}, 0});
    panel.series.push_back({what + " in y", {line(c.at("time"), c.at("py" + ending))}, 1});
    if (c.has("pz")) panel.series.push_back({what + " in z", {line(c.at("time"), c.at("pz" + ending))}, 2});
    plot.panels.push_back(std::move(panel));
  };
  const std::string length = length_name(result);
  add(length, "", "place");
  add(length + "/s", "_rate", "velocity");
  add(length + "/s²", "_acceleration", "acceleration");
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
                     const std::vector<double>& values, bool is_signed, const std::string& unit,
                     const std::vector<double>& coloured_by) {
  // The plot is drawn when the result is no more.
  const auto kept = std::make_shared<const core::PeriodSweep>(*result.sweep);
  const core::PeriodSweep& sweep = *kept;
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
  const bool radians = core::told_unit("rad", result.units).name == "rad";
  panel.field = {
      label, unit, is_signed, radians, coloured_by, [kept, values, lowest, highest, rows](double x, double y) {
        const double place = (y - lowest) / (highest - lowest) * static_cast<double>(rows);
        const auto row = static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(rows) - 0.5));
        return values[kept->index(row, sample_at(*kept, x))];
      }};
  int number = 0;
  // All least forces look alike: one entry of the legend names them.
  PlotSeries faint;
  faint.faint = true;
  for (const core::LossCurve& curve : result.loss_curves) {
    const std::string what = reaction_name({curve.joint, curve.quantity});
    if (curve.quantity != core::Quantity::f) {
      panel.series.push_back({what + " = 0", curve.lines, number++});
      continue;
    }
    faint.label += (faint.label.empty() ? "|" : ", |") + what + "|";
    faint.lines.insert(faint.lines.end(), curve.lines.begin(), curve.lines.end());
  }
  if (!faint.lines.empty()) {
    faint.label += fmt::format(" = {} {}", engineering(result.min_force, 3), force_name(result));
    panel.series.push_back(std::move(faint));
  }
  plot.panels.push_back(std::move(panel));
  for (const core::TrajectoryStage& stage : result.stages) plot.marks.push_back({stage.stops_at, stop_mark});
  plot.mark_labels = {"stop"};
  return {name, std::move(plot)};
}

}  // namespace

std::vector<NamedPlot> trajectory_plots(const core::TrajectoryResult& given) {
  const core::TrajectoryResult result = in_file_units(given);
  const bool spatial = result.samples.has("pz");
  std::vector<NamedPlot> plots = {path_plot(result, 'x', 'y')};
  if (spatial) plots.push_back(path_plot(result, 'x', 'z'));
  plots.push_back(error_plot(result));
  if (NamedPlot directions = take_up_plot(result); !directions.plot.panels.empty())
    plots.push_back(std::move(directions));
  plots.push_back(reactions_plot(result));
  plots.push_back(motion_plot(result));
  if (!result.sweep) return plots;
  const core::PeriodSweep& sweep = *result.sweep;
  const std::string length = length_name(result);
  std::vector<double> distances = lengths(sweep.dx, sweep.dy);
  std::vector<double> all = sweep.dx;  // one scale for all of them
  for (const std::vector<double>* const more : {&sweep.dy, &sweep.dz})
    all.insert(all.end(), more->begin(), more->end());
  plots.push_back(sweep_plot(result, "periods-dx", "error in x", sweep.dx, true, length, all));
  plots.push_back(sweep_plot(result, "periods-dy", "error in y", sweep.dy, true, length, all));
  if (spatial) {
    plots.push_back(sweep_plot(result, "periods-dz", "error in z", sweep.dz, true, length, all));
    distances = lengths(distances, sweep.dz);
  }
  plots.push_back(
      sweep_plot(result, "periods-dalpha", "error in orientation", sweep.dalpha, !spatial, "rad", sweep.dalpha));
  plots.push_back(
      sweep_plot(result, "periods-dp", "distance from the nominal place", distances, false, length, distances));
  return plots;
}

}  // namespace clearloci::report
