// PNG, quickly: Cairo's own writer takes twice the time of a whole picture for files of the same size.
// Private to report/.
#pragma once

#include <string>

namespace clearloci::report {

/// The rows of an opaque Raster (`stride` bytes apart) as a PNG of 8 bits a channel, with
/// its resolution in dots per inch.
std::string encode_png(const unsigned char* pixels, int width, int height, int stride, double dots_per_inch);

}  // namespace clearloci::report
