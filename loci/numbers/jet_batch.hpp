// Four jets (jet.hpp) side by side, as interval_batch.hpp has intervals: a lane has the bytes that it would have alone.
#pragma once

#include <array>
#include <cstddef>

#include "loci/numbers/interval_batch.hpp"
#include "loci/numbers/jet.hpp"

namespace clearloci::loci::sheet {

/// `N`: coordinates.
template <std::size_t N>
struct JetBatchOver {
  static constexpr std::size_t size = IntervalBatch::size;
  IntervalBatch value, middle;
  std::array<IntervalBatch, N> slope;
  std::array<bool, size> bounded = {true, true, true, true};

  JetBatchOver() = default;
  JetBatchOver(const Interval& same) : value(same), middle(same) {}  // NOLINT: a number is a constant function

  JetOver<N> lane(std::size_t l) const {
    JetOver<N> jet(value.lanes[l]);
    jet.middle = middle.lanes[l];
    for (std::size_t c = 0; c < N; ++c) jet.slope[c] = slope[c].lanes[l];
    jet.bounded = bounded[l];
    return jet;
  }
  void set_lane(std::size_t l, const JetOver<N>& jet) {
    value.lanes[l] = jet.value;
    middle.lanes[l] = jet.middle;
    for (std::size_t c = 0; c < N; ++c) slope[c].lanes[l] = jet.slope[c];
    bounded[l] = jet.bounded;
  }
};
using JetBatch = JetBatchOver<2>;

namespace interval_batch {

/// As of intervals. Of two and three coordinates.
template <std::size_t N>
void run(const Instruction* begin, const Instruction* end, const JetBatchOver<N>* values, JetBatchOver<N>* results,
         std::size_t count);
template <std::size_t N>
void run_by_lanes(const Instruction* begin, const Instruction* end, const JetBatchOver<N>* values,
                  JetBatchOver<N>* results, std::size_t count);
template <std::size_t N>
void run_by_avx2(const Instruction* begin, const Instruction* end, const JetBatchOver<N>* values,
                 JetBatchOver<N>* results, std::size_t count);
template <std::size_t N>
void run_by_avx512(const Instruction* begin, const Instruction* end, const JetBatchOver<N>* values,
                   JetBatchOver<N>* results, std::size_t count);

}  // namespace interval_batch

}  // namespace clearloci::loci::sheet
