// Boxes whose sides pass through ends, crossings, tangents and centres of curves (tests/corpus/loci): arcs that lie
// outside the box, whole circles in place of a point at its side, zones outside the workspace or none where it is, all
// certified, came of them once; so did one zone of two, where a closed boundary has its cone in a crossing. Areas are
// known by sampling 360000 poses for which every leg reaches.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/zones.hpp"
#include "loci/curves/arc_check.hpp"
#include "tests/laws/same_topology.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

struct Case {
  const char* file;
  double area;        ///< of the workspace in the box, m^2
  double doubt;       ///< of that number
  std::size_t zones;  ///< 0: not known beforehand
};

class BoxSides : public testing::TestWithParam<Case> {};

TEST_P(BoxSides, ArcsStayInTheBoxAndZonesCoverTheWorkspace) {
  const Case& this_GetParam = GetParam();
  const auto mechanism = mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/" + this_GetParam.file + ".yaml");
  const core::Zones map = find_zones(mechanism);
  const core::LocusMap& loci = map.loci;
  for (const core::LocusCurve& curve : loci.curves) {
    EXPECT_TRUE(curve.certified) << curve.factor;
    for (const core::Arc& arc : curve.arcs) {
      EXPECT_GT(arc.length, 0);
      for (const core::Point2& p : arc.points)
        for (std::size_t c = 0; c < 2; ++c) {
          const double low = core::to_double(loci.lower[c]), high = core::to_double(loci.upper[c]);
          ASSERT_GE(p[c], low - 1e-12 * (high - low)) << curve.factor;
          ASSERT_LE(p[c], high + 1e-12 * (high - low)) << curve.factor;
        }
    }
  }
  double zones = 0;
  for (const core::Zone& zone : map.zones) {
    EXPECT_TRUE(zone.certified) << zone.id;
    zones += zone.size;
  }
  EXPECT_NEAR(zones, this_GetParam.area, this_GetParam.doubt);
  if (this_GetParam.zones != 0) {
    EXPECT_EQ(map.zones.size(), this_GetParam.zones);
  }
  ASSERT_EQ(map.modes.size(), 1u);
  EXPECT_NEAR(map.modes[0].workspace, zones, 1e-5 * zones);
  EXPECT_EQ(map.modes[0].in_doubt, 0);
  ASSERT_EQ(loci.workspace.size(), 1u);
  double rings = 0;
  for (const core::Polyline& ring : loci.workspace[0].rings)
    for (std::size_t i = 1; i < ring.size(); ++i)
      rings += (ring[i - 1][0] * ring[i][1] - ring[i][0] * ring[i - 1][1]) / 2;
  EXPECT_NEAR(rings, this_GetParam.area, this_GetParam.doubt);
}

INSTANTIATE_TEST_SUITE_P(
    Corpus, BoxSides,
    testing::Values(Case{"five_bar_box_x_0_05", 0.92374, 1e-5, 10}, Case{"five_bar_box_x_0_1", 1.53792, 1e-4, 0},
                    Case{"box_fuzz_1", 0.84937, 1e-4, 0}, Case{"box_fuzz_3", 0.22238, 1e-4, 0},
                    Case{"box_fuzz_8", 0.5, 1e-9, 0}, Case{"box_fuzz_21", 0.29343, 1e-4, 0},
                    Case{"box_fuzz_53", 0.001577, 2e-6, 0}, Case{"rprpr_duplicate_arc", 1.19, 1e-9, 0},
                    Case{"bug1_scara", 0.128638, 1e-5, 0}, Case{"bug1_scara_horizontal", 0.128638, 1e-5, 0},
                    Case{"five_bar_empty_workspace_rings", 0.76899, 1e-4, 0},
                    Case{"coupler_boundary_through_cone", 3.1111, 1e-4, 11},
                    Case{"box_47_zones_area_short", 0.22831, 1e-4, 0},
                    Case{"box_82_zones_area_short", 0.30988, 1e-4, 0}),
    [](const auto& test) { return std::string(test.param.file); });

// The exact engine kept edges that leave the box and come back to it, and lost the arcs that they were joined to.
class BothEngines : public testing::TestWithParam<const char*> {};

TEST_P(BothEngines, TellTheSame) {
  const auto mechanism = mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/" + GetParam() + ".yaml");
  LociRequest request;
  const core::LocusMap adaptive = trace_loci(mechanism, request);
  request.engine = loci::Engine::exact;
  const core::LocusMap exact = trace_loci(mechanism, request);
  for (const core::LocusMap* map : {&adaptive, &exact})
    for (const core::LocusCurve& curve : map->curves) EXPECT_TRUE(curve.certified) << curve.factor;
  for (const std::string& difference : test::differences(exact, adaptive, test::EndsOnSides::by_place))
    ADD_FAILURE() << difference;
}

INSTANTIATE_TEST_SUITE_P(Corpus, BothEngines, testing::Values("three_rpr_leaves_the_box", "rrrpr_leaves_the_box"),
                         [](const auto& test) { return std::string(test.param); });

