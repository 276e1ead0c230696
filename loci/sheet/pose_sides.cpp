// What is known of a cell in doubt (pose_cell.hpp): signs, and the parts on both sides of what may vanish in it.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "loci/sheet/pose_cell.hpp"

namespace clearloci::loci::pose {
namespace {

using Matrix = std::vector<std::vector<double>>;

Matrix identity(std::size_t n) {
  Matrix identity(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) identity[i][i] = 1;
  return identity;
}

/// X A Y = diag(1, ..., 1, s) to rounding, and the sign of |X| |Y|.
struct Reduced {
  Matrix left, right;
  int sign = 1;
};

/// Gauss and Jordan with complete pivoting. Nothing where more than one pivot is small.
std::optional<Reduced> reduced(Matrix a) {
  constexpr double least_pivot = 1e-10;  // of the largest: beyond, rounding would be all
  const std::size_t n = a.size();
  Reduced reduced{identity(n), identity(n), 1};
  double first = 0;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    std::size_t row = k, column = k;
    for (std::size_t i = k; i < n; ++i)
      for (std::size_t j = k; j < n; ++j)
        if (std::abs(a[i][j]) > std::abs(a[row][column])) {
          row = i;
          column = j;
        }
    const double pivot = a[row][column];
    if (k == 0) first = std::abs(pivot);
    if (!std::isfinite(pivot) || !(std::abs(pivot) > least_pivot * first)) return std::nullopt;
    if (row != k) {
      std::swap(a[row], a[k]);
      std::swap(reduced.left[row], reduced.left[k]);
      reduced.sign = -reduced.sign;
    }
    if (column != k) {
      for (std::size_t i = 0; i < n; ++i) {
        std::swap(a[i][column], a[i][k]);
        std::swap(reduced.right[i][column], reduced.right[i][k]);
      }
      reduced.sign = -reduced.sign;
    }
    if (pivot < 0) reduced.sign = -reduced.sign;
    for (std::size_t j = 0; j < n; ++j) {
      a[k][j] /= pivot;
      reduced.left[k][j] /= pivot;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = a[i][k];
      if (i == k || factor == 0) continue;
      for (std::size_t j = 0; j < n; ++j) {
        a[i][j] -= factor * a[k][j];
        reduced.left[i][j] -= factor * reduced.left[k][j];
      }
    }
    for (std::size_t j = k + 1; j < n; ++j) {
      const double factor = a[k][j];
      if (factor == 0) continue;
      a[k][j] = 0;
      for (std::size_t i = 0; i < n; ++i) reduced.right[i][j] -= factor * reduced.right[i][k];
    }
  }
  return reduced;
}

double largest(const std::vector<Affine>& all, std::size_t count) {
  double most = 0;
  for (std::size_t i = 0; i < count; ++i) most = std::max(most, all[i].magnitude());
  return most;
}

/// A number of size `size` at most, of any sign, added.
Affine widened(Affine x, double size) {
  x.r = (x.r + size) * (1 + 0x1p-45);
  return x;
}

constexpr double roundings = 1e-12;  // of the few sums below, as a part of the cell

/// Where all forms are positive, of one direction for all.
HalfSpace where_positive(const std::vector<Affine>& forms) {
  const Affine first = forms.front().flattened();
  const double length = first.linear();
  if (!(length > 0)) return {};
  std::array<double, Affine::noises> way{};
  double square = 0, beyond = -1;
  for (std::size_t p = 0; p < way.size(); ++p) {
    way[p] = first.a[p] / length;
    square += way[p] * way[p];
  }
  for (const Affine& affine : forms) {
    const Affine form = affine.flattened();
    double along = 0, off = 0;
    for (std::size_t p = 0; p < way.size(); ++p) along += form.a[p] * way[p];
    along /= square;
    if (!(along > 0)) return {};
    for (std::size_t p = 0; p < way.size(); ++p) off += std::abs(form.a[p] - along * way[p]);
    beyond = std::max(beyond, (form.r + off - form.c) / along);
  }
  return HalfSpace::within(way, beyond + roundings);
}

/// Of a demand of one component its sign; of others +1, where they are told from those of a smaller size.
int sign_of_kept(int sign, double least) { return sign == 0 && least > 0 ? 1 : sign; }

int sign_of(const Affine& x) { return x.contains_zero() ? 0 : x.c > 0 ? 1 : -1; }

}  // namespace

