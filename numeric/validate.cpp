#include "numeric/validate.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/errors.hpp"
#include "numeric/arc_witness.hpp"
#include "numeric/checked_reaction.hpp"
#include "numeric/edge_judge.hpp"
#include "numeric/grid_passages.hpp"
#include "numeric/reactions.hpp"
#include "numeric/turns.hpp"
#include "numeric/validate_lines.hpp"
#include "numeric/validation_grid.hpp"

namespace clearloci::numeric {

namespace {

using core::LocusCurve;
using core::LocusKind;
using core::LocusMap;
using core::WorkingMode;

/// A force's direction that turns by more than a right angle within this fraction of the box has flipped.
constexpr double flip_resolution = 1e-10;

constexpr int zero_samples = 64;  ///< nodes on which a numerator must vanish before all nodes are asked

struct LineTally {
  std::vector<std::array<std::size_t, 4>> counts;  ///< by reaction and Outcome
  std::vector<DisputedEdge> disputed;
};

/// Everything about one working mode of the map.
class ModeValidation {
 public:
  ModeValidation(const NumericModel& model, const LocusMap& map, const Grid& grid, const WorkingMode& mode,
                 const std::vector<TracedReaction>& traced, double reach, double diagonal)
      : model_(model),
        map_(map),
        grid_(grid),
        mode_(mode),
        signs_(dyad_signs(model, map.tower, mode)),
        reach_(reach),
        diagonal_(diagonal) {
    smallest_ = flip_resolution * diagonal;
    turning_ = joints_of_turns(model, map, mode, traced);
    // Where |A| vanishes the force across a pin's axis flips as its components do: no edge tells these from zeros.
    for (const auto& reaction : traced)
      if (CheckedReaction checked = checked_reaction(model, reaction); checked.columns.pin < 0)
        reactions_.push_back(std::move(checked));
    for (const core::OpenRegion& region : map.open)
      if (region.mode == mode && !region.point) open_.push_back({&region, {}});
    for (Open& open : open_)
      for (const CheckedReaction& r : reactions_)
        open.concerns.push_back(open.region->kind == LocusKind::workspace_boundary ||
                                times_vanishing(open.region->kind, open.region->vanishing, r) != 0);
    for (const auto& curve : map.curves) {
      const bool here = curve.mode == mode;
      boundary_.push_back(here && curve.kind == LocusKind::workspace_boundary ? 1 : 0);
      for (auto& r : reactions_) r.weights.push_back(here ? times_vanishing(curve.kind, curve.vanishing, r) : 0);
    }
    std::vector<int> numbers;
    for (std::size_t c = 0; c < map.curves.size(); ++c) {
      const bool matters = std::any_of(reactions_.begin(), reactions_.end(),
                                       [&](const CheckedReaction& r) { return r.weights[c] != 0; });
      if (matters || boundary_[c] != 0) numbers.push_back(static_cast<int>(c));
    }
    passages_ = find_passages(grid, map.curves, numbers, reach);
  }

  void run(ValidationReport& report, std::size_t listed) {
    evaluate_nodes();
    find_zeros();
    const int rows = grid_.y.nodes, lines = rows + grid_.x.nodes;
    std::vector<LineTally> tallies(static_cast<std::size_t>(lines));
    tbb::parallel_for(0, lines, [&](int line) {
      tallies[static_cast<std::size_t>(line)] = line < rows ? judge_line(true, line) : judge_line(false, line - rows);
    });
    merge(tallies, report, listed);
    judge_arcs(report);
    judge_turns(model_, signs_, map_, mode_, std::array{grid_.x, grid_.y}, turning_, listed, report);
  }

 private:
  void evaluate_nodes() {
    fields_.resize(static_cast<std::size_t>(grid_.y.nodes));
    tbb::parallel_for(0, grid_.y.nodes, [&](int j) {
      std::vector<double> poses;
      for (int i = 0; i < grid_.x.nodes; ++i) poses.insert(poses.end(), {grid_.x.at(i), grid_.y.at(j)});
      reaction_field(model_, poses, signs_, fields_[static_cast<std::size_t>(j)]);
    });
  }

