// Closure (method.md section 1): every point in natural coordinates and over the tower of square roots.
// Private to symbolic/.
//
//   D = |P - A|^2,  k = a^2 - b^2 + D,  Q = 4 a^2 D - k^2,  s^2 = Q
//   B = A + (k (P - A) +- s J (P - A)) / (2 D),   J = [[0, -1], [1, 0]]
//
// In space, where B turns about an axis n through A, with N = n . n and h = n . (P - A):
//
//   D = N |P - A|^2 - h^2,  k = a^2 - b^2 + |P - A|^2,  s^2 = 4 a^2 D - N k^2
//   B = A + (k (N (P - A) - h n) +- s n x (P - A)) / (2 D)
//
// Points are kept homogeneous, (X : Y : W) with X, Y, W polynomials in the coordinates and the roots and W >= 0 (a
// product of squared distances), so that no division is ever needed and no sign is lost.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/angle_chart.hpp"
#include "core/root_tower.hpp"
#include "mechanism/mechanism.hpp"
#include "symbolic/ring.hpp"

namespace clearloci::symbolic {

/// x = X / W, y = Y / W, z = Z / W over the tower; Z = 0 in the plane.
struct TowerPoint {
  Poly x, y, w, z;  // in this order, so that two numbers and a denominator make a point of the plane
  TowerPoint(Poly x_, Poly y_, Poly w_) : x(std::move(x_)), y(std::move(y_)), w(std::move(w_)), z(w.ring()) {}
  TowerPoint(Poly x_, Poly y_, Poly z_, Poly w_)
      : x(std::move(x_)), y(std::move(y_)), w(std::move(w_)), z(std::move(z_)) {}
};

/// s = +-sqrt(square); `variable` is its index in the ring. `scale`, `scale_divisor`: both positive; s is the root of a
/// dyad (straight_lines.hpp), or what a slider or a length is found with, times their quotient.
struct TowerRoot {
  mechanism::PointIndex point = 0;  ///< -1 of the length of a vector
  int variable = 0;
  core::RootRole role = core::RootRole::working_mode;
  Poly square;
  Poly scale = Poly(square.ring(), 1);
  Poly scale_divisor = Poly(square.ring(), 1);
  /// Of a root that depends on earlier ones (dependent_roots.hpp): the root itself over the tower. Its `variable` then
  /// stands for the root of the number `square`, and occurs nowhere if that is 1.
  std::optional<Poly> value = {};
  /// Whether it is what is left of a root of f^2 R, R in place of its square: `scale_divisor` holds f then, which is
  /// positive on the side of the fold f = 0 (Fold).
  bool is_cut = false;
  /// Of an angle, which is none of a polynomial: positive multiples of its cosine and sine (core::Root).
  std::vector<Poly> cosine_and_sine = {};

