#include "report/surface.hpp"

#include "report/png.hpp"
#include "report/svg_text.hpp"

namespace clearloci::report {
namespace {

using Draw = std::function<void(const Canvas&)>;

constexpr int pixels_per_point = 2;

std::string svg(const Page& page, const Draw& draw) {
  std::string bytes;
  const Canvas canvas = Canvas::svg(bytes, page.width, page.height);
  draw(canvas);
  canvas.finish();
  return finish_svg(bytes, page.title, page.description);
}

std::string pdf(const Page& page, const Draw& draw) {
  std::string bytes;
  const Canvas canvas = Canvas::pdf(bytes, page.width, page.height, page.title);
  draw(canvas);
  canvas.show_page();
  canvas.finish();
  return bytes;
}

std::string png(const Page& page, const Draw& draw) {
  const int width = static_cast<int>(page.width) * pixels_per_point;
  const int height = static_cast<int>(page.height) * pixels_per_point;
  const Raster raster = Raster::opaque(width, height);
  const Canvas canvas = Canvas::on(raster);
  canvas.scale(pixels_per_point, pixels_per_point);
  draw(canvas);
  canvas.flush();
  return encode_png(raster.data(), width, height, raster.stride(), 72.0 * pixels_per_point);
}

}  // namespace

std::string render(const Page& page, PictureFormat format, const Draw& draw) {
  switch (format) {
    case PictureFormat::svg:
      return svg(page, draw);
    case PictureFormat::pdf:
      return pdf(page, draw);
    default:
      return png(page, draw);
  }
}

}  // namespace clearloci::report
