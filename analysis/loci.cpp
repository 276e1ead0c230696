#include "analysis/loci.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "analysis/carried.hpp"
#include "analysis/flanks.hpp"
#include "analysis/framed.hpp"
#include "analysis/loci_by_cells.hpp"
#include "analysis/model.hpp"
#include "analysis/pose.hpp"
#include "analysis/request_limits.hpp"
#include "clearloci/work_limit.hpp"
#include "core/errors.hpp"
#include "core/fold.hpp"
#include "core/shown_units.hpp"
#include "core/straight_line.hpp"
#include "loci/curves/curves.hpp"
#include "loci/surfaces/surfaces.hpp"
#include "mechanism/frame.hpp"
#include "mechanism/group_closing.hpp"
#include "mechanism/notes.hpp"
#include "mechanism/written_unit.hpp"
#include "numeric/sketch.hpp"

namespace clearloci {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Every combination in the order of core::all_working_modes: the last side changes fastest.
std::vector<DyadSides> sides_to_trace(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  const DyadSides mode = mechanism::working_mode(mechanism);
  if (!request.all_working_modes)
    return request.working_modes.empty() ? std::vector<DyadSides>{mode} : request.working_modes;
  std::vector<DyadSides> all;
  for (std::size_t count = 0; count < std::size_t{1} << mode.size(); ++count) {
    all.push_back(mode);
    for (std::size_t j = 0; j < mode.size(); ++j)
      if ((count >> j & 1) != 0) all.back()[mode.size() - 1 - j] *= -1;
  }
  return all;
}

/// Two to the power of the dyads are soon more than anyone looks at, and than there is memory for.
void check_mode_count(std::size_t dyads) {
  constexpr std::size_t most = 12;
  if (dyads > most)
    throw core::InputError(
        {.file = "--working-mode"},
        "all working modes of " + std::to_string(dyads) + " dyads are more than " + std::to_string(1U << most),
        "name one at a time");
}

/// Surfaces of one choice of sheets in every piece of the coordinates' ranges: the sheets of a piece need not be those
/// of another one, but together they are all.
core::LocusMap trace_surfaces(const LociRequest& request, const std::vector<symbolic::DerivedProblem>& derived,
                              const loci::TraceOptions& options) {
  std::vector<std::vector<const core::LocusProblem*>> sheets;  // one a piece each
  for (const symbolic::DerivedProblem& problem : derived) {
    std::size_t group = 0;
    while (group < sheets.size() && sheets[group].size() > static_cast<std::size_t>(problem.piece)) ++group;
    if (group == sheets.size()) sheets.emplace_back();
    sheets[group].push_back(&problem.problem);
  }
  std::optional<core::LocusMap> joined;
  for (const auto& charts : sheets) {
    core::LocusMap map = loci::trace_surfaces(charts, {.trace = options, .mesh_size = request.mesh_size});
    if (sheets.size() > 1) loci::drop_own_roots(map);
    if (!joined)
      joined = std::move(map);
    else
      loci::append_sheets(*joined, std::move(map));
  }
  int number = 0;
  for (core::LocusSurface& surface : joined->surfaces) surface.id = "s" + std::to_string(++number);
  number = 0;
  for (core::SpaceCurve& curve : joined->space_curves) curve.id = "c" + std::to_string(++number);
  return std::move(*joined);
}

/// Whether no pose keeps a limit: what is left to it is a negative number wherever points are placed.
bool all_are_beyond(const std::vector<symbolic::DerivedProblem>& derived) {
  return std::all_of(derived.begin(), derived.end(), [](const symbolic::DerivedProblem& one) {
    const std::vector<core::Root>& roots = one.problem.tower.roots;
    return std::any_of(roots.begin(), roots.end(), [](const core::Root& root) {
      const core::Polynomial& square = root.square;
      return square.is_constant() && !square.is_zero() && sgn(square.terms.front().coefficient) < 0;
    });
  });
}

/// Of the pieces and sheets of one mechanism together. `parts`: those of a single piece, where there are several.
core::LocusMap trace_pieces(const mechanism::Mechanism& mechanism, const LociRequest& request,
                            std::vector<symbolic::DerivedProblem>& derived, const std::vector<DyadSides>& sides,
                            std::vector<TracedSheet>& parts, const TraceMeans& means, TraceEffort effort) {
  // Sheets and modes of one mechanism have the curves in common that do not depend on the points placed otherwise.
  loci::sheet::KnownSearches of_all_sheets;
  const bool has_several = derived.size() > 1 || sides.size() > 1;
  loci::sheet::KnownSearches* const searches =
      means.searches == nullptr && has_several ? &of_all_sheets : means.searches;
  const loci::TraceOptions options{.engine = request.engine,
                                   .progress = request.progress,
                                   .deadline = request.deadline,
                                   .sketch = effort == TraceEffort::sketch,
                                   .certificate = means.certificate,
                                   .searches = searches};
  if (options.certificate != nullptr && all_are_beyond(derived))
    throw core::InputError({mechanism.file}, words_of_no_pose(mechanism), "leave --certificate out");
  if (options.certificate != nullptr)
    for (const core::Root& root : derived.front().problem.tower.roots)
      if (root.square.is_constant() || root.name == core::fold_name)
        throw core::InputError({mechanism.file}, "the square roots that give the points depend on one another",
                               "such a mechanism has no certificate: leave --certificate out");
  std::vector<core::WorkingMode> modes;
  for (const DyadSides& dyad_sides : sides)
    modes.push_back(mode_of(dyad_sides, names_of(derived.front().problem.tower)));
  if (mechanism.coordinates.size() == 3) {
    core::LocusMap map = trace_surfaces(request, derived, options);
    name_coordinates(mechanism, map);
    return map;
  }
  std::vector<core::LocusMap> maps;
  std::vector<const core::LocusProblem*> problems;
  for (const symbolic::DerivedProblem& one : derived) {
    if (request.deadline && Clock::now() >= *request.deadline) throw core::LimitReached("the time limit was reached");
    maps.push_back(loci::trace(one.problem, options));
    problems.push_back(&one.problem);
  }
  const bool sheets = std::any_of(derived.begin(), derived.end(),
                                  [&](const auto& one) { return &one != &derived.front() && one.piece == 0; });
  const bool lengths = mechanism.coordinates.size() == 2 && problems.front()->charts.empty();
  if (lengths && sheets)
    for (std::size_t i = 0; i < maps.size(); ++i) parts.push_back({derived[i].problem, maps[i]});
  if (lengths) return loci::join_sheets(problems, std::move(maps), modes);
  core::LocusMap map = loci::join_charts(problems, std::move(maps), std::move(modes), request.tolerance);
  name_coordinates(mechanism, map);
  return map;
}

/// Of those over the tower, which have no curve in any mode: one cell each, free of zeros, or open where a zero may be
/// at points; whoever checks it cuts it as far as it takes.
void claim_no_curves(const std::vector<core::LocusFactor>& factors, core::Certificate& certificate) {
  const core::LocusProblem& problem = certificate.problem;
  std::array<double, 4> domain{};
  for (std::size_t i = 0; i < 2; ++i) {
    const core::Rational margin = (problem.upper[i] - problem.lower[i]) / 1000;
    domain[2 * i] = core::to_double(problem.lower[i] - margin);
    domain[2 * i + 1] = core::to_double(problem.upper[i] + margin);
  }
  for (const core::LocusFactor& factor : factors) {
    if (factor.sheet.terms.empty()) continue;
    const auto kind = factor.implicit.empty() ? core::CellNode::Kind::free : core::CellNode::Kind::open;
    core::StraightLineBuilder builder;
    std::vector<int> variables;
    for (int v = 0; v < factor.sheet.variables; ++v) variables.push_back(builder.variable(v));
    const core::StraightLine line = builder.line(builder.polynomial(factor.sheet, variables));
    for (int mode = 0; mode < static_cast<int>(problem.modes.size()); ++mode)
      certificate.sheets.push_back({mode, factor.role, factor.expression, line, {}, domain, {{kind, 0, 0, 0}}});
  }
}

/// Expressions in the coordinates of the file, in place of those that the frame's have.
class FileTexts {
 public:
  explicit FileTexts(const std::vector<symbolic::DerivedProblem>& derived) {
    for (const symbolic::DerivedProblem& one : derived) texts_.insert(one.in_file.begin(), one.in_file.end());
  }

