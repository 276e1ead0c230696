// True certificates are accepted, and false ones rejected, whatever is made false in them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/check/certified.hpp"
#include "tests/laws/design_texts.hpp"

namespace clearloci::test {
namespace {

using Json = nlohmann::ordered_json;

class Examples : public testing::TestWithParam<const char*> {};

TEST_P(Examples, AreAccepted) {
  const std::string model = example(GetParam());
  const check::Examination examination = examination_of(model, certificate_of(model));
  EXPECT_TRUE(examination.accepted) << summary(examination);
  EXPECT_GT(examination.cells, 0u);
  EXPECT_GT(examination.arcs, 0u);
  EXPECT_LT(examination.open_share, 1e-4);
  RecordProperty("examination", summary(examination));
}

INSTANTIATE_TEST_SUITE_P(Shipped, Examples,
                         testing::Values("five_bar.yaml", "five_bar_generic.yaml", "five_bar_coupler.yaml",
                                         "five_bar_horizontal.yaml", "five_bar_inclined.yaml", "five_bar_isolated.yaml",
                                         "five_bar_weights.yaml", "prrrp.yaml", "rprpr.yaml", "three_rpr.yaml",
                                         "three_rrr.yaml", "five_bar_preloaded.yaml", "five_bar_antagonistic.yaml",
                                         "excavator.yaml"),
                         [](const auto& candidate) {
                           const std::string file = candidate.param;
                           return file.substr(0, file.find('.'));
                         });

// Two unequal rods on one rail: |A| has the factor xS1 - xS2, which no pose of any mode makes zero.
/// Two on one rail, whose rods of different lengths carry P.
std::string two_carriages(const std::string& clearance, const std::string& loads) {
  const auto guide = [&clearance](const std::string& name, const std::string& carriage, const std::string& point) {
    return "  " + name + ": {prismatic: [ground, " + carriage + "], at: " + point + ", axis: [1, 0], actuated: true" +
           clearance + "}\n";
  };
  return "format: 1\nname: Two carriages\nspace: planar\nworkspace: {x: [-0.5, 0.5], y: [-0.5, -0.05]}\n"
         "points:\n  R: [0, 0]\n  P: [x, y]\n"
         "  S1: {slider: [R, [1, 0]], from: P, length: 0.5, side: behind}\n"
         "  S2: {slider: [R, [1, 0]], from: P, length: 0.4, side: ahead}\n"
         "links: {c1: {points: [S1], mass: 1, com: S1, inertia: 0.001}, rod1: {points: [S1, P], mass: 0.5}, "
         "c2: {points: [S2], mass: 1, com: S2, inertia: 0.001}, rod2: {points: [S2, P], mass: 0.4}}\njoints:\n" +
         guide("G1", "c1", "S1") + guide("G2", "c2", "S2") +
         "  S1: {revolute: [c1, rod1], at: S1}\n  P: {revolute: [rod1, rod2], at: P}\n"
         "  S2: {revolute: [c2, rod2], at: S2}\n"
         "end_effector: {link: rod1, at: P}\n" +
         loads;
}

TEST(Certificate, OfGuidesWithoutEndsSayWhereTheyBearNothing) {
  const std::string model = two_carriages("", "loads: [{link: rod1, at: P, force: [5, 20]}]\ngravity: [0, -9.81]\n");
  const std::string text = certificate_of(model);
  EXPECT_NE(Json::parse(text).dump().find(R"(["G2","f"])"), std::string::npos);
  const check::Examination examination = examination_of(model, text);
  EXPECT_TRUE(examination.accepted) << summary(examination);
  EXPECT_GT(examination.arcs, 0u);
}

TEST(Certificate, FactorsThatAreNowhereZeroAreClaimedToBe) {
  const std::string model =
      two_carriages(", clearance: {gap: 1e-5, half_length: 0.04}", "loads: [{link: rod1, at: P, force: [5, 20]}]\n");
  const std::string text = certificate_of(model);
  const check::Examination examination = examination_of(model, text);
  EXPECT_TRUE(examination.accepted) << summary(examination);
  // Without the claim the factor is missing from |A|.
  Json certificate = Json::parse(text);
  Json& sheets = certificate["sheets"];
  const auto whole = std::find_if(sheets.begin(), sheets.end(), [&](const Json& sheet) {
    return certificate["functions"][sheet["function"].get<std::size_t>()]["name"] == "xS1 - xS2";
  });
  ASSERT_NE(whole, sheets.end());
  EXPECT_EQ(whole->at("role"), "direct-singularity");
  EXPECT_EQ(whole->at("cells"), ".");
  sheets.erase(whole);
  EXPECT_FALSE(examination_of(model, certificate.dump()).accepted);
}

TEST(Certificate, OfEveryWorkingModeIsAccepted) {
  const std::string model = example("five_bar_generic.yaml");
  LociRequest request;
  request.all_working_modes = true;
  const check::Examination examination = examination_of(model, certificate_of(model, request));
  EXPECT_TRUE(examination.accepted) << summary(examination);
}

TEST(Certificate, LimitsAreThoseOfTheModel) {
  const std::string plain = example("five_bar.yaml");
  const auto limited = [&](const std::string& reach) {
    return plain + "limits: [{distance: [A1, P], within: [0.31, " + reach + "]}]\n";
  };
  const std::string model = limited("0.92"), other = limited("0.93");
  Json certificate = Json::parse(certificate_of(model));
  const check::Examination examination = examination_of(model, certificate.dump());
  EXPECT_TRUE(examination.accepted) << summary(examination);
  certificate["model"]["text"] = other;
  EXPECT_FALSE(examination_of(other, certificate.dump()).accepted);
  // Without a root for it the limit is not known to be kept.
  certificate = Json::parse(certificate_of(model));
  for (auto& root : certificate["roots"])
    if (root["role"] == "limit") root["role"] = "length";
  EXPECT_THROW((void)examination_of(model, certificate.dump()), core::InputError);
}

TEST(Certificate, OfZonesIsAccepted) {
  const std::string model = example("five_bar.yaml");
  const check::Examination examination = examination_of(model, certificate_of(model, {}, true));
  EXPECT_TRUE(examination.accepted) << summary(examination);
  EXPECT_GT(examination.zones, 3u);
}

TEST(Certificate, OfRandomDesignsIsAccepted) {
  std::mt19937 random(20110501);
  int accepted = 0;
  const char* const count = std::getenv("CLEARLOCI_DESIGNS");
  const int designs = count != nullptr ? std::atoi(count) : 6;
  for (int i = 0; i < designs; ++i) {
    const std::string model = random_five_bar(random, i % 2 == 1).text();
    const check::Examination examination = examination_of(model, certificate_of(model));
    EXPECT_TRUE(examination.accepted) << model << summary(examination);
    accepted += examination.accepted ? 1 : 0;
  }
  EXPECT_EQ(accepted, designs);
}

// --- what is false
// ----------------------------------------------------------------------------------------------------

class Mutations : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    model_ = new std::string(example("five_bar_generic.yaml"));
    certificate_ = new std::string(certificate_of(*model_));
  }
  static void TearDownTestSuite() {
    delete model_;
    delete certificate_;
  }
  static Json certificate() { return Json::parse(*certificate_); }

