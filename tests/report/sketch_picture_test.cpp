// The mechanism in pictures: beside loci over one and three coordinates, with its springs and the names that the legend
// uses.
#include <gtest/gtest.h>

#include "report/label_places.hpp"
#include "report/layout.hpp"
#include "report/page_head.hpp"
#include "report/picture.hpp"
#include "tests/report/five_bar_map.hpp"

namespace clearloci::report {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++times;
  return times;
}

/// Height of an SVG in points.
double height(const std::string& svg) { return std::stod(svg.substr(svg.find(" height=\"") + 9)); }

core::Sketch two_links() {
  core::Sketch sketch;
  sketch.links = {{"crank", {{0, 0}, {0.1, 0.1}}}, {"rod", {{0.1, 0.1}, {0.4, 0}}}};
  sketch.joints = {{"A", {0, 0}, true, true}, {"B", {0.1, 0.1}}, {"C", {0.4, 0}, true}};
  return sketch;
}

core::LocusMap over_an_angle(const std::string& cause) {
  core::LocusMap map;
  map.mechanism = "Crank";
  map.tower.coordinates = {"theta"};
  map.angles = {true};
  map.lower = {0};
  map.upper = {6};
  map.reachable = {{{}, 0, 6}};
  map.isolated_points = {{core::LocusKind::contact_loss, {{"B", core::Quantity::f}}, {1.5}, {}, true, "x", cause}};
  map.complete = true;
  return map;
}

std::string drawn(const core::LocusMap& map, const core::Sketch* sketch) {
  return picture(map, {}, sketch, PictureFormat::svg, true);
}

TEST(LabelPlaces, CoverNeitherWhatIsDrawnNorOneAnother) {
  LabelPlaces labels({0, 0, 100, 100});
  labels.occupy({40, 40, 20, 20}, 0.5);
  const std::vector<core::Point2> places = {{50, 50}, {50, 20}, {50, 80}};
  EXPECT_EQ(labels.take(places, 20, 10), (core::Point2{50, 20})) << "the first is occupied";
  EXPECT_EQ(labels.take(places, 20, 10), (core::Point2{50, 80})) << "and the second has a label now";
  EXPECT_EQ(labels.take({{50, 50}}, 20, 10), (core::Point2{50, 50})) << "there is no other place";
  EXPECT_EQ(labels.take({{2, 98}}, 20, 10), (core::Point2{10, 95})) << "labels stay in the room";
  LabelPlaces beside({0, 0, 100, 100});
  beside.occupy({0, 50}, {100, 50}, 4, 0.5);
  EXPECT_EQ(beside.take({{50, 50}, {50, 30}}, 20, 10), (core::Point2{50, 30})) << "a bar is left in sight";
}

TEST(PageHead, WrapsItsLinesAndSaysWhereTheyEnd) {
  const PageHead one = page_head("Crank", "", 20, 200), two = page_head("Crank", "Working mode: B left", 20, 200);
  ASSERT_EQ(two.lines.size(), 2U);
  EXPECT_LT(two.lines[0].y, two.lines[1].y);
  EXPECT_LT(two.lines[1].y, two.bottom);
  EXPECT_LT(one.bottom, two.bottom);
  const std::string title = "A mechanism whose name is longer than the page is wide";
  for (const TitleLine& line : page_head(title, title, 20, 150).lines) {
    EXPECT_EQ(line.x, 20);
    EXPECT_LE(text_width(line.text, line.font), 150) << line.text;
  }
}

TEST(SketchPicture, StandsBelowLociOverOneCoordinate) {
  const core::LocusMap map = over_an_angle("A, B, C aligned");
  const core::Sketch sketch = two_links();
  const std::string with = drawn(map, &sketch), without = drawn(map, nullptr);
  EXPECT_GT(height(with), height(without) + 200);
  // Nine strokes of bars and brackets at least: two links of an outline and a fill, three pins, two brackets.
  EXPECT_GT(count(with, "<path"), count(without, "<path") + 9);
}

TEST(SketchPicture, StandsBelowSurfaces) {
  core::LocusMap map;
  map.mechanism = "Platform";
  map.tower.coordinates = {"x", "y", "z"};
  map.lower = {0, 0, 0};
  map.upper = {1, 1, 1};
  map.complete = true;
  core::LocusSurface triangle;
  triangle.vertices = {{0.2, 0.2, 0.5}, {0.8, 0.2, 0.5}, {0.5, 0.8, 0.5}};
  triangle.triangles = {{0, 1, 2}};
  triangle.vanishing = {{"B", core::Quantity::f}};
  map.surfaces = {triangle};
  const core::Sketch sketch = two_links();
  EXPECT_GT(height(drawn(map, &sketch)), height(drawn(map, nullptr)) + 200);
}

/// Letters of a word are glyphs that are used: the name of a link is written where the reason speaks of it, in its
/// whole.
TEST(SketchPicture, NamesTheLinksOfTheLegend) {
  const core::Sketch sketch = two_links();
  core::Sketch other = sketch;
  other.links[1].name = "bar";
  const core::LocusMap map = over_an_angle("link rod parallel to the load");
  EXPECT_EQ(count(drawn(map, &sketch), "<use"), count(drawn(map, &other), "<use") + 3);
  other.links[1].name = "ro";
  EXPECT_EQ(count(drawn(map, &sketch), "<use"), count(drawn(map, &other), "<use") + 3) << "a part of a word is no name";
}

TEST(SketchPicture, DrawsTorsionSpringsAsCoilsAndOthersAsZigzags) {
  const core::LocusMap map = over_an_angle("");
  const core::Sketch bare = two_links();
  core::Sketch torsion = bare, pulled = bare;
  torsion.springs = {{{0.1, 0.1}, {}, true}};
  pulled.springs = {{{0, 0}, {0.4, 0}, false}};
  const std::string without = drawn(map, &bare);
  EXPECT_EQ(count(drawn(map, &torsion), " L "), count(without, " L ") + 72) << "a turn and a half in steps of 7.5 deg";
  EXPECT_EQ(count(drawn(map, &pulled), " L "), count(without, " L ") + 17) << "two leads and seven turns";
}

/// Nothing reaches out of the box, whatever the scale: rails, springs and arrows, which are of one size on the page.
TEST(SketchPicture, FitsItsBox) {
  core::Sketch sketch = two_links();
  sketch.slides = {{{-0.3, 0}, {0.9, 0}, true, false}};
  sketch.springs = {{{0, 0}, {0.2, 0.9}, false}};
  sketch.loads = {{{0.4, 0}, {0, -100}, 0}, {{0.1, 0.1}, {50, 0}, 0}};
  const Box box = {10, 20, 300, 200};
  const Layout layout = lay_out_alone(sketch, box);
  constexpr double arrow = 40, room = 30;
  const auto inside = [&](const core::Point2& at, double dx = 0, double dy = 0) {
    const core::Point2 page = layout.page(at);
    return page[0] + dx > box.x + room && page[0] + dx < box.right() - room && page[1] + dy > box.y + room &&
           page[1] + dy < box.bottom() - room;
  };
  for (const core::SketchLink& link : sketch.links)
    for (const core::Point2& at : link.points) EXPECT_TRUE(inside(at));
  EXPECT_TRUE(inside({-0.3, 0}) && inside({0.9, 0}));
  EXPECT_TRUE(inside({0.2, 0.9}));
  EXPECT_TRUE(inside({0.4, 0}, 0, arrow));
  EXPECT_TRUE(inside({0.1, 0.1}, arrow, 0));
}

}  // namespace
}  // namespace clearloci::report
