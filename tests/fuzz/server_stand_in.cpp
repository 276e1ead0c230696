// The fuzzer of the server holds HTTP, admission and the fields of questions, without the engines that answer: in their
// place stand questions that read every field, and a page of one file.
#include <array>

#include "workbench/server/assets.hpp"
#include "workbench/server/questions.hpp"
#include "workbench/server/start.hpp"

namespace clearloci::workbench {
namespace {

Json read_fields(const Json& body, const Watch& watch) {
  const Fields fields(body);
  watch.progress(0.5, fields.text("file", "stage"));
  constexpr int most = 1000;
  return {{"text", fields.text("text")},
          {"joints", fields.words("joints")},
          {"at", fields.numbers("at")},
          {"files", fields.files("files").size()},
          {"min_force", fields.positive("min_force").has_value()},
          {"steps", fields.count("steps", 1, 1, most)},
          {"tolerance", fields.number("tolerance", 0, 0, 1)},
          {"all_modes", fields.flag("all_modes")}};
}

}  // namespace

Question question_named(const std::string& name) { return name == "model" || name == "loci" ? read_fields : nullptr; }

Json start_of(const ServerOptions& options) { return {{"file", options.file}}; }

std::span<const Asset> page_assets() {
  static constexpr std::array assets = {Asset{"index.html", "<!doctype html><title>page</title>"}};
  return assets;
}

}  // namespace clearloci::workbench
