#include "mechanism/evaluate.hpp"

#include <map>
#include <stdexcept>

#include "mechanism/radical_sum.hpp"

namespace clearloci::mechanism {
namespace {

/// Evaluates with every parameter's own expression, not its value: cos(a) with a = 90 deg is 0 exactly.
class Evaluator {
 public:
  explicit Evaluator(const std::vector<Parameter>& parameters) : parameters_(parameters) {}

  RadicalSum operator()(const Expression& expression) {
    using Kind = Expression::Kind;
    const auto argument = [&](std::size_t index) { return (*this)(expression.arguments()[index]); };
    switch (expression.kind()) {
      case Kind::number:
        return radical_sum(expression.value());
      case Kind::symbol:
        return parameter(expression.name());
      case Kind::pi:
        return pi_multiple(1);
      case Kind::add:
        return argument(0) + argument(1);
      case Kind::multiply:
        return argument(0) * argument(1);
      case Kind::divide:
        return argument(0) / argument(1);
      case Kind::power:
        return power(argument(0), argument(1));
      case Kind::negate:
        return -argument(0);
      case Kind::sqrt:
        return square_root(argument(0));
      case Kind::cos:
      case Kind::sin: {
        const CirclePoint point = circle_point(argument(0));
        RadicalSum result = radical_sum(expression.kind() == Kind::cos ? point.cosine : point.sine);
        result.exact = point.exact;
        return result;
      }
    }
    throw std::logic_error("an expression of unknown kind");
  }

 private:
  RadicalSum parameter(const std::string& name) {
    const auto known = values_.find(name);
    if (known != values_.end()) return known->second;
    for (const Parameter& candidate : parameters_) {
      if (candidate.name != name) continue;
      // Entered before its expression is evaluated: a parameter that used itself would be unknown, not endless.
      values_.emplace(name, radical_sum(candidate.value));
      return values_[name] = (*this)(candidate.expression);
    }
    throw std::out_of_range("'" + name + "' is not a parameter");
  }

  const std::vector<Parameter>& parameters_;
  std::map<std::string, RadicalSum> values_;
};

}  // namespace

ExactValue evaluate(const Expression& expression, const std::vector<Parameter>& parameters) {
  const RadicalSum sum = Evaluator(parameters)(expression);
  return {rational_value(sum), sum.exact && sum.is_rational()};
}

Rational value_of(const Expression& expression, const Mechanism& mechanism) {
  return evaluate(expression, mechanism.parameters).value;
}

}  // namespace clearloci::mechanism
