// The factors of a locus problem, over the tower, with their implicit polynomials. Private to symbolic/.
#pragma once

#include <array>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/derivation.hpp"
#include "symbolic/fold_quotient.hpp"
#include "symbolic/force_pairs.hpp"
#include "symbolic/limits.hpp"
#include "symbolic/margin_nodes.hpp"
#include "symbolic/margins.hpp"

namespace clearloci::symbolic {

/// Whether a list names a quantity of a joint, however often it vanishes.
bool is_of(const std::vector<core::Vanishing>& list, const std::string& joint, core::Quantity quantity);

/// Required: the factors are collected and selected. The problem has its factors in the order of the calls.
class FactorEmission {
 public:
  explicit FactorEmission(Derivation& d) : d_(d) {}

  void reactions();
  /// The ends of guides along axes of changing length: h N |u| = T behind, h N |u| = -T ahead.
  void moving_guides();
  void margins();
  /// Where r + 1 constraints on r free efforts hold together. Curves on which |A| or a reaction vanishes at every
  /// effort are there already.
  void preload();
  void direct_singularities();
  /// Where a root is zero that other things are divided by: what vanishes there is told by orders.
  void along_divided_roots();
  void boundaries();
  /// Where f1 and f2 of a joint say nothing of its force.
  void undirected();
  /// The planes that forces of three components keep to.
  void force_planes();
  /// What tells whether forces and |A| vanish together.
  void force_probes();
  /// Where both components of a force in the plane vanish, by functions that are lower than their factors.
  void force_pairs();
  /// The roots that margins brought, into the tower and everything that is written over it.
  void append_roots();

