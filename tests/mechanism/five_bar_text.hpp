// A correct mechanism file to spoil in one place at a time.
#pragma once

#include <stdexcept>
#include <string>

namespace clearloci::mechanism {

inline const std::string five_bar_text = R"(format: 1
name: Five-bar
space: planar
parameters:
  L: 0.5
  d: L
workspace:
  x: [-0.5, 1.0]
  y: [-1.0, 1.0]
points:
  A1: [0, 0]
  A2: [d, 0]
  P: [x, y]
  B1: {dyad: [A1, P], lengths: [L, L], side: right}
  B2: {dyad: [A2, P], lengths: [L, L], side: left}
links:
  A1B1: {points: [A1, B1], mass: 1}
  B1P: {points: [B1, P], mass: 1}
  PB2: {points: [P, B2], mass: 1}
  B2A2: {points: [B2, A2], mass: 1}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}
  B1: {revolute: [A1B1, B1P], at: B1, clearance: {radial: 10e-6}}
  P: {revolute: [B1P, PB2], at: P}
  B2: {revolute: [B2A2, PB2], at: B2}
  A2: {revolute: [ground, B2A2], at: A2, actuated: true}
end_effector: {link: PB2, at: P}
loads:
  - {link: PB2, at: P, force: [0, -100]}
)";

/// The text with its first `from` replaced.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("'" + from + "' is not in the text");
  return text.replace(at, from.size(), to);
}

}  // namespace clearloci::mechanism
