// Zones by cells, held against grids over statics of the tests' own and against the loci.
#include "clearloci/zones.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "clearloci/errors.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr long few_cells = 40'000;  // enough to tell the zones of these examples apart

Model example(const std::string& name) { return Model::read(source_dir() + "/examples/" + name + ".yaml"); }

double lower(const Zones& map, std::size_t c) { return to_double(map.loci.lower[c]); }
double upper(const Zones& map, std::size_t c) { return to_double(map.loci.upper[c]); }

/// Signs of the three legs' forces.
using Signs = std::array<int, 3>;

Signs signs_of(const Eigen::Vector3d& forces) {
  Signs signs{};
  for (int leg = 0; leg < 3; ++leg) signs[static_cast<std::size_t>(leg)] = forces[leg] > 0 ? 1 : -1;
  return signs;
}

Signs signs_of(const Zone& zone) {
  Signs signs{};
  for (const auto& [reaction, sign] : zone.signs)
    if (reaction.quantity == Quantity::F) signs[static_cast<std::size_t>(reaction.joint[1] - '1')] = sign;
  return signs;
}

/// The 3-UPU moves without turning: forces along the legs alone bear the load.
Eigen::Vector3d upu_forces(double x, double y, double z) {
  const Eigen::Matrix3d feet{{0.5, -0.25, -0.25}, {0, 0.43, -0.43}, {0, 0, 0}};
  const Eigen::Matrix3d tips{{0.2, -0.1, -0.1}, {0, 0.17, -0.17}, {0, 0, 0}};
  Eigen::Matrix3d A;
  for (int leg = 0; leg < 3; ++leg)
    A.col(leg) = (Eigen::Vector3d(x, y, z) + tips.col(leg) - feet.col(leg)).normalized();
  return A.partialPivLu().solve(-Eigen::Vector3d(50, 20, -200));
}

/// The 3-RPR: forces along the legs and the couple on the platform.
Eigen::Vector3d rpr_forces(double x, double y, double phi, double r) {
  const std::array<Eigen::Vector2d, 3> feet = {Eigen::Vector2d(-0.8, -0.5), {0.8, -0.5}, {0, 0.9}};
  constexpr std::array<double, 3> turned = {210, -30, 80};
  Eigen::Matrix3d A;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const Eigen::Vector2d arm =
        r * Eigen::Vector2d(std::cos(phi + turned[leg] * degree), std::sin(phi + turned[leg] * degree));
    const Eigen::Vector2d u = (Eigen::Vector2d(x, y) + arm - feet[leg]).normalized();
    A.col(static_cast<int>(leg)) << u, arm[0] * u[1] - arm[1] * u[0];
  }
  return A.partialPivLu().solve(-Eigen::Vector3d(30, -100, 5));
}

/// What a grid says of the share of each combination of signs, against the bounds of all zones that have it.
template <class Forces>
void expect_grid_within(const Zones& map, const Forces& forces) {
  constexpr int n = 70;
  std::map<Signs, double> grid, least, most;
  double cell = 1;
  for (std::size_t c = 0; c < 3; ++c) cell *= (upper(map, c) - lower(map, c)) / n;
  const auto at = [&](std::size_t c, int i) { return lower(map, c) + (i + 0.5) / n * (upper(map, c) - lower(map, c)); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) grid[signs_of(forces(at(0, i), at(1, j), at(2, k)))] += cell;
  for (const Zone& zone : map.zones) {
    least[signs_of(zone)] += zone.at_least;
    most[signs_of(zone)] += zone.at_most;
    EXPECT_EQ(signs_of(zone), signs_of(forces(zone.sample[0], zone.sample[1], zone.sample[2]))) << zone.id;
  }
  double whole = 1;
  for (std::size_t c = 0; c < 3; ++c) whole *= upper(map, c) - lower(map, c);
  const double fuzzy = 0.002 * whole;  // of a grid's own count
  for (const auto& [signs, size] : grid) {
    if (least.count(signs) == 0) {
      EXPECT_LT(size, map.modes.front().in_doubt + fuzzy);
      continue;
    }
    EXPECT_LE(least[signs], size + fuzzy);
    EXPECT_GE(most[signs], size - fuzzy);
  }
  double total = map.modes.front().in_doubt + map.modes.front().outside;
  for (const Zone& zone : map.zones) total += zone.at_least;
  EXPECT_NEAR(total, whole, 1e-9 * whole) << "nothing is counted twice or left out";
}

