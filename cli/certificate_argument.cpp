#include "cli/certificate_argument.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>

#include "analysis/flanks.hpp"
#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "report/files.hpp"

namespace clearloci::cli {

namespace {

report::CertificateSource source_of(const std::string& command, const CommonArguments& arguments) {
  std::ifstream stream(arguments.model, std::ios::binary);
  report::CertificateSource source{command, {std::istreambuf_iterator<char>(stream), {}}, {}};
  for (const std::string& pair : arguments.overrides) {
    const std::size_t sign = pair.find('=');
    source.overrides.emplace_back(pair.substr(0, sign), sign == std::string::npos ? "" : pair.substr(sign + 1));
  }
  return source;
}

void tell_that_nothing_is_claimed(const std::string& file) {
  fmt::print(stderr, "clearloci: {} is not written: nothing was proven within the time limit\n", core::printable(file));
}

}  // namespace

void add_certificate_argument(CLI::App& command, std::string& file, const std::string& of) {
  command.add_option("--certificate", file, "Also write a certificate of what was proven, for clearloci check; " + of)
      ->type_name("FILE");
}

bool has_certified_loci(const mechanism::Mechanism& mechanism) {
  const bool lengths =
      mechanism.coordinates.size() == 2 && !mechanism.coordinates[0].angle && !mechanism.coordinates[1].angle;
  return mechanism.space == mechanism::Space::planar && lengths && !mechanism::has_effort_bounds(mechanism) &&
         mechanism.groups.empty() && !meshes(mechanism);
}

bool has_certified_range(const mechanism::Mechanism& mechanism) { return mechanism.coordinates.size() == 1; }

void require_certifiable(const mechanism::Mechanism& mechanism) {
  mechanism::require_preload(mechanism);
  if (has_certified_loci(mechanism) || has_certified_range(mechanism)) return;
  if (mechanism::has_effort_bounds(mechanism))
    throw core::InputError({.file = "--certificate"},
                           "over two coordinates and more there is no certificate of the loci and zones of mechanisms "
                           "whose efforts have bounds",
                           "leave it out for this mechanism; verify has one of a task");
  throw core::InputError(
      {.file = "--certificate"},
      "loci and zones have certificates only over one coordinate, and for planar mechanisms over two "
      "lengths without points that close together, gears and belts",
      "leave it out; verify writes certificates of tasks over any coordinates");
}

void stage_certificate(report::StagedFiles& staged, const std::string& file, const std::string& command,
                       const CommonArguments& arguments, const core::Certificate& certificate, const core::Task* task) {
  if (certificate.problem.tower.coordinates.empty()) return tell_that_nothing_is_claimed(file);
  staged.add(file, report::certificate_text(source_of(command, arguments), certificate, task));
}

void stage_certificate(report::StagedFiles& staged, const std::string& file, const std::string& command,
                       const CommonArguments& arguments, const core::TaskCertificate& certificate,
                       const std::vector<core::PreloadLawCell>& law) {
  staged.add(file, report::certificate_text(source_of(command, arguments), certificate, law));
}

void stage_certificate(report::StagedFiles& staged, const std::string& file, const std::string& command,
                       const CommonArguments& arguments, const core::TaskCertificate& certificate,
                       const core::PreloadAnswer& refuted) {
  staged.add(file, report::certificate_text(source_of(command, arguments), certificate, refuted));
}

void stage_certificate(report::StagedFiles& staged, const std::string& file, const std::string& command,
                       const CommonArguments& arguments, const core::RangeCertificate& certificate) {
  if (certificate.modes.empty()) return tell_that_nothing_is_claimed(file);
  staged.add(file, report::certificate_text(source_of(command, arguments), certificate));
}

}  // namespace clearloci::cli
