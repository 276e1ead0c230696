// The answer of `clearloci error` over three free coordinates: as JSON, as a text, as volumes and as pictures of
// slices.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "clearloci/error.hpp"

namespace clearloci::report {

/// A layer of cells across a coordinate.
struct VolumeSlice {
  std::size_t across = 2;
  int layer = 0;
};

/// The sizes of the errors of every mode.
nlohmann::ordered_json error_volume_object(const core::VolumeErrors& errors);

/// A table of sizes a mode. Ends with a newline.
std::string error_volume_text(const core::VolumeErrors& errors);

/// Writes error.json, and what is asked for of csv, vtk (one volume a mode) and, a picture a field and slice, png, svg,
/// pdf. Returns the files. No slices: the one across the last coordinate in the middle of the box.
std::vector<std::filesystem::path> write_error_volume(const core::VolumeErrors& errors,
                                                      const std::filesystem::path& directory,
                                                      const std::set<std::string>& formats,
                                                      std::vector<VolumeSlice> slices = {});

}  // namespace clearloci::report
