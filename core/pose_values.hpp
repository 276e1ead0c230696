// A program over the pose (core/pose_program.hpp) in floating point, at single poses. Blocks of unknowns are solved by
// Newton's iteration: u <- u - J(q, u)^-1 g(q, u). Which solution is meant is told by continuation from the posture of
// the blocks, or by the caller. Nothing is proven here.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/pose_program.hpp"

namespace clearloci::inline core {

/// The unknowns of all blocks one after another.
using BlockUnknowns = std::vector<double>;
/// Of a pose: nearby values of the unknowns; nothing where the sheet does not reach it.
using BlockStart = std::function<std::optional<BlockUnknowns>(std::span<const double>)>;

class PoseValues {
 public:
  /// `program` must outlive it. One a thread.
  explicit PoseValues(const PoseProgram& program);

  /// Every step at a pose. False where some root is of no positive number, some divisor is zero, or a block does not
  /// close. `start`: of the blocks; by continuation where it is empty.
  bool run(std::span<const double> pose, const BlockStart& start = {});
  /// The same with these values of the unknowns, whether the blocks close or not.
  bool put(std::span<const double> pose, const BlockUnknowns& unknowns);
  double operator[](int step) const { return registers_[static_cast<std::size_t>(step)]; }

  /// Of a program with blocks: their unknowns at a pose, by continuation from the posture `near` along the straight
  /// way, else from that posture a turn of an angle before or behind, else coordinate by coordinate. Nothing where no
  /// such way leads there.
  std::optional<BlockUnknowns> followed(std::span<const double> pose);
  /// All steps, by Newton's iteration from `unknowns`, which are improved. False where it does not converge at once.
  bool close(std::span<const double> pose, BlockUnknowns& unknowns);
  /// The sign of the product of the blocks' det J, where they were closed last.
  int orientation() const { return orientation_; }
  /// Of the last close: how far it moved an unknown at most, and the last of its moves over the one before.
  double moved() const { return moved_; }
  double contraction() const { return contraction_; }

 private:
  bool run_steps(std::size_t from, std::size_t to, std::span<const double> pose);
  bool close(std::size_t block, std::span<const double> pose, std::span<double> unknowns);
  /// The same, given up as soon as a move is more than this part of the one before.
  bool close_quickly(std::span<const double> pose, BlockUnknowns& unknowns, double part);
  std::optional<BlockUnknowns> followed(std::span<const double> from, BlockUnknowns unknowns,
                                        std::span<const double> to);
  std::optional<BlockUnknowns> followed_round(BlockUnknowns near, std::span<const double> pose);

  const PoseProgram& program_;
  std::vector<double> registers_;
  int orientation_ = 1;
  double moved_ = 0, contraction_ = 0;
  double most_contraction_ = std::numeric_limits<double>::infinity();
};

/// What the unknowns' accuracy is measured by: the largest of them and of the blocks' lengths.
double size_of(const PoseProgram& program, std::span<const double> unknowns);

/// x with A x = b, by Gauss's elimination with partial pivoting; A and b are used up. `sign`: that of det A. False
/// where A is singular to rounding.
bool solve_dense(std::vector<double>& a, std::span<double> b, int* sign = nullptr);

}  // namespace clearloci::inline core
