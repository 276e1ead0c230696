#include "numeric/validate_lines.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "numeric/checked_reaction.hpp"
#include "numeric/edge_judge.hpp"
#include "numeric/surface_passages.hpp"
#include "numeric/turns.hpp"

namespace clearloci::numeric {
namespace {

using core::LocusKind;
using core::LocusMap;
using core::LocusSurface;
using core::WorkingMode;

/// Off every centre and every symmetry (validate.hpp).
constexpr std::array<double, 3> shifts = {std::numbers::sqrt2 - 1, std::numbers::phi - 1, std::numbers::sqrt3 - 1};

/// Points are roots in doubles, vertices of surfaces crossings of edges; as a part of the box.
constexpr double least_reach = 1e-9;
/// A triangle may be off by this many times what its surface's middles of triangles are off by at most.
constexpr double times_deviation = 4;
/// As of validate.cpp.
constexpr double flip_resolution = 1e-10;
constexpr std::size_t zero_samples = 64, most_zero_samples = 4096;
/// Distances from a locus at which a reaction is looked at (arc_witness.cpp), as parts of the box.
constexpr std::array<double, 3> distances = {1e-5, 1e-5 * approach_step, 1e-5 * approach_step* approach_step};
constexpr std::size_t places_of_a_surface = 60;

/// A point of the map, or a surface, as it is looked at.
struct Locus {
  std::string id;
  LocusKind kind = LocusKind::contact_loss;
  std::vector<core::Vanishing> vanishing;
  bool excited = true;
  /// Poses on it, and unit vectors across it over the box scaled to a cube.
  struct Place {
    std::vector<double> at, across;
  };
  std::vector<Place> places;
};

core::Point3 across(const core::Point3& a, const core::Point3& b, const core::Point3& c,
                    const std::vector<double>& widths) {
  std::array<double, 3> u{}, v{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = (b[i] - a[i]) / widths[i];
    v[i] = (c[i] - a[i]) / widths[i];
  }
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// Inner vertices, evenly over the list.
std::vector<Locus::Place> places_of(const LocusSurface& surface, const std::vector<double>& widths) {
  std::vector<core::Point3> normals(surface.vertices.size());
  std::map<std::pair<int, int>, int> triangles_of_edge;
  for (const auto& t : surface.triangles) {
    const auto vertex = [&](std::size_t k) { return surface.vertices[static_cast<std::size_t>(t[k])]; };
    const core::Point3 normal = across(vertex(0), vertex(1), vertex(2), widths);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) normals[static_cast<std::size_t>(t[k])][i] += normal[i];
      ++triangles_of_edge[std::minmax(t[k], t[(k + 1) % 3])];
    }
  }
  std::vector<bool> rim(surface.vertices.size(), false);
  for (const auto& [edge, count] : triangles_of_edge)
    if (count == 1) rim[static_cast<std::size_t>(edge.first)] = rim[static_cast<std::size_t>(edge.second)] = true;
  std::vector<std::size_t> inner;
  for (std::size_t i = 0; i < rim.size(); ++i)
    if (!rim[i]) inner.push_back(i);
  std::vector<Locus::Place> places;
  const std::size_t stride = std::max<std::size_t>(1, inner.size() / places_of_a_surface);
  for (std::size_t k = stride / 2; k < inner.size(); k += stride) {
    const core::Point3 &at = surface.vertices[inner[k]], &n = normals[inner[k]];
    const double length = std::hypot(n[0], n[1], n[2]);
    if (length > 0) places.push_back({{at.begin(), at.end()}, {n[0] / length, n[1] / length, n[2] / length}});
  }
  return places;
}

/// Evenly along the arcs, each with a way off the curve.
std::vector<Locus::Place> places_of(const core::SpaceCurve& curve, const std::vector<double>& widths) {
  std::size_t vertices = 0;
  for (const core::SpaceArc& arc : curve.arcs) vertices += arc.points.size();
  const std::size_t stride = std::max<std::size_t>(1, vertices / places_of_a_surface);
  std::vector<Locus::Place> places;
  for (const core::SpaceArc& arc : curve.arcs)
    for (std::size_t i = stride / 2 + 1; i + 1 < arc.points.size(); i += stride) {
      std::array<double, 3> way{};
      for (std::size_t c = 0; c < 3; ++c) way[c] = (arc.points[i + 1][c] - arc.points[i - 1][c]) / widths[c];
      // Across the coordinate that the curve goes along least.
      std::size_t least = 0;
      for (std::size_t c = 1; c < 3; ++c)
        if (std::abs(way[c]) < std::abs(way[least])) least = c;
      std::vector<double> off(3, 0.0);
      const double square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
      if (!(square > 0)) continue;
      for (std::size_t c = 0; c < 3; ++c) off[c] = (c == least ? 1.0 : 0.0) - way[least] * way[c] / square;
      const double length = std::hypot(off[0], off[1], off[2]);
      for (double& component : off) component /= length;
      places.push_back({{arc.points[i].begin(), arc.points[i].end()}, off});
    }
  return places;
}

class LinesOfMode {
 public:
  LinesOfMode(const NumericModel& model, const LocusMap& map, const GridSpec& spec, const WorkingMode& mode,
              const std::vector<TracedReaction>& traced)
      : model_(model), map_(map), mode_(mode), signs_(dyad_signs(model, map.tower, mode)), n_(model.box.size()) {
    const std::array<int, 3> nodes = {spec.nx, spec.ny, spec.nz};
    for (std::size_t c = 0; c < n_; ++c) {
      const double low = core::to_double(map.lower[c]), width = core::to_double(map.upper[c]) - low;
      widths_.push_back(width);
      const double step = width / nodes[c];
      axes_[c] = {low + shifts[c] * step, step, nodes[c]};
      diagonal_ = std::hypot(diagonal_, width);
    }
    reach_ = least_reach * diagonal_;
    for (const LocusSurface& surface : map.surfaces)
      if (surface.mode == mode) reach_ = std::max(reach_, times_deviation * surface.deviation);
    if (n_ == 1)
      for (std::size_t i = 0; i < map.isolated_points.size(); ++i) {
        const core::IsolatedPoint& point = map.isolated_points[i];
        add({"p" + std::to_string(i + 1), point.kind, point.vanishing, point.excited, {{point.at, {1.0}}}}, point.mode);
      }
    else
      for (const LocusSurface& surface : map.surfaces)
        add({surface.id, surface.kind, surface.vanishing, surface.excited, places_of(surface, widths_)}, surface.mode);
    if (n_ == 3) add_thin_loci();
    turning_ = joints_of_turns(model, map, mode, traced);
    for (const TracedReaction& reaction : traced) {
      CheckedReaction& checked = reactions_.emplace_back(checked_reaction(model, reaction));
      for (const auto& [locus, here] : loci_)
        checked.weights.push_back(here ? times_vanishing(locus.kind, locus.vanishing, checked) : 0);
    }
  }

