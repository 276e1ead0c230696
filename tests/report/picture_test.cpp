#include "report/picture.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <set>

#include "report/files.hpp"
#include "report/layout.hpp"
#include "report/png.hpp"
#include "report/svg_text.hpp"
#include "tests/report/five_bar_map.hpp"
#include "tests/report/scratch_folder.hpp"

namespace clearloci::report {
namespace {

constexpr PictureFormat formats[] = {PictureFormat::svg, PictureFormat::pdf, PictureFormat::png};

std::string five_bar_picture(const core::LocusMap& map, PictureFormat format) {
  const auto sketch = fixture::five_bar_sketch(fixture::elbows_out());
  return picture(map, fixture::elbows_out(), &sketch, format);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Preload loci that part no zones would cover those that do.
TEST(Picture, OfZonesHasPreloadLociThatBorderThem) {
  core::Zones map;
  map.loci = fixture::five_bar_map();
  const auto locus = [&](const std::string& id, const std::string& joint) {
    core::LocusCurve curve;
    curve.id = id;
    curve.kind = core::LocusKind::preload;
    curve.mode = fixture::elbows_out();
    curve.vanishing = {{joint, core::Quantity::F, 1}};
    curve.arcs.emplace_back().points = {{0, -0.5}, {0.1, -0.6}};
    map.loci.curves.push_back(curve);
  };
  locus("c91", "K1");
  locus("c92", "K2");
  core::Zone& zone = map.zones.emplace_back();
  zone.id = "z1";
  zone.mode = fixture::elbows_out();
  zone.outer = {{0, -0.5}, {0.1, -0.6}, {0.2, -0.5}, {0, -0.5}};
  zone.ball = {{0.1, -0.52}, 0.01};
  zone.borders = {{"c91", 0.1, core::LocusKind::preload, {{"K1", core::Quantity::F, 1}}, {}}};
  const std::string svg = zone_picture(map, fixture::elbows_out(), PictureFormat::svg);
  EXPECT_TRUE(has(svg, "F_K1"));
  EXPECT_FALSE(has(svg, "F_K2"));
  EXPECT_TRUE(has(svg, "backlash: A1")) << "others stay";
}

TEST(Picture, LegendNamesJointsAndReasons) {
  const std::string svg = five_bar_picture(fixture::five_bar_map(), PictureFormat::svg);
  EXPECT_TRUE(has(svg, "contact lost: A1, B1, P; backlash: A1 — link PB2 parallel to the load\n"));
  EXPECT_TRUE(has(svg, "backlash: A1 — A1, B1, P aligned\n"));
  EXPECT_TRUE(has(svg, "direct singularity\nworkspace boundary\nisolated points — contact lost: A1\n"));
}

TEST(Picture, CurvesOfOneReasonShareAnEntry) {
  const std::string svg = five_bar_picture(fixture::five_bar_map(), PictureFormat::svg);
  const std::size_t begin = svg.find("<desc>"), end = svg.find("</desc>");
  ASSERT_LT(begin, end);
  EXPECT_EQ(std::count(svg.begin() + static_cast<std::ptrdiff_t>(begin), svg.begin() + static_cast<std::ptrdiff_t>(end),
                       '\n'),
            7);
}

TEST(Picture, FilesAreWhatTheirNamesSay) {
  const auto map = fixture::five_bar_map();
  EXPECT_EQ(five_bar_picture(map, PictureFormat::svg).substr(0, 5), "<?xml");
  EXPECT_EQ(five_bar_picture(map, PictureFormat::pdf).substr(0, 5), "%PDF-");
  EXPECT_EQ(five_bar_picture(map, PictureFormat::png).substr(0, 8), "\x89PNG\r\n\x1A\n");
}

TEST(Picture, TheSameMapGivesTheSameBytesInOneProcessAndInTwo) {
  const auto map = fixture::hostile_map();
  const fixture::ScratchFolder scratch;
  for (const auto format : formats) {
    const std::string first = five_bar_picture(map, format);
    EXPECT_EQ(first, five_bar_picture(map, format));
    // A child that has drawn something else before has other numbers in Cairo's counters.
    const std::string path = (scratch.path() / "child").string();
    const pid_t child = ::fork();
    if (child == 0) {
      five_bar_picture(fixture::five_bar_map(), PictureFormat::svg);
      write_atomically(path, five_bar_picture(map, format));
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(first, fixture::read_file(path));
  }
}

TEST(Picture, PdfHasAFixedDate) {
  const std::string pdf = five_bar_picture(fixture::five_bar_map(), PictureFormat::pdf);
  EXPECT_TRUE(has(pdf, "20000101"));
}

TEST(Picture, SvgIsWellFormedWhateverTheNames) {
  const fixture::ScratchFolder scratch;
  write_atomically(scratch.path() / "loci.svg", five_bar_picture(fixture::hostile_map(), PictureFormat::svg));
  EXPECT_TRUE(
      fixture::succeeds("/usr/bin/python3 -c \"import sys, xml.etree.ElementTree as e; e.parse(sys.argv[1])\" '" +
                        (scratch.path() / "loci.svg").string() + "'"));
}

TEST(Picture, SvgHasNoNumberOfMoreThanThreeDecimals) {
  const std::string svg = five_bar_picture(fixture::five_bar_map(), PictureFormat::svg);
  std::size_t decimals = 0;
  bool after_point = false;
  for (const char c : svg) {
    const bool digit = c >= '0' && c <= '9';
    after_point = c == '.' || (after_point && digit);
    decimals = after_point && digit ? decimals + 1 : 0;
    ASSERT_LE(decimals, 3u);
  }
}

TEST(SvgText, NumbersAreRoundedNotCut) {
  const std::string svg = "<svg a=\"1\">\n<g id=\"surface7\" d=\"M 0.9996 -1.23456 L 10.50000 3\"/></svg>";
  EXPECT_EQ(finish_svg(svg, "a<b", "\"c\""),
            "<svg a=\"1\" role=\"img\">\n<title>a&lt;b</title>\n<desc>&quot;c&quot;</desc>\n"
            "<g d=\"M 1 -1.235 L 10.5 3\"/></svg>");
}

TEST(SvgText, NumbersAreRoundedAsTheNearestDoublesAre) {
  std::mt19937 random(7);
  std::string svg = "<svg >\n", rounded = "<svg  role=\"img\">\n<title></title>\n<desc></desc>\n";
  const auto text = [](const char* format, auto... values) {
    std::array<char, 64> bytes{};
    std::snprintf(bytes.data(), bytes.size(), format, values...);
    return std::string(bytes.data());
  };
  const auto add = [&](const std::string& number) {
    svg += number + " ";
    std::string shown = text("%.3f", std::stod(number));
    shown.erase(shown.find_last_not_of('0') + 1);
    if (shown.back() == '.') shown.pop_back();
    rounded += shown + " ";
  };
  for (const char* const edge : {"9.9996", "99.99951", "0.9995", "0.0005", "2.0015", "7.12350", "1.00049999", "0.0004"})
    add(edge);
  for (int i = 0; i < 20000; ++i)
    add(text("%d.%0*d", static_cast<int>(random() % 1500), static_cast<int>(4 + random() % 4),
             static_cast<int>(random() % 10000)));
  EXPECT_EQ(finish_svg(svg, "", ""), rounded);
}

/// Big-endian number at `at`.
std::size_t number_at(const std::string& bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// What follows the length and the type of a PNG's data.
std::string data_of(const std::string& png) {
  const std::size_t at = png.find("IDAT");
  return png.substr(at + 4, number_at(png, at - 4));
}

/// The bytes of a PNG's rows; `most`: how many they may be.
std::string inflated(const std::string& data, std::size_t most) {
  std::string rows(most, '\0');
  uLongf size = rows.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(rows.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
                       data.size()),
            Z_OK);
  rows.resize(size);
  return rows;
}

/// Decodes what encode_png writes, by the format's specification: sizes, checksums, unfiltered rows.
TEST(Png, PixelsComeBack) {
  constexpr int width = 3, height = 2, stride = 16;
  std::string pixels(stride * height, '\x77');
  const auto set = [&](int x, int y, std::uint32_t pixel) { std::memcpy(&pixels[y * stride + 4 * x], &pixel, 4); };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) set(x, y, 0xFF000000u + 0x010203u * static_cast<unsigned>(1 + x + 10 * y));
  }
  const std::string png = encode_png(reinterpret_cast<const unsigned char*>(pixels.data()), width, height, stride, 144);
  std::string types, data;
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t size = number_at(png, at);
    const std::string type = png.substr(at + 4, 4);
    EXPECT_EQ(number_at(png, at + 8 + size),
              crc32(0, reinterpret_cast<const Bytef*>(&png[at + 4]), static_cast<uInt>(size + 4)))
        << type;
    types += type + " ";
    if (type == "IDAT") data = png.substr(at + 8, size);
    if (type == "IHDR") {
      EXPECT_EQ(number_at(png, at + 8), 3u);
      EXPECT_EQ(number_at(png, at + 12), 2u);
    }
    at += size + 12;
  }
  EXPECT_EQ(types, "IHDR pHYs IDAT IEND ");
  std::string expected;
  for (int y = 0; y < height; ++y) {
    expected += '\0';
    for (int x = 0; x < width; ++x) {
      for (const int factor : {1, 2, 3}) expected += static_cast<char>(factor * (1 + x + 10 * y));
    }
  }
  EXPECT_EQ(inflated(data, 100), expected);
}

TEST(Png, RowsAreCompressedAsIfTheyCameAtOnce) {
  constexpr int width = 700, height = 400;
  std::mt19937 random(3);
  std::vector<std::uint32_t> pixels(width * height, 0xFFFFFFU);
  for (int i = 0; i < 60000; ++i)
    pixels[random() % pixels.size()] = random() % 5 == 0 ? 0x336699U : static_cast<std::uint32_t>(random());
  const std::string data =
      data_of(encode_png(reinterpret_cast<const unsigned char*>(pixels.data()), width, height, 4 * width, 144));
  EXPECT_GT(data.size(), std::size_t{1} << 16) << "several pieces";
  const std::string rows = inflated(data, height * (3 * width + 1));
  uLongf size = compressBound(rows.size());
  std::string at_once(size, '\0');
  ASSERT_EQ(compress2(reinterpret_cast<Bytef*>(at_once.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
                      rows.size(), 1),
            Z_OK);
  at_once.resize(size);
  EXPECT_TRUE(data == at_once);
  std::size_t at = 0;
  for (const std::uint32_t pixel : pixels) {
    if (at % (3 * width + 1) == 0) ++at;
    for (const int shift : {16, 8, 0}) ASSERT_EQ(static_cast<unsigned char>(rows[at++]), (pixel >> shift) & 0xFF);
  }
  EXPECT_EQ(at, rows.size());
}

struct Case {
  core::LocusMap map;
  core::Sketch sketch;
};

/// Ordinary, hostile, wide, and with far more groups than fit beside the plot.
std::vector<Case> layouts_to_try() {
  std::vector<Case> cases;
  const auto sketch = fixture::five_bar_sketch(fixture::elbows_out());
  cases.push_back({fixture::five_bar_map(), sketch});
  cases.push_back({fixture::hostile_map(), sketch});
  core::LocusMap wide = fixture::five_bar_map();
  wide.lower[1] = core::Rational(-7, 10);
  wide.upper[1] = core::Rational(-69, 100);
  cases.push_back({wide, {}});
  core::LocusMap crowded = fixture::hostile_map();
  for (int i = 0; i < 20; ++i) {
    auto curve = crowded.curves[0];
    curve.kind = static_cast<core::LocusKind>(i % 4);
    curve.cause = "Averyveryverylongcausewithoutanyspacethatmustbecutsomewhere and a second part " + std::to_string(i);
    crowded.curves.push_back(curve);
  }
  crowded.complete = false;
  crowded.out_of_time = true;
  cases.push_back({crowded, sketch});
  return cases;
}

bool overlap(const Box& a, const Box& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

TEST(Layout, NothingIsClippedAndNothingOverlaps) {
  for (const auto& one : layouts_to_try()) {
    const Subject subject{&one.map, fixture::elbows_out(), groups_of_mode(group_loci(one.map), fixture::elbows_out()),
                          one.sketch.joints.empty() ? nullptr : &one.sketch};
    const Layout layout = lay_out(subject);
    const Measure measure = measure_in(legend_font);
    EXPECT_GE(layout.plot.x, 0);
    EXPECT_LE(layout.plot.right(), layout.width);
    EXPECT_LE(layout.plot.bottom(), layout.height);
    for (const auto& line : layout.head.lines) {
      EXPECT_LE(line.x + text_width(line.text, line.font), layout.width) << line.text;
      EXPECT_LT(line.y, layout.plot.y);
    }
    for (std::size_t i = 0; i < layout.legend.size(); ++i) {
      const auto& entry = layout.legend[i];
      EXPECT_FALSE(overlap(entry.box, layout.plot));
      EXPECT_GE(entry.box.x, 0);
      EXPECT_LE(entry.box.right(), layout.width);
      EXPECT_LE(entry.box.bottom(), layout.height);
      for (const auto& line : entry.lines) {
        EXPECT_LE(legend_sample_width + legend_sample_gap + measure(line.text), entry.box.width + 1e-6) << line.text;
      }
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(entry.box, layout.legend[j].box)) << i << ", " << j;
    }
  }
}

TEST(Layout, AxesHaveOneScaleAndPointUp) {
  const auto map = fixture::five_bar_map();
  const Layout layout = lay_out({&map, fixture::elbows_out(), {}, nullptr});
  const auto origin = layout.page({0, 0}), right = layout.page({1, 0}), up = layout.page({0, 1});
  EXPECT_DOUBLE_EQ(right[0] - origin[0], origin[1] - up[1]);
  EXPECT_GT(right[0], origin[0]);
  EXPECT_LT(up[1], origin[1]);
  EXPECT_EQ(layout.x_label, "x (m)");
  EXPECT_EQ(layout.y_label, "y (m)");
  std::vector<std::string> labels;
  for (const auto& tick : layout.y_ticks) labels.push_back(tick.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"\u22121.0", "\u22120.5", "0.0", "0.5", "1.0"}));
}

