#include "loci/sheet/apex.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "core/errors.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::sheet {

namespace {

using core::Rational;
using core::StraightLine;
using core::StraightLineBuilder;
using Operation = StraightLine::Operation;

/// g = u^power regular. Where the power is 0, g(apex) and (g - g(apex)) / u may be known too.
struct Expansion {
  int power = 0;
  int regular = 0;  ///< step
  bool zero = false;
  std::optional<DoubleDouble> at_apex = {};
  std::optional<int> slope = {};
};

/// Numbers the steps of several lines so that equal ones have equal numbers.
class Numbering {
 public:
  std::vector<int> of(const StraightLine& line) {
    std::vector<int> numbers;
    for (const StraightLine::Step& step : line.steps) {
      const bool constant = step.operation == Operation::constant, variable = step.operation == Operation::variable;
      const int first = constant ? 0 : variable ? step.first : numbers[static_cast<std::size_t>(step.first)];
      const int second = constant || variable || step.operation == Operation::inverse
                             ? 0
                             : numbers[static_cast<std::size_t>(step.second)];
      const auto [place, fresh] =
          known_.try_emplace({step.operation, first, second, step.value()}, static_cast<int>(known_.size()));
      numbers.push_back(place->second);
    }
    return numbers;
  }

 private:
  std::map<std::tuple<Operation, int, int, Rational>, int> known_;
};

/// Writes lines over the tower around an apex.
class AroundApex {
 public:
  AroundApex(const Star& star, const core::RootTower& tower) : star_(star), tower_(tower) {
    u_ = builder_.variable(0);
    for (const StraightLine& line : star.apex->vanishing) vanishing_.insert(numbering_.of(line).back());
  }

  std::optional<Expansion> of(const StraightLine& line) {
    const std::vector<int> numbers = numbering_.of(line);
    std::vector<Expansion> steps;
    for (std::size_t i = 0; i < line.steps.size(); ++i) {
      std::optional<Expansion> expansion = step(line.steps[i], steps);
      if (!expansion) return std::nullopt;
      if (vanishing_.contains(numbers[i])) {
        if (!expansion->slope) return std::nullopt;
        expansion = Expansion{1, *expansion->slope, false, std::nullopt, std::nullopt};
      }
      steps.push_back(*expansion);
    }
    return steps.back();
  }

  StraightLine line(const Expansion& expansion) const { return builder_.line(expansion.regular); }
  StraightLine divided(const Expansion& expansion, int power) {
    return builder_.line(builder_.multiply(expansion.regular, builder_.power(u_, expansion.power - power)));
  }

 private:
  std::optional<Expansion> step(const StraightLine::Step& step, const std::vector<Expansion>& steps) {
    const auto operand = [&](int index) -> const Expansion& { return steps[static_cast<std::size_t>(index)]; };
    switch (step.operation) {
      case Operation::constant:
        return Expansion{0, builder_.constant(step.value(), step.radius()), step.value() == 0 && step.radius() == 0,
                         enclosed_as(step.value(), step.radius(), static_cast<DoubleDouble*>(nullptr)),
                         builder_.constant(0)};
      case Operation::variable:
        return variable(step.first);
      case Operation::add:
        return sum(operand(step.first), operand(step.second), false);
      case Operation::subtract:
        return sum(operand(step.first), operand(step.second), true);
      case Operation::multiply:
        return product(operand(step.first), operand(step.second));
      case Operation::angle:
        return angle_of_way(operand(step.first), operand(step.second));
      default:
        return inverse_of(operand(step.first));
    }
  }

  Expansion variable(int index) {
    if (index < 2) {
      const Rational& value = index == 0 ? star_.x : star_.y;
      const int slope = way_of(index);
      const int regular = builder_.add(builder_.constant(value, star_.apex->radius), builder_.multiply(u_, slope));
      return {0, regular, false, enclosed_as(value, star_.apex->radius, static_cast<DoubleDouble*>(nullptr)), slope};
    }
    const int root = index - 2;
    const auto [place, fresh] = roots_.try_emplace(root);
    if (fresh) place->second = root_expansion(root);
    return roots_.at(root);
  }

  /// (x - x0) / u or (y - y0) / u.
  int way_of(int index) {
    const int own = builder_.variable(1 + index), along = star_.along_y ? 1 : 0;
    if (!star_.is_sheared() || index == along) return own;
    const int slope = builder_.constant(star_.slope, star_.apex->slope_radius);
    return builder_.add(builder_.multiply(slope, builder_.variable(1 + along)), builder_.multiply(u_, own));
  }

