// Answers in the units of their file, and the words of tables.
#include "report/file_units.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "report/exports.hpp"
#include "report/loci_json.hpp"
#include "report/loci_table.hpp"
#include "report/pose.hpp"
#include "report/preload.hpp"
#include "report/verification.hpp"
#include "report/wording.hpp"
#include "report/zones.hpp"

#include <nlohmann/json.hpp>

namespace clearloci::report {
namespace {

core::LocusMap line_in_mm() {
  core::LocusMap map;
  map.mechanism = "Slide";
  map.tower.coordinates = {"x", "y"};
  map.lower = {-1, -1};
  map.upper = {1, 1};
  core::LocusCurve curve;
  curve.id = "c1";
  curve.vanishing = {{"A", core::Quantity::f}};
  curve.cause = "somewhere";
  curve.closed_form = core::CircleForm{{core::Rational(1, 4), 0}, core::Rational(1, 4), core::Rational(1, 2)};
  curve.arcs.push_back(
      {.ends = {core::ArcEnd::box, core::ArcEnd::box}, .length = 0.5, .points = {{0.25, 0}, {0.25, 0.5}}});
  map.curves.push_back(curve);
  map.units.declared = true;
  map.units.length = {"mm", 0.001};
  return map;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(FileUnits, AreThoseOfTablesCsvAndDrawings) {
  const core::LocusMap map = line_in_mm();
  const std::string table = loci_table(map);
  EXPECT_TRUE(has(table, "length/mm")) << table;
  EXPECT_TRUE(has(table, "circle centre (250, 0), radius 500")) << table;
  EXPECT_TRUE(has(table, "     500\n")) << table;
  EXPECT_TRUE(has(csv(map), "closed,x (mm),y (mm)\n")) << csv(map);
  EXPECT_TRUE(has(csv(map), ",250,500\n")) << csv(map);
  EXPECT_TRUE(has(dxf(map), "$INSUNITS\n 70\n4\n"));
}

/// Columns align whatever the signs are, and a reaction that nothing loads is told by its note alone.
TEST(ZonesTable, AlignsAndLeavesOutWhatNothingLoads) {
  core::Zones map;
  map.loci = line_in_mm();
  map.loci.notes = {"NS is zero in every pose under these loads"};
  core::Zone zone;
  zone.id = "z1";
  zone.assembly_mode = 1;
  zone.size = 0.125;
  zone.ball.centre = {0, 0};
  zone.certified = true;
  zone.signs = {{{"S", core::Quantity::N}, 0}};
  for (const char* joint : {"A1", "A2", "A3", "A4"}) zone.signs.push_back({{joint, core::Quantity::M}, -1});
  map.zones = {zone};
  const std::string table = zones_table(map);
  EXPECT_FALSE(has(table, "N_S")) << table;
  EXPECT_TRUE(has(table, "M_A1- M_A2- M_A3- M_A4-       125000")) << table;
  EXPECT_EQ(table.find("area/mm2") + 8 - table.find("zone "), table.find("125000") + 6 - table.find("z1 ")) << table;
}

TEST(FileUnits, LeaveJsonAndFilesWithoutThemInSi) {
  core::LocusMap map = line_in_mm();
  EXPECT_EQ(loci_object(map)["units"], "SI");
  EXPECT_EQ(loci_object(map)["curves"][0]["arcs"][0]["length"], 0.5);
  map.units = {};
  EXPECT_FALSE(loci_object(map).contains("units"));
  EXPECT_TRUE(has(csv(map), "closed,x,y\n"));
  EXPECT_TRUE(has(loci_table(map), "length/m"));
}

TEST(FileUnits, AreThoseOfAPose) {
  core::Pose pose;
  pose.units = {true, {"mm", 0.001}, {"rad", 1}, {"kN", 1000}, {"kg", 1}};
  pose.points = {{"A", {0.25, 0}}};
  pose.reactions = {{"A", {{core::Quantity::fx, 500}, {core::Quantity::fy, 0}, {core::Quantity::M, 3}}}};
  pose.take_up = {{"A", {1e-5, 0}, std::acos(-1.0) / 2, {}, {}, {}, {}}};
  pose.worst = {{1e-5, 0}, {0}, 1e-5, 0};
  const std::string text = pose_text(pose);
  EXPECT_TRUE(has(text, "A         250       0\n")) << text;
  EXPECT_TRUE(has(text, "|f| [kN]  M [N m]\n")) << text;
  EXPECT_TRUE(has(text, "fy = 0 in every joint\n")) << text;
  EXPECT_TRUE(has(text, "beta [deg]")) << "the file says nothing of angles\n" << text;
  pose.units.angle_declared = true;
  EXPECT_TRUE(has(pose_text(pose), "beta [rad]"));
  pose.units = {};
  EXPECT_TRUE(has(pose_text(pose), "dx [µm]")) << "what reads best where the file says nothing";
}

TEST(FileUnits, ScaleEveryPartOfASketch) {
  core::Sketch sketch;
  sketch.links = {{"rod", {{0.1, 0}}}};
  sketch.slides = {{{0.1, 0}, {0.2, 0}}};
  sketch.joints = {{"A", {0.1, 0}}};
  core::SketchSpring spring;
  spring.from = {0.1, 0};
  spring.to = {0.3, 0.2};
  sketch.springs = {spring};
  const core::Sketch shown = in_file_units(sketch, {true, {"mm", 0.001}});
  EXPECT_DOUBLE_EQ(shown.links[0].points[0][0], 100);
  EXPECT_DOUBLE_EQ(shown.slides[0].to[0], 200);
  EXPECT_DOUBLE_EQ(shown.joints[0].at[0], 100);
  EXPECT_DOUBLE_EQ(shown.springs[0].from[0], 100);
  EXPECT_DOUBLE_EQ(shown.springs[0].to[1], 200);
}

TEST(FileUnits, TellPlacesWithTheirAngles) {
  const std::array<double, 2> at = {0.25, std::acos(-1.0) / 6};
  EXPECT_EQ(place_words(at, {}, {}), "(0.25, 0.523599) m");
  EXPECT_EQ(place_words(at, {false, true}, {}), "(0.25 m, 30 deg)");
  EXPECT_EQ(place_words(std::array{0.25, 1e-17}, {}, {true, {"mm", 0.001}}), "(250, 0) mm");
}

TEST(Wording, BoundsStayBoundsInFewDigits) {
  EXPECT_DOUBLE_EQ(rounded_down(8.08553534835, 4), 8.085);
  EXPECT_DOUBLE_EQ(rounded_up(8.08553534835, 4), 8.086);
  EXPECT_DOUBLE_EQ(rounded_down(-8.08553534835, 4), -8.086);
  EXPECT_DOUBLE_EQ(rounded_up(22.0988, 3), 22.1);
  EXPECT_DOUBLE_EQ(rounded_down(0.09999, 3), 0.0999);
  EXPECT_EQ(rounded_down(6.25, 3), 6.25);
  EXPECT_EQ(rounded_up(0, 3), 0);
}

TEST(Wording, IsInEngineeringNotation) {
  EXPECT_EQ(engineering(1.25e-5, 9), "12.5e-6");
  EXPECT_EQ(engineering(-4.5e-4, 9), "-450e-6");
  EXPECT_EQ(engineering(0.0025, 9), "0.0025");
  EXPECT_EQ(engineering(123456.5, 9), "123456.5");
  EXPECT_EQ(engineering(2.5e7, 9), "25e6");
  EXPECT_EQ(engineering(0, 9), "0");
  EXPECT_EQ(engineering(-0.0, 9), "0");
  EXPECT_EQ(engineering(9.999999999999e-4, 9), "1e-3");
  EXPECT_EQ(engineering(std::numeric_limits<double>::infinity(), 9), "inf");
}

TEST(Wording, SaysByVirtualWorkWhatAFactorMeans) {
  const std::string heavy(200, 'x');
  const auto words = [&](core::LocusKind kind, const std::vector<core::Vanishing>& vanishing) {
    return reason_words(kind, vanishing, heavy, "", 60);
  };
  using K = core::LocusKind;
  using Q = core::Quantity;
  EXPECT_EQ(words(K::backlash, {{"A1", Q::M}}), "the loads do no work in the motion that A1 alone drives");
  EXPECT_EQ(words(K::contact_loss, {{"B", Q::f}}),
            "the loads do no work in any motion that B coming apart would allow");
  EXPECT_EQ(words(K::component, {{"B", Q::fy}}), "the loads do no work in the motion of B giving way along y");
  EXPECT_EQ(words(K::direct_singularity, {}), "the mechanism can move with its actuators locked");
  EXPECT_EQ(reason_words(K::backlash, {}, "x - 1", "", 60), "x - 1");
  EXPECT_EQ(reason_words(K::backlash, {}, heavy, "A, B, C aligned", 60), "A, B, C aligned");
}

TEST(Wording, TellsACoupleThatIsARoundingOfItsForceAsNone) {
  core::TaskWitness witness;
  witness.kind = core::TaskWitness::Kind::singular;
  witness.loads = {{0, {-20.46, 34.9}, {5.6e-17}}};
  EXPECT_NE(witness_words(witness).find("N and 0 N m as load 1"), std::string::npos) << witness_words(witness);
  witness.loads.front().couple = {2e-6};
  EXPECT_EQ(witness_words(witness).find(" 0 N m"), std::string::npos) << witness_words(witness);
}

TEST(Wording, TellsASizeApartFromItsBound) {
  core::TaskWitness witness;
  witness.kind = core::TaskWitness::Kind::beyond_bound;
  witness.beyond_bound = {{"K1", core::Quantity::F, 1}};
  witness.size = 4.99999999;
  witness.least = 5;
  EXPECT_EQ(witness_words(witness), "F_K1 is 4.99999999 N, less than 5");
  witness.size = 4.2;
  EXPECT_EQ(witness_words(witness), "F_K1 is 4.2 N, less than 5");
}

TEST(Wording, TellsWhereAGivenEffortIsAmongTheFeasibleOnes) {
  core::FeasibleEfforts efforts;
  efforts.joint = "A";
  efforts.given = true;
  const std::vector<core::Vanishing> fails = {{"B", core::Quantity::f, 1}};
  efforts.within = {-9, 9};
  efforts.ranges = {{-9, -3, {}, fails}, {2, 4, fails, fails}, {4, 9, fails, {}}};
  const auto told = [&](double effort) {
    efforts.effort = effort;
    const std::string text = feasible_efforts_text(efforts, {});
    return text.substr(text.find(" N m") + 4, text.find('\n') - text.find(" N m") - 4);
  };
  for (const double inside : {-9.0, -4.0, 3.0, 9.0}) EXPECT_EQ(told(inside), "; feasible here") << inside;
  for (const double end : {-3.0, 2.0}) EXPECT_EQ(told(end), ", at the end of a range; feasible here") << end;
  for (const double beyond : {-10.0, 0.0, 4.0, 10.0})
    EXPECT_EQ(told(beyond), ", which is not feasible; feasible here") << beyond;
  efforts.given = false;
  EXPECT_EQ(told(2), "; feasible here") << "of a least size";
  efforts.ranges.clear();
  EXPECT_EQ(told(0), "; none is feasible here");
}

TEST(Wording, TellsEachNoteOnce) {
  const std::vector<std::string> notes = {"a", "fAx is zero in every pose under these loads", "b", "a",
                                          "TP is zero in every pose under these loads"};
  EXPECT_EQ(told_once(notes), (std::vector<std::string>{"a", "fAx, TP are zero in every pose under these loads", "b"}));
}

}  // namespace
}  // namespace clearloci::report
