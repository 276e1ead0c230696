#include "report/formats.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/error.hpp"
#include "report/exports.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/picture.hpp"
#include "report/pose.hpp"
#include "report/preload.hpp"
#include "report/trajectory.hpp"
#include "report/trajectory_plots.hpp"
#include "report/typesetting.hpp"
#include "report/validation.hpp"
#include "report/verification.hpp"
#include "report/viewer.hpp"
#include "report/wording.hpp"
#include "report/zones.hpp"

namespace clearloci::report {
namespace {

bool any(std::size_t) { return true; }
bool curves(std::size_t coordinates) { return coordinates < 3; }
bool surfaces(std::size_t coordinates) { return coordinates == 3; }

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
    files.push_back({"loci" + mode_suffix(modes, loci.map.tower, mode) + ending_of(format),
                     picture(loci.map, mode, sketch == loci.sketches.end() ? nullptr : &sketch->sketch, format,
                             sketch != loci.sketches.end() && sketch->beside)});
  }
  return files;
}

template <PictureFormat format>
Files zone_pictures(const core::Zones& map) {
  Files files;
  const std::vector<core::WorkingMode> modes = modes_of_zones(map);
  for (const core::WorkingMode& mode : modes)
    files.push_back(
        {"zones" + mode_suffix(modes, map.loci.tower, mode) + ending_of(format), zone_picture(map, mode, format)});
  return files;
}

template <PictureFormat format>
Files verification_pictures(const core::Verification& result) {
  return {{std::string("verify") + ending_of(format), verification_picture(result, format)}};
}

Files loci_json(const LociSheet& loci) { return {{"loci.json", json_text(loci_object(loci.map))}}; }
Files zones_json(const core::Zones& map) { return {{"zones.json", json_text(zones_object(map))}}; }
Files verification_json(const core::Verification& result) {
  Files files = {{"verify.json", json_text(verification_object(result))}};
  if (result.preload && !result.preload->cells_of_law.empty())
    files.push_back({"preload_law.csv", shown_csv(law_table(result), result.units)});
  return files;
}
Files loci_csv(const LociSheet& loci) { return {{"loci.csv", csv(loci.map)}}; }
Files loci_dxf(const LociSheet& loci) { return {{"loci.dxf", dxf(loci.map, DxfVersion::r2000)}}; }
Files loci_dxf_r12(const LociSheet& loci) { return {{"loci-r12.dxf", dxf(loci.map, DxfVersion::r12)}}; }
Files loci_geojson(const LociSheet& loci) { return {{"loci.geojson", geojson(loci.map)}}; }
Files zones_in_geojson(const core::Zones& map) { return {{"zones.geojson", zones_geojson(map)}}; }
Files loci_vtk(const LociSheet& loci) { return {{"loci.vtp", vtp(loci.map)}}; }
Files loci_obj(const LociSheet& loci) { return {{"loci.mtl", mtl(loci.map)}, {"loci.obj", obj(loci.map)}}; }
Files loci_stl(const LociSheet& loci) {
  Files files;
  for (const core::LocusSurface& surface : loci.map.surfaces)
    files.push_back({"loci-" + mesh_name(surface) + ".stl", stl(surface)});
  return files;
}

Files loci_html(const LociSheet& loci) { return {{"loci.html", html_page(loci)}}; }
Files zones_html(const core::Zones& map) { return {{"zones.html", html_page({map.loci, {}, &map})}}; }

template <PictureFormat format>
Files error_drawn(const ErrorSheet& sheet) {
  return error_pictures(sheet, format);
}
Files error_json(const ErrorSheet& sheet) { return {{"error.json", json_text(error_object(sheet.errors))}}; }

template <PictureFormat format>
Files trajectory_pictures(const core::TrajectoryResult& result) {
  Files files;
  for (const NamedPlot& one : trajectory_plots(result))
    files.push_back({one.name + ending_of(format), plot(one.plot, format)});
  return files;
}
Files trajectory_json(const core::TrajectoryResult& result) {
  return {{"trajectory.json", json_text(trajectory_object(result))}};
}
Files trajectory_csv(const core::TrajectoryResult& result) {
  Files files = {{"trajectory.csv", shown_csv(result.samples, result.units)}};
  if (result.sweep) files.push_back({"periods.csv", shown_csv(sweep_table(result), result.units)});
  return files;
}

Files pose_json(const core::Pose& pose) { return {{"pose.json", json_text(pose_object(pose))}}; }

