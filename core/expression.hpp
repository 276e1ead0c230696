// An expression as the user wrote it: numbers, parameters, coordinates and a few functions. Exact, immutable.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/rational.hpp"

namespace clearloci::inline core {

class Expression {
 public:
  enum class Kind { number, symbol, pi, add, multiply, divide, power, negate, sqrt, cos, sin, atan };

  Expression();  ///< the number 0
  static Expression number(Rational value);
  static Expression symbol(std::string name);
  static Expression pi();
  /// `arguments`: two for add, multiply, divide, power; one for negate and the functions.
  static Expression apply(Kind kind, std::vector<Expression> arguments);

  Kind kind() const { return node_->kind; }
  const Rational& value() const { return node_->value; }   ///< of a number
  const std::string& name() const { return node_->name; }  ///< of a symbol
  const std::vector<Expression>& arguments() const { return node_->arguments; }

  /// True for a number equal to 0 (not for an expression that merely evaluates to 0).
  bool is_zero_literal() const;

 private:
  struct Node {
    Kind kind = Kind::number;
    Rational value;
    std::string name;
    std::vector<Expression> arguments;
  };
  explicit Expression(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  std::shared_ptr<const Node> node_;
};

/// Every symbol that occurs.
std::set<std::string> symbols(const Expression& expression);

/// Infix, with the fewest parentheses that keep its meaning.
std::string to_string(const Expression& expression);

}  // namespace clearloci::inline core
