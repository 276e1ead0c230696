// What the library throws: of three kinds of failure two concern its callers. Wrong input or a wrong call throws
// InputError, work that a limit of the caller's ended throws LimitReached; degenerate mathematics is a value that the
// caller receives. A broken promise of the library's own code is a std::logic_error, and a fault to be reported.
#pragma once

#include <stdexcept>
#include <string>

namespace clearloci::inline core {

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

}  // namespace clearloci::inline core
