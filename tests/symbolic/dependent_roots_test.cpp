// Roots that depend on earlier ones (method.md section 10), and the modes that are singular in every pose for it.
#include "symbolic/dependent_roots.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mechanism/read.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/geometry.hpp"
#include "symbolic/locus_problem.hpp"
#include "symbolic/singular_modes.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::symbolic {
namespace {

mechanism::Mechanism corpus(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/tests/corpus/modes/" + name + ".yaml");
}

/// x, y and the roots s of 1 - x^2 and t of 4 + y s.
class SquareClasses : public testing::Test {
 protected:
  SquareClasses() {
    roots.push_back({0, 2, core::RootRole::working_mode, one - x * x});
    roots.push_back({0, 3, core::RootRole::working_mode, one.scaled(4) + y * s});
  }
  SquareTest of(const Poly& p) const { return square_class(p, 2, roots); }
  static bool is_root(const SquareTest& test, const Poly& root) {
    return test.found && (test.found->root == root || test.found->root == -root);
  }

  Ring ring{{"x", "y", "s", "t"}};
  Poly one{ring, 1}, x = Poly::variable(ring, 0), y = Poly::variable(ring, 1), s = Poly::variable(ring, 2),
                     t = Poly::variable(ring, 3);
  std::vector<TowerRoot> roots;
};

TEST_F(SquareClasses, FindsTheElement) {
  const Poly s2 = one - x * x;
  EXPECT_TRUE(is_root(of((x + y) * (x + y)), x + y));
  EXPECT_TRUE(is_root(of(s2.scaled(9)), s.scaled(3)));       // another root's square
  EXPECT_EQ(of(s2 * (x + y) * (x + y)).found->constant, 1);  // times a square
  const SquareTest twice = of((y * y).scaled(8));            // a number times a square
  EXPECT_EQ(twice.found->constant, 2);
  EXPECT_TRUE(is_root(twice, y.scaled(2)));
  const SquareTest nested = of(x * x + y * y * s2 + (x * y * s).scaled(2));  // (x + y s)^2
  EXPECT_TRUE(is_root(nested, x + y * s));
  EXPECT_TRUE(of(one.scaled(4) + y * s).found.has_value());  // t's own
}

TEST_F(SquareClasses, KnowsWhatIsNone) {
  const Poly s2 = one - x * x;
  for (const Poly& p : {x, s2 * x, one + x * x, s, x + s, one.scaled(4) - y * s, t})
    EXPECT_FALSE(of(p).found.has_value()) << core::to_string(p.plain(), ring.names());
}

TEST(SignOverBox, IsKnownWhereItIsKept) {
  const std::vector<core::Rational> lower = {-1, -1}, upper = {1, 1};
  const core::Polynomial x = core::variable_polynomial(2, 0);
  const auto number = [](const core::Rational& value) { return core::constant_polynomial(2, value); };
  EXPECT_EQ(sign_over_box(x + number(2), lower, upper), 1);
  EXPECT_EQ(sign_over_box(x - number(2), lower, upper), -1);
  EXPECT_EQ(sign_over_box(x, lower, upper), 0);
  EXPECT_EQ(sign_over_box(x * x - x + number(core::Rational(3, 10)), lower, upper), 1);
}

TEST(CoincidentLegs, AreSingularOnOneSideOfEachOther) {
  const mechanism::Mechanism m = corpus("coincident_legs");
  EXPECT_TRUE(why_singular(m, {1, 1}).has_value());
  EXPECT_TRUE(why_singular(m, {-1, -1}).has_value());
  EXPECT_FALSE(why_singular(m, {1, -1}).has_value());
  EXPECT_FALSE(why_singular(m, {-1, 1}).has_value());
}

TEST(CoincidentLegs, ModesThatAreSingularEverywhereAreLeftOut) {
  const mechanism::Mechanism m = corpus("coincident_legs");
  EXPECT_THROW(locus_problems(m, {}), core::InputError);
  Selection all;
  all.working_modes = {{-1, -1}, {-1, 1}, {1, -1}, {1, 1}};
  const std::vector<DerivedProblem> problems = locus_problems(m, all);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems.front().problem.modes, (std::vector<core::WorkingMode>{{-1, 1}, {1, -1}}));
  EXPECT_EQ(
      std::count_if(problems.front().notes.begin(), problems.front().notes.end(),
                    [](const std::string& note) { return note.find("singular in every pose") != std::string::npos; }),
      2);
}

