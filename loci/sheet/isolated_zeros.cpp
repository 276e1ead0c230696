#include "loci/sheet/isolated_zeros.hpp"

#include <algorithm>
#include <numeric>

#include "core/errors.hpp"
#include "loci/sheet/krawczyk.hpp"

namespace clearloci::loci::sheet {

namespace {

// Cells are examined this much larger on every side, relative to their width, so that a zero on a common edge lies well
// inside the box of either neighbour and is certified there.
constexpr double inflation = 0.1;
// Refinement converges quadratically; this many steps are never needed.
constexpr int most_refinements = 40;

struct CertifiedZero {
  std::vector<int> lifted;
  std::vector<Interval> unique;     // local coordinates of a box that holds this zero only
  std::vector<Interval> enclosure;  // of all variables

  /// The box holds whatever zero lies in `all` (an enclosure of all variables).
  bool owns(const std::vector<Interval>& all) const {
    for (std::size_t c = 0; c < unique.size(); ++c)
      if (!inside(all[c < 2 ? c : 2 + lifted[c - 2]], unique[c])) return false;
    return true;
  }
};

Interval inflated(const Interval& a) {
  const double margin = inflation * a.width();
  return {a.lower() - margin, a.upper() + margin};
}

class ZeroSearch {
 public:
  ZeroSearch(const SheetProgram& program, const core::WorkingMode& mode, const ZeroOptions& options)
      : program_(&program), mode_(mode), options_(options), cell_(program, mode) {
    core::ensure(program.functions() >= 2, "two functions for two unknowns");
  }

  ZeroSet run(const std::vector<Cell>& seeds) {
    double size = 0;
    for (const Cell& seed : seeds) size = std::max({size, seed.x.width(), seed.y.width()});
    if (!seeds.empty()) {
      const auto hull_of = [&](auto member) {
        Interval all = seeds.front().*member;
        for (const Cell& seed : seeds) all = hull(all, seed.*member);
        return all;
      };
      size = std::max({size, hull_of(&Cell::x).width(), hull_of(&Cell::y).width()});
    }
    smallest_ = options_.smallest * size;
    std::vector<Cell> live = seeds, next;
    const std::size_t most = static_cast<std::size_t>(options_.most_cells) + seeds.size();
    while (!live.empty() && live.size() <= most) {
      next.clear();
      for (const Cell& cell : live) examine(cell, next);
      std::swap(live, next);
    }
    ZeroSet result;
    result.gave_up = !live.empty();
    undecided_.insert(undecided_.end(), live.begin(), live.end());
    result.undecided = clusters(std::move(undecided_));
    for (const CertifiedZero& zero : zeros_) result.zeros.push_back(describe(zero));
    std::sort(result.zeros.begin(), result.zeros.end(), [](const SheetZero& a, const SheetZero& b) {
      return a.x != b.x ? a.x < b.x : a.y < b.y;
    });
    return result;
  }

 private:
  void examine(const Cell& cell, std::vector<Cell>& next) {
    if (!cell_.enter(cell.x, cell.y) || !cell_.value(0).contains_zero() || !cell_.value(1).contains_zero()) return;
    if (known(cell)) return;
    std::vector<Interval> box;
    const std::vector<int> lifted = cell_.lifted();
    for (int c = 0; c < cell_.dimension(); ++c) box.push_back(inflated(cell_.local(c)));
    if (cell_.enter_local(box, lifted)) {
      cell_.differentiate();
      const bool small = std::max(cell.x.width(), cell.y.width()) < 1e4 * smallest_;
      if (small && (cell_.rounding_dominates(0) || cell_.rounding_dominates(1))) cell_.sharpen_middle();
      if (!cell_.centred(0).contains_zero() || !cell_.centred(1).contains_zero()) return;
      std::vector<Interval> image;
      const Verdict verdict = krawczyk(cell_, image);
      if (verdict == Verdict::none) return;
      if (verdict == Verdict::unique && accept(box, lifted, std::move(image), cell)) return;
    }
    if (cell.x.width() < smallest_ && cell.y.width() < smallest_)
      undecided_.push_back(cell);
    else
      split(cell, next);
  }

  /// All of the cell lies in the box of a zero that is known already. Required: cell_ has entered it.
  bool known(const Cell& cell) const {
    std::vector<Interval> all = {cell.x, cell.y};
    for (int j = 0; j < program_->roots(); ++j) all.push_back(cell_.root(j));
    return std::any_of(zeros_.begin(), zeros_.end(), [&](const CertifiedZero& zero) { return zero.owns(all); });
  }

