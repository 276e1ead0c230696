#include "loci/curves/simple_zeros.hpp"

#include <algorithm>
#include <cstdint>
#include <map>

#include "core/dense_terms.hpp"
#include "core/interval.hpp"

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
  core::Interval nearly;  ///< the value in doubles
  bool imaginary = false;
};

template <class Number>
struct Complex {
  Number real, imaginary;
  bool is_real = true;  ///< there is no imaginary part
  bool excludes_zero() const { return real.sign() != 0 || imaginary.sign() != 0; }
};

core::Interval in_doubles(const MultiInterval& value) { return {value.lower(), value.upper()}; }

std::size_t variable_of(const RootTower& tower, std::size_t root) { return tower.coordinates.size() + root; }

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
    for (const auto& [product, part] : parts) {
      const MultiInterval coefficient = evaluate(part, coordinates);
      terms_.push_back({product, coefficient, in_doubles(coefficient)});
    }
  }

  /// No root occurs.
  bool is_plain() const {
    return std::all_of(terms_.begin(), terms_.end(), [](const Term& term) { return term.product == 0; });
  }

  Complex<MultiInterval> value(const std::vector<ConjugateRoot>& roots) const {
    return value<MultiInterval>(roots, &Term::coefficient, &ConjugateRoot::value);
  }
  Complex<core::Interval> value_in_doubles(const std::vector<ConjugateRoot>& roots) const {
    return value<core::Interval>(roots, &Term::nearly, &ConjugateRoot::nearly);
  }

 private:
  struct Term {
    std::uint32_t product = 0;
    MultiInterval coefficient;
    core::Interval nearly;
  };

  template <class Number>
  Complex<Number> value(const std::vector<ConjugateRoot>& roots, Number Term::*coefficient,
                        Number ConjugateRoot::*root_value) const {
    Complex<Number> sum{Number(0.0), Number(0.0)};
    for (const Term& term_of_roots : terms_) {
      Number term = term_of_roots.*coefficient;
      int turns = 0;  // powers of i
      for (std::size_t k = 0; k < roots.size(); ++k)
        if ((term_of_roots.product >> k & 1U) != 0) {
          term = term * (roots[k].*root_value);
          turns += roots[k].imaginary ? 1 : 0;
        }
      if (turns % 4 >= 2) term = -term;
      sum.is_real = sum.is_real && turns % 2 == 0;
      Number& part = turns % 2 == 0 ? sum.real : sum.imaginary;
      part = part + term;
    }
    return sum;
  }

  std::vector<Term> terms_;
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
    fixed_.resize(roots.size());
  }

  bool are_nonzero() { return nonzero_from(true); }

 private:
  /// A root of a square that is proven to be real and not zero; its sign is that of the working mode.
  std::optional<ConjugateRoot> root_of(std::size_t k) const {
    std::vector<ConjugateRoot> before = chosen_;  // a square is computed from the roots before its own
    before.resize(squares_.size());
    const Complex<MultiInterval> square = squares_[k].value(before);
    const int sign = square.real.sign();
    if (!square.is_real || sign == 0) return std::nullopt;
    const MultiInterval size = square_root(sign > 0 ? square.real : -square.real);
    const MultiInterval value = signs_[k] > 0 ? size : -size;
    return ConjugateRoot{value, in_doubles(value), sign < 0};
  }

  /// The roots before those of `chosen_` have their signs; `mode`: those of the working mode.
  bool nonzero_from(bool mode) {
    const std::size_t k = chosen_.size();
    if (k == squares_.size())
      return mode || p_.value_in_doubles(chosen_).excludes_zero() || p_.value(chosen_).excludes_zero();
    std::optional<ConjugateRoot>& conjugate_root = fixed_[k];
    std::optional<ConjugateRoot> root = conjugate_root ? conjugate_root : root_of(k);
    if (!root) return false;
    if (squares_[k].is_plain()) conjugate_root = root;
    for (const bool same : {true, false}) {
      chosen_.push_back(same ? *root : ConjugateRoot{-root->value, -root->nearly, root->imaginary});
      const bool nonzero = nonzero_from(mode && same);
      chosen_.pop_back();
      if (!nonzero) return false;
    }
    return true;
  }

  AtPoint p_;
  std::vector<AtPoint> squares_;
  std::vector<int> signs_;                           ///< of the roots in the working mode
  std::vector<std::optional<ConjugateRoot>> fixed_;  ///< those whose squares hold no other root
  std::vector<ConjugateRoot> chosen_;
};

/// The derivative by a coordinate on the sheet.
MultiInterval slope_over(const std::vector<std::size_t>& roots, const Polynomial& p, int coordinate,
                         const RootTower& tower, const std::vector<MultiInterval>& at) {
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

/// The roots under a polynomial; nothing where one of them is an angle, not known, or may vanish.
std::optional<std::vector<std::size_t>> regular_roots(const Polynomial& p, const RootTower& tower,
                                                      const std::vector<MultiInterval>& at) {
  std::vector<std::size_t> roots = roots_under(p, tower);
  if (roots.size() > most_roots) return std::nullopt;
  for (const std::size_t j : roots)
    if (tower.roots[j].is_angle() || variable_of(tower, j) >= at.size() || at[variable_of(tower, j)].sign() == 0)
      return std::nullopt;
  return roots;
}

}  // namespace

bool vanishes_where_norm_does(const Polynomial& p, const RootTower& tower, const std::vector<MultiInterval>& at) {
  const auto roots = regular_roots(p, tower, at);
  return roots && OtherConjugates(p, tower, *roots, at).are_nonzero();
}

int slope_on_sheet(const Polynomial& p, int coordinate, const RootTower& tower, const std::vector<MultiInterval>& at) {
  const auto roots = regular_roots(p, tower, at);
  return roots ? slope_over(*roots, p, coordinate, tower, at).sign() : 0;
}

std::optional<int> slope_at_simple_zero(const Polynomial& p, const Polynomial& curve, const RootTower& tower,
                                        const std::vector<MultiInterval>& at) {
  for (int i = 0; i < static_cast<int>(tower.coordinates.size()); ++i) {
    const int across = evaluate(core::scaled_for_doubles(core::derivative(curve, i)), at).sign();
    if (across == 0) continue;
    const int along = slope_on_sheet(p, i, tower, at);
    if (along == 0) continue;
    if (!vanishes_where_norm_does(p, tower, at)) return std::nullopt;
    return across * along;
  }
  return std::nullopt;
}

}  // namespace clearloci::loci
