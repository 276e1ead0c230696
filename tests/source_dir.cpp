#include "tests/source_dir.hpp"

namespace clearloci {

std::string source_dir() { return CLEARLOCI_SOURCE_DIR; }

}  // namespace clearloci
