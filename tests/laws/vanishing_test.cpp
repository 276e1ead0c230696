// Loci are of reactions, not of numerators (method.md section 10): symmetric designs, on which numerators and |A|
// vanish together, and guides, which lose contact where an end lifts. The witness knows reactions alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/loci.hpp"
#include "core/locus_map.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using core::LocusCurve;
using core::LocusKind;
using core::Quantity;

mechanism::Mechanism corpus(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/" + name);
}

bool names(const LocusCurve& curve, const std::string& joint, Quantity quantity) {
  return std::any_of(curve.vanishing.begin(), curve.vanishing.end(),
                     [&](const core::Vanishing& v) { return v.joint == joint && v.quantity == quantity; });
}

/// The curves of a map with a given polynomial, as it is printed.
std::vector<const LocusCurve*> on(const core::LocusMap& map, const std::string& polynomial) {
  std::vector<const LocusCurve*> found;
  for (const LocusCurve& curve : map.curves)
    if (core::to_string(curve.implicit, map.tower.coordinates) == polynomial) found.push_back(&curve);
  return found;
}

const LocusCurve* of_kind(const std::vector<const LocusCurve*>& curves, LocusKind kind) {
  for (const LocusCurve* curve : curves)
    if (curve->kind == kind) return curve;
  return nullptr;
}

std::vector<numeric::TracedReaction> disputed(const numeric::ValidationReport& report) {
  std::vector<numeric::TracedReaction> list;
  for (const numeric::DisputedArc& arc : report.disputed_arcs)
    if (std::find(list.begin(), list.end(), arc.reaction) == list.end()) list.push_back(arc.reaction);
  return list;
}

bool contains(const std::vector<numeric::TracedReaction>& list, const std::string& joint, Quantity quantity) {
  return std::find(list.begin(), list.end(), numeric::TracedReaction{joint, quantity}) != list.end();
}

TEST(Vanishing, ForcesHaveNoLimitOnTheRimWhereTheLoadIsAlongTheLegs) {
  const core::LocusMap map = trace_loci(corpus("coaxial_equal_legs.yaml"), {});
  ASSERT_EQ(map.isolated_points.size(), 2U);
  for (const core::IsolatedPoint& point : map.isolated_points) {
    EXPECT_EQ(point.kind, LocusKind::no_limit);
    EXPECT_EQ(point.vanishing.size(), 5U);
    EXPECT_TRUE(point.certified);
    EXPECT_NEAR(std::hypot(point.at[0] - 1.7, point.at[1] - 1.7), 0.25, 1e-12);
  }
}

TEST(Vanishing, ADyadInLineWithItsCrankLeavesNoPlaceOpen) {
  const core::LocusMap map = trace_loci(corpus("stacked_dyad_in_line_with_its_crank.yaml"), {});
  EXPECT_TRUE(map.complete);
  EXPECT_TRUE(map.open.empty());
}

TEST(Vanishing, AForceHasNoLimitWhereTheDyadOnACrankIsStretched) {
  LociRequest request;
  request.joints = {"C"};
  const core::LocusMap map = trace_loci(corpus("stacked_dyad_without_limit.yaml"), request);
  EXPECT_EQ(std::count_if(map.isolated_points.begin(), map.isolated_points.end(),
                          [](const core::IsolatedPoint& point) { return point.kind == LocusKind::no_limit; }),
            3);
  for (const core::IsolatedPoint& point : map.isolated_points) EXPECT_TRUE(point.certified);
}

