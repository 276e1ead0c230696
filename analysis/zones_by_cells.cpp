#include "analysis/zones_by_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "analysis/flanks.hpp"
#include "analysis/framed.hpp"
#include "analysis/group_sheets.hpp"
#include "analysis/pose.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/request_limits.hpp"
#include "analysis/singular_modes.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/verification.hpp"
#include "core/errors.hpp"
#include "loci/zones/zones.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/known_lines.hpp"
#include "mechanism/notes.hpp"
#include "mechanism/posture_sample.hpp"
#include "numeric/error_samples.hpp"
#include "numeric/reactions.hpp"
#include "symbolic/pose_statics.hpp"

namespace clearloci {
namespace {

using core::Zone;
using core::Zones;
using loci::pose::Doubt;
using loci::pose::PoseCell;

core::ZoneBorder border_of(const mechanism::Mechanism& mechanism, const core::PoseStatics& statics, Doubt doubt,
                           int demand) {
  if (doubt == Doubt::workspace) return {.kind = core::LocusKind::workspace_boundary};
  if (doubt == Doubt::singularity) return {.kind = core::LocusKind::direct_singularity};
  core::TaskDemand task_demand = statics.demands[static_cast<std::size_t>(demand)].demand;
  if (doubt == Doubt::zero) task_demand.least = 0;
  core::ZoneBorder border{.kind = locus_kind_of(task_demand),
                          .vanishing = {{task_demand.joint, task_demand.quantity, 1}}};
  if (task_demand.bound)
    border.cause =
        mechanism::words_of_bound(mechanism::joint_named(mechanism, task_demand.joint), task_demand.bound->at);
  return border;
}

bool is_of_pin(const mechanism::Mechanism& mechanism, const core::TaskDemand& demand) {
  const mechanism::Joint& joint = mechanism::joint_named(mechanism, demand.joint);
  return demand.quantity == core::Quantity::f && mechanism::traits(joint).pinned &&
         !mechanism::is_slot(mechanism, joint);
}

/// Of |A| and of what has one component, at the zone's sample: they are those of all of it.
void add_signs(const core::PoseStatics& statics, const numeric::NumericModel& model, const DyadSides& sides,
               PoseCell& cell, Zone& zone) {
  const auto at = cell.at(zone.sample);
  if (!at) return;
  const numeric::Bounded determinant = numeric::bounded_numerators(model, zone.sample, sides).determinant;
  // Of a group that continuation did not lead to the sample it is not told.
  zone.assembly_mode = determinant.value > 0 ? 1 : determinant.value < 0 ? -1 : 0;
  for (std::size_t d = 0; d < statics.demands.size(); ++d) {
    const std::vector<double>& component = at->components[d].front();
    const core::TaskDemand& demand = statics.demands[d].demand;
    // The part of a pin's force along its line has the sign of whichever way the line was read.
    if (component.size() == 1 && !demand.bound && !is_of_pin(model.mechanism, demand))
      zone.signs.emplace_back(core::Vanishing{demand.joint, demand.quantity, 1}, component[0] > 0   ? 1
                                                                                 : component[0] < 0 ? -1
                                                                                                    : 0);
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

/// The size of what is in doubt at an end, N, N m or what it is of; infinite at a pose that is not assembled or
/// singular.
double size_at(PoseCell& cell, const std::vector<double>& pose, int demand) {
  const auto at = cell.at(pose);
  if (!at) return std::numeric_limits<double>::infinity();
  double squares = 0;
  for (const double part : at->components[static_cast<std::size_t>(demand)].front()) squares += part * part;
  return std::sqrt(squares);
}

/// Teeth that would have to pull. Zones are cut where their force vanishes.
bool teeth_pull(const numeric::NumericModel& model, const std::vector<double>& pose, const DyadSides& sides) {
  return meshes(model.mechanism) && !numeric::reachable(model, pose, sides);
}

/// What ends the zones over one coordinate, and the end effector's jumps there: errors a hair behind less those a hair
/// before. No loci are traced for it: what is in doubt beside a zone is at its end, to the finest cells.
class Ends {
 public:
  Ends(const mechanism::Mechanism& mechanism, const core::PoseStatics& statics, const numeric::NumericModel& model,
       const DyadSides& sides, bool all_loaded, std::vector<loci::pose::SheetEnd> dead_centres)
      : statics_(statics), model_(model), sides_(sides), dead_centres_(std::move(dead_centres)), cell_(statics) {
    const bool clearances = std::any_of(mechanism.joints.begin(), mechanism.joints.end(),
                                        [](const mechanism::Joint& joint) { return joint.clearance.has_value(); });
    jumps_ = clearances && all_loaded;
  }

  /// `all`: of the mode, those out of reach included.
  void add(const loci::pose::CellZone& cells, const std::vector<loci::pose::CellZone>& all,
           const std::array<double, 2>& range, Zone& zone) {
    const double width = range[1] - range[0];
    for (std::size_t end = 0; end < 2; ++end) {
      if (cells.at_ends[end].empty()) continue;
      const double at = end == 0 ? zone.lower[0] : zone.upper[0];
      if (at <= range[0] || at >= range[1]) continue;
      const double beyond = start_beyond(all, end == 1, at, widest_doubt * width);
      const bool reach_ends = beyond == at && is_end_of_reach(at, end == 0 ? -width : width);
      zone.ends.push_back(end_at(at, beyond, beside * width, reach_ends, cells.at_ends[end]));
    }
  }

 private:
  /// Of the range: more than the finest cells; more than what rounding leaves in doubt between two zones.
  static constexpr double beside = 1e-8, widest_doubt = 1e-3;
  /// What is passed from one side of it to the other is at the end itself; in units of `beside`.
  static constexpr double widest_end = 4;

  /// Where the zone beyond an end begins; the end itself where there is none so near.
  static double start_beyond(const std::vector<loci::pose::CellZone>& all, bool upper, double at, double reach) {
    double best = at, nearest = reach;
    for (const loci::pose::CellZone& zone : all) {
      const double start = upper ? zone.lower[0] : zone.upper[0], apart = upper ? start - at : at - start;
      if (apart < 0 || apart > nearest) continue;
      nearest = apart;
      best = start;
    }
    return best;
  }

  /// `beyond`: where the next zone begins.
  core::ZoneEnd end_at(double at, double beyond, double apart, bool reach_ends,
                       const std::set<std::pair<Doubt, int>>& open) {
    core::ZoneEnd end;
    end.at = at;
    const std::vector<double> before = {std::min(at, beyond) - apart}, behind = {std::max(at, beyond) + apart};
    const auto holds = [&](Doubt doubt) {
      return std::any_of(open.begin(), open.end(), [&](const auto& one) { return one.first == doubt; });
    };
    // Where reactions grow without bound nothing tells them from zero in the last cells: what bounds them comes first,
    // unless it is elsewhere in a stretch that is in doubt.
    const Passed passed =
        std::abs(beyond - at) <= widest_end * apart ? passed_between(before, behind) : Passed::nothing;
    if (holds(Doubt::workspace) || passed == Passed::boundary || reach_ends) {
      end.kind = core::LocusKind::workspace_boundary;
      for (const double beside_it : {at - apart, at + apart})  // the one beyond the end breaks the limit
        if (end.limit.empty())
          end.limit = limit_at(model_.mechanism, model_, std::vector<double>{beside_it}, sides_, 0);
      for (const loci::pose::SheetEnd& sheet : dead_centres_)
        if (sheet.lower <= at + 0.1 * apart && sheet.upper >= at - 0.1 * apart) {
          end.cause = "dead centre of group " + statics_.program.blocks[sheet.block].name;
          end.certified = sheet.proven;
        }
      return end;
    }
    if (holds(Doubt::singularity) || passed == Passed::singularity || grows_between(before, behind, open)) {
      end.kind = core::LocusKind::direct_singularity;
      return end;
    }
    add_vanishing(end, before, behind, apart, open);
    end.limit = flank_of(end, before, behind);
    if (end.zero)
      add_jump(end, *end.zero - apart, *end.zero + apart);
    else if (std::abs(beyond - at) <= apart)
      add_jump(end, before.front(), behind.front());
    return end;
  }

  /// Where no zone is near beyond an end: whether what is in doubt there goes on to a pose out of reach. Next to one at
  /// which |A| vanishes to a high order, cells stay in doubt far from it.
  bool is_end_of_reach(double at, double outward) {
    for (double part = beside; part <= widest_doubt; part *= 2)
      if (!cell_.at({at + outward * part})) return true;
    return false;
  }

  enum class Passed : std::uint8_t { nothing, boundary, singularity };

  /// Which of both lies between two poses, as they tell.
  Passed passed_between(const std::vector<double>& before, const std::vector<double>& behind) {
    const auto one = cell_.at(before), other = cell_.at(behind);
    if (one.has_value() != other.has_value()) return Passed::boundary;
    const bool alike = one && one->orientation == other->orientation;
    return alike && one->determinant * other->determinant < 0 ? Passed::singularity : Passed::nothing;
  }

  /// Whether something in doubt turns from one pose to the other where it has no bound instead of a zero: |A| vanishes
  /// there without changing its sign.
  bool grows_between(const std::vector<double>& before, const std::vector<double>& behind,
                     const std::set<std::pair<Doubt, int>>& open) {
    constexpr double much = 10;
    return std::any_of(open.begin(), open.end(), [&](const std::pair<Doubt, int>& one) {
      const int demand = one.second;
      if (!turns(cell_, before, behind, demand)) return false;
      const double beside_it = std::max(size_at(cell_, before, demand), size_at(cell_, behind, demand));
      return size_at(cell_, {zero_between(before, behind, demand)}, demand) > much * beside_it;
    });
  }

  /// Of what may vanish at an end that which turns; where nothing does, all of it.
  void add_vanishing(core::ZoneEnd& end, const std::vector<double>& before, const std::vector<double>& behind,
                     double apart, const std::set<std::pair<Doubt, int>>& open) {
    bool elsewhere = false;
    const auto add = [&](Doubt doubt, int demand) {
      const core::ZoneBorder border = border_of(model_.mechanism, statics_, doubt, demand);
      end.kind = end.vanishing.empty() ? *border.kind : std::min(end.kind, *border.kind);
      end.vanishing.push_back(border.vanishing.front());
    };
    for (const auto& [doubt, demand] : open) {
      if (!turns(cell_, before, behind, demand)) continue;
      const double zero = zero_between(before, behind, demand);
      end.turns = true;
      if (!end.zero) end.zero = zero;
      elsewhere = elsewhere || std::abs(zero - *end.zero) > 4 * apart;
      add(doubt, demand);
    }
    if (end.vanishing.empty())
      for (const auto& [doubt, demand] : open) add(doubt, demand);
    if (!elsewhere) return;
    end.turns = false;  // where each of them vanishes is not told
    end.zero.reset();
  }

  /// Where what turns between two poses does so.
  double zero_between(const std::vector<double>& before, const std::vector<double>& behind, int demand) {
    double low = before.front(), high = behind.front();
    constexpr int halvings = 60;
    for (int k = 0; k < halvings; ++k) {
      const double middle = low + 0.5 * (high - low);
      (turns(cell_, before, {middle}, demand) ? high : low) = middle;
    }
    return high;
  }

  /// A zone ends for good where the teeth of a gear that bear nothing would have to pull beyond.
  std::string flank_of(const core::ZoneEnd& end, const std::vector<double>& before,
                       const std::vector<double>& behind) const {
    if (!teeth_pull(model_, before, sides_) && !teeth_pull(model_, behind, sides_)) return {};
    for (const core::Vanishing& what : end.vanishing)
      if (what.quantity == core::Quantity::F && has_teeth(mechanism::joint_named(model_.mechanism, what.joint)))
        return "flank of gear " + what.joint;
    return {};
  }

  void add_jump(core::ZoneEnd& end, double before, double behind) const {
    if (!jumps_ || (end.kind != core::LocusKind::contact_loss && end.kind != core::LocusKind::backlash)) return;
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
    if (finite) end.jump = std::move(jump);
  }

  const core::PoseStatics& statics_;
  const numeric::NumericModel& model_;
  const DyadSides& sides_;
  std::vector<loci::pose::SheetEnd> dead_centres_;
  PoseCell cell_;
  bool jumps_ = false;
};

/// Zones on a side of a fold on which a link bends are out of reach, as are those in which teeth would have to pull: in
/// all of a zone or nowhere, so that one pose tells.
void leave_rigid(loci::pose::CellZones& found, const numeric::NumericModel& model, const DyadSides& sides) {
  std::vector<std::size_t> place(found.zones.size(), found.zones.size());  // among those that stay
  std::vector<loci::pose::CellZone> kept;
  for (std::size_t z = 0; z < found.zones.size(); ++z) {
    const numeric::Posture posture = numeric::posture(model, found.zones[z].sample, sides);
    if ((posture.broken && !posture.unreachable) || teeth_pull(model, found.zones[z].sample, sides)) {
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
    const std::size_t new_label = place[static_cast<std::size_t>(label) - 1];
    label = new_label < place.size() ? static_cast<int>(new_label) + 1 : -1;
  }
  found.zones = std::move(kept);
}

/// Whether something that vanishes at an end of a zone over one coordinate is proven to lie between it and another one.
bool is_zero_between(const mechanism::Mechanism& mechanism, const Zone& zone, const Zone& other) {
  const bool above = other.lower[0] >= zone.upper[0];
  return std::any_of(zone.ends.begin(), zone.ends.end(), [&](const core::ZoneEnd& end) {
    return end.turns && end.at == (above ? zone.upper[0] : zone.lower[0]) &&
           std::any_of(end.vanishing.begin(), end.vanishing.end(),
                       [&](const core::Vanishing& what) { return changes_through_zero(mechanism, what); });
  });
}

/// Zones with a zero between them are not one.
void part_at_zeros(const mechanism::Mechanism& mechanism, std::span<Zone> zones) {
  for (Zone& zone : zones) {
    for (Zone& other : zones) {
      if (&zone == &other || !is_zero_between(mechanism, zone, other)) continue;
      std::erase(zone.perhaps_one_with, other.id);
      std::erase(other.perhaps_one_with, zone.id);
    }
  }
  for (Zone& zone : zones) zone.certified = zone.perhaps_one_with.empty();
}

/// A crank that turns on: where the range is a full turn, its first and last zone are one.
void note_meeting_ends(const core::WorkingMode& mode, const std::array<double, 2>& range, Zones& map) {
  if (!is_full_turn(range[0], range[1])) return;
  const Zone *first = nullptr, *last = nullptr;
  for (const Zone& zone : map.zones) {
    if (zone.mode != mode) continue;
    if (zone.lower[0] == range[0]) first = &zone;
    if (zone.upper[0] == range[1]) last = &zone;
  }
  if (first != nullptr && last != nullptr && first != last)
    map.loci.notes.push_back("the range is a full turn: " + first->id + " and " + last->id +
                             " meet where it begins anew");
}

/// What is the same in every mode.
struct Ground {
  const mechanism::Mechanism& mechanism;
  const ZoneRequest& request;
  const std::vector<numeric::NumericModel>& models;  // one
  std::vector<double> lower = {}, upper = {};
};

std::string zone_name(std::size_t place) { return "z" + std::to_string(place + 1); }

/// `before`: zones of other modes.
Zone zone_of(const mechanism::Mechanism& mechanism, const loci::pose::CellZone& cells, const core::PoseStatics& statics,
             std::size_t before) {
  Zone zone;
  zone.size = zone.at_least = cells.at_least;
  zone.at_most = cells.at_most;
  zone.lower = cells.lower;
  zone.upper = cells.upper;
  zone.sample = cells.sample;
  for (const std::size_t other : cells.perhaps) zone.perhaps_one_with.push_back(zone_name(before + other));
  zone.certified = zone.perhaps_one_with.empty();
  zone.faces = cells.faces;
  for (const auto& [doubt, demand] : cells.bounds) zone.borders.push_back(border_of(mechanism, statics, doubt, demand));
  if (cells.at_side) zone.borders.push_back({.curve = "box"});
  return zone;
}

void add_mode(const Ground& ground, const DyadSides& sides, Zones& map) {
  const LociRequest& request = ground.request.loci;
  const numeric::NumericModel& model = ground.models.front();
  constexpr std::size_t poses = 24;
  const std::vector<core::TaskDemand> wanted = demands_of(ground.mechanism, request);
  core::PoseStatics statics = symbolic::pose_statics(
      {&ground.mechanism}, sides,
      loaded_demands(ground.models, sides, wanted, mechanism::spread_poses(ground.mechanism, poses), map.loci.notes,
                     LeastSizes::are_left_out));
  const auto covered =
      cover_groups(ground.mechanism, ground.lower, ground.upper, request.deadline, statics, map.loci.notes);
  loci::pose::CellZoneEffort effort;
  effort.most_cells = ground.request.cells;
  effort.deadline = request.deadline;
  // The ends of intervals are as good as points, and so are short intervals between two of them; of more coordinates,
  // bounds are wanted that are close enough.
  if (ground.lower.size() == 1) effort.enough_doubt = 0, effort.least_part = 1e-7;
  effort.raster = map.grid;
  loci::pose::CellZones found = loci::pose::cell_zones(statics, ground.lower, ground.upper, effort);
  const std::vector<loci::pose::CellZone> all = found.zones;
  leave_rigid(found, model, sides);
  core::ZonedMode mode;
  mode.mode = mode_of(sides, map.loci.tower);
  mode.outside = found.outside;
  mode.in_doubt = found.in_doubt;
  mode.cells = found.cells;
  mode.workspace = found.in_doubt;
  for (const loci::pose::CellZone& cells : found.zones) mode.workspace += cells.at_least;
  if (found.out_of_time) map.loci.complete = false, map.loci.out_of_time = true;
  // Over one coordinate the ends of zones take next to nothing: what is in doubt beyond them is not answered.
  constexpr double of_range = 1e-3;
  if (ground.lower.size() == 1 && found.in_doubt > of_range * (ground.upper[0] - ground.lower[0]))
    map.loci.complete = false;
  const std::size_t before = map.zones.size();
  std::vector<core::TaskDemand> demands;
  for (const core::PoseDemand& demand : statics.demands) demands.push_back(demand.demand);
  PoseCell cell(statics);
  Ends ends(ground.mechanism, statics, model, sides, statics.demands.size() == wanted.size(),
            covered ? covered->ends : std::vector<loci::pose::SheetEnd>{});
  for (std::size_t z = 0; z < found.zones.size(); ++z) {
    Zone zone = zone_of(ground.mechanism, found.zones[z], statics, before);
    zone.id = zone_name(before + z);
    zone.mode = mode.mode;
    if (const auto ball =
            loci::pose::largest_ball(found.zones[z], z, found.raster, map.grid, ground.lower, ground.upper))
      zone.ball = *ball;
    add_signs(statics, model, sides, cell, zone);
    zone.too_small = too_small_at(model, demands, zone.sample, sides);
    if (ground.lower.size() == 1) ends.add(found.zones[z], all, {ground.lower[0], ground.upper[0]}, zone);
    map.zones.push_back(std::move(zone));
  }
  part_at_zeros(ground.mechanism, std::span(map.zones).subspan(before));
  mode.labels = std::move(found.raster);
  for (int& label : mode.labels)
    if (label > 0) label += static_cast<int>(before);
  if (ground.lower.size() == 1 && ground.mechanism.coordinates.front().angle)
    note_meeting_ends(mode.mode, {ground.lower[0], ground.upper[0]}, map);
  map.modes.push_back(std::move(mode));
}

}  // namespace

bool changes_through_zero(const mechanism::Mechanism& mechanism, const core::Vanishing& what) {
  return what.quantity != core::Quantity::f ||
         mechanism::keeps_to_known_line(mechanism, mechanism::joint_named(mechanism, what.joint));
}

Zones zones_by_cells(const mechanism::Mechanism& mechanism, const ZoneRequest& request) {
  if (const std::optional<Framed> scaled = framed(mechanism, Scaling::none))
    return from_frame(zones_by_cells(scaled->mechanism, request), mechanism, scaled->frame);
  require_coordinates(mechanism, 1, 3, "zones are cut");
  check_sides(mechanism, request.loci);
  Zones map;
  map.by_cells = true;
  map.loci = empty_map(mechanism);
  map.loci.notes = mechanism::notes_of(mechanism);
  std::vector<numeric::NumericModel> models;
  models.push_back(numeric::compile(mechanism));
  Ground ground{mechanism, request, models};
  for (const mechanism::Coordinate& c : mechanism.coordinates) {
    ground.lower.push_back(core::to_double(c.lower));
    ground.upper.push_back(core::to_double(c.upper));
  }
  if (!request.grid.empty() && request.grid.size() != ground.lower.size())
    throw core::InputError({}, "the grid of labels has another number of coordinates than the mechanism",
                           "give a number of cells for each");
  if (!request.grid.empty()) check_nodes(request.grid, 1);
  map.grid = request.grid;
  if (map.grid.empty()) map.grid.assign(ground.lower.size(), raster_of(ground.lower.size()));
  std::vector<DyadSides> modes = requested_modes(mechanism, request.loci);
  if (modes.size() > 1) modes = regular_modes(mechanism, modes, map.loci.notes);
  for (std::size_t m = 0; m < modes.size(); ++m) {
    if (request.loci.progress)
      request.loci.progress(static_cast<double>(m) / static_cast<double>(modes.size()), "cells");
    add_mode(ground, modes[m], map);
  }
  // The workspace is what is not proven to be out of reach.
  if (std::all_of(map.modes.begin(), map.modes.end(), [](const core::ZonedMode& mode) { return mode.workspace == 0; }))
    map.loci.notes.push_back(words_of_no_pose(mechanism));
  return map;
}

}  // namespace clearloci
