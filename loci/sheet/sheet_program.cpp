#include "loci/sheet/sheet_program.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

#include "core/errors.hpp"

namespace clearloci::loci::sheet {

namespace {

/// Coefficients of (v + shift)^n, lowest power first.
std::vector<core::Rational> power_of_sum(const core::Rational& shift, int n) {
  std::vector<core::Rational> result = {1};
  for (int i = 0; i < n; ++i) {
    result.emplace_back(0);
    for (std::size_t k = result.size() - 1; k > 0; --k) result[k] = shift * result[k] + result[k - 1];
    result[0] *= shift;
  }
  return result;
}

}  // namespace

core::Polynomial shifted(const core::Polynomial& p, int variable, const core::Rational& shift) {
  if (shift == 0) return p;
  std::vector<std::vector<core::Rational>> powers;
  for (int n = 0; n <= std::max(0, core::degree_in(p, variable)); ++n) powers.push_back(power_of_sum(shift, n));
  std::map<std::vector<int>, core::Rational, std::greater<>> collected;
  for (const core::Term& term : p.terms) {
    std::vector<int> exponents = term.exponents;
    const int n = term.exponents[variable];
    for (int k = 0; k <= n; ++k) {
      exponents[variable] = k;
      collected[exponents] += term.coefficient * powers[n][k];
    }
  }
  core::Polynomial result{p.variables, {}};
  for (const auto& [exponents, coefficient] : collected)
    if (coefficient != 0) result.terms.push_back({exponents, coefficient});
  return result;
}

double constant_as(const core::Rational& value, double*) { return core::to_double(value); }

Interval constant_as(const core::Rational& value, Interval*) {
  const double nearest = core::to_double(value);
  // Products with an infinite end are no numbers, of which comparisons prove nothing.
  if (!std::isfinite(nearest)) throw core::LimitReached("the equations hold numbers beyond the range of doubles");
  if (core::Rational(nearest) == value) return nearest;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {std::nextafter(nearest, -infinity), std::nextafter(nearest, infinity)};
}

MultiInterval constant_as(const core::Rational& value, MultiInterval*) { return MultiInterval(value); }

/// Builds the instructions; equal ones are made once. Nodes are numbered: variables, then constants and instructions
/// as they come; `finish` turns the numbers into registers.
class SheetProgram::Builder {
 public:
  explicit Builder(int variables) : variables_(variables), derivatives_(variables) {
    for (int v = 0; v < variables; ++v) nodes_.push_back({Kind::variable, v, 0});
    zero_ = constant(0);
    one_ = constant(1);
  }

  int constant(const core::Rational& value) {
    const auto [it, added] = constant_nodes_.try_emplace(value, static_cast<int>(nodes_.size()));
    if (added) enclosed_constant(value, 0);
    return it->second;
  }

  int enclosed_constant(const core::Rational& value, const core::Rational& radius) {
    nodes_.push_back({Kind::constant, static_cast<int>(constants_.size()), 0});
    constants_.push_back({value, radius});
    return static_cast<int>(nodes_.size()) - 1;
  }

  int add(int a, int b) {
    if (a == zero_) return b;
    if (b == zero_) return a;
    return make(Kind::add, std::min(a, b), std::max(a, b));
  }

  int subtract(int a, int b) { return b == zero_ ? a : a == b ? zero_ : make(Kind::subtract, a, b); }

  int multiply(int a, int b) {
    if (a == zero_ || b == zero_) return zero_;
    if (a == one_) return b;
    if (b == one_) return a;
    return a == b ? make(Kind::square, a, a) : make(Kind::multiply, std::min(a, b), std::max(a, b));
  }

  int inverse(int a) { return make(Kind::inverse, a, a); }

  int power(int base, int exponent) {
    if (exponent == 0) return one_;
    if (exponent == 1) return base;
    const int half = power(base, exponent / 2);
    const int even = multiply(half, half);
    return exponent % 2 == 0 ? even : multiply(even, base);
  }

  int polynomial(const core::Polynomial& p) {
    std::vector<const core::Term*> terms;
    for (const core::Term& term : p.terms) terms.push_back(&term);
    return horner(terms, p.variables - 1);
  }

  int line(const core::StraightLine& line) {
    using Step = core::StraightLine::Operation;
    std::vector<int> nodes;
    for (const core::StraightLine::Step& step : line.steps) {
      const auto operand = [&](int index) { return nodes[index]; };
      switch (step.operation) {
        case Step::constant:
          nodes.push_back(step.radius() == 0 ? constant(step.value()) : enclosed_constant(step.value(), step.radius()));
          break;
        case Step::variable:
          nodes.push_back(step.first);
          break;
        case Step::add:
          nodes.push_back(add(operand(step.first), operand(step.second)));
          break;
        case Step::subtract:
          nodes.push_back(subtract(operand(step.first), operand(step.second)));
          break;
        case Step::multiply:
          nodes.push_back(multiply(operand(step.first), operand(step.second)));
          break;
        case Step::inverse:
          nodes.push_back(inverse(operand(step.first)));
          break;
      }
    }
    return nodes.back();
  }