TEST(Vanishing, CoaxialLegsBearTheirMotorsCouplesOnTheRim) {
  const mechanism::Mechanism leg = corpus("minitaur.yaml");
  for (const loci::Engine engine : {loci::Engine::adaptive_then_exact, loci::Engine::exact}) {
    LociRequest request;
    request.engine = engine;
    const core::LocusMap map = trace_loci(leg, request);
    for (const char* rim : {"100*x^2 + 100*y^2 - 9", "100*x^2 + 100*y^2 - 1"}) {
      const auto curves = on(map, rim);
      ASSERT_FALSE(curves.empty());
      for (const LocusCurve* curve : curves) EXPECT_TRUE(curve->vanishing.empty()) << rim;
      const LocusCurve* singular = of_kind(curves, LocusKind::direct_singularity);
      ASSERT_NE(singular, nullptr);
      EXPECT_TRUE(singular->excited);  // the pins' forces across the leg are unbounded
    }
    for (const LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << curve.id;
  }
}

TEST(Vanishing, TwoRodsOnOneRailLoseTheirAxialForcesAlone) {
  const mechanism::Mechanism rail = corpus("prr2.yaml");
  for (const loci::Engine engine : {loci::Engine::adaptive_then_exact, loci::Engine::exact}) {
    LociRequest request;
    request.engine = engine;
    const core::LocusMap map = trace_loci(rail, request);
    const auto bottom = on(map, "4*y + 1");
    const LocusCurve* lost = of_kind(bottom, LocusKind::backlash);
    ASSERT_NE(lost, nullptr);
    EXPECT_EQ(of_kind(bottom, LocusKind::contact_loss), nullptr);
    ASSERT_EQ(lost->vanishing.size(), 2u);
    EXPECT_TRUE(names(*lost, "G1", Quantity::F) && names(*lost, "G2", Quantity::F));
    // Both sliders meet, but the load is along the rods: nothing grows.
    const LocusCurve* singular = of_kind(bottom, LocusKind::direct_singularity);
    ASSERT_NE(singular, nullptr);
    EXPECT_FALSE(singular->excited);
    const LocusCurve* flat = of_kind(on(map, "y"), LocusKind::direct_singularity);
    ASSERT_NE(flat, nullptr);
    EXPECT_TRUE(flat->excited);
  }
}

/// The map with claims that the numerators alone would make: what vanishes on the curve of a given kind and polynomial.
core::LocusMap with_claims(core::LocusMap map, const std::string& polynomial,
                           const std::vector<core::Vanishing>& claims) {
  LocusCurve claim = *of_kind(on(map, polynomial), LocusKind::workspace_boundary);
  std::erase_if(map.curves,
                [&](const LocusCurve& curve) { return !curve.vanishing.empty() && curve.implicit == claim.implicit; });
  claim.id = "claim";
  claim.kind = LocusKind::contact_loss;
  claim.vanishing = claims;
  map.curves.push_back(std::move(claim));
  return map;
}

TEST(Vanishing, TheWitnessDisputesWhatNumeratorsAloneWouldClaim) {
  const mechanism::Mechanism leg = corpus("minitaur.yaml");
  const core::LocusMap legs = trace_loci(leg);
  EXPECT_EQ(numeric::validate(leg, legs, {40, 40}).disputed, 0u);
  for (const char* rim : {"100*x^2 + 100*y^2 - 9", "100*x^2 + 100*y^2 - 1"}) {
    const auto list = disputed(
        numeric::validate(leg, with_claims(legs, rim, {{"A1", Quantity::M, 1}, {"A2", Quantity::M, 1}}), {40, 40}));
    EXPECT_TRUE(contains(list, "A1", Quantity::M)) << rim;
    EXPECT_TRUE(contains(list, "A2", Quantity::M)) << rim;
  }

  const mechanism::Mechanism rail = corpus("prr2.yaml");
  const core::LocusMap rods = trace_loci(rail);
  EXPECT_EQ(numeric::validate(rail, rods, {40, 40}).disputed, 0u);
  const auto list = disputed(numeric::validate(rail,
                                               with_claims(rods, "4*y + 1",
                                                           {{"S1", Quantity::f, 1},
                                                            {"P", Quantity::f, 1},
                                                            {"S2", Quantity::f, 1},
                                                            {"G1", Quantity::N, 1},
                                                            {"G2", Quantity::N, 1},
                                                            {"G1", Quantity::F, 1},
                                                            {"G2", Quantity::F, 1}}),
                                               {40, 40}));
  for (const char* joint : {"S1", "P", "S2"}) EXPECT_TRUE(contains(list, joint, Quantity::f)) << joint;
  for (const char* joint : {"G1", "G2"}) {
    EXPECT_TRUE(contains(list, joint, Quantity::N)) << joint;
    EXPECT_FALSE(contains(list, joint, Quantity::F)) << joint;
  }
}

// Telescopes whose ends are not known bear a normal force alone: where it vanishes their contact is lost, and the arcs
// that say so are those on which the witness sees it change its sign.
TEST(Vanishing, TheWitnessCountsLostContactOfGuidesForTheirForce) {
  const mechanism::Mechanism legs = corpus("rprpr_heavy_cylinders.yaml");
  core::LocusMap map = trace_loci(legs);
  const std::vector<numeric::TracedReaction> force = {{"S2", Quantity::N}};
  EXPECT_EQ(numeric::validate(legs, map, {40, 40}, force).disputed, 0u);
  std::erase_if(map.curves, [](const LocusCurve& curve) { return names(curve, "S2", Quantity::f); });
  EXPECT_GT(numeric::validate(legs, map, {40, 40}, force).disputed, 0u);
}

// Where P meets A2 the guide's axis is undefined and every numerator vanishes: Newton's method found the place to 1e-8,
// where |A| seemed to be none, and contact was said to be lost.
TEST(Vanishing, NoContactIsLostWhereAnAxisIsUndefined) {
  const mechanism::Mechanism leg = corpus("rrrpr_box_through_base.yaml");
  const core::LocusMap map = trace_loci(leg);
  EXPECT_FALSE(map.curves.empty());
  for (const core::IsolatedPoint& point : map.isolated_points)
    EXPECT_GT(std::hypot(point.at[0] - 1.25, point.at[1] - 0.25), 1e-3) << to_string(point.kind);
}

TEST(Vanishing, TheWitnessMissesWhatIsNotNamed) {
  const mechanism::Mechanism rail = corpus("prr2.yaml");
  core::LocusMap map = trace_loci(rail);
  std::erase_if(map.curves, [](const LocusCurve& curve) { return curve.kind == LocusKind::backlash; });
  const auto list = disputed(
      numeric::validate(rail, map, {40, 40}, {{"G1", Quantity::F}, {"G2", Quantity::F}, {"S1", Quantity::fy}}));
  EXPECT_TRUE(contains(list, "G1", Quantity::F));
  EXPECT_TRUE(contains(list, "G2", Quantity::F));
  EXPECT_FALSE(contains(list, "S1", Quantity::fy));
}

TEST(Vanishing, TheWitnessDisputesIdleSingularitiesThatAreExcited) {
  const mechanism::Mechanism rail = corpus("prr2.yaml");
  core::LocusMap map = trace_loci(rail);
  for (LocusCurve& curve : map.curves)
    if (curve.kind == LocusKind::direct_singularity) curve.excited = false;
  const numeric::ValidationReport report = numeric::validate(rail, map, {40, 40});
  ASSERT_FALSE(report.disputed_arcs.empty());
  for (const numeric::DisputedArc& arc : report.disputed_arcs) {
    EXPECT_TRUE(arc.unbounded);
    EXPECT_NEAR(arc.at[1], 0, 1e-9);
  }
}

/// Two cranks and rods, on one base point or mirrored.
std::string five_bar(const std::string& base, const std::array<std::string, 4>& lengths, const char* sides,
                     const std::string& force, bool weighs) {
  const std::string mass = weighs ? ", mass: 1/2" : "";
  return "format: 1\nname: symmetric\nworkspace: {x: [-9/4, 9/4], y: [-9/4, 9/4]}\npoints:\n  A1: [-(" + base +
         "), 0]\n  A2: [" + base + ", 0]\n  P: [x, y]\n  B1: {dyad: [A1, P], lengths: [" + lengths[0] + ", " +
         lengths[1] + "], side: " + (sides[0] == 'l' ? "left" : "right") + "}\n  B2: {dyad: [A2, P], lengths: [" +
         lengths[2] + ", " + lengths[3] + "], side: " + (sides[1] == 'l' ? "left" : "right") +
         "}\nlinks:\n  T1: {points: [A1, B1]" + mass + "}\n  S1: {points: [B1, P]" + mass +
         "}\n  T2: {points: [A2, B2]" + mass + "}\n  S2: {points: [B2, P]" + mass +
         "}\njoints:\n  A1: {revolute: [ground, T1], at: A1, actuated: true}\n  B1: {revolute: [T1, S1], at: B1}\n"
         "  P: {revolute: [S1, S2], at: P}\n  B2: {revolute: [T2, S2], at: B2}\n"
         "  A2: {revolute: [ground, T2], at: A2, actuated: true}\nend_effector: {link: S1, at: P}\nloads:\n"
         "  - {link: S1, at: P, force: " +
         force + "}\n" + (weighs ? "gravity: [0, -9.81]\n" : "");
}

/// Two rods on rails h apart, with blocks that are guided.
std::string rods(const std::string& first, const std::string& second, const std::string& h, const std::string& axis,
                 const std::string& force, bool weighs) {
  const std::string mass = weighs ? ", mass: 2/5" : "", block = weighs ? ", com: " : "";
  const auto com = [&](const char* point) { return weighs ? block + point : std::string(); };
  return "format: 1\nname: rods\nworkspace: {x: [-1, 1], y: [-5/4, 5/4]}\npoints:\n  R: [0, 0]\n  Q: [0, " + h +
         "]\n  P: [x, y]\n  S1: {slider: [R, " + axis + "], from: P, length: " + first +
         ", side: behind}\n  S2: {slider: [Q, " + axis + "], from: P, length: " + second +
         ", side: ahead}\nlinks:\n  c1: {points: [S1], inertia: 0" + mass + com("S1") + "}\n  r1: {points: [S1, P]" +
         mass + "}\n  r2: {points: [S2, P]" + mass + "}\n  c2: {points: [S2], inertia: 0" + mass + com("S2") +
         "}\njoints:\n  G1: {prismatic: [ground, c1], at: S1, axis: " + axis +
         ", actuated: true, clearance: {gap: 1e-5, half_length: 3/100, axial: 5e-6}}\n"
         "  S1: {revolute: [c1, r1], at: S1, clearance: {radial: 1e-5}}\n"
         "  P: {revolute: [r1, r2], at: P, clearance: {radial: 1e-5}}\n"
         "  S2: {revolute: [c2, r2], at: S2, clearance: {radial: 1e-5}}\n"
         "  G2: {prismatic: [ground, c2], at: S2, axis: " +
         axis +
         ", actuated: true, clearance: {gap: 1e-5, half_length: 3/100, axial: 5e-6}}\n"
         "end_effector: {link: r2, at: P}\nloads:\n  - {link: r2, at: P, force: " +
         force + "}\n" + (weighs ? "gravity: [0, -9.81]\n" : "");
}

void hold(const std::string& text) {
  SCOPED_TRACE(text);
  const mechanism::Mechanism mechanism = mechanism::parse_mechanism(text, "symmetric.yaml");
  const Validation validation = validate_loci(mechanism, {}, {40, 40});
  EXPECT_EQ(validation.report.disputed, 0u);
  EXPECT_GT(validation.report.held, 100u);
  EXPECT_TRUE(validation.report.disputed_arcs.empty());
}

// No false vanishing and no missed one: what the map says along each arc is what the reactions do beside it.
TEST(Vanishing, SymmetricDesignsHoldAgainstTheWitness) {
  hold(five_bar("0", {"1/2", "3/4", "1/2", "3/4"}, "rl", "[0, -20]", false));
  hold(five_bar("0", {"1/4", "1/2", "1/4", "1/2"}, "lr", "[3, 4]", false));
  hold(five_bar("0", {"3/4", "3/4", "1/2", "1"}, "lr", "[12, -5]", false));
  hold(five_bar("1/4", {"3/4", "1", "3/4", "1"}, "rl", "[0, -20]", false));
  hold(five_bar("1/2", {"1", "1", "1", "1"}, "rl", "[10, 0]", false));
  hold(five_bar("1/2", {"3/4", "1", "3/4", "1"}, "ll", "[0, -20]", true));
  hold(rods("3/4", "3/4", "0", "[1, 0]", "[0, -20]", false));
  hold(rods("1/2", "3/4", "0", "[1, 0]", "[3, 4]", true));
  hold(rods("1/2", "1/2", "1/4", "[1, 1]", "[10, -5]", true));
}

// Where weighed coaxial legs of equal links are folded, P is on their common joint: their direction is undefined there,
// and a zero of all forces there is none of a posture. Nothing around it is in doubt.
TEST(Vanishing, AZeroAtTheConeOfCoaxialLegsLeavesNoDoubt) {
  const core::LocusMap map = trace_loci(
      mechanism::parse_mechanism(five_bar("0", {"1/2", "1/2", "1/2", "1/2"}, "lr", "[0, -20]", true), "m.yaml"));
  EXPECT_TRUE(map.complete);
  EXPECT_TRUE(map.open.empty());
  EXPECT_TRUE(map.isolated_points.empty());
  for (const std::string& note : map.notes)
    EXPECT_EQ(note.find("neither proven nor excluded"), std::string::npos) << note;
}

/// The boundary of one leg passes the base of the other. Where it meets a curve there stayed open, and the curve, which
/// was not cut there, was judged by a point at rounding from the boundary: all of it was left out.
TEST(Vanishing, NothingIsLostBesideABaseOnABoundary) {
  const mechanism::Mechanism mechanism =
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/five_bar_base_on_boundary.yaml");
  LociRequest request;
  request.joints = {"B1"};
  const auto report = validate_loci(mechanism, request, {80, 80}).report;
  EXPECT_EQ(report.disputed, 0u);
  EXPECT_GT(report.held, 1000u);
}

// A gantry: the bridge slides along x and carries the tool that slides along y. With the load (F_x, F_y) at the tool
// the bridge's guide bears N = -F_y and T = y F_x about its middle, and an end lifts where h F_y = +-y F_x.
TEST(Vanishing, AGuideLosesContactWhereAnEndLifts) {
  const mechanism::Mechanism gantry = corpus("gantry.yaml");
  LociRequest request;
  const core::LocusMap map = trace_loci(gantry, request);
  const auto upper = on(map, "y - 1"), lower = on(map, "y + 1");
  ASSERT_EQ(upper.size(), 1u);
  ASSERT_EQ(lower.size(), 1u);
  EXPECT_EQ(upper.front()->kind, LocusKind::contact_loss);
  ASSERT_EQ(upper.front()->vanishing.size(), 1u);
  EXPECT_TRUE(names(*upper.front(), "bridge", Quantity::end_ahead));
  ASSERT_EQ(lower.front()->vanishing.size(), 1u);
  EXPECT_TRUE(names(*lower.front(), "bridge", Quantity::end_behind));
  EXPECT_TRUE(on(map, "y").empty());  // T = 0 alone is a component
  request.quantities = {Quantity::f, Quantity::M, Quantity::T};
  const core::LocusMap components = trace_loci(gantry, request);
  const auto component = on(components, "y");
  ASSERT_EQ(component.size(), 1u);
  EXPECT_EQ(component.front()->kind, LocusKind::component);
  EXPECT_EQ(validate_loci(gantry, {}, {40, 40}).report.disputed, 0u);

  // Where an end bears 5 N: (20 +- 20 y)/2 = +-5.
  request = {};
  request.min_force = 5;
  const core::LocusMap margins = trace_loci(gantry, request);
  for (const char* line : {"2*y - 1", "2*y + 1", "2*y - 3", "2*y + 3"}) {
    const LocusCurve* margin = of_kind(on(margins, line), LocusKind::margin);
    ASSERT_NE(margin, nullptr) << line;
    EXPECT_TRUE(names(*margin, "bridge", line[4] == '-' ? Quantity::end_ahead : Quantity::end_behind));
  }
}

// The axis changes its length from pose to pose, so that N is known over that length only.
TEST(Vanishing, TelescopesLoseContactWhereAnEndLifts) {
  const mechanism::Mechanism telescope = corpus("telescopes.yaml");
  const Validation validation = validate_loci(telescope, {}, {60, 60});
  EXPECT_EQ(validation.report.disputed, 0u);
  bool ahead = false, behind = false;
  for (const LocusCurve& curve : validation.map.curves) {
    ahead = ahead || names(curve, "S1", Quantity::end_ahead);
    behind = behind || names(curve, "S1", Quantity::end_behind);
  }
  EXPECT_TRUE(ahead && behind);
}

}  // namespace
}  // namespace clearloci
