#include "report/task_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/task.hpp"
#include "report/axis.hpp"
#include "report/file_units.hpp"
#include "report/mechanism_drawing.hpp"
#include "report/page_head.hpp"
#include "report/surface.hpp"
#include "report/theme.hpp"
#include "report/typesetting.hpp"
#include "report/verification.hpp"
#include "report/wording.hpp"
#include "report/wrap.hpp"

namespace clearloci::report {
namespace {

using Pose = std::vector<double>;
using Place = std::array<double, 2>;

constexpr double panel = 190, strip = 40, gap = 58, left_room = 48;  // pt
constexpr double strip_width = 480, least_legend = 420;
constexpr std::size_t columns_of_panels = 3, most_panels = 6;
/// A locus or witness is drawn where the picture gets no more than this many times as wide by it.
constexpr double most_growth = 4;

const Colour& colour_of(const core::Verification& result) {
  return result.verified() ? light_theme.verified : light_theme.failed;
}

/// As on white, but covering what is below.
Colour faint(const Colour& colour, double strength) {
  const auto mixed = [&](double dash) { return 1 - strength * (1 - dash); };
  return {mixed(colour.red), mixed(colour.green), mixed(colour.blue)};
}

/// The task's poses: corners of a box or a solid, ends of a path, and how far a ball reaches.
struct Extent {
  Pose lower, upper;
};

double weight_of(const core::Verification& result, std::size_t c) {
  const auto& length = result.task.angle_length;
  return result.angles[c] && length ? core::to_double(*length) : 1.0;
}

/// How far along a coordinate the task is proven to be free around it.
double room_along(const core::Verification& result, std::size_t c) {
  const bool apart = result.angles[c] && !result.task.angle_length;
  const std::optional<double>& least_margin = apart ? result.angle_margin : result.margin;
  return least_margin.value_or(result.verified() ? 0 : core::to_double(result.task.margin)) / weight_of(result, c);
}

Extent extent_of(const core::Verification& result) {
  std::vector<core::Rational> weights;
  for (std::size_t c = 0; c < result.angles.size(); ++c)
    weights.push_back(result.angles[c] && result.task.angle_length ? *result.task.angle_length : core::Rational(1));
  const auto bounds = core::bounds(result.task.shape, weights);
  return {core::rounded(bounds[0]), core::rounded(bounds[1])};
}

/// What is shown of a coordinate, in its own unit.
struct Range {
  double lower = 0, upper = 1;
  double width() const { return upper - lower; }
};

Range range_of(const core::Verification& result, const Extent& task, std::size_t c) {
  const double room = room_along(result, c);
  Range range{task.lower[c] - room, task.upper[c] + room};
  const double bare = range.width();
  const auto reach = [&](double value) {
    const Range wider{std::min(range.lower, value), std::max(range.upper, value)};
    if (bare == 0 || wider.width() <= most_growth * bare) range = wider;
  };
  if (result.nearest) reach(result.nearest->at[c]);
  if (result.witness) reach(result.witness->at[c]);
  return range;
}

/// Two coordinates of a panel; of a strip the second is none.
struct Pair {
  std::size_t x = 0;
  std::optional<std::size_t> y;
};

std::vector<Pair> pairs_of(const std::vector<bool>& angles) {
  if (angles.size() == 1) return {{0, std::nullopt}};
  std::array<std::vector<std::size_t>, 2> kinds;
  for (std::size_t c = 0; c < angles.size(); ++c) kinds[angles[c] ? 1 : 0].push_back(c);
  std::vector<Pair> all;
  for (const auto& kind : kinds)
    for (std::size_t i = 0; i < kind.size(); ++i)
      for (std::size_t j = i + 1; j < kind.size(); ++j) all.push_back({kind[i], kind[j]});
  for (std::size_t k = 0; k < 2; ++k)
    if (kinds[k].size() == 1 && (k == 1 || kinds[1].size() > 1))
      for (const std::size_t other : kinds[1 - k]) all.push_back({other, kinds[k].front()});
  if (all.size() > most_panels) all.resize(most_panels);
  return all;
}

class Panel {
 public:
  Panel(const core::Verification& result, const Pair& pair, const std::vector<Range>& ranges, Box box)
      : result_(result), pair_(pair), box_(box), x_(ranges[pair.x]), y_(pair.y ? ranges[*pair.y] : Range{0, 1}) {}

