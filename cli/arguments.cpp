#include "cli/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/import/import.hpp"
#include "mechanism/read.hpp"

namespace clearloci::cli {
namespace {

/// A wrong option has no line and column; its name stands where the file's would.
[[noreturn]] void refuse(const std::string& option, const std::string& problem, const std::string& mend) {
  throw core::InputError({.file = option}, problem, mend);
}

std::vector<std::string> dyad_names(const mechanism::Mechanism& mechanism) {
  std::vector<std::string> names;
  for (const mechanism::PointIndex point : mechanism::dyad_points(mechanism))
    names.push_back(mechanism.points[static_cast<std::size_t>(point)].name);
  return names;
}

/// "left", "right" where there is a dyad, "ahead", "behind" where there is a slider.
std::vector<std::string> side_choices(const mechanism::Mechanism& mechanism) {
  std::vector<std::string> choices;
  for (const mechanism::PointIndex point : mechanism::dyad_points(mechanism))
    for (const int sign : {1, -1}) {
      const std::string side = mechanism::side_name(mechanism, point, sign);
      if (std::find(choices.begin(), choices.end(), side) == choices.end()) choices.push_back(side);
    }
  return choices;
}

/// Such as L=0.4; of one name.
bool is_assignment(const std::string& word) {
  const std::size_t equals = word.find('=');
  return equals != std::string::npos && equals != 0 && equals + 1 != word.size() && equals == word.rfind('=');
}

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

void add_export_argument(CLI::App& command, std::string& formats, const std::string& description) {
  command.add_option("--export", formats, description)->type_name("LIST")->capture_default_str();
}

void add_common_arguments(CLI::App& command, CommonArguments& arguments) {
  command.add_option("MODEL", arguments.model, "The mechanism file (YAML), or a file that the command import reads")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--set", arguments.overrides,
                  "Give a parameter another value, in the unit in which the file writes it (repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  command
      .add_option_function<std::vector<std::string>>(
          "--preload",
          [&arguments](const std::vector<std::string>& words) {
            for (const std::string& word : words) {
              if (!is_assignment(word))
                refuse("--preload", fmt::format("'{}' is not joint=value", word),
                       "write e.g. --preload A4=3.5, once for each joint");
              arguments.overrides.push_back("preload_" + word);
            }
          },
          "Give a motor of free effort its effort, in N m or N (repeatable)")
      ->allow_extra_args(false)
      ->type_name("JOINT=VALUE");
  command.add_option("-o,--output", arguments.output, "Folder for the files (default: ./out/<name of MODEL>)")
      ->type_name("DIR");
  command.add_flag("--quiet", arguments.quiet, "Print no table and no progress bar");
  command.add_flag("--json", arguments.json, "Print the answer as JSON in place of the table");
  command
      .add_option(
          "--time-limit", arguments.time_limit,
          "Largest time. When it is over, the program writes what it knows, marked as incomplete; exit status 3")
      ->type_name("SECONDS");
}

std::vector<mechanism::Override> parse_overrides(const std::vector<std::string>& words) {
  std::vector<mechanism::Override> overrides;
  for (const std::string& word : words) {
    if (!is_assignment(word))
      refuse("--set", fmt::format("'{}' is not name=value", word), "write e.g. --set L=0.4, once for each parameter");
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    if (std::any_of(overrides.begin(), overrides.end(), [&](const auto& known) { return known.first == name; }))
      refuse("--set", fmt::format("'{}' is given twice", name), "give each parameter and each effort one value");
    overrides.emplace_back(name, word.substr(equals + 1));
  }
  return overrides;
}

mechanism::Mechanism read_model(const CommonArguments& arguments) {
  return mechanism::read_mechanism(arguments.model, parse_overrides(arguments.overrides));
}

std::filesystem::path output_folder(const CommonArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  // "...yaml" without its ending is "..", and out/.. no folder of its own.
  const std::filesystem::path stem =
      mechanism::is_address(arguments.model) ? "address" : std::filesystem::path(arguments.model).stem();
  return std::filesystem::path("out") / (stem.empty() || stem == "." || stem == ".." ? "model" : stem);
}

std::string written_words(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files) names.push_back(file.filename().string());
  return fmt::format("Written to {}: {}\n", core::printable(folder.string()), fmt::join(names, ", "));
}

std::vector<std::string> split(const std::string& text, char separator) {
  constexpr const char* blanks = " \t";
  std::vector<std::string> words;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::size_t first = word.find_first_not_of(blanks);
    words.push_back(first == std::string::npos ? "" : word.substr(first, word.find_last_not_of(blanks) - first + 1));
    begin = end + 1;
  }
  return words;
}

