#include "loci/numbers/sheet_code.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <mutex>
#include <tuple>
#include <unordered_map>

#include "core/errors.hpp"

namespace clearloci::loci::sheet {
namespace {

/// Of numbers that stand elsewhere: copies would be most of the cost.
struct HashRational {
  std::size_t operator()(const core::Rational* value) const {
    const auto low = [](mpz_srcptr n) { return static_cast<std::size_t>(mpz_get_ui(n)); };
    constexpr std::size_t odd = 0x9e3779b97f4a7c15;
    return (low(value->get_num_mpz_t()) * odd) ^ low(value->get_den_mpz_t()) ^
           static_cast<std::size_t>(sgn(*value) + 1);
  }
};

struct EqualRationals {
  bool operator()(const core::Rational* a, const core::Rational* b) const { return *a == *b; }
};

struct HashShape {
  std::size_t operator()(const std::vector<int>& shape) const {
    std::size_t hash = shape.size();
    for (const int word : shape) hash = (std::rotl(hash, 5) ^ static_cast<unsigned>(word)) * 0x9e3779b97f4a7c15;
    return hash;
  }
};

/// The numbers of what is compiled, each once: how an instruction is shared depends on which of them are equal, and on
/// those that fold away. What is known within a radius equals nothing else. Those given must outlive this.
class Numbers {
 public:
  static constexpr int zero = 0, one = 1, two = 2;
  Numbers() {
    static const std::array<core::Rational, 3> always = {0, 1, 2};
    list_.reserve(usual);
    known_.reserve(usual);
    for (const core::Rational& value : always) index(value);
  }

  int index(const core::Rational& value) {
    const auto [it, added] = known_.try_emplace(&value, static_cast<int>(list_.size()));
    if (added) list_.emplace_back(&value, nullptr);
    return it->second;
  }
  int index(const core::Rational& value, const core::Rational& radius) {
    if (radius == 0) return index(value);
    list_.emplace_back(&value, &radius);
    return static_cast<int>(list_.size()) - 1;
  }
  std::vector<SheetNumber> copies() const {
    std::vector<SheetNumber> all;
    all.reserve(list_.size());
    for (const auto& [value, radius] : list_) all.push_back({*value, radius == nullptr ? core::Rational() : *radius});
    return all;
  }

 private:
  static constexpr std::size_t usual = 32;
  std::vector<std::pair<const core::Rational*, const core::Rational*>> list_;  ///< radius: none where it is 0
  std::unordered_map<const core::Rational*, int, HashRational, EqualRationals> known_;
};

/// First word of a function in a shape: what follows.
constexpr int polynomial_follows = 0, line_follows = 1;

void write_polynomial(const core::Polynomial& p, Numbers& numbers, std::vector<int>& shape) {
  shape.push_back(polynomial_follows);
  shape.push_back(static_cast<int>(p.terms.size()));
  for (const core::Term& term : p.terms) {
    shape.push_back(numbers.index(term.coefficient));
    shape.insert(shape.end(), term.exponents.begin(), term.exponents.end());
  }
}

void write_line(const core::StraightLine& line, Numbers& numbers, std::vector<int>& shape) {
  using Step = core::StraightLine::Operation;
  shape.push_back(line_follows);
  shape.push_back(static_cast<int>(line.steps.size()));
  for (const core::StraightLine::Step& step : line.steps) {
    shape.push_back(static_cast<int>(step.operation));
    shape.push_back(step.operation == Step::constant ? numbers.index(step.value(), step.radius()) : step.first);
    shape.push_back(step.operation == Step::constant ? 0 : step.second);
  }
}

/// Builds the instructions; equal ones are made once. Nodes are numbered: variables, then constants and instructions
/// as they come; `finish` turns the numbers into registers.
class Builder {
 public:
  explicit Builder(int variables) : variables_(variables), derivatives_(variables) {
    for (int v = 0; v < variables; ++v) nodes_.push_back({Kind::variable, v, 0});
    zero_ = constant(Numbers::zero);
    one_ = constant(Numbers::one);
  }

