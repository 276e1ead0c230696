#include "loci/sheet/remembered.hpp"

#include <gtest/gtest.h>

namespace clearloci::loci::sheet {
namespace {

using core::Polynomial;
using core::Rational;

/// value * x
Polynomial line(const Rational& value) { return {1, {{{1}, value}}}; }

TEST(Remembered, ComputesOnceWhatIsAskedAgain) {
  Remembered<Rational, int, Polynomial> known;
  int computed = 0;
  const auto ask = [&](int factor, const Polynomial& p) {
    return known(
        [&] {
          ++computed;
          return Rational(factor * p.terms.front().coefficient);
        },
        factor, p);
  };
  for (int round = 0; round < 3; ++round)
    for (int i = 1; i <= 20; ++i) EXPECT_EQ(ask(i, line(i)), i * i);
  EXPECT_EQ(computed, 20);
}

TEST(Remembered, TellsArgumentsApartThatHaveOneFingerprint) {
  const core::Integer far = core::Integer(1) << 64;
  const Polynomial one = line(1), other = line(Rational(far + 1));
  ASSERT_EQ(fingerprint(one), fingerprint(other));
  Remembered<Rational, Polynomial> known;
  for (int round = 0; round < 2; ++round)
    for (const Polynomial& p : {one, other})
      EXPECT_EQ(known([&] { return p.terms.front().coefficient; }, p), p.terms.front().coefficient);
}

TEST(Remembered, ForgetsAndComputesAgain) {
  Remembered<int, int> known;
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 1000; ++i) EXPECT_EQ(known([&] { return 3 * i; }, i), 3 * i);
}

TEST(Remembered, KeepsNothingOfWhatFails) {
  Remembered<int, int> known;
  EXPECT_THROW(known([]() -> int { throw 1; }, 5), int);
  EXPECT_EQ(known([] { return 2; }, 5), 2);
}

}  // namespace
}  // namespace clearloci::loci::sheet
