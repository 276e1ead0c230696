// What is drawn as what is constructed: the mechanism file in which every point has its construction, as the program
// found it (docs/guide/drawn-form.md). Its answers are those of the drawing.
//
//     const auto found = clearloci::normalize(clearloci::Model::read("sketch.yaml"));
//     std::cout << found.text;
#pragma once

#include <string>
#include <vector>

#include "clearloci/mechanism.hpp"

namespace clearloci {

struct NormalizedFile {
  std::string text;  ///< a mechanism file: repetitions written out, a comment behind every construction that was found
  std::vector<std::string> notes;  ///< such as by how much points moved to close with the lengths given
};

/// Of the model's file with the values put in. A file in which nothing is drawn has the constructions that it had.
NormalizedFile normalize(const Model& model);

}  // namespace clearloci
