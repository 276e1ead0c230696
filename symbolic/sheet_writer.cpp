#include "symbolic/sheet_writer.hpp"

#include <algorithm>
#include <iomanip>
#include <regex>
#include <sstream>

#include "core/angle_chart.hpp"
#include "core/locus_map.hpp"
#include "core/virtual_work.hpp"
#include "mechanism/group_closing.hpp"
#include "symbolic/demands.hpp"
#include "symbolic/preload_constraints.hpp"
#include "symbolic/sheets.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;
using mechanism::Mechanism;

}  // namespace

SheetWriter::SheetWriter(const Mechanism& m, bool keep_parameters)
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

EquationSheet SheetWriter::write(Language language) {
  language_ = language;
  names_ = CodeNames(language);
  name_symbols();
  for (Implicit& implicit : implicit_) tell(implicit);
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
  for (const mechanism::Group& group : groups_) write_closing(group, sheet.closing);
  sheet.determinant = determinant("A", determinants_.determinant, nullptr);
  for (std::size_t k = 0; k < equations.unknown_names.size(); ++k) {
    sheet.numerators.push_back(
        determinant(equations.unknown_names[k], determinants_.numerators[k], &equations.unknowns[k]));
  }
  write_preload(sheet);
  sheet.renamed = names_.renamed();
  return sheet;
}