  static void expect_rejected(const Json& changed, const std::string& word = "") {
    const check::Examination examination = examination_of(*model_, changed.dump());
    EXPECT_FALSE(examination.accepted);
    EXPECT_NE(examination.why.find(word), std::string::npos) << examination.why;
  }

  /// The first arc of a curve of some kind.
  static Json& arc_of(Json& certificate, const std::string& kind) {
    for (Json& curve : certificate["curves"])
      if (curve["kind"] == kind && !curve["arcs"].empty()) return curve["arcs"][0];
    throw std::logic_error("no such curve");
  }

  static std::string* model_;
  static std::string* certificate_;
};
std::string* Mutations::model_ = nullptr;
std::string* Mutations::certificate_ = nullptr;

TEST_F(Mutations, WithoutOneIsAccepted) {
  const check::Examination examination = examination_of(*model_, certificate().dump());
  EXPECT_TRUE(examination.accepted) << summary(examination);
}

TEST_F(Mutations, ACellLeftOut) {
  for (std::size_t s = 0; s < certificate()["sheets"].size(); ++s) {
    Json changed = certificate();
    std::string cells = changed["sheets"][s]["cells"];
    cells.erase(cells.rfind(' '));
    changed["sheets"][s]["cells"] = cells;
    expect_rejected(changed, "cover");
  }
}

