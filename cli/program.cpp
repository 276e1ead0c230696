#include "cli/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
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
#include "loci/search/search.hpp"
#include "mechanism/read.hpp"
#include "report/files.hpp"

namespace clearloci::cli {
namespace {

std::string help_call(const CLI::App& program) {
  for (const CLI::App* command : program.get_subcommands()) return "see clearloci " + command->get_name() + " --help";
  return "see clearloci --help";
}

struct CommandName {
  std::string_view name;
  Command (*add)(CLI::App& program);
};

constexpr CommandName command_names[] = {
    {"loci", add_loci_command},     {"equations", add_equations_command},   {"validate", add_validate_command},
    {"pose", add_pose_command},     {"error", add_error_command},           {"zones", add_zones_command},
    {"verify", add_verify_command}, {"trajectory", add_trajectory_command}, {"check", add_check_command},
    {"design", add_design_command}, {"normalize", add_normalize_command},   {"import", add_import_command},
    {"view", add_view_command}};

/// The command that the first word names; all of them where it is an option, as --help. Adding a command takes time.
std::vector<Command> add_commands(CLI::App& program, const std::string& word) {
  const bool option = word.empty() || word.front() == '-';
  std::vector<Command> commands;
  std::vector<std::string_view> names;
  for (const CommandName& command : command_names) {
    names.push_back(command.name);
    if (word != "--version" && (option || word == command.name)) commands.push_back(command.add(program));
  }
  // Said here, since CLI11 would only say that a command is missing.
  if (!option && commands.empty())
    throw core::InputError({}, fmt::format("unknown command '{}'", word),
                           fmt::format("the commands are {}", fmt::join(names, ", ")));
  return commands;
}

/// The keys of a mechanism file, of which the page mechanism-file.md has the values.
std::string wrapped_keys() {
  constexpr std::size_t width = 110;
  std::string text = "Keys of a mechanism file (docs/reference/mechanism-file.md):";
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
  const std::vector<Command> commands = add_commands(program, argc > 1 ? argv[1] : "");
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    return program.exit(request);
  } catch (const CLI::ParseError& error) {
    throw core::InputError({}, error.what(), help_call(program));
  }
  for (const Command& command : commands)
    if (command.app->parsed()) {
      if (command.app->get_name() == "view") {
        throw_where_memory_ends();
      } else {
        end_where_memory_ends();
        take_large_pages();
      }
      report::keep_inputs(named_inputs(*command.app));
      loci::keep_to_threads_to_be_had();
      return command.run();
    }
  return exit_wrong_input;
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  prepare_process();
  const auto unwritten = [] {
    complain("standard output cannot be written: the disk is full, or the reading program has ended");
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
    if (error.code() == std::errc::not_enough_memory) end_without_memory();
    if (error.code() == std::errc::resource_unavailable_try_again) {
      complain("the system has no more threads; allow more processes (ulimit -u) or more memory");
      report::remove_temporaries();
      std::_Exit(exit_limit_reached);
    }
    complain(fmt::format("internal error: {}; please report it with the mechanism file", error.what()));
    return exit_internal_error;
  } catch (const std::exception& error) {
    complain(fmt::format("internal error: {}; please report it with the mechanism file", error.what()));
    return exit_internal_error;
  }
}

}  // namespace clearloci::cli
