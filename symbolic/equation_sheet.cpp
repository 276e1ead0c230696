#include "symbolic/equation_sheet.hpp"

#include <algorithm>
#include <deque>
#include <functional>
#include <iomanip>
#include <memory>
#include <optional>
#include <regex>
#include <sstream>

#include "core/angle_chart.hpp"
#include "core/locus_map.hpp"
#include "core/virtual_work.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/group_closing.hpp"
#include "symbolic/algebra_turn.hpp"
#include "symbolic/causes.hpp"
#include "symbolic/code_names.hpp"
#include "symbolic/demands.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/expression_text.hpp"
#include "symbolic/formula.hpp"
#include "symbolic/formula_text.hpp"
#include "symbolic/preload_constraints.hpp"
#include "symbolic/sheets.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;
using mechanism::Mechanism;

class SheetWriter {
 public:
  SheetWriter(const Mechanism& m, bool keep_parameters)
      : groups_(m.groups),
        opened_(m.groups.empty() ? std::nullopt : std::optional(mechanism::with_open_groups(m))),
        mechanism_(opened_ ? *opened_ : m),
        geometry_(mechanism_, keep_parameters),
        determinants_(factored_determinants(geometry_)),
        elimination_(geometry_),
        causes_(geometry_, &determinants_.equations),
        names_(language_) {
    if (!geometry_.has_dependent_roots()) return;
    for (SheetGeometry& sheet : sheet_geometries(mechanism_, geometry_.charts(), all_modes(mechanism_))) {
      sheets_.push_back(std::make_unique<const Geometry>(std::move(sheet.geometry)));
      eliminations_.push_back(std::make_unique<const Elimination>(*sheets_.back()));
    }
  }

  EquationSheet write(Language language) {
    language_ = language;
    names_ = CodeNames(language);
    name_symbols();
    for (Implicit& own : implicit_) tell(own);
    EquationSheet sheet;
    sheet.mechanism = mechanism_.name;
    sheet.language = language_;
    for (const auto& p : mechanism_.parameters) {
      sheet.parameters.emplace_back(names_.name(user, p.name), parameter_text(p));
    }
    for (const auto& c : mechanism_.coordinates) sheet.coordinates.push_back(names_.name(user, c.name));
    const NewtonEulerEquations& equations = determinants_.equations;
    sheet.rows = equations.row_names;
    sheet.unknowns = equations.unknown_names;
    for (unsigned i = 0; i < equations.matrix.rows(); ++i) {
      auto& row = sheet.matrix.emplace_back();
      for (unsigned j = 0; j < equations.matrix.cols(); ++j) row.push_back(text(equations.matrix(i, j)));
      sheet.loads.push_back(text(equations.loads(i, 0)));
    }
    for (const ConstructedPoint& c : geometry_.constructed()) write_closure(c, sheet.closure);
    for (const InverseLength& length : geometry_.inverse_lengths()) write_length(length, sheet.closure);
    for (const TorsionAngle& angle : geometry_.torsion_angles()) write_angle(angle, sheet.closure);
    for (const mechanism::Group& own : groups_) write_closing(own, sheet.closing);
    sheet.determinant = determinant("A", determinants_.determinant, nullptr);
    for (std::size_t k = 0; k < equations.unknown_names.size(); ++k) {
      sheet.numerators.push_back(
          determinant(equations.unknown_names[k], determinants_.numerators[k], &equations.unknowns[k]));
    }
    write_preload(sheet);
    sheet.renamed = names_.renamed();
    return sheet;
  }

 private:
  // Kinds of names: the file's parameters and coordinates, no two of which are alike, and what is derived.
  static constexpr const char* user = "";
  static constexpr const char* derived = CodeNames::derived;

