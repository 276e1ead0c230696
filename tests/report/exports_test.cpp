#include "report/exports.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/wording.hpp"
#include "tests/report/five_bar_map.hpp"
#include "tests/report/scratch_folder.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

std::size_t vertex_count(const core::LocusMap& map) {
  std::size_t count = 0;
  for (const auto& curve : map.curves) {
    for (const auto& arc : curve.arcs) count += arc.points.size();
  }
  return count;
}

TEST(LociJson, KeysAreThoseOfTheFormatInItsOrder) {
  const Json root = loci_object(fixture::five_bar_map());
  EXPECT_EQ(keys(root), (std::vector<std::string>{"format", "mechanism", "parameters", "coordinates", "box",
                                                  "tolerance", "complete", "curves", "isolated_points", "open",
                                                  "workspace", "notes", "timing"}));
  EXPECT_EQ(keys(root["curves"][0]), (std::vector<std::string>{"id", "kind", "vanishing", "factor", "cause", "implicit",
                                                               "closed_form", "working_mode", "certified", "arcs"}));
  EXPECT_EQ(keys(root["curves"][0]["arcs"][0]), (std::vector<std::string>{"closed", "ends", "length", "points"}));
  EXPECT_EQ(keys(root["isolated_points"][0]),
            (std::vector<std::string>{"kind", "vanishing", "at", "certified", "working_mode"}));
}

TEST(LociJson, ExactNumbersAreStrings) {
  const Json root = loci_object(fixture::five_bar_map());
  EXPECT_EQ(root["parameters"], Json({{"L", "1/2"}, {"d", "1/2"}}));
  EXPECT_EQ(root["box"], Json::parse("[[-0.5, 1.0], [-1.0, 1.0]]"));
  const Json& curve = root["curves"][0];
  EXPECT_EQ(curve["closed_form"], Json::parse(R"({"circle": {"centre": ["1/2", "-1/2"], "radius": "1/2"}})"));
  EXPECT_EQ(curve["implicit"]["degree"], 2);
  EXPECT_EQ(curve["working_mode"], Json::parse(R"({"B1": "right", "B2": "left"})"));
  EXPECT_EQ(curve["vanishing"][3], Json::parse(R"({"joint": "A1", "quantity": "M"})"));
  EXPECT_EQ(curve["kind"], "contact-loss");
  EXPECT_EQ(curve["arcs"][0]["ends"], Json::parse(R"(["boundary", "boundary"])"));
}

TEST(LociJson, IrrationalRadiiLinesAndConicsKeepWhatIsExact) {
  const Json curves = loci_object(fixture::hostile_map())["curves"];
  const Json& line = curves[curves.size() - 3];
  EXPECT_EQ(line["closed_form"], Json::parse(R"({"line": {"a": "2", "b": "0", "c": "-1"}})"));
  EXPECT_EQ(line["vanishing"][0]["multiplicity"], 2);
  const Json& circle = curves[curves.size() - 2]["closed_form"]["circle"];
  EXPECT_EQ(circle["radius_squared"], "1/50");
  EXPECT_EQ(circle["radius"].get<double>(), std::sqrt(0.02));
  EXPECT_EQ(curves[curves.size() - 1]["closed_form"]["conic"]["type"], "ellipse");
  const Json sextic = loci_object(fixture::five_bar_map())["curves"][4];
  EXPECT_TRUE(sextic["closed_form"].is_null());
}

TEST(LociJson, EveryCoordinateReadsBackAsTheSameDouble) {
  core::LocusMap map = fixture::five_bar_map();
  map.curves[0].arcs[0].points[0] = {0.1 + 0.2, 1e-300};
  map.curves[0].arcs[0].points[1] = {std::nextafter(1.0, 2.0), -std::numbers::pi};
  const Json root = Json::parse(json_text(loci_object(map)));
  for (std::size_t c = 0; c < map.curves.size(); ++c) {
    for (std::size_t a = 0; a < map.curves[c].arcs.size(); ++a) {
      const auto points = root["curves"][c]["arcs"][a]["points"].get<core::Polyline>();
      ASSERT_EQ(points, map.curves[c].arcs[a].points);
    }
  }
  EXPECT_EQ(root["isolated_points"][1]["at"].get<std::vector<double>>(), map.isolated_points[1].at);
}

