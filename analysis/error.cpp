#include "analysis/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/coordinate_errors.hpp"
#include "analysis/flanks.hpp"
#include "analysis/framed.hpp"
#include "analysis/model.hpp"
#include "analysis/pose.hpp"
#include "analysis/request_limits.hpp"
#include "analysis/singular_modes.hpp"
#include "analysis/zone_errors.hpp"
#include "analysis/zones.hpp"
#include "core/errors.hpp"
#include "mechanism/fits.hpp"
#include "mechanism/notes.hpp"
#include "mechanism/read_task.hpp"
#include "numeric/error_map.hpp"

namespace clearloci {
namespace {

/// A map that a time limit ended before there was a tower of roots has no working modes to name; the errors have.
core::LocusMap with_modes(const mechanism::Mechanism& mechanism, core::LocusMap loci) {
  if (loci.out_of_time && loci.tower.roots.empty()) loci.tower.roots = empty_map(mechanism).tower.roots;
  return loci;
}

/// The loci that are drawn over the errors, or a map without any, complete with the names of the working modes.
core::LocusMap loci_below(const mechanism::Mechanism& mechanism, const ErrorRequest& request) {
  if (request.with_loci && mechanism.coordinates.size() < 3)
    return with_modes(mechanism, trace_loci(mechanism, request.loci));
  return empty_map(mechanism);
}

std::vector<std::optional<ErrorSizes>> sizes_in(const core::FieldMap& map, const std::vector<std::size_t>* cells) {
  std::vector<std::optional<ErrorSizes>> sizes;
  for (const core::Field& field : map.fields) sizes.push_back(sizes_of(field.values, cells));
  return sizes;
}

ModeErrors grid_errors(const numeric::NumericModel& model, const DyadSides& sides, const ErrorRequest& request) {
  numeric::ErrorMap found = numeric::error_map(
      model, sides, {.cells = request.grid, .worst_case = request.worst_case, .deadline = request.loci.deadline});
  ModeErrors errors;
  errors.map = std::move(found.map);
  errors.reachable = found.reachable;
  errors.undefined = found.undefined;
  errors.never_loaded = std::move(found.never_loaded);
  return errors;
}

void add_zones(const core::Zones& zones, const DyadSides& sides, ModeErrors& errors) {
  const core::WorkingMode mode = mode_in(zones.loci, sides);
  for (std::size_t z = 0; z < zones.zones.size(); ++z) {
    if (zones.zones[z].mode != mode) continue;
    std::vector<std::size_t> cells = cells_in(zones, z, errors.map);
    std::vector<std::optional<ErrorSizes>> sizes = sizes_in(errors.map, &cells);
    errors.zones.push_back({zones.zones[z].id, std::move(cells), std::move(sizes)});
  }
}

void check_zones(const mechanism::Mechanism& mechanism, const ErrorRequest& request) {
  if (request.with_zones && !request.with_loci && mechanism::is_plane(mechanism))
    throw core::InputError({mechanism.file}, "zones are bounded by the loci", "ask for the loci too");
}

}  // namespace

std::optional<ErrorSizes> sizes_of(const std::vector<double>& values, const std::vector<std::size_t>* which) {
  std::vector<double> sizes;
  std::size_t at = 0;
  double largest = -1;
  for (std::size_t i = 0; i < (which != nullptr ? which->size() : values.size()); ++i) {
    const std::size_t k = which != nullptr ? (*which)[i] : i;
    const double size = std::abs(values[k]);
    if (!std::isfinite(size)) continue;
    sizes.push_back(size);
    if (size > largest) {
      largest = size;
      at = k;
    }
  }
  if (sizes.empty()) return std::nullopt;
  std::sort(sizes.begin(), sizes.end());
  const auto part = [&](double p) {
    return sizes[static_cast<std::size_t>(p * static_cast<double>(sizes.size() - 1))];
  };
  return ErrorSizes{part(0.5), part(0.9), part(0.99), values[at], at};
}

core::WorkingMode mode_in(const core::LocusMap& loci, const DyadSides& sides) {
  return loci.tower.roots.empty() ? sides : mode_of(sides, loci.tower);
}

std::vector<int> error_grid(const ErrorRequest& request, std::size_t coordinates) {
  if (!request.grid.empty()) return request.grid;
  return coordinates == 1 ? std::vector<int>{720} : std::vector<int>(coordinates, coordinates == 2 ? 400 : 40);
}

Errors find_errors(const mechanism::Mechanism& mechanism, const ErrorRequest& given) {
  require_coordinates(mechanism, 1, 3, "errors are mapped");
  check_zones(mechanism, given);
  if (const std::optional<Framed> inside = framed_where_far(mechanism))
    return from_frame(find_errors(inside->mechanism, given), mechanism, inside->frame);
  ErrorRequest request = given;
  request.grid = error_grid(given, mechanism.coordinates.size());
  const numeric::NumericModel model = numeric::compile(mechanism);
  Errors errors;
  errors.grid = request.grid;
  for (const mechanism::Joint& joint : mechanism.joints) errors.joints.push_back(joint.name);
  errors.notes = mechanism::fit_notes(mechanism);
  for (std::string& note : mechanism::notes_of(mechanism)) errors.notes.push_back(std::move(note));
  if (meshes(mechanism))
    errors.notes.emplace_back(
        "only poses in which the teeth of gears push on the flanks of the working mode and no span of a belt is slack");
  core::Zones zones;
  if (request.with_zones)
    zones = find_zones(mechanism, {.loci = request.loci, .cells = request.zone_cells, .grid = request.grid});
  if (request.with_zones && !zones.by_cells)
    errors.loci = with_modes(mechanism, zones.loci);
  else
    errors.loci = loci_below(mechanism, request);
  if (zones.loci.out_of_time) errors.loci.complete = false, errors.loci.out_of_time = true;
  // Where the loci took all of the time, the errors are still worth having.
  if (errors.loci.out_of_time) request.loci.deadline.reset();
  for (const DyadSides& sides : regular_modes(mechanism, requested_modes(mechanism, request.loci), errors.notes)) {
    if (request.loci.progress) request.loci.progress(request.with_loci || request.with_zones ? 0.9 : 0, "errors");
    ModeErrors mode = mechanism.coordinates.size() == 1 ? coordinate_errors(model, sides, errors.loci, request)
                                                        : grid_errors(model, sides, request);
    mode.mode = mode_in(errors.loci, sides);
    mode.sizes = sizes_in(mode.map, nullptr);
    add_zones(zones, sides, mode);
    errors.modes.push_back(std::move(mode));
  }
  if (std::all_of(errors.modes.begin(), errors.modes.end(), [](const ModeErrors& mode) { return mode.reachable == 0; }))
    errors.notes.push_back(words_of_no_pose(mechanism, "no pose of the grid is reached"));
  return errors;
}

Errors find_errors(const Model& model, const ErrorRequest& request) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  check_request(mechanism, request);
  return find_errors(mechanism, request);
}

}  // namespace clearloci
