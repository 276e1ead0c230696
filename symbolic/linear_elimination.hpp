// Linear systems whose entries are steps of a program, made smaller by pivots that are numbers. Private to symbolic/.
#pragma once

#include <map>
#include <vector>

#include "core/pose_statics.hpp"

namespace clearloci::symbolic {

/// Sum of entries times unknowns, and a column of steps, one a load: the right side of an equation, or what is added to
/// a reaction.
struct SymbolicRow {
  std::map<int, int> entries;  ///< unknown to step
  std::vector<int> free;
};

class LinearElimination {
 public:
  LinearElimination(core::PoseProgramBuilder& builder, int unknowns, std::vector<SymbolicRow> equations);

  /// Eliminates unknowns with a number as pivot, as long as that fills no more than `most_fill` entries at a time.
  void reduce(std::size_t most_fill);

  /// The equations that are left.
  std::vector<SymbolicRow> equations() const;
  /// A reaction in the unknowns that are left.
  SymbolicRow substituted(SymbolicRow reaction);
  /// Old unknowns to their places among those left; -1 of eliminated ones.
  std::vector<int> places() const;

 private:
  struct Pivot {
    std::size_t row = 0;
    int unknown = 0;
  };
  bool choose(std::size_t most_fill, Pivot& pivot) const;
  void eliminate(const Pivot& pivot);
  /// row - (its entry / pivot entry) pivot_row.
  void subtract(SymbolicRow& row, const SymbolicRow& pivot_row, int unknown, int sign_of_free);

  core::PoseProgramBuilder& builder_;
  int unknowns_;
  std::vector<SymbolicRow> rows_;
  std::vector<bool> used_;
  std::vector<Pivot> pivots_;
};

}  // namespace clearloci::symbolic
