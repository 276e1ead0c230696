#include "loci/curves/sheet_sign.hpp"

#include <cmath>
#include <limits>

#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {
namespace {

using core::Interval;
using core::Polynomial;
using sheet::MultiInterval;

constexpr signed char unknown = 2;
constexpr int attempts = 8;
constexpr int no_square = -1;  // of an angle, which is above 0 as a root

Interval enclose(const core::Rational& lower, const core::Rational& upper) {
  // get_d truncates towards zero by less than one unit in the last place.
  const double low = lower.get_d(), high = upper.get_d();
  return {std::nextafter(low, -std::numeric_limits<double>::infinity()),
          std::nextafter(high, std::numeric_limits<double>::infinity())};
}

template <typename Number>
Number evaluate(const Polynomial& p, const std::vector<Number>& coefficients, const Number& x, const Number& y) {
  std::vector<Number> xs{Number(1.0)}, ys{Number(1.0)};
  const auto power = [](std::vector<Number>& table, const Number& base, int exponent) -> const Number& {
    while (static_cast<int>(table.size()) <= exponent) table.push_back(table.back() * base);
    return table[static_cast<std::size_t>(exponent)];
  };
  Number sum(0.0);
  for (std::size_t i = 0; i < p.terms.size(); ++i) {
    const auto& exponents = p.terms[i].exponents;
    sum = sum + coefficients[i] * (power(xs, x, exponents[0]) * power(ys, y, exponents[1]));
  }
  return sum;
}

}  // namespace

SheetSigns::SheetSigns(const core::RootTower& tower, const CurveArrangement& arrangement)
    : tower_(tower), arrangement_(arrangement) {
  for (const core::Root& root : tower.roots) squares_.push_back(root.is_angle() ? no_square : add(root.square));
}

int SheetSigns::add(const Polynomial& sheet) { return build(sheet); }

int SheetSigns::build(const Polynomial& p) {
  const int coordinates = static_cast<int>(tower_.coordinates.size());
  int top = static_cast<int>(tower_.roots.size()) - 1;
  while (top >= 0 && !core::depends_on(p, coordinates + top)) --top;
  Node node;
  if (top < 0) {
    node.leaf = static_cast<int>(leaves_.size());
    Leaf& leaf = leaves_.emplace_back();
    leaf.polynomial = core::with_variables(p, coordinates);
    for (const core::Term& term : leaf.polynomial.terms) {
      leaf.coefficients.push_back(enclose(term.coefficient, term.coefficient));
    }
    leaf.known.assign(arrangement_.edges().size(), unknown);
  } else {
    node.root = top;
    const auto [a, b] = split(p, coordinates + top);
    node.a = build(a);
    node.b = build(b);
    node.norm = build(reduce(a * a - b * b * tower_.roots[static_cast<std::size_t>(top)].square, tower_));
  }
  nodes_.push_back(node);
  return static_cast<int>(nodes_.size()) - 1;
}

std::optional<int> SheetSigns::sign(int sheet, const core::WorkingMode& mode, int edge) {
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (const auto decided = node_sign(sheet, mode, edge, attempt)) return decided;
  }
  return std::nullopt;
}

std::optional<int> SheetSigns::square_sign(int root, const core::WorkingMode& mode, int edge) {
  const int square = squares_[static_cast<std::size_t>(root)];
  return square == no_square ? 1 : sign(square, mode, edge);
}

std::optional<int> SheetSigns::root_sign(int root, const core::WorkingMode& mode, int edge, int attempt) {
  const auto square = node_sign(squares_[static_cast<std::size_t>(root)], mode, edge, attempt);
  if (!square) return std::nullopt;
  return *square == 0 ? 0 : mode[static_cast<std::size_t>(root)];
}

std::optional<int> SheetSigns::node_sign(int index, const core::WorkingMode& mode, int edge, int attempt) {
  const Node node = nodes_[static_cast<std::size_t>(index)];
  if (node.root < 0) return leaf_sign(node.leaf, edge, attempt);
  const auto a = node_sign(node.a, mode, edge, attempt);
  if (!a) return std::nullopt;
  const auto b = node_sign(node.b, mode, edge, attempt);
  if (!b) return std::nullopt;
  if (*b == 0) return a;
  const auto s = root_sign(node.root, mode, edge, attempt);
  if (!s) return std::nullopt;
  const int product = *b * *s;
  if (product == 0 || product == *a) return a;
  if (*a == 0) return product;
  const auto norm = node_sign(node.norm, mode, edge, attempt);
  if (!norm) return std::nullopt;
  return *a * *norm;
}

std::optional<int> SheetSigns::leaf_sign(int index, int edge, int attempt) {
  Leaf& leaf = leaves_[static_cast<std::size_t>(index)];
  if (leaf.polynomial.is_zero()) return 0;
  signed char& edge_sign = leaf.known[static_cast<std::size_t>(edge)];
  if (attempt == 0 && edge_sign != unknown) return edge_sign;
  const int curve = arrangement_.edges()[static_cast<std::size_t>(edge)].curve;
  if (const auto factor = leaf.vanishes_on.find(curve); factor != leaf.vanishes_on.end() && factor->second) return 0;
  const Sample& at = sample(edge, attempt);
  int sign = evaluate(leaf.polynomial, leaf.coefficients, at.coarse[0], at.coarse[1]).sign();
  if (sign == 0) {
    auto [factor, fresh] = leaf.vanishes_on.try_emplace(curve, false);
    if (fresh) factor->second = arrangement_.divides(curve, leaf.polynomial);
    if (factor->second) return edge_sign = 0;
    std::vector<MultiInterval> coefficients;
    for (const core::Term& term : leaf.polynomial.terms) coefficients.emplace_back(term.coefficient);
    sign = evaluate(leaf.polynomial, coefficients, at.fine[0], at.fine[1]).sign();
    if (sign == 0) return std::nullopt;
  }
  if (attempt == 0) edge_sign = static_cast<signed char>(sign);
  return sign;
}

const SheetSigns::Sample& SheetSigns::sample(int edge, int attempt) {
  const auto [entry, fresh] = samples_.try_emplace({edge, attempt});
  if (fresh) {
    const PointEnclosure at = arrangement_.sample(edge, attempt);
    for (std::size_t i = 0; i < 2; ++i) {
      entry->second.coarse[i] = enclose(at.lower[i], at.upper[i]);
      entry->second.fine[i] = MultiInterval(at.lower[i], at.upper[i]);
    }
  }
  return entry->second;
}

}  // namespace clearloci::loci
