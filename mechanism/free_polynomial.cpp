#include "mechanism/free_polynomial.hpp"

#include <algorithm>

#include "core/interpret.hpp"
#include "mechanism/evaluate.hpp"

namespace clearloci::mechanism {
namespace {

/// Expressions as polynomials in the new coordinates (core/interpret.hpp).
class Polynomials {
 public:
  using Value = FreePolynomial;

  Polynomials(const Mechanism& mechanism, const Frame& frame, Parameters parameters)
      : mechanism_(mechanism), frame_(frame), parameters_(parameters) {}

  std::optional<Value> known(const Expression& e) const {
    using Kind = Expression::Kind;
    const std::set<std::string> names = core::symbols(e);
    if (!is_free(names)) return constant(e, names);
    if (e.kind() != Kind::cos && e.kind() != Kind::sin) return std::nullopt;
    for (const Coordinate& coordinate : mechanism_.coordinates)
      if (!coordinate.angle && names.contains(coordinate.name)) throw NotPolynomial{};
    return Value::atom(e);
  }
  Value number(const Rational& value) const { return Value(value); }
  Value symbol(const std::string& name) const {
    const auto& all = mechanism_.coordinates;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Coordinate& coordinate) { return coordinate.name == name; });
    if (found->angle) throw NotPolynomial{};
    const Rational& from = frame_.from[static_cast<std::size_t>(found - all.begin())];
    return Value(from) + Value(frame_.scale) * Value::atom(Expression::symbol(name));
  }
  Value negate(const Value& a) const { return Value(-1) * a; }
  Value add(const Value& a, const Value& b) const { return a + b; }
  Value multiply(const Value& a, const Value& b) const { return a * b; }
  Value divide(const Value& a, const Value&, const Expression& e) const {
    const Expression& by = e.arguments()[1];
    if (is_free(core::symbols(by))) throw NotPolynomial{};
    if (parameters_ == Parameters::kept && !core::symbols(by).empty())
      return a * Value::atom(Expression::apply(Expression::Kind::divide, {Expression::number(1), by}));
    return a * Value(1 / value_of(by, mechanism_));
  }
  Value power(const Value& a, const Expression& e) const {
    constexpr int most = 24;
    if (is_free(core::symbols(e.arguments()[1]))) throw NotPolynomial{};
    const Rational exponent = value_of(e.arguments()[1], mechanism_);
    if (exponent.get_den() != 1 || exponent < 0 || exponent > most) throw NotPolynomial{};
    Value result(1);
    for (Rational i = 0; i < exponent; ++i) result = result * a;
    return result;
  }
  Value pi() const { throw NotPolynomial{}; }
  Value sqrt(const Value&, const Expression&) const { throw NotPolynomial{}; }
  Value cos(const Value&, const Expression&) const { throw NotPolynomial{}; }
  Value sin(const Value&, const Expression&) const { throw NotPolynomial{}; }
  Value atan(const Value& a, const Expression&) const {
    return Value::atom(Expression::apply(Expression::Kind::atan, {a.expression()}));
  }

 private:
  bool is_free(const std::set<std::string>& names) const {
    return std::any_of(mechanism_.coordinates.begin(), mechanism_.coordinates.end(),
                       [&](const Coordinate& coordinate) { return names.contains(coordinate.name); });
  }

  Value constant(const Expression& e, const std::set<std::string>& names) const {
    if (parameters_ == Parameters::valued) return Value(value_of(e, mechanism_));
    if (!names.empty()) return Value::atom(e);
    const ExactValue value = evaluate(e, mechanism_.parameters);
    return value.exact ? Value(value.value) : Value::atom(e);
  }

  const Mechanism& mechanism_;
  const Frame& frame_;
  Parameters parameters_;
};

}  // namespace

FreePolynomial FreePolynomial::atom(const Expression& expression) {
  FreePolynomial sum(0);
  const std::string text = core::to_string(expression);
  sum.atoms_.emplace(text, expression);
  sum.add({{text, 1}}, 1);
  return sum;
}

FreePolynomial operator+(FreePolynomial a, const FreePolynomial& b) {
  a.atoms_.insert(b.atoms_.begin(), b.atoms_.end());
  for (const auto& [monomial, coefficient] : b.terms_) a.add(monomial, coefficient);
  return a;
}

FreePolynomial operator*(const FreePolynomial& a, const FreePolynomial& b) {
  FreePolynomial product(0);
  product.atoms_ = a.atoms_;
  product.atoms_.insert(b.atoms_.begin(), b.atoms_.end());
  for (const auto& [m, p] : a.terms_)
    for (const auto& [n, q] : b.terms_) {
      FreePolynomial::Monomial both = m;
      for (const auto& [atom, power] : n) both[atom] += power;
      product.add(both, p * q);
    }
  return product;
}

Rational FreePolynomial::constant() const {
  const auto term = terms_.find({});
  return term == terms_.end() ? Rational(0) : term->second;
}

Expression FreePolynomial::expression() const {
  using Kind = Expression::Kind;
  std::optional<Expression> sum;
  for (const auto& [monomial, coefficient] : terms_) {
    Expression product = Expression::number(coefficient);
    for (const auto& [atom, power] : monomial) {
      const Expression& base = atoms_.at(atom);
      product = Expression::apply(
          Kind::multiply,
          {product, power == 1 ? base : Expression::apply(Kind::power, {base, Expression::number(power)})});
    }
    sum = sum ? Expression::apply(Kind::add, {*sum, product}) : product;
  }
  return sum.value_or(Expression::number(0));
}

void FreePolynomial::add(const Monomial& monomial, const Rational& coefficient) {
  Rational& total = terms_[monomial];
  total += coefficient;
  if (total == 0) terms_.erase(monomial);
}

FreePolynomial free_polynomial(const Expression& expression, const Mechanism& mechanism, const Frame& frame,
                               Parameters parameters) {
  return core::interpret(expression, Polynomials(mechanism, frame, parameters));
}

}  // namespace clearloci::mechanism
