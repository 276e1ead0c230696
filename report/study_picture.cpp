#include <algorithm>
#include <cmath>

#include "report/axis.hpp"
#include "report/mechanism_drawing.hpp"
#include "report/page_head.hpp"
#include "report/study.hpp"
#include "report/study_words.hpp"
#include "report/surface.hpp"
#include "report/typesetting.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::StudyDesign;
using core::StudyResult;
using Status = StudyDesign::Status;

constexpr Colour ink{0.13, 0.13, 0.13}, frame_colour{0.45, 0.45, 0.45}, plain{0.0, 0.5, 0.35};
constexpr double legend_width = 170, gap = 16;
/// Neighbours share their edges: softened, they would let the paper through.
constexpr double overlap = 0.35;
/// Feasible designs have the strong colours; reasons take pale ones in turn.
constexpr std::size_t most_reasons = 8;

Colour reason_colour(std::size_t number) {
  const Colour full = palette_colour(static_cast<int>(number));
  constexpr double pale = 0.62;
  const auto mix = [](double c) { return pale + (1 - pale) * c; };
  return {mix(full.red), mix(full.green), mix(full.blue)};
}

/// The power of a thousand that numbers of an axis are shown in: 1 where they are of a usual size.
double unit_of_axis(const std::array<double, 2>& range) {
  const double most = std::max(std::abs(range[0]), std::abs(range[1]));
  if (!(most > 0) || (most >= 0.01 && most < 1e5)) return 1;
  return std::pow(10.0, 3 * std::floor(std::log10(most) / 3));
}

std::string words_of_unit(double unit) { return unit == 1 ? "" : ", " + short_number(unit, 2); }

class StudyDrawing {
 public:
  explicit StudyDrawing(const StudyResult& result) : result_(result) {
    for (const auto& [reason, many] : study_reasons(result)) reasons_.push_back(reason);
    for (const core::StudyCell& cell : result.cells)
      if (!cell.reason.empty() && std::find(reasons_.begin(), reasons_.end(), cell.reason) == reasons_.end())
        reasons_.push_back(cell.reason);
    if (!result.figures.empty()) {
      std::vector<double> values;
      for (const StudyDesign& design : result.designs)
        if (design.status == Status::feasible) values.push_back(design.figures.front());
      scale_ = scale_of(values, false, unit());
    }
    for (std::size_t i = 0; i < result.designs.size(); ++i) order_.push_back(i);
    // What is feasible is drawn last, the best on top.
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    const std::size_t n = result.parameters.size();
    panels_ = n < 2 ? 1 : n - 1;
    side_ = panels_ == 1 ? 380 : std::max(110.0, 520.0 / static_cast<double>(panels_));
    if (n == 1 && result.figures.empty()) height_ = 90;
    if (n == 1 && !result.figures.empty()) {
      top_ = 0;
      for (const StudyDesign& design : result.designs)
        if (design.status == Status::feasible && design.figures.front() > top_) top_ = design.figures.front();
      top_ *= 1.06;  // room for the mark of the best
    }
    head_ = page_head(title(), subtitle(), page_margin + 60, plots() + gap + legend_width);
  }

  Page page() const {
    const double down = panels_ == 1 ? height() : plots();
    std::string description = "Designs of a study";
    for (const std::string& reason : reasons_) description += "\n" + printable(reason);
    return {page_margin + 60 + plots() + gap + legend_width + page_margin, head_.bottom + std::max(down, 150.0) + 46,
            title(), description};
  }

  void draw(const Canvas& canvas) const {
    const Page layout = page();
    draw_page_head(canvas, head_);
    const std::size_t n = result_.parameters.size();
    for (std::size_t row = 0; row < panels_; ++row)
      for (std::size_t column = 0; column <= (n < 2 ? 0 : row); ++column)
        draw_panel(canvas, column, n < 2 ? std::optional<std::size_t>() : row + 1, row, column);
    draw_legend(canvas, layout.width - page_margin - legend_width, head_.bottom);
  }

