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
  CLI::App* command = program.add_subcommand("normalize", "Write what is drawn as points with constructions");
  command->add_option("model", arguments->model, "Mechanism file")->required();
  command->add_option("-o,--output", arguments->output, "File to write; without it the text is printed");
  command->add_option("--set", arguments->overrides, "Another value of a parameter: name=value");
  command->add_flag("--json", arguments->json, "Print text and notes as JSON");
  command->add_flag("--quiet", arguments->quiet, "Print nothing but what is asked for");
  command->footer("Example: clearloci normalize sketch.yaml -o own.yaml\nThe drawn form: docs/drawn-form.md.");
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace clearloci::cli
