#include "loci/numbers/interval_batch.hpp"

#include <limits>

#include "core/errors.hpp"
#include "loci/numbers/jet_batch.hpp"
#include "loci/numbers/result_of.hpp"

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define CLEARLOCI_AVX2 __attribute__((target("avx2,fma")))
#define CLEARLOCI_AVX512 __attribute__((target("avx512f,avx512dq")))
#endif

namespace clearloci::loci::sheet::interval_batch {
namespace {

using Operation = SheetCode::Operation;
using RunIntervals = void (*)(const Instruction*, const Instruction*, const IntervalBatch*, IntervalBatch*,
                              std::size_t);
template <std::size_t N>
using RunJets = void (*)(const Instruction*, const Instruction*, const JetBatchOver<N>*, JetBatchOver<N>*, std::size_t);

template <class Apply>
void lane_by_lane(IntervalBatch& result, std::size_t count, const Apply& apply) {
  for (std::size_t l = 0; l < count; ++l) result.lanes[l] = apply(l);
}

/// What is computed a lane at a time in any case: seldom asked for.
void run_alone(Operation operation, const IntervalBatch& a, const IntervalBatch& b, IntervalBatch& result,
               std::size_t count) {
  lane_by_lane(result, count, [&](std::size_t l) { return result_of(operation, a.lanes[l], b.lanes[l]); });
}

}  // namespace

void run_by_lanes(const Instruction* begin, const Instruction* end, const IntervalBatch* values, IntervalBatch* results,
                  std::size_t count) {
  for (const Instruction* instruction = begin; instruction != end; ++instruction, ++results) {
    const IntervalBatch& a = values[instruction->first];
    const IntervalBatch& b = values[instruction->second];
    switch (instruction->operation) {
      case Operation::add:
        lane_by_lane(*results, count, [&](std::size_t l) { return a.lanes[l] + b.lanes[l]; });
        break;
      case Operation::subtract:
        lane_by_lane(*results, count, [&](std::size_t l) { return a.lanes[l] - b.lanes[l]; });
        break;
      case Operation::multiply:
        lane_by_lane(*results, count, [&](std::size_t l) { return a.lanes[l] * b.lanes[l]; });
        break;
      case Operation::square:
        lane_by_lane(*results, count, [&](std::size_t l) { return squared(a.lanes[l]); });
        break;
      default:
        run_alone(instruction->operation, a, b, *results, count);
    }
  }
}

namespace {

template <std::size_t N>
void run_alone(Operation operation, const JetBatchOver<N>& a, const JetBatchOver<N>& b, JetBatchOver<N>& result,
               std::size_t count) {
  for (std::size_t l = 0; l < count; ++l) result.set_lane(l, result_of(operation, a.lane(l), b.lane(l)));
}

}  // namespace

template <std::size_t N>
void run_by_lanes(const Instruction* begin, const Instruction* end, const JetBatchOver<N>* values,
                  JetBatchOver<N>* results, std::size_t count) {
  for (const Instruction* instruction = begin; instruction != end; ++instruction, ++results)
    run_alone(instruction->operation, values[instruction->first], values[instruction->second], *results, count);
}

#if defined(CLEARLOCI_AVX2)

static_assert(sizeof(Interval) == 2 * sizeof(double) && sizeof(IntervalBatch) == 8 * sizeof(double));

// Registers of either width hold intervals as their ends in core/interval.hpp: [-lower, upper]. What is done with them
// is written once, for both.

namespace by_avx2 {
namespace {

#define CLEARLOCI_WIDE CLEARLOCI_AVX2
using Wide = __m256d;
constexpr std::size_t width = 2;  // intervals

CLEARLOCI_WIDE inline Wide all(double a) { return _mm256_set1_pd(a); }
CLEARLOCI_WIDE inline Wide alternating(double lower, double upper) {
  return _mm256_setr_pd(lower, upper, lower, upper);
}
CLEARLOCI_WIDE inline Wide load(const double* from) { return _mm256_load_pd(from); }
CLEARLOCI_WIDE inline void store(double* to, Wide a) { _mm256_store_pd(to, a); }
CLEARLOCI_WIDE inline Wide plus(Wide a, Wide b) { return _mm256_add_pd(a, b); }
CLEARLOCI_WIDE inline Wide times(Wide a, Wide b) { return _mm256_mul_pd(a, b); }
CLEARLOCI_WIDE inline Wide times_plus(Wide a, Wide b, Wide c) { return _mm256_fmadd_pd(a, b, c); }
CLEARLOCI_WIDE inline Wide largest(Wide a, Wide b) { return _mm256_max_pd(a, b); }
CLEARLOCI_WIDE inline Wide least(Wide a, Wide b) { return _mm256_min_pd(a, b); }
CLEARLOCI_WIDE inline Wide swapped(Wide a) { return _mm256_permute_pd(a, 0b0101); }
CLEARLOCI_WIDE inline Wide magnitude(Wide a) { return _mm256_andnot_pd(all(-0.0), a); }
CLEARLOCI_WIDE inline Wide number_or_zero(Wide a) { return _mm256_and_pd(a, _mm256_cmp_pd(a, a, _CMP_ORD_Q)); }
CLEARLOCI_WIDE inline bool is_any_unordered(Wide a, Wide b) {
  return _mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_UNORD_Q)) != 0;
}
CLEARLOCI_WIDE inline Wide negated(Wide a) { return _mm256_xor_pd(all(-0.0), a); }
CLEARLOCI_WIDE inline Wide first_ends(Wide a, Wide b) { return _mm256_unpacklo_pd(a, b); }
CLEARLOCI_WIDE inline Wide second_ends(Wide a, Wide b) { return _mm256_unpackhi_pd(a, b); }
CLEARLOCI_WIDE inline Wide joined(Wide lower, Wide upper) { return _mm256_blend_pd(lower, upper, 0b1010); }

#include "loci/numbers/interval_batch_steps.inc"
#undef CLEARLOCI_WIDE

}  // namespace
}  // namespace by_avx2

