#include "loci/curves/simple_zeros.hpp"

#include <algorithm>
#include <cstdint>
#include <map>

#include "core/dense_terms.hpp"

namespace clearloci::loci {
namespace {

using core::Polynomial;
using core::RootTower;
using sheet::MultiInterval;

/// Conjugates that are looked at: of so many roots.
constexpr std::size_t most_roots = 8;

/// A real number, times i where it is imaginary.
struct ConjugateRoot {
  MultiInterval value;
  bool imaginary = false;
};

struct ComplexInterval {
  MultiInterval real, imaginary;
  bool is_real = true;  ///< there is no imaginary part
  bool excludes_zero() const { return real.sign() != 0 || imaginary.sign() != 0; }
};

std::size_t variable_of(const RootTower& tower, std::size_t root) { return tower.coordinates.size() + root; }

/// The roots that a polynomial holds, and those in their squares, in the tower's order.
std::vector<std::size_t> roots_under(const Polynomial& p, const RootTower& tower) {
  std::vector<bool> used(tower.roots.size(), false);
  for (std::size_t j = used.size(); j-- > 0;) {
    const int variable = static_cast<int>(variable_of(tower, j));
    used[j] = core::depends_on(p, variable);
    for (std::size_t k = j + 1; k < used.size(); ++k)
      used[j] = used[j] || (used[k] && core::depends_on(tower.roots[k].square, variable));
  }
  std::vector<std::size_t> roots;
  for (std::size_t j = 0; j < used.size(); ++j)
    if (used[j]) roots.push_back(j);
  return roots;
}

/// A polynomial at a point of the plane: its coefficients at the products of roots, each a set of bits of the roots of
/// a list.
class AtPoint {
 public:
  AtPoint(const Polynomial& p, const RootTower& tower, const std::vector<std::size_t>& roots,
          const std::vector<MultiInterval>& at) {
    std::map<std::uint32_t, Polynomial> parts;
    for (core::Term term : p.terms) {
      std::uint32_t product = 0;
      for (std::size_t k = 0; k < roots.size(); ++k)
        if (std::exchange(term.exponents[variable_of(tower, roots[k])], 0) > 0) product |= std::uint32_t{1} << k;
      Polynomial& part = parts[product];
      part.variables = p.variables;
      part.terms.push_back(std::move(term));
    }
    std::vector<MultiInterval> coordinates(at.begin(),
                                           at.begin() + static_cast<std::ptrdiff_t>(tower.coordinates.size()));
    coordinates.resize(static_cast<std::size_t>(p.variables), MultiInterval(0.0));
    for (const auto& [product, part] : parts) terms_.emplace_back(product, evaluate(part, coordinates));
  }

  ComplexInterval value(const std::vector<ConjugateRoot>& roots) const {
    ComplexInterval sum;
    for (const auto& [product, coefficient] : terms_) {
      MultiInterval term = coefficient;
      int turns = 0;  // powers of i
      for (std::size_t k = 0; k < roots.size(); ++k)
        if ((product >> k & 1U) != 0) {
          term = term * roots[k].value;
          turns += roots[k].imaginary ? 1 : 0;
        }
      if (turns % 4 >= 2) term = -term;
      sum.is_real = sum.is_real && turns % 2 == 0;
      MultiInterval& part = turns % 2 == 0 ? sum.real : sum.imaginary;
      part = part + term;
    }
    return sum;
  }

 private:
  std::vector<std::pair<std::uint32_t, MultiInterval>> terms_;
};

/// Whether every conjugate but the one of the working mode is proven not to vanish at a point.
class OtherConjugates {
 public:
  OtherConjugates(const Polynomial& p, const RootTower& tower, const std::vector<std::size_t>& roots,
                  const std::vector<MultiInterval>& at)
      : p_(p, tower, roots, at) {
    for (const std::size_t j : roots) {
      squares_.emplace_back(tower.roots[j].square, tower, roots, at);
      signs_.push_back(at[variable_of(tower, j)].sign());
    }
  }

  bool are_nonzero() { return nonzero_from(true); }

 private:
  /// The roots before those of `chosen_` have their signs; `mode`: those of the working mode.
  bool nonzero_from(bool mode) {
    if (chosen_.size() == squares_.size()) return mode || p_.value(chosen_).excludes_zero();
    // A square is computed from the roots before its own.
    std::vector<ConjugateRoot> before = chosen_;
    before.resize(squares_.size());
    const ComplexInterval square = squares_[chosen_.size()].value(before);
    if (!square.is_real) return false;
    const int sign = square.real.sign();
    if (sign == 0) return false;
    const MultiInterval size = square_root(sign > 0 ? square.real : -square.real);
    const int own = signs_[chosen_.size()];
    for (const int side : {own, -own}) {
      chosen_.push_back({side > 0 ? size : -size, sign < 0});
      const bool nonzero = nonzero_from(mode && side == own);
      chosen_.pop_back();
      if (!nonzero) return false;
    }
    return true;
  }

  AtPoint p_;
  std::vector<AtPoint> squares_;
  std::vector<int> signs_;  ///< of the roots in the working mode
  std::vector<ConjugateRoot> chosen_;
};

/// The derivative by a coordinate on the sheet.
MultiInterval slope_on_sheet(const Polynomial& p, int coordinate, const RootTower& tower,
                             const std::vector<std::size_t>& roots, const std::vector<MultiInterval>& at) {
  std::map<std::size_t, MultiInterval> slopes;  // of the roots
  const auto slope = [&](const Polynomial& of) {
    MultiInterval sum = evaluate(core::derivative(of, coordinate), at);
    for (const auto& [root, change] : slopes)
      if (const int variable = static_cast<int>(variable_of(tower, root)); core::depends_on(of, variable))
        sum = sum + evaluate(core::derivative(of, variable), at) * change;
    return sum;
  };
  for (const std::size_t j : roots)
    slopes.emplace(j, slope(tower.roots[j].square) * inverse(MultiInterval(2.0) * at[variable_of(tower, j)]));
  return slope(p);
}

}  // namespace

std::optional<int> slope_at_simple_zero(const Polynomial& p, const Polynomial& curve, const RootTower& tower,
                                        const std::vector<MultiInterval>& at) {
  const std::vector<std::size_t> roots = roots_under(p, tower);
  if (roots.size() > most_roots) return std::nullopt;
  for (const std::size_t j : roots)
    if (tower.roots[j].is_angle() || variable_of(tower, j) >= at.size() || at[variable_of(tower, j)].sign() == 0)
      return std::nullopt;
  for (int i = 0; i < static_cast<int>(tower.coordinates.size()); ++i) {
    const int across = evaluate(core::scaled_for_doubles(core::derivative(curve, i)), at).sign();
    if (across == 0) continue;
    const int along = slope_on_sheet(p, i, tower, roots, at).sign();
    if (along == 0) continue;
    if (!OtherConjugates(p, tower, roots, at).are_nonzero()) return std::nullopt;
    return across * along;
  }
  return std::nullopt;
}

}  // namespace clearloci::loci
