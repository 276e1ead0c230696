// What Cairo's SVG still lacks.
// Private to report/.
#pragma once

#include <string>

namespace clearloci::report {

/// `svg` as Cairo wrote it, with at most 3 decimals in lengths (its own grid is 1/256 pt), without the identifiers it
/// numbers through the whole process (two runs would differ), and with a title and a description for readers that do
/// not see the picture: Cairo writes text as outlines.
std::string finish_svg(const std::string& svg, const std::string& title, const std::string& description);

/// &, <, >, " and ' as entities.
std::string escape_xml(const std::string& text);

}  // namespace clearloci::report
