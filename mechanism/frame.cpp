#include "mechanism/frame.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/interpret.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/posture_sample.hpp"

namespace clearloci::mechanism {
namespace {

/// What cannot be written as a polynomial.
struct NotPolynomial {};

/// A polynomial in free coordinates and their cosines and sines: exponents by the text of what they belong to.
class Sum {
 public:
  using Monomial = std::map<std::string, int>;

  explicit Sum(const Rational& value) { add({}, value); }
  static Sum atom(const Expression& expression) {
    Sum sum(0);
    const std::string text = core::to_string(expression);
    sum.atoms_.emplace(text, expression);
    sum.add({{text, 1}}, 1);
    return sum;
  }

  friend Sum operator+(Sum a, const Sum& b) {
    a.atoms_.insert(b.atoms_.begin(), b.atoms_.end());
    for (const auto& [monomial, coefficient] : b.terms_) a.add(monomial, coefficient);
    return a;
  }
  friend Sum operator*(const Sum& a, const Sum& b) {
    Sum product(0);
    product.atoms_ = a.atoms_;
    product.atoms_.insert(b.atoms_.begin(), b.atoms_.end());
    for (const auto& [m, p] : a.terms_)
      for (const auto& [n, q] : b.terms_) {
        Monomial both = m;
        for (const auto& [atom, power] : n) both[atom] += power;
        product.add(both, p * q);
      }
    return product;
  }

  Expression expression() const {
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

 private:
  void add(const Monomial& monomial, const Rational& coefficient) {
    Rational& total = terms_[monomial];
    total += coefficient;
    if (total == 0) terms_.erase(monomial);
  }

  std::map<Monomial, Rational> terms_;
  std::map<std::string, Expression> atoms_;
};

class Change {
 public:
  Change(const Mechanism& mechanism, const Frame& frame) : mechanism_(mechanism), frame_(frame) {}

  Mechanism run() const {
    Mechanism result = mechanism_;
    for (std::size_t i = 0; i < result.coordinates.size(); ++i) {
      Coordinate& coordinate = result.coordinates[i];
      if (coordinate.angle) continue;
      coordinate.lower = (coordinate.lower - frame_.from[i]) / frame_.scale;
      coordinate.upper = (coordinate.upper - frame_.from[i]) / frame_.scale;
      coordinate.lower_expression = Expression::number(coordinate.lower);
      coordinate.upper_expression = Expression::number(coordinate.upper);
    }
    for (Point& point : result.points) change(point.form);
    for (Link& link : result.links)
      if (link.inertia) link.inertia = scaled(*link.inertia, 2);
    for (Joint& joint : result.joints) {
      for (VectorExpression& axis : joint.axes) change(axis);
      // Of a couple, else of a force.
      if (joint.effort) joint.effort = scaled(*joint.effort, traits(joint).slides ? 0 : 1);
      if (!joint.clearance) continue;
      for (Expression* length :
           {&joint.clearance->radial, &joint.clearance->gap, &joint.clearance->half_length, &joint.clearance->axial})
        *length = scaled(*length, 1);
    }
    // Forces stay as they are: N over a length that is `scale` m.
    const auto scale = [this](Expression& number, int power) { number = scaled(number, power); };
    for (Load& load : result.loads) {
      load.each_number(scale);
      if (load.force_vector) change(*load.force_vector);
    }
    for (Spring& spring : result.springs)
      spring.each_number([&scale](Expression& constant, int power) {
        if (power != 0) scale(constant, power);
      });
    for (Limit& limit : result.limits) {
      if (limit.is_angle()) continue;
      limit.lower = scaled(limit.lower, 1);
      limit.upper = scaled(limit.upper, 1);
      limit.lower_value /= frame_.scale;
      limit.upper_value /= frame_.scale;
    }
    return result;
  }

 private:
  bool is_free(const Expression& e) const {
    const std::set<std::string> names = core::symbols(e);
    return std::any_of(mechanism_.coordinates.begin(), mechanism_.coordinates.end(),
                       [&](const Coordinate& coordinate) { return names.contains(coordinate.name); });
  }

