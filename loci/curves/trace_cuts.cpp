#include "loci/curves/tracer.hpp"

#include <algorithm>
#include <cmath>

#include "core/dense_terms.hpp"
#include "loci/curves/vertices.hpp"

namespace clearloci::loci::sheet {
namespace {

// Where curve and region's edge touch, double zeros stay open down to smallest_cut. Open places up to this width,
// relative to the patch, count as one point.
constexpr double widest_touch = 1e-10;

// Along a side of the box that the curve touches they are as long as the root of that: in between the curve strays from
// the side by less than the place is wide.
constexpr double longest_touch = 1e-6;

// Zeros of (N, cutter) closer than this, relative to the patch, are a touch; more live cells than this a shared curve.
constexpr double smallest_cut = 1e-12;

// Nearer than this, relative to the region, a point is on the curve to rounding.
constexpr double at_rounding = 1e-14;

// Vertices are this near to their curve, relative to the region.
constexpr double vertex_accuracy = 1e-12;

}  // namespace

bool found_at_star(const Subtower& part, const SheetFunction& sheet, const Partition& parts, int star,
                   const std::function<bool()>& stop) {
  Charting charting(part.tower, {narrowed(sheet, part)}, parts.stars);
  for (const Chart& chart : parts.charts) {
    if (chart.side == Chart::Side::plane || chart.star != star) continue;
    const ChartedSheet charted = charting.in(chart);
    const SheetProgram program(charted.tower, charted.functions);
    const auto is_found = [&](int axis, const PlaneCell& side) {
      const FoundZeros found =
          ZeroSearch(program, part.mode, {{0}, {1 - axis}}).run({side}, {smallest_cut, most_star_cells, 1e-13, stop});
      return !found.enclosures.empty() || !found.undecided.empty();
    };
    if (is_found(0, {0.0, {-1, 1}}) || (chart.is_wing() && is_found(1, {{0, 1}, -1.0}))) return true;
  }
  return false;
}

bool Tracer::is_searched(int patch, int leaf, const Cut& cut) const {
  const Patch& patch_data = graph_.patches[static_cast<std::size_t>(patch)];
  const Leaf& candidate = patch_data.tree->leaves()[static_cast<std::size_t>(leaf)];
  if (candidate.kind != LeafKind::graph) return false;
  if (cut.side < 0) return true;
  const PlaneCell place = patch_data.chart.to_plane(candidate.cell);
  const auto side = static_cast<std::size_t>(cut.side);
  if (!(cut.side < 2 ? place.x : place.y).contains(box_[side])) return false;
  if (std::find(options_.along_side.begin(), options_.along_side.end(), cut.side) == options_.along_side.end())
    return true;
  return std::none_of(graph_.stretches.begin(), graph_.stretches.end(), [&](const Stretch& stretch) {
    if (stretch.patch != patch || stretch.leaf != leaf) return false;
    const int colour = options_.colour ? options_.colour(point_inside(graph_, {{&stretch, true}}, size_)) : 0;
    return along_side(colour) == cut.side;
  });
}

void Tracer::apply(const Cut& cut, const Partition& parts) {
  if (cut.sheet.polynomial.is_constant()) return;
  if (cut.side >= 0) return cut_in_patches(narrowed(cut.sheet, own_), cut, parts);
  const Subtower both = subtower(tower_, mode_, {sheet_.polynomial, cut.sheet.polynomial});
  const bool is_own = both.kept == own_.kept;
  if (cut.keep && is_own) return cut_in_patches(narrowed(cut.sheet, own_), cut, parts);
  const Partition parts_of_both = parts_of(both);
  if (!cut.keep) cut_at_stars(both, cut, parts_of_both);
  if (is_own)
    cut_in_patches(narrowed(cut.sheet, own_), cut, parts);
  else
    cut_on_both(both, cut, parts_of_both);
}

void Tracer::cut_in_patches(const SheetFunction& cutter, const Cut& cut, const Partition& parts) {
  Charting charting(own_.tower, {curve_, cutter}, parts.stars);
  for (std::size_t p = 0; p < graph_.patches.size(); ++p) {
    const Patch& patch = graph_.patches[p];
    std::vector<PlaneCell> seeds;
    for (std::size_t l = 0; l < patch.tree->leaves().size(); ++l)
      if (is_searched(static_cast<int>(p), static_cast<int>(l), cut)) seeds.push_back(patch.tree->leaves()[l].cell);
    if (seeds.empty()) continue;
    const ChartedSheet sheet = charting.in(patch.chart);
    const SheetProgram program(sheet.tower, sheet.functions);
    const double size = std::max(patch.domain.x.width(), patch.domain.y.width());
    TouchSearch touches(sheet.tower, sheet.functions, own_.mode, size);
    const FoundZeros found = ZeroSearch(program, own_.mode, {})
                                 .run(seeds, {smallest_cut * size, cut_cells(), 1e-13 * size, options_.stop, &touches});
    std::vector<PlaneCell> open = found.undecided;
    for (const Touch& touch : found.touches) open.push_back({touch.enclosure[0], touch.enclosure[1]});
    for (const std::vector<Interval>& zero : found.enclosures)
      if (!cut_stretch(graph_, static_cast<int>(p), zero, crossing_of(cut))) open.push_back({zero[0], zero[1]});
    for (const PlaneCell& cell : clusters(std::move(open)))
      if (!at_star(patch.chart, cell) && !at_end(patch.chart.to_plane(cell), cut) &&
          !is_touched_from_beyond(patch.chart.to_plane(cell)) && !touch(static_cast<int>(p), cell, cut))
        graph_.undecided.push_back(patch.chart.to_plane(cell));
  }
}

Crossing Tracer::crossing_of(const Cut& cut) const {
  Crossing crossing;
  crossing.kind = cut.keep ? Crossing::Kind::edge : Crossing::Kind::cut;
  (cut.keep ? crossing.alone : crossing.label) = cut.label;
  if (cut.side >= 0) crossing.fixed[static_cast<std::size_t>(cut.side / 2)] = core::to_double(sides_[cut.side]);
  return crossing;
}

bool Tracer::is_one_point(const PlaneCell& place, const Cut& cut, double size) {
  const double thin = std::min(place.x.width(), place.y.width()), wide = std::max(place.x.width(), place.y.width());
  return thin <= widest_touch * size && wide <= (cut.side < 0 ? widest_touch : longest_touch) * size;
}

bool Tracer::may_cut_at(const PlaneCell& place, const Cut& cut) const {
  if (cut.keep) return true;
  const Subtower both = subtower(tower_, mode_, {sheet_.polynomial, cut.sheet.polynomial});
  return vanish_exactly(both.tower, both.mode,
                        {narrowed(sheet_.polynomial, both), narrowed(cut.sheet.polynomial, both)}, place);
}

bool Tracer::touch(int patch, const PlaneCell& place, const Cut& cut) {
  const Patch& patch_data = graph_.patches[static_cast<std::size_t>(patch)];
  const double size = std::max(patch_data.domain.x.width(), patch_data.domain.y.width());
  if (!is_one_point(place, cut, size) || !may_cut_at(patch_data.chart.to_plane(place), cut)) return false;
  SheetCell cell(*patch_data.program, own_.mode);
  if (!cell.enter(place.x, place.y)) return true;  // outside the workspace
  std::vector<Interval> enclosure = {place.x, place.y};
  for (std::size_t j = 0; j < own_.mode.size(); ++j) enclosure.push_back(cell.root(static_cast<int>(j)));
  return cut_stretch(graph_, patch, enclosure, crossing_of(cut));
}

bool Tracer::is_touched_from_beyond(const PlaneCell& place) const {
  return std::any_of(
      graph_.touched_from_beyond.begin(), graph_.touched_from_beyond.end(),
      [&](const PlaneCell& touched) { return !disjoint(touched.x, place.x) && !disjoint(touched.y, place.y); });
}

void Tracer::add_touched_points(const std::vector<Cut>& cuts) {
  for (const PlaneCell& place : graph_.touched_from_beyond) {
    const core::Point2 at = {place.x.middle(), place.y.middle()};
    const bool is_off = std::any_of(cuts.begin(), cuts.end(), [&](const Cut& cut) {
      const Subtower part = subtower(tower_, mode_, {cut.sheet.polynomial});
      const SheetProgram program(part.tower, std::vector{narrowed(cut.sheet, part)});
      SheetCell cell(program, part.mode);
      if (!cell.enter(place.x, place.y)) return true;
      return cut.keep ? cell.value(0).sign() < 0 : cell.value(0).contains_zero();
    });
    if (!is_off) isolated_points_.push_back(at);
  }
}

void Tracer::cut_at_stars(const Subtower& both, const Cut& cut, const Partition& parts) {
  for (std::size_t i = 0; i < parts.stars.size(); ++i) {
    const Star& star = parts.stars[i];
    const bool is_on_boundary =
        star.shape == Star::Shape::corner &&
        std::any_of(star.roots.begin(), star.roots.end(), [&](int root) { return star.power_of_root(root) > 1; });
    if (star.shape != Star::Shape::cone && !star.no_length && !is_on_boundary) continue;
    std::vector<Crossing*> ends;
    for (Crossing& crossing : graph_.crossings)
      if (crossing.kind == Crossing::Kind::star && own_stars_[crossing.star].at_same_place(star))
        ends.push_back(&crossing);
    const core::Point2 at = {core::to_double(star.x), core::to_double(star.y)};
    const bool passes = ends.empty() && passes_through(at);
    if ((ends.empty() && !passes) || !found_at_star(both, cut.sheet, parts, static_cast<int>(i), options_.stop))
      continue;
    for (Crossing* end : ends) end->label = cut.label;
    const double r = at_rounding * size_;
    if (passes) cut_at({{at[0] - r, at[0] + r}, {at[1] - r, at[1] + r}}, crossing_of(cut));
  }
}

bool Tracer::passes_through(const core::Point2& at) const {
  const SheetProgram& program = *graph_.patches[0].program;
  SheetCell here(program, own_.mode);
  if (!here.enter(at[0], at[1]) || !here.lifted().empty()) return false;
  here.differentiate();
  const double slope = std::hypot(here.slope(0, 0).middle(), here.slope(0, 1).middle());
  return std::abs(here.value(0).middle()) <= at_rounding * size_ * slope;
}

bool Tracer::at_end(const PlaneCell& place, const Cut& cut) {
  const double width = same_place * size_;
  if (!is_one_point(place, cut, size_)) return false;
  bool found = false;
  for (Crossing& crossing : graph_.crossings) {
    if (crossing.kind == Crossing::Kind::seam || crossing.kind == Crossing::Kind::node) continue;
    if (std::abs(crossing.at[0] - place.x.middle()) > width + place.x.width() / 2 ||
        std::abs(crossing.at[1] - place.y.middle()) > width + place.y.width() / 2)
      continue;
    found = true;
    if (cut.side >= 0) move_onto_side(crossing.at, cut.side);
    if (!cut.keep && crossing.kind == Crossing::Kind::rim) crossing.label = cut.label;
  }
  return found;
}

void Tracer::move_onto_side(core::Point2& at, int side) const {
  const double level = core::to_double(sides_[static_cast<std::size_t>(side)]);
  double& coordinate = at[static_cast<std::size_t>(side / 2)];
  const double beyond = side % 2 == 0 ? level - coordinate : coordinate - level;
  if (beyond > 0 && beyond <= vertex_accuracy * size_) coordinate = level;
}

void Tracer::cut_on_both(const Subtower& both, const Cut& cut, const Partition& parts) {
  std::vector<PlaneCell> open;
  Charting charting(both.tower, {narrowed(sheet_, both), narrowed(cut.sheet, both)}, parts.stars);
  for (const Chart& chart : parts.charts) {
    const std::vector<PlaneCell> seeds = seeds_in(chart, parts);
    if (seeds.empty()) continue;
    const ChartedSheet sheet = charting.in(chart);
    const SheetProgram program(sheet.tower, sheet.functions);
    const double size = chart.side == Chart::Side::plane ? size_ : 1.0;
    TouchSearch touches(sheet.tower, sheet.functions, both.mode, size);
    const FoundZeros found = ZeroSearch(program, both.mode, {})
                                 .run(seeds, {smallest_cut * size, cut_cells(), 1e-13 * size, options_.stop, &touches});
    for (const Touch& touch : found.touches) {
      const PlaneCell cell = {touch.enclosure[0], touch.enclosure[1]};
      if (!at_star(chart, cell)) open.push_back(chart.to_plane(cell));
    }
    for (const PlaneCell& cell : found.undecided)
      if (!at_star(chart, cell)) open.push_back(chart.to_plane(cell));
    for (const std::vector<Interval>& zero : found.enclosures) {
      const PlaneCell place = chart.to_plane(PlaneCell{zero[0], zero[1]});
      if (!at_star(chart, {zero[0], zero[1]}) && !cut_at(place, crossing_of(cut))) open.push_back(place);
    }
  }
  for (const PlaneCell& cell : clusters(std::move(open))) {
    if (!at_end(cell, cut) && !is_touched_from_beyond(cell) &&
        !(is_one_point(cell, cut, size_) && may_cut_at(cell, cut) && cut_at(cell, crossing_of(cut))))
      graph_.undecided.push_back(cell);
  }
}

std::vector<PlaneCell> Tracer::seeds_in(const Chart& chart, const Partition& parts) const {
  // What vanishes at a star, and so its charts and its rectangle, depends on the tower.
  const auto has_rectangle_of = [&](const Chart& own) {
    return std::any_of(parts.charts.begin(), parts.charts.end(), [&](const Chart& other) {
      return other.side != Chart::Side::plane && other.rectangle == own.rectangle;
    });
  };
  const bool to_plane = chart.side == Chart::Side::plane;
  std::vector<PlaneCell> seeds;
  for (const Patch& patch : graph_.patches) {
    const bool same = patch.chart == chart;
    if (to_plane && !same && has_rectangle_of(patch.chart)) continue;
    for (const Leaf& leaf : patch.tree->leaves()) {
      if (leaf.kind != LeafKind::graph) continue;
      const std::optional<PlaneCell> share = same ? leaf.cell : chart.share_of(patch.chart.to_plane(leaf.cell));
      if (share && !(to_plane && in_hole(*share, parts))) seeds.push_back(*share);
    }
  }
  return seeds;
}

bool Tracer::in_hole(const PlaneCell& cell, const Partition& parts) {
  return std::any_of(parts.holes.begin(), parts.holes.end(), [&](const auto& hole) {
    return hole[0] <= cell.x.lower() && cell.x.upper() <= hole[1] && hole[2] <= cell.y.lower() &&
           cell.y.upper() <= hole[3];
  });
}

bool Tracer::cut_at(const PlaneCell& place, const Crossing& crossing) {
  for (std::size_t p = 0; p < graph_.patches.size(); ++p) {
    const Patch& patch = graph_.patches[p];
    const std::optional<PlaneCell> local = patch.chart.from_plane(place);
    if (!local) continue;
    const int leaf = patch.tree->locate(local->x, local->y);
    if (leaf < 0 || patch.tree->leaves()[leaf].kind == LeafKind::hole) continue;
    SheetCell cell(*patch.program, own_.mode);
    if (!cell.enter(local->x, local->y)) return false;
    std::vector<Interval> enclosure = {local->x, local->y};
    for (std::size_t j = 0; j < own_.mode.size(); ++j) enclosure.push_back(cell.root(static_cast<int>(j)));
    return cut_stretch(graph_, static_cast<int>(p), enclosure, crossing);
  }
  return false;
}

}  // namespace clearloci::loci::sheet
