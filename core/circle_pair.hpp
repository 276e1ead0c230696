// Two circles that only together have rational coefficients, such as the direct singularities of a symmetric 5R.
// Private to core/.
#pragma once

#include <optional>

#include "core/locus_map.hpp"

namespace clearloci::inline core {

/// rational + sign multiple sqrt(n), to the nearest double or its neighbour.
double to_double(const QuadraticNumber& value, const Integer& n, int sign);

/// `quartic`: irreducible over Q, of total degree 4 in (x, y). With S = x^2 + y^2 it is a pair where
///     quartic / c = (S + u)^2 - n l^2 = (S + u - sqrt(n) l) (S + u + sqrt(n) l),   u and l linear,
/// and both circles have real points.
std::optional<CirclePairForm> recognise_circle_pair(const Polynomial& quartic);

}  // namespace clearloci::inline core
