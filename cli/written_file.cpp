#include "cli/written_file.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "report/files.hpp"
#include "report/loci_json.hpp"

namespace clearloci::cli {

void put_out(const WrittenFile& file, const std::string& output, bool json, bool quiet) {
  if (!output.empty()) report::write_atomically(output, file.text);
  if (json) {
    nlohmann::ordered_json object = {{"format", 1}};
    if (!file.source.empty()) object["source"] = file.source;
    object["text"] = file.text;
    object["notes"] = file.notes;
    fmt::print("{}", report::json_text(object));
  } else if (output.empty()) {
    fmt::print("{}", file.text);
  } else if (!quiet) {
    for (const std::string& note : file.notes) fmt::print("{}\n", note);
    fmt::print("Written to {}\n", output);
  }
}

}  // namespace clearloci::cli
