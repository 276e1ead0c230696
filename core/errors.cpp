#include "core/errors.hpp"

#include <utility>

#include "core/text.hpp"

namespace clearloci::inline core {
namespace {

std::string one_line(const SourcePosition& position, const std::string& problem, const std::string& mend) {
  std::string line = position.file;
  if (position.line > 0) line += ":" + std::to_string(position.line);
  if (position.line > 0 && position.column > 0) line += ":" + std::to_string(position.column);
  if (!line.empty()) line += ": ";
  line += problem;
  if (!mend.empty()) line += "; " + mend;
  return message_line(line);
}

}  // namespace

InputError::InputError(SourcePosition position, std::string problem, std::string mend)
    : std::runtime_error(one_line(position, problem, mend)),
      position_(std::move(position)),
      problem_(std::move(problem)),
      mend_(std::move(mend)) {}

void ensure(bool promise, std::string_view what, const char* file, int line) {
  if (promise) return;
  throw std::logic_error(std::string(file) + ":" + std::to_string(line) + ": broken promise: " + std::string(what));
}

}  // namespace clearloci::inline core