  /// The file's names come first, so that derived ones give way.
  void name_symbols() {
    symbols_.clear();
    for (const auto& c : mechanism_.coordinates) names_.name(user, c.name);
    for (const auto& p : mechanism_.parameters) names_.name(user, p.name);
    const auto written = [this](const std::string& name) { return names_.in_formula(user, name); };
    const auto& ring = geometry_.ring().names();
    const auto& kept = geometry_.kept_expressions();
    for (const std::string& name : ring) {
      const auto expression = kept.find(name);
      const auto angle = std::find_if(mechanism_.coordinates.begin(), mechanism_.coordinates.end(), [&](const auto& c) {
        return name == "cos(" + c.name + ")" || name == "sin(" + c.name + ")";
      });
      if (expression != kept.end()) {
        symbols_.push_back(enclosed_expression_text(expression->second, language_, written));
      } else if (angle != mechanism_.coordinates.end()) {
        const std::string call = name.substr(0, 3);
        symbols_.push_back((language_ == Language::latex ? "\\" + call : call) + "(" + written(angle->name) + ")");
      } else if (const std::optional<std::string> half = half_angle(name)) {
        symbols_.push_back(*half);
      } else {
        const bool own = std::any_of(mechanism_.coordinates.begin(), mechanism_.coordinates.end(),
                                     [&](const auto& c) { return c.name == name; });
        symbols_.push_back(own ? written(name) : name);
      }
    }
    for (const ConstructedPoint& c : geometry_.constructed())
      for (const int variable : {c.x, c.y, c.z}) {
        if (variable < 0) continue;
        const auto v = static_cast<std::size_t>(variable);
        symbols_[v] = names_.in_formula(derived, ring[v]);
      }
    for (const InverseLength& length : geometry_.inverse_lengths()) {
      const auto v = static_cast<std::size_t>(length.variable);
      symbols_[v] = names_.in_formula(derived, ring[v]);
    }
  }

  /// The variable that stands for an angle in implicit polynomials: "tan(theta/2)".
  std::optional<std::string> half_angle(const std::string& variable) {
    for (std::size_t i = 0; i < mechanism_.coordinates.size(); ++i) {
      const std::optional<core::AngleChart>& chart = geometry_.charts()[i];
      const std::string& angle = mechanism_.coordinates[i].name;
      if (!chart || core::parameter_name(*chart, angle) != variable) continue;
      const std::string own = core::parameter_name(*chart, names_.in_formula(user, angle));
      if (language_ != Language::latex) return own;
      return "\\" + std::regex_replace(own, std::regex("[ *]pi\\)"), " \\pi)");
    }
    return std::nullopt;
  }

  /// A symbol of the closure: "kB1".
  FormulaText symbol_text(const std::string& name) {
    return {names_.in_formula(derived, name), FormulaText::Form::atom};
  }

  /// In C the value itself, for a file's own text may be of any length.
  std::string parameter_text(const mechanism::Parameter& p) {
    if (p.exact) return number_text(p.value, language_);
    if (language_ != Language::c)
      return expression_text(p.expression, language_,
                             [this](const std::string& name) { return names_.in_formula(user, name); });
    std::ostringstream digits;
    digits << std::setprecision(17) << core::to_double(p.value);
    return digits.str();
  }

  std::string text(const Poly& p) const { return formula(p.plain(), symbols_, language_); }
  std::string text(const GiNaC::ex& e) const { return text(geometry_.poly(e)); }

  /// `unknown`: of a numerator; null of |A|.
  Determinant determinant(const std::string& name, const FactoredPoly& p, const mechanism::Unknown* unknown) {
    Determinant result{name, product_formula(p, symbols_, language_), {}};
    for (const PolyFactor& factor : p.factors) {
      const Implicit& own = implicit(factor.poly);
      const std::string words = own.constant ? "the same in every pose" : cause(factor.poly, unknown);
      result.factors.push_back({text(factor.poly), factor.multiplicity, words, own.list, own.too_heavy});
    }
    return result;
  }

