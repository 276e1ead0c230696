// Certificates that were once rejected though they are true (tests/corpus/certificates), and one whose kinds were once
// accepted whatever they said.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

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
    testing::Values(
        Once{"arc_of_one_vertex"}, Once{"end_of_a_guide"},
        Once{"ends_alike", {core::Quantity::f}, {.joints = {"S1"}, .min_force = 50}}, Once{"guide_beside_the_boundary"},
        Once{"guide_without_clearance", {core::Quantity::f, core::Quantity::N}},
        Once{"point_where_a_spring_has_no_length"}, Once{"chord_beside_another"}, Once{"line_crossed_at_its_middle"},
        Once{"torsion_slit", {core::Quantity::M}}, Once{"spring_named_as_a_point", {core::Quantity::M}},
        Once{"force_of_one_component", {core::Quantity::fx}},
        Once{"crank_next_to_its_end_of_reach", {core::Quantity::M}},
        Once{"legs_that_never_align", {core::Quantity::f}, {.joints = {"B2"}}},
        Once{"components_at_a_cone", {core::Quantity::fy}},
        Once{"margins_at_a_cone", {core::Quantity::f}, {.joints = {"A1"}, .min_force = 10}},
        Once{"chords_between_two_nodes", {}, {.min_force = 50}}, Once{"two_boundaries_along_one_line"},
        Once{"rails_nearly_one_line", {core::Quantity::F}, {.working_modes = {{-1, 1}}}},
        Once{"guide_unloaded_along_the_boundary"}, Once{"foot_with_its_axis_to_the_pin"}, Once{"foot_beside_a_dyad"},
        Once{"foot_whose_guide_bears_a_couple"}, Once{"open_beside_the_boundary", {}, {.working_modes = {{1, -1}}}}),
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

/// Of a certificate: what lies along |A1 P| = 0.1, where the axis of the guide, from the foot to the pin, has no
/// length.
class FootBoundary : public testing::Test {
 protected:
  FootBoundary()
      : model_(example("../tests/corpus/certificates/foot_with_its_axis_to_the_pin.yaml")),
        certificate_(Json::parse(certificate_of(model_))) {}

  bool is_on_circle(const Json& arc) const {
    const auto is_on = [](const Json& point) {
      return std::abs(std::hypot(point[0].get<double>(), point[1].get<double>()) - 0.1) < 1e-9;
    };
    return std::all_of(arc["points"].begin(), arc["points"].end(), is_on);
  }
  bool is_of_circle(const Json& curve) const {
    return std::all_of(curve["arcs"].begin(), curve["arcs"].end(), [&](const Json& arc) { return is_on_circle(arc); });
  }
  /// The root of the foot is said to be zero along it.
  bool is_of_foot(const Json& sheet) const { return sheet["at_zero"] == Json::array({0}); }

  void expect_rejected(const Json& changed) const { EXPECT_FALSE(examination_of(model_, changed.dump()).accepted); }

  std::string model_;
  Json certificate_;
};

TEST_F(FootBoundary, IsABoundaryAlongWhichTheMotorIsUnloaded) {
  std::set<std::string> kinds;
  for (const Json& curve : certificate_["curves"])
    if (is_of_circle(curve)) kinds.insert(curve["kind"].get<std::string>() + curve["vanishing"].dump());
  EXPECT_EQ(kinds, (std::set<std::string>{"backlash[[\"A1\",\"M\"]]", "workspace-boundary[]"}));
}

TEST_F(FootBoundary, IsMissedWhereItIsLeftOut) {
  for (std::size_t c = 0; c < certificate_["curves"].size(); ++c) {
    Json changed = certificate_;
    changed["curves"].erase(c);
    expect_rejected(changed);
  }
  int tried = 0;
  for (std::size_t s = 0; s < certificate_["sheets"].size(); ++s) {
    Json changed = certificate_;
    changed["sheets"].erase(s);
    expect_rejected(changed);
    tried += is_of_foot(certificate_["sheets"][s]) ? 1 : 0;
  }
  EXPECT_EQ(tried, 2);
  // All of it together.
  Json changed = certificate_;
  for (auto sheet = changed["sheets"].begin(); sheet != changed["sheets"].end();)
    sheet = is_of_foot(*sheet) ? changed["sheets"].erase(sheet) : sheet + 1;
  for (auto curve = changed["curves"].begin(); curve != changed["curves"].end();)
    curve = is_of_circle(*curve) ? changed["curves"].erase(curve) : curve + 1;
  expect_rejected(changed);
}

TEST_F(FootBoundary, IsMissedWhereItIsChanged) {
  int tried = 0;
  for (std::size_t c = 0; c < certificate_["curves"].size(); ++c) {
    const Json& curve = certificate_["curves"][c];
    if (!is_of_circle(curve)) continue;
    Json shifted = certificate_, other = certificate_, swapped = certificate_;
    shifted["curves"][c]["arcs"][0]["points"][5][0] = curve["arcs"][0]["points"][5][0].get<double>() + 1e-5;
    expect_rejected(shifted);
    if (curve["vanishing"].empty()) continue;
    other["curves"][c]["vanishing"] = Json::array({Json::array({"A1", "f"}), Json::array({"A1", "M"})});
    other["curves"][c]["kind"] = "contact-loss";
    expect_rejected(other);
    swapped["curves"][c]["vanishing"] = Json::array({Json::array({"G", "F"})});
    expect_rejected(swapped);
    ++tried;
  }
  EXPECT_EQ(tried, 1);
}

}  // namespace
}  // namespace clearloci::test
