// From a study file (docs/guide/studies.md) to a Study.
#pragma once

#include <cstddef>
#include <string>

#include "clearloci/study.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// Designs are numbered and kept one by one.
inline constexpr long most_designs = 1'000'000'000;
inline constexpr std::size_t most_varied = 16;

/// Throws core::InputError, with file, line, column, problem and mend, for whatever is wrong with the file or with a
/// task that it names, which is found beside it.
core::Study read_study(const std::string& path, const Mechanism& mechanism);

/// The same for a text; `file` is the name that errors show.
core::Study parse_study(const std::string& text, const std::string& file, const Mechanism& mechanism);

/// One side of a `keep` and the other, of which left - right >= 0 is asked, or > 0 where `strict`.
struct Keep {
  Expression left, right;
  bool strict = false;
};

/// "L1 + L2 <= 0.9", in the file's own numbers. Throws core::InputError at `where`; among that where a plain number is
/// compared with a parameter that carries a unit.
Keep parse_keep(const std::string& text, const core::SourcePosition& where, const Mechanism& mechanism);

}  // namespace clearloci::mechanism