 private:
  double plots() const { return static_cast<double>(panels_) * (side_ + (panels_ > 1 ? 8 : 0)); }
  std::string title() const { return printable(result_.mechanism); }
  std::string subtitle() const {
    if (!result_.cells.empty())
      return std::to_string(result_.cells.size()) + " cells of designs, each proven or undecided";
    const auto feasible = std::count_if(result_.designs.begin(), result_.designs.end(),
                                        [](const StudyDesign& d) { return d.status == Status::feasible; });
    return std::to_string(feasible) + " of " + std::to_string(result_.designs.size()) + " designs feasible";
  }
  std::string unit() const {
    using core::Figure;
    switch (result_.figures.front()) {
      case Figure::min_force:
        return "N";
      case Figure::effort:
        return "N m";
      case Figure::zone_area:
        return "m^2";
      default:
        return "m";
    }
  }

  double rank(std::size_t i) const {
    const StudyDesign& design = result_.designs[i];
    if (design.status == Status::left_out) return -3;
    if (design.status == Status::infeasible) return -2;
    if (design.status == Status::undecided) return -1;
    if (result_.figures.empty() || std::isnan(design.figures.front())) return 0;
    const bool less = !result_.study.goals.empty() && !result_.study.goals.front().maximise;
    return less ? 1 / (1 + design.figures.front()) : 1 + design.figures.front();
  }

  Colour colour(const StudyDesign& design) const {
    if (design.status == Status::feasible) {
      if (result_.figures.empty() || std::isnan(design.figures.front())) return plain;
      return scale_.colour(design.figures.front());
    }
    if (design.status == Status::undecided) return {0.25, 0.25, 0.25};
    const auto place = std::find(reasons_.begin(), reasons_.end(), design.reason) - reasons_.begin();
    const auto number = static_cast<std::size_t>(place);
    return number < most_reasons ? reason_colour(number) : Colour{0.85, 0.85, 0.85};
  }

  void draw_panel(const Canvas& canvas, std::size_t x, std::optional<std::size_t> y, std::size_t row,
                  std::size_t column) const {
    const double step = side_ + (panels_ > 1 ? 8 : 0);
    const Box box{page_margin + 60 + static_cast<double>(column) * step, head_.bottom + static_cast<double>(row) * step,
                  side_, height()};
    const auto range = [&](std::size_t p) {
      const core::StudyParameter& parameter = result_.study.vary[p];
      return std::array{core::to_double(parameter.lower), core::to_double(parameter.upper)};
    };
    const std::array<double, 2> across = range(x), up = y ? range(*y) : std::array{0.0, top_};
    const auto [wide, high] = mark_size(x, y, box);
    const Marks marks{box, across, up, wide, high};
    canvas.save();
    canvas.rectangle(box.x, box.y, box.width, box.height);
    canvas.clip();
    for (const core::StudyCell& cell : result_.cells) draw_cell(canvas, cell, box, across, up, x, y);
    for (const std::size_t i : order_) draw_design(canvas, marks, result_.designs[i], x, y);
    if (result_.tolerances) draw_tolerances(canvas, *result_.tolerances, box, across, up, x, y);
    if (result_.best) {
      const StudyDesign& design = result_.designs[*result_.best];
      set_colour(canvas, {0.85, 0.1, 0.1});
      canvas.set_line_width(1.4);
      canvas.arc(marks.x(design.values[x]), y ? marks.y(design.values[*y]) : marks.y(figure(design)), 5, 0,
                 6.28318530717958648);
      canvas.stroke();
    }
    canvas.restore();
    set_colour(canvas, frame_colour);
    canvas.set_line_width(0.8);
    canvas.rectangle(box.x, box.y, box.width, box.height);
    canvas.stroke();
    draw_axes(canvas, box, across, up, x, y, row + 1 == panels_, column == 0);
  }

  /// Where designs lie in a panel, each with room for its mark.
  struct Marks {
    const Box& box;
    std::array<double, 2> across, up;
    double wide = 0, high = 0;
    double x(double value) const {
      return box.x + wide / 2 + (value - across[0]) / (across[1] - across[0]) * (box.width - wide);
    }
    double y(double value) const {
      return box.bottom() - high / 2 - (value - up[0]) / (up[1] - up[0]) * (box.height - high);
    }
  };

  double figure(const StudyDesign& design) const { return result_.figures.empty() ? top_ / 2 : design.figures.front(); }
  double height() const { return height_ > 0 ? height_ : side_; }

