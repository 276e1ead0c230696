// Draws a picture that has been laid out on any canvas.
// Private to report/.
#pragma once

#include "report/canvas.hpp"

#include "report/layout.hpp"

namespace clearloci::report {

/// One unit is a point. The page is painted white first.
void draw(const Canvas& canvas, const Subject& subject, const Layout& layout);

}  // namespace clearloci::report