  Sum sum(const Expression& e) const { return core::interpret(e, Polynomials{*this}); }

  /// Expressions as polynomials in the new coordinates (core/interpret.hpp).
  struct Polynomials {
    using Value = Sum;
    const Change& change;

    std::optional<Sum> known(const Expression& e) const {
      using Kind = Expression::Kind;
      if (!change.is_free(e)) return Sum(value_of(e, change.mechanism_));
      if (e.kind() != Kind::cos && e.kind() != Kind::sin) return std::nullopt;
      for (const auto& coordinate : change.mechanism_.coordinates)
        if (!coordinate.angle && core::symbols(e).contains(coordinate.name)) throw NotPolynomial{};
      return Sum::atom(e);
    }
    Sum number(const Rational& value) const { return Sum(value); }
    Sum symbol(const std::string& name) const {
      const auto& all = change.mechanism_.coordinates;
      const auto own =
          std::find_if(all.begin(), all.end(), [&](const Coordinate& coordinate) { return coordinate.name == name; });
      if (own->angle) throw NotPolynomial{};
      const Rational& from = change.frame_.from[static_cast<std::size_t>(own - all.begin())];
      return Sum(from) + Sum(change.frame_.scale) * Sum::atom(Expression::symbol(name));
    }
    Sum negate(const Sum& a) const { return Sum(-1) * a; }
    Sum add(const Sum& a, const Sum& b) const { return a + b; }
    Sum multiply(const Sum& a, const Sum& b) const { return a * b; }
    Sum divide(const Sum& a, const Sum&, const Expression& e) const {
      if (change.is_free(e.arguments()[1])) throw NotPolynomial{};
      return a * Sum(1 / value_of(e.arguments()[1], change.mechanism_));
    }
    Sum power(const Sum& a, const Expression& e) const {
      constexpr int most = 24;
      if (change.is_free(e.arguments()[1])) throw NotPolynomial{};
      const Rational exponent = value_of(e.arguments()[1], change.mechanism_);
      if (exponent.get_den() != 1 || exponent < 0 || exponent > most) throw NotPolynomial{};
      Sum result(1);
      for (Rational i = 0; i < exponent; ++i) result = result * a;
      return result;
    }
    Sum pi() const { throw NotPolynomial{}; }
    Sum sqrt(const Sum&, const Expression&) const { throw NotPolynomial{}; }
    Sum cos(const Sum&, const Expression&) const { throw NotPolynomial{}; }
    Sum sin(const Sum&, const Expression&) const { throw NotPolynomial{}; }
    Sum atan(const Sum& a, const Expression&) const {
      return Sum::atom(Expression::apply(Expression::Kind::atan, {a.expression()}));
    }
  };

  /// Over the scale's power.
  Expression scaled(const Expression& e, int power) const {
    Rational factor = 1;
    for (int i = 0; i < power; ++i) factor /= frame_.scale;
    for (int i = power; i < 0; ++i) factor *= frame_.scale;
    return (Sum(factor) * sum(e)).expression();
  }

  /// A number: lengths that are the same irrational number stay the same.
  void change(PointForm& form) const {
    if (auto* own = std::get_if<ExplicitPoint>(&form))
      for (std::size_t i = 0; i < own->coordinates.size(); ++i)
        own->coordinates[i] =
            (Sum(1 / frame_.scale) * (sum(own->coordinates[i]) + Sum(-frame_.origin[i]))).expression();
    if (auto* dyad = std::get_if<DyadPoint>(&form)) {
      dyad->from_length = scaled(dyad->from_length, 1);
      dyad->to_length = scaled(dyad->to_length, 1);
      if (dyad->axis) change(*dyad->axis);
    }
    if (auto* offset = std::get_if<OffsetPoint>(&form)) {
      offset->along = scaled(offset->along, 1);
      offset->left = scaled(offset->left, 1);
    }
    if (auto* slider = std::get_if<SliderPoint>(&form)) {
      slider->length = scaled(slider->length, 1);
      change(slider->along);
    }
  }

