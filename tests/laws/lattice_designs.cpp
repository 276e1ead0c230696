#include "tests/laws/lattice_designs.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace clearloci::test {
namespace {

/// A quarter n / 4 as it is written in a file.
std::string quarter(int n) {
  if (n % 4 == 0) return std::to_string(n / 4);
  return n % 2 == 0 ? std::to_string(n / 2) + "/2" : std::to_string(n) + "/4";
}

struct Place {
  int x = 0, y = 0;  // quarters
  std::string text() const { return "[" + quarter(x) + ", " + quarter(y) + "]"; }
};

class Writer {
 public:
  Writer(std::mt19937& random, bool weights) : random_(random), weights_(weights) {}

  std::string write(Family family) {
    switch (family) {
      case Family::five_bar:
        five_bar();
        break;
      case Family::coupler:
        coupler();
        break;
      case Family::prrrp:
        prrrp();
        break;
      case Family::prrr_r:
        prrr_r();
        break;
      case Family::rprpr:
        rprpr();
        break;
      case Family::three_rpr:
        three_rpr();
        break;
    }
    std::string text = "format: 1\nname: lattice " + to_string(family) + "\nspace: planar\nworkspace:\n" + box() +
                       "points:\n" + points_ + "links:\n" + links_ + "joints:\n" + joints_ + end_effector_ +
                       "loads:\n" + loads_;
    if (weights_) text += "gravity: [0, -9.81]\n";
    return text;
  }

