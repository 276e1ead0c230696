// Designs whose curves have isolated points: the exact engine answers them, and as the adaptive one does.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "analysis/loci.hpp"
#include "core/errors.hpp"
#include "tests/laws/lattice_designs.hpp"
#include "tests/laws/same_topology.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

bool is_certified(const core::LocusMap& map) {
  return std::all_of(map.curves.begin(), map.curves.end(),
                     [](const core::LocusCurve& curve) { return curve.certified; });
}

/// Traces by either engine. True: both certify all, and tell the same.
bool holds(const mechanism::Mechanism& mechanism) {
  LociRequest request;
  request.engine = core::Engine::exact;
  const core::LocusMap exact = trace_loci(mechanism, request);
  EXPECT_TRUE(exact.complete);
  request.engine = core::Engine::adaptive;
  const core::LocusMap adaptive = trace_loci(mechanism, request);
  if (!is_certified(exact) || !is_certified(adaptive)) return false;
  const std::vector<std::string> all = test::differences(exact, adaptive);
  EXPECT_TRUE(all.empty()) << all.front();
  return all.empty();
}

// At given orientations, on the lattice of quarters: with numbers of many digits CGAL's analysis takes minutes. The
// second once ended CGAL's sweep.
TEST(ExactDesigns, PlatformsOnThreeTelescopes) {
  int told = 0;
  for (const int i : {3000, 3002, 3004, 3006}) {
    std::seed_seq sequence{20261122, static_cast<int>(test::Family::three_rpr), i};
    std::mt19937 random(sequence);
    const std::string text = test::lattice_design(random, test::Family::three_rpr, i % 3 == 2);
    SCOPED_TRACE(std::to_string(i) + "\n" + text);
    try {
      told += holds(mechanism::parse_mechanism(text, "lattice.yaml")) ? 1 : 0;
    } catch (const core::InputError&) {  // no pose within the box
    }
  }
  EXPECT_GE(told, 2);
}

// Over the angles of two motors the curves of a component are biquadratic in the half tangents; three of them meet
// where the ends of a dyad of equal lengths do.
TEST(ExactDesigns, AComponentOverTwoAngles) {
  LociRequest request;
  request.quantities = {core::Quantity::fx};
  const std::string folder = source_dir() + "/tests/corpus/loci/";
  const mechanism::Mechanism mechanism = mechanism::read_mechanism(folder + "five_bar_angles_fx.yaml");
  request.engine = Engine::exact;
  const core::LocusMap exact = trace_loci(mechanism, request);
  EXPECT_TRUE(exact.complete);
  EXPECT_EQ(exact.curves.size(), 6U);
  for (const core::LocusCurve& curve : exact.curves) EXPECT_TRUE(curve.certified) << curve.id;

  // What the other engine leaves open at that place is handed to this one: the curves are of degree 16, but of 8 in
  // either half tangent.
  request.engine = Engine::adaptive_then_exact;
  const core::LocusMap map = trace_loci(mechanism, request);
  EXPECT_EQ(map.curves.size(), 6U);
  EXPECT_TRUE(map.complete);
  EXPECT_TRUE(is_certified(map));
}

}  // namespace
}  // namespace clearloci