  /// The same vector: a place in it is put back.
  void change(VectorExpression& vector) const {
    using Kind = VectorExpression::Kind;
    for (Expression& number : vector.numbers) number = scaled(number, 0);
    if (vector.kind != Kind::point) {
      for (VectorExpression& argument : vector.arguments) change(argument);
      return;
    }
    VectorExpression origin;
    for (std::size_t i = 0; i < dimension(mechanism_); ++i)
      origin.numbers.push_back(Expression::number(frame_.origin[i]));
    VectorExpression way;
    way.kind = Kind::scale;
    way.numbers = {Expression::number(frame_.scale)};
    way.arguments = {vector};
    vector = {};
    vector.kind = Kind::add;
    vector.arguments = {way, origin};
  }

  const Mechanism& mechanism_;
  const Frame& frame_;
};

Rational power_of_two(int exponent) {
  Rational result = 1;
  if (exponent > 0) result <<= static_cast<unsigned>(exponent);
  if (exponent < 0) result >>= static_cast<unsigned>(-exponent);
  return result;
}

/// The multiple of `step` next to a value.
Rational rounded(double value, const Rational& step) {
  const Rational ratio = Rational(value) / step + Rational(1, 2);
  core::Integer whole;
  mpz_fdiv_q(whole.get_mpz_t(), ratio.get_num_mpz_t(), ratio.get_den_mpz_t());
  return Rational(whole) * step;
}

}  // namespace

bool Frame::is_usual() const {
  const auto zero = [](const Rational& value) { return value == 0; };
  return scale == 1 && std::all_of(origin.begin(), origin.end(), zero) && std::all_of(from.begin(), from.end(), zero);
}

Frame frame_of(const Mechanism& mechanism) {
  // Within these nothing is gained: the engines are made for mechanisms of a metre, and work within some factors of it.
  constexpr double far = 32;          // distance from the origin, in sizes of the mechanism
  constexpr int usual_exponents = 6;  // powers of two
  constexpr std::size_t poses = 64;
  std::array<double, 3> lower, upper;
  lower.fill(INFINITY);
  upper.fill(-INFINITY);
  for (const std::vector<double>& pose : spread_poses(mechanism, poses))
    for (const auto& place : sample_points(mechanism, pose))
      for (std::size_t i = 0; place && i < 3; ++i) {
        lower[i] = std::min(lower[i], (*place)[i]);
        upper[i] = std::max(upper[i], (*place)[i]);
      }
  Frame frame;
  frame.from.resize(mechanism.coordinates.size());
  double size = 0, distance = 0;
  for (std::size_t i = 0; i < dimension(mechanism); ++i) {
    size = std::max(size, (upper[i] - lower[i]) / 2);
    distance = std::max(distance, std::abs(lower[i] + upper[i]) / 2);
  }
  if (!(std::isfinite(size) && size > 0 && std::isfinite(distance))) return frame;
  const int exponent = std::ilogb(size);
  const Rational step = power_of_two(exponent);
  if (std::abs(exponent) > usual_exponents) frame.scale = step;
  if (distance > far * size)
    for (std::size_t i = 0; i < dimension(mechanism); ++i) frame.origin[i] = rounded((lower[i] + upper[i]) / 2, step);
  for (std::size_t i = 0; i < frame.from.size(); ++i) {
    const Coordinate& coordinate = mechanism.coordinates[i];
    const double from = core::to_double(coordinate.lower), to = core::to_double(coordinate.upper);
    if (!coordinate.angle && std::abs(from + to) > far * (to - from)) frame.from[i] = rounded((from + to) / 2, step);
  }
  return frame;
}

std::optional<Mechanism> in_frame(const Mechanism& mechanism, const Frame& frame) {
  try {
    Mechanism inside = Change(mechanism, frame).run();
    inside.frame = frame;
    return inside;
  } catch (const NotPolynomial&) {
    return std::nullopt;
  }
}

}  // namespace clearloci::mechanism
