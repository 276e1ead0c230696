// What the loci of a design say of it as a whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"

namespace clearloci {
namespace {

std::vector<std::string> notes(const std::string& name, const std::vector<Model::Value>& values) {
  const Model model = Model::read(CLEARLOCI_SOURCE_DIR "/examples/" + name);
  return trace_loci(values.empty() ? model : model.with(values)).notes;
}

TEST(Loci, SayThatNoPoseIsReached) {
  const std::string note = "no pose is reached: the mechanism does not close in the workspace";
  EXPECT_THAT(notes("five_bar.yaml", {{"L", "0.1"}, {"d", "0.5"}}), testing::ElementsAre(note));
  EXPECT_THAT(notes("five_bar.yaml", {}), testing::IsEmpty());
  EXPECT_THAT(notes("four_bar.yaml", {}), testing::IsEmpty());
  EXPECT_THAT(notes("three_rpr.yaml", {}), testing::Not(testing::Contains(note)));
  EXPECT_THAT(notes("gough_stewart.yaml", {}), testing::Not(testing::Contains(note)));
}

}  // namespace
}  // namespace clearloci