namespace by_avx512 {
namespace {

#define CLEARLOCI_WIDE CLEARLOCI_AVX512
using Wide = __m512d;
constexpr std::size_t width = 4;  // intervals

CLEARLOCI_WIDE inline Wide all(double a) { return _mm512_set1_pd(a); }
CLEARLOCI_WIDE inline Wide alternating(double lower, double upper) {
  return _mm512_setr_pd(lower, upper, lower, upper, lower, upper, lower, upper);
}
CLEARLOCI_WIDE inline Wide load(const double* from) { return _mm512_load_pd(from); }
CLEARLOCI_WIDE inline void store(double* to, Wide a) { _mm512_store_pd(to, a); }
CLEARLOCI_WIDE inline Wide plus(Wide a, Wide b) { return _mm512_add_pd(a, b); }
CLEARLOCI_WIDE inline Wide times(Wide a, Wide b) { return _mm512_mul_pd(a, b); }
CLEARLOCI_WIDE inline Wide times_plus(Wide a, Wide b, Wide c) { return _mm512_fmadd_pd(a, b, c); }
CLEARLOCI_WIDE inline Wide largest(Wide a, Wide b) { return _mm512_max_pd(a, b); }
CLEARLOCI_WIDE inline Wide least(Wide a, Wide b) { return _mm512_min_pd(a, b); }
CLEARLOCI_WIDE inline Wide swapped(Wide a) { return _mm512_permute_pd(a, 0b01010101); }
CLEARLOCI_WIDE inline Wide magnitude(Wide a) { return _mm512_andnot_pd(all(-0.0), a); }
CLEARLOCI_WIDE inline Wide number_or_zero(Wide a) {
  return _mm512_maskz_mov_pd(_mm512_cmp_pd_mask(a, a, _CMP_ORD_Q), a);
}
CLEARLOCI_WIDE inline bool is_any_unordered(Wide a, Wide b) { return _mm512_cmp_pd_mask(a, b, _CMP_UNORD_Q) != 0; }
CLEARLOCI_WIDE inline Wide negated(Wide a) { return _mm512_xor_pd(all(-0.0), a); }
CLEARLOCI_WIDE inline Wide first_ends(Wide a, Wide b) { return _mm512_unpacklo_pd(a, b); }
CLEARLOCI_WIDE inline Wide second_ends(Wide a, Wide b) { return _mm512_unpackhi_pd(a, b); }
CLEARLOCI_WIDE inline Wide joined(Wide lower, Wide upper) { return _mm512_mask_blend_pd(0b10101010, lower, upper); }

#include "loci/numbers/interval_batch_steps.inc"
#undef CLEARLOCI_WIDE

}  // namespace
}  // namespace by_avx512

