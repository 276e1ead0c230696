#include "loci/search/touch_search.hpp"

#include <algorithm>
#include <cmath>

#include "loci/numbers/numbers.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {

namespace {

// The tangency of a tower with more roots is a determinant too large to be worth it.
constexpr int most_roots = 4;
constexpr int most_steps = 30;
// Newton's method ends at steps this small, relative to the region; it has failed where it leads out of the cell by
// more of its widths.
constexpr double converged = 1e-11, most_widths = 4;
// Of the enclosure of an extremum, relative to the region.
constexpr double accuracy = 1e-13;
// The box reaches this many times farther than the cell; wide ones settle more, narrow ones are proven where wide ones
// are not. Beside the curve it has room for so much of its slope, and for so much of the way along it.
constexpr double wider[] = {4, 1.25};
constexpr double room_for_slope = 1.5, room_for_bend = 0.5;

const System tangents = {{0, 2}, {0, 1}};

}  // namespace

std::optional<Touch> TouchSearch::around(const std::vector<Interval>& cell, const std::vector<int>& lifted) {
  if (static_cast<int>(tower_.roots.size()) > most_roots) return std::nullopt;
  if (!program_) {
    program_ = SheetProgram::with_tangency(tower_, two_);
    cell_.emplace(*program_, mode_);
  }
  const std::optional<std::vector<double>> at = extremum(cell, lifted);
  if (!at) return std::nullopt;
  // The coordinate along which the curve runs there.
  const std::size_t n = cell.size();
  std::vector<double> tangent(n);
  for (std::size_t d = 0; d < n; ++d) tangent[d] = std::abs(cell_->tangent(0, static_cast<int>(d)).middle());
  const auto along = static_cast<std::size_t>(std::max_element(tangent.begin(), tangent.end()) - tangent.begin());
  if (!(tangent[along] > 0)) return std::nullopt;
  std::vector<double> extent(n);
  double widest = 0;
  for (std::size_t d = 0; d < n; ++d) {
    extent[d] = std::max(std::abs(cell[d].lower() - (*at)[d]), std::abs(cell[d].upper() - (*at)[d]));
    widest = std::max(widest, extent[d]);
  }
  for (const double factor : wider) {
    const double half = factor * widest;
    std::vector<Interval> box;
    for (std::size_t d = 0; d < n; ++d) {
      double reach = half;
      if (d != along)
        reach =
            std::max({factor * extent[d], room_for_slope * half * tangent[d] / tangent[along], room_for_bend * half});
      box.emplace_back((*at)[d] - reach, (*at)[d] + reach);
    }
    if (auto touch = settle(*at, box, static_cast<int>(along), lifted)) return touch;
  }
  return std::nullopt;
}

