#include "analysis/pose_zones.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "analysis/framed.hpp"
#include "analysis/model.hpp"
#include "analysis/pose.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/request_limits.hpp"
#include "analysis/side_names.hpp"
#include "analysis/task_demands.hpp"
#include "core/errors.hpp"
#include "loci/zones/zones.hpp"
#include "mechanism/notes.hpp"
#include "mechanism/posture_sample.hpp"
#include "numeric/error_samples.hpp"
#include "numeric/reactions.hpp"
#include "symbolic/pose_statics.hpp"

namespace clearloci {
namespace {

using core::PoseZone;
using core::PoseZones;
using loci::pose::Doubt;
using loci::pose::PoseCell;

core::PoseZoneBound bound_of(const core::PoseStatics& statics, Doubt doubt, int demand) {
  if (doubt == Doubt::workspace) return {core::LocusKind::workspace_boundary, {}};
  if (doubt == Doubt::singularity) return {core::LocusKind::direct_singularity, {}};
  const core::TaskDemand& own = statics.demands[static_cast<std::size_t>(demand)].demand;
  return {locus_kind_of(own), {{own.joint, own.quantity, 1}}};
}

/// Of |A| and of what has one component, at the zone's sample: they are those of all of it.
void add_signs(const core::PoseStatics& statics, const numeric::NumericModel& model, const DyadSides& sides,
               PoseCell& cell, PoseZone& zone) {
  const auto at = cell.at(zone.sample);
  if (!at) return;
  const numeric::Bounded determinant = numeric::bounded_numerators(model, zone.sample, sides).determinant;
  zone.assembly_mode = determinant.value > 0 ? 1 : -1;
  for (std::size_t d = 0; d < statics.demands.size(); ++d) {
    const std::vector<double>& own = at->components[d].front();
    const core::TaskDemand& demand = statics.demands[d].demand;
    if (own.size() == 1)
      zone.signs.emplace_back(core::Vanishing{demand.joint, demand.quantity, 1}, own[0] > 0 ? 1 : own[0] < 0 ? -1 : 0);
  }
}

/// Cells of the grid of labels along each coordinate.
int raster_of(std::size_t coordinates) { return coordinates == 1 ? 1024 : coordinates == 2 ? 256 : 64; }

/// Whether what is in doubt at an end changes its sign, or turns round, between two poses.
bool turns(PoseCell& cell, const std::vector<double>& before, const std::vector<double>& behind, int demand) {
  const auto one = cell.at(before), other = cell.at(behind);
  if (!one || !other) return false;
  const auto d = static_cast<std::size_t>(demand);
  double together = 0;
  for (std::size_t k = 0; k < one->components[d].front().size(); ++k)
    together += one->components[d].front()[k] * other->components[d].front()[k];
  return together < 0;
}

/// What ends the zones over one coordinate, and the end effector's jumps there: errors a hair behind less those a hair
/// before. No loci are traced for it: what is in doubt beside a zone is at its end, to the finest cells.
class Ends {
 public:
  Ends(const mechanism::Mechanism& mechanism, const core::PoseStatics& statics, const numeric::NumericModel& model,
       const DyadSides& sides, bool all_loaded)
      : statics_(statics), model_(model), sides_(sides), cell_(statics) {
    const bool clearances = std::any_of(mechanism.joints.begin(), mechanism.joints.end(),
                                        [](const mechanism::Joint& joint) { return joint.clearance.has_value(); });
    jumps_ = clearances && all_loaded;
  }

  void add(const loci::pose::CellZone& cells, const PoseZones& map, PoseZone& zone) {
    const double width = map.upper[0] - map.lower[0];
    for (std::size_t end = 0; end < 2; ++end) {
      if (cells.at_ends[end].empty()) continue;
      const double at = end == 0 ? zone.lower[0] : zone.upper[0];
      if (at <= map.lower[0] || at >= map.upper[0]) continue;
      zone.ends.push_back(end_at(at, beside * width, cells.at_ends[end]));
    }
  }

 private:
  static constexpr double beside = 1e-8;  ///< of the range: more than the finest cells

