// clearloci/export.hpp over the registry of formats.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/loci.hpp"
#include "analysis/model.hpp"
#include "analysis/zones.hpp"
#include "clearloci/export.hpp"
#include "core/errors.hpp"
#include "report/error.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/loci_table.hpp"
#include "report/pose.hpp"
#include "report/trajectory.hpp"
#include "report/validation.hpp"
#include "report/verification.hpp"
#include "report/wording.hpp"
#include "report/zones.hpp"

namespace clearloci {
namespace {

void check(const std::set<std::string>& wanted, const std::vector<std::string>& allowed) {
  for (const std::string& name : wanted)
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
      throw core::InputError({}, fmt::format("the answer is not written as '{}'", name),
                             fmt::format("choose from {}", fmt::join(allowed, ", ")));
}

/// An answer that no question gave, such as a LocusMap that a caller has just made, says nothing that could be written.
void require(bool said, const std::string& what) {
  if (!said) throw core::InputError({}, what + " is empty: no question gave it", "hand over what a function answered");
}
const LocusMap& told(const LocusMap& loci) {
  const std::size_t count = loci.tower.coordinates.size();
  require(count > 0 && loci.lower.size() == count && loci.upper.size() == count, "the map of loci");
  return loci;
}
const Zones& told(const Zones& zones) {
  told(zones.loci);
  return zones;
}
const Verification& told(const Verification& answer) {
  require(!answer.coordinates.empty(), "the verification");
  return answer;
}
const Errors& told(const Errors& errors) {
  require(!errors.modes.empty(), "the map of errors");
  return errors;
}
const TrajectoryResult& told(const TrajectoryResult& result) {
  require(!result.samples.columns.empty() && !result.samples.columns.front().empty(), "the trajectory");
  return result;
}

std::vector<std::string> formats_of(const Zones& zones) {
  return report::zone_formats(zones.loci.tower.coordinates.size(), zones.by_cells);
}
std::vector<std::string> formats_of(const Errors& errors) {
  return report::error_formats(told(errors).modes.front().map.dimension());
}

/// Throws InputError for a layer that the errors do not have.
report::ErrorSheet sheet_of(const Errors& errors, const std::vector<FieldSlice>& slices) {
  const core::FieldMap& map = told(errors).modes.front().map;
  for (const FieldSlice& slice : slices)
    if (map.dimension() != 3 || slice.across >= 3 || slice.layer >= map.axes[slice.across].size())
      throw core::InputError({}, "the errors have no such slice", "give layers of cells over three coordinates");
  return {errors, slices};
}

using Paths = std::vector<std::filesystem::path>;

template <class Answer>
Paths write_checked(const Answer& answer, const std::filesystem::path& folder, const std::set<std::string>& formats,
                    const std::vector<std::string>& allowed = report::format_names<Answer>()) {
  check(formats, allowed);
  return report::write_answer(answer, folder, formats);
}

template <class Answer>
std::vector<ExportedFile> files_checked(const Answer& answer, const std::set<std::string>& formats,
                                        const std::vector<std::string>& allowed = report::format_names<Answer>()) {
  check(formats, allowed);
  std::vector<ExportedFile> files;
  for (report::File& file : report::files_of(answer, formats))
    files.push_back({std::move(file.name), std::move(file.bytes)});
  return files;
}

}  // namespace

std::vector<std::string> loci_formats(std::size_t coordinates) {
  std::vector<std::string> names = report::format_names<report::LociSheet>();
  std::erase_if(names, [&](const std::string& name) { return !report::can_hold(name, coordinates); });
  return names;
}
std::vector<std::string> zone_formats(const Model& model) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  return report::zone_formats(mechanism.coordinates.size(), has_zones_by_cells(mechanism));
}
std::vector<std::string> verification_formats() { return report::format_names<Verification>(); }
std::vector<std::string> error_formats(std::size_t coordinates) { return report::error_formats(coordinates); }
std::vector<std::string> trajectory_formats() { return report::format_names<TrajectoryResult>(); }

