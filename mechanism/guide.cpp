#include "mechanism/guide.hpp"

#include <optional>

#include "core/errors.hpp"
#include "core/reduced.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::mechanism {

bool has_guide_ends(const Mechanism& mechanism, const Joint& joint) {
  return is_guide(mechanism, joint) && joint.clearance &&
         core::to_double(value_of(joint.clearance->half_length, mechanism)) > 0;
}

std::vector<core::Quantity> contact_components(const Mechanism& mechanism, const Joint& joint) {
  if (has_guide_ends(mechanism, joint)) return {};
  return is_guide(mechanism, joint) ? reaction_components(mechanism, joint) : force_components(mechanism, joint);
}

bool plays_across(const Mechanism& mechanism, const Joint& joint) {
  return joint.type != JointType::cylindrical || !joint.clearance || value_of(joint.clearance->radial, mechanism) != 0;
}

Rational near_root(const Rational& square) {
  core::ensure(square >= 0, "the root of a number that is not negative");
  if (const std::optional<Rational> exact = core::square_root(square)) return *exact;
  // sqrt(n/d) = sqrt(n d)/d; the integer root of n d 4^bits errs by less than one.
  constexpr unsigned bits = 128;
  const core::Integer radicand = square.get_num() * square.get_den();
  return core::reduced(sqrt(core::Integer(radicand << (2 * bits))), square.get_den() << bits);
}

}  // namespace clearloci::mechanism
