// All files of files/: each is read and closes, or is refused by the name of what is at fault.
#include <algorithm>
#include <filesystem>

#include "tests/mechanism/import/imported.hpp"

namespace clearloci::mechanism {
namespace {

struct Refused {
  const char* file;
  const char* words;
};

/// What cannot be read, and the words that name it.
const std::vector<Refused> refused = {
    {"linkage/curved_slot.linkage2", "connector C1 slides along an arc"},
    {"mjcf/free_body.xml", "body box is free"},
    {"mjcf/curved_equality.xml", "equality joint1 is of two joints in no constant ratio"},
    {"sdf/screw.sdf", "joint B is of type 'screw'"},
    {"urdf/mimic_across.urdf", "joint b follows joint a, but the mechanism is not in one plane"},
};

std::vector<std::string> files() {
  std::vector<std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path_of("")))
    if (entry.is_regular_file() && entry.path().extension() != ".yaml")
      all.push_back(entry.path().lexically_relative(path_of("")).string());
  std::sort(all.begin(), all.end());
  return all;
}

class EveryFile : public testing::TestWithParam<std::string> {};

TEST_P(EveryFile, IsReadOrRefusedByName) {
  const auto found = std::find_if(refused.begin(), refused.end(),
                                  [](const Refused& candidate) { return candidate.file == GetParam(); });
  if (found != refused.end()) {
    const std::string why = refusal_of_file(GetParam());
    EXPECT_NE(why.find(found->words), std::string::npos) << why;
    EXPECT_NE(why.find(std::filesystem::path(GetParam()).filename().string() + ":"), std::string::npos) << why;
    return;
  }
  const Imported file = imported(GetParam());
  EXPECT_FALSE(file.format.empty());
  EXPECT_TRUE(import_format(file.text).empty());
  if (GetParam() == "cuik/legs.world") return;  // six legs close together: another test
  const Mechanism m = mechanism_of(file);
  EXPECT_FALSE(m.coordinates.empty());
  EXPECT_TRUE(has_note(file, "the source gives no clearances"));
  EXPECT_TRUE(has_note(file, "the end effector is "));
}

/// The angle of a link's first two points, or between two links, as the workspace of an imported file has them.
std::optional<double> drawn_angle(const Imported& imported, const Mechanism& m, const std::string& coordinate) {
  const auto drawn = places(imported);
  const auto direction = [&](const std::string& name) {
    for (const Link& link : m.links) {
      if (link.name != name || link.points.size() < 2) continue;
      const auto &p = drawn.at(m.points[static_cast<std::size_t>(link.points[0])].name),
                 &q = drawn.at(m.points[static_cast<std::size_t>(link.points[1])].name);
      return std::atan2(q[1] - p[1], q[0] - p[0]);
    }
    return 0.0;
  };
  for (const Entry& entry : entries(parse_document(imported.text, "own.yaml"))) {
    if (entry.key != "workspace") continue;
    for (const Entry& one : entries(entry.value)) {
      if (one.key != coordinate) continue;
      for (const Entry& part : entries(one.value)) {
        if (part.key != "of") continue;
        if (part.value.is_scalar())
          return one.value.node.has("stroke") ? std::nullopt : std::optional(direction(text_of(part.value)));
        const std::vector<Value> links = elements(part.value, 2);
        return direction(text_of(links[1])) - direction(text_of(links[0]));
      }
    }
  }
  return std::nullopt;
}

