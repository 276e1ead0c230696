#include "core/expression.hpp"

#include <utility>

#include "core/errors.hpp"

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

  bool begins_with_minus() const { return text.front() == '-'; }
};

Printed print(const Expression& expression);

/// The text where at least `needed` binding is required.
std::string enclosed(const Printed& printed, Binding needed) {
  return printed.binding < needed ? "(" + printed.text + ")" : printed.text;
}

/// As a right operand, where a leading minus would meet an operator.
std::string enclosed_right(const Printed& printed, Binding needed) {
  return printed.begins_with_minus() ? "(" + printed.text + ")" : enclosed(printed, needed);
}

Printed print_number(const Rational& value) {
  if (value.get_den() != 1) return {to_string(value), product};
  return {to_string(value), sgn(value) < 0 ? product : atom};
}

Printed print_sum(const Expression& left, const Expression& right) {
  const std::string first = enclosed(print(left), sum);
  if (right.kind() == Kind::negate) return {first + " - " + enclosed_right(print(right.arguments()[0]), product), sum};
  const Printed second = print(right);
  // -2*x as a second summand: subtract 2*x. The minus of a sum belongs to its first summand only: a + (-b + c). What
  // begins with two of them stays whole: a - (-b)*c would be read as a - ((-b)*c), and printed so.
  const bool subtracts = second.begins_with_minus() && second.binding >= product && second.text.substr(1, 2) != "(-";
  if (subtracts) return {first + " - " + second.text.substr(1), sum};
  return {first + " + " + enclosed_right(second, sum), sum};
}

Printed print(const Expression& expression) {
  const auto operand = [&expression](std::size_t index) { return print(expression.arguments()[index]); };
  switch (expression.kind()) {
    case Kind::number:
      return print_number(expression.value());
    case Kind::symbol:
      return {expression.name(), atom};
    case Kind::pi:
      return {"pi", atom};
    case Kind::add:
      return print_sum(expression.arguments()[0], expression.arguments()[1]);
    case Kind::multiply:
      return {enclosed(operand(0), product) + "*" + enclosed_right(operand(1), product), product};
    case Kind::divide:
      return {enclosed(operand(0), product) + "/" + enclosed_right(operand(1), exponentiation), product};
    case Kind::power:
      return {enclosed(operand(0), atom) + "^" + enclosed_right(operand(1), exponentiation), exponentiation};
    case Kind::negate:
      return {"-" + enclosed_right(operand(0), product), product};
    case Kind::sqrt:
      return {"sqrt(" + operand(0).text + ")", atom};
    case Kind::cos:
      return {"cos(" + operand(0).text + ")", atom};
    case Kind::sin:
      return {"sin(" + operand(0).text + ")", atom};
  }
  return {};
}

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

std::string to_string(const Expression& expression) { return print(expression).text; }

}  // namespace clearloci::inline core