  void write(TracedProblem& traced) const {
    if (texts_.empty()) return;
    write(traced.problem, traced.map);
    for (TracedSheet& sheet : traced.sheets) write(sheet.problem, sheet.map);
  }

 private:
  void write(core::LocusProblem& problem, core::LocusMap& map) const {
    for (core::LocusFactor& factor : problem.factors) write(factor.expression);
    for (core::LocusCurve& curve : map.curves) write(curve.factor);
    for (core::LocusSurface& surface : map.surfaces) write(surface.factor);
    for (core::SpaceCurve& curve : map.space_curves) write(curve.factor);
    for (core::IsolatedPoint& point : map.isolated_points) write(point.factor);
    for (core::OpenRegion& region : map.open) write(region.factor);
    for (std::string& note : map.notes)
      for (const auto& [inside, outside] : texts_)
        if (const std::size_t at = note.find("where " + inside + " "); at != std::string::npos)
          note.replace(at + 6, inside.size(), outside);
  }

  /// One, or several with "; " between them.
  void write(std::string& list) const {
    constexpr std::string_view apart = "; ";
    std::string result;
    for (std::size_t at = 0; at <= list.size();) {
      const std::size_t end = std::min(list.find(apart, at), list.size());
      const std::string one = list.substr(at, end - at);
      const auto text = texts_.find(one);
      result += (at == 0 ? "" : "; ") + (text == texts_.end() ? one : text->second);
      at = end + apart.size();
    }
    list = std::move(result);
  }

