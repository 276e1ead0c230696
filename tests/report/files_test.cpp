#include "report/files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "core/errors.hpp"
#include "report/error.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/zones.hpp"
#include "tests/report/five_bar_map.hpp"
#include "tests/report/scratch_folder.hpp"

namespace clearloci::report {
namespace {

using fixture::read_file;
using fixture::ScratchFolder;

TEST(Files, WrittenFileHoldsTheBytesAndNoTemporaryIsLeft) {
  const ScratchFolder scratch;
  const std::string bytes("a\0b\r\n\xFF", 6);
  write_atomically(scratch.path() / "file", bytes);
  EXPECT_EQ(read_file(scratch.path() / "file"), bytes);
  write_atomically(scratch.path() / "file", "");
  EXPECT_EQ(read_file(scratch.path() / "file"), "");
  EXPECT_EQ(scratch.file_count(), 1);
}

TEST(Files, MissingFoldersAreMade) {
  const ScratchFolder scratch;
  write_atomically(scratch.path() / "a/b c/d" / "file", "x");
  EXPECT_EQ(read_file(scratch.path() / "a/b c/d/file"), "x");
}

TEST(Files, AFileAnyoneMayReadUnlessTheUserSaysOtherwise) {
  const ScratchFolder scratch;
  write_atomically(scratch.path() / "file", "x");
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const auto mode = static_cast<unsigned>(std::filesystem::status(scratch.path() / "file").permissions());
  EXPECT_EQ(mode, 0666u & ~mask);
}

/// What write_atomically says of a path it cannot write; the scratch folder must be as it was.
void expect_refusal(const ScratchFolder& scratch, const std::filesystem::path& path) {
  const int before = scratch.file_count();
  try {
    write_atomically(path, "x");
    FAIL() << path << " was written";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(scratch.path().string()), std::string::npos) << error.what();
    EXPECT_FALSE(error.mend().empty());
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
  EXPECT_EQ(scratch.file_count(), before);
}

TEST(Files, AFolderThatIsAFileIsRefused) {
  const ScratchFolder scratch;
  write_atomically(scratch.path() / "file", "x");
  expect_refusal(scratch, scratch.path() / "file" / "loci.json");
  EXPECT_EQ(read_file(scratch.path() / "file"), "x");
}

TEST(Files, AFileThatIsAFolderIsRefusedAndNoTemporaryIsLeft) {
  const ScratchFolder scratch;
  std::filesystem::create_directories(scratch.path() / "loci.json" / "full");
  expect_refusal(scratch, scratch.path() / "loci.json");
}

TEST(Files, AFolderWithoutPermissionIsRefused) {
  const ScratchFolder scratch;
  std::filesystem::permissions(scratch.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  if (::access(scratch.path().c_str(), W_OK) == 0) GTEST_SKIP() << "this user may write everywhere";
  expect_refusal(scratch, scratch.path() / "loci.json");
}

TEST(StagedFiles, AppearTogetherOrNotAtAll) {
  const ScratchFolder scratch;
  write_atomically(scratch.path() / "one", "old");
  std::filesystem::create_directories(scratch.path() / "folder" / "full");
  const int before = scratch.file_count();
  {
    StagedFiles files;
    files.add(scratch.path() / "one", "new");
    files.add(scratch.path() / "two", "new");
    EXPECT_THROW(files.add(scratch.path() / "folder", "new"), core::InputError);
  }
  EXPECT_EQ(scratch.file_count(), before) << "no temporary is left";
  EXPECT_EQ(read_file(scratch.path() / "one"), "old");
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "two"));
  StagedFiles files;
  files.add(scratch.path() / "one", "new");
  files.add(scratch.path() / "two", "new");
  EXPECT_THROW(files.add(scratch.path() / "x" / ".." / "one", "other"), core::InputError) << "one name for two files";
  EXPECT_EQ(read_file(scratch.path() / "one"), "old");
  files.commit();
  EXPECT_EQ(read_file(scratch.path() / "one") + read_file(scratch.path() / "two"), "newnew");
}

TEST(StagedFiles, WriteThroughLinksAndReplaceNothingElse) {
  const ScratchFolder scratch;
  write_atomically(scratch.path() / "target", "old");
  std::filesystem::create_symlink("target", scratch.path() / "link");
  write_atomically(scratch.path() / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(scratch.path() / "link"));
  EXPECT_EQ(read_file(scratch.path() / "target"), "new");
  std::filesystem::create_symlink("later", scratch.path() / "dangling");
  write_atomically(scratch.path() / "dangling", "new");
  EXPECT_EQ(read_file(scratch.path() / "later"), "new");
  ASSERT_EQ(::mkfifo((scratch.path() / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(write_atomically(scratch.path() / "pipe", "x"), core::InputError);
  EXPECT_TRUE(std::filesystem::is_fifo(scratch.path() / "pipe"));
  EXPECT_THROW(write_atomically("/dev/null", "x"), core::InputError);
  std::filesystem::create_symlink("pipe", scratch.path() / "to_pipe");
  EXPECT_THROW(write_atomically(scratch.path() / "to_pipe", "x"), core::InputError);
}

TEST(StagedFiles, ReplaceNoInputByWhateverName) {
  const ScratchFolder scratch;
  write_atomically(scratch.path() / "model.yaml", "model");
  std::filesystem::create_symlink("model.yaml", scratch.path() / "link");
  std::filesystem::create_hard_link(scratch.path() / "model.yaml", scratch.path() / "hard");
  keep_inputs({scratch.path() / "link", scratch.path() / "none"});
  for (const char* name : {"model.yaml", "link", "hard"})
    EXPECT_THROW(write_atomically(scratch.path() / name, "x"), core::InputError) << name;
  EXPECT_EQ(read_file(scratch.path() / "model.yaml"), "model");
  write_atomically(scratch.path() / "none", "x");
}

TEST(WriteLoci, OneModeNeedsNoModeInItsNames) {
  const ScratchFolder scratch;
  const auto map = fixture::five_bar_map();
  const std::vector<std::string> all = format_names<LociSheet>();
  const std::vector<core::ModeSketch> sketches = {
      {fixture::elbows_out(), fixture::five_bar_sketch(fixture::elbows_out())}};
  const auto written = write_loci({map, sketches}, scratch.path() / "out", {all.begin(), all.end()});
  std::vector<std::string> names;
  for (const auto& path : written) {
    names.push_back(path.filename().string());
    EXPECT_GT(std::filesystem::file_size(path), 100u) << path;
  }
  std::vector<std::string> expected = {"loci.json", "loci.csv",     "loci.svg",     "loci.png", "loci.pdf",
                                       "loci.dxf",  "loci-r12.dxf", "loci.geojson", "loci.vtp"};
  if (std::find(all.begin(), all.end(), "html") != all.end()) expected.emplace_back("loci.html");  // with the workbench
  EXPECT_EQ(names, expected);
}

TEST(WriteLoci, WhatIsMadeSideBySideIsWhatEachFormatMakes) {
  const ScratchFolder scratch;
  const auto map = fixture::five_bar_map_in_all_modes();
  const std::vector<std::string> all = format_names<LociSheet>();
  const LociSheet loci{map, {}};
  EXPECT_GT(write_loci(loci, scratch.path(), {all.begin(), all.end()}).size(), all.size());
  for (const std::string& name : all)
    for (const File& file : can_hold(name, 2) ? files_of(loci, {name}) : Files{})
      EXPECT_TRUE(read_file(scratch.path() / file.name) == file.bytes) << file.name;
}

TEST(WriteLoci, SeveralModesHaveAPictureEach) {
  const ScratchFolder scratch;
  const auto written = write_loci({fixture::five_bar_map_in_all_modes(), {}}, scratch.path(), {"svg"});
  std::vector<std::string> names;
  for (const auto& path : written) names.push_back(path.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"loci.json", "loci-right-left.svg", "loci-right-right.svg",
                                             "loci-left-left.svg", "loci-left-right.svg"}));
}

TEST(WriteLoci, AMapWithoutAnyCurveStillGivesEveryFile) {
  const ScratchFolder scratch;
  core::LocusMap map = fixture::five_bar_map();
  map.curves.clear();
  map.isolated_points.clear();
  map.workspace.clear();
  EXPECT_EQ(write_loci({map, {}}, scratch.path(), {"svg", "png", "csv"}).size(), 4u);
}

TEST(Formats, HoldWhatTheySay) {
  for (const char* unknown : {"jpeg", "", "SVG"}) EXPECT_FALSE(can_hold(unknown, 2)) << unknown;
  EXPECT_TRUE(can_hold("dxf", 2));
  EXPECT_FALSE(can_hold("dxf", 3));
  EXPECT_TRUE(can_hold("stl", 3));
  EXPECT_FALSE(can_hold("stl", 2));
  EXPECT_EQ(format_names<core::Zones>(),
            (std::vector<std::string>{"json", "svg", "png", "pdf", "geojson", "vtk", "stl", "html"}));
  EXPECT_EQ(zone_formats(2, false), (std::vector<std::string>{"json", "svg", "png", "pdf", "geojson", "html"}));
  EXPECT_EQ(zone_formats(1, true), (std::vector<std::string>{"json", "svg", "png", "pdf"}));
  EXPECT_EQ(zone_formats(2, true), (std::vector<std::string>{"json", "svg", "png", "pdf", "vtk"}));
  EXPECT_EQ(zone_formats(3, true), (std::vector<std::string>{"json", "svg", "png", "pdf", "vtk", "stl"}));
  EXPECT_EQ(format_names<core::Verification>(), (std::vector<std::string>{"json", "svg", "png", "pdf"}));
  EXPECT_EQ(error_formats(2), (std::vector<std::string>{"json", "csv", "svg", "png", "pdf", "vtk"}));
  EXPECT_EQ(error_formats(1), (std::vector<std::string>{"json", "csv", "svg", "png", "pdf"}));
  EXPECT_EQ(format_names<core::TrajectoryResult>(), (std::vector<std::string>{"json", "csv", "svg", "png", "pdf"}));
  EXPECT_EQ(format_names<core::Pose>(), (std::vector<std::string>{"json"}));
  EXPECT_EQ(format_names<core::PoseInModes>(), (std::vector<std::string>{"json"}));
  EXPECT_EQ(format_names<core::Validation>(), (std::vector<std::string>{"json"}));
  EXPECT_EQ(error_formats(3), (std::vector<std::string>{"json", "csv", "svg", "png", "pdf", "vtk"}));
}

}  // namespace
}  // namespace clearloci::report