  int derivative(int node, int v) {
    std::vector<int>& known = derivatives_[v];
    if (node < static_cast<int>(known.size()) && known[node] != unknown) return known[node];
    const Node n = nodes_[node];
    int result = zero_;
    switch (n.kind) {
      case Kind::variable:
        result = n.first == v ? one_ : zero_;
        break;
      case Kind::constant:
        break;
      case Kind::add:
        result = add(derivative(n.first, v), derivative(n.second, v));
        break;
      case Kind::subtract:
        result = subtract(derivative(n.first, v), derivative(n.second, v));
        break;
      case Kind::multiply: {
        const int left = multiply(derivative(n.first, v), n.second);
        result = add(left, multiply(n.first, derivative(n.second, v)));
        break;
      }
      case Kind::square:
        result = multiply(multiply(constant(2), n.first), derivative(n.first, v));
        break;
      case Kind::inverse:
        result = multiply(subtract(zero_, multiply(node, node)), derivative(n.first, v));
        break;
    }
    if (node >= static_cast<int>(derivatives_[v].size())) derivatives_[v].resize(node + 1, unknown);
    return derivatives_[v][node] = result;
  }

  /// Laplace's expansion, the minors of the last rows made once each.
  int determinant(const std::vector<std::vector<int>>& matrix) {
    const std::size_t n = matrix.size();
    std::vector<int> minors(std::size_t{1} << n, one_);
    for (std::size_t columns = 1; columns < minors.size(); ++columns) {
      const std::vector<int>& row = matrix[n - static_cast<std::size_t>(std::popcount(columns))];
      int sum = zero_;
      bool plus = true;
      for (std::size_t left = columns; left != 0; left &= left - 1, plus = !plus) {
        const std::size_t own = left & (~left + 1);
        const int term = multiply(row[static_cast<std::size_t>(std::countr_zero(left))], minors[columns ^ own]);
        sum = plus ? add(sum, term) : subtract(sum, term);
      }
      minors[columns] = sum;
    }
    return minors.back();
  }

  int zero() const { return zero_; }
  int instructions() const { return instructions_; }

  /// The register of every node.
  std::vector<int> finish(SheetProgram& program) {
    std::vector<int> registers;
    int next = variables_ + static_cast<int>(constants_.size());
    for (const Node& node : nodes_) {
      switch (node.kind) {
        case Kind::variable:
          registers.push_back(node.first);
          continue;
        case Kind::constant:
          registers.push_back(variables_ + node.first);
          continue;
        case Kind::add:
          program.instructions_.push_back({Operation::add, 0, 0});
          break;
        case Kind::subtract:
          program.instructions_.push_back({Operation::subtract, 0, 0});
          break;
        case Kind::multiply:
          program.instructions_.push_back({Operation::multiply, 0, 0});
          break;
        case Kind::inverse:
          program.instructions_.push_back({Operation::inverse, 0, 0});
          break;
        case Kind::square:
          program.instructions_.push_back({Operation::square, 0, 0});
          break;
      }
      program.instructions_.back().first = registers[node.first];
      program.instructions_.back().second = registers[node.second];
      registers.push_back(next++);
    }
    program.constants_ = std::move(constants_);
    return registers;
  }

 private:
  enum class Kind : std::uint8_t { variable, constant, add, subtract, multiply, square, inverse };
  static constexpr int unknown = -1;
  struct Node {
    Kind kind;
    int first, second;
  };

  /// Horner's scheme in the last variable, its coefficients by Horner's scheme in the one before, and so on.
  int horner(const std::vector<const core::Term*>& terms, int variable) {
    if (terms.empty()) return zero_;
    if (variable < 0) return constant(terms.front()->coefficient);
    int highest = 0;
    for (const core::Term* term : terms) highest = std::max(highest, term->exponents[variable]);
    if (highest == 0) return horner(terms, variable - 1);
    std::vector<std::vector<const core::Term*>> by_power(highest + 1);
    for (const core::Term* term : terms) by_power[term->exponents[variable]].push_back(term);
    int result = zero_, previous = highest;
    for (int exponent = highest; exponent >= 0; --exponent) {
      if (by_power[exponent].empty()) continue;
      result = multiply(result, power(variable, previous - exponent));
      result = add(result, horner(by_power[exponent], variable - 1));
      previous = exponent;
    }
    return multiply(result, power(variable, previous));
  }

