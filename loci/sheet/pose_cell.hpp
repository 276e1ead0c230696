// Whether every pose of a cell is good for a task: it can be assembled, |A| does not vanish, and no reaction does or is
// too small. With A_m the matrix at the cell's middle, C = A_m^-1 to rounding and w_m = C b_m:
//     E = I - C A,                |E| s <= beta s < s for some s > 0:  A is regular in every pose of the cell
//     r = b - A w_m,              w - w_m = C r + E (w - w_m),  |E (w - w_m)| <= |E| |C r|_s / (1 - beta)
//     g = c w + d, lambda = C^T c_m:   g = d + lambda b + (c - A^T lambda) w_m + (c - A^T lambda) (w - w_m)
// The last product is one of two small things, so that what is known of g shrinks with the square of the cell; with C r
// in the place of w - w_m its terms are added up before they are bounded, and what is left shrinks with the cube. A
// vector f is kept from zero by n . f for one direction n, under all loads between two that it is kept under. Entries
// are enclosed by affine forms (affine.hpp).
//
// Where |A| may vanish, X A Y = [I + E, p; q, m] at no pose far from [I, 0; 0, m], with X, Y regular, splits off what
// makes it vanish: with z = Y^-1 w, y = X b
//     |A| = 0  exactly where  s = m - q (I + E)^-1 p  does,   s z_n = N = y_n - q (I + E)^-1 y_1
//     s g = s d + (c Y)_n N + (c Y)_1 (I + E)^-1 (s y_1 - p N)
// so that signs of reactions are known on both sides of s = 0 where s g does not vanish (pose_sides.cpp).
//
// Where the workspace boundary Q = 0 passes, the root of Q is any number from 0 to that of Q's largest value: what
// holds for all of them holds in every pose of the cell with Q >= 0, and where Q < 0 for certain there is none.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/pose_statics.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/sheet/half_space.hpp"
#include "loci/sheet/pose_chart.hpp"
#include "loci/sheet/pose_forms.hpp"
#include "loci/sheet/pose_point.hpp"

namespace clearloci::loci::pose {

/// What keeps a pose from being good: `demand` is that of core::PoseStatics, with `Doubt::demand`, and with
/// `Doubt::zero`, where a size that is below its least perhaps vanishes.
enum class Doubt { none, workspace, singularity, demand, zero };

/// What a cell says of itself, whatever its forms.
struct CellAnswers {
  enum class State { proven, in_doubt, outside };
  /// Of every demand and, last, of |A| what is the same all over a zone; 0 where it is not known.
  ///     of one component, and of |A|          its sign, +1 or -1
  ///     of more components that have a least size, kept     +1
  ///     of a size that is below the least     `below` times of that
  using Signs = std::vector<int>;
  static constexpr int below = 2;
  /// What is known of a cell in doubt, under one load.
  struct Known {
    bool free = false;                        ///< it is proven after all
    bool outside = false;                     ///< as of `enter`
    bool beyond = false;                      ///< the second part is `outside`
    Signs signs;                              ///< in all of the cell
    std::vector<std::pair<Doubt, int>> open;  ///< all that may vanish in it
    /// Parts of the cell that are proven, on the two sides of what may vanish: either may be empty.
    std::array<HalfSpace, 2> parts;
    std::array<Signs, 2> of_parts;
  };
  /// A single pose in floating point.
  using At = PosePoint::At;
  /// The smallest size under loads between the first and the last.
  static double size_of(const std::vector<std::vector<double>>& by_load);
  static Signs signs_of(const core::PoseStatics& statics, const At& at);
};

/// `Form`: of second order where products of coordinates are worth their price, else of first (affine.hpp).
template <class Form>
class PoseCellOf : public CellAnswers {
 public:
  /// `statics` must outlive the cell. One a thread.
  explicit PoseCellOf(const core::PoseStatics& statics);

  /// `outside`: no pose of the cell can be assembled, or an effort is beyond its bound in all of them.
  State enter(const PoseChart& chart, const PoseBox& box);

  /// Of a cell in doubt.
  /// Tries no demand first because it failed last: where the same cells follow, the same is found on every thread.
  void forget() { first_ = 0; }
  Doubt doubt() const { return doubt_; }
  int demand() const { return demand_; }
  /// How far each parameter of the box moves what is in doubt: a cut helps most along the largest.
  const std::array<double, Form::noises>& spreads() const { return spreads_; }
  /// Of a proven cell: what every reaction has at least, N or N m, one a demand.
  const std::vector<double>& least_sizes() const { return least_; }

  /// Of a cell that is regular: a row's sum in any of its poses under a load, N, N m or what the row is of.
  Form sum_of(const core::LinearRow& row, std::size_t load) const;

  /// Of a cell in doubt; of forms of second order only. The chart and the box that it was entered with must still be.
  Known known();

  /// Nothing where it cannot be assembled or A cannot be inverted.
  std::optional<At> at(const std::vector<double>& pose) { return point_.at(pose); }
  const core::PoseStatics& statics() const { return *statics_; }

