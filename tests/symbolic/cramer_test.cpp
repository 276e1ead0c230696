// Cramer determinants against GiNaC's own determinant() of the full matrix, an independent route.
#include "symbolic/cramer.hpp"

#include <ginac/ginac.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

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
  std::optional<CramerDeterminants> within(std::size_t most_terms) const {
    return cramer_determinants_within(most_terms, ring_, matrix_, right_);
  }

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

/// n rows of variables of their own.
template <std::size_t n>
struct Generic {
  Generic() {
    for (std::size_t i = 0; i < n * (n + 1); ++i)
      (i < n * n ? matrix[i / n] : right).push_back(Poly::variable(ring, static_cast<int>(i)));
  }
  static std::vector<std::string> names() {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < n * (n + 1); ++i) names.push_back("v" + std::to_string(i));
    return names;
  }

  Ring ring{names()};
  std::vector<std::vector<Poly>> matrix{n};
  std::vector<Poly> right;
};

/// That every form is of a determinant that is one factor, and has its value at some place.
void hold_forms(const CramerDeterminants& d, const Ring& ring) {
  std::vector<FactoredPoly> products = d.numerators;
  products.push_back(d.determinant);
  for (const DeterminantForm& form : d.forms) {
    EXPECT_TRUE(std::any_of(products.begin(), products.end(), [&](const FactoredPoly& product) {
      return std::any_of(product.factors.begin(), product.factors.end(),
                         [&](const PolyFactor& factor) { return factor.poly == form.value; });
    }));
    const auto at_numbers = [&](Poly p) {
      for (int v = 0; v < ring.size(); ++v) p = p.at(v, (v * v * v + 5 * v) % 23 - 11);
      return p.constant();
    };
    const auto n = static_cast<unsigned>(form.rows.size());
    GiNaC::matrix numbers(n, n);
    for (unsigned i = 0; i < n; ++i)
      for (unsigned j = 0; j < n; ++j)
        numbers(i, j) = GiNaC::numeric(core::to_string(at_numbers(form.rows[i].at(j))).c_str());
    const GiNaC::ex whole = numbers.determinant() * GiNaC::numeric(core::to_string(form.constant).c_str());
    EXPECT_TRUE((whole - GiNaC::numeric(core::to_string(at_numbers(form.value)).c_str())).is_zero());
    EXPECT_FALSE(whole.is_zero());
  }
}

/// Seven rows of variables of their own: |A| has 5040 terms, its form 49 entries.
TEST(Cramer, LongMinorsAreKnownAsDeterminants) {
  const auto& [ring, matrix, right] = Generic<7>();
  constexpr std::size_t n = 7;
  const CramerDeterminants d = cramer_determinants(ring, matrix, right);
  ASSERT_EQ(d.forms.size(), n + 1);
  hold_forms(d, ring);
}

/// Two rows that hold two unknowns, three that hold all five, entries of three variables each: the determinants of the
/// blocks are never multiplied with each other, and the form of what the second one gives has the rows of both.
TEST(Cramer, BlocksAreSolvedOneAfterTheOther) {
  std::vector<std::string> names;
  for (int i = 0; i < 3 * (2 * 3 + 3 * 6); ++i) names.push_back("v" + std::to_string(i));
  const Ring ring(names);
  int next = 0;
  const auto entry = [&] {
    Poly sum(ring);
    for (int k = 0; k < 3; ++k) sum += Poly::variable(ring, next++);
    return sum;
  };
  std::vector<std::vector<Poly>> matrix;
  std::vector<Poly> right;
  for (std::size_t i = 0; i < 5; ++i) {
    std::vector<Poly>& row = matrix.emplace_back();
    for (std::size_t j = 0; j < 5; ++j) row.push_back(i < 2 && j >= 2 ? Poly(ring) : entry());
    right.push_back(entry());
  }
  const std::optional<CramerDeterminants> d = cramer_determinants_within(2916, ring, matrix, right);
  ASSERT_TRUE(d) << "162 terms of each load times 18 of each minor";
  ASSERT_EQ(d->determinant.factors.size(), 2);
  EXPECT_EQ(d->determinant.factors[0].poly.length() + d->determinant.factors[1].poly.length(), 18 + 162);
  std::vector<std::size_t> sizes;
  for (const DeterminantForm& form : d->forms) sizes.push_back(form.rows.size());
  EXPECT_EQ(sizes, (std::vector<std::size_t>{3, 5, 5, 5})) << "|A| of the second block, and its three numerators";
  hold_forms(*d, ring);
}

/// The same matrices: nothing where products are long, else what comes without a limit.
RC_GTEST_PROP(Cramer, WithinALimitOfTermsIsTheSameOrNothing, ()) {
  const auto n = static_cast<std::size_t>(*rc::gen::inRange(1, 7));
  const Worlds worlds(n);
  const CramerDeterminants all = worlds.ours();
  const auto within = worlds.within(static_cast<std::size_t>(*rc::gen::inRange(1, 40)));
  RC_TAG(within ? "within" : "beyond");
  if (!within) return;
  const auto same = [](const FactoredPoly& a, const FactoredPoly& b) {
    if (a.constant != b.constant || a.factors.size() != b.factors.size()) return false;
    for (std::size_t i = 0; i < a.factors.size(); ++i)
      if (!(a.factors[i].poly == b.factors[i].poly) || a.factors[i].multiplicity != b.factors[i].multiplicity)
        return false;
    return true;
  };
  RC_ASSERT(same(within->determinant, all.determinant));
  RC_ASSERT(within->numerators.size() == all.numerators.size());
  for (std::size_t k = 0; k < all.numerators.size(); ++k) RC_ASSERT(same(within->numerators[k], all.numerators[k]));
}

TEST(Cramer, EndsWhereProductsGrowBeyondTheLimit) {
  const auto& [ring, matrix, right] = Generic<7>();
  EXPECT_FALSE(cramer_determinants_within(700, ring, matrix, right));  // minors of six rows have 720 terms
  EXPECT_TRUE(cramer_determinants_within(720, ring, matrix, right));
}

/// The force along a link that two balls hold is one unknown; what it bears is a product throughout.
TEST(Cramer, TwoForceMembersBecomeOneUnknown) {
  const Ring ring({"x", "y", "z", "p", "q", "r"});
  const auto v = [&](int i) { return Poly::variable(ring, i); };
  const Poly zero(ring), x = v(0), y = v(1), z = v(2);
  // (x, y, z) x f = 0 but for the row that follows from the other two, and p f1 + q f2 + r f3 = 1.
  const CramerDeterminants d =
      cramer_determinants(ring, {{y, -x, zero}, {zero, z, -y}, {v(3), v(4), v(5)}}, {zero, zero, Poly(ring, 1)});
  EXPECT_TRUE(expanded(d.determinant, ring) == y * (v(3) * x + v(4) * y + v(5) * z));
  EXPECT_TRUE(expanded(d.numerators[0], ring) == x * y);
  EXPECT_TRUE(expanded(d.numerators[1], ring) == y * y);
  EXPECT_TRUE(expanded(d.numerators[2], ring) == y * z);
}

}  // namespace
}  // namespace clearloci::symbolic
