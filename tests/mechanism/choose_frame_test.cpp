// The frame of a mechanism goes with it: moved, it is the same mechanism in its frame.
#include <gtest/gtest.h>

#include <filesystem>

#include "mechanism/frame.hpp"
#include "mechanism/read.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::mechanism {
namespace {

/// Its numbers, as text.
std::vector<std::string> numbers_of(const Mechanism& m) {
  std::vector<std::string> list;
  const auto add = [&](const Expression& e) { list.push_back(core::to_string(e)); };
  for (const Coordinate& c : m.coordinates)
    for (const Rational& end : {c.lower, c.upper}) list.push_back(core::to_string(end));
  for (const Point& point : m.points) {
    if (const auto* explicit_point = std::get_if<ExplicitPoint>(&point.form))
      std::for_each(explicit_point->coordinates.begin(), explicit_point->coordinates.end(), add);
    if (const auto* dyad_point = std::get_if<DyadPoint>(&point.form))
      add(dyad_point->from_length), add(dyad_point->to_length);
    if (const auto* offset_point = std::get_if<OffsetPoint>(&point.form))
      add(offset_point->along), add(offset_point->left);
    if (const auto* slider_point = std::get_if<SliderPoint>(&point.form)) add(slider_point->length);
  }
  return list;
}

class ChosenFrames : public testing::TestWithParam<std::string> {
 protected:
  /// The example with its places and lengths as in p = origin + scale p'; lengths that are no places stay.
  static Mechanism seen(const Mechanism& m, const Frame& from) {
    const Frame frame_of_model = frame_of(m);
    Frame frame = from;
    frame.from.resize(m.coordinates.size());
    for (std::size_t q = 0; q < m.coordinates.size(); ++q)
      for (std::size_t i = 0; i < dimension(m); ++i)
        if (!m.coordinates[q].angle && is_place(m, q, i)) frame.from[q] = from.origin[i];
    Mechanism result = in_frame(m, frame).value();
    result.frame.reset();
    return result;
  }

 private:
  /// By its name: examples call places x, y and z.
  static bool is_place(const Mechanism& m, std::size_t q, std::size_t i) {
    return m.coordinates[q].name == std::string(1, "xyz"[i]);
  }
};

TEST_P(ChosenFrames, GoWithTheMechanism) {
  const Mechanism m = read_mechanism(GetParam());
  const Frame frame_of_model = frame_of(m);
  const auto inside = in_frame(m, frame_of_model);
  ASSERT_TRUE(inside);
  Frame by;
  by.origin = {core::Rational(-17, 3), core::Rational(1000000), core::Rational(22, 7)};
  if (dimension(m) == 2) by.origin[2] = 0;
  const Mechanism moved = seen(m, by);
  const Frame other = frame_of(moved);
  EXPECT_EQ(other.scale, frame_of_model.scale);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(other.origin[i], frame_of_model.origin[i] - by.origin[i]) << i;
  EXPECT_EQ(numbers_of(in_frame(moved, other).value()), numbers_of(*inside));
  EXPECT_TRUE(is_far(moved));
}

TEST_P(ChosenFrames, AreScaledWhereMetresAreFarFromTheSize) {
  const Mechanism m = read_mechanism(GetParam());
  Frame by;
  std::vector<std::vector<std::string>> numbers;
  for (const int exponent : {16, 20}) {
    by.scale = core::Rational(core::Rational(1) >> static_cast<unsigned>(exponent));
    const Mechanism large = seen(m, by);
    const Frame frame_of_model = frame_of(large);
    EXPECT_NE(frame_of_model.scale, 1);
    numbers.push_back(numbers_of(in_frame(large, frame_of_model).value()));
  }
  EXPECT_EQ(numbers[0], numbers[1]);
}

TEST_P(ChosenFrames, AreNotFarFromTheUsualOneNearTheOrigin) { EXPECT_FALSE(is_far(read_mechanism(GetParam()))); }

/// By their names alone: every test of this program lists them as it starts.
std::vector<std::string> examples() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(source_dir()) / "examples"))
    if (entry.path().extension() == ".yaml" && entry.path().stem().extension().empty())
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

INSTANTIATE_TEST_SUITE_P(Examples, ChosenFrames, testing::ValuesIn(examples()),
                         [](const auto& test) { return std::filesystem::path(test.param).stem().string(); });

}  // namespace
}  // namespace clearloci::mechanism
