#include "analysis/zones.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "analysis/framed.hpp"
#include "analysis/idle_efforts.hpp"
#include "analysis/model.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/request_limits.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/zone_preload.hpp"
#include "analysis/zones_by_cells.hpp"
#include "core/errors.hpp"
#include "loci/curves/curves.hpp"
#include "loci/search/search.hpp"
#include "loci/zones/zones.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/read_task.hpp"
#include "numeric/line_witness.hpp"
#include "numeric/reactions.hpp"
#include "numeric/take_up.hpp"

namespace clearloci {
namespace {

using Clock = std::chrono::steady_clock;

/// +1 or -1 where rounding cannot have changed it, else 0.
int sign(const numeric::Bounded& value) { return value.value > value.error ? 1 : value.value < -value.error ? -1 : 0; }

/// Whether N or T of a guide whose ends are not known has one sign in every zone. Its own curve cuts none; it has none
/// where it was asked for and none was found, and where the other of the two is zero in every pose it is that of the
/// force.
bool keeps_sign_in_zones(const core::Vanishing& what, const LociRequest& request, const core::LocusMap& loci,
                         const std::vector<core::Vanishing>& always_zero) {
  const auto is = [&](core::Quantity quantity) {
    return [&joint = what.joint, quantity](const core::Vanishing& vanishing) {
      return vanishing.joint == joint && vanishing.quantity == quantity;
    };
  };
  const auto asked = [&](core::Quantity quantity) {
    return std::find(request.quantities.begin(), request.quantities.end(), quantity) != request.quantities.end();
  };
  if (asked(what.quantity))
    return std::none_of(loci.curves.begin(), loci.curves.end(), [&](const core::LocusCurve& curve) {
      return curve.kind == core::LocusKind::component &&
             std::any_of(curve.vanishing.begin(), curve.vanishing.end(), is(what.quantity));
    });
  const core::Quantity other = what.quantity == core::Quantity::N ? core::Quantity::T : core::Quantity::N;
  return asked(core::Quantity::f) && std::any_of(always_zero.begin(), always_zero.end(), is(other));
}

/// Whether zeros of an effort or of the force at the end of a guide cut zones: those of what was asked for.
bool cuts_zones(core::Quantity quantity, const LociRequest& request) {
  const auto asked = [&](core::Quantity candidate) {
    return std::find(request.quantities.begin(), request.quantities.end(), candidate) != request.quantities.end();
  };
  using enum core::Quantity;
  if (quantity == F) return asked(F) || asked(M);
  if (quantity == end_ahead || quantity == end_behind) return asked(quantity) || asked(f);
  return asked(quantity);
}

/// Signs of |A| and of every wanted couple and the like in the zones, and what is too small, by the independent witness
/// at their samples.
void add_signs(const mechanism::Mechanism& mechanism, const LociRequest& request,
               const std::vector<core::Vanishing>& always_zero, core::Zones& map) {
  const numeric::NumericModel model = numeric::compile(with_idle_efforts(mechanism));
  const bool free = !mechanism::joints_without_preload(mechanism).empty();
  const std::vector<numeric::TracedReaction> wanted = selected_reactions(mechanism, request);
  const std::vector<numeric::JointColumns> columns_of_joints = numeric::joint_columns(model);
  const std::vector<numeric::JointClearance> clearances = numeric::joint_clearances(mechanism);
  std::vector<core::TaskDemand> demands = demands_of(mechanism, request);
  std::erase_if(demands, [&](const core::TaskDemand& demand) {
    return std::any_of(always_zero.begin(), always_zero.end(), [&](const core::Vanishing& what) {
      return what.joint == demand.joint && what.quantity == demand.quantity;
    });
  });
  for (core::Zone& zone : map.zones) {
    const std::vector<int> sides = numeric::dyad_signs(model, map.loci.tower, zone.mode);
    const numeric::BoundedNumerators at = numeric::bounded_numerators(model, zone.sample, sides);
    if (!at.reachable) continue;
    zone.assembly_mode = sign(at.determinant);
    if (free) continue;  // signs and sizes are those of the effort that is chosen
    zone.too_small = too_small_at(model, demands, zone.sample, sides);
    for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
      const mechanism::Unknown& unknown = model.unknowns[k];
      const std::string& joint = mechanism.joints[static_cast<std::size_t>(unknown.joint)].name;
      const core::Quantity q = unknown.quantity;
      // A guide whose ends are known is told of by these.
      const bool guide =
          mechanism.space == mechanism::Space::planar && (q == core::Quantity::N || q == core::Quantity::T) &&
          !mechanism::has_guide_ends(mechanism, mechanism.joints[static_cast<std::size_t>(unknown.joint)]);
      const bool component = !guide && q != core::Quantity::M && q != core::Quantity::F;
      const bool chosen = std::any_of(wanted.begin(), wanted.end(), [&](const numeric::TracedReaction& reaction) {
        return reaction.joint == joint && reaction.quantity == q;
      });
      const core::Vanishing what{joint, q, 1};
      const bool slot = mechanism::is_slot(mechanism, mechanism.joints[static_cast<std::size_t>(unknown.joint)]);
      const bool cuts = slot && std::find(request.quantities.begin(), request.quantities.end(), core::Quantity::f) !=
                                    request.quantities.end();
      const bool keeps =
          guide ? cuts || keeps_sign_in_zones(what, request, map.loci, always_zero) : cuts_zones(q, request);
      if (!component && chosen && keeps) zone.signs.emplace_back(what, sign(at.values[k]) * zone.assembly_mode);
    }
    for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
      for (const auto& [end, side] : mechanism::guide_end_signs)
        if (cuts_zones(end, request) &&
            std::find(wanted.begin(), wanted.end(), numeric::TracedReaction{mechanism.joints[j].name, end}) !=
                wanted.end()) {
          const numeric::WitnessColumns columns = {columns_of_joints[j].normal, columns_of_joints[j].tilt, -1,
                                                   side / clearances[j].half_length};
          zone.signs.emplace_back(core::Vanishing{mechanism.joints[j].name, end, 1},
                                  sign(numeric::components(at, columns).front()) * zone.assembly_mode);
        }
  }
}

/// Where the loci are those of several sheets, zones lie on one sheet each; a curve's name is that of the joined map.
/// `may_leave`: as of loci::zones, of a mechanism without folds.
loci::CutZones zones_of(TracedProblem traced, bool may_leave, const loci::ZoneLabel& label) {
  if (traced.sheets.empty()) return loci::zones(traced.problem, std::move(traced.map), false, may_leave, label);
  loci::CutZones all;
  core::Zones& joined = all.map;
  for (TracedSheet& sheet : traced.sheets) {
    loci::CutZones cut = loci::zones(sheet.problem, std::move(sheet.map), false, false, label);
    core::Zones& zones = cut.map;
    all.finer_may_tell = all.finer_may_tell && cut.finer_may_tell;
    const std::vector<core::LocusCurve> curves = zones.loci.curves;
    const core::TowerNames tower = zones.loci.tower;
    loci::drop_own_roots(zones.loci);
    for (core::Zone& zone : zones.zones) {
      for (core::ZoneBorder& border : zone.borders) {
        border.beside.clear();
        const auto curve =
            std::find_if(curves.begin(), curves.end(), [&](const auto& c) { return c.id == border.curve; });
        if (curve == curves.end()) continue;
        const std::size_t place = static_cast<std::size_t>(curve - curves.begin());
        border.curve = loci::name_in(traced.map, zones.loci.curves[place]);
        const auto named = std::find_if(traced.map.curves.begin(), traced.map.curves.end(),
                                        [&](const auto& c) { return c.id == border.curve; });
        if (named == traced.map.curves.end()) continue;
        border.kind = named->kind;
        border.vanishing = named->vanishing;
      }
      for (int& point : zone.isolated_points)
        point = loci::place_in(traced.map, zones.loci.isolated_points[static_cast<std::size_t>(point)]);
      std::erase(zone.isolated_points, -1);
      loci::drop_own_roots(tower, zone.mode);
      joined.zones.push_back(std::move(zone));
    }
    for (core::ZonedMode& area : zones.modes) {
      loci::drop_own_roots(tower, area.mode);
      const auto found = std::find_if(joined.modes.begin(), joined.modes.end(),
                                      [&](const core::ZonedMode& other) { return other.mode == area.mode; });
      if (found == joined.modes.end()) {
        joined.modes.push_back(area);
        continue;
      }
      found->workspace += area.workspace;
      found->outside = std::max(0.0, found->outside - area.workspace);
      found->in_doubt += area.in_doubt;
    }
  }
  joined.loci = std::move(traced.map);
  std::vector<core::WorkingMode> modes;
  for (const core::WorkspaceRegion& region : joined.loci.workspace) modes.push_back(region.mode);
  const auto key = [&](const core::Zone& zone) {
    return std::pair(std::find(modes.begin(), modes.end(), zone.mode) - modes.begin(), -zone.size);
  };
  std::stable_sort(joined.zones.begin(), joined.zones.end(),
                   [&](const core::Zone& a, const core::Zone& b) { return key(a) < key(b); });
  int number = 0;
  for (core::Zone& zone : joined.zones) zone.id = "z" + std::to_string(++number);
  return all;
}

/// `label`: may be empty.
core::Zones cut_zones(const mechanism::Mechanism& mechanism, const LociRequest& request, core::Certificate* certificate,
                      const symbolic::LocusFamily* family, const PreloadLabel& label) {
  constexpr int attempts = 3;  // polylines of curves that nearly touch are told apart by finer ones
  LociRequest finer = request;
  loci::sheet::KnownSearches searches;
  for (int attempt = 1;; ++attempt) {
    TracedProblem traced = trace_problem(mechanism, finer, {certificate, &searches, family});
    if (traced.map.out_of_time)
      throw core::LimitReached("the loci could not be traced completely within the time limit");
    const Clock::time_point start = Clock::now();
    const std::vector<core::Vanishing> always_zero = traced.problem.always_zero;
    loci::ZoneLabel in_tower;
    if (label)
      in_tower = [&label, tower = traced.map.tower](const core::WorkingMode& mode, const std::vector<double>& sample) {
        return label(tower, mode, sample);
      };
    loci::CutZones cut = zones_of(std::move(traced), attempt < attempts, in_tower);
    core::Zones& map = cut.map;
    const bool certified = std::all_of(map.zones.begin(), map.zones.end(), [](const auto& z) { return z.certified; });
    if (cut.left || (!certified && cut.finer_may_tell && attempt < attempts)) {
      finer.tolerance /= 16;
      continue;
    }
    add_signs(mechanism, request, always_zero, map);
    const std::chrono::duration<double> taken = Clock::now() - start;
    map.loci.timing.emplace_back("zones", taken.count());
    return std::move(map);
  }
}

}  // namespace

