// One file of those that come with the text of a task or a trajectory. Private to mechanism/.
#pragma once

#include "mechanism/handed_files.hpp"
#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism {

/// The bytes of the file that the value names; throws core::InputError where it was not handed over.
inline const std::string& handed_file(const HandedFiles& handed, const Value& name) {
  const auto found = handed.find(text_of(name));
  if (found != handed.end()) return found->second;
  throw core::InputError(name.where, "the file '" + text_of(name) + "' was not handed over with the text",
                         "hand it over too, or ask the program where the files lie in a folder");
}

}  // namespace clearloci::mechanism