/// One direction `way` for all forms: with form_i = c_i + l_i (way . e) + d_i . e + [-r_i, r_i],
///     way . e > (least_i + r_i - c_i + |d_i|) / l_i   makes form_i > least_i,
/// and likewise on the other side. Forms that vanish on one surface have nearly one direction; of others little is
/// left. `turned`: what the sign of a demand is multiplied by where |A|'s form is positive (0: it is not open).
template <>
void PoseCell::sides_of(const std::vector<Open>& open, const std::vector<int>& turned, Known& sides_known) const {
  if (open.empty()) return;
  const Affine first = open.front().form.flattened();
  const double length = first.linear();
  if (!(length > 0)) return;
  std::array<double, Affine::noises> way{};
  double square = 0;
  for (std::size_t p = 0; p < way.size(); ++p) {
    way[p] = first.a[p] / length;
    square += way[p] * way[p];
  }
  std::array<double, 2> beyond = {-1, -1};
  std::vector<int> alike;
  for (const Open& open_side : open) {
    double along = 0, off = 0;
    const Affine form = open_side.form.flattened();
    for (std::size_t p = 0; p < way.size(); ++p) along += form.a[p] * way[p];
    along /= square;
    if (along == 0) return;
    for (std::size_t p = 0; p < way.size(); ++p) off += std::abs(form.a[p] - along * way[p]);
    alike.push_back(along > 0 ? 1 : -1);
    const double beside = open_side.least + form.r + off, centre = alike.back() * form.c, rise = std::abs(along);
    beyond[0] = std::max(beyond[0], (beside - centre) / rise);
    beyond[1] = std::max(beyond[1], (beside + centre) / rise);
  }
  for (std::size_t side = 0; side < 2; ++side) {
    std::array<double, Affine::noises> affines = way;
    if (side == 1)
      for (double& value : affines) value = -value;
    sides_known.parts[side] = HalfSpace::within(affines, beyond[side] + roundings);
    Signs& signs = sides_known.of_parts[side] = sides_known.signs;
    const int here = side == 0 ? 1 : -1;
    int determinant = 1;
    for (std::size_t i = 0; i < open.size(); ++i)
      if (open[i].demand < 0) {
        determinant = here * alike[i];
        signs.back() = determinant * open[i].sign;
      }
    for (std::size_t d = 0; d < turned.size(); ++d)
      if (turned[d] != 0) signs[d] = turned[d] * determinant;
    for (std::size_t i = 0; i < open.size(); ++i)
      if (open[i].demand >= 0)
        signs[static_cast<std::size_t>(open[i].demand)] = here * alike[i] * open[i].sign * determinant;
  }
}

template <>
PoseCell::Known PoseCell::known() {
  Known sides_known;
  const std::size_t demands = statics_->demands.size();
  sides_known.signs.assign(demands + 1, 0);
  if (doubt_ == Doubt::workspace) know_at_boundary(sides_known);
  if (doubt_ == Doubt::singularity) know_near_singularity(sides_known);
  if (doubt_ == Doubt::demand) know_at_demand(sides_known);
  drop_parts_beyond_bounds(sides_known);
  return sides_known;
}

template <>
void PoseCell::know_at_demand(Known& sides_known) {
  const std::size_t demands = statics_->demands.size();
  const int demand = demand_;
  const std::array<double, Affine::noises> spreads = spreads_;
  sides_known.signs.back() = determinant_;
  std::vector<Open> open;
  for (std::size_t d = 0; d < demands; ++d) {
    if (keeps(static_cast<int>(d))) {
      sides_known.signs[d] = sign_of_kept(kept_[d].sign, leasts_[d]);
      continue;
    }
    Open what = kept_[d];
    const bool is_small = is_below(static_cast<int>(d));
    if (is_small) what.least = 0, what.sign *= below;
    if (is_small && what.form.lower() > 0) {
      sides_known.signs[d] = below * sign_of_kept(kept_[d].sign, leasts_[d]);
      continue;
    }
    sides_known.open.emplace_back(is_small ? Doubt::zero : Doubt::demand, static_cast<int>(d));
    open.push_back(what);
  }
  sides_known.free = open.empty();
  demand_ = demand;
  doubt_ = Doubt::demand;
  spreads_ = spreads;
  if (sides_known.free) return;
  sides_of(open, {}, sides_known);
  // Where A is not far from singular its inverse is known badly, and s g well.
  constexpr double well_known = 0.1;
  if (contraction_ < well_known) return;
  Known other;
  other.signs.assign(demands + 1, 0);
  know_near_singularity(other);
  const auto share = [](const Known& one) {
    return one.free || one.outside ? 1.0 : share_of(one.parts[0]) + share_of(one.parts[1]);
  };
  if (share(other) > share(sides_known)) sides_known = other;
}

