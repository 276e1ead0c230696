// The Newton-Euler equations reduced once a mechanism. Entries of force rows are +-1 and stay so; every such unit pivot
// is eliminated while compiling, and a small dense core is left for each pose. With N_k = w_k |A| (Cramer, paper (28)):
//     core:        M N = b |M|,  so (N, -|M|) spans the kernel of [M | b]: no division by |M|, exact through |A| = 0
//     eliminated:  N_c = ε (b_r |A| - Σ a_rj N_j),  ε = ±1 the pivot
#pragma once

#include <map>
#include <vector>

#include "numeric/tape.hpp"

namespace clearloci::numeric {

/// Rows of [A | -w_e] without their zeros; column `unknowns` is the load.
struct SparseEquations {
  int unknowns = 0;
  std::vector<std::map<int, Register>> rows;
};

/// N_unknown = pivot (b |A| - Σ a_j N_j). `load` < 0: zero.
struct BackSubstitution {
  int unknown = 0;
  double pivot = 1;
  Register load = -1;
  std::vector<std::pair<Register, int>> terms;  ///< a_j, j
};

struct Elimination {
  int unknowns = 0;
  double sign = 1;                      ///< |A| = sign · |M|
  std::vector<int> core_unknowns;       ///< columns of M
  std::vector<Register> core;           ///< [M | b], row after row, n × (n + 1)
  std::vector<BackSubstitution> steps;  ///< in order of use
};

/// Eliminates every unit pivot, the sparsest first; appends to the tape what the core and the steps need.
Elimination eliminate(TapeBuilder& tape, SparseEquations equations);

/// The vector (N_1 ... N_n, -|M|) with M N = b |M| from g = [M | b], n × (n + 1) row after row, destroyed.
/// Complete pivoting over all n + 1 columns; a rank below n gives the zero vector. T: double or Bounded, of which the
/// errors are finite whatever the rank.
template <class T>
void kernel_vector(int n, T* g, T* kernel);
template <>
void kernel_vector<double>(int n, double* g, double* kernel);
template <>
void kernel_vector<Bounded>(int n, Bounded* g, Bounded* kernel);

}  // namespace clearloci::numeric
