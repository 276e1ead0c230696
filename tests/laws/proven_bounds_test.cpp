// What is called proven of a task bounds what any pose, design and load of it does, in mechanisms with every kind of
// clearance of the plane, on oblique axes of any length, with springs and limits: greatest pose errors and least forces
// against samples, each design read anew from its file and solved by LU of all equations.
// CLEARLOCI_DESIGNS=n in the environment tries n verified tasks of every family.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "core/errors.hpp"
#include "mechanism/open_design.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_task.hpp"
#include "numeric/pose_error.hpp"
#include "tests/laws/judged.hpp"

namespace clearloci {
namespace {

using core::Point2;
using mechanism::Mechanism;
using Values = std::vector<mechanism::Override>;

int designs() {
  const char* const text = std::getenv("CLEARLOCI_DESIGNS");
  return text == nullptr ? 4 : std::atoi(text);
}

struct Draw {
  std::mt19937 random;
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  bool one_in(int many) { return std::uniform_int_distribution<int>(1, many)(random) == 1; }
  std::string radial() { return fmt::format("{:.1f}e-6", uniform(2, 20)); }
};

struct Design {
  std::string text;
  Point2 near;  ///< a pose that is reached where the lengths allow it
};

constexpr const char* head = "format: 1\nname: random\nspace: planar\n";

/// A spring or two and a limit that may bind, between points that every family has.
std::string extras(Draw& draw, const std::string& link, const std::string& point) {
  std::string text;
  if (draw.one_in(2)) {
    text += "springs:\n";
    text += fmt::format("  - {{links: [{}, ground], at: [{}, S]", link, point);
    text += draw.one_in(2) ? fmt::format(", stiffness: {:.0f}, free_length: {:.2f}}}\n", draw.uniform(20, 200), 0.3)
                           : fmt::format(", force: {:.1f}}}\n", draw.uniform(2, 30));
  }
  if (draw.one_in(3)) text += fmt::format("limits:\n  - {{distance: [A1, {}], within: [0.05, 2.5]}}\n", point);
  return text;
}

std::string loads(Draw& draw, const std::string& link) {
  return fmt::format("loads:\n  - {{link: {}, at: P, force: [{:.1f}, {:.1f}], couple: {:.2f}}}\n", link,
                     draw.uniform(-80, 80), draw.uniform(-80, 80), draw.one_in(2) ? 0.0 : draw.uniform(-3, 3));
}

Design five_bar(Draw& draw) {
  const double d = draw.uniform(0.3, 0.8), a = draw.uniform(0.4, 0.8), b = draw.uniform(0.4, 0.8);
  std::string text = head;
  text += fmt::format("parameters: {{d: {:.3f}, a: {:.3f}, rho: {}}}\n", d, a, draw.radial());
  text += "workspace: {x: [-2, 2], y: [-2, 2]}\npoints:\n  A1: [0, 0]\n  A2: [d, 0]\n  S: [0.3, 1.7]\n  P: [x, y]\n";
  text += fmt::format("  B1: {{dyad: [A1, P], lengths: [a, {:.3f}], side: left}}\n", b);
  text += fmt::format("  B2: {{dyad: [A2, P], lengths: [{:.3f}, a], side: right}}\n", b);
  text += "links:\n  c1: {points: [A1, B1], mass: 0.5}\n  r1: {points: [B1, P], mass: 0.5}\n";
  text += "  r2: {points: [P, B2], mass: 0.5}\n  c2: {points: [B2, A2], mass: 0.5}\njoints:\n";
  text += "  A1: {revolute: [ground, c1], at: A1, actuated: true, clearance: {radial: rho, angular: 4e-5}}\n";
  text += "  B1: {revolute: [c1, r1], at: B1, clearance: {radial: " + draw.radial() + "}}\n";
  text += "  P: {revolute: [r1, r2], at: P, clearance: {radial: rho}}\n";
  text += "  B2: {revolute: [c2, r2], at: B2, clearance: {radial: " + draw.radial() + "}}\n";
  text += "  A2: {revolute: [ground, c2], at: A2, actuated: true, clearance: {radial: rho, angular: 2e-5}}\n";
  text += "end_effector: {link: r2, at: P}\n" + loads(draw, "r2");
  if (draw.one_in(2)) text += "gravity: [0, -9.81]\n";
  return {text + extras(draw, "r2", "P"), {0.5 * d + draw.uniform(-0.2, 0.2), draw.uniform(0.3, 0.9)}};
}

/// Telescopic legs, of which one bears couples at the ends of its guide.
Design telescopes(Draw& draw) {
  const double d = draw.uniform(0.5, 0.9);
  std::string text = head;
  text += fmt::format("parameters: {{d: {:.3f}, rho: {}}}\n", d, draw.radial());
  text += "workspace: {x: [-2, 2], y: [-2, 2]}\npoints:\n  A1: [0, 0]\n  A2: [d, 0.1]\n  S: [0.3, 1.7]\n  P: [x, y]\n";
  text += "links: {c1: {points: [A1]}, r1: {points: [P]}, r2: {points: [P]}, c2: {points: [A2]}}\njoints:\n";
  text += "  A1: {revolute: [ground, c1], at: A1, clearance: {radial: rho}}\n";
  text += fmt::format(
      "  S1: {{prismatic: [c1, r1], at: P, axis: [A1, P], actuated: true, "
      "clearance: {{gap: {}, half_length: 0.03, axial: {}}}}}\n",
      draw.radial(), draw.radial());
  text += "  P: {revolute: [r1, r2], at: P, clearance: {radial: " + draw.radial() + "}}\n";
  text += "  S2: {prismatic: [c2, r2], at: P, axis: [A2, P], actuated: true, clearance: {axial: rho}}\n";
  text += "  A2: {revolute: [ground, c2], at: A2, clearance: {radial: " + draw.radial() + "}}\n";
  text += "end_effector: {link: r2, at: P}\n" + loads(draw, "r1");
  text += fmt::format("  - {{link: c1, at: A1, force: [0, 0], couple: {:.2f}}}\n", draw.uniform(1, 4));
  return {text + extras(draw, "r1", "P"), {draw.uniform(-0.2, 1), draw.uniform(0.3, 0.9)}};
}

/// Driven arms in whose sleeves rods slide: two guides along axes of changing length.
Design arms(Draw& draw) {
  std::string text = head;
  text += fmt::format("parameters: {{d: {:.3f}, rho: {}}}\n", draw.uniform(0.5, 0.9), draw.radial());
  text += "workspace: {x: [-2, 2], y: [-2, 2]}\npoints:\n  A1: [0, 0]\n  A2: [d, 0.1]\n  S: [0.3, 1.7]\n  P: [x, y]\n";
  text += "links: {c1: {points: [A1]}, r1: {points: [P]}, r2: {points: [P]}, c2: {points: [A2]}}\njoints:\n";
  for (int k = 1; k <= 2; ++k) {
    text +=
        fmt::format("  A{0}: {{revolute: [ground, c{0}], at: A{0}, actuated: true, clearance: {{radial: rho}}}}\n", k);
    text += fmt::format(
        "  S{0}: {{prismatic: [c{0}, r{0}], at: P, axis: [A{0}, P], clearance: {{gap: {1}, half_length: {2:.3f}}}}}\n",
        k, draw.radial(), draw.uniform(0.03, 0.08));
  }
  text += "  P: {revolute: [r1, r2], at: P, clearance: {radial: " + draw.radial() + "}}\n";
  text += "end_effector: {link: r2, at: P}\n" + loads(draw, "r2");
  return {text + extras(draw, "r2", "P"), {draw.uniform(-0.2, 1), draw.uniform(0.3, 0.9)}};
}

/// A plate on three telescopic legs, which keeps its orientation.
Design plate(Draw& draw) {
  std::string text = head;
  text += fmt::format("parameters: {{d: {:.3f}, rho: {}}}\n", draw.uniform(0.6, 1), draw.radial());
  text += "workspace: {x: [-1, 1], y: [-1, 1]}\npoints:\n  A1: [-0.6, -0.6]\n  A2: [d, -0.4]\n  A3: [0, 0.8]\n";
  text += "  S: [0.9, 0.9]\n  P: [x, y]\n  C1: [x - 1/8, y - 1/5]\n  C2: [x + 1/4, y]\n  C3: [x, y + 1/10]\n";
  text += "links:\n  pl: {points: [P, C1, C2, C3], mass: 1}\n";
  for (int k = 1; k <= 3; ++k) text += fmt::format("  a{0}: {{points: [A{0}]}}\n  b{0}: {{points: [C{0}]}}\n", k);
  text += "joints:\n";
  for (int k = 1; k <= 3; ++k) {
    text += fmt::format("  A{0}: {{revolute: [ground, a{0}], at: A{0}, clearance: {{radial: rho}}}}\n", k);
    text += fmt::format(
        "  S{0}: {{prismatic: [a{0}, b{0}], at: C{0}, axis: [A{0}, C{0}], actuated: true, clearance: {{axial: "
        "{1}}}}}\n",
        k, draw.radial());
    text += fmt::format("  C{0}: {{revolute: [b{0}, pl], at: C{0}, clearance: {{radial: {1}}}}}\n", k, draw.radial());
  }
  text += "end_effector: {link: pl, at: P}\n" + loads(draw, "pl") + "gravity: [0, -9.81]\n";
  return {text + extras(draw, "pl", "P"), {draw.uniform(-0.3, 0.3), draw.uniform(-0.3, 0.3)}};
}

/// Two blocks on oblique rails, whose directions are written with any length.
Design rails(Draw& draw) {
  const double d = draw.uniform(0.5, 0.8), turn = draw.uniform(-0.4, 0.4);
  const auto axis = [&](double angle) {
    const double length = std::pow(10, draw.uniform(-2, 2));
    return fmt::format("[{:.5g}, {:.5g}]", length * std::sin(angle), length * std::cos(angle));
  };
  const std::string first = axis(turn), second = axis(-0.5 * turn);
  std::string text = head;
  text += fmt::format("parameters: {{d: {:.3f}, L: {:.3f}, rho: {}}}\n", d, draw.uniform(0.5, 0.7), draw.radial());
  text += "workspace: {x: [-1, 2], y: [-2, 2]}\npoints:\n  A1: [0, 0]\n  A2: [d, 0]\n  S: [0.3, 1.7]\n  P: [x, y]\n";
  text += fmt::format("  B1: {{slider: [A1, {}], from: P, length: L, side: ahead}}\n", first);
  text += fmt::format("  B2: {{slider: [A2, {}], from: P, length: L, side: ahead}}\n", second);
  text += "links: {g1: {points: [B1]}, r1: {points: [B1, P], mass: 0.4}, r2: {points: [P, B2], mass: 0.4}, ";
  text += "g2: {points: [B2]}}\njoints:\n";
  text += fmt::format(
      "  G1: {{prismatic: [ground, g1], at: B1, axis: {}, actuated: true, clearance: {{gap: {}, "
      "half_length: 0.04, axial: {}}}}}\n",
      first, draw.radial(), draw.radial());
  text += "  B1: {revolute: [g1, r1], at: B1, clearance: {radial: rho}}\n";
  text += "  P: {revolute: [r1, r2], at: P, clearance: {radial: " + draw.radial() + "}}\n";
  text += "  B2: {revolute: [g2, r2], at: B2, clearance: {radial: rho}}\n";
  text += fmt::format("  G2: {{prismatic: [ground, g2], at: B2, axis: {}, actuated: true, clearance: {{axial: {}}}}}\n",
                      second, draw.radial());
  text += "end_effector: {link: r2, at: P}\n" + loads(draw, "r2");
  text += fmt::format("  - {{link: g1, at: B1, force: [0, 0], couple: {:.2f}}}\n", draw.uniform(0.5, 2));
  if (draw.one_in(2)) text += "gravity: [0, -9.81]\n";
  return {text + extras(draw, "r2", "P"), {0.5 * d + draw.uniform(-0.1, 0.1), draw.uniform(-0.3, 0.3)}};
}

using Family = Design (*)(Draw&);

struct Solved {
  double error = 0, least_force = INFINITY;
};

/// The pose error at a pose, and the least force that a pin bears.
Solved solved(const numeric::NumericModel& model, const Point2& at) {
  const numeric::Posture posture = numeric::posture(model, at, mechanism::working_mode(model.mechanism));
  EXPECT_TRUE(posture.reachable());
  const numeric::Accuracy accuracy = numeric::pose_accuracy(model, posture);
  Solved result{accuracy.error.dp.norm()};
  for (std::size_t j = 0; j < model.mechanism.joints.size(); ++j)
    if (model.mechanism.joints[j].type == mechanism::JointType::revolute && model.mechanism.joints[j].clearance)
      result.least_force = std::min(result.least_force, accuracy.of_joints[j].force.norm());
  return result;
}

class ProvenBounds : public testing::TestWithParam<std::pair<const char*, Family>> {};

TEST_P(ProvenBounds, AreMetByNoSample) {
  Draw draw{std::mt19937(20260701)};
  int verified = 0;
  for (int n = 0; verified < designs() && n < 40 * designs(); ++n) {
    const Design design = GetParam().second(draw);
    const double side = draw.uniform(0.01, 0.04);
    const std::string shape = fmt::format("format: 1\nbox: {{x: [{}, {}], y: [{}, {}]}}\n", design.near[0],
                                          design.near[0] + side, design.near[1], design.near[1] + side);
    std::string varied;
    if (n % 2 == 1)
      varied = "tolerances: {d: 2e-4, rho: 5e-7}\n" +
               fmt::format("loads_within: [{{load: 1, radius: {:.2f}}}]\n", draw.uniform(0.2, 4));
    SCOPED_TRACE(design.text + shape + varied);
    Mechanism m;
    try {
      m = mechanism::parse_mechanism(design.text, "random.yaml");
    } catch (const core::InputError&) {
      continue;  // it closes nowhere
    }
    const Verification answer =
        test::decided(m, mechanism::parse_task(shape + varied + "pose_error: 1\n", "task.yaml", m));
    if (!answer.verified()) continue;
    ++verified;
    ASSERT_TRUE(answer.pose_error);
    const core::Task task = mechanism::parse_task(shape + varied, "task.yaml", m);
    Solved most;
    const int members = varied.empty() ? 1 : 12;
    for (int k = 0; k < members; ++k) {
      Values values;
      for (const core::Tolerance& tolerance : task.tolerances) {
        const core::Rational nominal = mechanism::parameter_named(m, tolerance.parameter)->value;
        const core::Rational part(draw.uniform(0, 1) < 0.5 ? 0 : 1);
        values.emplace_back(
            tolerance.parameter,
            core::to_string(core::Rational(nominal + tolerance.below + (tolerance.above - tolerance.below) * part)));
      }
      Mechanism member = mechanism::parse_mechanism(design.text, "random.yaml", values);
      for (const core::LoadWithin& within : task.loads_within) {
        const double angle = draw.uniform(0, 6.3), radius = core::to_double(within.force);
        std::vector<core::Expression>& force = member.loads[within.load].force;
        const std::array<double, 2> more = {radius * std::cos(angle), radius * std::sin(angle)};
        for (std::size_t c = 0; c < 2; ++c)
          force[c] = core::Expression::apply(core::Expression::Kind::add,
                                             {force[c], core::Expression::number(core::Rational(more[c]))});
      }
      const numeric::NumericModel model = numeric::compile(member);
      const int grid = varied.empty() ? 12 : 4;
      for (int i = 0; i <= grid; ++i)
        for (int j = 0; j <= grid; ++j) {
          const Solved solution = solved(model, {design.near[0] + side * i / grid, design.near[1] + side * j / grid});
          most.error = std::max(most.error, solution.error);
          most.least_force = std::min(most.least_force, solution.least_force);
        }
    }
    EXPECT_LE(most.error, *answer.pose_error * (1 + 1e-9));
    if (varied.empty()) {
      EXPECT_GE(most.error, *answer.pose_error * (1 - 4e-3)) << "the bound is not near";
    }
    // A tenth more than what some sample bears is not kept by all.
    const Verification too_much = test::decided(
        m, mechanism::parse_task(shape + varied + fmt::format("min_force: {}\n", 1.1 * most.least_force), "t.yaml", m));
    EXPECT_NE(too_much.verdict, core::Verdict::verified) << most.least_force;
  }
  EXPECT_EQ(verified, designs()) << "too few tasks were verified for the law to say anything";
}

INSTANTIATE_TEST_SUITE_P(Families, ProvenBounds,
                         testing::Values(std::pair("five_bar", &five_bar), std::pair("telescopes", &telescopes),
                                         std::pair("arms", &arms), std::pair("plate", &plate),
                                         std::pair("rails", &rails)),
                         [](const auto& candidate) { return std::string(candidate.param.first); });

/// The same answers however long the axes are written.
TEST(AxisLengths, AreOfNoConsequence) {
  const std::string
      axis = "axis: [0, 1]",
      text = std::string(head) +
             "workspace: {x: [0, 0.6], y: [-0.4, 0.4]}\n"
             "points:\n  R1: [0, 0]\n  R2: [0.6, 0]\n  P: [x, y]\n"
             "  B1: {slider: [R1, [0, 1]], from: P, length: 0.5, side: ahead}\n"
             "  B2: {slider: [R2, [0, 1]], from: P, length: 0.5, side: ahead}\n"
             "links: {g1: {points: [B1]}, r1: {points: [B1, P]}, r2: {points: [P, B2]}, g2: {points: [B2]}}\n"
             "joints:\n"
             "  G1: {prismatic: [ground, g1], at: B1, axis: [0, 1], actuated: true, clearance: {axial: 5e-6}}\n"
             "  B1: {revolute: [g1, r1], at: B1, clearance: {radial: 1e-5}}\n"
             "  P: {revolute: [r1, r2], at: P, clearance: {radial: 1e-5}}\n"
             "  B2: {revolute: [g2, r2], at: B2, clearance: {radial: 1e-5}}\n"
             "  G2: {prismatic: [ground, g2], at: B2, axis: [0, 1], actuated: true, clearance: {axial: 5e-6}}\n"
             "end_effector: {link: r2, at: P}\nloads:\n  - {link: r2, at: P, force: [30, -100]}\n";
  const std::string task = "format: 1\nbox: {x: [0.28, 0.3], y: [-0.1, -0.08]}\npose_error: 1e-3\n";
  std::vector<double> bounds;
  for (const char* length : {"1", "100", "1/50", "sqrt(3)"}) {
    std::string changed = text;
    for (std::size_t at = 0; (at = changed.find(axis, at)) != std::string::npos; at += axis.size())
      changed.replace(at, axis.size(), fmt::format("axis: [0, {}]", length));
    const Mechanism m = mechanism::parse_mechanism(changed, "rails.yaml");
    const Verification answer = test::decided(m, mechanism::parse_task(task, "task.yaml", m));
    ASSERT_TRUE(answer.pose_error) << length;
    bounds.push_back(*answer.pose_error);
  }
  for (const double bound : bounds) EXPECT_NEAR(bound, bounds.front(), 2e-3 * bounds.front());
}

}  // namespace
}  // namespace clearloci
