#include "tests/laws/lattice_designs.hpp"

#include <algorithm>
#include <vector>

namespace clearloci::test {
namespace {

using core::Rational;

/// A coordinate and a number as the mechanism file adds them.
std::string shifted(const char* coordinate, const Rational& by) {
  return std::string(coordinate) + (by < 0 ? " - " : " + ") + text_of(abs(by));
}

struct Leg {
  Rational crank, rod;
};

class Writer {
 public:
  Writer(std::mt19937& random, bool on_lattice, bool weights, const Standing& standing)
      : random_(random), on_lattice_(on_lattice), weights_(weights) {
    denominator_ = one_in(4) ? 8 : 4;
    // Sizes of tables and of hands besides those of a man.
    const int size = in(0, 7);
    if (size == 0) scale_ = Rational(1, 10);
    if (size == 1) scale_ = 10;
    parts_.size = scale_ * standing.unit, parts_.unit = standing.unit;
    scale_ = parts_.size;
    parts_.origin = {standing.shift.x * scale_, standing.shift.y * scale_};
  }

  DesignParts write(Family family) {
    switch (family) {
      case Family::five_bar:
      case Family::mirrored:
      case Family::kite:
      case Family::coaxial:
        five_bar(family);
        break;
      case Family::coupler:
        coupler();
        break;
      case Family::stacked:
        stacked();
        break;
      case Family::prrrp:
      case Family::one_rail:
        two_sliders(family == Family::one_rail);
        break;
      case Family::prrr_r:
        prrr_r();
        break;
      case Family::rrrpr:
        rrrpr();
        break;
      case Family::rprpr:
        rprpr();
        break;
      case Family::three_rpr:
        three_rpr();
        break;
      case Family::four_bar:
        four_bar();
        break;
      case Family::slider_crank:
        slider_crank();
        break;
      case Family::three_rrr:
        three_rrr();
        break;
      case Family::motor_angles:
        motor_angles();
        break;
      case Family::turning_platform:
        turning_platform();
        break;
    }
    parts_.name = std::string(on_lattice_ ? "lattice " : "generic ") + to_string(family);
    parts_.lengths = !over_angles(family);
    parts_.coordinates = {"x", "y"};
    if (over_an_angle(family)) parts_.coordinates = {"theta"};
    if (family == Family::motor_angles) parts_.coordinates = {"theta", "psi"};
    if (family == Family::turning_platform) parts_.coordinates = {"x", "phi"};
    if (parts_.lengths) {
      parts_.workspace = box();
    } else {
      if (family == Family::turning_platform) parts_.workspace = span();
      for (const std::string& name : parts_.coordinates)
        if (name != "x") parts_.workspace += range(name);
    }
    if (weights_) parts_.gravity = one_in(6) ? "[-9.81, 0]" : "[0, -9.81]";
    return std::move(parts_);
  }

