#include "check/zeros.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::check {
namespace {

// Relative to the box: zeros are enclosed to the first; what is not decided in cells of the second stays undecided.
constexpr double accuracy = 1e-13, smallest = 1e-11;
// Newton's steps are enough to get there, or at least to this.
constexpr int most_steps = 30;
constexpr double loose = 1e-10;
// More of them mean that the functions share a curve.
constexpr std::size_t most_undecided = 2'000;

/// By Gauss's elimination in doubles: a preconditioner needs no more. Empty: singular.
std::vector<std::vector<double>> inverse(std::vector<std::vector<double>> a) {
  const std::size_t n = a.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) a[i].push_back(i == j ? 1 : 0);
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    const double pivot_entry = a[k][k];
    if (!(std::abs(pivot_entry) > 0) || !std::isfinite(pivot_entry)) return {};
    for (double& entry : a[k]) entry /= pivot_entry;
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = i == k ? 0.0 : a[i][k];
      for (std::size_t j = k; j < 2 * n; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  for (auto& row : a) {
    row.erase(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(n));
    if (!std::all_of(row.begin(), row.end(), [](double entry) { return std::isfinite(entry); })) return {};
  }
  return a;
}

class Isolation {
 public:
  Isolation(Sheet& sheet, double size, std::size_t most) : sheet_(sheet), size_(size), most_(most) {}

  CommonZeros run(std::vector<Rectangle> cells) {
    if (cells.empty()) return {};
    fixed_ = cells[0].x0 == cells[0].x1 ? 0 : cells[0].y0 == cells[0].y1 ? 1 : -1;
    functions_ = fixed_ < 0 ? 2 : 1;
    for (std::size_t count = 0; !cells.empty(); ++count) {
      const Rectangle cell = cells.back();
      cells.pop_back();
      result_.complete = count <= most_ && result_.undecided.size() <= most_undecided;
      if (!result_.complete) break;
      if (decided(cell)) continue;
      if (cell.size() < smallest * size_)
        result_.undecided.push_back(cell);
      else
        for (const Rectangle& half : halves(cell)) cells.push_back(half);
    }
    return std::move(result_);
  }

 private:
  /// Krawczyk's operator on the box that the sheet is in: m - C F(m) + (1 - C F') (X - m), F the functions and the
  /// bonds of lifted roots, over all local coordinates but a fixed one. Empty: no use.
  std::vector<Interval> krawczyk() {
    sheet_.differentiate();
    std::vector<int> free;
    for (int c = 0; c < sheet_.dimension(); ++c)
      if (c != fixed_) free.push_back(c);
    const std::size_t n = free.size(), functions = static_cast<std::size_t>(functions_);
    const auto bond_of = [&](std::size_t row) { return static_cast<int>(row - functions); };
    const auto jacobian = [&](std::size_t row, std::size_t k) -> const Interval& {
      return row < functions ? sheet_.slope(static_cast<int>(row), free[k]) : sheet_.bond(bond_of(row), free[k]);
    };
    std::vector<std::vector<double>> middle(n);
    for (std::size_t row = 0; row < n; ++row)
      for (std::size_t k = 0; k < n; ++k) middle[row].push_back(jacobian(row, k).middle());
    const auto c = inverse(std::move(middle));
    if (c.empty()) return {};
    std::vector<Interval> image;
    for (int i = 0; i < sheet_.dimension(); ++i) image.push_back(sheet_.local(i));
    for (std::size_t i = 0; i < n; ++i) {
      Interval sum = sheet_.middle(free[i]);
      const auto weight = [&](std::size_t row) { return Interval(c[i][row], cell_bits); };
      for (std::size_t row = 0; row < n; ++row)
        sum = sum - weight(row) * (row < functions ? sheet_.at_middle(static_cast<int>(row))
                                                   : sheet_.bond_at_middle(bond_of(row)));
      for (std::size_t k = 0; k < n; ++k) {
        Interval share(i == k ? 1.0 : 0.0, cell_bits);
        for (std::size_t row = 0; row < n; ++row) share = share - weight(row) * jacobian(row, k);
        sum = sum + share * (sheet_.local(free[k]) - sheet_.middle(free[k]));
      }
      if (!sum.is_finite()) return {};
      image[static_cast<std::size_t>(free[i])] = sum;
    }
    return image;
  }

