// Other programs' files as mechanism files: PMKS+, Linkage, MJCF, URDF, SDF, DXF, pyslvs and CUIK (import.md).
// Model::read and Model::parse take such files directly; what is here says what became of them.
//
//     const auto own = clearloci::import_file("coupler.linkage2");
//     std::cout << own.text;  // in the drawn form, with comments
//     for (const std::string& note : own.notes) std::cerr << note << '\n';
#pragma once

#include <string>
#include <vector>

#include "clearloci/errors.hpp"

namespace clearloci {

struct ImportRequest {
  std::string clearance = {};  ///< radial, of joints of which the file says none: "20e-6" m, "30 um"; empty: 20e-6 m
  std::string side = {};       ///< text of a second file that belongs to the first: the loops of a URDF
  std::string side_file = {};  ///< its name, for messages
};

struct ImportedFile {
  std::string text;                ///< a mechanism file in the drawn form
  std::string format;              ///< "PMKS+"; empty of a mechanism file, which comes back as it is
  std::vector<std::string> notes;  ///< what was interpreted, and what was left out
};

/// Of a path, or an address of PMKS+; the loops of robot.urdf are read from a robot.yaml beside it. Throws InputError
/// that names the element at fault.
ImportedFile import_file(const std::string& path, const ImportRequest& request = {});
/// The same for a text; `file` is the name that errors show.
ImportedFile import_text(const std::string& text, const std::string& file, const ImportRequest& request = {});

/// The names of the formats.
std::vector<std::string> import_formats();

}  // namespace clearloci
