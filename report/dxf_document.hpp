// A DXF document around its entities: header, tables, blocks, objects, for R2000 (AC1015) and R12 (AC1009).
// Private to report/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/locus_map.hpp"
#include "report/exports.hpp"

namespace clearloci::report {

/// A layer: one a curve, one a kind of isolated points.
struct DxfLayer {
  std::string name;
  int colour = 7;  ///< AutoCAD colour index
  std::string line_type = "CONTINUOUS";
};

/// Group codes and values, a line each, with the version's bookkeeping.
class DxfWriter {
 public:
  explicit DxfWriter(DxfVersion version) : modern_(version == DxfVersion::r2000) {}

  /// R2000: entities have handles, owners and subclass markers.
  bool modern() const { return modern_; }
  const std::string& text() const { return text_; }

  void put(int code, std::string_view value);
  void put(int code, int value);
  void put_real(int code, double value);
  /// x under `code`, y under code + 10, z = 0 under code + 20.
  void put_point(const core::Point2& at, bool with_z, int code = 10);
  /// R2000 only: a new handle, under `handle_code`, and its owner. Returns the handle.
  std::string put_handle(const std::string& owner, int handle_code = 5);
  /// R2000 only: a subclass marker.
  void put_class(std::string_view name);
  void begin_section(std::string_view name);
  void end_section();
  /// Returns the table's handle.
  std::string begin_table(std::string_view name, int entries);
  void end_table();
  std::string next_handle() const;

 private:
  bool modern_;
  unsigned next_handle_ = 0x30;  // below it: the fixed handles of the OBJECTS section
  std::string text_;
};

/// Block records that entities name as their owners; empty in R12.
struct DxfHandles {
  std::string model_space, paper_space;
};

/// The text as a string value: ASCII, other characters as \U+XXXX (beyond the basic plane: '?'), cut at 250 bytes,
/// since the format allows 255.
std::string dxf_string(const std::string& text);

/// `seed`: the first handle that no entity has.
void write_dxf_header(DxfWriter& out, const core::LocusMap& map, const std::string& seed);
DxfHandles write_dxf_tables(DxfWriter& out, const core::LocusMap& map, const std::vector<DxfLayer>& layers);
void write_dxf_blocks(DxfWriter& out, const DxfHandles& handles);
/// R2000 only: classes before the tables, objects after the entities.
void write_dxf_classes(DxfWriter& out);
void write_dxf_objects(DxfWriter& out);

}  // namespace clearloci::report
