// From what is drawn to how it closes: a mechanism file in the drawn form as one in which every point has a
// construction, which the other readers read. Private to mechanism/.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mechanism/read.hpp"
#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism {

struct Assembled {
  Value document;                               ///< without what is drawn
  std::vector<std::string> notes;               ///< for whoever reads the answers
  std::map<std::string, std::string> comments;  ///< how points are constructed
};

/// Whether a document has the key `drawn`.
bool is_drawn(const Value& document);

/// `document`: drawn, with its repetitions written out and its points named. Throws core::InputError where the drawing
/// is wrong or does not close.
Assembled assemble(const Value& document, const std::vector<Override>& overrides);

/// A document as the text of a file, with a comment behind each construction.
std::string written_document(const Value& document, const std::map<std::string, std::string>& comments);

}  // namespace clearloci::mechanism
