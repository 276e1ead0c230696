// Answers as files, pictures and texts (results.md). Files are whole or not there, and their bytes depend on the
// answer alone.
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     const clearloci::LocusMap loci = trace_loci(model);
//     for (const auto& file : export_to(model, loci, "out", {"svg", "dxf"})) std::cout << file << "\n";
//     export_to(find_errors(model), "out", {"png", "vtk"});
//
// Formats are known by name: "json" (always written), "csv", "svg", "png", "pdf", "dxf", "dxf-r12", "geojson", "vtk",
// "stl", "obj", "html". Coordinates in files are m and rad.
#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "clearloci/error.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/trajectory.hpp"
#include "clearloci/validate.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"

namespace clearloci {

/// The formats that loci over so many free coordinates can be written in, those of the zones of a mechanism, of
/// verifications, of errors over one to three coordinates, and of trajectories.
std::vector<std::string> loci_formats(std::size_t coordinates = 2);
std::vector<std::string> zone_formats(const Model& model);
std::vector<std::string> verification_formats();
std::vector<std::string> error_formats(std::size_t coordinates = 2);
std::vector<std::string> trajectory_formats();

/// Write the answer into a folder, which is made where it is missing, and return the files in the order written. The
/// pictures of loci over x and y show the mechanism in a posture. Throw InputError for a format that the answer has
/// not, and where the folder cannot be written.
std::vector<std::filesystem::path> export_to(const Model& model, const LocusMap& loci,
                                             const std::filesystem::path& folder,
                                             const std::set<std::string>& formats = {"svg", "png", "csv"});
std::vector<std::filesystem::path> export_to(const Zones& zones, const std::filesystem::path& folder,
                                             const std::set<std::string>& formats = {"svg", "png"});
std::vector<std::filesystem::path> export_to(const Verification& answer, const std::filesystem::path& folder,
                                             const std::set<std::string>& formats = {"svg", "png"});
/// `slices`: over three coordinates the layers of cells that are drawn; none: the one in the middle of the last one.
std::vector<std::filesystem::path> export_to(const Errors& errors, const std::filesystem::path& folder,
                                             const std::set<std::string>& formats = {"png"},
                                             const std::vector<FieldSlice>& slices = {});
std::vector<std::filesystem::path> export_to(const TrajectoryResult& result, const std::filesystem::path& folder,
                                             const std::set<std::string>& formats = {"png", "csv"});

/// A file that is not written.
struct ExportedFile {
  std::string name, bytes;
};

/// What the above would write in these formats alone, in memory.
std::vector<ExportedFile> files_of(const Model& model, const LocusMap& loci, const std::set<std::string>& formats);
std::vector<ExportedFile> files_of(const Zones& zones, const std::set<std::string>& formats);
std::vector<ExportedFile> files_of(const Verification& answer, const std::set<std::string>& formats);
std::vector<ExportedFile> files_of(const Errors& errors, const std::set<std::string>& formats,
                                   const std::vector<FieldSlice>& slices = {});
std::vector<ExportedFile> files_of(const TrajectoryResult& result, const std::set<std::string>& formats);

/// The bytes of loci.json, zones.json, verify.json, error.json, trajectory.json, pose.json, validation.json. Required
/// of a Pose: it is within reach, and where it was iterated it converged.
std::string to_json(const LocusMap& loci);
std::string to_json(const Zones& zones);
std::string to_json(const Verification& answer);
std::string to_json(const Errors& errors);
std::string to_json(const TrajectoryResult& result);
std::string to_json(const Pose& pose);
std::string to_json(const PoseInModes& poses);
std::string to_json(const Validation& validation);

/// The tables and texts of the program, in UTF-8.
std::string to_table(const LocusMap& loci);
std::string to_table(const Zones& zones);
std::string to_text(const Verification& answer);
std::string to_text(const Errors& errors);
std::string to_text(const TrajectoryResult& result);
std::string to_text(const Pose& pose);
std::string to_text(const PoseInModes& poses);
std::string to_text(const Validation& validation);

/// The working modes that the answer speaks of, each once.
std::vector<WorkingMode> modes_of(const LocusMap& loci);
std::vector<WorkingMode> modes_of(const Zones& zones);

/// The picture of one working mode of the answer, as SVG.
std::string to_svg(const LocusMap& loci, const WorkingMode& mode);
std::string to_svg(const Zones& zones, const WorkingMode& mode);
std::string to_svg(const Verification& answer);

}  // namespace clearloci
