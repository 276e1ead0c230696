// Units of a mechanism file: what plain numbers of a field are meant in, numbers that carry their own unit, and one
// table of what is measured where. Private to mechanism/.
//
// An expression is evaluated in the file's own numbers: with `length: mm` a coordinate x stands for its value in mm,
// `2 cm` for 20, `5 N/m` for 0.005 (N/mm), and the whole is then turned into SI by what the field measures. A product
// of units (couple, inertia, gravity, stiffness) without any unit in it is SI already: N m, kg m², m/s², N/m.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/mechanism.hpp"
#include "mechanism/written_unit.hpp"
#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism {

/// factor pi^pi: exact sizes of units, 1/180 and 1 of a degree in rad.
struct UnitSize {
  Rational factor = 1;
  int pi = 0;

  bool is_one() const { return factor == 1 && pi == 0; }
  bool operator==(const UnitSize&) const = default;
};

/// A unit has whole powers up to this, such as the m^2 of an inertia.
inline constexpr int largest_unit_power = 4;

/// What the values under a key measure; nothing of a pure number or a direction. One table for every kind of file.
std::optional<Dimension> dimension_of(const std::string& field);

/// Whether the table has the key: other keys measure what the key around them does.
bool is_field(const std::string& key);

/// "a length", "a couple", "N/mm"-like products by their powers; for messages.
std::string words_of(const Dimension& dimension);

/// A name that may stand after a number: mm, kN, deg.
bool is_unit(const std::string& name);

/// The symbol that parse_expression's tree has for a unit; no name of a file looks like it.
Expression unit_symbol(const std::string& name);

/// The units of a file, SI where it says nothing.
Units read_units(const std::optional<Value>& value);

/// An expression in SI units from one in the numbers of the file.
struct InSi {
  Expression expression;
  Dimension dimension;  ///< of the units in it; none where it is plain numbers
  bool certain = true;  ///< every part of it says what it measures
  bool has_unit = false;
  bool mixes = false;   ///< adds plain numbers to ones with a unit, or unlike ones
  bool unlike = false;  ///< adds such as a length and a force
};

/// `field`: what it measures; of a pure number nothing. Symbols are the mechanism's parameters and free coordinates.
InSi in_si(const Expression& written, const Mechanism& mechanism, const std::optional<Dimension>& field);

/// in_si for the number under a value's field, with complaints about units that do not fit.
InSi in_si(const Expression& written, const Mechanism& mechanism, const Value& value);

/// A unit's symbol: its name, and its size in the file's own numbers.
struct NamedSize {
  std::string name;
  UnitSize size;
  Dimension dimension;
};
std::optional<NamedSize> unit_of_symbol(const Expression& symbol, const Units& units);

/// One of the file's unit for that: "N/mm", 1 of it.
ParameterUnit coherent_unit(const Units& units, const Dimension& dimension);

/// The tree with units put in for SI, where no file is about.
Expression with_si_units(const Expression& written);

}  // namespace clearloci::mechanism
