// clearloci loci: the main job. Traces the discontinuity loci, writes their files and prints their table.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "analysis/range_certificate.hpp"
#include "analysis/zones.hpp"
#include "cli/certificate_argument.hpp"
#include "cli/commands.hpp"
#include "cli/loci_arguments.hpp"
#include "cli/program.hpp"
#include "cli/progress.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "mechanism/read_task.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/loci_table.hpp"

namespace clearloci::cli {
namespace {

struct LociCommand {
  CommonArguments common;
  LociArguments loci;
  std::string formats = "svg,png,csv";
  std::string certificate;
  bool exact = false;
};

/// Asked for, not merely a default.
void check_formats(const std::set<std::string>& formats, std::size_t coordinates) {
  for (const std::string& name : formats)
    if (!report::can_hold(name, coordinates))
      throw core::InputError({.file = "--export"},
                             fmt::format("{} does not hold loci over {} free coordinate{}", name, coordinates,
                                         coordinates == 1 ? "" : "s"),
                             coordinates == 3 ? "surfaces go to stl, obj, vtk, csv and pictures" : "leave it out");
}

/// What the page shows besides the loci, over two lengths and as far as there is time.
std::optional<core::Zones> zones_of_page(const mechanism::Mechanism& mechanism, const LociRequest& request) {
  if (!mechanism::is_plane(mechanism)) return std::nullopt;
  try {
    return find_zones(mechanism, {request});
  } catch (const core::InputError&) {  // there are none, as where every pose is singular
  } catch (const core::LimitReached&) {
  }
  return std::nullopt;
}

int run(const LociCommand& arguments, TimeLimit& limit) {
  const std::set<std::string> formats = parse_formats(arguments.formats, report::format_names<report::LociSheet>());
  const std::future<void> letters = report::prepare_pictures(formats);
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  check_formats(formats, mechanism.coordinates.size());
  if (!arguments.certificate.empty()) require_certifiable(mechanism);
  limit.known([common = arguments.common, map = unfinished_map(mechanism, "the time limit was reached")] {
    write_incomplete(common, "loci.json", report::loci_object(map));
  });
  Progress progress(arguments.common.quiet);
  const LociRequest request = loci_request(arguments.loci, mechanism, progress, limit);
  core::Certificate certificate;
  const bool certify = !arguments.certificate.empty(), on_range = certify && has_certified_range(mechanism);
  const auto traced = std::make_shared<const core::LocusMap>(
      trace_loci(mechanism, request, certify && !on_range ? &certificate : nullptr));
  const core::LocusMap& map = *traced;
  limit.known(
      [common = arguments.common, traced] { write_incomplete(common, "loci.json", report::loci_object(*traced)); });
  progress.clear();

  const std::filesystem::path folder = output_folder(arguments.common);
  std::optional<core::Zones> zones;
  if (formats.contains("html")) zones = zones_of_page(mechanism, request);
  report::StagedFiles staged;
  if (on_range)
    stage_certificate(staged, arguments.certificate, "loci", arguments.common,
                      range_certificate(mechanism, request, map));
  else if (certify)
    stage_certificate(staged, arguments.certificate, "loci", arguments.common, certificate);
  const std::vector<std::filesystem::path> files =
      report::stage_loci(staged, {map, sample_sketches(mechanism, map), zones ? &*zones : nullptr}, folder, formats);
  limit.commit(staged);
  if (arguments.common.json) {
    fmt::print("{}", report::json_text(report::loci_object(map)));
  } else if (!arguments.common.quiet) {
    fmt::print("{}\n", report::loci_table(map, arguments.exact));
    fmt::print("{}", written_words(folder, files));
  }
  if (!map.out_of_time) return map.complete ? exit_done : exit_limit_reached;
  throw core::LimitReached(fmt::format("the time limit was reached; what is known is in {}, marked incomplete",
                                       core::printable(folder.string())));
}

}  // namespace

Command add_loci_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("loci", "Trace the discontinuity loci and write them as pictures and files");
  const auto arguments = std::make_shared<LociCommand>();
  add_common_arguments(*app, arguments->common);
  add_tracing_arguments(*app, arguments->loci);
  add_locus_arguments(*app, arguments->loci);
  add_controlled_argument(*app, arguments->loci);
  add_mesh_argument(*app, arguments->loci);
  add_export_argument(*app, arguments->formats,
                      fmt::format("Files besides loci.json, comma-separated: {}",
                                  fmt::join(report::format_names<report::LociSheet>(), ", ")));
  app->add_flag("--exact", arguments->exact,
                "Print irrational numbers of closed forms in the table as roots, not as decimals");
  add_certificate_argument(*app, arguments->certificate, certified_mechanisms);
  app->footer(
      "Example: clearloci loci examples/five_bar.yaml --export svg,pdf,dxf --working-mode all\n"
      "With three free coordinates the loci are surfaces:\n"
      "  clearloci loci examples/gough_stewart.yaml --mesh-size 1/48 --export png,stl,obj,vtk");
  return within_limit(app, arguments, run);
}

}  // namespace clearloci::cli
