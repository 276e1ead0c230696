#include "report/surface.hpp"

#include <cairo-pdf.h>
#include <cairomm/surface.h>

#include "report/png.hpp"
#include "report/svg_text.hpp"

namespace clearloci::report {
namespace {

using Draw = std::function<void(const Cairo::RefPtr<Cairo::Context>&)>;

constexpr int pixels_per_point = 2;

Cairo::Surface::SlotWriteFunc append_to(std::string& bytes) {
  return [&bytes](const unsigned char* data, unsigned int length) {
    bytes.append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  };
}

std::string svg(const Page& page, const Draw& draw) {
  std::string bytes;
  const auto surface = Cairo::SvgSurface::create_for_stream(append_to(bytes), page.width, page.height);
  draw(Cairo::Context::create(surface));
  surface->finish();
  return finish_svg(bytes, page.title, page.description);
}

/// The date of creation is a constant: the same drawing gives the same bytes.
std::string pdf(const Page& page, const Draw& draw) {
  std::string bytes;
  const auto surface = Cairo::PdfSurface::create_for_stream(append_to(bytes), page.width, page.height);
  const auto set = [&](cairo_pdf_metadata_t what, const std::string& value) {
    cairo_pdf_surface_set_metadata(surface->cobj(), what, value.c_str());
  };
  set(CAIRO_PDF_METADATA_TITLE, page.title);
  set(CAIRO_PDF_METADATA_CREATOR, "clearloci");
  set(CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  draw(Cairo::Context::create(surface));
  surface->show_page();
  surface->finish();
  return bytes;
}

std::string png(const Page& page, const Draw& draw) {
  const int width = static_cast<int>(page.width) * pixels_per_point;
  const int height = static_cast<int>(page.height) * pixels_per_point;
  const auto surface = Cairo::ImageSurface::create(Cairo::ImageSurface::Format::RGB24, width, height);
  const auto context = Cairo::Context::create(surface);
  context->scale(pixels_per_point, pixels_per_point);
  draw(context);
  surface->flush();
  return encode_png(surface->get_data(), width, height, surface->get_stride(), 72.0 * pixels_per_point);
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