TEST_F(Mutations, AGraphCalledFree) {
  for (std::size_t s = 0; s < certificate()["sheets"].size(); ++s) {
    Json changed = certificate();
    std::string cells = changed["sheets"][s]["cells"];
    const std::size_t at = cells.find(":2");
    if (at == std::string::npos) continue;
    const std::size_t from = cells.rfind(' ', at) + 1;
    cells.replace(from, at + 2 - from, ".");
    changed["sheets"][s]["cells"] = cells;
    expect_rejected(changed, "free of zeros");
  }
}

TEST_F(Mutations, ACountChanged) {
  for (std::size_t s = 0; s < certificate()["sheets"].size(); ++s) {
    Json changed = certificate();
    std::string cells = changed["sheets"][s]["cells"];
    const std::size_t at = cells.find(":2 ");
    if (at == std::string::npos) continue;
    cells[at + 1] = '4';
    changed["sheets"][s]["cells"] = cells;
    expect_rejected(changed, "ends");
  }
}

TEST_F(Mutations, AVariableChanged) {
  // Every graph over x said to be over y: some of them are both, not all.
  Json changed = certificate();
  for (Json& sheet : changed["sheets"]) {
    std::string cells = sheet["cells"];
    for (std::size_t at = cells.find("g0:"); at != std::string::npos; at = cells.find("g0:", at + 1))
      cells[at + 1] = '1';
    sheet["cells"] = cells;
  }
  expect_rejected(changed);
}

TEST_F(Mutations, ASmallerDomain) {
  Json changed = certificate();
  changed["sheets"][0]["domain"][0] = "0x0p+0";
  expect_rejected(changed);
}

TEST_F(Mutations, ASheetLeftOut) {
  for (std::size_t s = 0; s < certificate()["sheets"].size(); ++s) {
    Json changed = certificate();
    changed["sheets"].erase(s);
    expect_rejected(changed);
  }
}

// What vanishes along a boundary or a singularity has an arc of its own.
TEST_F(Mutations, AReactionNamedWhereItIsUnbounded) {
  for (const char* kind : {"direct-singularity", "workspace-boundary"}) {
    Json changed = certificate();
    for (Json& curve : changed["curves"])
      if (curve["kind"] == kind) curve["vanishing"].push_back({"B2", "f"});
    expect_rejected(changed, "is said to make");
  }
}

TEST_F(Mutations, AnArcMoved) {
  for (const char* kind : {"contact-loss", "direct-singularity", "workspace-boundary"}) {
    Json changed = certificate();
    for (Json& point : arc_of(changed, kind)["points"]) point[0] = point[0].get<double>() + 1e-7;
    expect_rejected(changed);
  }
}

TEST_F(Mutations, AVertexMoved) {
  for (const char* kind : {"contact-loss", "direct-singularity", "workspace-boundary"}) {
    Json changed = certificate();
    Json& points = arc_of(changed, kind)["points"];
    points[points.size() / 3][1] = points[points.size() / 3][1].get<double>() + 1e-8;
    expect_rejected(changed);
  }
}

TEST_F(Mutations, AnArcRemoved) {
  for (std::size_t c = 0; c < certificate()["curves"].size(); ++c)
    for (std::size_t a = 0; a < certificate()["curves"][c]["arcs"].size(); ++a) {
      Json changed = certificate();
      changed["curves"][c]["arcs"].erase(a);
      expect_rejected(changed);
    }
}

TEST_F(Mutations, AnArcTwice) {
  for (const char* kind : {"contact-loss", "direct-singularity", "workspace-boundary"}) {
    Json changed = certificate();
    for (Json& curve : changed["curves"])
      if (curve["kind"] == kind && !curve["arcs"].empty()) {
        curve["arcs"].push_back(Json(curve["arcs"][0]));
        break;
      }
    expect_rejected(changed, "two arcs");
  }
}