  bool is_angle() const { return !cosine_and_sine.empty(); }
};

/// Where a root that depends on earlier ones is e = f times roots, and f takes both signs: |f| is f on one side of
/// f = 0 and -f on the other. There the leg is stretched or folded, but the mechanism goes on. Or where a root is |f|
/// times another one, as of equal links whose ends meet all along a curve: the two modes meet there.
struct Fold {
  std::size_t root = 0;  ///< by its place in Geometry::roots
  Poly where;            ///< f over the tower, with the sign that it has on the side chosen: positive there
};

/// Of the sheets of a tower with dependent roots the one on which the points are placed.
struct SheetChoice {
  std::vector<int> sides = {};   ///< one a dyad or slider, as mechanism::working_mode; empty: the file's
  std::vector<int> halves = {};  ///< one a fold, in the order in which they are met: the sign of its f; +1 beyond
  bool all_sheets = false;       ///< dependent roots stay as they are: for enclosures, which ask for no field
};

/// A point that has symbols of its own in natural coordinates (xB1, yB1).
struct ConstructedPoint {
  mechanism::PointIndex point = 0;
  int x = 0, y = 0;  ///< ring variables
  int z = -1;        ///< none in the plane
};

/// Two natural coordinates and the place that they stand for over the tower: a constructed point, or the cosine and
/// sine of an angle, which are a point of the unit circle. Or one, the inverse of a length; y is -1 then. Or a place
/// that holds the two themselves, which stand for other numbers from then on.
struct Substitution {
  int x = 0, y = 0;  ///< ring variables
  TowerPoint place;
  int z = -1;  ///< of a point in space
};

/// 1 / |v| of a vector that forces act along, or by which an angle is measured: a number where |v| is one, else a
/// natural coordinate of its own, over the tower with one more root (method.md section 11):
///     v = V / W,  s^2 = V . V,  1 / |v| = W s / (V . V)
struct InverseLength {
  std::string name;  ///< of the spring, joint or limit
  mechanism::VectorExpression along;
  int variable = -1;
  GiNaC::ex natural = 0;
  std::optional<TowerPoint> place = {};  ///< (1 / |v|, 0) over the tower; none of a number
  int root = -1;                         ///< by its place in Geometry::roots
};

/// What a torsion spring is turned off its rest: a natural coordinate of its own, over the tower with one more root,
/// that is no root of a polynomial (core::Root). With a, b the directions of the joint's links and the rest r, in the
/// plane
///     X = a . b cos r + a x b sin r,  Y = a x b cos r - a . b sin r,  angle of (X, Y)
/// in space, about the joint's axis u, with u . u a . b - (u . a)(u . b) for a . b and |u| u . (a x b) for a x b.
/// Or the arc tangent of a polynomial Y in a load, with X = 1.
struct TorsionAngle {
  std::size_t spring = 0;
  std::optional<core::Expression> tangent = {};  ///< an arc tangent, and of no spring
  std::string name = {};                         ///< the symbol of an arc tangent
  int variable = -1;
  GiNaC::ex natural = 0;                 ///< a number where the links do not turn
  std::array<GiNaC::ex, 2> way = {};     ///< X, Y
  std::optional<TowerPoint> place = {};  ///< (angle, 0) over the tower; none of a number
  int root = -1;                         ///< by its place in Geometry::roots; none where an earlier angle stands for it
};

/// One a coordinate: the chart of an angle, nothing for a length.
using Charts = std::vector<std::optional<core::AngleChart>>;

/// All the algebra of one mechanism lives in one ring:
/// free coordinates, coordinates of constructed points, roots, parameters kept symbolic, an auxiliary variable.
class Geometry {
 public:
  /// With `keep_parameters` the parameters, and irrational expressions in them, stay symbols; otherwise their exact
  /// values are put in. An angle is written in the t of its chart (core/angle_chart.hpp); without `charts`, of the half
  /// turn about 0. Throws core::InputError where a point is no polynomial in the free coordinates.
  /// Roots that depend on earlier ones are replaced where no parameters are kept, on the sheet that is chosen.
  Geometry(const mechanism::Mechanism& mechanism, bool keep_parameters, Charts charts = {}, SheetChoice sheet = {});

  const mechanism::Mechanism& mechanism() const { return *mechanism_; }
  const Ring& ring() const { return *ring_; }
  int coordinates() const { return static_cast<int>(mechanism_->coordinates.size()); }