/// The construction that is found puts every point where it is drawn, to a billionth of the size.
TEST_P(EveryFile, IsDrawnWhereItsConstructionPutsIt) {
  if (std::any_of(refused.begin(), refused.end(),
                  [](const Refused& candidate) { return candidate.file == GetParam(); }) ||
      GetParam() == "cuik/legs.world")
    return;
  const Imported file = imported(GetParam());
  const Mechanism m = mechanism_of(file);
  if (m.space == Space::spatial) return;
  std::vector<double> pose;
  for (const Coordinate& coordinate : m.coordinates) {
    const auto angle = drawn_angle(file, m, coordinate.name);
    if (!angle) return;  // a stroke: linkage_test.cpp
    pose.push_back(*angle);
  }
  const auto drawn = places(file);
  double size = 0;
  for (const auto& [a, p] : drawn)
    for (const auto& [b, q] : drawn) size = std::max(size, apart(p, q));
  const double metres = core::to_double(value_in_si("1", "length", m, {}));
  const auto at = sample_points(m, pose);
  for (std::size_t p = 0; p < m.points.size(); ++p) {
    const auto named = drawn.find(m.points[p].name);
    if (named == drawn.end()) continue;
    ASSERT_TRUE(at[p]) << m.points[p].name;
    for (std::size_t i = 0; i < named->second.size(); ++i)
      EXPECT_NEAR((*at[p])[i] / metres, named->second[i], 1e-9 * size) << m.points[p].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, EveryFile, testing::ValuesIn(files()), [](const auto& file) {
  std::string name = file.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
});

/// No mechanism file is taken for another program's.
TEST(ImportFormat, LeavesMechanismFilesAlone) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_dir() + "/examples"))
    if (entry.path().extension() == ".yaml") {
      const std::string text = bytes_of(entry.path().string());
      EXPECT_TRUE(import_format(text).empty()) << entry.path();
      EXPECT_EQ(import_text(text, "m.yaml").text, text);
    }
}

TEST(ImportFormat, IsKnownByTheContentAlone) {
  const std::map<std::string, std::string> formats = {
      {"pmks/four_bar.txt", "PMKS+"},  {"pmks/address.txt", "PMKS+"},         {"linkage/four_bar.linkage2", "Linkage"},
      {"mjcf/four_bar.xml", "MJCF"},   {"urdf/four_bar.urdf", "URDF"},        {"sdf/four_bar_1_4.sdf", "SDF"},
      {"dxf/four_bar_r12.dxf", "DXF"}, {"pyslvs/crank_rocker.txt", "pyslvs"}, {"cuik/four_bar.world", "CUIK"}};
  for (const auto& [name, format] : formats) EXPECT_EQ(import_format(bytes_of(path_of(name))), format) << name;
  EXPECT_EQ(import_formats().size(), 8U);
}

/// One four-bar, drawn in six programs: crank (0, 0) to (30, 40), coupler to (120, 90), rocker to (100, 0).
TEST(OneFourBar, IsTheSameInEveryFormat) {
  const std::map<std::string, std::vector<std::string>> names = {
      {"pmks/four_bar.txt", {"A", "B", "C", "D"}},
      {"pmks/centimetres.txt", {"A", "B", "C", "D"}},
      {"mjcf/four_bar.xml", {"A", "B", "C", "D"}},
      {"mjcf/pin_of_two_connects.xml", {"A", "B", "C", "D"}},
      {"urdf/four_bar.urdf", {"motor_A", "B", "loop_end", "D"}},
      {"sdf/four_bar_1_4.sdf", {"A", "B", "C", "D"}},
      {"sdf/four_bar_1_6.sdf", {"A", "B", "C", "D"}},
      {"sdf/four_bar_1_11.sdf", {"A", "B", "C", "D"}},
      {"dxf/four_bar_r12.dxf", {"P1", "P2", "P3", "P4"}},
      {"dxf/four_bar_r2000.dxf", {"P1", "P2", "P3", "P4"}},
      {"pyslvs/crank_rocker.txt", {"P0", "P1", "P2", "P4"}}};
  const std::vector<std::vector<double>> right = {{0, 0}, {0.03, 0.04}, {0.12, 0.09}, {0.1, 0}};
  for (const auto& [file, name] : names) {
    const Imported found = imported(file);
    const auto at = places(found);
    const double metres = core::to_double(value_in_si("1", "length", mechanism_of(found), {}));
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_TRUE(at.contains(name[i])) << file << " " << name[i];
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(at.at(name[i])[k] * metres, right[i][k], 0.12e-9) << file << " " << name[i];
    }
  }
}

}  // namespace
}  // namespace clearloci::mechanism
