// Zones partition the workspace and have the signs that they are said to have; areas and rings hold against sampling.
// Where a force passes its least value along a line, a margin curve is there, and no certified zone goes through.
#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/zones.hpp"
#include "core/errors.hpp"
#include "tests/laws/law_subject.hpp"

namespace clearloci::test {
namespace {

/// The workspace's area by sampling, and how far that of chords within `tolerance` may be off. One pose is drawn in
/// each cell of a grid: poses in rows miss slits along them, as of torsion springs, that are thinner than the cells.
std::pair<double, double> sampled_area(const Subject& s, const std::vector<int>& sides, double tolerance) {
  constexpr int n = 300;
  const Point2 step = {(s.upper(0) - s.lower(0)) / n, (s.upper(1) - s.lower(1)) / n};
  std::vector<char> there(n * n);
  std::mt19937 random(n);
  std::uniform_real_distribution<double> within(0, 1);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double x = s.lower(0) + (i + within(random)) * step[0];
      const double y = s.lower(1) + (k + within(random)) * step[1];
      there[static_cast<std::size_t>(i * n + k)] = s.witness.reachable(Point2{x, y}, sides) ? 1 : 0;
    }
  int count = 0, rim = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const char symbol = there[static_cast<std::size_t>(i * n + k)];
      count += symbol;
      if ((i > 0 && there[static_cast<std::size_t>((i - 1) * n + k)] != symbol) ||
          (k > 0 && there[static_cast<std::size_t>(i * n + k - 1)] != symbol))
        ++rim;
    }
  // Five standard deviations of draws that are in or out by half a cell each; chords; what no pose falls into.
  const double chords = rim * tolerance / std::min(step[0], step[1]);
  return {count * step[0] * step[1], (2.5 * std::sqrt(rim) + chords + 0.02 * n) * step[0] * step[1]};
}

/// Away from everything drawn a reachable pose lies in one zone, and has its signs; another one lies in none.
void one_zone_a_pose(Subject& s, const core::Zones& zones, const core::WorkingMode& mode,
                     const std::vector<int>& sides) {
  const double away = 1e-3 * s.size();
  const auto beside_an_arc = [&](const Point2& at) {
    for (const core::LocusCurve& curve : zones.loci.curves)
      for (const core::Arc& arc : curve.arcs)
        if (curve.mode == mode && distance_to(arc.points, at) < away) return true;
    return false;
  };
  long held = 0;
  for (const std::vector<double>& pose : s.scattered(20)) {
    const Point2 at = {pose[0], pose[1]};
    std::vector<const core::Zone*> around;
    for (const core::Zone& zone : zones.zones)
      if (zone.mode == mode && inside(zone, at)) around.push_back(&zone);
    const auto reactions = s.witness.at(at, sides);
    std::ostringstream fault;
    if (around.size() != (reactions ? 1U : 0U))
      fault << around.size() << " zones about a pose " << (reactions ? "" : "not ") << "of the workspace";
    if (reactions && around.size() == 1) {
      const core::Zone& zone = *around.front();
      if ((reactions->determinant > 0 ? 1 : -1) != zone.assembly_mode) fault << zone.id << ": another sign of |A|";
      for (const auto& [what, sign] : zone.signs)
        if (what.quantity != core::Quantity::f && sign != 0 &&
            (s.witness.value_of(*reactions, what) > 0 ? 1 : -1) != sign)
          fault << zone.id << ": another sign of " << core::to_string(what.quantity) << " of " << what.joint;
    }
    ++held;
    if (fault.str().empty() || beside_an_arc(at)) continue;
    Report::Line(s.report) << fault.str() << " at (" << at[0] << ", " << at[1] << ")";
    return;
  }
  s.report.held("poses in zones", held);
}

struct Crossing {
  Point2 at;
  core::Vanishing what;
};

/// Where reactions pass their least value, along lines of a grid, by bisection.
std::vector<Crossing> crossings(const Subject& s, const std::vector<int>& sides) {
  constexpr int n = 40;
  std::vector<std::pair<core::Vanishing, double>> wanted;
  for (const mechanism::Joint& joint : s.mechanism.joints) {
    const auto& joints = s.request.joints;
    if (!joint.clearance || (!joints.empty() && std::find(joints.begin(), joints.end(), joint.name) == joints.end()))
      continue;
    if (s.request.min_force && s.witness.has_force(joint.name))
      wanted.push_back({{joint.name, core::Quantity::f, 1}, core::to_double(*s.request.min_force)});
    if (s.request.min_couple && joint.actuated && s.witness.has_force(joint.name))
      wanted.push_back({{joint.name, core::Quantity::M, 1}, core::to_double(*s.request.min_couple)});
  }
  const auto node = [&](int i, int k) {
    return Point2{s.lower(0) + (i + 0.371) / n * (s.upper(0) - s.lower(0)),
                  s.lower(1) + (k + 0.617) / n * (s.upper(1) - s.lower(1))};
  };
  std::vector<Crossing> found;
  const auto look = [&](Point2 a, Point2 b) {
    auto at_a = s.witness.at(a, sides), at_b = s.witness.at(b, sides);
    if (!at_a || !at_b || at_a->determinant * at_b->determinant < 0) return;
    for (const auto& [what, least] : wanted) {
      const auto excess = [&, &condition = what, &bound = least](const numeric::Reactions& w) {
        return std::abs(s.witness.value_of(w, condition)) - bound;
      };
      double ea = excess(*at_a);
      if (!(ea * excess(*at_b) < 0)) continue;
      Point2 p = a, q = b;
      bool all = true;
      for (int step = 0; step < 40 && all; ++step) {
        const Point2 m = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])};
        const auto at_m = s.witness.at(m, sides);
        all = at_m && at_m->determinant * at_a->determinant > 0;
        if (all) (excess(*at_m) * ea > 0 ? p : q) = m;
      }
      // A passage, and no jump.
      const auto last = s.witness.at(p, sides);
      if (all && last && std::abs(excess(*last)) < 1e-6 * least) found.push_back({p, what});
    }
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      if (i + 1 < n) look(node(i, k), node(i + 1, k));
      if (k + 1 < n) look(node(i, k), node(i, k + 1));
    }
  return found;
}