void run_by_avx2(const Instruction* begin, const Instruction* end, const IntervalBatch* values, IntervalBatch* results,
                 std::size_t count) {
  by_avx2::run_wide(begin, end, values, results, count);
}

template <std::size_t N>
void run_by_avx2(const Instruction* begin, const Instruction* end, const JetBatchOver<N>* values,
                 JetBatchOver<N>* results, std::size_t count) {
  by_avx2::run_wide(begin, end, values, results, count);
}

void run_by_avx512(const Instruction* begin, const Instruction* end, const IntervalBatch* values,
                   IntervalBatch* results, std::size_t count) {
  by_avx512::run_wide(begin, end, values, results, count);
}

template <std::size_t N>
void run_by_avx512(const Instruction* begin, const Instruction* end, const JetBatchOver<N>* values,
                   JetBatchOver<N>* results, std::size_t count) {
  by_avx512::run_wide(begin, end, values, results, count);
}

bool has_avx2() { return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0; }
bool has_avx512() { return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0; }

#else

namespace {

template <class Batch>
void run_wide(const Instruction*, const Instruction*, const Batch*, Batch*, std::size_t) {
  core::ensure(false, "the processor has such registers");
}

}  // namespace

void run_by_avx2(const Instruction* begin, const Instruction* end, const IntervalBatch* values, IntervalBatch* results,
                 std::size_t count) {
  run_wide(begin, end, values, results, count);
}

template <std::size_t N>
void run_by_avx2(const Instruction* begin, const Instruction* end, const JetBatchOver<N>* values,
                 JetBatchOver<N>* results, std::size_t count) {
  run_wide(begin, end, values, results, count);
}

void run_by_avx512(const Instruction* begin, const Instruction* end, const IntervalBatch* values,
                   IntervalBatch* results, std::size_t count) {
  run_wide(begin, end, values, results, count);
}

template <std::size_t N>
void run_by_avx512(const Instruction* begin, const Instruction* end, const JetBatchOver<N>* values,
                   JetBatchOver<N>* results, std::size_t count) {
  run_wide(begin, end, values, results, count);
}

bool has_avx2() { return false; }
bool has_avx512() { return false; }

#endif

void run(const Instruction* begin, const Instruction* end, const IntervalBatch* values, IntervalBatch* results,
         std::size_t count) {
  static const auto way = has_avx512() ? RunIntervals{run_by_avx512}
                          : has_avx2() ? RunIntervals{run_by_avx2}
                                       : RunIntervals{run_by_lanes};
  way(begin, end, values, results, count);
}

template <std::size_t N>
void run(const Instruction* begin, const Instruction* end, const JetBatchOver<N>* values, JetBatchOver<N>* results,
         std::size_t count) {
  static const auto way = has_avx512() ? RunJets<N>{run_by_avx512<N>}
                          : has_avx2() ? RunJets<N>{run_by_avx2<N>}
                                       : RunJets<N>{run_by_lanes<N>};
  way(begin, end, values, results, count);
}

template void run(const Instruction*, const Instruction*, const JetBatchOver<2>*, JetBatchOver<2>*, std::size_t);
template void run_by_lanes(const Instruction*, const Instruction*, const JetBatchOver<2>*, JetBatchOver<2>*,
                           std::size_t);
template void run_by_avx2(const Instruction*, const Instruction*, const JetBatchOver<2>*, JetBatchOver<2>*,
                          std::size_t);
template void run_by_avx512(const Instruction*, const Instruction*, const JetBatchOver<2>*, JetBatchOver<2>*,
                            std::size_t);
template void run(const Instruction*, const Instruction*, const JetBatchOver<3>*, JetBatchOver<3>*, std::size_t);
template void run_by_lanes(const Instruction*, const Instruction*, const JetBatchOver<3>*, JetBatchOver<3>*,
                           std::size_t);
template void run_by_avx2(const Instruction*, const Instruction*, const JetBatchOver<3>*, JetBatchOver<3>*,
                          std::size_t);
template void run_by_avx512(const Instruction*, const Instruction*, const JetBatchOver<3>*, JetBatchOver<3>*,
                            std::size_t);

}  // namespace clearloci::loci::sheet::interval_batch