  /// A point in natural coordinates: x, y, z.
  const std::array<GiNaC::ex, 3>& natural(mechanism::PointIndex point) const { return natural_[index(point)]; }
  const TowerPoint& tower(mechanism::PointIndex point) const { return tower_[index(point)]; }
  const std::vector<ConstructedPoint>& constructed() const { return constructed_; }
  const std::vector<TowerRoot>& roots() const { return roots_; }
  const std::vector<Fold>& folds() const { return folds_; }
  /// Whether sheets are not alike: there are dependent roots or folds.
  bool has_dependent_roots() const { return !sign_choices_.empty() || !folds_.empty(); }
  /// Whether the points are placed alike on the sheets of another working mode, but for the signs of the roots.
  bool same_for(const std::vector<int>& sides) const;
  /// The numerators of the squared distances divided by, reduced.
  const std::vector<Poly>& denominators() const { return denominators_; }
  /// The way (x, y) / w from one end of a dyad to the other over the tower, w positive, its squared distance d / w2 and
  /// 2 d w, the denominator of the way to the point; reduced.
  struct Way {
    mechanism::PointIndex point = 0;
    Poly x, y, w;
    Poly w2, d, twice_dw;
    bool is_squared = true;  ///< w2 = w^2, d = x^2 + y^2; else a shorter fraction
  };
  const std::vector<Way>& dyad_ways() const { return dyad_ways_; }
  /// Where a dyad X on V, W closes a loop with a `fourth` point C that is as far from V as X is from W, and the other
  /// way round, X is V + W - C (a parallelogram) or C + m (W - V), m |W - V|^2 = |X - V|^2 - |X - W|^2 (a crossed one).
  struct Closing {
    mechanism::PointIndex fourth = 0;
    TowerPoint place;                     ///< in natural coordinates; m is called as the x of X
    std::optional<TowerPoint> part = {};  ///< (m, 0) over the tower, of a crossed one
    core::Rational along = 0;             ///< m |W - V|^2
  };
  /// By X.
  const std::map<mechanism::PointIndex, Closing>& closings() const { return closings_; }
  /// Polynomials that places divide by and that vanish nowhere: 1 + t^2 of every angle.
  const std::vector<Poly>& positive_units() const { return positive_units_; }

  /// Of the springs, actuators and limits that need one.
  const std::vector<InverseLength>& inverse_lengths() const { return inverse_lengths_; }
  bool has_inverse_length(const std::string& name) const;
  /// Requires that there is one of this name.
  const InverseLength& inverse_length(const std::string& name) const;
  /// What the inverse length of an arm of a limit's angle is called; none is shared with springs and joints.
  static std::string arm_name(std::size_t limit, bool second);
  /// The same of the directions that a torsion spring measures.
  static std::string arm_name(const mechanism::Spring& spring, bool second);

  const std::vector<TorsionAngle>& torsion_angles() const { return torsion_angles_; }
  const TorsionAngle& torsion_angle(std::size_t spring) const;
  /// What is called after it: the spring, or the symbol of an arc tangent.
  const std::string& name_of(const TorsionAngle& angle) const;

  /// The square of a length of the file: exact where the length is the root of a rational number, unless the length is
  /// that of a crank too, whose place needs the length itself.
  Poly squared_length(const core::Expression& length) const;

  const Charts& charts() const { return charts_; }
  /// What over_tower puts in, in this order: angles first, as the other places are long.
  std::vector<Substitution> substitutions() const;
  /// A natural polynomial with one pair replaced, times W^degree; `degree` is at least its degree in the pair.
  Poly substituted(const Poly& natural, const Substitution& pair, int degree) const;
  static int degree_in(const Poly& natural, const Substitution& pair);

  /// A ring variable that occurs in nothing else, for telling two polynomials of one computation apart.
  int auxiliary() const { return ring().size() - 1; }

  /// A vector of the file in natural coordinates, 2 or 3 components.
  std::vector<GiNaC::ex> vector(const mechanism::VectorExpression& vector) const;

  /// Parameters and expressions in them that stay symbols, by the names of their variables.
  const std::map<std::string, core::Expression>& kept_expressions() const { return kept_expressions_; }

  /// An expression of the file as a GiNaC expression in the ring's symbols.
  GiNaC::ex expression(const core::Expression& expression) const;
  /// A polynomial GiNaC expression as an element of the ring.
  Poly poly(const GiNaC::ex& expression) const;
  /// Powers of roots put back: at most the first power of each remains.
  Poly reduce(Poly p) const;

  /// Ring variables in the order of core::RootTower: coordinates, then roots.
  std::vector<int> tower_variables() const;
  core::RootTower plain_tower() const;

