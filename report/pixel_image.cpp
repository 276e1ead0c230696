#include "report/pixel_image.hpp"

#include <cairomm/pattern.h>

#include <cmath>
#include <cstdint>
#include <cstring>

namespace clearloci::report {
namespace {

/// Opaque, as Cairo's ARGB32 wants it.
std::uint32_t pixel_of(const Colour& colour) {
  const auto channel = [](double value) { return static_cast<std::uint32_t>(std::lround(255 * value)); };
  return 0xFF000000U | channel(colour.red) << 16 | channel(colour.green) << 8 | channel(colour.blue);
}

}  // namespace

PixelImage::PixelImage(const Box& box)
    : box_(box),
      width_(static_cast<int>(std::lround(box.width * pixels_per_point))),
      height_(static_cast<int>(std::lround(box.height * pixels_per_point))),
      image_(Cairo::ImageSurface::create(Cairo::ImageSurface::Format::ARGB32, width_, height_)) {}

void PixelImage::put(int column, int row, const Colour& colour) {
  const std::uint32_t pixel = pixel_of(colour);
  std::memcpy(image_->get_data() + static_cast<std::ptrdiff_t>(row) * image_->get_stride() +
                  4 * static_cast<std::ptrdiff_t>(column),
              &pixel, sizeof pixel);
}

void PixelImage::paint(const Cairo::RefPtr<Cairo::Context>& context) const {
  image_->mark_dirty();
  context->save();
  context->translate(box_.x, box_.y);
  context->scale(1.0 / pixels_per_point, 1.0 / pixels_per_point);
  const auto pattern = Cairo::SurfacePattern::create(image_);
  pattern->set_filter(Cairo::SurfacePattern::Filter::NEAREST);
  context->set_source(pattern);
  context->paint();
  context->restore();
}

}  // namespace clearloci::report