  /// Where reactions can only vanish together, of the joints and quantities that `loci` takes without options.
  void write_preload(EquationSheet& sheet) {
    const NewtonEulerEquations& equations = determinants_.equations;
    if (equations.free_joints.empty() && !mechanism::has_effort_bounds(mechanism_)) return;
    for (std::size_t e = 0; e < equations.efforts.size(); ++e) {
      auto& [joint, column] = sheet.efforts.emplace_back();
      joint = mechanism_.joints[static_cast<std::size_t>(equations.free_joints[e])].name;
      for (unsigned i = 0; i < equations.efforts[e].rows(); ++i) column.push_back(text(equations.efforts[e](i, 0)));
    }
    const PreloadColumns columns = preload_columns(geometry_, elimination_, determinants_);
    core::LocusProblem demanded;
    state_demands(mechanism_, {}, demanded);
    std::vector<std::string> notes;
    const PreloadDeterminants all = preload_determinants(
        geometry_.ring(), determinants_.determinant, columns.joints.size(),
        preload_constraints(geometry_, elimination_, columns, determinants_.determinant, demanded, {}, notes));
    for (const PreloadDeterminant& own : all.all) {
      PreloadEquation& equation = sheet.preload.emplace_back();
      std::string name;
      for (const core::Vanishing& reaction : own.event.vanishing) {
        equation.reactions.push_back(core::to_string(reaction.quantity) + "_" + reaction.joint);
        name += (name.empty() ? "" : "_") + equation.reactions.back();
      }
      for (const std::string& words : own.event.words) name += "_" + words;
      equation.words = words_of(own.event, columns.motors(mechanism_), columns.joints.size());
      equation.determinant = {
          name + (own.event.infinite ? "_unbounded" : ""), product_formula(own.value, symbols_, language_), {}};
      for (const PolyFactor& factor : own.value.factors) {
        const Implicit& curves = implicit(factor.poly);
        equation.determinant.factors.push_back({text(factor.poly), factor.multiplicity,
                                                curves.constant ? "the same in every pose" : causes_.of(factor.poly),
                                                curves.list, curves.too_heavy});
      }
    }
  }

  /// What |A| shares with a numerator says the same there.
  std::string cause(const Poly& factor, const mechanism::Unknown* unknown) const {
    const auto& shared = determinants_.determinant.factors;
    if (unknown == nullptr ||
        std::any_of(shared.begin(), shared.end(), [&](const PolyFactor& own) { return own.poly == factor; })) {
      const std::string words = causes_.of_determinant(factor);
      return words.empty() ? core::virtual_work_words(core::LocusKind::direct_singularity, {}) : words;
    }
    std::string words = causes_.of(factor);
    if (!words.empty()) return words;
    const core::Vanishing own{mechanism_.joints[static_cast<std::size_t>(unknown->joint)].name, unknown->quantity};
    return core::virtual_work_words(core::LocusKind::component, std::span(&own, 1));
  }

  struct Implicit {
    Poly natural;
    std::vector<Poly> curves;
    std::vector<ImplicitPolynomial> list;  ///< the curves in the language, each once
    bool too_heavy = false;
    bool constant = false;  ///< such as the square of a link's length, by which a couple is divided
  };

  /// Several numerators share factors: each is eliminated once.
  const Implicit& implicit(const Poly& natural) {
    const auto known = std::find_if(implicit_.begin(), implicit_.end(),
                                    [&](const Implicit& entry) { return entry.natural == natural; });
    if (known != implicit_.end()) return *known;
    Implicit own{natural, {}, {}, false, is_constant(natural)};
    const auto add = [&](const Elimination& elimination, const Poly& in_its_ring) {
      if (elimination.is_too_heavy_over_tower(in_its_ring)) {
        own.too_heavy = true;
        return;
      }
      const Poly& sheet = elimination.over_tower(in_its_ring);
      if (sheet.is_zero()) return;
      for (const Poly& curve : elimination.implicit_factors(sheet)) own.curves.push_back(curve);
    };
    // Over the unknowns of groups there is nothing to eliminate with.
    if (sheets_.empty() && !own.constant && !opened_) add(elimination_, natural);
    for (std::size_t i = 0; i < sheets_.size() && !own.constant; ++i)
      add(*eliminations_[i], in_ring(natural, sheets_[i]->ring()));
    tell(own);
    return implicit_.emplace_back(std::move(own));
  }

  void tell(Implicit& own) const {
    own.list.clear();
    for (const Poly& curve : own.curves) {
      const std::string words = text(curve);
      if (std::any_of(own.list.begin(), own.list.end(), [&](const auto& told) { return told.polynomial == words; }))
        continue;
      int degree = 0;
      for (const core::Term& term : curve.plain().terms) {
        int total = 0;
        for (int i = 0; i < geometry_.coordinates(); ++i) total += term.exponents[static_cast<std::size_t>(i)];
        degree = std::max(degree, total);
      }
      own.list.push_back({words, degree, closed_form(curve, degree)});
    }
  }