  void run(ValidationReport& report, std::size_t listed) {
    find_zeros();
    std::vector<std::array<std::size_t, 4>> counts(reactions_.size());
    for (std::size_t along = 0; along < n_; ++along) judge_lines(along, counts, report, listed);
    for (std::size_t r = 0; r < reactions_.size(); ++r)
      if (is_judged_by_edges(reactions_[r])) add_tally(report, mode_, reactions_[r].reaction, counts[r], zero_[r]);
    for (std::size_t l = 0; l < loci_.size(); ++l)
      if (loci_[l].second && tells_zeros(loci_[l].first.kind)) judge_locus(l, report);
    if (n_ == 3) judge_turns(model_, signs_, map_, mode_, axes_, turning_, listed, report);
  }

 private:
  /// Curves and points at which forces of several components vanish. No line of the grid meets them: they come after
  /// the surfaces, whose numbers are those of their places in the map.
  void add_thin_loci() {
    const auto add_thin = [&](Locus locus, const WorkingMode& mode) {
      if (!locus.places.empty()) loci_.emplace_back(std::move(locus), mode == mode_);
      boundary_.resize(loci_.size(), 0);
    };
    for (const core::SpaceCurve& curve : map_.space_curves)
      add_thin({curve.id, curve.kind, curve.vanishing, true, places_of(curve, widths_)}, curve.mode);
    for (std::size_t i = 0; i < map_.isolated_points.size(); ++i) {
      const core::IsolatedPoint& point = map_.isolated_points[i];
      add_thin({"p" + std::to_string(i + 1), point.kind, point.vanishing, point.excited, {{point.at, {1.0, 0.0, 0.0}}}},
               point.mode);
    }
  }

