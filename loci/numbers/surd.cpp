#include "loci/numbers/surd.hpp"

#include "core/errors.hpp"

namespace clearloci::loci {

using core::Rational;

Surd::Surd(const Rational& value) {
  if (value != 0) terms_.push_back({value, 1});
}

Surd Surd::root_of(const Rational& square) {
  core::ensure(square >= 0, "a square is not negative");
  if (const std::optional<Rational> root = core::square_root(square)) return Surd(*root);
  Surd result;
  result.terms_.push_back({1, square});
  return result;
}

std::optional<Rational> Surd::rational() const {
  if (terms_.empty()) return Rational(0);
  const Term& only = terms_.front();
  const std::optional<Rational> root = terms_.size() == 1 ? core::square_root(only.radicand) : std::nullopt;
  if (!root) return std::nullopt;
  return Rational(only.factor * *root);
}

std::optional<Surd> Surd::reciprocal() const {
  if (terms_.empty() || terms_.size() > 2) return std::nullopt;
  Rational norm = 0, sign = 1;
  for (const Term& term : terms_) {
    norm += sign * term.factor * term.factor * term.radicand;
    sign = -1;
  }
  Surd conjugate = *this;
  if (terms_.size() == 2) conjugate.terms_.back().factor = -conjugate.terms_.back().factor;
  return conjugate * Surd(Rational(1 / norm));
}

void Surd::add(Term term) {
  for (auto known = terms_.begin(); known != terms_.end(); ++known) {
    const std::optional<Rational> ratio = core::square_root(term.radicand / known->radicand);
    if (!ratio) continue;
    known->factor += term.factor * *ratio;
    if (known->factor == 0) terms_.erase(known);
    return;
  }
  if (term.factor != 0) terms_.push_back(std::move(term));
}

Surd operator+(Surd a, const Surd& b) {
  for (const Surd::Term& term : b.terms_) a.add(term);
  return a;
}

Surd operator-(Surd a, const Surd& b) {
  for (const Surd::Term& term : b.terms_) a.add({-term.factor, term.radicand});
  return a;
}

Surd operator*(const Surd& a, const Surd& b) {
  Surd product;
  for (const Surd::Term& x : a.terms_)
    for (const Surd::Term& y : b.terms_) product.add({x.factor * y.factor, x.radicand * y.radicand});
  return product;
}

}  // namespace clearloci::loci