namespace {

/// Where the loci are complete, zones may still be in doubt: by how their curves meet, or by their areas.
bool all_is_certain(const core::Zones& map) {
  return std::all_of(map.zones.begin(), map.zones.end(), [](const core::Zone& zone) { return zone.certified; }) &&
         std::all_of(map.modes.begin(), map.modes.end(),
                     [](const core::ZonedMode& mode) { return mode.in_doubt == 0; });
}

}  // namespace

bool has_zones_by_cells(const mechanism::Mechanism& mechanism) {
  const bool chosen = !mechanism::joints_without_preload(mechanism).empty();
  return !mechanism::is_plane(mechanism) || !mechanism.groups.empty() ||
         (mechanism::has_effort_bounds(mechanism) && !chosen);
}

core::Zones find_zones(const mechanism::Mechanism& mechanism, const ZoneRequest& request,
                       core::Certificate* certificate, const symbolic::LocusFamily* family) {
  if (request.by_cells || has_zones_by_cells(mechanism))
    return zones_by_cells(mechanism::with_bounded_belts(mechanism), request);
  const std::optional<Framed> scaled = framed(mechanism);
  const PreloadLabel label = label_of_preload(mechanism, scaled ? scaled->frame : mechanism::Frame{});
  core::Zones map =
      scaled ? cut_zones(scaled->mechanism, in_frame(request.loci, scaled->frame), certificate, family, label)
             : cut_zones(mechanism, request.loci, certificate, family, label);
  map.loci.complete = map.loci.complete && all_is_certain(map);
  if (certificate != nullptr) {
    certify(map.loci, scaled, *certificate);
    certificate->zones = map.zones;
    certificate->zoned_modes = map.modes;
  }
  if (scaled) map = from_frame(std::move(map), mechanism, scaled->frame);
  add_preload(mechanism, request.loci, map);
  return map;
}

Zones find_zones(const Model& model, const ZoneRequest& request) {
  const Model::Content& content = model.content();
  check_request(content.mechanism, request.loci);
  check_cells(request.cells);
  return find_zones(content.mechanism, request, nullptr, content.member ? &content.shared->family() : nullptr);
}

}  // namespace clearloci