  void add(Locus locus, const WorkingMode& mode) {
    const bool here = mode == mode_;
    boundary_.push_back(here && locus.kind == LocusKind::workspace_boundary ? 1 : 0);
    if (here) numbers_.push_back(static_cast<int>(loci_.size()));
    loci_.emplace_back(std::move(locus), here);
  }

  /// Where |A| vanishes the force across a pin's axis flips as its components do: no edge tells these from zeros.
  bool is_judged_by_edges(const CheckedReaction& checked) const {
    return checked.columns.pin < 0 && !is_judged_by_turns(checked.reaction, turning_);
  }

  std::vector<double> node(std::size_t index) const {
    std::vector<double> pose;
    for (std::size_t c = 0; c < n_; ++c) {
      const auto nodes = static_cast<std::size_t>(axes_[c].nodes);
      pose.push_back(axes_[c].at(static_cast<int>(index % nodes)));
      index /= nodes;
    }
    return pose;
  }

  /// Reactions that are nonzero beyond rounding at none of some nodes.
  void find_zeros() {
    std::size_t nodes = 1;
    for (std::size_t c = 0; c < n_; ++c) nodes *= static_cast<std::size_t>(axes_[c].nodes);
    zero_.assign(reactions_.size(), false);
    std::vector<bool> seen(reactions_.size(), false);
    bool any = false;
    for (const std::size_t samples : {zero_samples, most_zero_samples}) {
      // A stride that shares no factor with round numbers of nodes.
      const std::size_t stride = std::max<std::size_t>(1, nodes / samples) | 1U;
      for (std::size_t k = 0; k < nodes; k += stride) {
        const BoundedNumerators at = bounded_numerators(model_, node(k), signs_);
        if (!at.reachable) continue;
        any = true;
        for (std::size_t r = 0; r < reactions_.size(); ++r) seen[r] = seen[r] || is_decided(at, reactions_[r].columns);
      }
      if (std::all_of(seen.begin(), seen.end(), [](bool is_checked) { return is_checked; })) break;
    }
    for (std::size_t r = 0; any && r < seen.size(); ++r) zero_[r] = !seen[r];
  }

  std::vector<std::vector<Passage>> passages_along(std::size_t along) const {
    if (n_ == 3) return find_passages(axes_, along, map_.surfaces, numbers_, reach_);
    std::vector<std::vector<Passage>> line(1);
    for (const int number : numbers_) {
      const double at = loci_[static_cast<std::size_t>(number)].first.places.front().at.front();
      line.front().push_back({at - reach_, at + reach_, at, true, number});
    }
    std::sort(line.front().begin(), line.front().end(),
              [](const Passage& a, const Passage& b) { return a.low < b.low; });
    return line;
  }

  struct LineTally {
    std::vector<std::array<std::size_t, 4>> counts;
    std::vector<DisputedEdge> disputed;
  };

  void judge_lines(std::size_t along, std::vector<std::array<std::size_t, 4>>& counts, ValidationReport& report,
                   std::size_t listed) const {
    const std::vector<std::vector<Passage>> passages = passages_along(along);
    std::vector<LineTally> tallies(passages.size());
    tbb::parallel_for(std::size_t{0}, passages.size(),
                      [&](std::size_t line) { tallies[line] = judge_line(along, line, passages[line]); });
    for (const LineTally& tally : tallies) {
      for (std::size_t r = 0; r < counts.size(); ++r)
        for (std::size_t v = 0; v < counts[r].size(); ++v) counts[r][v] += tally.counts[r][v];
      for (const DisputedEdge& edge : tally.disputed)
        if (report.disputed_edges.size() < listed) report.disputed_edges.push_back(edge);
    }
  }