std::vector<core::Quantity> parse_quantities(const std::string& text) {
  constexpr auto all = core::all_quantities;
  std::vector<core::Quantity> quantities;
  for (const std::string& word : split(text)) {
    const auto* const found =
        std::find_if(all.begin(), all.end(), [&](core::Quantity quantity) { return to_string(quantity) == word; });
    if (found == all.end())
      refuse("--quantity", fmt::format("unknown quantity '{}'", word),
             "choose from f, N, T, M, F, fx, fy, fz, mx, my, mz");
    if (std::find(quantities.begin(), quantities.end(), *found) == quantities.end()) quantities.push_back(*found);
  }
  return quantities;
}

DyadSides parse_working_mode(const std::string& text, const mechanism::Mechanism& mechanism) {
  const std::vector<std::string> names = dyad_names(mechanism);
  const std::vector<std::string> words = split(text);
  if (names.empty())
    refuse("--working-mode", "the mechanism has no dyad, so there is one working mode only", "leave the option out");
  const std::vector<mechanism::PointIndex> points = mechanism::dyad_points(mechanism);
  const std::string choice = fmt::format("{}", fmt::join(side_choices(mechanism), " or "));
  const std::string mend = fmt::format("give {} for each of {} ({}), or all", choice, fmt::join(names, ","),
                                       names.size() == 1 ? "1 dyad" : fmt::format("{} dyads", names.size()));
  if (words.size() != names.size())
    refuse("--working-mode", fmt::format("'{}' has {} side{}", text, words.size(), words.size() == 1 ? "" : "s"), mend);
  DyadSides sides;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string plus = mechanism::side_name(mechanism, points[i], 1);
    if (words[i] != plus && words[i] != mechanism::side_name(mechanism, points[i], -1))
      refuse("--working-mode", fmt::format("'{}' is not a side of {}", words[i], names[i]), mend);
    sides.push_back(words[i] == plus ? 1 : -1);
  }
  return sides;
}

core::Rational parse_number(const std::string& text, const std::string& option, const mechanism::Mechanism& mechanism,
                            const std::string& key) {
  const std::string mend = "give a number such as 0.25 or 1/4, or an expression in the file's parameters";
  try {
    core::Rational value = mechanism::value_in_si(text, key, mechanism, {.file = option});
    if (const auto reason = mechanism::unusable(value)) refuse(option, fmt::format("'{}' {}", text, *reason), mend);
    return value;
  } catch (const std::domain_error& error) {
    refuse(option, fmt::format("'{}': {}", text, error.what()), mend);
  } catch (const std::out_of_range& error) {
    refuse(option, fmt::format("'{}': {}", text, error.what()), mend);
  }
}

core::Rational parse_positive(const std::string& text, const std::string& option, const mechanism::Mechanism& mechanism,
                              const std::string& key) {
  core::Rational value = parse_number(text, option, mechanism, key);
  if (value <= 0) refuse(option, fmt::format("{} is not above zero", text), "give a positive number");
  return value;
}

namespace {

/// The values of "y=-0.7,x=0.25" in the order of the coordinates.
std::vector<std::string> named_values(const std::vector<std::string>& words, const mechanism::Mechanism& mechanism) {
  std::vector<std::string> names;
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) names.push_back(coordinate.name);
  const std::string mend = fmt::format("give {}=...", fmt::join(names, "=...,"));
  std::vector<std::string> values(names.size());
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) refuse("--at", fmt::format("'{}' has no name, and others have", word), mend);
    const std::vector<std::string> sides = split(word, '=');
    const auto name = std::find(names.begin(), names.end(), sides[0]);
    if (name == names.end()) refuse("--at", fmt::format("there is no free coordinate '{}'", sides[0]), mend);
    std::string& value = values[static_cast<std::size_t>(name - names.begin())];
    if (!value.empty()) refuse("--at", fmt::format("{} is there twice", *name), mend);
    value = word.substr(equals + 1);
    if (value.empty()) refuse("--at", fmt::format("{} has no value", *name), mend);
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    if (values[i].empty()) refuse("--at", fmt::format("{} is missing", names[i]), mend);
  return values;
}

}  // namespace

