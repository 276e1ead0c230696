// Intervals and cells side by side: each lane is what it would be alone, to the bit.
#include "loci/numbers/interval_batch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "loci/numbers/jet_batch.hpp"
#include "loci/sheet/sheet_cell.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using interval_batch::Instruction;
using Operation = SheetCode::Operation;

bool same(const Interval& a, const Interval& b) { return a.lower() == b.lower() && a.upper() == b.upper(); }

/// Of either sign, across zero, thin, tiny and large.
Interval drawn(std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(-2, 2), exponent(-40, 40);
  std::uniform_int_distribution<int> kind(0, 4);
  const double a = number(random), b = number(random), scale = std::exp2(exponent(random));
  switch (kind(random)) {
    case 0:
      return scale * a;
    case 1:
      return {0.0, scale * std::abs(a)};
    case 2:
      return {-scale * std::abs(a), 0.0};
    case 3:
      return {scale * a, scale * a + std::abs(b)};
    default:
      return {std::min(a, b), std::max(a, b)};
  }
}

using RunIntervals = void (*)(const Instruction*, const Instruction*, const IntervalBatch*, IntervalBatch*,
                              std::size_t);
template <std::size_t N>
using RunJets = void (*)(const Instruction*, const Instruction*, const JetBatchOver<N>*, JetBatchOver<N>*, std::size_t);

struct Way {
  const char* name;
  bool (*is_had)();
  RunIntervals run_intervals;
  RunJets<2> run_jets;
  RunJets<3> run_jets_of_three;
};

class Lanes : public ::testing::TestWithParam<Way> {
 protected:
  void SetUp() override {
    if (!GetParam().is_had()) GTEST_SKIP() << "this processor does not have it";
  }
  static void run(const std::vector<Instruction>& code, const IntervalBatch* values, IntervalBatch* results) {
    GetParam().run_intervals(code.data(), code.data() + code.size(), values, results, IntervalBatch::size);
  }
};

TEST_P(Lanes, AreWhatIntervalsAreAlone) {
  std::mt19937_64 random(3);
  const std::vector<Instruction> code = {
      {Operation::add, 0, 1},     {Operation::subtract, 0, 1}, {Operation::multiply, 0, 1},   {Operation::square, 0, 0},
      {Operation::inverse, 0, 0}, {Operation::angle, 0, 1},    {Operation::angle_slope, 0, 1}};
  for (int i = 0; i < 20000; ++i) {
    std::array<IntervalBatch, 9> values;
    for (std::size_t l = 0; l < IntervalBatch::size; ++l)
      for (const std::size_t v : {0, 1}) values[v].lanes[l] = drawn(random);
    run(code, values.data(), values.data() + 2);
    for (std::size_t l = 0; l < IntervalBatch::size; ++l) {
      const Interval &a = values[0].lanes[l], &b = values[1].lanes[l];
      const std::array<Interval, 7> alone = {
          a + b, a - b, a * b, squared(a), inverse(a), angle_of(a, b), angle_slope(a, b)};
      for (std::size_t k = 0; k < alone.size(); ++k)
        ASSERT_TRUE(same(values[2 + k].lanes[l], alone[k]))
            << k << ": [" << a.lower() << ", " << a.upper() << "], [" << b.lower() << ", " << b.upper() << "]";
    }
  }
}

/// Over several divisors that may be 0 bounds overflow: what is computed with them once took no part of a result, and
/// the product with [0, 1] was an interval without 0.
TEST_P(Lanes, WhatOverflowsExcludesNothing) {
  const std::vector<Instruction> code = {{Operation::inverse, 0, 0},  {Operation::square, 3, 3},
                                         {Operation::square, 4, 4},   {Operation::square, 5, 5},
                                         {Operation::subtract, 6, 6}, {Operation::multiply, 7, 0},
                                         {Operation::multiply, 7, 1}, {Operation::multiply, 7, 2},
                                         {Operation::add, 8, 7},      {Operation::subtract, 10, 8}};
  std::array<IntervalBatch, 13> values;
  for (std::size_t l = 0; l < IntervalBatch::size; ++l) {
    values[0].lanes[l] = {0.0, 1.0};
    values[1].lanes[l] = 0.0;
    values[2].lanes[l] = {-1.0, -0.5};
  }
  run(code, values.data(), values.data() + 3);
  constexpr std::size_t by_zero = 9, all_results = 13;
  for (std::size_t l = 0; l < IntervalBatch::size; ++l)
    for (std::size_t k = 7; k < all_results; ++k) {
      const Interval& lane = values[k].lanes[l];
      EXPECT_TRUE(lane.contains_zero()) << k;
      EXPECT_TRUE(k == by_zero || (lane.contains(-1e300) && lane.contains(1e300))) << k;
    }
}

