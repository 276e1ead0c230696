// Where everything of a picture stands, decided before anything is drawn. Lengths in points (1/72 inch), y down.
// Private to report/.
#pragma once

#include <string>
#include <vector>

#include "clearloci/zones.hpp"
#include "core/locus_map.hpp"
#include "core/sketch.hpp"
#include "report/axis.hpp"
#include "report/field_scale.hpp"
#include "report/groups.hpp"
#include "report/page_head.hpp"
#include "report/task_mark.hpp"
#include "report/typesetting.hpp"

namespace clearloci::report {

/// What a legend entry shows a sample of.
enum class SampleKind {
  curve,
  point,
  workspace,
  searched_box,
  open_place,
  mechanism,
  load,
  remark,
  colour_bar,
  inset,
  zones,
  task,
  task_point
};

struct LegendLine {
  std::string text;
  bool secondary = false;  ///< the reason: in grey
};

struct LegendEntry {
  SampleKind sample = SampleKind::curve;
  Stroke stroke;                  ///< of a curve
  Marker marker;                  ///< of a point
  std::vector<LegendLine> lines;  ///< the label, wrapped
  Box box;                        ///< sample and label
};

/// One picture: the loci of one working mode. Axes of lengths have one scale, y points up.
struct Layout {
  double width = 0, height = 0;
  Box plot;
  core::Point2 low{}, high{};                ///< what the plot shows: of an angle (LocusMap::angles) rad, else m
  core::Point2 search_low{}, search_high{};  ///< the box that was searched, likewise
  core::Point2 scale = {1, 1};               ///< pt/m, pt/rad
  std::vector<Tick> x_ticks, y_ticks;
  std::string x_label, y_label;
  double y_label_x = 0;  ///< baseline of the upright y label
  PageHead head;
  std::vector<LegendEntry> legend;

  core::Point2 page(const core::Point2& point) const {
    return {plot.x + (point[0] - low[0]) * scale[0], plot.bottom() - (point[1] - low[1]) * scale[1]};
  }
};

/// What a picture shows. The pointers outlive it; `sketch`, `layer` and `zones` may be null.
struct Subject {
  const core::LocusMap* map = nullptr;
  core::WorkingMode mode;
  Groups groups;  ///< of this mode
  const core::Sketch* sketch = nullptr;
  const FieldLayer* layer = nullptr;    ///< drawn in the place of the shaded workspace
  const core::Zones* zones = nullptr;   ///< likewise
  const TaskMark* task = nullptr;       ///< may be null too
  const core::Sketch* inset = nullptr;  ///< likewise: the mechanism in a space of its own, below the legend
};

Layout lay_out(const Subject& subject);

/// Whether a sample stands below its label, and not in front of it.
inline bool stands_below(SampleKind sample) { return sample == SampleKind::colour_bar || sample == SampleKind::inset; }

/// What stands above a mechanism that is drawn beside the loci.
inline constexpr const char* sample_posture_words = "mechanism in a sample posture";

/// Of a mechanism alone, all of it with its loads inside a box.
Layout lay_out_alone(const core::Sketch& sketch, const Box& box);

inline constexpr double legend_sample_width = 32;  ///< pt
inline constexpr double legend_sample_gap = 8;     ///< pt, between a sample and its label

}  // namespace clearloci::report
