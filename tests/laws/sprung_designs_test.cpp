// 5R with springs of every kind, with limits and without: what loci claim holds against reactions solved numerically,
// and most of their curves are certified. CLEARLOCI_DESIGNS=n in the environment tries n of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "analysis/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "tests/laws/design_texts.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

template <std::size_t n>
std::string one_of(const std::array<const char*, n>& texts, std::mt19937& random) {
  return texts[random() % n];
}

std::string spring(std::mt19937& random) {
  switch (random() % 5) {
    case 0:
      return "{links: [A1B1, ground], at: [B1, A2], stiffness: 300, free_length: " +
             one_of<2>({"1/10", "1/4"}, random) + "}";
    case 1:
      return "{links: [B1P, B2A2], at: [P, A2], force: " + one_of<2>({"25", "-40"}, random) + "}";
    case 2:
      return "{links: [PB2, ground], at: [P, A1], stiffness: 100, free_length: 0}";
    case 3:
      return "{links: [A1B1, B2A2], at: [B1, B2], stiffness: 200, free_length: 0}";
    default:
      return "{joint: " + one_of<5>({"A1", "B1", "P", "B2", "A2"}, random) +
             ", stiffness: 8, rest: " + one_of<3>({"0", "60 deg", "-1.1"}, random) + "}";
  }
}

std::string limits(std::mt19937& random) {
  return "limits:\n  - " +
         one_of<3>({"{distance: [A1, P], within: [0.31, 0.92]}", "{angle: [A1, B1, P], within: [20 deg, 160 deg]}",
                    "{distance: [B1, B2], within: [0.1, 1.25]}"},
                   random) +
         "\n";
}

TEST(SprungDesigns, HoldAgainstTheWitness) {
  const char* const wanted = std::getenv("CLEARLOCI_DESIGNS");
  const int designs = wanted != nullptr ? std::atoi(wanted) : 3;
  std::mt19937 random(20110577);
  int certified = 0, tried = 0;
  for (int i = 0; i < designs; ++i) {
    std::string text = test::random_five_bar(random, i % 2 == 1).text() + "springs:\n";
    for (unsigned count = 1 + random() % 2; count > 0; --count) text += "  - " + spring(random) + "\n";
    if (random() % 3 == 0) text += limits(random);
    SCOPED_TRACE(text);
    const mechanism::Mechanism mechanism = mechanism::parse_mechanism(text, "sprung.yaml");
    const Validation validation = validate_loci(mechanism, {}, {40, 40});
    EXPECT_EQ(validation.report.disputed, 0U);
    EXPECT_TRUE(validation.report.disputed_arcs.empty());
    ++tried;
    certified += std::ranges::all_of(validation.map.curves, &LocusCurve::certified) ? 1 : 0;
  }
  EXPECT_GE(2 * certified, tried - 1);
}

// What a search leaves open beside a point that it has proven is an open place, and no point of its own.
TEST(SprungDesigns, TellAPlaceOnce) {
  const Model model = Model::read(source_dir() + "/tests/corpus/springs/point_proven_beside_an_open_cell.yaml");
  const LocusMap loci = trace_loci(model);
  const auto& points = loci.isolated_points;
  EXPECT_TRUE(std::ranges::any_of(points, &IsolatedPoint::certified));
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(points[i].vanishing == points[k].vanishing &&
                   std::hypot(points[i].at[0] - points[k].at[0], points[i].at[1] - points[k].at[1]) < 1e-9)
          << points[i].at[0] << " " << points[i].at[1];
  EXPECT_EQ(loci.complete, loci.open.empty());
}

}  // namespace
}  // namespace clearloci
