#include "symbolic/dependent_roots.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/errors.hpp"
#include "symbolic/geometry.hpp"
#include "symbolic/tower_steps.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;

// --- Residues -------------------------------------------------------------------------------------------------------

/// A prime that is 3 modulo 4: a square's root is a power of it.
constexpr std::uint64_t prime = 2147483647;

std::uint64_t power(std::uint64_t base, std::uint64_t exponent) {
  std::uint64_t result = 1;
  for (; exponent > 0; exponent /= 2, base = base * base % prime)
    if (exponent % 2 == 1) result = result * base % prime;
  return result;
}

std::uint64_t residue(const core::Integer& value) { return mpz_fdiv_ui(value.get_mpz_t(), prime); }

/// A polynomial whose coefficients were put modulo the prime; nothing where it divides a denominator.
struct Residues {
  std::vector<std::pair<std::vector<int>, std::uint64_t>> terms;

  std::uint64_t at(const std::vector<std::uint64_t>& values) const {
    std::uint64_t sum = 0;
    for (const auto& [exponents, coefficient] : terms) {
      std::uint64_t product = coefficient;
      for (std::size_t v = 0; v < exponents.size(); ++v)
        if (exponents[v] > 0) product = product * power(values[v], static_cast<std::uint64_t>(exponents[v])) % prime;
      sum = (sum + product) % prime;
    }
    return sum;
  }
};

std::optional<Residues> residues(const Poly& p) {
  Residues result;
  for (const core::Term& term : p.plain().terms) {
    const std::uint64_t below = residue(term.coefficient.get_den());
    if (below == 0) return std::nullopt;
    result.terms.emplace_back(term.exponents, residue(term.coefficient.get_num()) * power(below, prime - 2) % prime);
  }
  return result;
}

/// False only where p is certainly no number times a square: at places where all roots before it have values modulo the
/// prime it is now a square there and now none.
bool may_be_square(const Poly& p, int coordinates, const std::vector<TowerRoot>& roots) {
  constexpr int tries = 4096;
  const std::optional<Residues> remainders = residues(p);
  std::vector<Residues> squares;
  for (const TowerRoot& root : roots) {
    std::optional<Residues> square = residues(root.square);
    if (!square) return true;
    squares.push_back(std::move(*square));
  }
  if (!remainders) return true;
  std::uint64_t state = 20110101;
  const auto next = [&state] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (state >> 33) % prime;
  };
  std::vector<std::uint64_t> at(static_cast<std::size_t>(p.ring().size()), 0);
  bool square = false, none = false;
  for (int i = 0; i < tries; ++i) {
    for (int v = 0; v < coordinates; ++v) at[static_cast<std::size_t>(v)] = next();
    bool placed = true;
    for (std::size_t j = 0; j < roots.size() && placed; ++j) {
      const std::uint64_t q = squares[j].at(at), s = power(q, (prime + 1) / 4);
      placed = s * s % prime == q;
      at[static_cast<std::size_t>(roots[j].variable)] = next() % 2 == 0 ? s : (prime - s) % prime;
    }
    if (!placed) continue;
    const std::uint64_t value = remainders->at(at);
    if (value == 0) continue;
    (power(value, (prime - 1) / 2) == 1 ? square : none) = true;
    if (square && none) return false;
  }
  return true;
}

// --- Conjugates -----------------------------------------------------------------------------------------------------

class Squares {
 public:
  explicit Squares(const std::vector<TowerRoot>& roots) : roots_(roots) {}

  /// p in the coordinates and the first `level` roots.
  std::optional<SquareClass> of(const Poly& p, std::size_t level) const {
    if (p.is_zero()) return SquareClass{1, p};
    if (level == 0) return over_coordinates(p);
    const TowerRoot& top = roots_[level - 1];
    const auto [a, b] = split(p, top.variable);
    if (b.is_zero()) {
      if (auto plain = of(a, level - 1)) return plain;
      // a = c e^2 / Q = c (e s / Q)^2.
      const std::optional<SquareClass> times = of(reduce(a * top.square), level - 1);
      if (!times) return std::nullopt;
      const std::optional<Poly> below = quotient(times->root, top.square);
      if (!below) {
        open_ = true;
        return std::nullopt;
      }
      return SquareClass{times->constant, *below * Poly::variable(p.ring(), top.variable)};
    }
    // a + b s = c (u + v s)^2:  a^2 - b^2 Q = c^2 (u^2 - v^2 Q)^2,  c u^2 = (a +- its root) / 2,  v = b / (2 c u).
    const std::optional<SquareClass> norm = of(reduce(a * a - b * b * top.square), level - 1);
    if (!norm || norm->constant != 1) return std::nullopt;
    for (const int sign : {1, -1}) {
      const Poly half = (a + norm->root.scaled(sign)).scaled(Rational(1, 2));
      if (half.is_zero()) continue;
      const std::optional<SquareClass> u = of(half, level - 1);
      if (!u) continue;
      const std::optional<Poly> v = quotient(b.scaled(Rational(1, 2) / u->constant), u->root);
      if (!v) {
        open_ = true;
        continue;
      }
      return SquareClass{u->constant, u->root + *v * Poly::variable(p.ring(), top.variable)};
    }
    return std::nullopt;
  }

