#include "report/cell_zone_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "report/axis.hpp"
#include "report/file_units.hpp"
#include "report/mechanism_drawing.hpp"
#include "report/page_head.hpp"
#include "report/surface.hpp"
#include "report/theme.hpp"
#include "report/typesetting.hpp"
#include "report/wording.hpp"
#include "report/wrap.hpp"
#include "report/zones.hpp"

namespace clearloci::report {
namespace {

constexpr double gap = 46, legend_width = 190;  // pt
constexpr Font number_font{9, true};
constexpr Colour doubtful{0.45, 0.45, 0.45};
constexpr std::size_t layers_drawn = 6, columns_of_layers = 3;
/// A zone gets its number where a square of it is at least this wide, pt; on a strip counts the width alone.
constexpr double least_square = 9;

struct Scale {
  std::string label;
  double lower = 0, upper = 1;  ///< as shown
  bool angle = false;

  std::vector<Tick> ticks_at_least(double least) const {
    return angle ? angle_ticks(lower, upper, least) : ticks(lower, upper, least);
  }
};

Scale scale_of(const core::LocusMap& map, std::size_t c) {
  const bool angle = angles_of(map)[c];
  const ShownUnit length = shown_unit("m", map.units);
  const double factor = angle ? 180 / std::numbers::pi : length.per_si;
  return {printable(map.tower.coordinates[c]) + (angle ? " (deg)" : " (" + length.name + ")"),
          core::to_double(map.lower[c]) * factor, core::to_double(map.upper[c]) * factor, angle};
}

Colour colour_of(int zone) { return zone_colour(static_cast<std::size_t>(zone - 1)); }

/// Labels row after row, the first coordinate to the right.
struct Layer {
  std::string title;
  int columns = 0, rows = 0;
  std::vector<int> labels;
};

std::vector<Layer> layers_of(const core::Zones& map, const std::vector<int>& labels) {
  const int columns = map.grid.front(), rows = map.grid.size() > 1 ? map.grid[1] : 1;
  const auto size = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  const std::size_t all = labels.size() / size, drawn = std::min(all, layers_drawn);
  std::vector<Layer> layers;
  for (std::size_t k = 0; k < drawn; ++k) {
    const std::size_t layer = (2 * k + 1) * all / (2 * drawn);
    const auto first = labels.begin() + static_cast<std::ptrdiff_t>(layer * size);
    Layer zones{"", columns, rows, {first, first + static_cast<std::ptrdiff_t>(size)}};
    if (map.grid.size() > 2) {
      const Scale third = scale_of(map.loci, 2);
      const double at =
          third.lower + (static_cast<double>(layer) + 0.5) / static_cast<double>(all) * (third.upper - third.lower);
      zones.title = fmt::format("{} = {:.4g}", printable(map.loci.tower.coordinates[2]), at) +
                    (third.angle ? " deg" : " " + shown_unit("m", map.loci.units).name);
    }
    layers.push_back(std::move(zones));
  }
  return layers;
}

/// Runs of one label in a row.
template <class Use>
void for_runs(const Layer& layer, const Use& use) {
  for (int row = 0; row < layer.rows; ++row)
    for (int from = 0, to = 0; from < layer.columns; from = to) {
      const auto label = [&](int column) {
        return layer.labels[static_cast<std::size_t>(row) * static_cast<std::size_t>(layer.columns) +
                            static_cast<std::size_t>(column)];
      };
      for (to = from; to < layer.columns && label(to) == label(from);) ++to;
      use(row, from, to, label(from));
    }
}

/// The middle of the largest square of cells of each zone, and its half side, in cells.
struct Square {
  int row = 0, column = 0, half = 0;
};

std::map<int, Square> largest_squares(const Layer& layer) {
  const auto at = [&](int row, int column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(layer.columns) + static_cast<std::size_t>(column);
  };
  // How many steps, slanting ones too, it is to a cell of another label or out of the picture: there and back again.
  std::vector<int> steps(layer.labels.size(), 0);
  const auto reach = [&](int row, int column, int way) {
    int least = layer.rows + layer.columns;
    for (const auto& [down, aside] : {std::pair{0, -1}, {-1, -1}, {-1, 0}, {-1, 1}}) {
      const int r = row + way * down, c = column + way * aside;
      if (layer.rows == 1 && down != 0) continue;
      const bool inside = r >= 0 && r < layer.rows && c >= 0 && c < layer.columns;
      least =
          std::min(least, inside && layer.labels[at(r, c)] == layer.labels[at(row, column)] ? steps[at(r, c)] + 1 : 1);
    }
    return least;
  };
  for (int row = 0; row < layer.rows; ++row)
    for (int column = 0; column < layer.columns; ++column) steps[at(row, column)] = reach(row, column, 1);
  std::map<int, Square> largest;
  for (int row = layer.rows - 1; row >= 0; --row)
    for (int column = layer.columns - 1; column >= 0; --column) {
      int& step = steps[at(row, column)];
      step = std::min(step, reach(row, column, -1));
      Square& best = largest[layer.labels[at(row, column)]];
      if (step > best.half) best = {row, column, step};
    }
  return largest;
}

void draw_layer(const Canvas& canvas, const Layer& layer, const Box& box) {
  const double width = box.width / layer.columns, height = box.height / layer.rows;
  const auto top = [&](int row) { return box.bottom() - (row + 1) * height; };
  canvas.save();
  canvas.set_sharp_edges();  // neighbours meet without a seam
  for_runs(layer, [&](int row, int from, int to, int label) {
    if (label < 0) return;
    set_colour(canvas, label == 0 ? doubtful : colour_of(label));
    canvas.rectangle(box.x + from * width, top(row), (to - from) * width, height);
    canvas.fill();
  });
  canvas.restore();
  set_colour(canvas, light_theme.ink);
  for (const auto& [label, square] : largest_squares(layer)) {
    const double side = (2 * square.half - 1) * (layer.rows == 1 ? width : std::min(width, height));
    if (label > 0 && side >= least_square)
      write_text(canvas, std::to_string(label), box.x + (square.column + 0.5) * width,
                 top(square.row) + 0.5 * height + 3, number_font, Align::centre);
  }
}

void draw_axes(const Canvas& canvas, const Box& box, const Scale& x, const Scale* y) {
  set_colour(canvas, light_theme.frame);
  canvas.set_line_width(0.8);
  canvas.rectangle(box.x, box.y, box.width, box.height);
  canvas.stroke();
  constexpr double least_gap = 42;  // pt between ticks
  const auto at_x = [&](double value) { return box.x + (value - x.lower) / (x.upper - x.lower) * box.width; };
  for (const Tick& tick : x.ticks_at_least(least_gap / box.width * (x.upper - x.lower))) {
    canvas.move_to(at_x(tick.at), box.bottom());
    canvas.line_to(at_x(tick.at), box.bottom() + 3);
    canvas.stroke();
    write_text(canvas, tick.label, at_x(tick.at), box.bottom() + 12, tick_font, Align::centre);
  }
  write_text(canvas, x.label, box.x + 0.5 * box.width, box.bottom() + 24, label_font, Align::centre);
  if (y == nullptr) return;
  const auto at_y = [&](double value) {
    return box.bottom() - (value - y->lower) / (y->upper - y->lower) * box.height;
  };
  for (const Tick& tick : y->ticks_at_least(0.6 * least_gap / box.height * (y->upper - y->lower))) {
    canvas.move_to(box.x - 3, at_y(tick.at));
    canvas.line_to(box.x, at_y(tick.at));
    canvas.stroke();
    write_text(canvas, tick.label, box.x - 5, at_y(tick.at) + 3, tick_font, Align::right);
  }
  write_text(canvas, y->label, box.x - 4, box.y - 5, label_font, Align::right);
}

/// Where zones of the mode over one coordinate end: a line, heavy at a singularity.
void draw_ends(const Canvas& canvas, const core::Zones& map, const core::WorkingMode& mode, const Box& box) {
  const double lower = core::to_double(map.loci.lower[0]), width = core::to_double(map.loci.upper[0]) - lower;
  for (const core::Zone& zone : map.zones)
    for (const core::ZoneEnd& end : zone.ends) {
      if (zone.mode != mode) continue;
      const bool singular = end.kind == core::LocusKind::direct_singularity;
      const double x = box.x + (end.at - lower) / width * box.width;
      set_colour(canvas, light_theme.ink);
      canvas.set_line_width(singular ? 2.4 : 1.2);
      canvas.move_to(x, box.y - 4);
      canvas.line_to(x, box.bottom());
      canvas.stroke();
    }
}

struct LegendRow {
  std::optional<Colour> colour = {};
  std::vector<std::string> lines;
};

std::vector<LegendRow> legend_of(const core::Zones& map, const core::ZonedMode& mode) {
  std::vector<LegendRow> rows;
  const auto add = [&](const Colour& colour, const std::string& text) {
    rows.push_back({colour, wrap(text, legend_width - 16, measure_in(legend_font))});
  };
  constexpr std::size_t most = 24;
  std::size_t count = 0;
  for (std::size_t z = 0; z < map.zones.size(); ++z) {
    const core::Zone& zone = map.zones[z];
    if (zone.mode != mode.mode || ++count > most) continue;
    std::string signs;
    for (const auto& [reaction, sign] : zone.signs)
      signs += " " + reaction_name(reaction) + (sign > 0 ? "+" : sign < 0 ? "\u2212" : "?");
    add(colour_of(static_cast<int>(z) + 1), fmt::format("{} {}{}", zone.id,
                                                        zone.assembly_mode > 0   ? "|A|+"
                                                        : zone.assembly_mode < 0 ? "|A|\u2212"
                                                                                 : "",
                                                        signs));
    if (!zone.too_small.empty())
      for (std::string& line :
           wrap("too small: " + reaction_names(zone.too_small), legend_width - 16, measure_in(legend_font)))
        rows.back().lines.push_back(std::move(line));
  }
  if (count > most) rows.push_back({std::nullopt, {fmt::format("and {} more", count - most)}});
  const auto any = [&](int label) {
    return std::find(mode.labels.begin(), mode.labels.end(), label) != mode.labels.end();
  };
  if (any(0)) add(doubtful, "in doubt");
  if (any(-1)) rows.push_back({std::nullopt, {"white: out of reach"}});
  return rows;
}

}  // namespace

std::string cell_zone_picture(const core::Zones& map, const core::ZonedMode& mode, PictureFormat format) {
  const std::vector<Layer> layers = layers_of(map, mode.labels);
  const Scale x = scale_of(map.loci, 0);
  std::optional<Scale> y;
  if (map.grid.size() > 1) y = scale_of(map.loci, 1);
  const bool many = layers.size() > 1;
  const double width = many ? 190 : 420, height = !y ? 40 : many ? 190 : 420;
  const std::size_t columns = std::min(columns_of_layers, layers.size());
  const std::size_t rows = (layers.size() + columns - 1) / columns;
  const double left = page_margin + 36;
  const double legend_x = left + static_cast<double>(columns) * (width + gap) - gap + 24;
  const std::vector<LegendRow> legend = legend_of(map, mode);
  const std::string sides = mode_words(map.loci.tower, mode.mode);
  const double page_width = legend_x + legend_width + page_margin;
  const PageHead page = page_head(map.loci.mechanism, "Discontinuity-free zones" + (sides.empty() ? "" : "; " + sides),
                                  left, page_width - left - page_margin);
  const double head = page.bottom + (y ? 12 : 0);  // above the layers stand the names of their upright axes
  double legend_height = 0;
  for (const LegendRow& row : legend) legend_height += legend_line_height * static_cast<double>(row.lines.size()) + 4;
  const double below = head + static_cast<double>(rows) * (height + gap);
  // Beside a legend that reaches so far down there is the width of the layer alone.
  const double room = head + legend_height > below - legend_line_height ? width : width + legend_width;
  std::vector<std::string> ends;
  if (!y)
    for (const std::string& words : zone_end_lines(map, mode.mode))
      for (const std::string& line : wrap(printable(words), room, measure_in(legend_font))) ends.push_back(line);
  const double bottom = std::max(below + legend_line_height * static_cast<double>(ends.size()), head + legend_height);
  std::string description;
  for (const LegendRow& row : legend)
    for (const std::string& line : row.lines) description += line + "\n";
  for (const std::string& line : ends) description += line + "\n";
  const std::string title = printable(map.loci.mechanism);

  const auto draw = [&](const Canvas& canvas) {
    draw_page_head(canvas, page);
    for (std::size_t k = 0; k < layers.size(); ++k) {
      const std::size_t row = k / columns;
      const Box box{left + static_cast<double>(k % columns) * (width + gap),
                    head + static_cast<double>(row) * (height + gap), width, height};
      draw_layer(canvas, layers[k], box);
      if (!y) draw_ends(canvas, map, mode.mode, box);
      draw_axes(canvas, box, x, y ? &*y : nullptr);
      set_colour(canvas, light_theme.ink);
      write_text(canvas, layers[k].title, box.x + 0.5 * box.width, box.y - 5, legend_font, Align::centre);
    }
    double end_at = below;
    set_colour(canvas, light_theme.ink);
    for (const std::string& line : ends) {
      write_text(canvas, line, left, end_at, legend_font);
      end_at += legend_line_height;
    }
    double at = head + 8;
    for (const LegendRow& row : legend) {
      if (row.colour) {
        set_colour(canvas, *row.colour);
        canvas.rectangle(legend_x, at - 8, 10, 9);
        canvas.fill();
      }
      set_colour(canvas, light_theme.ink);
      for (const std::string& line : row.lines) {
        write_text(canvas, line, legend_x + 16, at, legend_font);
        at += legend_line_height;
      }
      at += 4;
    }
  };
  return render({page_width, std::ceil(bottom + page_margin), title, description}, format, draw);
}

}  // namespace clearloci::report
