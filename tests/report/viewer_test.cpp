// What pages in a browser draw by: the rules of the pictures as data, and the page of `--export html`.
#include "report/viewer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "report/base64.hpp"
#include "report/groups.hpp"
#include "tests/report/five_bar_map.hpp"

namespace clearloci::report {
namespace {

using fixture::five_bar_map;
using fixture::hostile_map;
using Json = nlohmann::ordered_json;

TEST(DrawingRules, AreThoseOfThePictures) {
  const Json rules = drawing_rules();
  EXPECT_EQ(rules["themes"]["light"]["curves"][0], "#0072b2");  // palette_colour(0)
  EXPECT_EQ(rules["themes"]["light"]["singularity"], "#000000");
  EXPECT_EQ(rules["themes"]["dark"]["curves"].size(), rules["themes"]["light"]["curves"].size());
  for (const Json& kind : rules["kinds"]) EXPECT_FALSE(kind["happens"].get<std::string>().empty());
}

TEST(TheViewersData, HasEveryCurveAndPointInOneGroup) {
  const core::LocusMap map = five_bar_map();
  const Json data = viewer_object({map, {}});
  std::multiset<std::string> ids;
  for (const Json& group : data["curve_groups"])
    for (const Json& id : group["ids"]) ids.insert(id.get<std::string>());
  ASSERT_EQ(ids.size(), map.curves.size());
  for (const core::LocusCurve& curve : map.curves) EXPECT_EQ(ids.count(curve.id), 1U) << curve.id;
  std::set<int> points;
  for (const Json& group : data["point_groups"])
    for (const Json& index : group["points"]) points.insert(index.get<int>());
  EXPECT_EQ(points.size(), map.isolated_points.size());
}

TEST(TheViewersData, DashesAsThePicturesDo) {
  const core::LocusMap map = hostile_map();
  const Groups groups = group_loci(map);
  const Json data = viewer_object({map, {}});
  ASSERT_EQ(data["curve_groups"].size(), groups.curves.size());
  for (std::size_t k = 0; k < groups.curves.size(); ++k) {
    EXPECT_EQ(data["curve_groups"][k]["dash"], Json(groups.curves[k].stroke.dash));
    EXPECT_EQ(data["curve_groups"][k]["what"], groups.curves[k].what);
  }
}

TEST(Base64, IsThatOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(ThePage, AsksNobodyAndIsNotBrokenByNames) {
  if (viewer_bundle().script.empty()) GTEST_SKIP() << "a build without the workbench";
  core::LocusMap map = five_bar_map();
  map.mechanism = "</script><img src=x onerror=alert(1)><!--";
  const std::string page = html_page({map, {}});
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
  std::size_t ends = 0;
  for (std::size_t at = 0; (at = page.find("</script", at)) != std::string::npos; ++at) ++ends;
  EXPECT_EQ(ends, 2U);
}

}  // namespace
}  // namespace clearloci::report