  Expansion root_expansion(int root) {
    const int variable = builder_.variable(3 + root);
    if (const int power = star_.power_of_root(root); power > 0)
      return {power, variable, false, std::nullopt, std::nullopt};
    const Apex::Value& value = star_.apex->roots[static_cast<std::size_t>(root)];
    Expansion result{0, variable, false, std::nullopt, std::nullopt};
    if (!value.known) return result;
    result.at_apex = enclosed_as(value.middle, value.radius, static_cast<DoubleDouble*>(nullptr));
    // (s - s0) / u = ((Q - Q0) / u) / (s + s0)
    const std::optional<Expansion> square = of(form_of(tower_.roots[static_cast<std::size_t>(root)]));
    if (square && square->power == 0 && square->slope) {
      const int both = builder_.add(variable, builder_.constant(value.middle, value.radius));
      result.slope = builder_.multiply(*square->slope, builder_.inverse(both));
    }
    return result;
  }

 public:
  static StraightLine form_of(const core::Root& root) {
    if (root.is_angle()) return core::line_of_angle(form_of(root.cosine_and_sine[1]), form_of(root.cosine_and_sine[0]));
    return root.line.empty() ? form_of(root.square) : root.line;
  }
  static StraightLine form_of(const core::Polynomial& p) {
    StraightLineBuilder builder;
    std::vector<int> variables;
    for (int v = 0; v < p.variables; ++v) variables.push_back(builder.variable(v));
    return builder.line(builder.polynomial(p, variables));
  }

 private:
  int raised(const Expansion& e, int power) {
    return builder_.multiply(e.regular, builder_.power(u_, e.power - power));
  }

  Expansion sum(const Expansion& a, const Expansion& b, bool subtract) {
    if (b.zero) return a;
    if (a.zero && !subtract) return b;
    const int power = a.zero ? b.power : std::min(a.power, b.power);
    const int left = a.zero ? builder_.constant(0) : raised(a, power), right = raised(b, power);
    Expansion result{power, subtract ? builder_.subtract(left, right) : builder_.add(left, right), false, {}, {}};
    if (power != 0) return result;
    const auto value = [](const Expansion& e) { return e.power > 0 ? std::optional(DoubleDouble(0.0)) : e.at_apex; };
    if (value(a) && value(b)) result.at_apex = subtract ? *value(a) - *value(b) : *value(a) + *value(b);
    const std::optional<int> first = slope_of(a), second = slope_of(b);
    if (first && second) result.slope = subtract ? builder_.subtract(*first, *second) : builder_.add(*first, *second);
    return result;
  }

  std::optional<int> slope_of(const Expansion& e) {
    if (e.power > 0) return builder_.multiply(e.regular, builder_.power(u_, e.power - 1));
    return e.slope;
  }

  Expansion product(const Expansion& a, const Expansion& b) {
    if (a.zero) return a;
    if (b.zero) return b;
    Expansion result{a.power + b.power, builder_.multiply(a.regular, b.regular), false, {}, {}};
    if (a.power != 0 || b.power != 0 || !a.at_apex || !b.at_apex) return result;
    result.at_apex = *a.at_apex * *b.at_apex;
    if (a.slope && b.slope)
      result.slope =
          builder_.add(builder_.multiply(*a.slope, b.regular), builder_.multiply(enclosed(*a.at_apex), *b.slope));
    return result;
  }

  /// Common powers of u turn no way.
  std::optional<Expansion> angle_of_way(const Expansion& y, const Expansion& x) {
    if (y.zero && x.zero) return std::nullopt;
    const int power = y.zero ? x.power : x.zero ? y.power : std::min(y.power, x.power);
    const auto part = [&](const Expansion& e) { return e.zero ? builder_.constant(0) : raised(e, power); };
    return Expansion{0, builder_.angle(part(y), part(x)), false, std::nullopt, std::nullopt};
  }

  std::optional<Expansion> inverse_of(const Expansion& a) {
    if (a.zero) return std::nullopt;
    const int regular = builder_.inverse(a.regular);
    Expansion result{-a.power, regular, false, {}, {}};
    if (a.power != 0 || !a.at_apex || a.at_apex->sign() == 0) return result;
    result.at_apex = inverse(*a.at_apex);
    if (a.slope)
      result.slope = builder_.subtract(
          builder_.constant(0), builder_.multiply(*a.slope, builder_.multiply(regular, enclosed(*result.at_apex))));
    return result;
  }

