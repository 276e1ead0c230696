#include "loci/sheet/apex.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

#include "core/errors.hpp"
#include "loci/numbers/double_double.hpp"
#include "loci/search/isolated_zeros.hpp"
#include "loci/sheet/fine_zero.hpp"

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
      std::optional<Expansion> own = step(line.steps[i], steps);
      if (!own) return std::nullopt;
      if (vanishing_.contains(numbers[i])) {
        if (!own->slope) return std::nullopt;
        own = Expansion{1, *own->slope, false, std::nullopt, std::nullopt};
      }
      steps.push_back(*own);
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
      const int slope = builder_.variable(1 + index);
      const int regular = builder_.add(builder_.constant(value, star_.apex->radius), builder_.multiply(u_, slope));
      return {0, regular, false, enclosed_as(value, star_.apex->radius, static_cast<DoubleDouble*>(nullptr)), slope};
    }
    const int root = index - 2;
    const auto [place, fresh] = roots_.try_emplace(root);
    if (fresh) place->second = root_expansion(root);
    return roots_.at(root);
  }

  Expansion root_expansion(int root) {
    const int own = builder_.variable(3 + root);
    if (const int power = star_.power_of_root(root); power > 0) return {power, own, false, std::nullopt, std::nullopt};
    const Apex::Value& value = star_.apex->roots[static_cast<std::size_t>(root)];
    Expansion result{0, own, false, std::nullopt, std::nullopt};
    if (!value.known) return result;
    result.at_apex = enclosed_as(value.middle, value.radius, static_cast<DoubleDouble*>(nullptr));
    // (s - s0) / u = ((Q - Q0) / u) / (s + s0)
    const std::optional<Expansion> square = of(form_of(tower_.roots[static_cast<std::size_t>(root)]));
    if (square && square->power == 0 && square->slope) {
      const int both = builder_.add(own, builder_.constant(value.middle, value.radius));
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

/// Which roots vanish at the apex, and with which power: those whose squares do.
void find_roots(Star& star, const core::RootTower& tower) {
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    if (tower.roots[j].is_angle()) continue;  // in every direction it has a value
    AroundApex around_apex(star, tower);
    const std::optional<Expansion> square = around_apex.of(AroundApex::form_of(tower.roots[j]));
    if (square && square->power > 0)
      star.roots.insert(star.roots.end(), static_cast<std::size_t>(square->power / 2), static_cast<int>(j));
  }
}

/// A star at the zero of functions 0 and 1 of the program, as an enclosure; what vanishes there is left open.
std::optional<Star> enclosed_star(const SheetZero& zero, const core::RootTower& tower, const Subtower& part,
                                  const SheetProgram& program) {
  constexpr double slack = 4;
  const double radius = slack * std::max(zero.radius, 0x1p-50 * std::max(std::abs(zero.x), std::abs(zero.y)));
  const std::optional<FineZero> fine =
      fine_zero(program, part.mode, {zero.x - radius, zero.x + radius}, {zero.y - radius, zero.y + radius});
  if (!fine) return std::nullopt;
  Star star;
  star.x = fine->x;
  star.y = fine->y;
  Apex apex;
  apex.radius = fine->radius;
  apex.roots.resize(tower.roots.size());
  for (std::size_t j = 0; j < fine->roots.size(); ++j) {
    const Rational lower = fine->roots[j].lower_end(), upper = fine->roots[j].upper_end();
    apex.roots[static_cast<std::size_t>(part.kept[j])] = {(lower + upper) / 2, (upper - lower) / 2, true};
  }
  star.apex = std::move(apex);
  return star;
}

/// The box and a little around it: a star next to the box reaches into it.
struct Surroundings {
  std::vector<Rational> lower, upper;

  Surroundings(const std::vector<Rational>& from, const std::vector<Rational>& to) : lower(from), upper(to) {
    const Rational around(1, 50);
    for (std::size_t c = 0; c < 2; ++c) {
      const Rational margin = around * (to[c] - from[c]);
      lower[c] -= margin;
      upper[c] += margin;
    }
  }
};

/// The nodes that forms have in common, where part `first` of one of them and the last part vanish.
class Nodes {
 public:
  Nodes(const core::RootTower& tower, const core::WorkingMode& mode, const std::vector<const core::NodeForm*>& forms,
        const core::NodeForm& form, std::size_t first)
      : tower_(tower), forms_(forms), part_(part_of(tower, mode, forms)) {
    const auto add = [&](const core::NodeForm::Part& own) {
      functions_.push_back({narrowed(own.sheet, part_), narrowed(own.line, part_)});
    };
    add(form.parts[first]);
    add(form.parts.back());
    for (const core::NodeForm* other : forms) std::for_each(other->parts.begin(), other->parts.end(), add);
    functions_.push_back({core::Polynomial{part_.tower.variables(), {}}, narrowed(form.probes[first], part_)});
  }

  void add_to(std::vector<Star>& stars, const Surroundings& box, ZeroOptions options) const {
    if (std::any_of(functions_.begin(), functions_.end(), [](const SheetFunction& f) { return f.line.empty(); }))
      return;
    options.special = narrowed(options.special, part_);
    const ZeroSet found =
        isolated_zeros(part_.tower, part_.mode, functions_[0], functions_[1], box.lower, box.upper, options);
    if (found.zeros.empty()) return;
    const SheetProgram program(part_.tower, functions_);
    for (const SheetZero& zero : found.zeros) {
      if (!zero.inside_workspace || is_known(stars, zero)) continue;
      std::optional<Star> star = enclosed_star(zero, tower_, part_, program);
      if (!star || !all_vanish(program, *star)) continue;
      star->singular = true;
      star->room = room_around(program, zero, box);
      for (const core::NodeForm* form : forms_)
        for (const core::NodeForm::Part& own : form->parts) star->apex->vanishing.push_back(own.line);
      stars.push_back(std::move(*star));
    }
  }

 private:
  static Subtower part_of(const core::RootTower& tower, const core::WorkingMode& mode,
                          const std::vector<const core::NodeForm*>& forms) {
    std::vector<core::Polynomial> all;
    for (const core::NodeForm* form : forms)
      for (const core::NodeForm::Part& own : form->parts) all.push_back(own.sheet);
    return subtower(tower, mode, all);
  }

  /// How far no root gets near zero, to all appearance: next to a workspace boundary what is written around the node is
  /// enclosed badly.
  static double room_around(const SheetProgram& program, const SheetZero& zero, const Surroundings& box) {
    constexpr int directions = 16, most_halvings = 24;
    constexpr double widest = 0.06, least_square = 0.3;
    auto registers = program.registers<double>();
    const auto squares_at = [&](double x, double y) {
      std::vector<double> squares;
      registers.set(0, x);
      registers.set(1, y);
      for (int j = 0; j < program.roots(); ++j) {
        registers.run_square(j);
        squares.push_back(registers.square(j));
        const double root = std::sqrt(std::max(0.0, squares.back()));
        registers.set(2 + j, zero.roots[static_cast<std::size_t>(j)] < 0 ? -root : root);
      }
      return squares;
    };
    const std::vector<double> middle = squares_at(zero.x, zero.y);
    const auto is_clear = [&](double reach) {
      for (int k = 0; k < directions; ++k) {
        const double angle = 2 * std::numbers::pi * k / directions;
        const std::vector<double> own = squares_at(zero.x + reach * std::cos(angle), zero.y + reach * std::sin(angle));
        for (std::size_t j = 0; j < own.size(); ++j)
          if (!(own[j] > least_square * middle[j])) return false;
      }
      return true;
    };
    double reach =
        widest * std::max(core::to_double(box.upper[0] - box.lower[0]), core::to_double(box.upper[1] - box.lower[1]));
    for (int k = 0; k < most_halvings && !is_clear(std::numbers::sqrt2 * reach); ++k) reach /= 2;
    return reach;
  }

  static bool is_known(const std::vector<Star>& stars, const SheetZero& zero) {
    return std::any_of(stars.begin(), stars.end(), [&](const Star& other) {
      return std::max(std::abs(core::to_double(other.x) - zero.x), std::abs(core::to_double(other.y) - zero.y)) <=
             2 * zero.radius;
    });
  }

  /// By the probe, which does not vanish there.
  bool all_vanish(const SheetProgram& program, const Star& star) const {
    auto registers = program.registers<MultiInterval>();
    const auto enclosure = [](const Rational& value, const Rational& radius) {
      return MultiInterval(value - radius, value + radius);
    };
    registers.set(0, enclosure(star.x, star.apex->radius));
    registers.set(1, enclosure(star.y, star.apex->radius));
    for (int j = 0; j < program.roots(); ++j) {
      registers.run_square(j);
      const Apex::Value& root = star.apex->roots[static_cast<std::size_t>(part_.kept[static_cast<std::size_t>(j)])];
      registers.set(2 + j, enclosure(root.middle, root.radius));
    }
    registers.run_values();
    const int probe = program.functions() - 1;
    for (int f = 0; f < probe; ++f)
      if (registers.value(f).sign() != 0) return false;
    return registers.value(probe).sign() != 0;
  }

  const core::RootTower& tower_;
  const std::vector<const core::NodeForm*>& forms_;
  Subtower part_;
  std::vector<SheetFunction> functions_;  ///< the two that are looked for, all parts, the probe
};

}  // namespace

