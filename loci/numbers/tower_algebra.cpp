#include "loci/numbers/tower_algebra.hpp"

#include <algorithm>
#include <cmath>

#include "core/dense_terms.hpp"
#include "core/errors.hpp"

namespace clearloci::loci {

using core::Polynomial;

std::pair<Polynomial, Polynomial> split(const Polynomial& p, int variable) {
  Polynomial a, b;
  a.variables = b.variables = p.variables;
  for (core::Term term : p.terms) {
    int& exponent = term.exponents[static_cast<std::size_t>(variable)];
    core::ensure(exponent <= 1, "a sheet polynomial linear in its roots");
    Polynomial& part = exponent == 0 ? a : b;
    exponent = 0;
    part.terms.push_back(std::move(term));
  }
  return {a, b};
}

Polynomial reduce(Polynomial p, const core::RootTower& tower) {
  const int coordinates = static_cast<int>(tower.coordinates.size());
  for (int j = static_cast<int>(tower.roots.size()) - 1; j >= 0; --j) {
    const int variable = coordinates + j;
    while (core::degree_in(p, variable) > 1) {
      Polynomial low, high;
      low.variables = high.variables = p.variables;
      for (core::Term term : p.terms) {
        int& exponent = term.exponents[static_cast<std::size_t>(variable)];
        Polynomial& part = exponent > 1 ? high : low;
        if (exponent > 1) exponent -= 2;
        part.terms.push_back(std::move(term));
      }
      p = low + high * tower.roots[static_cast<std::size_t>(j)].square;
    }
  }
  return p;
}

int top_root(const Polynomial& p, const core::RootTower& tower) {
  const int coordinates = static_cast<int>(tower.coordinates.size());
  int top = static_cast<int>(tower.roots.size()) - 1;
  while (top >= 0 && !core::depends_on(p, coordinates + top)) --top;
  return top;
}

bool has_angle(const Polynomial& p, const core::RootTower& tower) {
  for (int j = 0; j < static_cast<int>(tower.roots.size()); ++j) {
    if (!core::depends_on(p, static_cast<int>(tower.coordinates.size()) + j)) continue;
    const core::Root& root = tower.roots[static_cast<std::size_t>(j)];
    if (root.is_angle() || has_angle(root.square, tower)) return true;
  }
  return false;
}

bool is_root_of_angle(const core::RootTower& tower, std::size_t j) {
  return !tower.roots[j].is_angle() && has_angle(tower.roots[j].square, tower);
}

Polynomial conjugate_product(const Polynomial& p, int root, const core::RootTower& tower) {
  const auto [a, b] = split(p, static_cast<int>(tower.coordinates.size()) + root);
  return reduce(a * a - b * b * tower.roots[static_cast<std::size_t>(root)].square, tower);
}

Polynomial norm(Polynomial p, const core::RootTower& tower) {
  for (int root = top_root(p, tower); root >= 0; root = top_root(p, tower)) {
    p = conjugate_product(p, root, tower);
    if (!p.is_zero()) p = core::primitive_part(p);
  }
  return core::with_variables(p, static_cast<int>(tower.coordinates.size()));
}

std::optional<Polynomial> quotient(Polynomial p, Polynomial divisor, const core::RootTower& tower) {
  for (int root = top_root(divisor, tower); root >= 0; root = top_root(divisor, tower)) {
    const auto [a, b] = split(divisor, static_cast<int>(tower.coordinates.size()) + root);
    p = reduce(p * (a + a - divisor), tower);
    divisor = conjugate_product(divisor, root, tower);
    if (divisor.is_zero()) return std::nullopt;  // the tower is no field, as is known of none of its open roots
  }
  return core::exact_quotient(p, divisor);
}

double norm_degree(const Polynomial& p, const core::RootTower& tower) {
  // A root weighs half the degree of its square; weights of nested ones add up from the first on.
  const std::size_t coordinates = tower.coordinates.size();
  std::vector<double> weights(coordinates, 1.0);
  const auto weighted = [&weights](const Polynomial& element) {
    double degree = 0;
    for (const core::Term& term : element.terms) {
      double weight = 0;
      for (std::size_t i = 0; i < weights.size(); ++i) weight += weights[i] * term.exponents[i];
      degree = std::max(degree, weight);
    }
    return degree;
  };
  for (const core::Root& root : tower.roots) weights.push_back(weighted(root.square) / 2);
  return std::ldexp(weighted(p), static_cast<int>(core::roots_under(p, tower).size()));
}

}  // namespace clearloci::loci
