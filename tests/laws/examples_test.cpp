// What holds for every shipped example, and the paper's findings about its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/loci.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using core::LocusKind;

mechanism::Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
}

bool vanishes(const core::LocusCurve& curve, const std::string& joint, core::Quantity quantity) {
  return std::any_of(curve.vanishing.begin(), curve.vanishing.end(),
                     [&](const auto& v) { return v.joint == joint && v.quantity == quantity; });
}

class Examples : public testing::TestWithParam<std::string> {};

TEST_P(Examples, HoldAgainstTheWitness) {
  LociRequest request;
  request.all_working_modes = true;
  const Validation validation = validate_loci(example(GetParam()), request, {400, 400});
  EXPECT_EQ(validation.report.disputed, 0u);
  EXPECT_GT(validation.report.held, 1000u);
}

TEST_P(Examples, AreCertifiedAndTheSameEachTime) {
  const core::LocusMap a = trace_loci(example(GetParam())), b = trace_loci(example(GetParam()));
  EXPECT_TRUE(a.complete);
  ASSERT_EQ(a.curves.size(), b.curves.size());
  for (std::size_t i = 0; i < a.curves.size(); ++i) {
    EXPECT_TRUE(a.curves[i].certified) << a.curves[i].id;
    EXPECT_EQ(a.curves[i].id, b.curves[i].id);
    ASSERT_EQ(a.curves[i].arcs.size(), b.curves[i].arcs.size());
    for (std::size_t k = 0; k < a.curves[i].arcs.size(); ++k) {
      EXPECT_EQ(a.curves[i].arcs[k].points, b.curves[i].arcs[k].points);
    }
  }
  for (const core::IsolatedPoint& point : a.isolated_points) EXPECT_TRUE(point.certified);
}

INSTANTIATE_TEST_SUITE_P(All, Examples,
                         testing::Values("five_bar", "five_bar_generic", "five_bar_horizontal", "five_bar_inclined",
                                         "five_bar_isolated", "five_bar_weights", "prrrp", "rprpr", "three_rpr"),
                         [](const auto& test) { return test.param; });

TEST(PaperVerticalLoad, LegsAreUnloadedOnCirclesOfLinkLength) {
  // Figs. 12 and 13; L = d = 1/2: f_A1, f_B1, f_P on circles about (1/2, +-1/2), f_B2, f_A2 about (0, +-1/2).
  const core::LocusMap map = trace_loci(example("five_bar"));
  int leg1 = 0, leg2 = 0;
  for (const core::LocusCurve& curve : map.curves) {
    if (curve.kind != LocusKind::contact_loss) continue;
    const auto* circle = std::get_if<core::CircleForm>(&curve.closed_form);
    ASSERT_NE(circle, nullptr);
    ASSERT_TRUE(circle->radius.has_value());
    EXPECT_EQ(*circle->radius, core::Rational(1, 2));
    EXPECT_EQ(abs(circle->centre[1]), core::Rational(1, 2));
    const bool first = vanishes(curve, "A1", core::Quantity::f);
    (first ? leg1 : leg2) += 1;
    EXPECT_EQ(circle->centre[0], first ? core::Rational(1, 2) : core::Rational(0));
    for (const std::string joint : {"A1", "B1", "P"}) EXPECT_EQ(vanishes(curve, joint, core::Quantity::f), first);
    for (const std::string joint : {"B2", "A2"}) EXPECT_EQ(vanishes(curve, joint, core::Quantity::f), !first);
    EXPECT_EQ(vanishes(curve, "A1", core::Quantity::M), first);
    EXPECT_EQ(vanishes(curve, "A2", core::Quantity::M), !first);
  }
  EXPECT_EQ(leg1, 2);
  EXPECT_EQ(leg2, 2);
}

TEST(PaperVerticalLoad, CoupleVanishesAloneOnTheOuterBoundaryOnly) {
  const core::LocusMap map = trace_loci(example("five_bar"));
  for (const core::LocusCurve& curve : map.curves) {
    if (curve.kind != LocusKind::backlash) continue;
    const auto* circle = std::get_if<core::CircleForm>(&curve.closed_form);
    ASSERT_NE(circle, nullptr);
    EXPECT_EQ(*circle->radius, 1);  // both links stretched out
    EXPECT_EQ(circle->centre[0], vanishes(curve, "A1", core::Quantity::M) ? core::Rational(0) : core::Rational(1, 2));
  }
}

TEST(PaperHorizontalLoad, LegsAreUnloadedWhereTheirLinksAreHorizontal) {
  // Fig. 11: circles about (1/2 +- 1/2, 0) for leg 1 and (+-1/2, 0) for leg 2.
  const core::LocusMap map = trace_loci(example("five_bar_horizontal"));
  int found = 0;
  for (const core::LocusCurve& curve : map.curves) {
    if (curve.kind != LocusKind::contact_loss) continue;
    const auto* circle = std::get_if<core::CircleForm>(&curve.closed_form);
    ASSERT_NE(circle, nullptr);
    EXPECT_EQ(circle->centre[1], 0);
    const core::Rational from_base =
        circle->centre[0] - (vanishes(curve, "A1", core::Quantity::f) ? core::Rational(1, 2) : core::Rational(0));
    EXPECT_EQ(abs(from_base), core::Rational(1, 2));
    ++found;
  }
  EXPECT_GE(found, 2);
}

TEST(Weights, LeaveNoCurveOfForce) {
  const core::LocusMap map = trace_loci(example("five_bar_weights"));
  int couples = 0;
  for (const core::LocusCurve& curve : map.curves) {
    EXPECT_NE(curve.kind, LocusKind::contact_loss);
    if (!vanishes(curve, "A1", core::Quantity::M)) continue;
    ++couples;
    EXPECT_EQ(core::total_degree(curve.implicit), 24);
    EXPECT_FALSE(curve.arcs.empty());
  }
  EXPECT_EQ(couples, 1);
}

TEST(Weights, AnInclinedLoadLeavesIsolatedContactLosses) {
  const core::LocusMap map = trace_loci(example("five_bar_isolated"));
  const auto has = [&](const std::string& joint, double x, double y) {
    return std::any_of(map.isolated_points.begin(), map.isolated_points.end(), [&](const core::IsolatedPoint& p) {
      const bool vanishes = std::any_of(p.vanishing.begin(), p.vanishing.end(), [&](const auto& v) {
        return v.joint == joint && v.quantity == core::Quantity::f;
      });
      return vanishes && p.certified && std::hypot(p.at[0] - x, p.at[1] - y) < 1e-6;
    });
  };
  EXPECT_TRUE(has("A1", -0.198205, -0.040963));
  EXPECT_TRUE(has("B2", 0.091455, 0.211746));
}

}  // namespace
}  // namespace clearloci
