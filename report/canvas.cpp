#include "report/canvas.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <dlfcn.h>

#include <new>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"

namespace clearloci::report {
namespace {

constexpr const char* library_name = "libcairo.so.2";

/// A function of Cairo, looked up when the library is opened.
template <class Function>
Function* function(void* library, const char* name) {
  void* const found = library == nullptr ? nullptr : dlsym(library, name);
  if (found == nullptr)
    throw core::InputError({}, std::string("pictures need the library ") + library_name + ", which cannot be loaded",
                           "install the Debian package libcairo2, or name with --export files that are no pictures");
  return reinterpret_cast<Function*>(found);
}

/// The functions that are called here, each by its own name without `cairo_`.
struct Library {
  void* const opened = dlopen(library_name, RTLD_NOW | RTLD_LOCAL);
#define CLEARLOCI_CAIRO(name) \
  decltype(::cairo_##name)* const name = function<decltype(::cairo_##name)>(opened, "cairo_" #name)
  CLEARLOCI_CAIRO(arc);
  CLEARLOCI_CAIRO(arc_negative);
  CLEARLOCI_CAIRO(clip);
  CLEARLOCI_CAIRO(close_path);
  CLEARLOCI_CAIRO(create);
  CLEARLOCI_CAIRO(destroy);
  CLEARLOCI_CAIRO(fill);
  CLEARLOCI_CAIRO(fill_preserve);
  CLEARLOCI_CAIRO(font_options_create);
  CLEARLOCI_CAIRO(font_options_destroy);
  CLEARLOCI_CAIRO(font_options_set_antialias);
  CLEARLOCI_CAIRO(font_options_set_hint_metrics);
  CLEARLOCI_CAIRO(font_options_set_hint_style);
  CLEARLOCI_CAIRO(get_source);
  CLEARLOCI_CAIRO(image_surface_create);
  CLEARLOCI_CAIRO(image_surface_get_data);
  CLEARLOCI_CAIRO(image_surface_get_stride);
  CLEARLOCI_CAIRO(line_to);
  CLEARLOCI_CAIRO(move_to);
  CLEARLOCI_CAIRO(new_path);
  CLEARLOCI_CAIRO(new_sub_path);
  CLEARLOCI_CAIRO(paint);
  CLEARLOCI_CAIRO(paint_with_alpha);
  CLEARLOCI_CAIRO(pattern_set_filter);
  CLEARLOCI_CAIRO(pdf_surface_create_for_stream);
  CLEARLOCI_CAIRO(pdf_surface_set_metadata);
  CLEARLOCI_CAIRO(pop_group_to_source);
  CLEARLOCI_CAIRO(push_group);
  CLEARLOCI_CAIRO(rectangle);
  CLEARLOCI_CAIRO(restore);
  CLEARLOCI_CAIRO(rotate);
  CLEARLOCI_CAIRO(save);
  CLEARLOCI_CAIRO(scale);
  CLEARLOCI_CAIRO(select_font_face);
  CLEARLOCI_CAIRO(set_antialias);
  CLEARLOCI_CAIRO(set_dash);
  CLEARLOCI_CAIRO(set_fill_rule);
  CLEARLOCI_CAIRO(set_font_options);
  CLEARLOCI_CAIRO(set_font_size);
  CLEARLOCI_CAIRO(set_line_cap);
  CLEARLOCI_CAIRO(set_line_join);
  CLEARLOCI_CAIRO(set_line_width);
  CLEARLOCI_CAIRO(set_source_rgb);
  CLEARLOCI_CAIRO(set_source_rgba);
  CLEARLOCI_CAIRO(set_source_surface);
  CLEARLOCI_CAIRO(show_page);
  CLEARLOCI_CAIRO(show_text);
  CLEARLOCI_CAIRO(status);
  CLEARLOCI_CAIRO(status_to_string);
  CLEARLOCI_CAIRO(stroke);
  CLEARLOCI_CAIRO(surface_destroy);
  CLEARLOCI_CAIRO(surface_finish);
  CLEARLOCI_CAIRO(surface_flush);
  CLEARLOCI_CAIRO(surface_mark_dirty);
  CLEARLOCI_CAIRO(surface_status);
  CLEARLOCI_CAIRO(svg_surface_create_for_stream);
  CLEARLOCI_CAIRO(text_extents);
  CLEARLOCI_CAIRO(text_path);
  CLEARLOCI_CAIRO(translate);
#undef CLEARLOCI_CAIRO
};

const Library& cairo() {
  static const Library library;
  return library;
}

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo().status_to_string(status));
}

std::shared_ptr<void> owned(cairo_surface_t* surface) {
  std::shared_ptr<void> owner(surface, [](cairo_surface_t* raw_surface) { cairo().surface_destroy(raw_surface); });
  check(cairo().surface_status(surface));
  return owner;
}

cairo_surface_t* surface_of(const std::shared_ptr<void>& owner) { return static_cast<cairo_surface_t*>(owner.get()); }
cairo_t* pen(const std::shared_ptr<void>& owner) { return static_cast<cairo_t*>(owner.get()); }

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  try {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
}

}  // namespace

Raster::Raster(int width, int height, bool transparent)
    : surface_(
          owned(cairo().image_surface_create(transparent ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24, width, height))) {}

unsigned char* Raster::data() { return cairo().image_surface_get_data(surface_of(surface_)); }
const unsigned char* Raster::data() const { return cairo().image_surface_get_data(surface_of(surface_)); }
int Raster::stride() const { return cairo().image_surface_get_stride(surface_of(surface_)); }

