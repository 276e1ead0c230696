#include "cli/certificate_argument.hpp"

#include <CLI/CLI.hpp>
#include <fstream>
#include <iterator>

#include "core/errors.hpp"
#include "report/files.hpp"

namespace clearloci::cli {

void add_certificate_argument(CLI::App& command, std::string& file) {
  command
      .add_option(
          "--certificate", file,
          "Also write a certificate of what was proven, for clearloci check; planar mechanisms over two lengths")
      ->type_name("FILE");
}

void require_certifiable(const mechanism::Mechanism& mechanism) {
  const bool lengths =
      mechanism.coordinates.size() == 2 && !mechanism.coordinates[0].angle && !mechanism.coordinates[1].angle;
  if (mechanism.space == mechanism::Space::planar && lengths) return;
  throw core::InputError({.file = "--certificate"}, "certificates are of planar mechanisms over two lengths",
                         "leave it out for this mechanism");
}

void stage_certificate(report::StagedFiles& staged, const std::string& file, const std::string& command,
                       const CommonArguments& arguments, const core::Certificate& certificate, const core::Task* task) {
  std::ifstream stream(arguments.model, std::ios::binary);
  report::CertificateSource source{command, {std::istreambuf_iterator<char>(stream), {}}, {}};
  for (const std::string& pair : arguments.overrides) {
    const std::size_t sign = pair.find('=');
    source.overrides.emplace_back(pair.substr(0, sign), sign == std::string::npos ? "" : pair.substr(sign + 1));
  }
  staged.add(file, report::certificate_text(source, certificate, task));
}

}  // namespace clearloci::cli