TEST(ZonesByCells, OfA3UpuAgreeWithAGrid) {
  const Zones map = find_zones(example("three_upu"), {.cells = few_cells});
  EXPECT_TRUE(map.loci.complete);
  std::set<Signs> kinds;
  for (const Zone& zone : map.zones) kinds.insert(signs_of(zone));
  EXPECT_EQ(kinds.size(), 7U) << "every combination but the legs that all pull";
  EXPECT_LT(map.modes.front().in_doubt, 0.06 * 0.384);
  expect_grid_within(map, upu_forces);
  // The ball of a zone has its signs all over.
  for (const Zone& zone : map.zones) {
    ASSERT_GT(zone.ball.radius, 0) << zone.id;
    const Eigen::Vector3d centre(zone.ball.centre[0], zone.ball.centre[1], zone.ball.centre[2]);
    EXPECT_GT(zone.ball.radius, 0.2 * std::cbrt(zone.at_least * 3 / (4 * std::numbers::pi))) << zone.id;
    for (int i = 0; i < 400; ++i) {
      const double height = -1 + 2 * (i + 0.5) / 400, turn = 2.39996 * i, flat = std::sqrt(1 - height * height);
      const Eigen::Vector3d p =
          centre + zone.ball.radius * Eigen::Vector3d(flat * std::cos(turn), flat * std::sin(turn), height);
      EXPECT_EQ(signs_of(upu_forces(p[0], p[1], p[2])), signs_of(zone)) << zone.id;
    }
  }
}

TEST(ZonesByCells, OfA3RprWithFreeOrientationAgreeWithAGrid) {
  const Model model = example("three_rpr_orientation");
  double r = 0;
  for (const Model::Parameter& parameter : model.parameters())
    if (parameter.name == "r") r = parameter.value;
  const Zones map = find_zones(model, {.cells = few_cells});
  EXPECT_LT(map.modes.front().in_doubt, 0.4 * 1.44 * std::numbers::pi)
      << "many surfaces meet here, and most is told apart";
  // The grid of labels against statics at its places: a zone's signs are those there.
  std::size_t labelled = 0;
  for (std::size_t i = 0; i < map.modes.front().labels.size(); i += 7) {
    if (map.modes.front().labels[i] <= 0) continue;
    const std::size_t n = 64;
    const std::array<std::size_t, 3> cell = {i % n, i / n % n, i / n / n};
    std::array<double, 3> at{};
    for (std::size_t c = 0; c < 3; ++c)
      at[c] = lower(map, c) + (static_cast<double>(cell[c]) + 0.5) / n * (upper(map, c) - lower(map, c));
    EXPECT_EQ(signs_of(rpr_forces(at[0], at[1], at[2], r)),
              signs_of(map.zones[static_cast<std::size_t>(map.modes.front().labels[i] - 1)]));
    ++labelled;
  }
  EXPECT_GT(labelled, map.modes.front().labels.size() / 7 / 2);
  expect_grid_within(map, [r](double x, double y, double phi) { return rpr_forces(x, y, phi, r); });
}

