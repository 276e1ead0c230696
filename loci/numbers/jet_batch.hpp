// Four jets (jet.hpp) side by side, as interval_batch.hpp has intervals: a lane has the bytes that it would have alone.
#pragma once

#include <array>
#include <cstddef>

#include "loci/numbers/interval_batch.hpp"
#include "loci/numbers/jet.hpp"

namespace clearloci::loci::sheet {

struct JetBatch {
  static constexpr std::size_t size = IntervalBatch::size;
  IntervalBatch value, middle;
  std::array<IntervalBatch, 2> slope;
  std::array<bool, size> bounded = {true, true, true, true};

  JetBatch() = default;
  JetBatch(const Interval& same) : value(same), middle(same) {}  // NOLINT: a number is a constant function

  Jet lane(std::size_t l) const {
    Jet jet(value.lanes[l]);
    jet.middle = middle.lanes[l];
    for (std::size_t c = 0; c < 2; ++c) jet.slope[c] = slope[c].lanes[l];
    jet.bounded = bounded[l];
    return jet;
  }
  void set_lane(std::size_t l, const Jet& jet) {
    value.lanes[l] = jet.value;
    middle.lanes[l] = jet.middle;
    for (std::size_t c = 0; c < 2; ++c) slope[c].lanes[l] = jet.slope[c];
    bounded[l] = jet.bounded;
  }
};

namespace interval_batch {

/// As of intervals.
void run(const Instruction* begin, const Instruction* end, const JetBatch* values, JetBatch* results,
         std::size_t count);
void run_by_lanes(const Instruction* begin, const Instruction* end, const JetBatch* values, JetBatch* results,
                  std::size_t count);
void run_by_avx2(const Instruction* begin, const Instruction* end, const JetBatch* values, JetBatch* results,
                 std::size_t count);
void run_by_avx512(const Instruction* begin, const Instruction* end, const JetBatch* values, JetBatch* results,
                   std::size_t count);

}  // namespace interval_batch

}  // namespace clearloci::loci::sheet
