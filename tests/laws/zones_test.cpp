// Discontinuity-free zones (method.md section 9): the paper's zones, areas known in closed form, and what must hold for
// every design. CLEARLOCI_DESIGNS=n in the environment tries n random designs.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>

#include "analysis/zones.hpp"
#include "core/errors.hpp"
#include "loci/zones/zones.hpp"
#include "numeric/reactions.hpp"
#include "tests/laws/design_texts.hpp"
#include "tests/laws/distance_to.hpp"
#include "tests/laws/task_designs.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using test::distance_to;

mechanism::Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
}

bool inside(const core::Polyline& ring, const core::Point2& at) {
  bool result = false;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const core::Point2 &a = ring[i - 1], &b = ring[i];
    if ((a[1] > at[1]) != (b[1] > at[1]) && at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1]))
      result = !result;
  }
  return result;
}

bool inside(const core::Zone& zone, const core::Point2& at) {
  return inside(zone.outer, at) && std::none_of(zone.holes.begin(), zone.holes.end(),
                                                [&](const core::Polyline& hole) { return inside(hole, at); });
}

double total_area(const core::Zones& map, const core::WorkingMode& mode) {
  double total = 0;
  for (const core::Zone& zone : map.zones) total += zone.mode == mode ? zone.size : 0;
  return total;
}

bool certified(const core::Zones& map) {
  return std::all_of(map.zones.begin(), map.zones.end(), [](const core::Zone& zone) { return zone.certified; });
}

/// At random poses of every zone the independent witness finds the zone's signs, and the inscribed circle is inside.
void expect_one_sign_a_zone(const mechanism::Mechanism& mechanism, const core::Zones& map, std::mt19937& random) {
  const numeric::NumericModel model = numeric::compile(mechanism);
  for (const core::Zone& zone : map.zones) {
    SCOPED_TRACE(zone.id);
    EXPECT_NE(zone.assembly_mode, 0);
    EXPECT_TRUE(inside(zone, {zone.sample[0], zone.sample[1]}));
    // A zone no wider than a few tolerances may be too thin for a circle.
    double border = 0;
    for (const core::ZoneBorder& part : zone.borders) border += part.length;
    EXPECT_TRUE(zone.ball.radius > 0 || zone.size < 4 * map.loci.tolerance * border);
    EXPECT_NEAR(distance_to(zone.outer, {zone.ball.centre[0], zone.ball.centre[1]}), zone.ball.radius,
                zone.holes.empty() && zone.isolated_points.empty() ? 3 * map.loci.tolerance : 10);
    const std::vector<int> sides = numeric::dyad_signs(model, map.loci.tower, zone.mode);
    core::Point2 low = zone.outer.front(), high = low;
    for (const core::Point2& p : zone.outer)
      for (std::size_t i = 0; i < 2; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    int seen = 0;
    for (int i = 0; i < 400 && seen < 20; ++i) {
      const auto between = [&](std::size_t c) {
        return std::uniform_real_distribution<double>(low[c], high[c])(random);
      };
      const core::Point2 at = {between(0), between(1)};
      if (!inside(zone, at) || distance_to(zone.outer, at) < 10 * map.loci.tolerance) continue;
      if (std::any_of(zone.holes.begin(), zone.holes.end(),
                      [&](const auto& hole) { return distance_to(hole, at) < 10 * map.loci.tolerance; }))
        continue;
      ++seen;
      const numeric::Posture posture = numeric::posture(model, at, sides);
      ASSERT_TRUE(posture.reachable()) << at[0] << " " << at[1];
      const numeric::Reactions reactions = numeric::solve_reactions(model, posture);
      EXPECT_EQ(reactions.determinant > 0 ? 1 : -1, zone.assembly_mode) << at[0] << " " << at[1];
      for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
        const mechanism::Unknown& unknown = model.unknowns[k];
        for (const auto& [reaction, sign] : zone.signs) {
          if (reaction.joint != mechanism.joints[static_cast<std::size_t>(unknown.joint)].name) continue;
          if (reaction.quantity != unknown.quantity) continue;
          const double value = reactions.values[static_cast<Eigen::Index>(k)];
          // No sign: the reaction is zero whatever the pose, as in a massless telescope's guide.
          if (sign == 0) {
            EXPECT_LE(std::abs(value), 1e-9 * reactions.values.cwiseAbs().maxCoeff()) << reaction.joint;
          } else {
            EXPECT_EQ(value > 0 ? 1 : -1, sign) << reaction.joint << " at " << at[0] << " " << at[1];
          }
        }
      }
    }
  }
}