void SheetWriter::name_symbols() {
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
      const bool is_coordinate = std::any_of(mechanism_.coordinates.begin(), mechanism_.coordinates.end(),
                                             [&](const auto& c) { return c.name == name; });
      symbols_.push_back(is_coordinate ? written(name) : name);
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

std::optional<std::string> SheetWriter::half_angle(const std::string& variable) {
  for (std::size_t i = 0; i < mechanism_.coordinates.size(); ++i) {
    const std::optional<core::AngleChart>& chart = geometry_.charts()[i];
    const std::string& angle = mechanism_.coordinates[i].name;
    if (!chart || core::parameter_name(*chart, angle) != variable) continue;
    const std::string parameter_name = core::parameter_name(*chart, names_.in_formula(user, angle));
    if (language_ != Language::latex) return parameter_name;
    return "\\" + std::regex_replace(parameter_name, std::regex("[ *]pi\\)"), " \\pi)");
  }
  return std::nullopt;
}

std::string SheetWriter::parameter_text(const mechanism::Parameter& p) {
  if (p.exact) return number_text(p.value, language_);
  if (language_ != Language::c)
    return expression_text(p.expression, language_,
                           [this](const std::string& name) { return names_.in_formula(user, name); });
  std::ostringstream digits;
  digits << std::setprecision(17) << core::to_double(p.value);
  return digits.str();
}

Determinant SheetWriter::determinant(const std::string& name, const FactoredPoly& p,
                                     const mechanism::Unknown* unknown) {
  Determinant result{name, product_formula(p, symbols_, language_), {}};
  for (const PolyFactor& factor : p.factors) {
    const Implicit& form = implicit(factor.poly);
    const std::string words = form.constant ? "the same in every pose" : cause(factor.poly, unknown);
    result.factors.push_back({text(factor.poly), factor.multiplicity, words, form.list, form.too_heavy});
  }
  return result;
}

void SheetWriter::write_preload(EquationSheet& sheet) {
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
  for (const PreloadDeterminant& determinant : all.all) {
    PreloadEquation& equation = sheet.preload.emplace_back();
    std::string name;
    for (const core::Vanishing& reaction : determinant.event.vanishing) {
      equation.reactions.push_back(core::to_string(reaction.quantity) + "_" + reaction.joint);
      name += (name.empty() ? "" : "_") + equation.reactions.back();
    }
    for (const std::string& words : determinant.event.words) name += "_" + words;
    equation.words = words_of(determinant.event, columns.motors(mechanism_), columns.joints.size());
    equation.determinant = {name + (determinant.event.infinite ? "_unbounded" : ""),
                            product_formula(determinant.value, symbols_, language_),
                            {}};
    for (const PolyFactor& factor : determinant.value.factors) {
      const Implicit& curves = implicit(factor.poly);
      equation.determinant.factors.push_back({text(factor.poly), factor.multiplicity,
                                              curves.constant ? "the same in every pose" : causes_.of(factor.poly),
                                              curves.list, curves.too_heavy});
    }
  }
}

std::string SheetWriter::cause(const Poly& factor, const mechanism::Unknown* unknown) const {
  const auto& shared = determinants_.determinant.factors;
  if (unknown == nullptr || std::any_of(shared.begin(), shared.end(),
                                        [&](const PolyFactor& poly_factor) { return poly_factor.poly == factor; })) {
    const std::string words = causes_.of_determinant(factor);
    return words.empty() ? core::virtual_work_words(core::LocusKind::direct_singularity, {}) : words;
  }
  std::string words = causes_.of(factor);
  if (!words.empty()) return words;
  const core::Vanishing vanishing{mechanism_.joints[static_cast<std::size_t>(unknown->joint)].name, unknown->quantity};
  return core::virtual_work_words(core::LocusKind::component, std::span(&vanishing, 1));
}

const SheetWriter::Implicit& SheetWriter::implicit(const Poly& natural) {
  const auto found =
      std::find_if(implicit_.begin(), implicit_.end(), [&](const Implicit& entry) { return entry.natural == natural; });
  if (found != implicit_.end()) return *found;
  Implicit implicit{natural, {}, {}, false, is_constant(natural)};
  const auto add = [&](const Elimination& elimination, const Poly& in_its_ring) {
    if (elimination.is_too_heavy_over_tower(in_its_ring)) {
      implicit.too_heavy = true;
      return;
    }
    const Poly& sheet = elimination.over_tower(in_its_ring);
    if (sheet.is_zero()) return;
    for (const Poly& curve : elimination.implicit_factors(sheet)) implicit.curves.push_back(curve);
  };
  // Over the unknowns of groups there is nothing to eliminate with.
  if (sheets_.empty() && !implicit.constant && !opened_) add(elimination_, natural);
  for (std::size_t i = 0; i < sheets_.size() && !implicit.constant; ++i)
    add(*eliminations_[i], in_ring(natural, sheets_[i]->ring()));
  tell(implicit);
  return implicit_.emplace_back(std::move(implicit));
}

void SheetWriter::tell(Implicit& implicit) const {
  implicit.list.clear();
  for (const Poly& curve : implicit.curves) {
    const std::string words = text(curve);
    if (std::any_of(implicit.list.begin(), implicit.list.end(),
                    [&](const auto& told) { return told.polynomial == words; }))
      continue;
    int degree = 0;
    for (const core::Term& term : curve.plain().terms) {
      int total = 0;
      for (int i = 0; i < geometry_.coordinates(); ++i) total += term.exponents[static_cast<std::size_t>(i)];
      degree = std::max(degree, total);
    }
    implicit.list.push_back({words, degree, closed_form(curve, degree)});
  }
}

bool SheetWriter::is_constant(const Poly& natural) const {
  if (sheets_.empty()) return elimination_.constant_over_tower(natural).has_value();
  for (std::size_t i = 0; i < sheets_.size(); ++i)
    if (!eliminations_[i]->constant_over_tower(in_ring(natural, sheets_[i]->ring()))) return false;
  return true;
}

Poly SheetWriter::in_ring(const Poly& p, const Ring& ring) {
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

Poly SheetWriter::coefficient(const Poly& p, std::size_t i, std::size_t j) {
  const std::vector<Poly> by_x = p.coefficients(0);
  if (i >= by_x.size()) return Poly(p.ring());
  const std::vector<Poly> by_y = by_x[i].coefficients(1);
  return j < by_y.size() ? by_y[j] : Poly(p.ring());
}

std::string SheetWriter::closed_form(const Poly& p, int degree) const {
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

}  // namespace clearloci::symbolic