  /// Whether it is the same number in every pose.
  bool is_constant(const Poly& natural) const {
    if (sheets_.empty()) return elimination_.constant_over_tower(natural).has_value();
    for (std::size_t i = 0; i < sheets_.size(); ++i)
      if (!eliminations_[i]->constant_over_tower(in_ring(natural, sheets_[i]->ring()))) return false;
    return true;
  }

  /// The same polynomial in another ring of the same variables.
  static Poly in_ring(const Poly& p, const Ring& ring) {
    const core::Polynomial plain = p.plain();
    Poly sum(ring);
    for (const core::Term& term : plain.terms) {
      Poly product(ring, term.coefficient);
      for (std::size_t v = 0; v < term.exponents.size(); ++v)
        if (term.exponents[v] > 0)
          product *= Poly::variable(ring, static_cast<int>(v)).pow(static_cast<unsigned>(term.exponents[v]));
      sum += product;
    }
    return sum;
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

  using Lines = std::vector<std::pair<std::string, std::string>>;

  /// The inverse length of a spring, or of the axis of an actuator of known effort.
  void write_length(const InverseLength& length, Lines& lines) const {
    if (length.root < 0 || length.name.rfind("limit", 0) == 0) return;  // no force acts along the arms of a limit
    const FormulaWriter w(language_);
    const FormulaText one = as_text(Poly(geometry_.ring(), 1));
    lines.emplace_back(symbols_[static_cast<std::size_t>(length.variable)],
                       w.quotient(one, w.root(as_text(squared(length.along)))).text);
  }

  /// What a torsion spring is turned off its rest, or an arc tangent.
  void write_angle(const TorsionAngle& angle, Lines& lines) const {
    const auto part = [&](std::size_t i) { return as_text(geometry_.poly(angle.way[i])); };
    lines.emplace_back(symbols_[static_cast<std::size_t>(angle.variable)],
                       FormulaWriter(language_).angle(part(1), part(0)).text);
  }

  /// How a constructed point follows from the ones before it, in the formulas of method.md section 1.
  void write_closure(const ConstructedPoint& c, Lines& lines) {
    const mechanism::Point& point = mechanism_.points[static_cast<std::size_t>(c.point)];
    if (const auto* dyad = std::get_if<mechanism::DyadPoint>(&point.form)) {
      write_dyad(c, point.name, *dyad, lines);
    } else if (const auto* slider = std::get_if<mechanism::SliderPoint>(&point.form)) {
      write_slider(c, point.name, *slider, lines);
    } else if (const auto* offset = std::get_if<mechanism::OffsetPoint>(&point.form)) {
      // Otherwise linear in the two other points.
      if (geometry_.poly(geometry_.natural(c.point)[0]).depends_on(c.x)) write_offset(c, point.name, *offset, lines);
    } else if (const auto* crossing = std::get_if<mechanism::CrossingPoint>(&point.form)) {
      write_crossing(c, point.name, *crossing, lines);
    }
  }

  /// |Q - P|^2 - length^2 of the distances of a group, (P - Q) x u of its lines.
  void write_closing(const mechanism::Group& own, std::vector<std::string>& polynomials) const {
    const auto way = [&](mechanism::PointIndex from, mechanism::PointIndex to, std::size_t axis) {
      return coordinate(to, axis) - coordinate(from, axis);
    };
    for (const mechanism::Group::Distance& distance : own.distances) {
      Poly sum = -geometry_.squared_length(distance.length);
      for (std::size_t axis = 0; axis < mechanism::dimension(mechanism_); ++axis)
        sum += way(distance.first, distance.second, axis).pow(2);
      polynomials.push_back(text(sum));
    }
    for (const mechanism::Group::Line& line : own.lines) {
      const std::vector<GiNaC::ex> along = geometry_.vector(line.along);
      polynomials.push_back(text(way(line.base, line.point, 0) * geometry_.poly(along[1]) -
                                 way(line.base, line.point, 1) * geometry_.poly(along[0])));
    }
  }

  using Vector = std::array<FormulaText, 3>;  // z = 0 in the plane

  void write_dyad(const ConstructedPoint& c, const std::string& name, const mechanism::DyadPoint& dyad, Lines& lines) {
    const FormulaWriter w(language_);
    const FormulaText D = symbol_text("D" + name), k = symbol_text("k" + name), s = symbol_text("s" + name);
    const Vector way = difference(dyad.from, dyad.to);
    const Poly a2 = geometry_.squared_length(dyad.from_length), b2 = geometry_.squared_length(dyad.to_length);
    const FormulaText way2 = squared(way), reach = as_text(a2.scaled(4)), excess = as_text(a2 - b2);
    const auto add_root = [&](const FormulaText& square) {
      const FormulaText root = w.root(square);
      lines.emplace_back(s.text, (dyad.side == mechanism::Side::left ? root : w.negated(root)).text);
    };
    const auto over_twice_D = [&](const FormulaText& along, const FormulaText& left) {
      return w.quotient(w.sum(w.product(k, along), w.product(s, left)), w.twice(D));
    };
    if (!dyad.axis) {
      lines.emplace_back(D.text, way2.text);
      lines.emplace_back(k.text, dyad.right_angle ? as_text(a2.scaled(2)).text : w.sum(excess, D).text);
      add_root(w.difference(w.product(reach, D), w.squared(k)));
      const FormulaText x = w.quotient(w.difference(w.product(k, way[0]), w.product(s, way[1])), w.twice(D));
      write_place(c, dyad.from, {x, over_twice_D(way[1], way[0]), {}}, lines);
      return;
    }
    const FormulaText h = symbol_text("h" + name);
    const Vector n = direction(*dyad.axis);
    const FormulaText n2 = as_text(squared(*dyad.axis));
    lines.emplace_back(h.text, dot(n, way).text);
    lines.emplace_back(D.text, w.difference(w.product(n2, way2), w.squared(h)).text);
    lines.emplace_back(k.text, w.sum(excess, way2).text);
    add_root(w.difference(w.product(reach, D), w.product(n2, w.squared(k))));
    const Vector left = cross(n, way);
    Vector step;
    for (std::size_t i = 0; i < 3; ++i)
      step[i] = over_twice_D(w.difference(w.product(n2, way[i]), w.product(h, n[i])), left[i]);
    write_place(c, dyad.from, step, lines);
  }

  /// S = Q + (p + s) u / U,  p = u . (C - Q),  U = u . u,  s^2 = l^2 U - (u x (C - Q))^2.
  void write_slider(const ConstructedPoint& c, const std::string& name, const mechanism::SliderPoint& slider,
                    Lines& lines) {
    const FormulaWriter w(language_);
    const FormulaText p = symbol_text("p" + name), s = symbol_text("s" + name);
    const Vector u = direction(slider.along), way = difference(slider.base, slider.from), across = cross(u, way);
    lines.emplace_back(p.text, dot(u, way).text);
    FormulaText q = across[2];
    if (mechanism_.space == mechanism::Space::planar) {
      q = symbol_text("q" + name);
      lines.emplace_back(q.text, across[2].text);
    }
    const FormulaText across2 = mechanism_.space == mechanism::Space::planar ? w.squared(q) : squared(across);
    const FormulaText size = as_text(squared(slider.along));
    const Poly l2 = geometry_.squared_length(slider.length);
    const FormulaText root = w.root(w.difference(w.product(as_text(l2), size), across2));
    lines.emplace_back(s.text, (slider.ahead ? root : w.negated(root)).text);
    const FormulaText step = w.quotient(w.sum(p, s), size);
    write_place(c, slider.base, {w.product(step, u[0]), w.product(step, u[1]), w.product(step, u[2])}, lines);
  }

  /// X = Q + (((R - Q) x v) / (u x v)) u.
  void write_crossing(const ConstructedPoint& c, const std::string& name, const mechanism::CrossingPoint& crossing,
                      Lines& lines) {
    const FormulaWriter w(language_);
    const FormulaText p = symbol_text("p" + name);
    const Vector u = direction(crossing.along_first), v = direction(crossing.along_second);
    const Vector way = difference(crossing.first, crossing.second);
    lines.emplace_back(p.text, w.quotient(cross(way, v)[2], cross(u, v)[2]).text);
    write_place(c, crossing.first, {w.product(p, u[0]), w.product(p, u[1]), {}}, lines);
  }

  void write_offset(const ConstructedPoint& c, const std::string& name, const mechanism::OffsetPoint& offset,
                    Lines& lines) {
    const FormulaWriter w(language_);
    const FormulaText l = symbol_text("l" + name);
    const Vector way = difference(offset.first, offset.second);
    const FormulaText along = as_text(length(offset.along)), left = as_text(length(offset.left));
    lines.emplace_back(l.text, w.root(squared(way)).text);
    write_place(c, offset.first,
                {w.quotient(w.difference(w.product(along, way[0]), w.product(left, way[1])), l),
                 w.quotient(w.sum(w.product(along, way[1]), w.product(left, way[0])), l),
                 w.quotient(w.product(along, way[2]), l)},
                lines);
  }

  void write_place(const ConstructedPoint& c, mechanism::PointIndex from, const Vector& step, Lines& lines) const {
    const FormulaWriter w(language_);
    const std::array<int, 3> variables = {c.x, c.y, c.z};
    for (std::size_t i = 0; i < 3; ++i) {
      if (variables[i] < 0) continue;
      lines.emplace_back(symbols_[static_cast<std::size_t>(variables[i])],
                         w.sum(as_text(coordinate(from, i)), step[i]).text);
    }
  }

  FormulaText dot(const Vector& a, const Vector& b) const {
    const FormulaWriter w(language_);
    return w.sum(w.sum(w.product(a[0], b[0]), w.product(a[1], b[1])), w.product(a[2], b[2]));
  }
  FormulaText squared(const Vector& a) const {
    const FormulaWriter w(language_);
    return w.sum(w.sum(w.squared(a[0]), w.squared(a[1])), w.squared(a[2]));
  }
  Vector cross(const Vector& a, const Vector& b) const {
    const FormulaWriter w(language_);
    const auto minor = [&](std::size_t i, std::size_t k) {
      return w.difference(w.product(a[i], b[k]), w.product(a[k], b[i]));
    };
    return {minor(1, 2), minor(2, 0), minor(0, 1)};
  }
  Vector direction(const mechanism::VectorExpression& vector) const {
    Vector u = {as_text(Poly(geometry_.ring())), as_text(Poly(geometry_.ring())), as_text(Poly(geometry_.ring()))};
    const std::vector<GiNaC::ex> natural = geometry_.vector(vector);
    for (std::size_t i = 0; i < natural.size(); ++i) u[i] = as_text(geometry_.poly(natural[i]));
    return u;
  }
  Poly squared(const mechanism::VectorExpression& vector) const {
    Poly sum(geometry_.ring());
    for (const GiNaC::ex& u : geometry_.vector(vector)) sum += geometry_.poly(u) * geometry_.poly(u);
    return sum;
  }

  Poly coordinate(mechanism::PointIndex point, std::size_t axis) const {
    return geometry_.poly(geometry_.natural(point)[axis]);
  }
  Poly length(const core::Expression& e) const { return geometry_.poly(geometry_.expression(e).expand()); }
  FormulaText as_text(const Poly& p) const { return formula_text(p.plain(), symbols_, language_); }
  Vector difference(mechanism::PointIndex from, mechanism::PointIndex to) const {
    const auto along = [&](std::size_t axis) { return as_text(coordinate(to, axis) - coordinate(from, axis)); };
    return {along(0), along(1), along(2)};
  }

  std::vector<mechanism::Group> groups_;
  std::optional<Mechanism> opened_;  ///< with the unknowns of its groups as coordinates
  const Mechanism& mechanism_;
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

}  // namespace

std::vector<EquationSheet> equation_sheets(const Mechanism& mechanism, const std::vector<Language>& languages,
                                           bool keep_parameters) {
  const auto turn = algebra_turn();
  SheetWriter writer(mechanism, keep_parameters);
  std::vector<EquationSheet> sheets;
  for (const Language language : languages) sheets.push_back(writer.write(language));
  return sheets;
}

EquationSheet equation_sheet(const Mechanism& mechanism, const SheetOptions& options) {
  return equation_sheets(mechanism, {options.language}, options.keep_parameters).front();
}

}  // namespace clearloci::symbolic
