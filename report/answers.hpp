// What is written to files: answers with what their pictures show besides, and the files that are made of them.
#pragma once

#include <string>
#include <vector>

#include "clearloci/error.hpp"
#include "core/sketch.hpp"

namespace clearloci::report {

struct File {
  std::string name, bytes;
};
using Files = std::vector<File>;

struct LociSheet {
  const core::LocusMap& map;
  const std::vector<core::ModeSketch>& sketches;  ///< may be empty or lack modes
  const core::Zones* zones = nullptr;             ///< that the page shows; may be null
};

struct ErrorSheet {
  const core::Errors& errors;
  std::vector<core::FieldSlice> slices = {};  ///< that are drawn over three coordinates; empty: one in the middle
};

}  // namespace clearloci::report