 private:
  static std::size_t index(mechanism::PointIndex point) { return static_cast<std::size_t>(point); }
  GiNaC::symbol symbol(const std::string& name) const;
  void name_variables();
  void list_lengths();
  void place_length(InverseLength& length);
  void list_torsion_angles();
  std::array<GiNaC::ex, 2> way_off_rest(const mechanism::Spring& spring) const;
  /// The symbol of the arc tangent of a polynomial.
  GiNaC::ex arc_tangent(const core::Expression& tangent) const;
  void place_torsion_angle(TorsionAngle& angle);
  /// What an earlier angle, or its opposite, stands for over the tower where (x, y) has that angle in every pose.
  std::optional<TowerPoint> same_angle(const Poly& x, const Poly& y) const;
  /// Over the tower, with one positive denominator for all.
  std::array<Poly, 2> numerators(const std::array<GiNaC::ex, 2>& way) const;
  void place_angles();
  void take_samples();
  /// Expressions of the file as GiNaC's, an algebra of core/interpret.hpp.
  struct Naturals;
  /// cos and sin of a sum of whole multiples of angles and constants.
  std::array<GiNaC::ex, 2> circle(const core::Expression& angle) const;
  bool is_free(const core::Expression& expression) const;
  void place(mechanism::PointIndex point);
  void place_explicit(mechanism::PointIndex point, const mechanism::ExplicitPoint& form);
  void place_mean(mechanism::PointIndex point, const mechanism::MeanPoint& form);
  void place_dyad(mechanism::PointIndex point, const mechanism::DyadPoint& form);
  void place_offset(mechanism::PointIndex point, const mechanism::OffsetPoint& form);
  void place_slider(mechanism::PointIndex point, const mechanism::SliderPoint& form);
  void place_shifted(mechanism::PointIndex point, const mechanism::ShiftedPoint& form);
  void place_crossing(mechanism::PointIndex point, const mechanism::CrossingPoint& form);
  void list_crank_lengths();
  /// Position first + ((u along + v across) (second - first)) / length, over the tower.
  TowerPoint offset_over_tower(const mechanism::OffsetPoint& form, const Poly& length_numerator,
                               const Poly& length_denominator) const;
  TowerPoint offset_over_tower(const mechanism::OffsetPoint& form, const std::array<Poly, 2>& offset,
                               const Poly& length_numerator, const Poly& length_denominator) const;
  const ConstructedPoint& constructed(mechanism::PointIndex point) const;
  void construct(mechanism::PointIndex point);
  bool has_root(const Poly& p) const;
  /// Returns the root times its `scale_divisor`, that is, the true root times its `scale`.
  Poly add_root(TowerRoot root);
  /// A root whose `scale / scale_divisor` is far from 1 over the box is given another unit, so that floating point
  /// finds all variables of a tower of one size.
  void give_unit(TowerRoot& root) const;
  /// The root over the tower, where it depends on earlier ones; `square` of the root becomes a number.
  std::optional<Poly> depend(TowerRoot& root);
  /// Takes out of a root over the coordinates what its square holds twice and what takes both signs: where that is zero
  /// the two modes meet, and the root is not smooth.
  void cut_where_modes_meet(TowerRoot& root);
  /// Sign of an element on the sheet chosen, roots taken as positive; cuts the sheet where it takes both.
  /// `root`: the place of the one that is replaced. `odd_roots`: take the signs that the mode gives them.
  int sign_on_sheet(Poly element, std::size_t root, std::vector<std::size_t>& odd_roots);
  /// +1 or -1 of a root in a working mode; +1 of lengths.
  int side_of(std::size_t root, const std::vector<int>& sides) const;
  int next_root() const;
  /// Three numerators of a vector over a positive denominator: its direction. z = 0 in the plane.
  std::array<Poly, 3> direction(const mechanism::VectorExpression& vector) const;
  /// On a line or in a plane of constant direction fewer symbols do than there are coordinates.
  void keep_on_line(mechanism::PointIndex point, mechanism::PointIndex base, const std::array<Poly, 3>& along);
  void keep_in_plane(mechanism::PointIndex point, mechanism::PointIndex base, const std::array<Poly, 3>& normal);
  /// Nor does a point that is placed at a constant way from another one, as in a parallelogram, have coordinates of its
  /// own: factors show what numerators and |A| share.
  void keep_beside_another(mechanism::PointIndex point);
  /// False where the point closes no loop. Over the tower: `way` is W - V over its squared length, `part` one over
  /// this.
  bool close_loop(mechanism::PointIndex point, const mechanism::DyadPoint& form, TowerPoint way, TowerPoint part);
  /// to - from and a + way over the least denominator, as far as its factors are known to be positive.
  TowerPoint difference(const TowerPoint& to, const TowerPoint& from) const;
  TowerPoint sum(const TowerPoint& a, const TowerPoint& way) const;
  /// Divides by what is positive and common to all.
  void lighten(TowerPoint& place) const;
  Poly common_positive(Poly a, Poly b) const;
  /// p / divisor, where that holds neither coordinates nor roots; none of zero.
  /// A squared distance in natural coordinates, with the squared lengths of dyads' links put in where that lowers its
  /// degree: of the distance between a point on a crank and a fixed one it is linear in the crank's end.
  Poly by_known_lengths(Poly squared) const;
  /// In the plane over the tower: numerator and positive denominator.
  std::array<Poly, 2> squared_distance(mechanism::PointIndex from, mechanism::PointIndex to) const;
  std::optional<Poly> constant_quotient(const Poly& p, const Poly& divisor) const;
  /// A squared length that is divided by; its factors join what is known to be positive.
  void add_denominator(const Poly& squared_length);
  void add_positive(const Poly& divisor);
  /// What is divided by where `below` is what is left of that: what vanishes on a fold may have cancelled.
  Poly without_cuts(Poly squared_length, const Poly& below) const;
  /// The direction of an axis is undefined where its length is zero: |u|^2 joins the denominators.
  void divide_by_length(const mechanism::VectorExpression& axis);