 private:
  using Sum = SumOf<Form>;
  struct Entry {
    int row = 0, step = 0;
  };
  /// `boundaries`: takes the squares and limits that may vanish in the cell; without it the first of them ends the run.
  State run(const PoseChart& chart, const PoseBox& box, std::vector<Form>* boundaries = nullptr);
  State in_doubt(Doubt doubt, const Form& form, int demand = -1);
  bool invert();
  bool is_regular();
  void solve(std::size_t load);
  /// Judges each demand of a cell once, and those that are alike together.
  bool keeps(int demand);
  bool judge(int demand);
  /// n . f of a demand's components f, as the equations leave it: left . w and multipliers . b.
  struct Projection {
    std::vector<double> n, multipliers;
    std::vector<Form> left;
  };
  Projection project(const core::PoseDemand& demand, std::vector<double> n) const;
  /// Under a load, and what it is off by besides.
  std::pair<Form, double> value_of(const Projection& projection, const core::PoseDemand& demand,
                                   std::size_t load) const;
  /// Of a demand that is not kept, in a cell that is regular: whether its size is below the least in every pose of it,
  /// under one load.
  bool is_below(int demand) const;
  /// Adds how far each parameter moves what a demand is kept from zero by.
  void add_spreads(const Form& value);
  bool is_beyond_bound(int demand) const;
  bool has_effort_beyond(const Signs& signs) const;
  void drop_parts_beyond_bounds(Known& sides_known) const;
  /// Of a step of a row. Most entries of A are numbers, which move with no coordinate.
  void add_step(Sum& sum, double factor, int index) const {
    if (forms_.varies(index))
      sum.add(factor, forms_[index], sizes_[static_cast<std::size_t>(index)]);
    else
      sum.add_number(factor, forms_[index]);
  }
  Form& step(int index) { return forms_[index]; }
  std::vector<double> component_values(const core::PoseDemand& demand, std::size_t load) const;
  /// Something that may vanish in the cell, as it is kept: where |form| > least. `demand` < 0: |A|, by s.
  struct Open {
    Form form;
    double least = 0;
    int demand = -1;
    int sign = 0;  ///< of a demand of one component where the form is positive; 0: of others
  };
  void sides_of(const std::vector<Open>& open, const std::vector<int>& turned, Known& sides_known) const;
  void know_near_singularity(Known& sides_known);
  void know_at_demand(Known& sides_known);
  void know_at_boundary(Known& sides_known);
  double inverse_at(std::size_t i, std::size_t j) const { return inverse_[i * n_ + j]; }

  const core::PoseStatics* statics_;
  PosePoint point_;
  PoseForms<Form> forms_;
  const PoseChart* chart_ = nullptr;  ///< of the cell entered last, and its box
  const PoseBox* box_ = nullptr;
  std::size_t n_;
  std::vector<std::vector<Entry>> columns_;    ///< of A
  std::vector<int> varying_;                   ///< steps of rows that do with the pose
  std::vector<double> sizes_;                  ///< of those, by step
  std::vector<double> leasts_;                 ///< asked of every demand, rounded up
  std::vector<double> inverse_;                ///< C
  std::vector<double> error_;                  ///< |E|
  std::vector<double> weights_;                ///< s
  double contraction_ = 0;                     ///< beta
  int determinant_ = 0;                        ///< the sign of |A| at the cell's middle
  std::vector<int> closures_;                  ///< steps whose roots vary with the pose, and limits
  std::vector<std::vector<double>> solution_;  ///< load by load: w_m
  std::vector<std::vector<Form>> moved_;       ///< C r
  std::vector<std::vector<double>> rest_;      ///< what w - w_m differs from that at most
  std::vector<double> least_;
  enum class Judged : std::uint8_t { not_yet, kept, open };
  std::vector<int> alike_;                  ///< of every demand the first one of the same rows and size
  std::vector<Judged> judged_;              ///< in this cell, of the first ones
  std::vector<std::vector<Form>> by_load_;  ///< likewise, of a demand that is kept
  std::vector<Open> kept_;                  ///< a demand each, as it was kept from zero last
  Doubt doubt_ = Doubt::none;
  int demand_ = -1, first_ = 0;
  std::array<double, Form::noises> spreads_{};
};

using PoseCell = PoseCellOf<Affine>;
template <>
CellAnswers::Known PoseCell::known();
template <>
void PoseCell::sides_of(const std::vector<Open>& open, const std::vector<int>& turned, Known& sides_known) const;
template <>
bool PoseCell::has_effort_beyond(const Signs& signs) const;
template <>
void PoseCell::drop_parts_beyond_bounds(Known& sides_known) const;
template <>
void PoseCell::know_at_demand(Known& sides_known);
template <>
void PoseCell::know_near_singularity(Known& sides_known);
template <>
void PoseCell::know_at_boundary(Known& sides_known);
extern template class PoseCellOf<Affine>;
extern template class PoseCellOf<FlatAffine>;

}  // namespace clearloci::loci::pose
