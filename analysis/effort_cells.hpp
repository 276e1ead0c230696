// Several free efforts at one pose (docs/background/method.md section 15): every scalar reaction and every bound is
// affine in them,
//     a_i + B_i . lambda,
// and the choices that keep a demand from vanishing, or above its least size, are the cells of this arrangement, one a
// pattern of signs. Private to analysis/.
#pragma once

#include <optional>
#include <vector>

#include "clearloci/zones.hpp"
#include "core/task_conditions.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci {

/// Which choices are feasible; forces of pins, of several components, fail at single choices and are left out. Nothing
/// where |A| cannot be told from zero.
std::optional<core::ZonePreload> efforts_in_cells(const mechanism::Mechanism& mechanism,
                                                  const std::vector<double>& pose, const std::vector<int>& sides,
                                                  const std::vector<core::TaskDemand>& demands,
                                                  const LociRequest& request);

}  // namespace clearloci