/// The zones of each mode, and what is said to be in doubt, make up its workspace as reached poses of a grid measure
/// it; a pose that is not beside a curve lies in one zone if it is reached, and in none if not.
void expect_partition(const mechanism::Mechanism& mechanism, const core::Zones& map, std::mt19937& random) {
  const numeric::NumericModel model = numeric::compile(mechanism);
  const core::LocusMap& loci = map.loci;
  core::Point2 low{}, high{};
  for (std::size_t c = 0; c < 2; ++c) low[c] = core::to_double(loci.lower[c]), high[c] = core::to_double(loci.upper[c]);
  for (const core::ZonedMode& account : map.modes) {
    const std::vector<int> sides = numeric::dyad_signs(model, loci.tower, account.mode);
    const auto reached = [&](const core::Point2& at) { return numeric::reachable(model, at, sides); };
    // The error of counting nodes is half a cell for every cell that the rim crosses, and on the average far less.
    constexpr int n = 200;
    const double dx = (high[0] - low[0]) / n, dy = (high[1] - low[1]) / n;
    int inside_it = 0, rim = 0;
    std::vector<bool> row(n), below(n);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) {
        const auto here = static_cast<std::size_t>(k);
        row[here] = reached({low[0] + (k + 0.5) * dx, low[1] + (i + 0.5) * dy});
        inside_it += row[here] ? 1 : 0;
        if (i > 0 && row[here] != below[here]) ++rim;
        if (k > 0 && row[here] != row[here - 1]) ++rim;
      }
      below = row;
    }
    const double counted = inside_it * dx * dy, doubt = (0.25 * rim + 4) * dx * dy;
    EXPECT_NEAR(account.workspace, counted, doubt);
    EXPECT_NEAR(total_area(map, account.mode), counted, doubt);
    EXPECT_EQ(account.in_doubt, 0);
    const double size = std::max(high[0] - low[0], high[1] - low[1]);
    for (int i = 0; i < 200; ++i) {
      const auto between = [&](std::size_t c) {
        return std::uniform_real_distribution<double>(low[c], high[c])(random);
      };
      const core::Point2 at = {between(0), between(1)};
      const auto count = std::count_if(map.zones.begin(), map.zones.end(), [&](const core::Zone& zone) {
        return zone.mode == account.mode && inside(zone, at);
      });
      const long wanted = reached(at) ? 1 : 0;
      const bool beside = std::any_of(loci.curves.begin(), loci.curves.end(), [&](const core::LocusCurve& curve) {
        return std::any_of(curve.arcs.begin(), curve.arcs.end(),
                           [&](const core::Arc& arc) { return distance_to(arc.points, at) < 1e-4 * size; });
      });
      if (!beside) {
        EXPECT_EQ(count, wanted) << at[0] << " " << at[1];
      }
    }
  }
}

