// The nodes of margin curves. A w = b has a solution with bounded w next to |A| = 0 only where b does no work in the
// motion that is free there: on |A| = 0 all numerators are N = (ν·b) u, ν the motion and u the forces that balance
// without a load. At ν·b = 0 they vanish together, and |f|^2 = f_min^2, cleared of |A|^2, has a node. By Cramer's rule
// under a second load b',
//     N_x N'_y - N_y N'_x = |A| |A_xy|,   A_xy: A with columns x and y replaced by b and b'
// so that there N_x = |A| = 0 with N'_x != 0 means N_y = 0. Private to symbolic/.
#pragma once

#include <optional>

#include "core/locus_factor.hpp"
#include "symbolic/margins.hpp"
#include "symbolic/straight_lines.hpp"

namespace clearloci::symbolic {

class MarginNodes {
 public:
  MarginNodes(const Geometry& geometry, const Elimination& elimination, StraightLines& lines)
      : geometry_(geometry), elimination_(elimination), lines_(lines) {}

  struct Form {
    core::StraightLine line;  ///< of |w|^2 - (f_min |A|)^2
    core::NodeForm nodes;
  };
  /// None where a part is zero or a number in every pose.
  std::optional<Form> of(const Margin& margin);

  /// Every reaction under b'.
  const std::vector<Reaction>& probed();

 private:
  const Geometry& geometry_;
  const Elimination& elimination_;
  StraightLines& lines_;
  std::optional<std::vector<Reaction>> probed_;  ///< made where it is asked for
};

}  // namespace clearloci::symbolic
