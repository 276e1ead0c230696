// Designs that the numeric witness once disputed (tests/corpus/witness, tests/corpus/modes): the curves were wrong in
// some, the witness in others. Now it disputes nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/loci.hpp"
#include "analysis/zones.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

mechanism::Mechanism corpus(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/tests/corpus/" + name + ".yaml");
}

/// `certified`: every curve is to be.
void hold(const std::string& name, bool certified, LociRequest request = {}) {
  SCOPED_TRACE(name);
  const Validation validation = validate_loci(corpus(name), request, {60, 60});
  EXPECT_EQ(validation.report.disputed, 0u);
  EXPECT_GT(validation.report.held, 100u);
  for (const core::LocusCurve& curve : validation.map.curves)
    EXPECT_TRUE(curve.certified || !certified) << curve.id << " " << curve.factor;
}

/// One reaction alone, on a grid of so many nodes either way.
void hold_one(const std::string& name, const std::string& joint, core::Quantity quantity, LociRequest request = {},
              int nodes = 60, std::size_t held = 1000) {
  request.joints = {joint};
  request.quantities = {quantity};
  const Validation validation = validate_loci(corpus(name), request, {nodes, nodes});
  EXPECT_EQ(validation.report.disputed, 0u);
  EXPECT_GT(validation.report.held, held);
}

// They take more cells than the budget that curves have at first.
TEST(OnceDisputed, CurvesThatTakeManyCells) {
  hold("witness/coupler_five_bar", true);
  LociRequest request;
  request.joints = {"A2"};
  request.quantities = {core::Quantity::fx};
  hold("witness/stacked_5r", true, request);
}

// A telescopic leg that is nearly of no length: plain enclosures of what holds the lengths of two legs with weights are
// wide around it, and the budgets of cells ran out before they told anything.
TEST(OnceDisputed, ALegOfHardlyAnyLength) {
  const Validation validation = validate_loci(corpus("loci/three_rpr_turning_short_leg"), {}, {60, 60});
  EXPECT_EQ(validation.report.disputed, 0u);
  EXPECT_GT(validation.report.held, 100u);
  EXPECT_TRUE(validation.map.complete);
  for (const core::LocusCurve& curve : validation.map.curves) EXPECT_TRUE(curve.certified) << curve.id;
  for (const core::IsolatedPoint& point : validation.map.isolated_points) EXPECT_TRUE(point.certified);
}

// Other curves pass 1e-8 m beside the arcs, nearer than the ways towards them are long.
TEST(OnceDisputed, CurvesNearerThanTheWaysTowardsThem) {
  hold("certificates/rails_nearly_one_line", true, {.working_modes = {{-1, 1}}});
}

// A couple is small along the boundary beside its curve's end there: from farther away it seemed to vanish all along.
TEST(OnceDisputed, ACoupleThatIsSmallAlongTheBoundary) { hold("witness/couple_small_along_the_boundary", true); }

// A moment vanishes along the workspace boundary, where its curve is open.
TEST(OnceDisputed, AnOpenCurveAlongTheBoundary) {
  hold("certificates/open_beside_the_boundary", false, {.working_modes = {{1, -1}}});
}

// A root forty times as large as the box, whose rounding was taken for no convergence: a chord was accepted unmeasured.
TEST(OnceDisputed, AChordBesideABend) {
  LociRequest request;
  request.working_modes = {{-1, -1}};  // right, right
  hold_one("witness/coupler_with_large_roots", "A1", core::Quantity::fx, request, 200, 10000);
}

// fy vanishes along an arc 7e-10 rad beside the workspace boundary; seen from 1e-7 rad it tends to 9.4 N. The witness
// disputed the arc. What vanishes along the boundary itself is approached from one side as before.
TEST(OnceDisputed, AnArcNextToTheBoundary) {
  LociRequest request;
  request.joints = {"B2"};
  request.quantities = {core::Quantity::fy};
  const Validation validation = validate_loci(corpus("witness/component_beside_the_boundary"), request, {60, 60});
  EXPECT_EQ(validation.report.disputed, 0u);
  EXPECT_GT(validation.report.arcs_held, 2u);
}