TEST(Groups, LookAlikeInEveryModeAndDifferWithinOne) {
  const auto map = fixture::five_bar_map_in_all_modes();
  const Groups groups = group_loci(map);
  std::set<std::string> looks;
  for (const auto& group : groups.curves) {
    std::string look = std::to_string(group.stroke.colour.red) + std::to_string(group.stroke.colour.green) +
                       std::to_string(group.stroke.colour.blue);
    looks.insert(look);
  }
  EXPECT_EQ(looks.size(), groups.curves.size());
  for (const auto& region : map.workspace) {
    const Groups mode = groups_of_mode(groups, region.mode);
    ASSERT_EQ(mode.curves.size(), groups.curves.size());
    for (std::size_t i = 0; i < mode.curves.size(); ++i) {
      EXPECT_EQ(mode.curves[i].stroke.dash, groups.curves[i].stroke.dash);
      EXPECT_EQ(mode.curves[i].stroke.colour.red, groups.curves[i].stroke.colour.red);
      for (const auto* curve : mode.curves[i].curves) EXPECT_EQ(curve->mode, region.mode);
    }
  }
}

/// A print in grey has width and dashes only.
TEST(Groups, KindsDifferWithoutColour) {
  const auto map = fixture::hostile_map();
  std::set<std::pair<double, std::vector<double>>> looks;
  const Groups groups = group_loci(map);
  for (const auto& group : groups.curves) looks.insert({group.stroke.width, group.stroke.dash});
  EXPECT_EQ(looks.size(), groups.curves.size());
}

}  // namespace
}  // namespace clearloci::report
