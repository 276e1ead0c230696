// The steps of a program over the pose (core/pose_program.hpp) as enclosures over a cell. Blocks of unknowns are
// enclosed by Krawczyk's operator with the pose as a parameter: from values u_m at the cell's middle Newton's iteration
// with forms
//     u_0(q) <- u_0(q) - Y g(q, u_0(q)),   Y = J(q_m, u_m)^-1 to rounding
// gives a polynomial in the cell's coordinates, and where for a box D around zero
//     -Y g(q, u_0(q)) + (1 - Y J(q, u_0(q) + D)) D   lies inside D
// there is exactly one solution u(q) in u_0(q) + D at every pose of the cell, it is in u_0(q) plus that, and J is
// regular on it (method.md section 14; Neumaier, Interval Methods for Systems of Equations, section 5.1).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/pose_program.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/sheet/pose_chart.hpp"

namespace clearloci::loci::pose {

template <class Form>
class PoseForms {
 public:
  enum class Outcome { complete, in_doubt, outside };
  /// Where an unknown is the only one: u_0 and the half width of D.
  struct Unique {
    Form middle;
    double radius = 0;
  };

  /// `program` must outlive it.
  explicit PoseForms(const core::PoseProgram& program);

  /// Every step. `starts`: the unknowns of all blocks at the cell's middle, one after another. `boundaries`: takes the
  /// squares that may be zero in the cell, whose roots are anything up to the largest; without it the first ends the
  /// run.
  Outcome run(const PoseChart& chart, const PoseBox& box, std::span<const double> starts = {},
              std::vector<Form>* boundaries = nullptr);
  /// The steps up to the end of the last block, with these unknowns of all blocks, at a single pose.
  Outcome put(const Pose& at, std::span<const Form> unknowns);
  /// Of the last run in doubt: what may vanish. Where a block is at its dead centre, how far J varies.
  const Form& doubt() const { return doubt_; }

  /// Over one coordinate q, of a program whose first block has its rates: unknown k of it as the parameter, from
  /// `start`[k] - half to `start`[k] + half, along the first of the forms' coordinates. True where q and the other
  /// unknowns are one function of it; then they are in the registers, and `turn` says where they are the only ones.
  bool turn(double q, std::span<const double> start, std::size_t k, double half);
  /// In the place of unknown k that of q.
  const std::vector<Unique>& turned() const { return turned_; }
  const Form& turned_coordinate() const { return turned_coordinate_; }
  /// The sign of det J of the first block, over all that the registers enclose; 0: it may vanish.
  int orientation() const;

  Form& operator[](int step) { return registers_[static_cast<std::size_t>(step)]; }
  const Form& operator[](int step) const { return registers_[static_cast<std::size_t>(step)]; }
  bool varies(int step) const { return varies_[static_cast<std::size_t>(step)] != 0; }
  /// Of all blocks' unknowns, one after another, of the last run that was complete.
  const std::vector<Unique>& unique() const { return unique_; }

 private:
  Outcome run_steps(int from, int to, const PoseChart& chart, const PoseBox& box, std::vector<Form>* boundaries);
  Outcome close(const core::PoseProgram::Block& block, const PoseChart& chart, const PoseBox& box,
                std::span<const double> start);
  bool contracts(const std::vector<int>& jacobian, const std::vector<double>& inverse, const std::vector<Form>& moved,
                 const std::vector<double>& radius, std::vector<double>& rest);
  template <class Put>
  Outcome krawczyk(const std::vector<int>& jacobian, const std::vector<int>& equations, const Put& put,
                   std::vector<Form>& middle, std::vector<Form>& result, std::vector<Unique>& unique);

  const core::PoseProgram* program_;
  std::vector<Form> registers_;
  std::vector<char> varies_;  ///< registers that do with the pose; the others are numbers
  std::vector<Unique> unique_, turned_;
  const Form* coordinate_ = nullptr;  ///< in the place of a chart's
  Form doubt_, turned_coordinate_;
};

extern template class PoseForms<Affine>;
extern template class PoseForms<FlatAffine>;

}  // namespace clearloci::loci::pose
