// Certificates of loci and zones over one coordinate: what was found is proven anew, and what is made false is
// rejected.
#include <gtest/gtest.h>

#include <functional>

#include "analysis/range_certificate.hpp"
#include "tests/check/certified.hpp"
#include "tests/texts.hpp"

namespace clearloci::test {
namespace {

using Json = nlohmann::ordered_json;

std::string range_certified(const std::string& model, bool zones, const LociRequest& request = {}) {
  const mechanism::Mechanism mechanism = mechanism::parse_mechanism(model, "model.yaml");
  const core::RangeCertificate certificate =
      zones ? range_certificate(mechanism, request, find_zones(mechanism, {request}))
            : range_certificate(mechanism, request, trace_loci(mechanism, request));
  return report::certificate_text({zones ? "zones" : "loci", model, {}}, certificate);
}

struct Expected {
  const char* name;
  const char* model;
  std::size_t points;     ///< that are proven, at least
  std::size_t unchecked;  ///< at most
  bool zones = true;      ///< also of zones; of groups a check takes long
};

class RangesOfExamples : public testing::TestWithParam<Expected> {};

TEST_P(RangesOfExamples, AreProvenAnew) {
  const std::string model = example(GetParam().model);
  for (const bool zones : {false, true}) {
    if (zones && !GetParam().zones) continue;
    const check::Examination examination = examination_of(model, range_certified(model, zones));
    EXPECT_TRUE(examination.accepted) << examination.why;
    EXPECT_GE(examination.points, GetParam().points) << zones;
    EXPECT_GT(examination.zones, 1u);
    EXPECT_LE(examination.unchecked.size(), GetParam().unchecked) << testing::PrintToString(examination.unchecked);
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, RangesOfExamples,
                         testing::Values(Expected{"OfDyads", "four_bar.yaml", 2, 0},
                                         Expected{"OfGears", "geared_five_bar.yaml", 5, 2},
                                         Expected{"OfAGroup", "stephenson_outside.yaml", 1, 3, false}),
                         [](const auto& candidate) { return std::string(candidate.param.name); });

Json& point_of(Json& mode, const std::string& kind) {
  for (Json& point : mode["points"])
    if (point["kind"] == kind) return point;
  throw std::logic_error("no point is of kind " + kind);
}

std::size_t longest(const Json& free) {
  const auto length = [](const Json& value) {
    return core::to_double(core::Rational(value["to"].get<std::string>()) -
                           core::Rational(value["from"].get<std::string>()));
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < free.size(); ++i)
    if (length(free[i]) > length(free[best])) best = i;
  return best;
}

TEST(PoseRangeCertificate, IsRejectedWhereAClaimIsMadeFalse) {
  const std::string model = example("four_bar.yaml"), certificate = range_certified(model, true);
  ASSERT_TRUE(examination_of(model, certificate).accepted);
  const auto mode = [](Json& c) -> Json& { return c["pose_range"]["modes"][0]; };
  const std::vector<std::pair<const char*, std::function<void(Json&)>>> changes = {
      {"a zone across a point",
       [&](Json& c) {
         mode(c)["free"][0]["to"] = mode(c)["free"][1]["to"];
         mode(c)["free"].erase(1);
       }},
      {"a point that is left out", [&](Json& c) { mode(c)["points"].erase(0); }},
      {"a point twice", [&](Json& c) { mode(c)["points"].push_back(Json(mode(c)["points"][0])); }},
      {"a point where no locus is", [&](Json& c) { mode(c)["points"][0]["at"] = mode(c)["free"][0]["from"]; }},
      {"a sign of |A|",
       [&](Json& c) { mode(c)["free"][0]["assembly_mode"] = -mode(c)["free"][0]["assembly_mode"].get<int>(); }},
      {"a sign of a reaction",
       [&](Json& c) { mode(c)["free"][0]["signs"][0][2] = -mode(c)["free"][0]["signs"][0][2].get<int>(); }},
      {"intervals that overlap", [&](Json& c) { mode(c)["free"].push_back(mode(c)["free"][0]); }},
      {"an interval that leaves the range", [&](Json& c) { mode(c)["free"][0]["to"] = "100"; }},
      {"a side too many", [&](Json& c) { mode(c)["sides"].push_back(1); }},
      {"a sign that is zero", [&](Json& c) { mode(c)["free"][0]["signs"][0][2] = 0; }},
      {"a long zone that is left out", [&](Json& c) { mode(c)["free"].erase(longest(mode(c)["free"])); }},
      {"nothing within reach", [&](Json& c) { mode(c)["free"] = mode(c)["points"] = Json::array(); }},
      {"a point beyond the range", [&](Json& c) { mode(c)["points"][0]["at"] = "20"; }},
      {"another kind", [&](Json& c) { point_of(mode(c), "backlash")["kind"] = "contact-loss"; }},
      {"what vanishes of no joint", [&](Json& c) { point_of(mode(c), "backlash")["vanishing"][0][0] = "ZZ"; }},
      {"a reaction that vanishes and is left out",
       [&](Json& c) { point_of(mode(c), "contact-loss")["vanishing"].erase(0); }},
      {"nothing that vanishes", [&](Json& c) { point_of(mode(c), "backlash")["vanishing"] = Json::array(); }},
      {"a zero of a reaction that keeps its sign",
       [&](Json& c) {
         point_of(mode(c), "contact-loss")["vanishing"].push_back({"D", "f"});
       }},
      {"a boundary where the mechanism closes on both sides",
       [&](Json& c) {
         point_of(mode(c), "backlash")["vanishing"] = Json::array();
         point_of(mode(c), "backlash")["kind"] = "workspace-boundary";
       }},
      {"a singularity where |A| keeps its sign",
       [&](Json& c) {
         Json& point = point_of(mode(c), "backlash");
         point["vanishing"] = Json::array();
         point["kind"] = "direct-singularity";
       }},
      {"no demands", [&](Json& c) { mode(c)["demands"] = Json::array(); }},
      {"no modes", [&](Json& c) { c["pose_range"]["modes"] = Json::array(); }},
      {"another coordinate", [&](Json& c) { c["coordinates"][0] = "x"; }},
  };
  for (const auto& [what, change] : changes) {
    Json changed = Json::parse(certificate);
    change(changed);
    try {
      EXPECT_FALSE(examination_of(model, changed.dump()).accepted) << what;
    } catch (const core::InputError&) {
      SUCCEED() << "it is no certificate any more";
    }
  }
}

/// Under a least force each interval says what is too small in it, and it may say neither less nor more.
TEST(PoseRangeCertificate, TellsWhatIsTooSmall) {
  const std::string model = example("four_bar.yaml");
  LociRequest request;
  request.min_force = 10;
  for (const bool zones : {false, true}) {
    const std::string certificate = range_certified(model, zones, request);
    const check::Examination examination = examination_of(model, certificate);
    EXPECT_TRUE(examination.accepted) << examination.why;
    EXPECT_GE(examination.points, 3u);
    Json free = Json::parse(certificate)["pose_range"]["modes"][0]["free"];
    std::size_t small = 0;
    for (std::size_t i = 0; i < free.size(); ++i) {
      Json changed = Json::parse(certificate);
      Json& list = changed["pose_range"]["modes"][0]["free"][i]["too_small"];
      small += list.empty() ? 0 : 1;
      if (list.empty())
        list.push_back({"B", "f"});
      else
        list.erase(0);
      EXPECT_FALSE(examination_of(model, changed.dump()).accepted) << zones << " " << i;
    }
    EXPECT_GE(small, 3u);
    EXPECT_LT(small, free.size());
  }
}

/// Out of reach there are no points but at its ends, where teeth change flanks: each is a boundary at which their force
/// vanishes.
TEST(PoseRangeCertificate, IsRejectedWherePointsAreNotThoseOfTheEndsOfTheReach) {
  const std::string model = example("geared_five_bar.yaml"), certificate = range_certified(model, false);
  const auto is_accepted = [&](const std::function<void(Json&)>& change) {
    Json changed = Json::parse(certificate);
    change(changed["pose_range"]["modes"][0]);
    return examination_of(model, changed.dump()).accepted;
  };
  EXPECT_FALSE(is_accepted([](Json& mode) {
    mode["points"].push_back(point_of(mode, "workspace-boundary"));
    mode["points"].back()["at"] = "2";
  }));
  const Json points = Json::parse(certificate)["pose_range"]["modes"][0]["points"];
  const auto first = [&](const auto& wanted) {
    return static_cast<std::size_t>(std::find_if(points.begin(), points.end(), wanted) - points.begin());
  };
  const std::size_t of_teeth = first([](const Json&point) { return point["vanishing"].dump() == R"([["W","F"]])"; }),
                    boundary = first([](const Json&point) { return point["kind"] == "workspace-boundary"; });
  ASSERT_LT(std::max(of_teeth, boundary), points.size());
  for (const std::size_t point : {of_teeth, boundary})
    EXPECT_FALSE(is_accepted([&](Json& mode) { mode["points"].erase(point); })) << point;
  EXPECT_FALSE(is_accepted([&](Json& mode) { mode["points"].push_back(points[boundary]); })) << "twice";
  EXPECT_FALSE(is_accepted([](Json& mode) { mode["free"][0]["assembly_mode"] = 1; })) << "of no zone";
}

/// Also where a zone begins beyond what is out of reach.
TEST(PoseRangeCertificate, SaysOnceWhatVanishesAtTheEndsOfZones) {
  const Json certificate = Json::parse(range_certified(example("geared_five_bar.yaml"), true));
  const Json& points = certificate["pose_range"]["modes"][0]["points"];
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(points[i], points[k]);
}

/// A mechanism whose legs reach no point of the line together, and one that its limit holds from every pose.
TEST(PoseRangeCertificate, SaysThatTheWholeRangeIsOutOfReach) {
  std::string apart = example("five_bar.yaml");
  for (const auto& [old, now] : std::vector<std::pair<std::string, std::string>>{{"  y: [-1.0, 1.0]", ""},
                                                                                 {"P:  [x, y]", "P:  [x, 0]"},
                                                                                 {"  d: L ", "  d: 3 "},
                                                                                 {"x: [-0.5, 1.0]", "x: [0, 3]"}})
    apart = replaced(apart, old, now);
  const std::string limited = example("four_bar.yaml") + "limits:\n  - {distance: [A, C], within: [10, 11]}\n";
  for (const std::string& model : {apart, limited})
    for (const bool zones : {false, true}) {
      const std::string certificate = range_certified(model, zones);
      const check::Examination examination = examination_of(model, certificate);
      EXPECT_TRUE(examination.accepted) << examination.why;
      EXPECT_TRUE(examination.unchecked.empty()) << testing::PrintToString(examination.unchecked);
      // The same is said in vain of a mechanism that moves.
      Json changed = Json::parse(range_certified(example("four_bar.yaml"), zones));
      Json& mode = changed["pose_range"]["modes"][0];
      mode["free"] = mode["points"] = mode["open"] = Json::array();
      EXPECT_FALSE(examination_of(example("four_bar.yaml"), changed.dump()).accepted);
    }
}

}  // namespace
}  // namespace clearloci::test