  LineTally judge_line(std::size_t along, std::size_t line, const std::vector<Passage>& passages) const {
    std::vector<double> base(n_, 0.0);
    if (n_ == 3) {
      const std::size_t u = along == 0 ? 1 : 0, v = along == 2 ? 1 : 2;
      const auto columns = static_cast<std::size_t>(axes_[u].nodes);
      base[u] = axes_[u].at(static_cast<int>(line % columns));
      base[v] = axes_[v].at(static_cast<int>(line / columns));
    }
    const GridAxis& axis = axes_[along];
    const LineWitness place(model_, signs_, base, along, flip_resolution * diagonal_);
    std::vector<double> poses;
    for (int i = 0; i < axis.nodes; ++i) {
      const std::vector<double> pose = place.point(axis.at(i));
      poses.insert(poses.end(), pose.begin(), pose.end());
    }
    ReactionField field;
    reaction_field(model_, poses, signs_, field);
    EdgeJudge judge(place, axis, passages, boundary_, reach_);
    LineTally tally;
    tally.counts.resize(reactions_.size());
    for (int edge = 0; edge + 1 < axis.nodes; ++edge)
      for (std::size_t r = 0; r < reactions_.size(); ++r) {
        if (zero_[r]) continue;
        const CheckedReaction& checked = reactions_[r];
        if (!is_judged_by_edges(checked)) continue;
        const auto a = static_cast<std::size_t>(edge), b = a + 1;
        const EdgeNodes nodes = edge_nodes(field, a, field, b, checked.columns);
        const Finding finding = judge.judge(edge, {checked.columns, checked.weights}, nodes);
        ++tally.counts[r][static_cast<std::size_t>(finding.outcome)];
        if (finding.outcome == Outcome::disputed)
          tally.disputed.push_back({place.point(axis.at(edge)), place.point(axis.at(edge + 1)), mode_, checked.reaction,
                                    finding.crossings, finding.sign_change});
      }
    return tally;
  }

  std::vector<Approach> approaches_of(const Locus& locus) const {
    std::vector<Approach> ways;
    for (const Locus::Place& place : locus.places)
      for (const double side : {1.0, -1.0}) {
        Approach way;
        for (const double distance : distances) {
          std::vector<double> pose = place.at;
          for (std::size_t c = 0; c < n_; ++c) pose[c] += side * distance * place.across[c] * widths_[c];
          way.at.push_back(bounded_numerators(model_, pose, signs_));
        }
        if (std::all_of(way.at.begin(), way.at.end(),
                        [](const BoundedNumerators& numerators) { return numerators.reachable; }))
          ways.push_back(std::move(way));
      }
    return ways;
  }

  /// What the reactions do beside a locus, against what the map says of them there.
  void judge_locus(std::size_t l, ValidationReport& report) const {
    const Locus& locus = loci_[l].first;
    const std::vector<Approach> ways = approaches_of(locus);
    const bool context = locus.kind == LocusKind::direct_singularity || locus.kind == LocusKind::workspace_boundary;
    const auto most = [&](std::size_t count) { return 2 * count > ways.size(); };
    const auto dispute = [&](const TracedReaction& reaction, bool claimed, bool unbounded) {
      ++report.disputed;
      report.disputed_arcs.push_back({locus.id, locus.places.front().at, mode_, reaction, claimed, unbounded});
    };
    for (std::size_t r = 0; r < reactions_.size(); ++r) {
      const CheckedReaction& checked = reactions_[r];
      const bool claimed = checked.weights[l] != 0;
      if (zero_[r] || (!claimed && !context)) continue;
      const TendencyTally tally = ways.empty() ? TendencyTally{} : tally_of(ways, checked.columns);
      if (claimed && most(tally.other))
        dispute(checked.reaction, true, false);
      else if (claimed)
        ++(most(tally.zero) ? report.arcs_held : report.arcs_undecided);
      else if (most(tally.zero) && !another_passes(l, r))
        dispute(checked.reaction, false, false);
    }
    if (locus.kind != LocusKind::direct_singularity || locus.excited || ways.empty()) return;
    for (std::size_t k = 0; k < model_.unknowns.size(); ++k)
      if (most(tally_of(ways, {static_cast<int>(k)}).unbounded)) {
        const mechanism::Unknown& unknown = model_.unknowns[k];
        dispute({model_.mechanism.joints[static_cast<std::size_t>(unknown.joint)].name, unknown.quantity}, true, true);
      }
  }

