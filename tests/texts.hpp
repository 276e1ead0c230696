// Texts of examples, and changes of them.
#pragma once

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "tests/source_dir.hpp"

namespace clearloci {

/// Of examples/NAME.yaml.
inline std::string example_text(const std::string& name) {
  std::ifstream file(source_dir() + "/examples/" + name + ".yaml");
  if (!file) throw std::logic_error("there is no example " + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The first of `from` replaced; throws std::logic_error where there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("'" + from + "' is not in the text");
  return text.replace(at, from.size(), to);
}

}  // namespace clearloci