  int constant(int number) {
    const auto at = static_cast<std::size_t>(number);
    if (at >= constant_nodes_.size()) constant_nodes_.resize(at + 1, unknown);
    if (constant_nodes_[at] == unknown) {
      constant_nodes_[at] = static_cast<int>(nodes_.size());
      nodes_.push_back({Kind::constant, static_cast<int>(constants_.size()), 0});
      constants_.push_back(number);
    }
    return constant_nodes_[at];
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
  int angle(int y, int x) { return make(Kind::angle, y, x); }
  int angle_slope(int y, int x) { return make(Kind::angle_slope, y, x); }

  int power(int base, int exponent) {
    if (exponent == 0) return one_;
    if (exponent == 1) return base;
    const int half = power(base, exponent / 2);
    const int even = multiply(half, half);
    return exponent % 2 == 0 ? even : multiply(even, base);
  }

  /// What write_polynomial() or write_line() wrote; `at` goes on behind it.
  int function(const std::vector<int>& shape, std::size_t& at) {
    return shape[at] == polynomial_follows ? polynomial(shape, ++at) : line(shape, ++at);
  }

  int derivative(int node, int v) {
    std::vector<int>& derivatives = derivatives_[v];
    if (node < static_cast<int>(derivatives.size()) && derivatives[node] != unknown) return derivatives[node];
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
        result = multiply(multiply(constant(Numbers::two), n.first), derivative(n.first, v));
        break;
      case Kind::inverse:
        result = multiply(subtract(zero_, multiply(node, node)), derivative(n.first, v));
        break;
      case Kind::angle: {
        const int turned = multiply(n.second, derivative(n.first, v));
        result = multiply(subtract(turned, multiply(n.first, derivative(n.second, v))), angle_slope(n.first, n.second));
        break;
      }
      case Kind::angle_slope: {
        const int grown = add(multiply(n.first, derivative(n.first, v)), multiply(n.second, derivative(n.second, v)));
        result = multiply(multiply(constant(Numbers::two), multiply(node, node)), subtract(zero_, grown));
        break;
      }
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
        const std::size_t lowest = left & (~left + 1);
        const int term = multiply(row[static_cast<std::size_t>(std::countr_zero(left))], minors[columns ^ lowest]);
        sum = plus ? add(sum, term) : subtract(sum, term);
      }
      minors[columns] = sum;
    }
    return minors.back();
  }

  int zero() const { return zero_; }
  int instructions() const { return instructions_; }

  /// The register of every node. Within a stage (of those that end after so many instructions) what waits for nothing
  /// comes first: a processor works on neighbours at a time where none needs the other's result, and foresees what
  /// is to be done where it is the same.
  std::vector<int> finish(SheetCode& code) {
    std::vector<int> order;  // nodes, instructions alone
    std::vector<int> level(nodes_.size(), 0), stage(nodes_.size(), -1);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Node& node = nodes_[i];
      if (node.kind == Kind::variable || node.kind == Kind::constant) continue;
      const auto made = static_cast<int>(order.size());
      stage[i] = static_cast<int>(std::upper_bound(code.stage_end.begin(), code.stage_end.end(), made) -
                                  code.stage_end.begin());
      for (const int operand : {node.first, node.second})
        if (stage[operand] == stage[i]) level[i] = std::max(level[i], level[operand] + 1);
      order.push_back(static_cast<int>(i));
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return std::tuple(stage[a], level[a], nodes_[a].kind) < std::tuple(stage[b], level[b], nodes_[b].kind);
    });
    std::vector<int> registers(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (stage[i] < 0)
        registers[i] = nodes_[i].kind == Kind::variable ? nodes_[i].first : variables_ + nodes_[i].first;
    int next = variables_ + static_cast<int>(constants_.size());
    for (const int node : order) registers[node] = next++;
    for (const int node : order)
      code.instructions.push_back(
          {operation_of(nodes_[node].kind), registers[nodes_[node].first], registers[nodes_[node].second]});
    code.constants = std::move(constants_);
    return registers;
  }

