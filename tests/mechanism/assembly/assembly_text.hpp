// Drawings for the tests of mechanism/assembly, and where their points are.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/posture_sample.hpp"
#include "mechanism/read.hpp"

namespace clearloci::mechanism {

/// A four-bar of 62 and 75 mm: A and D stand, B is the crank's pin. `%KEY%` of a change replaces a line that begins so.
inline std::string drawn_four_bar() {
  return "format: 1\n"
         "units: {length: mm}\n"
         "workspace: {theta: {angle: [0, 360 deg], of: AB}}\n"
         "drawn:\n"
         "  A: [0, 0]\n"
         "  B: [30, 40]\n"
         "  C: [120, 90]\n"
         "  D: [100, 0]\n"
         "links:\n"
         "  AB: {points: [A, B]}\n"
         "  BC: {points: [B, C]}\n"
         "  CD: {points: [C, D]}\n"
         "joints:\n"
         "  A: {revolute: [ground, AB], at: A, actuated: true}\n"
         "  B: {revolute: [AB, BC], at: B}\n"
         "  C: {revolute: [BC, CD], at: C}\n"
         "  D: {revolute: [ground, CD], at: D}\n"
         "end_effector: {link: CD, at: C}\n"
         "loads: [{link: CD, at: C, force: [0, -100]}]\n";
}

/// The text with one line in place of another.
inline std::string with_line(std::string text, const std::string& line, const std::string& instead) {
  const std::size_t at = text.find(line);
  EXPECT_NE(at, std::string::npos) << line;
  if (at != std::string::npos) text.replace(at, line.size(), instead);
  return text;
}

using Places = std::map<std::string, std::array<double, 3>>;

/// The points that the file names, m; nothing where it does not close.
inline std::optional<Places> places_at(const Mechanism& m, const std::vector<double>& pose) {
  Places places;
  const auto placed = sample_points(m, pose);
  for (std::size_t p = 0; p < placed.size(); ++p) {
    if (!placed[p]) return std::nullopt;
    if (!m.points[p].auxiliary) places[m.points[p].name] = *placed[p];
  }
  return places;
}

inline double apart(const std::array<double, 3>& p, const std::array<double, 3>& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// Whether rounding moves no point: at the end of a reach it moves one by its square root.
inline bool is_steady(const Mechanism& m, std::vector<double> pose) {
  constexpr double rounding = 1e-13, still = 1e-10;
  const auto here = places_at(m, pose);
  for (double& value : pose) value += rounding;
  const auto there = places_at(m, pose);
  if (here.has_value() != there.has_value()) return false;
  if (!here) return true;
  for (const auto& [name, place] : *here)
    if (apart(place, there->at(name)) > still) return false;
  return true;
}

/// Points of one name are in one place, pose by pose; returns how many poses close.
inline int expect_same_places(const Mechanism& one, const Mechanism& other, std::size_t poses, double within) {
  int closed = 0;
  for (const std::vector<double>& pose : spread_poses(one, poses)) {
    if (!is_steady(one, pose)) continue;
    const auto a = places_at(one, pose), b = places_at(other, pose);
    EXPECT_EQ(a.has_value(), b.has_value());
    if (!a || !b) continue;
    ++closed;
    for (const auto& [name, place] : *a) {
      const auto same = b->find(name);
      if (same == b->end()) continue;
      EXPECT_LT(apart(place, same->second), within) << name;
    }
  }
  return closed;
}

}  // namespace clearloci::mechanism
