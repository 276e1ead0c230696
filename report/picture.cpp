#include "report/picture.hpp"

#include <cairo-pdf.h>
#include <cairomm/context.h>
#include <cairomm/surface.h>

#include <cmath>

#include "report/drawing.hpp"
#include "report/png.hpp"
#include "report/svg_text.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

constexpr int pixels_per_point = 2;

Cairo::Surface::SlotWriteFunc append_to(std::string& bytes) {
  return [&bytes](const unsigned char* data, unsigned int length) {
    bytes.append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  };
}

std::string title_of(const Subject& subject) {
  const std::string mode = mode_words(subject.map->tower, subject.mode);
  const std::string what =
      subject.layer == nullptr ? "Discontinuity loci" : "Pose error, " + subject.layer->field->label;
  return printable(what + ": " + subject.map->mechanism + (mode.empty() ? "" : ", " + mode));
}

std::string legend_of(const Groups& groups) {
  std::string text;
  for (const auto& group : groups.curves) text += group.what + (group.why.empty() ? "" : " — " + group.why) + "\n";
  for (const auto& group : groups.points) text += group.label + "\n";
  return text;
}

std::string svg(const Subject& subject, const Layout& layout) {
  std::string bytes;
  const auto surface = Cairo::SvgSurface::create_for_stream(append_to(bytes), layout.width, layout.height);
  draw(Cairo::Context::create(surface), subject, layout);
  surface->finish();
  return finish_svg(bytes, title_of(subject), legend_of(subject.groups));
}

/// The date of creation is a constant: the same map gives the same bytes.
std::string pdf(const Subject& subject, const Layout& layout) {
  std::string bytes;
  const auto surface = Cairo::PdfSurface::create_for_stream(append_to(bytes), layout.width, layout.height);
  const auto set = [&](cairo_pdf_metadata_t what, const std::string& value) {
    cairo_pdf_surface_set_metadata(surface->cobj(), what, value.c_str());
  };
  set(CAIRO_PDF_METADATA_TITLE, title_of(subject));
  set(CAIRO_PDF_METADATA_CREATOR, "clearloci");
  set(CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  draw(Cairo::Context::create(surface), subject, layout);
  surface->show_page();
  surface->finish();
  return bytes;
}

std::string png(const Subject& subject, const Layout& layout) {
  const int width = static_cast<int>(layout.width) * pixels_per_point;
  const int height = static_cast<int>(layout.height) * pixels_per_point;
  const auto surface = Cairo::ImageSurface::create(Cairo::ImageSurface::Format::RGB24, width, height);
  const auto context = Cairo::Context::create(surface);
  context->scale(pixels_per_point, pixels_per_point);
  draw(context, subject, layout);
  surface->flush();
  return encode_png(surface->get_data(), width, height, surface->get_stride(), 72.0 * pixels_per_point);
}

std::string drawn(const Subject& subject, PictureFormat format) {
  const Layout layout = lay_out(subject);
  switch (format) {
    case PictureFormat::svg:
      return svg(subject, layout);
    case PictureFormat::pdf:
      return pdf(subject, layout);
    default:
      return png(subject, layout);
  }
}

}  // namespace

std::string picture(const core::LocusMap& map, const core::WorkingMode& mode, const core::Sketch* sketch,
                    PictureFormat format) {
  return drawn({&map, mode, groups_of_mode(group_loci(map), mode), sketch, nullptr, nullptr}, format);
}

std::string field_picture(const core::LocusMap& map, const core::WorkingMode& mode, const core::FieldMap& fields,
                          const core::Field& field, PictureFormat format) {
  const FieldLayer layer{&fields, &field, scale_of(field.values, field.is_signed, field.unit)};
  return drawn({&map, mode, groups_of_mode(group_loci(map), mode), nullptr, &layer, nullptr}, format);
}

std::string zone_picture(const core::ZoneMap& map, const core::WorkingMode& mode, PictureFormat format) {
  return drawn({&map.loci, mode, groups_of_mode(group_loci(map.loci), mode), nullptr, nullptr, &map}, format);
}

std::string legend_text(const core::LocusMap& map, const core::WorkingMode& mode) {
  return legend_of(groups_of_mode(group_loci(map), mode));
}

}  // namespace clearloci::report
