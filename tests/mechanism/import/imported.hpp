// What tests ask of an imported file: its drawn places, links and joints, and the mechanism that it is.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "mechanism/import/import.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/read.hpp"
#include "mechanism/yaml_input.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::mechanism {

inline std::string path_of(const std::string& name) { return source_dir() + "/tests/mechanism/import/files/" + name; }

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline Imported imported(const std::string& name) { return import_file(path_of(name)); }
inline Mechanism mechanism_of(const Imported& imported) { return parse_mechanism(imported.text, "own.yaml"); }

/// A section of the file, as it is written: {"C", "[120, 90]"}.
inline std::map<std::string, std::string> section(const Imported& imported, const std::string& name) {
  std::map<std::string, std::string> lines;
  std::istringstream text(imported.text);
  std::string line;
  bool inside = false;
  while (std::getline(text, line)) {
    if (!line.empty() && line[0] != ' ') inside = line == name + ":";
    if (!inside || line.substr(0, 2) != "  ") continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) lines[line.substr(2, colon - 2)] = line.substr(colon + 2);
  }
  return lines;
}

/// Where points are drawn, in the file's unit.
inline std::map<std::string, std::vector<double>> places(const Imported& imported) {
  std::map<std::string, std::vector<double>> found;
  for (const Entry& entry : entries(parse_document(imported.text, "own.yaml"))) {
    if (entry.key != "drawn") continue;
    for (const Entry& point : entries(entry.value))
      for (const Value& part : elements(point.value)) found[point.key].push_back(std::stod(text_of(part)));
  }
  return found;
}

inline double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

inline bool has_note(const Imported& imported, const std::string& words) {
  for (const std::string& note : imported.notes)
    if (note.find(words) != std::string::npos) return true;
  return false;
}

inline std::string refusal_of(const std::string& text, const std::string& file = "source") {
  try {
    (void)import_text(text, file);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

inline std::string refusal_of_file(const std::string& name) {
  try {
    (void)imported(name);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace clearloci::mechanism
