#include "loci/numbers/batch.hpp"

#include "core/errors.hpp"
#include "loci/numbers/result_of.hpp"

namespace clearloci::loci::sheet::batch {

void run_by_lanes(const Instruction* begin, const Instruction* end, const Batch* values, Batch* results) {
  for (const Instruction* instruction = begin; instruction != end; ++instruction, ++results)
    *results = result_of(instruction->operation, values[instruction->first], values[instruction->second]);
}

#if defined(__x86_64__) && defined(__GNUC__)

namespace {

/// A batch as one number: the compiler takes as many registers as the processor needs for it.
using Wide __attribute__((vector_size(sizeof(Batch)), aligned(alignof(Batch)), may_alias)) = double;

inline const Wide& wide(const Batch& a) { return reinterpret_cast<const Wide&>(a); }
inline Wide& wide(Batch& a) { return reinterpret_cast<Wide&>(a); }

__attribute__((always_inline)) inline void run_wide(const Instruction* begin, const Instruction* end,
                                                    const Batch* values, Batch* results) {
  using Operation = SheetCode::Operation;
  for (const Instruction* instruction = begin; instruction != end; ++instruction, ++results) {
    const Batch& a = values[instruction->first];
    const Batch& b = values[instruction->second];
    switch (instruction->operation) {
      case Operation::add:
        wide(*results) = wide(a) + wide(b);
        break;
      case Operation::subtract:
        wide(*results) = wide(a) - wide(b);
        break;
      case Operation::multiply:
        wide(*results) = wide(a) * wide(b);
        break;
      case Operation::square:
        wide(*results) = wide(a) * wide(a);
        break;
      case Operation::inverse:
        wide(*results) = 1 / wide(a);
        break;
      default:
        *results = result_of(instruction->operation, a, b);
    }
  }
}

}  // namespace

__attribute__((target("avx2"))) void run_by_avx2(const Instruction* begin, const Instruction* end, const Batch* values,
                                                 Batch* results) {
  run_wide(begin, end, values, results);
}

__attribute__((target("avx512f"))) void run_by_avx512(const Instruction* begin, const Instruction* end,
                                                      const Batch* values, Batch* results) {
  run_wide(begin, end, values, results);
}

#else

void run_by_avx2(const Instruction*, const Instruction*, const Batch*, Batch*) {
  core::ensure(false, "the processor has such registers");
}

void run_by_avx512(const Instruction*, const Instruction*, const Batch*, Batch*) {
  core::ensure(false, "the processor has such registers");
}

#endif

void run(const Instruction* begin, const Instruction* end, const Batch* values, Batch* results) {
  static const auto way = interval_batch::has_avx512() ? run_by_avx512
                          : interval_batch::has_avx2() ? run_by_avx2
                                                       : run_by_lanes;
  way(begin, end, values, results);
}

}  // namespace clearloci::loci::sheet::batch
