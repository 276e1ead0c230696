// Eight doubles evaluated side by side: a SheetProgram run over Batch serves eight points for one pass through its
// instructions, in as few registers as the processor has for them. A lane has the bytes that it would have alone.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/rational.hpp"
#include "loci/numbers/interval_batch.hpp"

namespace clearloci::loci::sheet {

struct Batch {
  static constexpr std::size_t size = 8;
  std::array<double, size> lanes{};

  Batch() = default;
  explicit Batch(double value) { lanes.fill(value); }

  double& operator[](std::size_t i) { return lanes[i]; }
  double operator[](std::size_t i) const { return lanes[i]; }
};

namespace batch_detail {
template <class F>
Batch lane_by_lane(const F& of) {
  Batch result;
  for (std::size_t i = 0; i < Batch::size; ++i) result.lanes[i] = of(i);
  return result;
}
}  // namespace batch_detail

inline Batch operator+(const Batch& a, const Batch& b) {
  return batch_detail::lane_by_lane([&](std::size_t i) { return a.lanes[i] + b.lanes[i]; });
}
inline Batch operator-(const Batch& a, const Batch& b) {
  return batch_detail::lane_by_lane([&](std::size_t i) { return a.lanes[i] - b.lanes[i]; });
}
inline Batch operator*(const Batch& a, const Batch& b) {
  return batch_detail::lane_by_lane([&](std::size_t i) { return a.lanes[i] * b.lanes[i]; });
}
inline Batch squared(const Batch& a) { return a * a; }
inline Batch inverse(const Batch& a) {
  return batch_detail::lane_by_lane([&](std::size_t i) { return 1 / a.lanes[i]; });
}
inline Batch angle_of(const Batch& y, const Batch& x) {
  return batch_detail::lane_by_lane([&](std::size_t i) { return std::atan2(y.lanes[i], x.lanes[i]); });
}
inline Batch angle_slope(const Batch& y, const Batch& x) { return inverse(x * x + y * y); }
/// Not a number where the lane is negative.
inline Batch square_root(const Batch& a) {
  return batch_detail::lane_by_lane([&](std::size_t i) { return std::sqrt(a.lanes[i]); });
}

namespace batch {

using Instruction = SheetCode::Instruction;

/// The instructions [begin, end) on registers `values`, their results from `results` on.
void run(const Instruction* begin, const Instruction* end, const Batch* values, Batch* results);

/// The ways in which it may do so; required of the last two: interval_batch::has_avx2(), has_avx512().
void run_by_lanes(const Instruction* begin, const Instruction* end, const Batch* values, Batch* results);
void run_by_avx2(const Instruction* begin, const Instruction* end, const Batch* values, Batch* results);
void run_by_avx512(const Instruction* begin, const Instruction* end, const Batch* values, Batch* results);

}  // namespace batch

inline Batch constant_as(const core::Rational& value, Batch*) { return Batch(core::to_double(value)); }

}  // namespace clearloci::loci::sheet
