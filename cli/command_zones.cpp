// clearloci zones: the discontinuity-free zones of a working mode, as a picture, a table and files.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/range_certificate.hpp"
#include "analysis/zones.hpp"
#include "cli/certificate_argument.hpp"
#include "cli/commands.hpp"
#include "cli/loci_arguments.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "core/errors.hpp"
#include "mechanism/read_task.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/zones.hpp"

namespace clearloci::cli {
namespace {

struct ZonesCommand {
  CommonArguments common;
  LociArguments loci;
  std::string formats = "svg,png";
  std::string certificate;
  long cells = 300'000;
};

int run(const ZonesCommand& arguments, TimeLimit& limit) {
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  const std::set<std::string> formats = parse_formats(
      arguments.formats, report::zone_formats(mechanism.coordinates.size(), has_zones_by_cells(mechanism)));
  const std::future<void> letters = report::prepare_pictures(formats);
  const bool certify = !arguments.certificate.empty();
  if (certify) require_certifiable(mechanism);
  limit.known([common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "zones.json", incomplete_body(name, "the zones were"));
  });
  Progress progress(arguments.common.quiet);
  core::Certificate certificate;
  const bool on_range = certify && has_certified_range(mechanism);
  const LociRequest request = loci_request(arguments.loci, mechanism, progress, limit);
  const core::Zones map =
      find_zones(mechanism, {request, arguments.cells}, certify && !on_range ? &certificate : nullptr);
  progress.clear();

  const std::filesystem::path folder = output_folder(arguments.common);
  report::StagedFiles staged;
  if (on_range)
    stage_certificate(staged, arguments.certificate, "zones", arguments.common,
                      range_certificate(mechanism, request, map));
  else if (certify)
    stage_certificate(staged, arguments.certificate, "zones", arguments.common, certificate);
  const std::vector<std::filesystem::path> files = report::stage_answer(staged, map, folder, formats);
  limit.commit(staged);
  if (arguments.common.json)
    fmt::print("{}", report::json_text(report::zones_object(map)));
  else if (!arguments.common.quiet)
    fmt::print("{}\n{}", report::zones_table(map), written_words(folder, files));
  return map.loci.complete ? exit_done : exit_limit_reached;
}

}  // namespace

Command add_zones_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("zones", "Cut the workspace into its discontinuity-free zones");
  const auto arguments = std::make_shared<ZonesCommand>();
  add_common_arguments(*app, arguments->common);
  add_tracing_arguments(*app, arguments->loci);
  add_locus_arguments(*app, arguments->loci);
  add_controlled_argument(*app, arguments->loci);
  add_export_argument(
      *app, arguments->formats,
      fmt::format("Files besides zones.json, comma-separated: {}; by cells {}",
                  fmt::join(report::zone_formats(2, false), ", "), fmt::join(report::zone_formats(3, true), ", ")));
  app->add_option(
         "--cells", arguments->cells,
         "By cells, which is over other than two lengths, and where determined efforts or tensions have bounds "
         "or points close together: the number of cells in each mode; more cells leave less in doubt")
      ->check(CLI::Range(1L, 100'000'000L))
      ->capture_default_str();
  add_certificate_argument(*app, arguments->certificate, certified_mechanisms);
  app->footer("Example: clearloci zones examples/five_bar.yaml --working-mode all");
  return within_limit(app, arguments, run);
}

}  // namespace clearloci::cli
