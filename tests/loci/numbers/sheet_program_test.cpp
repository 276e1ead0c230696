// The compiled program against the polynomials it was compiled from.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "core/errors.hpp"
#include "loci/numbers/sheet_program.hpp"
#include "loci/sheet/sheet_cell.hpp"
#include "loci/sheet/smooth_cell.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using testing::FiveBar;
using testing::Ring;

TEST(Interval, HasNoEndBeyondDoubles) {
  core::Rational huge = 1;
  mpq_mul_2exp(huge.get_mpq_t(), huge.get_mpq_t(), 1100);
  EXPECT_THROW(constant_as(huge, static_cast<Interval*>(nullptr)), core::LimitReached);
  EXPECT_THROW(constant_as(-huge, static_cast<Interval*>(nullptr)), core::LimitReached);
  EXPECT_EQ(constant_as(1 / huge, static_cast<Interval*>(nullptr)).sign(), 0);
}

TEST(Interval, EnclosesRoundedResults) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-3, 3);
  for (int i = 0; i < 2000; ++i) {
    const double a = number(random), b = number(random), c = number(random), d = number(random);
    const Interval p(std::min(a, b), std::max(a, b)), q(std::min(c, d), std::max(c, d));
    const core::Rational exact_a(a), exact_c(c);
    const auto holds = [](const Interval& i_, const core::Rational& value) {
      return core::Rational(i_.lower()) <= value && value <= core::Rational(i_.upper());
    };
    EXPECT_TRUE(holds(p + q, exact_a + exact_c));
    EXPECT_TRUE(holds(p - q, exact_a - exact_c));
    EXPECT_TRUE(holds(p * q, exact_a * exact_c));
    EXPECT_TRUE(holds(squared(p), exact_a * exact_a));
    if (!q.contains_zero()) {
      EXPECT_TRUE(holds(p * inverse(q), exact_a / exact_c));
    }
  }
  EXPECT_EQ((Interval(1, 2) - Interval(0, 3)).sign(), 0);
  EXPECT_EQ((Interval(-1, 2) * Interval(-3, 4)).contains(-6), true);
  EXPECT_LE((Interval(-1, 2) * Interval(-3, 4)).lower(), -6);
  EXPECT_GE((Interval(-1, 2) * Interval(-3, 4)).upper(), 8);
  EXPECT_LT((Interval(-1, 2) * Interval(-3, 4)).upper(), 8.000001);
}

TEST(Interval, EnclosesTheAnglesOfWays) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> number(-2, 2), part(0, 1);
  int cut = 0;
  for (int i = 0; i < 5000; ++i) {
    const double x0 = number(random), y0 = number(random), wide = std::pow(part(random), 4), high = part(random);
    const Interval x(x0, x0 + wide), y(y0, y0 + high);
    const Interval angle = angle_of(y, x);
    const MultiInterval precise = angle_of(MultiInterval(core::Rational(y.lower()), core::Rational(y.upper())),
                                           MultiInterval(core::Rational(x.lower()), core::Rational(x.upper())));
    for (int k = 0; k < 4; ++k) {
      const double a = x.lower() + part(random) * x.width(), b = y.lower() + part(random) * y.width();
      EXPECT_TRUE(angle.contains(std::atan2(b, a))) << a << ", " << b;
    }
    EXPECT_LE(precise.lower(), angle.lower() + 1e-14) << "at least as wide: its mean-value form is for narrow boxes";
    EXPECT_GE(precise.upper(), angle.upper() - 1e-14);
    if (crosses_cut(y, x)) ++cut;
  }
  EXPECT_GT(cut, 100);
  EXPECT_EQ(angle_slope(Interval(-1e-3, 1e-3), Interval(-1, -0.5)).sign(), 0) << "nothing is known where it is cut";
}

TEST(MultiInterval, KnowsAnglesToManyDigits) {
  const auto number = [](const char* digits) { return MultiInterval(core::Rational(digits)); };
  const auto error = [&](const MultiInterval& a, const char* digits) {  // 60 digits of each
    core::Rational expected(core::Integer(digits), core::Integer(1));
    core::Integer scale;
    mpz_ui_pow_ui(scale.get_mpz_t(), 10, 59);
    expected /= scale;
    return std::max(core::to_double(abs(a.upper_end() - expected)), core::to_double(abs(a.lower_end() - expected)));
  };
  // pi/4, 3 pi/4, atan2(-3, 1/2), atan2(1/1000, -7), from series in decimals of 90 digits.
  EXPECT_LT(error(angle_of(number("1"), number("1")), "78539816339744830961566084581987572104929234984377645524374"),
            1e-58);
  EXPECT_LT(error(angle_of(number("2"), number("-2")), "235619449019234492884698253745962716314787704953132936573121"),
            1e-58);
  EXPECT_LT(
      error(angle_of(number("-3"), number("1/2")), "-140564764938026978095219340199580798810019803922252509146944"),
      1e-58);
  EXPECT_LT(
      error(angle_of(number("1/1000"), number("-7")), "314144979644790791289194863324968109459165096523636228207825"),
      1e-58);
}

