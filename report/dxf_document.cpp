#include "report/dxf_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "report/wording.hpp"

namespace clearloci::report {
namespace {

struct LineType {
  std::string_view name, description;
  std::vector<double> dashes;  ///< drawing units times $LTSCALE; negative: gap; 0: dot
};

const std::vector<LineType>& line_types() {
  static const std::vector<LineType> types = {{"CONTINUOUS", "Solid line", {}},
                                              {"DASHED", "__ __ __ __", {0.5, -0.25}},
                                              {"DASHDOT", "__ . __ . __", {0.5, -0.25, 0, -0.25}},
                                              {"DOT", ". . . . . .", {0, -0.25}},
                                              {"HIDDEN", "_ _ _ _ _ _", {0.25, -0.125}},
                                              {"PHANTOM", "____ _ _ ____", {1, -0.25, 0.25, -0.25, 0.25, -0.25}}};
  return types;
}

/// Corners of the searched box.
std::pair<core::Point2, core::Point2> extent(const core::LocusMap& map) {
  const bool planar = map.lower.size() > 1;
  return {{core::to_double(map.lower[0]), planar ? core::to_double(map.lower[1]) : 0},
          {core::to_double(map.upper[0]), planar ? core::to_double(map.upper[1]) : 0}};
}

/// What a program shows first: the searched box.
void write_view_port(DxfWriter& out, const core::LocusMap& map) {
  const auto [low, high] = extent(map);
  const std::string table = out.begin_table("VPORT", 1);
  out.put(0, "VPORT");
  out.put_handle(table);
  out.put_class("AcDbSymbolTableRecord");
  out.put_class("AcDbViewportTableRecord");
  out.put(2, "*ACTIVE");
  out.put(70, 0);
  out.put_point({0, 0}, false, 10);
  out.put_point({1, 1}, false, 11);
  out.put_point({(low[0] + high[0]) / 2, (low[1] + high[1]) / 2}, false, 12);
  out.put_point({0, 0}, false, 16);
  out.put_real(36, 1);
  out.put_real(40, 1.1 * std::max(high[0] - low[0], high[1] - low[1]));
  out.put_real(41, 1.5);
  out.end_table();
}

void write_line_types(DxfWriter& out) {
  const auto& types = line_types();
  const int special = out.modern() ? 2 : 0;  // ByBlock and ByLayer are entries of their own from R13 on
  const std::string table = out.begin_table("LTYPE", static_cast<int>(types.size()) + special);
  const auto write = [&](const LineType& type) {
    out.put(0, "LTYPE");
    out.put_handle(table);
    out.put_class("AcDbSymbolTableRecord");
    out.put_class("AcDbLinetypeTableRecord");
    out.put(2, type.name);
    out.put(70, 0);
    out.put(3, type.description);
    out.put(72, 65);
    out.put(73, static_cast<int>(type.dashes.size()));
    double period = 0;
    for (const double dash : type.dashes) period += std::abs(dash);
    out.put_real(40, period);
    for (const double dash : type.dashes) {
      out.put_real(49, dash);
      if (out.modern()) out.put(74, 0);
    }
  };
  if (out.modern()) {
    write({"ByBlock", "", {}});
    write({"ByLayer", "", {}});
  }
  for (const auto& type : types) write(type);
  out.end_table();
}

void write_layers(DxfWriter& out, const std::vector<DxfLayer>& layers) {
  const std::string table = out.begin_table("LAYER", static_cast<int>(layers.size()));
  for (const auto& layer : layers) {
    out.put(0, "LAYER");
    out.put_handle(table);
    out.put_class("AcDbSymbolTableRecord");
    out.put_class("AcDbLayerTableRecord");
    out.put(2, layer.name);
    out.put(70, 0);
    out.put(62, layer.colour);
    out.put(6, layer.line_type);
    if (out.modern()) out.put(390, "F");  // plot style: the placeholder of the OBJECTS section
  }
  out.end_table();
}

void write_text_style(DxfWriter& out) {
  const std::string table = out.begin_table("STYLE", 1);
  out.put(0, "STYLE");
  out.put_handle(table);
  out.put_class("AcDbSymbolTableRecord");
  out.put_class("AcDbTextStyleTableRecord");
  out.put(2, "STANDARD");
  out.put(70, 0);
  out.put_real(40, 0);
  out.put_real(41, 1);
  out.put_real(50, 0);
  out.put(71, 0);
  out.put_real(42, 0.1);
  out.put(3, "txt");
  out.put(4, "");
  out.end_table();
}

void write_applications(DxfWriter& out) {
  const std::string table = out.begin_table("APPID", 2);
  for (const std::string_view name : {"ACAD", "CLEARLOCI"}) {
    out.put(0, "APPID");
    out.put_handle(table);
    out.put_class("AcDbSymbolTableRecord");
    out.put_class("AcDbRegAppTableRecord");
    out.put(2, name);
    out.put(70, 0);
  }
  out.end_table();
}

void write_dimension_style(DxfWriter& out) {
  const std::string table = out.begin_table("DIMSTYLE", 1);
  out.put_class("AcDbDimStyleTable");
  out.put(0, "DIMSTYLE");
  out.put_handle(table, 105);
  out.put_class("AcDbSymbolTableRecord");
  out.put_class("AcDbDimStyleTableRecord");
  out.put(2, "STANDARD");
  out.put(70, 0);
  out.end_table();
}

DxfHandles write_block_records(DxfWriter& out) {
  DxfHandles handles;
  const std::string table = out.begin_table("BLOCK_RECORD", 2);
  for (const std::string_view name : {"*Model_Space", "*Paper_Space"}) {
    out.put(0, "BLOCK_RECORD");
    const std::string handle = out.put_handle(table);
    (name == "*Model_Space" ? handles.model_space : handles.paper_space) = handle;
    out.put_class("AcDbSymbolTableRecord");
    out.put_class("AcDbBlockTableRecord");
    out.put(2, name);
  }
  out.end_table();
  return handles;
}

}  // namespace

void DxfWriter::put(int code, std::string_view value) {
  fmt::format_to(std::back_inserter(text_), "{:>3}\n{}\n", code, value);
}

void DxfWriter::put(int code, int value) { fmt::format_to(std::back_inserter(text_), "{:>3}\n{}\n", code, value); }

void DxfWriter::put_real(int code, double value) {
  std::string number = exact_number(value);
  if (number.find_first_of(".en") == std::string::npos) number += ".0";
  put(code, number);
}

void DxfWriter::put_point(const core::Point2& at, bool with_z, int code) {
  put_real(code, at[0]);
  put_real(code + 10, at[1]);
  if (with_z) put_real(code + 20, 0);
}

std::string DxfWriter::put_handle(const std::string& owner, int handle_code) {
  if (!modern_) return "";
  std::string handle = next_handle();
  ++next_handle_;
  put(handle_code, handle);
  put(330, owner);
  return handle;
}

void DxfWriter::put_class(std::string_view name) {
  if (modern_) put(100, name);
}

void DxfWriter::begin_section(std::string_view name) {
  put(0, "SECTION");
  put(2, name);
}

void DxfWriter::end_section() { put(0, "ENDSEC"); }

std::string DxfWriter::begin_table(std::string_view name, int entries) {
  put(0, "TABLE");
  put(2, name);
  std::string handle = put_handle("0");
  put_class("AcDbSymbolTable");
  put(70, entries);
  return handle;
}

void DxfWriter::end_table() { put(0, "ENDTAB"); }

std::string DxfWriter::next_handle() const { return fmt::format("{:X}", next_handle_); }

std::string dxf_string(const std::string& text) {
  const std::string clean = printable(text);
  std::string out;
  for (std::size_t i = 0; i < clean.size();) {
    const auto lead = static_cast<unsigned char>(clean[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    unsigned code = length == 1 ? lead : lead & (0xFFu >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) code = (code << 6) | (static_cast<unsigned char>(clean[i + k]) & 0x3Fu);
    i += length;
    const std::string piece = code < 0x80     ? std::string(1, static_cast<char>(code))
                              : code > 0xFFFF ? "?"
                                              : fmt::format("\\U+{:04X}", code);
    if (out.size() + piece.size() > 250) break;
    out += piece;
  }
  return out;
}

namespace {

/// $INSUNITS of a unit of length.
int insertion_unit(const std::string& name) {
  const std::vector<std::pair<std::string, int>> codes = {{"in", 1}, {"mm", 4},  {"cm", 5}, {"m", 6},
                                                          {"km", 7}, {"um", 13}, {"dm", 14}};
  for (const auto& [unit, code] : codes)
    if (unit == name) return code;
  return 0;  // unitless
}

}  // namespace

void write_dxf_header(DxfWriter& out, const core::LocusMap& map, const std::string& seed) {
  const auto [low, high] = extent(map);
  out.begin_section("HEADER");
  out.put(9, "$ACADVER");
  out.put(1, out.modern() ? "AC1015" : "AC1009");
  if (out.modern()) {
    out.put(9, "$DWGCODEPAGE");
    out.put(3, "ANSI_1252");
    out.put(9, "$HANDSEED");
    out.put(5, seed);
  }
  out.put(9, "$INSUNITS");
  out.put(70, insertion_unit(map.units.length.name));
  out.put(9, "$EXTMIN");
  out.put_point(low, true);
  out.put(9, "$EXTMAX");
  out.put_point(high, true);
  // Patterns are about a unit long: the scale makes a period some hundredth of the drawing.
  out.put(9, "$LTSCALE");
  out.put_real(40, std::hypot(high[0] - low[0], high[1] - low[1]) / 60);
  out.put(9, "$PDMODE");
  out.put(70, 34);
  out.put(9, "$PDSIZE");
  out.put_real(40, 0);
  out.end_section();
}

DxfHandles write_dxf_tables(DxfWriter& out, const core::LocusMap& map, const std::vector<DxfLayer>& layers) {
  DxfHandles handles;
  out.begin_section("TABLES");
  write_view_port(out, map);
  write_line_types(out);
  write_layers(out, layers);
  write_text_style(out);
  if (out.modern()) {
    for (const std::string_view empty : {"VIEW", "UCS"}) {
      out.begin_table(empty, 0);
      out.end_table();
    }
  }
  write_applications(out);
  if (out.modern()) {
    write_dimension_style(out);
    handles = write_block_records(out);
  }
  out.end_section();
  return handles;
}

void write_dxf_blocks(DxfWriter& out, const DxfHandles& handles) {
  out.begin_section("BLOCKS");
  if (out.modern()) {
    for (const bool model : {true, false}) {
      const std::string_view name = model ? "*Model_Space" : "*Paper_Space";
      const std::string& owner = model ? handles.model_space : handles.paper_space;
      const auto start = [&](std::string_view entity, std::string_view kind) {
        out.put(0, entity);
        out.put_handle(owner);
        out.put_class("AcDbEntity");
        if (!model) out.put(67, 1);
        out.put(8, "0");
        out.put_class(kind);
      };
      start("BLOCK", "AcDbBlockBegin");
      out.put(2, name);
      out.put(70, 0);
      out.put_point({0, 0}, true);
      out.put(3, name);
      out.put(1, "");
      start("ENDBLK", "AcDbBlockEnd");
    }
  }
  out.end_section();
}

/// Of the objects that are no part of the format's core.
void write_dxf_classes(DxfWriter& out) {
  if (!out.modern()) return;
  out.begin_section("CLASSES");
  const std::pair<std::string_view, std::string_view> classes[] = {{"ACDBDICTIONARYWDFLT", "AcDbDictionaryWithDefault"},
                                                                   {"ACDBPLACEHOLDER", "AcDbPlaceHolder"}};
  for (const auto& [record, name] : classes) {
    out.put(0, "CLASS");
    out.put(1, record);
    out.put(2, name);
    out.put(3, "ObjectDBX Classes");
    out.put(90, 0);
    out.put(280, 0);
    out.put(281, 0);
  }
  out.end_section();
}

/// The root dictionary, its group dictionary and the plot style that layers name.
void write_dxf_objects(DxfWriter& out) {
  if (!out.modern()) return;
  const auto dictionary = [&](std::string_view handle, std::string_view owner,
                              const std::vector<std::pair<std::string_view, std::string_view>>& entries) {
    out.put(0, "DICTIONARY");
    out.put(5, handle);
    out.put(330, owner);
    out.put_class("AcDbDictionary");
    out.put(281, 1);
    for (const auto& [name, entry] : entries) {
      out.put(3, name);
      out.put(350, entry);
    }
  };
  out.begin_section("OBJECTS");
  dictionary("C", "0", {{"ACAD_GROUP", "D"}, {"ACAD_PLOTSTYLENAME", "E"}});
  dictionary("D", "C", {});
  out.put(0, "ACDBDICTIONARYWDFLT");
  out.put(5, "E");
  out.put(330, "C");
  out.put_class("AcDbDictionary");
  out.put(281, 1);
  out.put(3, "Normal");
  out.put(350, "F");
  out.put_class("AcDbDictionaryWithDefault");
  out.put(340, "F");
  out.put(0, "ACDBPLACEHOLDER");
  out.put(5, "F");
  out.put(330, "E");
  out.end_section();
}

}  // namespace clearloci::report
