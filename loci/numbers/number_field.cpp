#include "loci/numbers/number_field.hpp"

#include <utility>

#include "core/reduced.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Rational;
using Element = NumberField::Element;

void trim(Element& a) {
  while (!a.empty() && a.back() == 0) a.pop_back();
}

/// Adds factor x^power b.
void add_multiple(Element& a, const Rational& factor, std::size_t power, const Element& b) {
  if (a.size() < b.size() + power) a.resize(b.size() + power);
  for (std::size_t i = 0; i < b.size(); ++i) a[i + power] += factor * b[i];
  trim(a);
}

}  // namespace

NumberField::NumberField(RealRoot alpha) {
  narrow_by(alpha, MultiInterval::precision);
  alpha_ = MultiInterval(alpha.lower, alpha.upper);
  for (const core::Integer& c : alpha.polynomial) monic_.push_back(core::reduced(c, alpha.polynomial.back()));
}

Element NumberField::reduced(Element a) const {
  const auto n = static_cast<std::size_t>(degree());
  trim(a);
  while (a.size() > n) {
    const Rational factor = -a.back();
    add_multiple(a, factor, a.size() - 1 - n, monic_);
  }
  return a;
}

Element NumberField::sum(const Element& a, const Element& b) const {
  Element result = a;
  add_multiple(result, 1, 0, b);
  return result;
}

Element NumberField::times(const Element& a, const Rational& factor) const {
  Element result;
  add_multiple(result, factor, 0, a);
  return result;
}

Element NumberField::product(const Element& a, const Element& b) const {
  Element result;
  for (std::size_t i = 0; i < a.size(); ++i) add_multiple(result, a[i], i, b);
  return reduced(std::move(result));
}

/// By Euclid's algorithm: r = s a modulo the polynomial of alpha for every pair (r, s).
Element NumberField::inverse(const Element& a) const {
  Element r = monic_, s, next = a, next_s = {1};
  while (next.size() > 1) {
    while (r.size() >= next.size()) {
      const Rational factor = -r.back() / next.back();
      const std::size_t power = r.size() - next.size();
      add_multiple(r, factor, power, next);
      add_multiple(s, factor, power, next_s);
    }
    std::swap(r, next);
    std::swap(s, next_s);
  }
  return reduced(times(next_s, 1 / next.front()));
}

MultiInterval NumberField::enclosure(const Element& a) const {
  MultiInterval value;
  for (auto c = a.rbegin(); c != a.rend(); ++c) value = value * alpha_ + MultiInterval(*c);
  return value;
}

}  // namespace clearloci::loci::sheet
