#include "loci/sheet/patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clearloci::loci::sheet {

namespace {

using core::Polynomial;
using core::Rational;

core::Point2 place_of(const Star& star) { return {core::to_double(star.x), core::to_double(star.y)}; }

/// The rectangle around a star; none: it has nothing to do with the box.
std::optional<std::array<double, 4>> rectangle_around(const Star& star, const std::array<double, 4>& box,
                                                      const std::vector<core::Point2>& bases, bool skewed) {
  // A star this close to the box's edge, relative to its rectangle, has the rectangle reach across the edge.
  constexpr double margin = 0.05;
  // No round numbers, since sides of rectangles on sides of the box are hard to tell apart.
  constexpr double largest = 0.0607;  // half a rectangle's width, relative to the box
  // Functions are small around other bases: polynomials in polar coordinates are no good form there.
  constexpr double share = 0.2473;  // of the way to the next base
  // Along a common tangent, relative to the way off it: every curve towards the touch then stays in the rectangle.
  constexpr double flat = 0.4931;
  // Of the way to the sides x0, x1, y0, y1: no corner in a direction in which designs on a lattice have branches.
  constexpr std::array<double, 4> shares = {0.9371, 0.8533, 0.9713, 0.8117};
  const auto [x, y] = place_of(star);
  double reach = largest * std::max(box[1] - box[0], box[3] - box[2]);
  for (const core::Point2& base : bases) {
    const double distance = std::max(std::abs(base[0] - x), std::abs(base[1] - y));
    if (distance > 0) reach = std::min(reach, share * distance);
  }
  reach = std::min(reach, star.room);
  const double edge = margin * reach;
  if (x < box[0] - edge || x > box[1] + edge || y < box[2] - edge || y > box[3] + edge) return std::nullopt;
  // Short binary fractions, so that the charts' coefficients stay short.
  const double grain = std::exp2(std::floor(std::log2(reach)) - 20);
  const Star& tangential = star.tangential.empty() ? star : star.tangential.front();
  const bool sheared = tangential.is_sheared();
  const auto side = [&](double centre, double wanted_reach, double direction, double limit) {
    const double rounded = std::round((centre + direction * wanted_reach) / grain) * grain;
    const double room = direction * (limit - centre);
    if (sheared) return rounded;
    return room >= wanted_reach * 1.1 ? rounded : room > edge ? limit : rounded;
  };
  const double across = sheared && !tangential.along_y ? flat * reach : reach;
  const double up = sheared && tangential.along_y ? flat * reach : reach;
  const auto reach_to = [&](std::size_t s) { return (s < 2 ? across : up) * (skewed ? shares[s] : 1.0); };
  return std::array{side(x, reach_to(0), -1, box[0]), side(x, reach_to(1), 1, box[1]), side(y, reach_to(2), -1, box[2]),
                    side(y, reach_to(3), 1, box[3])};
}

/// Adds the charts around a star.
void add_charts(Partition& parts, int star, const std::array<Rational, 4>& rectangle) {
  using Side = Chart::Side;
  using To = ChartBorder::To;
  const Star& at = parts.stars[static_cast<std::size_t>(star)];
  std::array<std::array<int, 2>, 4> outermost{};  // of each side's charts, those before and beyond all others
  const auto border = [&](const ChartBorder& of) -> ChartBorder& {
    return parts.borders[static_cast<std::size_t>(of.chart)][side_of(of.axis, of.end)];
  };
  /// `from` searches for the zeros between them.
  const auto join = [&](const ChartBorder& from, const ChartBorder& to) {
    border(from) = {To::chart, true, to.chart, to.axis, to.end};
    border(to) = {To::chart, false, from.chart, from.axis, from.end};
  };
  const auto place = [](int chart, int axis, int end) { return ChartBorder{To::chart, true, chart, axis, end}; };
  constexpr std::array sides = {Side::right, Side::top, Side::left, Side::bottom};
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const int first = static_cast<int>(parts.charts.size());
    for (Chart& chart : Chart(sides[s], star, at, rectangle).parts(at)) {
      ChartBorders& borders = parts.borders.emplace_back();
      borders[0].to = To::star;
      borders[1].to = To::plane;
      if (chart.is_wing()) borders[2].to = To::star;
      parts.charts.push_back(std::move(chart));
    }
    const int last = static_cast<int>(parts.charts.size()) - 1;
    outermost[s] = {first, last};
    if (first == last) continue;
    const int before = first, middle = first + 2, beyond = last;
    join(place(before + 1, 0, 1), place(before, 1, 1));
    join(place(before + 1, 1, 1), place(middle, 1, -1));
    join(place(beyond - 1, 1, 1), place(middle, 1, 1));
    join(place(beyond - 1, 0, 1), place(beyond, 1, -1));
  }
  const auto& [right, top, left, bottom] = outermost;
  join(place(right[1], 1, 1), place(top[1], 1, 1));
  join(place(right[0], 1, -1), place(bottom[1], 1, 1));
  join(place(left[1], 1, 1), place(top[0], 1, -1));
  join(place(left[0], 1, -1), place(bottom[0], 1, -1));
}

}  // namespace

