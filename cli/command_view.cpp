// clearloci view: the workbench in a browser.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/program.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "mechanism/read.hpp"
#ifdef CLEARLOCI_HAS_WORKBENCH
#include "workbench/server/server.hpp"
#endif

namespace clearloci::cli {
namespace {

struct ViewCommand {
  CommonArguments common;
  int port = 0;
};

#ifdef CLEARLOCI_HAS_WORKBENCH
int run(const ViewCommand& arguments) {
  constexpr double usual_time_limit = 20;
  const bool has_model = !arguments.common.model.empty();
  mechanism::ModelText model;
  if (has_model) {
    model = mechanism::read_model_text(arguments.common.model);
    // Complains in the words of every command.
    (void)mechanism::parse_mechanism(model.text, model.file, parse_overrides(arguments.common.overrides));
  } else if (!arguments.common.overrides.empty()) {
    throw core::InputError({}, "--set changes a parameter of a mechanism file, and there is none", "name the file");
  }
  const double time_limit =
      arguments.common.time_limit.empty()
          ? usual_time_limit
          : core::to_double(parse_positive(arguments.common.time_limit, "--time-limit", mechanism::Mechanism{}));
  workbench::Server server({.file = arguments.common.model,
                            .text = model.text,
                            .values = parse_overrides(arguments.common.overrides),
                            .port = arguments.port,
                            .time_limit = time_limit});
  fmt::print("The workbench is open at\n\n  {}\n\nuntil this is ended with Ctrl-C.\n", server.address());
  std::fflush(stdout);
  server.run();
  return exit_done;
}
#else
int run(const ViewCommand&) {
  throw core::InputError({}, "this build has no workbench", "build with -DCLEARLOCI_WORKBENCH=ON, which needs Node.js");
}
#endif

}  // namespace

Command add_view_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "view", "Open the workbench in a browser: draw and change a mechanism; loci and zones are updated at once");
  const auto arguments = std::make_shared<ViewCommand>();
  app->add_option(
         "MODEL", arguments->common.model,
         "The mechanism file (YAML), or a file that the command import reads; without it the page shows a gallery")
      ->type_name("FILE");
  app->add_option("--set", arguments->common.overrides,
                  "Give a parameter another value, in the unit in which the file writes it (repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  constexpr int largest_port = 65535;
  app->add_option("--port", arguments->port, "The port to listen on (default: one that is free)")
      ->check(CLI::Range(1, largest_port))
      ->type_name("PORT");
  app->add_option("--time-limit", arguments->common.time_limit, "Largest time for one answer (default: 20)")
      ->type_name("SECONDS");
  app->footer(
      "Examples: clearloci view\n"
      "          clearloci view examples/five_bar.yaml\n"
      "Prints an address of this machine (127.0.0.1) for the browser; other machines cannot reach it. It writes no "
      "files:\n"
      "the browser downloads them. Ctrl-C ends it.");
  return {app, [arguments] { return run(*arguments); }};
}

}  // namespace clearloci::cli
