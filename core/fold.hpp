// Sides of a fold (symbolic/locus_problem.hpp).
#pragma once

namespace clearloci::inline core {

/// The name of a root that places nothing: its square is positive on one side of a fold and keeps the sheet there.
inline constexpr const char* fold_name = "fold";
/// Of a root that places nothing either: its square is what is left to a limit of the workspace.
inline constexpr const char* limit_name = "limit";

}  // namespace clearloci::inline core
