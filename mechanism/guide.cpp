#include "mechanism/guide.hpp"

#include "mechanism/evaluate.hpp"

namespace clearloci::mechanism {

bool has_guide_ends(const Mechanism& mechanism, const Joint& joint) {
  return mechanism.space == Space::planar && joint.type == JointType::prismatic && joint.clearance &&
         core::to_double(value_of(joint.clearance->half_length, mechanism)) > 0;
}

}  // namespace clearloci::mechanism
