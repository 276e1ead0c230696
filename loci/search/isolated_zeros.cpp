#include "loci/search/isolated_zeros.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>

#include "core/errors.hpp"
#include "loci/search/zero_search.hpp"

namespace clearloci::loci::sheet {

namespace {

// Once a chart is given up the set stays open, and the others get this part of the cells.
constexpr int share_after_giving_up = 8;

// Of the box: a zero this near to a cone counts as the cone.
constexpr double at_rounding = 1e-12;

// Of the smallest cell: zeros this near to a place where the curves touch, or all but do, count as one with it; cells
// that are wider are seldom left by a touch alone.
constexpr double one_touch = 100, widest_at_touch = 1e7;

// Relative to coordinates: cells are not cut until they hold no doubles.
constexpr double roundings = 0x1p-49;

/// The zero in plane coordinates. `enclosure`: of the chart's coordinates and roots.
SheetZero describe(const std::vector<Interval>& enclosure, const Chart& chart, const std::vector<Star>& stars) {
  SheetZero zero;
  const PlaneCell place = chart.to_plane(PlaneCell{enclosure[0], enclosure[1]});
  zero.x = place.x.middle();
  zero.y = place.y.middle();
  zero.radius = 0.5 * std::max(place.x.width(), place.y.width());
  for (std::size_t j = 0; j + 2 < enclosure.size(); ++j) {
    double scale = 1;
    if (chart.side != Chart::Side::plane)
      scale = chart.scale_of_root(static_cast<int>(j), stars[static_cast<std::size_t>(chart.star)],
                                  enclosure[0].middle(), enclosure[1].middle());
    zero.roots.push_back(scale * enclosure[2 + j].middle());
    if (enclosure[2 + j].sign() == 0) zero.inside_workspace = false;
  }
  return zero;
}

ZeroSet found_zeros(const core::RootTower& tower, const core::WorkingMode& mode, const SheetFunction& first,
                    const SheetFunction& second, const std::vector<core::Rational>& lower,
                    const std::vector<core::Rational>& upper, const ZeroOptions& options) {
  const auto range = [&](int c) {
    Interval* const as_interval = nullptr;
    return hull(constant_as(lower[c], as_interval), constant_as(upper[c], as_interval));
  };
  const Interval box_x = range(0), box_y = range(1);
  const double size = std::max(box_x.width(), box_y.width());
  std::vector<Star> special = touches(tower);
  special.insert(special.end(), options.special.begin(), options.special.end());
  const Partition parts =
      partition(tower, {box_x.lower(), box_x.upper(), box_y.lower(), box_y.upper()}, bases(tower), special);

  ZeroSet result;
  std::vector<SheetFunction> functions = {first, second};
  functions.insert(functions.end(), options.also.begin(), options.also.end());
  System system;
  for (int f = 2; f < static_cast<int>(functions.size()); ++f) system.also.push_back(f);
  Charting charting(tower, functions, parts.stars);
  const double spacing = roundings * std::max(box_x.magnitude(), box_y.magnitude());
  for (const Chart& chart : parts.charts) {
    const bool plane = chart.side == Chart::Side::plane;
    const ChartedSheet sheet = charting.in(chart);
    SheetProgram program(sheet.tower, sheet.functions);
    ZeroSearch search(program, mode, system);
    const std::vector<PlaneCell> seeds = plane ? outside_holes(parts) : std::vector<PlaneCell>{{{0, 1}, {-1, 1}}};
    const double chart_size = plane ? size : 1.0;
    std::optional<TouchSearch> touches;
    if (options.touches)
      touches.emplace(sheet.tower, std::vector{sheet.functions[0], sheet.functions[1]}, mode, chart_size,
                      one_touch * options.smallest);
    const FoundZeros found = search.run(
        seeds,
        {std::max(options.smallest * chart_size, plane ? spacing : 0.0),
         static_cast<std::size_t>(result.gave_up ? options.most_cells / share_after_giving_up : options.most_cells),
         2e-15 * size, options.stop, touches ? &*touches : nullptr, widest_at_touch * options.smallest * chart_size});
    result.gave_up = result.gave_up || found.gave_up;
    for (const PlaneCell& cell : found.undecided) result.undecided.push_back(chart.to_plane(cell));
    const auto add = [&](const std::vector<Interval>& enclosure, std::vector<SheetZero>& list) {
      const PlaneCell place = chart.to_plane(PlaneCell{enclosure[0], enclosure[1]});
      if (disjoint(place.x, box_x) || disjoint(place.y, box_y)) return;
      const SheetZero zero = describe(enclosure, chart, parts.stars);
      if (chart.is_at_star({enclosure[0], enclosure[1]}, 1)) {
        const bool at_cone = parts.stars[static_cast<std::size_t>(chart.star)].is_undefined() &&
                             std::max(place.x.width(), place.y.width()) <= at_rounding * size;
        (at_cone ? result.at_cones : result.undecided).push_back(place);
        return;
      }
      // A zero on the seam of two charts is found in both.
      const bool seen = std::any_of(list.begin(), list.end(), [&](const SheetZero& other) {
        return std::max(std::abs(other.x - zero.x), std::abs(other.y - zero.y)) <= other.radius + zero.radius;
      });
      if (!seen) list.push_back(zero);
    };
    for (const std::vector<Interval>& enclosure : found.enclosures) add(enclosure, result.zeros);
    for (const Touch& touch : found.touches) {
      std::vector<Interval> around = touch.enclosure;
      for (const std::size_t c : {0u, 1u}) around[c] = around[c] + Interval(-touch.reach, touch.reach);
      add(around, result.touches);
    }
  }
  result.undecided = clusters(std::move(result.undecided));
  std::sort(result.zeros.begin(), result.zeros.end(),
            [](const SheetZero& a, const SheetZero& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  return result;
}

}  // namespace

ZeroSet isolated_zeros(const core::RootTower& tower, const core::WorkingMode& mode, const SheetFunction& first,
                       const SheetFunction& second, const std::vector<core::Rational>& lower,
                       const std::vector<core::Rational>& upper, const ZeroOptions& options) {
  if (options.searches == nullptr) return found_zeros(tower, mode, first, second, lower, upper, options);
  KnownSearches::Key key =
      KnownSearches::key(KnownSearches::Key::Kind::zeros, tower, mode, lower, upper, options.special);
  key.numbers.push_back(options.most_cells);
  key.numbers.push_back(options.touches ? 1 : 0);
  for (const int half : std::bit_cast<std::array<int, 2>>(options.smallest)) key.numbers.push_back(half);
  key.polynomials.push_back(first.polynomial);
  key.polynomials.push_back(second.polynomial);
  key.numbers.push_back(static_cast<int>(options.also.size()));
  for (const SheetFunction& function : options.also) key.polynomials.push_back(function.polynomial);
  return *options.searches->get<ZeroSet>(key, [&] {
    return std::make_shared<const ZeroSet>(found_zeros(tower, mode, first, second, lower, upper, options));
  });
}

}  // namespace clearloci::loci::sheet