  std::map<std::string, std::string> texts_;
};

/// Derives the problem and traces it; fills in the notes and the time of every stage begun.
TracedProblem derive_and_trace(const mechanism::Mechanism& mechanism, const LociRequest& request,
                               const TraceMeans& means, TraceEffort effort) {
  const auto check_deadline = [&] {
    if (request.deadline && Clock::now() >= *request.deadline) throw core::LimitReached("the time limit was reached");
  };
  double symbolic = 0, elimination = 0, tracing = 0;
  TracedProblem traced;
  core::LocusMap& map = traced.map;
  Clock::time_point start = Clock::now();
  try {
    if (request.progress) request.progress(0, "equations");
    check_deadline();
    std::vector<symbolic::DerivedProblem> derived = derived_problems(mechanism, request, means.family);
    for (symbolic::DerivedProblem& one : derived) {
      symbolic += one.symbolic_seconds;
      elimination += one.elimination_seconds;
    }
    if (means.derived) means.derived(derived);

    start = Clock::now();
    check_deadline();
    map = trace_pieces(mechanism, request, derived, sides_to_trace(mechanism, request), traced.sheets, means, effort);
    tracing = seconds_since(start);
    if (means.certificate != nullptr) {
      auto& factors = means.certificate->problem.factors;
      factors.insert(factors.end(), derived.front().rest.begin(), derived.front().rest.end());
      claim_no_curves(derived.front().rest, *means.certificate);
    }
    std::vector<std::string> notes;
    for (const symbolic::DerivedProblem& one : derived)
      for (const std::string& note : one.notes)
        if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    map.notes.insert(map.notes.begin(), notes.begin(), notes.end());
    if (mechanism.coordinates.size() > 2 && all_are_beyond(derived)) map.notes.push_back(words_of_no_pose(mechanism));
    traced.problem = std::move(derived.front().problem);
    FileTexts(derived).write(traced);
  } catch (const core::LimitReached& limit) {
    (symbolic > 0 ? tracing : symbolic) = seconds_since(start);
    map = unfinished_map(mechanism, limit.what());
    traced.sheets.clear();
  }
  map.timing = {{"symbolic", symbolic}, {"elimination", elimination}, {"tracing", tracing}};
  return traced;
}

/// Whether the working modes traced place the mechanism at no pose of the workspace, as where a length is too short. Of
/// surfaces that is not known.
bool closes_nowhere(const core::LocusMap& map) {
  if (map.out_of_time || !map.open.empty() || map.lower.size() > 2) return false;
  if (!map.curves.empty() || !map.isolated_points.empty()) return false;
  return map.reachable.empty() && std::all_of(map.workspace.begin(), map.workspace.end(),
                                              [](const auto& region) { return region.rings.empty(); });
}

TracedProblem trace_member(const mechanism::Mechanism& mechanism, const LociRequest& request, const TraceMeans& means,
                           TraceEffort effort = TraceEffort::full) {
  require_coordinates(mechanism, 1, 3, "loci are traced");
  check_sides(mechanism, request);
  TracedProblem traced = derive_and_trace(mechanism, request, means, effort);
  core::LocusMap& map = traced.map;
  map.mechanism = mechanism.name;
  map.units = mechanism.units;
  map.parameters = mechanism::told_parameters(mechanism);
  map.tolerance = request.tolerance;
  for (std::string& note : mechanism::notes_of(mechanism)) map.notes.push_back(std::move(note));
  if (closes_nowhere(map)) map.notes.push_back(words_of_no_pose(mechanism));
  return traced;
}

}  // namespace

