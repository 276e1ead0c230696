#include "mechanism/evaluate.hpp"

#include <map>
#include <set>
#include <stdexcept>

#include "core/interpret.hpp"
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
    for (auto p = used.rbegin(); p != used.rend(); ++p) values_[(*p)->name] = core::interpret((*p)->expression, *this);
  }

  using Value = RadicalSum;
  RadicalSum number(const Rational& value) const { return radical_sum(value); }
  RadicalSum symbol(const std::string& name) const {
    const auto found = values_.find(name);
    if (found != values_.end()) return found->second;
    throw std::out_of_range("'" + name + "' is not a parameter");
  }
  RadicalSum pi() const { return pi_multiple(1); }
  RadicalSum negate(const RadicalSum& a) const { return -a; }
  RadicalSum add(const RadicalSum& a, const RadicalSum& b) const { return a + b; }
  RadicalSum multiply(const RadicalSum& a, const RadicalSum& b) const { return a * b; }
  RadicalSum divide(const RadicalSum& a, const RadicalSum& b, const Expression&) const { return a / b; }
  RadicalSum power(const RadicalSum& a, const Expression& e) const {
    return mechanism::power(a, core::interpret(e.arguments()[1], *this));
  }
  RadicalSum sqrt(const RadicalSum& a, const Expression&) const { return square_root(a); }
  RadicalSum cos(const RadicalSum& a, const Expression&) const {
    const CirclePoint point = circle_point(a);
    return coordinate(point, point.cosine);
  }
  RadicalSum sin(const RadicalSum& a, const Expression&) const {
    const CirclePoint point = circle_point(a);
    return coordinate(point, point.sine);
  }
  RadicalSum atan(const RadicalSum&, const Expression&) const { throw std::domain_error("atan of a number"); }

 private:
  static RadicalSum coordinate(const CirclePoint& point, const Rational& value) {
    RadicalSum result = radical_sum(value);
    result.exact = point.exact;
    return result;
  }

  const std::vector<Parameter>& parameters_;
  std::map<std::string, RadicalSum> values_;
};

}  // namespace

ExactValue evaluate(const Expression& expression, const std::vector<Parameter>& parameters) {
  Evaluator evaluator(parameters);
  evaluator.prepare(expression);
  const RadicalSum sum = core::interpret(expression, evaluator);
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
