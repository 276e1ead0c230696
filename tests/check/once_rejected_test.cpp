// Certificates that were once rejected though they are true (tests/corpus/certificates), and one whose kinds were once
// accepted whatever they said.
#include <gtest/gtest.h>

#include "tests/check/certified.hpp"

namespace clearloci::test {
namespace {

using Json = nlohmann::ordered_json;

struct Once {
  const char* name;
  std::vector<core::Quantity> quantities = {};  ///< none: the default
  LociRequest request = {};
};

class OnceRejected : public testing::TestWithParam<Once> {};

TEST_P(OnceRejected, IsAccepted) {
  const std::string model = example("../tests/corpus/certificates/" + std::string(GetParam().name) + ".yaml");
  LociRequest request = GetParam().request;
  if (!GetParam().quantities.empty()) request.quantities = GetParam().quantities;
  const check::Examination examination = examination_of(model, certificate_of(model, request));
  EXPECT_TRUE(examination.accepted) << summary(examination).substr(0, 2000);
  EXPECT_GT(examination.arcs, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Corpus, OnceRejected,
    testing::Values(Once{"arc_of_one_vertex"}, Once{"end_of_a_guide"},
                    Once{"ends_alike", {core::Quantity::f}, {.joints = {"S1"}, .min_force = 50}},
                    Once{"guide_beside_the_boundary"}, Once{"point_where_a_spring_has_no_length"},
                    Once{"chord_beside_another"}, Once{"line_crossed_at_its_middle"},
                    Once{"torsion_slit", {core::Quantity::M}}, Once{"spring_named_as_a_point", {core::Quantity::M}},
                    Once{"force_of_one_component", {core::Quantity::fx}},
                    Once{"crank_next_to_its_end_of_reach", {core::Quantity::M}},
                    Once{"legs_that_never_align", {core::Quantity::f}, {.joints = {"B2"}}},
                    Once{"components_at_a_cone", {core::Quantity::fy}},
                    Once{"margins_at_a_cone", {core::Quantity::f}, {.joints = {"A1"}, .min_force = 10}},
                    Once{"chords_between_two_nodes", {}, {.min_force = 50}}, Once{"two_boundaries_along_one_line"},
                    Once{"rails_nearly_one_line", {core::Quantity::F}, {.working_modes = {{-1, 1}}}},
                    Once{"guide_unloaded_along_the_boundary"}),
    [](const auto& candidate) { return std::string(candidate.param.name); });

// Its chords lead there and back along one line: no point is inside of them.
TEST(ZonesOnceRejected, AZoneThinnerThanItsChords) {
  const std::string model = example("../tests/corpus/certificates/zone_thinner_than_its_chords.yaml");
  const check::Examination examination = examination_of(model, certificate_of(model, {}, true));
  EXPECT_TRUE(examination.accepted) << summary(examination).substr(0, 2000);
  EXPECT_GT(examination.zones, 4u);
}

TEST(Kinds, FollowFromWhatVanishes) {
  const std::string model = example("../tests/corpus/certificates/kinds.yaml");
  const Json certificate = Json::parse(certificate_of(model));
  int tried = 0;
  for (std::size_t c = 0; c < certificate["curves"].size(); ++c)
    for (const char* const kind : {"contact-loss", "backlash", "component"}) {
      const std::string true_kind = certificate["curves"][c]["kind"];
      if (true_kind == kind || certificate["curves"][c]["vanishing"].empty()) continue;
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