  core::PoseZoneEnd end_at(double at, double apart, const std::set<std::pair<Doubt, int>>& open) {
    core::PoseZoneEnd own;
    own.at = at;
    const std::vector<double> before = {at - apart}, behind = {at + apart};
    const auto holds = [&](Doubt doubt) {
      return std::any_of(open.begin(), open.end(), [&](const auto& one) { return one.first == doubt; });
    };
    if (holds(Doubt::workspace)) {
      own.kind = core::LocusKind::workspace_boundary;
      return own;
    }
    if (holds(Doubt::singularity)) {
      own.kind = core::LocusKind::direct_singularity;
      return own;
    }
    bool first = true;
    for (const bool turning : {true, false}) {
      if (!own.reactions.empty()) break;
      // Of those that only may vanish none is told where others do.
      for (const auto& [doubt, demand] : open) {
        if (turning && !turns(cell_, before, behind, demand)) continue;
        const core::PoseZoneBound bound = bound_of(statics_, doubt, demand);
        own.reactions.push_back(bound.reactions.front());
        own.kind = first ? bound.kind : std::min(own.kind, bound.kind);
        first = false;
      }
    }
    add_jump(own, before.front(), behind.front());
    return own;
  }

  void add_jump(core::PoseZoneEnd& own, double before, double behind) const {
    if (!jumps_ || (own.kind != core::LocusKind::contact_loss && own.kind != core::LocusKind::backlash)) return;
    const std::array<double, 2> poses = {before, behind};
    const numeric::ErrorSamples errors = numeric::error_samples(model_, poses, sides_, true, false);
    // A difference this much smaller than the errors is no jump, but rounding and the way between the two poses.
    constexpr double least_jump = 1e-6;
    const mechanism::Space space = model_.mechanism.space;
    const PoseError first = error_of(space, errors.error[0]);
    PoseError jump = error_of(space, errors.error[1]);
    bool finite = true;
    const auto subtract = [&](std::vector<double>& parts, const std::vector<double>& first_parts, double scale) {
      for (std::size_t c = 0; c < parts.size(); ++c) {
        parts[c] -= first_parts[c];
        if (std::abs(parts[c]) < least_jump * scale) parts[c] = 0;
        finite = finite && std::isfinite(parts[c]);
      }
    };
    subtract(jump.displacement, first.displacement, errors.error[0].dp.norm());
    // A platform that cannot turn does so by rounding: by a displacement's last digits over a metre.
    constexpr double least_turn = 1e-6;  // 1/m
    subtract(jump.rotation, first.rotation,
             std::max(errors.error[0].dalpha.norm(), least_turn * errors.error[0].dp.norm()));
    if (finite) own.jump = std::move(jump);
  }

