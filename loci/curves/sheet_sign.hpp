// Exact signs of sheet polynomials along the edges of an arrangement.
//
// An element of the tower is N = a + b s with s = sigma sqrt(Q), and its sign follows from those of lower elements:
//     sgn(a) and sgn(b s) agree            -> that sign
//     they differ                          -> sgn(a) sgn(a^2 - b^2 Q)
// At the bottom stand polynomials in (x, y): their sign at a point of an irreducible curve is decided by intervals of
// doubles, then of 512 bits, and where both fail by whether the curve is a factor (then it is 0 all along).
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "core/interval.hpp"
#include "core/root_tower.hpp"
#include "loci/curves/curve_arrangement.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {

class SheetSigns {
 public:
  SheetSigns(const core::RootTower& tower, const CurveArrangement& arrangement);

  /// Registers a sheet polynomial, in (x, y, s1...sm).
  int add(const core::Polynomial& sheet);

  /// -1, 0 or +1 in the interior of an edge; 0 means 0 all along it. None: not decided at any of several points with
  /// the digits that intervals have. Required: the mode's squares are >= 0 there.
  std::optional<int> sign(int sheet, const core::WorkingMode& mode, int edge);

  /// Sign of the j-th root's square in the interior of an edge; required: those of earlier roots are >= 0.
  std::optional<int> square_sign(int root, const core::WorkingMode& mode, int edge);

 private:
  struct Leaf {
    core::Polynomial polynomial;  ///< in (x, y)
    std::vector<core::Interval> coefficients;
    std::map<int, bool> vanishes_on;  ///< curve to whether it is a factor
    std::vector<signed char> known;   ///< sign at the first sample of every edge; `unknown`
  };
  struct Node {
    int root = -1;  ///< -1: a leaf
    int leaf = -1;
    int a = -1, b = -1, norm = -1;
  };
  struct Sample {
    std::array<core::Interval, 2> coarse;
    std::array<sheet::MultiInterval, 2> fine;
  };

  int build(const core::Polynomial& p);
  std::optional<int> node_sign(int node, const core::WorkingMode& mode, int edge, int attempt);
  std::optional<int> leaf_sign(int leaf, int edge, int attempt);
  std::optional<int> root_sign(int root, const core::WorkingMode& mode, int edge, int attempt);
  const Sample& sample(int edge, int attempt);

  const core::RootTower& tower_;
  const CurveArrangement& arrangement_;
  std::vector<Node> nodes_;
  std::deque<Leaf> leaves_;
  std::vector<int> squares_;
  std::map<std::pair<int, int>, Sample> samples_;
};

}  // namespace clearloci::loci