  /// Whether another locus on which the map has the reaction vanish runs where most of this one does.
  bool another_passes(std::size_t l, std::size_t r) const {
    const Locus& locus = loci_[l].first;
    std::size_t met = 0;
    for (const Locus::Place& place : locus.places) {
      bool near = false;
      for (std::size_t k = 0; k < loci_.size() && !near; ++k)
        near = reactions_[r].weights[k] != 0 && passes_near(k, place.at);
      met += near ? 1 : 0;
    }
    return 2 * met >= locus.places.size();
  }

  bool passes_near(std::size_t l, const std::vector<double>& at) const {
    if (n_ == 1) return std::abs(loci_[l].first.places.front().at[0] - at[0]) <= 2 * reach_;
    if (l >= map_.surfaces.size()) return false;
    const LocusSurface& surface = map_.surfaces[l];
    return std::any_of(surface.triangles.begin(), surface.triangles.end(), [&](const std::array<int, 3>& t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto value = [&](std::size_t k) { return surface.vertices[static_cast<std::size_t>(t[k])][c]; };
        const auto [least, most] = std::minmax({value(0), value(1), value(2)});
        if (at[c] < least - 2 * reach_ || at[c] > most + 2 * reach_) return false;
      }
      return true;
    });
  }

  const NumericModel& model_;
  const LocusMap& map_;
  WorkingMode mode_;
  std::vector<int> signs_;
  std::size_t n_;
  std::array<GridAxis, 3> axes_;
  std::vector<double> widths_;
  double diagonal_ = 0, reach_ = 0;
  std::vector<std::pair<Locus, bool>> loci_;  ///< of the map, and whether in this mode
  std::vector<int> boundary_, numbers_;
  std::vector<std::string> turning_;  ///< joints of joints_of_turns
  std::vector<CheckedReaction> reactions_;
  std::vector<bool> zero_;
};

std::vector<WorkingMode> modes_of(const NumericModel& model, const LocusMap& map) {
  std::vector<WorkingMode> modes;
  const auto add = [&](const auto& all) {
    for (const auto& line : all)
      if (std::find(modes.begin(), modes.end(), line.mode) == modes.end()) modes.push_back(line.mode);
  };
  add(map.reachable);
  add(map.surfaces);
  if (map.lower.size() == 1) add(map.isolated_points);
  if (!modes.empty()) return modes;
  // No locus at all is a claim, too: in the mode of the file.
  WorkingMode mode;
  std::size_t dyad = 0;
  const std::vector<int> sides = mechanism::working_mode(model.mechanism);
  for (const core::RootNames& root : map.tower.roots)
    mode.push_back(root.role == core::RootRole::working_mode ? sides.at(dyad++) : 1);
  return {mode};
}

}  // namespace

ValidationReport validate_lines(const NumericModel& model, const LocusMap& map, const GridSpec& spec,
                                const std::vector<TracedReaction>& traced) {
  ValidationReport report;
  tbb::task_arena arena(spec.threads > 0 ? spec.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    for (const WorkingMode& mode : modes_of(model, map))
      LinesOfMode(model, map, spec, mode, traced).run(report, spec.listed_disputes);
  });
  return report;
}

}  // namespace clearloci::numeric
