// The commands of the program, each in its own source: it adds its options to the command line and gives back what
// runs it. Exit statuses are those of the program (program.hpp).
#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace clearloci::cli {

struct Command {
  CLI::App* app = nullptr;   ///< owned by the program's App
  std::function<int()> run;  ///< returns the exit status
};

Command add_loci_command(CLI::App& program);
Command add_equations_command(CLI::App& program);
Command add_validate_command(CLI::App& program);
Command add_pose_command(CLI::App& program);
Command add_zones_command(CLI::App& program);
Command add_verify_command(CLI::App& program);
Command add_error_command(CLI::App& program);
Command add_trajectory_command(CLI::App& program);
Command add_check_command(CLI::App& program);
Command add_design_command(CLI::App& program);
Command add_normalize_command(CLI::App& program);
Command add_import_command(CLI::App& program);
Command add_view_command(CLI::App& program);

}  // namespace clearloci::cli
