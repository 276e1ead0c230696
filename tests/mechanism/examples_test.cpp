// Every shipped example reads.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "mechanism/read.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::mechanism {
namespace {

const std::filesystem::path examples = std::filesystem::path(source_dir()) / "examples";

TEST(Examples, AllRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(examples)) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW(read_mechanism(entry.path().string())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 18);
}

TEST(Examples, FiveBarHasTheColumnsOfThePaper) {
  const Mechanism m = read_mechanism((examples / "five_bar.yaml").string());
  std::string order;
  for (const Unknown& unknown : unknowns(m)) order += unknown_name(m, unknown) + " ";
  EXPECT_EQ(order, "fA1x fA1y fB1x fB1y fPx fPy fB2x fB2y fA2x fA2y MA1 MA2 ");
}

/// A point in the middle of a link is its centre of mass: two places of a link that are one stay together.
TEST(Rigidity, TakesAPointInTheMiddleOfALinkWithAMass) {
  const std::filesystem::path corpus = std::filesystem::path(source_dir()) / "tests/corpus/mechanism";
  for (const char* name : {"rigid_min.yaml", "watt2_187.yaml"})
    EXPECT_NO_THROW(read_mechanism((corpus / name).string())) << name;
}

TEST(ReadMechanism, NamesAFileThatIsNotThere) {
  try {
    read_mechanism("no/such/file.yaml");
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_STREQ(error.what(), "no/such/file.yaml: there is no such file; check the path");
  }
  EXPECT_THROW(read_mechanism(examples.string()), core::InputError);  // a folder
}

}  // namespace
}  // namespace clearloci::mechanism