Canvas::Canvas(std::shared_ptr<void> surface)
    : surface_(std::move(surface)),
      context_(cairo().create(surface_of(surface_)), [](cairo_t* context) { cairo().destroy(context); }) {}

Canvas Canvas::on(const Raster& raster) { return Canvas(raster.surface_); }

Canvas Canvas::svg(std::string& bytes, double width, double height) {
  return Canvas(owned(cairo().svg_surface_create_for_stream(append, &bytes, width, height)));
}

/// The date of creation is a constant: the same drawing gives the same bytes.
Canvas Canvas::pdf(std::string& bytes, double width, double height, const std::string& title) {
  cairo_surface_t* const surface = cairo().pdf_surface_create_for_stream(append, &bytes, width, height);
  Canvas canvas(owned(surface));
  cairo().pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, title.c_str());
  cairo().pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, "clearloci");
  cairo().pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  return canvas;
}

void Canvas::show_page() const { cairo().show_page(pen(context_)); }

void Canvas::flush() const {
  cairo().surface_flush(surface_of(surface_));
  check(cairo().status(pen(context_)));
}

void Canvas::finish() const {
  check(cairo().status(pen(context_)));
  cairo().surface_finish(surface_of(surface_));
  check(cairo().surface_status(surface_of(surface_)));
}

void Canvas::save() const { cairo().save(pen(context_)); }
void Canvas::restore() const { cairo().restore(pen(context_)); }
void Canvas::translate(double x, double y) const { cairo().translate(pen(context_), x, y); }
void Canvas::scale(double x, double y) const { cairo().scale(pen(context_), x, y); }
void Canvas::rotate(double radians) const { cairo().rotate(pen(context_), radians); }

void Canvas::begin_new_path() const { cairo().new_path(pen(context_)); }
void Canvas::begin_new_sub_path() const { cairo().new_sub_path(pen(context_)); }
void Canvas::move_to(double x, double y) const { cairo().move_to(pen(context_), x, y); }
void Canvas::line_to(double x, double y) const { cairo().line_to(pen(context_), x, y); }
void Canvas::close_path() const { cairo().close_path(pen(context_)); }
void Canvas::rectangle(double x, double y, double width, double height) const {
  cairo().rectangle(pen(context_), x, y, width, height);
}
void Canvas::arc(double x, double y, double radius, double from, double to) const {
  cairo().arc(pen(context_), x, y, radius, from, to);
}
void Canvas::arc_negative(double x, double y, double radius, double from, double to) const {
  cairo().arc_negative(pen(context_), x, y, radius, from, to);
}

void Canvas::set_source_rgb(double red, double green, double blue) const {
  cairo().set_source_rgb(pen(context_), red, green, blue);
}
void Canvas::set_source_rgba(double red, double green, double blue, double opacity) const {
  cairo().set_source_rgba(pen(context_), red, green, blue, opacity);
}
void Canvas::set_line_width(double width) const { cairo().set_line_width(pen(context_), width); }
void Canvas::set_line_cap(LineCap cap) const {
  cairo().set_line_cap(pen(context_), cap == LineCap::round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
}
void Canvas::set_line_join(LineJoin join) const {
  cairo().set_line_join(pen(context_), join == LineJoin::round ? CAIRO_LINE_JOIN_ROUND : CAIRO_LINE_JOIN_MITER);
}
void Canvas::set_fill_rule(FillRule rule) const {
  cairo().set_fill_rule(pen(context_), rule == FillRule::even_odd ? CAIRO_FILL_RULE_EVEN_ODD : CAIRO_FILL_RULE_WINDING);
}
void Canvas::set_dash(const std::vector<double>& lengths) const {
  cairo().set_dash(pen(context_), lengths.data(), static_cast<int>(lengths.size()), 0);
}
void Canvas::set_sharp_edges() const { cairo().set_antialias(pen(context_), CAIRO_ANTIALIAS_NONE); }

void Canvas::stroke() const { cairo().stroke(pen(context_)); }
void Canvas::fill() const { cairo().fill(pen(context_)); }
void Canvas::fill_preserve() const { cairo().fill_preserve(pen(context_)); }
void Canvas::clip() const { cairo().clip(pen(context_)); }
void Canvas::paint() const { cairo().paint(pen(context_)); }
void Canvas::paint(const Raster& raster, Filter filter) const {
  cairo().surface_mark_dirty(surface_of(raster.surface_));
  cairo().set_source_surface(pen(context_), surface_of(raster.surface_), 0, 0);
  cairo().pattern_set_filter(cairo().get_source(pen(context_)),
                             filter == Filter::nearest ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
  paint();
}
void Canvas::push_group() const { cairo().push_group(pen(context_)); }
void Canvas::paint_group(double opacity) const {
  cairo().pop_group_to_source(pen(context_));
  cairo().paint_with_alpha(pen(context_), opacity);
}

void Canvas::set_font(double size, bool bold, bool italic) const {
  cairo_font_options_t* const options = cairo().font_options_create();
  cairo().font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo().font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo().font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo().set_font_options(pen(context_), options);
  cairo().font_options_destroy(options);
  cairo().select_font_face(pen(context_), "sans-serif", italic ? CAIRO_FONT_SLANT_ITALIC : CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo().set_font_size(pen(context_), size);
}
double Canvas::text_advance(const std::string& text) const {
  cairo_text_extents_t extents;
  cairo().text_extents(pen(context_), text.c_str(), &extents);
  return extents.x_advance;
}
void Canvas::show_text(const std::string& text) const { cairo().show_text(pen(context_), text.c_str()); }
void Canvas::text_path(const std::string& text) const { cairo().text_path(pen(context_), text.c_str()); }

}  // namespace clearloci::report
