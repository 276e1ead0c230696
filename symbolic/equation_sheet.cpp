#include "symbolic/equation_sheet.hpp"

#include <algorithm>

#include "core/locus_map.hpp"
#include "mechanism/evaluate.hpp"
#include "symbolic/causes.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/formula.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;
using mechanism::Mechanism;

class SheetWriter {
 public:
  SheetWriter(const Mechanism& m, const SheetOptions& options)
      : mechanism_(m),
        language_(options.language),
        geometry_(m, options.keep_parameters),
        determinants_(factored_determinants(geometry_)),
        elimination_(geometry_),
        causes_(geometry_) {}

  EquationSheet write() {
    EquationSheet sheet;
    sheet.mechanism = mechanism_.name;
    sheet.language = language_;
    for (const auto& p : mechanism_.parameters) {
      sheet.parameters.emplace_back(p.name, p.exact ? core::to_string(p.value) : core::to_string(p.expression));
    }
    for (const auto& c : mechanism_.coordinates) sheet.coordinates.push_back(c.name);
    const NewtonEulerEquations& equations = determinants_.equations;
    sheet.rows = equations.row_names;
    sheet.unknowns = equations.unknown_names;
    for (unsigned i = 0; i < equations.matrix.rows(); ++i) {
      auto& row = sheet.matrix.emplace_back();
      for (unsigned j = 0; j < equations.matrix.cols(); ++j) row.push_back(text(equations.matrix(i, j)));
      sheet.loads.push_back(text(equations.loads(i, 0)));
    }
    for (const ConstructedPoint& c : geometry_.constructed()) write_closure(c, sheet.closure);
    sheet.determinant = determinant("A", determinants_.determinant_factors);
    for (std::size_t k = 0; k < equations.unknown_names.size(); ++k) {
      sheet.numerators.push_back(determinant(equations.unknown_names[k], determinants_.numerator_factors[k]));
    }
    return sheet;
  }

 private:
  std::string text(const Poly& p) const { return formula(p.plain(), geometry_.ring().names(), language_); }
  std::string text(const GiNaC::ex& e) const { return text(geometry_.poly(e)); }

  Determinant determinant(const std::string& name, const FactoredPoly& p) {
    Determinant result{name, product_formula(p, geometry_.ring().names(), language_), {}};
    for (const PolyFactor& factor : p.factors) {
      DeterminantFactor entry{text(factor.poly), factor.multiplicity, causes_.of(factor.poly), implicit(factor.poly)};
      result.factors.push_back(std::move(entry));
    }
    return result;
  }

  /// Several numerators share factors: each is eliminated once.
  const std::vector<ImplicitPolynomial>& implicit(const Poly& natural) {
    const auto known =
        std::find_if(implicit_.begin(), implicit_.end(), [&](const auto& entry) { return entry.first == natural; });
    if (known != implicit_.end()) return known->second;
    std::vector<ImplicitPolynomial> list;
    const Poly sheet = elimination_.over_tower(natural);
    if (!sheet.is_zero()) {
      for (const Poly& curve : elimination_.implicit_factors(sheet)) {
        int degree = 0;
        for (const core::Term& term : curve.plain().terms) {
          int own = 0;
          for (int i = 0; i < geometry_.coordinates(); ++i) own += term.exponents[static_cast<std::size_t>(i)];
          degree = std::max(degree, own);
        }
        list.push_back({text(curve), degree, closed_form(curve, degree)});
      }
    }
    return implicit_.emplace_back(natural, std::move(list)).second;
  }

  /// Coefficient of x^i y^j, a polynomial in the parameters.
  static Poly coefficient(const Poly& p, std::size_t i, std::size_t j) {
    const std::vector<Poly> by_x = p.coefficients(0);
    if (i >= by_x.size()) return Poly(p.ring());
    const std::vector<Poly> by_y = by_x[i].coefficients(1);
    return j < by_y.size() ? by_y[j] : Poly(p.ring());
  }

  std::string closed_form(const Poly& p, int degree) const {
    if (geometry_.coordinates() != 2 || degree > 2) return "";
    if (degree == 1) return "line";
    const Poly a = coefficient(p, 2, 0);
    Poly half_x(p.ring()), half_y(p.ring()), rest(p.ring());
    const bool circle = a == coefficient(p, 0, 2) && coefficient(p, 1, 1).is_zero() &&
                        coefficient(p, 1, 0).scaled(Rational(-1, 2)).divides(a, half_x) &&
                        coefficient(p, 0, 1).scaled(Rational(-1, 2)).divides(a, half_y) &&
                        coefficient(p, 0, 0).divides(a, rest);
    if (circle) {
      const Poly squared = half_x * half_x + half_y * half_y - rest;
      Poly radius(p.ring());
      std::string size;
      if (squared.square_root(radius))
        size = "radius " + text(radius);
      else if (!squared.is_constant() || squared.constant() > 0)
        size = "radius^2 " + text(squared);
      if (!size.empty()) return "circle: centre (" + text(half_x) + ", " + text(half_y) + "), " + size;
    }
    const std::vector<int> free{0, 1};
    for (int variable = 2; variable < geometry_.ring().size(); ++variable) {
      if (p.depends_on(variable)) return "conic";
    }
    const core::ClosedForm form = core::recognise_closed_form(p.plain(free));
    if (const auto* conic = std::get_if<core::ConicForm>(&form)) return conic->type;
    return "";
  }