TEST(Rhombus, IsLeftOutOnTheSideOfItsFoldWhereItIsSingular) {
  for (const char* name : {"rhombus_of_one_side", "rhombus_crank"}) {
    const mechanism::Mechanism m = corpus(name);
    EXPECT_FALSE(why_singular(m, mechanism::working_mode(m)).has_value()) << name;
    std::size_t modes = 0, notes = 0;
    for (const DerivedProblem& each : locus_problems(m, {})) {
      modes += each.problem.modes.size();
      for (const std::string& note : each.notes) notes += note.find("singular in every pose") != std::string::npos;
    }
    EXPECT_GE(modes, 1u) << name;
    EXPECT_GE(notes, 1u) << name;
  }
}

TEST(Parallelogram, IsCutWhereItIsFlat) {
  const mechanism::Mechanism m = corpus("parallelogram");
  const Geometry geometry(m, false);
  ASSERT_EQ(geometry.folds().size(), 1u);  // tan(theta/2) = 0
  EXPECT_EQ(geometry.folds().front().where, Poly::variable(geometry.ring(), 0));
  // On either side of it the point is rational in the coordinate.
  for (const int half : {1, -1}) {
    const Geometry side(m, false, {}, {{}, {half}});
    EXPECT_EQ(side.roots().front().square, Poly(side.ring(), 1));
    EXPECT_FALSE(side.tower(side.constructed().front().point).x.depends_on(side.roots().front().variable));
    // By the other three it is written in the cosine and sine of the angle, which are put in after it.
    ASSERT_EQ(side.closings().size(), 1u);
    Poly over = Poly::variable(side.ring(), side.constructed().front().x);
    for (const Substitution& pair : side.substitutions())
      over = side.substituted(over, pair, Geometry::degree_in(over, pair));
    for (int variable = 1; variable < side.ring().size(); ++variable) EXPECT_FALSE(over.depends_on(variable));
  }
}

TEST(Parallelogram, OnALegIsCutWhereThatLegLiesOnTheBase) {
  const mechanism::Mechanism m = corpus("five_bar_parallelogram");
  const Geometry geometry(m, false);
  ASSERT_EQ(geometry.folds().size(), 1u);
  EXPECT_TRUE(geometry.folds().front().where.depends_on(geometry.roots().front().variable));
  EXPECT_EQ(locus_problems(m, {}).size(), 2u);
  // On one side it is a parallelogram, C beside B as D is beside A; on the other one it is crossed.
  const auto point = [&](const char* name) {
    return static_cast<mechanism::PointIndex>(
        std::find_if(m.points.begin(), m.points.end(), [&](const auto& p) { return p.name == name; }) -
        m.points.begin());
  };
  int beside = 0;
  for (const int half : {1, -1}) {
    const Geometry side(m, false, {}, {{}, {half}});
    const auto &b = side.natural(point("B")), &c = side.natural(point("C"));
    if ((c[0] - b[0]).expand() == GiNaC::numeric(-3, 10) && (c[1] - b[1]).expand().is_zero()) ++beside;
  }
  EXPECT_EQ(beside, 1);
}

