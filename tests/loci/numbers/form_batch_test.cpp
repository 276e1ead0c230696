// Forms of second order: they hold the values of what they enclose, the rest shrinks with the cube of a cell, and what
// is not known excludes nothing.
#include "loci/numbers/form_batch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace clearloci::loci::sheet {
namespace {

using form_batch::Instruction;
using Operation = SheetCode::Operation;

const std::vector<Instruction> program_of_forms = {
    {Operation::add, 0, 1},     {Operation::subtract, 0, 1}, {Operation::multiply, 0, 1}, {Operation::square, 0, 0},
    {Operation::inverse, 3, 3}, {Operation::multiply, 4, 6}, {Operation::multiply, 7, 5}, {Operation::subtract, 8, 4}};

template <std::size_t N>
long double value_of(const Form<N>& form, const std::array<double, N>& noises) {
  long double sum = form.c;
  for (std::size_t i = 0; i < N; ++i) {
    sum += static_cast<long double>(form.a[i]) * noises[i];
    for (std::size_t j = i; j < N; ++j)
      sum += static_cast<long double>(form.b[Form<N>::place(i, j)]) * noises[i] * noises[j];
  }
  return sum;
}

template <std::size_t N>
void expect_values_inside() {
  std::mt19937_64 random(29);
  std::uniform_real_distribution<double> number(-2, 2), exponent(-30, 0), noise(-1, 1);
  int known = 0, unknown = 0;
  for (int i = 0; i < 2000; ++i) {
    std::array<FormBatch<N>, 10> values;
    std::array<Interval, FormBatch<N>::size> x, y;
    for (std::size_t l = 0; l < FormBatch<N>::size; ++l) {
      const double width = std::exp2(exponent(random)), at_x = number(random), at_y = number(random);
      x[l] = {at_x, at_x + width};
      y[l] = {at_y, at_y + width};
      values[0].set_lane(l, FormBatch<N>::coordinate(x[l], 0));
      values[1].set_lane(l, FormBatch<N>::coordinate(y[l], N - 1));
    }
    form_batch::run(program_of_forms.data(), program_of_forms.data() + program_of_forms.size(), values.data(),
                    values.data() + 2);
    FormBatch<N> root;
    form_batch::take_root(values[5], root);
    for (std::size_t l = 0; l < FormBatch<N>::size; ++l) {
      std::array<double, N> at{};
      at[0] = noise(random);
      at[N - 1] = noise(random);
      const long double p = value_of(values[0].lane(l), at), q = value_of(values[1].lane(l), at);
      const std::array<long double, 8> exact = {p + q,
                                                p - q,
                                                p * q,
                                                p * p,
                                                1 / (p - q),
                                                p * q / (p - q),
                                                p * q / (p - q) * p * p,
                                                p * q / (p - q) * p * p - p * q};
      for (std::size_t k = 0; k < exact.size(); ++k) {
        const Form<N> form = values[2 + k].lane(l);
        if (!std::isfinite(form.r)) {
          ++unknown;
          continue;
        }
        ++known;
        ASSERT_LE(std::abs(exact[k] - value_of(form, at)), form.r * (1 + 0x1p-50L)) << k;
      }
      if (const Form<N> form = root.lane(l); std::isfinite(form.r)) {
        ASSERT_LE(std::abs(std::abs(p) - value_of(form, at)), form.r);
      }
    }
  }
  EXPECT_GT(known, 10000);
  EXPECT_GT(unknown, 1000);
}

TEST(Forms, HoldValues) {
  expect_values_inside<2>();
  expect_values_inside<3>();
  expect_values_inside<4>();
}

/// Of a quotient and a root on cells that are halved.
TEST(Forms, HaveARestThatShrinksWithTheCube) {
  const auto rests = [](double width) {
    std::array<FormBatch<2>, 10> values;
    for (std::size_t l = 0; l < FormBatch<2>::size; ++l) {
      values[0].set_lane(l, FormBatch<2>::coordinate({1.5 - width, 1.5 + width}, 0));
      values[1].set_lane(l, FormBatch<2>::coordinate({0.5 - width, 0.5 + width}, 1));
    }
    form_batch::run(program_of_forms.data(), program_of_forms.data() + program_of_forms.size(), values.data(),
                    values.data() + 2);
    FormBatch<2> root;
    form_batch::take_root(values[2], root);
    return std::array{values[9].lane(3).r, root.lane(3).r};
  };
  for (const double width : {0x1p-4, 0x1p-6, 0x1p-8}) {
    const auto wide = rests(width), narrow = rests(width / 2);
    for (const std::size_t k : {0u, 1u}) EXPECT_LT(narrow[k], wide[k] / 6) << width;
  }
}

/// A divisor that may be 0, a root of what may be negative, bounds that overflow, and what is computed with them.
TEST(Forms, ThatAreNotKnownExcludeNothing) {
  const std::vector<Instruction> more = {{Operation::inverse, 0, 0},  {Operation::multiply, 2, 1},
                                         {Operation::subtract, 3, 3}, {Operation::inverse, 3, 3},
                                         {Operation::multiply, 2, 1}, {Operation::angle, 0, 1}};
  std::array<FormBatch<2>, 8> values;
  for (std::size_t l = 0; l < FormBatch<2>::size; ++l) {
    values[0].set_lane(l, l % 2 == 0 ? FormBatch<2>::coordinate({-0.5, 1}, 0) : FormBatch<2>::number({1e-320, 1e-319}));
    values[1].set_lane(l, l % 4 < 2 ? FormBatch<2>::number(0.0) : FormBatch<2>::coordinate({1e300, 1e308}, 1));
  }
  form_batch::run(more.data(), more.data() + more.size(), values.data(), values.data() + 2);
  FormBatch<2> root;
  form_batch::take_root(values[0], root);
  for (std::size_t l = 0; l < FormBatch<2>::size; ++l) {
    for (std::size_t k = 2; k < values.size(); ++k) EXPECT_FALSE(std::isfinite(values[k].lane(l).r)) << k << " " << l;
    if (l % 2 == 0) {
      EXPECT_FALSE(std::isfinite(root.lane(l).r));
    }
  }
}

}  // namespace
}  // namespace clearloci::loci::sheet
