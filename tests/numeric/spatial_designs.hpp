// Files of spatial mechanisms with random numbers: slices z = const over (x, y), every joint with its clearance.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace clearloci::test {

/// 6-UPS: bases and platform joints near a ring, the platform's turned by a random orientation. `with_weights`: the
/// platform, the rods and one cylinder have masses.
std::string random_gough_stewart(std::mt19937& random, bool with_weights);

/// Tsai's translational 3-UPU with unequal legs.
std::string random_three_upu(std::mt19937& random);

/// 3-RCU with actuated revolute joints on the ground, or (one in two) 3-RPS with passive revolute and actuated
/// prismatic joints in the legs: axes that move, forces and couples across them. The platform moves across the legs'
/// first axes, and `th`, a parameter, is its turn about them. The cranks are loaded at their bases.
std::string random_three_leg(std::mt19937& random);

/// 3-RUU and 3-PUU: elbows built as dyads, carriages as sliders, unequal legs whose planes stand anywhere.
/// `with_weights`: forearms and the platform have masses.
std::string random_delta(std::mt19937& random, bool sliders, bool with_weights);

}  // namespace clearloci::test
