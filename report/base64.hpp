// Bytes inside JSON.
#pragma once

#include <string>

namespace clearloci::report {

std::string base64(const std::string& bytes);

}  // namespace clearloci::report