TEST(SheetProgram, DifferentiatesAngles) {
  // angle of (x - y^2, x y + 2) and its slopes, by differences.
  core::StraightLineBuilder builder;
  const int x = builder.variable(0), y = builder.variable(1);
  const int cosine = builder.subtract(x, builder.power(y, 2));
  const int sine = builder.add(builder.multiply(x, y), builder.constant(2));
  core::RootTower plane;
  plane.coordinates = {"x", "y"};
  const SheetProgram program(
      plane, std::vector<SheetFunction>{{core::variable_polynomial(2, 0), builder.line(builder.angle(sine, cosine))}});
  const auto at = [&](double a, double b) { return std::atan2(a * b + 2, a - b * b); };
  auto numbers = program.registers<double>();
  auto intervals = program.registers<Interval>();
  auto jets = program.registers<Jet>();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(-1.2, 1.2);
  for (int i = 0; i < 100; ++i) {
    const double a = number(random), b = number(random), h = 1e-6, r = 0.01;
    numbers.set(0, a);
    numbers.set(1, b);
    numbers.run_values();
    numbers.run_gradients();
    EXPECT_DOUBLE_EQ(numbers.value(0), at(a, b));
    EXPECT_NEAR(numbers.partial(0, 0), (at(a + h, b) - at(a - h, b)) / (2 * h), 1e-7);
    EXPECT_NEAR(numbers.partial(0, 1), (at(a, b + h) - at(a, b - h)) / (2 * h), 1e-7);
    intervals.set(0, Interval(a - r, a + r));
    intervals.set(1, Interval(b - r, b + r));
    intervals.run_values();
    intervals.run_gradients();
    EXPECT_TRUE(intervals.partial(0, 0).contains(numbers.partial(0, 0)));
    EXPECT_TRUE(intervals.partial(0, 1).contains(numbers.partial(0, 1)));
    jets.set(0, Jet(Interval(a - r, a + r), 0));
    jets.set(1, Jet(Interval(b - r, b + r), 1));
    jets.run_values();
    for (const double p : {a - r, a, a + r})
      for (const double q : {b - r, b, b + r}) {
        EXPECT_TRUE(intervals.value(0).contains(at(p, q)));
        EXPECT_TRUE(jets.value(0).value.contains(at(p, q)));
      }
    EXPECT_LE(jets.value(0).value.width(), intervals.value(0).width());
  }
}

TEST(Interval, EnclosesRationalsThatDoublesMiss) {
  const Interval third = constant_as(core::Rational(1, 3), static_cast<Interval*>(nullptr));
  EXPECT_LT(core::Rational(third.lower()), core::Rational(1, 3));
  EXPECT_GT(core::Rational(third.upper()), core::Rational(1, 3));
  EXPECT_EQ(constant_as(core::Rational(1, 4), static_cast<Interval*>(nullptr)).width(), 0);
}

class CompiledFiveBar : public ::testing::Test {
 protected:
  FiveBar design{.a1 = {3, 5}, .b1 = {2, 5}, .a2 = {1, 2}, .b2 = {7, 10}, .weight = {981, 100}};
  testing::FiveBarSheet sheet = testing::five_bar_sheet(design);
  std::vector<core::Polynomial> functions{sheet.moment_A1, sheet.determinant};
  SheetProgram program{sheet.tower, functions};
};

