// What a task asks of the reactions, as programs over the root tower: what symbolic/ hands to the proof in loci/. The
// load turns from the first to the last one, and every reaction is affine in it,
//     w(t) = ((1 - t) N_first + t N_last) / D,   0 <= t <= 1,
// with one D for all loads, so that two programs a component cover the whole range.
#pragma once

#include <string>
#include <vector>

#include "core/locus_factor.hpp"

namespace clearloci::inline core {

/// Of an effort w that must stay above (`side` 1) or below (-1) a bound: side (w - at) > 0.
struct EffortBound {
  int side = 1;
  Rational at = 0;  ///< N or N m
};

/// A reaction that must not vanish, or must keep a size, or an effort that must keep to its bound.
struct TaskDemand {
  std::string joint;
  Quantity quantity = Quantity::f;  ///< f, an end of a guide, M or F
  Rational least = 0;               ///< N or N m; 0: it must not vanish
  /// Of M or F: then `least` is 0, and what must not vanish nor be negative is side (w - at).
  std::optional<EffortBound> bound = {};
};

/// One demand, of every joint that bears the same: w = 0 for no t, or |w| > least for all. Numbers are those of
/// functions of TaskConditions.
struct TaskCondition {
  std::vector<Vanishing> reactions;
  Rational least = 0;
  /// What all components have in common, under every load: w vanishes with any of these. Only where `least` is 0.
  std::vector<int> factors;
  /// Load by load the components of what is left of w D; nothing where that is a constant other than 0.
  std::vector<std::vector<int>> parts;
  /// Likewise what each direction of TaskConditions adds to w D: N_i of w = N / D + sum l_i N_i / D.
  std::vector<std::vector<int>> directions = {};
  int denominator = -1;  ///< D, where `least` is not 0
  /// Of a couple about an axis u, or a force across it, that is no unit vector: |u|^2, for w is M |u|, or f |u|.
  int squared_axis = -1;
  /// Zero in every pose under one of the loads: the demand is met nowhere.
  std::vector<int> unloaded = {};
};

/// Parts of a load that follow one another, and all that they may be together: how far from the middle, N or N m.
struct LoadBall {
  std::size_t first = 0, count = 0;
  double radius = 0;
};

struct TaskConditions {
  RootTower tower;
  std::vector<StraightLine> functions;  ///< over the tower's variables
  std::vector<int> determinant;         ///< the factors of |A|
  std::vector<int> denominators;        ///< squared distances that the closure divides by
  std::vector<TaskCondition> conditions;
  /// Reactions that take up clearances (method.md section 6), each with its D; nothing is demanded of them. Their
  /// `directions` end with those of a unit force along x and along y on the end effector.
  std::vector<TaskCondition> take_ups = {};
  /// Demands that no pose can fail to meet otherwise: the reaction is zero whatever the pose and the load.
  std::vector<TaskDemand> never_loaded;
  std::size_t loads = 1;
  std::size_t directions = 0;  ///< unit loads, of which any may be added to every load
};

}  // namespace clearloci::inline core