TEST_F(Mutations, HalfAnArc) {
  for (const char* kind : {"contact-loss", "direct-singularity", "workspace-boundary"}) {
    Json changed = certificate();
    Json& arc = arc_of(changed, kind);
    Json half = Json::array();
    for (std::size_t i = 0; i <= arc["points"].size() / 2; ++i) half.push_back(arc["points"][i]);
    arc["points"] = half;
    expect_rejected(changed);
  }
}

TEST_F(Mutations, AnArcAdded) {
  Json changed = certificate();
  Json& curve = changed["curves"][0];
  curve["arcs"].push_back({{"closed", false},
                           {"ends", {"crossing", "crossing"}},
                           {"points", {{0.31, -0.42}, {0.315, -0.424}, {0.32, -0.43}, {0.33, -0.44}}}});
  expect_rejected(changed);
}

TEST_F(Mutations, AnEndRelabelled) {
  Json changed = certificate();
  for (Json& curve : changed["curves"])
    for (Json& arc : curve["arcs"])
      if (arc["ends"][0] == "boundary") {
        arc["ends"][0] = "direct-singularity";
        return expect_rejected(changed, "ends");
      }
  FAIL() << "no arc ends on the boundary";
}

TEST_F(Mutations, ALabelChanged) {
  for (std::size_t c = 0; c < certificate()["curves"].size(); ++c) {
    Json changed = certificate();
    Json& vanishing = changed["curves"][c]["vanishing"];
    if (vanishing.empty()) continue;
    vanishing.erase(0);
    expect_rejected(changed, "vanish");
  }
}

TEST_F(Mutations, AFunctionChanged) {
  for (std::size_t f = 0; f < certificate()["functions"].size(); ++f) {
    Json changed = certificate();
    std::string program = changed["functions"][f]["program"];
    const std::size_t at = program.find('*');
    if (at == std::string::npos) continue;
    program[at] = '+';
    changed["functions"][f]["program"] = program;
    expect_rejected(changed);
  }
}

TEST_F(Mutations, ALoadOfAFunctionChanged) {
  // A number of a program instead of a step: another load, length or base.
  int tried = 0;
  for (std::size_t f = 0; f < certificate()["functions"].size(); ++f) {
    Json changed = certificate();
    std::string program = changed["functions"][f]["program"];
    const std::size_t at = program.find_first_of("123456789", program.find('c'));
    if (program.find('c') == std::string::npos) continue;
    program.insert(at, "7");
    changed["functions"][f]["program"] = program;
    expect_rejected(changed);
    ++tried;
  }
  EXPECT_GT(tried, 3);
}

TEST_F(Mutations, AVariableOfAFunctionChanged) {
  for (std::size_t f = 0; f < certificate()["functions"].size(); ++f) {
    Json changed = certificate();
    std::string program = changed["functions"][f]["program"];
    const std::size_t at = program.find("v0");
    if (at == std::string::npos) continue;
    program[at + 1] = '1';
    changed["functions"][f]["program"] = program;
    expect_rejected(changed);
  }
}

TEST_F(Mutations, AFactorDropped) {
  for (std::size_t f = 0; f < certificate()["functions"].size(); ++f) {
    Json changed = certificate();
    Json sheets = Json::array();
    for (const Json& sheet : changed["sheets"])
      if (sheet["function"].get<std::size_t>() != f) sheets.push_back(sheet);
    if (sheets.size() == changed["sheets"].size()) continue;
    changed["sheets"] = sheets;
    expect_rejected(changed);
  }
}

TEST_F(Mutations, ACrossingDropped) {
  // Two arcs that end where |A| cuts their curve, made one.
  int tried = 0;
  for (std::size_t c = 0; c < certificate()["curves"].size(); ++c) {
    const Json arcs = certificate()["curves"][c]["arcs"];
    if (certificate()["curves"][c]["kind"] == "direct-singularity") continue;
    for (std::size_t a = 0; a < arcs.size(); ++a)
      for (std::size_t b = 0; b < arcs.size(); ++b) {
        const Json &end = arcs[a]["points"].back(), &start = arcs[b]["points"].front();
        if (a == b || arcs[a]["ends"][1] != "direct-singularity" ||
            std::hypot(end[0].get<double>() - start[0].get<double>(), end[1].get<double>() - start[1].get<double>()) >
                1e-9)
          continue;
        Json changed = certificate();
        Json& list = changed["curves"][c]["arcs"];
        for (std::size_t i = 1; i < arcs[b]["points"].size(); ++i) list[a]["points"].push_back(arcs[b]["points"][i]);
        list[a]["ends"][1] = arcs[b]["ends"][1];
        list.erase(b);
        expect_rejected(changed, "|A|");
        ++tried;
      }
  }
  EXPECT_GT(tried, 0);
}

