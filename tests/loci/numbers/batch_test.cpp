// Doubles side by side: each lane is what it would be alone, to the bit.
#include "loci/numbers/batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "loci/numbers/jet.hpp"
#include "loci/numbers/sheet_program.hpp"

namespace clearloci::loci::sheet {
namespace {

using batch::Instruction;
using Operation = SheetCode::Operation;

double alone(Operation operation, double a, double b) {
  switch (operation) {
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::square:
      return squared(a);
    case Operation::inverse:
      return inverse(a);
    case Operation::angle:
      return angle_of(a, b);
    case Operation::angle_slope:
      return angle_slope(a, b);
  }
  return 0;
}

struct BatchWay {
  const char* name;
  bool (*is_had)();
  void (*run)(const Instruction*, const Instruction*, const Batch*, Batch*);
};

class Batches : public testing::TestWithParam<BatchWay> {};

TEST_P(Batches, HaveTheirOwnNumbers) {
  if (!GetParam().is_had()) GTEST_SKIP() << "this processor does not have it";
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(-2, 2), exponent(-40, 40);
  // Products of sums: what a processor would fuse, were it let.
  const std::vector<Instruction> code = {{Operation::add, 0, 1},         {Operation::subtract, 0, 1},
                                         {Operation::multiply, 0, 1},    {Operation::square, 0, 0},
                                         {Operation::inverse, 0, 0},     {Operation::angle, 0, 1},
                                         {Operation::angle_slope, 0, 1}, {Operation::multiply, 2, 3},
                                         {Operation::add, 9, 4},         {Operation::subtract, 4, 9}};
  for (int i = 0; i < 2000; ++i) {
    std::vector<Batch> values(2 + code.size());
    for (std::size_t v = 0; v < 2; ++v)
      for (double& lane : values[v].lanes) lane = std::exp2(exponent(random)) * number(random);
    if (i % 10 == 0) values[0][3] = 0;
    GetParam().run(code.data(), code.data() + code.size(), values.data(), values.data() + 2);
    for (std::size_t l = 0; l < Batch::size; ++l)
      for (std::size_t k = 0; k < code.size(); ++k) {
        const double expected = alone(code[k].operation, values[static_cast<std::size_t>(code[k].first)][l],
                                      values[static_cast<std::size_t>(code[k].second)][l]);
        const double value = values[2 + k][l];
        EXPECT_TRUE(value == expected || (std::isnan(value) && std::isnan(expected))) << "step " << k << ", lane " << l;
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, Batches,
                         testing::Values(BatchWay{"lanes", [] { return true; }, batch::run_by_lanes},
                                         BatchWay{"avx2", interval_batch::has_avx2, batch::run_by_avx2},
                                         BatchWay{"avx512", interval_batch::has_avx512, batch::run_by_avx512},
                                         BatchWay{"chosen", [] { return true; }, batch::run}),
                         [](const testing::TestParamInfo<BatchWay>& way) { return way.param.name; });

}  // namespace
}  // namespace clearloci::loci::sheet
