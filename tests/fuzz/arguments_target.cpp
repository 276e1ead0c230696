#include <CLI/CLI.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/loci_arguments.hpp"
#include "cli/progress.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/fuzz/sample_mechanisms.hpp"
#include "tests/fuzz/targets.hpp"

namespace clearloci::fuzz {
namespace {

/// The words of a call, without the mechanism's file; `model`: that file.
struct Call {
  std::string model;
  std::vector<std::string> words;
};

Call call_of(std::string_view bytes) {
  Call call;
  call.words = cli::split(std::string(bytes), '\n');
  const std::string& first = call.words.front();
  const std::size_t number = first.size() == 1 && first[0] >= '0' && first[0] <= '2' ? first[0] - '0' : 0;
  call.model = sample_files.at(number);
  call.words.erase(call.words.begin());
  for (std::string& word : call.words) word = word.substr(0, word.find('\0'));  // as the system hands words over
  return call;
}

/// What one call may ask for, each by the reader that the commands use.
struct Values {
  cli::CommonArguments common;
  cli::LociArguments loci;
  std::string at, grid, steps;
};

/// From words to values. False where the call asks for help instead.
bool parse(const Call& call, Values& values) {
  CLI::App command("one of the commands", "clearloci");
  cli::add_common_arguments(command, values.common);
  cli::add_tracing_arguments(command, values.loci);
  cli::add_locus_arguments(command, values.loci);
  cli::add_mesh_argument(command, values.loci);
  command.add_option("--at", values.at);
  command.add_option("--grid", values.grid);
  command.add_option("--steps", values.steps);
  std::vector<const char*> words = {"clearloci", call.model.c_str()};
  for (const std::string& word : call.words) words.push_back(word.c_str());
  try {
    command.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::Success&) {
    return false;
  } catch (const CLI::ParseError& error) {  // as cli/program.cpp says it
    throw core::InputError({}, error.what(), "see clearloci --help");
  }
  return true;
}

bool is_above_zero(double value) { return std::isfinite(value) && value > 0; }

void check_values(const Values& values, const mechanism::Mechanism& mechanism) {
  const auto request = value_or_complaint([&] {
    cli::Progress progress(true);
    return cli::loci_request(values.loci, mechanism, progress);
  });
  if (request) {
    require(is_above_zero(request->tolerance), "a tolerance is finite and above zero");
    require(is_above_zero(request->mesh_size), "a mesh size is finite and above zero");
    for (const auto& least : {request->selection.min_force, request->selection.min_couple})
      require(!least || is_above_zero(core::to_double(*least)), "a least effort is finite and above zero");
    for (const DyadSides& sides : request->working_modes)
      require(sides.size() == dyad_points(mechanism).size(), "a side for every dyad");
  }
  const auto pose = value_or_complaint([&] { return cli::parse_pose(values.at, mechanism); });
  if (pose) {
    require(pose->size() == mechanism.coordinates.size(), "a value for every coordinate");
    for (const core::Rational& value : *pose)
      require(std::isfinite(core::to_double(value)), "a coordinate of a pose is finite");
  }
  const auto grid = value_or_complaint([&] { return cli::parse_grid(values.grid); });
  if (grid) require(grid->first >= 2 && grid->second >= 2, "a grid has two nodes along each coordinate");
  const auto steps = value_or_complaint([&] { return cli::parse_steps(values.steps); });
  if (steps) require(*steps >= 2, "a range has two steps");
}

}  // namespace

void arguments_target(std::string_view bytes) {
  const Call call = call_of(bytes);
  Values values;
  const auto parsed = value_or_complaint([&] { return parse(call, values); });
  if (!parsed || !*parsed) return;
  values.common.model = call.model;  // a second model is refused, but never opened
  const auto mechanism = value_or_complaint([&] { return cli::read_model(values.common); });
  if (mechanism) check_values(values, *mechanism);
}

}  // namespace clearloci::fuzz