 private:
  int in(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool one_in(int n) { return in(1, n) == 1; }
  std::string side(const char* first, const char* second) { return one_in(2) ? first : second; }

  /// Between two quarters, on the lattice or between its nodes.
  Rational number(int low, int high) {
    const int d = on_lattice_ ? denominator_ : 97 + in(0, 40);
    Rational value(in((low * d + 3) / 4 - (low * d < 0 && (low * d) % 4 != 0 ? 1 : 0), high * d / 4), d);
    value.canonicalize();
    return value;
  }
  Rational length(int low = 1, int high = 5) {
    Rational l;
    do l = number(low, high);
    while (l <= 0);
    return l;
  }
  Rational scaled(const Rational& value) { return value * scale_; }
  std::string scaled_text(const Rational& value) { return text_of(scaled(value)); }
  std::string scaled_text(const Place& place) { return text_of(Place{scaled(place.x), scaled(place.y)}); }

  Place place(int reach) { return {number(-reach, reach), number(-reach, reach)}; }
  Place first_base() { return one_in(2) ? Place{0, 0} : place(2); }
  Place second_base(const Place& first) {
    if (one_in(14)) return first;
    if (one_in(14)) {
      static const std::array<Rational, 4> little = {Rational(1, 64), Rational(1, 1000), Rational(1, 1000000),
                                                     Rational(1, 1000000000)};
      return {first.x + little[static_cast<std::size_t>(in(0, 3))], first.y};
    }
    return {first.x + length(1, 4), one_in(2) ? first.y : Rational(first.y + number(-2, 2))};
  }

  /// On the lattice crank and rod are often alike.
  Leg leg() {
    const Rational crank = length();
    return {crank, on_lattice_ && one_in(2) ? crank : length()};
  }
  /// Circles about `centre` that matter: the box may be cut where they end.
  void stops_of_radii(const Place& centre, const std::vector<Rational>& radii) {
    for (const Rational& r : radii) {
      reach_ = std::max(reach_, r);
      stops_[0].insert(stops_[0].end(), {centre.x - r, centre.x + r});
      stops_[1].insert(stops_[1].end(), {centre.y - r, centre.y + r});
    }
  }
  void stops_about(const Place& centre, const Leg& leg) {
    stops_of_radii(centre, {0, leg.crank, leg.rod, leg.crank + leg.rod, abs(leg.crank - leg.rod)});
  }

  /// Whole now and then; else its sides are often where something ends.
  std::string box() {
    std::string text;
    for (const std::size_t axis : {0u, 1u}) {
      std::vector<Rational>& stops = stops_[axis];
      if (stops.empty()) stops = {-1, 0, 1};
      const auto [least, greatest] = std::minmax_element(stops.begin(), stops.end());
      const Rational margin = one_in(2) ? Rational(0) : Rational(1, 4);
      const Rational whole_from = *least - margin, whole_to = *greatest + margin;
      const auto pick = [&]() -> Rational {
        if (one_in(3)) return whole_from + (whole_to - whole_from) * Rational(in(1, 7), 8);
        return stops[static_cast<std::size_t>(in(0, static_cast<int>(stops.size()) - 1))];
      };
      Rational from = whole_from, to = whole_to;
      if (on_lattice_ ? !one_in(3) : one_in(3)) {
        const Rational a = one_in(2) ? whole_from : pick(), b = one_in(2) ? whole_to : pick();
        from = std::min(a, b), to = std::max(a, b);
        if (to - from < Rational(1, 8)) to = from + Rational(1, 4);
      }
      const Rational& at = axis == 0 ? parts_.origin.x : parts_.origin.y;
      text += std::string(axis == 0 ? "  x: [" : "  y: [") + text_of(Rational(scaled(from) + at)) + ", " +
              text_of(Rational(scaled(to) + at)) + "]\n";
    }
    return text;
  }

  /// Of x alone.
  std::string span() {
    const std::string both = box();
    return both.substr(0, both.find('\n') + 1);
  }

  std::string range(const std::string& name) {
    if (one_in(2)) return "  " + name + ": {angle: [0, 360 deg]}\n";
    const int from = on_lattice_ ? 45 * in(-4, 4) : in(-200, 200);
    return "  " + name + ": {angle: [" + std::to_string(from) + " deg, " +
           std::to_string(from + (on_lattice_ ? 90 * in(1, 4) : in(40, 360))) + " deg]}\n";
  }

  std::string mass() {
    if (!weights_) return one_in(5) ? ", mass: 1" : "";  // without gravity a mass is of no consequence
    return one_in(7) ? "" : ", mass: " + text_of(length(1, 8));
  }
  void point(const std::string& name, const std::string& form) { parts_.points.push_back({name, form}); }
  void fixed_point(const std::string& name, const Place& at) {
    parts_.points.push_back({name, {}, Place{scaled(at.x) + parts_.origin.x, scaled(at.y) + parts_.origin.y}});
  }
  void dyad(const std::string& name, const std::string& from, const std::string& to, const Leg& leg,
            std::string side_of = "") {
    if (side_of.empty()) side_of = side("left", "right");
    point(name, "{dyad: [" + from + ", " + to + "], lengths: [" + scaled_text(leg.crank) + ", " + scaled_text(leg.rod) +
                    "], side: " + side_of + "}");
    parts_.sides.push_back({"left", "right"});
  }
  void slider(const std::string& name, const std::string& base, const std::string& axis, const std::string& from,
              const Rational& length) {
    point(name, "{slider: [" + base + ", " + axis + "], from: " + from + ", length: " + scaled_text(length) +
                    ", side: " + side("ahead", "behind") + "}");
    parts_.sides.push_back({"ahead", "behind"});
  }
  using Names = std::vector<std::string>;
  void link(const std::string& name, const Names& points) { parts_.links.push_back({name, points, mass()}); }
  void weightless(const std::string& name, const Names& points) { parts_.links.push_back({name, points}); }
  void block(const std::string& name, const std::string& at) {
    parts_.links.push_back(
        {name, {at}, weights_ && one_in(2) ? ", mass: " + text_of(length()) + ", com: " + at + ", inertia: 0" : ""});
  }
  void revolute(const std::string& name, const std::string& from, const std::string& to, bool actuated = false) {
    parts_.joints.push_back({name, "revolute", from, to, name, {}, actuated, {}, {"radial: " + little(10)}});
    if (actuated) parts_.joints.back().clearance.emplace_back("angular: 0.5e-3 rad");
  }
  void prismatic(const std::string& name, const std::string& from, const std::string& to, const std::string& at,
                 const std::string& axis, bool guide, bool actuated = true) {
    parts_.joints.push_back({name, "prismatic", from, to, at, axis, actuated});
    std::vector<std::string>& clearance = parts_.joints.back().clearance;
    if (guide) clearance = {"gap: " + little(10), "half_length: " + scaled_text(Rational(1, one_in(2) ? 8 : 32))};
    if (actuated) clearance.push_back("axial: " + little(5));
  }
  std::string little(int value) const { return micrometres(value, parts_.unit); }

  std::string force() {
    if (on_lattice_ && !one_in(4)) {
      static const std::array<const char*, 8> round = {"[0, -100]", "[0, -100]", "[0, 10]",   "[100, 0]",
                                                       "[-10, 0]",  "[10, -10]", "[30, -40]", "[-40, -30]"};
      return round[static_cast<std::size_t>(in(0, 7))];
    }
    int x = 0, y = 0;
    do x = in(-90, 90), y = in(-90, 90);
    while (x == 0 && y == 0);
    return "[" + std::to_string(x) + ", " + std::to_string(y) + "]";
  }
  void load(const std::string& link, const std::string& at, bool couple) {
    parts_.loads.push_back("{link: " + link + ", at: " + at + ", force: " + force() +
                           (couple ? ", couple: " + text_of(number(-12, 12)) : "") + "}");
  }
  /// The load on the end effector, and now and then another one.
  void tool(const std::string& link, const std::string& at, const std::string& other, const std::string& other_at) {
    parts_.end_link = link, parts_.end_point = at;
    load(link, at, one_in(7));
    if (one_in(5)) load(other, other_at, one_in(7));
  }

  void five_bar(Family family) {
    Place a1 = first_base(), a2 = second_base(a1);
    Leg leg1 = leg(), leg2 = on_lattice_ && one_in(3) ? leg1 : leg();
    if (family == Family::mirrored) {
      a1 = {-length(1, 3), one_in(2) ? Rational(0) : number(-2, 2)}, a2 = {-a1.x, a1.y};
      leg2 = leg1;
    } else if (family == Family::kite) {
      leg1.rod = leg1.crank, leg2.rod = leg2.crank;
    } else if (family == Family::coaxial) {
      if (!one_in(4)) a2 = a1;
      if (!one_in(3)) leg2 = leg1;
    }
    fixed_point("A1", a1), fixed_point("A2", a2), point("P", "[x, y]");
    stops_about(a1, leg1), stops_about(a2, leg2);
    const std::string first = side("left", "right");
    dyad("B1", "A1", "P", leg1, first);
    dyad("B2", "A2", "P", leg2, one_in(4) ? first : first == "left" ? "right" : "left");
    link("A1B1", {"A1", "B1"}), link("B1P", {"B1", "P"}), link("PB2", {"P", "B2"}), link("B2A2", {"B2", "A2"});
    revolute("A1", "ground", "A1B1", true), revolute("B1", "A1B1", "B1P"), revolute("P", "B1P", "PB2");
    revolute("B2", "B2A2", "PB2"), revolute("A2", "ground", "B2A2", true);
    tool("PB2", "P", one_in(2) ? "A1B1" : "B1P", "B1");
  }

  void coupler() {
    const Place a1 = first_base(), a2 = second_base(a1);
    const Leg leg1 = leg(), leg2 = on_lattice_ && one_in(2) ? leg1 : leg();
    fixed_point("A1", a1), fixed_point("A2", a2), point("E", "[x, y]");
    stops_about(a1, leg1);
    dyad("B1", "A1", "E", leg1);
    point("C",
          "{on: [B1, E], offset: " + scaled_text(Place{length(1, 4), one_in(2) ? Rational(0) : number(-2, 2)}) + "}");
    dyad("B2", "A2", "C", leg2);
    link("A1B1", {"A1", "B1"}), link("B1E", {"B1", "E", "C"}), link("CB2", {"C", "B2"}), link("A2B2", {"A2", "B2"});
    revolute("A1", "ground", "A1B1", true), revolute("B1", "A1B1", "B1E"), revolute("C", "B1E", "CB2");
    revolute("B2", "A2B2", "CB2"), revolute("A2", "ground", "A2B2", true);
    tool("B1E", "E", "CB2", "B2");
  }

  void stacked() {
    const Place a1 = first_base(), a2 = second_base(a1), a3 = second_base(a2);
    const Leg leg1 = leg(), leg2 = on_lattice_ && one_in(2) ? leg1 : leg();
    fixed_point("A1", a1), fixed_point("A2", a2), fixed_point("A3", a3), point("P", "[x, y]");
    stops_about(a1, leg1), stops_about(a2, leg2);
    dyad("B1", "A1", "P", leg1), dyad("B2", "A2", "P", leg2);
    point("Q",
          "{on: [A2, B2], offset: " + scaled_text(Place{length(1, 4), one_in(2) ? Rational(0) : number(-2, 2)}) + "}");
    dyad("C", "A3", "Q", leg());
    link("A1B1", {"A1", "B1"}), link("B1P", {"B1", "P"}), link("PB2", {"P", "B2"}), link("crank", {"A2", "B2", "Q"});
    link("QC", {"Q", "C"}), link("A3C", {"A3", "C"});
    revolute("A1", "ground", "A1B1", true), revolute("B1", "A1B1", "B1P"), revolute("P", "B1P", "PB2");
    revolute("B2", "crank", "PB2"), revolute("A2", "ground", "crank"), revolute("Q", "crank", "QC");
    revolute("C", "A3C", "QC"), revolute("A3", "ground", "A3C", true);
    tool("PB2", "P", "crank", "Q");
  }

  std::string rail() {
    static const std::array<const char*, 7> round = {"[0, 1]", "[1, 0]",  "[0, 1]", "[1, 0]",
                                                     "[1, 1]", "[-1, 1]", "[3, 4]"};
    if (on_lattice_) return round[static_cast<std::size_t>(in(0, 6))];
    return "[" + std::to_string(in(-20, 20)) + ", " + std::to_string(in(1, 20)) + "]";
  }

  void two_sliders(bool one_rail) {
    const Place r1 = first_base(), r2 = one_rail ? r1 : second_base(r1);
    const std::string axis1 = one_rail ? side("[1, 0]", "[0, 1]") : rail();
    const std::string axis2 = one_rail || one_in(2) ? axis1 : rail();
    const Rational first = length(1, 4), second = one_in(3) ? length(1, 4) : first;
    fixed_point("R1", r1), fixed_point("R2", r2), point("P", "[x, y]");
    stops_of_radii(r1, {0, first, second}), stops_of_radii(r2, {0, first, second});
    slider("S1", "R1", axis1, "P", first), slider("S2", "R2", axis2, "P", second);
    block("block1", "S1"), link("S1P", {"S1", "P"}), link("PS2", {"P", "S2"}), block("block2", "S2");
    prismatic("G1", "ground", "block1", "S1", axis1, true);
    revolute("S1", "block1", "S1P"), revolute("P", "S1P", "PS2"), revolute("S2", "block2", "PS2");
    prismatic("G2", "ground", "block2", "S2", axis2, true);
    tool("PS2", "P", "S1P", "S1");
  }

  void prrr_r() {
    const Place r1 = first_base(), a2 = one_in(4) ? r1 : second_base(r1);
    const std::string axis = rail();
    const Leg leg2 = leg();
    const Rational rod = on_lattice_ && one_in(3) ? leg2.rod : length();
    fixed_point("R1", r1), fixed_point("A2", a2), point("P", "[x, y]");
    stops_about(a2, leg2), stops_of_radii(r1, {0, rod});
    slider("S1", "R1", axis, "P", rod);
    dyad("B2", "A2", "P", leg2);
    block("block1", "S1"), link("S1P", {"S1", "P"}), link("PB2", {"P", "B2"}), link("A2B2", {"A2", "B2"});
    prismatic("G1", "ground", "block1", "S1", axis, true);
    revolute("S1", "block1", "S1P"), revolute("P", "S1P", "PB2"), revolute("B2", "A2B2", "PB2");
    revolute("A2", "ground", "A2B2", true);
    tool("PB2", "P", "A2B2", "B2");
  }

  /// Revolute at the base, prismatic, ends at `foot`: a cylinder with its rod.
  void telescope(const std::string& n, const Place& base, const std::string& foot) {
    fixed_point("A" + n, base);
    stops_of_radii(base, {0, Rational(1, 2), 1});
    if (weights_ && one_in(2)) {
      point("G" + n, "{on: [A" + n + ", " + foot + "], offset: [" + scaled_text(Rational(1, 4)) + ", 0]}");
      parts_.links.push_back({"cylinder" + n, {"A" + n}, ", mass: 1, com: G" + n + ", inertia: 1/100"});
    } else {
      weightless("cylinder" + n, {"A" + n});
    }
    weightless("rod" + n, {foot});
    revolute("A" + n, "ground", "cylinder" + n);
    prismatic("S" + n, "cylinder" + n, "rod" + n, foot, "[A" + n + ", " + foot + "]", one_in(2));
  }

  void rprpr() {
    const Place a1 = first_base(), a2 = second_base(a1);
    point("P", "[x, y]");
    telescope("1", a1, "P"), telescope("2", a2, "P");
    revolute("P", "rod1", "rod2");
    tool("rod2", "P", "cylinder1", "A1");
  }

  void rrrpr() {
    const Place a1 = first_base(), a2 = second_base(a1);
    const Leg leg1 = leg();
    fixed_point("A1", a1), point("P", "[x, y]");
    stops_about(a1, leg1);
    dyad("B1", "A1", "P", leg1);
    link("A1B1", {"A1", "B1"}), link("B1P", {"B1", "P"});
    revolute("A1", "ground", "A1B1", true), revolute("B1", "A1B1", "B1P");
    telescope("2", a2, "P");
    revolute("P", "B1P", "rod2");
    tool("B1P", "P", "A1B1", "B1");
  }

  void three_rpr() {
    std::array<Place, 3> bases = {place(4), place(4), place(4)}, feet = {place(2), place(2), place(2)};
    if (on_lattice_ && one_in(2)) {
      const Rational w = length(2, 4), h = length(2, 4);
      bases = {Place{-w, -h}, Place{w, -h}, Place{0, h}};
    }
    if (one_in(5)) feet[1] = feet[0];
    if (one_in(10)) bases[1] = bases[0];
    point("P", "[x, y]");
    for (std::size_t i = 0; i < 3; ++i)
      point("B" + std::to_string(i + 1),
            "[" + shifted("x", scaled(feet[i].x)) + ", " + shifted("y", scaled(feet[i].y)) + "]");
    platform({"P", "B1", "B2", "B3"});
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string n = std::to_string(i + 1);
      telescope(n, bases[i], "B" + n);
      revolute("B" + n, "rod" + n, "platform");
    }
    tool("platform", "P", "platform", "B1");
  }

