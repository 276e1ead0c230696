#include "mechanism/evaluate.hpp"

#include <map>
#include <set>
#include <stdexcept>

#include "mechanism/radical_sum.hpp"

namespace clearloci::mechanism {
namespace {

/// Evaluates with every parameter's own expression, not its value: cos(a) with a = 90 deg is 0 exactly.
class Evaluator {
 public:
  explicit Evaluator(const std::vector<Parameter>& parameters) : parameters_(parameters) {}

  /// Required before an expression is evaluated: what it uses, in the order of the file. Otherwise each parameter's
  /// expression would be evaluated inside that of the next, as deep as there are parameters.
  void prepare(const Expression& expression) {
    std::set<std::string> needed = core::symbols(expression);
    std::vector<const Parameter*> used;
    for (auto p = parameters_.rbegin(); p != parameters_.rend(); ++p) {
      if (!needed.contains(p->name)) continue;
      needed.merge(core::symbols(p->expression));
      used.push_back(&*p);
    }
    for (auto p = used.rbegin(); p != used.rend(); ++p) values_[(*p)->name] = (*this)((*p)->expression);
  }

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
    throw std::out_of_range("'" + name + "' is not a parameter");
  }

  const std::vector<Parameter>& parameters_;
  std::map<std::string, RadicalSum> values_;
};

}  // namespace

ExactValue evaluate(const Expression& expression, const std::vector<Parameter>& parameters) {
  Evaluator evaluator(parameters);
  evaluator.prepare(expression);
  const RadicalSum sum = evaluator(expression);
  return {rational_value(sum), sum.exact && sum.is_rational()};
}

std::optional<std::string> unusable(const Rational& value) {
  // Products of some twenty such numbers are still doubles; nothing that is built or loaded comes near.
  static const Rational largest = core::rational_from_decimal("1e15"), smallest = core::rational_from_decimal("1e-30");
  constexpr std::size_t most_bits = 4096;
  const Rational size = abs(value);
  if (size > largest) return "is larger than 1e15";
  if (sgn(value) != 0 && size < smallest) return "is nearer to 0 than 1e-30 without being 0";
  if (mpz_sizeinbase(value.get_num_mpz_t(), 2) + mpz_sizeinbase(value.get_den_mpz_t(), 2) > most_bits)
    return "has more than 4096 bits";
  return std::nullopt;
}

Rational value_of(const Expression& expression, const Mechanism& mechanism) {
  return evaluate(expression, mechanism.parameters).value;
}

}  // namespace clearloci::mechanism
