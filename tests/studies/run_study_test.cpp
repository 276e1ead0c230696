// Studies as a whole: the same verdicts as single designs have, whatever the number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <set>

#include "clearloci/study.hpp"
#include "clearloci/verify.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_study.hpp"
#include "tests/report/scratch_folder.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using Status = StudyDesign::Status;

Model five_bar() { return Model::read(source_dir() + "/examples/five_bar.yaml"); }

std::string study_text(const std::string& method, const std::string& more = "goal: {maximise: margin}") {
  return "format: 1\nvary: {L: [0.3, 0.7], d: [0.3, 0.7]}\n"
         "task: {box: {x: [0.1, 0.4], y: [-0.7, -0.5]}}\n" +
         more + "\nmethod: " + method + "\n";
}

std::string told(const StudyResult& result) {
  std::string text;
  for (const StudyDesign& design : result.designs) {
    text += std::to_string(design.index) + " " + to_string(design.status) + " " + design.reason;
    for (const double value : design.values) text += " " + std::to_string(value);
    for (const double value : design.figures) text += " " + std::to_string(value);
    text += "\n";
  }
  return text;
}

/// As of a task: in the units of the mechanism file, where they have none of their own.
TEST(Study, RequiresFiguresInTheUnitsOfTheFile) {
  const mechanism::Mechanism lift = mechanism::read_mechanism(source_dir() + "/examples/scissor_lift.yaml");
  const auto required = [&](const std::string& require) {
    const Study study = mechanism::parse_study(
        "format: 1\nvary: {W: [1000, 2000]}\ntask: {box: {theta: [20, 30], u: [0, 100]}}\nrequire: {" + require +
            "}\ngoal: {maximise: margin}\nmethod: {grid: 2}\n",
        "study.yaml", lift);
    return core::to_double(study.require.at(0).bound);
  };
  EXPECT_DOUBLE_EQ(required("pose_error: 3.4 mm"), 0.0034);
  EXPECT_DOUBLE_EQ(required("pose_error: 3.4"), 0.0034);
  EXPECT_DOUBLE_EQ(required("margin: 3 cm"), 0.03);
  EXPECT_DOUBLE_EQ(required("largest_circle: 30"), 0.03);
  EXPECT_DOUBLE_EQ(required("min_force: 2 kN"), 2000);
  EXPECT_DOUBLE_EQ(required("effort: 500 N mm"), 0.5);
  EXPECT_DOUBLE_EQ(required("effort: 0.5 kN"), 500);
  EXPECT_DOUBLE_EQ(required("effort: 12"), 12);
  EXPECT_DOUBLE_EQ(required("zone_area: 500 mm^2"), 0.0005);
  EXPECT_THROW(required("pose_error: 3.4 N"), core::InputError);
  EXPECT_THROW(required("effort: 3 mm"), core::InputError);
}

TEST(Study, SaysOfEveryDesignWhatVerifySays) {
  const Model model = five_bar();
  const Study study = parse_study(study_text("{grid: [7, 6]}"), model);
  const StudyResult result = run_study(model, study);
  ASSERT_EQ(result.designs.size(), 42U);
  std::size_t feasible = 0;
  for (const StudyDesign& design : result.designs) {
    std::vector<Model::Value> values;
    for (std::size_t i = 0; i < 2; ++i) values.emplace_back(result.parameters[i], std::to_string(design.values[i]));
    const Model member = model.with(values);
    Task task = study.tasks.front();
    const Verification answer = verify(member, task, {.depth = VerifyDepth::margin});
    EXPECT_EQ(design.status == Status::feasible, answer.verdict == Verdict::verified)
        << design.index << " " << design.reason;
    EXPECT_EQ(design.status == Status::infeasible, answer.verdict == Verdict::refuted)
        << design.index << " " << design.reason;
    if (design.status != Status::feasible) continue;
    ++feasible;
    // Both are proven lower bounds of one number.
    EXPECT_NEAR(design.figures.front(), *answer.margin, 2e-3 * (*answer.margin + 0.3)) << design.index;
  }
  EXPECT_GT(feasible, 5U);
  EXPECT_LT(feasible, 37U);
  ASSERT_TRUE(result.best);
  for (const StudyDesign& design : result.designs)
    if (design.status == Status::feasible) {
      EXPECT_LE(design.figures.front(), result.designs[*result.best].figures.front());
    }
}

