// Certificates of zones: all of the workspace is in one of them, once.
#include <gtest/gtest.h>

#include <functional>

#include "check/zone_borders.hpp"
#include "tests/check/certified.hpp"
#include "tests/texts.hpp"

namespace clearloci::test {
namespace {

using Json = nlohmann::ordered_json;

/// Two zones, of which the second is a strip that poses all over the box do not meet.
std::string with_a_strip() { return replaced(example("prrrp.yaml"), "x: [0, 0.6]", "x: [0.14, 0.6]"); }

TEST(ZonesOfAStrip, CoverTheWorkspaceOnce) {
  const std::string model = with_a_strip();
  const Json certificate = Json::parse(certificate_of(model, {}, true));
  const auto changed = [&](const std::function<void(Json&)>& change) {
    Json other = certificate;
    change(other);
    return examination_of(model, other.dump());
  };
  ASSERT_EQ(certificate["zones"].size(), 2u);
  ASSERT_LT(certificate["zones"][1]["area"].get<double>(), 0.004);
  const check::Examination examination = changed([](Json&) {});
  ASSERT_TRUE(examination.accepted) << summary(examination);
  EXPECT_TRUE(examination.unchecked.empty()) << summary(examination);
  const auto left_out = [](Json& c) { c["zones"].erase(1); };
  EXPECT_FALSE(changed(left_out).accepted);
  EXPECT_FALSE(changed([](Json& c) { c["zones"].erase(0); }).accepted);
  EXPECT_FALSE(changed([](Json& c) { c["zones"] = Json::array(); }).accepted);
  EXPECT_THROW((void)changed([](Json& c) { c.erase("zones"); }), core::InputError);
  EXPECT_FALSE(changed([](Json& c) {
                 c["zones"].push_back(Json(c["zones"][1]));
                 c["zones"].back()["id"] = "z3";
               }).accepted);
  // What is said to be in doubt is not looked at, and that is told.
  const check::Examination doubtful = changed([&](Json& c) {
    left_out(c);
    c["in_doubt"] = {0.01};
  });
  EXPECT_TRUE(doubtful.accepted) << summary(doubtful);
  EXPECT_EQ(doubtful.unchecked.size(), 1u);
  EXPECT_THROW((void)changed([](Json& c) { c["in_doubt"] = {-1}; }), core::InputError);
}

TEST(ZonesOfAStrip, NameTheirModesByTheModelsSliders) {
  const std::string model = with_a_strip();
  Json certificate = Json::parse(certificate_of(model, {}, true));
  std::swap(certificate["roots"][0]["point"], certificate["roots"][1]["point"]);
  EXPECT_FALSE(examination_of(model, certificate.dump()).accepted);
}

/// Beyond a singularity along a side of the box no pose is looked for.
TEST(ZonesOfAStrip, MayHaveASingularityAlongTheBox) {
  const std::string model =
      "format: 1\nname: two legs\nworkspace: {x: [0.125, 0.875], y: [0, 1]}\npoints: {A: [0, 0], E: [1, 0], P: [x, "
      "y]}\n"
      "links: {a: {points: [A]}, b: {points: [P]}, c: {points: [E]}, d: {points: [P]}}\njoints:\n"
      "  A: {revolute: [ground, a], at: A}\n  S: {prismatic: [a, b], at: P, axis: [A, P], actuated: true}\n"
      "  P: {revolute: [b, d], at: P}\n  E: {revolute: [ground, c], at: E}\n"
      "  T: {prismatic: [c, d], at: P, axis: [E, P], actuated: true, clearance: {axial: 30e-6}}\n"
      "end_effector: {link: d, at: P}\nloads: [{link: d, at: P, force: [-100, -100], couple: -10}]\n";
  const check::Examination examination = examination_of(model, certificate_of(model, {}, true));
  EXPECT_TRUE(examination.accepted) << summary(examination);
  EXPECT_EQ(examination.zones, 2u);
}

check::ZoneClaim zone_of(core::Polyline outer) {
  check::ZoneClaim zone;
  zone.outer = std::move(outer);
  return zone;
}

TEST(ZoneBorders, HaveAZoneOnEitherSideOrTheEndOfAll) {
  const check::ZoneClaim left = zone_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}),
                         right = zone_of({{1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 0}});
  EXPECT_EQ(check::ZoneBorders({&left, &right}).one_sided().size(), 6u);
  EXPECT_EQ(check::ZoneBorders({&left}).one_sided().size(), 4u);
  EXPECT_THROW(check::ZoneBorders({&left, &right, &left}), check::FalseClaim);
}

TEST(ZoneBorders, WithinAZoneDivideNothing) {
  // What ends in it, and what joins it to a hole.
  const core::Polyline ending = {{0, 0}, {1, 0}, {1, 0.5}, {1, 0}, {2, 0}, {2, 1}, {0, 1}, {0, 0}};
  const core::Polyline holed = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}, {0, 0}};
  for (const core::Polyline& ring : {ending, holed}) {
    const check::ZoneClaim zone = zone_of(ring);
    EXPECT_NO_THROW(check::ZoneBorders({&zone}));
  }
  const check::ZoneClaim divided = zone_of({{0, 0}, {1, 0}, {1, 1}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}, {0, 0}});
  EXPECT_THROW(check::ZoneBorders({&divided}), check::FalseClaim);
}

}  // namespace
}  // namespace clearloci::test
