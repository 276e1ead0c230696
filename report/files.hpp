// Files that are whole or not there, and those of one answer together.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace clearloci::report {

/// Files that appear together: each is written under a temporary name in its folder at once, and all take their places
/// at commit(). A reader sees the old files or the new ones, never parts; where commit() is not reached no temporary
/// is left. A symbolic link is written through. All throw core::InputError, naming the path and the reason.
class StagedFiles {
 public:
  StagedFiles() = default;
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Makes missing folders. Refuses what is no regular file, such as a folder or a device, what is one of
  /// keep_inputs, and what was added already.
  void add(const std::filesystem::path& path, std::string_view bytes);

  void commit();

 private:
  struct Staged {
    std::filesystem::path path, temporary;
    int place = -1;  ///< where a signal handler finds the temporary name
  };
  std::vector<Staged> staged_;
};

/// A single file.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Files that this process reads and that no file written from now on replaces: of a program with one answer, before
/// it works. Those that do not exist are passed over.
void keep_inputs(const std::vector<std::filesystem::path>& inputs);

/// Removes the temporary names of every write under way in this process, for a process that ends in the middle of one.
/// May be called from a signal handler.
void remove_temporaries();

}  // namespace clearloci::report