// A crank of 1e-15 m, whose workspace is narrower than doubles tell, ended the program; between bases 1e-15 m apart
// whole circles came out for arcs of that length.
TEST(NearlyDegenerate, IsTraced) {
  for (const char* file : {"five_bar_tiny_crank", "near_coincident_bases"}) {
    const core::LocusMap map =
        trace_loci(mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/" + file + ".yaml"));
    EXPECT_FALSE(map.curves.empty()) << file;
    for (const core::LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << file << ": " << curve.factor;
    for (const std::string& note : map.notes) EXPECT_EQ(note.find("withheld"), std::string::npos) << note;
  }
}

// The box lies all inside the workspace: its only ring is the box itself.
TEST(BoxInsideTheWorkspace, IsItsOwnRing) {
  const std::string path = source_dir() + "/examples/five_bar.yaml";
  auto mechanism = mechanism::read_mechanism(path);
  mechanism.coordinates[0].lower = core::Rational(1, 4);
  mechanism.coordinates[0].upper = core::Rational(1, 2);
  mechanism.coordinates[1].lower = core::Rational(1, 4);
  mechanism.coordinates[1].upper = core::Rational(1, 2);
  for (const loci::Engine engine : {loci::Engine::adaptive, loci::Engine::exact}) {
    LociRequest request;
    request.engine = engine;
    const core::LocusMap map = trace_loci(mechanism, request);
    ASSERT_EQ(map.workspace.size(), 1u);
    ASSERT_EQ(map.workspace[0].rings.size(), 1u);
    const core::Polyline& ring = map.workspace[0].rings[0];
    double area = 0;
    for (std::size_t i = 1; i < ring.size(); ++i)
      area += (ring[i - 1][0] * ring[i][1] - ring[i][0] * ring[i - 1][1]) / 2;
    EXPECT_NEAR(std::abs(area), 1.0 / 16, 1e-12);
  }
}

// The last check (loci/curves/arc_check.hpp) passes what was traced, and withholds what is made wrong.
class LastCheck : public testing::Test {
 protected:
  void SetUp() override {
    traced_ = trace_problem(mechanism::read_mechanism(source_dir() + "/examples/five_bar_generic.yaml"));
  }

  /// An open arc of a reaction's curve.
  static core::Arc& arc_of(core::LocusMap& map) {
    for (core::LocusCurve& curve : map.curves)
      for (core::Arc& arc : curve.arcs)
        if (curve.kind < core::LocusKind::direct_singularity && !arc.closed && arc.points.size() > 10) return arc;
    throw std::logic_error("an arc of a reaction");
  }

  template <typename Change>
  void expect_withheld(const Change& change, const std::string& why) const {
    core::LocusMap map = traced_.map;
    change(arc_of(map));
    const std::size_t notes = map.notes.size();
    loci::withhold_wrong_arcs(traced_.problem, map);
    ASSERT_EQ(map.notes.size(), notes + 1) << why;
    EXPECT_NE(map.notes.back().find(why), std::string::npos) << map.notes.back();
    EXPECT_TRUE(std::any_of(map.curves.begin(), map.curves.end(), [](const auto& curve) { return !curve.certified; }) ||
                map.curves.size() < traced_.map.curves.size());
  }

  TracedProblem traced_;
};

TEST_F(LastCheck, PassesWhatWasTraced) {
  core::LocusMap map = traced_.map;
  loci::withhold_wrong_arcs(traced_.problem, map);
  EXPECT_EQ(map.notes, traced_.map.notes);
  EXPECT_EQ(map.curves.size(), traced_.map.curves.size());
}

TEST_F(LastCheck, WithholdsAVertexThatWasMoved) {
  expect_withheld([](core::Arc& arc) { arc.points[5][0] += 1e-9; }, "off its curve");
}

TEST_F(LastCheck, WithholdsAnArcThatLeavesTheBox) {
  expect_withheld([](core::Arc& arc) { arc.points[5] = {1e3, 0}; }, "outside the box");
}

TEST_F(LastCheck, WithholdsAnEndThatIsNotWhereItSays) {
  expect_withheld([](core::Arc& arc) { arc.points.pop_back(), arc.ends[1] = core::ArcEnd::box; }, "on no side");
}

TEST_F(LastCheck, WithholdsAClosedArcWithEnds) {
  expect_withheld([](core::Arc& arc) { arc.closed = true; }, "closed");
}

TEST_F(LastCheck, WithholdsAnArcOfAnotherMode) {
  core::LocusMap map = traced_.map;
  for (core::LocusCurve& curve : map.curves)
    for (int& sign : curve.mode) sign = -sign;
  loci::withhold_wrong_arcs(traced_.problem, map);
  for (const core::LocusCurve& curve : map.curves) EXPECT_NE(curve.kind, core::LocusKind::contact_loss) << curve.factor;
}

TEST_F(LastCheck, WithholdsALengthThatIsNotTheArcs) {
  expect_withheld([](core::Arc& arc) { arc.length *= 1.5; }, "length");
}

}  // namespace
}  // namespace clearloci
