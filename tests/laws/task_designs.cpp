#include "tests/laws/task_designs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "loci/tasks/task_region.hpp"
#include "numeric/reactions.hpp"

namespace clearloci::test {
namespace {

/// Numbers of one design: quarters, or thousandths in general position.
class Numbers {
 public:
  Numbers(std::mt19937& random, bool lattice) : random_(random), lattice_(lattice) {}

  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool one_in(int n) { return whole(1, n) == 1; }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  /// Between two numbers given in quarters.
  std::string quarters(int low, int high) {
    if (lattice_) return fmt::format("{}/4", whole(low, high));
    return fmt::format("{:.3f}", real(low / 4.0, high / 4.0));
  }
  std::string vector(int low, int high) { return fmt::format("[{}, {}]", quarters(low, high), quarters(low, high)); }
  std::string side() { return one_in(2) ? "left" : "right"; }
  std::string way() { return one_in(2) ? "ahead" : "behind"; }
  std::string axis() {
    if (lattice_) return one_in(2) ? "[1, 0]" : "[0, 1]";
    return fmt::format("[{:.2f}, {:.2f}]", real(0.1, 1), real(-1, 1));
  }
  /// N.
  std::string force() {
    if (!lattice_) return fmt::format("[{}, {}]", whole(-90, 90), whole(-90, 90));
    switch (whole(0, 3)) {
      case 0:
        return "[0, -100]";
      case 1:
        return "[100, 0]";
      case 2:
        return "[50, -50]";
      default:
        return "[25, -75]";
    }
  }
  bool lattice() const { return lattice_; }

