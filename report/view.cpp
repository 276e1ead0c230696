#include "report/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace clearloci::report {
namespace {

using core::Point3;

constexpr int fine = 2;  // samples along each side of a pixel

Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point3 minus(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Point3 normalised(const Point3& a) {
  const double length = std::sqrt(dot(a, a)), inverse = 1 / length;
  return length > 0 ? Point3{a[0] * inverse, a[1] * inverse, a[2] * inverse} : Point3{0, 0, 1};
}

/// value^28, the sharpness of a highlight.
double sharpened(double value) {
  const double square = value * value, fourth = square * square, eighth = fourth * fourth;
  return eighth * eighth * eighth * fourth;
}

/// A piece of a surface behind one sample.
struct Fragment {
  float nearness = 0;
  std::array<float, 3> colour{};
  float opacity = 0;
  int next = -1;
};

/// A corner on the finer grid.
struct Corner {
  double x = 0, y = 0, nearness = 0, height = 0;
  Point3 normal{};
};

class Shader {
 public:
  Shader(const View& view, const Shading& shading, core::Point2 left_top, int width, int height, double per_point)
      : view_(view),
        shading_(shading),
        left_top_(left_top),
        width_(width * fine),
        height_(height * fine),
        per_point_(per_point * fine),
        first_(static_cast<std::size_t>(width_) * height_, -1) {
    light_ = normalised({view.toward[0] + 0.7 * view.up[0] - 0.5 * view.right[0],
                         view.toward[1] + 0.7 * view.up[1] - 0.5 * view.right[1],
                         view.toward[2] + 0.7 * view.up[2] - 0.5 * view.right[2]});
    half_way_ = normalised({light_[0] + view.toward[0], light_[1] + view.toward[1], light_[2] + view.toward[2]});
  }

  void add(const ShadedSurface& shaded) {
    const core::LocusSurface& surface = *shaded.surface;
    std::vector<Point3> normals(surface.vertices.size());
    for (const auto& t : surface.triangles) {
      const auto at = [&](std::size_t i) { return view_.space(surface.vertices[static_cast<std::size_t>(t[i])]); };
      const Point3 normal = cross(minus(at(1), at(0)), minus(at(2), at(0)));  // as long as the triangle is large
      for (const int corner : t)
        for (std::size_t i = 0; i < 3; ++i) normals[static_cast<std::size_t>(corner)][i] += normal[i];
    }
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < normals.size(); ++i) corners.push_back(corner(surface.vertices[i], normals[i]));
    log_transparency_ = std::log(1 - shaded.opacity);
    for (const auto& t : surface.triangles)
      fill(corners[static_cast<std::size_t>(t[0])], corners[static_cast<std::size_t>(t[1])],
           corners[static_cast<std::size_t>(t[2])], shaded);
    add_rim(surface, corners, shaded);
  }

  std::vector<std::uint32_t> pixels() {
    const int width = width_ / fine, height = height_ / fine;
    std::vector<std::uint32_t> result;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        std::array<double, 4> sum{};
        for (int i = 0; i < fine * fine; ++i) {
          const auto colour =
              composed(first_[static_cast<std::size_t>(y * fine + i / fine) * width_ + x * fine + i % fine]);
          for (std::size_t c = 0; c < 4; ++c) sum[c] += colour[c] / (fine * fine);
        }
        const auto byte = [](double value) {
          return static_cast<std::uint32_t>(std::clamp(std::lround(255 * value), 0L, 255L));
        };
        result.push_back(byte(sum[3]) << 24 | byte(sum[0]) << 16 | byte(sum[1]) << 8 | byte(sum[2]));
      }
    return result;
  }

 private:
  Corner corner(const Point3& place, const Point3& normal) const {
    const core::Point2 page = view_.page(place);
    return {(page[0] - left_top_[0]) * per_point_, (page[1] - left_top_[1]) * per_point_, view_.nearness(place),
            place[2], normalised(normal)};
  }

