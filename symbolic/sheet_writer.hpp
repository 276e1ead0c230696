// What equation_sheet writes with: the names of symbols, the determinants and factors, the closure of every point.
// Private to symbolic/.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/causes.hpp"
#include "symbolic/code_names.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/equation_sheet.hpp"
#include "symbolic/expression_text.hpp"
#include "symbolic/formula.hpp"
#include "symbolic/formula_text.hpp"

namespace clearloci::symbolic {

class SheetWriter {
 public:
  SheetWriter(const mechanism::Mechanism& m, bool keep_parameters);

  EquationSheet write(Language language);

 private:
  // Kinds of names: the file's parameters and coordinates, no two of which are alike, and what is derived.
  static constexpr const char* user = "";
  static constexpr const char* derived = CodeNames::derived;

  /// The file's names come first, so that derived ones give way.
  void name_symbols();

  /// The variable that stands for an angle in implicit polynomials: "tan(theta/2)".
  std::optional<std::string> half_angle(const std::string& variable);

  /// A symbol of the closure: "kB1".
  FormulaText symbol_text(const std::string& name) {
    return {names_.in_formula(derived, name), FormulaText::Form::atom};
  }

  /// In C the value itself, for a file's own text may be of any length.
  std::string parameter_text(const mechanism::Parameter& p);

  std::string text(const Poly& p) const { return formula(p.plain(), symbols_, language_); }
  std::string text(const GiNaC::ex& e) const { return text(geometry_.poly(e)); }

  /// `unknown`: of a numerator; null of |A|.
  Determinant determinant(const std::string& name, const FactoredPoly& p, const mechanism::Unknown* unknown);

  /// Where reactions can only vanish together, of the joints and quantities that `loci` takes without options.
  void write_preload(EquationSheet& sheet);

  /// What |A| shares with a numerator says the same there.
  std::string cause(const Poly& factor, const mechanism::Unknown* unknown) const;

  struct Implicit {
    Poly natural;
    std::vector<Poly> curves;
    std::vector<ImplicitPolynomial> list;  ///< the curves in the language, each once
    bool too_heavy = false;
    bool constant = false;  ///< such as the square of a link's length, by which a couple is divided
  };

  /// Several numerators share factors: each is eliminated once.
  const Implicit& implicit(const Poly& natural);

  void tell(Implicit& implicit) const;

  /// Whether it is the same number in every pose.
  bool is_constant(const Poly& natural) const;

  /// The same polynomial in another ring of the same variables.
  static Poly in_ring(const Poly& p, const Ring& ring);

  /// Coefficient of x^i y^j, a polynomial in the parameters.
  static Poly coefficient(const Poly& p, std::size_t i, std::size_t j);

  std::string closed_form(const Poly& p, int degree) const;

  using Lines = std::vector<std::pair<std::string, std::string>>;

  /// The inverse length of a spring, or of the axis of an actuator of known effort.
  void write_length(const InverseLength& length, Lines& lines) const;

  /// What a torsion spring is turned off its rest, or an arc tangent.
  void write_angle(const TorsionAngle& angle, Lines& lines) const;

  /// How a constructed point follows from the ones before it, in the formulas of method.md section 1.
  void write_closure(const ConstructedPoint& c, Lines& lines);

  /// |Q - P|^2 - length^2 of the distances of a group, (P - Q) x u of its lines.
  void write_closing(const mechanism::Group& group, std::vector<std::string>& polynomials) const;

  using Vector = std::array<FormulaText, 3>;  // z = 0 in the plane

  void write_dyad(const ConstructedPoint& c, const std::string& name, const mechanism::DyadPoint& dyad, Lines& lines);

  /// S = Q + (p + s) u / U,  p = u . (C - Q),  U = u . u,  s^2 = l^2 U - (u x (C - Q))^2.
  void write_slider(const ConstructedPoint& c, const std::string& name, const mechanism::SliderPoint& slider,
                    Lines& lines);

  /// X = Q + (((R - Q) x v) / (u x v)) u.
  void write_crossing(const ConstructedPoint& c, const std::string& name, const mechanism::CrossingPoint& crossing,
                      Lines& lines);

  void write_offset(const ConstructedPoint& c, const std::string& name, const mechanism::OffsetPoint& offset,
                    Lines& lines);

  void write_place(const ConstructedPoint& c, mechanism::PointIndex from, const Vector& step, Lines& lines) const;

  FormulaText dot(const Vector& a, const Vector& b) const;
  FormulaText squared(const Vector& a) const;
  Vector cross(const Vector& a, const Vector& b) const;
  Vector direction(const mechanism::VectorExpression& vector) const;
  Poly squared(const mechanism::VectorExpression& vector) const;

  Poly coordinate(mechanism::PointIndex point, std::size_t axis) const {
    return geometry_.poly(geometry_.natural(point)[axis]);
  }
  Poly length(const core::Expression& e) const { return geometry_.poly(geometry_.expression(e).expand()); }
  FormulaText as_text(const Poly& p) const { return formula_text(p.plain(), symbols_, language_); }
  Vector difference(mechanism::PointIndex from, mechanism::PointIndex to) const;

  std::vector<mechanism::Group> groups_;
  std::optional<mechanism::Mechanism> opened_;  ///< with the unknowns of its groups as coordinates
  const mechanism::Mechanism& mechanism_;
  Language language_ = Language::text;
  Geometry geometry_;
  FactoredDeterminants determinants_;
  Elimination elimination_;
  Causes causes_;
  /// Where roots depend on one another: the sheets of all modes, which together have the zeros; else none.
  std::vector<std::unique_ptr<const Geometry>> sheets_;
  std::vector<std::unique_ptr<const Elimination>> eliminations_;
  CodeNames names_;
  std::vector<std::string> symbols_;  ///< of the ring's variables, as the language writes them
  std::deque<Implicit> implicit_;     ///< references to its elements stay valid
};
}  // namespace clearloci::symbolic