 private:
  /// `natural`: the polynomial that gave the sheet; null where there is none.
  void add(core::FactorRole role, const Poly* natural, const Poly& sheet, bool with_implicit, core::LocusFactor common);
  void add_parts(const Poly* natural, const std::vector<SheetFactor>& parts, const core::LocusFactor& common);
  void put_implicit(const SheetFactor& part, core::LocusFactor& factor) const;
  /// How the `part` of a natural polynomial is computed whose other parts are elements of folds; empty where it is not
  /// known.
  core::StraightLine line_of(const Poly& natural, const std::vector<SheetFactor>& parts, std::size_t part);
  /// Places among the problem's pair functions: of one of its factors; of the parts of a natural polynomial over the
  /// tower, null where it vanishes in every pose.
  std::size_t pair_function(std::size_t factor);
  const std::vector<std::size_t>* pair_functions(const Poly& natural);
  /// In the place of two factors, of fx and fy. False, and nothing is added, where both functions are zero along a
  /// curve.
  bool add_pairs(const LowerPair& pair, const std::array<std::size_t, 2>& factors, core::ForcePairs& of_joint);
  /// Which of the problem's factors a reaction's factor is, of a component of a joint's force.
  std::vector<std::size_t> parts_of(std::size_t factor, const std::string& joint, core::Quantity component) const;
  /// Takes what divides |A| too out of what vanishes on a factor over the tower: reactions are quotients.
  std::vector<core::Vanishing> without_determinant(const Poly& sheet, std::vector<core::Vanishing> vanishing);
  int order_along(const FactoredPoly& product, const DividedRoot& divided) const;
  /// Of the numerator of what the joint bears, where the equations' unknown is a part of it over the length of its
  /// axis.
  int order_along(const Reaction& reaction, const DividedRoot& divided) const;
  int order_of_axis(const mechanism::Joint& joint, const DividedRoot& divided) const;
  /// Of the factors from `first` on those with the curves of |A| or of a reaction before.
  void drop_known(std::size_t first);
  /// Of a reaction and not wanted: without the roots along whose zeros it vanishes on boundaries alone.
  void add_rest(const Poly& natural, core::LocusFactor factor);
  /// Which has no zeros.
  bool is_inverse_length(const Poly& p) const;
  /// Bounds of all tensions hold them on either side.
  bool is_passed_by_tensions(const DeterminantPart& part) const;
  /// Where only one value of the free efforts leaves the others finite, which are then open: what is chosen goes
  /// through infinity along the line of the unknowns.
  void name_motors(core::LocusFactor& factor) const;
  /// What is said of the places where the root of a point is zero.
  core::LocusFactor stretched(const TowerRoot& root) const;
  /// The cosine of an angle between the links of a dyad is a polynomial in the coordinates. Computed from the elbow it
  /// is divided by the squared distance of the dyad's ends, and nothing is known of it where they meet.
  bool is_divided_in_vain(const core::Polynomial& square, const core::StraightLine& line) const;
  /// The fold of a length that a point's place is divided by: where one of the two points of `on` passes through the
  /// other, the way between them turns round, and what stands beside it changes sides.
  void add_flip(const TowerRoot& root, const Fold& fold, core::LocusFactor factor);
  /// "B2 on B1, where P has no place", of the ends of a dyad that meet all along a fold.
  std::optional<core::LocusFactor> ends_meet(const TowerRoot& root, const Fold& fold) const;
  /// A side of a fold ends where its square root does: f >= 0 there.
  void add_fold(const Fold& fold);
  /// A sheet ends where a limit does, as at a fold: one more root, of what is left to the limit.
  void add_limits();
  /// Of the factors from `first` on, boundaries: those along one curve become one, with the causes of all.
  void join_boundaries(std::size_t first);
  void add_limit(const LimitCondition& limit);
  /// Where a dyad on others is stretched and where it is folded, each by itself: the product of both, which the square
  /// of its root is, has many more terms, and a norm of twice the degree. False where the square will do.
  bool add_rims(std::size_t index);
  /// Of what is left to the cut of a spring's angle: sin(angle - end) for both ends of its range, times a positive
  /// factor. Empty where no root of the tower is the angle.
  std::vector<core::Rim> sides_of_cut(const std::string& spring) const;
  /// Of what holds along curves inside the workspace.
  std::vector<SheetFactor> parts_of_margin(const Poly& squared) const;
  /// False: the squared margin is not a single curve, or |w| is constant.
  bool add_senses(const TwoSenses& senses, const Poly& squared, core::LocusFactor common);
  /// How often `divisor` divides p.
  static int times_in(Poly p, const Poly& divisor);
  bool is_product_of_denominators(Poly p) const;
  /// The factors size |w| - bound and size |w| + bound over one more root, |w|, without what they share, which is
  /// returned. `parts`: of the product of the two. Nothing where |w| is constant or a side is zero.
  std::optional<Poly> add_both_senses(const TwoSenses& senses, std::vector<SheetFactor> parts,
                                      std::array<core::LocusFactor, 2> factors);
  /// Both senses of size |w| = +-bound, or a note where they are not two curves. What size and bound share, perhaps
  /// over the tower alone, is a curve on which both ends are at theirs.
  void add_ends(const TwoSenses& senses, const std::array<core::LocusFactor, 2>& ends, const std::string& joint);
  /// Where an end bears f_min to either side: h N |u| +- T = +-2 h f_min |A|.
  void add_guide_margins();
  /// The parts over the tower of what a margin's equation was multiplied by, a divisor of |A|, to a power.
  std::vector<std::pair<core::Polynomial, int>> cleared_by(const FactoredPoly& below, int power) const;
  /// With what is known of its nodes, where it is one curve.
  void add_squared_margin(const Margin& margin, const Poly& sheet, const core::LocusFactor& factor);

  Derivation& d_;
  FoldQuotients fold_quotients_{d_.geometry, d_.elimination, d_.lines};
  MarginNodes margin_nodes_{d_.geometry, d_.elimination, d_.lines};
  std::vector<std::array<std::size_t, 2>> ranges_;  ///< of the reactions' factors: their parts among the problem's
  bool is_cut_ = false;        ///< of the reactions' factor that was added last, parts that divide |A| were taken out
  std::set<std::size_t> cut_;  ///< the reactions' factors of which they were
  std::map<std::size_t, std::size_t> pair_functions_of_factors_;
  std::list<std::pair<Poly, std::vector<std::size_t>>> pair_functions_of_natural_;
  std::vector<core::Root> more_roots_;  ///< written in the coordinates and the roots of the geometry
};

}  // namespace clearloci::symbolic
