#include "clearloci/import.hpp"

#include "mechanism/import/import.hpp"

namespace clearloci {
namespace {

mechanism::ImportOptions options_of(const ImportRequest& request) {
  return {request.clearance, request.side, request.side_file};
}

ImportedFile told(mechanism::Imported imported) {
  return {std::move(imported.text), std::move(imported.format), std::move(imported.notes)};
}

}  // namespace

ImportedFile import_file(const std::string& path, const ImportRequest& request) {
  return told(mechanism::import_file(path, options_of(request)));
}

ImportedFile import_text(const std::string& text, const std::string& file, const ImportRequest& request) {
  return told(mechanism::import_text(text, file, options_of(request)));
}

std::vector<std::string> import_formats() { return mechanism::import_formats(); }

}  // namespace clearloci
