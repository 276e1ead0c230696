// Efforts that are free at one pose, and all bounds that efforts have there: a polytope
//     offset_i + slope_i . lambda >= 0,       two rows an effort that has bounds, one a bound
// (docs/background/method.md section 15). Private to analysis/.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/rational.hpp"
#include "mechanism/mechanism.hpp"
#include "numeric/reactions.hpp"

namespace clearloci {

/// side (effort - bound) as it depends on the free efforts, N or N m.
struct EffortRow {
  mechanism::JointIndex joint = 0;
  int side = 1;
  double width = 1;  ///< between the two bounds
  numeric::Bounded offset;
  std::vector<numeric::Bounded> slope;  ///< one a free effort
};

/// Of a mechanism whose free efforts are those of joints_without_preload(); nothing where |A| cannot be told from zero.
std::optional<std::vector<EffortRow>> effort_rows(const mechanism::Mechanism& mechanism,
                                                  std::span<const numeric::Bounded> at, std::span<const int> sides);

/// Rows in exact numbers: those that doubles are.
struct EffortPolytope {
  struct Row {
    core::Rational offset;
    std::vector<core::Rational> slope;
  };
  std::vector<Row> rows;
  std::size_t efforts = 0;

  /// Of rows measured in their widths the place farthest within all of them, and how far; below zero: there is none
  /// within. `multipliers`: y >= 0 of the dual program, one a row; `binding`: those that are not zero.
  struct Deepest {
    core::Rational depth;
    std::vector<core::Rational> at;
    std::vector<std::size_t> binding;
    std::vector<core::Rational> multipliers;
  };
  std::optional<Deepest> deepest(const std::vector<core::Rational>& widths) const;

  /// Where a sum of efforts is least, and what binds it.
  std::optional<Deepest> least(const std::vector<core::Rational>& of) const;
};

EffortPolytope polytope_of(const std::vector<EffortRow>& rows);
std::vector<core::Rational> widths_of(const std::vector<EffortRow>& rows);

}  // namespace clearloci