 private:
  std::mt19937& random_;
  bool lattice_;
};

const char* const guide = "clearance: {gap: 1e-5, half_length: 1/32, axial: 5e-6}";
const char* const pin = "clearance: {radial: 1e-5}";
const char* const drive = "actuated: true, clearance: {radial: 1e-5, angular: 5e-4}";

struct Parts {
  std::string points, links, joints, end, loads;
};

Parts five_bar(Numbers& n, const std::string& mass, bool coupler) {
  Parts p;
  const std::string l1 = n.quarters(2, 4), l2 = n.one_in(3) ? l1 : n.quarters(2, 4);
  const std::string l3 = n.one_in(2) ? l1 : n.quarters(2, 4), l4 = n.one_in(2) ? l2 : n.quarters(2, 4);
  const std::string base = n.one_in(6) ? "[0, 0]" : n.one_in(2) ? "[" + n.quarters(1, 4) + ", 0]" : n.vector(-3, 3);
  p.points = fmt::format("  A1: [0, 0]\n  A2: {}\n  P: [x, y]\n", base);
  p.points += fmt::format("  B2: {{dyad: [A2, P], lengths: [{}, {}], side: {}}}\n", l3, l4, n.side());
  const std::string foot = coupler ? "C" : "P";
  if (coupler) p.points += fmt::format("  C: {{on: [B2, P], offset: [{}, {}]}}\n", n.quarters(1, 3), n.quarters(-1, 1));
  p.points += fmt::format("  B1: {{dyad: [A1, {}], lengths: [{}, {}], side: {}}}\n", foot, l1, l2, n.side());
  p.links = fmt::format(
      "  A1B1: {{points: [A1, B1]{0}}}\n  B1P: {{points: [B1, {1}]{0}}}\n  PB2: {{points: [B2, P{2}]{0}}}\n"
      "  A2B2: {{points: [A2, B2]{0}}}\n",
      mass, foot, coupler ? ", C" : "");
  p.joints = fmt::format(
      "  A1: {{revolute: [ground, A1B1], at: A1, {1}}}\n  B1: {{revolute: [A1B1, B1P], at: B1, {0}}}\n"
      "  {2}: {{revolute: [B1P, PB2], at: {2}, {0}}}\n  B2: {{revolute: [A2B2, PB2], at: B2, {0}}}\n"
      "  A2: {{revolute: [ground, A2B2], at: A2, {1}}}\n",
      pin, drive, foot);
  p.end = "PB2";
  return p;
}

/// A prismatic joint at the ground carries either leg, or one of them.
Parts sliders(Numbers& n, const std::string& mass, bool both) {
  Parts p;
  const std::string axis = n.axis(), length = n.quarters(2, 5);
  p.points =
      fmt::format("  R1: [0, 0]\n  A2: {}\n  P: [x, y]\n  S1: {{slider: [R1, {}], from: P, length: {}, side: {}}}\n",
                  n.vector(-3, 3), axis, length, n.way());
  p.links =
      fmt::format("  block1: {{points: [S1]}}\n  S1P: {{points: [S1, P]{0}}}\n  PB2: {{points: [P, B2]{0}}}\n", mass);
  p.joints = fmt::format(
      "  G1: {{prismatic: [ground, block1], at: S1, axis: {}, actuated: true, {}}}\n"
      "  S1: {{revolute: [block1, S1P], at: S1, {}}}\n  P: {{revolute: [S1P, PB2], at: P, {}}}\n",
      axis, guide, pin, pin);
  if (both) {
    const std::string axis_name = n.one_in(2) ? axis : n.axis();
    p.points += fmt::format("  B2: {{slider: [A2, {}], from: P, length: {}, side: {}}}\n", axis_name,
                            n.one_in(2) ? length : n.quarters(2, 5), n.way());
    p.links += "  block2: {points: [B2]}\n";
    p.joints += fmt::format(
        "  B2: {{revolute: [block2, PB2], at: B2, {}}}\n"
        "  G2: {{prismatic: [ground, block2], at: B2, axis: {}, actuated: true, {}}}\n",
        pin, axis_name, guide);
  } else {
    p.points += fmt::format("  B2: {{dyad: [A2, P], lengths: [{}, {}], side: {}}}\n", n.quarters(2, 4),
                            n.quarters(2, 4), n.side());
    p.links += fmt::format("  A2B2: {{points: [A2, B2]{}}}\n", mass);
    p.joints += fmt::format(
        "  B2: {{revolute: [A2B2, PB2], at: B2, {}}}\n  A2: {{revolute: [ground, A2B2], at: A2, {}}}\n", pin, drive);
  }
  p.end = "PB2";
  return p;
}

/// One or both legs are cylinders from the ground to P.
Parts cylinders(Numbers& n, const std::string& mass, bool both) {
  Parts p;
  p.points = fmt::format("  A1: [0, 0]\n  A2: [{}, {}]\n  P: [x, y]\n", n.quarters(1, 4), n.quarters(-2, 2));
  const auto leg = [&](const std::string& a, const std::string& k) {
    p.links += fmt::format("  cylinder{0}: {{points: [{1}]}}\n  rod{0}: {{points: [P]}}\n", k, a);
    p.joints += fmt::format(
        "  {1}: {{revolute: [ground, cylinder{0}], at: {1}, {2}}}\n"
        "  S{0}: {{prismatic: [cylinder{0}, rod{0}], at: P, axis: [{1}, P], actuated: true, {3}}}\n",
        k, a, pin, guide);
  };
  if (both) {
    leg("A1", "1");
  } else {
    p.points += fmt::format("  B1: {{dyad: [A1, P], lengths: [{}, {}], side: {}}}\n", n.quarters(2, 4),
                            n.quarters(2, 4), n.side());
    p.links = fmt::format("  A1B1: {{points: [A1, B1]{0}}}\n  rod1: {{points: [B1, P]{0}}}\n", mass);
    p.joints = fmt::format(
        "  A1: {{revolute: [ground, A1B1], at: A1, {}}}\n  B1: {{revolute: [A1B1, rod1], at: B1, {}}}\n", drive, pin);
  }
  leg("A2", "2");
  p.joints += fmt::format("  P: {{revolute: [rod1, rod2], at: P, {}}}\n", pin);
  p.end = "rod2";
  return p;
}

Parts platform(Numbers& n) {
  Parts p;
  p.points = "  P: [x, y]\n";
  p.links = "  platform: {points: [P, B1, B2, B3]}\n";
  const std::array<std::array<int, 4>, 3> corners = {{{-4, -4, -1, -1}, {4, -4, 1, -1}, {0, 4, 0, 1}}};
  for (int k = 1; k <= 3; ++k) {
    const auto& [ax, ay, bx, by] = corners[static_cast<std::size_t>(k - 1)];
    p.points += fmt::format("  A{0}: [{1}, {2}]\n  B{0}: [x + {3}, y + {4}]\n", k, n.quarters(ax - 1, ax + 1),
                            n.quarters(ay - 1, ay + 1), n.quarters(bx, bx + 1), n.quarters(by, by + 1));
    p.links += fmt::format("  cylinder{0}: {{points: [A{0}]}}\n  rod{0}: {{points: [B{0}]}}\n", k);
    p.joints += fmt::format(
        "  A{0}: {{revolute: [ground, cylinder{0}], at: A{0}, {1}}}\n"
        "  S{0}: {{prismatic: [cylinder{0}, rod{0}], at: B{0}, axis: [A{0}, B{0}], actuated: true, "
        "clearance: {{axial: 5e-6}}}}\n"
        "  B{0}: {{revolute: [rod{0}, platform], at: B{0}, {1}}}\n",
        k, pin);
  }
  p.end = "platform";
  return p;
}

std::vector<int> mode_of(const mechanism::Mechanism& m) { return mechanism::working_mode(m); }

}  // namespace

std::string random_design(std::mt19937& random, int kind, bool lattice) {
  Numbers n(random, lattice);
  const bool heavy = n.one_in(2);
  const std::string mass = heavy ? ", mass: " + std::string(lattice ? "1" : fmt::format("{:.1f}", n.real(0.2, 2))) : "";
  Parts p;
  switch (kind) {
    case 0:
    case 1:
      p = five_bar(n, mass, kind == 1);
      break;
    case 2:
    case 3:
      p = sliders(n, mass, kind == 2);
      break;
    case 4:
    case 5:
      p = cylinders(n, mass, kind == 5);
      break;
    default:
      p = platform(n);
  }
  std::string text = "format: 1\nname: random\nspace: planar\nworkspace: {x: [-3, 3], y: [-3, 3]}\npoints:\n" +
                     p.points + "links:\n" + p.links + "joints:\n" + p.joints +
                     fmt::format("end_effector: {{link: {0}, at: P}}\nloads:\n  - {{link: {0}, at: P, force: {1}}}\n",
                                 p.end, n.force());
  if (heavy) text += "gravity: [0, -9.81]\n";
  return text;
}

std::optional<std::string> random_shape(std::mt19937& random, const mechanism::Mechanism& mechanism, bool lattice) {
  Numbers n(random, lattice);
  const numeric::NumericModel model = numeric::compile(mechanism);
  core::Point2 at{};
  bool found = false;
  for (int i = 0; i < 2000 && !found; ++i) {
    at = lattice ? core::Point2{n.whole(-16, 16) / 8.0, n.whole(-16, 16) / 8.0}
                 : core::Point2{n.real(-2, 2), n.real(-2, 2)};
    found = numeric::reachable(model, at, mode_of(mechanism));
  }
  if (!found) return std::nullopt;
  const auto text = [&](double value) {
    return lattice ? fmt::format("{}/64", std::lround(64 * value)) : fmt::format("{:.4f}", value);
  };
  const auto step = [&] { return lattice ? std::ldexp(1.0, -n.whole(2, 5)) : n.real(0.005, 0.12); };
  const auto place = [&] {
    const double dx = (n.one_in(2) ? 1 : -1) * step(), dy = (n.one_in(2) ? 1 : -1) * step();
    return "[" + text(at[0] + dx) + ", " + text(at[1] + dy) + "]";
  };
  const std::string margin = n.one_in(2) ? ""
                                         : "\nmargin: " + (lattice ? fmt::format("1/{}", 32 << n.whole(0, 2))
                                                                   : fmt::format("{:.4f}", n.real(0, 0.03)));
  switch (n.whole(0, 3)) {
    case 0: {
      // Of the lattice a corner, a side or the middle lies on the pose.
      const double left = n.one_in(3) ? 0 : step(), low = n.one_in(3) ? 0 : step();
      return fmt::format("box: {{x: [{}, {}], y: [{}, {}]}}", text(at[0] - left), text(at[0] + step()),
                         text(at[1] - low), text(at[1] + step())) +
             margin;
    }
    case 1:
      return fmt::format("circle: {{centre: [{}, {}], radius: {}}}", text(at[0]), text(at[1]), text(step())) + margin;
    case 2:
      return fmt::format("polygon: [[{}, {}], {}, {}]", text(at[0]), text(at[1]), place(), place()) + margin;
    default:
      return fmt::format("path: [[{}, {}], {}, {}]", text(at[0]), text(at[1]), place(), place()) + margin;
  }
}

std::string random_wishes(std::mt19937& random, const mechanism::Mechanism& mechanism, const core::TaskShape& shape,
                          bool lattice) {
  Numbers n(random, lattice);
  std::string text;
  const numeric::NumericModel model = numeric::compile(mechanism);
  if (n.one_in(2)) {
    const std::string first = n.force(), second = n.force();
    const auto opposite = [](const std::string& a, const std::string& b) {
      double ax = 0, ay = 0, bx = 0, by = 0;
      std::sscanf(a.c_str(), "[%lf, %lf]", &ax, &ay);
      std::sscanf(b.c_str(), "[%lf, %lf]", &bx, &by);
      return ax * by - ay * bx == 0 && ax * bx + ay * by <= 0;
    };
    if (!opposite(first, second)) text += "\nloads_from: [" + first + ", " + second + "]";
  }
  // About as much as is there.
  double force = std::numeric_limits<double>::infinity(), couple = force;
  for (const core::Point2& at : loci::TaskRegion(shape).samples()) {
    const numeric::Posture posture = numeric::posture(model, at, mode_of(mechanism));
    if (!posture.reachable()) continue;
    const auto w = numeric::solve_reactions(model, posture).values;
    for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
      const double reaction = w(static_cast<Eigen::Index>(k));
      if (model.unknowns[k].quantity == core::Quantity::M) couple = std::min(couple, std::abs(reaction));
      if (model.unknowns[k].quantity == core::Quantity::fx)
        force = std::min(force, std::hypot(reaction, w(static_cast<Eigen::Index>(k) + 1)));
    }
  }
  const auto share = [&](double of) {
    return lattice ? std::max(1.0, std::round(of / 4)) : std::max(0.001, of * n.real(0.3, 1.05));
  };
  if (n.one_in(2) && std::isfinite(force)) text += fmt::format("\nmin_force: {:.3f}", share(force));
  if (n.one_in(4) && std::isfinite(couple)) text += fmt::format("\nmin_couple: {:.3f}", share(couple));
  return text;
}

}  // namespace clearloci::test