TEST(Study, IsRefusedWhereItIsNone) {
  const Model model = five_bar();
  const Study good = parse_study(study_text("{grid: [2, 2]}"), model);
  const auto refuses = [&](const auto& change) {
    Study study = good;
    change(study);
    EXPECT_THROW(run_study(model, study), InputError);
    EXPECT_THROW(judge_designs(model, study, 0, 1), InputError);
  };
  using Kind = StudyMethod::Kind;
  refuses([](Study& study) { study.vary.clear(); });
  refuses([](Study& study) { study.vary[0].name = "nobody"; });
  refuses([](Study& study) { study.vary[1] = study.vary[0]; });
  refuses([](Study& study) { std::swap(study.vary[0].lower, study.vary[0].upper); });
  refuses([](Study& study) { study.tasks.clear(); });
  refuses([](Study& study) { study.tasks.front().shape = TaskBox{}; });
  refuses([](Study& study) { study.method.counts = {3}; });
  refuses([](Study& study) { study.method.counts = {0, 3}; });
  refuses([](Study& study) { study.method.counts = {2'000'000'000, 2'000'000'000}; });
  refuses([](Study& study) { study.method = {Kind::sample, {}, 0}; });
  refuses([](Study& study) { study.method = {Kind::search, {}, 0}; });
  refuses([](Study& study) { study.require = {{Figure::margin, -1}}; });
}

TEST(Study, DesignsAreThoseOfItsResult) {
  const Model model = five_bar();
  const StudyResult result = run_study(model, parse_study(study_text("{grid: [2, 2]}"), model));
  const Model other = Model::read(source_dir() + "/examples/four_bar.yaml");
  EXPECT_NO_THROW(design_model(model, result, result.designs.front()));
  EXPECT_THROW(design_model(other, result, result.designs.front()), InputError);
  for (const std::vector<double>& values : {std::vector<double>{}, {std::nan(""), 0.5}}) {
    StudyDesign design = result.designs.front();
    design.values = values;
    EXPECT_THROW(design_text(model, result, design), InputError);
  }
}

TEST(Study, HasTheSameAnswerWhateverTheThreads) {
  const Model model = five_bar();
  const Study study = parse_study(study_text("{sample: 100}"), model);
  EXPECT_EQ(told(run_study(model, study, {.threads = 1})), told(run_study(model, study, {.threads = 5})));
}

TEST(Study, GoesOnWhereItWasStopped) {
  const report::fixture::ScratchFolder folder;
  const Model model = five_bar();
  const Study study = parse_study(study_text("{sample: 200}"), model);
  StudyOptions options = {.table = folder.path() / "designs.table", .threads = 2};
  const std::string whole = told(run_study(model, study, options));
  // Half of the table, cut in a line.
  std::filesystem::resize_file(options.table, std::filesystem::file_size(options.table) / 2);
  const std::string half = report::fixture::read_file(options.table);
  options.resume = true;
  EXPECT_EQ(told(run_study(model, study, options)), whole);
  const std::string lines = half.substr(0, half.rfind('\n') + 1), again = report::fixture::read_file(options.table);
  EXPECT_TRUE(again.starts_with(lines)) << "what the table holds is not judged again";
  EXPECT_EQ(std::count(again.begin(), again.end(), '\n'), 201);
}

TEST(Study, LeavesOutWhatIsNotKept) {
  const Model model = five_bar();
  const StudyResult result = run_study(model, parse_study(study_text("{grid: [9, 9]}", "keep: [L + d <= 1]"), model));
  for (const StudyDesign& design : result.designs)
    EXPECT_EQ(design.status == Status::left_out, design.values[0] + design.values[1] > 1 + 1e-12) << design.index;
}

TEST(Study, AFrontHasNoDesignThatAnotherBeatsInEveryGoal) {
  const Model model = five_bar();
  const StudyResult result = run_study(
      model, parse_study(study_text("{sample: 150}", "goal: [{maximise: margin}, {minimise: L + d}]"), model));
  ASSERT_GT(result.front.size(), 2U);
  const auto goals = [&](std::size_t i) {
    const StudyDesign& design = result.designs[i];
    return std::array{design.figures.front(), -(design.values[0] + design.values[1])};
  };
  for (const std::size_t entry : result.front)
    for (std::size_t i = 0; i < result.designs.size(); ++i) {
      if (result.designs[i].status != Status::feasible) continue;
      EXPECT_FALSE(goals(i)[0] > goals(entry)[0] && goals(i)[1] > goals(entry)[1]) << i << " beats " << entry;
    }
}

