#include "check/zeros.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::check {
namespace {

// Zeros are enclosed to this width, relative to their segment or the box.
constexpr double accuracy = 1e-13;
// Relative to the box: what is not decided in cells so small stays undecided.
constexpr double smallest = 1e-11;
constexpr int most_halvings = 120;
constexpr std::size_t most_pieces = 20'000;
// More of them mean that the functions share a curve.
constexpr std::size_t most_undecided = 2'000;

class Segment {
 public:
  Segment(Sheet& sheet, int axis, double at) : sheet_(sheet), axis_(axis), at_(at) {}

  bool search(double from, double to, std::vector<Place>& zeros) {
    struct Piece {
      double from, to;
      int depth;
    };
    std::vector<Piece> open = {{from, to, 0}};
    const double width = to - from;
    for (std::size_t count = 0; !open.empty(); ++count) {
      const auto [a, b, depth] = open.back();
      open.pop_back();
      if (count > most_pieces || depth > most_halvings || !(a < b)) return false;
      if (!enter(a, b) || !sheet_.value(0).contains_zero()) continue;
      sheet_.differentiate();
      if (!sheet_.centred(0).contains_zero()) continue;
      if (sheet_.lifted().empty() && sheet_.slope(0, 1 - axis_).sign() != 0) {
        const std::optional<int> before = sign(a), after = sign(b);
        if (before && after && *before != 0 && *after != 0) {
          if (*before != *after) zeros.push_back(narrowed(a, b, *before, accuracy * width));
          continue;
        }
        if (depth == 0 || b - a < accuracy * width) return false;
      }
      // Off the middle where a zero happens to lie on it.
      double middle = 0;
      for (const double part : {0.5, 0.43, 0.57, 0.38}) {
        middle = a + part * (b - a);
        const std::optional<int> there = sign(middle);
        if (!there || *there != 0) break;
      }
      open.push_back({middle, b, depth + 1});  // the lower piece is looked at first
      open.push_back({a, middle, depth + 1});
    }
    return true;
  }

 private:
  bool enter(double a, double b) {
    const Interval free(a, b, cell_bits), fixed(at_, cell_bits);
    return axis_ == 0 ? sheet_.enter(fixed, free) : sheet_.enter(free, fixed);
  }
  std::optional<int> sign(double t) { return axis_ == 0 ? sign_at(sheet_, at_, t) : sign_at(sheet_, t, at_); }

  Place narrowed(double a, double b, int before, double width) {
    while (b - a > width) {
      const double middle = 0.5 * (a + b);
      if (!(a < middle && middle < b)) break;
      const std::optional<int> there = sign(middle);
      if (!there || *there == 0) break;
      (*there == before ? a : b) = middle;
    }
    const Interval free(a, b, cell_bits), fixed(at_, cell_bits);
    return axis_ == 0 ? Place{fixed, free} : Place{free, fixed};
  }

  Sheet& sheet_;
  int axis_;
  double at_;
};

/// By Gauss's elimination in doubles: a preconditioner needs no more. Empty: singular.
std::vector<std::vector<double>> inverse(std::vector<std::vector<double>> a) {
  const std::size_t n = a.size();
  std::vector<std::vector<double>> b(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) b[i][i] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    if (!(std::abs(a[k][k]) > 0) || !std::isfinite(a[k][k])) return {};
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = 0; j < n; ++j) {
        a[i][j] -= factor * a[k][j];
        b[i][j] -= factor * b[k][j];
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      b[i][j] /= a[i][i];
      if (!std::isfinite(b[i][j])) return {};
    }
  return b;
}

/// Krawczyk's operator on the box that the sheet is in: m - C F(m) + (1 - C F') (X - m). Empty: no use.
std::vector<Interval> krawczyk(Sheet& sheet) {
  sheet.differentiate();
  const int n = sheet.dimension(), bonds = n - 2;
  const auto jacobian = [&](int row, int c) { return row < 2 ? sheet.slope(row, c) : sheet.bond(row - 2, c); };
  std::vector<std::vector<double>> middle(static_cast<std::size_t>(n));
  for (int row = 0; row < n; ++row)
    for (int c = 0; c < n; ++c) middle[static_cast<std::size_t>(row)].push_back(jacobian(row, c).middle());
  const auto c = inverse(std::move(middle));
  if (c.empty()) return {};
  std::vector<Interval> image;
  for (int i = 0; i < n; ++i) {
    Interval sum = sheet.middle(i);
    const auto weight = [&](int row) {
      return Interval(c[static_cast<std::size_t>(i)][static_cast<std::size_t>(row)], cell_bits);
    };
    for (int row = 0; row < 2; ++row) sum = sum - weight(row) * sheet.at_middle(row);
    for (int l = 0; l < bonds; ++l) sum = sum - weight(2 + l) * sheet.bond_at_middle(l);
    for (int k = 0; k < n; ++k) {
      Interval share(i == k ? 1.0 : 0.0, cell_bits);
      for (int row = 0; row < n; ++row) share = share - weight(row) * jacobian(row, k);
      sum = sum + share * (sheet.local(k) - sheet.middle(k));
    }
    if (!sum.is_finite()) return {};
    image.push_back(std::move(sum));
  }
  return image;
}