template <>
bool PoseCell::has_effort_beyond(const Signs& signs) const {
  for (std::size_t d = 0; d < statics_->demands.size() && d < signs.size(); ++d)
    if (statics_->demands[d].demand.bound && signs[d] < 0) return true;
  return false;
}

/// Where an effort is beyond its bound there is no state: such a part is none.
template <>
void PoseCell::drop_parts_beyond_bounds(Known& sides_known) const {
  if (has_effort_beyond(sides_known.of_parts[0])) {
    std::swap(sides_known.parts[0], sides_known.parts[1]);
    std::swap(sides_known.of_parts[0], sides_known.of_parts[1]);
    if (has_effort_beyond(sides_known.of_parts[0])) sides_known.parts[0] = {};
  }
  if (has_effort_beyond(sides_known.of_parts[1]) && !sides_known.parts[1].empty()) sides_known.beyond = true;
}

/// The first part is within reach and free of all that may vanish, the second out of reach.
template <>
void PoseCell::know_at_boundary(Known& sides_known) {
  sides_known.open.emplace_back(Doubt::workspace, -1);
  const std::array<double, Affine::noises> spreads = spreads_;
  std::vector<Affine> closures;
  const State state = run(*chart_, *box_, &closures);
  sides_known.outside = state == State::outside;
  if (state == State::proven && invert() && is_regular()) {
    sides_known.signs.back() = determinant_;
    solve(0);
    bool all = true;
    for (std::size_t d = 0; d < statics_->demands.size(); ++d) {
      const bool kept = keeps(static_cast<int>(d));
      if (kept) sides_known.signs[d] = kept_[d].sign;
      all = all && kept;
    }
    if (all && !closures.empty()) {
      sides_known.parts[0] = where_positive(closures);
      sides_known.of_parts[0] = sides_known.signs;
    }
  }
  double most = 0;
  for (const Affine& closure : closures) {
    const HalfSpace part = where_positive({Affine(0.0) - closure});
    if (part.empty() || share_of(part) <= most) continue;
    most = share_of(part);
    sides_known.parts[1] = part;
    sides_known.beyond = true;
  }
  doubt_ = Doubt::workspace;
  demand_ = -1;
  spreads_ = spreads;
}

