#include "core/circle_pair.hpp"

namespace clearloci::inline core {
namespace {

constexpr unsigned precision = 256;  // bits: the sum may cancel

/// ax x + ay y + a1.
struct Linear {
  Rational x, y, one;
};

/// n l^2, n a positive integer.
struct ScaledSquare {
  Integer n;
  Linear l;
};

/// n with its small square factors taken out; `root` is multiplied by theirs.
Integer without_squares(Integer n, Rational& root) {
  constexpr unsigned long most = 1000;
  for (unsigned long p = 2; p <= most && Integer(p) * p <= n; ++p) {
    while (mpz_divisible_ui_p(n.get_mpz_t(), p * p) != 0) {
      n /= p * p;
      root *= p;
    }
  }
  return n;
}

/// The quadratic a x^2 + b x y + c y^2 + d x + e y + f as a multiple of a square, if it is a positive one.
std::optional<ScaledSquare> scaled_square(const Rational& a, const Rational& b, const Rational& c, const Rational& d,
                                          const Rational& e, const Rational& f) {
  const bool square = b * b == 4 * a * c && d * d == 4 * a * f && e * e == 4 * c * f && b * d == 2 * a * e &&
                      b * e == 2 * c * d && d * e == 2 * f * b;
  const Rational first = sgn(a) != 0 ? a : sgn(c) != 0 ? c : f;
  if (!square || sgn(first) <= 0) return std::nullopt;
  Linear l = sgn(a) != 0   ? Linear{1, b / (2 * a), d / (2 * a)}
             : sgn(c) != 0 ? Linear{0, 1, e / (2 * c)}
                           : Linear{0, 0, 1};
  // first = num den / den^2.
  Rational root(1, first.get_den());
  const Integer n = without_squares(first.get_num() * first.get_den(), root);
  return ScaledSquare{n, {l.x * root, l.y * root, l.one * root}};
}

}  // namespace

double to_double(const QuadraticNumber& value, const Integer& n, int sign) {
  const mpf_class root = sqrt(mpf_class(n, precision));
  const mpf_class sum = mpf_class(value.rational, precision) + sign * mpf_class(value.multiple, precision) * root;
  return sum.get_d();
}

std::optional<CirclePairForm> recognise_circle_pair(const Polynomial& quartic) {
  const Rational scale = coefficient(quartic, {4, 0});
  const auto of = [&](int i, int j) { return Rational(coefficient(quartic, {i, j}) / scale); };
  if (sgn(scale) == 0 || of(3, 1) != 0 || of(2, 2) != 2 || of(1, 3) != 0 || of(0, 4) != 1) return std::nullopt;
  const Rational ux = of(3, 0) / 2, uy = of(2, 1) / 2;
  if (of(1, 2) != 2 * ux || of(0, 3) != 2 * uy) return std::nullopt;

  // n l^2 = (S + u)^2 - quartic / c has the quadratic part [[a + t, b/2], [b/2, c + t]], t twice the constant of u:
  // its determinant vanishes.
  const Rational a = ux * ux - of(2, 0), b = 2 * ux * uy - of(1, 1), c = uy * uy - of(0, 2);
  const std::optional<Rational> spread = square_root((a - c) * (a - c) + b * b);
  if (!spread) return std::nullopt;
  for (const int side : {1, -1}) {
    const Rational t = (side * *spread - a - c) / 2, u1 = t / 2;
    const auto square = scaled_square(a + t, b, c + t, t * ux - of(1, 0), t * uy - of(0, 1), u1 * u1 - of(0, 0));
    if (!square || mpz_perfect_square_p(square->n.get_mpz_t()) != 0) continue;
    const auto& [n, l] = *square;
    CirclePairForm form;
    form.n = n;
    form.centre = {QuadraticNumber{-ux / 2, l.x / 2}, QuadraticNumber{-uy / 2, l.y / 2}};
    form.radius_squared = {(ux * ux + uy * uy + n * (l.x * l.x + l.y * l.y)) / 4 - u1,
                           l.one - (ux * l.x + uy * l.y) / 2};
    if (to_double(form.radius_squared, n, 1) > 0 && to_double(form.radius_squared, n, -1) > 0) return form;
  }
  return std::nullopt;
}

}  // namespace clearloci::inline core
