// Fields as images over a box of the page, of two pixels a point: cell edges stay sharp, and every format shows the
// same. Private to report/.
#pragma once

#include "report/canvas.hpp"

#include "report/axis.hpp"
#include "report/theme.hpp"

namespace clearloci::report {

class PixelImage {
 public:
  static constexpr int pixels_per_point = 2;

  explicit PixelImage(const Box& box);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Rows count from the top. What is not put stays transparent.
  void put(int column, int row, const Colour& colour);
  void paint(const Canvas& canvas) const;

 private:
  Box box_;
  int width_ = 0, height_ = 0;
  Raster image_;
};

}  // namespace clearloci::report
