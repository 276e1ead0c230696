// clearloci/export.hpp over the registry of formats.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/loci.hpp"
#include "analysis/model.hpp"
#include "clearloci/export.hpp"
#include "core/errors.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/loci_table.hpp"
#include "report/verification.hpp"
#include "report/wording.hpp"
#include "report/zones.hpp"

namespace clearloci {
namespace {

void check(const std::set<std::string>& wanted, const std::vector<std::string>& known) {
  for (const std::string& name : wanted)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw core::InputError({}, fmt::format("the answer is not written as '{}'", name),
                             fmt::format("choose from {}", fmt::join(known, ", ")));
}

template <class Answer>
std::vector<ExportedFile> files_in(report::Files (*report::Format::*made)(const Answer&), const Answer& answer,
                                   const std::set<std::string>& names) {
  std::vector<ExportedFile> files;
  for (const report::Format& format : report::formats())
    if (format.*made != nullptr && names.contains(std::string(format.name)))
      for (report::File& file : (format.*made)(answer)) files.push_back({std::move(file.name), std::move(file.bytes)});
  return files;
}

}  // namespace

std::vector<std::string> loci_formats(std::size_t coordinates) {
  std::vector<std::string> names = report::format_names(report::Answer::loci);
  std::erase_if(names, [&](const std::string& name) { return !report::can_hold(name, coordinates); });
  return names;
}
std::vector<std::string> zone_formats() { return report::format_names(report::Answer::zones); }
std::vector<std::string> verification_formats() { return report::format_names(report::Answer::verification); }

std::vector<std::filesystem::path> export_loci(const Model& model, const LocusMap& loci,
                                               const std::filesystem::path& folder,
                                               const std::set<std::string>& formats) {
  check(formats, loci_formats(loci.tower.coordinates.size()));
  return report::write_loci({loci, sample_sketches(model.content().mechanism, loci)}, folder, formats);
}

std::vector<std::filesystem::path> export_zones(const ZoneMap& zones, const std::filesystem::path& folder,
                                                const std::set<std::string>& formats) {
  check(formats, zone_formats());
  return report::write_zones(zones, folder, formats);
}

std::vector<std::filesystem::path> export_verification(const Verification& answer, const std::filesystem::path& folder,
                                                       const std::set<std::string>& formats) {
  check(formats, verification_formats());
  return report::write_verification(answer, folder, formats);
}

std::vector<ExportedFile> loci_files(const Model& model, const LocusMap& loci, const std::set<std::string>& formats) {
  check(formats, loci_formats(loci.tower.coordinates.size()));
  const std::vector<core::ModeSketch> sketches = sample_sketches(model.content().mechanism, loci);
  return files_in(&report::Format::loci, report::LociSheet{loci, sketches}, formats);
}

std::vector<ExportedFile> zone_files(const ZoneMap& zones, const std::set<std::string>& formats) {
  check(formats, zone_formats());
  return files_in(&report::Format::zones, zones, formats);
}

std::vector<ExportedFile> verification_files(const Verification& answer, const std::set<std::string>& formats) {
  check(formats, verification_formats());
  return files_in(&report::Format::verification, answer, formats);
}

std::string to_json(const LocusMap& loci) { return report::json_text(report::loci_object(loci)); }
std::string to_json(const ZoneMap& zones) { return report::json_text(report::zones_object(zones)); }
std::string to_json(const Verification& answer) { return report::json_text(report::verification_object(answer)); }

std::string to_table(const LocusMap& loci) { return report::loci_table(loci); }
std::string to_table(const ZoneMap& zones) { return report::zones_table(zones); }
std::string to_text(const Verification& answer) { return report::verification_text(answer, answer.by.has_value()); }

std::vector<WorkingMode> modes_of(const LocusMap& loci) { return report::modes_of(loci); }

std::string to_svg(const LocusMap& loci, const WorkingMode& mode) {
  return report::picture(loci, mode, nullptr, report::PictureFormat::svg);
}
std::string to_svg(const ZoneMap& zones, const WorkingMode& mode) {
  return report::zone_picture(zones, mode, report::PictureFormat::svg);
}
std::string to_svg(const Verification& answer) {
  return report::verification_picture(answer, report::PictureFormat::svg);
}

}  // namespace clearloci
