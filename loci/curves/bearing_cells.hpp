// Cells in which a joint bears a force, told by the equilibrium A w = b itself. Where the numerators of both components
// vanish with |A|, as often to a higher order, no enclosure of them tells whether the force is zero in some pose
// around. But a force of zero means A' w' = b, where A' is A without the columns of the force. So there is none where
// the columns of [A' | b] are independent, which they mostly are where A is singular, too: there b is no work of what
// moves freely, and the force is bound to be what balances it. They are independent in every pose of a cell if
//     ||I - L [A' | b]|| < 1    for some L, such as the left inverse at the cell's middle.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/locus_factor.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {

class BearingCells {
 public:
  /// Nothing is computed before it is asked for.
  BearingCells(const core::LocusProblem& problem, const core::WorkingMode& mode) : problem_(problem), mode_(mode) {}

  /// Whether it is proven that in no pose of the cell the joint's force is zero, nor tends to zero where |A| is. Of a
  /// cell without poses this is true.
  bool bear(const std::string& joint, const sheet::PlaneCell& cell);

 private:
  bool bear(const std::vector<int>& places, const sheet::PlaneCell& cell, int halvings);
  bool are_independent(const std::vector<int>& places, const sheet::SheetCell& entered) const;

  const core::LocusProblem& problem_;
  core::WorkingMode mode_;
  std::optional<sheet::SheetProgram> entries_;
  std::optional<sheet::SheetCell> cell_;
};

}  // namespace clearloci::loci
