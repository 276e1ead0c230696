// The first answer of a drag: loci of one design carried over to the next (clearloci/loci.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "core/polynomial.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

Model example_model(const std::string& name) { return Model::read(source_dir() + "/examples/" + name); }

double value_at(const Polynomial& p, const Point2& at) {
  const std::array<Rational, 2> exact = {Rational(at[0]), Rational(at[1])};
  return to_double(evaluate(p, std::span<const Rational>(exact)));
}

/// To first order; at a pole, where the gradient vanishes too, none.
double off_curve(const Polynomial& p, const Point2& at) {
  const double value = std::abs(value_at(p, at));
  if (value == 0) return 0;
  return value / std::hypot(value_at(derivative(p, 0), at), value_at(derivative(p, 1), at));
}

double vertices(const LocusCurve& curve) {
  double count = 0;
  for (const Arc& arc : curve.arcs) count += static_cast<double>(arc.points.size());
  return count;
}

/// Curves of the new design have polynomials that were found without any vertices of the old one.
void expect_on_curves(const LocusMap& carried, const LocusMap& proven, double extent) {
  std::size_t compared = 0;
  for (const LocusCurve& curve : carried.curves) {
    EXPECT_FALSE(curve.certified) << curve.id;
    for (const Arc& arc : curve.arcs)
      for (const Point2& at : arc.points) {
        double least = 1;
        for (const LocusCurve& locus_curve : proven.curves)
          if (locus_curve.kind == curve.kind && locus_curve.mode == curve.mode && !locus_curve.implicit.is_zero())
            least = std::min(least, off_curve(locus_curve.implicit, at));
        EXPECT_LE(least, 1e-9 * extent) << curve.id << " at " << at[0] << ", " << at[1];
        ++compared;
      }
  }
  EXPECT_GT(compared, 100u);
}

class CarriedDesign : public testing::TestWithParam<std::pair<const char*, Model::Value>> {};

TEST_P(CarriedDesign, LiesOnTheCurvesOfTheNewOne) {
  const auto& [name, value] = GetParam();
  const Model model = example_model(name), next = model.with({value});
  const LociRequest coarse{.tolerance = 1e-3};
  const LocusMap last = trace_loci(model, coarse), map = carry_loci(last, next, coarse),
                 proof = trace_loci(next, coarse);
  EXPECT_FALSE(map.complete);
  EXPECT_EQ(map.parameters, proof.parameters);
  EXPECT_EQ(map.lower, proof.lower);
  ASSERT_EQ(map.curves.size(), last.curves.size());
  expect_on_curves(map, proof, 1);
  double before = 0, after = 0;
  for (std::size_t k = 0; k < map.curves.size(); ++k) {
    EXPECT_EQ(map.curves[k].id, last.curves[k].id);
    before += vertices(last.curves[k]);
    after += vertices(map.curves[k]);
  }
  EXPECT_GT(after, 0.9 * before) << "little is lost of so small a step";
}

INSTANTIATE_TEST_SUITE_P(Examples, CarriedDesign,
                         testing::Values(std::pair{"five_bar.yaml", Model::Value{"L", "0.505"}},
                                         std::pair{"five_bar.yaml", Model::Value{"d", "0.49"}},
                                         std::pair{"five_bar_weights.yaml", Model::Value{"L", "0.495"}}));

TEST(CarriedLoci, AreToldBeforeTheProof) {
  const Model model = example_model("five_bar.yaml");
  LociRequest request;
  request.last = std::make_shared<const LocusMap>(trace_loci(model));
  std::vector<LocusMap> first;
  request.carried = [&](LocusMap map) { first.push_back(std::move(map)); };
  const Model next = model.with({{"L", "0.51"}});
  const LocusMap proof = trace_loci(next, request);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_TRUE(proof.complete);
  const LocusMap alone = carry_loci(*request.last, next);
  ASSERT_EQ(first[0].curves.size(), alone.curves.size());
  for (std::size_t k = 0; k < alone.curves.size(); ++k) {
    ASSERT_EQ(first[0].curves[k].arcs.size(), alone.curves[k].arcs.size());
    for (std::size_t a = 0; a < alone.curves[k].arcs.size(); ++a)
      EXPECT_EQ(first[0].curves[k].arcs[a].points, alone.curves[k].arcs[a].points);
  }
}

TEST(CarriedLoci, OverAnotherNumberOfCoordinatesAreNotComplete) {
  const LocusMap map = carry_loci(trace_loci(example_model("four_bar.yaml")), example_model("five_bar.yaml"));
  EXPECT_FALSE(map.complete);
  EXPECT_FALSE(map.notes.empty());
}

TEST(CarriedLoci, OverOneCoordinateAreTheNewValues) {
  const Model model = example_model("four_bar.yaml");
  std::string text = model.text();
  const std::string length = "lengths: [0.9, ";
  text.replace(text.find(length), length.size(), "lengths: [0.91, ");
  const Model next = Model::parse(text);
  const LocusMap last = trace_loci(model), map = carry_loci(last, next), proof = trace_loci(next);
  ASSERT_FALSE(map.isolated_points.empty());
  for (const IsolatedPoint& point : map.isolated_points) {
    double least = 1;
    for (const IsolatedPoint& isolated_point : proof.isolated_points)
      if (isolated_point.mode == point.mode) least = std::min(least, std::abs(isolated_point.at[0] - point.at[0]));
    EXPECT_LE(least, 1e-9 * 6.3) << point.at[0];
  }
}

}  // namespace
}  // namespace clearloci
