// A mechanism file that a command writes or prints, with notes on it.
#pragma once

#include <string>
#include <vector>

namespace clearloci::cli {

struct WrittenFile {
  std::string source = {};  ///< the program that the text was made from a file of; "" of our own
  const std::string& text;
  const std::vector<std::string>& notes;
};

/// Writes the text to `output`, where there is one, and prints what then is wanted: JSON, the text, or the notes.
void put_out(const WrittenFile& file, const std::string& output, bool json, bool quiet);

}  // namespace clearloci::cli
