// clearloci zones: the discontinuity-free zones of a working mode, as a picture, a table and files.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/zones.hpp"
#include "cli/certificate_argument.hpp"
#include "cli/commands.hpp"
#include "cli/loci_arguments.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/zones.hpp"

namespace clearloci::cli {
namespace {

struct Arguments {
  CommonArguments common;
  LociArguments loci;
  std::string formats = "svg,png";
  std::string certificate;
};

int run(const Arguments& arguments, TimeLimit& limit) {
  const std::set<std::string> formats = parse_formats(arguments.formats, report::format_names(report::Answer::zones));
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  if (!arguments.certificate.empty()) require_certifiable(mechanism);
  limit.known([common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "zones.json", incomplete_body(name, "the zones were"));
  });
  Progress progress(arguments.common.quiet);
  const LociRequest request = loci_request(arguments.loci, mechanism, progress, limit);
  core::Certificate certificate;
  const bool certify = !arguments.certificate.empty();
  const core::ZoneMap map = find_zones(mechanism, request, certify ? &certificate : nullptr);
  progress.clear();
  limit.writing();

  const std::filesystem::path folder = output_folder(arguments.common);
  if (certify)
    write_certificate(arguments.certificate, "zones", arguments.common, certificate, map.loci, {.zones = &map.zones});
  const std::vector<std::filesystem::path> files = report::write_zones(map, folder, formats);
  if (arguments.common.json) {
    fmt::print("{}", report::json_text(report::zones_object(map)));
  } else if (!arguments.common.quiet) {
    fmt::print("{}\n", report::zones_table(map));
    fmt::print("{}", written_words(folder, files));
  }
  return exit_done;
}

}  // namespace

Command add_zones_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("zones", "Cut the workspace into its discontinuity-free zones");
  const auto arguments = std::make_shared<Arguments>();
  add_common_arguments(*app, arguments->common);
  add_tracing_arguments(*app, arguments->loci);
  add_locus_arguments(*app, arguments->loci);
  app->add_option("--export", arguments->formats,
                  fmt::format("Files besides zones.json, several after commas: {}",
                              fmt::join(report::format_names(report::Answer::zones), ", ")))
      ->type_name("LIST")
      ->capture_default_str();
  add_certificate_argument(*app, arguments->certificate);
  app->footer(
      "Example: clearloci zones examples/five_bar.yaml --working-mode all\n"
      "The files go to ./out/<name of MODEL>, or to the folder of -o.");
  return {app, [arguments] {
            return run_within(arguments->common, [&](TimeLimit& limit) { return run(*arguments, limit); });
          }};
}

}  // namespace clearloci::cli
