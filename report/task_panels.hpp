// A task as a picture: what it is seen as along all coordinates but one or two.
// Private to report/.
#pragma once

#include <string>

#include "clearloci/verify.hpp"
#include "report/picture.hpp"

namespace clearloci::report {

/// The task with its proven margin, the nearest locus that was found, the witness and what stayed open: over one
/// coordinate on a strip, over more projected along the others, one panel a pair of lengths and a pair of angles (a
/// single one has panels with those of the other kind). In the units of the mechanism file.
std::string task_panels(const core::Verification& result, PictureFormat format);

}  // namespace clearloci::report
