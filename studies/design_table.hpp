// Finished designs on disk, as they come: a table that is appended and synced, so that a run that ends at any moment,
// in the middle of a line too, goes on from there. Private to studies/.
//
//     clearloci designs 1 <hash of model, study and tasks>
//     <index> <status> <task> <x> <y> <figures...> <reason, percent-encoded> <checksum>
//
// Numbers are the shortest decimals that read back as the same doubles. A line whose checksum is not that of its text
// was cut; it and what follows are dropped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "clearloci/study.hpp"

namespace clearloci {

/// One design without the values of its parameters, which follow from its index.
std::string table_line(const core::StudyDesign& design);
/// False: the line is damaged.
bool read_table_line(std::string_view line, std::size_t figures, core::StudyDesign& design);

class DesignTable {
 public:
  /// Opens the table, and reads what it holds where `resume`. Throws core::InputError where it cannot be written, is of
  /// another study, or is in use by another run.
  DesignTable(std::filesystem::path path, const std::string& hash, std::size_t figures, bool resume);
  ~DesignTable();
  DesignTable(const DesignTable&) = delete;
  DesignTable& operator=(const DesignTable&) = delete;

  std::vector<core::StudyDesign> take() { return std::move(known_); }

  /// Appends lines and waits until they are on the disk.
  void append(const std::string& lines);

  /// Puts the lines of these designs, in their order, in the place of all that were appended: a run that has come to
  /// its end leaves the same bytes whatever came first.
  void settle(const std::vector<core::StudyDesign>& designs);

 private:
  void check_own() const;
  void read(const std::string& header, std::size_t figures);
  [[noreturn]] void refuse(const std::string& what) const;

  std::filesystem::path path_;
  std::string header_;
  int file_ = -1;
  std::vector<core::StudyDesign> known_;
};

/// 64 bits of FNV-1a, as 16 hexadecimal digits.
std::string hash_of(std::string_view text);

}  // namespace clearloci