// On the upper half of a circle both numerators and |A| vanish to the first order, so that fy tends to 30 N and more.
// With the angle of a torsion spring a numerator has no polynomial, and its orders along |A| = 0 were not asked for.
TEST(OnceDisputed, ReactionsThatAreFiniteOnTheSingularity) {
  const std::string name = "witness/mirrored_reaction_finite_on_the_singularity";
  LociRequest request;
  request.joints = {"A2"};
  request.quantities = {core::Quantity::fy};
  const Validation validation = validate_loci(corpus(name), request, {60, 60});
  EXPECT_EQ(validation.report.disputed, 0u);
  EXPECT_GT(validation.report.held, 500u);
  const core::LocusMap& map = validation.map;
  const auto is_on_circle = [](const core::Point2& p) { return std::abs(std::hypot(p[0], p[1]) - 0.375) < 1e-9; };
  bool is_singularity_traced = false;
  for (const core::LocusCurve& curve : map.curves)
    for (const core::Arc& arc : curve.arcs) {
      const bool is_along = std::all_of(arc.points.begin(), arc.points.end(), is_on_circle);
      EXPECT_EQ(is_along, curve.kind == core::LocusKind::direct_singularity) << curve.id << " " << curve.factor;
      is_singularity_traced = is_singularity_traced || is_along;
    }
  EXPECT_TRUE(is_singularity_traced);
  // On the lower half |A| is zero to the second order. It has a polynomial, though other factors have the angle.
  for (const core::LocusCurve& curve : map.curves)
    EXPECT_TRUE(curve.certified || curve.kind != core::LocusKind::direct_singularity) << curve.id;
}

// Its curve ends in a node on the workspace boundary: the end alone fails the last check, not the arcs that lead there.
TEST(OnceDisputed, ArcsThatLeadToANodeOnTheRim) {
  LociRequest request;
  request.joints = {"A2"};
  request.quantities = {core::Quantity::M};
  const Validation validation = validate_loci(corpus("witness/prrr_r_node_on_the_rim"), request, {100, 100});
  EXPECT_EQ(validation.report.disputed, 0u);
  double length = 0;
  for (const core::LocusCurve& curve : validation.map.curves)
    if (curve.kind == core::LocusKind::backlash) {
      EXPECT_FALSE(curve.certified);
      for (const core::Arc& arc : curve.arcs) length += arc.length;
    }
  EXPECT_NEAR(length, 6.71, 0.01);
  // Zones are no more certain than the curves that cut them.
  const core::Zones map = find_zones(corpus("witness/prrr_r_node_on_the_rim"), {request});
  EXPECT_FALSE(map.zones.empty());
  for (const core::Zone& zone : map.zones) EXPECT_FALSE(zone.certified) << zone.id;
  EXPECT_GE(map.modes.front().in_doubt, map.modes.front().workspace * (1 - 1e-9));  // areas are sums
  EXPECT_FALSE(map.loci.complete);
}

