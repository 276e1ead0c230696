#include <string>

#include "mechanism/import/import.hpp"
#include "mechanism/read.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/fuzz/targets.hpp"

namespace clearloci::fuzz {

/// What is imported is a text that the reader of mechanism files reads, or refuses as any other; the same bytes give
/// the same text, and no note is longer than a screen.
void import_target(std::string_view bytes) {
  const std::string text(bytes);
  const auto found = value_or_complaint([&] { return mechanism::import_text(text, "source"); });
  if (!found) return;
  if (found->format.empty()) {
    require(found->text == text, "a text in no format that is known comes back as it is");
    return;
  }
  const auto again = value_or_complaint([&] { return mechanism::import_text(text, "source"); });
  require(again && again->text == found->text, "the same bytes give the same mechanism file");
  require(mechanism::import_format(found->text).empty(), "what is imported is a mechanism file");
  for (const std::string& note : found->notes) {
    const auto flaw = flaw_of_message(note);
    require(!flaw, "a note is fit to be shown: " + flaw.value_or(""));
  }
  (void)value_or_complaint([&] { return mechanism::parse_mechanism(found->text, "own.yaml"); });
}

}  // namespace clearloci::fuzz