Paths export_to(const Model& model, const LocusMap& loci, const std::filesystem::path& folder,
                const std::set<std::string>& formats) {
  told(loci);
  check(formats, loci_formats(loci.tower.coordinates.size()));
  return report::write_loci({loci, sample_sketches(model.content().mechanism, loci)}, folder, formats);
}
Paths export_to(const Zones& zones, const std::filesystem::path& folder, const std::set<std::string>& formats) {
  return write_checked(told(zones), folder, formats, formats_of(zones));
}
Paths export_to(const Verification& answer, const std::filesystem::path& folder, const std::set<std::string>& formats) {
  return write_checked(told(answer), folder, formats);
}
Paths export_to(const Errors& errors, const std::filesystem::path& folder, const std::set<std::string>& formats,
                const std::vector<FieldSlice>& slices) {
  return write_checked(sheet_of(errors, slices), folder, formats, formats_of(errors));
}
Paths export_to(const TrajectoryResult& result, const std::filesystem::path& folder,
                const std::set<std::string>& formats) {
  return write_checked(told(result), folder, formats);
}

std::vector<ExportedFile> files_of(const Model& model, const LocusMap& loci, const std::set<std::string>& formats) {
  const std::vector<core::ModeSketch> sketches = sample_sketches(model.content().mechanism, told(loci));
  return files_checked(report::LociSheet{loci, sketches}, formats, loci_formats(loci.tower.coordinates.size()));
}
std::vector<ExportedFile> files_of(const Zones& zones, const std::set<std::string>& formats) {
  return files_checked(told(zones), formats, formats_of(zones));
}
std::vector<ExportedFile> files_of(const Verification& answer, const std::set<std::string>& formats) {
  return files_checked(told(answer), formats);
}
std::vector<ExportedFile> files_of(const Errors& errors, const std::set<std::string>& formats,
                                   const std::vector<FieldSlice>& slices) {
  return files_checked(sheet_of(errors, slices), formats, formats_of(errors));
}
std::vector<ExportedFile> files_of(const TrajectoryResult& result, const std::set<std::string>& formats) {
  return files_checked(told(result), formats);
}

using report::json_text;
std::string to_json(const LocusMap& loci) { return json_text(report::loci_object(told(loci))); }
std::string to_json(const Zones& zones) { return json_text(report::zones_object(told(zones))); }
std::string to_json(const Verification& answer) { return json_text(report::verification_object(told(answer))); }
std::string to_json(const Errors& errors) { return json_text(report::error_object(told(errors))); }
std::string to_json(const TrajectoryResult& result) { return json_text(report::trajectory_object(told(result))); }
std::string to_json(const Pose& pose) { return json_text(report::pose_object(pose)); }
std::string to_json(const PoseInModes& poses) { return json_text(report::pose_in_modes_object(poses)); }
std::string to_json(const Validation& validation) { return json_text(report::validation_object(validation)); }

std::string to_table(const LocusMap& loci) { return report::loci_table(told(loci)); }
std::string to_table(const Zones& zones) { return report::zones_table(told(zones)); }
std::string to_text(const Verification& answer) { return report::verification_text(told(answer)); }
std::string to_text(const Errors& errors) { return report::error_text(told(errors)); }
std::string to_text(const TrajectoryResult& result) { return report::trajectory_text(told(result)); }
std::string to_text(const Pose& pose) { return report::pose_text(pose); }
std::string to_text(const PoseInModes& poses) { return report::pose_in_modes_text(poses); }
std::string to_text(const Validation& validation) { return report::validation_text(validation); }

std::vector<WorkingMode> modes_of(const LocusMap& loci) { return report::modes_of(loci); }
std::vector<WorkingMode> modes_of(const Zones& zones) { return report::modes_of_zones(zones); }

std::string to_svg(const LocusMap& loci, const WorkingMode& mode) {
  return report::picture(told(loci), mode, nullptr, report::PictureFormat::svg);
}
std::string to_svg(const Zones& zones, const WorkingMode& mode) {
  return report::zone_picture(told(zones), mode, report::PictureFormat::svg);
}
std::string to_svg(const Verification& answer) {
  return report::verification_picture(told(answer), report::PictureFormat::svg);
}

}  // namespace clearloci
