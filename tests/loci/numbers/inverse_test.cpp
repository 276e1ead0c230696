#include "loci/numbers/inverse.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace clearloci::loci {
namespace {

TEST(Inverse, TimesItsMatrixIsOne) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> entry(-1, 1);
  for (std::size_t n = 1; n <= 12; ++n) {
    std::vector<double> a(n * n), y(n * n);
    for (double& candidate : a) candidate = entry(random);
    a[0] = 0;  // wants another row for its first pivot, from two rows on
    if (n == 1) a[0] = -3;
    std::vector<double> used = a;
    ASSERT_TRUE(invert(used, y, n)) << n;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        double sum = 0;
        for (std::size_t k = 0; k < n; ++k) sum += y[i * n + k] * a[k * n + j];
        EXPECT_NEAR(sum, i == j, 1e-11) << n;
      }
  }
}

TEST(Inverse, TellsTheSignOfTheDeterminant) {
  const std::vector<std::vector<double>> matrices = {{2, 1, 0, 3}, {0, 1, 1, 0}, {-2, 1, 0, 3}, {1, 5, -2, -1}};
  for (std::vector<double> a : matrices) {
    const double determinant = a[0] * a[3] - a[1] * a[2];
    std::vector<double> y(4);
    int sign = 0;
    ASSERT_TRUE(invert(a, y, 2, 0, &sign));
    EXPECT_EQ(sign, determinant < 0 ? -1 : 1) << determinant;
  }
}

TEST(Inverse, OfASingularMatrixIsNone) {
  std::vector<double> y(9), equal_rows = {1, 2, 3, 4, 5, 6, 1, 2, 3}, nothing(9, 0.0);
  EXPECT_FALSE(invert(equal_rows, y, 3));
  EXPECT_FALSE(invert(nothing, y, 3));
  std::vector<double> no_number = {1, std::nan(""), 0, 1};
  EXPECT_FALSE(invert(no_number, y, 2));
}

TEST(Inverse, RefusesPivotsThatAreLostInRounding) {
  const std::vector<double> nearly_singular = {1, 1, 1, 1 + 1e-13};
  std::vector<double> y(4), used = nearly_singular;
  EXPECT_TRUE(invert(used, y, 2));
  used = {1, 1e3, 1, 1e3 + 1e-10};  // what is left of the second row: 1e-10, of a row of nothing else
  EXPECT_TRUE(invert(used, y, 2, 1e-12));
  used = {1e-14, 1, 0, 1};
  EXPECT_TRUE(invert(used, y, 2));
  used = {1e-14, 1, 0, 1};
  EXPECT_FALSE(invert(used, y, 2, 1e-12));
}

}  // namespace
}  // namespace clearloci::loci
