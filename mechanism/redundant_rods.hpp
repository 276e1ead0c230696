// A rod more than the geometry needs, with the axial force that is chosen for it:
//     CD: {points: [C, D], redundant: true}
// is read as a rod with a telescope at its second point, whose actuator has a free effort and which the rest of the
// mechanism keeps at one length. Private to mechanism/.
#pragma once

#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism {

/// The document with its redundant rods written so: a link CD_end at D, and a joint CD along the rod, whose effort is
/// the force that the rod pulls with, N. Throws core::InputError for a link that is no rod between two joints.
Value telescoped_rods(const Value& document);

}  // namespace clearloci::mechanism
