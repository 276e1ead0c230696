#include <utility>

#include "analysis/error.hpp"
#include "analysis/framed.hpp"
#include "analysis/model.hpp"
#include "analysis/request_limits.hpp"
#include "analysis/side_names.hpp"
#include "analysis/singular_modes.hpp"
#include "mechanism/fits.hpp"
#include "mechanism/notes.hpp"
#include "numeric/error_map.hpp"

namespace clearloci {

VolumeErrors error_volume(const mechanism::Mechanism& mechanism, const ErrorRequest& request) {
  require_coordinates(mechanism, 3, 3, "volumes of errors are filled");
  if (const std::optional<Framed> own = framed_where_far(mechanism))
    return from_frame(error_volume(own->mechanism, request), mechanism);
  const numeric::NumericModel model = numeric::compile(mechanism);
  VolumeErrors errors;
  errors.units = mechanism.units;
  errors.notes = mechanism::fit_notes(mechanism);
  for (std::string& note : mechanism::notes_of(mechanism)) errors.notes.push_back(std::move(note));
  for (const DyadSides& sides : regular_modes(mechanism, requested_modes(mechanism, request.loci), errors.notes)) {
    if (request.loci.progress) request.loci.progress(0, "errors");
    numeric::ErrorVolume found = numeric::error_volume(
        model, sides, {.cells = request.cells, .worst_case = request.worst_case, .deadline = request.loci.deadline});
    core::VolumeModeErrors own;
    own.mode = side_names(mechanism, sides);
    own.volume = std::move(found.volume);
    for (const core::Field& field : own.volume.fields) own.sizes.push_back(sizes_of(field.values));
    own.reachable = found.reachable;
    own.undefined = found.undefined;
    own.never_loaded = std::move(found.never_loaded);
    errors.modes.push_back(std::move(own));
  }
  return errors;
}

VolumeErrors error_volume(const Model& model, const ErrorRequest& request) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  check_request(mechanism, request);
  return error_volume(mechanism, request);
}

}  // namespace clearloci
