// The range of forces of a task file: `loads_from: [[0, -80], [20, -100]]`. Private to mechanism/.
#pragma once

#include <utility>
#include <vector>

#include "mechanism/reader.hpp"

namespace clearloci::mechanism {

/// The first and the last force, of two components in the plane and of three in space, N. Throws core::InputError where
/// the mechanism has not one force that they could take the place of, and where they are opposite or zero.
std::pair<std::vector<core::Rational>, std::vector<core::Rational>> read_loads_from(const Mechanism& mechanism,
                                                                                    const Value& value);

}  // namespace clearloci::mechanism