double distance_to_zone(const core::Zone& zone, const Point2& at) {
  double least = distance_to(zone.outer, at);
  for (const core::Polyline& hole : zone.holes) least = std::min(least, distance_to(hole, at));
  return least;
}

}  // namespace

void judge_margins(Subject& s) {
  if (!s.is_plane() || (!s.request.min_force && !s.request.min_couple)) return;
  const std::optional<core::LocusMap> map = loci_of(s);
  if (!map) return;
  core::Zones zones;
  try {
    zones = s.report.in_patience([&] { return find_zones(s.mechanism, {s.request}); });
  } catch (const core::LimitReached&) {
    return s.report.late();
  } catch (const core::InputError& refused) {
    return s.report.refused(refused.what());
  }
  for (const core::WorkspaceRegion& region : map->workspace) {
    for (const Crossing& crossing : crossings(s, s.sides_of(*map, region.mode))) {
      double least = 1e300;
      bool doubted = !map->complete;
      for (const core::LocusCurve& curve : map->curves) {
        if (curve.mode != region.mode) continue;
        doubted = doubted || (!curve.certified && curve.kind == core::LocusKind::margin);
        const bool of_it = std::any_of(curve.vanishing.begin(), curve.vanishing.end(), [&](const auto& candidate) {
          return candidate.joint == crossing.what.joint && candidate.quantity == crossing.what.quantity;
        });
        if (curve.kind == core::LocusKind::margin && of_it)
          for (const core::Arc& arc : curve.arcs) least = std::min(least, distance_to(arc.points, crossing.at));
      }
      const double reach = 3 * map->tolerance + 1e-7 * s.size();
      s.report.held("crossings of margins");
      if (least > reach && !doubted)
        return void(Report::Line(s.report) << core::to_string(crossing.what.quantity) << " of " << crossing.what.joint
                                           << " passes its least value at (" << crossing.at[0] << ", " << crossing.at[1]
                                           << "), " << least << " from the next margin curve");
      for (const core::Zone& zone : zones.zones)
        if (zone.certified && zone.mode == region.mode && inside(zone, crossing.at) &&
            distance_to_zone(zone, crossing.at) > 1e-3 * s.size())
          return void(Report::Line(s.report) << core::to_string(crossing.what.quantity) << " of " << crossing.what.joint
                                             << " passes its least value at (" << crossing.at[0] << ", "
                                             << crossing.at[1] << ") inside " << zone.id << ", certified");
    }
  }
}

void judge_zones(Subject& s) {
  if (!s.is_plane()) return;
  core::Zones zones;
  try {
    zones = s.report.in_patience([&] { return find_zones(s.mechanism, {s.request}); });
  } catch (const core::LimitReached&) {
    return s.report.late();
  } catch (const core::InputError& refused) {
    return s.report.refused(refused.what());
  }
  double in_doubt = 0, workspace = 0;
  for (const core::ZonedMode& mode : zones.modes) {
    in_doubt += mode.in_doubt;
    workspace += mode.workspace;
  }
  // What no pose was found of, thinner than its chords, and what is between curves that meet nearer than their order is
  // told is in doubt, and each zone that was found may be certified.
  constexpr double hardly_any = 1e-10;
  const bool certified =
      in_doubt <= hardly_any * workspace &&
      std::all_of(zones.zones.begin(), zones.zones.end(), [](const core::Zone& zone) { return zone.certified; });
  if (!certified) s.report.uncertified("zones");
  if (zones.loci.complete && (!certified || in_doubt > 0)) s.report.fault("zones in doubt are told as complete");
  const std::string what = std::to_string(zones.zones.size()) + " zones" + (certified ? "" : ", not certified");
  for (const core::WorkspaceRegion& region : zones.loci.workspace) {
    const std::vector<int> sides = s.sides_of(zones.loci, region.mode);
    const auto [sampled, doubt] = sampled_area(s, sides, zones.loci.tolerance);
    double rings = 0, total = 0;
    for (const core::Polyline& ring : region.rings) rings += area_of(ring);
    const auto& notes = zones.loci.notes;
    const bool said = std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
      return note.find("ring") != std::string::npos || note.find("workspace") != std::string::npos;
    });
    if (std::abs(std::abs(rings) - sampled) > doubt && region.rings.size() < 2 && !said)
      Report::Line(s.report) << region.rings.size() << " rings of " << rings << " m^2, sampled " << sampled << " +- "
                             << doubt;
    for (const core::Zone& zone : zones.zones) total += zone.mode == region.mode ? zone.size : 0;
    if (certified && std::abs(total - sampled) > doubt)
      Report::Line(s.report) << what << " of " << total << " m^2, sampled " << sampled << " +- " << doubt;
    for (const core::ZonedMode& account : zones.modes) {
      if (account.mode != region.mode) continue;
      if (std::abs(account.workspace - sampled) > doubt + account.in_doubt)
        Report::Line(s.report) << "a workspace of " << account.workspace << " m^2, sampled " << sampled << " +- "
                               << doubt;
    }
    if (certified) one_zone_a_pose(s, zones, region.mode, sides);
  }
}

}  // namespace clearloci::test
