// Mechanisms beside which tasks, trajectories and arguments are read: of the plane over two lengths, over one angle,
// and a slice of space.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/read.hpp"

namespace clearloci::fuzz {

inline constexpr std::array<const char*, 3> sample_files = {
    CLEARLOCI_SOURCE_DIR "/examples/pick_and_place/manipulator.yaml",
    CLEARLOCI_SOURCE_DIR "/examples/slider_crank.yaml",
    CLEARLOCI_SOURCE_DIR "/examples/gough_stewart_slice.yaml",
};

inline const std::vector<mechanism::Mechanism>& sample_mechanisms() {
  static const std::vector<mechanism::Mechanism> mechanisms = [] {
    std::vector<mechanism::Mechanism> read;
    for (const char* file : sample_files) read.push_back(mechanism::read_mechanism(file));
    return read;
  }();
  return mechanisms;
}

}  // namespace clearloci::fuzz
