#include "cli/loci_arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "analysis/request_limits.hpp"
#include "core/errors.hpp"
#include "core/shown_units.hpp"
#include "mechanism/frame.hpp"

namespace clearloci::cli {
namespace {

Engine parse_engine(const std::string& word) {
  if (const std::optional<Engine> engine = core::engine_named(word)) return *engine;
  throw core::InputError({.file = "--engine"}, fmt::format("unknown engine '{}'", word),
                         "choose from adaptive-then-exact, exact, adaptive");
}

double parse_tolerance(const std::string& text, const mechanism::Mechanism& mechanism) {
  const core::Rational tolerance = parse_positive(text, "--tolerance", mechanism, "length");
  const double finest = finest_tolerance(mechanism);
  if (tolerance < core::Rational(finest))
    throw core::InputError({.file = "--tolerance"},
                           fmt::format("{} is finer than doubles can express in this box", text),
                           "give " + core::told(finest, "m", mechanism.units, 2) + " or more");
  return core::to_double(tolerance);
}

}  // namespace

void add_tracing_arguments(CLI::App& command, LociArguments& arguments) {
  command
      .add_option(
          "--joint", arguments.joints,
          "Consider the reactions of this joint (repeatable; default: all joints with a clearance, or all joints)")
      ->allow_extra_args(false)
      ->type_name("NAME");
  command
      .add_option("--working-mode", arguments.working_mode,
                  "left or right for every dyad, such as right,left; or all (default: the mode of the file)")
      ->type_name("SIDES");
  command
      .add_option(
          "--engine", arguments.engine,
          "How curves are traced: exact (arrangement of polynomials), adaptive (subdivision), adaptive-then-exact")
      ->type_name("ENGINE")
      ->capture_default_str();
}

void add_locus_arguments(CLI::App& command, LociArguments& arguments) {
  command
      .add_option("--quantity", arguments.quantities,
                  "Reactions whose zeros are traced: f, N, T, M, F, fx to mz, comma-separated")
      ->type_name("LIST")
      ->capture_default_str();
  command
      .add_option("--min-force", arguments.min_force, "Also trace the curves on which a contact force has this size")
      ->type_name("N");
  command.add_option("--min-couple", arguments.min_couple, "Also trace the curves on which a couple has this size")
      ->type_name("NM");
  command
      .add_option("--tolerance", arguments.tolerance,
                  "Largest distance of a drawn chord from its curve, in the unit of length of the file (default: about "
                  "1e-5 of the size of the mechanism)")
      ->type_name("M");
}

void add_controlled_argument(CLI::App& command, LociArguments& arguments) {
  command.add_flag("--controlled", arguments.controlled,
                   "Free efforts without a value may vary with the pose: a pose is singular only if it is so for every "
                   "choice of the free efforts");
}

void add_mesh_argument(CLI::App& command, LociArguments& arguments) {
  command
      .add_option("--mesh-size", arguments.mesh_size,
                  "Over three coordinates: approximate length of the triangles' edges, as a part of the box")
      ->type_name("PART")
      ->capture_default_str();
}

LociRequest loci_request(const LociArguments& arguments, const mechanism::Mechanism& mechanism, Progress& progress,
                         const TimeLimit& limit) {
  LociRequest request;
  request.controlled = arguments.controlled;
  request.joints = parse_joints(arguments.joints, mechanism);
  request.quantities = parse_quantities(arguments.quantities);
  if (!arguments.min_force.empty())
    request.min_force = parse_positive(arguments.min_force, "--min-force", mechanism, "min_force");
  if (!arguments.min_couple.empty())
    request.min_couple = parse_positive(arguments.min_couple, "--min-couple", mechanism, "min_couple");
  request.tolerance = arguments.tolerance.empty() ? 1e-5 * mechanism::frame_of(mechanism).scale_value()
                                                  : parse_tolerance(arguments.tolerance, mechanism);
  request.mesh_size = core::to_double(parse_positive(arguments.mesh_size, "--mesh-size", mechanism));
  if (arguments.working_mode == "all")
    request.all_working_modes = true;
  else if (!arguments.working_mode.empty())
    request.working_modes = {parse_working_mode(arguments.working_mode, mechanism)};
  request.engine = parse_engine(arguments.engine);
  request.deadline = limit.deadline();
  request.progress = [&progress](double fraction, std::string_view stage) { progress.show(fraction, stage); };
  return request;
}

}  // namespace clearloci::cli
