// What a picture shows of a task that is verified.
#pragma once

#include "core/locus_map.hpp"

namespace clearloci::report {

struct TaskMark {
  core::Polyline outline;  ///< closed by its first point, or a path
  bool filled = true;      ///< false: a path
  bool verified = false;
  double margin = 0;      ///< m, drawn around the outline
  core::Polyline points;  ///< ringed: the nearest point of a locus, or the witness
};

}  // namespace clearloci::report
