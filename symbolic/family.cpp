#include "symbolic/family.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::symbolic {
namespace {

std::vector<std::vector<Poly>> extended_matrix(const Geometry& geometry, const NewtonEulerEquations& equations) {
  std::vector<std::vector<Poly>> rows;
  for (unsigned i = 0; i < equations.matrix.rows(); ++i) {
    std::vector<Poly>& row = rows.emplace_back();
    for (unsigned j = 0; j < equations.matrix.cols(); ++j) row.push_back(geometry.poly(equations.matrix(i, j)));
    row.push_back(geometry.poly(equations.loads(i, 0)));
  }
  return rows;
}

/// Of the polynomials with symbols for parameters; beyond, a member's own numbers are quicker than values put into
/// them, or derive in no time what takes minutes with thirty symbols. Whatever mechanism gains has some hundred:
/// Jansen's leg 224.
constexpr std::size_t most_terms = 1000;

/// The factorisations of the distinct factors met so far.
struct Refactored {
  Poly before;
  FactoredPoly after;
};

}  // namespace

Family::Family(const mechanism::Mechanism& member) : mechanism_(member), geometry_(mechanism_, true) {
  if (!mechanism::joints_without_preload(mechanism_).empty()) return;
  std::optional<FactoredDeterminants> derived = factored_determinants_within(most_terms, geometry_);
  if (!derived || !derived->equations.divisors.empty()) return;
  matrix_ = extended_matrix(geometry_, derived->equations);
  determinants_ = std::move(derived);
}

Poly Family::substituted(const Poly& p, const Geometry& geometry,
                         const std::vector<std::optional<Poly>>& values) const {
  const core::Polynomial plain = p.plain();
  Poly sum(geometry.ring());
  for (const core::Term& term : plain.terms) {
    Poly product(geometry.ring(), term.coefficient);
    for (std::size_t v = 0; v < term.exponents.size(); ++v) {
      if (term.exponents[v] == 0) continue;
      core::ensure(values[v].has_value(), "a value for every variable that occurs");
      product *= values[v]->pow(static_cast<unsigned>(term.exponents[v]));
    }
    sum += product;
  }
  return sum;
}

std::optional<FactoredDeterminants> Family::at(const Geometry& geometry) const {
  if (!determinants_) return std::nullopt;
  const mechanism::Mechanism& member = geometry.mechanism();
  std::vector<std::optional<Poly>> values(static_cast<std::size_t>(geometry_.ring().size()));
  for (int v = 0; v < geometry_.ring().size(); ++v) {
    auto& value = values[static_cast<std::size_t>(v)];
    const std::string& name = geometry_.ring().name(v);
    const auto kept = geometry_.kept_expressions().find(name);
    if (kept != geometry_.kept_expressions().end()) {
      try {
        const auto exact = mechanism::evaluate(kept->second, member.parameters);
        if (!exact.exact) return std::nullopt;
        value = Poly(geometry.ring(), exact.value);
      } catch (const std::exception&) {
        return std::nullopt;  // division by zero, another set of parameters
      }
    } else if (const int index = geometry.ring().index(name); index >= 0) {
      value = Poly::variable(geometry.ring(), index);
    }
  }

  NewtonEulerEquations equations = newton_euler_equations(geometry);
  const std::vector<std::vector<Poly>> matrix = extended_matrix(geometry, equations);
  if (matrix.size() != matrix_.size() || !equations.divisors.empty()) return std::nullopt;
  for (std::size_t i = 0; i < matrix.size(); ++i)
    for (std::size_t j = 0; j < matrix[i].size(); ++j)
      if (!(substituted(matrix_[i][j], geometry, values) == matrix[i][j])) return std::nullopt;

  std::vector<Refactored> recent;
  const auto factored_again = [&](const Poly& factor) -> const FactoredPoly& {
    for (const Refactored& entry : recent)
      if (entry.before == factor) return entry.after;
    return recent.emplace_back(Refactored{factor, factored(substituted(factor, geometry, values), {})}).after;
  };
  const auto with_values = [&](const FactoredPoly& p) {
    FactoredPoly result{p.constant, {}};
    for (const PolyFactor& factor : p.factors) {
      if (result.constant == 0) break;
      multiply(result, factored_again(factor.poly), factor.multiplicity);
    }
    return result;
  };
  FactoredDeterminants result{std::move(equations), with_values(determinants_->determinant), {}};
  if (result.determinant.is_zero()) return std::nullopt;  // the usual way says what is wrong
  for (const FactoredPoly& numerator : determinants_->numerators) result.numerators.push_back(with_values(numerator));
  return result;
}

}  // namespace clearloci::symbolic
