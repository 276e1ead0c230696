// Points on an implicit curve next to a double point of it, where the gradient is small beside the terms.
#include "loci/plane_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

namespace clearloci::loci {
namespace {

using core::Polynomial;
using core::Rational;

TEST(PlaneCurve, ProjectsToRoundingNextToANode) {
  // y^2 = (x - 1/2)^2 (x + 1), multiplied out: around its node terms of size 1 cancel.
  const Polynomial x = core::variable_polynomial(2, 0), y = core::variable_polynomial(2, 1);
  const auto number = [](const Rational& value) { return core::constant_polynomial(2, value); };
  const Polynomial off = x - number(Rational(1, 2));
  const Polynomial cubic = core::primitive_part(off * off * (x + number(1)) - y * y);
  const PlaneCurve curve(cubic);
  const Polynomial dx = core::derivative(cubic, 0), dy = core::derivative(cubic, 1);
  for (const double reach : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const core::Point2 at = curve.project({0.5 + reach, 1.2 * reach});
    const std::array<Rational, 2> place = {Rational(at[0]), Rational(at[1])};
    const auto value = [&](const Polynomial& p) { return core::to_double(core::evaluate(p, std::span(place))); };
    EXPECT_LE(std::abs(value(cubic)) / std::hypot(value(dx), value(dy)), 4e-16) << reach;
  }
}

}  // namespace
}  // namespace clearloci::loci