  /// Over one parameter the first figure goes up, and designs without it are bands.
  void draw_design(const Canvas& canvas, const Marks& marks, const StudyDesign& design, std::size_t x,
                   std::optional<std::size_t> y) const {
    set_colour(canvas, colour(design));
    const double left = marks.x(design.values[x]) - marks.wide / 2;
    if (y)
      canvas.rectangle(left, marks.y(design.values[*y]) - marks.high / 2 - overlap, marks.wide + overlap,
                       marks.high + overlap);
    else if (design.status != Status::feasible || result_.figures.empty() || std::isnan(figure(design)))
      canvas.rectangle(left, marks.box.y, marks.wide + overlap, marks.box.height);
    else
      canvas.rectangle(left, marks.y(figure(design)), marks.wide + overlap,
                       marks.box.bottom() - marks.y(figure(design)));
    canvas.fill();
  }

  /// The box that is proven around the file's design.
  static void draw_tolerances(const Canvas& canvas, const core::StudyCell& cell, const Box& box,
                              const std::array<double, 2>& across, const std::array<double, 2>& up, std::size_t x,
                              std::optional<std::size_t> y) {
    const auto at = [](double value, const std::array<double, 2>& range, double from, double length) {
      return from + (value - range[0]) / (range[1] - range[0]) * length;
    };
    const double left = at(cell.lower[x], across, box.x, box.width),
                 right = at(cell.upper[x], across, box.x, box.width);
    const double top = y ? at(cell.upper[*y], up, box.bottom(), -box.height) : box.y;
    const double bottom = y ? at(cell.lower[*y], up, box.bottom(), -box.height) : box.bottom();
    set_colour(canvas, {0.85, 0.1, 0.1});
    canvas.set_line_width(1.6);
    canvas.rectangle(left + 0.8, top + 0.8, right - left - 1.6, bottom - top - 1.6);
    canvas.stroke();
  }

  /// Of a proof over more than two parameters cells lie over one another: what verifies shows through.
  void draw_cell(const Canvas& canvas, const core::StudyCell& cell, const Box& box, const std::array<double, 2>& across,
                 const std::array<double, 2>& up, std::size_t x, std::optional<std::size_t> y) const {
    const auto part = [](double value, const std::array<double, 2>& range) {
      return (value - range[0]) / (range[1] - range[0]);
    };
    const double left = box.x + box.width * part(cell.lower[x], across);
    const double right = box.x + box.width * part(cell.upper[x], across);
    const double top = y ? box.bottom() - box.height * part(cell.upper[*y], up) : box.y;
    const double bottom = y ? box.bottom() - box.height * part(cell.lower[*y], up) : box.bottom();
    StudyDesign like;
    like.status = cell.status;
    like.reason = cell.reason;
    set_colour(canvas, colour(like), result_.parameters.size() > 2 ? 0.25 : 1);
    const double more = result_.parameters.size() > 2 ? 0 : overlap;
    canvas.rectangle(left, top - more, right - left + more, bottom - top + more);
    canvas.fill();
  }

  /// On a grid designs are cells; else they are dots that leave room for one another.
  std::array<double, 2> mark_size(std::size_t x, std::optional<std::size_t> y, const Box& box) const {
    const core::StudyMethod& method = result_.study.method;
    if (method.kind == core::StudyMethod::Kind::grid && method.counts.size() <= 2 && (!y || method.counts.size() == 2))
      return {box.width / method.counts[x], y ? box.height / method.counts[*y] : 0.0};
    const auto many = static_cast<double>(std::max<std::size_t>(1, result_.designs.size()));
    if (!y) return {std::clamp(2 * box.width / many, 1.5, 12.0), 0.0};
    const double share = std::clamp(box.width / std::sqrt(many), 1.5, 6.0);
    return {share, share};
  }

