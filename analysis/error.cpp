#include "analysis/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/framed.hpp"
#include "analysis/model.hpp"
#include "analysis/request_limits.hpp"
#include "analysis/singular_modes.hpp"
#include "analysis/zone_errors.hpp"
#include "analysis/zones.hpp"
#include "core/errors.hpp"
#include "mechanism/fits.hpp"
#include "mechanism/group_closing.hpp"
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

std::vector<std::optional<ErrorSizes>> sizes_in(const core::FieldMap& map, const std::vector<std::size_t>* cells) {
  std::vector<std::optional<ErrorSizes>> sizes;
  for (const core::Field& field : map.fields) sizes.push_back(sizes_of(field.values, cells));
  return sizes;
}

ModeErrors mode_errors(const numeric::NumericModel& model, const DyadSides& sides, const ErrorRequest& request) {
  numeric::ErrorMap found =
      numeric::error_map(model, sides, {.nx = request.nx, .ny = request.ny, .worst_case = request.worst_case});
  ModeErrors own;
  own.map = std::move(found.map);
  own.sizes = sizes_in(own.map, nullptr);
  own.reachable = found.reachable;
  own.undefined = found.undefined;
  own.never_loaded = std::move(found.never_loaded);
  return own;
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

core::LocusMap loci_below(const mechanism::Mechanism& mechanism, const ErrorRequest& request) {
  // Those of points that close together are known over one coordinate.
  const bool known = mechanism.groups.empty() || mechanism.coordinates.size() == 1;
  if (request.with_loci && known) return with_modes(mechanism, trace_loci(mechanism, request.loci));
  core::LocusMap none = empty_map(mechanism);
  if (request.with_loci)
    none.notes.push_back("no loci are drawn: the points of group " + mechanism.groups.front().name + " close together");
  return none;
}

core::WorkingMode mode_in(const core::LocusMap& loci, const DyadSides& sides) {
  return loci.tower.roots.empty() ? sides : mode_of(sides, loci.tower);
}

ErrorMap error_map(const mechanism::Mechanism& mechanism, const ErrorRequest& request) {
  if (request.with_zones && !request.with_loci)
    throw core::InputError({mechanism.file}, "zones are bounded by the loci", "ask for the loci too");
  require_coordinates(mechanism, 2, 2, "maps of errors are drawn");
  if (request.with_zones)
    mechanism::require_closed_forms(mechanism, "errors zone by zone are told", "ask without zones");
  if (request.with_zones && !mechanism::is_plane(mechanism))
    throw core::InputError({mechanism.file}, "errors zone by zone are those over two lengths", "ask without zones");
  if (const std::optional<Framed> own = framed_where_far(mechanism))
    return from_frame(error_map(own->mechanism, request), mechanism, own->frame);
  const numeric::NumericModel model = numeric::compile(mechanism);
  ErrorMap errors;
  errors.notes = mechanism::fit_notes(mechanism);
  for (std::string& note : mechanism::notes_of(mechanism)) errors.notes.push_back(std::move(note));
  core::Zones zones;
  if (request.with_zones) zones = find_zones(mechanism, {request.loci});
  errors.loci = request.with_zones ? with_modes(mechanism, std::move(zones.loci)) : loci_below(mechanism, request);
  for (const DyadSides& sides : regular_modes(mechanism, requested_modes(mechanism, request.loci), errors.loci.notes)) {
    if (request.loci.progress) request.loci.progress(0.9, "errors");
    ModeErrors own = mode_errors(model, sides, request);
    own.mode = mode_in(errors.loci, sides);
    for (const core::Zone& zone : zones.zones) {
      if (zone.mode != own.mode) continue;
      std::vector<std::size_t> cells = cells_in(zone, own.map);
      std::vector<std::optional<ErrorSizes>> sizes = sizes_in(own.map, &cells);
      own.zones.push_back({zone.id, std::move(cells), std::move(sizes)});
    }
    errors.modes.push_back(std::move(own));
  }
  return errors;
}

ErrorMap error_map(const Model& model, const ErrorRequest& request) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  check_request(mechanism, request);
  return error_map(mechanism, request);
}

}  // namespace clearloci
