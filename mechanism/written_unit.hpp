// The units in which parameters are written: a plain number that takes the place of one is meant in its unit.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// A unit by the powers of its names. `factor` pi^pi: one of it in the file's own numbers.
struct ParameterUnit {
  std::vector<std::pair<std::string, int>> powers;
  Rational factor = 1;
  int pi = 0;

  bool operator==(const ParameterUnit&) const = default;
};

/// N/mm of `2 N/mm`. Nothing of plain numbers, and where terms are in different units; parameters count in the file's
/// units. `written`: with the symbols of parse_with_units.
std::optional<ParameterUnit> written_unit(const Expression& written, const Mechanism& mechanism);

/// "N/mm", "kg mm^2": as it stands behind a number.
std::string words_of(const ParameterUnit& unit);

/// A number in the unit, as an expression in the file's own numbers.
Expression in_file_numbers(const Expression& number, const ParameterUnit& unit);

/// The file's unit of what a parameter measures; nothing of a plain number.
std::optional<ParameterUnit> unit_of(const Parameter& parameter, const Units& units);

/// A value of the parameter, in the file's own numbers, as text that reads back as it: "3 N/mm", "7/20".
std::string value_words(const Parameter& parameter, const Rational& value, const Units& units);

/// The parameter's value: "3 N/mm", "30 deg", "7/20"; an expression where it is irrational.
std::string value_words(const Parameter& parameter, const Mechanism& mechanism);

/// Of every parameter its name and value_words: what answers tell of a mechanism's parameters. Without efforts that are
/// free and have no value.
std::vector<std::pair<std::string, std::string>> told_parameters(const Mechanism& mechanism);

}  // namespace clearloci::mechanism
