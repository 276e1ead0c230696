// Random double butterflies over the angle of the crank, as drawings and as groups: loci, dead centres and ranges are
// those of a walk along the assembly curve (double_butterflies.hpp).
// CLEARLOCI_DESIGNS=n in the environment tries n designs, from CLEARLOCI_FIRST on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <tuple>

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "tests/laws/double_butterflies.hpp"

namespace clearloci::test {
namespace {

struct Tally {
  int designs = 0, refused = 0, lost = 0, points = 0, uncertified = 0, changes = 0, dead_centres = 0,
      uncertified_ends = 0, incomplete = 0;
};

constexpr double near = 1e-6;

bool is_loss(const IsolatedPoint& point) {
  return point.kind == LocusKind::contact_loss || point.kind == LocusKind::backlash;
}

bool is_open_at(const LocusMap& map, double theta) {
  return std::any_of(map.open.begin(), map.open.end(), [&](const OpenRegion& region) {
    return theta > region.lower[0] - near && theta < region.upper[0] + near;
  });
}

/// What vanishes at an angle: names of pins, and "M" for the motor. A loss is told only of what vanishes by itself.
std::set<std::string> zeros_at(const Borne& all) {
  const double largest = *std::max_element(all.pins.begin(), all.pins.end());
  std::set<std::string> names;
  for (std::size_t k = 0; k < all.pins.size(); ++k)
    if (all.pins[k] < near * largest) names.insert(pin_names[k]);
  if (std::abs(all.motor) < near * largest) names.insert("M");
  return names;
}

std::set<std::string> told_at(const LocusMap& map, double theta) {
  std::set<std::string> names;
  for (const IsolatedPoint& point : map.isolated_points)
    if (is_loss(point) && std::abs(point.at[0] - theta) < near)
      for (const Vanishing& what : point.vanishing) names.insert(what.quantity == Quantity::M ? "M" : what.joint);
  return names;
}

void hold_range(const LocusMap& map, const Walk& walk, Tally& tally) {
  ASSERT_FALSE(map.reachable.empty());
  const auto range = std::find_if(map.reachable.begin(), map.reachable.end(), [&](const ReachableInterval& interval) {
    return interval.from < walk.to && interval.to > walk.from;
  });
  ASSERT_NE(range, map.reachable.end());
  EXPECT_EQ(map.reachable.size(), 1U);
  for (const auto& [is_dead, told, at] :
       {std::tuple(walk.dead_from, range->from, walk.from), std::tuple(walk.dead_to, range->to, walk.to)}) {
    if (!is_dead) {
      EXPECT_NEAR(told, at, near);
      continue;
    }
    ++tally.dead_centres;
    // One that is not certified may be somewhat beyond what is proven to be in reach.
    constexpr double doubtful = 1e-4;
    const auto point = std::find_if(map.isolated_points.begin(), map.isolated_points.end(), [&](const auto& one) {
      return one.kind == LocusKind::workspace_boundary && std::abs(one.at[0] - at) < doubtful;
    });
    if (point == map.isolated_points.end() && is_open_at(map, at)) continue;
    ASSERT_NE(point, map.isolated_points.end()) << "no dead centre is told at " << at;
    tally.uncertified_ends += point->certified ? 0 : 1;
    EXPECT_NEAR(told, at, point->certified ? near : doubtful);
    EXPECT_NEAR(point->at[0], at, point->certified ? near : doubtful);
  }
}

void hold(const DoubleButterfly& design, const LocusMap& map, const Walk& walk, Tally& tally) {
  ++tally.designs;
  tally.incomplete += map.complete ? 0 : 1;
  hold_range(map, walk, tally);
  for (const SignChange& change : walk.changes) {
    ++tally.changes;
    if (is_open_at(map, change.theta) || change.theta - walk.from < near || walk.to - change.theta < near) continue;
    const std::optional<Borne> all = borne_at(design, walk, change.theta);
    ASSERT_TRUE(all) << "at " << change.theta;
    EXPECT_EQ(told_at(map, change.theta), zeros_at(*all)) << "at " << change.theta;
  }
  for (const IsolatedPoint& point : map.isolated_points) {
    if (!is_loss(point)) continue;
    ++tally.points;
    tally.uncertified += point.certified ? 0 : 1;
    const std::optional<Borne> all = borne_at(design, walk, point.at[0]);
    ASSERT_TRUE(all) << "nothing closes at " << point.at[0];
    const std::set<std::string> zeros = zeros_at(*all);
    for (const std::string& name : told_at(map, point.at[0]))
      EXPECT_TRUE(zeros.count(name) == 1) << name << " at " << point.at[0];
  }
}

unsigned from_environment(const char* name, unsigned otherwise) {
  const char* const wanted = std::getenv(name);
  return wanted != nullptr ? static_cast<unsigned>(std::atoi(wanted)) : otherwise;
}

TEST(GroupLaw, DoubleButterfliesAreThoseOfAContinuation) {
  const unsigned first = from_environment("CLEARLOCI_FIRST", 1), designs = from_environment("CLEARLOCI_DESIGNS", 30);
  constexpr double reach = 0.7;
  Tally tally;
  for (unsigned seed = first; seed < first + designs && !HasFailure(); ++seed) {
    std::mt19937 random(seed);
    const DoubleButterfly design = double_butterfly(random, seed % 2 == 0);
    const std::string text = seed % 3 == 0 ? group_text(design, reach) : drawn_text(design, reach);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text);
    std::optional<Model> model;
    try {
      model = Model::parse(text, "butterfly.yaml");
    } catch (const InputError& error) {
      ++tally.refused;
      const std::string what = error.what();
      EXPECT_TRUE(what.find("dead centre") != std::string::npos || what.find("it is singular") != std::string::npos)
          << what;
      continue;
    }
    const std::optional<Walk> this_walk = walk(design, reach);
    const LocusMap map = trace_loci(*model);
    if (this_walk) {
      hold(design, map, *this_walk, tally);
      continue;
    }
    // Where assembly curves meet there is no way on: then that end of the range is not proven.
    ++tally.lost;
    EXPECT_TRUE(std::any_of(map.isolated_points.begin(), map.isolated_points.end(), [](const IsolatedPoint& point) {
      return point.kind == LocusKind::workspace_boundary && !point.certified;
    }));
  }
  fmt::print("{} designs, {} refused, {} lost, {} incomplete; ", tally.designs, tally.refused, tally.lost,
             tally.incomplete);
  fmt::print("{} changes of sign, {} points ({} not certified), {} dead centres ({} not certified)\n", tally.changes,
             tally.points, tally.uncertified, tally.dead_centres, tally.uncertified_ends);
  EXPECT_GT(tally.designs, 20);
  EXPECT_LE(tally.lost, tally.designs / 20);
  EXPECT_GT(tally.changes, 10);
  EXPECT_GT(tally.dead_centres, 10);
  EXPECT_LT(tally.uncertified_ends, tally.dead_centres);
}

}  // namespace
}  // namespace clearloci::test
