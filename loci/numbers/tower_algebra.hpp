// Arithmetic of polynomials in the roots of a tower: N = a + b s, s^2 = Q.
#pragma once

#include <optional>
#include <utility>

#include "core/root_tower.hpp"

namespace clearloci::loci {

/// N = a + b s: a and b, free of the variable. Required: p linear in it.
std::pair<core::Polynomial, core::Polynomial> split(const core::Polynomial& p, int variable);

/// The same element without powers of the roots above the first.
core::Polynomial reduce(core::Polynomial p, const core::RootTower& tower);

/// The last root that occurs in p; -1: none.
int top_root(const core::Polynomial& p, const core::RootTower& tower);

/// Whether an element holds an angle: then it is no algebraic number, and has no norm.
bool has_angle(const core::Polynomial& p, const core::RootTower& tower);
/// Whether root j is no angle itself, and its square holds one: no polynomial tells where it vanishes.
bool is_root_of_angle(const core::RootTower& tower, std::size_t j);

/// Product of an element with its conjugates under the sign of root `root`: a^2 - b^2 Q.
core::Polynomial conjugate_product(const core::Polynomial& p, int root, const core::RootTower& tower);

/// Every root eliminated: in the coordinates alone, zero wherever p is. Required: no angle.
core::Polynomial norm(core::Polynomial p, const core::RootTower& tower);

/// p over a divisor, where that has polynomials in the coordinates for coefficients; nothing else. Required: no angle,
/// the divisor is not zero.
std::optional<core::Polynomial> quotient(core::Polynomial p, core::Polynomial divisor, const core::RootTower& tower);

/// A bound on the degree of an element's norm, before anything is divided out.
double norm_degree(const core::Polynomial& p, const core::RootTower& tower);

}  // namespace clearloci::loci
