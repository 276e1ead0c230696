#include "tests/laws/margin_designs.hpp"

#include <fmt/format.h>

#include <random>

namespace clearloci::test {
namespace {

class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed), lattice_(random_() % 2 == 0) {}

  int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  bool one_in(int n) { return whole(1, n) == 1; }
  std::string side() { return one_in(2) ? "left" : "right"; }
  /// m.
  std::string length(int from, int to) {
    return lattice_ ? fmt::format("{}/40", 5 * ((2 * from + 24) / 25 + whole(0, std::max(0, (to - from) / 13))))
                    : fmt::format("{}/100", whole(from, to));
  }
  std::string place(int from, int to) {
    return lattice_ ? fmt::format("{}/8", whole(from, to) / 12) : fmt::format("{}/100", whole(from, to));
  }
  std::string mass() { return lattice_ ? fmt::format("{}/8", whole(1, 12)) : fmt::format("{}/10", whole(1, 15)); }
  std::string force() { return fmt::format("{}", whole(-90, 90)); }
  std::string couple() { return fmt::format("{}/8", whole(-80, 80)); }

 private:
  std::mt19937 random_;
  bool lattice_;
};

std::string leg(const std::string& crank, const std::string& rod, const std::string& base, const std::string& elbow,
                Numbers& n) {
  return fmt::format("  {}: {{points: [{}, {}], mass: {}}}\n  {}: {{points: [{}, P], mass: {}}}\n", crank, base, elbow,
                     n.mass(), rod, elbow, n.mass());
}

std::string pin(const std::string& name, const std::string& from, const std::string& to, bool actuated) {
  return fmt::format("  {}: {{revolute: [{}, {}], at: {}{}, clearance: {{radial: 1e-5{}}}}}\n", name, from, to, name,
                     actuated ? ", actuated: true" : "", actuated ? ", angular: 5e-4" : "");
}

std::string head(const std::string& name) {
  return "format: 1\nname: " + name + "\nspace: planar\nworkspace: {x: [-0.8, 1.2], y: [-0.9, 0.9]}\n";
}

std::string load(const std::string& link, const std::string& at, Numbers& n) {
  return fmt::format("loads:\n  - {{link: {}, at: {}, force: [{}, {}], couple: {}}}\n", link, at, n.force(), n.force(),
                     n.couple());
}

constexpr const char* gravity = "gravity: [0, -9.81]\n";

std::string five_bar(Numbers& n, bool sprung) {
  std::string text =
      head("5r") +
      fmt::format(
          "points:\n  A1: [0, 0]\n  A2: [{}, {}]\n  P: [x, y]\n  B1: {{dyad: [A1, P], lengths: [{}, {}], side: {}}}\n"
          "  B2: {{dyad: [A2, P], lengths: [{}, {}], side: {}}}\nlinks:\n",
          n.place(30, 60), n.place(-24, 24), n.length(35, 60), n.length(35, 60), n.side(), n.length(35, 60),
          n.length(35, 60), n.side());
  text += leg("crank1", "rod1", "A1", "B1", n) + leg("crank2", "rod2", "A2", "B2", n) + "joints:\n" +
          pin("A1", "ground", "crank1", true) + pin("B1", "crank1", "rod1", false) + pin("P", "rod1", "rod2", false) +
          pin("B2", "crank2", "rod2", false) + pin("A2", "ground", "crank2", true) +
          "end_effector: {link: rod2, at: P}\n";
  text += sprung ? load("rod1", "P", n) : n.one_in(2) ? load("crank2", "B2", n) : load("rod2", "P", n);
  if (sprung)
    text += fmt::format("springs:\n  - {{links: [rod1, ground], at: [P, A2], stiffness: {}, free_length: 0}}\n",
                        n.whole(20, 400));
  return text + gravity;
}

std::string on_a_rail(Numbers& n) {
  const std::string rail = fmt::format("[1/2, {}]", n.place(0, 24));
  std::string text =
      head("prrr-r") + fmt::format(
                           "points:\n  R1: [0, 0]\n  A2: [{}, {}]\n  P: [x, y]\n"
                           "  S1: {{slider: [R1, {}], from: P, length: {}, side: ahead}}\n"
                           "  B2: {{dyad: [A2, P], lengths: [{}, {}], side: {}}}\nlinks:\n  block: {{points: [S1]}}\n",
                           n.place(40, 70), n.place(-30, 30), rail, n.length(40, 60), n.length(40, 60),
                           n.length(35, 60), n.side());
  text +=
      fmt::format("  rod1: {{points: [S1, P], mass: {}}}\n  rod2: {{points: [P, B2], mass: {}}}\n", n.mass(), n.mass());
  text += fmt::format("  crank2: {{points: [A2, B2], mass: {}}}\njoints:\n", n.mass());
  text += "  G1: {prismatic: [ground, block], at: S1, axis: " + rail +
          ", actuated: true, clearance: {gap: 1e-5, half_length: 3/100, axial: 5e-6}}\n";
  text += pin("S1", "block", "rod1", false) + pin("P", "rod1", "rod2", false) + pin("B2", "crank2", "rod2", false) +
          pin("A2", "ground", "crank2", true) + "end_effector: {link: rod2, at: P}\n";
  return text + load("rod2", "P", n) + gravity;
}

/// The second leg is a cylinder between its base and the end effector.
std::string telescopic(Numbers& n) {
  std::string text =
      head("rrrpr") +
      fmt::format(
          "points:\n  A1: [0, 0]\n  A2: [{}, {}]\n  P: [x, y]\n"
          "  B1: {{dyad: [A1, P], lengths: [{}, {}], side: {}}}\n  C1: {{on: [B1, P], offset: [{}, {}]}}\nlinks:\n",
          n.place(60, 80), n.place(-40, 24), n.length(40, 60), n.length(40, 60), n.side(), n.length(10, 30),
          n.place(-24, 24));
  text += fmt::format("  crank: {{points: [A1, B1], mass: {}}}\n  rod: {{points: [B1, P, C1], mass: {}}}\n", n.mass(),
                      n.mass());
  text += "  barrel: {points: [A2]}\n  piston: {points: [P]}\njoints:\n";
  text += pin("A1", "ground", "crank", true) + pin("B1", "crank", "rod", false) + pin("P", "rod", "piston", false) +
          "  S2: {prismatic: [barrel, piston], at: P, axis: [A2, P], actuated: true}\n" +
          pin("A2", "ground", "barrel", false) + "end_effector: {link: rod, at: P}\n";
  return text + load("rod", "C1", n) + gravity;
}

}  // namespace

MarginDesign random_margin_design(unsigned seed) {
  Numbers n(seed);
  const int kind = n.whole(0, 6);
  const std::string bound = n.one_in(2) ? fmt::format("{}", n.whole(2, 80)) : fmt::format("{}/10", n.whole(20, 900));
  if (kind < 3) return {"5R", five_bar(n, false), bound};
  if (kind < 4) return {"sprung 5R", five_bar(n, true), bound};
  if (kind < 6) return {"PRRR-R", on_a_rail(n), bound};
  return {"RRRPR", telescopic(n), bound};
}

}  // namespace clearloci::test
