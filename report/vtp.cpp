#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "report/exports.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

/// One cell of the PolyData: a vertex (one point) or a polyline.
struct Cell {
  int curve = -1, arc = -1, kind = 0, mode = 0;
  bool closed = false;
  std::size_t points = 0;
};

struct Cells {
  std::vector<Cell> vertices, lines, triangles;
  std::string coordinates;   ///< of all points, vertices first, then lines
  std::string connectivity;  ///< of the triangles
  std::size_t points = 0;
};

void append_point(Cells& cells, double x, double y, double z = 0) {
  cells.coordinates += exact_number(x) + " " + exact_number(y) + " " + exact_number(z) + "\n";
  ++cells.points;
}

Cells cells_of(const core::LocusMap& map, const std::vector<core::WorkingMode>& modes) {
  const auto mode_index = [&](const core::WorkingMode& mode) {
    return static_cast<int>(std::find(modes.begin(), modes.end(), mode) - modes.begin());
  };
  Cells cells;
  for (const auto& point : map.isolated_points) {
    append_point(cells, point.at[0], point.at.size() > 1 ? point.at[1] : 0, point.at.size() > 2 ? point.at[2] : 0);
    cells.vertices.push_back({-1, -1, static_cast<int>(point.kind), mode_index(point.mode), false, 1});
  }
  for (std::size_t c = 0; c < map.curves.size(); ++c) {
    const core::LocusCurve& curve = map.curves[c];
    for (std::size_t a = 0; a < curve.arcs.size(); ++a) {
      const core::Arc& arc = curve.arcs[a];
      for (const auto& point : arc.points) append_point(cells, point[0], point[1]);
      cells.lines.push_back({static_cast<int>(c), static_cast<int>(a), static_cast<int>(curve.kind),
                             mode_index(curve.mode), arc.closed, arc.points.size()});
    }
  }
  for (std::size_t c = 0; c < map.space_curves.size(); ++c) {
    const core::SpaceCurve& curve = map.space_curves[c];
    for (std::size_t a = 0; a < curve.arcs.size(); ++a) {
      const core::SpaceArc& arc = curve.arcs[a];
      for (const auto& point : arc.points) append_point(cells, point[0], point[1], point[2]);
      cells.lines.push_back({static_cast<int>(map.surfaces.size() + c), static_cast<int>(a),
                             static_cast<int>(curve.kind), mode_index(curve.mode), arc.closed, arc.points.size()});
    }
  }
  for (std::size_t s = 0; s < map.surfaces.size(); ++s) {
    const core::LocusSurface& surface = map.surfaces[s];
    const std::size_t first = cells.points;
    for (const auto& point : surface.vertices) append_point(cells, point[0], point[1], point[2]);
    for (const auto& triangle : surface.triangles) {
      for (const int corner : triangle)
        cells.connectivity += std::to_string(first + static_cast<std::size_t>(corner)) + " ";
      cells.triangles.push_back(
          {static_cast<int>(s), 0, static_cast<int>(surface.kind), mode_index(surface.mode), false, triangle.size()});
    }
  }
  return cells;
}

void append_array(std::string& out, std::string_view type, std::string_view name, std::string_view values) {
  fmt::format_to(std::back_inserter(out),
                 "        <DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">\n{}\n        </DataArray>\n", type, name,
                 values);
}

/// VTK writes a string array as the codes of its characters, each string ended by a 0.
void append_strings(std::string& out, std::string_view name, const std::vector<std::string>& strings) {
  std::string codes;
  for (const auto& text : strings) {
    for (const char c : text) codes += std::to_string(static_cast<unsigned char>(c)) + " ";
    codes += "0 ";
  }
  fmt::format_to(
      std::back_inserter(out),
      "      <Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">\n{}\n      </Array>\n", name,
      strings.size(), codes);
}

/// Cells of the given points.
void append_cells(std::string& out, std::string_view element, const std::vector<Cell>& cells,
                  std::string_view connectivity) {
  std::string offsets;
  std::size_t end = 0;
  for (const auto& cell : cells) offsets += std::to_string(end += cell.points) + " ";
  fmt::format_to(std::back_inserter(out), "      <{}>\n", element);
  append_array(out, "Int64", "connectivity", connectivity);
  append_array(out, "Int64", "offsets", offsets);
  fmt::format_to(std::back_inserter(out), "      </{}>\n", element);
}

/// Connectivity and offsets of cells whose points follow one another from `first`.
void append_topology(std::string& out, std::string_view element, const std::vector<Cell>& cells, std::size_t first) {
  std::string connectivity;
  for (const auto& cell : cells)
    for (std::size_t i = 0; i < cell.points; ++i) connectivity += std::to_string(first++) + " ";
  append_cells(out, element, cells, connectivity);
}

void append_cell_data(std::string& out, const Cells& cells) {
  const auto column = [&](auto value) {
    std::string values;
    for (const auto& cell : cells.vertices) values += std::to_string(value(cell)) + " ";
    for (const auto& cell : cells.lines) values += std::to_string(value(cell)) + " ";
    for (const auto& cell : cells.triangles) values += std::to_string(value(cell)) + " ";
    return values;
  };
  out += "      <CellData Scalars=\"curve\">\n";
  append_array(out, "Int32", "curve", column([](const Cell& cell) { return cell.curve; }));
  append_array(out, "Int32", "arc", column([](const Cell& cell) { return cell.arc; }));
  append_array(out, "Int32", "kind", column([](const Cell& cell) { return cell.kind; }));
  append_array(out, "Int32", "mode", column([](const Cell& cell) { return cell.mode; }));
  append_array(out, "UInt8", "closed", column([](const Cell& cell) { return cell.closed ? 1 : 0; }));
  out += "      </CellData>\n";
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (int kind = 0; kind <= static_cast<int>(core::LocusKind::no_limit); ++kind) {
    names.push_back(core::to_string(static_cast<core::LocusKind>(kind)));
  }
  return names;
}

}  // namespace

std::string vtp(const core::LocusMap& map) {
  const auto modes = modes_of(map);
  const Cells cells = cells_of(map, modes);
  std::vector<std::string> mode_names, curve_names;
  for (const auto& mode : modes) mode_names.push_back(mode_words(map.tower, mode));
  for (const auto& curve : map.curves) curve_names.push_back(curve.id);
  for (const auto& surface : map.surfaces) curve_names.push_back(surface.id);
  for (const auto& curve : map.space_curves) curve_names.push_back(curve.id);

  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <PolyData>\n    <FieldData>\n";
  append_strings(out, "mechanism", {printable(map.mechanism)});
  append_strings(out, "units", units_of(map));
  append_strings(out, "kind_names", kind_names());
  append_strings(out, "mode_names", mode_names);
  append_strings(out, "curve_names", curve_names);
  out += "    </FieldData>\n";
  fmt::format_to(std::back_inserter(out),
                 "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                 "NumberOfPolys=\"{}\">\n      <PointData/>\n",
                 cells.points, cells.vertices.size(), cells.lines.size(), cells.triangles.size());
  append_cell_data(out, cells);
  fmt::format_to(std::back_inserter(out),
                 "      <Points>\n        <DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
                 "format=\"ascii\">\n{}        </DataArray>\n      </Points>\n",
                 cells.coordinates);
  append_topology(out, "Verts", cells.vertices, 0);
  append_topology(out, "Lines", cells.lines, cells.vertices.size());
  if (!cells.triangles.empty()) append_cells(out, "Polys", cells.triangles, cells.connectivity);
  return out + "    </Piece>\n  </PolyData>\n</VTKFile>\n";
}

}  // namespace clearloci::report
