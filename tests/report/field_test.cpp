// Fields as colours, pictures and files.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "report/colour_map.hpp"
#include "report/field_exports.hpp"
#include "report/field_scale.hpp"
#include "report/picture.hpp"
#include "tests/report/five_bar_map.hpp"

namespace clearloci::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// CIELAB lightness of an sRGB colour.
double lightness(const Colour& colour) {
  const auto linear = [](double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); };
  const double y = 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
  return 116 * std::cbrt(y) - 16;
}

TEST(SequentialColours, RiseInLightnessByEqualSteps) {
  constexpr int steps = 16;
  for (int i = 0; i < steps; ++i) {
    const double rise =
        lightness(sequential_colour((i + 1.0) / steps)) - lightness(sequential_colour(double(i) / steps));
    EXPECT_NEAR(rise, (lightness(sequential_colour(1)) - lightness(sequential_colour(0))) / steps, 1.0);
  }
  EXPECT_NEAR(sequential_colour(-1).red, 0x44 / 255.0, 1e-12);   // viridis begins with #440154
  EXPECT_NEAR(sequential_colour(2).green, 0xe7 / 255.0, 1e-12);  // and ends with #fde725
}

TEST(DivergingColours, AreLightestAtZeroAndMirroredInLightness) {
  for (int i = 0; i < 10; ++i) {
    const double t = i / 10.0, next = t + 0.1;
    EXPECT_GT(lightness(diverging_colour(t)), lightness(diverging_colour(next)));
    EXPECT_GT(lightness(diverging_colour(-t)), lightness(diverging_colour(-next)));
    EXPECT_NEAR(lightness(diverging_colour(t)), lightness(diverging_colour(-t)), 4);
  }
  EXPECT_NEAR(diverging_colour(-1).blue, 192 / 255.0, 2e-3);
  EXPECT_NEAR(diverging_colour(1).red, 180 / 255.0, 2e-3);
  EXPECT_NEAR(diverging_colour(0).red, 221 / 255.0, 2e-2);  // Moreland's middle, (221, 221, 221)
}

TEST(FieldScale, EndsAtAPercentileWhereTheFieldHasPoles) {
  std::vector<double> values(100, 1e-4);
  values[3] = -250;
  values[4] = nan;
  const FieldScale scale = scale_of(values, true, "m");
  EXPECT_TRUE(scale.saturated && scale.diverging);
  EXPECT_EQ(scale.high, 1e-4);
  EXPECT_EQ(scale.low, -1e-4);
  EXPECT_EQ(scale.unit, "mm");
  EXPECT_EQ(saturation_words(scale), "colours end at ±0.1 mm, the 90th percentile; the largest is 250 m");
  values[3] = 1.2e-4;
  EXPECT_FALSE(scale_of(values, false, "rad").saturated);
  EXPECT_EQ(scale_of(values, false, "rad").high, 1.2e-4);
  EXPECT_EQ(scale_of(values, false, "rad").low, 0);
  EXPECT_EQ(scale_of({nan, 0}, true, "m").saturated, false);
  for (const double high : {1e-7, 3.3e-4, 0.7, 42.0}) {
    const auto ticks = scale_ticks(scale_of({high, -high}, true, "m"));
    EXPECT_GE(ticks.size(), 3u);
    EXPECT_LE(ticks.size(), 7u);
  }
}

core::FieldMap small_map() {
  core::FieldMap map;
  map.coordinates = {"x", "y"};
  map.angles = {false, false};
  map.lower = {0, -1};
  map.upper = {1, 1};
  map.axes = {{0.25, 0.75}, {-0.5, 0.5}};
  map.fields = {{"dx", "error in x", "m", true, {1e-3, nan, -2.5, 0}},
                {"dp", "distance", "m", false, {nan, nan, 7, nan}}};
  return map;
}

TEST(FieldCsv, HasARowForEveryCellWithAValue) {
  EXPECT_EQ(field_csv(small_map()),
            "x,y,dx,dp\n"
            "0.25,-0.5,0.001,\n"
            "0.25,0.5,-2.5,7\n"
            "0.75,0.5,0,\n");
}

TEST(Vti, HoldsTheFieldsAsTheyAre) {
  const std::string text = vti(small_map());
  EXPECT_NE(text.find("WholeExtent=\"0 1 0 1 0 0\" Origin=\"0.25 -0.5 0\" Spacing=\"0.5 1 1\""), std::string::npos);
  EXPECT_NE(text.find("Name=\"dp\" format=\"appended\" offset=\"40\""), std::string::npos);
  const std::size_t data = text.find("\n_") + 2;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, text.data() + data, 8);
  EXPECT_EQ(bytes, 4u * 8u);
  double value = 0;
  std::memcpy(&value, text.data() + data + 8 + 2 * 8, 8);
  EXPECT_EQ(value, -2.5);
  std::memcpy(&value, text.data() + data + 40 + 8 + 2 * 8, 8);
  EXPECT_EQ(value, 7);
}

TEST(FieldPicture, IsTheSameEachTimeAndDiffersFromThatOfTheLoci) {
  const core::LocusMap loci = fixture::five_bar_map();
  core::FieldMap map = small_map();
  map.lower = {-0.5, -1};
  const core::WorkingMode mode = fixture::elbows_out();
  for (const PictureFormat format : {PictureFormat::png, PictureFormat::svg, PictureFormat::pdf}) {
    const std::string first = field_picture(loci, mode, map, map.fields[0], format);
    // Compared as truths: the bytes of a picture are no message.
    EXPECT_TRUE(first == field_picture(loci, mode, map, map.fields[0], format));
    EXPECT_TRUE(first != picture(loci, mode, nullptr, format));
    EXPECT_GT(first.size(), 1000u);
  }
}

}  // namespace
}  // namespace clearloci::report
