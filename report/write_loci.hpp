// The front door of report/: a traced map in, files out.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/locus_map.hpp"
#include "core/sketch.hpp"

namespace clearloci::report {

enum class FileFormat { json, csv, svg, png, pdf, dxf, dxf_r12, geojson, vtk, stl, obj };

/// "json", "csv", "svg", "png", "pdf", "dxf", "dxf-r12", "geojson", "vtk", "stl", "obj"; nothing for any other name.
std::optional<FileFormat> file_format(std::string_view name);

/// Every name file_format knows, in the order above.
std::vector<std::string> file_format_names();

/// json, svg, png, csv.
std::set<FileFormat> default_file_formats();

using core::ModeSketch;

/// Whether loci over so many free coordinates can be written so: dxf and geojson hold curves, stl and obj surfaces.
bool can_hold(FileFormat format, std::size_t coordinates);

/// Writes `loci.json`, `loci.csv`, `loci.dxf`, `loci-r12.dxf`, `loci.geojson`, `loci.vtp`, `loci.obj` as asked, each
/// for all modes, and one picture a mode: `loci.svg`, or `loci-left-right.svg`, ... where the map has several. Of
/// surfaces `loci.obj` holds the triangles that `loci.json` speaks of and is always written; stl is a file a surface,
/// `loci-s1-contact-loss.stl`. `sketches` may be empty
/// or lack modes. Every file is whole or not there. Returns the files in the order written; throws core::InputError
/// where the directory cannot be written.
std::vector<std::filesystem::path> write_loci(const core::LocusMap& map, const std::vector<ModeSketch>& sketches,
                                              const std::filesystem::path& directory,
                                              const std::set<FileFormat>& formats);

}  // namespace clearloci::report
