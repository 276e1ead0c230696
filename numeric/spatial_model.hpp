// The equations of a spatial mechanism compiled to floating point. Every joint bears a force and a couple written in
// Cartesian components, which vary smoothly with the pose; what it does not bear is an equation of its own:
//     six rows a link:         A w = -w_e         force (N), then moment about the end-effector point (N m)
//     free along an axis u:    u · f = 0          prismatic and cylindrical joints that are not actuated
//     free about an axis u:    u · m = 0          cylindrical joints, and revolute ones that are not actuated
//     actuated along, about u: F = u · f, M = u · m
// A universal joint bears the one couple T (u × v)/|u × v|. The determinant is that of A alone in the orthonormal form
// of spatial.hpp: each equation stands at the row of the unknown that it disposes of, and contributes the factor one.
// Private to numeric/.
#pragma once

#include "numeric/model.hpp"

namespace clearloci::numeric {

/// Requires a spatial mechanism with as many unknowns as equations.
NumericModel compile_spatial(const mechanism::Mechanism& mechanism);

}  // namespace clearloci::numeric
