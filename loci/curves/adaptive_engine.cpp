#include "loci/curves/adaptive_engine.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/errors.hpp"
#include "loci/curves/arc_check.hpp"
#include "loci/curves/edge_labels.hpp"
#include "loci/curves/exact_engine.hpp"
#include "loci/curves/sheet_loci.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusCurve;
using core::LocusFactor;
using core::LocusMap;
using core::LocusProblem;

/// Beyond this degree, as degree_of counts it, the exact arrangement does not end in useful time
/// (docs/background/performance.md).
constexpr int bearable_degree = 14;

/// Cells worth their time before the exact engine takes a curve over: it takes about as long as so many times the
/// fourth power of the degree, a tenth of a second for degree 8 and a second for degree 14.
constexpr int cells_a_fourth_power = 8, fewest_cells = 20000, most_cells = 150000;

const LocusFactor& factor_of(const LocusProblem& problem, const SheetShare& share) {
  return problem.factors[static_cast<std::size_t>(share.factor)];
}

/// How many crossings two curves have at most, by their degrees in both coordinates together or in each: over half
/// tangents of angles the latter are fewer.
double most_crossings(const core::Polynomial& p, const core::Polynomial& q) {
  const double together = static_cast<double>(core::total_degree(p)) * core::total_degree(q);
  const double apart = static_cast<double>(core::degree_in(p, 0)) * core::degree_in(q, 1) +
                       static_cast<double>(core::degree_in(p, 1)) * core::degree_in(q, 0);
  return std::min(together, apart);
}

/// The degree of a curve that is as heavy: that which has as many crossings with another one of its kind.
int degree_of(const core::Polynomial& p) { return static_cast<int>(std::ceil(std::sqrt(most_crossings(p, p)))); }

int highest_degree(const LocusFactor& factor) {
  int degree = -1;
  for (const core::Polynomial& p : factor.implicit) degree = std::max(degree, degree_of(p));
  return degree;
}

bool is_too_heavy(const LocusFactor& factor) {
  return highest_degree(factor) > bearable_degree || factor.implicit_too_heavy;
}

bool is_context(const LocusFactor& factor) {
  return factor.role == FactorRole::direct_singularity || factor.role == FactorRole::workspace_boundary ||
         factor.role == FactorRole::construction;
}

core::LocusKind kind_of(FactorRole role, core::LocusKind reaction) {
  switch (role) {
    case FactorRole::margin:
      return core::LocusKind::margin;
    case FactorRole::preload:
      return core::LocusKind::preload;
    case FactorRole::direct_singularity:
      return core::LocusKind::direct_singularity;
    case FactorRole::workspace_boundary:
      return core::LocusKind::workspace_boundary;
    default:
      return std::min(reaction, core::LocusKind::component);
  }
}

/// The curves of the exact engine that uncertified shares stand for.
IsWanted replacing(const LocusProblem& problem, const std::vector<SheetShare*>& shares) {
  struct Replaced {
    core::WorkingMode mode;
    FactorRole role;
    std::vector<core::Polynomial> implicit;
  };
  std::vector<Replaced> all;
  for (const SheetShare* share : shares) {
    const LocusFactor& factor = factor_of(problem, *share);
    all.push_back({problem.modes[static_cast<std::size_t>(share->mode)], factor.role, factor.implicit});
  }
  return [all = std::move(all)](const LocusCurve& curve) {
    return std::any_of(all.begin(), all.end(), [&](const Replaced& replaced) {
      return curve.mode == replaced.mode && curve.kind == kind_of(replaced.role, curve.kind) &&
             std::find(replaced.implicit.begin(), replaced.implicit.end(), curve.implicit) != replaced.implicit.end();
    });
  };
}