/// Bounds that overflow, and what is computed with them: differences of infinities, their products with 0.
TEST_P(Lanes, AreWhatIntervalsAreAloneWhereBoundsOverflow) {
  std::mt19937_64 random(23);
  std::uniform_int_distribution<int> draw(0, 6);
  const std::array<Interval, 7> some = {Interval(0.0, 1e300),    Interval(-1e300, 1e300), Interval(1e200, 1e300),
                                        Interval(-1e300, -1.0),  Interval(0.0),           Interval(-0.5, 2.0),
                                        Interval(1e-300, 1e-200)};
  const std::vector<Instruction> code = {{Operation::multiply, 0, 1}, {Operation::square, 0, 0},
                                         {Operation::square, 2, 2},   {Operation::subtract, 2, 3},
                                         {Operation::add, 4, 5},      {Operation::multiply, 6, 1},
                                         {Operation::multiply, 5, 7}, {Operation::square, 6, 6},
                                         {Operation::subtract, 8, 9}, {Operation::add, 10, 0}};
  for (int i = 0; i < 400; ++i) {
    std::array<IntervalBatch, 12> values;
    std::array<std::array<Interval, 12>, IntervalBatch::size> alone;
    for (std::size_t l = 0; l < IntervalBatch::size; ++l)
      for (const std::size_t v : {0, 1})
        alone[l][v] = values[v].lanes[l] = some.at(static_cast<std::size_t>(draw(random)));
    run(code, values.data(), values.data() + 2);
    for (std::size_t k = 0; k < code.size(); ++k)
      for (std::size_t l = 0; l < IntervalBatch::size; ++l) {
        const Interval &a = alone[l][static_cast<std::size_t>(code[k].first)],
                       &b = alone[l][static_cast<std::size_t>(code[k].second)];
        Interval& result = alone[l][2 + k];
        result = code[k].operation == Operation::add        ? a + b
                 : code[k].operation == Operation::subtract ? a - b
                 : code[k].operation == Operation::multiply ? a * b
                                                            : squared(a);
        ASSERT_TRUE(same(values[2 + k].lanes[l], result)) << k;
      }
  }
}

/// A function's value, its value at the middle and its slopes, as jets carry them, or not bounded.
template <std::size_t N>
void expect_jets_as_alone(RunJets<N> run) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(-2, 2), width(0, 0.3);
  const std::vector<Instruction> code = {{Operation::add, 0, 1},      {Operation::subtract, 0, 1},
                                         {Operation::multiply, 0, 1}, {Operation::square, 0, 0},
                                         {Operation::inverse, 0, 0},  {Operation::multiply, 4, 6},
                                         {Operation::angle, 0, 1},    {Operation::subtract, 7, 4}};
  int unbounded = 0;
  for (int i = 0; i < 5000; ++i) {
    std::array<JetBatchOver<N>, 10> values;
    for (std::size_t l = 0; l < IntervalBatch::size; ++l)
      for (const int v : {0, 1}) {
        const double at = number(random);
        values[static_cast<std::size_t>(v)].set_lane(
            l, JetOver<N>(Interval(at, at + width(random)), v + static_cast<int>(N) - 2));
      }
    run(code.data(), code.data() + code.size(), values.data(), values.data() + 2, IntervalBatch::size);
    for (std::size_t l = 0; l < IntervalBatch::size; ++l) {
      const JetOver<N> a = values[0].lane(l), b = values[1].lane(l), product = a * b, reciprocal = inverse(a);
      const std::array<JetOver<N>, 8> alone = {a + b,          a - b,
                                               product,        squared(a),
                                               reciprocal,     product * reciprocal,
                                               angle_of(a, b), product * reciprocal - product};
      for (std::size_t k = 0; k < alone.size(); ++k) {
        const JetOver<N> lane = values[2 + k].lane(l);
        ASSERT_EQ(lane.bounded, alone[k].bounded) << k;
        unbounded += lane.bounded ? 0 : 1;
        ASSERT_TRUE(same(lane.value, alone[k].value) && same(lane.middle, alone[k].middle)) << k;
        for (std::size_t c = 0; c < N; ++c) ASSERT_TRUE(same(lane.slope[c], alone[k].slope[c])) << k;
      }
    }
  }
  EXPECT_GT(unbounded, 100);
}

