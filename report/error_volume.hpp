// The answer of `clearloci error` over three free coordinates: as JSON, as a text, as volumes and as pictures of
// slices.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "clearloci/error.hpp"
#include "report/answers.hpp"
#include "report/picture.hpp"

namespace clearloci::report {

/// The sizes of the errors of every mode.
nlohmann::ordered_json error_volume_object(const core::VolumeErrors& errors);

/// A table of sizes a mode. Ends with a newline.
std::string error_volume_text(const core::VolumeErrors& errors);

/// Bytes of a table a mode and of a volume a mode, and of a picture a field and slice; without slices of the one across
/// the last coordinate in the middle of the box.
Files volume_csv(const VolumeSheet& sheet);
Files volume_vti(const VolumeSheet& sheet);
Files volume_pictures(const VolumeSheet& sheet, PictureFormat format);

}  // namespace clearloci::report
