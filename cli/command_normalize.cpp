// clearloci normalize: what is drawn as what is constructed.
#include <CLI/CLI.hpp>
#include <memory>

#include "clearloci/normalize.hpp"
#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/program.hpp"
#include "cli/written_file.hpp"

namespace clearloci::cli {
namespace {

struct NormalizeCommand {
  std::string model, output;
  std::vector<std::string> overrides;
  bool quiet = false, json = false;
};

int run(const NormalizeCommand& arguments) {
  const NormalizedFile found = normalize(Model::read(arguments.model, parse_overrides(arguments.overrides)));
  put_out({.text = found.text, .notes = found.notes}, arguments.output, arguments.json, arguments.quiet);
  return exit_done;
}

}  // namespace

Command add_normalize_command(CLI::App& program) {
  auto arguments = std::make_shared<NormalizeCommand>();
  CLI::App* command = program.add_subcommand(
      "normalize", "Find the construction of every point of a drawn mechanism, and write the file");
  command->add_option("MODEL", arguments->model, "The mechanism file (YAML), or a file that the command import reads")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--output", arguments->output, "The file to write; without this option the text is printed");
  command->add_option("--set", arguments->overrides,
                      "Give a parameter another value, in the unit in which the file writes it (repeatable)");
  command->add_flag("--json", arguments->json, "Print the text and the notes as JSON");
  command->add_flag("--quiet", arguments->quiet, "Print no notes");
  command->footer("Example: clearloci normalize sketch.yaml -o own.yaml\nThe drawn form: docs/guide/drawn-form.md.");
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace clearloci::cli
