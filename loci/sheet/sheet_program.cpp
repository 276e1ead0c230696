#include "loci/sheet/sheet_program.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "core/errors.hpp"

namespace clearloci::loci::sheet {

namespace {

// Cells wider than this, in steps of the grid of origins, gain nothing from an origin in their middle.
constexpr double widest_local = 0.25;

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
  if (core::Rational(nearest) == value) return nearest;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {std::nextafter(nearest, -infinity), std::nextafter(nearest, infinity)};
}

MultiInterval constant_as(const core::Rational& value, MultiInterval*) { return MultiInterval(value); }

/// Builds the instructions; equal ones are made once. Nodes are numbered: variables, then constants and instructions
/// as they come; `finish` turns the numbers into registers.
class SheetProgram::Builder {
 public:
  explicit Builder(int variables) : variables_(variables) {
    for (int v = 0; v < variables; ++v) nodes_.push_back({Kind::variable, v, 0});
    zero_ = constant(0);
    one_ = constant(1);
  }

  int constant(const core::Rational& value) {
    const auto [it, added] = constant_nodes_.try_emplace(core::to_string(value), static_cast<int>(nodes_.size()));
    if (added) {
      nodes_.push_back({Kind::constant, static_cast<int>(constants_.size()), 0});
      constants_.push_back(value);
    }
    return it->second;
  }

  int add(int a, int b) {
    if (a == zero_) return b;
    if (b == zero_) return a;
    return make(Kind::add, std::min(a, b), std::max(a, b));
  }

  int multiply(int a, int b) {
    if (a == zero_ || b == zero_) return zero_;
    if (a == one_) return b;
    if (b == one_) return a;
    return a == b ? make(Kind::square, a, a) : make(Kind::multiply, std::min(a, b), std::max(a, b));
  }

  int power(int base, int exponent) {
    if (exponent == 0) return one_;
    if (exponent == 1) return base;
    const int half = power(base, exponent / 2);
    const int even = multiply(half, half);
    return exponent % 2 == 0 ? even : multiply(even, base);
  }

  /// Horner's scheme in the last variable, its coefficients by Horner's scheme in the one before, and so on.
  int horner(const std::vector<core::Term>& terms, int variable) {
    if (terms.empty()) return zero_;
    if (variable < 0) return constant(terms.front().coefficient);
    std::map<int, std::vector<core::Term>, std::greater<>> by_power;
    for (const core::Term& term : terms) by_power[term.exponents[variable]].push_back(term);
    int result = zero_, previous = 0;
    for (const auto& [exponent, coefficient] : by_power) {
      if (result != zero_) result = multiply(result, power(variable, previous - exponent));
      result = add(result, horner(coefficient, variable - 1));
      previous = exponent;
    }
    return multiply(result, power(variable, previous));
  }

  int derivative(int node, int v) {
    const auto known = derivatives_.find({node, v});
    if (known != derivatives_.end()) return known->second;
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
      case Kind::multiply: {
        const int left = multiply(derivative(n.first, v), n.second);
        result = add(left, multiply(n.first, derivative(n.second, v)));
        break;
      }
      case Kind::square:
        result = multiply(multiply(constant(2), n.first), derivative(n.first, v));
        break;
    }
    derivatives_[{node, v}] = result;
    return result;
  }

  int zero() const { return zero_; }
  int instructions() const { return instructions_; }

  /// The register of every node.
  std::vector<int> finish(SheetProgram& program) const {
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
        case Kind::multiply:
          program.instructions_.push_back({Operation::multiply, 0, 0});
          break;
        case Kind::square:
          program.instructions_.push_back({Operation::square, 0, 0});
          break;
      }
      program.instructions_.back().first = registers[node.first];
      program.instructions_.back().second = registers[node.second];
      registers.push_back(next++);
    }
    program.constants_ = constants_;
    return registers;
  }

 private:
  enum class Kind { variable, constant, add, multiply, square };
  struct Node {
    Kind kind;
    int first, second;
  };

  int make(Kind kind, int a, int b) {
    const auto [it, added] = shared_.try_emplace({kind, a, b}, static_cast<int>(nodes_.size()));
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
  std::vector<core::Rational> constants_;
  std::map<std::string, int> constant_nodes_;
  std::map<std::tuple<Kind, int, int>, int> shared_;
  std::map<std::pair<int, int>, int> derivatives_;
};

SheetProgram::SheetProgram(const core::RootTower& tower, std::vector<core::Polynomial> functions)
    : tower_(tower), functions_(std::move(functions)) {
  core::ensure(tower_.coordinates.size() == 2, "a sheet has two free coordinates");
  compile(tower_, functions_);
}

SheetProgram::SheetProgram(const SheetProgram& program, std::array<double, 2> origin)
    : tower_(program.tower_), functions_(program.functions_), moved_(true), origin_(origin) {
  const auto moved = [&](const core::Polynomial& p) {
    return shifted(shifted(p, 0, core::Rational(origin[0])), 1, core::Rational(origin[1]));
  };
  core::RootTower tower = tower_;
  std::vector<core::Polynomial> functions;
  for (core::Root& root : tower.roots) root.square = moved(root.square);
  for (const core::Polynomial& function : functions_) functions.push_back(moved(function));
  compile(tower, functions);
}

const SheetProgram& SheetProgram::near(double x, double y, double width) const {
  if (local_step_ == 0 || width > widest_local * local_step_ || std::hypot(x, y) < local_step_) return *this;
  std::array<double, 2> origin = {(std::floor(x / local_step_) + 0.5) * local_step_,
                                  (std::floor(y / local_step_) + 0.5) * local_step_};
  double nearest = local_step_;
  for (const std::array<double, 2>& point : local_points_) {
    const double distance = std::hypot(point[0] - x, point[1] - y);
    if (distance < nearest) nearest = distance, origin = point;
  }
  std::unique_ptr<SheetProgram>& program = local_[origin];
  if (!program) program.reset(new SheetProgram(*this, origin));
  return *program;
}

void SheetProgram::compile(const core::RootTower& tower, const std::vector<core::Polynomial>& functions) {
  Builder builder(variables());
  std::vector<int> square_nodes, value_nodes;
  for (const core::Root& root : tower.roots) {
    core::ensure(root.square.variables == variables(), "a root's square is written in all variables of the tower");
    square_nodes.push_back(builder.horner(root.square.terms, variables() - 1));
    stage_end_.push_back(builder.instructions());
  }
  for (const core::Polynomial& function : functions) {
    core::ensure(function.variables == variables(), "a function is written in all variables of the tower");
    value_nodes.push_back(builder.horner(function.terms, variables() - 1));
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
}

}  // namespace clearloci::loci::sheet
