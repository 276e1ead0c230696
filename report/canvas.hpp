// What pictures are drawn on: pages and pixels of Cairo. That library, with the fonts and the X11 libraries it brings,
// is opened when the first picture is asked for; where it is missing an InputError says so. Lengths in points unless
// scaled. Whatever else fails in Cairo is told by Canvas::finish(): std::bad_alloc or a std::runtime_error.
// Private to report/.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace clearloci::report {

enum class LineCap { butt, round };
enum class LineJoin { miter, round };
enum class FillRule { winding, even_odd };
enum class Filter { smooth, nearest };

/// Pixels of 32 bits, native 0xAARRGGBB, premultiplied; rows from the top.
class Raster {
 public:
  /// Transparent.
  Raster(int width, int height) : Raster(width, height, true) {}
  /// Black, and without transparency.
  static Raster opaque(int width, int height) { return {width, height, false}; }

  unsigned char* data();
  const unsigned char* data() const;
  int stride() const;  ///< bytes from row to row

 private:
  friend class Canvas;
  Raster(int width, int height, bool transparent);

  std::shared_ptr<void> surface_;
};

/// A page or a raster with the state of the pen. Copies draw on the same one.
class Canvas {
 public:
  /// One unit is a pixel.
  static Canvas on(const Raster& raster);
  /// A page whose bytes are appended to `bytes`, which must outlive it; complete after finish().
  static Canvas svg(std::string& bytes, double width, double height);
  static Canvas pdf(std::string& bytes, double width, double height, const std::string& title);

  void show_page() const;
  /// What is drawn is in the raster's data; what had failed is thrown.
  void flush() const;
  /// The page's bytes are complete; what had failed is thrown.
  void finish() const;

  void save() const;
  void restore() const;
  void translate(double x, double y) const;
  void scale(double x, double y) const;
  void rotate(double radians) const;

  void begin_new_path() const;
  void begin_new_sub_path() const;
  void move_to(double x, double y) const;
  void line_to(double x, double y) const;
  void close_path() const;
  void rectangle(double x, double y, double width, double height) const;
  /// From one angle to the other, radians, towards y; `arc_negative` the other way.
  void arc(double x, double y, double radius, double from, double to) const;
  void arc_negative(double x, double y, double radius, double from, double to) const;

  void set_source_rgb(double red, double green, double blue) const;
  void set_source_rgba(double red, double green, double blue, double opacity) const;
  void set_line_width(double width) const;
  void set_line_cap(LineCap cap) const;
  void set_line_join(LineJoin join) const;
  void set_fill_rule(FillRule rule) const;
  /// None: a solid line.
  void set_dash(const std::vector<double>& lengths) const;
  /// Edges as whole pixels: neighbours meet without a seam.
  void set_sharp_edges() const;

  void stroke() const;
  void fill() const;
  void fill_preserve() const;
  void clip() const;
  void paint() const;
  void paint(const Raster& raster, Filter filter) const;
  /// What is drawn between the two is laid over the page as a whole, with one opacity.
  void push_group() const;
  void paint_group(double opacity) const;

  /// Metrics are not rounded to pixels, so that SVG, PDF and PNG break lines alike.
  void set_font(double size, bool bold, bool italic) const;
  double text_advance(const std::string& text) const;
  void show_text(const std::string& text) const;
  void text_path(const std::string& text) const;

 private:
  explicit Canvas(std::shared_ptr<void> surface);

  std::shared_ptr<void> surface_, context_;
};

}  // namespace clearloci::report
