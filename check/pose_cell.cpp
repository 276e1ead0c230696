#include "check/pose_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check/elimination.hpp"

namespace clearloci::check {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double ulp = 0x1p-52;

/// Every value is c + sum a_i e_i within r, where |e_i| <= 1, of balls |e| <= 1.
struct PoseForm {
  double c = 0;
  std::vector<double> a;
  double r = 0;
};

/// A double within, and how far the others are from it at most.
std::pair<double, double> ball_of(const Interval& x) {
  if (!x.is_finite()) return {0, infinite};
  const double low = x.lower(), high = x.upper(), c = low + 0.5 * (high - low);
  return {c, std::max(high - c, c - low) * (1 + ulp)};
}

PoseForm form_of(const Jet& jet, const std::vector<double>& half) {
  PoseForm form;
  std::tie(form.c, form.r) = ball_of(jet.middle());
  if (jet.is_constant()) return form;
  for (std::size_t i = 0; i < half.size(); ++i) {
    const auto [slope, apart] = ball_of(jet.slopes()[i]);
    form.a.push_back(slope * half[i]);
    if (half[i] > 0) form.r += (apart + std::abs(slope) * ulp) * half[i] * (1 + ulp);
  }
  return form;
}

/// Sums of multiples of forms; their rounding is added last.
class Sum {
 public:
  explicit Sum(std::size_t coordinates, double constant = 0) {
    form_.a.assign(coordinates, 0.0);
    form_.c = constant;
    size_ = std::abs(constant);
  }
  void add(double factor, const PoseForm& form) {
    form_.c += factor * form.c;
    form_.r += std::abs(factor) * form.r;
    double size = std::abs(form.c) + form.r;
    for (std::size_t i = 0; i < form.a.size(); ++i) {
      form_.a[i] += factor * form.a[i];
      size += std::abs(form.a[i]);
    }
    size_ += std::abs(factor) * size;
    ++terms_;
  }
  void widen(double by) { form_.r += by * (1 + ulp); }
  PoseForm done() {
    form_.r = (form_.r + (terms_ + 4.0) * ulp * size_) * (1 + (terms_ + 4.0) * ulp);
    return form_;
  }

 private:
  PoseForm form_;
  double size_ = 0, terms_ = 0;
};

/// No longer than 1; zeros where its length is zero or unknown.
std::vector<double> unit(std::vector<double> way) {
  double square = 0;
  for (const double component : way) square += component * component;
  const double length = std::sqrt(square) * (1 + 8 * ulp);
  for (double& component : way) component = length > 0 && std::isfinite(length) ? component / length : 0.0;
  return way;
}

class Solved {
 public:
  Solved(const PoseEquations& equations, const Jet::Offsets& offsets, const std::vector<LoadBall>& balls)
      : equations_(equations), balls_(balls), n_(equations.unknowns) {
    for (const Interval& offset : offsets)
      half_.push_back(std::max(std::abs(offset.lower()), std::abs(offset.upper())));
    proof_.spreads.assign(half_.size(), 0.0);
    for (const PoseEntry& entry : equations.matrix) entries_.push_back(form_of(entry.value, half_));
  }

  /// Whether A is regular all over the cell.
  bool solve() {
    if (!solve_middle()) return false;
    enclose();
    return proof_.regular;
  }

  /// The unit vector of its reaction at the middle; zeros where it vanishes there.
  std::vector<double> way_of(std::size_t demand) {
    while (demands_.size() <= demand) demands_.push_back(components_of(equations_.demands[demands_.size()]));
    std::vector<double> way;
    for (const PoseForm& form : demands_[demand]) way.push_back(form.c);
    return unit(std::move(way));
  }

  /// That a reaction is above its least along a way no longer than 1.
  void look_along(std::size_t demand, const std::vector<double>& way, double least) {
    Sum along(half_.size());
    double square = 0;
    for (std::size_t k = 0; k < way.size(); ++k) {
      along.add(way[k], demands_[demand][k]);
      square += demands_[demand][k].c * demands_[demand][k].c;
    }
    proof_.demands.push_back(square > 0 && is_above(along.done(), 1 / std::sqrt(square), least));
  }

  void look_at_bounds() {
    proof_.positive = true;
    for (const auto& positive_step : equations_.positive) look_at(positive_step);
  }