  const mechanism::Mechanism* mechanism_;
  bool keep_parameters_;
  mutable std::map<std::string, GiNaC::symbol> symbols_;  ///< by printed name
  mutable std::vector<std::string> kept_;                 ///< parameters and irrational expressions, as they appear
  mutable std::map<std::string, core::Expression> kept_expressions_;  ///< what they stand for
  mutable std::map<std::string, int> variable_of_symbol_;             ///< GiNaC symbol's name to ring variable
  std::unique_ptr<Ring> ring_;
  std::vector<std::array<GiNaC::ex, 3>> natural_;  ///< z = 0 in the plane
  std::vector<TowerPoint> tower_;
  std::vector<ConstructedPoint> constructed_;
  std::vector<InverseLength> inverse_lengths_;
  std::vector<TorsionAngle> torsion_angles_;
  std::vector<TowerRoot> roots_;
  std::vector<Poly> denominators_;
  std::vector<Way> dyad_ways_;
  /// Of dyads on others: the point by its numbers (u, v) along and across the way between its ends, for which its own
  /// symbols stand, and (u, v) over the tower. Multiplied out the two are long.
  std::map<mechanism::PointIndex, std::array<TowerPoint, 2>> frames_;
  std::map<mechanism::PointIndex, Closing> closings_;
  std::vector<Poly> positive_units_;
  std::vector<Poly> positive_;  ///< known to be nowhere negative on the sheets, in the order of their appearance
  Charts charts_;
  std::vector<Substitution> angles_;
  std::set<core::Rational> crank_lengths_;  ///< rational numbers that stand for irrational lengths in places
  int first_root_ = 0;                      ///< ring variable
  SheetChoice sheet_;
  std::vector<Fold> folds_;
  /// Of every dependent root the roots, itself among them, whose signs together it was placed with.
  std::vector<std::vector<std::size_t>> sign_choices_;
  /// A pose over the box with the roots so far. Where one of them has no value, that of the opposite of its square: of
  /// that size it is elsewhere.
  struct Sample {
    std::vector<double> at;  ///< by ring variable
    bool is_reached = true;
  };
  std::vector<Sample> samples_;
};

}  // namespace clearloci::symbolic
