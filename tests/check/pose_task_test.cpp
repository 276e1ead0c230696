// Certificates of tasks over any coordinates: what was verified is proven anew, and what is made false is rejected.
#include <gtest/gtest.h>

#include <functional>

#include "analysis/framed.hpp"
#include "analysis/loci.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/task_certificate.hpp"
#include "analysis/task_demands.hpp"
#include "clearloci/verify.hpp"
#include "mechanism/read_task.hpp"
#include "tests/check/certified.hpp"
#include "tests/laws/judged.hpp"

namespace clearloci::test {
namespace {

using Json = nlohmann::ordered_json;

struct Certified {
  std::string model, certificate;
  bool verified = false;
};

Certified certified(const std::string& model, const std::string& task_text) {
  const mechanism::Mechanism mechanism = mechanism::parse_mechanism(model, "model.yaml");
  const core::Task task = mechanism::parse_task("format: 1\n" + task_text, "task.yaml", mechanism);
  require_certifiable(task);
  return {model, report::certificate_text({"verify", model, {}}, clearloci::certificate_of(mechanism, task, {})),
          decided(mechanism, task).verified()};
}

struct Case {
  const char* name;
  const char* model;
  const char* task;
};

class TasksOfExamples : public testing::TestWithParam<Case> {};

TEST_P(TasksOfExamples, AreProvenAnew) {
  const Certified proof = certified(example(GetParam().model), GetParam().task);
  ASSERT_TRUE(proof.verified);
  const check::Examination examination = examination_of(proof.model, proof.certificate);
  EXPECT_TRUE(examination.accepted) << examination.why;
  EXPECT_GT(examination.task_cells, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Shipped, TasksOfExamples,
    testing::Values(
        Case{"OverAnAngle", "four_bar.yaml", "box: {theta: [70 deg, 80 deg]}\n"},
        Case{"WithLeastForces", "five_bar.yaml",
             "path: [[0, -0.7], [0, -0.675], [0.5, -0.675], [0.5, -0.7]]\nmargin: 0.01\nmin_force: 2\n"},
        Case{"WithinTolerances", "five_bar.yaml",
             "circle: {centre: [0.25, -0.6], radius: 0.02}\ntolerances: {L: 1e-3}\n"},
        Case{"UnderAnyLoadNear", "five_bar.yaml",
             "box: {x: [0.1, 0.4], y: [-0.8, -0.6]}\ntolerances: {L: 0.1e-3}\n"
             "loads_within: [{load: 1, radius: 20, couple: 2}]\n"},
        Case{"UnderATurningLoad", "five_bar.yaml",
             "box: {x: [0.1, 0.4], y: [-0.8, -0.6]}\nmin_force: 5\nloads_from: [[-20, -100], [20, -100]]\n"},
        Case{"UnderAnyLoadNearInSpace", "gough_stewart_slice.yaml",
             "box: {x: [-0.02, 0], y: [-0.2, -0.18]}\nloads_within: [{load: 1, radius: 5}]\n"},
        Case{"OfAPolygonWithTolerances", "five_bar.yaml",
             "polygon: [[0.1, -0.8], [0.4, -0.8], [0.25, -0.6]]\nmargin: 0.01\ntolerances: {L: 1e-4}\n"},
        Case{"OfAPolygonWithAngles", "three_rpr_orientation.yaml",
             "polygon: [[0.1, 0.1], [0.12, 0.1], [0.1, 0.12]]\nbox: {phi: [10 deg, 12 deg]}\nmargin: 1e-3\n"},
        Case{"OfGuides", "prrrp.yaml", "box: {x: [0.2, 0.22], y: [0.1, 0.12]}\nmin_force: 1e-3\n"},
        Case{"WithOrientations", "three_rpr_orientation.yaml",
             "box: {x: [0.1, 0.12], y: [0.1, 0.12], phi: [10 deg, 12 deg]}\n"},
        Case{"OfAGroup", "stephenson_outside.yaml", "box: {phi: [121 deg, 126 deg]}\nmargin: 0.1 deg\n"},
        Case{"OfADrawnGroup", "double_butterfly.yaml", "box: {theta: [114 deg, 115 deg]}\n"},
        Case{"OfAPlatformOverItsLegs", "three_rpr_legs.yaml",
             "path: [[0.7, 0.71, 0.65], [0.72, 0.71, 0.65], [0.72, 0.72, 0.66]]\n"},
        Case{"OfAPlatformOverItsLegsWithTolerances", "three_rpr_legs.yaml",
             "box: {q1: [0.705, 0.71], q2: [0.715, 0.72], q3: [0.65, 0.655]}\ntolerances: {r: 1e-3}\n"
             "loads_within: [{load: 1, radius: 2}]\n"},
        Case{"OfGears", "geared_five_bar.yaml", "box: {theta: [100 deg, 105 deg]}\nmin_force: 1\n"},
        Case{"OfABelt", "scara_belt.yaml", "box: {x: [200, 220], y: [100, 120]}\ntolerances: {forearm: 0.1}\n"},
        Case{"OfCables", "cables/hanging.yaml", "box: {x: [-0.1, 0.1], y: [-0.9, -0.7]}\n"},
        Case{"OfSlots", "scissor_lift.yaml", "box: {theta: [30 deg, 35 deg], u: [200, 300]}\nmargin: 0.5\n"},
        Case{"InSpace", "three_upu.yaml", "box: {x: [0.1, 0.12], y: [0.05, 0.07], z: [0.5, 0.55]}\n"},
        Case{"OfPinsInSpace", "delta.yaml", "box: {x: [0.05, 0.07], y: [0.03, 0.05], z: [-0.7, -0.68]}\n"},
        Case{"OverSixCoordinates", "gough_stewart_poses.yaml",
             "box: {x: [-0.02, 0.02], y: [-0.02, 0.02], z: [0.48, 0.52], alpha: [-2 deg, 2 deg], "
             "beta: [-2 deg, 2 deg], gamma: [-2 deg, 2 deg]}\nangle_length: 0.2\nmargin: 0.01\n"
             "tolerances: {plate: 2e-3}\n"}),
    [](const auto& candidate) { return std::string(candidate.param.name); });

/// The three-RPR over orientations, whose actuators' and pins' forces are asked for.
Certified platform() {
  return certified(example("three_rpr_orientation.yaml"),
                   "box: {x: [0.1, 0.12], y: [0.1, 0.12], phi: [10 deg, 12 deg]}\n");
}

using Changes = std::vector<std::pair<const char*, std::function<void(Json&)>>>;

/// It is accepted as it is; with any of the changes it is rejected, or is no certificate any more.
void expect_rejected(const Certified& certified, const Changes& changes) {
  const check::Examination examination = examination_of(certified.model, certified.certificate);
  ASSERT_TRUE(examination.accepted) << examination.why;
  for (const auto& [what, change] : changes) {
    Json changed = Json::parse(certified.certificate);
    change(changed);
    try {
      EXPECT_FALSE(examination_of(certified.model, changed.dump()).accepted) << what;
    } catch (const core::InputError&) {
      SUCCEED() << "it is no certificate any more";
    }
  }
}

TEST(PoseTaskCertificate, IsRejectedWhereAClaimIsMadeFalse) {
  const Certified certified = platform();
  const Changes changes = {
      {"a box that reaches a locus",
       [](Json& c) {
         c["pose_task"]["points"][0] = {"-9/10", "-9/10", "-3"};
       }},
      {"a margin beyond the loci", [](Json& c) { c["pose_task"]["margin"] = "2"; }},
      {"a box inside out", [](Json& c) { std::swap(c["pose_task"]["points"][0], c["pose_task"]["points"][1]); }},
      {"more force than there is", [](Json& c) { c["pose_task"]["demands"][0][2] = "100000"; }},
      {"a joint that is none", [](Json& c) { c["pose_task"]["demands"][0][0] = "Q9"; }},
      {"a quantity that nothing bears", [](Json& c) { c["pose_task"]["demands"][0][1] = "end_ahead"; }},
      {"no demands", [](Json& c) { c["pose_task"]["demands"] = Json::array(); }},
      {"a side too many", [](Json& c) { c["pose_task"]["sides"].push_back(1); }},
      {"a parameter away from its value",
       [](Json& c) {
         c["pose_task"]["parameters"] = {{"r", "1", "2"}, {"r", "1", "2"}};
       }},
      {"a parameter of another model",
       [](Json& c) {
         c["pose_task"]["parameters"] = {{"q", "1", "2"}, {"q", "1", "2"}};
       }},
      {"coordinates in another order", [](Json& c) { std::swap(c["coordinates"][0], c["coordinates"][1]); }},
      {"another model", [](Json& c) { c["model"]["text"] = example("three_rrr_orientation.yaml"); }},
  };
  expect_rejected(certified, changes);
}

TEST(PoseTaskCertificate, IsRejectedWhereItsLoadsAreMadeLarger) {
  const Certified proof = certified(example("five_bar.yaml"),
                                    "box: {x: [0.1, 0.4], y: [-0.8, -0.6]}\nmargin: 1e-3\n"
                                    "loads_within: [{load: 1, radius: 20, couple: 2}]\n");
  const Changes changes = {
      {"a ball that holds the opposite load", [](Json& c) { c["pose_task"]["loads_within"][0][1] = "101"; }},
      {"a negative ball", [](Json& c) { c["pose_task"]["loads_within"][0][1] = "-1"; }},
      {"a load that is none", [](Json& c) { c["pose_task"]["loads_within"][0][0] = 1; }},
      {"a load that turns round",
       [](Json& c) {
         c["pose_task"]["loads_from"] = {{"0", "-100"}, {"0", "100"}};
       }},
      {"a load with too many parts",
       [](Json& c) {
         c["pose_task"]["loads_from"] = {{"0", "0", "1"}, {"0", "0", "1"}};
       }},
      {"one end of a load",
       [](Json& c) {
         c["pose_task"]["loads_from"] = Json::array({{"0", "-100"}});
       }},
  };
  expect_rejected(proof, changes);
}

TEST(PoseTaskCertificate, IsRejectedWhereItsPolygonIsMadeLarger) {
  const Certified proof = certified(example("three_rpr_orientation.yaml"),
                                    "polygon: [[0.1, 0.1], [0.12, 0.1], [0.1, 0.12]]\nbox: {phi: [10 deg, 12 deg]}\n");
  const Changes changes = {
      {"a corner beyond the loci",
       [](Json& c) {
         c["pose_task"]["points"][0] = {"-9/10", "-9/10", c["pose_task"]["points"][0][2]};
       }},
      {"a range of angles beyond the loci", [](Json& c) { c["pose_task"]["above"][2] = "3"; }},
      {"corners at several angles", [](Json& c) { c["pose_task"]["points"][0][2] = "0"; }},
      {"across one coordinate",
       [](Json& c) {
         c["pose_task"]["across"] = {0, 0};
       }},
      {"across a coordinate that is none",
       [](Json& c) {
         c["pose_task"]["across"] = {0, 7};
       }},
      {"two corners", [](Json& c) { c["pose_task"]["points"].erase(2); }},
  };
  expect_rejected(proof, changes);
}

// Where the program refutes a task, no certificate of it is accepted: the checker finds the locus too.
TEST(PoseTaskCertificate, OfARefutedTaskIsRejected) {
  const Certified proof = certified(example("four_bar.yaml"), "box: {theta: [10 deg, 170 deg]}\n");
  ASSERT_FALSE(proof.verified);
  const check::Examination examination = examination_of(proof.model, proof.certificate);
  EXPECT_FALSE(examination.accepted);
  EXPECT_NE(examination.why.find("theta"), std::string::npos) << examination.why;
}

// A third leg without weight, whose motor is given no effort, bears nothing at any pose.
TEST(PoseTaskCertificate, AsksForWhatOtherEffortsWouldLoad) {
  std::string model = example("studies/third_leg.yaml");
  const std::string play = ", angular: 0.5e-3", task_text = "format: 1\nbox: {x: [0.22, 0.23], y: [0.31, 0.32]}\n";
  model.erase(model.find(play, model.find("at: A3, actuated")), play.size());
  for (const char* effort : {"0", "-1"}) {
    const mechanism::Mechanism mechanism = mechanism::parse_mechanism(model, "model.yaml", {{"preload_A3", effort}});
    const core::Task task = mechanism::parse_task(task_text, "task.yaml", mechanism);
    const report::CertificateSource source{"verify", model, {{"preload_A3", effort}}};
    const bool loaded = std::string(effort) != "0";
    const std::string alone = report::certificate_text(source, clearloci::certificate_of(mechanism, task, {}));
    EXPECT_EQ(examination_of(model, alone).accepted, loaded) << effort;
    core::Certificate loci;
    trace_loci(mechanism, {}, &loci);
    const core::Task in_loci = in_frame(task, loci);
    const check::Examination examination = examination_of(model, report::certificate_text(source, loci, &in_loci));
    EXPECT_EQ(examination.accepted, loaded) << effort << examination.why;
    EXPECT_EQ(examination.why.find("A3 bears nothing") == std::string::npos, loaded) << examination.why;
  }
}

// Where no pose is within reach nothing is told of other efforts.
TEST(EffortsBesideTheGiven, LoadForCertainOrNotAtAll) {
  std::string model = example("studies/third_leg.yaml");
  const std::string play = ", angular: 0.5e-3";
  model.erase(model.find(play, model.find("at: A3, actuated")), play.size());
  const mechanism::Mechanism mechanism = mechanism::parse_mechanism(model, "model.yaml", {{"preload_A3", "0"}});
  const std::vector<core::TaskDemand> demands = demands_of(mechanism, {});
  const std::vector<int> sides = requested_modes(mechanism, {}).front();
  const std::vector<bool> near = loaded_beside_efforts(mechanism, sides, demands, {{100, 100}, {0.22, 0.31}}),
                          beyond = loaded_beside_efforts(mechanism, sides, demands, {{100, 100}});
  ASSERT_EQ(near.size(), demands.size());
  for (std::size_t d = 0; d < demands.size(); ++d) {
    EXPECT_TRUE(near[d] || demands[d].joint != "A3") << core::to_string(demands[d].quantity);
    EXPECT_FALSE(beyond[d]) << demands[d].joint;
  }
}

TEST(PoseTaskCertificate, OfWhatIsNotCertifiedIsRefused) {
  const std::string model = example("four_bar.yaml");
  EXPECT_THROW(certified(model, "box: {theta: [70 deg, 80 deg]}\npose_error: 1e-3\n"), core::InputError);
}

/// A five-bar whose first motor exerts what it is given at most, N m.
std::string bounded_five_bar(const std::string& within) {
  std::string text = example("five_bar.yaml");
  const std::string motor = "at: A1, actuated: true";
  const std::size_t at = text.find(motor);
  return text.replace(at, motor.size(), "at: A1, actuated: {within: " + within + "}");
}

TEST(PoseTaskCertificate, HoldsEffortsToTheirBounds) {
  const std::string task = "box: {x: [0.24, 0.26], y: [-0.7, -0.68]}\n";
  const Certified wide = certified(bounded_five_bar("[-100, 100]"), task);
  ASSERT_TRUE(wide.verified);
  const check::Examination examination = examination_of(wide.model, wide.certificate);
  EXPECT_TRUE(examination.accepted) << examination.why;
  for (const char* narrow : {"[-0.5, 0.5]", "[-100, -99]", "[99, 100]"}) {
    const Certified proof = certified(bounded_five_bar(narrow), task);
    EXPECT_FALSE(proof.verified) << narrow;
    EXPECT_FALSE(examination_of(proof.model, proof.certificate).accepted) << narrow;
  }
}

TEST(PoseTaskCertificate, OfGearsIsRejectedOnTheOtherFlankAndAcrossBothOfThem) {
  const Certified proof = certified(example("geared_five_bar.yaml"), "box: {theta: [100 deg, 105 deg]}\n");
  const Changes changes = {
      {"the other flank", [](Json& c) { c["pose_task"]["sides"][0] = -c["pose_task"]["sides"][0].get<int>(); }},
      {"a box across both flanks", [](Json& c) { c["pose_task"]["points"][0][0] = "0"; }},
      {"a box across both flanks, without the demand",
       [](Json& c) {
         c["pose_task"]["points"][0][0] = "0";
         c["pose_task"]["demands"] = Json::array({{"P", "f", "0"}});
       }},
  };
  expect_rejected(proof, changes);
}

TEST(PoseTaskCertificate, OfABeltIsRejectedWhereASpanIsSlack) {
  const std::string task = "box: {x: [200, 220], y: [100, 120]}\n";
  const Certified tight = certified(example("scara_belt.yaml"), task);
  ASSERT_TRUE(tight.verified);
  EXPECT_TRUE(examination_of(tight.model, tight.certificate).accepted);
  std::string text = example("scara_belt.yaml");
  text.replace(text.find("T0: 80"), 6, "T0: 20");
  const Certified slack = certified(text, task);
  EXPECT_FALSE(slack.verified);
  EXPECT_FALSE(examination_of(slack.model, slack.certificate).accepted);
}

TEST(PoseTaskCertificate, OfAGroupIsRejectedBeyondADeadCentreAndInAnotherAssembly) {
  const std::string text = example("stephenson_outside.yaml");
  const Certified proof = certified(text, "box: {phi: [121 deg, 125 deg]}\n");
  ASSERT_TRUE(proof.verified);
  const Changes changes = {
      {"a box beyond a dead centre", [](Json& c) { c["pose_task"]["points"][0][0] = "19/10"; }},
      {"more force than there is", [](Json& c) { c["pose_task"]["demands"][0][2] = "100000"; }},
      {"another assembly",
       [&](Json& c) {
         std::string other = text;
         const std::string near = "B: [0.05, 0.3], C: [0.86, 0.69], E: [0.42, 0.92]";
         c["model"]["text"] =
             other.replace(other.find(near), near.size(), "B: [0, -0.3], C: [0.8, 0.69], E: [0.4, 0.2]");
       }},
  };
  expect_rejected(proof, changes);
  // Where the program refutes a task the checker finds the locus, too.
  const Certified refuted = certified(text, "box: {phi: [121 deg, 190 deg]}\n");
  ASSERT_FALSE(refuted.verified);
  EXPECT_FALSE(examination_of(refuted.model, refuted.certificate).accepted);
}

}  // namespace
}  // namespace clearloci::test
