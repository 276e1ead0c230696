// The readers, one a format, and their registry. Private to mechanism/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mechanism/import/source.hpp"

namespace clearloci::mechanism::imports {

struct SourceText {
  const std::string& text;
  const std::string& file;       ///< that errors show
  const std::string& side;       ///< text of the second file; ""
  const std::string& side_file;  ///< its name
};

struct Format {
  std::string_view name;
  std::string_view side_ending;  ///< of the second file that may lie beside; ""
  bool (*recognises)(std::string_view text);
  Source (*read)(const SourceText& text);
};

const std::vector<Format>& formats();

bool is_pmks(std::string_view text);
Source read_pmks(const SourceText& text);
bool is_linkage(std::string_view text);
Source read_linkage(const SourceText& text);
bool is_urdf(std::string_view text);
Source read_urdf(const SourceText& text);
bool is_sdf(std::string_view text);
Source read_sdf(const SourceText& text);
bool is_mjcf(std::string_view text);
Source read_mjcf(const SourceText& text);
bool is_dxf(std::string_view text);
Source read_dxf(const SourceText& text);
bool is_pyslvs(std::string_view text);
Source read_pyslvs(const SourceText& text);
bool is_cuik(std::string_view text);
Source read_cuik(const SourceText& text);

/// The text without white space at its ends.
std::string_view trimmed(std::string_view text);

/// Whether a text is XML whose outermost element has that name.
bool is_xml_of(std::string_view text, std::string_view root);

/// A number as the formats write them: the whole text, finite. False where it is none.
bool number_of(std::string_view text, double& value);

}  // namespace clearloci::mechanism::imports