std::optional<std::vector<double>> TouchSearch::extremum(const std::vector<Interval>& cell,
                                                         const std::vector<int>& lifted) {
  std::vector<double> point;
  for (const Interval& range : cell) point.push_back(range.middle());
  std::vector<Interval> thin(point.size()), image;
  double step = 0;
  for (int i = 0; i < most_steps; ++i) {
    for (std::size_t d = 0; d < point.size(); ++d) thin[d] = point[d];
    if (!cell_->enter_local(thin, lifted)) return std::nullopt;
    cell_->differentiate();
    if (i > 0 && step <= converged * size_) return point;
    krawczyk(*cell_, tangents, image);
    if (image.empty()) return std::nullopt;
    step = 0;
    for (std::size_t d = 0; d < point.size(); ++d) {
      step = std::max(step, std::abs(image[d].middle() - point[d]));
      point[d] = image[d].middle();
      if (!(std::abs(point[d] - cell[d].middle()) <= most_widths * cell[d].width())) return std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<Touch> TouchSearch::settle(const std::vector<double>& at, const std::vector<Interval>& box, int along,
                                         const std::vector<int>& lifted) {
  SheetCell& cell = *cell_;
  if (!cell.enter_local(box, lifted)) return std::nullopt;
  cell.differentiate();
  std::vector<Interval> image;
  if (krawczyk(cell, tangents, image) != ZeroCount::unique) return std::nullopt;
  const Interval main = cell.tangent(0, along);
  if (main.sign() == 0) return std::nullopt;
  Interval bend(0.0);
  double steepest = 1;  // of the ways in x and y beside the one along the curve
  const double half = box[static_cast<std::size_t>(along)].upper() - at[static_cast<std::size_t>(along)];
  for (int d = 0; d < cell.dimension(); ++d) {
    const Interval interval = d == along ? main : cell.tangent(0, d);
    bend = bend + cell.slope(2, d) * interval;
    if (d == along) continue;
    if (d < 2) steepest = std::max(steepest, (interval * inverse(main)).magnitude());
    // The extremum is somewhere in the image: from there the curve has this much room, and so far to go.
    const Interval& place = image[static_cast<std::size_t>(d)];
    const Interval& range = box[static_cast<std::size_t>(d)];
    const double room = std::min(place.lower() - range.lower(), range.upper() - place.upper());
    const double way = half + image[static_cast<std::size_t>(along)].width();
    if (!(interval.magnitude() * way < 0.999 * room * main.mignitude())) return std::nullopt;
  }
  if (bend.sign() == 0) return std::nullopt;
  Interval roots(1.0);
  for (int j = 0; j < cell.program().roots(); ++j)
    if (std::find(lifted.begin(), lifted.end(), j) == lifted.end()) roots = roots * (Interval(2.0) * cell.root(j));
  const int least = -bend.sign() * roots.sign();  // +1: g has a least value there, -1: a greatest
  const double reach_squared =
      2 * roots.magnitude() * main.magnitude() * main.magnitude() / bend.mignitude();  // times |g_0|

  std::vector<Interval> enclosure = image;
  narrow(cell, tangents, box, lifted, accuracy * size_, enclosure);
  if (!cell.enter_local(enclosure, lifted)) return std::nullopt;
  cell.differentiate();
  const Interval value = value_on_curve(along);
  Touch touch;
  touch.box = box;
  touch.extremum = least;
  if (value.sign() != 0 && value.sign() == least) return touch;
  const double way = std::sqrt(value.magnitude() * reach_squared);
  if (!(way <= one_point_ * size_)) return std::nullopt;
  touch.reach = way * steepest;
  for (std::size_t l = 0; l < lifted.size(); ++l)
    if (const int sign = mode_[static_cast<std::size_t>(lifted[l])];
        enclosure[2 + l].sign() == -sign && enclosure[2 + l].mignitude() > one_point_ * size_)
      return touch;  // on another sheet
  touch.enclosure = {enclosure[0], enclosure[1]};
  for (int j = 0; j < cell.program().roots(); ++j) touch.enclosure.push_back(cell.root(j));
  return touch;
}

/// Of g in what the cell is in, where f = 0, along a curve that runs along that coordinate. Where the curves touch, the
/// gradient of g is a sum of those of f and of the bonds of the lifted roots, which vanish: without them g hardly
/// varies.
Interval TouchSearch::value_on_curve(int along) {
  SheetCell& cell = *cell_;
  const Interval plain = cell.centred(1);
  cell.sharpen_middle();
  std::vector<int> across;
  for (int d = 0; d < cell.dimension(); ++d)
    if (d != along) across.push_back(d);
  const std::size_t n = across.size();
  const auto slope = [&](std::size_t bond, int d) -> const Interval& {
    return bond == 0 ? cell.slope(0, d) : cell.bond_slope(static_cast<int>(bond) - 1, d);
  };
  std::vector<double> slopes, inverse(n * n);
  for (std::size_t bond = 0; bond < n; ++bond)
    for (const int d : across) slopes.push_back(slope(bond, d).middle());
  if (!invert(slopes, inverse, n)) return plain;
  std::vector<Interval> share(n, Interval(0.0));
  for (std::size_t bond = 0; bond < n; ++bond)
    for (std::size_t k = 0; k < n; ++k)
      share[bond] = share[bond] + cell.slope(1, across[k]).middle() * Interval(inverse[k * n + bond]);
  Interval value = cell.middle_value(1);
  for (std::size_t bond = 0; bond < n; ++bond)
    value = value - share[bond] * (bond == 0 ? cell.middle_value(0) : cell.middle_bond(static_cast<int>(bond) - 1));
  for (int d = 0; d < cell.dimension(); ++d) {
    Interval rest = cell.slope(1, d);
    for (std::size_t bond = 0; bond < n; ++bond) rest = rest - share[bond] * slope(bond, d);
    value = value + rest * (cell.local(d) - Interval(cell.middle(d)));
  }
  return meet(value, plain);
}

}  // namespace clearloci::loci::sheet