template <>
void PoseCell::know_near_singularity(Known& sides_known) {
  constexpr std::size_t most = 40;  // unknowns: beyond, a cell costs more than its halves
  sides_known.open.emplace_back(Doubt::singularity, -1);
  if (n_ == 0 || n_ > most) return;
  Matrix middle(n_, std::vector<double>(n_, 0.0));
  for (std::size_t column = 0; column < n_; ++column)
    for (const Entry& entry : columns_[column])
      middle[static_cast<std::size_t>(entry.row)][column] = step(entry.step).c;
  const std::optional<Reduced> change = reduced(std::move(middle));
  if (!change) return;
  const Matrix &X = change->left, &Y = change->right;
  const std::size_t last = n_ - 1;
  // M = X A Y.
  std::vector<std::vector<Affine>> M(n_, std::vector<Affine>(n_));
  std::vector<Affine> row(n_);
  std::vector<double> sizes(n_);
  double contraction = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t l = 0; l < n_; ++l) {
      AffineSum sum;
      for (const Entry& entry : columns_[l])
        if (const double factor = X[i][static_cast<std::size_t>(entry.row)]; factor != 0)
          add_step(sum, factor, entry.step);
      row[l] = sum.result();
      sizes[l] = row[l].size();
    }
    double off = 0;
    for (std::size_t j = 0; j < n_; ++j) {
      AffineSum sum;
      for (std::size_t l = 0; l < n_; ++l)
        if (Y[l][j] != 0) sum.add(Y[l][j], row[l], sizes[l]);
      M[i][j] = sum.result();
      if (i < last && j < last) off += (i == j ? M[i][j] - Affine(1.0) : M[i][j]).magnitude();
    }
    if (i < last) contraction = std::max(contraction, off * (1 + 0x1p-40));
  }
  if (!(contraction < 1)) return;
  const double rest = contraction / (1 - contraction) * (1 + 0x1p-40);  // of (I + E)^-1 - I
  std::vector<Affine> y, p;
  for (std::size_t i = 0; i < n_; ++i) {
    AffineSum sum;
    for (std::size_t j = 0; j < n_; ++j)
      if (X[i][j] != 0) add_step(sum, X[i][j], statics_->equations[j].free.front());
    y.push_back(sum.result());
    p.push_back(M[i][last]);
  }
  Affine s = M[last][last], N = y[last];
  double q = 0;
  for (std::size_t j = 0; j < last; ++j) {
    s = s - M[last][j] * p[j];
    N = N - M[last][j] * y[j];
    q += M[last][j].magnitude();
  }
  s = widened(s, q * rest * largest(p, last));
  N = widened(N, q * rest * largest(y, last));
  std::vector<Affine> u;
  for (std::size_t j = 0; j < last; ++j) u.push_back(s * y[j] - p[j] * N);
  const double rest_of_u = rest * largest(u, last);

  const int side = sign_of(s);  // 0: on both
  std::vector<Open> open;
  if (side == 0) open.push_back({s, 0, -1, change->sign});
  std::vector<int> turned(statics_->demands.size(), 0);
  if (side != 0) sides_known.open.clear();
  const auto form_of = [&](std::size_t d) {
    std::vector<Affine> components;
    for (const core::LinearRow& linear_row : statics_->demands[d].components) {
      Affine sum = s * step(linear_row.free.front());
      double off = 0;
      for (std::size_t j = 0; j < n_; ++j) {
        AffineSum of_j;
        for (const core::LinearRow::Term& term : linear_row.terms)
          if (const double value = Y[static_cast<std::size_t>(term.unknown)][j]; value != 0)
            add_step(of_j, value, term.step);
        const Affine c = of_j.result();
        sum = sum + c * (j == last ? N : u[j]);
        if (j < last) off += c.magnitude();
      }
      components.push_back(widened(sum, off * rest_of_u));
    }
    double size = 0;
    for (const Affine& component : components) size = std::hypot(size, component.c);
    AffineSum sum;
    for (std::size_t k = 0; k < components.size(); ++k)
      sum.add(size > 0 ? components[k].c / size : k == 0 ? 1.0 : 0.0, components[k]);
    // n is a unit vector to some roundings.
    const double least = leasts_[d] * s.magnitude() * (1 + 0x1p-45);
    const bool single = components.size() == 1;
    const int sign = !single ? 0 : components.front().c < 0 ? -1 : 1;
    return Open{sum.result(), least, static_cast<int>(d), sign};
  };
  std::vector<Open> forms;
  for (std::size_t d = 0; d < statics_->demands.size(); ++d) {
    const auto alike = static_cast<std::size_t>(alike_[d]);
    forms.push_back(alike < d ? forms[alike] : form_of(d));
    forms.back().demand = static_cast<int>(d);
    Open singular = forms.back();
    if (singular.form.lower() > singular.least) {
      turned[d] = singular.sign;
      if (side != 0) sides_known.signs[d] = singular.sign * side;
      continue;
    }
    sides_known.open.emplace_back(Doubt::demand, static_cast<int>(d));
    if (side < 0) singular.sign = -singular.sign;
    open.push_back(singular);
  }
  if (side != 0) {
    sides_known.signs.back() = side * change->sign;
    sides_known.outside = has_effort_beyond(sides_known.signs);
    sides_known.free = open.empty() && !sides_known.outside;
    turned.clear();
  }
  sides_of(open, turned, sides_known);
}

}  // namespace clearloci::loci::pose