  bool is_free() {
    sheet_.differentiate();
    for (int f = 0; f < functions_; ++f)
      if (!sheet_.centred(f).contains_zero()) return true;
    return false;
  }

  bool decided(const Rectangle& cell) {
    if (!sheet_.enter(Interval(cell.x0, cell.x1, cell_bits), Interval(cell.y0, cell.y1, cell_bits))) return true;
    for (int f = 0; f < functions_; ++f)
      if (!sheet_.value(f).contains_zero()) return true;
    if (is_free()) return true;
    const std::vector<int> lifted = sheet_.lifted();
    std::vector<Interval> box;
    for (int c = 0; c < sheet_.dimension(); ++c) box.push_back(sheet_.local(c));
    const std::vector<Interval> image = krawczyk();
    if (image.empty()) return false;
    for (std::size_t c = 0; c < box.size(); ++c)
      if (disjoint(image[c], box[c])) return true;
    // A box around the place where Newton's method leads, wide enough to hold the cell.
    std::vector<Interval> wide = box;
    for (std::size_t c = 0; c < box.size(); ++c) {
      if (static_cast<int>(c) == fixed_) continue;
      const double reach = 1.5 * box[c].width(), at = std::clamp(image[c].middle(), box[c].lower(), box[c].upper());
      wide[c] = Interval(at - reach, at + reach, cell_bits);
    }
    if (!sheet_.enter_local(wide, lifted)) return false;
    std::vector<Interval> zero = krawczyk();
    if (zero.empty()) return false;
    for (std::size_t c = 0; c < wide.size(); ++c)
      if (static_cast<int>(c) != fixed_ && !inside(zero[c], wide[c])) return false;
    // Exactly one zero, in `zero`; drawn tighter while that helps.
    for (int i = 0; i < most_steps && zero[0].width() + zero[1].width() > accuracy * size_; ++i) {
      if (!sheet_.enter_local(zero, lifted)) break;
      const std::vector<Interval> next = krawczyk();
      if (next.empty()) break;
      for (std::size_t c = 0; c < zero.size(); ++c) zero[c] = meet(next[c], zero[c]);
    }
    if (zero[0].width() + zero[1].width() > loose * size_) return false;
    // Roots that were lifted have a sign in this mode.
    Place place{zero[0], zero[1], {}};
    for (std::size_t l = 0; l < lifted.size(); ++l) {
      const int sign = zero[2 + l].sign(), claimed_sign = box[2 + l].middle() > 0 ? 1 : -1;
      if (sign == 0) return false;
      if (sign != claimed_sign) return true;
      place.roots.emplace_back(lifted[l], zero[2 + l]);
    }
    for (const Known& entry : known_) {
      if (disjoint(zero[0], entry.zero.x) || disjoint(zero[1], entry.zero.y)) continue;
      return contains(entry.x, zero[0]) && contains(entry.y, zero[1]);
    }
    known_.push_back({place, wide[0], wide[1]});
    result_.zeros.push_back(std::move(place));
    return true;
  }

  struct Known {
    Place zero;
    Interval x, y;  // of the box in which there is no other
  };

  Sheet& sheet_;
  double size_;
  std::size_t most_;
  int fixed_ = -1, functions_ = 2;
  std::vector<Known> known_;
  CommonZeros result_;
};

}  // namespace

CommonZeros common_zeros(Sheet& sheet, std::vector<Rectangle> cells, double size, std::size_t most) {
  return Isolation(sheet, size, most).run(std::move(cells));
}

}  // namespace clearloci::check
