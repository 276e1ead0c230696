// A rectangle of the plane or of a patch, enclosed by its sides.
#pragma once

#include "core/interval.hpp"

namespace clearloci::loci::sheet {

struct PlaneCell {
  Interval x, y;
};

}  // namespace clearloci::loci::sheet
