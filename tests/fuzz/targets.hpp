// What is fuzzed: each target takes any bytes and throws PropertyBroken, or whatever escapes the code under test, where
// its property does not hold. tests/fuzz/README.md lists them.
#pragma once

#include <string_view>

namespace clearloci::fuzz {

/// A mechanism file: read, checked, and every number of what comes out finite.
void mechanism_target(std::string_view bytes);

/// Another program's file of any format that is known: refused, or a mechanism file that is read or refused.
void import_target(std::string_view bytes);

/// A task file, beside mechanisms of the plane, of angles and of space.
void task_target(std::string_view bytes);

/// A trajectory file, beside the same.
void trajectory_target(std::string_view bytes);

/// An expression: printed and read again it is the same, in words and in value.
void expression_target(std::string_view bytes);

/// A certificate: read, and what it names is there. Whether its claims hold is not asked.
void certificate_target(std::string_view bytes);

/// A call of a command that traces loci: one word a line, the first one the number of a mechanism.
void arguments_target(std::string_view bytes);

/// What a browser, or anything else, sends over a connection to the workbench's server. @TOKEN@ and @PORT@ stand for
/// its own.
void server_target(std::string_view bytes);

}  // namespace clearloci::fuzz
