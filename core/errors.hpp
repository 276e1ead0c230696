// The three kinds of failure are never mixed: wrong input throws InputError, a broken promise of our own code hits
// `ensure`, and degenerate mathematics is a value that the caller receives.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace clearloci::core {

/// A place in a text the user wrote; line and column count from 1, 0 means unknown.
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
};

/// The input or the call is wrong. what() is one line: `file:line:column: what is wrong; how to mend it`.
class InputError : public std::runtime_error {
 public:
  InputError(SourcePosition position, std::string problem, std::string mend);

  const SourcePosition& position() const { return position_; }
  const std::string& problem() const { return problem_; }
  const std::string& mend() const { return mend_; }

 private:
  SourcePosition position_;
  std::string problem_;
  std::string mend_;
};

/// Work that could not be finished within a limit the user set.
class LimitReached : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A promise of our own code, checked in every build: throws std::logic_error naming the place, which the defaults fill
/// in (std::source_location is not to be had with Clang 14).
void ensure(bool promise, std::string_view what, const char* file = __builtin_FILE(), int line = __builtin_LINE());

}  // namespace clearloci::core
