#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "report/exports.hpp"
#include "report/surface_groups.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

void append_little_endian(std::string& out, std::uint32_t value) {
  for (int byte = 0; byte < 4; ++byte) out += static_cast<char>(value >> (8 * byte) & 0xFF);
}

void append_float(std::string& out, double value) {
  append_little_endian(out, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

core::Point3 unit_normal(const core::Point3& a, const core::Point3& b, const core::Point3& c) {
  core::Point3 u{}, v{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
  }
  core::Point3 normal = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  for (double& component : normal) component = length > 0 ? component / length : 0;
  return normal;
}

std::string material_name(std::size_t group) { return "group" + std::to_string(group + 1); }

std::string title_of(const core::LocusMap& map, const core::LocusSurface& surface) {
  const std::string what = vanishing_words(surface.kind, surface.vanishing);
  const std::string mode = mode_words(map.tower, surface.mode);
  return printable(surface.id + " " + (what.empty() ? kind_words(surface.kind) : what) +
                   (mode.empty() ? "" : ", " + mode));
}

}  // namespace

std::string mesh_name(const core::LocusSurface& surface) { return surface.id + "-" + core::to_string(surface.kind); }

std::string stl(const core::LocusSurface& surface) {
  constexpr std::size_t header = 80;
  std::string out = "clearloci " + mesh_name(surface);  // a header must not begin with "solid"
  out.resize(header, ' ');
  append_little_endian(out, static_cast<std::uint32_t>(surface.triangles.size()));
  for (const auto& triangle : surface.triangles) {
    const auto at = [&](std::size_t i) { return surface.vertices[static_cast<std::size_t>(triangle[i])]; };
    for (const double component : unit_normal(at(0), at(1), at(2))) append_float(out, component);
    for (std::size_t i = 0; i < 3; ++i)
      for (const double coordinate : at(i)) append_float(out, coordinate);
    out += std::string(2, '\0');
  }
  return out;
}

std::string obj(const core::LocusMap& map) {
  std::string out = "# " + printable(map.mechanism) + "\nmtllib loci.mtl\n";
  const auto groups = group_surfaces(map);
  const auto material_of = [&](const core::LocusSurface& surface) {
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const core::LocusSurface* member : groups[g].surfaces)
        if (member == &surface) return material_name(g);
    return material_name(0);
  };
  std::size_t before = 1;  // OBJ counts from 1 on, through all groups
  for (const core::LocusSurface& surface : map.surfaces) {
    fmt::format_to(std::back_inserter(out), "# {}\ng {}\nusemtl {}\n", title_of(map, surface), mesh_name(surface),
                   material_of(surface));
    for (const auto& at : surface.vertices)
      out += "v " + exact_number(at[0]) + " " + exact_number(at[1]) + " " + exact_number(at[2]) + "\n";
    for (const auto& triangle : surface.triangles) {
      out += "f";
      for (const int corner : triangle) out += " " + std::to_string(before + static_cast<std::size_t>(corner));
      out += "\n";
    }
    before += surface.vertices.size();
  }
  return out;
}

std::string mtl(const core::LocusMap& map) {
  std::string out;
  const auto groups = group_surfaces(map);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Colour& colour = groups[g].colour;
    fmt::format_to(std::back_inserter(out), "# {}\nnewmtl {}\nKd {:.3f} {:.3f} {:.3f}\nd {:.2f}\n", groups[g].what,
                   material_name(g), colour.red, colour.green, colour.blue, groups[g].opacity);
  }
  return out;
}

}  // namespace clearloci::report
