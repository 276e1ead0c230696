#include "loci/sheet/form_cells.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace clearloci::loci::sheet {
namespace {

// Of sums of some tens of terms.
constexpr double roundings = 0x1p-46, tiny = 0x1p-1000;
constexpr int sweeps = 3;

/// m - d <= e <= m + d.
struct Noise {
  double m = 0, d = 1;
};
template <std::size_t N>
using Noises = std::array<Noise, N>;

struct Range {
  double lower, upper;
};

/// Of the form without the linear term of noise `skipped`. Not a number where nothing is known.
template <std::size_t N>
Range range_of(const Form<N>& form, const Noises<N>& noises, std::size_t skipped = N) {
  double middle = form.c, radius = form.r, size = std::abs(form.c);
  for (std::size_t i = 0; i < N; ++i) {
    if (i == skipped) continue;
    middle += form.a[i] * noises[i].m;
    radius += std::abs(form.a[i]) * noises[i].d;
    size += std::abs(form.a[i]);
  }
  std::size_t k = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const Noise& p = noises[i];
    const double half = 0.5 * p.d * p.d;
    middle += form.b[k] * (p.m * p.m + half);
    radius += std::abs(form.b[k]) * (2 * std::abs(p.m) * p.d + half);
    size += std::abs(form.b[k]);
    ++k;
    for (std::size_t j = i + 1; j < N; ++j, ++k) {
      const Noise& q = noises[j];
      middle += form.b[k] * p.m * q.m;
      radius += std::abs(form.b[k]) * (std::abs(p.m) * q.d + (std::abs(q.m) + q.d) * p.d);
      size += std::abs(form.b[k]);
    }
  }
  radius += 4 * (size + radius) * roundings + tiny;
  return {middle - radius, middle + radius};
}

bool excludes_zero(const Range& range) { return range.lower > 0 || range.upper < 0; }

/// False: the noise cannot be in the range.
bool meet_noise(Noise& noise, const Range& range) {
  const double lower = std::fmax(noise.m - noise.d, range.lower), upper = std::fmin(noise.m + noise.d, range.upper);
  if (lower > upper + roundings) return false;
  noise.m = 0.5 * (lower + upper);
  noise.d = std::fmin(noise.d, 0.5 * std::abs(upper - lower) + 0x1p-48);
  return true;
}

template <std::size_t N>
Form<N> combined(std::span<const Form<N>> forms, const double* factors) {
  Form<N> sum;
  double size = 0;
  for (std::size_t f = 0; f < forms.size(); ++f) {
    const double factor = factors[f];
    const Form<N>& form = forms[f];
    sum.c += factor * form.c;
    sum.r += std::abs(factor) * form.r;
    double own = std::abs(form.c);
    for (std::size_t i = 0; i < N; ++i) {
      sum.a[i] += factor * form.a[i];
      own += std::abs(form.a[i]);
    }
    for (std::size_t k = 0; k < Form<N>::products; ++k) {
      sum.b[k] += factor * form.b[k];
      own += std::abs(form.b[k]);
    }
    size += std::abs(factor) * own;
  }
  sum.r += (size + sum.r) * roundings + tiny;
  return sum;
}

/// A part of a coordinate's range.
Interval part_of(const Interval& range, const Noise& noise) {
  const double middle = range.middle();
  const double half = std::fmax(range.upper() - middle, middle - range.lower()) * (1 + 0x1p-51);
  const Interval part = Interval(middle) + Interval(half) * (Interval(noise.m) + Interval(-noise.d, noise.d));
  return meet(part, range);
}

}  // namespace

template <std::size_t N>
FormCells<N>::FormCells(const SheetProgram& program, core::WorkingMode mode)
    : program_(&program), mode_(std::move(mode)), registers_(program.registers<FormBatch<N>>()) {}

