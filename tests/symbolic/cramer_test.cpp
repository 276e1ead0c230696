// Cramer determinants against GiNaC's own determinant() of the full matrix, an independent route.
#include "symbolic/cramer.hpp"

#include <ginac/ginac.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace clearloci::symbolic {
namespace {

using core::Rational;

/// One random sparse entry: mostly 0 and +-1, sometimes linear in x and y; in both worlds.
struct Entry {
  int constant = 0, x = 0, y = 0;
};

Entry random_entry() {
  const int kind = *rc::gen::inRange(0, 8);
  if (kind < 3) return {};
  if (kind < 6) return {*rc::gen::element(-1, 1), 0, 0};
  return {*rc::gen::inRange(-3, 4), *rc::gen::inRange(-2, 3), *rc::gen::inRange(-2, 3)};
}

class Worlds {
 public:
  explicit Worlds(std::size_t n) : n_(n), full_(static_cast<unsigned>(n), static_cast<unsigned>(n) + 1) {
    for (std::size_t i = 0; i < n; ++i) {
      auto& row = matrix_.emplace_back();
      for (std::size_t j = 0; j <= n; ++j) {
        const Entry e = random_entry();
        const Poly p =
            Poly(ring_, e.constant) + Poly::variable(ring_, 0).scaled(e.x) + Poly::variable(ring_, 1).scaled(e.y);
        if (j < n)
          row.push_back(p);
        else
          right_.push_back(p);
        full_(static_cast<unsigned>(i), static_cast<unsigned>(j)) = e.constant + e.x * x_ + e.y * y_;
      }
    }
  }

  CramerDeterminants ours() const { return cramer_determinants(ring_, matrix_, right_); }

  /// Determinant with column k replaced by the right-hand side; k = n: of the matrix itself.
  GiNaC::ex theirs(std::size_t k) const {
    const auto n = static_cast<unsigned>(n_);
    GiNaC::matrix m(n, n);
    for (unsigned i = 0; i < n; ++i) {
      for (unsigned j = 0; j < n; ++j) m(i, j) = full_(i, j == k ? n : j);
    }
    return m.determinant().expand();
  }

  /// The difference between the two worlds, which must be zero.
  bool same(const FactoredPoly& product, const GiNaC::ex& e) const {
    GiNaC::ex sum = 0;
    const Poly p = expanded(product, ring_);
    for (const core::Term& term : p.plain().terms) {
      sum += GiNaC::numeric(core::to_string(term.coefficient).c_str()) * GiNaC::pow(x_, term.exponents[0]) *
             GiNaC::pow(y_, term.exponents[1]);
    }
    return (sum - e).expand().is_zero();
  }

 private:
  std::size_t n_;
  Ring ring_{{"x", "y"}};
  GiNaC::symbol x_{"x"}, y_{"y"};
  std::vector<std::vector<Poly>> matrix_;
  std::vector<Poly> right_;
  GiNaC::matrix full_;
};

RC_GTEST_PROP(Cramer, AgreesWithTheDeterminantOfEveryReplacedMatrix, ()) {
  const auto n = static_cast<std::size_t>(*rc::gen::inRange(1, 7));
  const Worlds worlds(n);
  const CramerDeterminants ours = worlds.ours();
  RC_ASSERT(worlds.same(ours.determinant, worlds.theirs(n)));
  if (ours.determinant.is_zero()) {
    RC_ASSERT(ours.numerators.empty());
    return;
  }
  for (std::size_t k = 0; k < n; ++k) RC_ASSERT(worlds.same(ours.numerators[k], worlds.theirs(k)));
}

TEST(Cramer, AMatrixNeedsNoConstantEntries) {
  const Ring ring({"x", "y"});
  const Poly x = Poly::variable(ring, 0), y = Poly::variable(ring, 1);
  const CramerDeterminants d = cramer_determinants(ring, {{x, y}, {y, x}}, {x, y});
  EXPECT_TRUE(expanded(d.determinant, ring) == x * x - y * y);
  EXPECT_TRUE(expanded(d.numerators[0], ring) == x * x - y * y);
  EXPECT_TRUE(d.numerators[1].is_zero());
}

}  // namespace
}  // namespace clearloci::symbolic