TEST_P(Lanes, AreWhatJetsAreAlone) {
  expect_jets_as_alone<2>(GetParam().run_jets);
  expect_jets_as_alone<3>(GetParam().run_jets_of_three);
}

INSTANTIATE_TEST_SUITE_P(, Lanes,
                         ::testing::Values(Way{"OneByOne", [] { return true; }, interval_batch::run_by_lanes,
                                               interval_batch::run_by_lanes, interval_batch::run_by_lanes},
                                           Way{"ByAvx2", interval_batch::has_avx2, interval_batch::run_by_avx2,
                                               interval_batch::run_by_avx2, interval_batch::run_by_avx2},
                                           Way{"ByAvx512", interval_batch::has_avx512, interval_batch::run_by_avx512,
                                               interval_batch::run_by_avx512, interval_batch::run_by_avx512}),
                         [](const auto& candidate) { return std::string(candidate.param.name); });

/// Cells all over the workspace and its boundary, in batches of every size.
TEST(SheetCells, AreWhatCellsAreAlone) {
  const testing::FiveBar design{.a1 = {3, 5}, .b1 = {2, 5}, .a2 = {1, 2}, .b2 = {7, 10}, .weight = {981, 100}};
  const testing::FiveBarSheet sheet = testing::five_bar_sheet(design);
  const SheetProgram program(sheet.tower, {sheet.moment_A1, sheet.determinant});
  const core::WorkingMode mode = {1, -1};
  SheetCell alone(program, mode);
  SheetCells cells(program, mode);
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> unit(0, 1);
  int lifted = 0, outside = 0;
  for (int i = 0; i < 600; ++i) {
    std::array<std::array<Interval, 2>, SheetCells::size> ranges;
    std::array<SheetCells::Target, SheetCells::size> places;
    for (std::size_t lane = 0; lane < SheetCells::size; ++lane) {
      const double x = -0.5 + 1.5 * unit(random), y = -1 + 2 * unit(random), w = std::exp2(-12 * unit(random)) / 8;
      ranges[lane] = {Interval(x, x + w), Interval(y, y + w)};
      places[lane] = {ranges[lane]};
    }
    const std::size_t count = 1 + static_cast<std::size_t>(i) % SheetCells::size;
    cells.enter(places, count);
    cells.differentiate();
    for (std::size_t lane = 0; lane < count; ++lane) {
      ASSERT_EQ(cells.inside(lane), alone.enter(ranges[lane]));
      if (!cells.inside(lane)) {
        ++outside;
        continue;
      }
      alone.differentiate();
      SheetCell& cell = cells[lane];
      ASSERT_EQ(cell.lifted(), alone.lifted());
      lifted += cell.lifted().empty() ? 0 : 1;
      for (int j = 0; j < program.roots(); ++j) {
        EXPECT_TRUE(same(cell.square(j), alone.square(j)));
        EXPECT_TRUE(same(cell.root(j), alone.root(j)));
      }
      for (const int f : {0, 1}) {
        EXPECT_TRUE(same(cell.value(f), alone.value(f)));
        EXPECT_TRUE(same(cell.middle_value(f), alone.middle_value(f)));
        EXPECT_TRUE(same(cell.centred(f), alone.centred(f)));
        for (int c = 0; c < cell.dimension(); ++c) {
          EXPECT_TRUE(same(cell.slope(f, c), alone.slope(f, c)));
          EXPECT_TRUE(same(cell.tangent(f, c), alone.tangent(f, c)));
        }
      }
      EXPECT_EQ(cell.is_beyond_a_rim(), alone.is_beyond_a_rim());
    }
  }
  EXPECT_GT(lifted, 50);
  EXPECT_GT(outside, 50);
}

}  // namespace
}  // namespace clearloci::loci::sheet