 private:
  enum class Kind : std::uint8_t { variable, constant, add, subtract, multiply, square, inverse, angle, angle_slope };
  static constexpr int unknown = -1;
  struct Node {
    Kind kind;
    int first, second;
  };

  /// Of an instruction.
  static SheetCode::Operation operation_of(Kind kind) {
    using Operation = SheetCode::Operation;
    switch (kind) {
      case Kind::add:
        return Operation::add;
      case Kind::subtract:
        return Operation::subtract;
      case Kind::multiply:
        return Operation::multiply;
      case Kind::square:
        return Operation::square;
      case Kind::inverse:
        return Operation::inverse;
      case Kind::angle:
        return Operation::angle;
      case Kind::angle_slope:
        return Operation::angle_slope;
      default:
        core::ensure(false, "variables and constants are no instructions");
        return Operation::add;
    }
  }

  /// A term as it is written: its number, then the exponents.
  using Term = const int*;
  static int exponent_of(Term term, int variable) { return term[1 + variable]; }

  int polynomial(const std::vector<int>& shape, std::size_t& at) {
    const int count = shape[at++];
    std::vector<Term> terms;
    for (int i = 0; i < count; ++i, at += static_cast<std::size_t>(1 + variables_)) terms.push_back(&shape[at]);
    return horner(terms, variables_ - 1);
  }

  int line(const std::vector<int>& shape, std::size_t& at) {
    using Step = core::StraightLine::Operation;
    std::vector<int> nodes;
    const int count = shape[at++];
    for (int i = 0; i < count; ++i) {
      const auto operation = static_cast<Step>(shape[at]);
      const int first = shape[at + 1], second = shape[at + 2];
      at += 3;
      const auto operand = [&](int index) { return nodes[static_cast<std::size_t>(index)]; };
      switch (operation) {
        case Step::constant:
          nodes.push_back(constant(first));
          break;
        case Step::variable:
          nodes.push_back(first);
          break;
        case Step::add:
          nodes.push_back(add(operand(first), operand(second)));
          break;
        case Step::subtract:
          nodes.push_back(subtract(operand(first), operand(second)));
          break;
        case Step::multiply:
          nodes.push_back(multiply(operand(first), operand(second)));
          break;
        case Step::inverse:
          nodes.push_back(inverse(operand(first)));
          break;
        case Step::angle:
          nodes.push_back(angle(operand(first), operand(second)));
          break;
      }
    }
    return nodes.back();
  }

