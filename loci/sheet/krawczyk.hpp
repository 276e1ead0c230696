// Krawczyk's operator for the square system F = (functions..., G_l ...) = 0 in a cell's local coordinates:
//     K(X) = m - Y F(m) + (I - Y F'(X)) (X - m),   Y ~ F'(m)^-1
// K(X) inside the interior of X proves exactly one zero in X; K(X) disjoint from X proves none
// (Neumaier, Interval Methods for Systems of Equations, 1990, section 5.1).
#pragma once

#include <vector>

#include "loci/sheet/sheet_cell.hpp"

namespace clearloci::loci::sheet {

enum class ZeroCount { none, unique, unknown };

/// As many functions as free coordinates; lifted roots are free and bound by their G_l.
struct System {
  std::vector<int> functions = {0, 1};
  std::vector<int> free = {0, 1};
  std::vector<int> also = {};  ///< further functions: a cell without a zero of one of them has none of the system
};

/// Zeros in the box that `cell` has entered and differentiated. `image`: K(X) in all local coordinates (those that
/// are not free stay as they are), or empty where the middle Jacobian is singular.
ZeroCount krawczyk(const SheetCell& cell, const System& system, std::vector<Interval>& image);

/// Narrows the enclosure of the only zero in a box, which is thin in the coordinates that are not free: Newton's method
/// from its middle, then the smallest box around the limit that is proven to hold a zero, which can only be this one;
/// in multi-precision where doubles do not get it as narrow as `accuracy`.
void narrow(SheetCell& cell, const System& system, const std::vector<Interval>& box, const std::vector<int>& lifted,
            double accuracy, std::vector<Interval>& enclosure);

/// The same place by place, for those who have several of them to narrow and enclose their places side by side. What is
/// given outlives this.
class Narrowing {
 public:
  Narrowing(const System& system, const std::vector<Interval>& box, const std::vector<int>& lifted, double accuracy,
            std::vector<Interval>& enclosure);

  bool is_done() const { return stage_ == Stage::done; }
  /// The local coordinates that a cell is to enter next, and to be differentiated in; which roots are lifted there.
  const std::vector<Interval>& place() const { return stage_ == Stage::steps ? point_ : trial_; }
  const std::vector<int>& lifted() const { return *lifted_; }
  /// `entered`: the cell has; otherwise the place is too wide to work on.
  void take(SheetCell& cell, bool entered);

 private:
  enum class Stage { steps, radii, done };

  bool is_thin(std::size_t c) const { return (*box_)[c].width() == 0; }
  void begin(bool sharp);
  void take_step();
  void choose_trial();
  void take_trial(ZeroCount count);
  void end_radii(bool narrow);

  const System* system_;
  const std::vector<Interval>* box_;
  const std::vector<int>* lifted_;
  double accuracy_;
  std::vector<Interval>* enclosure_;
  std::vector<Interval> point_, trial_, image_;
  Stage stage_ = Stage::steps;
  bool sharp_ = false;
  int count_ = 0;  // of steps, of radii
  double step_ = 0, last_step_ = 0, radius_ = 0;
};

}  // namespace clearloci::loci::sheet
