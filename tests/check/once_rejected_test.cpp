// Certificates that were once rejected though they are true (tests/corpus/certificates), and one whose kinds were once
// accepted whatever they said.
#include <gtest/gtest.h>

#include "tests/check/certified.hpp"

namespace clearloci::test {
namespace {

using Json = nlohmann::ordered_json;

class OnceRejected : public testing::TestWithParam<const char*> {};

TEST_P(OnceRejected, IsAccepted) {
  const std::string model = example("../tests/corpus/certificates/" + std::string(GetParam()) + ".yaml");
  const check::Examination examination = examination_of(model, certificate_of(model));
  EXPECT_TRUE(examination.accepted) << summary(examination).substr(0, 2000);
  EXPECT_GT(examination.arcs, 0u);
}

INSTANTIATE_TEST_SUITE_P(Corpus, OnceRejected,
                         testing::Values("end_of_a_guide", "guide_beside_the_boundary",
                                         "point_where_a_spring_has_no_length", "chord_beside_another",
                                         "line_crossed_at_its_middle"),
                         [](const auto& own) { return std::string(own.param); });

TEST(Kinds, FollowFromWhatVanishes) {
  const std::string model = example("../tests/corpus/certificates/kinds.yaml");
  const Json certificate = Json::parse(certificate_of(model));
  int tried = 0;
  for (std::size_t c = 0; c < certificate["curves"].size(); ++c)
    for (const char* const kind : {"contact-loss", "backlash", "component"}) {
      const std::string own = certificate["curves"][c]["kind"];
      if (own == kind || certificate["curves"][c]["vanishing"].empty()) continue;
      Json changed = certificate;
      changed["curves"][c]["kind"] = kind;
      const check::Examination examination = examination_of(model, changed.dump());
      EXPECT_FALSE(examination.accepted);
      EXPECT_NE(examination.why.find("kind"), std::string::npos) << examination.why;
      ++tried;
    }
  EXPECT_GT(tried, 8);
}

}  // namespace
}  // namespace clearloci::test
