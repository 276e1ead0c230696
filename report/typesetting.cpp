#include "report/typesetting.hpp"

#include <cairomm/fontface.h>
#include <cairomm/surface.h>

namespace clearloci::report {
namespace {

/// A context that draws nowhere, for measuring.
Cairo::RefPtr<Cairo::Context> ruler() {
  return Cairo::Context::create(Cairo::ImageSurface::create(Cairo::ImageSurface::Format::A8, 1, 1));
}

double advance(const Cairo::RefPtr<Cairo::Context>& context, const std::string& text) {
  Cairo::TextExtents extents;
  context->get_text_extents(text, extents);
  return extents.x_advance;
}

}  // namespace

void choose_font(const Cairo::RefPtr<Cairo::Context>& context, const Font& font) {
  Cairo::FontOptions options;
  options.set_antialias(Cairo::ANTIALIAS_GRAY);
  options.set_hint_style(Cairo::FontOptions::HintStyle::NONE);
  options.set_hint_metrics(Cairo::FontOptions::HintMetrics::OFF);
  context->set_font_options(options);
  context->select_font_face("sans-serif",
                            font.italic ? Cairo::ToyFontFace::Slant::ITALIC : Cairo::ToyFontFace::Slant::NORMAL,
                            font.bold ? Cairo::ToyFontFace::Weight::BOLD : Cairo::ToyFontFace::Weight::NORMAL);
  context->set_font_size(font.size);
}

void load_fonts() {
  for (const bool bold : {false, true}) text_width("0", {.bold = bold});
}

double text_width(const std::string& text, const Font& font) {
  const auto context = ruler();
  choose_font(context, font);
  return advance(context, text);
}

Measure measure_in(const Font& font) {
  const auto context = ruler();
  choose_font(context, font);
  return [context](std::string_view text) { return advance(context, std::string(text)); };
}

void write_text(const Cairo::RefPtr<Cairo::Context>& context, const std::string& text, double x, double y,
                const Font& font, Align align) {
  choose_font(context, font);
  const double shift = align == Align::left ? 0 : advance(context, text) * (align == Align::centre ? 0.5 : 1);
  context->move_to(x - shift, y);
  context->show_text(text);
  context->begin_new_path();
}

}  // namespace clearloci::report