void name_coordinates(const mechanism::Mechanism& mechanism, core::LocusMap& map) {
  map.tower.coordinates.clear();
  map.lower.clear();
  map.upper.clear();
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
    map.tower.coordinates.push_back(coordinate.name);
    map.lower.push_back(coordinate.lower);
    map.upper.push_back(coordinate.upper);
  }
}

std::vector<symbolic::DerivedProblem> derived_problems(const mechanism::Mechanism& mechanism,
                                                       const LociRequest& request,
                                                       const symbolic::LocusFamily* family) {
  // Of algebra single steps are short, and the whole may take minutes.
  std::optional<core::WorkLimit> limit;
  if (request.deadline) limit.emplace(*request.deadline, [] { return false; });
  symbolic::Selection selection = selection_of(request);
  selection.working_modes = sides_to_trace(mechanism, request);
  std::vector<symbolic::DerivedProblem> derived =
      family != nullptr ? family->problems(mechanism, selection) : symbolic::locus_problems(mechanism, selection);
  for (symbolic::DerivedProblem& one : derived)
    one.problem.tolerance = one.problem.charts.empty() ? request.tolerance : loci::chart_tolerance(request.tolerance);
  return derived;
}

void check_sides(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  const std::size_t dyads = mechanism::dyad_points(mechanism).size();
  if (request.all_working_modes) check_mode_count(dyads);
  for (const DyadSides& sides : request.working_modes)
    if (sides.size() != dyads || std::any_of(sides.begin(), sides.end(), [](int s) { return s != 1 && s != -1; }))
      throw core::InputError({}, "a working mode needs a side for each of the " + std::to_string(dyads) + " dyads",
                             "give +1 (left) or -1 (right) for each");
}

core::WorkingMode mode_of(const DyadSides& sides, const core::TowerNames& tower) {
  core::WorkingMode mode;
  std::size_t dyad = 0;
  for (const core::RootNames& root : tower.roots) {
    if (root.role != core::RootRole::working_mode) {
      mode.push_back(1);
      continue;
    }
    core::ensure(dyad < sides.size(), "the tower has one working_mode root a dyad");
    mode.push_back(sides[dyad++]);
  }
  core::ensure(dyad == sides.size(), "the tower has one working_mode root a dyad");
  return mode;
}

std::vector<DyadSides> requested_modes(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  const DyadSides mode = mechanism::working_mode(mechanism);
  if (!request.all_working_modes && !request.working_modes.empty()) return request.working_modes;
  if (!request.all_working_modes) return {mode};
  check_mode_count(mode.size());
  std::vector<DyadSides> modes = {mode};
  for (std::size_t pattern = 0; pattern < std::size_t{1} << mode.size(); ++pattern) {
    DyadSides sides;
    for (std::size_t j = 0; j < mode.size(); ++j) sides.push_back((pattern >> j & 1) != 0 ? -1 : 1);
    if (sides != mode) modes.push_back(sides);
  }
  return modes;
}

core::LocusMap empty_map(const mechanism::Mechanism& mechanism) {
  core::LocusMap map;
  map.mechanism = mechanism.name;
  map.units = mechanism.units;
  map.parameters = mechanism::told_parameters(mechanism);
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
    map.tower.coordinates.push_back(coordinate.name);
    map.lower.push_back(coordinate.lower);
    map.upper.push_back(coordinate.upper);
    map.angles.push_back(coordinate.angle);
  }
  if (std::none_of(map.angles.begin(), map.angles.end(), [](bool angle) { return angle; })) map.angles.clear();
  for (const mechanism::PointIndex dyad : mechanism::dyad_points(mechanism)) {
    core::RootNames root;
    root.point = mechanism.points[static_cast<std::size_t>(dyad)].name;
    root.role = core::RootRole::working_mode;
    root.sides = {mechanism::side_name(mechanism, dyad, 1), mechanism::side_name(mechanism, dyad, -1)};
    map.tower.roots.push_back(std::move(root));
  }
  return map;
}

core::LocusMap unfinished_map(const mechanism::Mechanism& mechanism, const std::string& reason) {
  core::LocusMap map = empty_map(mechanism);
  map.tower.roots.clear();
  map.complete = false;
  map.out_of_time = true;
  map.notes = {reason};
  return map;
}

