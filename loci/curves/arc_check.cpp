#include "loci/curves/arc_check.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <limits>

#include "loci/curves/open_regions.hpp"
#include "loci/curves/place_words.hpp"
#include "loci/search/search.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::Interval;
using core::LocusFactor;
using core::LocusKind;

// What vertices are held to, relative to the box, and in spacings of the doubles that say where they are.
constexpr double vertex_accuracy = 1e-12;
constexpr double spacings = 4;

/// Every |A|, then the denominators.
std::vector<sheet::SheetFunction> functions_at_ends(const core::LocusProblem& problem) {
  std::vector<sheet::SheetFunction> list;
  for (const LocusFactor& other : problem.factors)
    if (other.role == FactorRole::direct_singularity) list.push_back({other.sheet, other.line});
  for (const core::Polynomial& denominator : problem.tower.denominators) list.push_back({denominator, {}});
  return list;
}

bool plays_part_of(const LocusFactor& factor, LocusKind kind) {
  switch (kind) {
    case LocusKind::margin:
      return factor.role == FactorRole::margin;
    case LocusKind::preload:
      return factor.role == FactorRole::preload;
    case LocusKind::direct_singularity:
      return factor.role == FactorRole::direct_singularity;
    case LocusKind::workspace_boundary:
      return factor.role == FactorRole::workspace_boundary;
    default:
      return factor.role == FactorRole::reaction;
  }
}

}  // namespace

double vertex_reach(const std::vector<double>& lower, const std::vector<double>& upper) {
  double largest = 0, size = 0;
  for (std::size_t c = 0; c < lower.size(); ++c) {
    size = std::max(size, upper[c] - lower[c]);
    largest = std::max({largest, std::abs(lower[c]), std::abs(upper[c])});
  }
  return std::max(vertex_accuracy * size, spacings * std::numeric_limits<double>::epsilon() * largest);
}

ArcCheck::ArcCheck(const core::LocusProblem& problem, const LocusFactor& factor, const core::WorkingMode& mode)
    : problem_(problem),
      mode_(mode),
      program_(problem.tower, std::vector<sheet::SheetFunction>{{factor.sheet, factor.line}}),
      registers_(program_.registers<Interval>()) {
  for (std::size_t c = 0; c < 2; ++c) {
    lower_[c] = core::to_double(problem.lower[c]);
    upper_[c] = core::to_double(problem.upper[c]);
  }
  reach_ = vertex_reach({lower_[0], lower_[1]}, {upper_[0], upper_[1]});
}

bool ArcCheck::one_vanishes(const std::array<Interval, 2>& place, bool of_denominators) {
  if (!at_ends_) {
    at_ends_.emplace(problem_.tower, functions_at_ends(problem_));
    registers_at_ends_ = at_ends_->registers<Interval>();
  }
  for (int c = 0; c < 2; ++c) registers_at_ends_->set(c, place[static_cast<std::size_t>(c)]);
  for (int j = 0; j < program_.roots(); ++j) {
    registers_at_ends_->run_square(j);
    registers_at_ends_->set(2 + j, registers_.root(j));
  }
  registers_at_ends_->run_values();
  const int first_denominator = at_ends_->functions() - static_cast<int>(problem_.tower.denominators.size());
  const int end = of_denominators ? at_ends_->functions() : first_denominator;
  for (int f = of_denominators ? first_denominator : 0; f < end; ++f)
    if (registers_at_ends_->value(f).contains_zero()) return true;
  return false;
}

