// The reactions of a joint by what they are.
#pragma once

#include <array>
#include <string>

namespace clearloci::core {

/// `f`: every force component of a joint together; `M`: an actuator's couple; `F`: an actuator's axial force. Of a
/// planar prismatic joint `N` is the normal force and `T` the couple. `fx` to `mz`: components of the force and the
/// couple.
enum class Quantity { f, M, F, N, T, fx, fy, fz, mx, my, mz };

/// Every quantity, in the order of tables and legends.
inline constexpr std::array all_quantities = {Quantity::f,  Quantity::N,  Quantity::T,  Quantity::M,
                                              Quantity::F,  Quantity::fx, Quantity::fy, Quantity::fz,
                                              Quantity::mx, Quantity::my, Quantity::mz};

/// "f", "M", ..., as in loci.json.
std::string to_string(Quantity quantity);

}  // namespace clearloci::core
