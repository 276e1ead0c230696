// The options of the commands that trace loci, and the request they make.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/progress.hpp"
#include "cli/time_limit.hpp"

namespace clearloci::cli {

struct LociArguments {
  bool controlled = false;
  std::vector<std::string> joints;
  std::string quantities = "f,M";
  std::string min_force, min_couple, tolerance, mesh_size = "1/32", working_mode;
  std::string engine = "adaptive-then-exact";
};

/// --joint, --working-mode, --engine.
void add_tracing_arguments(CLI::App& command, LociArguments& arguments);

/// --quantity, --min-force, --min-couple, --tolerance.
void add_locus_arguments(CLI::App& command, LociArguments& arguments);

/// --mesh-size.
void add_controlled_argument(CLI::App& command, LociArguments& arguments);

void add_mesh_argument(CLI::App& command, LociArguments& arguments);

/// `progress` must outlive the request.
LociRequest loci_request(const LociArguments& arguments, const mechanism::Mechanism& mechanism, Progress& progress,
                         const TimeLimit& limit);

}  // namespace clearloci::cli
