// Orders of vanishing along a curve on a working mode's sheet (method.md section 10), exactly.
//
// Along an irreducible curve g = 0 a polynomial p in the coordinates vanishes to the order v(p) in which g divides it;
// a root to v(s) = v(Q) / 2, so that on the workspace boundary, where Q = 0, orders count in the root. Of an element N
// = a + b s with s = sigma sqrt(Q), on one side of the curve:
//     v(a) != v(b s)                        -> the smaller of the two
//     equal, and a and b s of one sign      -> v(a): nothing cancels
//     equal, signs differ                   -> v(a^2 - b^2 Q) - v(a): the conjugate a - b s does not cancel
// The signs are those next to the curve, and come out of the same recursion: at its bottom stand polynomials in the
// coordinates, whose cofactor p / g^v has a sign at a point of the curve, told by intervals.
//
// An angle phi, an arc tangent of Y / X, is no algebraic number: it vanishes as Y does where X > 0. Of c0 + c1 phi +
// ... whose terms of the lowest order v differ in sign, the sum of the leading coefficients, lim c / |g|^v, tells
// whether they cancel: where its enclosure excludes zero they do not; else nothing is told.
#pragma once

#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "core/root_tower.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {

/// How an element vanishes towards the curve from one side. `sign`: next to the curve; 0: it is zero there.
struct Germ {
  core::Rational order = 0;
  int sign = 0;

  bool is_zero() const { return sign == 0; }
};

/// An enclosed point of the curve in general position on it: coordinates, each with the ends of its interval.
using EnclosedPoint = std::vector<std::pair<core::Rational, core::Rational>>;

/// The germs of polynomials in the coordinates, on the sides +1 and -1 of a curve; nothing where it is not told.
using CoordinateGerm = std::function<std::optional<Germ>(const core::Polynomial& p, int side)>;

/// The exact algebra that orders along a curve rest on. It is the same at every point of it, in every mode: computed
/// when it is first asked for. May be shared by threads.
class CurveAlgebra {
 public:
  /// `curve`: irreducible, in the coordinates. The tower outlives this.
  CurveAlgebra(const core::RootTower& tower, core::Polynomial curve) : tower_(tower), curve_(std::move(curve)) {}

  struct Divided {
    int order = 0;            ///< how often the curve divides the polynomial
    core::Polynomial rest;    ///< what is left of it then, over `scale`
    core::Rational scale{1};  ///< positive
  };
  const Divided& divided(const core::Polynomial& p);
  struct Conjugate {
    core::Polynomial product;  ///< p times its conjugate by a root, over `scale`
    core::Rational scale{1};   ///< positive
  };
  const Conjugate& conjugate(const core::Polynomial& p, int root);

 private:
  template <class Value>
  using Known = std::list<std::pair<core::Polynomial, Value>>;
  /// What is known of p, or else what `compute` says.
  template <class Value, class Compute>
  const Value& known_or(Known<Value>& values, const core::Polynomial& p, const Compute& compute);

  const core::RootTower& tower_;
  core::Polynomial curve_;
  std::mutex mutex_;  // of what follows
  Known<Divided> divided_;
  Known<Conjugate> conjugates_;
};

/// The algebra of the curves of a tower. May be shared by threads.
class CurveAlgebras {
 public:
  explicit CurveAlgebras(core::RootTower tower) : tower_(std::move(tower)) {}

  /// Not to be used longer than this. `curve`: irreducible, in the coordinates.
  std::shared_ptr<CurveAlgebra> of(const core::Polynomial& curve) const;

 private:
  core::RootTower tower_;
  mutable std::mutex mutex_;
  mutable std::list<std::pair<core::Polynomial, std::shared_ptr<CurveAlgebra>>> curves_;
};

class ArcOrders {
 public:
  /// `curve`: irreducible, in the coordinates; side +1 is where it is positive.
  ArcOrders(const core::RootTower& tower, core::WorkingMode mode, core::Polynomial curve, const EnclosedPoint& at);
  /// The same with what is known of the curve from other points of it.
  ArcOrders(const core::RootTower& tower, core::WorkingMode mode, std::shared_ptr<CurveAlgebra> curve,
            const EnclosedPoint& at);
  /// At what another rule tells the germs of.
  ArcOrders(const core::RootTower& tower, core::WorkingMode mode, CoordinateGerm germ, const EnclosedPoint& at);

  /// Every root's germ is known on every side from which the mode reaches the curve. Required by what follows.
  bool decided() const { return decided_; }
  /// The sides, +1 and -1, on which the mode's workspace is.
  const std::vector<int>& sides() const { return sides_; }
  /// Orders times this are whole numbers: 2 on a simple boundary.
  int ramification() const { return ramification_; }

  /// Whether what is computed is proven not to vanish on the arc. Required: nothing but the tower's variables occurs.
  bool is_nonzero(const core::StraightLine& line) const;
  /// Of a sheet polynomial. Nothing: not decided.
  std::optional<Germ> germ(const core::Polynomial& p, int side);

 private:
  void place_roots(const EnclosedPoint& at);
  bool place_roots_on(int side);
  std::optional<Germ> coordinate_germ(const core::Polynomial& p, int side);
  int sign_at_point(const core::Polynomial& p);
  std::optional<Germ> germ_with_angle(const core::Polynomial& p, int root, int side);
  std::optional<Germ> angle_germ(int root, int side);
  /// The limit of an element over |g|^order on one side, enclosed; nothing where its germ is not told. Required: the
  /// curve's own rule.
  std::optional<sheet::MultiInterval> lead(const core::Polynomial& p, int side);
  std::optional<sheet::MultiInterval> lead_over_root(const core::Polynomial& p, int root, int side);
  std::optional<sheet::MultiInterval> lead_of_angle(int root, int side);
  /// Of several terms of one order.
  std::optional<sheet::MultiInterval> lead_with_angle(const core::Polynomial& p, int root, int side);

  const core::RootTower& tower_;
  core::WorkingMode mode_;
  std::shared_ptr<CurveAlgebra> algebra_;
  CoordinateGerm rule_;                                ///< instead of the curve's own; may be empty
  std::vector<sheet::MultiInterval> at_;               ///< coordinates, then the roots placed so far
  std::list<std::pair<core::Polynomial, int>> signs_;  ///< at the point; of the one side as of the other
  std::map<int, std::vector<Germ>> squares_;           ///< of every side: of the squares placed so far
  std::vector<int> sides_;
  int ramification_ = 1;
  bool decided_ = true;
};

/// A point of a plane curve within `reach` of a given one, enclosed so that no other point of it is on the same
/// vertical or horizontal line there. Nothing where there is none.
std::optional<EnclosedPoint> curve_point(const core::Polynomial& curve, const std::array<double, 2>& near,
                                         double reach);

}  // namespace clearloci::loci
