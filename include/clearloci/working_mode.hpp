// What the values of a place and the signs of a working mode belong to.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace clearloci::inline core {

/// What choosing the other sign of a root means.
enum class RootRole {
  working_mode,  ///< the other assembly of a dyad or slider: both signs are postures
  length,        ///< a distance: always the positive root
};

/// Sign of every root of the tower, +1 (left, ahead) or -1 (right, behind); +1 for roots of role `length`.
using WorkingMode = std::vector<int>;

/// One root of the tower by its names.
struct RootNames {
  std::string name;   ///< "s1"
  std::string point;  ///< that it places: "B1"
  RootRole role = RootRole::working_mode;
  std::array<std::string, 2> sides = {"left", "right"};  ///< what the signs + and - are called

  bool operator==(const RootNames&) const = default;
};

struct TowerNames {
  std::vector<std::string> coordinates;  ///< the free ones, e.g. {"x", "y"}
  std::vector<RootNames> roots;          ///< a WorkingMode has one sign for each

  bool operator==(const TowerNames&) const = default;
};

/// {"B1": "right", "B2": "left"} in the order of the roots, without those of role `length`.
std::vector<std::pair<std::string, std::string>> describe_mode(const TowerNames& tower, const WorkingMode& mode);

}  // namespace clearloci::inline core
