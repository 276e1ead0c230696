#include "mechanism/read_stl.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "core/task.hpp"
#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

/// A part of a million triangles has 50 MB.
constexpr std::size_t largest_solid = std::size_t{256} << 20;
constexpr std::size_t header = 80, bytes_of_triangle = 50;

/// As the file has them: three a triangle.
using Corner = std::array<double, 3>;

std::uint32_t little_endian(const char* at) {
  std::array<unsigned char, 4> b{};
  std::memcpy(b.data(), at, b.size());
  return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
}

float float_at(const char* at) {
  const std::uint32_t bits = little_endian(at);
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Files whose header begins with "solid" may be binary all the same: the number of triangles tells.
bool is_binary(const std::string& bytes) {
  return bytes.size() >= header + 4 &&
         bytes.size() == header + 4 + bytes_of_triangle * std::size_t{little_endian(bytes.data() + header)};
}

std::vector<Corner> binary_corners(const std::string& bytes) {
  std::vector<Corner> corners;
  for (std::size_t at = header + 4; at + bytes_of_triangle <= bytes.size(); at += bytes_of_triangle)
    for (std::size_t k = 0; k < 3; ++k) {
      Corner& corner = corners.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) corner[c] = float_at(bytes.data() + at + 12 + 12 * k + 4 * c);
    }
  return corners;
}

/// The words of a text, one after another, with the line that each is on.
class Words {
 public:
  explicit Words(const std::string& text) : text_(text) {}

  /// Empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t from = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return std::string_view(text_).substr(from, at_ - from);
  }
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  int line() const { return line_; }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v'; }

  const std::string& text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::string lower_case(std::string_view word) {
  std::string lower_case(word);
  for (char& c : lower_case)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower_case;
}

/// solid NAME, then of each triangle: facet normal N N N, outer loop, three times vertex X Y Z, endloop, endfacet.
std::vector<Corner> text_corners(const std::string& text, const std::string& file) {
  Words words(text);
  std::vector<Corner> corners;
  std::size_t of_loop = 0;
  const auto refuse = [&](const std::string& what) {
    throw InputError({file, words.line(), 1}, what, "export the part as STL once more, binary");
  };
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    const std::string keyword = lower_case(word);
    if (keyword == "solid" || keyword == "endsolid" || keyword == "facet") {
      words.skip_line();  // names, and normals, which say nothing that the corners do not
    } else if (keyword == "loop") {
      of_loop = 0;
    } else if (keyword == "endloop") {
      if (of_loop != 3) refuse("a facet of the STL file has " + std::to_string(of_loop) + " corners");
    } else if (keyword == "vertex") {
      Corner& corner = corners.emplace_back();
      for (double& value : corner) {
        std::string_view number = words.next();
        if (!number.empty() && number.front() == '+') number.remove_prefix(1);
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
        if (error != std::errc() || end != number.data() + number.size())
          refuse("a vertex of the STL file has no three numbers");
      }
      ++of_loop;
    } else if (keyword != "outer" && keyword != "endfacet") {
      refuse("the file is no STL file");
    }
  }
  if (corners.size() % 3 != 0) refuse("the STL file ends within a facet");
  return corners;
}

struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::size_t sum = 0;
    for (const double value : corner) sum = sum * 0x9e3779b97f4a7c15ULL + std::hash<double>{}(value);
    return sum;
  }
};

/// Corners at the same place are one; triangles of less than three are none.
core::TaskMesh joined(const std::vector<Corner>& corners, const std::string& file, double unit) {
  core::TaskMesh mesh;
  mesh.file = file;
  std::unordered_map<Corner, int, CornerHash> index_of_corner;
  std::array<int, 3> triangle{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Corner corner = corners[i];
    for (double& value : corner) {
      if (!std::isfinite(value))
        throw InputError({file, 0, 0}, "a corner of the STL file is not finite", "export the part as STL once more");
      if (value == 0) value = 0;  // of both signs
    }
    const auto [place, fresh] = index_of_corner.try_emplace(corner, static_cast<int>(mesh.corners.size()));
    if (fresh) mesh.corners.push_back({unit * corner[0], unit * corner[1], unit * corner[2]});
    triangle[i % 3] = place->second;
    if (i % 3 == 2 && triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace

core::TaskMesh parse_stl(const std::string& bytes, const std::string& file, double unit) {
  const std::vector<Corner> corners = is_binary(bytes) ? binary_corners(bytes) : text_corners(bytes, file);
  core::TaskMesh mesh = joined(corners, file, unit);
  if (mesh.triangles.empty())
    throw InputError({file, 0, 0}, "the STL file has no triangles", "export a watertight solid");
  if (const auto open = core::open_surface(mesh))
    throw InputError({file, 0, 0}, "the surface of the STL file " + *open, "export a watertight solid");
  return mesh;
}

core::TaskMesh read_stl(const std::string& path, double unit) {
  return parse_stl(read_text(path, "an STL file", largest_solid), path, unit);
}

}  // namespace clearloci::mechanism
