// Draws a picture that has been laid out on any Cairo surface.
// Private to report/.
#pragma once

#include <cairomm/context.h>

#include "report/layout.hpp"

namespace clearloci::report {

/// One unit of the context is a point. The page is painted white first.
void draw(const Cairo::RefPtr<Cairo::Context>& context, const Subject& subject, const Layout& layout);

}  // namespace clearloci::report