TEST(LociJson, HostileNamesAreEscaped) {
  const auto map = fixture::hostile_map();
  const Json root = Json::parse(json_text(loci_object(map)));
  EXPECT_EQ(root["mechanism"].get<std::string>(), printable(map.mechanism));
  EXPECT_EQ(root["curves"][0]["vanishing"][0]["joint"], "A\"<1>, &A1");
}

TEST(LociJson, TextEndsWithANewlineAndPutsPolylinesOnOneLine) {
  const std::string text = json_text(loci_object(fixture::five_bar_map()));
  EXPECT_EQ(text.back(), '\n');
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 400);
}

/// The fields of one CSV record.
std::vector<std::string> split_record(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[i++];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  return fields;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Csv, OneRowAVertexAndAnIsolatedPoint) {
  const auto map = fixture::hostile_map();
  const auto lines = lines_of(csv(map));
  EXPECT_EQ(lines[0], "curve,arc,kind,vanishing,mode,closed,x,y");
  EXPECT_EQ(lines.size(), 1 + vertex_count(map) + map.isolated_points.size());
  for (const auto& line : lines) ASSERT_EQ(split_record(line).size(), 8u) << line;
}

TEST(Csv, FieldsSayWhatTheVertexIs) {
  const auto map = fixture::hostile_map();
  const auto lines = lines_of(csv(map));
  const auto first = split_record(lines[1]);
  EXPECT_EQ(first[0], "c1");
  EXPECT_EQ(first[1], "1");
  EXPECT_EQ(first[3], reaction_names(map.curves[0].vanishing));
  EXPECT_EQ(first[4], "B<1>,\" right, B2 left");
  EXPECT_EQ(first[5], "false");
  EXPECT_EQ(std::stod(first[6]), map.curves[0].arcs[0].points[0][0]);
  EXPECT_EQ(std::stod(first[7]), map.curves[0].arcs[0].points[0][1]);
  const auto last = split_record(lines.back());
  EXPECT_EQ(last[0], "p2");
  EXPECT_EQ(last[1], "");
  EXPECT_EQ(last[6], "0.091455");
}

TEST(GeoJson, ArcsAreLineStringsWithUnitsAndMode) {
  const auto map = fixture::hostile_map();
  const Json root = Json::parse(geojson(map));
  EXPECT_EQ(root["type"], "FeatureCollection");
  EXPECT_EQ(root["units"], "m");
  std::size_t arcs = 0;
  for (const auto& curve : map.curves) arcs += curve.arcs.size();
  ASSERT_EQ(root["features"].size(), arcs + map.isolated_points.size());
  for (const auto& feature : root["features"]) {
    EXPECT_EQ(feature["type"], "Feature");
    EXPECT_EQ(feature["properties"]["units"], "m");
    EXPECT_EQ(feature["properties"]["mode"]["B2"], "left");
    EXPECT_FALSE(feature["properties"]["vanishing"].is_null());
    EXPECT_FALSE(feature["properties"]["kind"].get<std::string>().empty());
  }
  EXPECT_EQ(root["features"].back()["geometry"],
            Json::parse(R"({"type": "Point", "coordinates": [0.091455, 0.211746]})"));
}

/// The numbers between the start and end tag of the first DataArray of that name.
std::vector<double> data_array(const std::string& vtp, const std::string& name, std::size_t from = 0) {
  const std::size_t start = vtp.find('>', vtp.find("Name=\"" + name + "\"", from)) + 1;
  std::istringstream in(vtp.substr(start, vtp.find('<', start) - start));
  return {std::istream_iterator<double>(in), {}};
}

