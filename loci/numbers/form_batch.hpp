// Polynomials of second order that enclose functions over eight cells side by side, with every local coordinate of a
// cell a noise e_i in [-1, 1]:
//     f(x) in c + sum a_i e_i + sum_{i <= j} b_ij e_i e_j + [-r, r]
// as loci/numbers/affine.hpp has them, for the programs of sheets: what is linear and quadratic cancels before it is
// bounded, and r shrinks with the cube of a cell. r takes up every rounding. Where nothing is known r is no finite
// number.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/interval.hpp"
#include "loci/numbers/sheet_code.hpp"

namespace clearloci::loci::sheet {

/// `N`: coordinates.
template <std::size_t N>
struct Form {
  static constexpr std::size_t products = N * (N + 1) / 2;
  /// Where the coefficient of e_i e_j is, i <= j.
  static constexpr std::size_t place(std::size_t i, std::size_t j) { return i * N - i * (i + 1) / 2 + j; }

  double c = 0, r = 0;
  std::array<double, N> a{};
  std::array<double, products> b{};  ///< of e_0^2, e_0 e_1, ..., e_1^2, ...
};

template <std::size_t N>
struct FormBatch {
  static constexpr std::size_t size = 8, products = Form<N>::products;
  struct alignas(64) Lanes {
    std::array<double, size> of{};
  };
  Lanes c, r;
  std::array<Lanes, N> a;
  std::array<Lanes, products> b;

  FormBatch() = default;
  FormBatch(const Interval& same) {  // NOLINT: a number is the same in every lane
    const Form<N> form = number(same);
    for (std::size_t lane = 0; lane < size; ++lane) set_lane(lane, form);
  }

  static Form<N> number(const Interval& range) {
    Form<N> form;
    form.c = range.middle();
    if (range.width() != 0) form.r = std::fmax(range.upper() - form.c, form.c - range.lower()) * (1 + 0x1p-51);
    return form;
  }
  /// The coordinate of noise i.
  static Form<N> coordinate(const Interval& range, std::size_t i) {
    Form<N> form = number(range);
    std::swap(form.r, form.a[i]);
    return form;
  }
  static Form<N> unknown() {
    Form<N> form;
    form.r = std::numeric_limits<double>::infinity();
    return form;
  }

  Form<N> lane(std::size_t l) const {
    Form<N> form;
    form.c = c.of[l];
    form.r = r.of[l];
    for (std::size_t i = 0; i < N; ++i) form.a[i] = a[i].of[l];
    for (std::size_t k = 0; k < products; ++k) form.b[k] = b[k].of[l];
    return form;
  }
  void set_lane(std::size_t l, const Form<N>& form) {
    c.of[l] = form.c;
    r.of[l] = form.r;
    for (std::size_t i = 0; i < N; ++i) a[i].of[l] = form.a[i];
    for (std::size_t k = 0; k < products; ++k) b[k].of[l] = form.b[k];
  }
};

namespace form_batch {

using Instruction = SheetCode::Instruction;

/// The instructions [begin, end) on registers `values`, their results from `results` on. Of two, three and four
/// coordinates.
template <std::size_t N>
void run(const Instruction* begin, const Instruction* end, const FormBatch<N>* values, FormBatch<N>* results);

/// Roots of a root's squares, not known where a square is not proven to be positive.
template <std::size_t N>
void take_root(const FormBatch<N>& square, FormBatch<N>& root);

}  // namespace form_batch

}  // namespace clearloci::loci::sheet
