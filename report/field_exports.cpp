#include "report/field_exports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>

#include "report/file_units.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

void append_number(std::string& out, double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value == 0 ? 0.0 : value);
  out.append(text, end);
}

template <class T>
void append_little_endian(std::string& out, T value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof value);
  for (std::size_t byte = 0; byte < sizeof value; ++byte) out += static_cast<char>((bits >> (8 * byte)) & 0xFF);
}

}  // namespace

std::string field_csv(const core::FieldMap& map, const core::Units& units) {
  std::string out;
  std::vector<double> per_si;  // of the coordinates, then the fields
  const auto add_column = [&](const std::string& name, const std::string& unit) {
    out += (per_si.empty() ? "" : ",") + column_head(name, unit, units);
    per_si.push_back(shown_unit(unit, units).per_si);
  };
  for (std::size_t c = 0; c < map.dimension(); ++c) add_column(map.coordinates[c], map.angles[c] ? "rad" : "m");
  for (const core::Field& field : map.fields) add_column(field.name, field.unit);
  out += '\n';
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    const auto there = [&](const core::Field& field) { return !std::isnan(field.values[cell]); };
    if (std::none_of(map.fields.begin(), map.fields.end(), there)) continue;
    const std::array<std::size_t, 3> at = map.cell(cell);
    std::size_t column = 0;
    for (; column < map.dimension(); ++column) {
      if (column > 0) out += ',';
      append_number(out, map.axes[column][at[column]] * per_si[column]);
    }
    for (const core::Field& field : map.fields) {
      out += ',';
      if (there(field)) append_number(out, field.values[cell] * per_si[column]);
      ++column;
    }
    out += '\n';
  }
  return out;
}

std::string vti(const core::FieldMap& map) {
  // Over two coordinates one layer of points, at 0.
  std::array<std::size_t, 3> points = {1, 1, 1};
  std::array<double, 3> first{}, step = {1, 1, 1};
  for (std::size_t c = 0; c < map.dimension(); ++c) {
    points[c] = map.axes[c].size();
    first[c] = map.axes[c].front();
    step[c] = (map.upper[c] - map.lower[c]) / static_cast<double>(points[c]);
  }
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", points[0] - 1, points[1] - 1, points[2] - 1);
  const auto three = [](const std::array<double, 3>& v) {
    return exact_number(v[0]) + " " + exact_number(v[1]) + " " + exact_number(v[2]);
  };
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <ImageData WholeExtent=\"{}\" Origin=\"{}\" Spacing=\"{}\">\n"
      "    <Piece Extent=\"{}\">\n      <PointData>\n",
      extent, three(first), three(step), extent);
  const std::uint64_t bytes = sizeof(double) * map.size();
  std::uint64_t offset = 0;
  for (const core::Field& field : map.fields) {
    fmt::format_to(std::back_inserter(out),
                   "        <DataArray type=\"Float64\" Name=\"{}\" format=\"appended\" offset=\"{}\"/>\n", field.name,
                   offset);
    offset += sizeof bytes + bytes;
  }
  out += "      </PointData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_";
  out.reserve(out.size() + offset + 64);
  for (const core::Field& field : map.fields) {
    append_little_endian(out, bytes);
    for (const double value : field.values) append_little_endian(out, value);
  }
  return out + "\n  </AppendedData>\n</VTKFile>\n";
}

}  // namespace clearloci::report
