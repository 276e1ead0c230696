// Answers as files, pictures and texts (docs/results.md). Files are whole or not there, and their bytes depend on the
// answer alone.
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     const clearloci::LocusMap loci = trace_loci(model);
//     for (const auto& file : export_loci(model, loci, "out", {"svg", "dxf"})) std::cout << file << "\n";
//
// Formats are known by name: "json" (always written), "csv", "svg", "png", "pdf", "dxf", "dxf-r12", "geojson", "vtk",
// "stl", "obj", "html". Coordinates in files are m and rad.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"

namespace clearloci {

/// The formats that loci over so many free coordinates can be written in, and those of zones and of verifications.
std::vector<std::string> loci_formats(std::size_t coordinates = 2);
std::vector<std::string> zone_formats();
std::vector<std::string> verification_formats();

/// Write the answer into a folder, which is made where it is missing, and return the files in the order written. The
/// pictures of loci over x and y show the mechanism in a posture. Throw InputError for a format that the answer has
/// not, and where the folder cannot be written.
std::vector<std::filesystem::path> export_loci(const Model& model, const LocusMap& loci,
                                               const std::filesystem::path& folder,
                                               const std::set<std::string>& formats = {"svg", "png", "csv"});
std::vector<std::filesystem::path> export_zones(const ZoneMap& zones, const std::filesystem::path& folder,
                                                const std::set<std::string>& formats = {"svg", "png"});
std::vector<std::filesystem::path> export_verification(const Verification& answer, const std::filesystem::path& folder,
                                                       const std::set<std::string>& formats = {"svg", "png"});

/// A file that is not written.
struct ExportedFile {
  std::string name, bytes;
};

/// What the above would write in these formats alone, in memory.
std::vector<ExportedFile> loci_files(const Model& model, const LocusMap& loci, const std::set<std::string>& formats);
std::vector<ExportedFile> zone_files(const ZoneMap& zones, const std::set<std::string>& formats);
std::vector<ExportedFile> verification_files(const Verification& answer, const std::set<std::string>& formats);

/// The bytes of loci.json, zones.json, verify.json.
std::string to_json(const LocusMap& loci);
std::string to_json(const ZoneMap& zones);
std::string to_json(const Verification& answer);

/// The tables and texts of the program, in UTF-8.
std::string to_table(const LocusMap& loci);
std::string to_table(const ZoneMap& zones);
std::string to_text(const Verification& answer);

/// The working modes that the map speaks of, each once.
std::vector<WorkingMode> modes_of(const LocusMap& loci);

/// The picture of one working mode of the map, as SVG.
std::string to_svg(const LocusMap& loci, const WorkingMode& mode);
std::string to_svg(const ZoneMap& zones, const WorkingMode& mode);
std::string to_svg(const Verification& answer);

}  // namespace clearloci
