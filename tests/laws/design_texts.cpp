#include "tests/laws/design_texts.hpp"

namespace clearloci::test {

std::string FiveBarDesign::text() const {
  const auto pair = [](const std::array<std::string, 2>& v) { return "[" + v[0] + ", " + v[1] + "]"; };
  std::string text = "format: 1\nname: random 5R\nspace: planar\nworkspace:\n  x: [" + box[0] + ", " + box[1] +
                     "]\n  y: [" + box[2] + ", " + box[3] + "]\npoints:\n  A1: " + pair(a1) + "\n  A2: " + pair(a2) +
                     "\n  P: [x, y]\n  B1: {dyad: [A1, P], lengths: [" + proximal1 + ", " + distal1 +
                     "], side: " + side1 + "}\n  B2: {dyad: [A2, P], lengths: [" + proximal2 + ", " + distal2 +
                     "], side: " + side2 + "}\n";
  text += R"(links:
  A1B1: {points: [A1, B1], mass: 1}
  B1P:  {points: [B1, P],  mass: 1}
  PB2:  {points: [P, B2],  mass: 2}
  B2A2: {points: [B2, A2], mass: 1}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}
  B1: {revolute: [A1B1, B1P],    at: B1, clearance: {radial: 10e-6}}
  P:  {revolute: [B1P, PB2],     at: P,  clearance: {radial: 10e-6}}
  B2: {revolute: [B2A2, PB2],    at: B2, clearance: {radial: 10e-6}}
  A2: {revolute: [ground, B2A2], at: A2, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}
end_effector: {link: PB2, at: P}
)";
  text += "loads:\n  - {link: PB2, at: P, force: " + pair(force) + "}\n";
  if (!gravity[0].empty()) text += "gravity: " + pair(gravity) + "\n";
  return text;
}

namespace {

/// Bases, lengths and now and then sides of the box are multiples of 1/4, legs often alike. The box holds some of the
/// workspace whatever is drawn: either leg reaches from at most 1/2 to at least 1.
FiveBarDesign five_bar_on_the_lattice(std::mt19937& random, bool with_weights) {
  const auto in = [&random](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const auto quarters = [&](int low, int high) { return std::to_string(in(low, high)) + "/4"; };
  FiveBarDesign design;
  design.a1 = {quarters(-1, 1), quarters(-1, 1)};
  design.a2 = {quarters(2, 3), in(0, 1) == 0 ? design.a1[1] : quarters(-1, 1)};
  for (std::string* length : {&design.proximal1, &design.distal1, &design.proximal2, &design.distal2})
    *length = quarters(2, 4);
  if (in(0, 1) == 0) design.distal1 = design.proximal1;
  if (in(0, 1) == 0) design.proximal2 = design.proximal1, design.distal2 = design.distal1;
  design.side1 = in(0, 1) == 0 ? "left" : "right";
  design.side2 = in(0, 1) == 0 ? "left" : "right";
  static const std::array<std::array<std::string, 2>, 5> loads = {
      {{"0", "-100"}, {"0", "-100"}, {"100", "0"}, {"30", "-40"}, {"-50", "50"}}};
  design.force = loads[static_cast<std::size_t>(in(0, 4))];
  design.box = {"-7/4", "5/2", "-2", "2"};
  const int side = in(0, 7);
  if (side < 4) design.box[static_cast<std::size_t>(side)] = quarters(side % 2 == 0 ? -4 : 2, side % 2 == 0 ? -1 : 4);
  if (with_weights) design.gravity = {"0", "-9.81"};
  return design;
}

}  // namespace

FiveBarDesign random_five_bar(std::mt19937& random, bool with_weights) {
  if (random() % 2 == 0) return five_bar_on_the_lattice(random, with_weights);
  const auto in = [&random](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const auto quotient = [&](int low, int high, int denominator) {
    return std::to_string(in(low, high)) + "/" + std::to_string(denominator);
  };
  FiveBarDesign design;
  design.a1 = {quotient(-6, 6, 20), quotient(-6, 6, 20)};
  design.a2 = {quotient(7, 16, 20), quotient(-6, 6, 20)};
  // The longer of two lengths at most 1: everything stays inside the box, up to its sides.
  for (std::string* length : {&design.proximal1, &design.distal1, &design.proximal2, &design.distal2}) {
    *length = quotient(24, 50, 60);
  }
  if (in(0, 4) == 0) design.distal1 = design.proximal1;
  if (in(0, 4) == 0) {
    design.proximal2 = design.proximal1;
    design.distal2 = design.distal1;
  }
  if (in(0, 4) == 0) design.a2[1] = design.a1[1];
  design.side1 = in(0, 1) == 0 ? "left" : "right";
  design.side2 = in(0, 1) == 0 ? "left" : "right";
  do {
    design.force = {std::to_string(in(-9, 9) * 10), std::to_string(in(-9, 9) * 10)};
  } while (design.force[0] == "0" && design.force[1] == "0");
  if (in(0, 3) == 0) design.force[static_cast<std::size_t>(in(0, 1))] = "0";
  if (design.force[0] == "0" && design.force[1] == "0") design.force[1] = "-100";
  if (with_weights) design.gravity = {"0", "-9.81"};
  return design;
}

}  // namespace clearloci::test