  PoseCellProof& proof() { return proof_; }

 private:
  bool solve_middle() {
    Dense middle(n_, std::vector<double>(n_, 0.0));
    for (std::size_t e = 0; e < entries_.size(); ++e)
      middle[equations_.matrix[e].row][equations_.matrix[e].unknown] += entries_[e].c;
    auto inverse = inverse_of(std::move(middle));
    if (!inverse) return false;
    inverse_ = std::move(*inverse);
    w0_.assign(n_, 0.0);
    for (std::size_t i = 0; i < n_; ++i) {
      right_.push_back(form_of(equations_.right[i], half_));
      for (std::size_t k = 0; k < n_; ++k) w0_[k] += inverse_[k][i] * right_[i].c;
    }
    double most = 0;
    for (const double component : w0_) most = std::max(most, std::abs(component));
    for (const double component : w0_) scale_.push_back(std::abs(component) + 1e-3 * most + 1e-300);
    return std::isfinite(most);
  }

  void enclose() {
    std::vector<Sum> residual;
    for (std::size_t i = 0; i < n_; ++i) {
      residual.emplace_back(half_.size());
      residual.back().add(1, right_[i]);
    }
    std::vector<std::vector<std::size_t>> of_unknown(n_);
    for (std::size_t e = 0; e < entries_.size(); ++e) {
      const PoseEntry& entry = equations_.matrix[e];
      residual[entry.row].add(-w0_[entry.unknown], entries_[e]);
      of_unknown[entry.unknown].push_back(e);
    }
    std::vector<PoseForm> left;
    for (Sum& sum : residual) left.push_back(sum.done());
    Dense bound(n_, std::vector<double>(n_, 0.0));
    for (std::size_t k = 0; k < n_; ++k) {
      Sum rho(half_.size());
      for (std::size_t i = 0; i < n_; ++i)
        if (inverse_[k][i] != 0) rho.add(inverse_[k][i], left[i]);
      rho_.push_back(rho.done());
      note(rho_.back(), 1 / scale_[k]);
      for (std::size_t j = 0; j < n_; ++j) {
        Sum sum(half_.size(), k == j ? 1.0 : 0.0);
        for (const std::size_t e : of_unknown[j]) sum.add(-inverse_[k][equations_.matrix[e].row], entries_[e]);
        const PoseForm form = sum.done();
        note(form, scale_[j] / scale_[k]);
        bound[k][j] = magnitude(form);
      }
    }
    proof_.regular = find_radius(bound);
  }

  void note(const PoseForm& form, double per) {
    for (std::size_t c = 0; c < form.a.size(); ++c) proof_.spreads[c] += std::abs(form.a[c]) * per;
  }

  /// d with |rho| + |E| d <= d and |E| d < d.
  bool find_radius(const Dense& bound) {
    radius_.clear();
    constexpr double part = 1e-9;
    for (std::size_t k = 0; k < n_; ++k) radius_.push_back(1.01 * magnitude(rho_[k]) + part * scale_[k]);
    rest_.assign(n_, 0.0);
    constexpr int attempts = 20;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      bool inside = true;
      std::vector<double> next = radius_;
      for (std::size_t k = 0; k < n_; ++k) {
        double sum = 0;
        for (std::size_t j = 0; j < n_; ++j) sum += bound[k][j] * radius_[j];
        rest_[k] = sum * (1 + static_cast<double>(n_ + 2) * ulp);
        const double all = (rest_[k] + magnitude(rho_[k])) * (1 + 4 * ulp);
        if (!std::isfinite(all)) return false;
        inside = inside && all <= radius_[k] && rest_[k] < radius_[k];
        next[k] = std::max(radius_[k], 1.1 * all + part * scale_[k]);
      }
      if (inside) return true;
      radius_ = std::move(next);
    }
    return false;
  }

  /// One a row of the entries.
  std::vector<Sum> sums_of(const std::vector<PoseEntry>& entries) const {
    std::size_t count = 0;
    for (const PoseEntry& entry : entries) count = std::max(count, entry.row + 1);
    std::vector<Sum> sums(count, Sum(half_.size()));
    for (const PoseEntry& entry : entries) {
      const PoseForm q = form_of(entry.value, half_);
      Sum& sum = sums[entry.row];
      sum.add(w0_[entry.unknown], q);
      sum.add(q.c, rho_[entry.unknown]);
      sum.widen((spread(q) + q.r) * radius_[entry.unknown] + std::abs(q.c) * rest_[entry.unknown]);
    }
    return sums;
  }