TEST_F(Mutations, AFileOfAnotherModel) {
  const check::Examination examination = examination_of(example("five_bar.yaml"), *certificate_);
  EXPECT_FALSE(examination.accepted);
  EXPECT_NE(examination.why.find("model"), std::string::npos) << examination.why;
}

TEST_F(Mutations, ARootChanged) {
  for (std::size_t r = 0; r < certificate()["roots"].size(); ++r) {
    Json changed = certificate();
    std::string program = changed["roots"][r]["square"];
    program[program.find('*')] = '+';
    changed["roots"][r]["square"] = program;
    expect_rejected(changed);
  }
}

TEST_F(Mutations, AModeChanged) {
  Json changed = certificate();
  changed["modes"][0][0] = -changed["modes"][0][0].get<int>();
  expect_rejected(changed);
}

TEST_F(Mutations, ABoxChanged) {
  Json changed = certificate();
  changed["box"][0][0] = "-1/3";
  expect_rejected(changed, "box");
}

TEST_F(Mutations, AModelChanged) {
  std::string model = *model_;
  model += "# another comment\n";
  const check::Examination examination = examination_of(model, *certificate_);
  EXPECT_FALSE(examination.accepted);
  EXPECT_NE(examination.why.find("model"), std::string::npos);

  // Both the file and its copy in the certificate: another mechanism.
  Json changed = certificate();
  const std::size_t at = model_->find("force: [");
  ASSERT_NE(at, std::string::npos);
  std::string other = *model_;
  other.replace(at, 8, "force: [7 + ");
  changed["model"]["text"] = other;
  EXPECT_FALSE(examination_of(other, changed.dump()).accepted);
}

TEST(Points, AreCounted) {
  const std::string model = example("five_bar_isolated.yaml");
  Json certificate = Json::parse(certificate_of(model));
  ASSERT_FALSE(certificate["points"].empty());
  EXPECT_GT(examination_of(model, certificate.dump()).points, 0u);

  Json moved = certificate;
  moved["points"][0]["at"][0] = moved["points"][0]["at"][0].get<double>() + 1e-6;
  EXPECT_FALSE(examination_of(model, moved.dump()).accepted);

  Json fewer = certificate;
  fewer["points"].erase(0);
  EXPECT_FALSE(examination_of(model, fewer.dump()).accepted);
}

TEST(Zones, AreHeldAgainstTheModel) {
  const std::string model = example("five_bar.yaml");
  const Json certificate = Json::parse(certificate_of(model, {}, true));
  ASSERT_TRUE(examination_of(model, certificate.dump()).accepted);
  const auto rejected = [&](const std::function<void(Json&)>& change) {
    Json changed = certificate;
    change(changed["zones"][0]);
    EXPECT_FALSE(examination_of(model, changed.dump()).accepted);
  };
  rejected([](Json& zone) { zone["assembly_mode"] = -zone["assembly_mode"].get<int>(); });
  rejected([](Json& zone) { zone["signs"][0][2] = -zone["signs"][0][2].get<int>(); });
  rejected([](Json& zone) { zone["area"] = zone["area"].get<double>() + 0.01; });
  rejected([](Json& zone) { zone["sample"][0] = zone["sample"][0].get<double>() + 10; });
  rejected([](Json& zone) {
    Json& corner = zone["outer"][zone["outer"].size() / 2];
    corner[0] = corner[0].get<double>() + 1e-3;
  });
  rejected([](Json& zone) { zone["outer"].erase(zone["outer"].size() / 2); });
  rejected([&](Json& zone) {
    zone["outer"] = certificate["zones"][1]["outer"];
    zone["area"] = certificate["zones"][1]["area"];
  });
}

}  // namespace
}  // namespace clearloci::test
