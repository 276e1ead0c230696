#include "loci/numbers/batch.hpp"

#include "core/errors.hpp"
#include "loci/numbers/result_of.hpp"

namespace clearloci::loci::sheet::batch {

void run_by_lanes(const Instruction* begin, const Instruction* end, const Batch* values, Batch* results) {
  run_instructions(begin, end, values, results);
}

#if defined(__x86_64__) && defined(__GNUC__)

namespace {

/// A batch as one number: the compiler takes as many registers as the processor needs for it.
using Wide __attribute__((vector_size(sizeof(Batch)), aligned(alignof(Batch)), may_alias)) = double;

inline const Wide& wide(const Batch& a) { return reinterpret_cast<const Wide&>(a); }
inline Wide& wide(Batch& a) { return reinterpret_cast<Wide&>(a); }

/// As run_instructions().
__attribute__((always_inline)) inline void run_wide(const Instruction* begin, const Instruction* end,
                                                    const Batch* values, Batch* results) {
  using Operation = SheetCode::Operation;
  while (begin != end) {
    const Operation operation = begin->operation;
    const auto go_on = [&] { return ++begin != end && begin->operation == operation; };
    switch (operation) {
      case Operation::add:
        do wide(*results++) = wide(values[begin->first]) + wide(values[begin->second]);
        while (go_on());
        break;
      case Operation::subtract:
        do wide(*results++) = wide(values[begin->first]) - wide(values[begin->second]);
        while (go_on());
        break;
      case Operation::multiply:
        do wide(*results++) = wide(values[begin->first]) * wide(values[begin->second]);
        while (go_on());
        break;
      case Operation::square:
        do wide(*results++) = wide(values[begin->first]) * wide(values[begin->first]);
        while (go_on());
        break;
      case Operation::inverse:
        do wide(*results++) = 1 / wide(values[begin->first]);
        while (go_on());
        break;
      default:
        do *results++ = result_of(operation, values[begin->first], values[begin->second]);
        while (go_on());
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
