// Mutations of the project's texts that keep their shape: numbers become other numbers, names other names of the text,
// keys, brackets and lines are swapped, copied and left out. What comes out is nearly right, and so reaches what stands
// behind the YAML parser.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace clearloci::fuzz {

/// Fragments that a text of some kind may hold: values, entries ("key: value" lines), keys.
struct Vocabulary {
  std::vector<std::string> numbers;  ///< numbers and expressions
  std::vector<std::string> words;    ///< keys and values that have a meaning
  std::vector<std::string> groups;   ///< in brackets
  std::vector<std::string> lines;    ///< whole lines
};

/// One of the vocabularies: "mechanism", "import", "task", "trajectory", "expression", "arguments".
const Vocabulary& vocabulary_of(const std::string& target);

/// The text after one to a few mutations; the same seed gives the same text.
std::string mutated(const std::string& text, const Vocabulary& vocabulary, std::uint32_t seed);

/// Some of the lines of one text and some of the other, in blocks of like indentation.
std::string crossed(const std::string& first, const std::string& second, std::uint32_t seed);

}  // namespace clearloci::fuzz