TEST_F(CompiledFiveBar, AgreesWithPolynomialsInDoubleIntervalAndMultiInterval) {
  auto doubles = program.registers<double>();
  auto intervals = program.registers<Interval>();
  auto multiples = program.registers<MultiInterval>();
  std::mt19937_64 random(11);
  std::uniform_int_distribution<int> number(-64, 64);
  for (int i = 0; i < 50; ++i) {
    std::vector<double> at;
    std::vector<core::Rational> exact;
    for (int v = 0; v < 4; ++v) {
      at.push_back(number(random) / 64.0);
      exact.emplace_back(at.back());
      doubles.set(v, at.back());
      intervals.set(v, at.back());
      multiples.set(v, MultiInterval(at.back()));
    }
    for (int j = 0; j < 2; ++j) doubles.run_square(j), intervals.run_square(j), multiples.run_square(j);
    doubles.run_values(), intervals.run_values(), multiples.run_values();
    doubles.run_gradients(), intervals.run_gradients();
    for (int f = 0; f < 2; ++f) {
      const core::Rational truth = core::evaluate(functions[f], exact);
      const double size = 1 + std::abs(core::to_double(truth));
      EXPECT_NEAR(doubles.value(f), core::to_double(truth), 1e-9 * size);
      EXPECT_LE(core::Rational(intervals.value(f).lower()), truth);
      EXPECT_GE(core::Rational(intervals.value(f).upper()), truth);
      EXPECT_LT(intervals.value(f).width(), 1e-9 * size);
      EXPECT_LE(core::Rational(multiples.value(f).lower()), truth);
      EXPECT_GE(core::Rational(multiples.value(f).upper()), truth);
      EXPECT_LT(multiples.value(f).upper() - multiples.value(f).lower(), 1e-14 * size);
      for (int v = 0; v < 4; ++v) {
        const core::Rational slope = core::evaluate(core::derivative(functions[f], v), exact);
        EXPECT_LE(core::Rational(intervals.partial(f, v).lower()), slope);
        EXPECT_GE(core::Rational(intervals.partial(f, v).upper()), slope);
        EXPECT_NEAR(doubles.partial(f, v), core::to_double(slope), 1e-9 * (1 + std::abs(core::to_double(slope))));
      }
    }
  }
}

TEST_F(CompiledFiveBar, GivesInBatchesWhatItGivesOneByOne) {
  auto one = program.registers<double>();
  auto batch = program.registers<Batch>();
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Batch> at(4);
  for (Batch& v : at)
    for (double& lane : v.lanes) lane = number(random);
  for (int v = 0; v < 4; ++v) batch.set(v, at[static_cast<std::size_t>(v)]);
  for (int j = 0; j < 2; ++j) batch.run_square(j);
  batch.run_values(), batch.run_gradients();
  for (std::size_t lane = 0; lane < Batch::size; ++lane) {
    for (int v = 0; v < 4; ++v) one.set(v, at[static_cast<std::size_t>(v)][lane]);
    for (int j = 0; j < 2; ++j) one.run_square(j);
    one.run_values(), one.run_gradients();
    for (int f = 0; f < 2; ++f) {
      EXPECT_DOUBLE_EQ(batch.value(f)[lane], one.value(f));
      for (int v = 0; v < 4; ++v) EXPECT_DOUBLE_EQ(batch.partial(f, v)[lane], one.partial(f, v));
    }
  }
}

TEST_F(CompiledFiveBar, SharesSubexpressions) {
  const SheetProgram twice(sheet.tower, {sheet.moment_A1, sheet.moment_A1});
  const SheetProgram once(sheet.tower, {sheet.moment_A1});
  EXPECT_EQ(twice.instructions(), once.instructions());
}

// dN/dx on the sheet, through every s_j(x, y), against a difference quotient.
TEST_F(CompiledFiveBar, SlopesFollowTheChainRule) {
  const core::WorkingMode mode = {-1, 1};
  SheetCell cell(program, mode);
  const auto value = [&](double x, double y) {
    EXPECT_TRUE(cell.enter(x, y));
    return cell.value(0).middle();
  };
  const double x = 0.21, y = -0.63, h = 1e-6;
  const double along_x = (value(x + h, y) - value(x - h, y)) / (2 * h);
  const double along_y = (value(x, y + h) - value(x, y - h)) / (2 * h);
  ASSERT_TRUE(cell.enter(x, y));
  ASSERT_TRUE(cell.lifted().empty());
  cell.differentiate();
  EXPECT_NEAR(cell.slope(0, 0).middle(), along_x, 1e-6 * std::abs(along_x));
  EXPECT_NEAR(cell.slope(0, 1).middle(), along_y, 1e-6 * std::abs(along_y));
}

