#include "loci/numbers/form_batch.hpp"

#include <limits>

#include "core/errors.hpp"
#include "loci/numbers/interval_batch.hpp"

#if defined(__x86_64__) && defined(__GNUC__)
#define CLEARLOCI_WIDE_FORMS
#endif

namespace clearloci::loci::sheet::form_batch {
namespace {

using Operation = SheetCode::Operation;

/// Eight doubles as one number: the compiler takes as many registers as the processor needs for it. Small structures by
/// reference and nothing by value, which compilers would pass differently for every processor.
using Wide __attribute__((vector_size(64), may_alias)) = double;

// Sums of some roundings, one part in 2^48 of what was summed; numbers that are not normal.
constexpr double roundings = 0x1p-48, tiny = 0x1p-1000;

#define CLEARLOCI_INLINE __attribute__((always_inline)) inline

template <class Lanes>
CLEARLOCI_INLINE const Wide& wide(const Lanes& lanes) {
  return reinterpret_cast<const Wide&>(lanes);
}
template <class Lanes>
CLEARLOCI_INLINE Wide& wide(Lanes& lanes) {
  return reinterpret_cast<Wide&>(lanes);
}

#define CLEARLOCI_ABS(value) ((value) < 0 ? -(value) : (value))

template <std::size_t N>
struct Sizes {
  Wide linear, quadratic;
};

template <std::size_t N>
CLEARLOCI_INLINE void measure(const FormBatch<N>& x, Sizes<N>& sizes) {
  sizes.linear = CLEARLOCI_ABS(wide(x.a[0]));
  for (std::size_t i = 1; i < N; ++i) sizes.linear += CLEARLOCI_ABS(wide(x.a[i]));
  sizes.quadratic = CLEARLOCI_ABS(wide(x.b[0]));
  for (std::size_t k = 1; k < FormBatch<N>::products; ++k) sizes.quadratic += CLEARLOCI_ABS(wide(x.b[k]));
}

template <int sign, std::size_t N>
CLEARLOCI_INLINE void add(const FormBatch<N>& x, const FormBatch<N>& y, FormBatch<N>& sum) {
  const auto joined = [](const auto& p, const auto& q, auto& result) __attribute__((always_inline)) {
    if constexpr (sign > 0)
      wide(result) = wide(p) + wide(q);
    else
      wide(result) = wide(p) - wide(q);
  };
  joined(x.c, y.c, sum.c);
  for (std::size_t i = 0; i < N; ++i) joined(x.a[i], y.a[i], sum.a[i]);
  for (std::size_t k = 0; k < FormBatch<N>::products; ++k) joined(x.b[k], y.b[k], sum.b[k]);
  Sizes<N> sizes;
  measure(sum, sizes);
  const Wide r = wide(x.r) + wide(y.r);
  wide(sum.r) = r + ((CLEARLOCI_ABS(wide(sum.c)) + sizes.linear + sizes.quadratic + r) * roundings + tiny);
}

/// The products of the linear parts of `x` and `y`, times `factor`, onto the quadratic one of `sum`.
template <std::size_t N>
CLEARLOCI_INLINE void add_linear_product(const FormBatch<N>& x, const FormBatch<N>& y, const Wide& factor,
                                         FormBatch<N>& sum) {
  for (std::size_t i = 0; i < N; ++i) {
    const Wide scaled = wide(x.a[i]) * factor;
    for (std::size_t j = 0; j < N; ++j) {
      Wide& b = wide(sum.b[i <= j ? Form<N>::place(i, j) : Form<N>::place(j, i)]);
      b += scaled * wide(y.a[j]);
    }
  }
}

template <std::size_t N>
CLEARLOCI_INLINE void multiply(const FormBatch<N>& x, const FormBatch<N>& y, FormBatch<N>& product) {
  const Wide cx = wide(x.c), cy = wide(y.c);
  for (std::size_t i = 0; i < N; ++i) wide(product.a[i]) = cx * wide(y.a[i]) + cy * wide(x.a[i]);
  for (std::size_t k = 0; k < FormBatch<N>::products; ++k) wide(product.b[k]) = cx * wide(y.b[k]) + cy * wide(x.b[k]);
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j)
      wide(product.b[i <= j ? Form<N>::place(i, j) : Form<N>::place(j, i)]) += wide(x.a[i]) * wide(y.a[j]);
  wide(product.c) = cx * cy;
  Sizes<N> of_x, of_y;
  measure(x, of_x);
  measure(y, of_y);
  const Wide rx = wide(x.r), ry = wide(y.r);
  const Wide size_x = CLEARLOCI_ABS(cx) + of_x.linear + of_x.quadratic,
             size_y = CLEARLOCI_ABS(cy) + of_y.linear + of_y.quadratic;
  const Wide r = of_x.linear * of_y.quadratic + of_x.quadratic * (of_y.linear + of_y.quadratic) + size_x * ry +
                 size_y * rx + rx * ry;
  wide(product.r) = r + ((size_x * size_y + r) * roundings + tiny);
}

/// Of a function at x.c: its value, its slope and half its second derivative; the rest of its series is at most `rest`
/// over x.
struct Series {
  Wide value, slope, half_second, rest;
};

template <std::size_t N>
CLEARLOCI_INLINE void compose(const FormBatch<N>& x, const Sizes<N>& sizes, const Series& f, FormBatch<N>& result) {
  const Wide bent = sizes.quadratic + wide(x.r), reach = sizes.linear + bent;
  const Wide slope = CLEARLOCI_ABS(f.slope), second = CLEARLOCI_ABS(f.half_second);
  wide(result.c) = f.value;
  for (std::size_t i = 0; i < N; ++i) wide(result.a[i]) = f.slope * wide(x.a[i]);
  for (std::size_t k = 0; k < FormBatch<N>::products; ++k) wide(result.b[k]) = f.slope * wide(x.b[k]);
  add_linear_product(x, x, f.half_second, result);
  const Wide r = slope * wide(x.r) + second * bent * (2 * sizes.linear + bent) + f.rest;
  wide(result.r) = r + ((CLEARLOCI_ABS(f.value) + slope * reach + second * reach * reach + r) * (2 * roundings) + tiny);
}

template <std::size_t N>
CLEARLOCI_INLINE void square(const FormBatch<N>& x, FormBatch<N>& result) {
  multiply(x, x, result);
}

/// From 0, at least; not above 0 where it may be reached. Takes what is no number for unknown.
template <std::size_t N>
CLEARLOCI_INLINE void measure_away(const FormBatch<N>& x, const Sizes<N>& sizes, Wide& reach, Wide& away) {
  const Wide c = CLEARLOCI_ABS(wide(x.c));
  reach = (sizes.linear + sizes.quadratic + wide(x.r)) * (1 + roundings);
  away = c - reach - c * roundings - tiny;
}

/// Nothing is known where `away` is not above 0.
template <std::size_t N>
CLEARLOCI_INLINE void forget_where_not(const Wide& away, FormBatch<N>& result) {
  const Wide none = {}, infinite = none + std::numeric_limits<double>::infinity();
  wide(result.c) = away > 0 ? wide(result.c) : none;
  for (auto& a : result.a) wide(a) = away > 0 ? wide(a) : none;
  for (auto& b : result.b) wide(b) = away > 0 ? wide(b) : none;
  wide(result.r) = away > 0 ? wide(result.r) : infinite;
}

/// 1 / (c + d) = 1/c - d/c^2 + d^2/c^3 - d^3 / (c^3 (c + d)).
template <std::size_t N>
CLEARLOCI_INLINE void invert(const FormBatch<N>& x, FormBatch<N>& result) {
  Sizes<N> sizes;
  measure(x, sizes);
  Wide reach, away;
  measure_away(x, sizes, reach, away);
  const Wide value = 1 / wide(x.c), squared = value * value, cubed = squared * value;
  const Wide rest = CLEARLOCI_ABS(cubed) * reach * reach * reach / away;
  compose(x, sizes, {value, -squared, cubed, rest}, result);
  forget_where_not(away, result);
}

template <std::size_t N>
CLEARLOCI_INLINE void root(const FormBatch<N>& x, FormBatch<N>& result) {
  Sizes<N> sizes;
  measure(x, sizes);
  Wide reach, away, value, root_away;
  measure_away(x, sizes, reach, away);
  away = wide(x.c) > 0 ? away : -CLEARLOCI_ABS(away);
  for (std::size_t l = 0; l < FormBatch<N>::size; ++l) {
    value[l] = std::sqrt(x.c.of[l]);
    root_away[l] = std::sqrt(away[l]);
  }
  const Wide inverse = 0.5 / value, second = -0.25 * inverse / wide(x.c);
  // A third of half the third derivative: 3/8 t^(-5/2) / 6.
  const Wide rest = reach * reach * reach / (16 * away * away * root_away);
  compose(x, sizes, {value, inverse, second, rest}, result);
  forget_where_not(away, result);
}

template <std::size_t N>
CLEARLOCI_INLINE void run_wide(const Instruction* begin, const Instruction* end, const FormBatch<N>* values,
                               FormBatch<N>* results) {
  while (begin != end) {
    const Operation operation = begin->operation;
    const auto go_on = [&] { return ++begin != end && begin->operation == operation; };
    switch (operation) {
      case Operation::add:
        do add<1>(values[begin->first], values[begin->second], *results++);
        while (go_on());
        break;
      case Operation::subtract:
        do add<-1>(values[begin->first], values[begin->second], *results++);
        while (go_on());
        break;
      case Operation::multiply:
        do multiply(values[begin->first], values[begin->second], *results++);
        while (go_on());
        break;
      case Operation::square:
        do square(values[begin->first], *results++);
        while (go_on());
        break;
      case Operation::inverse:
        do invert(values[begin->first], *results++);
        while (go_on());
        break;
      default:  // of angles nothing is told
        do
          for (std::size_t l = 0; l < FormBatch<N>::size; ++l) results->set_lane(l, FormBatch<N>::unknown());
        while (++results, go_on());
    }
  }
}

template <std::size_t N>
using Run = void (*)(const Instruction*, const Instruction*, const FormBatch<N>*, FormBatch<N>*);

template <std::size_t N>
void run_plain(const Instruction* begin, const Instruction* end, const FormBatch<N>* values, FormBatch<N>* results) {
  run_wide(begin, end, values, results);
}
template <std::size_t N>
__attribute__((target("avx2"))) void run_by_avx2(const Instruction* begin, const Instruction* end,
                                                 const FormBatch<N>* values, FormBatch<N>* results) {
  run_wide(begin, end, values, results);
}
template <std::size_t N>
__attribute__((target("avx512f,avx512dq"))) void run_by_avx512(const Instruction* begin, const Instruction* end,
                                                               const FormBatch<N>* values, FormBatch<N>* results) {
  run_wide(begin, end, values, results);
}

}  // namespace

template <std::size_t N>
void run(const Instruction* begin, const Instruction* end, const FormBatch<N>* values, FormBatch<N>* results) {
  static const auto way = interval_batch::has_avx512() ? Run<N>{run_by_avx512<N>}
                          : interval_batch::has_avx2() ? Run<N>{run_by_avx2<N>}
                                                       : Run<N>{run_plain<N>};
  way(begin, end, values, results);
}

template <std::size_t N>
void take_root(const FormBatch<N>& square_of_it, FormBatch<N>& result) {
  root(square_of_it, result);
}

template void run(const Instruction*, const Instruction*, const FormBatch<2>*, FormBatch<2>*);
template void run(const Instruction*, const Instruction*, const FormBatch<3>*, FormBatch<3>*);
template void run(const Instruction*, const Instruction*, const FormBatch<4>*, FormBatch<4>*);
template void take_root(const FormBatch<2>&, FormBatch<2>&);
template void take_root(const FormBatch<3>&, FormBatch<3>&);
template void take_root(const FormBatch<4>&, FormBatch<4>&);

}  // namespace clearloci::loci::sheet::form_batch