// The load is along the folded lower leg where the couple in A1 vanishes on the boundary: beside it the slopes of that
// leg's root are steep. Second-order enclosures told nothing there, and 40 of 73 arcs were withheld.
TEST(OnceDisputed, ACurveThatRunsIntoTheFoldOfALowerLeg) {
  const core::LocusMap map = trace_loci(corpus("loci/coupler_load_along_the_folded_leg"), {});
  EXPECT_TRUE(map.complete);
  for (const core::LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << curve.id << " " << curve.factor;
}

// Three divisors stand on one another, each of which may be 0 in large cells: bounds of slopes overflowed there, and
// all cells of the curves of A2 were taken for empty. Nothing was open.
TEST(OnceDisputed, CurvesThroughCellsWhoseBoundsOverflow) {
  LociRequest request;
  request.joints = {"A2"};
  request.quantities = {core::Quantity::fy, core::Quantity::M};
  const core::LocusMap map = trace_loci(corpus("loci/coupler_spring_curves_missing"), request);
  const auto is_told = [&](core::Quantity quantity, const core::Point2& at) {
    constexpr double near = 2e-3;
    const auto is_of = [&](const std::vector<core::Vanishing>& list) {
      return std::any_of(list.begin(), list.end(),
                         [&](const core::Vanishing& vanishing) { return vanishing.quantity == quantity; });
    };
    const auto is_near = [&](const core::Arc& arc) {
      return std::any_of(arc.points.begin(), arc.points.end(),
                         [&](const core::Point2& p) { return std::hypot(p[0] - at[0], p[1] - at[1]) < 10 * near; });
    };
    return std::any_of(map.curves.begin(), map.curves.end(),
                       [&](const core::LocusCurve& curve) {
                         return is_of(curve.vanishing) && std::any_of(curve.arcs.begin(), curve.arcs.end(), is_near);
                       }) ||
           std::any_of(map.open.begin(), map.open.end(), [&](const core::OpenRegion& region) {
             return is_of(region.vanishing) && region.lower[0] <= at[0] + near && at[0] - near <= region.upper[0] &&
                    region.lower[1] <= at[1] + near && at[1] - near <= region.upper[1];
           });
  };
  // Signs of reactions solved numerically change there.
  EXPECT_TRUE(is_told(core::Quantity::fy, {0.2276, -0.4849}));
  EXPECT_TRUE(is_told(core::Quantity::M, {-0.1640, -0.7301}));
}

// The crossings of curves of which no polynomial is computed were taken for unproven, and no zone was certified.
TEST(OnceDisputed, ZonesBetweenCurvesWithoutPolynomials) {
  const core::Zones map = find_zones(corpus("loci/stacked_curves_without_polynomials_cross"), {});
  // The smallest has 7e-9 m^2, beside a boundary with chords as coarse as it is wide; there alone M_A3 < 0.
  EXPECT_EQ(map.zones.size(), 14u);
  double sum = 0;
  for (const core::Zone& zone : map.zones) {
    EXPECT_TRUE(zone.certified) << zone.id;
    sum += zone.size;
  }
  EXPECT_NEAR(sum, map.modes.front().workspace, 1e-4 * sum);
  const std::vector<double>& thin = map.zones.back().sample;
  double couple = 0;
  const Model model = Model::read(source_dir() + "/tests/corpus/loci/stacked_curves_without_polynomials_cross.yaml");
  const Pose pose = solve_pose(model, thin);
  for (const JointReaction& joint : pose.reactions)
    for (const ReactionComponent& part : joint.components)
      if (joint.joint == "A3" && part.quantity == core::Quantity::M) couple = part.value;
  EXPECT_LT(couple, -1e-3);
}

// A base of a leg on a side of the box, where curves stay open; a limit keeps every pose away from it.
TEST(OnceDisputed, NothingIsOpenWhereNoPoseIs) {
  LociRequest request;
  request.min_force = 50;
  const core::LocusMap map = trace_loci(corpus("loci/rprpr_base_beyond_a_limit"), request);
  EXPECT_TRUE(map.complete);
  EXPECT_TRUE(map.open.empty());
  for (const core::LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << curve.id << " " << curve.factor;
}

// Two zones that meet in one point, where a side of the box touches the boundary, were one with a wrong sign.
TEST(OnceDisputed, ZonesThatASideOfTheBoxTellsApart) {
  const core::Zones map = find_zones(corpus("witness/prrr_r_pinched_by_a_side"), {});
  EXPECT_EQ(map.zones.size(), 7u);
  for (const core::Zone& zone : map.zones) EXPECT_TRUE(zone.certified) << zone.id;
  // Left and right of (0, -1/4).
  const auto area_about = [&](double area) {
    return std::any_of(map.zones.begin(), map.zones.end(),
                       [&](const core::Zone& zone) { return std::abs(zone.size - area) < 1e-6; });
  };
  EXPECT_TRUE(area_about(0.134880093));
  EXPECT_TRUE(area_about(0.014809826));
}

// The normal force of a guide has the factor x twice, |A| once, exactly: no rounding hides its even zero.
TEST(OnceDisputed, AnEvenZeroBesideASingularity) {
  LociRequest request;
  request.all_working_modes = true;
  hold_one("witness/one_rail_double_zero", "G1", core::Quantity::N, request);
}

// A numerator that vanishes with one factor of |A|, a twentieth of an edge beside a zero of the other one.
TEST(OnceDisputed, SingularitiesWithinOneEdge) {
  hold_one("witness/stacked_5r_close_singularities", "A1", core::Quantity::fx);
}

// |A| vanishes twice within a sixteenth of an edge; the force flips at one of the two places and vanishes nowhere near.
TEST(OnceDisputed, TwoSingularitiesThatHideTheirSigns) {
  hold_one("witness/stacked_5r_hidden_singularities", "B2", core::Quantity::fy);
}

// Where P is on A2 its dyad has no elbow, and numerators multiplied by what it divides by are zero: that is no point of
// a locus, and was one to the exact engine.
TEST(OnceDisputed, AnElbowThatIsNowhere) {
  LociRequest request;
  request.joints = {"A3"};
  request.quantities = {core::Quantity::M};
  request.engine = loci::Engine::exact;
  EXPECT_TRUE(trace_loci(corpus("witness/stacked_5r_on_a_base"), request).isolated_points.empty());
}

// Both components of A2 nearly vanish together along a curve: one halving leaves more cells than the budget, and the
// next ones ever fewer.
TEST(OnceDisputed, APlaceThatTakesManyCells) {
  const core::LocusMap map = trace_loci(corpus("witness/stacked_5r"));
  for (const core::LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << curve.id;
  EXPECT_TRUE(map.notes.empty()) << map.notes.front();
}

// P on A2, where leg 2 has no elbow, ends the curves that reach it whether or not a side of the box passes through it.
TEST(OnceDisputed, AnElbowThatIsNowhereOnASideOfTheBox) {
  for (const core::Rational& upper : {core::Rational(1, 2), core::Rational(3, 2)}) {
    mechanism::Mechanism m = corpus("witness/stacked_5r_on_a_base");
    m.coordinates[1].upper = upper;
    int singular = 0, lost = 0;
    for (const core::LocusCurve& curve : trace_loci(m).curves)
      for (const core::Arc& arc : curve.arcs)
        for (const std::size_t end : {0u, 1u}) {
          const core::Point2& at = end == 0 ? arc.points.front() : arc.points.back();
          if (std::hypot(at[0] - 1.25, at[1] - 0.5) > 1e-9) continue;
          const bool is_singular = curve.kind == core::LocusKind::direct_singularity;
          EXPECT_EQ(arc.ends[end], is_singular ? core::ArcEnd::boundary : core::ArcEnd::direct_singularity) << curve.id;
          ++(is_singular ? singular : lost);
        }
    EXPECT_GE(singular, 1);
    EXPECT_GE(lost, 1);
  }
}

// Numerators and |A| vanish together where the parallelogram is flat.
TEST(OnceDisputed, AParallelogramOnALeg) {
  hold("modes/five_bar_parallelogram", false);
  // Either side of the fold has the other's curves there, under one name.
  const core::LocusMap map = trace_loci(corpus("modes/five_bar_parallelogram"));
  const auto flat = [&](core::LocusKind kind) {
    return std::count_if(map.curves.begin(), map.curves.end(), [&](const core::LocusCurve& curve) {
      return curve.kind == kind && curve.cause == "B, C, D aligned";
    });
  };
  EXPECT_EQ(flat(core::LocusKind::direct_singularity), 2);  // the two circles on which B is on the line A, D
  EXPECT_EQ(flat(core::LocusKind::workspace_boundary), 2);
}

// N and T of a heavy cylinder's guide share a line over the tower alone: upright, it bears nothing across itself.
TEST(OnceDisputed, WhatAGuidesForcesShareOverTheRoots) {
  hold("witness/rprpr_upright_cylinders", true);
  const core::LocusMap map = trace_loci(corpus("witness/rprpr_upright_cylinders"));
  for (const std::string joint : {"S1", "S2"}) {
    const auto lifts = [&](const core::LocusCurve& curve, core::Quantity end) {
      return std::any_of(curve.vanishing.begin(), curve.vanishing.end(),
                         [&](const core::Vanishing& v) { return v.joint == joint && v.quantity == end; });
    };
    const auto curve = std::find_if(map.curves.begin(), map.curves.end(), [&](const core::LocusCurve& c) {
      return lifts(c, core::Quantity::end_ahead) && lifts(c, core::Quantity::end_behind);
    });
    ASSERT_NE(curve, map.curves.end()) << joint;
    ASSERT_EQ(curve->arcs.size(), 1u);
    EXPECT_NEAR(curve->arcs.front().length, 0.75, 1e-9);
    EXPECT_EQ(curve->arcs.front().points.front()[0], joint == "S1" ? -0.5 : 0.5);
  }
}

// A guide beside its pin changes sides where the pin passes through the point that it is placed by.
TEST(OnceDisputed, AFoldOfAnOffset) {
  hold("witness/prrrp_guide_beside_its_pin", true);
  const core::Zones map = find_zones(corpus("witness/prrrp_guide_beside_its_pin"), {});
  const auto fold = std::find_if(map.loci.curves.begin(), map.loci.curves.end(), [](const core::LocusCurve& curve) {
    return curve.cause == "R on S1, where K has no place";
  });
  ASSERT_NE(fold, map.loci.curves.end());
  EXPECT_EQ(fold->kind, core::LocusKind::workspace_boundary);
  double length = 0, area = 0;
  for (const core::Arc& arc : fold->arcs) length += arc.length;
  EXPECT_NEAR(length, std::acos(0.1) / 2 - std::acos(0.8) / 2, 1e-6);  // of the circle, y from -0.4 to -0.05, x > 0
  for (const core::Zone& zone : map.zones) {
    EXPECT_TRUE(zone.certified) << zone.id;
    area += zone.size;
  }
  EXPECT_NEAR(area, 1.2 * 0.35, 1e-6);
}

// The middle of an arc's single chord is not on the curve.
TEST(OnceDisputed, AShortArc) { hold("witness/mirrored_short_arc", true); }

// Bases a billionth of the legs apart: the exact engine cannot tell signs there and says so.
TEST(OnceDisputed, LegsThatAreNearlyCoaxial) { hold("witness/kite_near_coaxial", false); }

// The link at A3 is parallel to x along a circle of which both ends of its height have a maximum: fy vanishes there and
// keeps its sign.
TEST(OnceDisputed, ZerosWithoutAChangeOfSign) {
  LociRequest request;
  request.all_working_modes = true;
  hold_one("witness/stacked_5r_touching_zero", "Q", core::Quantity::fy, request);
}

void all_is_certified(const std::string& name) {
  SCOPED_TRACE(name);
  const core::LocusMap map = trace_loci(corpus(name), {});
  EXPECT_TRUE(map.complete);
  EXPECT_TRUE(map.open.empty());
  EXPECT_FALSE(map.curves.empty());
  for (const core::LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << curve.id << " " << curve.factor;
  for (const core::IsolatedPoint& point : map.isolated_points) EXPECT_TRUE(point.certified);
}

void all_zones_are_certified(const core::Zones& map) {
  ASSERT_FALSE(map.zones.empty());
  double sum = 0, workspace = 0;
  for (const core::Zone& zone : map.zones) {
    EXPECT_TRUE(zone.certified) << zone.id;
    sum += zone.size;
  }
  for (const auto& mode : map.modes) workspace += mode.workspace;
  EXPECT_NEAR(sum, workspace, 1e-4 * workspace);
}

void all_zones_are_certified(const std::string& name, const ZoneRequest& request = {}) {
  SCOPED_TRACE(name);
  all_zones_are_certified(find_zones(corpus(name), request));
}

// A limit of the angle at the elbow keeps the pin from the base of legs of equal lengths. Computed from the elbow the
// cosine of that angle is divided by the distance, so that it excluded nothing there.
TEST(OnceDisputed, NothingIsOpenAtABaseBeyondALimit) { all_is_certified("loci/rrrpr_limit_keeps_from_the_base"); }

// The direction of a link was read off the foot of its guide, 10 um beside its pin, though the way along it is longer:
// rounding left loci of one cylinder open in all of the box.
TEST(OnceDisputed, GuidesThatPassTheirPinsClosely) { all_is_certified("loci/rprpr_guides_beside_pins"); }

// |A| vanishes all along the boundary, and the force's numerators at one place of it: both branches of the margin curve
// leave there along the tangent. 6421 arcs were found, and 4 places stayed open.
TEST(OnceDisputed, AMarginsNodeOnASingularBoundary) {
  LociRequest request;
  request.min_force = 4;
  const core::LocusMap map = trace_loci(corpus("loci/coaxial_margin_node_on_a_singular_boundary"), request);
  EXPECT_TRUE(map.complete);
  EXPECT_TRUE(map.open.empty());
  for (const core::LocusCurve& curve : map.curves) {
    EXPECT_TRUE(curve.certified) << curve.id;
    EXPECT_LE(curve.arcs.size(), 10u) << curve.id;
  }
}

// N = |A| = 0 within the least distance between a base and the end effector: no pose is there, and margin points were
// listed, for their curves know nothing of that limit.
TEST(OnceDisputed, NoMarginPointIsBeyondALimit) {
  LociRequest request;
  request.min_force = 10;
  request.working_modes = {{-1, 1}};  // right, left
  const core::LocusMap map = trace_loci(corpus("loci/five_bar_margin_node_beyond_a_limit"), request);
  EXPECT_TRUE(map.complete);
  EXPECT_TRUE(map.isolated_points.empty());
  const auto is_margin = [](const core::LocusCurve& curve) { return curve.kind == core::LocusKind::margin; };
  EXPECT_EQ(std::count_if(map.curves.begin(), map.curves.end(), is_margin), 2);
  for (const core::LocusCurve& curve : map.curves) EXPECT_TRUE(curve.certified) << curve.id;
}

// Over motor angles the elbows meet at irrational half tangents: no chart was made around these places.
TEST(OnceDisputed, ElbowsThatMeetOverMotorAngles) { all_is_certified("loci/five_bar_angles_elbows_meet"); }

// Where a leg is stretched on |A| = 0 forces vanish together with it: that there is no limit was not proven.
TEST(OnceDisputed, ForcesWithoutLimit) { all_is_certified("loci/five_bar_no_limit_on_the_boundary"); }

// All along the slit of a torsion spring, which narrows to nothing at the boundary of its dyad, cells of the motor's
// couple had to be narrower than the slit.
TEST(OnceDisputed, ATorsionSpringsSlitAtTheBoundary) { all_is_certified("loci/five_bar_torsion_slit_at_the_boundary"); }

// Along |A| = 0 the motor's couple is steep, so that the locus and both margin curves run side by side.
TEST(OnceDisputed, ZonesBetweenALocusAndItsMargins) {
  ZoneRequest request;
  request.loci.min_couple = 1;
  all_zones_are_certified("loci/stacked_margins_beside_a_locus", request);
}

// The contact losses of both legs are parts of one curve, two circles that touch at the common base: parts of either
// pass there and touch.
TEST(OnceDisputed, ZonesBetweenTwoFactorsOfOneCurveThatTouch) {
  all_zones_are_certified("loci/kite_contact_losses_touch_at_the_base");
}

// Both links are parallel to the load on one pair of lines, each on another line of the mode: points of the one were
// moved onto the other factor.
TEST(OnceDisputed, ZonesBetweenTwoFactorsOfOneCurveApart) {
  ZoneRequest request;
  request.loci.all_working_modes = true;
  all_zones_are_certified("loci/one_rail_two_factors_of_one_curve", request);
}

// Loci end on a boundary 1e-7 of the box from where it crosses another one: they were taken to go on to that crossing,
// which is as near to their curve as rounding tells, and no zone was certified.
TEST(OnceDisputed, ZonesWhereLociEndBesideACornerOfTheWorkspace) {
  ZoneRequest request;
  request.loci.all_working_modes = true;
  all_zones_are_certified("loci/five_bar_loci_end_beside_a_corner", request);
}

/// What is in doubt is between curves that meet nearer than their order is told, and less than this.
void all_zones_but_a_circle_are_certified(const std::string& name, const ZoneRequest& request, double most_in_doubt) {
  SCOPED_TRACE(name);
  const core::Zones map = find_zones(corpus(name), request);
  all_zones_are_certified(map);
  for (const core::Zone& zone : map.zones) EXPECT_EQ(zone.outer.front(), zone.outer.back()) << zone.id;
  for (const core::ZonedMode& mode : map.modes) {
    EXPECT_GT(mode.in_doubt, 0);
    EXPECT_LT(mode.in_doubt, most_in_doubt);
  }
  EXPECT_FALSE(map.loci.complete);
  EXPECT_TRUE(std::any_of(map.loci.notes.begin(), map.loci.notes.end(), [](const std::string& note) {
    return note.find("nearer than their order is told") != std::string::npos;
  }));
}

// Two nodes on the boundary are 2e-7 m apart, and the curves that leave them along it 1e-15 m, where they are told by
// no circle about one node: no zone was certified.
TEST(OnceDisputed, ZonesBesideCurvesThatLeaveNearNodesAlongTheBoundary) {
  ZoneRequest request;
  request.loci.working_modes = {{-1, -1}, {1, -1}};
  all_zones_but_a_circle_are_certified("loci/prrr_r_curves_leave_along_the_boundary", request, 1e-11);
}

// Margin curves leave a base side by side and cross 1.3e-6 m from it.
TEST(OnceDisputed, ZonesBesideABaseNearWhichMarginsCross) {
  ZoneRequest request;
  request.loci.min_force = 40;
  request.loci.working_modes = {{-1, -1}};
  all_zones_but_a_circle_are_certified("loci/five_bar_margins_cross_beside_a_base", request, 1e-11);
}

// The spring's angle is that of a way whose coefficients are 1e-72, since a base is at sqrt(2)/8 + 3/4: its enclosures
// had no digits left. Two zeros were missing, and none was certified.
TEST(OnceDisputed, ATorsionSpringOverIrrationalBases) {
  LociRequest request;
  request.working_modes = {{-1}};  // right
  const Validation validation = validate_loci(corpus("springs/four_bar_torsion_over_a_root"), request, {4000, 1});
  EXPECT_EQ(validation.report.disputed, 0u);
  EXPECT_EQ(validation.map.isolated_points.size(), 9u);
  for (const core::IsolatedPoint& point : validation.map.isolated_points)
    EXPECT_TRUE(point.certified) << point.at[0] << " " << point.cause;
}

// Forces along guides have a root of the tower each, which modes over an angle do not tell: they were read beyond their
// ends, and the program crashed.
TEST(OnceDisputed, ForcesWithRootsOfTheirOwnOverAnAngle) { hold("loci/rpr_turning_forces_with_roots", true); }

// |A| is a root alone and vanishes along the boundary: beside it chords over the angles found no vertex of the curve.
TEST(OnceDisputed, ASingularBoundaryOverMotorAngles) {
  LociRequest request;
  request.all_working_modes = true;
  hold("loci/five_bar_angles_singular_boundary", true, request);
}

}  // namespace
}  // namespace clearloci
