// Sums of given functions that stay within given bounds at given places.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace clearloci::numeric {

/// Factors c of the functions, such that max_i |sum_t c_t rows[i][t] - m_i| / h_i is nearly least, where m_i is the
/// middle of bounds[i] and h_i half its width: Lawson's algorithm (Rice and Usow, Math. Comp. 22, 1968), iteratively
/// reweighted least squares. rows: one a place, each with a value a function; at least one of both. None where the
/// bounds of a place have no width.
std::optional<std::vector<double>> weighted_fit(const std::vector<std::vector<double>>& rows,
                                                std::span<const std::array<double, 2>> bounds);

}  // namespace clearloci::numeric
