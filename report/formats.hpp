// The one registry of export formats: a line a format, a column an answer. What the commands offer, and
// clearloci/export.hpp, is read off it; a new format is a file that makes its bytes and a line in formats.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "clearloci/error.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/trajectory.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"
#include "core/sketch.hpp"

namespace clearloci::report {

struct File {
  std::string name, bytes;
};
using Files = std::vector<File>;

/// Loci with what their pictures show besides.
struct LociSheet {
  const core::LocusMap& map;
  const std::vector<core::ModeSketch>& sketches;  ///< may be empty or lack modes
};

/// How each answer is written; null where the format does not hold it.
struct Format {
  std::string_view name;
  bool (*holds_coordinates)(std::size_t count) = nullptr;  ///< loci over so many free ones
  Files (*loci)(const LociSheet&) = nullptr;
  Files (*zones)(const core::ZoneMap&) = nullptr;
  Files (*verification)(const core::Verification&) = nullptr;
  Files (*error)(const core::ErrorMap&) = nullptr;
  Files (*coordinate_errors)(const core::CoordinateErrors&) = nullptr;
  Files (*trajectory)(const core::TrajectoryResult&) = nullptr;
  Files (*pose)(const core::Pose&) = nullptr;
};

/// In the order in which files are written; json is the first.
const std::vector<Format>& formats();

enum class Answer { loci, zones, verification, error, coordinate_errors, trajectory, pose };

/// The names of the formats that an answer can be written in.
std::vector<std::string> format_names(Answer answer);

/// Whether loci over so many free coordinates can be written so: dxf and geojson hold curves, stl and obj surfaces.
bool can_hold(std::string_view format, std::size_t coordinates);

/// Write the answer in the formats named, and as json always; of surfaces also `loci.obj`, which holds the triangles
/// that `loci.json` speaks of. Files are `loci.json`, `loci.csv`, `loci-r12.dxf`, ..., each for all modes; pictures one
/// a mode: `loci.svg`, or `loci-left-right.svg`, ... where there are several; stl a file a surface,
/// `loci-s1-contact-loss.stl`. Every file is whole or not there. Returns the files in the order written; throws
/// core::InputError where the directory cannot be written. Names that the answer has no format for are passed over.
std::vector<std::filesystem::path> write_loci(const LociSheet& loci, const std::filesystem::path& directory,
                                              const std::set<std::string>& names);
std::vector<std::filesystem::path> write_zones(const core::ZoneMap& map, const std::filesystem::path& directory,
                                               const std::set<std::string>& names);
std::vector<std::filesystem::path> write_verification(const core::Verification& result,
                                                      const std::filesystem::path& directory,
                                                      const std::set<std::string>& names);
/// Of maps `error.json`, `error.csv`, `error-dx.png`, ...; over a single coordinate also `take-up.png`, ...
std::vector<std::filesystem::path> write_error(const core::ErrorMap& errors, const std::filesystem::path& directory,
                                               const std::set<std::string>& names);
std::vector<std::filesystem::path> write_coordinate_errors(const core::CoordinateErrors& result,
                                                           const std::filesystem::path& directory,
                                                           const std::set<std::string>& names);
/// `progress`: from 0.5 on.
std::vector<std::filesystem::path> write_trajectory(
    const core::TrajectoryResult& result, const std::filesystem::path& directory, const std::set<std::string>& names,
    const std::function<void(double fraction, std::string_view stage)>& progress = {});
std::vector<std::filesystem::path> write_pose(const core::Pose& pose, const std::filesystem::path& directory,
                                              const std::set<std::string>& names = {});

}  // namespace clearloci::report
