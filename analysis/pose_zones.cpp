#include "analysis/pose_zones.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/error.hpp"
#include "analysis/model.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/side_names.hpp"
#include "analysis/task_demands.hpp"
#include "core/errors.hpp"
#include "loci/pose/largest_ball.hpp"
#include "loci/pose/pose_zones.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/posture_sample.hpp"
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

/// What ends the zones over one coordinate.
void add_ends(const mechanism::Mechanism& mechanism, const LociRequest& request, const DyadSides& sides,
              PoseZones& map) {
  std::vector<core::ErrorEvent> events;
  const bool clearances = std::any_of(mechanism.joints.begin(), mechanism.joints.end(),
                                      [](const mechanism::Joint& joint) { return joint.clearance.has_value(); });
  if (mechanism.space == mechanism::Space::planar && clearances) {
    ErrorRequest asked;
    asked.steps = 1;
    asked.worst_case = false;
    asked.loci = request;
    const core::CoordinateErrors errors = coordinate_errors(mechanism, asked);
    for (const core::CoordinateModeErrors& own : errors.modes)
      if (own.mode == mode_of(sides, errors.loci.tower)) events = own.events;
  } else {
    const core::LocusMap loci = trace_loci(mechanism, request);
    for (const core::IsolatedPoint& point : loci.isolated_points)
      if (point.mode == mode_of(sides, loci.tower)) events.push_back({point});
  }
  const double near = 1e-7 * (map.upper[0] - map.lower[0]);  // cells part loci from zones far closer
  for (PoseZone& zone : map.zones)
    for (const double end : {zone.lower[0], zone.upper[0]})
      for (const core::ErrorEvent& event : events)
        if (std::abs(event.point.at.front() - end) <= near)
          zone.ends.push_back({event.point.at.front(), event.point.kind, event.point.vanishing, event.jumps, event.dx,
                               event.dy, event.dalpha});
}

}  // namespace

PoseZones find_pose_zones(const mechanism::Mechanism& mechanism, const LociRequest& request, long cells) {
  require_coordinates(mechanism, 1, 3, "zones are cut");
  if (request.all_working_modes || request.working_modes.size() > 1)
    throw core::InputError({.file = "--working-mode"}, "zones by cells are those of one working mode",
                           "give one side for each dyad, and ask once for each mode");
  const DyadSides sides = requested_modes(mechanism, request).front();
  PoseZones result;
  result.mechanism = mechanism.name;
  result.units = mechanism.units;
  result.notes = mechanism::idle_notes(mechanism);
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
  const core::PoseStatics statics =
      symbolic::pose_statics({&mechanism}, sides,
                             loaded_demands(models, sides, demands_of(mechanism, request),
                                            mechanism::spread_poses(mechanism, poses), result.notes));
  if (request.progress) request.progress(0, "cells");
  loci::pose::CellZoneEffort effort;
  effort.most_cells = cells;
  effort.deadline = request.deadline;
  // The ends of intervals are as good as points; of more coordinates, bounds are wanted that are close enough.
  if (result.lower.size() == 1) effort.enough_doubt = 0;
  effort.raster.assign(result.lower.size(), raster_of(result.lower.size()));
  loci::pose::CellZones found = loci::pose::cell_zones(statics, result.lower, result.upper, effort);
  result.outside = found.outside;
  result.in_doubt = found.in_doubt;
  result.cells = found.cells;
  result.complete = !found.out_of_time;
  result.grid = effort.raster;
  PoseCell cell(statics);
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
    result.zones.push_back(std::move(zone));
  }
  result.labels = std::move(found.raster);
  if (result.coordinates.size() == 1) try {
      add_ends(mechanism, request, sides, result);
    } catch (const core::LimitReached&) {
      result.notes.emplace_back("the loci that end the zones could not be named within the time limit");
    }
  return result;
}

PoseZones find_pose_zones(const Model& model, const LociRequest& request, long cells) {
  return find_pose_zones(model.content().mechanism, request, cells);
}

}  // namespace clearloci