  /// Horner's scheme in the last variable, its coefficients by Horner's scheme in the one before, and so on.
  int horner(const std::vector<Term>& terms, int variable) {
    if (terms.empty()) return zero_;
    if (variable < 0) return constant(*terms.front());
    int highest = 0;
    for (const Term term : terms) highest = std::max(highest, exponent_of(term, variable));
    if (highest == 0) return horner(terms, variable - 1);
    std::vector<std::vector<Term>> by_power(highest + 1);
    for (const Term term : terms) by_power[exponent_of(term, variable)].push_back(term);
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
  std::vector<int> constants_;
  std::vector<int> constant_nodes_;  // by number
  std::unordered_map<std::uint64_t, int> shared_;
  std::vector<std::vector<int>> derivatives_;  // by variable and node
};

/// Of a shape: variables, coordinates, functions, whether with their tangency; then the squares and the functions.
SheetCode compile(const std::vector<int>& shape) {
  const int variables = shape[0], coordinates = shape[1], functions = shape[2], roots = variables - coordinates;
  const bool tangency = shape[3] != 0;
  std::size_t at = 4;
  SheetCode code;
  Builder builder(variables);
  std::vector<int> square_nodes, value_nodes;
  for (int j = 0; j < roots; ++j) {
    square_nodes.push_back(builder.function(shape, at));
    code.stage_end.push_back(builder.instructions());
  }
  for (int f = 0; f < functions; ++f) value_nodes.push_back(builder.function(shape, at));
  if (tangency) {
    std::vector<std::vector<int>> jacobian;
    for (const int node : value_nodes) {
      jacobian.emplace_back();
      for (int v = 0; v < variables; ++v) jacobian.back().push_back(builder.derivative(node, v));
    }
    for (int j = 0; j < roots; ++j) {
      jacobian.emplace_back();
      for (int v = 0; v < variables; ++v)
        jacobian.back().push_back(builder.subtract(builder.zero(), builder.derivative(square_nodes[j], v)));
      const int variable = coordinates + j;  // the square does not hold the root itself
      jacobian.back()[variable] = builder.multiply(builder.constant(Numbers::two), variable);
    }
    value_nodes.push_back(builder.determinant(jacobian));
  }
  code.stage_end.push_back(builder.instructions());

  const auto gradients = [&](const std::vector<int>& nodes) {
    std::vector<std::vector<int>> all;
    for (const int node : nodes) {
      all.emplace_back();
      for (int v = 0; v < variables; ++v) all.back().push_back(builder.derivative(node, v));
    }
    return all;
  };
  code.partials = gradients(value_nodes);
  code.square_partials = gradients(square_nodes);
  code.stage_end.push_back(builder.instructions());

  const std::vector<int> registers = builder.finish(code);
  const auto to_registers = [&](std::vector<int>& nodes) {
    for (int& node : nodes) node = registers[node];
  };
  for (auto& gradient : code.partials) to_registers(gradient);
  for (auto& gradient : code.square_partials) to_registers(gradient);
  code.squares = square_nodes;
  code.values = value_nodes;
  to_registers(code.squares);
  to_registers(code.values);
  code.zero = registers[builder.zero()];
  return code;
}

/// Codes by shape, for all threads; forgotten together when they become many.
class Compiled {
 public:
  std::shared_ptr<const SheetCode> of(std::vector<int>&& shape) {
    {
      const std::lock_guard lock(mutex_);
      const auto found = known_.find(shape);
      if (found != known_.end()) return found->second;
    }
    auto code = std::make_shared<const SheetCode>(compile(shape));
    const std::lock_guard lock(mutex_);
    words_ += shape.size() + 3 * code->instructions.size();
    if (words_ > most_words) {
      known_.clear();
      words_ = 0;
    }
    known_.emplace(std::move(shape), code);
    return code;
  }

 private:
  static constexpr std::size_t most_words = std::size_t{1} << 23;  // 32 MB
  std::mutex mutex_;
  std::unordered_map<std::vector<int>, std::shared_ptr<const SheetCode>, HashShape> known_;
  std::size_t words_ = 0;
};

}  // namespace

CompiledSheet compile_sheet(const core::RootTower& tower, const std::vector<core::Polynomial>& functions,
                            const std::vector<core::StraightLine>& lines, bool tangency) {
  static Compiled compiled;
  const auto coordinates = static_cast<int>(tower.coordinates.size());
  const int variables = coordinates + static_cast<int>(tower.roots.size());
  Numbers numbers;
  std::vector<int> shape = {variables, coordinates, static_cast<int>(functions.size()), tangency ? 1 : 0};
  const auto write = [&](const core::Polynomial& polynomial, const core::StraightLine& line) {
    core::ensure(polynomial.variables == variables, "squares and functions are written in all variables of the tower");
    line.empty() ? write_polynomial(polynomial, numbers, shape) : write_line(line, numbers, shape);
  };
  for (const core::Root& root : tower.roots) write(root.square, root.line);
  for (std::size_t f = 0; f < functions.size(); ++f) write(functions[f], lines[f]);
  return {compiled.of(std::move(shape)), numbers.copies()};
}

}  // namespace clearloci::loci::sheet
