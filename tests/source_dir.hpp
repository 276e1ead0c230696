// The folder of the repository, for tests that read examples and corpus. A function of one small source: a path in the
// other sources would keep ccache from serving one checkout what another one compiled.
#pragma once

#include <string>

namespace clearloci {

// Absolute, without a slash at its end.
std::string source_dir();

}  // namespace clearloci