// Every point of a cell has its value inside the cell's enclosures, lifted or not.
TEST_F(CompiledFiveBar, CellsEncloseTheirPoints) {
  const core::WorkingMode mode = {1, 1};
  SheetCell cell(program, mode), point(program, mode);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  int lifted = 0, plain = 0;
  for (int i = 0; i < 400; ++i) {
    const double x = -0.5 + 1.5 * unit(random), y = -1 + 2 * unit(random), w = 0.1 * unit(random);
    const bool inside_workspace = cell.enter({x, x + w}, {y, y + w});
    if (inside_workspace) cell.differentiate();
    if (inside_workspace) ++(cell.lifted().empty() ? plain : lifted);
    for (int k = 0; k < 5; ++k) {
      if (!point.enter(x + w * unit(random), y + w * unit(random))) continue;
      ASSERT_TRUE(inside_workspace || !point.lifted().empty());
      EXPECT_FALSE(disjoint(point.value(0), cell.value(0)));
      EXPECT_FALSE(disjoint(point.value(0), cell.centred(0)));
      EXPECT_FALSE(disjoint(point.value(1), cell.centred(1)));
    }
  }
  EXPECT_GT(lifted, 10);
  EXPECT_GT(plain, 10);
}

// A root over a root: values and slopes enclose those of points, and shrink with the square of the cell.
TEST(SmoothCell, EnclosesToSecondOrder) {
  const Ring r{4};
  core::RootTower tower = testing::one_root(r(2) - r.x() * r.x() - r.y() * r.y());
  tower.roots.push_back({"s2", "B2", core::RootRole::working_mode, r(1) + r.s(1) * r.x() - r.y() * r.y()});
  const core::Polynomial f = r.s(1) * r.s(2) - r.x() * r.s(1) - r.y() * r.s(2);
  const SheetProgram program(tower, {f});
  EXPECT_TRUE(program.is_nested());
  const Ring below{3};
  const core::RootTower one = testing::one_root(below(2) - below.x() * below.x());
  EXPECT_FALSE(SheetProgram(one, {below.s(1) - below.y()}).is_nested());
  const core::WorkingMode mode = {1, -1};
  SmoothCell cell(program, mode), point(program, mode);
  SheetCell plain(program, mode);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  int inside = 0, outside = 0, narrower = 0;
  for (int i = 0; i < 400; ++i) {
    const double x = -1.6 + 3.2 * unit(random), y = -1.6 + 3.2 * unit(random), w = 0.02 * unit(random);
    const SmoothCell::Standing place = cell.enter({x, x + w}, {y, y + w});
    if (place == SmoothCell::Standing::unknown) continue;
    ++(place == SmoothCell::Standing::inside ? inside : outside);
    for (int k = 0; k < 5; ++k) {
      const double px = x + w * unit(random), py = y + w * unit(random), h = 1e-6;
      if (place == SmoothCell::Standing::outside) {
        EXPECT_EQ(point.enter(px, py), SmoothCell::Standing::outside);
        continue;
      }
      const auto value = [&](double at_x, double at_y) {
        EXPECT_EQ(point.enter(at_x, at_y), SmoothCell::Standing::inside);
        return point.value().middle();
      };
      const double along_x = (value(px + h, py) - value(px - h, py)) / (2 * h) * w / 2;
      EXPECT_LE(cell.slope(0).lower(), along_x + 1e-7 * w);
      EXPECT_GE(cell.slope(0).upper(), along_x - 1e-7 * w);
      value(px, py);
      EXPECT_FALSE(disjoint(point.value(), cell.value()));
    }
    if (place == SmoothCell::Standing::outside) continue;
    ASSERT_TRUE(plain.enter({x, x + w}, {y, y + w}));
    narrower += cell.value().width() < 0.75 * plain.value(0).width() ? 1 : 0;
  }
  EXPECT_GT(outside, 10);
  EXPECT_GT(inside, 100);
  EXPECT_GT(narrower, inside / 2);
}

TEST(SmoothCell, KnowsNothingWhereItDividesByZero) {
  const Ring r{2};
  core::StraightLineBuilder builder;
  const core::StraightLine line = builder.line(builder.inverse(builder.variable(0)));
  const SheetProgram program(testing::plane(), std::vector<SheetFunction>{{r.x(), line}});
  SmoothCell cell(program, {});
  EXPECT_EQ(cell.enter({-1, 1}, {0, 1}), SmoothCell::Standing::unknown);
  EXPECT_EQ(cell.enter({1, 2}, {0, 1}), SmoothCell::Standing::inside);
  EXPECT_TRUE(cell.value().contains(0.5) && cell.value().contains(1));
}

TEST(PointSign, DecidesWhatDoublesCannot) {
  const Ring r{2};
  // x^2 - y^2 - 2^-200 at x = 1 + 2^-52, y = 1 + 2^-52 is -2^-200.
  core::Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 2, 200);
  const SheetProgram program(testing::plane(),
                             {r.x() * r.x() - r.y() * r.y() - r(core::Rational(core::Integer(1), power))});
  PointSign sign(program, {});
  EXPECT_EQ(sign(1 + 0x1p-52, 1 + 0x1p-52), -1);
  EXPECT_EQ(sign(1 + 0x1p-52, 1), 1);
}

