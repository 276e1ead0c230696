#include "loci/sheet/interval_batch.hpp"

#include "core/errors.hpp"
#include "loci/sheet/jet_batch.hpp"

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define CLEARLOCI_AVX2 __attribute__((target("avx2")))
#endif

namespace clearloci::loci::sheet::interval_batch {
namespace {

using Operation = SheetCode::Operation;

template <class Apply>
void lane_by_lane(IntervalBatch& result, std::size_t count, const Apply& apply) {
  for (std::size_t l = 0; l < count; ++l) result.lanes[l] = apply(l);
}

/// What is computed a lane at a time in any case: seldom asked for.
void run_alone(Operation operation, const IntervalBatch& a, const IntervalBatch& b, IntervalBatch& result,
               std::size_t count) {
  if (operation == Operation::inverse)
    lane_by_lane(result, count, [&](std::size_t l) { return inverse(a.lanes[l]); });
  else if (operation == Operation::angle)
    lane_by_lane(result, count, [&](std::size_t l) { return angle_of(a.lanes[l], b.lanes[l]); });
  else
    lane_by_lane(result, count, [&](std::size_t l) { return angle_slope(a.lanes[l], b.lanes[l]); });
}

}  // namespace

void run_by_lanes(const Instruction* begin, const Instruction* end, const IntervalBatch* values, IntervalBatch* results,
                  std::size_t count) {
  for (const Instruction* own = begin; own != end; ++own, ++results) {
    const IntervalBatch& a = values[own->first];
    const IntervalBatch& b = values[own->second];
    switch (own->operation) {
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
        run_alone(own->operation, a, b, *results, count);
    }
  }
}

namespace {

Jet result_of(Operation operation, const Jet& a, const Jet& b) {
  switch (operation) {
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::square:
      return squared(a);
    case Operation::inverse:
      return inverse(a);
    case Operation::angle:
      return angle_of(a, b);
    case Operation::angle_slope:
      return angle_slope(a, b);
  }
  core::ensure(false, "every operation is known");
  return a;
}

void run_alone(Operation operation, const JetBatch& a, const JetBatch& b, JetBatch& result, std::size_t count) {
  for (std::size_t l = 0; l < count; ++l) result.set_lane(l, result_of(operation, a.lane(l), b.lane(l)));
}

}  // namespace

void run_by_lanes(const Instruction* begin, const Instruction* end, const JetBatch* values, JetBatch* results,
                  std::size_t count) {
  for (const Instruction* own = begin; own != end; ++own, ++results)
    run_alone(own->operation, values[own->first], values[own->second], *results, count);
}

#if defined(CLEARLOCI_AVX2)

namespace {

/// Two intervals, each as its ends in core/interval.hpp: [-lower, upper].
using Two = __m256d;

CLEARLOCI_AVX2 inline Two swapped(Two a) { return _mm256_permute_pd(a, 0b0101); }
CLEARLOCI_AVX2 inline Two magnitude(Two a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
CLEARLOCI_AVX2 inline Two negated(Two a) { return _mm256_xor_pd(_mm256_set1_pd(-0.0), a); }

CLEARLOCI_AVX2 inline Two outward(Two ends) {
  const Two error = _mm256_add_pd(_mm256_mul_pd(magnitude(ends), _mm256_set1_pd(0x1p-52)), _mm256_set1_pd(0x1p-1000));
  return _mm256_add_pd(ends, error);
}

CLEARLOCI_AVX2 inline Two product(Two a, Two b) {
  const Two straight = _mm256_mul_pd(a, b), crossed = _mm256_mul_pd(a, swapped(b));
  const Two upper = _mm256_max_pd(straight, negated(crossed)), lower = _mm256_max_pd(crossed, negated(straight));
  return outward(_mm256_max_pd(_mm256_unpacklo_pd(lower, upper), _mm256_unpackhi_pd(lower, upper)));
}

/// Least and greatest absolute value squared; the lower end is 0 at least.
CLEARLOCI_AVX2 inline Two square(Two a) {
  const Two other = swapped(a);
  const Two least = _mm256_max_pd(negated(other), _mm256_max_pd(negated(a), _mm256_setzero_pd()));
  const Two most = _mm256_max_pd(magnitude(a), magnitude(other));
  const Two ends = outward(_mm256_blend_pd(negated(_mm256_mul_pd(least, least)), _mm256_mul_pd(most, most), 0b1010));
  return _mm256_blend_pd(_mm256_min_pd(ends, _mm256_set1_pd(-0.0)), ends, 0b1010);
}

CLEARLOCI_AVX2 inline Two load(const IntervalBatch& a, std::size_t half) {
  return _mm256_load_pd(reinterpret_cast<const double*>(&a) + 4 * half);
}
CLEARLOCI_AVX2 inline void store(IntervalBatch& a, std::size_t half, Two value) {
  _mm256_store_pd(reinterpret_cast<double*>(&a) + 4 * half, value);
}

CLEARLOCI_AVX2 inline Two sum(Two a, Two b) { return outward(_mm256_add_pd(a, b)); }

/// As core::around and core::meet.
CLEARLOCI_AVX2 inline Two around(Two middle, Two first, Two second) {
  const Two one = _mm256_max_pd(first, swapped(first)), other = _mm256_max_pd(second, swapped(second));
  return sum(sum(one, other), middle);
}
CLEARLOCI_AVX2 inline Two meet(Two a, Two b) {
  const Two ends = _mm256_min_pd(a, b);
  const Two lower = negated(_mm256_unpacklo_pd(ends, ends));
  return _mm256_blend_pd(_mm256_max_pd(ends, lower), ends, 0b0101);
}

/// Half of a batch of jets.
struct TwoJets {
  Two value, middle, slope[2];
};

CLEARLOCI_AVX2 inline TwoJets load(const JetBatch& a, std::size_t half) {
  return {load(a.value, half), load(a.middle, half), {load(a.slope[0], half), load(a.slope[1], half)}};
}
/// The value met with the mean-value form.
CLEARLOCI_AVX2 inline void store_tightened(JetBatch& a, std::size_t half, const TwoJets& jets) {
  store(a.value, half, meet(jets.value, around(jets.middle, jets.slope[0], jets.slope[1])));
  store(a.middle, half, jets.middle);
  for (std::size_t c = 0; c < 2; ++c) store(a.slope[c], half, jets.slope[c]);
}

CLEARLOCI_AVX2 inline TwoJets sum(const TwoJets& a, const TwoJets& b) {
  return {sum(a.value, b.value), sum(a.middle, b.middle), {sum(a.slope[0], b.slope[0]), sum(a.slope[1], b.slope[1])}};
}
CLEARLOCI_AVX2 inline TwoJets negative(const TwoJets& a) {
  return {swapped(a.value), swapped(a.middle), {swapped(a.slope[0]), swapped(a.slope[1])}};
}
CLEARLOCI_AVX2 inline TwoJets product(const TwoJets& a, const TwoJets& b) {
  TwoJets result{product(a.value, b.value), product(a.middle, b.middle), {}};
  for (std::size_t c = 0; c < 2; ++c) result.slope[c] = sum(product(a.slope[c], b.value), product(a.value, b.slope[c]));
  return result;
}
CLEARLOCI_AVX2 inline TwoJets square(const TwoJets& a) {
  TwoJets result{square(a.value), square(a.middle), {}};
  const Two twice = product(_mm256_setr_pd(-2, 2, -2, 2), a.value);
  for (std::size_t c = 0; c < 2; ++c) result.slope[c] = product(twice, a.slope[c]);
  return result;
}

static_assert(sizeof(Interval) == 2 * sizeof(double) && sizeof(IntervalBatch) == 8 * sizeof(double));

}  // namespace

CLEARLOCI_AVX2 void run_by_avx2(const Instruction* begin, const Instruction* end, const IntervalBatch* values,
                                IntervalBatch* results, std::size_t count) {
  const std::size_t halves = (count + 1) / 2;
  for (const Instruction* own = begin; own != end; ++own, ++results) {
    const IntervalBatch& a = values[own->first];
    const IntervalBatch& b = values[own->second];
    switch (own->operation) {
      case Operation::add:
        for (std::size_t half = 0; half < halves; ++half)
          store(*results, half, outward(_mm256_add_pd(load(a, half), load(b, half))));
        break;
      case Operation::subtract:
        for (std::size_t half = 0; half < halves; ++half)
          store(*results, half, outward(_mm256_add_pd(load(a, half), swapped(load(b, half)))));
        break;
      case Operation::multiply:
        for (std::size_t half = 0; half < halves; ++half) store(*results, half, product(load(a, half), load(b, half)));
        break;
      case Operation::square:
        for (std::size_t half = 0; half < halves; ++half) store(*results, half, square(load(a, half)));
        break;
      default:
        run_alone(own->operation, a, b, *results, count);
    }
  }
}

CLEARLOCI_AVX2 void run_by_avx2(const Instruction* begin, const Instruction* end, const JetBatch* values,
                                JetBatch* results, std::size_t count) {
  const std::size_t halves = (count + 1) / 2;
  for (const Instruction* own = begin; own != end; ++own, ++results) {
    const JetBatch& a = values[own->first];
    const JetBatch& b = values[own->second];
    switch (own->operation) {
      case Operation::add:
        for (std::size_t half = 0; half < halves; ++half)
          store_tightened(*results, half, sum(load(a, half), load(b, half)));
        break;
      case Operation::subtract:
        for (std::size_t half = 0; half < halves; ++half)
          store_tightened(*results, half, sum(load(a, half), negative(load(b, half))));
        break;
      case Operation::multiply:
        for (std::size_t half = 0; half < halves; ++half)
          store_tightened(*results, half, product(load(a, half), load(b, half)));
        break;
      case Operation::square:
        for (std::size_t half = 0; half < halves; ++half) store_tightened(*results, half, square(load(a, half)));
        break;
      default:
        run_alone(own->operation, a, b, *results, count);
        continue;
    }
    for (std::size_t l = 0; l < JetBatch::size; ++l) results->bounded[l] = a.bounded[l] && b.bounded[l];
  }
}

bool has_avx2() { return __builtin_cpu_supports("avx2") != 0; }

#else

void run_by_avx2(const Instruction*, const Instruction*, const IntervalBatch*, IntervalBatch*, std::size_t) {
  core::ensure(false, "the processor has AVX2");
}

void run_by_avx2(const Instruction*, const Instruction*, const JetBatch*, JetBatch*, std::size_t) {
  core::ensure(false, "the processor has AVX2");
}

bool has_avx2() { return false; }

#endif

void run(const Instruction* begin, const Instruction* end, const IntervalBatch* values, IntervalBatch* results,
         std::size_t count) {
  static const bool wide = has_avx2();
  wide ? run_by_avx2(begin, end, values, results, count) : run_by_lanes(begin, end, values, results, count);
}

void run(const Instruction* begin, const Instruction* end, const JetBatch* values, JetBatch* results,
         std::size_t count) {
  static const bool wide = has_avx2();
  wide ? run_by_avx2(begin, end, values, results, count) : run_by_lanes(begin, end, values, results, count);
}

}  // namespace clearloci::loci::sheet::interval_batch