Files pose_in_modes_json(const core::PoseInModes& poses) {
  return {{"pose.json", json_text(pose_in_modes_object(poses))}};
}
Files validation_json(const core::Validation& validation) {
  return {{"validation.json", json_text(validation_object(validation))}};
}

/// What is drawn is drawn alike as svg, png and pdf.
template <PictureFormat format>
Format pictures(std::string_view name) {
  return {name,
          any,
          loci_pictures<format>,
          zone_pictures<format>,
          verification_pictures<format>,
          error_drawn<format>,
          trajectory_pictures<format>};
}

}  // namespace

const std::vector<Format>& formats() {
  static const std::vector<Format> all = [] {
    std::vector<Format> list = {
        {"json", any, loci_json, zones_json, verification_json, error_json, trajectory_json, pose_json,
         pose_in_modes_json, validation_json},
        {"csv", any, loci_csv, error_csv, trajectory_csv},
        pictures<PictureFormat::svg>("svg"),
        pictures<PictureFormat::png>("png"),
        pictures<PictureFormat::pdf>("pdf"),
        {"dxf", curves, loci_dxf},
        {"dxf-r12", curves, loci_dxf_r12},
        {"geojson", curves, loci_geojson, zones_in_geojson},
        {"vtk", any, loci_vtk, zones_vtk, error_vti},
        {"stl", surfaces, loci_stl, zones_stl},
        {"obj", surfaces, loci_obj},
        {"html", any, loci_html, zones_html},
    };
    // A build without the workbench has no viewer to put into a page.
    if (viewer_bundle().script.empty()) std::erase_if(list, [](const Format& one) { return one.name == "html"; });
    return list;
  }();
  return all;
}

std::string mode_suffix(const std::vector<core::WorkingMode>& modes, const core::TowerNames& tower,
                        const core::WorkingMode& mode) {
  return modes.size() > 1 ? "-" + mode_slug(tower, mode) : "";
}

std::vector<std::string> zone_formats(std::size_t coordinates, bool by_cells) {
  std::vector<std::string> names = format_names<core::Zones>();
  std::erase_if(names, [&](const std::string& name) {
    if (name == "geojson" || name == "html") return by_cells;
    if (name == "vtk") return !by_cells || coordinates < 2;
    return name == "stl" && (!by_cells || coordinates < 3);
  });
  return names;
}

bool can_hold(std::string_view name, std::size_t coordinates) {
  return std::any_of(formats().begin(), formats().end(), [&](const Format& format) {
    return format.name == name && format.maker<LociSheet>() != nullptr && format.holds_coordinates(coordinates);
  });
}

std::future<void> prepare_pictures(const std::set<std::string>& names) {
  const bool any_picture = names.contains("svg") || names.contains("png") || names.contains("pdf");
  return any_picture ? std::async(load_fonts) : std::future<void>();
}

void stage_files(StagedFiles& staged, const Files& files, const std::filesystem::path& directory,
                 std::vector<std::filesystem::path>& paths) {
  for (const File& file : files) {
    staged.add(directory / file.name, file.bytes);
    paths.push_back(directory / file.name);
  }
}

namespace {

/// json, and what is named.
auto named(const std::set<std::string>& names) {
  return [&names](const Format& format) { return format.name == "json" || names.contains(std::string(format.name)); };
}

}  // namespace

std::vector<std::filesystem::path> stage_loci(StagedFiles& staged, const LociSheet& loci,
                                              const std::filesystem::path& directory,
                                              const std::set<std::string>& names) {
  const std::size_t coordinates = loci.map.tower.coordinates.size();
  const auto asked = named(names);
  return stage_wanted(staged, loci, directory, [&](const Format& format) {
    return format.holds_coordinates(coordinates) && (asked(format) || (coordinates == 3 && format.name == "obj"));
  });
}

std::vector<std::filesystem::path> write_loci(const LociSheet& loci, const std::filesystem::path& directory,
                                              const std::set<std::string>& names) {
  StagedFiles staged;
  std::vector<std::filesystem::path> paths = stage_loci(staged, loci, directory, names);
  staged.commit();
  return paths;
}

std::vector<std::filesystem::path> stage_trajectory(StagedFiles& staged, const core::TrajectoryResult& result,
                                                    const std::filesystem::path& directory,
                                                    const std::set<std::string>& names,
                                                    const std::function<void(double, std::string_view)>& progress) {
  return stage_wanted(staged, result, directory, named(names), [&](double part) {
    if (progress) progress(0.5 + 0.5 * part, "files");
  });
}

}  // namespace clearloci::report