Verdict verdict_of(const Model& model, const StudyResult& result, const std::vector<double>& values) {
  std::vector<Model::Value> settings;
  for (std::size_t i = 0; i < values.size(); ++i)
    settings.emplace_back(result.parameters[i], std::to_string(values[i]));
  return verify(model.with(settings), result.study.tasks.front(), {.depth = VerifyDepth::verdict}).verdict;
}

TEST(Study, ParametersMayEnterByQuotientsAndCosines) {
  std::string text = report::fixture::read_file(source_dir() + "/examples/five_bar.yaml");
  const auto change = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  change("  d: L ", "  g: 1\n  tilt: 0\n  d: L/g ");
  change("A2: [d, 0]", "A2: [d*cos(tilt), d*sin(tilt)]");
  const Model model = Model::parse(text);
  const std::string study =
      "format: 1\nvary: {g: [0.7, 1.6], tilt: [-0.6, 0.6]}\ntask: {box: {x: [0.1, 0.4], y: [-0.7, -0.5]}}\n"
      "method: {grid: [6, 5]}\n";
  const StudyResult result = run_study(model, parse_study(study, model));
  std::size_t feasible = 0;
  for (const StudyDesign& design : result.designs) {
    const Verdict verdict = verdict_of(model, result, design.values);
    EXPECT_EQ(design.status == Status::feasible, verdict == Verdict::verified) << design.index << " " << design.reason;
    feasible += design.status == Status::feasible;
  }
  EXPECT_GT(feasible, 3U);
  EXPECT_LT(feasible, 30U);
}

/// A clearance of a joint changes no effort.
TEST(Study, EffortsAreThoseOfAllActuators) {
  const auto efforts = [](const std::string& clearance) {
    const Model model = Model::parse(R"(format: 1
parameters: {q: 0.5}
workspace: {x: [0.05, 0.45], y: [0.1, 1.1]}
points: {A: [0, 0], E: [q, 0], P: [x, y]}
links: {a: {points: [A]}, b: {points: [P]}, c: {points: [E]}, d: {points: [P]}}
joints:
  A: {revolute: [a, ground], at: A}
  S: {prismatic: [a, b], at: P, axis: [A, P], actuated: true, clearance: {axial: 1e-5}}
  P: {revolute: [b, d], at: P, clearance: {radial: 1e-5}}
  T: {prismatic: [c, d], at: P, axis: [E, P], actuated: true)" +
                                     clearance + R"(}
  E: {revolute: [ground, c], at: E}
end_effector: {link: d, at: P}
loads: [{link: d, at: P, force: [-100, 100]}]
)");
    const std::string study =
        "format: 1\nvary: {q: [0.43, 0.58]}\ntask: {box: {x: [0.2988, 0.3028], y: [0.4488, 0.4588]}}\n"
        "goal: {minimise: effort}\nmethod: {grid: [3]}\n";
    std::vector<double> list;
    for (const StudyDesign& design : run_study(model, parse_study(study, model)).designs)
      list.push_back(design.figures.empty() ? 0 : design.figures.front());
    return list;
  };
  const std::vector<double> all = efforts(", clearance: {axial: 1e-5}");
  ASSERT_EQ(all.size(), 3U);
  EXPECT_NEAR(all.back(), 153.57, 0.01);  // T bears 152.108 N at (0.2988, 0.4488)
  EXPECT_EQ(efforts(""), all);
}

TEST(Study, VariesFreeEffortsAndWritesTheBest) {
  const Model model = Model::read(source_dir() + "/examples/studies/antagonistic.yaml");
  const std::string study =
      "format: 1\nvary: {preload_B2: [-40 N m, -1 N m]}\ntask: {box: {x: [-0.05, 0.15], y: [0.45, 0.6]}}\n"
      "goal: {maximise: preload_B2}\nmethod: {prove: 1/4096}\n";
  const StudyResult result = run_study(model, parse_study(study, model));
  ASSERT_EQ(result.ranges.size(), 1U);
  EXPECT_NEAR(result.ranges.front().to[0], -6.09, 0.02);
  ASSERT_TRUE(result.best);
  const Model best = Model::parse(design_text(model, result, result.designs[*result.best]));
  EXPECT_TRUE(verify(best, parse_task("format: 1\nbox: {x: [-0.05, 0.15], y: [0.45, 0.6]}\n", best)).verified());
}