std::vector<Star> enclosed_cones(const core::RootTower& tower, const core::WorkingMode& mode,
                                 const std::vector<Rational>& lower, const std::vector<Rational>& upper) {
  const Surroundings box(lower, upper);
  std::vector<Star> stars;
  for (const core::DyadBase& base : tower.bases) {
    const Subtower part = subtower(tower, mode, {base.x, base.y});
    if (part.kept.empty()) continue;  // at a rational point, or nowhere
    const SheetFunction x = {narrowed(base.x, part), narrowed(base.x_line, part)};
    const SheetFunction y = {narrowed(base.y, part), narrowed(base.y_line, part)};
    const ZeroSet found = isolated_zeros(part.tower, part.mode, x, y, box.lower, box.upper);
    if (found.zeros.empty()) continue;
    const SheetProgram program(part.tower, {x, y});
    for (const SheetZero& zero : found.zeros) {
      if (!zero.inside_workspace) continue;
      std::optional<Star> star = enclosed_star(zero, tower, part, program);
      if (!star) continue;
      star->apex->vanishing = {base.x_line, base.y_line};
      find_roots(*star, tower);
      if (!star->roots.empty()) stars.push_back(std::move(*star));
    }
  }
  return stars;
}

std::vector<Star> enclosed_nodes(const core::RootTower& tower, const core::WorkingMode& mode,
                                 const std::vector<const core::NodeForm*>& forms, const std::vector<Rational>& lower,
                                 const std::vector<Rational>& upper, const ZeroOptions& options) {
  const Surroundings box(lower, upper);
  std::vector<Star> stars;
  for (const core::NodeForm* form : forms)
    for (std::size_t first = 0; first < form->probes.size(); ++first)
      Nodes(tower, mode, forms, *form, first).add_to(stars, box, options);
  return stars;
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

StraightLine polar_angle(const Star& star, const core::RootTower& tower, const core::Root& root) {
  AroundApex around_apex(star, tower);
  std::optional<Expansion> expansion = around_apex.of(root.line);
  if (!expansion) expansion = around_apex.of(AroundApex::form_of(root));
  core::ensure(expansion.has_value(), "an angle has an expansion");
  return around_apex.line(*expansion);
}

}  // namespace clearloci::loci::sheet
