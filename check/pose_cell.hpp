// Reactions over a cell of poses, from its equations: affine forms in the coordinates of the cell, in doubles, with all
// rounding in their radius. Private to check/.
#pragma once

#include <optional>
#include <vector>

#include "check/pose_equations.hpp"

namespace clearloci::check {

/// Every value is c + sum a_i e_i within r, where |e_i| <= 1.
struct PoseForm {
  double c = 0;
  std::vector<double> a;
  double r = 0;

  double spread() const;
  double magnitude() const;
  double lower() const { return c - (spread() + r) * (1 + 0x1p-40); }
};

/// What a cell was found to be.
struct PoseCellProof {
  bool regular = false;         ///< A is, all over it
  std::vector<bool> demands;    ///< the reaction keeps above its least, and points into one half space
  std::vector<double> spreads;  ///< what each coordinate does to it: where to cut
  bool holds() const;
};

/// `offsets`: X_c - m_c of the cell.
PoseCellProof prove_cell(const PoseEquations& equations, const std::vector<core::TaskDemand>& demands,
                         const Jet::Offsets& offsets);

}  // namespace clearloci::check