  const core::PoseStatics& statics_;
  const numeric::NumericModel& model_;
  const DyadSides& sides_;
  PoseCell cell_;
  bool jumps_ = false;
};

/// Zones on a side of a fold on which a link bends are out of reach: on one side links are rigid or bend all over it,
/// so that one pose tells.
void leave_rigid(loci::pose::CellZones& found, const numeric::NumericModel& model, const DyadSides& sides) {
  std::vector<std::size_t> place(found.zones.size(), found.zones.size());  // among those that stay
  std::vector<loci::pose::CellZone> kept;
  for (std::size_t z = 0; z < found.zones.size(); ++z) {
    const numeric::Posture posture = numeric::posture(model, found.zones[z].sample, sides);
    if (posture.broken && !posture.unreachable) {
      found.outside += found.zones[z].at_least;
      continue;
    }
    place[z] = kept.size();
    kept.push_back(std::move(found.zones[z]));
  }
  for (loci::pose::CellZone& zone : kept) {
    std::set<std::size_t> perhaps;
    for (const std::size_t other : zone.perhaps)
      if (place[other] < place.size()) perhaps.insert(place[other]);
    zone.perhaps = std::move(perhaps);
  }
  for (int& label : found.raster) {
    if (label <= 0) continue;
    const std::size_t own = place[static_cast<std::size_t>(label) - 1];
    label = own < place.size() ? static_cast<int>(own) + 1 : -1;
  }
  found.zones = std::move(kept);
}

/// A crank that turns on: where the range is a full turn, its first and last zone are one.
void note_meeting_ends(PoseZones& map) {
  constexpr double of_turn = 1e-12;  // roundings of the range's ends
  if (std::abs(map.upper[0] - map.lower[0] - 2 * std::numbers::pi) > of_turn) return;
  const PoseZone *first = nullptr, *last = nullptr;
  for (const PoseZone& zone : map.zones) {
    if (zone.lower[0] == map.lower[0]) first = &zone;
    if (zone.upper[0] == map.upper[0]) last = &zone;
  }
  if (first != nullptr && last != nullptr && first != last)
    map.notes.push_back("the range is a full turn: " + first->id + " and " + last->id + " meet where it begins anew");
}

}  // namespace

PoseZones find_pose_zones(const mechanism::Mechanism& mechanism, const LociRequest& request, long cells) {
  if (const std::optional<Framed> own = framed(mechanism, Scaling::none))
    return from_frame(find_pose_zones(own->mechanism, request, cells), mechanism, own->frame);
  require_coordinates(mechanism, 1, 3, "zones are cut");
  if (request.all_working_modes || request.working_modes.size() > 1)
    throw core::InputError({.file = "--working-mode"}, "zones by cells are those of one working mode",
                           "give one side for each dyad, and ask once for each mode");
  const DyadSides sides = requested_modes(mechanism, request).front();
  PoseZones result;
  result.mechanism = mechanism.name;
  result.units = mechanism.units;
  result.notes = mechanism::notes_of(mechanism);
  for (const mechanism::Coordinate& c : mechanism.coordinates) {
    result.coordinates.push_back(c.name);
    result.angles.push_back(c.angle);
    result.lower.push_back(core::to_double(c.lower));
    result.upper.push_back(core::to_double(c.upper));
  }
  result.working_mode = side_names(mechanism, sides);
  constexpr std::size_t poses = 24;
  std::vector<numeric::NumericModel> models;
  models.push_back(numeric::compile(mechanism));
  const std::vector<core::TaskDemand> wanted = demands_of(mechanism, request);
  const core::PoseStatics statics = symbolic::pose_statics(
      {&mechanism}, sides,
      loaded_demands(models, sides, wanted, mechanism::spread_poses(mechanism, poses), result.notes));
  if (request.progress) request.progress(0, "cells");
  loci::pose::CellZoneEffort effort;
  effort.most_cells = cells;
  effort.deadline = request.deadline;
  // The ends of intervals are as good as points; of more coordinates, bounds are wanted that are close enough.
  if (result.lower.size() == 1) effort.enough_doubt = 0;
  effort.raster.assign(result.lower.size(), raster_of(result.lower.size()));
  loci::pose::CellZones found = loci::pose::cell_zones(statics, result.lower, result.upper, effort);
  leave_rigid(found, models.front(), sides);
  result.outside = found.outside;
  result.in_doubt = found.in_doubt;
  result.cells = found.cells;
  result.complete = !found.out_of_time;
  result.grid = effort.raster;
  PoseCell cell(statics);
  Ends ends(mechanism, statics, models.front(), sides, statics.demands.size() == wanted.size());
  for (std::size_t z = 0; z < found.zones.size(); ++z) {
    loci::pose::CellZone& own = found.zones[z];
    PoseZone zone;
    zone.id = "z" + std::to_string(z + 1);
    zone.at_least = own.at_least;
    zone.at_most = own.at_most;
    zone.lower = own.lower;
    zone.upper = own.upper;
    zone.sample = own.sample;
    zone.at_side = own.at_side;
    for (const std::size_t other : own.perhaps) zone.perhaps_one_with.push_back("z" + std::to_string(other + 1));
    if (const auto ball = loci::pose::largest_ball(own, z, found.raster, effort.raster, result.lower, result.upper))
      zone.ball = core::PoseZoneBall{ball->centre, ball->radius};
    zone.faces = std::move(own.faces);
    for (const auto& [doubt, demand] : own.bounds) zone.bounds.push_back(bound_of(statics, doubt, demand));
    add_signs(statics, models.front(), sides, cell, zone);
    if (result.coordinates.size() == 1) ends.add(own, result, zone);
    result.zones.push_back(std::move(zone));
  }
  result.labels = std::move(found.raster);
  if (result.coordinates.size() == 1 && result.angles.front()) note_meeting_ends(result);
  return result;
}

PoseZones find_pose_zones(const Model& model, const LociRequest& request, long cells) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  check_request(mechanism, request);
  return find_pose_zones(mechanism, request, cells);
}

}  // namespace clearloci