class Isolation {
 public:
  Isolation(Sheet& sheet, double size, std::size_t most) : sheet_(sheet), size_(size), most_(most) {}

  CommonZeros run(std::vector<Rectangle> cells) {
    for (std::size_t count = 0; !cells.empty(); ++count) {
      const Rectangle cell = cells.back();
      cells.pop_back();
      result_.complete = count <= most_ && result_.undecided.size() <= most_undecided;
      if (!result_.complete) break;
      if (decided(cell)) continue;
      if (cell.size() < smallest * size_) {
        result_.undecided.push_back(cell);
        continue;
      }
      for (const Rectangle& half : halves(cell)) cells.push_back(half);
    }
    return std::move(result_);
  }

 private:
  bool decided(const Rectangle& cell) {
    const Interval x(cell.x0, cell.x1, cell_bits), y(cell.y0, cell.y1, cell_bits);
    if (!sheet_.enter(x, y)) return true;
    for (const int f : {0, 1})
      if (!sheet_.value(f).contains_zero()) return true;
    sheet_.differentiate();
    for (const int f : {0, 1})
      if (!sheet_.centred(f).contains_zero()) return true;
    const std::vector<int> lifted = sheet_.lifted();
    std::vector<Interval> box;
    for (int c = 0; c < sheet_.dimension(); ++c) box.push_back(sheet_.local(c));
    const std::vector<Interval> image = krawczyk(sheet_);
    if (image.empty()) return false;
    for (std::size_t c = 0; c < box.size(); ++c)
      if (disjoint(image[c], box[c])) return true;
    // A box around the place where Newton's method leads, wide enough to hold the cell.
    std::vector<Interval> wide;
    for (std::size_t c = 0; c < box.size(); ++c) {
      const double reach = 1.5 * box[c].width(), at = std::clamp(image[c].middle(), box[c].lower(), box[c].upper());
      wide.emplace_back(at - reach, at + reach, cell_bits);
    }
    if (!sheet_.enter_local(wide, lifted)) return false;
    std::vector<Interval> zero = krawczyk(sheet_);
    if (zero.empty()) return false;
    for (std::size_t c = 0; c < wide.size(); ++c)
      if (!inside(zero[c], wide[c])) return false;
    // Exactly one zero, in `zero`; drawn tighter while that helps.
    for (int i = 0; i < 8 && zero[0].width() + zero[1].width() > accuracy * size_; ++i) {
      if (!sheet_.enter_local(zero, lifted)) break;
      const std::vector<Interval> next = krawczyk(sheet_);
      if (next.empty()) break;
      for (std::size_t c = 0; c < zero.size(); ++c) zero[c] = meet(next[c], zero[c]);
    }
    // Roots that were lifted have a sign in this mode.
    for (std::size_t l = 0; l < lifted.size(); ++l) {
      const int sign = zero[2 + l].sign(), own = box[2 + l].middle() > 0 ? 1 : -1;
      if (sign == 0) return false;
      if (sign != own) return true;
    }
    for (const Known& known : known_) {
      if (disjoint(zero[0], known.zero.x) || disjoint(zero[1], known.zero.y)) continue;
      return inside(zero[0], known.x) && inside(zero[1], known.y);
    }
    known_.push_back({{zero[0], zero[1]}, wide[0], wide[1]});
    result_.zeros.push_back({zero[0], zero[1]});
    return true;
  }

  struct Known {
    Place zero;
    Interval x, y;  // of the box in which there is no other
  };

  Sheet& sheet_;
  double size_;
  std::size_t most_;
  std::vector<Known> known_;
  CommonZeros result_;
};

}  // namespace

std::optional<int> sign_at(Sheet& sheet, double x, double y) {
  if (!sheet.enter(Interval(x, cell_bits), Interval(y, cell_bits))) return std::nullopt;
  return sheet.is_inner() ? sheet.value(0).sign() : 0;
}

std::optional<std::vector<Place>> zeros_on_segment(Sheet& sheet, int axis, double at, double from, double to) {
  std::vector<Place> zeros;
  if (!Segment(sheet, axis, at).search(from, to, zeros)) return std::nullopt;
  return zeros;
}

CommonZeros common_zeros(Sheet& sheet, std::vector<Rectangle> cells, double size, std::size_t most) {
  return Isolation(sheet, size, most).run(std::move(cells));
}

}  // namespace clearloci::check
