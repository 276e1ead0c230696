// clearloci import: another program's file as a mechanism file.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "clearloci/import.hpp"
#include "clearloci/mechanism.hpp"
#include "cli/commands.hpp"
#include "cli/program.hpp"
#include "cli/written_file.hpp"
#include "core/text.hpp"
#include "mechanism/read.hpp"

namespace clearloci::cli {
namespace {

struct ImportCommand {
  std::string file, output, clearance, loops;
  bool quiet = false, json = false;
};

/// What hinders the file from being asked anything as it stands.
std::string hindrance(const ImportedFile& found, const std::string& file) {
  try {
    (void)Model::parse(found.text, file);
  } catch (const InputError& error) {
    return error.problem() + "; " + error.mend();
  }
  return {};
}

int run(const ImportCommand& arguments) {
  ImportRequest request{.clearance = arguments.clearance, .side = {}, .side_file = arguments.loops};
  if (!arguments.loops.empty()) request.side = mechanism::read_text(arguments.loops, "the file of loops");
  ImportedFile found = import_file(arguments.file, request);
  if (found.format.empty())
    throw InputError({arguments.file, 0, 0}, "this is a mechanism file already, or in no format that is known",
                     fmt::format("name a file of {}", fmt::join(import_formats(), ", ")));
  const std::string name = arguments.output.empty() ? arguments.file : arguments.output;
  if (const std::string why = hindrance(found, name); !why.empty())
    found.notes.push_back("as it stands it is refused: " + core::message_line(why));
  put_out({found.format, found.text, found.notes}, arguments.output, arguments.json, arguments.quiet);
  return exit_done;
}

}  // namespace

Command add_import_command(CLI::App& program) {
  auto arguments = std::make_shared<ImportCommand>();
  CLI::App* command = program.add_subcommand("import", "Write another program's file as a mechanism file");
  command
      ->add_option("FILE", arguments->file,
                   "A file of PMKS+, Linkage, MJCF, URDF, SDF, DXF, pyslvs or CUIK; or an address of PMKS+, in quotes")
      ->required();
  command->add_option("-o,--output", arguments->output, "The file to write; without this option the text is printed");
  command->add_option(
      "--clearance", arguments->clearance,
      "Radial clearance of pins and balls, for which the file gives none, in m or with a unit (default: 20e-6)");
  command->add_option("--loops", arguments->loops,
                      "With a URDF: the file with the key closed_loop (default: robot.yaml beside robot.urdf)");
  command->add_flag("--json", arguments->json, "Print the text and the notes as JSON");
  command->add_flag("--quiet", arguments->quiet, "Print no notes");
  command->footer(
      "Examples:\n"
      "  clearloci import linkage.linkage2 -o own.yaml\n"
      "  clearloci import 'https://app.pmksplus.com/?...' -o own.yaml --clearance '30 um'\n"
      "  clearloci loci robot.urdf\n"
      "All commands take such files directly. docs/guide/import.md lists what is read of each format.");
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace clearloci::cli
