#include "cli/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "cli/commands.hpp"
#include "cli/out_of_memory.hpp"
#include "cli/standard_streams.hpp"
#include "core/errors.hpp"
#include "mechanism/read.hpp"
#include "report/files.hpp"

namespace clearloci::cli {
namespace {

std::string help_call(const CLI::App& program) {
  for (const CLI::App* command : program.get_subcommands()) return "see clearloci " + command->get_name() + " --help";
  return "see clearloci --help";
}

/// A word in the command's place that is none: said here, since CLI11 would only say that a command is missing.
void check_command_word(const std::vector<Command>& commands, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.app->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return;
  throw core::InputError({}, fmt::format("unknown command '{}'", argv[1]),
                         fmt::format("the commands are {}", fmt::join(names, ", ")));
}

/// The keys of a mechanism file, of which the page mechanism-file.md has the values.
std::string wrapped_keys() {
  constexpr std::size_t width = 110;
  std::string text = "Keys of a mechanism file (docs/mechanism-file.md):";
  for (const std::string& key : mechanism::file_keys()) {
    if (text.size() - text.rfind('\n') + key.size() > width) text += "\n ";
    text += " " + key;
  }
  return text + "\n";
}

/// The files among the words of the call that are read: all but those of the options that say where to write.
std::vector<std::filesystem::path> named_inputs(const CLI::App& command) {
  std::vector<std::filesystem::path> files;
  for (const CLI::Option* option : command.get_options()) {
    if (option->check_name("--output") || option->check_name("--certificate")) continue;
    for (const std::string& word : option->results()) files.emplace_back(word);
  }
  return files;
}

int parse_and_run(int argc, const char* const* argv) {
  CLI::App program("Discontinuity loci of parallel mechanisms with joint clearances.", "clearloci");
  program.set_version_flag("--version", "clearloci " CLEARLOCI_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Example: clearloci loci examples/five_bar.yaml\n" + wrapped_keys() +
      "Exit status: 0 done; 1 a check failed; 2 the input or the call is wrong; 3 a limit of time or memory was "
      "reached;\n"
      "70 an error of the program itself.");
  const std::vector<Command> commands = {
      add_loci_command(program),   add_equations_command(program),  add_validate_command(program),
      add_pose_command(program),   add_error_command(program),      add_zones_command(program),
      add_verify_command(program), add_trajectory_command(program), add_check_command(program),
      add_design_command(program), add_normalize_command(program),  add_import_command(program),
      add_view_command(program)};
  try {
    check_command_word(commands, argc, argv);
    program.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    return program.exit(request);
  } catch (const CLI::ParseError& error) {
    throw core::InputError({}, error.what(), help_call(program));
  }
  for (const Command& command : commands)
    if (command.app->parsed()) {
      if (command.app->get_name() == "view")
        throw_where_memory_ends();
      else
        end_where_memory_ends();
      report::keep_inputs(named_inputs(*command.app));
      return command.run();
    }
  return exit_wrong_input;
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  prepare_process();
  const auto unwritten = [] {
    complain("standard output cannot be written; is the disk full, or the reader gone?");
    return exit_wrong_input;
  };
  try {
    const int status = parse_and_run(argc, argv);
    return flush_standard_output() ? status : unwritten();
  } catch (const core::InputError& error) {
    complain(error.what());
    return exit_wrong_input;
  } catch (const core::LimitReached& limit) {
    complain(limit.what());
    const int status = flush_standard_output() ? exit_limit_reached : exit_wrong_input;
    std::_Exit(status);  // work left behind (loci/curves/abandonable.hpp) must not meet the end of static objects
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (const std::system_error& error) {
    if (std::ferror(stdout) != 0) return unwritten();  // printing throws where the stream fails
    if (error.code() == std::errc::resource_unavailable_try_again || error.code() == std::errc::not_enough_memory)
      end_without_memory();  // no thread is to be had
    complain(fmt::format("internal error: {}; please report it with the mechanism file", error.what()));
    return exit_internal_error;
  } catch (const std::exception& error) {
    complain(fmt::format("internal error: {}; please report it with the mechanism file", error.what()));
    return exit_internal_error;
  }
}

}  // namespace clearloci::cli