  int enclosed(const DoubleDouble& value) {
    const Rational lower = value.lower_end(), upper = value.upper_end();
    return builder_.constant((lower + upper) / 2, (upper - lower) / 2);
  }

  const Star& star_;
  const core::RootTower& tower_;
  StraightLineBuilder builder_;
  Numbering numbering_;
  int u_ = 0;
  std::set<int> vanishing_;  ///< numbers of what does so at the apex
  std::map<int, Expansion> roots_;
};

}  // namespace

void find_roots_of(Star& star, const core::RootTower& tower) {
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    if (tower.roots[j].is_angle()) continue;  // in every direction it has a value
    AroundApex around_apex(star, tower);
    const std::optional<Expansion> square = around_apex.of(AroundApex::form_of(tower.roots[j]));
    if (square && square->power > 0)
      star.roots.insert(star.roots.end(), static_cast<std::size_t>(square->power / 2), static_cast<int>(j));
  }
}

int power_at(const Star& star, const core::RootTower& tower, const StraightLine& function) {
  const std::optional<Expansion> expansion = AroundApex(star, tower).of(function);
  return expansion ? expansion->power : 0;
}

StraightLine polar_line(const Star& star, const core::RootTower& tower, const SheetFunction& function,
                        std::optional<int> power) {
  AroundApex around_apex(star, tower);
  std::optional<Expansion> expansion;
  if (!function.line.empty()) expansion = around_apex.of(function.line);
  if (!expansion) expansion = around_apex.of(AroundApex::form_of(function.polynomial));
  core::ensure(expansion.has_value(), "a polynomial has an expansion");
  return power && *power <= expansion->power ? around_apex.divided(*expansion, *power) : around_apex.line(*expansion);
}

StraightLine boundary_line(const Star& star, const core::Polynomial& square) {
  // Q = sum of c_ij X^i Y^j; of the first order nothing is left but what is off the tangent.
  const MultiInterval at[2] = {{star.x - star.apex->radius, star.x + star.apex->radius},
                               {star.y - star.apex->radius, star.y + star.apex->radius}};
  std::map<std::array<int, 2>, MultiInterval> taylor;
  for (const core::Term& term : square.terms) {
    const int m = term.exponents[0], n = term.exponents[1];
    MultiInterval by_x(term.coefficient);
    for (int i = m; i >= 0; --i) {  // coefficient * binomial(m, i) x^(m - i)
      MultiInterval by_y = by_x;
      for (int j = n; j >= 0; --j) {
        MultiInterval& sum = taylor.try_emplace({i, j}, Rational(0)).first->second;
        sum = sum + by_y;
        if (j > 0) by_y = by_y * at[1] * MultiInterval(Rational(j, n - j + 1));
      }
      if (i > 0) by_x = by_x * at[0] * MultiInterval(Rational(i, m - i + 1));
    }
  }
  StraightLineBuilder builder;
  const std::size_t along = star.along_y ? 1 : 0, off = 1 - along;
  const int u = builder.variable(0), on_tangent = builder.variable(1 + static_cast<int>(along)),
            off_tangent = builder.variable(1 + static_cast<int>(off));
  const int slope = builder.constant(star.slope, star.apex->slope_radius);
  const int way_off = builder.add(builder.multiply(slope, on_tangent), builder.multiply(u, off_tangent));
  int sum = builder.constant(0);
  for (const auto& [powers, coefficient] : taylor) {
    const int order = powers[0] + powers[1];
    const Rational lower = coefficient.lower_end(), upper = coefficient.upper_end();
    const int factor = builder.constant((lower + upper) / 2, (upper - lower) / 2);
    if (order == 1 && powers[off] == 1) sum = builder.add(sum, builder.multiply(factor, off_tangent));
    if (order < 2) continue;
    const int ways = builder.multiply(builder.power(on_tangent, powers[along]), builder.power(way_off, powers[off]));
    sum = builder.add(sum, builder.multiply(builder.power(u, order - 2), builder.multiply(factor, ways)));
  }
  return builder.line(sum);
}

StraightLine polar_angle(const Star& star, const core::RootTower& tower, const core::Root& root) {
  AroundApex around_apex(star, tower);
  std::optional<Expansion> expansion = around_apex.of(root.line);
  if (!expansion) expansion = around_apex.of(AroundApex::form_of(root));
  core::ensure(expansion.has_value(), "an angle has an expansion");
  return around_apex.line(*expansion);
}

}  // namespace clearloci::loci::sheet