TEST(Study, WhatAProofDidNotComeToStaysUndecided) {
  const Model model = five_bar();
  const StudyResult result = run_study(model, parse_study(study_text("{prove: 1/64}", ""), model),
                                       {.threads = 1, .deadline = std::chrono::steady_clock::now()});
  EXPECT_FALSE(result.complete);
  double all = 0;
  bool is_left = false;
  for (const StudyCell& cell : result.cells) {
    all += (cell.upper[0] - cell.lower[0]) * (cell.upper[1] - cell.lower[1]);
    is_left = is_left || (cell.status == Status::undecided && cell.reason == "not looked at");
  }
  EXPECT_NEAR(all, 0.16, 1e-12);
  EXPECT_TRUE(is_left);
}

TEST(Study, AProofThatGoesOnStillTellsWhatItKnew) {
  const Model model = five_bar();
  const Study study = parse_study(study_text("{prove: 1/16}", ""), model);
  const report::fixture::ScratchFolder folder;
  const std::filesystem::path table = folder.path() / "table.csv";
  const StudyResult whole = run_study(model, study, {.table = table, .threads = 1});
  const StudyResult again = run_study(
      model, study, {.table = table, .resume = true, .threads = 1, .deadline = std::chrono::steady_clock::now()});
  EXPECT_EQ(again.cells.size(), whole.cells.size());
}

TEST(Study, ProvesCellsOfDesigns) {
  const Model model = five_bar();
  const StudyResult result = run_study(model, parse_study(study_text("{prove: 1/16}", ""), model), {.threads = 2});
  double area = 0, open = 0;
  for (const StudyCell& cell : result.cells) {
    const double size = (cell.upper[0] - cell.lower[0]) * (cell.upper[1] - cell.lower[1]);
    area += size;
    if (cell.status == Status::undecided) open += size;
    // Corners and the middle of a cell that is decided are designs like others.
    for (const double part : {0.01, 0.5, 0.99}) {
      if (cell.status == Status::undecided) continue;
      const Verdict verdict = verdict_of(model, result,
                                         {cell.lower[0] + part * (cell.upper[0] - cell.lower[0]),
                                          cell.lower[1] + part * (cell.upper[1] - cell.lower[1])});
      EXPECT_EQ(verdict, cell.status == Status::feasible ? Verdict::verified : Verdict::refuted) << cell.reason;
    }
  }
  EXPECT_NEAR(area, 0.16, 1e-12) << "cells make up the box";
  EXPECT_LT(open, 0.05);
  ASSERT_TRUE(result.tolerances);
  for (const double x : {1e-4, 1 - 1e-4})
    for (const double y : {1e-4, 1 - 1e-4})
      EXPECT_EQ(
          verdict_of(model, result,
                     {result.tolerances->lower[0] + x * (result.tolerances->upper[0] - result.tolerances->lower[0]),
                      result.tolerances->lower[1] + y * (result.tolerances->upper[1] - result.tolerances->lower[1])}),
          Verdict::verified);
}

/// The contact of A1, B1 and P is lost where the load and the spring's pull k (1 - l0/|HP|)(H - P) together point along
/// B2 P. Over the task of the study the stiffest spring for which they do is that of the corner (-1/20, 3/5).
double stiffness_at_the_corner() {
  const double x = -0.05, y = 0.6, half = 0.5, dx = x - half, dy = y;  // P from A2
  const double square = dx * dx + dy * dy, up = std::sqrt((half * half - square / 4) / square);
  const double vx = dx / 2 + up * dy, vy = dy / 2 - up * dx;  // B2 P
  const double hx = 0.75 - x, hy = -0.25 - y, pull = 1 - 0.25 / std::hypot(hx, hy);
  return -100 * vx / (pull * (hx * vy - hy * vx));
}

