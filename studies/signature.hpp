// What a study asks, as one text: two studies with the same text have the same answer. Private to studies/.
#pragma once

#include <string>

#include "clearloci/study.hpp"

namespace clearloci {

std::string signature(const Model& model, const core::Study& study);

}  // namespace clearloci