namespace {

/// Doubles keep the digits of all ranges and lengths beside each other up to such a ratio: beyond it a workspace may be
/// missing as a whole.
void require_comparable_ranges(const mechanism::Mechanism& mechanism) {
  const core::Rational most(10'000'000);
  const auto refuse = [&](const std::string& what) {
    throw core::InputError({mechanism.file}, what,
                           "change the ranges of 'workspace', or check the units; ranges and lengths may be in the "
                           "ratio 1e7");
  };
  const auto told = [&](const core::Rational& length) {
    return core::told(core::to_double(length), "m", mechanism.units, 3);
  };
  const core::Rational size = mechanism::size_of(mechanism);
  core::Rational largest = size;
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
    const core::Rational width = coordinate.upper - coordinate.lower;
    if (!coordinate.angle) largest = std::max(largest, width);
    if (coordinate.angle && width * most < 1) refuse("the range of " + coordinate.name + " is too narrow");
    if (!coordinate.angle && width > most * size)
      refuse("the range of " + coordinate.name + " is " + told(width) + ", the mechanism's size is some " + told(size));
  }
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates)
    if (const core::Rational width = coordinate.upper - coordinate.lower; !coordinate.angle && width * most < largest)
      refuse("the range of " + coordinate.name + " is " + told(width) + ", beside lengths or ranges of some " +
             told(largest));
}

}  // namespace

void require_coordinates(const mechanism::Mechanism& mechanism, std::size_t least, std::size_t most,
                         const std::string& what) {
  const std::size_t count = mechanism.coordinates.size();
  if (least <= count && count <= most) return require_comparable_ranges(mechanism);
  const std::string wanted = least == most ? std::to_string(least) : "one to three";
  throw core::InputError(
      {mechanism.file}, what + " over " + wanted + " free coordinates; this workspace has " + std::to_string(count),
      count > most
          ? (count == most + 1 ? std::string("make one of them a parameter, such as z: 0.5, and vary it with --set")
                               : "make " + std::to_string(count - most) +
                                     " of them parameters, such as z: 0.5, and vary them with --set")
          : "give 'workspace' another coordinate with its range");
}

symbolic::Selection selection_of(const LociRequest& request) {
  return {.joints = request.joints,
          .quantities = request.quantities,
          .min_force = request.min_force,
          .min_couple = request.min_couple,
          .controlled = request.controlled};
}

namespace {

/// In the frame of the mechanism's own, with a family or without one.
core::LocusMap trace_in_frame(const mechanism::Mechanism& mechanism, const LociRequest& request,
                              const TraceMeans& means) {
  if (means.certificate != nullptr) {
    mechanism::require_closed_forms(mechanism, "certificates are written", "leave --certificate out");
    refuse_gears(mechanism, "certificates are written", "leave --certificate out");
  }
  if (!mechanism.groups.empty()) return loci_by_cells(mechanism, request);
  const std::optional<Framed> scaled = framed(mechanism);
  TraceMeans used = means;
  if (request.last && request.carried)
    used.derived = [&](const std::vector<symbolic::DerivedProblem>& derived) {
      request.carried(carried_loci(*request.last, mechanism, scaled, derived));
    };
  core::LocusMap map = scaled ? trace_member(scaled->mechanism, in_frame(request, scaled->frame), used).map
                              : trace_member(mechanism, request, used).map;
  if (means.certificate != nullptr) certify(map, scaled, *means.certificate);
  return scaled ? from_frame(std::move(map), mechanism, scaled->frame) : map;
}

}  // namespace

core::LocusMap trace_loci(const mechanism::Mechanism& mechanism, const LociRequest& request,
                          core::Certificate* certificate) {
  return trace_in_frame(mechanism, request, {.certificate = certificate});
}

TracedProblem trace_problem(const mechanism::Mechanism& mechanism, const LociRequest& request, const TraceMeans& means,
                            TraceEffort effort) {
  return trace_member(mechanism, request, means, effort);
}

core::LocusMap trace_loci(const mechanism::Mechanism& member, const symbolic::LocusFamily& family,
                          const LociRequest& request) {
  return trace_in_frame(member, request, {.family = &family});
}

core::LocusMap trace_loci(const Model& model, const LociRequest& request) {
  const Model::Content& content = model.content();
  check_request(content.mechanism, request);
  return content.member ? trace_loci(content.mechanism, content.shared->family(), request)
                        : trace_loci(content.mechanism, request);
}

}  // namespace clearloci