  void draw(const Canvas& canvas, const Extent& task) const {
    canvas.save();
    canvas.rectangle(box_.x, box_.y, box_.width, box_.height);
    canvas.clip();
    draw_shape(canvas, task);
    draw_open(canvas);
    if (result_.nearest) draw_nearest(canvas, result_.nearest->at);
    if (result_.witness) draw_ring(canvas, result_.witness->at);
    canvas.restore();
    draw_axes(canvas);
  }

 private:
  double at_x(double value) const { return box_.x + (value - x_.lower) / x_.width() * box_.width; }
  double at_y(double value) const { return box_.bottom() - (value - y_.lower) / y_.width() * box_.height; }
  Place at(const Pose& pose) const { return {at_x(pose[pair_.x]), at_y(pair_.y ? pose[*pair_.y] : 0.5)}; }

  /// Where it has no width it is a line.
  void rectangle(const Canvas& canvas, const Extent& extent) const {
    const double left = at_x(extent.lower[pair_.x]), right = at_x(extent.upper[pair_.x]);
    const double low = pair_.y ? at_y(extent.lower[*pair_.y]) : at_y(0.3);
    const double high = pair_.y ? at_y(extent.upper[*pair_.y]) : at_y(0.7);
    canvas.rectangle(left, high, right - left, low - high);
  }

  void ellipse(const Canvas& canvas, const Extent& task) const {
    const double rx = 0.5 * (at_x(task.upper[pair_.x]) - at_x(task.lower[pair_.x]));
    const double ry = 0.5 * (at_y(task.lower[*pair_.y]) - at_y(task.upper[*pair_.y]));
    canvas.save();
    canvas.translate(at_x(task.lower[pair_.x]) + rx, at_y(task.upper[*pair_.y]) + ry);
    canvas.scale(std::max(rx, 1e-3), std::max(ry, 1e-3));
    canvas.begin_new_sub_path();
    canvas.arc(0, 0, 1, 0, 2 * std::numbers::pi);
    canvas.restore();
  }

  /// All turned alike, so that together they fill what any of them covers.
  void triangles(const Canvas& canvas, const core::TaskMesh& mesh) const {
    for (const std::array<int, 3>& triangle : mesh.triangles) {
      std::array<Place, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::array<double, 3>& from = mesh.corners[static_cast<std::size_t>(triangle[i])];
        corners[i] = at({from.begin(), from.end()});
      }
      const auto& [a, b, c] = corners;
      if ((b[0] - a[0]) * (c[1] - a[1]) < (b[1] - a[1]) * (c[0] - a[0])) std::swap(corners[1], corners[2]);
      canvas.move_to(corners[0][0], corners[0][1]);
      for (std::size_t i = 1; i < 3; ++i) canvas.line_to(corners[i][0], corners[i][1]);
      canvas.close_path();
    }
  }

  /// True where it has an inside.
  bool trace(const Canvas& canvas, const Extent& task) const {
    canvas.begin_new_path();
    const auto* path = std::get_if<core::TaskPath>(&result_.task.shape);
    if (path != nullptr && pair_.y) {
      for (const core::RationalPose& point : path->points) {
        const Place place = at(core::rounded(point));
        canvas.line_to(place[0], place[1]);
      }
      return false;
    }
    const auto* mesh = std::get_if<core::TaskMesh>(&result_.task.shape);
    if (mesh != nullptr)
      triangles(canvas, *mesh);
    else if (pair_.y && std::holds_alternative<core::TaskBall>(result_.task.shape))
      ellipse(canvas, task);
    else
      rectangle(canvas, task);
    return true;
  }

  /// With a pen as wide as the margin, which counts otherwise along each coordinate.
  void draw_margin(const Canvas& canvas, const Extent& task, double x, double y) const {
    constexpr double least = 0.25;  // pt
    trace(canvas, task);
    canvas.save();
    canvas.scale(std::max(x / x_.width() * box_.width, least),
                 pair_.y ? std::max(y / y_.width() * box_.height, least) : least);
    canvas.set_line_width(2);
    canvas.set_line_join(LineJoin::round);
    canvas.set_line_cap(LineCap::round);
    set_colour(canvas, faint(colour_of(result_), 0.18));
    canvas.stroke();
    canvas.restore();
  }