// Equal links whose ends meet all along a curve: the root is f times another one, and f is taken out of it, of the
// place and of what is divided by.
TEST(EqualLinks, AreCutWhereTheirEndsMeet) {
  for (const char* name : {"five_bar_on_one_axis", "two_slides_on_a_rail"}) {
    SCOPED_TRACE(name);
    const mechanism::Mechanism m = corpus(name);
    EXPECT_TRUE(Geometry(m, false, {}, {.all_sheets = true}).folds().empty());
    EXPECT_TRUE(Geometry(m, true).folds().empty());
    for (const int half : {1, -1}) {
      const Geometry side(m, false, {}, {{}, {half}});
      ASSERT_EQ(side.folds().size(), 1u);
      const Poly& where = side.folds().front().where;
      const Poly difference = Poly::variable(side.ring(), 0) - Poly::variable(side.ring(), 1);
      EXPECT_TRUE(where == difference.scaled(half) || where == difference.scaled(-half));
      const TowerRoot& root = side.roots().front();
      EXPECT_TRUE(root.is_cut);
      Poly rest(side.ring());
      EXPECT_FALSE(root.square.divides(where, rest));
      EXPECT_TRUE(root.scale_divisor.divides(where, rest));
      EXPECT_FALSE(side.tower(root.point).w.divides(where, rest));
      for (const Poly& denominator : side.denominators()) EXPECT_FALSE(denominator.divides(where, rest));
      // Still as far from either end as the dyad has it.
      const auto& dyad = std::get<mechanism::DyadPoint>(m.points[static_cast<std::size_t>(root.point)].form);
      const Elimination elimination(side);
      for (const auto& [end, length] : {std::pair(dyad.from, dyad.from_length), std::pair(dyad.to, dyad.to_length)}) {
        Poly squared(side.ring());
        for (std::size_t i = 0; i < 2; ++i) {
          const Poly way = side.poly((side.natural(root.point)[i] - side.natural(end)[i]).expand());
          squared += way * way;
        }
        EXPECT_EQ(elimination.constant_over_tower(squared), side.squared_length(length).constant());
      }
    }
  }
}

// Over the tower the place of a closing point, put in by the formula of a dyad, has thousands of terms. By the other
// three of its loop it has few, whether that is a parallelogram or crossed, and it is put in before these.
TEST(Parallelogram, IsClosedByThePlacesOfThreePoints) {
  const mechanism::Mechanism m = corpus("parallelogram_under_coupler");
  const auto index = [&m](const char* name) {
    const auto point = std::find_if(m.points.begin(), m.points.end(), [&](const auto& p) { return p.name == name; });
    return static_cast<mechanism::PointIndex>(point - m.points.begin());
  };
  int crossed = 0;
  for (const int half : {1, -1}) {
    const Geometry side(m, false, {}, {{}, {half}});
    const Elimination elimination(side);
    ASSERT_EQ(side.closings().size(), 1u);
    const auto& [point, closing] = *side.closings().begin();
    EXPECT_EQ(point, index("X"));
    EXPECT_EQ(closing.fourth, index("B2"));
    EXPECT_EQ(closing.part.has_value(), closing.along != 0);
    crossed += closing.part ? 1 : 0;
    const ConstructedPoint& own = side.constructed().back();
    ASSERT_EQ(own.point, point);
    EXPECT_EQ(side.substitutions().front().x, own.x);
    for (const Substitution& pair : side.substitutions()) {
      if (pair.x == own.x) {
        EXPECT_LT(pair.place.x.length(), 20u);
      }
    }
    // It is as far from either end as the dyad has it.
    const auto& dyad = std::get<mechanism::DyadPoint>(m.points[static_cast<std::size_t>(point)].form);
    for (const auto& [end, length] : {std::pair(dyad.from, dyad.from_length), std::pair(dyad.to, dyad.to_length)}) {
      Poly squared(side.ring());
      for (std::size_t i = 0; i < 2; ++i) {
        const Poly way = side.poly((side.natural(point)[i] - side.natural(end)[i]).expand());
        squared += way * way;
      }
      EXPECT_EQ(elimination.constant_over_tower(squared), side.squared_length(length).constant());
    }
    const TowerPoint& place = side.tower(point);
    Poly over = Poly::variable(side.ring(), own.x), below(side.ring(), 1);
    for (const Substitution& pair : side.substitutions()) {
      const int degree = Geometry::degree_in(over, pair);
      over = side.substituted(over, pair, degree);
      for (int i = 0; i < degree; ++i) below = side.reduce(below * pair.place.w);
    }
    EXPECT_TRUE(side.reduce(over * place.w - below * place.x).is_zero());
  }
  EXPECT_EQ(crossed, 1);
}

