// What a factor says of the lines that links, guides and loads act along: "links C1B1, C2B2 and C3B3 meet in one point
// or are parallel", "the loads on boom and arm balance about O". Private to symbolic/.
//
// A line along d through p has the moment m = (p - E) x d about the end effector's point E, as the rows of the
// Newton-Euler equations have. In the plane three of them are concurrent or parallel where
//     |d1 d2 d3; m1 m2 m3| = 0
// and loads whose sum is F, with the moment M, balance about p where M = (p - E) x F.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "symbolic/geometry.hpp"
#include "symbolic/newton_euler.hpp"
#include "symbolic/residue_pose.hpp"

namespace clearloci::symbolic {

/// Conditions are never written out: each is known by its values at two poses modulo a prime of 61 bits, as is the
/// factor. A condition and a factor that are no multiples of each other have the same ratio of both by an accident of
/// a chance below 1e-15, and what would be wrong is a caption.
class LinesOfAction {
 public:
  LinesOfAction(const Geometry& geometry, const NewtonEulerEquations& equations);

  /// The wording of the condition that a factor states, up to a constant; empty where it states none of them.
  /// `loads`: whether it may speak of loads.
  std::string of(const Poly& factor, bool loads) const;

 private:
  static constexpr std::size_t poses = 2;
  using Values = std::array<Residue, poses>;
  struct Vector {
    std::array<Values, 3> along;
  };
  enum class Kind { link, axis, load };
  struct Line {
    Kind kind;
    std::string name;
    Vector way;
    Values moment;      ///< in the plane
    bool part = false;  ///< a line through two points of a link that has more
  };
  /// Of some lines, "parallel"; words are put together when they are asked for.
  struct Condition {
    Values values;
    std::vector<const Line*> lines;
    std::string words;
    bool of_loads;
  };

  Values values(const Poly& p) const;
  Values values(const GiNaC::ex& expression) const;
  Vector vector(const mechanism::VectorExpression& written) const;
  Vector way(mechanism::PointIndex from, mechanism::PointIndex to) const;
  Values moment(mechanism::PointIndex at, const Vector& along) const;
  void add_links();
  void add_axes();
  void add_loads(const NewtonEulerEquations& equations);
  void add(const Values& condition, std::vector<const Line*> lines, const char* words, bool of_loads = false);
  void add_springs();
  void add_directions();
  void add_pairs();
  void add_triples();
  void add_universals();
  void add_balances();

  static Values product(const Values& a, const Values& b);
  static Values sum(const Values& a, const Values& b);
  static Values difference(const Values& a, const Values& b);
  static Values dot(const Vector& a, const Vector& b);
  static Vector cross(const Vector& a, const Vector& b);
  static std::string listed(const std::vector<const Line*>& lines);
  std::string loads_on(const std::vector<std::size_t>& links) const;
  std::vector<std::vector<std::size_t>> loaded_sets() const;

  const Geometry& geometry_;
  bool planar_ = true;
  std::array<ResiduePose, poses> at_;
  std::vector<Vector> points_;
  std::vector<Line> lines_;  ///< all there before the conditions, which point at them
  /// Of every link that bears any, the sum of its loads and weights, and of springs and motors of known effort.
  struct Resultant {
    std::size_t link;
    Vector force;
    Values moment;
  };
  std::vector<Resultant> resultants_;
  std::vector<Condition> conditions_;
};

}  // namespace clearloci::symbolic