/// Shares that the adaptive engine left open, and those that have a curve in common with them, unless all that would
/// have to be told together is beyond the exact engine.
std::vector<SheetShare*> bearable_open(const LocusProblem& problem, std::vector<SheetShare>& shares) {
  std::vector<SheetShare*> open;
  for (SheetShare& share : shares) {
    const bool is_open = std::any_of(shares.begin(), shares.end(), [&](const SheetShare& other) {
      return other.mode == share.mode && !other.traced.certified &&
             factor_of(problem, other).role == factor_of(problem, share).role &&
             shares_curve(factor_of(problem, other), factor_of(problem, share));
    });
    if (is_open) open.push_back(&share);
  }
  // A curve beyond the engine's reach stays open, and so does what would have to be told together with it.
  for (bool left = true; left;) {
    left = false;
    for (const SheetShare* heavy : open) {
      const LocusFactor& factor = factor_of(problem, *heavy);
      if (!is_too_heavy(factor)) continue;
      std::erase_if(open, [&](const SheetShare* share) {
        return share->mode == heavy->mode && (share == heavy || shares_curve(factor_of(problem, *share), factor));
      });
      left = true;
      break;
    }
  }
  return open;
}

/// About what the crossings of two factors' curves take.
double cost_of_crossings(const LocusFactor& a, const LocusFactor& b) {
  double cost = 0;
  for (const core::Polynomial& p : a.implicit)
    for (const core::Polynomial& q : b.implicit) {
      const double number = most_crossings(p, q);
      cost += number * number;
    }
  return cost;
}

using Group = std::vector<SheetShare*>;

/// Shares that have a curve in common go together, for all modes.
std::vector<Group> connected(const LocusProblem& problem, const Group& open) {
  const auto has_common = [&](const Group& group, const SheetShare* share) {
    return std::any_of(group.begin(), group.end(), [&](const SheetShare* other) {
      return other->factor == share->factor || shares_curve(factor_of(problem, *other), factor_of(problem, *share));
    });
  };
  std::vector<Group> groups;
  for (SheetShare* share : open) {
    Group exact_group = {share};
    for (Group& group : groups)
      if (has_common(group, share)) {
        exact_group.insert(exact_group.end(), group.begin(), group.end());
        group.clear();
      }
    std::erase_if(groups, [](const Group& group) { return group.empty(); });
    groups.push_back(std::move(exact_group));
  }
  return groups;
}

/// What goes into one arrangement. Crossings of groups with each other are not asked for; two go together where these
/// take no longer than those of boundaries and singularities, which every arrangement has.
std::vector<Group> arrangements_of(const LocusProblem& problem, const Group& open) {
  double context = 0;
  for (const LocusFactor& a : problem.factors)
    for (const LocusFactor& b : problem.factors)
      if (is_context(a) && is_context(b)) context += cost_of_crossings(a, b);
  const auto cost = [&](const Group& a, const Group& b) {
    double sum = 0;
    for (const SheetShare* one : a)
      for (const SheetShare* other : b) {
        const LocusFactor& factor = factor_of(problem, *one);
        if (!is_context(factor)) sum += cost_of_crossings(factor, factor_of(problem, *other));
      }
    return sum;
  };
  std::vector<Group> arrangements;
  for (Group& group : connected(problem, open)) {
    const auto other = std::find_if(arrangements.begin(), arrangements.end(),
                                    [&](const Group& arrangement) { return cost(group, arrangement) <= context; });
    if (other == arrangements.end())
      arrangements.push_back(std::move(group));
    else
      other->insert(other->end(), group.begin(), group.end());
  }
  return arrangements;
}