// Once open: in the base of a cylinder, where |A| vanishes in either mode on a curve of its own; where what a curve
// with long coefficients leaves of a product was too small to have a sign; along a boundary on which numerators are
// zero with the root though no term of them has it as a factor; along the slit of a torsion spring; in slivers beside
// the boundary, whose chords have their middles beyond or far from the point amid them, or are crossed by its chords;
// where a curve that two factors have parts of crosses itself, in a part of each; where a locus passes a corner of the
// workspace by less than what counts as one place, so that it is followed from no point of its own.
TEST(Zones, OfTheCorpusAreCertified) {
  for (const std::string name :
       {"rrrpr_singularities_cross_at_base", "five_bar_long_coefficients", "minitaur_foot", "rrrpr_torsion_slit",
        "rrrpr_sliver_beside_a_boundary", "prrrp_sliver_along_a_boundary", "three_rrr_sliver_beside_a_boundary",
        "one_rail_curve_crosses_itself", "coupler_locus_beside_a_corner"}) {
    SCOPED_TRACE(name);
    const core::Zones map =
        find_zones(mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/" + name + ".yaml"), {});
    EXPECT_TRUE(certified(map));
    EXPECT_FALSE(map.zones.empty());
  }
}

// Beside a locus that leaves the boundary at a tangent, where chords of the usual tolerance are as coarse as it is
// wide.
TEST(Zones, AreTracedFinerWhereOneIsThinnerThanItsChords) {
  const core::Zones map =
      find_zones(mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/prrr_r_sliver_at_a_tangent.yaml"), {});
  EXPECT_TRUE(certified(map));
  EXPECT_EQ(map.zones.size(), 24u);
  for (const core::ZonedMode& mode : map.modes) EXPECT_EQ(mode.in_doubt, 0);
}

/// Designs of the corpus, certified with so many zones and the tolerance asked for.
void expect_no_finer_loci(const std::vector<std::pair<std::string, std::size_t>>& designs, std::mt19937 random) {
  for (const auto& [name, zones] : designs) {
    SCOPED_TRACE(name);
    const mechanism::Mechanism mechanism =
        mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/" + name + ".yaml");
    const core::Zones map = find_zones(mechanism);
    EXPECT_TRUE(certified(map));
    EXPECT_EQ(map.zones.size(), zones);
    EXPECT_EQ(map.loci.tolerance, LociRequest().tolerance);
    expect_one_sign_a_zone(mechanism, map, random);
    expect_partition(mechanism, map, random);
  }
}

// Once open, or traced anew with finer and finer chords: loci touch the boundary beside its crossing with another one,
// where no point near a locus can be moved onto it; a locus runs next to a boundary that it does not meet.
TEST(Zones, BesideBoundariesNeedNoFinerLoci) {
  expect_no_finer_loci({{"coupler_loci_touch_boundaries", 22}, {"coupler_locus_beside_a_boundary", 18}},
                       std::mt19937(20110579));
}

// Once taken for none, traced anew three times for it: slivers between a locus and the boundary, at an angle to the
// lines on which points of them are looked for; and beside a touch of two boundaries that |A| = 0 passes through, the
// first chord behind which was 2 mm off.
TEST(Zones, OfSliversAndBehindATouchNeedNoFinerLoci) {
  expect_no_finer_loci({{"prrr_r_slivers_at_an_angle", 17}, {"prrr_r_singularity_through_a_touch", 9}},
                       std::mt19937(20110580));
}

/// That two curves are one follows from what they are, not from their vertices: zones of a picture are the same when
/// every vertex is moved by a few roundings.
TEST(Zones, OfASketchDoNotDependOnTheRoundingOfVertices) {
  std::mt19937 random(20261126);
  std::uniform_int_distribution<int> steps(-4, 4);
  for (const char* name : {"five_bar", "five_bar_weights", "five_bar_generic", "five_bar_coupler"}) {
    SCOPED_TRACE(name);
    const mechanism::Mechanism mechanism = example(name);
    TracedProblem traced = trace_problem(mechanism, {}, {}, TraceEffort::sketch);
    const auto areas = [&] {
      std::vector<double> list;
      for (const core::Zone& zone : loci::zones(traced.problem, traced.map, true).map.zones) list.push_back(zone.size);
      return list;
    };
    const std::vector<double> drawn = areas();
    EXPECT_GE(drawn.size(), 2U);
    for (core::LocusCurve& curve : traced.map.curves)
      for (core::Arc& arc : curve.arcs)
        for (core::Point2& at : arc.points)
          for (double& c : at) c += steps(random) * std::numeric_limits<double>::epsilon();
    const std::vector<double> moved = areas();
    ASSERT_EQ(moved.size(), drawn.size());
    for (std::size_t z = 0; z < drawn.size(); ++z) EXPECT_NEAR(moved[z], drawn[z], traced.map.tolerance) << z;
  }
}

// Once not in order: two loci pass the place where the ends of a spring meet, one of them twice.
TEST(Zones, ThroughAPlaceWhereASpringHasNoLength) {
  expect_no_finer_loci({{"three_rpr_curves_through_ends_of_a_spring", 22}}, std::mt19937(20110581));
}

TEST(PaperZones, FourSurfacesOfTheAssemblyModeOfFig9AndTheSliversOfTheOther) {
  const core::Zones map = find_zones(example("five_bar"));
  const auto home = std::find_if(map.zones.begin(), map.zones.end(), [](const core::Zone& zone) {
    return inside(zone, {0.25, -0.7});
  });
  ASSERT_NE(home, map.zones.end());
  int same = 0, other = 0;
  for (const core::Zone& zone : map.zones) ++(zone.assembly_mode == home->assembly_mode ? same : other);
  EXPECT_EQ(same, 4);
  EXPECT_EQ(other, 6);
}

TEST(PaperZones, AreasAndCirclesAreThoseOfTheCircles) {
  const core::Zones map = find_zones(example("five_bar"));
  // The lens of two unit circles, 1/2 apart.
  const double lens = 2 * std::acos(0.25) - 0.25 * std::sqrt(4 - 0.25);
  EXPECT_NEAR(total_area(map, map.zones.front().mode), lens, 1e-6 * lens);
  // Between the two circles of radius 1/2 about (0, 1/2) and (1/2, 1/2): touched in two points only.
  const auto upper = std::find_if(map.zones.begin(), map.zones.end(), [](const core::Zone& zone) {
    return inside(zone, {0.25, 0.5});
  });
  ASSERT_NE(upper, map.zones.end());
  const double overlap = 2 * (0.25 * std::acos(0.5)) - 0.25 * std::sqrt(1 - 0.25);
  EXPECT_NEAR(upper->size, overlap, 1e-6 * overlap);
  EXPECT_NEAR(upper->ball.radius, 0.25, 1e-9);
  EXPECT_NEAR(upper->ball.centre[1], 0.5, 1e-6);
}

class ZonesOfExamples : public testing::TestWithParam<std::string> {};

TEST_P(ZonesOfExamples, HaveOneSignEachInEveryMode) {
  const mechanism::Mechanism mechanism = example(GetParam());
  LociRequest request;
  request.all_working_modes = true;
  const core::Zones map = find_zones(mechanism, {request});
  ASSERT_FALSE(map.zones.empty());
  EXPECT_TRUE(certified(map));
  std::mt19937 random(20110577);
  expect_one_sign_a_zone(mechanism, map, random);
  expect_partition(mechanism, map, random);
  // However many loci cut it, a workspace has one area.
  request.joints = {mechanism.joints.front().name};
  request.quantities = {core::Quantity::M};
  const core::Zones coarse = find_zones(mechanism, {request});
  for (const core::Zone& zone : map.zones) {
    const double area = total_area(map, zone.mode);
    EXPECT_NEAR(total_area(coarse, zone.mode), area, 1e-6 * area);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ZonesOfExamples,
                         testing::Values("five_bar", "five_bar_generic", "five_bar_horizontal", "five_bar_inclined",
                                         "five_bar_isolated", "five_bar_weights"),
                         [](const auto& test) { return test.param; });

TEST(ZonesOfRandomDesigns, PartitionTheWorkspaceAndHaveOneSignEach) {
  const char* wanted = std::getenv("CLEARLOCI_DESIGNS");
  const int designs = wanted != nullptr ? std::atoi(wanted) : 12;
  std::mt19937 random(20110578);
  int proven = 0;
  for (int i = 0; i < designs; ++i) {
    const test::FiveBarDesign design = test::random_five_bar(random, i % 4 == 3);
    SCOPED_TRACE(design.text());
    const mechanism::Mechanism mechanism = mechanism::parse_mechanism(design.text(), "random.yaml");
    const core::Zones map = find_zones(mechanism);
    if (certified(map))
      ++proven, expect_one_sign_a_zone(mechanism, map, random), expect_partition(mechanism, map, random);
  }
  // A weighted design in a hundred or so has curves that run closer together than doubles can tell.
  EXPECT_GE(proven, designs - designs / 50 - 1);
}

// Five-bars, with a coupler too, on sliders and on cylinders, platforms: half of them on the lattice.
TEST(ZonesOfRandomDesigns, OfOtherFamiliesPartitionTheWorkspace) {
  const char* wanted = std::getenv("CLEARLOCI_DESIGNS");
  const int designs = wanted != nullptr ? std::atoi(wanted) : 2 * test::task_design_kinds;
  int proven = 0, refused = 0;
  for (int i = 0; i < designs; ++i) {
    std::mt19937 random(20110580U + static_cast<unsigned>(i));
    const bool lattice = (i / test::task_design_kinds) % 2 == 0;
    const std::string text = test::random_design(random, i % test::task_design_kinds, lattice);
    SCOPED_TRACE(text);
    try {
      const mechanism::Mechanism mechanism = mechanism::parse_mechanism(text, "random.yaml");
      LociRequest request;
      request.deadline = std::chrono::steady_clock::now() + std::chrono::seconds(15);
      const core::Zones map = find_zones(mechanism, {request});
      if (!map.loci.complete || !certified(map)) continue;
      ++proven;
      expect_one_sign_a_zone(mechanism, map, random);
      expect_partition(mechanism, map, random);
    } catch (const core::InputError&) {
      ++refused;  // singular in every pose, or out of reach in the whole box
    } catch (const core::LimitReached&) {
      continue;  // its zones are not known then: nothing is claimed
    }
  }
  // Else the law would be about few of them.
  EXPECT_GE(proven, (designs - refused) / 2);
}

// N of S2 vanishes on a ray from A2: a guide whose ends are not known loses no contact there, so the ray cuts no zone,
// and the zones that it crosses have no sign of N.
TEST(Zones, HaveNoSignOfWhatChangesInsideThem) {
  const mechanism::Mechanism rprpr =
      mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/rprpr_component_crosses_a_zone.yaml");
  LociRequest asked;
  asked.quantities = {core::Quantity::N, core::Quantity::T, core::Quantity::F, core::Quantity::f};
  for (const LociRequest& request : {asked, LociRequest{}}) {
    const core::Zones map = find_zones(rprpr, {request});
    ASSERT_GE(map.zones.size(), 3u);
    for (const core::Zone& zone : map.zones) {
      const auto told = [&](core::Quantity quantity) {
        return std::count_if(zone.signs.begin(), zone.signs.end(), [&](const auto& sign) {
          return sign.first.joint == "S2" && sign.first.quantity == quantity;
        });
      };
      EXPECT_EQ(told(core::Quantity::N), 0) << zone.id;
      EXPECT_EQ(told(core::Quantity::T), request.quantities == asked.quantities ? 1 : 0) << zone.id;
      EXPECT_EQ(told(core::Quantity::F), 1) << zone.id;
    }
  }
}

/// Zeros of what was not asked for cut no zone, so a zone has no sign of it.
TEST(Zones, HaveNoSignOfWhatWasNotAskedFor) {
  using enum core::Quantity;
  std::mt19937 random(20261127);
  for (const char* name : {"five_bar", "prrrp"}) {
    const mechanism::Mechanism mechanism = example(name);
    for (const std::vector<core::Quantity>& asked :
         std::vector<std::vector<core::Quantity>>{{fx}, {f}, {M}, {end_ahead}, {f, M}}) {
      LociRequest request;
      request.quantities = asked;
      const core::Zones map = find_zones(mechanism, {request});
      expect_one_sign_a_zone(mechanism, map, random);
      const auto is_asked = [&](core::Quantity quantity) {
        return std::find(asked.begin(), asked.end(), quantity) != asked.end();
      };
      for (const core::Zone& zone : map.zones)
        for (const auto& [what, sign] : zone.signs) {
          const core::Quantity quantity = what.quantity;
          EXPECT_TRUE(is_asked(quantity) || (quantity == F && is_asked(M)) ||
                      (core::is_guide_end(quantity) && is_asked(f)))
              << name << " " << zone.id << " " << core::to_string(quantity) << "_" << what.joint;
        }
    }
  }
}

}  // namespace
}  // namespace clearloci
