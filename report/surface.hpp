// A drawing as the bytes of a file.
// Private to report/.
#pragma once

#include "report/canvas.hpp"

#include <functional>
#include <string>

#include "report/picture.hpp"

namespace clearloci::report {

/// Lengths in points. `title` and `description` are for readers that do not see the picture.
struct Page {
  double width = 0, height = 0;
  std::string title, description;
};

/// The same drawing gives the same bytes. PNG has 2 pixels a point.
std::string render(const Page& page, PictureFormat format, const std::function<void(const Canvas&)>& draw);

}  // namespace clearloci::report
