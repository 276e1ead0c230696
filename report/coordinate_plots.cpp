// The pictures of `clearloci error` over a single free coordinate.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/coordinate_plots.hpp"
#include "report/plot_lines.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

enum MarkStyle { contact_mark, couple_mark, singularity_mark, boundary_mark };

class ModePlots {
 public:
  ModePlots(const core::CoordinateErrors& result, const core::CoordinateModeErrors& errors)
      : result_(result), errors_(errors) {
    const bool angle = result.angle;
    to_axis_ = angle ? 180 / std::numbers::pi : 1;
    axis_ = printable(result.coordinate) + (angle ? " (deg)" : " (m)");
    for (const double value : errors.samples.columns.front()) at_.push_back(to_axis_ * value);
  }

  Plot error() const {
    Plot plot = frame("pose error");
    const auto add = [&](const char* column, const char* label, const char* unit, int number) {
      PlotPanel panel;
      panel.y_label = unit;
      const std::string worst = std::string("worst_") + column;
      if (errors_.samples.has(worst)) {
        core::Polyline above = line(at_, errors_.samples.at(worst), 1e3), below = above;
        for (core::Point2& point : below) point[1] = -point[1];
        panel.series.push_back({"bound under any load", {std::move(above), std::move(below)}, -1, true});
      }
      panel.series.push_back({label, {line(at_, errors_.samples.at(column), 1e3)}, number});
      panel.y_range = clipped_range(panel);
      plot.panels.push_back(std::move(panel));
    };
    add("dx", "error in x", "mm", 0);
    add("dy", "error in y", "mm", 1);
    add("dalpha", "error in orientation", "mrad", 2);
    return plot;
  }

  Plot take_up() const {
    Plot plot = frame("take-up");
    for (std::size_t j = 0; j < result_.joints.size(); ++j) {
      const std::string& name = result_.joints[j];
      add_take_up(plot, "beta_" + name, "β of " + name, "β (deg)", 0, static_cast<int>(j));
      add_take_up(plot, "theta_" + name, "play of the drive " + name, "mrad", 1e3, static_cast<int>(j));
      add_take_up(plot, "travel_" + name, "play of the drive " + name, "µm", 1e6, static_cast<int>(j));
      add_take_up(plot, "normal_" + name, "across the guide " + name, "µm", 1e6, static_cast<int>(j));
      add_take_up(plot, "tilt_" + name, "tilt in the guide " + name, "mrad", 1e3, static_cast<int>(j));
    }
    plot.panel_height = 80;
    return plot;
  }

  Plot reactions() const {
    Plot plot = frame("reactions");
    PlotPanel forces, couples;
    forces.y_label = "|f| (N)";
    couples.y_label = "N, N m";
    for (std::size_t j = 0; j < result_.joints.size(); ++j) {
      const std::string& name = result_.joints[j];
      if (errors_.samples.has("f" + name + "x")) {
        const std::vector<double> size =
            lengths(errors_.samples.at("f" + name + "x"), errors_.samples.at("f" + name + "y"));
        forces.series.push_back({"f_" + name, {line(at_, size)}, static_cast<int>(j)});
      }
      for (const std::string quantity : {"M", "F", "N", "T"})
        if (errors_.samples.has(quantity + name))
          couples.series.push_back(
              {quantity + "_" + name, {line(at_, errors_.samples.at(quantity + name))}, static_cast<int>(j)});
    }
    for (PlotPanel* panel : {&forces, &couples}) {
      if (panel->series.empty()) continue;
      panel->y_range = clipped_range(*panel);
      plot.panels.push_back(std::move(*panel));
    }
    plot.panel_height = 190;
    return plot;
  }

 private:
  Plot frame(const std::string& what) const {
    Plot plot;
    plot.title = result_.mechanism + ": " + what;
    plot.subtitle = mode_words(result_.loci.tower, errors_.mode);
    plot.x_label = axis_;
    plot.degrees = result_.angle;
    const std::vector<double>& values = at_;
    plot.x_range = {values.front(), values.back()};
    plot.mark_labels = {"contact lost", "M = 0: backlash crossed", "direct singularity", "end of the reach"};
    for (const core::ErrorEvent& event : errors_.events) {
      const core::LocusKind kind = event.point.kind;
      const int style = kind == core::LocusKind::contact_loss         ? contact_mark
                        : kind == core::LocusKind::backlash           ? couple_mark
                        : kind == core::LocusKind::direct_singularity ? singularity_mark
                                                                      : boundary_mark;
      plot.marks.push_back({to_axis_ * event.point.at.front(), style});
    }
    return plot;
  }

  /// A panel where the joint has that take-up; `factor` 0: an angle to be drawn in degrees.
  void add_take_up(Plot& plot, const std::string& column, const std::string& label, const char* unit, double factor,
                   int number) const {
    if (!errors_.samples.has(column)) return;
    const std::vector<double>& values = errors_.samples.at(column);
    PlotPanel panel;
    panel.y_label = unit;
    panel.series.push_back({label, {factor == 0 ? angle_line(at_, values) : line(at_, values, factor)}, number});
    if (factor == 0) {
      panel.degrees = true;
      panel.y_range = {-190, 190};
    } else {
      double most = 0;
      for (const double value : values)
        if (std::isfinite(value)) most = std::max(most, factor * std::abs(value));
      if (most > 0) panel.y_range = {-1.25 * most, 1.25 * most};
    }
    plot.panels.push_back(std::move(panel));
  }

  /// Near a direct singularity values grow without bound; the rest must still be seen. None: nothing is that large.
  static std::optional<std::array<double, 2>> clipped_range(const PlotPanel& panel) {
    constexpr double typical_part = 0.85, most = 4, room = 2;
    std::vector<double> sizes;
    bool signs[2] = {false, false};
    for (const PlotSeries& series : panel.series)
      for (const core::Polyline& points : series.lines)
        for (const core::Point2& point : points)
          if (std::isfinite(point[1])) {
            sizes.push_back(std::abs(point[1]));
            signs[point[1] < 0 ? 0 : 1] = true;
          }
    if (sizes.empty()) return std::nullopt;
    std::sort(sizes.begin(), sizes.end());
    const double typical = sizes[static_cast<std::size_t>(typical_part * static_cast<double>(sizes.size() - 1))];
    if (typical == 0 || sizes.back() <= most * typical) return std::nullopt;
    return std::array<double, 2>{signs[0] ? -room * typical : 0, signs[1] ? room * typical : 0};
  }

  const core::CoordinateErrors& result_;
  const core::CoordinateModeErrors& errors_;
  double to_axis_ = 1;
  std::string axis_;
  std::vector<double> at_;
};

}  // namespace

std::vector<NamedPlot> coordinate_plots(const core::CoordinateErrors& result) {
  std::vector<NamedPlot> plots;
  for (const core::CoordinateModeErrors& mode : result.modes) {
    const ModePlots own(result, mode);
    const std::string which = result.modes.size() > 1 ? "-" + mode_slug(result.loci.tower, mode.mode) : std::string();
    plots.push_back({"error" + which, own.error()});
    plots.push_back({"take-up" + which, own.take_up()});
    plots.push_back({"reactions" + which, own.reactions()});
  }
  return plots;
}

}  // namespace clearloci::report