  std::vector<PoseForm> components_of(const std::vector<PoseEntry>& entries) {
    std::vector<PoseForm> components;
    proof_.components.emplace_back();
    for (Sum& sum : sums_of(entries)) {
      components.push_back(sum.done());
      const PoseForm& form = components.back();
      const double off = (spread(form) + form.r) * (1 + 0x1p-40);
      proof_.components.back().push_back(
          {std::nextafter(form.c - off, -infinite), std::nextafter(form.c + off, infinite)});
    }
    return components;
  }

  void look_at(const PoseEquations::Positive& positive) {
    std::vector<Sum> sums = sums_of(positive.entries);
    if (sums.size() != 1) {
      proof_.positive = false;
      return;
    }
    sums.front().add(1, form_of(positive.constant, half_));
    const PoseForm form = sums.front().done();
    proof_.positive = is_above(form, 1 / (std::abs(form.c) + std::numeric_limits<double>::min()), 0) && proof_.positive;
    proof_.broken = form.c + (spread(form) + form.r) * (1 + 0x1p-40) < 0 || proof_.broken;
  }

  bool is_above(const PoseForm& form, double per, double least) {
    note(form, per);
    return form.c - (spread(form) + form.r) * (1 + 0x1p-40) > least * (1 + 16 * ulp);
  }

  double spread(const PoseForm& form) const {
    double sum = 0;
    auto ball = balls_.begin();
    for (std::size_t c = 0; c < form.a.size();) {
      if (ball == balls_.end() || c != ball->first) {
        sum += std::abs(form.a[c++]);
        continue;
      }
      double square = 0;
      for (const std::size_t end = c + ball->count; c < end; ++c) square += form.a[c] * form.a[c];
      sum += std::sqrt(square);
      ++ball;
    }
    return sum * (1 + (static_cast<double>(form.a.size()) + 16) * ulp);
  }

  double magnitude(const PoseForm& form) const { return (std::abs(form.c) + spread(form) + form.r) * (1 + 4 * ulp); }

  const PoseEquations& equations_;
  const std::vector<LoadBall>& balls_;
  std::size_t n_;
  std::vector<double> half_, w0_, scale_, radius_, rest_;
  std::vector<PoseForm> entries_, right_, rho_;
  std::vector<std::vector<PoseForm>> demands_;  ///< the components of each
  Dense inverse_;
  PoseCellProof proof_;
};

}  // namespace

bool PoseCellProof::holds() const {
  return regular && positive && std::all_of(demands.begin(), demands.end(), [](bool demand) { return demand; });
}

PoseCellProof prove_cell(const std::vector<PoseEquations>& choices, const std::vector<core::TaskDemand>& demands,
                         const Jet::Offsets& offsets, const std::vector<LoadBall>& balls) {
  std::vector<Solved> all;
  for (const PoseEquations& equations : choices)
    if (!all.emplace_back(equations, offsets, balls).solve()) return std::move(all.back().proof());
  for (std::size_t d = 0; d < demands.size(); ++d) {
    std::vector<double> way = all.front().way_of(d);
    for (auto other = all.begin() + 1; other != all.end(); ++other) {
      const std::vector<double> more = other->way_of(d);
      for (std::size_t k = 0; k < way.size(); ++k) way[k] += more[k];
    }
    way = unit(std::move(way));
    for (Solved& one : all) one.look_along(d, way, std::nextafter(demands[d].least.get_d(), infinite));
  }
  for (Solved& one : all) one.look_at_bounds();
  PoseCellProof proof = std::move(all.front().proof());
  for (auto other = all.begin() + 1; other != all.end(); ++other) {
    const PoseCellProof& more = other->proof();
    for (std::size_t d = 0; d < demands.size(); ++d) proof.demands[d] = proof.demands[d] && more.demands[d];
    proof.positive = proof.positive && more.positive;
    proof.broken = proof.broken || more.broken;
    for (std::size_t c = 0; c < proof.spreads.size(); ++c) proof.spreads[c] += more.spreads[c];
  }
  return proof;
}

}  // namespace clearloci::check