TEST(Vtp, CellsAndPointsAgreeWithTheirCounts) {
  const auto map = fixture::hostile_map();
  const std::string text = vtp(map);
  std::size_t arcs = 0;
  for (const auto& curve : map.curves) arcs += curve.arcs.size();
  const std::size_t points = vertex_count(map) + map.isolated_points.size();
  EXPECT_NE(text.find("NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfVerts=\"2\" NumberOfLines=\"" +
                      std::to_string(arcs) + "\""),
            std::string::npos);
  EXPECT_EQ(data_array(text, "Points").size(), 3 * points);
  EXPECT_EQ(data_array(text, "curve").size(), arcs + 2);
  EXPECT_EQ(data_array(text, "kind").size(), arcs + 2);
  const std::size_t lines = text.find("<Lines>");
  const auto offsets = data_array(text, "offsets", lines), connectivity = data_array(text, "connectivity", lines);
  ASSERT_EQ(offsets.size(), arcs);
  EXPECT_EQ(offsets.back(), static_cast<double>(vertex_count(map)));
  EXPECT_EQ(connectivity.front(), 2);
  EXPECT_EQ(connectivity.back(), static_cast<double>(points - 1));
}

TEST(Vtp, IsWellFormedWhateverTheNames) {
  const fixture::ScratchFolder scratch;
  write_atomically(scratch.path() / "loci.vtp", vtp(fixture::hostile_map()));
  EXPECT_TRUE(
      fixture::succeeds("/usr/bin/python3 -c \"import sys, xml.etree.ElementTree as e; e.parse(sys.argv[1])\" '" +
                        (scratch.path() / "loci.vtp").string() + "'"));
}

TEST(Wording, ModesAndClosedFormsInWords) {
  const auto map = fixture::five_bar_map();
  const auto& names = map.tower.coordinates;
  EXPECT_EQ(mode_words(map.tower, fixture::elbows_out()), "B1 right, B2 left");
  EXPECT_EQ(mode_slug(map.tower, fixture::elbows_out()), "right-left");
  EXPECT_EQ(closed_form_words(map.curves[0].closed_form, names), "circle centre (0.5, -0.5), radius 0.5");
  EXPECT_EQ(closed_form_words(map.curves[0].closed_form, names, true), "circle centre (1/2, -1/2), radius 1/2");
  EXPECT_EQ(closed_form_words(core::CircleForm{{0, 1}, core::Rational(69, 100), {}}, names),
            "circle centre (0, 1), radius 0.830662");
  EXPECT_EQ(closed_form_words(core::CircleForm{{0, 1}, core::Rational(69, 100), {}}, names, true),
            "circle centre (0, 1), radius √(69/100)");
  // (1/4, ±√3/4) with radii √(1 ± √3/2).
  core::CirclePairForm pair;
  pair.n = 3;
  pair.centre = {core::QuadraticNumber{core::Rational(1, 4), 0}, core::QuadraticNumber{0, core::Rational(1, 4)}};
  pair.radius_squared = {1, core::Rational(1, 2)};
  EXPECT_EQ(closed_form_words(pair, names), "circles centre (0.25, ±0.433013), radius 1.36603 or 0.366025");
  EXPECT_EQ(closed_form_words(pair, names, true), "circles centre (1/4, ±√3/4), radius √(1 ± √3/2)");
  EXPECT_EQ(closed_form_words(core::LineForm{2, -1, core::Rational(3, 4)}, names), "line x - 0.5 y + 0.375 = 0");
  EXPECT_EQ(closed_form_words(core::LineForm{0, -1, 0}, names), "line -y = 0");
  EXPECT_EQ(closed_form_words(core::ConicForm{"parabola", {}, {}, {}, 0}, names), "parabola");
  EXPECT_EQ(closed_form_words({}, names), "");
}

TEST(Wording, IllFormedTextBecomesPrintable) {
  EXPECT_EQ(printable("déjà №机🙂"), "déjà №机🙂");
  EXPECT_EQ(printable("a\nb\x7F"), "a\uFFFDb\uFFFD");
  EXPECT_EQ(printable("\xC0\xAF"), "\uFFFD\uFFFD");                 // overlong
  EXPECT_EQ(printable("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");       // a surrogate
  EXPECT_EQ(printable("x\xE2\x82"), "x\uFFFD\uFFFD");               // cut short
  EXPECT_EQ(printable("\xF4\x90\x80\x80").substr(0, 3), "\uFFFD");  // beyond U+10FFFF
}

}  // namespace
}  // namespace clearloci::report