  void platform(const Names& points) {
    parts_.links.push_back({"platform", points, weights_ ? ", mass: 1, com: P, inertia: 1/10" : ""});
  }

  /// At a given orientation, on three elbows.
  void three_rrr() {
    std::array<Place, 3> bases = {Place{number(-5, -3), number(-4, -2)}, Place{number(3, 5), number(-4, -2)},
                                  Place{number(-1, 1), number(3, 5)}};
    std::array<Place, 3> feet = {place(2), place(2), place(2)};
    if (one_in(4)) feet[1] = feet[0];
    const Leg first = {length(2, 5), length(2, 5)};
    point("P", "[x, y]");
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string n = std::to_string(i + 1);
      fixed_point("A" + n, bases[i]);
      stops_of_radii(bases[i], {0, 1});
      point("C" + n, "[" + shifted("x", scaled(feet[i].x)) + ", " + shifted("y", scaled(feet[i].y)) + "]");
      dyad("B" + n, "A" + n, "C" + n, one_in(2) ? first : Leg{length(2, 5), length(2, 5)});
    }
    platform({"P", "C1", "C2", "C3"});
    for (int i = 1; i <= 3; ++i) {
      const std::string n = std::to_string(i);
      link("a" + n, {"A" + n, "B" + n}), link("b" + n, {"B" + n, "C" + n});
      revolute("A" + n, "ground", "a" + n, true), revolute("B" + n, "a" + n, "b" + n);
      revolute("C" + n, "b" + n, "platform");
    }
    tool("platform", "P", "platform", "C1");
  }

