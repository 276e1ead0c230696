// What people call things that the files call by another name, or have in another form, and what is written instead.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace clearloci::mechanism {

/// What to write in place of a key that does not exist; nothing where that is not known. `known`: the keys that exist
/// there.
std::optional<std::string> what_to_write_for(const std::string& key, const std::vector<std::string>& names);

/// What may stand under a key, such as "{length: mm}" under `units`; nothing where that is not known.
std::optional<std::string> example_of(const std::string& key);

}  // namespace clearloci::mechanism