  void draw_shape(const Canvas& canvas, const Extent& task) const {
    const double along_x = room_along(result_, pair_.x), along_y = pair_.y ? room_along(result_, *pair_.y) : 0;
    // Margins of lengths and of angles that are apart hold one at a time.
    const bool apart = pair_.y && !result_.task.angle_length && result_.angles[pair_.x] != result_.angles[*pair_.y];
    if (apart) {
      draw_margin(canvas, task, along_x, 0);
      draw_margin(canvas, task, 0, along_y);
    } else if (along_x > 0 || along_y > 0) {
      draw_margin(canvas, task, along_x, along_y);
    }
    if (trace(canvas, task)) {
      set_colour(canvas, faint(colour_of(result_), 0.4));
      canvas.fill_preserve();
    }
    if (std::holds_alternative<core::TaskMesh>(result_.task.shape)) return canvas.begin_new_path();
    set_colour(canvas, colour_of(result_));
    canvas.set_line_width(1.6);
    if (!result_.verified()) canvas.set_dash({5, 4});
    canvas.stroke();
    canvas.set_dash({});
  }

  void draw_open(const Canvas& canvas) const {
    if (!result_.open || result_.open->lower.empty()) return;
    rectangle(canvas, {result_.open->lower, result_.open->upper});
    set_colour(canvas, light_theme.frame, 0.35);
    canvas.fill_preserve();
    canvas.set_line_width(1);
    set_colour(canvas, light_theme.frame);
    canvas.stroke();
  }

  void draw_nearest(const Canvas& canvas, const Pose& pose) const {
    constexpr double r = 4;
    const Place p = at(pose);
    set_colour(canvas, light_theme.ink);
    canvas.set_line_width(1.5);
    if (!pair_.y) {
      canvas.move_to(p[0], box_.y), canvas.line_to(p[0], box_.bottom());
      return canvas.stroke();
    }
    canvas.move_to(p[0] - r, p[1] - r), canvas.line_to(p[0] + r, p[1] + r);
    canvas.move_to(p[0] - r, p[1] + r), canvas.line_to(p[0] + r, p[1] - r);
    canvas.stroke();
  }

  void draw_ring(const Canvas& canvas, const Pose& pose) const {
    const Place p = at(pose);
    for (const double width : {4.0, 1.8}) {  // white below, so that it shows on every colour
      width > 2 ? canvas.set_source_rgb(1, 1, 1) : set_colour(canvas, light_theme.failed);
      canvas.set_line_width(width);
      canvas.begin_new_sub_path();
      canvas.arc(p[0], p[1], 5, 0, 2 * std::numbers::pi);
      canvas.stroke();
    }
  }

  double shown(std::size_t c) const {
    return result_.angles[c] ? 180 / std::numbers::pi : shown_unit("m", result_.units).per_si;
  }
  std::string label(std::size_t c) const {
    return printable(result_.coordinates[c]) +
           (result_.angles[c] ? " (deg)" : " (" + shown_unit("m", result_.units).name + ")");
  }
  std::vector<Tick> marks(std::size_t c, const Range& range, double least) const {
    const double factor = shown(c);
    return result_.angles[c] ? angle_ticks(range.lower * factor, range.upper * factor, least * factor)
                             : ticks(range.lower * factor, range.upper * factor, least * factor);
  }

  void draw_axes(const Canvas& canvas) const {
    constexpr double least_gap = 46, least_gap_up = 24;  // pt between ticks
    set_colour(canvas, light_theme.frame);
    canvas.set_line_width(0.8);
    canvas.rectangle(box_.x, box_.y, box_.width, box_.height);
    canvas.stroke();
    for (const Tick& tick : marks(pair_.x, x_, least_gap / box_.width * x_.width())) {
      const double x = at_x(tick.at / shown(pair_.x));
      canvas.move_to(x, box_.bottom()), canvas.line_to(x, box_.bottom() + 3);
      canvas.stroke();
      write_text(canvas, tick.label, x, box_.bottom() + 12, tick_font, Align::centre);
    }
    write_text(canvas, label(pair_.x), box_.x + 0.5 * box_.width, box_.bottom() + 24, label_font, Align::centre);
    if (!pair_.y) return;
    for (const Tick& tick : marks(*pair_.y, y_, least_gap_up / box_.height * y_.width())) {
      const double y = at_y(tick.at / shown(*pair_.y));
      canvas.move_to(box_.x - 3, y), canvas.line_to(box_.x, y);
      canvas.stroke();
      write_text(canvas, tick.label, box_.x - 5, y + 3, tick_font, Align::right);
    }
    write_text(canvas, label(*pair_.y), box_.x - 4, box_.y - 5, label_font, Align::right);
  }