  bool node_reachable(int i, int j) const {
    return fields_[static_cast<std::size_t>(j)].reachable(static_cast<std::size_t>(i));
  }
  /// A row of nodes.
  const ReactionField& field_of(int j) const { return fields_[at(j)]; }
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }

  /// Reactions that are nonzero beyond rounding at no node.
  void find_zeros() {
    std::vector<std::array<int, 2>> nodes;
    for (int j = 0; j < grid_.y.nodes; ++j) {
      for (int i = 0; i < grid_.x.nodes; ++i) {
        if (node_reachable(i, j)) nodes.push_back({i, j});
      }
    }
    zero_ = std::vector<std::atomic<bool>>(reactions_.size());
    for (auto& z : zero_) z = !nodes.empty();
    const auto ask = [&](const std::array<int, 2>& node) {
      const auto n = bounded_numerators(model_, std::array{grid_.x.at(node[0]), grid_.y.at(node[1])}, signs_);
      for (std::size_t r = 0; r < reactions_.size(); ++r) {
        if (zero_[r] && is_decided(n, reactions_[r].columns)) zero_[r] = false;
      }
    };
    const auto none_left = [&] {
      return std::none_of(zero_.begin(), zero_.end(), [](const auto& z) { return z.load(); });
    };
    for (std::size_t k = 0; k < nodes.size() && !none_left();
         k += std::max<std::size_t>(1, nodes.size() / zero_samples)) {
      ask(nodes[k]);
    }
    if (none_left()) return;
    tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t k) { ask(nodes[k]); });
  }

  LineTally judge_line(bool row, int line) const {
    const GridAxis& along = row ? grid_.x : grid_.y;
    const auto& passages = (row ? passages_.rows : passages_.columns)[static_cast<std::size_t>(line)];
    const LineWitness place(model_, signs_, {grid_.x.at(row ? 0 : line), grid_.y.at(row ? line : 0)}, row ? 0 : 1,
                            smallest_);
    EdgeJudge judge(place, along, passages, boundary_, reach_);
    LineTally tally;
    tally.counts.resize(reactions_.size());
    for (int edge = 0; edge + 1 < along.nodes; ++edge) {
      for (std::size_t r = 0; r < reactions_.size(); ++r) {
        if (zero_[r]) continue;
        const auto& checked = reactions_[r];
        const EdgeNodes nodes =
            row ? edge_nodes(field_of(line), at(edge), field_of(line), at(edge + 1), checked.columns)
                : edge_nodes(field_of(edge), at(line), field_of(edge + 1), at(line), checked.columns);
        Finding finding = judge.judge(edge, {checked.columns, checked.weights}, nodes);
        if (finding.outcome == Outcome::disputed &&
            is_open(r, place.point(along.at(edge)), place.point(along.at(edge + 1))))
          finding.outcome = Outcome::undecided;
        ++tally.counts[r][static_cast<std::size_t>(finding.outcome)];
        if (finding.outcome != Outcome::disputed) continue;
        tally.disputed.push_back({place.point(along.at(edge)), place.point(along.at(edge + 1)), mode_, checked.reaction,
                                  finding.crossings, finding.sign_change});
      }
    }
    return tally;
  }

  /// Where a locus of the reaction is open nothing is claimed.
  bool is_open(std::size_t reaction, const std::vector<double>& from, const std::vector<double>& to) const {
    return std::any_of(open_.begin(), open_.end(), [&](const Open& open) {
      if (!open.concerns[reaction]) return false;
      for (std::size_t c = 0; c < 2; ++c)
        if (std::max(from[c], to[c]) < open.region->lower[c] - reach_ ||
            std::min(from[c], to[c]) > open.region->upper[c] + reach_)
          return false;
      return true;
    });
  }

  void merge(const std::vector<LineTally>& lines, ValidationReport& report, std::size_t listed) const {
    for (std::size_t r = 0; r < reactions_.size(); ++r) {
      std::array<std::size_t, 4> sum{};
      for (const auto& line : lines) {
        for (std::size_t v = 0; v < sum.size(); ++v) sum[v] += line.counts[r][v];
      }
      add_tally(report, mode_, reactions_[r].reaction, sum, zero_[r]);
    }
    for (const auto& line : lines) {
      for (const auto& edge : line.disputed) {
        if (report.disputed_edges.size() < listed) report.disputed_edges.push_back(edge);
      }
    }
  }

  /// What the reactions do beside every arc, against what the map says of them there.
  void judge_arcs(ValidationReport& report) const {
    for (std::size_t c = 0; c < map_.curves.size(); ++c) {
      const LocusCurve& curve = map_.curves[c];
      if (curve.mode != mode_ || !tells_zeros(curve.kind)) continue;
      for (const core::Arc& arc : curve.arcs) {
        const std::vector<Approach> ways = approaches(model_, signs_, curve, arc, diagonal_);
        const bool context = curve.kind == LocusKind::direct_singularity || curve.kind == LocusKind::workspace_boundary;
        for (std::size_t r = 0; r < reactions_.size(); ++r)
          if (!zero_[r]) judge_arc(c, ways, r, context, report);
        if (curve.kind == LocusKind::direct_singularity && !curve.excited) judge_idle(c, ways, report);
      }
    }
  }

  /// A claim is disputed where most of the ways say otherwise: some may end near a zero of another curve.
  void judge_arc(std::size_t c, const std::vector<Approach>& ways, std::size_t reaction, bool context,
                 ValidationReport& report) const {
    const CheckedReaction& checked = reactions_[reaction];
    const bool claimed = checked.weights[c] != 0;
    if (ways.empty() && claimed) ++report.arcs_undecided;
    if (ways.empty() || (!claimed && !context)) return;
    const TendencyTally tally = tally_of(ways, checked.columns);
    const auto most = [&](std::size_t count) { return 2 * count > ways.size(); };
    const auto dispute = [&](const core::Point2& at) {
      if (is_open(reaction, pose_of(at), pose_of(at))) {
        if (claimed) ++report.arcs_undecided;
        return;
      }
      ++report.disputed;
      report.disputed_arcs.push_back({map_.curves[c].id, pose_of(at), mode_, checked.reaction, claimed, false});
    };
    // Other curves, or a boundary beyond that of the workspace, may be nearer than the ways' ends; and where a reaction
    // is small along the arc it may seem to vanish towards it from farther away.
    const auto tally_nearer = [&] {
      std::vector<Approach> nearer;
      for (const Approach& way : ways)
        if (auto one = brought_nearer(model_, signs_, way)) nearer.push_back(std::move(*one));
      return tally_of(nearer, checked.columns);
    };
    if (claimed && most(tally.other)) {
      // Vertices may be off their curve by the map's tolerance.
      const auto stands_for_a_zero = [&](const Approach& way) {
        return turns_round(model_, signs_, way, checked.columns, reach_);
      };
      if (most(tally_nearer().other) && !std::all_of(ways.begin(), ways.end(), stands_for_a_zero))
        return dispute(ways.front().towards);
      ++report.arcs_undecided;
    } else if (claimed) {
      ++(most(tally.zero) ? report.arcs_held : report.arcs_undecided);
    }
    if (claimed || !most(tally.zero) || !most(tally_nearer().zero)) return;
    // Another curve of the map may run along here and say so.
    const core::Point2& at = ways.front().towards;
    for (std::size_t k = 0; k < map_.curves.size(); ++k)
      if (checked.weights[k] != 0 && passes_near(map_.curves[k], at, 2 * reach_)) return;
    dispute(at);
  }

  /// A direct singularity at which the map has every reaction stay finite.
  void judge_idle(std::size_t c, const std::vector<Approach>& ways, ValidationReport& report) const {
    for (std::size_t k = 0; k < model_.unknowns.size(); ++k) {
      const TendencyTally tally = tally_of(ways, {static_cast<int>(k)});
      if (2 * tally.unbounded <= ways.size()) continue;
      const mechanism::Unknown& unknown = model_.unknowns[k];
      const std::string& joint = model_.mechanism.joints[static_cast<std::size_t>(unknown.joint)].name;
      ++report.disputed;
      report.disputed_arcs.push_back(
          {map_.curves[c].id, pose_of(ways.front().towards), mode_, {joint, unknown.quantity}, true, true});
    }
  }

  static std::vector<double> pose_of(const core::Point2& at) { return {at[0], at[1]}; }

  static bool passes_near(const LocusCurve& curve, const core::Point2& at, double reach) {
    for (const core::Arc& arc : curve.arcs)
      for (std::size_t i = 1; i < arc.points.size(); ++i) {
        const core::Point2 &a = arc.points[i - 1], &b = arc.points[i];
        const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
        const double t =
            length2 > 0 ? std::clamp(((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0.0;
        if (std::hypot(a[0] + t * dx - at[0], a[1] + t * dy - at[1]) <= reach) return true;
      }
    return false;
  }

  const NumericModel& model_;
  const LocusMap& map_;
  Grid grid_;
  WorkingMode mode_;
  std::vector<int> signs_;
  double reach_, diagonal_;
  double smallest_ = 0;
  std::vector<std::string> turning_;  ///< joints of joints_of_turns
  std::vector<CheckedReaction> reactions_;
  struct Open {
    const core::OpenRegion* region;
    std::vector<bool> concerns;  ///< by reaction
  };
  std::vector<Open> open_;
  std::vector<int> boundary_;
  GridPassages passages_;
  std::vector<ReactionField> fields_;  ///< a row of nodes each
  std::vector<std::atomic<bool>> zero_;
};

void check_call(const NumericModel& model, const LocusMap& map, const GridSpec& spec) {
  const auto refuse = [](const std::string& problem, const std::string& mend) {
    throw core::InputError({}, problem, mend);
  };
  const std::size_t n = model.box.size();
  const std::array<int, 3> nodes = {spec.nx, spec.ny, spec.nz};
  for (std::size_t c = 0; c < std::min<std::size_t>(n, 3); ++c)
    if (nodes[c] < 2) refuse("the grid has no cells", "ask for two nodes at least along each coordinate");
  if (n < 1 || n > 3 || map.lower.size() != n || map.upper.size() != n)
    refuse("the loci are not those of the mechanism's coordinates", "validate takes one to three free coordinates");
  if (map.tower.coordinates.empty()) return;
  for (std::size_t c = 0; c < n; ++c) {
    if (map.tower.coordinates.at(c) != model.mechanism.coordinates[c].name) {
      refuse("the loci have other coordinates than the mechanism", "trace the loci of the same mechanism");
    }
  }
}

}  // namespace

std::vector<TracedReaction> named_reactions(const LocusMap& map) {
  std::vector<TracedReaction> named;
  const auto add = [&](const auto& loci) {
    for (const auto& locus : loci) {
      if (!tells_zeros(locus.kind)) continue;
      for (const auto& v : locus.vanishing) {
        const TracedReaction reaction{v.joint, v.quantity};
        if (std::find(named.begin(), named.end(), reaction) == named.end()) named.push_back(reaction);
      }
    }
  };
  add(map.curves);
  add(map.surfaces);
  if (map.tower.coordinates.size() == 1) add(map.isolated_points);
  return named;
}

ValidationReport validate(const mechanism::Mechanism& mechanism, const LocusMap& map, const GridSpec& spec,
                          const std::vector<TracedReaction>& traced) {
  const NumericModel model = compile(mechanism);
  check_call(model, map, spec);
  if (model.box.size() != 2) return validate_lines(model, map, spec, traced.empty() ? named_reactions(map) : traced);
  const ValidationGrid grid = validation_grid(map, spec);
  ValidationReport report;
  tbb::task_arena arena(spec.threads > 0 ? spec.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    for (const auto& mode : modes_in(map)) {
      ModeValidation(model, map, grid.grid, mode, traced.empty() ? named_reactions(map) : traced, grid.reach,
                     grid.diagonal)
          .run(report, spec.listed_disputes);
    }
  });
  return report;
}

}  // namespace clearloci::numeric
