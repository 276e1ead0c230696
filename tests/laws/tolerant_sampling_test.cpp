// What verify says of a task with tolerances and balls of loads against dense sampling of designs, loads and poses,
// each design read anew from its file and its reactions solved by LU of all equations. A proof is contradicted by no
// sample, and the witness of a refutation fails. CLEARLOCI_DESIGNS=n in the environment tries n designs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <random>

#include "core/errors.hpp"
#include "loci/tasks/task_region.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_task.hpp"
#include "numeric/reactions.hpp"
#include "report/verification.hpp"
#include "tests/laws/judged.hpp"

namespace clearloci {
namespace {

using core::Point2;
using core::Quantity;
using Value = mechanism::Override;

int designs() {
  const char* const text = std::getenv("CLEARLOCI_DESIGNS");
  return text == nullptr ? 12 : std::atoi(text);
}

const std::vector<std::string> names = {"a", "b", "c", "e", "d", "push"};

/// A 5R of four lengths, the way between its motors and the size of its load.
std::string five_bar(const std::array<double, 6>& v, double angle, double weight) {
  std::string text = "format: 1\nname: random 5R\nspace: planar\nparameters:\n";
  for (std::size_t i = 0; i < names.size(); ++i) text += fmt::format("  {}: {}\n", names[i], v[i]);
  text += "workspace: {x: [-3, 3], y: [-3, 3]}\n";
  text += "points:\n  A1: [0, 0]\n  A2: [d, 0]\n  P: [x, y]\n";
  text += "  B1: {dyad: [A1, P], lengths: [a, b], side: right}\n  B2: {dyad: [A2, P], lengths: [c, e], side: left}\n";
  text += "links:\n  A1B1: {points: [A1, B1], mass: 1}\n  B1P: {points: [B1, P], mass: 1}\n";
  text += "  PB2: {points: [P, B2], mass: 1}\n  B2A2: {points: [B2, A2], mass: 1}\njoints:\n";
  text += "  A1: {revolute: [ground, A1B1], at: A1, actuated: true, clearance: {radial: 1e-5, angular: 5e-4}}\n";
  text += "  B1: {revolute: [A1B1, B1P], at: B1, clearance: {radial: 1e-5}}\n";
  text += "  P: {revolute: [B1P, PB2], at: P, clearance: {radial: 1e-5}}\n";
  text += "  B2: {revolute: [B2A2, PB2], at: B2, clearance: {radial: 1e-5}}\n";
  text += "  A2: {revolute: [ground, B2A2], at: A2, actuated: true, clearance: {radial: 1e-5, angular: 5e-4}}\n";
  text += "end_effector: {link: PB2, at: P}\n";
  text += fmt::format("loads:\n  - {{link: PB2, at: P, force: [{:.3f}*push, {:.3f}*push], couple: 0}}\n",
                      std::cos(angle), std::sin(angle));
  if (weight > 0) text += fmt::format("gravity: [0, {}]\n", -weight);
  return text;
}

struct Law {
  std::mt19937& random;
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  double rounded(double low, double high, double unit) { return unit * std::round(uniform(low, high) / unit); }
};

/// Reactions of one design under one load at a pose; nothing where it is out of reach.
struct Solved {
  Eigen::VectorXd w;
  double determinant = 0;
};

std::optional<Solved> solve(const mechanism::Mechanism& m, const Point2& at) {
  const numeric::NumericModel model = numeric::compile(m);
  const numeric::Posture posture = numeric::posture(model, at, mechanism::working_mode(m));
  if (!posture.reachable()) return std::nullopt;
  const numeric::Reactions reactions = numeric::solve_reactions(model, posture);
  return Solved{reactions.values, reactions.determinant};
}

mechanism::Mechanism under(mechanism::Mechanism m, const Point2& force, double couple) {
  m.loads.front().force = {core::Expression::number(core::Rational(force[0])),
                           core::Expression::number(core::Rational(force[1]))};
  m.loads.front().couple = core::Expression::number(core::Rational(couple));
  return m;
}

double force_of(const mechanism::Mechanism& m, const Solved& solved, const std::string& joint, Quantity quantity) {
  const std::vector<mechanism::Unknown> unknowns = mechanism::unknowns(m);
  double square = 0;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    if (m.joints[static_cast<std::size_t>(unknowns[k].joint)].name != joint) continue;
    const bool wanted = quantity == Quantity::f
                            ? unknowns[k].quantity == Quantity::fx || unknowns[k].quantity == Quantity::fy
                            : unknowns[k].quantity == quantity;
    if (wanted) square += std::pow(solved.w(static_cast<Eigen::Index>(k)), 2);
  }
  return std::sqrt(square);
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// How long the verdict took, against that of the file's own design and load alone.
double shown_times(int n, const mechanism::Mechanism& m, core::Task task, const Verification& answer,
                   Clock::time_point start) {
  const double since = seconds_since(start);
  task.tolerances.clear();
  task.loads_within.clear();
  const auto again = Clock::now();
  const Verification nominal = test::decided(m, task, {.deadline = again + std::chrono::seconds(5)});
  const double alone = seconds_since(again);
  fmt::print("{} {} {:.4f} s; nominal {} {:.4f} s; ratio {:.2f}\n", n, to_string(answer.verdict), since,
             to_string(nominal.verdict), alone, since / alone);
  return since / alone;
}

TEST(TolerantTasks, NoSampleOfDesignsLoadsAndPosesContradictsAVerdict) {
  std::mt19937 random(20110501);
  Law law{random};
  int verified = 0, refuted = 0, undecided = 0;
  std::vector<double> ratios;
  for (int n = 0; n < designs();) {
    const std::array<double, 6> v = {law.rounded(0.4, 0.9, 0.05), law.rounded(0.4, 0.9, 0.05),
                                     law.rounded(0.4, 0.9, 0.05), law.rounded(0.4, 0.9, 0.05),
                                     law.rounded(0.2, 0.8, 0.1),  law.rounded(40, 120, 10)};
    const std::string text = five_bar(v, law.rounded(-3, 3, 0.5), n % 3 == 0 ? 9.81 : 0);
    mechanism::Mechanism m;
    try {
      m = mechanism::parse_mechanism(text, "random.yaml");
    } catch (const core::InputError&) {
      continue;
    }
    const double x = law.rounded(-0.3, 0.9, 0.05), y = law.rounded(-1, 1, 0.05), side = law.uniform(0.01, 0.12);
    std::string task_text = fmt::format("format: 1\nbox: {{x: [{}, {}], y: [{}, {}]}}\n", x, x + side, y, y + side);
    if (n % 2 == 0) task_text += fmt::format("min_force: {:.2f}\n", law.uniform(0.5, 12));
    const double size = std::pow(10, law.uniform(-4.5, -1.5));
    task_text += fmt::format("tolerances: {{a: {0}, c: [{1}, {0}], d: {0}, push: {2}}}\n", size, -size / 2, 40 * size);
    const double ball = n % 4 < 3 ? law.uniform(0, 15) : 0, couple = n % 5 == 0 ? law.uniform(0, 2) : 0;
    task_text += fmt::format("loads_within: [{{load: 1, radius: {}, couple: {}}}]\n", ball, couple);
    const core::Task task = mechanism::parse_task(task_text, "task.yaml", m);
    const auto start = std::chrono::steady_clock::now();
    const Verification answer = test::decided(m, task, {.deadline = start + std::chrono::seconds(5)});
    ++n;
    if (std::getenv("CLEARLOCI_SHOW_TIMES") != nullptr) ratios.push_back(shown_times(n, m, task, answer, start));
    SCOPED_TRACE(text + task_text + to_string(answer.verdict) +
                 (answer.witness ? ": " + report::witness_words(*answer.witness) : ""));
    if (answer.verdict == core::Verdict::undecided) {
      ++undecided;
      continue;
    }
    if (answer.verdict == core::Verdict::refuted) {
      ++refuted;
      ASSERT_TRUE(answer.witness);
      const core::TaskWitness& witness = *answer.witness;
      EXPECT_LE(loci::TaskRegion(task.shape).signed_distance(test::point_of(witness.at)), 1e-12);
      std::vector<Value> values;
      for (const auto& [name, value] : witness.design) {
        values.emplace_back(name, core::to_string(core::Rational(value)));
        for (const core::Tolerance& tolerance : task.tolerances)
          if (tolerance.parameter == name)
            for (std::size_t i = 0; i < names.size(); ++i)
              if (names[i] == name) {
                EXPECT_GE(value, v[i] + core::to_double(tolerance.below) - 1e-12);
                EXPECT_LE(value, v[i] + core::to_double(tolerance.above) + 1e-12);
              }
      }
      mechanism::Mechanism member = mechanism::parse_mechanism(text, "random.yaml", values);
      if (!witness.loads.empty()) {
        const numeric::NumericModel model = numeric::compile(member);
        const numeric::Posture there = numeric::posture(model, Point2{x, y}, mechanism::working_mode(member));
        const Point2 point2 = numeric::in_plane(there.loads.front().force);
        EXPECT_LE(std::hypot(witness.loads[0].force[0] - point2[0], witness.loads[0].force[1] - point2[1]),
                  ball + 1e-9);
        EXPECT_LE(std::abs(witness.loads[0].couple.at(0)), couple + 1e-9);
        member = under(member, test::point_of(witness.loads[0].force), witness.loads[0].couple.at(0));
      }
      const auto solved = solve(member, test::point_of(witness.at));
      using Kind = core::TaskWitness::Kind;
      if (witness.kind == Kind::unreachable) {
        EXPECT_FALSE(solved.has_value());
      }
      if (witness.kind == Kind::singular && solved) {
        EXPECT_LT(std::abs(solved->determinant), 1e-9);
      }
      if (witness.kind == Kind::vanishing) {
        ASSERT_TRUE(solved);
        const core::Vanishing& vanishing = witness.vanishing.front();
        EXPECT_LT(force_of(member, *solved, vanishing.joint, vanishing.quantity),
                  1e-6 * solved->w.cwiseAbs().maxCoeff());
      }
      if (witness.kind == Kind::too_small) {
        ASSERT_TRUE(solved);
        const core::Vanishing& vanishing = witness.too_small.front();
        EXPECT_LT(force_of(member, *solved, vanishing.joint, vanishing.quantity),
                  core::to_double(*witness.least) * (1 + 1e-9));
      }
      continue;
    }
    ++verified;
    // Corners and insides of all three.
    std::optional<int> sign_of_determinant;
    std::vector<int> signs;
    for (int sample = 0; sample < 60; ++sample) {
      const auto part = [&] { return sample % 3 == 0 ? std::round(law.uniform(0, 1)) : law.uniform(0, 1); };
      std::vector<Value> values;
      for (const core::Tolerance& tolerance : task.tolerances)
        for (std::size_t i = 0; i < names.size(); ++i)
          if (names[i] == tolerance.parameter) {
            const core::Rational nominal = m.parameters[i].value;
            const core::Rational value =
                nominal + tolerance.below + (tolerance.above - tolerance.below) * core::Rational(part());
            values.emplace_back(names[i], core::to_string(value));
          }
      mechanism::Mechanism member = mechanism::parse_mechanism(text, "random.yaml", values);
      const Point2 at = {x + side * part(), y + side * part()};
      const numeric::NumericModel model = numeric::compile(member);
      const numeric::Posture posture = numeric::posture(model, at, mechanism::working_mode(member));
      ASSERT_TRUE(posture.reachable()) << sample;
      const double angle = law.uniform(0, 6.3), radius = ball * (sample % 2 == 0 ? 1 : law.uniform(0, 1));
      const Point2 point2 = numeric::in_plane(posture.loads.front().force);
      member = under(member, {point2[0] + radius * std::cos(angle), point2[1] + radius * std::sin(angle)},
                     couple * (2 * part() - 1));
      const auto solved = solve(member, at);
      ASSERT_TRUE(solved);
      const int sign = solved->determinant > 0 ? 1 : -1;
      if (!sign_of_determinant) sign_of_determinant = sign;
      EXPECT_EQ(sign, *sign_of_determinant) << sample;
      std::vector<int> own_signs;
      for (const char* joint : {"A1", "B1", "P", "B2", "A2"})
        if (task.min_force) {
          EXPECT_GT(force_of(member, *solved, joint, Quantity::f), core::to_double(*task.min_force)) << sample << joint;
        }
      const std::vector<mechanism::Unknown> unknowns = mechanism::unknowns(member);
      for (std::size_t k = 0; k < unknowns.size(); ++k)
        if (unknowns[k].quantity == Quantity::M)
          own_signs.push_back(solved->w(static_cast<Eigen::Index>(k)) > 0 ? 1 : -1);
      if (signs.empty()) signs = own_signs;
      EXPECT_EQ(signs, own_signs) << sample;
    }
  }
  std::printf("%d verified, %d refuted, %d undecided\n", verified, refuted, undecided);
  if (!ratios.empty()) {
    std::sort(ratios.begin(), ratios.end());
    std::printf("time to that of the nominal design: median %.2f, nine tenths below %.2f\n", ratios[ratios.size() / 2],
                ratios[ratios.size() * 9 / 10]);
  }
  EXPECT_GT(verified + refuted, 3 * undecided);
  EXPECT_GT(verified, 0);
  EXPECT_GT(refuted, 0);
}

}  // namespace
}  // namespace clearloci