std::vector<core::Rational> parse_pose(const std::string& text, const mechanism::Mechanism& mechanism) {
  std::vector<std::string> words = split(text);
  if (text.find('=') != std::string::npos) words = named_values(words, mechanism);
  if (words.size() != mechanism.coordinates.size()) {
    std::vector<std::string> names;
    for (const mechanism::Coordinate& coordinate : mechanism.coordinates) names.push_back(coordinate.name);
    refuse("--at", fmt::format("'{}' has {} value{}", text, words.size(), words.size() == 1 ? "" : "s"),
           fmt::format("give one for each of the {} free coordinate{}: {}", names.size(), names.size() == 1 ? "" : "s",
                       fmt::join(names, ",")));
  }
  std::vector<core::Rational> pose;
  for (std::size_t i = 0; i < words.size(); ++i)
    pose.push_back(parse_number(words[i], "--at", mechanism, mechanism::key_of(mechanism.coordinates[i])));
  return pose;
}

std::vector<double> parse_rates(const std::string& text, const std::string& option,
                                const mechanism::Mechanism& mechanism) {
  if (text.empty()) return {};
  std::vector<double> rates;
  const std::string rate = option == "--velocity" ? "speed" : "acceleration";
  for (const std::string& word : split(text)) {
    const bool angle = rates.size() < mechanism.coordinates.size() && mechanism.coordinates[rates.size()].angle;
    rates.push_back(core::to_double(parse_number(word, option, mechanism, (angle ? "angular_" : "linear_") + rate)));
  }
  if (rates.size() != mechanism.coordinates.size())
    refuse(option, fmt::format("'{}' has {} value{}", text, rates.size(), rates.size() == 1 ? "" : "s"),
           fmt::format("give one for each free coordinate, {} in all", mechanism.coordinates.size()));
  return rates;
}

std::vector<int> parse_grid(const std::string& text, std::size_t coordinates) {
  struct Usual {
    int most;  // along a coordinate; their product is the edge of what a machine of today holds
    const char *what, *example;
  };
  constexpr std::array<Usual, 3> usual = {{{1000000, "number of steps along the only free coordinate", "720"},
                                           {20000, "grid over two coordinates", "400x400"},
                                           {2000, "grid over three coordinates", "40x40x40"}}};
  core::ensure(1 <= coordinates && coordinates <= usual.size(), "grids are over one to three coordinates");
  const Usual& defaults = usual[coordinates - 1];
  std::vector<int> grid;
  for (const std::string& word : split(text, 'x'))
    if (const std::optional<int> count = whole_number(word); count && *count >= 2 && *count <= defaults.most)
      grid.push_back(*count);
  if (grid.size() == coordinates && split(text, 'x').size() == coordinates) return grid;
  refuse("--grid", fmt::format("'{}' is not a {}", text, defaults.what),
         coordinates == 1
             ? fmt::format("give one number from 2 to {}, e.g. --grid {}", defaults.most, defaults.example)
             : fmt::format("give the cells along each, from 2 to {}, e.g. --grid {}", defaults.most, defaults.example));
}

std::pair<std::size_t, double> parse_slice(const std::string& text, const mechanism::Mechanism& mechanism) {
  const std::size_t equals = text.find('=');
  for (std::size_t c = 0; equals != std::string::npos && c < mechanism.coordinates.size(); ++c) {
    const mechanism::Coordinate& coordinate = mechanism.coordinates[c];
    if (split(text.substr(0, equals)) != std::vector{coordinate.name}) continue;
    const core::Rational value =
        parse_number(text.substr(equals + 1), "--slice", mechanism, mechanism::key_of(coordinate));
    if (value < coordinate.lower || value > coordinate.upper)
      refuse("--slice", fmt::format("'{}' is out of the range of {}", text, coordinate.name), "give a value within it");
    return {c, core::to_double(value)};
  }
  refuse("--slice", fmt::format("'{}' is no slice", text), "give a free coordinate and its value, such as z=0.3");
}

std::vector<std::string> parse_joints(const std::vector<std::string>& words, const mechanism::Mechanism& mechanism) {
  std::vector<std::string> allowed;
  for (const mechanism::Joint& joint : mechanism.joints) allowed.push_back(joint.name);
  std::vector<std::string> joints;
  for (const std::string& word : words)
    for (const std::string& name : split(word)) {
      if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
        refuse("--joint", fmt::format("the mechanism has no joint '{}'", name),
               fmt::format("choose from {}", fmt::join(allowed, ", ")));
      if (std::find(joints.begin(), joints.end(), name) == joints.end()) joints.push_back(name);
    }
  return joints;
}

std::set<std::string> parse_formats(const std::string& text, const std::vector<std::string>& allowed) {
  std::set<std::string> formats;
  for (const std::string& word : split(text)) {
    if (std::find(allowed.begin(), allowed.end(), word) == allowed.end())
      throw core::InputError({.file = "--export"}, fmt::format("unknown format '{}'", word),
                             fmt::format("choose from {}", fmt::join(allowed, ", ")));
    formats.insert(word);
  }
  return formats;
}

}  // namespace clearloci::cli