  /// How a constructed point follows from the ones before it, in the formulas of method.md section 1.
  void write_closure(const ConstructedPoint& c, std::vector<std::pair<std::string, std::string>>& lines) const {
    const mechanism::Point& point = mechanism_.points[static_cast<std::size_t>(c.point)];
    const auto coordinate = [&](mechanism::PointIndex i, std::size_t axis) {
      return geometry_.poly(geometry_.natural(i)[axis]);
    };
    const Ring& ring = geometry_.ring();
    const std::string x = variable_text(ring.name(c.x), language_), y = variable_text(ring.name(c.y), language_);
    const auto local = [&](const std::string& letter) { return variable_text(letter + point.name, language_); };
    const std::string times = language_ == Language::latex ? " " : "*";
    const auto square = [&](const std::string& base) {
      return base + (language_ == Language::python ? "**2" : language_ == Language::latex ? "^{2}" : "^2");
    };
    const auto squared = [&](const std::string& base) {
      return language_ == Language::c ? base + "*" + base : square(base);
    };
    const auto root = [&](const std::string& of) {
      return language_ == Language::latex ? "\\sqrt{" + of + "}" : "sqrt(" + of + ")";
    };
    if (const auto* dyad = std::get_if<mechanism::DyadPoint>(&point.form)) {
      const Poly u = coordinate(dyad->to, 0) - coordinate(dyad->from, 0);
      const Poly v = coordinate(dyad->to, 1) - coordinate(dyad->from, 1);
      const Poly a = geometry_.poly(geometry_.expression(dyad->from_length).expand());
      const Poly b = geometry_.poly(geometry_.expression(dyad->to_length).expand());
      const std::string four_a2 = text((a * a).scaled(4));
      lines.emplace_back(local("D"), squared("(" + text(u) + ")") + " + " + squared("(" + text(v) + ")"));
      const Poly difference = a * a - b * b;
      lines.emplace_back(local("k"), difference.is_zero() ? local("D") : text(difference) + " + " + local("D"));
      const std::string side = dyad->side == mechanism::Side::left ? "" : "-";
      lines.emplace_back(local("s"),
                         side + root("(" + four_a2 + ")" + times + local("D") + " - " + squared(local("k"))));
      const std::string twice = "(2" + times + local("D") + ")";
      lines.emplace_back(x, "(" + text(coordinate(dyad->from, 0)) + ") + (" + local("k") + times + "(" + text(u) +
                                ") - " + local("s") + times + "(" + text(v) + "))/" + twice);
      lines.emplace_back(y, "(" + text(coordinate(dyad->from, 1)) + ") + (" + local("k") + times + "(" + text(v) +
                                ") + " + local("s") + times + "(" + text(u) + "))/" + twice);
    } else if (const auto* offset = std::get_if<mechanism::OffsetPoint>(&point.form)) {
      if (!geometry_.poly(geometry_.natural(c.point)[0]).depends_on(c.x)) return;  // linear in the two other points
      const Poly u = coordinate(offset->second, 0) - coordinate(offset->first, 0);
      const Poly v = coordinate(offset->second, 1) - coordinate(offset->first, 1);
      const std::string along = "(" + text(geometry_.expression(offset->along).expand()) + ")";
      const std::string left = "(" + text(geometry_.expression(offset->left).expand()) + ")";
      lines.emplace_back(local("l"), root(squared("(" + text(u) + ")") + " + " + squared("(" + text(v) + ")")));
      lines.emplace_back(x, "(" + text(coordinate(offset->first, 0)) + ") + (" + along + times + "(" + text(u) +
                                ") - " + left + times + "(" + text(v) + "))/" + local("l"));
      lines.emplace_back(y, "(" + text(coordinate(offset->first, 1)) + ") + (" + along + times + "(" + text(v) +
                                ") + " + left + times + "(" + text(u) + "))/" + local("l"));
    }
  }

  const Mechanism& mechanism_;
  Language language_;
  Geometry geometry_;
  FactoredDeterminants determinants_;
  Elimination elimination_;
  Causes causes_;
  std::vector<std::pair<Poly, std::vector<ImplicitPolynomial>>> implicit_;
};

}  // namespace

EquationSheet equation_sheet(const Mechanism& mechanism, const SheetOptions& options) {
  return SheetWriter(mechanism, options).write();
}

}  // namespace clearloci::symbolic