  void put(int x, int y, const Fragment& fragment) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    int& first = first_[static_cast<std::size_t>(y) * width_ + x];
    fragments_.push_back(fragment);
    fragments_.back().next = first;
    first = static_cast<int>(fragments_.size()) - 1;
  }

  void fill(const Corner& a, const Corner& b, const Corner& c, const ShadedSurface& shaded) {
    const double twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (twice == 0) return;
    const int from_y = std::max(0, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y}) - 0.5)));
    const int to_y = std::min(height_ - 1, static_cast<int>(std::floor(std::max({a.y, b.y, c.y}) - 0.5)));
    const int from_x = std::max(0, static_cast<int>(std::ceil(std::min({a.x, b.x, c.x}) - 0.5)));
    const int to_x = std::min(width_ - 1, static_cast<int>(std::floor(std::max({a.x, b.x, c.x}) - 0.5)));
    const double slope_x = ((c.y - a.y) * (b.height - a.height) - (b.y - a.y) * (c.height - a.height)) / twice;
    const double slope_y = ((b.x - a.x) * (c.height - a.height) - (c.x - a.x) * (b.height - a.height)) / twice;
    const double slope = std::sqrt(slope_x * slope_x + slope_y * slope_y), inverse = 1 / twice;
    for (int y = from_y; y <= to_y; ++y)
      for (int x = from_x; x <= to_x; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double of_b = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) * inverse;
        const double of_c = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) * inverse;
        const double of_a = 1 - of_b - of_c;
        if (of_a < 0 || of_b < 0 || of_c < 0) continue;
        const auto mixed = [&](double u, double v, double w) { return of_a * u + of_b * v + of_c * w; };
        Point3 normal{};
        for (std::size_t i = 0; i < 3; ++i) normal[i] = mixed(a.normal[i], b.normal[i], c.normal[i]);
        put(x, y,
            lit(normalised(normal), mixed(a.nearness, b.nearness, c.nearness),
                on_height_line(mixed(a.height, b.height, c.height), slope), shaded));
      }
  }

  bool on_height_line(double height, double slope) const {
    constexpr double half_width = 0.6 * fine;  // samples
    if (shading_.height_step <= 0 || slope == 0) return false;
    const double off = std::abs(height - shading_.height_step * std::round(height / shading_.height_step));
    return off < half_width * slope;
  }

  Fragment lit(const Point3& normal, double nearness, bool line, const ShadedSurface& shaded) const {
    const double facing = std::abs(dot(normal, view_.toward));
    // Both sides are shown: the normal is turned towards the eye.
    const double turn = dot(normal, view_.toward) < 0 ? -1 : 1;
    const double diffuse = std::max(0.0, turn * dot(normal, light_));
    const double shine = 0.22 * sharpened(std::max(0.0, turn * dot(normal, half_way_)));
    const double brightness = (0.5 + 0.56 * diffuse) * (line ? 0.62 : 1);
    Fragment fragment;
    fragment.nearness = static_cast<float>(nearness);
    const std::array<double, 3> colour = {shaded.colour.red, shaded.colour.green, shaded.colour.blue};
    for (std::size_t i = 0; i < 3; ++i)
      fragment.colour[i] = static_cast<float>(std::clamp(colour[i] * brightness + shine, 0.0, 1.0));
    // More of a sheet is looked through where it is seen at a flat angle.
    const double thickness = 1 / std::max(0.25, facing);
    const double opacity = 1 - std::exp(log_transparency_ * std::min(2.0, thickness));
    fragment.opacity = static_cast<float>(line ? std::max(opacity, 0.8) : opacity);
    return fragment;
  }

  /// The edges of a single triangle as dark lines.
  void add_rim(const core::LocusSurface& surface, const std::vector<Corner>& corners, const ShadedSurface& shaded) {
    std::vector<std::array<int, 2>> edges;
    for (const auto& t : surface.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
    std::sort(edges.begin(), edges.end());
    for (std::size_t first = 0, next = 0; first < edges.size(); first = next) {
      while (next < edges.size() && edges[next] == edges[first]) ++next;
      if (next - first == 1)
        draw_line(corners[static_cast<std::size_t>(edges[first][0])],
                  corners[static_cast<std::size_t>(edges[first][1])], shaded);
    }
  }

  void draw_line(const Corner& a, const Corner& b, const ShadedSurface& shaded) {
    const double half_width = 0.42 * per_point_, bias = 0.01;
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double reach = half_width + 1;
    const int from_y = static_cast<int>(std::floor(std::min(a.y, b.y) - reach));
    const int to_y = static_cast<int>(std::ceil(std::max(a.y, b.y) + reach));
    const int from_x = static_cast<int>(std::floor(std::min(a.x, b.x) - reach));
    const int to_x = static_cast<int>(std::ceil(std::max(a.x, b.x) + reach));
    for (int y = from_y; y <= to_y; ++y)
      for (int x = from_x; x <= to_x; ++x) {
        const double px = x + 0.5 - a.x, py = y + 0.5 - a.y;
        const double along =
            length > 0 ? std::clamp((px * (b.x - a.x) + py * (b.y - a.y)) / (length * length), 0.0, 1.0) : 0;
        if (std::hypot(px - along * (b.x - a.x), py - along * (b.y - a.y)) > half_width) continue;
        Fragment fragment;
        fragment.nearness = static_cast<float>(a.nearness + along * (b.nearness - a.nearness) + bias);
        const std::array<double, 3> colour = {shaded.colour.red, shaded.colour.green, shaded.colour.blue};
        for (std::size_t i = 0; i < 3; ++i) fragment.colour[i] = static_cast<float>(0.55 * colour[i]);
        fragment.opacity = static_cast<float>(std::min(1.0, shaded.opacity + 0.25));
        put(x, y, fragment);
      }
  }

  /// Premultiplied colour and opacity of what is behind a sample, the farthest first.
  std::array<double, 4> composed(int first) {
    order_.clear();
    // A few at most, the last drawn first: each is put in its place as it comes.
    for (int i = first; i >= 0; i = fragments_[static_cast<std::size_t>(i)].next) {
      const float nearness = fragments_[static_cast<std::size_t>(i)].nearness;
      std::size_t place = order_.size();
      order_.push_back(i);
      for (; place > 0 && fragments_[static_cast<std::size_t>(order_[place - 1])].nearness >= nearness; --place)
        order_[place] = order_[place - 1];
      order_[place] = i;
    }
    std::array<double, 4> sum{};
    for (const int i : order_) {
      const Fragment& fragment = fragments_[static_cast<std::size_t>(i)];
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] = sum[c] * (1 - fragment.opacity) + fragment.colour[c] * fragment.opacity;
      sum[3] = sum[3] * (1 - fragment.opacity) + fragment.opacity;
    }
    return sum;
  }

  const View& view_;
  Shading shading_;
  core::Point2 left_top_;
  int width_, height_;
  double per_point_;
  Point3 light_{}, half_way_{};
  double log_transparency_ = 0;  ///< of the surface that is being added
  std::vector<int> first_;
  std::vector<Fragment> fragments_;
  std::vector<int> order_;
};

}  // namespace