  static void split(const Cell& cell, std::vector<Cell>& next) {
    if (cell.x.width() > cell.y.width()) {
      next.push_back({{cell.x.lower(), cell.x.middle()}, cell.y});
      next.push_back({{cell.x.middle(), cell.x.upper()}, cell.y});
    } else {
      next.push_back({cell.x, {cell.y.lower(), cell.y.middle()}});
      next.push_back({cell.x, {cell.y.middle(), cell.y.upper()}});
    }
  }

  /// Shrinks the enclosure of the zero in `box` and keeps it if it lies in the cell. False: it lies in the cell or not,
  /// rounding does not tell.
  bool accept(const std::vector<Interval>& box, const std::vector<int>& lifted, std::vector<Interval> enclosure,
              const Cell& cell) {
    for (int step = 0; step < most_refinements; ++step) {
      if (!cell_.enter_local(enclosure, lifted)) break;
      cell_.differentiate();
      cell_.sharpen_middle();
      std::vector<Interval> image;
      if (krawczyk(cell_, image) == Verdict::none || image.empty()) break;
      bool shrunk = false;
      for (std::size_t c = 0; c < enclosure.size(); ++c) {
        const Interval smaller = meet(image[c], enclosure[c]);
        shrunk = shrunk || smaller.width() < 0.5 * enclosure[c].width();
        enclosure[c] = smaller;
      }
      if (!shrunk) break;
    }
    if (disjoint(enclosure[0], cell.x) || disjoint(enclosure[1], cell.y)) return true;
    for (std::size_t l = 0; l < lifted.size(); ++l)
      if (enclosure[2 + l].sign() == -mode_[lifted[l]]) return true;
    CertifiedZero zero{lifted, box, {enclosure[0], enclosure[1]}};
    if (!cell_.enter_local(enclosure, lifted)) return false;
    for (int j = 0; j < program_->roots(); ++j) zero.enclosure.push_back(cell_.root(j));
    for (const CertifiedZero& other : zeros_) {
      if (other.owns(zero.enclosure) || zero.owns(other.enclosure)) return true;
      if (!disjoint(other.enclosure[0], zero.enclosure[0]) && !disjoint(other.enclosure[1], zero.enclosure[1]))
        return false;
    }
    zeros_.push_back(std::move(zero));
    return true;
  }

  SheetZero describe(const CertifiedZero& zero) const {
    SheetZero result;
    result.x = zero.enclosure[0].middle();
    result.y = zero.enclosure[1].middle();
    result.radius = 0.5 * std::max(zero.enclosure[0].width(), zero.enclosure[1].width());
    result.enclosure = zero.enclosure;
    for (int j = 0; j < program_->roots(); ++j) {
      result.roots.push_back(zero.enclosure[2 + j].middle());
      if (zero.enclosure[2 + j].sign() == 0) result.inside_workspace = false;
    }
    return result;
  }

  const SheetProgram* program_;
  core::WorkingMode mode_;
  ZeroOptions options_;
  SheetCell cell_;
  double smallest_ = 0;
  std::vector<CertifiedZero> zeros_;
  std::vector<Cell> undecided_;
};

}  // namespace

std::vector<Cell> clusters(std::vector<Cell> cells) {
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
    return a.x.lower() != b.x.lower() ? a.x.lower() < b.x.lower() : a.y.lower() < b.y.lower();
  });
  std::vector<std::size_t> parent(cells.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t k = i + 1; k < cells.size() && cells[k].x.lower() <= cells[i].x.upper(); ++k)
      if (!disjoint(cells[i].y, cells[k].y)) parent[std::max(find(i), find(k))] = std::min(find(i), find(k));
  std::vector<Cell> result;
  std::vector<std::size_t> index(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t root = find(i);
    if (root == i) {
      index[i] = result.size();
      result.push_back(cells[i]);
    } else {
      Cell& cluster = result[index[root]];
      cluster = {hull(cluster.x, cells[i].x), hull(cluster.y, cells[i].y)};
    }
  }
  return result;
}

ZeroSet isolated_zeros(const SheetProgram& program, const core::WorkingMode& mode, const std::vector<Cell>& seeds,
                       const ZeroOptions& options) {
  return ZeroSearch(program, mode, options).run(seeds);
}

ZeroSet isolated_zeros(const core::RootTower& tower, const core::WorkingMode& mode, const core::Polynomial& first,
                       const core::Polynomial& second, const std::vector<core::Rational>& lower,
                       const std::vector<core::Rational>& upper, const ZeroOptions& options) {
  const SheetProgram program(tower, {first, second});
  const auto range = [&](int c) {
    Interval* const as_interval = nullptr;
    return hull(constant_as(lower[c], as_interval), constant_as(upper[c], as_interval));
  };
  return isolated_zeros(program, mode, {{range(0), range(1)}}, options);
}

}  // namespace clearloci::loci::sheet