std::optional<std::string> ArcCheck::fault_at(const core::Point2& at, core::ArcEnd end, const core::Point2& reach) {
  bool on_side = false;
  for (std::size_t c = 0; c < 2; ++c) {
    if (!(at[c] >= lower_[c] - reach[c] && at[c] <= upper_[c] + reach[c])) return "a vertex outside the box";
    on_side = on_side || at[c] <= lower_[c] + reach[c] || at[c] >= upper_[c] - reach[c];
  }
  const std::array<Interval, 2> place = {Interval(at[0] - reach[0], at[0] + reach[0]),
                                         Interval(at[1] - reach[1], at[1] + reach[1])};
  for (int c = 0; c < 2; ++c) registers_.set(c, place[static_cast<std::size_t>(c)]);
  bool on_boundary = false;
  for (int j = 0; j < program_.roots(); ++j) {
    registers_.run_square(j);
    const Interval& square = registers_.square(j);
    if (square.upper() < 0) return "a vertex outside the workspace";
    on_boundary = on_boundary || square.lower() <= 0;
    const Interval root = square_root(square);
    registers_.set(2 + j, mode_[static_cast<std::size_t>(j)] > 0 ? root : -root);
  }
  registers_.run_values();
  if (!registers_.value(0).contains_zero()) return "a vertex off its curve, or in another mode";
  switch (end) {
    case core::ArcEnd::box:
      if (!on_side) return "an end on no side of the box";
      break;
    case core::ArcEnd::boundary:
      // Where a leg's ends meet the sheet ends in a point.
      if (!on_boundary && !one_vanishes(place, true)) return "an end away from the workspace boundary";
      break;
    case core::ArcEnd::direct_singularity:
      if (!one_vanishes(place, false)) return "an end away from the direct singularities";
      break;
    default:
      break;
  }
  return std::nullopt;
}

bool ArcCheck::holds(const core::Point2& vertex, core::ArcEnd end) { return holds(vertex, end, {reach_, reach_}); }

bool ArcCheck::holds(const core::Point2& vertex, core::ArcEnd end, const core::Point2& reach) {
  return !fault_at(vertex, end, reach);
}

std::optional<ArcFault> ArcCheck::operator()(const core::Arc& arc) {
  if (arc.points.size() < 2) return ArcFault{"an arc without vertices", {}};
  const core::Point2 &first = arc.points.front(), &last = arc.points.back();
  const bool same = first == last, no_ends = arc.ends[0] == core::ArcEnd::none && arc.ends[1] == core::ArcEnd::none;
  if (arc.closed && !(same && no_ends)) return ArcFault{"a closed arc with ends", first};
  // A loop may lead from a crossing back to it; at a side of the box an arc that comes back to where it left is a
  // point.
  if (!arc.closed && (no_ends || (same && (arc.points.size() < 4 || arc.ends[0] == core::ArcEnd::box))))
    return ArcFault{"an arc of one point", first};
  double chords = 0;
  for (std::size_t i = 0; i < arc.points.size(); ++i) {
    if (i > 0) chords += std::hypot(arc.points[i][0] - arc.points[i - 1][0], arc.points[i][1] - arc.points[i - 1][1]);
    core::ArcEnd end = core::ArcEnd::none;
    if (i == 0) end = arc.ends[0];
    if (i + 1 == arc.points.size()) end = arc.ends[1];
    if (auto what = fault_at(arc.points[i], end, {reach_, reach_}))
      return ArcFault{std::move(*what), arc.points[i], true};
  }
  // A chord that strays by the tolerance hides less than twice that of a curve that does not turn back.
  const double hidden = 2 * problem_.tolerance * static_cast<double>(arc.points.size());
  if (!(arc.length >= chords * (1 - 1e-9) - reach_ && arc.length <= chords + hidden + reach_))
    return ArcFault{"a length that is not that of its chords", first};
  return std::nullopt;
}

bool owns(const LocusFactor& factor, const core::LocusCurve& curve) {
  if (!plays_part_of(factor, curve.kind)) return false;
  if (curve.implicit.is_zero()) return factor.implicit.empty();
  return std::find(factor.implicit.begin(), factor.implicit.end(), curve.implicit) != factor.implicit.end();
}

std::deque<ArcCheck> checks_of(const core::LocusProblem& problem, const core::LocusCurve& curve) {
  std::deque<ArcCheck> checks;
  for (const LocusFactor& factor : problem.factors)
    if (owns(factor, curve)) checks.emplace_back(problem, factor, curve.mode);
  return checks;
}