// The element of a fold is divided out before a natural polynomial is put over the tower: what comes of it is what
// comes of all of it put over the tower.
TEST(Parallelogram, ElementsAreDividedOutOfNaturalPolynomials) {
  const mechanism::Mechanism m = corpus("parallelogram_under_coupler");
  for (const int half : {1, -1}) {
    const Geometry side(m, false, {}, {{}, {half}});
    const Elimination elimination(side);
    ASSERT_EQ(side.folds().size(), 1u);
    ASSERT_TRUE(elimination.fold_element(0));
    core::Rational constant;
    const std::vector<PolyFactor> element = side.folds().front().where.factors(constant);
    const FactoredDeterminants found = factored_determinants(side);
    std::vector<FactoredPoly> products = found.numerators;
    products.push_back(found.determinant);
    int held = 0, others = 0;
    for (const FactoredPoly& product : products)
      for (const PolyFactor& factor : product.factors) {
        const Poly& whole = elimination.over_tower(factor.poly);
        if (whole.is_zero()) continue;
        const std::vector<SheetFactor> parts = elimination.natural_factors(factor.poly, false),
                                       all = elimination.sheet_factors(whole, false);
        ASSERT_EQ(parts.size(), all.size());
        for (std::size_t i = 0; i < parts.size(); ++i) {
          EXPECT_EQ(parts[i].sheet, all[i].sheet);
          EXPECT_EQ(parts[i].multiplicity, all[i].multiplicity);
          ++(parts[i].sheet == element.front().poly ? held : others);
        }
      }
    EXPECT_GT(held, 0);
    EXPECT_GT(others, 0);
  }
}

// Of a dyad on two others what is put in is shorter than its place, and the two steps make the place.
TEST(DyadsOnOthers, ArePutInByStepsOfFewTerms) {
  const mechanism::Mechanism m =
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/seven_bar_on_both_legs.yaml");
  const Geometry geometry(m, false);
  const ConstructedPoint& h = geometry.constructed().back();
  const TowerPoint& place = geometry.tower(h.point);
  Poly over = Poly::variable(geometry.ring(), h.x);
  Poly below(geometry.ring(), 1);
  for (const Substitution& pair : geometry.substitutions()) {
    EXPECT_LT(pair.place.x.length(), place.x.length() / 2);
    EXPECT_LT(pair.place.w.length(), place.x.length() / 2);
    const int degree = Geometry::degree_in(over, pair);
    over = geometry.substituted(over, pair, degree);
    for (int i = 0; i < degree; ++i) below = geometry.reduce(below * pair.place.w);
  }
  EXPECT_TRUE(geometry.reduce(over * place.w - below * place.x).is_zero());
}

// The places of points are written in the chart of an angle: its cosine and sine beside it would be a variable too
// many.
TEST(Angles, ArePutInBeforePoints) {
  const Geometry geometry(mechanism::read_mechanism(source_dir() + "/examples/klann_leg.yaml"), false);
  EXPECT_EQ(geometry.substitutions().front().place.w,
            Poly::variable(geometry.ring(), 0).pow(2) + Poly(geometry.ring(), 1));
}

// Most polynomials do not hold the point that folds: what one side has found is found on the other one, and it is what
// that side finds alone.
TEST(KnownEliminations, AreWhatEachSideFindsAlone) {
  const mechanism::Mechanism m = corpus("five_bar_parallelogram");
  KnownEliminations known;
  int common = 0, of_one_side = 0;
  for (const int half : {1, -1}) {
    const Geometry side(m, false, {}, {{}, {half}});
    const Elimination alone(side), shared(side, &known);
    for (const FactoredPoly& numerator : factored_determinants(side).numerators)
      for (const PolyFactor& factor : numerator.factors) {
        const Poly sheet = alone.over_tower(factor.poly);
        const bool is_known = known.find(KnownEliminations::Kind::factors, {sheet}, side.ring()).has_value();
        if (half < 0) ++(is_known ? common : of_one_side);
        EXPECT_EQ(shared.over_tower(factor.poly), sheet);
        const std::vector<SheetFactor> parts = shared.sheet_factors(sheet, false),
                                       own = alone.sheet_factors(sheet, false);
        ASSERT_EQ(parts.size(), own.size());
        for (std::size_t i = 0; i < parts.size(); ++i) {
          EXPECT_EQ(parts[i].sheet, own[i].sheet);
          EXPECT_EQ(parts[i].multiplicity, own[i].multiplicity);
        }
      }
  }
  EXPECT_GT(common, 0);
  EXPECT_GT(of_one_side, 0);
}

}  // namespace
}  // namespace clearloci::symbolic
