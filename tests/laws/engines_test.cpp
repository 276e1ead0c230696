// The adaptive engine tells the same as the exact one: components, closed or open, ends and what they end on, isolated
// points. CLEARLOCI_DESIGNS=n in the environment compares n designs, and traces n with weights.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numbers>

#include "analysis/loci.hpp"
#include "tests/laws/design_texts.hpp"
#include "tests/laws/same_topology.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

int designs(int usual) {
  const char* wanted = std::getenv("CLEARLOCI_DESIGNS");
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

LociRequest all_modes(loci::Engine engine) {
  LociRequest request;
  request.all_working_modes = true;
  request.engine = engine;
  return request;
}

void expect_certified(const core::LocusMap& map) {
  for (const core::LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << curve.factor;
  for (const core::IsolatedPoint& point : map.isolated_points) EXPECT_TRUE(point.certified);
  for (const std::string& note : map.notes) {
    EXPECT_EQ(note.find("undecided"), std::string::npos) << note;
    EXPECT_EQ(note.find("neither proven"), std::string::npos) << note;
    EXPECT_EQ(note.find("withheld"), std::string::npos) << note;
  }
}

/// `request` names the engine that is held against the exact one.
void expect_agreement(const mechanism::Mechanism& mechanism, LociRequest request,
                      test::EndsOnSides ends = test::EndsOnSides::strict) {
  const core::LocusMap adaptive = trace_loci(mechanism, request);
  request.engine = loci::Engine::exact;
  const core::LocusMap exact = trace_loci(mechanism, request);
  expect_certified(adaptive);
  expect_certified(exact);
  for (const std::string& difference : test::differences(exact, adaptive, ends)) ADD_FAILURE() << difference;
}

class EnginesOnExamples : public testing::TestWithParam<std::string> {};

TEST_P(EnginesOnExamples, Agree) {
  const auto mechanism = mechanism::read_mechanism(source_dir() + "/examples/" + GetParam() + ".yaml");
  LociRequest request = all_modes(loci::Engine::adaptive);
  expect_agreement(mechanism, request);
  request.quantities = {core::Quantity::fx, core::Quantity::fy};
  expect_agreement(mechanism, request);
}

INSTANTIATE_TEST_SUITE_P(Quick, EnginesOnExamples,
                         testing::Values("five_bar", "five_bar_generic", "five_bar_horizontal", "five_bar_inclined"),
                         [](const auto& test) { return test.param; });

TEST(Engines, AgreeOnMargins) {
  const auto mechanism = mechanism::read_mechanism(source_dir() + "/examples/five_bar_generic.yaml");
  LociRequest request;
  request.engine = loci::Engine::adaptive;
  request.joints = {"B2"};
  request.min_force = 50;
  expect_agreement(mechanism, request);
}

TEST(Engines, AgreeOnRandomDesigns) {
  constexpr unsigned seed = 7;
  std::mt19937 random(seed);
  for (int i = 0; i < designs(4); ++i) {
    const test::FiveBarDesign design = test::random_five_bar(random, false);
    SCOPED_TRACE(design.text());
    // On the lattice a side of the box passes where boundaries and singularities end arcs too. All that meets there is
    // a true name of the end; which of them an engine sees inside the box is another matter. And what the adaptive
    // engine says of some of these designs is that it leaves them to the exact one.
    expect_agreement(mechanism::parse_mechanism(design.text(), "random.yaml"),
                     all_modes(loci::Engine::adaptive_then_exact), test::EndsOnSides::by_place);
  }
}

/// Lengths of the arcs, of all modes, of one kind on a circle.
std::vector<double> lengths(const core::LocusMap& map, core::LocusKind kind,
                            const std::array<core::Rational, 2>& centre, const core::Rational& radius) {
  std::vector<double> list;
  for (const core::LocusCurve& curve : map.curves) {
    const auto* circle = std::get_if<core::CircleForm>(&curve.closed_form);
    if (curve.kind != kind || circle == nullptr || circle->centre != centre) continue;
    if (circle->radius_squared != radius * radius) continue;
    for (const core::Arc& arc : curve.arcs) list.push_back(arc.length);
  }
  return list;
}

// Once wrong, each in one of the engines.
TEST(Engines, AgreeOnDesignsOfTheCorpus) {
  const auto kept = [](const std::string& name) {
    return mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/" + name + ".yaml");
  };
  const LociRequest request = all_modes(loci::Engine::adaptive_then_exact);
  for (const std::string name :
       {"five_bar_node_at_touching_rims", "five_bar_singularity_leaves_the_box", "five_bar_parallel_singularity",
        "five_bar_rim_half_singular", "rrrpr_singularity_touches_a_side"}) {
    SCOPED_TRACE(name);
    expect_agreement(kept(name), request, test::EndsOnSides::by_place);
  }
  // On the rim where leg 1 is folded, |P - A1| = 1/2, B2 may stand on A1, in line with B1 and P: in either mode of leg
  // 2 |A| vanishes on one half of it. On the other the couple in A1 does.
  const core::Rational quarter(1, 4);
  const core::LocusMap half = trace_loci(kept("five_bar_rim_half_singular"), request);
  const std::vector<double> halves = lengths(half, core::LocusKind::backlash, {quarter, quarter}, 2 * quarter);
  EXPECT_EQ(halves.size(), 4u);
  for (const double length : halves) EXPECT_NEAR(length, std::numbers::pi / 2, 1e-9);
  // B1B2 is as long as A1A2 and stays parallel to it: P is on the circle of radius 3/4 about (-1/2, 1/4), with both
  // elbows to the left on its lower half, to the right on the upper one, which the box cuts at y = 3/4.
  const core::LocusMap parallel = trace_loci(kept("five_bar_parallel_singularity"), request);
  std::vector<double> arcs =
      lengths(parallel, core::LocusKind::direct_singularity, {-2 * quarter, quarter}, 3 * quarter);
  std::sort(arcs.begin(), arcs.end());
  ASSERT_EQ(arcs.size(), 3u);
  EXPECT_NEAR(arcs[0], 0.75 * std::asin(0.5 / 0.75), 1e-9);
  EXPECT_NEAR(arcs[1], arcs[0], 1e-9);
  EXPECT_NEAR(arcs[2], 0.75 * std::numbers::pi, 1e-9);
}

// |A| = 0 all along the rail, and no force of S1's guide: no arc there ends on a singularity.
TEST(Engines, AgreeWhereTheSingularityIsTheLineItself) {
  const mechanism::Mechanism rail =
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/one_rail_singular_line_to_a_limit.yaml");
  expect_agreement(rail, all_modes(loci::Engine::adaptive));
  int ends = 0;
  for (const core::LocusCurve& curve : trace_loci(rail, all_modes(loci::Engine::exact)).curves)
    for (const core::Arc& arc : curve.arcs)
      if (curve.kind == core::LocusKind::contact_loss)
        for (const core::ArcEnd end : arc.ends) ends += end == core::ArcEnd::boundary || end == core::ArcEnd::box;
  EXPECT_EQ(ends, 8);
}

// At rest at 140 deg, the spring is half a turn off at -40 deg. Its angle is that of an arm without length of its own,
// whose sine and cosine hold a root: the lines beside the slit were lost with the root, but for certificates.
TEST(AdaptiveEngine, FindsTheSlitOfATorsionSpringOfAnArm) {
  const mechanism::Mechanism arm = mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/arm_torsion_slit.yaml");
  const core::LocusMap map = trace_loci(arm, {});
  core::Certificate certificate;
  const core::LocusMap certified = trace_loci(arm, {}, &certificate);
  for (const std::string& difference : test::differences(map, certified)) ADD_FAILURE() << difference;
  int sides = 0;
  for (const core::LocusCurve& curve : map.curves) {
    if (curve.kind != core::LocusKind::workspace_boundary) continue;
    ++sides;
    EXPECT_TRUE(curve.certified);
    for (const core::Point2& at : curve.arcs.at(0).points)
      EXPECT_NEAR(std::abs(std::atan2(at[1], at[0]) * 180 / std::numbers::pi + 40), 0.1, 1e-4);  // rational, nearly
  }
  EXPECT_EQ(sides, 2);
}

// The line of the slider's reach runs through A2: where it crosses the circles of the other leg's ends, right above and
// below A2, the couple in A2 vanishes.
TEST(Engines, ArcsEndInCornersOfALineAndACircle) {
  const core::LocusMap map = trace_loci(
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/prrr_r_corner_of_rail_and_circle.yaml"), {});
  int ends = 0;
  for (const core::LocusCurve& curve : map.curves) {
    EXPECT_TRUE(curve.certified) << curve.id;
    if (curve.kind != core::LocusKind::backlash) continue;
    for (const core::Arc& arc : curve.arcs)
      for (const core::Point2& end : {arc.points.front(), arc.points.back()})
        ends += end == core::Point2{0.75, 0.25} || end == core::Point2{0.75, -1.75} ? 1 : 0;
  }
  EXPECT_EQ(ends, 2);
}

// A locus meets |A| = 0 where that crosses or touches itself, a double zero of both: at a point of the lattice, where
// all roots are rational. And a branch leaves the base of a leg towards a corner between the charts around it.
TEST(Engines, TheAdaptiveOneCertifiesWhatTouchesOnTheLattice) {
  const auto kept = [](const std::string& name) {
    return mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/" + name + ".yaml");
  };
  LociRequest adaptive;
  adaptive.engine = loci::Engine::adaptive;
  const mechanism::Mechanism crossing = kept("prrr_r_double_zero_with_singularity");
  expect_certified(trace_loci(crossing, adaptive));
  LociRequest of_guide = adaptive;  // the other curves are beyond the exact engine
  of_guide.joints = {"G1"};
  expect_agreement(crossing, of_guide, test::EndsOnSides::by_place);
  for (const core::LocusCurve& curve : trace_loci(kept("prrr_r_zeros_along_an_axis"), adaptive).curves)
    EXPECT_TRUE(curve.certified) << curve.id;
  expect_certified(trace_loci(kept("coupler_branch_towards_a_corner"), {}));
}

// The rail touches the circle of the crank, and all lengths are 3/4: where S1 and B2 meet in that point, on the lower
// half of the circle around it, |A| is never negative. The couple in A2 is beyond the exact engine there.
TEST(Engines, CertifyWhereTheSingularityIsDouble) {
  const core::LocusMap map = trace_loci(
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/prrr_r_rail_touches_crank_circle.yaml"), {});
  int open = 0;
  std::size_t vertices = 0;
  for (const core::LocusCurve& curve : map.curves) {
    if (!curve.certified) ++open;
    for (const core::Arc& arc : curve.arcs) vertices += arc.points.size();
  }
  EXPECT_EQ(open, 1);
  EXPECT_LE(vertices, 2000u);  // 2170 where chords were too short beside branches that nearly touch
  const std::vector<double> half = lengths(map, core::LocusKind::direct_singularity, {0, -0.5}, 0.75);
  ASSERT_EQ(half.size(), 1u);
  EXPECT_NEAR(half[0], 0.75 * std::numbers::pi, 1e-9);
}

// At (0, -1/4) the leg of the coupler is folded, and C is on A1: the ends of the other leg meet, on the boundary of the
// one that they stand on. At (6/25, -193/100) both legs are stretched; there a locus meets the boundary of the upper
// one in the same place. Both couples, |A| = 0 and two of the boundaries had been left open for it.
TEST(Engines, TheAdaptiveOneCertifiesWhereLegsOnLegsAreStretchedOrMeet) {
  LociRequest adaptive;
  adaptive.engine = loci::Engine::adaptive;
  const core::LocusMap map = trace_loci(
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/coupler_base_on_a_boundary.yaml"), adaptive);
  ASSERT_EQ(map.curves.size(), 6u);
  for (const core::LocusCurve& curve : map.curves) {
    EXPECT_TRUE(curve.certified) << curve.id;
    for (const core::Arc& arc : curve.arcs)
      for (const core::ArcEnd end : arc.ends) EXPECT_NE(end, core::ArcEnd::crossing) << curve.id;
  }
}

// Both rods are level at x = -1/2: two boundaries of the workspace on one line, along which cells can tell nothing.
TEST(Engines, CertifyWhereTwoBoundariesAreOneLine) {
  const mechanism::Mechanism rails =
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/prrrp_boundaries_on_one_line.yaml");
  const core::LocusMap map = trace_loci(rails, {});
  int on_the_line = 0;
  for (const core::LocusCurve& curve : map.curves) {
    EXPECT_TRUE(curve.certified) << curve.id;
    const auto* line = std::get_if<core::LineForm>(&curve.closed_form);
    if (line == nullptr || curve.arcs.front().points.front()[0] != -0.5) continue;
    ++on_the_line;
    EXPECT_EQ(curve.cause.find("; ") != std::string::npos, curve.kind == core::LocusKind::workspace_boundary);
  }
  EXPECT_EQ(on_the_line, 2);  // the boundary, once, and |A| = 0
  expect_agreement(rails, all_modes(loci::Engine::adaptive_then_exact), test::EndsOnSides::by_place);
}

// The ends of equal links meet all along the line of equal strokes or angles, which P has no place on: both sides of it
// have been left open, cell by cell.
TEST(Engines, CertifyWhereTheEndsOfEqualLinksMeetAlongALine) {
  // Of the five-bar whole forces vanish on the line where |A| does, which stays open.
  for (const auto& [name, cause, quantity] :
       {std::tuple("five_bar_on_one_axis", "B2 on B1, where P has no place", core::Quantity::fx),
        std::tuple("two_slides_on_a_rail", "S2 on S1, where P has no place", core::Quantity::f)}) {
    SCOPED_TRACE(name);
    LociRequest request;
    request.quantities = {quantity};
    const core::LocusMap map =
        trace_loci(mechanism::read_mechanism(source_dir() + "/tests/corpus/modes/" + name + ".yaml"), request);
    EXPECT_TRUE(map.complete);
    expect_certified(map);
    int meeting = 0;
    for (const core::LocusCurve& curve : map.curves) {
      if (curve.cause != cause) continue;
      ++meeting;
      EXPECT_EQ(curve.kind, core::LocusKind::workspace_boundary);
      ASSERT_EQ(curve.arcs.size(), 1u);  // found on both sides, and in every chart
      const core::Arc& arc = curve.arcs.front();
      for (const core::Point2& at : arc.points) EXPECT_NEAR(at[0], at[1], 1e-9);
      const double from = core::to_double(map.lower[0]), to = core::to_double(map.upper[0]);
      EXPECT_NEAR(arc.length, std::numbers::sqrt2 * (to - from), 1e-6);
    }
    EXPECT_EQ(meeting, 1);
  }
}

// Dyads on dyads: enclosures of the upper ones' roots are tight where they are computed by ways and distances. Four of
// these curves, and the places of three joints, had been left open after ten times as long.
TEST(Engines, CertifyTwoDyadsOnAFiveBar) {
  const core::LocusMap map =
      trace_loci(mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/five_bar_two_dyads_stacked.yaml"), {});
  EXPECT_GE(map.curves.size(), 15u);
  for (const core::LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << curve.id;
  EXPECT_TRUE(map.notes.empty()) << map.notes.front();
  // A2 bears nothing at two poses. Of |A|'s polynomials nothing but rounding is left there, though |A| is far from
  // zero.
  EXPECT_EQ(map.isolated_points.size(), 2u);
  for (const core::IsolatedPoint& point : map.isolated_points) {
    EXPECT_EQ(point.kind, core::LocusKind::contact_loss);
    EXPECT_TRUE(point.certified);
  }
}

// A third dyad. On the small circle about A2, on which leg 2 is folded, the crank turns ten times as fast as P, and the
// chain of four links above it is not told there: that is said, in seconds; everything else is proven.
TEST(Engines, CertifyThreeDyadsButOnOneCircle) {
  const core::LocusMap map =
      trace_loci(mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/five_bar_three_dyads_stacked.yaml"), {});
  EXPECT_GE(map.curves.size(), 15u);
  EXPECT_FALSE(map.out_of_time);
  for (const core::LocusCurve& curve : map.curves)
    EXPECT_TRUE(curve.certified || curve.cause == "P, B2, A2 aligned") << curve.id << " " << curve.cause;
  EXPECT_LE(map.notes.size(), 1u);
}

/// Both boundaries' circles touch, from outside or from inside, on bases of several inclinations.
std::vector<test::FiveBarDesign> touching_designs() {
  std::vector<test::FiveBarDesign> designs(5);
  const auto set = [](test::FiveBarDesign& design, std::array<std::string, 2> a2, const char* proximal1,
                      const char* distal1, const char* proximal2, const char* distal2) {
    design.a2 = std::move(a2);
    design.proximal1 = proximal1;
    design.distal1 = distal1;
    design.proximal2 = proximal2;
    design.distal2 = distal2;
  };
  set(designs[0], {"1/5", "0"}, "26/60", "37/60", "30/60", "31/60");
  set(designs[1], {"3/10", "2/5"}, "1/2", "7/10", "2/5", "7/10");
  set(designs[2], {"2/5", "-3/10"}, "1/2", "7/10", "2/5", "7/10");
  set(designs[3], {"3/10", "2/5"}, "2/5", "3/5", "7/10", "4/5");
  set(designs[4], {"2/5", "3/10"}, "2/5", "3/5", "9/10", "2/5");
  return designs;
}

TEST(Engines, AgreeWhereWorkspaceBoundariesTouch) {
  for (const test::FiveBarDesign& design : touching_designs()) {
    SCOPED_TRACE(design.text());
    expect_agreement(mechanism::parse_mechanism(design.text(), "touch.yaml"), all_modes(loci::Engine::adaptive));
  }
}

TEST(AdaptiveEngine, CertifiesWeightsWhereWorkspaceBoundariesTouch) {
  for (test::FiveBarDesign design : touching_designs()) {
    design.gravity = {"0", "-9.81"};
    SCOPED_TRACE(design.text());
    expect_certified(
        trace_loci(mechanism::parse_mechanism(design.text(), "touch.yaml"), all_modes(loci::Engine::adaptive)));
  }
}

// Where P is above A2 on the rim of leg 2 neither weight nor load has a moment about A2, whatever leg 1 does; there
// leg 1 is stretched out.
TEST(AdaptiveEngine, CertifiesACurveThroughTheCornerOfTwoBoundaries) {
  test::FiveBarDesign design;
  design.a1 = {"1/10", "-1/10"};
  design.a2 = {"1/2", "3/10"};
  design.proximal1 = "24/60";
  design.distal1 = design.distal2 = "27/60";
  design.proximal2 = "48/60";
  design.gravity = {"0", "-9.81"};
  design.force = {"50", "0"};
  expect_certified(
      trace_loci(mechanism::parse_mechanism(design.text(), "corner.yaml"), all_modes(loci::Engine::adaptive)));
}

// Leg 1 stands on the coupler and has equal lengths: where its ends meet, at no rational point, the sheet is a cone.
TEST(AdaptiveEngine, CertifiesConesOfDyadsOnDyads) {
  std::ifstream file(source_dir() + "/examples/five_bar_coupler.yaml");
  const std::string shipped((std::istreambuf_iterator<char>(file)), {});
  const auto with = [](std::string text, const std::string& old, const std::string& value) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return at == std::string::npos ? text : text.replace(at, old.size(), value);
  };
  for (const std::string offset : {"[0.4, 0.1]", "[1/4, -0.15]"}) {
    const std::string text = with(with(shipped, "offset: [0.4, 0.1]", "offset: " + offset), "A1: [0, 0]",
                                  offset == "[0.4, 0.1]" ? "A1: [0, 0]" : "A1: [0.05, 0.1]");
    SCOPED_TRACE(text);
    const mechanism::Mechanism mechanism = mechanism::parse_mechanism(text, "coupler.yaml");
    const core::LocusMap map = trace_loci(mechanism, all_modes(loci::Engine::adaptive));
    expect_certified(map);
    // At the apex itself every couple is zero because the construction is undefined, which is no locus.
    for (const core::IsolatedPoint& point : map.isolated_points) EXPECT_EQ(point.kind, core::LocusKind::contact_loss);
    EXPECT_EQ(validate_loci(mechanism, {}, {.nx = 80, .ny = 80}).report.disputed, 0u);
  }
}

// The crank of one leg carries a dyad more: roots nest, and at A2 the upper one vanishes with a higher power of the
// distance than the lower one.
constexpr const char* seven_bar = R"(format: 1
name: Seven-bar with a remote drive
space: planar

parameters:
  L: 1/2
  rod: 0.6
  arm: 0.3

workspace:
  x: [-0.5, 1.0]
  y: [-1.0, 1.0]

points:
  A1: [0, 0]
  A2: [L, 0]
  A3: [1.1, 0]
  P:  [x, y]
  B1: {dyad: [A1, P], lengths: [L, L], side: left}
  B2: {dyad: [A2, P], lengths: [L, L], side: right}
  D:  {on: [A2, B2], offset: [1/5, 0]}
  C:  {dyad: [A3, D], lengths: [arm, rod], side: left}

links:
  A1B1: {points: [A1, B1], mass: 1}
  B1P:  {points: [B1, P],  mass: 1}
  PB2:  {points: [P, B2],  mass: 1}
  A2B2: {points: [A2, B2, D], mass: 1}
  DC:   {points: [D, C], mass: 0.5}
  A3C:  {points: [A3, C], mass: 0.5}

joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}
  B1: {revolute: [A1B1, B1P],    at: B1, clearance: {radial: 10e-6}}
  P:  {revolute: [B1P, PB2],     at: P,  clearance: {radial: 10e-6}}
  B2: {revolute: [A2B2, PB2],    at: B2, clearance: {radial: 10e-6}}
  A2: {revolute: [ground, A2B2], at: A2, clearance: {radial: 10e-6}}
  D:  {revolute: [A2B2, DC],     at: D,  clearance: {radial: 10e-6}}
  C:  {revolute: [A3C, DC],      at: C,  clearance: {radial: 10e-6}}
  A3: {revolute: [ground, A3C],  at: A3, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}

end_effector: {link: PB2, at: P}

loads:
  - {link: PB2, at: P, force: [0, -100]}
)";

TEST(AdaptiveEngine, TracesADyadOnADyadThroughTheBaseOfTheLowerOne) {
  const core::LocusMap map =
      trace_loci(mechanism::parse_mechanism(seven_bar, "seven_bar.yaml"), {.engine = loci::Engine::adaptive});
  EXPECT_FALSE(map.out_of_time);
  EXPECT_FALSE(map.curves.empty());
  for (const core::LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << curve.factor;
  EXPECT_TRUE(map.isolated_points.empty());
  // Of the curves nothing is open.
  for (const core::OpenRegion& region : map.open) EXPECT_TRUE(region.point) << region.factor;
}

TEST(AdaptiveEngine, MarksWhatADeadlineCutShort) {
  const auto mechanism = mechanism::read_mechanism(source_dir() + "/examples/five_bar.yaml");
  core::LocusProblem problem = trace_problem(mechanism).problem;
  const core::LocusMap map =
      loci::trace(problem, {.engine = loci::Engine::adaptive, .deadline = std::chrono::steady_clock::now()});
  EXPECT_FALSE(map.complete);
}

// Any weight on the links makes the couples' curves ones of degree 24.
TEST(AdaptiveEngine, CertifiesRandomDesignsWithWeights) {
  constexpr unsigned seed = 8;
  std::mt19937 random(seed);
  for (int i = 0; i < designs(3); ++i) {
    const test::FiveBarDesign design = test::random_five_bar(random, true);
    SCOPED_TRACE(design.text());
    const core::LocusMap map =
        trace_loci(mechanism::parse_mechanism(design.text(), "random.yaml"), all_modes(loci::Engine::adaptive));
    expect_certified(map);
    EXPECT_TRUE(map.complete);
  }
}

}  // namespace
}  // namespace clearloci
