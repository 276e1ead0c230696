// From the words of the command line to values. Whatever is wrong with them is a core::InputError that names the
// option, or a CLI::ParseError.
#pragma once

#include <CLI/App.hpp>
#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "analysis/loci.hpp"
#include "core/rational.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::cli {

/// What every command takes.
struct CommonArguments {
  std::string model = {};
  std::vector<std::string> overrides = {};  ///< "name=value"
  std::string output = {};                  ///< folder; empty: not given
  bool quiet = false;
  bool json = false;
  std::string time_limit = {};  ///< seconds; empty: none
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
};

void add_common_arguments(CLI::App& command, CommonArguments& arguments);

/// --export: names of formats after commas.
void add_export_argument(CLI::App& command, std::string& formats, const std::string& description);

/// {"L", "0.4"} of "L=0.4".
std::vector<mechanism::Override> parse_overrides(const std::vector<std::string>& words);

/// The mechanism file with its overrides.
mechanism::Mechanism read_model(const CommonArguments& arguments);

/// `-o DIR`, or ./out/<file name without its ending>, ./out/model where that is no name.
std::filesystem::path output_folder(const CommonArguments& arguments);

/// "Written to out/five_bar: loci.json, loci.png", with the end of the line.
std::string written_words(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

/// The words between the commas, without the blanks around them.
std::vector<std::string> split(const std::string& text, char separator = ',');

/// "f,M,fx,fy".
std::vector<core::Quantity> parse_quantities(const std::string& text);

/// "left,right": the side of every dyad of the mechanism.
DyadSides parse_working_mode(const std::string& text, const mechanism::Mechanism& mechanism);

/// A number by the rules of the mechanism file ("0.25", "1/4", "2*L"), exact. `option` is named in errors.
/// In the units of the file as what stands under the key of that name ("margin", "min_force"); "": a pure number.
core::Rational parse_number(const std::string& text, const std::string& option, const mechanism::Mechanism& mechanism,
                            const std::string& key = {});

/// parse_number, and more than zero.
core::Rational parse_positive(const std::string& text, const std::string& option, const mechanism::Mechanism& mechanism,
                              const std::string& key = {});

/// "0.25,-0.7" or, in any order, "y=-0.7,x=0.25": one number a free coordinate.
std::vector<core::Rational> parse_pose(const std::string& text, const mechanism::Mechanism& mechanism);

/// "3,-1.5": one rate a free coordinate; none where nothing was written.
std::vector<double> parse_rates(const std::string& text, const std::string& option,
                                const mechanism::Mechanism& mechanism);

/// "400x400", "40x40x40" or "720": a number for each of so many coordinates, 2 at least.
std::vector<int> parse_grid(const std::string& text, std::size_t coordinates);

/// "z=0.3": a coordinate by its place, and a value within its range.
std::pair<std::size_t, double> parse_slice(const std::string& text, const mechanism::Mechanism& mechanism);

/// `options.joints`, each of which may list several after commas; checked against the mechanism.
std::vector<std::string> parse_joints(const std::vector<std::string>& words, const mechanism::Mechanism& mechanism);

/// --export: names after commas. Throws core::InputError for one that is not among those that the answer has.
std::set<std::string> parse_formats(const std::string& text, const std::vector<std::string>& allowed);

}  // namespace clearloci::cli
