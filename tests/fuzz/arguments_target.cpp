#include <CLI/CLI.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "cli/arguments.hpp"
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

/// What a call may ask for, besides what is common to all commands.
struct Values {
  cli::CommonArguments common;
  std::vector<std::string> joints;
  std::string at = "0", grid = "2x2", steps = "2", quantities = "f", working_mode = "left", positive = "1";
};

/// From words to values. False where the call asks for help instead.
bool parse(const Call& call, Values& values) {
  CLI::App command("one of the commands", "clearloci");
  cli::add_common_arguments(command, values.common);
  command.add_option("--joint", values.joints)->allow_extra_args(false);
  command.add_option("--at", values.at);
  command.add_option("--grid", values.grid);
  command.add_option("--steps", values.steps);
  command.add_option("--quantity", values.quantities);
  command.add_option("--working-mode", values.working_mode);
  command.add_option("--tolerance,--mesh-size,--min-force,--min-couple,--period", values.positive);
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

void check_values(const Values& values, const mechanism::Mechanism& mechanism) {
  const auto joints = value_or_complaint([&] { return cli::parse_joints(values.joints, mechanism); });
  if (joints) require(joints->size() <= mechanism.joints.size(), "each joint once");
  const auto quantities = value_or_complaint([&] { return cli::parse_quantities(values.quantities); });
  if (quantities) require(!quantities->empty(), "a quantity or more");
  const auto sides = value_or_complaint([&] { return cli::parse_working_mode(values.working_mode, mechanism); });
  if (sides) require(sides->size() == dyad_points(mechanism).size(), "a side for every dyad");
  const auto positive =
      value_or_complaint([&] { return cli::parse_positive(values.positive, "--tolerance", mechanism); });
  if (positive) {
    const double value = core::to_double(*positive);
    require(std::isfinite(value) && value > 0, "a positive number is finite and above zero in double precision");
  }
  const auto pose = value_or_complaint([&] { return cli::parse_pose(values.at, mechanism); });
  if (pose) {
    require(pose->size() == mechanism.coordinates.size(), "a value for every coordinate");
    for (const core::Rational& value : *pose)
      require(std::isfinite(core::to_double(value)), "a coordinate of a pose is finite");
  }
  for (const std::size_t coordinates : {1U, 2U, 3U}) {
    const std::string& words = coordinates == 1 ? values.steps : values.grid;
    const auto grid = value_or_complaint([&] { return cli::parse_grid(words, coordinates); });
    if (!grid) continue;
    require(grid->size() == coordinates, "a grid has a number for each coordinate");
    for (const int along : *grid) require(along >= 2, "a grid has two cells along each coordinate");
  }
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
