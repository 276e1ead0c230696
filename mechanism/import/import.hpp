// Other programs' files as mechanism files in the drawn form (import.md): the door of this folder. A format is a
// reader of its own and a line in formats.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clearloci::mechanism {

struct ImportOptions {
  std::string clearance =
      {};                 ///< radial, of joints of which the source says none; m, or with its unit; "" for the usual
  std::string side = {};  ///< a second file that belongs to the first, such as the loops of a URDF; its text
  std::string side_file = {};  ///< its name
};

struct Imported {
  std::string text;    ///< a mechanism file in the drawn form, with comments
  std::string format;  ///< "PMKS+"; "" where the text was a mechanism file already
  std::vector<std::string> notes;
};

/// The name of the format that a text is in; "" of a mechanism file, and of what no reader knows.
std::string import_format(std::string_view text);

/// Names of all formats, for messages.
std::vector<std::string> import_formats();

/// Whether what stands in place of a path is an address that holds a mechanism.
bool is_address(std::string_view path);

/// Throws core::InputError that names the element at fault. A mechanism file comes back as it is.
Imported import_text(const std::string& text, const std::string& file, const ImportOptions& options = {});

/// Of a path, or an address; with the side file that lies beside it (robot.yaml of robot.urdf).
Imported import_file(const std::string& path, ImportOptions options = {});

}  // namespace clearloci::mechanism