  /// 5R over the angles of its motors.
  void motor_angles() {
    const Place a1 = first_base(), a2 = second_base(a1);
    Leg leg1 = leg(), leg2 = on_lattice_ && one_in(3) ? leg1 : leg();
    fixed_point("A1", a1), fixed_point("A2", a2);
    point("B1", on_circle(leg1.crank, "theta", a1)), point("B2", on_circle(leg2.crank, "psi", a2));
    dyad("P", "B1", "B2", {leg1.rod, leg2.rod});
    link("A1B1", {"A1", "B1"}), link("B1P", {"B1", "P"}), link("PB2", {"P", "B2"}), link("B2A2", {"B2", "A2"});
    revolute("A1", "ground", "A1B1", true), revolute("B1", "A1B1", "B1P"), revolute("P", "B1P", "PB2");
    revolute("B2", "B2A2", "PB2"), revolute("A2", "ground", "B2A2", true);
    tool("PB2", "P", one_in(2) ? "A1B1" : "B1P", "B1");
  }

  /// 3-RPR over x and its orientation.
  void turning_platform() {
    const std::array<Place, 3> bases = {Place{-length(2, 4), -length(1, 4)}, Place{length(2, 4), -length(1, 4)},
                                        Place{number(-1, 1), length(2, 5)}};
    const Rational height = number(-1, 1);
    point("P", "[x, " + text_of(Rational(scaled(height) + parts_.origin.y)) + "]");
    parts_.frames = "  plate: {at: P, turned: phi}\n";
    for (int i = 1; i <= 3; ++i) point("B" + std::to_string(i), "{in: plate, place: " + scaled_text(place(2)) + "}");
    platform({"P", "B1", "B2", "B3"});
    for (int i = 1; i <= 3; ++i) {
      const std::string n = std::to_string(i);
      telescope(n, bases[static_cast<std::size_t>(i - 1)], "B" + n);
      revolute("B" + n, "rod" + n, "platform");
    }
    tool("platform", "P", "platform", "B1");
  }

