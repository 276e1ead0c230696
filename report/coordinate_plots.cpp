// The pictures of `clearloci error` over a single free coordinate.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/coordinate_plots.hpp"
#include "report/file_units.hpp"
#include "report/plot_lines.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

enum MarkStyle { contact_mark, couple_mark, singularity_mark, boundary_mark };

class ModePlots {
 public:
  ModePlots(const core::Errors& all, const core::ModeErrors& errors)
      : all_(all), errors_(errors), samples_(core::samples_of(errors)) {
    const bool angle = errors.map.angles.front();
    const core::Units& units = all.loci.units;
    to_axis_ = angle ? 180 / std::numbers::pi : shown_unit("m", units).per_si;
    axis_ = printable(errors.map.coordinates.front()) + (angle ? " (deg)" : " (" + units.length.name + ")");
    angle_ = core::told_unit("rad", units);
    if (units.declared) {
      length_ = small_length_ = shown_unit("m", units);
      force_ = shown_unit("N", units);
    }
    for (const double value : errors.map.axes.front()) at_.push_back(to_axis_ * value);
  }

  Plot error() const {
    Plot plot = frame("pose error");
    int number = 0;
    for (const core::Field& field : errors_.map.fields) {
      // Where no error under the load is defined the bound stands alone.
      const bool alone = !field.is_signed && field.name.starts_with("worst_") && field.name != "worst_dp" &&
                         !samples_.has(field.name.substr(6));
      if (!field.is_signed && !alone) continue;
      const ShownUnit& unit = field.unit == "m" ? length_ : angle_;
      PlotPanel panel;
      panel.y_label = unit.name;
      const std::string worst = alone ? field.name : "worst_" + field.name;
      if (samples_.has(worst)) {
        const core::Polyline above = line(at_, samples_.at(worst), unit.per_si);
        core::Polyline below = above;
        for (core::Point2& point : below) point[1] = -point[1];
        const bool is_first = plot.panels.empty();  // grey is the same in all panels
        const std::string bound = alone ? field.label : is_first ? "bound under any load" : "";
        panel.series.push_back({bound, {above, std::move(below)}, -1, true});
      }
      if (!alone) panel.series.push_back({field.label, {line(at_, field.values, unit.per_si)}, number++});
      panel.y_range = clipped_range(panel);
      plot.panels.push_back(std::move(panel));
    }
    share_ranges(plot);
    if (plot.panels.size() > 3) plot.panel_height = 110;
    return plot;
  }

  /// A panel for each thing that joints do, with a line a joint.
  Plot take_up() const {
    Plot plot = frame("take-up");
    add_take_ups(plot, "beta_", "β (deg)", "β of ", {"β (deg)", 0});
    for (const char axis : {'x', 'y', 'z'}) add_displacements(plot, axis);
    add_take_ups(plot, "theta_", "play of the drive", "drive ", angle_);
    add_take_ups(plot, "travel_", "play of the drive", "drive ", small_length_);
    add_take_ups(plot, "normal_", "across the guide", "guide ", small_length_);
    add_take_ups(plot, "tilt_", "tilt in the guide", "guide ", angle_);
    plot.panel_height = plot.panels.size() > 1 ? 130 : 0;
    return plot;
  }

  Plot reactions() const {
    Plot plot = frame("reactions");
    std::vector<PlotSeries> forces, efforts, couples;
    for (std::size_t j = 0; j < all_.joints.size(); ++j) {
      const std::string& name = all_.joints[j];
      if (samples_.has("f" + name + "x")) {
        std::vector<double> size = lengths(samples_.at("f" + name + "x"), samples_.at("f" + name + "y"));
        if (const std::string fz = "f" + name + "z"; samples_.has(fz)) size = lengths(size, samples_.at(fz));
        forces.push_back({"f_" + name, {line(at_, size, force_.per_si)}, static_cast<int>(j)});
      }
      const auto add = [&](std::vector<PlotSeries>& series, const std::string& quantity, double factor) {
        if (samples_.has(quantity + name))
          series.push_back({quantity + "_" + name,
                            {line(at_, samples_.at(quantity + name), factor)},
                            static_cast<int>(series.size())});
      };
      for (const char* const force : {"F", "N"}) add(efforts, force, force_.per_si);
      for (const char* const couple : {"M", "T"}) add(couples, couple, 1);
    }
    add_by_size(plot, force_.name, std::move(forces));
    add_by_size(plot, force_.name, std::move(efforts));
    add_by_size(plot, "N m", std::move(couples));
    plot.panel_height = plot.panels.size() > 3 ? 120 : 190;
    return plot;
  }