/// The problem of these shares alone; none: what comes with them is beyond the exact engine.
std::optional<LocusProblem> problem_of(const LocusProblem& problem, const Group& open) {
  LocusProblem rest = problem;
  rest.factors.clear();
  rest.modes.clear();
  for (std::size_t f = 0; f < problem.factors.size(); ++f) {
    const bool is_open = std::any_of(open.begin(), open.end(),
                                     [&](const SheetShare* share) { return share->factor == static_cast<int>(f); });
    if (!is_open && !is_context(problem.factors[f])) {
      // Its curves are settled, or in another arrangement; its orders along those that are not may still count.
      if (problem.factors[f].role != FactorRole::reaction) continue;
      rest.factors.push_back(problem.factors[f]);
      rest.factors.back().implicit.clear();
      rest.factors.back().implicit_too_heavy = false;
      continue;
    }
    if (is_too_heavy(problem.factors[f])) return std::nullopt;
    rest.factors.push_back(problem.factors[f]);
  }
  for (const SheetShare* share : open) {
    const core::WorkingMode& mode = problem.modes[static_cast<std::size_t>(share->mode)];
    if (std::find(rest.modes.begin(), rest.modes.end(), mode) == rest.modes.end()) rest.modes.push_back(mode);
  }
  return rest;
}

/// Points of the boundaries and singularities, and what is said of them, come with every arrangement.
void take_points_and_notes(LocusMap& exact, LocusMap& map) {
  for (core::IsolatedPoint& point : exact.isolated_points) {
    const bool is_present = std::any_of(
        map.isolated_points.begin(), map.isolated_points.end(), [&](const core::IsolatedPoint& isolated_point) {
          return isolated_point.mode == point.mode && isolated_point.kind == point.kind &&
                 isolated_point.vanishing == point.vanishing && isolated_point.at == point.at;
        });
    if (!is_present) map.isolated_points.push_back(std::move(point));
  }
  for (std::string& note : exact.notes)
    if (std::find(map.notes.begin(), map.notes.end(), note) == map.notes.end()) map.notes.push_back(std::move(note));
}

/// Whether a root is built on an angle, of which the exact engine's algebra knows nothing. Factors with an angle have
/// no polynomials, and are beyond its reach anyway.
bool stands_on_angle(const core::RootTower& tower) {
  for (std::size_t j = 0; j < tower.roots.size(); ++j)
    for (const core::Root& root : tower.roots)
      if (tower.roots[j].is_angle() && core::depends_on(root.square, 2 + static_cast<int>(j))) return true;
  return false;
}

/// The exact engine on what the adaptive one left open. Marks the shares that it settled.
void settle_exactly(const LocusProblem& problem, const TraceOptions& options, std::vector<SheetShare>& shares,
                    LocusMap& map) {
  if (stands_on_angle(problem.tower)) return;
  for (const Group& open : arrangements_of(problem, bearable_open(problem, shares))) {
    if (options.deadline && std::chrono::steady_clock::now() > *options.deadline)
      throw core::LimitReached("the time limit was reached");
    const std::optional<LocusProblem> locus_problem = problem_of(problem, open);
    if (!locus_problem) return;
    LocusMap exact = trace_exactly(*locus_problem, options, replacing(problem, open));
    if (exact.out_of_time) throw core::LimitReached("the time limit was reached");
    for (LocusCurve& curve : exact.curves) map.curves.push_back(std::move(curve));
    for (core::OpenRegion& region : exact.open) map.open.push_back(std::move(region));
    take_points_and_notes(exact, map);
    for (SheetShare* share : open) share->settled = true;
  }
}

/// By factor: the cells after which it is left to the exact engine, where that will surely settle it; 0 where it may
/// not.
std::vector<int> cells_before_exact(const LocusProblem& problem, const TraceOptions& options) {
  std::vector<int> cells(problem.factors.size(), 0);
  const bool is_asked = options.engine == Engine::adaptive_then_exact && !options.sketch && !options.deadline &&
                        options.certificate == nullptr && !core::has_angles(problem.tower);
  int degree_of_context = 0;
  for (const LocusFactor& factor : problem.factors) {
    if (!is_asked || (is_context(factor) && is_too_heavy(factor))) return cells;
    if (is_context(factor)) degree_of_context = std::max(degree_of_context, highest_degree(factor));
  }
  for (std::size_t f = 0; f < cells.size(); ++f) {
    int degree = degree_of_context;
    bool is_settled = true;
    for (const LocusFactor& factor : problem.factors) {
      if (&factor != &problem.factors[f] && !shares_curve(factor, problem.factors[f])) continue;
      is_settled = is_settled && !is_too_heavy(factor);
      degree = std::max(degree, highest_degree(factor));
    }
    if (is_settled)
      cells[f] = std::clamp(cells_a_fourth_power * degree * degree * degree * degree, fewest_cells, most_cells);
  }
  return cells;
}

