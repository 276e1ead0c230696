// From the YAML file of mechanism-file.md to a Mechanism, with every check that needs no algebra.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// `--set name=value` of the command line.
using Override = std::pair<std::string, std::string>;

/// The text of a model: of a mechanism file as it is, of another program's file or address as the drawn form that it is
/// imported as (docs/guide/import.md).
struct ModelText {
  std::string text;
  std::vector<std::string> notes;  ///< what the import says
  std::string file;                ///< the name that errors in the text show
};
ModelText read_model_text(const std::string& path);
ModelText model_text(std::string text, std::string file);

/// Throws core::InputError, with file, line, column, problem and mend, for whatever is wrong with the input. Of another
/// program's file too, whose notes are the mechanism's.
Mechanism read_mechanism(const std::string& path, const std::vector<Override>& overrides = {});

/// The same for the text of a mechanism file; `file` is the name that errors show.
Mechanism parse_mechanism(const std::string& text, const std::string& file,
                          const std::vector<Override>& overrides = {});

/// The same for many values of the parameters: the text is taken apart once, here.
using MechanismReader = std::function<Mechanism(const std::vector<Override>& overrides)>;
MechanismReader mechanism_reader(const std::string& text, const std::string& file);

/// A mechanism file in which every point has a construction.
struct WrittenMechanism {
  std::string text;
  std::vector<std::string> notes;
};
/// The same mechanism as a file that says how it closes; what is drawn is constructed.
WrittenMechanism constructed_text(const std::string& text, const std::string& file);

/// The keys of a mechanism file, in the order of mechanism-file.md; what a help text names.
const std::vector<std::string>& file_keys();

/// No mechanism, task or path that a person writes comes near; a device or a wrong file would fill the memory.
constexpr std::size_t largest_text = std::size_t{4} << 20;
/// A file's bytes. Throws core::InputError where it cannot be read or has more of them. `what`: "the mechanism file".
std::string read_text(const std::string& path, const std::string& what, std::size_t most = largest_text);

/// The value of such an expression in SI units, where the mechanism's file has a key of that name: "margin" of a
/// length, "min_force" of a force; "" of a pure number. Throws InputError for what cannot be read or measures something
/// else, std::domain_error and std::out_of_range as value_of.
Rational value_in_si(const std::string& text, const std::string& key, const Mechanism& mechanism,
                     const core::SourcePosition& where);

/// The key of that kind for the values of a free coordinate.
std::string key_of(const Coordinate& coordinate);

/// An expression by the rules of mechanism-file.md, e.g. "2*L + cos(30 deg)". `where`: its place, for errors.
Expression parse_expression(const std::string& text, const core::SourcePosition& where);

}  // namespace clearloci::mechanism