TEST(ZonesByCells, ThatEndAtTheWorkspaceBoundaryAgreeWithTheWitness) {
  const Model model = example("three_rrr_orientation");
  const Zones map = find_zones(model, {.cells = 20'000});
  // A leg of two halves of 0.5 m reaches as far as 1 m.
  const auto reachable = [](double x, double y, double phi) {
    const std::array<Eigen::Vector2d, 3> feet = {Eigen::Vector2d(-0.7, -0.4), {0.7, -0.4}, {0, 0.8}};
    constexpr std::array<double, 3> turned = {210, -30, 90};
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const double a = phi + turned[leg] * degree;
      if ((Eigen::Vector2d(x, y) + 0.2 * Eigen::Vector2d(std::cos(a), std::sin(a)) - feet[leg]).norm() > 1)
        return false;
    }
    return true;
  };
  ASSERT_EQ(map.grid.size(), 3U);
  std::vector<double> poses;
  std::vector<int> labels;
  double outside = 0, all = 0;
  for (std::size_t i = 0; i < map.modes.front().labels.size(); i += 5) {
    std::array<double, 3> at{};
    std::size_t rest = i;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto n = static_cast<std::size_t>(map.grid[c]);
      at[c] = lower(map, c) + (static_cast<double>(rest % n) + 0.5) / map.grid[c] * (upper(map, c) - lower(map, c));
      rest /= n;
    }
    ++all;
    if (!reachable(at[0], at[1], at[2])) {
      ++outside;
      ASSERT_LE(map.modes.front().labels[i], 0) << "no zone is out of reach";
      continue;
    }
    ASSERT_GE(map.modes.front().labels[i], 0) << "what is out of reach is so";
    poses.insert(poses.end(), at.begin(), at.end());
    labels.push_back(map.modes.front().labels[i]);
  }
  const Reactions found = reactions(model, poses);
  std::map<Signs, double> sampled, least, most;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    Signs signs{};
    for (std::size_t column = 0; column < found.quantities.size(); ++column)
      if (found.quantities[column] == Quantity::M)
        signs[static_cast<std::size_t>(found.joints[column][1] - '1')] = found.table.columns[column][i] > 0 ? 1 : -1;
    ++sampled[signs];
    if (labels[i] == 0) continue;
    for (const auto& [reaction, sign] : map.zones[static_cast<std::size_t>(labels[i] - 1)].signs)
      if (reaction.quantity == Quantity::M) {
        ASSERT_EQ(sign, signs[static_cast<std::size_t>(reaction.joint[1] - '1')]);
      }
  }
  double whole = 1, told = map.modes.front().outside + map.modes.front().in_doubt;
  for (std::size_t c = 0; c < 3; ++c) whole *= upper(map, c) - lower(map, c);
  for (const Zone& zone : map.zones) {
    Signs signs{};
    for (const auto& [reaction, sign] : zone.signs)
      if (reaction.quantity == Quantity::M) signs[static_cast<std::size_t>(reaction.joint[1] - '1')] = sign;
    least[signs] += zone.at_least;
    most[signs] += zone.at_most;
    told += zone.at_least;
  }
  EXPECT_NEAR(told, whole, 1e-9 * whole);
  const double fuzzy = 0.004;  // of the samples' own count
  EXPECT_LT(map.modes.front().outside / whole, outside / all + fuzzy);
  EXPECT_GT((map.modes.front().outside + map.modes.front().in_doubt) / whole, outside / all - fuzzy);
  for (const auto& [signs, count] : sampled) {
    EXPECT_LT(least[signs] / whole, count / all + fuzzy);
    if (least[signs] > 0) {
      EXPECT_GT(most[signs] / whole, count / all - fuzzy);
    }
  }
}

