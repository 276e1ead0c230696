#include "core/root_tower.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "core/locus_map.hpp"

namespace clearloci::inline core {
namespace {

RootTower three_roots() {
  RootTower tower;
  tower.coordinates = {"x", "y"};
  const Polynomial none{5, {}};
  tower.roots = {{"s1", "B1", RootRole::working_mode, none},
                 {"s2", "E", RootRole::length, none},
                 {"s3", "B2", RootRole::working_mode, none}};
  return tower;
}

TEST(RootTower, CountsItsVariables) { EXPECT_EQ(three_roots().variables(), 5); }

TEST(AllWorkingModes, ListsEveryModeOnceTheGivenOneFirst) {
  const WorkingMode first = {-1, 1, 1};
  const std::vector<WorkingMode> modes = all_working_modes(three_roots(), first);
  ASSERT_EQ(modes.size(), 4U);
  EXPECT_EQ(modes.front(), first);
  EXPECT_EQ(std::set<WorkingMode>(modes.begin(), modes.end()).size(), 4U);
  for (const WorkingMode& mode : modes) EXPECT_EQ(mode[1], 1) << "a length is always the positive root";
}

TEST(AllWorkingModes, HasOneModeWithoutRoots) {
  EXPECT_EQ(all_working_modes(RootTower{}, {}).size(), 1U);
  EXPECT_THROW(all_working_modes(three_roots(), {1, 1}), std::logic_error);
}

TEST(DescribeMode, NamesThePointsAndSides) {
  const auto described = describe_mode(names_of(three_roots()), {-1, 1, 1});
  const std::vector<std::pair<std::string, std::string>> expected = {{"B1", "right"}, {"B2", "left"}};
  EXPECT_EQ(described, expected);
}

TEST(Names, AreThoseOfTheResultFiles) {
  EXPECT_EQ(to_string(LocusKind::contact_loss), "contact-loss");
  EXPECT_EQ(to_string(LocusKind::backlash), "backlash");
  EXPECT_EQ(to_string(LocusKind::component), "component");
  EXPECT_EQ(to_string(LocusKind::margin), "margin");
  EXPECT_EQ(to_string(LocusKind::direct_singularity), "direct-singularity");
  EXPECT_EQ(to_string(LocusKind::workspace_boundary), "workspace-boundary");
  EXPECT_EQ(to_string(ArcEnd::boundary), "boundary");
  EXPECT_EQ(to_string(ArcEnd::direct_singularity), "direct-singularity");
  EXPECT_EQ(to_string(Quantity::f), "f");
  EXPECT_EQ(to_string(Quantity::M), "M");
  EXPECT_EQ(to_string(Quantity::fx), "fx");
  EXPECT_EQ(to_string(Quantity::fy), "fy");
}

}  // namespace
}  // namespace clearloci::inline core