TEST(PointSign, KnowsTheWorkspace) {
  const Ring r{3};
  const core::RootTower tower = testing::one_root(r(1) - r.x() * r.x() - r.y() * r.y());
  const SheetProgram program(tower, {r.s(1) - r(core::Rational(1, 2))});
  PointSign right(program, {1}), wrong(program, {-1});
  EXPECT_EQ(right(0, 0), 1);
  EXPECT_EQ(right(0.9, 0), -1);
  EXPECT_EQ(wrong(0, 0), -1);
  EXPECT_EQ(right(1, 1e-9), std::nullopt);
  EXPECT_EQ(right(1, 0), 0);
}

TEST(IntervalDeterminant, IsTheSumOverPermutations) {
  for (std::size_t n = 1; n <= 6; ++n) {
    std::vector<std::vector<Interval>> matrix(n);
    std::vector<std::vector<long>> entries(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        entries[i].push_back(static_cast<long>((7 * i * i + 5 * k + 3 * i * k * k) % 11) - 5);
        matrix[i].emplace_back(static_cast<double>(entries[i].back()));
      }
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    long expected = 0;
    do {
      long product = 1;
      for (std::size_t i = 0; i < n; ++i) {
        product *= entries[i][order[i]];
        for (std::size_t k = 0; k < i; ++k)
          if (order[k] > order[i]) product = -product;
      }
      expected += product;
    } while (std::next_permutation(order.begin(), order.end()));
    const Interval found = determinant(matrix);
    EXPECT_LE(found.lower(), static_cast<double>(expected)) << n;
    EXPECT_GE(found.upper(), static_cast<double>(expected)) << n;
    EXPECT_LE(found.width(), 1e-6) << n;
  }
}

// Programs of one shape share their instructions, and have numbers of their own; where numbers become equal, 0 or 1
// they are of another shape.
TEST(SheetProgram, SharesCodeButNoNumbers) {
  const auto value = [](int a, int b, int c) {
    const core::Polynomial x = core::variable_polynomial(2, 0), y = core::variable_polynomial(2, 1);
    const auto number = [](int n) { return core::constant_polynomial(2, n); };
    core::RootTower plane;
    plane.coordinates = {"x", "y"};
    const SheetProgram program(plane, std::vector<SheetFunction>{{number(a) * x * x + number(b) * x * y + number(c)}});
    auto at = program.registers<double>();
    at.set(0, 3.0);
    at.set(1, 5.0);
    at.run_values();
    at.run_gradients();
    return std::array{at.value(0), at.partial(0, 0), at.partial(0, 1)};
  };
  for (const std::array<int, 3>& n : {std::array{7, 11, 13}, {13, 7, 11}, {7, 7, 7}, {1, 7, 2}, {2, 2, 1}, {7, 11, 13}})
    EXPECT_EQ(value(n[0], n[1], n[2]),
              (std::array{9.0 * n[0] + 15.0 * n[1] + n[2], 6.0 * n[0] + 5.0 * n[1], 3.0 * n[1]}));
}

/// Of every sign: products and squares are the least and the greatest of those of their ends.
TEST(MultiInterval, MultipliesByTheSignsOfItsEnds) {
  const std::vector<core::Rational> ends = {-3, core::Rational(-1, 4), 0, core::Rational(1, 2), 2};
  std::vector<MultiInterval> all;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t k = i; k < ends.size(); ++k) all.emplace_back(ends[i], ends[k]);
  for (const MultiInterval& a : all) {
    for (const MultiInterval& b : all) {
      const std::array<core::Rational, 4> products = {a.lower_end() * b.lower_end(), a.lower_end() * b.upper_end(),
                                                      a.upper_end() * b.lower_end(), a.upper_end() * b.upper_end()};
      EXPECT_EQ((a * b).lower_end(), *std::min_element(products.begin(), products.end()));
      EXPECT_EQ((a * b).upper_end(), *std::max_element(products.begin(), products.end()));
    }
    const core::Rational lower = a.lower_end() * a.lower_end(), upper = a.upper_end() * a.upper_end();
    EXPECT_EQ(squared(a).lower_end(), a.sign() == 0 ? core::Rational(0) : std::min(lower, upper));
    EXPECT_EQ(squared(a).upper_end(), std::max(lower, upper));
  }
}

}  // namespace
}  // namespace clearloci::loci::sheet