 private:
  Plot frame(const std::string& what) const {
    Plot plot;
    plot.title = all_.loci.mechanism + ": " + what;
    plot.subtitle = mode_words(all_.loci.tower, errors_.mode);
    plot.x_label = axis_;
    plot.degrees = errors_.map.angles.front();
    const std::vector<double>& values = at_;
    plot.x_range = {values.front(), values.back()};
    std::vector<core::Quantity> zeros;
    for (const core::ErrorEvent& event : errors_.events)
      if (event.point.kind == core::LocusKind::backlash)
        for (const core::Vanishing& vanishing : event.point.vanishing) zeros.push_back(vanishing.quantity);
    plot.mark_labels = {"contact lost", zero_words(zeros), "direct singularity", "end of the reach"};
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

  /// Of the values that are not among the largest: those near a direct singularity say nothing of the rest.
  static double typical_size(const PlotSeries& series) {
    std::vector<double> sizes;
    for (const core::Polyline& points : series.lines)
      for (const core::Point2& point : points)
        if (std::isfinite(point[1])) sizes.push_back(std::abs(point[1]));
    if (sizes.empty()) return 0;
    std::sort(sizes.begin(), sizes.end());
    return sizes[static_cast<std::size_t>(typical_part * static_cast<double>(sizes.size() - 1))];
  }

  /// "F, N" of series F_A, N_A, F_B; "|f|" of sizes.
  static std::string quantities_of(const std::vector<PlotSeries>& series) {
    std::vector<std::string> names;
    for (const PlotSeries& line : series) {
      const std::string name = line.label.starts_with("f_") ? "|f|" : line.label.substr(0, 1);
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return fmt::format("{}", fmt::join(names, ", "));
  }

  /// The series in panels of their own where one would flatten the other, the largest first.
  static void add_by_size(Plot& plot, const std::string& unit, std::vector<PlotSeries> series) {
    constexpr double most_ratio = 20;
    std::stable_sort(series.begin(), series.end(),
                     [](const PlotSeries& a, const PlotSeries& b) { return typical_size(a) > typical_size(b); });
    double largest = 0;
    std::size_t first = plot.panels.size();
    for (PlotSeries& line : series) {
      const double size = typical_size(line);
      const bool flattened = size > rounding && size * most_ratio < largest;
      if (plot.panels.size() == first || flattened) {
        largest = size;
        plot.panels.emplace_back();
      }
      plot.panels.back().series.push_back(std::move(line));
    }
    for (std::size_t i = first; i < plot.panels.size(); ++i) {
      std::vector<PlotSeries>& lines = plot.panels[i].series;
      std::stable_sort(lines.begin(), lines.end(),
                       [](const PlotSeries& a, const PlotSeries& b) { return a.number < b.number; });
      plot.panels[i].y_range = clipped_range(plot.panels[i]);
      plot.panels[i].y_label = quantities_of(lines) + " (" + unit + ")";
    }
  }

  /// In space a panel a component of where joints are pressed to.
  void add_displacements(Plot& plot, char axis) const {
    PlotPanel panel;
    panel.y_label = fmt::format("d{} ({})", axis, small_length_.name);
    for (std::size_t j = 0; j < all_.joints.size(); ++j) {
      const std::string column = "d_" + all_.joints[j] + "_" + axis;
      if (!samples_.has(column)) continue;
      panel.series.push_back({fmt::format("d{} of {}", axis, all_.joints[j]),
                              {line(at_, samples_.at(column), small_length_.per_si)},
                              static_cast<int>(j)});
    }
    add_even(plot, std::move(panel));
  }

  /// A panel where joints have that take-up; a unit without size: an angle to be drawn in degrees.
  void add_take_ups(Plot& plot, const std::string& column, const std::string& what, const std::string& label,
                    const ShownUnit& unit) const {
    const bool direction = unit.per_si == 0;
    PlotPanel panel;
    panel.y_label = direction ? unit.name : what + " (" + unit.name + ")";
    for (std::size_t j = 0; j < all_.joints.size(); ++j) {
      const std::string& name = all_.joints[j];
      if (!samples_.has(column + name)) continue;
      const std::vector<double>& values = samples_.at(column + name);
      panel.series.push_back(
          {label + name, {direction ? angle_line(at_, values) : line(at_, values, unit.per_si)}, static_cast<int>(j)});
    }
    if (direction && !panel.series.empty()) {
      panel.degrees = true;
      panel.y_range = {-190, 190};
      plot.panels.push_back(std::move(panel));
    } else {
      add_even(plot, std::move(panel));
    }
  }

  /// As far up as down.
  static void add_even(Plot& plot, PlotPanel panel) {
    if (panel.series.empty()) return;
    double most = 0;
    for (const PlotSeries& series : panel.series)
      for (const core::Polyline& points : series.lines)
        for (const core::Point2& point : points)
          if (std::isfinite(point[1])) most = std::max(most, std::abs(point[1]));
    panel.y_range = most <= rounding ? std::array<double, 2>{-1, 1} : std::array<double, 2>{-1.25 * most, 1.25 * most};
    plot.panels.push_back(std::move(panel));
  }

  /// Near a direct singularity values grow without bound; the rest must still be seen. None: nothing is that large.
  static std::optional<std::array<double, 2>> clipped_range(const PlotPanel& panel) {
    constexpr double most = 4, room = 2;
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
    if (sizes.back() <= rounding) return std::array<double, 2>{-1, 1};
    const double typical = sizes[static_cast<std::size_t>(typical_part * static_cast<double>(sizes.size() - 1))];
    if (typical == 0 || sizes.back() <= most * typical) return std::nullopt;
    return std::array<double, 2>{signs[0] ? -room * typical : 0, signs[1] ? room * typical : 0};
  }

  static constexpr double typical_part = 0.85;
  /// In the units shown: picometres, nanonewtons. What is smaller is what rounding leaves of zero.
  static constexpr double rounding = 1e-9;

  const core::Errors& all_;
  const core::ModeErrors& errors_;
  const core::Table samples_;
  double to_axis_ = 1;
  std::string axis_;
  ShownUnit length_{"mm", 1e3}, small_length_{"µm", 1e6}, angle_{"deg", 180 / std::numbers::pi}, force_{"N", 1};
  std::vector<double> at_;
};

}  // namespace

std::vector<NamedPlot> coordinate_plots(const core::Errors& errors, const core::ModeErrors& mode) {
  const ModePlots plots(errors, mode);
  std::vector<NamedPlot> all = {
      {"error", plots.error()}, {"take-up", plots.take_up()}, {"reactions", plots.reactions()}};
  std::erase_if(all, [](const NamedPlot& plot) { return plot.plot.panels.empty(); });
  return all;
}

}  // namespace clearloci::report
