// Four intervals side by side: a SheetProgram run over IntervalBatch encloses four cells for one pass through its
// instructions. Where the processor has AVX-512 all four share a register, where it has AVX2 two, else each has its
// own, as with jets (jet_batch.hpp); every step rounds as that of one Interval does, so that a lane has the bytes that
// it would have alone.
#pragma once

#include <array>
#include <cstddef>

#include "core/interval.hpp"
#include "loci/numbers/sheet_code.hpp"

namespace clearloci::loci::sheet {

struct alignas(64) IntervalBatch {
  static constexpr std::size_t size = 4;
  std::array<Interval, size> lanes{};

  IntervalBatch() = default;
  IntervalBatch(const Interval& same) { lanes.fill(same); }  // NOLINT: a number is the same in every lane
};

namespace interval_batch {

using Instruction = SheetCode::Instruction;

/// The instructions [begin, end) on registers `values`, their results from `results` on, at least in the first `count`
/// lanes.
void run(const Instruction* begin, const Instruction* end, const IntervalBatch* values, IntervalBatch* results,
         std::size_t count);

/// The ways in which it may do so: a lane at a time; two at a time, required: has_avx2(); all four, has_avx512().
void run_by_lanes(const Instruction* begin, const Instruction* end, const IntervalBatch* values, IntervalBatch* results,
                  std::size_t count);
void run_by_avx2(const Instruction* begin, const Instruction* end, const IntervalBatch* values, IntervalBatch* results,
                 std::size_t count);
void run_by_avx512(const Instruction* begin, const Instruction* end, const IntervalBatch* values,
                   IntervalBatch* results, std::size_t count);
bool has_avx2();
bool has_avx512();

}  // namespace interval_batch

}  // namespace clearloci::loci::sheet