  const core::Verification& result_;
  Pair pair_;
  Box box_;
  Range x_, y_;
};

/// Coordinates of one kind are drawn to one scale, and what has no extent gets that of the others.
std::vector<Range> ranges_of(const core::Verification& result, const Extent& task) {
  constexpr double bare = 0.1;  ///< m or rad, where nothing has any extent
  std::vector<Range> all;
  std::array<double, 2> widest{};
  for (std::size_t c = 0; c < result.angles.size(); ++c) {
    all.push_back(range_of(result, task, c));
    double& width = widest[result.angles[c] ? 1 : 0];
    width = std::max(width, all.back().width());
  }
  for (std::size_t c = 0; c < all.size(); ++c) {
    constexpr double around = 1.16;
    const double width = widest[result.angles[c] ? 1 : 0];
    const double middle = 0.5 * (all[c].lower + all[c].upper), half = 0.5 * around * (width > 0 ? width : bare);
    all[c] = {middle - half, middle + half};
  }
  return all;
}

bool is_shown(const Pose& at, const std::vector<Range>& ranges) {
  for (std::size_t c = 0; c < at.size(); ++c)
    if (at[c] < ranges[c].lower || at[c] > ranges[c].upper) return false;
  return true;
}

/// The facts of the text, but for the least reactions and notes, each with what it is drawn as.
std::vector<std::string> legend_of(const core::Verification& result, const std::vector<Range>& ranges) {
  std::vector<std::string> lines;
  std::istringstream text(verification_text(result));
  std::string line;
  for (int row = 0; std::getline(text, line); ++row) {
    if (row < 2) continue;  // the head
    const std::string head = line.substr(0, line.find(' '));
    std::string sign;
    if (head == "nearest")
      sign =
          is_shown(result.nearest->at, ranges) ? (ranges.size() == 1 ? "line: " : "cross: ") : "beyond the picture: ";
    if (head == "witness") sign = "ring: ";
    if (head == "open") sign = "grey: ";
    const bool told = head == "VERIFIED" || head == "REFUTED" || head == "UNDECIDED" || head == "moved" ||
                      head == "scaled" || head == "margin" || head == "nearest" || head == "witness" || head == "open";
    if (!told) continue;
    std::string words;
    for (const char letter : line)  // columns of the text are of no use here
      if (letter != ' ' || (!words.empty() && words.back() != ' ')) words += letter;
    lines.push_back(sign + words);
  }
  return lines;
}

}  // namespace

std::string task_panels(const core::Verification& result, PictureFormat format) {
  const Extent task = extent_of(result);
  const std::vector<Range> ranges = ranges_of(result, task);
  const std::vector<Pair> pairs = pairs_of(result.angles);
  const bool one = ranges.size() == 1;
  const double width = one ? strip_width : panel, height = one ? strip : panel;
  const std::size_t columns = std::min(columns_of_panels, pairs.size());
  const std::size_t rows = (pairs.size() + columns - 1) / columns;
  const double left = page_margin + left_room;
  const double across = static_cast<double>(columns) * (width + gap) - gap;
  const double legend_width = std::max(across, least_legend);
  std::string mode;
  for (const auto& [point, side] : result.working_mode) mode += (mode.empty() ? "; " : ", ") + point + " " + side;
  const std::string head_line = fmt::format("Task ({}) with its margin{}{}", core::kind_of(result.task.shape),
                                            one ? "" : ", seen along the other coordinates", printable(mode));
  // Above the panels stand the names of their upright axes.
  const PageHead page = page_head(result.mechanism, head_line, left, legend_width);
  const double head = page.bottom + (one ? 0 : 12), below = head + static_cast<double>(rows) * (height + gap);
  std::vector<std::string> legend;
  std::string description = head_line + "\n";
  for (const std::string& fact : legend_of(result, ranges)) {
    description += fact + "\n";
    for (const std::string& line : wrap(printable(fact), legend_width, measure_in(legend_font))) legend.push_back(line);
  }
  const std::string title = printable(result.mechanism);

  const auto draw = [&](const Canvas& canvas) {
    draw_page_head(canvas, page);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const std::size_t row = k / columns;
      const Box box{left + static_cast<double>(k % columns) * (width + gap),
                    head + static_cast<double>(row) * (height + gap), width, height};
      Panel(result, pairs[k], ranges, box).draw(canvas, task);
    }
    double at = below;
    set_colour(canvas, light_theme.ink);
    for (const std::string& line : legend) {
      write_text(canvas, line, left, at, legend_font);
      at += legend_line_height;
    }
  };
  const double bottom = below + legend_line_height * static_cast<double>(legend.size());
  return render({left + legend_width + page_margin, std::ceil(bottom + page_margin), title, description}, format, draw);
}

}  // namespace clearloci::report