namespace {

struct Sound {
  std::vector<core::Arc> pieces;
  std::vector<PlaneBox> gaps;  ///< what is between them
};

/// What is left of an arc without the vertices that fail, but for pieces that chords of a curve elsewhere may be.
Sound sound_pieces(const core::Arc& arc, std::deque<ArcCheck>& checks, double tolerance) {
  constexpr std::size_t fewest = 4;  // vertices that no place with a few wrong ones has by chance
  Sound sound;
  if (arc.points.empty()) return sound;
  core::Arc piece;
  std::size_t told = 0;  // the last vertex of the piece before
  const auto held = [&](const core::Point2& at, core::ArcEnd end) {
    return std::any_of(checks.begin(), checks.end(), [&](ArcCheck& check) { return check.holds(at, end); });
  };
  const auto leave_out = [&](std::size_t from, std::size_t to) {
    if (to > from)
      sound.gaps.push_back(extent_of({arc.points.begin() + static_cast<std::ptrdiff_t>(from),
                                      arc.points.begin() + static_cast<std::ptrdiff_t>(to) + 1}));
  };
  // A piece that ends before vertex `next`.
  const auto finish = [&](std::size_t next) {
    const std::size_t count = piece.points.size();
    if (count >= fewest && piece.length > 2 * tolerance * static_cast<double>(count)) {
      leave_out(told, next - count);
      told = next - 1;
      sound.pieces.push_back(piece);
    }
    piece = {};
  };
  for (std::size_t i = 0; i < arc.points.size(); ++i) {
    const core::Point2& at = arc.points[i];
    if (!held(at, core::ArcEnd::none)) {
      finish(i);
      continue;
    }
    if (!piece.points.empty())
      piece.length += std::hypot(at[0] - piece.points.back()[0], at[1] - piece.points.back()[1]);
    piece.points.push_back(at);
    if (i == 0 && held(at, arc.ends[0])) piece.ends[0] = arc.ends[0];
    if (i + 1 == arc.points.size() && held(at, arc.ends[1])) piece.ends[1] = arc.ends[1];
  }
  finish(arc.points.size());
  leave_out(told, arc.points.size() - 1);
  return sound;
}

}  // namespace

std::vector<WrongArc> wrong_arcs(const core::LocusProblem& problem, const core::LocusMap& map) {
  std::vector<std::vector<WrongArc>> by_curve(map.curves.size());
  run_in_order(map.curves.size(), [&](std::size_t c) {
    const core::LocusCurve& curve = map.curves[c];
    std::deque<ArcCheck> checks = checks_of(problem, curve);
    for (std::size_t a = 0; a < curve.arcs.size() && !checks.empty(); ++a) {
      std::optional<ArcFault> fault;
      const bool held = std::any_of(checks.begin(), checks.end(), [&](ArcCheck& check) {
        std::optional<ArcFault> found = check(curve.arcs[a]);
        const bool none = !found;
        if (!fault) fault = std::move(found);
        return none;
      });
      if (!held) by_curve[c].push_back({c, a, std::move(*fault)});
    }
  });
  std::vector<WrongArc> wrong;
  for (std::vector<WrongArc>& own : by_curve) std::move(own.begin(), own.end(), std::back_inserter(wrong));
  return wrong;
}

bool withhold_wrong_arcs(const core::LocusProblem& problem, core::LocusMap& map) {
  const std::vector<WrongArc> wrong = wrong_arcs(problem, map);
  for (std::size_t first = 0, next = 0; first < wrong.size(); first = next) {
    while (next < wrong.size() && wrong[next].curve == wrong[first].curve) ++next;
    core::LocusCurve& curve = map.curves[wrong[first].curve];
    curve.certified = false;
    const ArcFault& fault = wrong[first].fault;
    map.notes.push_back((next - first == 1 ? "an arc" : std::to_string(next - first) + " arcs") + " of the curve (" +
                        curve_words(curve) + ") failed the last check; the parts that failed are withheld: " +
                        fault.what + ", " + place_words(problem, {fault.at[0], fault.at[0], fault.at[1], fault.at[1]}));
    std::deque<ArcCheck> checks = checks_of(problem, curve);
    for (std::size_t last = next; last-- > first;) {
      const auto place = curve.arcs.begin() + static_cast<std::ptrdiff_t>(wrong[last].arc);
      // What is wrong with an arc as a whole may be so anywhere along it.
      Sound sound = sound_pieces(*place, checks, problem.tolerance);
      if (!wrong[last].fault.in_vertices)
        sound.gaps = {extent_of(place->points.empty() ? core::Polyline{wrong[last].fault.at} : place->points)};
      for (const PlaneBox& gap : sound.gaps) leave_open(label_of(curve), curve.mode, gap, map);
      curve.arcs.insert(curve.arcs.erase(place), sound.pieces.begin(), sound.pieces.end());
    }
  }
  std::erase_if(map.curves, [](const core::LocusCurve& curve) { return curve.arcs.empty(); });
  return !wrong.empty();
}

}  // namespace clearloci::loci
