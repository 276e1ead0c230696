// Plots of one quantity over another: lines in panels one above the other, with a common horizontal axis; or a field
// over two quantities in colours, with lines over it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/locus_map.hpp"
#include "report/picture.hpp"

namespace clearloci::report {

/// Lines are broken where a value is not a number. Series of one number in different panels look alike.
struct PlotSeries {
  std::string label;  ///< of the legend; empty: not in it
  std::vector<core::Polyline> lines;
  int number = 0;      ///< chooses the colour; -1: black
  bool faint = false;  ///< thin and grey, for what the others are compared with
};

/// A vertical line: something happens there.
struct PlotMark {
  double at = 0;
  int style = 0;  ///< as the mark legend of the plot
};

/// A field over the panel, drawn below its lines. NaN: nothing.
struct PlotField {
  std::string label, unit;
  bool is_signed = true;
  bool radians = false;        ///< angles are shown in rad, not in degrees
  std::vector<double> values;  ///< all of them, to choose the colours by
  std::function<double(double x, double y)> at;
};

struct PlotPanel {
  std::string y_label;
  bool degrees = false;  ///< the y axis bears degrees
  std::vector<PlotSeries> series;
  std::optional<PlotField> field;
  std::optional<std::array<double, 2>> y_range;  ///< else what the series need
};

struct Plot {
  std::string title, subtitle;
  std::string x_label;
  bool degrees = false;                          ///< the x axis bears degrees
  std::optional<std::array<double, 2>> x_range;  ///< else what the series need
  std::vector<PlotPanel> panels;
  std::vector<PlotMark> marks;
  std::vector<std::string> mark_labels;  ///< by style
  bool equal_scales = false;             ///< one panel whose axes are of one kind
  double panel_height = 0;               ///< pt; 0: by the number of panels
};

/// Panels of one unit get the range that all of them need, so that they can be compared.
void share_ranges(Plot& plot);

struct NamedPlot {
  std::string name;  ///< of the file, without its ending
  Plot plot;
};

std::string plot(const Plot& plot, PictureFormat format);

/// RFC 4180 with "\n": names, then rows of numbers that read back as the same doubles, empty where there is none.
/// Columns are of equal length.
std::string table_csv(const std::vector<std::string>& names, const std::vector<std::vector<double>>& columns);

}  // namespace clearloci::report
