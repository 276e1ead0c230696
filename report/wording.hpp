// The words in which tables, legends and file names speak of loci.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::report {

/// "f_A1", "M_A1", "fx_A1".
std::string reaction_name(const core::Vanishing& vanishing);

/// "f_A1 f_B1 M_A1".
std::string reaction_names(std::span<const core::Vanishing> vanishing);

/// "contact loss", "direct singularity", ...: to_string(kind) as words.
std::string kind_words(core::LocusKind kind);

/// "contact lost: A1, B1, P; backlash: A1"; empty where nothing vanishes.
std::string vanishing_words(core::LocusKind kind, std::span<const core::Vanishing> vanishing);

/// Whether a factor is short enough to be read, in columns and in the digits of its numbers.
bool reads_well(const std::string& factor, int longest);

/// How long a factor may be that stands beside numbers of the map: none is read where the map is in other units than
/// the polynomials, which are in m.
int readable_factor(const core::LocusMap& map, int longest);

/// Why it vanishes: the cause; the factor, where it reads well, as it stands; else what the vanishing means by
/// virtual work, which holds of any factor: "the loads do no work in the motion that A1 alone drives".
std::string reason_words(core::LocusKind kind, std::span<const core::Vanishing> vanishing, const std::string& factor,
                         const std::string& cause, int longest);

/// "circle centre (1/2, -1/2), radius 1/2", "line 2 x - 1 = 0"; empty without a closed form. Irrational numbers are
/// decimals, or with `exact` multiples of roots: "√3/4".
std::string closed_form_words(const core::ClosedForm& form, std::span<const std::string> coordinates,
                              bool exact = false);

/// Sentences of a map each once; those that say the same of several reactions as one.
std::vector<std::string> told_once(const std::vector<std::string>& notes);

/// "B1 right, B2 left"; empty for a mechanism without a choice.
std::string mode_words(const core::TowerNames& tower, const core::WorkingMode& mode);

/// "right-left": the mode as a part of a file's name.
std::string mode_slug(const core::TowerNames& tower, const core::WorkingMode& mode);

/// The numbers of a value as it is written as decimals: "0.35" of "7/20", "0.333333 N/mm" of "1/3 N/mm". An expression
/// is left as it is.
std::string decimal_words(const std::string& value);

/// Names and exact values, as answers have them.
using Parameters = std::vector<std::pair<std::string, std::string>>;

/// "L = 0.5, k = 3 N/mm"; `exact`: "L = 1/2".
std::string parameter_words(const Parameters& parameters, bool exact = false);

/// The same as the line of a text, with its end; empty without parameters.
std::string parameter_line(const Parameters& parameters, bool exact = false);

/// The modes of the map's curves, points and regions, each once, in order of appearance.
std::vector<core::WorkingMode> modes_of(const core::LocusMap& map);

/// The shortest decimal of at most `digits` significant digits: "0.785", "1e-05", "-2". No "-0".
std::string short_number(double value, int digits);

/// Significant digits in texts: of places and loads, which may be typed in again; of sizes; of what needs few.
inline constexpr int place_digits = 9, size_digits = 6, few_digits = 4;

/// A bound to so many digits that stays one.
double rounded_down(double value, int digits);
double rounded_up(double value, int digits);

/// Engineering notation: an exponent that is a multiple of three where the number is not between 0.001 and 1e6:
/// "12.5e-6", "0.25", "1234.5". No "-0".
std::string engineering(double value, int digits);

/// Of one of several numbers whose largest is `beside`: "0" for what rounding leaves of it.
std::string engineering_beside(double value, double beside, int digits);

/// What passes through zero at the marks of a plot: "M = 0: backlash crossed", "M or F = 0: backlash crossed; an end of
/// a guide lifts".
std::string zero_words(std::span<const core::Quantity> quantities);

/// "150 N", "20.22 kN".
std::string force_words(double newtons);

/// The shortest decimal that reads back as the same double.
std::string exact_number(double value);

/// core::printable: what a user calls a mechanism must not break a file.
std::string printable(std::string_view text);

/// Code points of `text`, the number of columns it takes in a terminal (wide scripts aside).
int columns(std::string_view text);

/// Of the coordinates: one of all lengths; one a coordinate where angles are among them.
std::vector<std::string> units_of(const core::LocusMap& map);

}  // namespace clearloci::report
