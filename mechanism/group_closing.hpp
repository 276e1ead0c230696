// Where the points of groups are at a pose, in floating point: the assembly that is reached from the file's posture
// (core/pose_values.hpp). No result rests on it: others prove, or improve by means of their own, what it finds.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/pose_program.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

class GroupClosing {
 public:
  /// `sides`: one a point of dyad_points. The mechanism must outlive this.
  GroupClosing(const Mechanism& mechanism, const std::vector<int>& sides);
  GroupClosing(GroupClosing&&) noexcept;
  GroupClosing& operator=(GroupClosing&&) noexcept;
  ~GroupClosing();

  /// The coordinates of the groups' points, m, one after another; nothing where the assembly does not reach the pose.
  std::optional<std::vector<double>> at(std::span<const double> pose);

  /// Of the last group's distances at a pose, m, whether it closes there or not.
  std::optional<std::vector<double>> lengths(std::span<const double> pose);

  /// How the last group's equations are met by its posture, and where Newton's iteration leads from there.
  struct Posture {
    bool built = false;                         ///< what the group is built on closes at the posture's pose
    std::optional<std::vector<double>> closed;  ///< as at(); nothing where it leads nowhere
    double moved = 0;                           ///< by how much a coordinate changes at most, m
    std::vector<double> lengths, wanted;        ///< of its distances, m
    std::vector<std::size_t> dependent;         ///< equations that do not hold its points, at a dead centre
  };
  Posture posture();

 private:
  struct Program;
  std::unique_ptr<Program> program_;
};

/// The points as steps, with the groups as blocks.
core::PoseProgram group_program(const Mechanism& mechanism, const std::vector<int>& sides);

/// Where the unknowns of the last group can be at a pose in a working mode: its points are no farther from known ones
/// than the lengths between them add up to. Nothing where known points are not placed.
std::optional<std::vector<std::array<double, 2>>> group_reach(const Mechanism& mechanism,
                                                              const std::vector<double>& pose,
                                                              const std::vector<int>& sides);

/// The points up to those of a group, for what is asked of their places alone.
Mechanism up_to_group(Mechanism mechanism, std::size_t group);

/// How many unknowns the groups have together.
std::size_t group_unknowns(const Mechanism& mechanism);

/// The same with the unknowns of its groups as free coordinates behind its own, "xB", "yB", within a metre of the
/// posture: all points have formulas then, and what closes the groups is left to the caller.
Mechanism with_open_groups(Mechanism mechanism);

/// Throws core::InputError for a mechanism with groups: what is asked for needs closed forms. `what`: "loci over two
/// coordinates are traced".
void require_closed_forms(const Mechanism& mechanism, const std::string& what, const std::string& mend);

}  // namespace clearloci::mechanism
