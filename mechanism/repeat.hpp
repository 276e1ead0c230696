// `repeat`: parts of a mechanism file that are alike, written once and read as if they were written out.
// Private to mechanism/.
//
//     repeat:
//       i: [1, 2, 3]
//       table: {a: [10 deg, 130 deg, 250 deg]}            parameters a1, a2, a3
//       points: {'A{i}': ['cos(a{i})', 'sin(a{i})', 0]}   points A1, A2, A3, after the plain ones
#pragma once

#include <vector>

#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism {

/// The document without its `repeat`, which may be one block or a list of them: for each value of i a copy of every
/// section, {i} replaced by the value, appended to the section of the same name among `sections`. The nodes of copies
/// keep their place in the text; the file in it is followed by " (i = 3)".
Value expand_repeat(const Value& document, const std::vector<std::string>& sections);

/// An error in a copy as one of the file: its place without the value of i, which the text says instead.
core::InputError told_of_file(const core::InputError& error, const std::string& file);

}  // namespace clearloci::mechanism
