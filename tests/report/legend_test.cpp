// What legends say: every reason once, ids, margins in red; and labels where there is room.
#include <gtest/gtest.h>

#include "clearloci/study.hpp"
#include "report/groups.hpp"
#include "report/label_places.hpp"
#include "report/plot.hpp"
#include "report/study_words.hpp"
#include "report/surface_groups.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::LocusKind;
using core::Quantity;

core::LocusCurve curve(const std::string& id, LocusKind kind, const std::string& joint, Quantity quantity,
                       const std::string& factor) {
  core::LocusCurve curve;
  curve.id = id;
  curve.kind = kind;
  curve.vanishing = {{joint, quantity, 1}};
  curve.factor = factor;
  return curve;
}

/// Too long for a legend.
const std::string unreadable = std::string(80, 'x');

TEST(Legend, ReasonsThatSeveralCurvesShareAreToldOnce) {
  core::LocusMap map;
  for (int leg = 1; leg <= 6; ++leg)
    map.curves.push_back(curve("c" + std::to_string(leg), LocusKind::backlash, "S" + std::to_string(leg), Quantity::F,
                               unreadable + std::to_string(leg)));
  map.curves.push_back(curve("c7", LocusKind::contact_loss, "P", Quantity::f, unreadable));
  const Groups groups = group_loci(map);
  ASSERT_EQ(groups.curves.size(), 7U);
  ASSERT_EQ(groups.remarks.size(), 1U);
  EXPECT_EQ(groups.remarks.front(),
            "c1, c2, c3, c4, c5, c6: the loads do no work in the motion that the joint alone drives");
  EXPECT_FALSE(groups.curves.front().why.empty()) << "the contact loss has a reason of its own";
  for (std::size_t i = 1; i < 7; ++i) EXPECT_EQ(groups.curves[i].why, "") << i;
}

TEST(Legend, NoEntryIsThereTwice) {
  core::LocusMap map;
  // Two factors of one reaction, neither of which can be read: one entry, with both ids.
  map.curves = {curve("c1", LocusKind::backlash, "A", Quantity::M, unreadable + "1"),
                curve("c2", LocusKind::backlash, "A", Quantity::M, unreadable + "2"),
                curve("c3", LocusKind::backlash, "B", Quantity::M, unreadable + "3")};
  const Groups groups = group_loci(map);
  ASSERT_EQ(groups.curves.size(), 2U);
  EXPECT_EQ(ids_of(groups.curves[0]), "c1, c2");
  EXPECT_EQ(ids_of(groups.curves[1]), "c3");
}

TEST(Legend, ReasonsThatSeveralSurfacesShareAreToldOnce) {
  core::LocusMap map;
  const auto add = [&](const std::string& id, const std::string& joint, const std::string& cause) {
    core::LocusSurface surface;
    surface.id = id;
    surface.kind = LocusKind::backlash;
    surface.vanishing = {{joint, Quantity::F, 1}};
    surface.factor = unreadable + id;
    surface.cause = cause;
    map.surfaces.push_back(std::move(surface));
  };
  add("s1", "S1", "");
  add("s2", "S2", "");
  add("s3", "S3", "the load parallel to S3");
  std::vector<SurfaceGroup> groups = group_surfaces(map);
  ASSERT_EQ(groups.size(), 3U);
  const std::vector<std::string> remarks = tell_shared_reasons(groups);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks.front(), "s1, s2: the loads do no work in the motion that the joint alone drives");
  EXPECT_EQ(groups[0].why + groups[1].why, "");
  EXPECT_EQ(groups[2].why, "the load parallel to S3");
}

TEST(Legend, OfManyIdsTheEndsAreTold) {
  core::LocusMap map;
  for (int i = 1; i <= 7; ++i)
    map.curves.push_back(curve("c" + std::to_string(i), LocusKind::direct_singularity, "", Quantity::f, "x"));
  EXPECT_EQ(ids_of(group_loci(map).curves.front()), "c1, c2, …, c7");
}

TEST(Legend, WhatIsBelowTheLeastForceIsALossOfMarginInRed) {
  core::LocusMap map;
  map.curves = {curve("m1", LocusKind::margin, "A", Quantity::f, unreadable)};
  const Groups groups = group_loci(map);
  EXPECT_EQ(groups.curves.front().what, "contact margin lost: A");
  EXPECT_EQ(groups.curves.front().stroke.colour.red, light_theme.failed.red);
  EXPECT_EQ(groups.curves.front().stroke.colour.green, light_theme.failed.green);
}

TEST(Legend, FactorsInMetresDoNotStandBesideMillimetres) {
  core::LocusMap map;
  EXPECT_EQ(readable_factor(map, 40), 40);
  map.units.declared = true;
  EXPECT_EQ(readable_factor(map, 40), 40);
  map.units.length = {"mm", 1e-3};
  EXPECT_EQ(readable_factor(map, 40), 0);
}

TEST(Legend, ParametersAreDecimalsAndExactOnRequest) {
  core::LocusMap map;
  map.parameters = {{"L", "7/20"}, {"k", "1/3 N/mm"}, {"turn", "30 deg"}, {"d", "sqrt(2)/2"}};
  EXPECT_EQ(parameter_words(map.parameters), "L = 0.35, k = 0.333333333 N/mm, turn = 30 deg, d = sqrt(2)/2");
  EXPECT_EQ(parameter_words(map.parameters, true), "L = 7/20, k = 1/3 N/mm, turn = 30 deg, d = sqrt(2)/2");
}

TEST(Labels, AreLeftOutWhereThereIsNoRoom) {
  LabelPlaces labels({0, 0, 100, 100});
  ASSERT_TRUE(labels.take_free({{20, 20}}, 20, 10, 0.1));
  EXPECT_FALSE(labels.take_free({{22, 20}}, 20, 10, 0.1)) << "it would cover the first";
  const auto other = labels.take_free({{22, 20}, {60, 60}}, 20, 10, 0.1);
  ASSERT_TRUE(other);
  EXPECT_EQ((*other)[0], 60);
}

TEST(Plots, PanelsOfOneUnitShareARange) {
  Plot plot;
  for (const double size : {1.0, 5.0}) {
    PlotPanel panel;
    panel.y_label = "mm";
    panel.series.push_back({"error", {{{0, -size}, {1, size}}}, 0});
    plot.panels.push_back(panel);
  }
  plot.panels.push_back(plot.panels.front());
  plot.panels.back().y_label = "deg";
  share_ranges(plot);
  EXPECT_EQ(*plot.panels[0].y_range, *plot.panels[1].y_range);
  EXPECT_GE((*plot.panels[0].y_range)[1], 5);
  EXPECT_LT((*plot.panels[2].y_range)[1], 2);
}

TEST(Studies, TellThatTheBestIsAtAnEndOfItsRange) {
  core::StudyResult result;
  result.study.vary = {{"L", core::Rational(3, 10), core::Rational(7, 10)}, {"d", 0, 1}};
  core::StudyDesign best;
  best.values = {0.7, 0.4};
  result.designs = {best};
  EXPECT_TRUE(edge_words(result).empty()) << "there is no best";
  result.best = 0;
  ASSERT_EQ(edge_words(result).size(), 1U);
  EXPECT_EQ(edge_words(result).front(), "L is at the upper end of its range, 0.7: designs beyond it may be better");
}

}  // namespace
}  // namespace clearloci::report