 private:
  int in(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool one_in(int n) { return in(1, n) == 1; }
  std::string side(const char* first, const char* second) { return one_in(2) ? first : second; }

  /// Lengths of the two links of a leg.
  std::array<int, 2> leg() {
    const int a = in(1, 6), b = one_in(2) ? a : in(1, 6);
    reach_ = std::max(reach_, a + b);
    for (const int r : {a, b, a + b, std::abs(a - b)}) radii_.push_back(r);
    return {a, b};
  }
  std::string lengths(const std::array<int, 2>& leg) { return "[" + quarter(leg[0]) + ", " + quarter(leg[1]) + "]"; }

  Place base(const Place& other) {
    Place place = {other.x + in(1, 6), one_in(3) ? in(-3, 3) : other.y};
    if (one_in(12)) place = other;  // coincident
    return centre(place);
  }
  Place centre(const Place& place) {
    centres_.push_back(place);
    return place;
  }

  std::string force() {
    Place f;
    do f = one_in(2) ? Place{0, -400} : Place{40 * in(-3, 3), 40 * in(-3, 3)};
    while (f.x == 0 && f.y == 0);
    return f.text();
  }

  /// Whole now and then; else its sides are on the lattice, often through centres and where circles have their ends.
  std::string box() {
    int low[2] = {1000, 1000}, high[2] = {-1000, -1000};
    for (const Place& p : centres_) {
      low[0] = std::min(low[0], p.x), high[0] = std::max(high[0], p.x);
      low[1] = std::min(low[1], p.y), high[1] = std::max(high[1], p.y);
    }
    std::string text;
    for (const int axis : {0, 1}) {
      int from = low[axis] - reach_ - 1, to = high[axis] + reach_ + 1;
      if (!one_in(4)) {
        std::vector<int> stops;
        for (const Place& p : centres_) {
          const int c = axis == 0 ? p.x : p.y;
          stops.push_back(c);
          for (const int r : radii_) stops.insert(stops.end(), {c - r, c + r});
        }
        const auto pick = [&] {
          return one_in(3) ? in(from, to) : stops[static_cast<std::size_t>(in(0, static_cast<int>(stops.size()) - 1))];
        };
        const int own_from = one_in(3) ? from : pick(), own_to = one_in(3) ? to : pick();
        from = std::min(own_from, own_to);
        to = std::max({own_from, own_to, from + 1});
      }
      text += std::string(axis == 0 ? "  x: [" : "  y: [") + quarter(from) + ", " + quarter(to) + "]\n";
    }
    return text;
  }

  std::string mass() { return weights_ ? ", mass: 1" : ""; }
  void link(const std::string& name, const std::string& points) {
    links_ += "  " + name + ": {points: [" + points + "]" + mass() + "}\n";
  }
  void block(const std::string& name, const std::string& points) {
    links_ += "  " + name + ": {points: [" + points + "]}\n";
  }
  void revolute(const std::string& name, const std::string& from, const std::string& to, bool actuated = false) {
    joints_ += "  " + name + ": {revolute: [" + from + ", " + to + "], at: " + name +
               (actuated ? ", actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}\n"
                         : ", clearance: {radial: 10e-6}}\n");
  }
  void prismatic(const std::string& name, const std::string& from, const std::string& to, const std::string& at,
                 const std::string& axis, bool guide) {
    joints_ += "  " + name + ": {prismatic: [" + from + ", " + to + "], at: " + at + ", axis: " + axis +
               ", actuated: true, clearance: {" + (guide ? "gap: 10e-6, half_length: 1/32, " : "") + "axial: 5e-6}}\n";
  }
  void tool(const std::string& link, const std::string& at) {
    end_effector_ = "end_effector: {link: " + link + ", at: " + at + "}\n";
    loads_ = "  - {link: " + link + ", at: " + at + ", force: " + force() + "}\n";
  }

  void five_bar() {
    const Place a1 = centre({one_in(2) ? 0 : in(-2, 2), one_in(2) ? 0 : in(-2, 2)}), a2 = base(a1);
    const auto leg1 = leg(), leg2 = one_in(2) ? leg1 : leg();
    points_ = "  A1: " + a1.text() + "\n  A2: " + a2.text() +
              "\n  P: [x, y]\n  B1: {dyad: [A1, P], lengths: " + lengths(leg1) + ", side: " + side("left", "right") +
              "}\n  B2: {dyad: [A2, P], lengths: " + lengths(leg2) + ", side: " + side("left", "right") + "}\n";
    link("A1B1", "A1, B1"), link("B1P", "B1, P"), link("PB2", "P, B2"), link("B2A2", "B2, A2");
    revolute("A1", "ground", "A1B1", true), revolute("B1", "A1B1", "B1P"), revolute("P", "B1P", "PB2");
    revolute("B2", "B2A2", "PB2"), revolute("A2", "ground", "B2A2", true);
    tool("PB2", "P");
  }

  void coupler() {
    const Place a1 = centre({0, 0}), a2 = base(a1);
    const auto leg1 = leg(), leg2 = one_in(2) ? leg1 : leg();
    const Place offset = {in(1, leg2[1]), one_in(2) ? 0 : in(-2, 2)};
    points_ = "  A1: " + a1.text() + "\n  A2: " + a2.text() +
              "\n  E: [x, y]\n  C2: {dyad: [A2, E], lengths: " + lengths(leg2) + ", side: " + side("left", "right") +
              "}\n  C: {on: [C2, E], offset: " + offset.text() + "}\n  B1: {dyad: [A1, C], lengths: " + lengths(leg1) +
              ", side: " + side("left", "right") + "}\n";
    link("A1B1", "A1, B1"), link("B1C", "B1, C"), link("C2E", "C2, E, C"), link("A2C2", "A2, C2");
    revolute("A1", "ground", "A1B1", true), revolute("B1", "A1B1", "B1C"), revolute("C", "B1C", "C2E");
    revolute("C2", "A2C2", "C2E"), revolute("A2", "ground", "A2C2", true);
    tool("C2E", "E");
  }

  std::string rail() {
    static const std::array<const char*, 5> directions = {"[0, 1]", "[1, 0]", "[1, 1]", "[3, 4]", "[-1, 1]"};
    return directions[static_cast<std::size_t>(one_in(2) ? in(0, 1) : in(0, 4))];
  }

  void slider(const std::string& name, const std::string& base, const std::string& axis, int length) {
    points_ += "  " + name + ": {slider: [" + base + ", " + axis + "], from: P, length: " + quarter(length) +
               ", side: " + side("ahead", "behind") + "}\n";
    radii_.push_back(length);
    reach_ = std::max(reach_, length);
  }

  void prrrp() {
    const Place r1 = centre({0, 0}), r2 = base(r1);
    const std::string axis1 = rail(), axis2 = one_in(2) ? axis1 : rail();
    const int first = in(1, 6), second = one_in(2) ? first : in(1, 6);
    points_ = "  R1: " + r1.text() + "\n  R2: " + r2.text() + "\n  P: [x, y]\n";
    slider("S1", "R1", axis1, first), slider("S2", "R2", axis2, second);
    block("block1", "S1"), link("S1P", "S1, P"), link("PS2", "P, S2"), block("block2", "S2");
    prismatic("G1", "ground", "block1", "S1", axis1, true);
    revolute("S1", "block1", "S1P"), revolute("P", "S1P", "PS2"), revolute("S2", "block2", "PS2");
    prismatic("G2", "ground", "block2", "S2", axis2, true);
    tool("PS2", "P");
  }

  void prrr_r() {
    const Place r1 = centre({0, 0}), a2 = base(r1);
    const std::string axis = rail();
    const auto leg2 = leg();
    points_ = "  R1: " + r1.text() + "\n  A2: " + a2.text() + "\n  P: [x, y]\n";
    slider("S1", "R1", axis, in(1, 6));
    points_ += "  B2: {dyad: [A2, P], lengths: " + lengths(leg2) + ", side: " + side("left", "right") + "}\n";
    block("block1", "S1"), link("S1P", "S1, P"), link("PB2", "P, B2"), link("A2B2", "A2, B2");
    prismatic("G1", "ground", "block1", "S1", axis, true);
    revolute("S1", "block1", "S1P"), revolute("P", "S1P", "PB2"), revolute("B2", "A2B2", "PB2");
    revolute("A2", "ground", "A2B2", true);
    tool("PB2", "P");
  }

  void rprpr() {
    const Place a1 = centre({0, 0}), a2 = base(a1);
    reach_ = 4;
    radii_ = {1, 2, 4};
    points_ = "  A1: " + a1.text() + "\n  A2: " + a2.text() +
              "\n  P: [x, y]\n  G1: {on: [A1, P], offset: [1/4, 0]}\n  G2: {on: [A2, P], offset: [1/4, 0]}\n";
    const std::string inertia = weights_ ? ", mass: 1, com: G" : "";
    links_ = "  cylinder1: {points: [A1]" + (weights_ ? inertia + "1, inertia: 1/100" : "") +
             "}\n  rod1: {points: [P]}\n  rod2: {points: [P]}\n  cylinder2: {points: [A2]" +
             (weights_ ? inertia + "2, inertia: 1/100" : "") + "}\n";
    revolute("A1", "ground", "cylinder1"), revolute("A2", "ground", "cylinder2"), revolute("P", "rod1", "rod2");
    prismatic("S1", "cylinder1", "rod1", "P", "[A1, P]", true);
    prismatic("S2", "cylinder2", "rod2", "P", "[A2, P]", true);
    tool("rod2", "P");
  }

  void three_rpr() {
    reach_ = 6;
    radii_ = {1, 2, 4};
    const std::array<Place, 3> bases = {centre({in(-5, -1), in(-4, 0)}), centre({in(1, 5), in(-4, 0)}),
                                        centre({in(-2, 2), in(1, 5)})};
    const std::array<Place, 3> feet = {Place{in(-2, 0), in(-1, 0)}, Place{in(1, 2), in(-1, 0)},
                                       Place{in(-1, 1), in(1, 2)}};
    std::string feet_names;
    weights_ = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string n = std::to_string(i + 1);
      points_ += "  A" + n + ": " + bases[i].text() + "\n";
      feet_names += ", B" + n;
      links_ += "  cylinder" + n + ": {points: [A" + n + "]}\n  rod" + n + ": {points: [B" + n + "]}\n";
      revolute("A" + n, "ground", "cylinder" + n);
      prismatic("S" + n, "cylinder" + n, "rod" + n, "B" + n, "[A" + n + ", B" + n + "]", false);
      revolute("B" + n, "rod" + n, "platform");
    }
    points_ += "  P: [x, y]\n";
    for (std::size_t i = 0; i < 3; ++i)
      points_ += "  B" + std::to_string(i + 1) + ": [x + " + quarter(feet[i].x) + ", y + " + quarter(feet[i].y) + "]\n";
    links_ += "  platform: {points: [P" + feet_names + "]}\n";
    tool("platform", "P");
    loads_.insert(loads_.rfind('}'), ", couple: " + quarter(40 * in(-2, 2)));
  }

  std::mt19937& random_;
  bool weights_;
  int reach_ = 1;
  std::vector<int> radii_ = {0};
  std::vector<Place> centres_;
  std::string points_, links_, joints_, end_effector_, loads_;
};

}  // namespace

std::string to_string(Family family) {
  static const std::array<const char*, 6> names = {"5R", "coupler five-bar", "PRRRP", "PRRR-R", "RPRPR", "3-RPR"};
  return names[static_cast<std::size_t>(family)];
}

std::string lattice_design(std::mt19937& random, Family family, bool weights) {
  return Writer(random, weights).write(family);
}

}  // namespace clearloci::test
