// From a task file (docs/reference/task-files.md) to a Task.
#pragma once

#include <string>

#include "core/task.hpp"
#include "mechanism/handed_files.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// Throws core::InputError, with file, line, column, problem and mend, for whatever is wrong with the file: among that
/// a shape that is empty, crosses itself or leaves the mechanism's box.
core::Task read_task(const std::string& path, const Mechanism& mechanism);

/// The same for a text; `file` is the name that errors show. `handed`: the files that the text names; null: they are
/// read from beside `file`.
core::Task parse_task(const std::string& text, const std::string& file, const Mechanism& mechanism,
                      const HandedFiles* handed = nullptr);

/// Whether two lengths are free, and nothing else.
bool is_plane(const Mechanism& mechanism);

}  // namespace clearloci::mechanism
