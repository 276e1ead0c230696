// The texts beside a mechanism that is drawn, each where it covers the least: names of joints, of the end effector and
// of links, sizes of forces and couples. Private to report/.
#pragma once

#include <string>
#include <vector>

#include "report/canvas.hpp"
#include "report/label_places.hpp"
#include "report/layout.hpp"

namespace clearloci::report {

constexpr double bar_width = 8;       ///< pt, of links
constexpr double pin_radius = 3.4;    ///< pt
constexpr double couple_radius = 15;  ///< pt, of the turning arrow of a couple

/// Of a force on the page.
struct Arrow {
  core::Point2 tail{}, tip{};
  bool ends_at_point = false;  ///< its tip is at the point of application
};

/// What labels had better leave in sight: pins and brackets, arrows, and less so bars.
void keep_free(const Layout& layout, const core::Sketch& sketch, const std::vector<Arrow>& arrows, LabelPlaces& labels);

/// `arrows`: of the sketch's forces that are not zero, in their order. Links are named that `words` speak of. A cross
/// on a ring marks the end effector's point where no joint is.
void write_labels(const Canvas& canvas, const Layout& layout, const core::Sketch& sketch,
                  const std::vector<Arrow>& arrows, const std::string& words, LabelPlaces& labels);

}  // namespace clearloci::report