  bool open() const { return open_; }

  Poly reduce(Poly p) const { return reduced_in(std::move(p), roots_); }

 private:
  std::optional<Poly> quotient(const Poly& p, const Poly& divisor) const { return quotient_in(p, divisor, roots_); }

  static std::optional<SquareClass> over_coordinates(const Poly& p) {
    const Poly primitive = p.primitive();
    Poly root(p.ring());
    if (!primitive.square_root(root)) return std::nullopt;
    Rational constant = p.exact_quotient(primitive).constant();
    if (constant < 0) return std::nullopt;  // nowhere reachable but where the root is zero
    // Squares of small primes are taken out of the constant: numbers that people write.
    Rational size = 1;
    for (unsigned long n = 2; n < 1000; ++n) {
      const Rational square(n * n);
      while (mpz_divisible_ui_p(constant.get_num_mpz_t(), n * n)) constant /= square, size *= n;
      while (mpz_divisible_ui_p(constant.get_den_mpz_t(), n * n)) constant *= square, size /= n;
    }
    if (mpz_perfect_square_p(constant.get_num_mpz_t()) && mpz_perfect_square_p(constant.get_den_mpz_t())) {
      size *= Rational(sqrt(constant.get_num()), sqrt(constant.get_den()));
      constant = 1;
    }
    return SquareClass{constant, root.scaled(size)};
  }

  const std::vector<TowerRoot>& roots_;
  mutable bool open_ = false;
};

// --- Enclosures -----------------------------------------------------------------------------------------------------

using Range = std::array<Rational, 2>;

Range power_of(const Range& x, int exponent) {
  Range result = {1, 1};
  for (int i = 0; i < exponent; ++i) {
    const std::array<Rational, 4> ends = {result[0] * x[0], result[0] * x[1], result[1] * x[0], result[1] * x[1]};
    result = {*std::min_element(ends.begin(), ends.end()), *std::max_element(ends.begin(), ends.end())};
  }
  if (exponent % 2 == 0 && result[0] < 0) result[0] = 0;
  return result;
}

Range value_over(const core::Polynomial& p, const std::vector<Range>& box) {
  Range sum = {0, 0};
  for (const core::Term& term : p.terms) {
    Range product = {term.coefficient, term.coefficient};
    for (std::size_t v = 0; v < term.exponents.size(); ++v) {
      if (term.exponents[v] == 0) continue;
      const Range factor = power_of(box[v], term.exponents[v]);
      const std::array<Rational, 4> ends = {product[0] * factor[0], product[0] * factor[1], product[1] * factor[0],
                                            product[1] * factor[1]};
      product = {*std::min_element(ends.begin(), ends.end()), *std::max_element(ends.begin(), ends.end())};
    }
    sum[0] += product[0];
    sum[1] += product[1];
  }
  return sum;
}

}  // namespace

SquareTest square_class(const Poly& p, int coordinates, const std::vector<TowerRoot>& roots) {
  if (p.is_zero() || !may_be_square(p, coordinates, roots)) return {};
  const Squares squares(roots);
  std::optional<SquareClass> found = squares.of(p, roots.size());
  if (found)
    core::ensure(squares.reduce(found->root * found->root).scaled(found->constant) == p, "a root's square is its own");
  const bool open = !found && squares.open();
  return {std::move(found), open};
}

std::optional<Poly> quotient_over_tower(const Poly& p, const Poly& divisor, const std::vector<TowerRoot>& roots) {
  return quotient_in(p, divisor, roots);
}

int sign_over_box(const core::Polynomial& p, const std::vector<Rational>& lower, const std::vector<Rational>& upper) {
  constexpr std::size_t most_boxes = 256;
  std::vector<Range> whole;
  for (std::size_t i = 0; i < lower.size(); ++i) whole.push_back({lower[i], upper[i]});
  std::vector<std::vector<Range>> open = {whole};
  int sign = 0;
  for (std::size_t done = 0; !open.empty(); ++done) {
    if (done == most_boxes) return 0;
    const std::vector<Range> box = open.back();
    open.pop_back();
    const Range value = value_over(p, box);
    const int box_sign = value[0] > 0 ? 1 : value[1] < 0 ? -1 : 0;
    if (box_sign != 0) {
      if (sign != 0 && box_sign != sign) return 0;
      sign = box_sign;
      continue;
    }
    if (value[0] == 0 && value[1] == 0) return 0;
    std::size_t widest = box.size();
    for (std::size_t i = 0; i < box.size(); ++i)
      if (core::depends_on(p, static_cast<int>(i)) &&
          (widest == box.size() || box[i][1] - box[i][0] > box[widest][1] - box[widest][0]))
        widest = i;
    if (widest == box.size()) return 0;
    std::vector<Range> low = box, high = box;
    low[widest][1] = high[widest][0] = (box[widest][0] + box[widest][1]) / 2;
    open.push_back(std::move(low));
    open.push_back(std::move(high));
  }
  return sign;
}

}  // namespace clearloci::symbolic
