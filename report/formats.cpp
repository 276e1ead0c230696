#include "report/formats.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/exports.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/picture.hpp"
#include "report/verification.hpp"
#include "report/viewer.hpp"
#include "report/wording.hpp"
#include "report/zones.hpp"

namespace clearloci::report {
namespace {

bool any(std::size_t) { return true; }
bool curves(std::size_t coordinates) { return coordinates < 3; }
bool surfaces(std::size_t coordinates) { return coordinates == 3; }

const char* ending_of(PictureFormat format) {
  switch (format) {
    case PictureFormat::svg:
      return ".svg";
    case PictureFormat::png:
      return ".png";
    case PictureFormat::pdf:
      break;
  }
  return ".pdf";
}

/// "-left-right" where there are several modes.
std::string which(const std::vector<core::WorkingMode>& modes, const core::TowerNames& tower,
                  const core::WorkingMode& mode) {
  return modes.size() > 1 ? "-" + mode_slug(tower, mode) : "";
}

/// The modes to draw: those of the map, else (nothing was found in any) those of the sketches.
std::vector<core::WorkingMode> modes_to_draw(const LociSheet& loci) {
  std::vector<core::WorkingMode> modes = modes_of(loci.map);
  if (!modes.empty()) return modes;
  for (const core::ModeSketch& one : loci.sketches) modes.push_back(one.mode);
  if (modes.empty()) modes.emplace_back(loci.map.tower.roots.size(), 1);
  return modes;
}

template <PictureFormat format>
Files loci_pictures(const LociSheet& loci) {
  Files files;
  const std::vector<core::WorkingMode> modes = modes_to_draw(loci);
  for (const core::WorkingMode& mode : modes) {
    const auto sketch = std::find_if(loci.sketches.begin(), loci.sketches.end(),
                                     [&](const core::ModeSketch& one) { return one.mode == mode; });
    files.push_back({"loci" + which(modes, loci.map.tower, mode) + ending_of(format),
                     picture(loci.map, mode, sketch == loci.sketches.end() ? nullptr : &sketch->sketch, format)});
  }
  return files;
}

template <PictureFormat format>
Files zone_pictures(const core::ZoneMap& map) {
  Files files;
  const std::vector<core::WorkingMode> modes = modes_of_zones(map);
  for (const core::WorkingMode& mode : modes)
    files.push_back(
        {"zones" + which(modes, map.loci.tower, mode) + ending_of(format), zone_picture(map, mode, format)});
  return files;
}

template <PictureFormat format>
Files verification_picture(const core::Verification& result) {
  return {{std::string("verify") + ending_of(format), verification_picture(result, format)}};
}

Files loci_json(const LociSheet& loci) { return {{"loci.json", json_text(loci_object(loci.map))}}; }
Files zones_json(const core::ZoneMap& map) { return {{"zones.json", json_text(zones_object(map))}}; }
Files verification_json(const core::Verification& result) {
  return {{"verify.json", json_text(verification_object(result))}};
}
Files loci_csv(const LociSheet& loci) { return {{"loci.csv", csv(loci.map)}}; }
Files loci_dxf(const LociSheet& loci) { return {{"loci.dxf", dxf(loci.map, DxfVersion::r2000)}}; }
Files loci_dxf_r12(const LociSheet& loci) { return {{"loci-r12.dxf", dxf(loci.map, DxfVersion::r12)}}; }
Files loci_geojson(const LociSheet& loci) { return {{"loci.geojson", geojson(loci.map)}}; }
Files zones_in_geojson(const core::ZoneMap& map) { return {{"zones.geojson", zones_geojson(map)}}; }
Files loci_vtk(const LociSheet& loci) { return {{"loci.vtp", vtp(loci.map)}}; }
Files loci_obj(const LociSheet& loci) { return {{"loci.mtl", mtl(loci.map)}, {"loci.obj", obj(loci.map)}}; }
Files loci_stl(const LociSheet& loci) {
  Files files;
  for (const core::LocusSurface& surface : loci.map.surfaces)
    files.push_back({"loci-" + mesh_name(surface) + ".stl", stl(surface)});
  return files;
}

Files loci_html(const LociSheet& loci) { return {{"loci.html", html_page(loci)}}; }

constexpr PictureFormat svg = PictureFormat::svg, png = PictureFormat::png, pdf = PictureFormat::pdf;

/// Writes what the formats that `wanted` picks make of an answer. `made`: the answer's column of the registry.
template <class Answer, class Wanted>
std::vector<std::filesystem::path> write_in(Files (*Format::*made)(const Answer&), const Answer& answer,
                                            const std::filesystem::path& directory, Wanted wanted) {
  std::vector<std::filesystem::path> paths;
  for (const Format& format : formats()) {
    if (format.*made == nullptr || !wanted(format)) continue;
    for (const File& file : (format.*made)(answer)) {
      write_atomically(directory / file.name, file.bytes);
      paths.push_back(directory / file.name);
    }
  }
  return paths;
}

/// json, and what is named.
auto named(const std::set<std::string>& names) {
  return [&names](const Format& format) { return format.name == "json" || names.contains(std::string(format.name)); };
}

}  // namespace

const std::vector<Format>& formats() {
  static const std::vector<Format> all = [] {
    std::vector<Format> list = {
        {"json", any, loci_json, zones_json, verification_json},
        {"csv", any, loci_csv, nullptr, nullptr},
        {"svg", any, loci_pictures<svg>, zone_pictures<svg>, verification_picture<svg>},
        {"png", any, loci_pictures<png>, zone_pictures<png>, verification_picture<png>},
        {"pdf", any, loci_pictures<pdf>, zone_pictures<pdf>, verification_picture<pdf>},
        {"dxf", curves, loci_dxf, nullptr, nullptr},
        {"dxf-r12", curves, loci_dxf_r12, nullptr, nullptr},
        {"geojson", curves, loci_geojson, zones_in_geojson, nullptr},
        {"vtk", any, loci_vtk, nullptr, nullptr},
        {"stl", surfaces, loci_stl, nullptr, nullptr},
        {"obj", surfaces, loci_obj, nullptr, nullptr},
        {"html", any, loci_html, nullptr, nullptr},
    };
    // A build without the workbench has no viewer to put into a page.
    if (viewer_bundle().script.empty()) std::erase_if(list, [](const Format& one) { return one.name == "html"; });
    return list;
  }();
  return all;
}

std::vector<std::string> format_names(Answer answer) {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    const bool holds = answer == Answer::loci    ? format.loci != nullptr
                       : answer == Answer::zones ? format.zones != nullptr
                                                 : format.verification != nullptr;
    if (holds) names.emplace_back(format.name);
  }
  return names;
}

bool can_hold(std::string_view name, std::size_t coordinates) {
  return std::any_of(formats().begin(), formats().end(), [&](const Format& format) {
    return format.name == name && format.loci != nullptr && format.holds_coordinates(coordinates);
  });
}

std::vector<std::filesystem::path> write_loci(const LociSheet& loci, const std::filesystem::path& directory,
                                              const std::set<std::string>& names) {
  const std::size_t coordinates = loci.map.tower.coordinates.size();
  const auto asked = named(names);
  return write_in(&Format::loci, loci, directory, [&](const Format& format) {
    return format.holds_coordinates(coordinates) && (asked(format) || (coordinates == 3 && format.name == "obj"));
  });
}

std::vector<std::filesystem::path> write_zones(const core::ZoneMap& map, const std::filesystem::path& directory,
                                               const std::set<std::string>& names) {
  return write_in(&Format::zones, map, directory, named(names));
}

std::vector<std::filesystem::path> write_verification(const core::Verification& result,
                                                      const std::filesystem::path& directory,
                                                      const std::set<std::string>& names) {
  return write_in(&Format::verification, result, directory, named(names));
}

}  // namespace clearloci::report
