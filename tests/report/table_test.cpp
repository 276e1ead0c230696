#include <gtest/gtest.h>

#include <sstream>

#include "report/loci_table.hpp"
#include "report/text_table.hpp"
#include "report/wording.hpp"
#include "report/wrap.hpp"
#include "tests/report/five_bar_map.hpp"

namespace clearloci::report {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(LociTable, SaysWhatVanishesWhereAndHow) {
  const std::string table = loci_table(fixture::five_bar_map());
  for (const char* part :
       {"Planar 5R manipulator", "L = 0.5, d = 0.5", "Working mode: B1 right, B2 left", "f: A1, B1, P; M: A1",
        "link PB2 parallel to the load", "circle centre (0.5, -0.5), radius 0.5", "direct singularity",
        "workspace boundary", "backlash", "isolated points", "-0.198205"}) {
    EXPECT_TRUE(has(table, part)) << part << "\n" << table;
  }
}

TEST(LociTable, FitsTheTerminalAndItsColumnsAlign) {
  for (const auto& map : {fixture::five_bar_map(), fixture::five_bar_map_in_all_modes(), fixture::hostile_map()}) {
    std::istringstream in(loci_table(map));
    int degree_column = 0;
    for (std::string line; std::getline(in, line);) {
      EXPECT_LE(columns(line), 120) << line;
      const std::size_t degree = line.find("degree");
      if (degree != std::string::npos) degree_column = columns(line.substr(0, degree)) + 6;
      if (has(line, "circle centre (0.5, 0.5)")) {
        EXPECT_EQ(columns(line.substr(0, line.find("circle"))), degree_column + 2) << line;
      }
    }
  }
}

TEST(LociTable, LongFactorsDoNotFillTheScreen) {
  core::LocusMap map = fixture::five_bar_map();
  map.curves[0].cause = "";
  map.curves[0].factor = std::string(5000, 'x');
  EXPECT_FALSE(has(loci_table(map), "xxxx"));
}

TEST(LociTable, NotesUncertaintyAndIncompletenessAreSaid) {
  core::LocusMap map = fixture::five_bar_map();
  EXPECT_FALSE(has(loci_table(map), "certified"));
  map.curves[1].certified = false;
  map.complete = false;
  map.out_of_time = true;
  map.notes = {"M_A2 vanishes in every pose"};
  const std::string table = loci_table(map);
  EXPECT_TRUE(has(table, "c2*"));
  EXPECT_TRUE(has(table, "not certified"));
  EXPECT_TRUE(has(table, "Incomplete"));
  EXPECT_TRUE(has(table, "M_A2 vanishes in every pose"));
}

TEST(LociTable, NothingIsSaidOfWhatTheTimeLimitCutOff) {
  core::LocusMap map = fixture::five_bar_map();
  map.curves.clear();
  map.isolated_points.clear();
  map.out_of_time = true;
  EXPECT_TRUE(has(loci_table(map), "nothing was found before the time limit"));
  EXPECT_FALSE(has(loci_table(map), "no curves"));
}

TEST(LociTable, OpenPlacesAreCountedBesideTheirCurve) {
  core::LocusMap map = fixture::five_bar_map();
  map.complete = false;
  const core::LocusCurve& curve = map.curves[0];
  const double x = core::to_double(map.lower[0]), y = core::to_double(map.lower[1]);
  const double wide = core::to_double(map.upper[0]) - x, high = core::to_double(map.upper[1]) - y;
  core::OpenRegion region{curve.kind, curve.vanishing, curve.factor, curve.cause, curve.mode, {x, y}, {}};
  region.upper = {x + wide / 10, y + high / 10};
  map.open = {region, region};
  std::string table = loci_table(map);
  EXPECT_TRUE(has(table, "open: 2 places, 2 % of the box"));
  EXPECT_TRUE(has(table, "Incomplete"));
  EXPECT_FALSE(has(table, "time limit"));
  // Of a locus of which nothing is drawn.
  map.open[1].factor = "another";
  map.open[1].cause = "something else";
  map.open[1].upper = map.open[1].lower;
  table = loci_table(map);
  EXPECT_TRUE(has(table, "open: 1 place, 1 % of the box"));
  EXPECT_TRUE(has(table, "open: 1 place, below 0.001 %"));
  EXPECT_TRUE(has(table, "something else"));
}

TEST(LociTable, AnEmptyMapIsAnAnswer) {
  core::LocusMap map;
  map.mechanism = "nothing";
  EXPECT_EQ(loci_table(map), "nothing\n\nno curves\n");
}

/// What is in doubt is not out of reach.
TEST(LociTable, ARangeInDoubtIsNotOutOfReach) {
  core::LocusMap map;
  map.mechanism = "nothing";
  map.tower.coordinates = {"q"};
  map.complete = true;
  EXPECT_TRUE(has(loci_table(map), "out of reach in the whole range"));
  map.complete = false;
  EXPECT_FALSE(has(loci_table(map), "out of reach"));
  EXPECT_TRUE(has(loci_table(map), "nothing is proven: all that may be in reach is in doubt"));
}

TEST(TextTable, AlignsNumbersByTheirPointsAndLeavesOutEmptyColumns) {
  const std::vector<Column> heading = {
      {"joint"}, {"f [N]", 0, Alignment::point}, {"N [N]", 0, Alignment::point}, {"M [N m]", 0, Alignment::point}};
  const std::vector<Row> rows = {{"A", "-12.5", "", "100"}, {"long", "0", "", ""}, {"C", "250e-6", "", "undefined"}};
  EXPECT_EQ(format_filled_columns(heading, rows),
            "joint   f [N]    M [N m]\n"
            "─────  ──────  ─────────\n"
            "A      -12.5         100\n"
            "long     0\n"
            "C      250e-6  undefined\n");
}

TEST(Wrap, LinesFitAndNothingIsLost) {
  const Measure measure = [](std::string_view text) { return static_cast<double>(columns(text)); };
  EXPECT_EQ(wrap("", 5, measure), (std::vector<std::string>{""}));
  EXPECT_EQ(wrap("  one two  three", 7, measure), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrap("abcdefgh ij", 3, measure), (std::vector<std::string>{"abc", "def", "gh", "ij"}));
  EXPECT_EQ(wrap("éééé", 3, measure), (std::vector<std::string>{"ééé", "é"}));
  EXPECT_EQ(wrap("ab", 0, measure), (std::vector<std::string>{"a", "b"})) << "a line has a character at least";
}

}  // namespace
}  // namespace clearloci::report
