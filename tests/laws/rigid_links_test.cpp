// Rigid means rigid: in any mechanism, in any working mode and at any pose that is reached links have the lengths that
// they have at all others, and zones hold no pose at which one of them bends. The designs have parallelograms that can
// flip, whose links are rigid on one side of the flip alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <tuple>

#include "analysis/loci.hpp"
#include "core/errors.hpp"
#include "core/fold.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_task.hpp"
#include "mechanism/rigidity.hpp"
#include "numeric/reactions.hpp"
#include "symbolic/locus_problem.hpp"
#include "tests/laws/judged.hpp"
#include "tests/source_dir.hpp"
#include "tests/texts.hpp"

namespace clearloci {
namespace {

int designs() {
  const char* const text = std::getenv("CLEARLOCI_DESIGNS");
  return text == nullptr ? 4 : std::atoi(text);
}

struct Numbers {
  double base = 100, arm = 300, fore = 700, tip = 50, h = 60;
};

/// A planar delta whose platform is kept level by two parallelograms on its left leg, the upper one of which can flip.
std::string delta(const Numbers& n, const std::string& upper_side = "left") {
  std::string text = "format: 1\nname: delta\nspace: planar\nunits: {length: mm, angle: deg}\n";
  text += fmt::format("parameters: {{base: {}, arm: {}, fore: {}, tip: {}, h: {}, tool: 2}}\n", n.base, n.arm, n.fore,
                      n.tip, n.h);
  text += "workspace: {x: [-700, 700], y: [-1000, -300]}\npoints:\n";
  text += "  O1: [-base, 0]\n  O2: [base, 0]\n  P: [x, y]\n  P1: [x - tip, y]\n  P2: [x + tip, y]\n";
  text += "  A1: {dyad: [O1, P1], lengths: [arm, fore], side: right}\n";
  text += "  A2: {dyad: [O2, P2], lengths: [arm, fore], side: left}\n";
  text += "  G1: [-base, h]\n  B1: {dyad: [A1, G1], lengths: [h, arm], side: " + upper_side + "}\n";
  text += "  C1: {on: [A1, B1], offset: [0, h]}\n  Q1: [x - tip - h, y]\n";
  text += "links:\n  upper1: {points: [O1, A1], mass: 1}\n  lower1: {points: [A1, P1], mass: 0.5}\n";
  text += "  bracket: {points: [A1, B1, C1]}\n  rod1: {points: [G1, B1]}\n  rod2: {points: [C1, Q1]}\n";
  text += "  tool: {points: [P1, P2, Q1, P]}\n  upper2: {points: [O2, A2], mass: 1}\n";
  text += "  lower2: {points: [A2, P2], mass: 0.5}\njoints:\n";
  text += "  O1: {revolute: [ground, upper1], at: O1, actuated: true, clearance: {radial: 10e-3, angular: 0.02}}\n";
  text += "  A1: {revolute: [upper1, bracket], at: A1}\n  A1b: {revolute: [bracket, lower1], at: A1}\n";
  text += "  G1: {revolute: [ground, rod1], at: G1}\n  B1: {revolute: [rod1, bracket], at: B1}\n";
  text += "  C1: {revolute: [bracket, rod2], at: C1}\n  Q1: {revolute: [rod2, tool], at: Q1}\n";
  text += "  P1: {revolute: [lower1, tool], at: P1, clearance: {radial: 10e-3}}\n";
  text += "  O2: {revolute: [ground, upper2], at: O2, actuated: true}\n";
  text += "  A2: {revolute: [upper2, lower2], at: A2}\n  P2: {revolute: [lower2, tool], at: P2}\n";
  return text + "end_effector: {link: tool, at: P}\ngravity: [0, -9.81]\n";
}

/// The largest part by which a link's length differs from what it is at other poses.
double bent(const mechanism::Mechanism& m, std::mt19937& random, const std::vector<int>& mode, int& reached) {
  const numeric::NumericModel model = numeric::compile(m);
  std::vector<std::vector<double>> lengths;  // a pose each
  for (int tries = 0; tries < 4000 && lengths.size() < 120; ++tries) {
    std::vector<double> pose;
    for (const auto& range : model.box)
      pose.push_back(std::uniform_real_distribution<double>(range[0], range[1])(random));
    const numeric::Posture posture = numeric::posture(model, pose, mode);
    if (!posture.reachable()) continue;
    std::vector<double>& length = lengths.emplace_back();
    for (const mechanism::Link& link : m.links)
      for (std::size_t i = 0; i < link.points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          length.push_back((posture.points[static_cast<std::size_t>(link.points[i])] -
                            posture.points[static_cast<std::size_t>(link.points[j])])
                               .norm());
  }
  reached = static_cast<int>(lengths.size());
  double most = 0;
  for (const std::vector<double>& length : lengths)
    for (std::size_t k = 0; k < length.size(); ++k) {
      std::vector<double> all;
      for (const std::vector<double>& other : lengths) all.push_back(other[k]);
      std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
      most = std::max(most, std::abs(length[k] - all[all.size() / 2]) / (all[all.size() / 2] + 1e-3));
    }
  return most;
}

TEST(RigidLinks, KeepTheirLengthsAtEveryPoseThatIsReached) {
  std::mt19937 random(20260702);
  const auto draw = [&](double low, double high) {
    return 10 * std::round(std::uniform_real_distribution<double>(low, high)(random) / 10);
  };
  int looked_at = 0;
  for (int n = 0; n < designs(); ++n) {
    const Numbers numbers{draw(40, 160), draw(200, 400), draw(500, 800), draw(20, 80), draw(30, 120)};
    SCOPED_TRACE(delta(numbers));
    const mechanism::Mechanism m = mechanism::parse_mechanism(delta(numbers), "delta.yaml");
    for (int signs = 0; signs < 8; ++signs) {
      int reached = 0;
      const std::vector<int> mode = {signs & 1 ? 1 : -1, signs & 2 ? 1 : -1, signs & 4 ? 1 : -1};
      EXPECT_LE(bent(m, random, mode, reached), 1e-12) << signs;
      looked_at += reached;
    }
  }
  EXPECT_GT(looked_at, 100 * designs());
}

/// The sides of the triangles of links in the plane, at poses that are reached; each is always the same.
void expect_no_link_turned_over(const mechanism::Mechanism& m, std::mt19937& random, const std::vector<int>& mode) {
  const numeric::NumericModel model = numeric::compile(m);
  std::map<std::string, std::array<int, 2>> sides;
  for (int i = 0; i < 300; ++i) {
    std::vector<double> pose;
    for (const auto& range : model.box)
      pose.push_back(std::uniform_real_distribution<double>(range[0], range[1])(random));
    const numeric::Posture posture = numeric::posture(model, pose, mode);
    if (!posture.reachable()) continue;
    for (const mechanism::Link& link : m.links)
      for (std::size_t k = 2; k < link.points.size(); ++k) {
        const auto at = [&](std::size_t j) { return posture.points[static_cast<std::size_t>(link.points[j])]; };
        const Eigen::Vector3d a = at(1) - at(0), b = at(k) - at(0);
        const double turn = a.cross(b).z();
        if (std::abs(turn) > 1e-9 * a.norm() * b.norm()) ++sides[fmt::format("{} {}", link.name, k)][turn > 0 ? 1 : 0];
      }
  }
  for (const auto& [name, count] : sides) EXPECT_TRUE(count[0] == 0 || count[1] == 0) << name;
}

/// Groups, slots, gears and belts, and offsets, with other lengths than the files': some of them do not close.
TEST(RigidLinks, OfGroupsSlotsGearsAndBeltsAreRigid) {
  using Ranges = std::vector<std::tuple<std::string, double, double>>;
  const std::vector<std::pair<std::string, Ranges>> files = {
      {"stephenson_outside", {}},
      {"double_butterfly", {}},
      {"three_rpr_legs", {{"r", 0.24, 0.26}}},
      {"scissor_lift", {{"bar", 900, 1100}}},
      {"geared_five_bar", {{"crank1", 10, 30}, {"crank2", 10, 20}, {"rod1", 70, 110}, {"rod2", 70, 110}}},
      {"scara_belt", {{"arm", 150, 250}, {"forearm", 120, 200}}},
      {"planar_delta", {{"arm", 80, 120}, {"forearm", 150, 250}, {"w", 10, 40}, {"tilt", -20, 20}}}};
  std::mt19937 random(20260703);
  int looked_at = 0, mechanisms = 0;
  for (const auto& [name, ranges] : files)
    for (int n = 0; n < (ranges.empty() ? 1 : designs()); ++n) {
      std::vector<std::pair<std::string, std::string>> set;
      for (const auto& [parameter, low, high] : ranges)
        set.emplace_back(parameter, fmt::format("{:.4f}", std::uniform_real_distribution<double>(low, high)(random)));
      SCOPED_TRACE(name + " " + std::to_string(n));
      std::optional<mechanism::Mechanism> m;
      try {
        m = mechanism::parse_mechanism(example_text(name), name + ".yaml", set);
      } catch (const core::InputError& error) {
        EXPECT_EQ(std::string(error.what()).find("rigid"), std::string::npos) << error.what();
        continue;
      }
      int reached = 0;
      const std::vector<int> mode = mechanism::working_mode(*m);
      EXPECT_LE(bent(*m, random, mode, reached), 1e-10);
      expect_no_link_turned_over(*m, random, mode);
      looked_at += reached;
      ++mechanisms;
    }
  EXPECT_GT(mechanisms, 4 + designs());
  EXPECT_GT(looked_at, 20 * mechanisms);
}

TEST(RigidLinks, TheSideOnWhichOneBendsIsNoWorkspace) {
  const mechanism::Mechanism m =
      mechanism::read_mechanism(source_dir() + "/tests/corpus/modes/flipped_parallelogram.yaml");
  const numeric::NumericModel model = numeric::compile(m);
  const std::vector<int> mode = mechanism::working_mode(m);
  const numeric::Posture flipped = numeric::posture(model, std::vector<double>{0.65, -0.5}, mode);
  ASSERT_TRUE(flipped.broken);
  // One side of the fold is left, and its border bounds the workspace.
  const std::vector<symbolic::DerivedProblem> problems = symbolic::locus_problems(m, {});
  ASSERT_EQ(problems.size(), 1U);
  bool folded = false;
  for (const core::Root& root : problems.front().problem.tower.roots) folded = folded || root.name == core::fold_name;
  EXPECT_TRUE(folded);
  const mechanism::HeldByLinks held = mechanism::held_by_links(m);
  ASSERT_FALSE(held.distances.empty());
  // A task there is refuted, and names the link.
  const Verification there =
      test::decided(m, mechanism::parse_task("format: 1\nbox: {x: [649, 651], y: [-501, -499]}\n", "task.yaml", m));
  ASSERT_EQ(there.verdict, core::Verdict::refuted);
  EXPECT_EQ(there.witness->kind, core::TaskWitness::Kind::unreachable);
  EXPECT_NE(there.witness->limit.find("rod2"), std::string::npos) << there.witness->limit;
}

TEST(RigidLinks, LimitsAtTheirLengthsBoundNothing) {
  const mechanism::Mechanism m = mechanism::parse_mechanism(
      delta({}) +
          "limits:\n  - {distance: [C1, Q1], within: [600, 700]}\n  - {distance: [G1, B1], within: [300, 900]}\n",
      "delta.yaml");
  const numeric::NumericModel model = numeric::compile(m);
  const std::vector<int> mode = mechanism::working_mode(m);
  EXPECT_TRUE(numeric::reachable(model, std::vector<double>{0.1, -0.8}, mode));
  EXPECT_FALSE(numeric::reachable(model, std::vector<double>{0.65, -0.5}, mode));
  EXPECT_TRUE(
      test::decided(m, mechanism::parse_task("format: 1\nbox: {x: [100, 150], y: [-800, -750]}\n", "task.yaml", m))
          .verified());
}

TEST(RigidLinks, OneThatIsRigidNowhereIsRefusedWithItsLengths) {
  std::string text = delta({});
  const std::string right = "  Q1: [x - tip - h, y]\n";
  text.replace(text.find(right), right.size(), "  Q1: [x - tip - h - 1, y]\n");
  try {
    const mechanism::Mechanism m = mechanism::parse_mechanism(text, "delta.yaml");
    ADD_FAILURE() << "rod2 is not rigid";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("rod2 is not rigid"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(" mm at x = "), std::string::npos) << error.what();
  }
}

// --- what is drawn

/// A four-bar with a leg of two more links.
struct Legs {
  const char* kind;
  const char *crank, *coupler, *rocker;  ///< points of the four-bar O, M, C, A, with those of the leg
  const char *inner, *outer;             ///< the links that carry D, and B
};

constexpr std::array<Legs, 5> all_legs = {{{"Klann", "O, M", "M, C, D", "A, C", "coupler", "ground"},
                                           {"Watt I", "O, M", "M, C, D", "A, C, B", "coupler", "rocker"},
                                           {"Watt II", "O, M", "M, C", "A, C, D", "rocker", "ground"},
                                           {"Stephenson II", "O, M, B", "M, C", "A, C, D", "rocker", "crank"},
                                           {"Stephenson III", "O, M, B", "M, C, D", "A, C", "coupler", "crank"}}};

struct DrawnLeg {
  std::string text;
  double angle = 0;                                         ///< of the crank as it is drawn, deg
  std::map<std::string, std::array<double, 2>> drawn = {};  ///< mm
};

/// A six-bar with each point where three decimals say, in an order of its own.
DrawnLeg drawn_leg(unsigned seed) {
  std::mt19937 random(seed);
  const Legs& legs = all_legs[seed % all_legs.size()];
  const auto decimals = [](double value) { return std::round(1e3 * value) / 1e3; };
  const auto draw = [&](double size) { return decimals(std::uniform_real_distribution<double>(-size, size)(random)); };
  DrawnLeg leg;
  for (const char* name : {"O", "A", "B", "C", "D", "E", "F"}) leg.drawn[name] = {draw(100), draw(100)};
  const auto& o = leg.drawn["O"];
  const double turn = std::uniform_real_distribution<double>(0, 2 * std::numbers::pi)(random);
  leg.drawn["M"] = {decimals(o[0] + 25 * std::cos(turn)), decimals(o[1] + 25 * std::sin(turn))};
  const auto& m = leg.drawn["M"];
  leg.angle = std::atan2(m[1] - o[1], m[0] - o[0]);
  if (leg.angle < 0) leg.angle += 2 * std::numbers::pi;
  std::vector<std::string> names;
  for (const auto& [name, place] : leg.drawn) names.push_back(name);
  std::shuffle(names.begin(), names.end(), random);
  leg.text = fmt::format("format: 1\nname: {}\nunits: {{length: mm}}\n", legs.kind);
  leg.text += "workspace: {theta: {angle: [0, 360 deg], of: crank}}\ndrawn:\n";
  for (const std::string& name : names)
    leg.text += fmt::format("  {}: [{:.3f}, {:.3f}]\n", name, leg.drawn[name][0], leg.drawn[name][1]);
  leg.text += fmt::format(
      "links: {{crank: {{points: [{}]}}, coupler: {{points: [{}]}}, rocker: {{points: [{}]}}, rod: {{points: [B, E]}}, "
      "leg: {{points: [E, D, F]}}}}\n",
      legs.crank, legs.coupler, legs.rocker);
  leg.text += "joints:\n  O: {revolute: [ground, crank], at: O, actuated: true, clearance: {radial: 20e-3}}\n";
  const auto pin = [&](const std::string& name, const std::string& from, const std::string& to) {
    leg.text +=
        fmt::format("  {}: {{revolute: [{}, {}], at: {}, clearance: {{radial: 20e-3}}}}\n", name, from, to, name);
  };
  pin("M", "crank", "coupler");
  pin("A", "ground", "rocker");
  pin("C", "rocker", "coupler");
  pin("D", legs.inner, "leg");
  pin("E", "rod", "leg");
  pin("B", legs.outer, "rod");
  leg.text += "end_effector: {link: leg, at: F}\nloads: [{link: leg, at: F, force: [0, -100]}]\n";
  return leg;
}

/// What `pose` reaches as it is drawn, `loci` derives: no sheet of it is taken for one on which a link bends.
TEST(RigidLinks, AreRigidAsTheyAreDrawn) {
  for (unsigned seed = 0; seed < 4U + static_cast<unsigned>(designs()); ++seed) {
    const DrawnLeg leg = drawn_leg(seed);
    SCOPED_TRACE(leg.text);
    const mechanism::Mechanism m = mechanism::parse_mechanism(leg.text, "leg.yaml");
    const numeric::Posture posture =
        numeric::posture(numeric::compile(m), std::vector<double>{leg.angle}, mechanism::working_mode(m));
    ASSERT_TRUE(posture.reachable());
    std::size_t compared = 0;
    for (std::size_t p = 0; p < m.points.size(); ++p) {
      const auto drawn = leg.drawn.find(m.points[p].name);
      if (drawn == leg.drawn.end()) continue;
      ++compared;
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(posture.points[p][static_cast<Eigen::Index>(i)], 1e-3 * drawn->second[i], 1e-12);
    }
    EXPECT_EQ(compared, leg.drawn.size());
    std::vector<symbolic::DerivedProblem> problems;
    ASSERT_NO_THROW(problems = symbolic::locus_problems(m, {}));
    for (const symbolic::DerivedProblem& problem : problems) {
      EXPECT_FALSE(problem.problem.modes.empty());
      for (const std::string& note : problem.notes) EXPECT_EQ(note.find("bends a link"), std::string::npos) << note;
      // Roots stay in the range of doubles, however long the construction.
      for (const core::Root& root : problem.problem.tower.roots)
        for (const core::Term& term : root.square.terms) EXPECT_LT(std::abs(term.coefficient.get_d()), 1e60);
    }
  }
}

}  // namespace
}  // namespace clearloci