template <std::size_t N>
void FormCells<N>::enter(const std::array<Place, size>& places, std::size_t count) {
  places_ = places;
  outside_.fill(false);
  FormBatch<N> batch;
  for (const int c : {0, 1}) {
    for (std::size_t lane = 0; lane < count; ++lane)
      batch.set_lane(lane, FormBatch<N>::coordinate((*places[lane].all)[c], static_cast<std::size_t>(c)));
    registers_.set(c, batch);
  }
  std::array<std::size_t, size> next{};
  for (int j = 0; j < program_->roots(); ++j) {
    registers_.run_square(j);
    const FormBatch<N>& square = registers_.square(j);
    form_batch::take_root(square, batch);
    for (std::size_t lane = 0; lane < count; ++lane) {
      Form<N> own = square.lane(lane);
      if (range_of(own, Noises<N>{}).upper < 0) outside_[lane] = true;
      const std::vector<int>& lifted = *places[lane].lifted;
      if (next[lane] < lifted.size() && lifted[next[lane]] == j) {
        const std::size_t noise = 2 + next[lane];
        const Form<N> root = FormBatch<N>::coordinate((*places[lane].all)[2 + static_cast<std::size_t>(j)], noise);
        batch.set_lane(lane, root);
        own.c = root.c * root.c - own.c;
        for (double& a : own.a) a = -a;
        for (double& b : own.b) b = -b;
        own.a[noise] += 2 * root.c * root.a[noise];
        own.b[Form<N>::place(noise, noise)] += root.a[noise] * root.a[noise];
        const double reach = std::abs(root.c) + root.a[noise];
        own.r += roundings * (reach * reach + std::abs(own.c) + own.r) + tiny;
        bonds_[lane][next[lane]++] = own;
      } else if (mode_[static_cast<std::size_t>(j)] < 0) {
        Form<N> negative = batch.lane(lane);
        negative.c = -negative.c;
        for (double& a : negative.a) a = -a;
        for (double& b : negative.b) b = -b;
        batch.set_lane(lane, negative);
      }
    }
    registers_.set(2 + j, batch);
  }
  registers_.run_values();
}

template <std::size_t N>
bool FormCells<N>::contract(std::size_t lane, const System& system, std::vector<Interval>& all) const {
  if (outside_[lane]) return false;
  const std::vector<int>& lifted = *places_[lane].lifted;
  std::array<Form<N>, N> forms;
  std::array<std::size_t, N> unknowns{};
  const std::size_t given = system.functions.size(), n = given + lifted.size();
  Noises<N> noises{};
  for (std::size_t f = 0; f < given; ++f) {
    forms[f] = value(lane, system.functions[f]);
    unknowns[f] = static_cast<std::size_t>(system.free[f]);
  }
  for (std::size_t l = 0; l < lifted.size(); ++l) {
    forms[given + l] = bonds_[lane][l];
    unknowns[given + l] = 2 + l;
  }
  for (std::size_t f = 0; f < n; ++f)
    if (excludes_zero(range_of(forms[f], noises))) return false;
  for (const int f : system.also)
    if (excludes_zero(range_of(value(lane, f), noises))) return false;
  std::array<double, N * N> jacobian{}, inverse{};
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = 0; column < n; ++column) jacobian[row * n + column] = forms[row].a[unknowns[column]];
  if (!invert(std::span(jacobian).first(n * n), std::span(inverse).first(n * n), n)) return true;
  std::array<Form<N>, N> solved;
  for (std::size_t i = 0; i < n; ++i) {
    solved[i] = combined<N>(std::span<const Form<N>>(forms).first(n), &inverse[i * n]);
    // e_i - (its sum) is zero where the sum is.
    for (double& a : solved[i].a) a = -a;
    for (double& b : solved[i].b) b = -b;
    solved[i].c = -solved[i].c;
    solved[i].r += 0x1p-52 * std::abs(solved[i].a[unknowns[i]]);
    solved[i].a[unknowns[i]] += 1;
  }
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t i = 0; i < n; ++i)
      if (!meet_noise(noises[unknowns[i]], range_of(solved[i], noises))) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t c = unknowns[i];
    Interval& range = all[c < 2 ? c : 2 + static_cast<std::size_t>(lifted[c - 2])];
    range = part_of(range, noises[c]);
  }
  return true;
}

template class FormCells<2>;
template class FormCells<3>;
template class FormCells<4>;

}  // namespace clearloci::loci::sheet
