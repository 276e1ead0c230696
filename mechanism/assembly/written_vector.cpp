#include "mechanism/assembly/written_vector.hpp"

#include <algorithm>

namespace clearloci::mechanism {
namespace {

void add_term(Terms& terms, const Term& term) {
  if (term.amount.is_zero()) return;
  for (Term& entry : terms)
    if (entry.factor == term.factor) {
      entry.amount = entry.amount + term.amount;
      std::erase_if(terms, [](const Term& one) { return one.amount.is_zero(); });
      return;
    }
  terms.push_back(term);
}

std::string product(const std::string& a, const std::string& b) {
  if (a.empty()) return b;
  return b.empty() ? a : a + "*" + b;
}

template <typename Change>
WrittenVector changed(WrittenVector vector, const Change& change) {
  for (Terms& terms : vector.components)
    for (Term& term : terms) change(term);
  for (Term& term : vector.ways) change(term);
  return vector;
}

}  // namespace

std::string text_of(const Terms& terms) {
  std::string text;
  for (const Term& entry : terms) {
    const bool negative = entry.amount.is_exact() && entry.amount.value() < 0;
    const Amount size = negative ? -entry.amount : entry.amount;
    std::string term;
    if (entry.factor.empty())
      term = size.text(!size.is_exact() && !text.empty());
    else if (size.is_rational() && size.rational() == 1)
      term = entry.factor;
    else
      term = size.text(true) + "*" + entry.factor;
    text += text.empty() ? (negative ? "-" : "") : (negative ? " - " : " + ");
    text += term;
  }
  return text.empty() ? "0" : text;
}

bool WrittenVector::is_constant() const {
  return ways.empty() && std::all_of(components.begin(), components.end(), [](const Terms& terms) {
           return std::all_of(terms.begin(), terms.end(), [](const Term& term) { return term.factor.empty(); });
         });
}

bool WrittenVector::is_zero() const {
  return ways.empty() && std::all_of(components.begin(), components.end(), [](const Terms& t) { return t.empty(); });
}

WrittenVector& WrittenVector::operator+=(const WrittenVector& other) {
  for (std::size_t i = 0; i < 3; ++i)
    for (const Term& term : other.components[i]) add_term(components[i], term);
  for (const Term& term : other.ways) add_term(ways, term);
  return *this;
}

WrittenVector constant_vector(const Amounts& amounts) {
  WrittenVector result;
  for (std::size_t i = 0; i < 3; ++i) add_term(result.components[i], {amounts[i], ""});
  return result;
}

WrittenVector way_between(const std::string& from, const std::string& to) {
  WrittenVector result;
  result.ways.push_back({Amount(core::Rational(1)), "(" + to + " - " + from + ")"});
  return result;
}

WrittenVector operator+(WrittenVector a, const WrittenVector& b) { return a += b; }

WrittenVector operator*(const Amount& factor, WrittenVector vector) {
  if (factor.is_zero()) return {};
  return changed(std::move(vector), [&](Term& term) { term.amount = factor * term.amount; });
}

WrittenVector times(const std::string& function, WrittenVector vector) {
  return changed(std::move(vector), [&](Term& term) { term.factor = product(function, term.factor); });
}

WrittenVector left_of(const WrittenVector& vector) {
  WrittenVector result;
  for (Term term : vector.components[1]) {
    term.amount = -term.amount;
    result.components[0].push_back(term);
  }
  result.components[1] = vector.components[0];
  return result;
}

std::string text_of(const WrittenVector& vector, std::size_t dimension) {
  std::string text = vector.ways.empty() ? "" : text_of(vector.ways);
  const bool none =
      std::all_of(vector.components.begin(), vector.components.end(), [](const Terms& t) { return t.empty(); });
  if (none && !text.empty()) return text;
  if (!text.empty()) text += " + ";
  text += "[";
  for (std::size_t i = 0; i < dimension; ++i) text += (i == 0 ? "" : ", ") + text_of(vector.components[i]);
  return text + "]";
}

}  // namespace clearloci::mechanism