  int make(Kind kind, int a, int b) {
    const std::uint64_t key =
        static_cast<std::uint64_t>(kind) << 60 | static_cast<std::uint64_t>(a) << 30 | static_cast<std::uint64_t>(b);
    const auto [it, added] = shared_.try_emplace(key, static_cast<int>(nodes_.size()));
    if (added) {
      nodes_.push_back({kind, a, b});
      ++instructions_;
    }
    return it->second;
  }

  int variables_;
  int zero_ = 0, one_ = 0;
  int instructions_ = 0;
  std::vector<Node> nodes_;
  std::vector<Constant> constants_;
  std::map<core::Rational, int> constant_nodes_;
  std::unordered_map<std::uint64_t, int> shared_;
  std::vector<std::vector<int>> derivatives_;  // by variable and node
};

SheetProgram::SheetProgram(const core::RootTower& tower, std::vector<core::Polynomial> functions,
                           std::vector<core::StraightLine> lines)
    : tower_(tower), functions_(std::move(functions)), lines_(std::move(lines)) {
  lines_.resize(functions_.size());
  compile();
}

SheetProgram::SheetProgram(const core::RootTower& tower, const std::vector<SheetFunction>& functions) : tower_(tower) {
  for (const SheetFunction& function : functions) {
    functions_.push_back(function.polynomial);
    lines_.push_back(function.line);
  }
  compile();
}

SheetProgram SheetProgram::with_tangency(const core::RootTower& tower, const std::vector<SheetFunction>& two) {
  core::ensure(two.size() == 2, "two functions are tangent");
  SheetProgram program;
  program.tower_ = tower;
  for (const SheetFunction& function : two) {
    program.functions_.push_back(function.polynomial);
    program.lines_.push_back(function.line);
  }
  program.compile(true);
  return program;
}

bool SheetProgram::is_nested() const {
  return std::any_of(square_partials_.begin(), square_partials_.end(), [this](const std::vector<int>& partials) {
    return std::any_of(partials.begin() + coordinates(), partials.end(), [this](int p) { return p != zero_; });
  });
}

void SheetProgram::compile(bool tangency) {
  Builder builder(variables());
  std::vector<int> square_nodes, value_nodes;
  for (const core::Root& root : tower_.roots) {
    core::ensure(root.square.variables == variables(), "a root's square is written in all variables of the tower");
    square_nodes.push_back(root.line.empty() ? builder.polynomial(root.square) : builder.line(root.line));
    stage_end_.push_back(builder.instructions());
  }
  for (std::size_t f = 0; f < functions_.size(); ++f) {
    core::ensure(functions_[f].variables == variables(), "a function is written in all variables of the tower");
    value_nodes.push_back(lines_[f].empty() ? builder.polynomial(functions_[f]) : builder.line(lines_[f]));
  }
  if (tangency) {
    std::vector<std::vector<int>> jacobian;
    for (const int node : value_nodes) {
      jacobian.emplace_back();
      for (int v = 0; v < variables(); ++v) jacobian.back().push_back(builder.derivative(node, v));
    }
    for (int j = 0; j < roots(); ++j) {
      jacobian.emplace_back();
      for (int v = 0; v < variables(); ++v)
        jacobian.back().push_back(builder.subtract(builder.zero(), builder.derivative(square_nodes[j], v)));
      const int own = coordinates() + j;  // the square does not hold the root itself
      jacobian.back()[own] = builder.multiply(builder.constant(2), own);
    }
    value_nodes.push_back(builder.determinant(jacobian));
  }
  stage_end_.push_back(builder.instructions());

  const auto gradients = [&](const std::vector<int>& nodes) {
    std::vector<std::vector<int>> all;
    for (const int node : nodes) {
      all.emplace_back();
      for (int v = 0; v < variables(); ++v) all.back().push_back(builder.derivative(node, v));
    }
    return all;
  };
  partials_ = gradients(value_nodes);
  square_partials_ = gradients(square_nodes);
  stage_end_.push_back(builder.instructions());

  const std::vector<int> registers = builder.finish(*this);
  const auto to_registers = [&](std::vector<int>& nodes) {
    for (int& node : nodes) node = registers[node];
  };
  for (auto& gradient : partials_) to_registers(gradient);
  for (auto& gradient : square_partials_) to_registers(gradient);
  squares_ = square_nodes;
  values_ = value_nodes;
  to_registers(squares_);
  to_registers(values_);
  zero_ = registers[builder.zero()];
  for (const Constant& constant : constants_) {
    nearest_constants_.push_back(core::to_double(constant.value));
    enclosed_constants_.push_back(enclosed_as(constant.value, constant.radius, static_cast<Interval*>(nullptr)));
  }
}

}  // namespace clearloci::loci::sheet