Point3 View::space(const Point3& place) const {
  Point3 result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = (place[i] - centre[i]) * scale[i];
  return result;
}

core::Point2 View::page(const Point3& place) const {
  const Point3 projected = space(place);
  return {origin[0] + zoom * dot(projected, right), origin[1] - zoom * dot(projected, up)};
}

double View::nearness(const Point3& place) const { return dot(space(place), toward); }

View view_of(const core::LocusMap& map, double azimuth, double elevation) {
  const auto is_angle = [&](std::size_t i) { return !map.angles.empty() && map.angles[i]; };
  View view;
  Point3 extent{};
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = core::to_double(map.lower[i]), high = core::to_double(map.upper[i]);
    view.centre[i] = 0.5 * (low + high);
    extent[i] = high - low;
    if (!is_angle(i)) longest = std::max(longest, extent[i]);
  }
  constexpr double flattest = 0.45;  // of a box's side to its longest: a thin box still shows what is in it
  for (std::size_t i = 0; i < 3; ++i) {
    if (is_angle(i) || longest == 0)
      view.scale[i] = 1 / extent[i];
    else
      view.scale[i] = std::max(1 / longest, flattest / extent[i]);
  }
  view.toward = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  view.right = {-std::sin(azimuth), std::cos(azimuth), 0};
  view.up = cross(view.toward, view.right);
  return view;
}

std::vector<std::uint32_t> shade(const View& view, const std::vector<ShadedSurface>& surfaces, const Shading& shading,
                                 core::Point2 left_top, int width, int height, double per_point) {
  Shader shader(view, shading, left_top, width, height, per_point);
  for (const ShadedSurface& surface : surfaces) shader.add(surface);
  return shader.pixels();
}

}  // namespace clearloci::report
