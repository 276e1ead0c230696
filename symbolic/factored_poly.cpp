#include "symbolic/factored_poly.hpp"

#include <algorithm>
#include <optional>

#include "core/errors.hpp"

namespace clearloci::symbolic {

int FactoredPoly::multiplicity(const Poly& factor) const {
  for (const PolyFactor& poly_factor : factors)
    if (poly_factor.poly == factor) return poly_factor.multiplicity;
  return 0;
}

FactoredPoly factored(const Poly& p, const std::vector<PolyFactor>& likely) {
  FactoredPoly result;
  Poly rest = p;
  if (!p.is_zero()) {
    for (const PolyFactor& factor : likely) {
      PolyFactor found{factor.poly, 0};
      for (Poly quotient(p.ring()); rest.divides(factor.poly, quotient); ++found.multiplicity) rest = quotient;
      if (found.multiplicity > 0) result.factors.push_back(std::move(found));
    }
  }
  for (PolyFactor& factor : rest.factors(result.constant)) result.factors.push_back(std::move(factor));
  sort_factors(result.factors);
  return result;
}

void multiply(FactoredPoly& product, const FactoredPoly& factor, int times) {
  if (times == 0) return;
  for (int i = 0; i < std::abs(times); ++i) {
    if (times > 0)
      product.constant *= factor.constant;
    else
      product.constant /= factor.constant;
  }
  if (product.is_zero()) {
    product.factors.clear();
    return;
  }
  const std::size_t before = product.factors.size();
  for (const PolyFactor& part : factor.factors) {
    const auto found = std::find_if(product.factors.begin(), product.factors.end(),
                                    [&](const PolyFactor& f) { return f.poly == part.poly; });
    if (found == product.factors.end())
      product.factors.push_back({part.poly, part.multiplicity * times});
    else
      found->multiplicity += part.multiplicity * times;
  }
  const bool in_order = product.factors.size() == before || before == 0;
  std::erase_if(product.factors, [](const PolyFactor& f) { return f.multiplicity == 0; });
  if (!in_order) sort_factors(product.factors);
}

FactoredPoly common_factors(const FactoredPoly& a, const FactoredPoly& b) {
  FactoredPoly common{1, {}};
  for (const PolyFactor& factor : a.factors)
    if (const int times = std::min(factor.multiplicity, b.multiplicity(factor.poly)); times > 0)
      common.factors.push_back({factor.poly, times});
  return common;
}

FactoredPoly shared_factors(const std::vector<FactoredPoly>& products) {
  std::optional<FactoredPoly> shared;
  for (const FactoredPoly& p : products)
    if (!p.is_zero()) shared = common_factors(shared ? *shared : p, p);
  return shared.value_or(FactoredPoly{1, {}});
}

Poly sum_of_squares(const std::vector<Poly>& parts) {
  Poly sum = parts.at(0) * parts[0];
  for (std::size_t i = 1; i < parts.size(); ++i) sum += parts[i] * parts[i];
  return sum;
}

Poly without(FactoredPoly product, const FactoredPoly& factors, const Ring& ring) {
  multiply(product, factors, -1);
  return expanded(product, ring);
}

Poly expanded(const FactoredPoly& product, const Ring& ring) {
  Poly result(ring, product.constant);
  for (const PolyFactor& factor : product.factors) {
    core::ensure(factor.multiplicity > 0, "a polynomial, no quotient");
    result *= factor.poly.pow(static_cast<unsigned>(factor.multiplicity));
  }
  return result;
}

}  // namespace clearloci::symbolic