  void draw_axes(const Canvas& canvas, const Box& box, const std::array<double, 2>& across,
                 const std::array<double, 2>& up, std::size_t x, std::optional<std::size_t> y, bool below,
                 bool beside) const {
    set_colour(canvas, ink);
    if (below) {
      const double unit = unit_of_axis(across);
      const double low = across[0] / unit, high = across[1] / unit;
      for (const Tick& tick : ticks(low, high, 52 / box.width * (high - low)))
        write_text(canvas, tick.label, box.x + (tick.at - low) / (high - low) * box.width, box.bottom() + 13, tick_font,
                   Align::centre);
      write_text(canvas, result_.parameters[x] + words_of_unit(unit), box.x + box.width / 2, box.bottom() + 28,
                 label_font, Align::centre);
    }
    if (!beside || (!y && result_.figures.empty())) return;
    const double unit = unit_of_axis(up), low = up[0] / unit, high = up[1] / unit;
    for (const Tick& tick : ticks(low, high, 30 / box.height * (high - low)))
      write_text(canvas, tick.label, box.x - 5, box.bottom() - (tick.at - low) / (high - low) * box.height + 3,
                 tick_font, Align::right);
    canvas.save();
    canvas.translate(page_margin + 12, box.y + box.height / 2);
    canvas.rotate(-1.57079632679489662);
    write_text(canvas,
               y ? result_.parameters[*y] + words_of_unit(unit)
                 : core::to_string(result_.figures.front()) + " (" + scale_.unit + ")" + words_of_unit(unit),
               0, 0, y ? label_font : legend_font, Align::centre);
    canvas.restore();
  }

  void draw_legend(const Canvas& canvas, double x, double y) const {
    const Measure measure = measure_in(legend_font);
    const auto entry = [&](const Colour& colour, const std::string& words) {
      set_colour(canvas, colour);
      canvas.rectangle(x, y + 1, 10, 10);
      canvas.fill();
      set_colour(canvas, ink);
      for (const std::string& piece : wrap(printable(words), legend_width - 16, measure)) {
        write_text(canvas, piece, x + 16, y + 9.5, legend_font);
        y += 11.5;
      }
      y += 2;
    };
    set_colour(canvas, ink);
    if (!result_.figures.empty()) {
      write_text(canvas, "feasible: " + core::to_string(result_.figures.front()) + " (" + scale_.unit + ")", x, y + 9,
                 legend_font);
      y += 14;
      draw_colour_bar(canvas, scale_, {x, y, legend_width, colour_bar_room});
      y += colour_bar_room + 8;
    } else {
      entry(plain, "feasible");
    }
    if (std::any_of(result_.cells.begin(), result_.cells.end(),
                    [](const core::StudyCell& c) { return c.status == Status::undecided; }))
      entry({0.25, 0.25, 0.25}, "undecided");
    if (result_.tolerances) {
      set_colour(canvas, {0.85, 0.1, 0.1});
      canvas.set_line_width(1.4);
      canvas.rectangle(x + 0.7, y + 1.7, 8.6, 8.6);
      canvas.stroke();
      set_colour(canvas, ink);
      for (const std::string& piece : wrap("proven around the file's design", legend_width - 16, measure)) {
        write_text(canvas, piece, x + 16, y + 9.5, legend_font);
        y += 11.5;
      }
      y += 2;
    }
    for (std::size_t i = 0; i < std::min(reasons_.size(), most_reasons); ++i) entry(reason_colour(i), reasons_[i]);
    if (reasons_.size() > most_reasons) entry({0.85, 0.85, 0.85}, "other reasons");
    if (result_.best) {
      set_colour(canvas, {0.85, 0.1, 0.1});
      canvas.set_line_width(1.4);
      canvas.arc(x + 5, y + 6, 4.5, 0, 6.28318530717958648);
      canvas.stroke();
      set_colour(canvas, ink);
      write_text(canvas, "best", x + 16, y + 9.5, legend_font);
    }
  }

  const StudyResult& result_;
  std::vector<std::string> reasons_;
  std::vector<std::size_t> order_;
  FieldScale scale_;
  PageHead head_;
  std::size_t panels_ = 1;
  double side_ = 380;
  double height_ = 0;  ///< of the only panel, where it is not a square
  double top_ = 1;     ///< of the first figure, over one parameter
};

}  // namespace

std::string study_picture(const StudyResult& result, PictureFormat format) {
  const StudyDrawing drawing(result);
  return render(drawing.page(), format, [&](const Canvas& canvas) { drawing.draw(canvas); });
}

}  // namespace clearloci::report
