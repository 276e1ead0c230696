// Every shipped example, drawn: the same points in the same poses, and the same equations.
#include <algorithm>
#include <filesystem>
#include <sstream>

#include "tests/mechanism/assembly/assembly_text.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::mechanism {
namespace {

const std::filesystem::path root = source_dir();
const std::filesystem::path twins = root / "tests/mechanism/assembly/twins";

std::vector<std::string> names_of_unknowns(const Mechanism& m) {
  std::vector<std::string> names;
  for (const Unknown& unknown : unknowns(m)) names.push_back(unknown_name(m, unknown));
  return names;
}

std::string without_comments(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) result += line.substr(0, line.find("  # ")) + "\n";
  return result;
}

/// A drawn parallelogram can be flat, and one of offsets cannot.
bool can_be_drawn(const Mechanism& example) { return example.name != "Planar delta"; }

TEST(DrawnTwins, AreTheExamples) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(root / "examples")) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const Mechanism example = read_mechanism(entry.path().string());
    if (!can_be_drawn(example)) continue;
    ASSERT_TRUE(std::filesystem::exists(twins / name)) << "draw it";
    const Mechanism twin = read_mechanism((twins / name).string());
    ASSERT_EQ(twin.coordinates.size(), example.coordinates.size());
    for (std::size_t i = 0; i < twin.coordinates.size(); ++i) {
      EXPECT_EQ(twin.coordinates[i].name, example.coordinates[i].name);
      EXPECT_EQ(twin.coordinates[i].lower, example.coordinates[i].lower);
      EXPECT_EQ(twin.coordinates[i].upper, example.coordinates[i].upper);
    }
    EXPECT_EQ(names_of_unknowns(twin), names_of_unknowns(example));
    EXPECT_GT(expect_same_places(example, twin, 40, 1e-9), 0);
    ++count;
  }
  EXPECT_GE(count, 30);
}

/// The construction that is written says the same as the drawing, word for word.
TEST(DrawnTwins, AreWrittenAsConstructions) {
  for (const char* name :
       {"five_bar", "slider_crank", "jansen_leg", "gripper", "delta", "geared_five_bar", "scara_belt"}) {
    SCOPED_TRACE(name);
    const std::string path = (twins / (std::string(name) + ".yaml")).string();
    const WrittenMechanism written = constructed_text(read_text(path, "the twin"), path);
    EXPECT_EQ(written.text.find("drawn:"), std::string::npos);
    // What is constructed stays as it is, but for the comments.
    EXPECT_EQ(constructed_text(written.text, "own.yaml").text, without_comments(written.text));
    const Mechanism twin = read_mechanism(path), mechanism = parse_mechanism(written.text, "own.yaml");
    ASSERT_EQ(twin.points.size(), mechanism.points.size());
    for (std::size_t p = 0; p < mechanism.points.size(); ++p) {
      EXPECT_EQ(twin.points[p].name, mechanism.points[p].name);
      EXPECT_EQ(twin.points[p].form.index(), mechanism.points[p].form.index());
    }
    EXPECT_EQ(working_mode(twin), working_mode(mechanism));
    EXPECT_GT(expect_same_places(mechanism, twin, 20, 1e-15), 0);
  }
}

}  // namespace
}  // namespace clearloci::mechanism