std::vector<core::Point2> bases(const core::RootTower& tower) {
  std::vector<core::Point2> result;
  for (const Polynomial& denominator : tower.denominators)
    if (const auto base = double_point(denominator))
      result.push_back({core::to_double((*base)[0]), core::to_double((*base)[1])});
  return result;
}

Partition partition(const core::RootTower& tower, const std::array<double, 4>& box, std::vector<core::Point2> bases,
                    const std::vector<Star>& special, bool skewed) {
  std::vector<Star> all = cones(tower);
  for (const Star& star : special) {
    const auto known =
        std::find_if(all.begin(), all.end(), [&](const Star& other) { return other.at_same_place(star); });
    if (known == all.end())
      all.push_back(star);
    else
      known->no_length = known->no_length || star.no_length;
    bases.push_back(place_of(star));
  }
  Partition result;
  result.domain = box;
  result.charts.emplace_back();
  result.borders.emplace_back();
  for (const Star& star : all) {
    const auto hole = rectangle_around(star, box, bases, skewed);
    if (!hole) continue;
    const int index = static_cast<int>(result.stars.size());
    result.stars.push_back(star);
    result.holes.push_back(*hole);
    add_charts(result, index, {(*hole)[0], (*hole)[1], (*hole)[2], (*hole)[3]});
    for (const std::size_t c : {0, 2}) {
      result.domain[c] = std::min(result.domain[c], (*hole)[c]);
      result.domain[c + 1] = std::max(result.domain[c + 1], (*hole)[c + 1]);
    }
  }
  return result;
}

std::vector<PlaneCell> outside_holes(const Partition& partition) {
  std::vector<double> xs = {partition.domain[0], partition.domain[1]}, ys = {partition.domain[2], partition.domain[3]};
  for (const auto& hole : partition.holes) {
    xs.insert(xs.end(), {hole[0], hole[1]});
    ys.insert(ys.end(), {hole[2], hole[3]});
  }
  for (auto* cuts : {&xs, &ys}) {
    std::sort(cuts->begin(), cuts->end());
    cuts->erase(std::unique(cuts->begin(), cuts->end()), cuts->end());
  }
  std::vector<PlaneCell> result;
  for (std::size_t i = 0; i + 1 < xs.size(); ++i)
    for (std::size_t k = 0; k + 1 < ys.size(); ++k) {
      const bool in_hole = std::any_of(partition.holes.begin(), partition.holes.end(), [&](const auto& hole) {
        return hole[0] <= xs[i] && xs[i + 1] <= hole[1] && hole[2] <= ys[k] && ys[k + 1] <= hole[3];
      });
      if (!in_hole) result.push_back({{xs[i], xs[i + 1]}, {ys[k], ys[k + 1]}});
    }
  return result;
}

}  // namespace clearloci::loci::sheet