// What is tried first must not depend on the thread that a cell falls to.
TEST(ZonesByCells, AreTheSameInEveryRun) {
  const Model model = example("three_rpr_orientation");
  const double first = find_zones(model, {.cells = 6'000}).modes.front().in_doubt;
  for (int run = 0; run < 3; ++run) EXPECT_EQ(find_zones(model, {.cells = 6'000}).modes.front().in_doubt, first);
}

TEST(ZonesByCells, OfThreeCoordinatesHaveClosedSurfaces) {
  const Zones map = find_zones(example("three_upu"), {.cells = 5000});
  ASSERT_FALSE(map.zones.empty());
  // By Gauss: the volume inside from the faces alone.
  for (const Zone& zone : map.zones) {
    double volume = 0;
    for (const auto& corners : zone.faces) {
      const auto point = [&](std::size_t i) { return Eigen::Vector3d(corners[i][0], corners[i][1], corners[i][2]); };
      for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        volume += point(0).dot((point(i) - point(0)).cross(point(i + 1) - point(0))) / 6;
    }
    EXPECT_NEAR(volume, zone.at_least, 1e-9) << zone.id;
  }
}

/// Of the whole turn of a crank.
void expect_zones_between_loci(const Zones& map, const LocusMap& loci) {
  std::set<double> cuts = {0, 2 * std::numbers::pi};
  for (const IsolatedPoint& point : loci.isolated_points) cuts.insert(point.at.front());
  ASSERT_EQ(map.zones.size() + 1, cuts.size());
  for (const Zone& zone : map.zones) {
    for (const double end : {zone.lower[0], zone.upper[0]}) {
      double least = 10;
      for (const double cut : cuts) least = std::min(least, std::abs(cut - end));
      EXPECT_LT(least, 1e-7);
    }
    for (const double cut : cuts) EXPECT_FALSE(zone.lower[0] < cut - 1e-12 && cut + 1e-12 < zone.upper[0]);
    EXPECT_FALSE(zone.ends.empty());
  }
}

TEST(ZonesByCells, OfAFourBarEndAtItsLoci) {
  const Model model = example("four_bar");
  const Zones map = find_zones(model);
  expect_zones_between_loci(map, trace_loci(model));
  // The end effector jumps where the rocker is upright, and its couple changes its sign in every zone.
  const auto jumps = std::count_if(map.zones.begin(), map.zones.end(), [](const Zone& zone) {
    return std::any_of(zone.ends.begin(), zone.ends.end(),
                       [](const ZoneEnd& end) { return end.jump && end.jump->displacement[0] != 0; });
  });
  EXPECT_GE(jumps, 3);
}

/// Where its pins bear less than 10 N, too, it has zones, between the same contact losses.
TEST(ZonesByCells, OfAFourBarEndWhereForcesAreTooSmall) {
  const Model model = example("four_bar");
  ZoneRequest request;
  request.loci.min_force = 10;
  const Zones map = find_zones(model, request);
  const LocusMap loci = trace_loci(model, request.loci);
  expect_zones_between_loci(map, loci);
  EXPECT_TRUE(map.loci.complete);
  EXPECT_LT(map.modes.front().in_doubt, 1e-5);
  int small = 0, lost = 0;
  for (const Zone& zone : map.zones) {
    EXPECT_TRUE(zone.certified) << zone.id;
    std::set<std::string> expected, found;
    for (const JointReaction& reaction : solve_pose(model, zone.sample).reactions)
      if (std::hypot(reaction.components[0].value, reaction.components[1].value) < 10) expected.insert(reaction.joint);
    for (const Vanishing& what : zone.too_small) found.insert(what.joint);
    EXPECT_EQ(found, expected) << zone.id;
    small += zone.too_small.empty() ? 0 : 1;
    for (const ZoneEnd& end : zone.ends) lost += end.kind == LocusKind::contact_loss && !zone.too_small.empty() ? 1 : 0;
  }
  EXPECT_GE(small, 3) << "on either side of both contact losses";
  EXPECT_EQ(lost, 4);
}

/// F = -10 (q - 1/3); the ends bear (5 -+ 20 (q - 1/3))/2 under it: zero at q = 1/3 -+ 1/4. All unknowns are
/// eliminated.
TEST(ZonesByCells, OfASlideEndWhereItsReactionsVanish) {
  const Model model = Model::parse(R"(
format: 1
space: planar
workspace: {q: [0, 1]}
points: {S: [q, 0], T: [q, 0.1]}
links:
  slide: {points: [S, T]}
joints:
  J: {prismatic: [ground, slide], at: S, axis: [1, 0], actuated: true, clearance: {gap: 1e-5, half_length: 0.05, axial: 1e-5}}
end_effector: {link: slide, at: T}
loads:
  - {link: slide, at: T, force: ['10*(q - 1/3)', -5]}
)",
                                   "slide.yaml");
  const Zones map = find_zones(model);
  std::set<double> ends;
  for (const Zone& zone : map.zones) ends.insert({zone.lower[0], zone.upper[0]});
  for (const double cut : {1.0 / 12, 1.0 / 3, 7.0 / 12})
    EXPECT_TRUE(std::any_of(ends.begin(), ends.end(), [&](double end) { return std::abs(end - cut) < 1e-8; })) << cut;
  EXPECT_EQ(map.zones.size(), 4U);
}

/// Where a dyad is stretched, and where |A| changes its sign, reactions grow without bound: none of them vanishes.
TEST(ZonesByCells, EndWhereReactionsAreUnbounded) {
  const Zones slider =
      find_zones(Model::read(source_dir() + "/tests/corpus/loci/crank_at_dead_centres_of_a_slider.yaml"));
  ASSERT_EQ(slider.zones.size(), 1U);
  ASSERT_EQ(slider.zones[0].ends.size(), 2U);
  for (const ZoneEnd& end : slider.zones[0].ends) {
    EXPECT_EQ(end.kind, LocusKind::workspace_boundary) << end.at;
    EXPECT_TRUE(end.vanishing.empty()) << end.at;
  }
  const Zones bars = find_zones(Model::read(source_dir() + "/tests/corpus/loci/eight_bar_singular_between_zones.yaml"));
  int singular = 0;
  for (const Zone& zone : bars.zones)
    for (const ZoneEnd& end : zone.ends) {
      if (std::abs(end.at - 155.716287 * std::numbers::pi / 180) > 1e-6) continue;
      EXPECT_EQ(end.kind, LocusKind::direct_singularity);
      EXPECT_FALSE(end.jump.has_value());
      ++singular;
    }
  EXPECT_EQ(singular, 2);
}

/// Eight bars on one crank: no locus is traced for it, which takes minutes.
TEST(ZonesByCells, OfAJansenLegEndWhereItsReactionsTurn) {
  const Model model = example("jansen_leg");
  const Zones map = find_zones(model);
  EXPECT_GT(map.zones.size(), 4U);
  EXPECT_LT(map.modes.front().in_doubt, 1e-5);
  int told = 0;
  for (const Zone& zone : map.zones)
    for (const ZoneEnd& end : zone.ends) {
      const Pose before = solve_pose(model, {end.at - 1e-6}), behind = solve_pose(model, {end.at + 1e-6});
      for (const Vanishing& vanishing : end.vanishing) {
        double together = 0;
        for (std::size_t j = 0; j < before.reactions.size(); ++j) {
          if (before.reactions[j].joint != vanishing.joint) continue;
          for (std::size_t k = 0; k < before.reactions[j].components.size(); ++k) {
            const Quantity part = before.reactions[j].components[k].quantity;
            if ((vanishing.quantity == Quantity::f) == (part == Quantity::fx || part == Quantity::fy))
              together += before.reactions[j].components[k].value * behind.reactions[j].components[k].value;
          }
        }
        EXPECT_LT(together, 0) << vanishing.joint << " at " << end.at;
        ++told;
      }
    }
  EXPECT_GT(told, 8);
}

/// A slider-crank, over its crank's angle and over both of its modes: each has the zones that it has alone.
TEST(ZonesByCells, OfAllModesAreThoseOfEachAlone) {
  const Model model = example("slider_crank");
  const Zones all = find_zones(model, {{.all_working_modes = true}});
  ASSERT_GT(all.modes.size(), 1U);
  std::size_t before = 0;
  for (const ZonedMode& mode : all.modes) {
    const Zones alone = find_zones(model, {{.working_modes = {mode.mode}}});
    ASSERT_EQ(alone.modes.size(), 1U);
    EXPECT_EQ(alone.modes.front().mode, mode.mode);
    EXPECT_EQ(alone.modes.front().outside, mode.outside);
    for (std::size_t z = 0; z < alone.zones.size(); ++z) {
      ASSERT_LT(before + z, all.zones.size());
      const Zone &one = alone.zones[z], &other = all.zones[before + z];
      EXPECT_EQ(other.mode, mode.mode);
      EXPECT_EQ(other.id, "z" + std::to_string(before + z + 1)) << "numbers go on over the modes";
      EXPECT_EQ(one.lower, other.lower);
      EXPECT_EQ(one.upper, other.upper);
      EXPECT_EQ(one.signs, other.signs);
    }
    for (std::size_t i = 0; i < mode.labels.size(); ++i) {
      const int label = alone.modes.front().labels[i];
      EXPECT_EQ(mode.labels[i], label > 0 ? label + static_cast<int>(before) : label);
    }
    before += alone.zones.size();
  }
  EXPECT_EQ(before, all.zones.size());
}

/// The faces of the arrangement lie between the bounds that cells give of them.
TEST(ZonesByCells, OverTwoLengthsBoundTheFaces) {
  const Model model = example("five_bar");
  const Zones faces = find_zones(model), cells = find_zones(model, {.cells = 20'000, .by_cells = true});
  ASSERT_FALSE(faces.by_cells);
  ASSERT_TRUE(cells.by_cells);
  const ZonedMode &exact = faces.modes.front(), &bounded = cells.modes.front();
  EXPECT_GE(bounded.workspace, exact.workspace * (1 - 1e-5));
  EXPECT_LE(bounded.workspace - bounded.in_doubt, exact.workspace * (1 + 1e-5));
  for (const Zone& zone : faces.zones) {
    EXPECT_TRUE(zone.certified) << zone.id;
    EXPECT_LE(zone.at_least, zone.size) << zone.id;
    EXPECT_GE(zone.at_most, zone.size) << zone.id;
    EXPECT_LT(zone.at_most - zone.at_least, 1e-3 * zone.size) << zone.id;
  }
  const Zone &largest = faces.zones.front(), &by_cells = cells.zones.front();
  EXPECT_LE(by_cells.at_least, largest.size * (1 + 1e-5));
  EXPECT_GE(by_cells.at_most, largest.size * (1 - 1e-5));
  EXPECT_GT(by_cells.at_least, 0.8 * largest.size);
  EXPECT_EQ(by_cells.assembly_mode, largest.assembly_mode);
}

TEST(ZonesByCells, WantThreeCoordinatesAtMost) { EXPECT_THROW(find_zones(example("gough_stewart_poses")), InputError); }

/// The force of a pin has no sign; along a two-force link it has.
TEST(ZonesByCells, OverOneCoordinateAreTwoWhereTheForceOfAPinVanishesBetweenThem) {
  const Zones zones = find_zones(example("gripper"));
  int lost = 0;
  for (const Zone& zone : zones.zones) {
    EXPECT_TRUE(zone.certified) << zone.id;
    for (const ZoneEnd& end : zone.ends) lost += end.kind == LocusKind::contact_loss ? 1 : 0;
  }
  EXPECT_GE(lost, 2) << "from either side";
}

/// Forces grow without bound towards the place where O, C1 and B are aligned and C1 is at C2. Neither zones nor loci
/// say that any of them vanishes there: it is the end of the reach.
TEST(ZonesByCells, EndWithTheReachWhereTheEndsOfEqualLinksMeet) {
  const Model model = Model::read(source_dir() + "/tests/corpus/mechanism/peaucellier.yaml");
  const double aligned = std::acos((0.964 - 0.5) / 0.5);  // |OB|^2 = 1/2 + cos(t)/2 = 4 |OC1|^2
  const LocusMap loci = trace_loci(model);
  ASSERT_EQ(loci.isolated_points.size(), 1U);
  EXPECT_EQ(loci.isolated_points[0].kind, LocusKind::workspace_boundary);
  EXPECT_NEAR(loci.isolated_points[0].at[0], aligned, 1e-12);
  const Zones map = find_zones(model);
  ASSERT_EQ(map.zones.size(), 1U);
  ASSERT_EQ(map.zones[0].ends.size(), 1U);
  EXPECT_EQ(map.zones[0].ends[0].kind, LocusKind::workspace_boundary);
  EXPECT_FALSE(map.zones[0].ends[0].jump);
  EXPECT_NEAR(map.zones[0].ends[0].at, aligned, 1e-5);
}

TEST(ZonesOverTwoLengths, AreTheSameAtACoarseTolerance) {
  const Model model = Model::read(source_dir() + "/tests/corpus/witness/sliver_zone.yaml");
  for (const double tolerance : {1e-5, 1e-3, 0.03}) {
    ZoneRequest request;
    request.loci.tolerance = tolerance;
    const Zones map = find_zones(model, request);
    ASSERT_EQ(map.zones.size(), 10U) << tolerance;
    for (const Zone& zone : map.zones) EXPECT_TRUE(zone.certified) << zone.id << " " << tolerance;
    // The eighth is the thinnest; coarse chords tell its size roughly, and bounds of it for certain.
    constexpr double size = 4.018e-7;
    EXPECT_NEAR(map.zones[7].size, size, tolerance > 1e-5 ? 1e-7 : 2e-9) << tolerance;
    EXPECT_LT(map.zones[7].at_least, size) << tolerance;
    EXPECT_GT(map.zones[7].at_most, size) << tolerance;
  }
}

TEST(ZonesByCells, KnowPinsThatBearNothingWhereRoundingCannotTell) {
  // A six-bar whose load acts on one end of the dyad l4-l5: its other pins bear nothing. The bounds on the rounding of
  // their forces are too wide to say so.
  const Zones map = find_zones(Model::parse(R"(format: 1
name: dr
workspace:
  th:
    angle: [-0.122386514426961, 2.87761348557304]
    of: l2
drawn:
  P0: [-0.027, -0.195]
  P1: [0.54, -0.293]
  P2: [-0.126, -0.563]
  P3: [0.112, 0.35]
  P4: [0.017, 0.168]
  P5: [0.457, -0.153]
  P6: [0.297, -0.444]
  P7: [-0.412, -0.581]
links:
  l1:
    points: [P0, P1, P2]
  l2:
    points: [P2, P4, P5]
  l3:
    points: [P4, P3, P6]
  l4:
    points: [P5, P7]
  l5:
    points: [P7, P6]
joints:
  P0:
    revolute: [ground, l1]
    at: P0
    clearance: {radial: 1.0e-05, angular: 0.0002}
    actuated: true
  P2:
    revolute: [l1, l2]
    at: P2
    clearance: {radial: 1.0e-05}
  P4:
    revolute: [l2, l3]
    at: P4
    clearance: {radial: 1.0e-05}
  P3:
    revolute: [l3, ground]
    at: P3
    clearance: {radial: 1.0e-05}
  P5:
    revolute: [l2, l4]
    at: P5
    clearance: {radial: 1.0e-05}
  P7:
    revolute: [l4, l5]
    at: P7
    clearance: {radial: 1.0e-05}
  P6:
    revolute: [l5, l3]
    at: P6
    clearance: {radial: 1.0e-05}
end_effector: {link: l5, at: P6}
loads:
- link: l5
  at: P6
  force: [100.0, 20.0]
)"));
  EXPECT_TRUE(map.loci.complete);
  EXPECT_EQ(map.zones.size(), 4U);
  EXPECT_EQ(std::count(map.loci.notes.begin(), map.loci.notes.end(),
                       "P5, P7 bear nothing in any pose under these loads, so the take-up is undefined"),
            1);
}

}  // namespace
}  // namespace clearloci
