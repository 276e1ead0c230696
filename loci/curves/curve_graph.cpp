#include "loci/curves/curve_graph.hpp"

#include <algorithm>

#include "loci/curves/graph_builder.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {
namespace {

constexpr unsigned most_attempts = 4;

/// An enclosure wider than rounding, whose middle is not on the curve, gets the curve's point at the middle of its
/// range of variable `along` for its middle.
void move_to_curve(const Patch& patch, int along, std::vector<Interval>& enclosure) {
  const double size = std::max(patch.domain.x.width(), patch.domain.y.width());
  LiftedPoint point;
  double width = 0;
  for (const Interval& value : enclosure) {
    point.push_back(value.middle());
    width = std::max(width, value.width());
  }
  if (width <= crossing_accuracy * size) return;
  LiftedPoint row(point.size(), 0.0), moved = point;
  row[static_cast<std::size_t>(along)] = 1;
  SheetFollower follower(*patch.program, size);
  if (!follower.correct(moved, row, point[static_cast<std::size_t>(along)])) return;
  for (std::size_t v = 0; v < point.size(); ++v)
    if (static_cast<int>(v) != along && enclosure[v].contains(moved[v])) enclosure[v] = Interval(moved[v]);
}

}  // namespace

LiftedPoint StretchEnd::middle() const {
  LiftedPoint point;
  for (const Interval& value : enclosure) point.push_back(value.middle());
  return point;
}

std::vector<Patch> make_patches(const core::RootTower& tower, const SheetFunction& curve, const Partition& parts) {
  std::vector<Patch> patches;
  Charting charting(tower, {curve}, parts.stars);
  for (const Chart& chart : parts.charts) {
    Patch patch;
    patch.chart = chart;
    const auto& d = parts.domain;
    patch.domain = chart.side == Side::plane ? PlaneCell{{d[0], d[1]}, {d[2], d[3]}} : PlaneCell{{0, 1}, {-1, 1}};
    const ChartedSheet sheet = charting.in(chart);
    patch.program = std::make_shared<const SheetProgram>(sheet.tower, sheet.functions);
    patches.push_back(std::move(patch));
  }
  return patches;
}

CurveGraph curve_graph(const core::RootTower& tower, const SheetFunction& curve, const core::WorkingMode& mode,
                       const Partition& parts, const TreeOptions& options) {
  for (unsigned attempt = 0;; ++attempt) {
    TreeOptions tree_options = options;
    tree_options.attempt = attempt;
    // A budget that is not to be extended is none to be spent several times either.
    const bool last = attempt + 1 >= most_attempts || !options.extended || (options.stop && options.stop());
    if (auto graph = GraphBuilder(tower, curve, mode, parts, tree_options, last).run()) return std::move(*graph);
  }
}

bool cut_stretch(CurveGraph& graph, int patch, std::vector<Interval> enclosure, Crossing crossing) {
  const Patch& patch_data = graph.patches[static_cast<std::size_t>(patch)];
  const int leaf = patch_data.tree->locate(enclosure[0], enclosure[1]);
  if (leaf < 0) return false;
  for (Stretch& stretch : graph.stretches) {
    if (stretch.patch != patch || stretch.leaf != leaf) continue;
    const auto along = static_cast<std::size_t>(stretch.along);
    const Interval& key = enclosure[along];
    if (!(stretch.ends[0].enclosure[along].upper() < key.lower() &&
          key.upper() < stretch.ends[1].enclosure[along].lower()))
      continue;
    move_to_curve(patch_data, stretch.along, enclosure);
    crossing.at = patch_data.chart.to_plane(enclosure[0].middle(), enclosure[1].middle());
    for (std::size_t c = 0; c < 2; ++c)
      if (crossing.fixed[c]) crossing.at[c] = *crossing.fixed[c];
    graph.crossings.push_back(crossing);
    Stretch rest = stretch;
    rest.ends[0] = {static_cast<int>(graph.crossings.size()) - 1, enclosure};
    stretch.ends[1] = rest.ends[0];
    graph.stretches.push_back(std::move(rest));
    return true;
  }
  return false;
}

}  // namespace clearloci::loci::sheet