  std::string on_circle(const Rational& radius, const std::string& angle = "theta", const Place& centre = {}) {
    const auto along = [&](const Rational& at, const char* function) {
      const std::string turned = scaled_text(radius) + "*" + function + "(" + angle + ")";
      return at == 0 ? turned : text_of(at) + " + " + turned;
    };
    return "[" + along(scaled(centre.x) + parts_.origin.x, "cos") + ", " +
           along(scaled(centre.y) + parts_.origin.y, "sin") + "]";
  }

  void four_bar() {
    const Rational crank = length(1, 4);
    const Place d = {length(1, 6), one_in(2) ? Rational(0) : number(-2, 2)};
    Leg rest = {length(2, 6), length(2, 6)};
    if (one_in(3)) rest.rod = crank;  // a deltoid or, with the next, a parallelogram
    if (one_in(4)) rest.crank = d.x;
    fixed_point("A", {0, 0}), fixed_point("D", d), point("B", on_circle(crank));
    dyad("C", "B", "D", rest);
    link("AB", {"A", "B"}), link("BC", {"B", "C"}), link("CD", {"C", "D"});
    revolute("A", "ground", "AB", true), revolute("B", "AB", "BC"), revolute("C", "BC", "CD");
    revolute("D", "ground", "CD");
    tool("CD", "C", "BC", "B");
  }