TEST(Study, TheSoftestSpringIsThatOfTheClosedForm) {
  const Model model = Model::read(source_dir() + "/examples/studies/preloaded.yaml");
  const Study study = read_study(source_dir() + "/examples/studies/softest_spring.yaml", model);
  const StudyResult result = run_study(model, study, {.threads = 2});
  ASSERT_EQ(result.ranges.size(), 1U);
  const ProvenRange& range = result.ranges.front();
  const double closed_form = stiffness_at_the_corner();
  EXPECT_LE(range.from[0], closed_form);
  EXPECT_GE(range.from[1], closed_form);
  EXPECT_LT(range.from[1] - range.from[0], 1e-12 * closed_form);
  EXPECT_EQ(range.below, "contact lost in A1, B1, P");
  EXPECT_EQ(range.to[0], 400);
  EXPECT_EQ(range.to[1], 400);
  EXPECT_EQ(range.above, "");
}

TEST(Study, RangesEndWhereCellsFail) {
  // The way between the motors: too near, and too far, fail; in between the box of the task is within reach.
  const Model model = five_bar();
  const StudyResult result =
      run_study(model, parse_study("format: 1\nvary: {L: [0.3, 0.9]}\ntask: {box: {x: [0.1, 0.4], y: [-0.7, -0.5]}}\n"
                                   "method: {prove: 1/1048576}\n",
                                   model));
  ASSERT_FALSE(result.ranges.empty());
  for (const ProvenRange& range : result.ranges) {
    EXPECT_LE(range.from[0], range.from[1]);
    EXPECT_LT(range.from[1], range.to[0]);
    EXPECT_LE(range.to[0], range.to[1]);
    if (!range.below.empty()) {
      EXPECT_EQ(verdict_of(model, result, {range.from[0] - 1e-5}), Verdict::refuted) << range.below;
    }
    if (!range.above.empty()) {
      EXPECT_EQ(verdict_of(model, result, {range.to[1] + 1e-5}), Verdict::refuted) << range.above;
    }
    EXPECT_EQ(verdict_of(model, result, {range.from[1] + 1e-5}), Verdict::verified);
    EXPECT_EQ(verdict_of(model, result, {range.to[0] - 1e-5}), Verdict::verified);
  }
}

TEST(Study, ASearchBeatsAGrid) {
  const Model model = five_bar();
  const StudyResult grid = run_study(model, parse_study(study_text("{grid: [9, 9]}"), model));
  const Study study = parse_study(study_text("{search: 150}"), model);
  const StudyResult found = run_study(model, study);
  ASSERT_TRUE(grid.best && found.best);
  EXPECT_LE(found.designs.size(), 150U);
  EXPECT_GT(found.designs[*found.best].figures.front(), grid.designs[*grid.best].figures.front());
  EXPECT_EQ(told(found), told(run_study(model, study))) << "the same from run to run";
}

TEST(Study, AFrontOfASearchHasEveryDesignOnce) {
  const Model model = five_bar();
  const StudyResult found = run_study(
      model, parse_study(study_text("{search: 200}", "goal: [{maximise: margin}, {minimise: pose_error}]"), model));
  ASSERT_GT(found.front.size(), 2U);
  std::set<std::vector<double>> values;
  for (const std::size_t entry : found.front) values.insert(found.designs[entry].values);
  EXPECT_EQ(values.size(), found.front.size());
}

TEST(Study, WritesADesignAsTheFileThatItComesFrom) {
  const Model model = five_bar();
  const StudyResult result = run_study(model, parse_study(study_text("{grid: [8, 8]}"), model));
  ASSERT_TRUE(result.best);
  const std::string text = design_text(model, result, result.designs[*result.best]);
  EXPECT_NE(text.find("# named exact numbers"), std::string::npos) << "comments stay";
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), std::count(model.text().begin(), model.text().end(), '\n'));
  const Model best = Model::parse(text);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(best.parameters()[i].value, result.designs[*result.best].values[i]);
  EXPECT_TRUE(verify(best, result.study.tasks.front(), {.depth = VerifyDepth::verdict}).verified());
}

TEST(Study, RefusesWhatHasNoMeaning) {
  const Model model = five_bar();
  for (const std::string& text :
       {study_text("{grid: [0, 2]}"), study_text("{walk: 3}"), study_text("{grid: [2, 2]}", "goal: {maximise: beauty}"),
        study_text("{grid: [2, 2]}", "keep: [L + q <= 1]"), study_text("{grid: [2, 2]}", "keep: [L + d]"),
        study_text("{search: 100}", ""), std::string("format: 1\nvary: {q: [0, 1]}\ntask: {}\nmethod: {sample: 3}\n")})
    EXPECT_THROW((void)parse_study(text, model), InputError) << text;
}

}  // namespace
}  // namespace clearloci
