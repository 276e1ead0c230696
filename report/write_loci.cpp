#include "report/write_loci.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "report/exports.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/picture.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

struct Naming {
  FileFormat format;
  std::string_view name;
  std::string_view file;  ///< after "loci"
};

constexpr std::array<Naming, 11> namings = {{{FileFormat::json, "json", ".json"},
                                             {FileFormat::csv, "csv", ".csv"},
                                             {FileFormat::svg, "svg", ".svg"},
                                             {FileFormat::png, "png", ".png"},
                                             {FileFormat::pdf, "pdf", ".pdf"},
                                             {FileFormat::dxf, "dxf", ".dxf"},
                                             {FileFormat::dxf_r12, "dxf-r12", "-r12.dxf"},
                                             {FileFormat::geojson, "geojson", ".geojson"},
                                             {FileFormat::vtk, "vtk", ".vtp"},
                                             {FileFormat::stl, "stl", ".stl"},
                                             {FileFormat::obj, "obj", ".obj"}}};

std::optional<PictureFormat> picture_format(FileFormat format) {
  switch (format) {
    case FileFormat::svg:
      return PictureFormat::svg;
    case FileFormat::png:
      return PictureFormat::png;
    case FileFormat::pdf:
      return PictureFormat::pdf;
    default:
      return std::nullopt;
  }
}

std::string bytes_of(const core::LocusMap& map, FileFormat format) {
  switch (format) {
    case FileFormat::csv:
      return csv(map);
    case FileFormat::dxf:
      return dxf(map, DxfVersion::r2000);
    case FileFormat::dxf_r12:
      return dxf(map, DxfVersion::r12);
    case FileFormat::geojson:
      return geojson(map);
    case FileFormat::vtk:
      return vtp(map);
    case FileFormat::obj:
      return obj(map);
    default:
      return json_text(loci_object(map));
  }
}

const core::Sketch* sketch_of(const std::vector<ModeSketch>& sketches, const core::WorkingMode& mode) {
  const auto found = std::find_if(sketches.begin(), sketches.end(), [&](const auto& one) { return one.mode == mode; });
  return found == sketches.end() ? nullptr : &found->sketch;
}

/// The modes to draw: those of the map, else (nothing was found in any) those of the sketches.
std::vector<core::WorkingMode> modes_to_draw(const core::LocusMap& map, const std::vector<ModeSketch>& sketches) {
  std::vector<core::WorkingMode> modes = modes_of(map);
  if (!modes.empty()) return modes;
  for (const auto& one : sketches) modes.push_back(one.mode);
  if (modes.empty()) modes.emplace_back(map.tower.roots.size(), 1);
  return modes;
}

}  // namespace

std::optional<FileFormat> file_format(std::string_view name) {
  for (const auto& naming : namings) {
    if (naming.name == name) return naming.format;
  }
  return std::nullopt;
}

std::vector<std::string> file_format_names() {
  std::vector<std::string> names;
  for (const auto& naming : namings) names.emplace_back(naming.name);
  return names;
}

std::set<FileFormat> default_file_formats() {
  return {FileFormat::json, FileFormat::svg, FileFormat::png, FileFormat::csv};
}

bool can_hold(FileFormat format, std::size_t coordinates) {
  const bool of_surfaces = format == FileFormat::stl || format == FileFormat::obj;
  const bool of_curves = format == FileFormat::dxf || format == FileFormat::dxf_r12 || format == FileFormat::geojson;
  return coordinates == 3 ? !of_curves : !of_surfaces;
}

std::vector<std::filesystem::path> write_loci(const core::LocusMap& map, const std::vector<ModeSketch>& sketches,
                                              const std::filesystem::path& directory,
                                              const std::set<FileFormat>& formats) {
  std::vector<std::filesystem::path> written;
  const auto write = [&](const std::string& name, const std::string& bytes) {
    write_atomically(directory / name, bytes);
    written.push_back(directory / name);
  };
  const auto modes = modes_to_draw(map, sketches);
  const bool surfaces = map.tower.coordinates.size() == 3;
  for (const auto& naming : namings) {
    const bool wanted = formats.contains(naming.format) || (surfaces && naming.format == FileFormat::obj);
    if (!wanted || !can_hold(naming.format, map.tower.coordinates.size())) continue;
    if (naming.format == FileFormat::stl) {
      for (const auto& surface : map.surfaces) write("loci-" + mesh_name(surface) + ".stl", stl(surface));
      continue;
    }
    if (naming.format == FileFormat::obj) write("loci.mtl", mtl(map));
    const auto drawn = picture_format(naming.format);
    if (!drawn) {
      write("loci" + std::string(naming.file), bytes_of(map, naming.format));
      continue;
    }
    for (const auto& mode : modes) {
      const std::string which = modes.size() > 1 ? "-" + mode_slug(map.tower, mode) : "";
      write("loci" + which + std::string(naming.file), picture(map, mode, sketch_of(sketches, mode), *drawn));
    }
  }
  return written;
}

}  // namespace clearloci::report