/// Hands out the claims of shares that were proven on the sheets.
void certify(const LocusProblem& problem, const std::vector<SheetShare>& shares, core::Certificate& certificate) {
  for (const SheetShare& share : shares) {
    const LocusFactor& factor = factor_of(problem, share);
    if (share.settled || !share.traced.certified || share.traced.stopped) continue;
    for (core::SheetClaim claim : share.traced.claims) {
      claim.mode = share.mode;
      claim.role = factor.role;
      claim.name = factor.expression;
      certificate.sheets.push_back(std::move(claim));
    }
    std::erase_if(certificate.open,
                  [&](const core::OpenClaim& open) { return open.mode == share.mode && open.factor == share.factor; });
  }
}

/// Curves, points and notes of the shares, those that are open from the exact engine.
LocusMap gathered(const LocusProblem& problem, const TraceOptions& options, const CurveAlgebras& algebras,
                  std::vector<SheetShare>& shares) {
  LocusMap map;
  for (SheetShare& share : shares) share.settled = false;
  try {
    if (options.engine != Engine::adaptive && !options.sketch) settle_exactly(problem, options, shares, map);
  } catch (const core::LimitReached&) {
    map.out_of_time = true;  // what is open stays so
  }
  add_sheet_loci(problem, shares, algebras, map);
  return map;
}

/// Marks the shares that wrong arcs are of as open. False: there are none that were taken for certified.
bool reopen(const LocusProblem& problem, const std::vector<WrongArc>& wrong, const LocusMap& map,
            std::vector<SheetShare>& shares) {
  bool any = false;
  for (const WrongArc& arc : wrong)
    for (SheetShare& share : shares) {
      const LocusCurve& curve = map.curves[arc.curve];
      if (!share.traced.certified || curve.mode != problem.modes[static_cast<std::size_t>(share.mode)] ||
          !owns(factor_of(problem, share), curve))
        continue;
      const core::Point2& at = arc.fault.at;
      share.traced.certified = false;
      share.traced.undecided.push_back({at[0], at[0], at[1], at[1]});
      any = true;
    }
  return any;
}

}  // namespace

Found find_adaptively(const LocusProblem& problem, const TraceOptions& options) {
  const std::shared_ptr<const CurveAlgebras> algebras = curve_algebras(problem, options);
  std::vector<SheetShare> shares = trace_on_sheets(problem, options, *algebras, cells_before_exact(problem, options));
  if (options.certificate != nullptr) {
    *options.certificate = {};
    options.certificate->problem = problem;
    for (const SheetShare& share : shares) options.certificate->open.push_back({share.mode, share.factor});
  }
  LocusMap map = gathered(problem, options, *algebras, shares);
  bool withheld = false;
  // The last check. What fails it is traced again by the exact engine; what fails it then is not handed out.
  if (const std::vector<WrongArc> wrong = wrong_arcs(problem, map); !wrong.empty()) {
    if (reopen(problem, wrong, map, shares)) map = gathered(problem, options, *algebras, shares);
    withheld = withhold_wrong_arcs(problem, map);
  }
  if (options.certificate != nullptr) certify(problem, shares, *options.certificate);
  return {.map = std::move(map), .withheld = withheld, .leaves_workspace = true};
}

}  // namespace clearloci::loci
