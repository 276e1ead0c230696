// The answer of `clearloci error`: as JSON, as a text, as files and as pictures.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "clearloci/error.hpp"
#include "report/answers.hpp"
#include "report/picture.hpp"

namespace clearloci::report {

/// The sizes of the errors of every mode, and in its zones where there are any; over a single coordinate the jumps and
/// the samples, too.
nlohmann::ordered_json error_object(const core::Errors& errors);

/// A table of sizes a mode, of every zone, and over a single coordinate of the jumps. Ends with a newline.
std::string error_text(const core::Errors& errors);

/// What errors over so many coordinates can be written as: vtk has no picture of a line.
std::vector<std::string> error_formats(std::size_t coordinates);

/// A table a mode, in the units of the file.
Files error_csv(const ErrorSheet& sheet);
/// A grid a mode, in SI units; over two and three coordinates.
Files error_vti(const ErrorSheet& sheet);
/// Over a single coordinate three plots a mode: errors, take-up, reactions. Else a map a field, with the loci over it;
/// over three coordinates a map for each slice, without slices for the one across the last coordinate in the middle of
/// the box.
Files error_pictures(const ErrorSheet& sheet, PictureFormat format);

}  // namespace clearloci::report
