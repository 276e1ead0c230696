#include "core/expression.hpp"

#include <utility>

#include "core/errors.hpp"
#include "core/interpret.hpp"

namespace clearloci::inline core {
namespace {

using Kind = Expression::Kind;

std::size_t arity(Kind kind) {
  switch (kind) {
    case Kind::number:
    case Kind::symbol:
    case Kind::pi:
      return 0;
    case Kind::negate:
    case Kind::sqrt:
    case Kind::cos:
    case Kind::sin:
    case Kind::atan:
      return 1;
    case Kind::add:
    case Kind::multiply:
    case Kind::divide:
    case Kind::power:
      return 2;
  }
  return 0;
}

void collect_symbols(const Expression& expression, std::set<std::string>& found) {
  if (expression.kind() == Kind::symbol) found.insert(expression.name());
  for (const Expression& argument : expression.arguments()) collect_symbols(argument, found);
}

// How tightly a printed text binds; `product` also covers a leading minus, which stands left of products only.
enum Binding { sum, product, exponentiation, atom };

struct Printed {
  std::string text;
  Binding binding = atom;
  bool is_negation = false;  ///< its text after the minus is what a sum subtracts

  bool begins_with_minus() const { return text.front() == '-'; }
};

/// The text where at least `needed` binding is required.
std::string enclosed(const Printed& printed, Binding needed) {
  return printed.binding < needed ? "(" + printed.text + ")" : printed.text;
}

/// As a right operand, where a leading minus would meet an operator.
std::string enclosed_right(const Printed& printed, Binding needed) {
  return printed.begins_with_minus() ? "(" + printed.text + ")" : enclosed(printed, needed);
}

/// Texts as an algebra (core/interpret.hpp).
struct Printing {
  using Value = Printed;

  Printed number(const Rational& value) const {
    if (value.get_den() != 1) return {to_string(value), product};
    return {to_string(value), sgn(value) < 0 ? product : atom};
  }
  Printed symbol(const std::string& name) const { return {name, atom}; }
  Printed pi() const { return {"pi", atom}; }
  Printed negate(const Printed& a) const { return {"-" + enclosed_right(a, product), product, true}; }

  Printed add(const Printed& a, const Printed& b) const {
    const std::string first = enclosed(a, sum);
    if (b.is_negation) return {first + " - " + b.text.substr(1), sum};
    // -2*x as a second summand: subtract 2*x. The minus of a sum belongs to its first summand only: a + (-b + c). What
    // begins with two of them stays whole: a - (-b)*c would be read as a - ((-b)*c), and printed so.
    const bool subtracts = b.begins_with_minus() && b.binding >= product && b.text.substr(1, 2) != "(-";
    if (subtracts) return {first + " - " + b.text.substr(1), sum};
    return {first + " + " + enclosed_right(b, sum), sum};
  }

  Printed multiply(const Printed& a, const Printed& b) const {
    return {enclosed(a, product) + "*" + enclosed_right(b, product), product};
  }
  Printed divide(const Printed& a, const Printed& b, const Expression&) const {
    return {enclosed(a, product) + "/" + enclosed_right(b, exponentiation), product};
  }
  Printed power(const Printed& a, const Expression& e) const {
    const Printed exponent = interpret(e.arguments()[1], *this);
    return {enclosed(a, atom) + "^" + enclosed_right(exponent, exponentiation), exponentiation};
  }
  Printed sqrt(const Printed& a, const Expression&) const { return {"sqrt(" + a.text + ")", atom}; }
  Printed cos(const Printed& a, const Expression&) const { return {"cos(" + a.text + ")", atom}; }
  Printed sin(const Printed& a, const Expression&) const { return {"sin(" + a.text + ")", atom}; }
  Printed atan(const Printed& a, const Expression&) const { return {"atan(" + a.text + ")", atom}; }
};

}  // namespace

Expression::Expression() : node_(std::make_shared<Node>()) {}

Expression Expression::number(Rational value) {
  Node node;
  node.value = std::move(value);
  return Expression(std::make_shared<const Node>(std::move(node)));
}

Expression Expression::symbol(std::string name) {
  ensure(!name.empty(), "a symbol has a name");
  Node node;
  node.kind = Kind::symbol;
  node.name = std::move(name);
  return Expression(std::make_shared<const Node>(std::move(node)));
}

Expression Expression::pi() {
  Node node;
  node.kind = Kind::pi;
  return Expression(std::make_shared<const Node>(std::move(node)));
}

Expression Expression::apply(Kind kind, std::vector<Expression> arguments) {
  ensure(arity(kind) > 0 && arguments.size() == arity(kind), "an operation has its number of arguments");
  Node node;
  node.kind = kind;
  node.arguments = std::move(arguments);
  return Expression(std::make_shared<const Node>(std::move(node)));
}

bool Expression::is_zero_literal() const { return kind() == Kind::number && sgn(value()) == 0; }

std::set<std::string> symbols(const Expression& expression) {
  std::set<std::string> found;
  collect_symbols(expression, found);
  return found;
}

std::string to_string(const Expression& expression) { return interpret(expression, Printing{}).text; }

}  // namespace clearloci::inline core
