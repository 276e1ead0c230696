// Files that are whole or not there.
#pragma once

#include <filesystem>
#include <string_view>

namespace clearloci::report {

/// Writes `bytes` to `path`: into a temporary name in the same folder, which then takes the place of `path`. A reader
/// sees the old file or the new one, never a part; after a failure no temporary is left. Missing folders are made.
/// Throws core::InputError, naming the path and the system's reason, where that is not possible.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Removes the temporary names of every write under way in this process, for a process that ends in the middle of one.
/// May be called from a signal handler.
void remove_temporaries();

}  // namespace clearloci::report
