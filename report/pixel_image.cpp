#include "report/pixel_image.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace clearloci::report {
namespace {

/// Opaque.
std::uint32_t pixel_of(const Colour& colour) {
  const auto channel = [](double value) { return static_cast<std::uint32_t>(std::lround(255 * value)); };
  return 0xFF000000U | channel(colour.red) << 16 | channel(colour.green) << 8 | channel(colour.blue);
}

}  // namespace

PixelImage::PixelImage(const Box& box)
    : box_(box),
      width_(static_cast<int>(std::lround(box.width * pixels_per_point))),
      height_(static_cast<int>(std::lround(box.height * pixels_per_point))),
      image_(width_, height_) {}

void PixelImage::put(int column, int row, const Colour& colour) {
  const std::uint32_t pixel = pixel_of(colour);
  std::memcpy(
      image_.data() + static_cast<std::ptrdiff_t>(row) * image_.stride() + 4 * static_cast<std::ptrdiff_t>(column),
      &pixel, sizeof pixel);
}

void PixelImage::paint(const Canvas& canvas) const {
  canvas.save();
  canvas.translate(box_.x, box_.y);
  canvas.scale(1.0 / pixels_per_point, 1.0 / pixels_per_point);
  canvas.paint(image_, Filter::nearest);
  canvas.restore();
}

}  // namespace clearloci::report
