// Reactions over a cell of poses, from its equations: affine forms in the coordinates of the cell, in doubles, with all
// rounding in their radius. Private to check/.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "check/pose_equations.hpp"

namespace clearloci::check {

/// Coordinates of the cell that stand one behind the other and lie in a ball around the middle, not in a box.
struct LoadBall {
  std::size_t first = 0, count = 0;
};

/// What a cell was found to be.
struct PoseCellProof {
  bool regular = false;       ///< A is, all over it
  std::vector<bool> demands;  ///< the reaction keeps above its least, and points into one half space
  bool positive = false;      ///< all that the model itself asks to be
  bool broken = false;        ///< something that the model itself asks to be positive is negative all over it
  /// Of every demand what its components are within; empty where A is not known to be regular.
  std::vector<std::vector<std::array<double, 2>>> components;
  std::vector<double> spreads;  ///< what each coordinate does to it: where to cut
  bool holds() const;
};

/// Of several choices of efforts, each with its equations: of all that is between these, too, since a reaction that is
/// above its least along one way under each of them is so under all convex combinations. Components are of the first.
/// `offsets`: X_c - m_c of the cell. `balls`: by their first coordinates.
PoseCellProof prove_cell(const std::vector<PoseEquations>& choices, const std::vector<core::TaskDemand>& demands,
                         const Jet::Offsets& offsets, const std::vector<LoadBall>& balls = {});

}  // namespace clearloci::check