  void slider_crank() {
    const Rational crank = length(1, 4), rod = one_in(5) ? crank : length(1, 6);
    const std::string axis = rail();
    fixed_point("A", {0, 0}), fixed_point("R", {0, one_in(2) ? Rational(0) : number(-2, 2)});
    point("B", on_circle(crank));
    slider("C", "R", axis, "B", rod);
    link("AB", {"A", "B"}), link("BC", {"B", "C"}), block("block", "C");
    revolute("A", "ground", "AB", true), revolute("B", "AB", "BC"), revolute("C", "BC", "block");
    prismatic("G", "ground", "block", "C", axis, true, false);
    tool("block", "C", "BC", "B");
  }

  std::mt19937& random_;
  bool on_lattice_, weights_;
  int denominator_ = 4;
  Rational scale_ = 1, reach_ = 0;
  std::array<std::vector<Rational>, 2> stops_;
  DesignParts parts_;
};

}  // namespace

std::string to_string(Family family) {
  static const std::array<const char*, all_families.size()> names = {"5R",
                                                                     "mirrored 5R",
                                                                     "kite 5R",
                                                                     "coaxial 5R",
                                                                     "coupler five-bar",
                                                                     "stacked 5R",
                                                                     "PRRRP",
                                                                     "one rail",
                                                                     "PRRR-R",
                                                                     "RRRPR",
                                                                     "RPRPR",
                                                                     "3-RPR",
                                                                     "four-bar",
                                                                     "slider-crank",
                                                                     "3-RRR",
                                                                     "5R over angles",
                                                                     "3-RPR turning"};
  return names[static_cast<std::size_t>(family)];
}

DesignParts design_parts(std::mt19937& random, Family family, bool on_lattice, bool weights, const Standing& standing) {
  return Writer(random, on_lattice, weights, standing).write(family);
}

std::string lattice_design(std::mt19937& random, Family family, bool weights) {
  return text_of(design_parts(random, family, true, weights));
}

std::string generic_design(std::mt19937& random, Family family, bool weights) {
  return text_of(design_parts(random, family, false, weights));
}

}  // namespace clearloci::test
