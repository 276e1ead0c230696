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

std::string field_csv(const core::FieldMap& map, const core::LocusMap& loci) {
  // The fields are in the file's units already; the coordinates' angles are not.
  std::array<double, 2> per_si = {1, 1};
  std::string out;
  for (std::size_t c = 0; c < 2; ++c) {
    const bool angle = c < loci.angles.size() && loci.angles[c];
    if (angle) per_si[c] = shown_unit("rad", loci.units).per_si;
    out += (c == 0 ? "" : ",") + column_head(map.coordinates[c], angle ? "rad" : "m", loci.units);
  }
  for (const core::Field& field : map.fields)
    out += "," + (loci.units.declared ? field.name + " (" + field.unit + ")" : field.name);
  out += '\n';
  for (int j = 0; j < map.ny; ++j) {
    for (int i = 0; i < map.nx; ++i) {
      const std::size_t cell = map.index(i, j);
      const auto there = [&](const core::Field& field) { return !std::isnan(field.values[cell]); };
      if (std::none_of(map.fields.begin(), map.fields.end(), there)) continue;
      append_number(out, map.x(i) * per_si[0]);
      out += ',';
      append_number(out, map.y(j) * per_si[1]);
      for (const core::Field& field : map.fields) {
        out += ',';
        if (there(field)) append_number(out, field.values[cell]);
      }
      out += '\n';
    }
  }
  return out;
}

std::string vti(const core::FieldMap& map) {
  const double dx = (map.upper[0] - map.lower[0]) / map.nx, dy = (map.upper[1] - map.lower[1]) / map.ny;
  const std::string extent = fmt::format("0 {} 0 {} 0 0", map.nx - 1, map.ny - 1);
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <ImageData WholeExtent=\"{}\" Origin=\"{} {} 0\" Spacing=\"{} {} 1\">\n"
      "    <Piece Extent=\"{}\">\n      <PointData>\n",
      extent, exact_number(map.x(0)), exact_number(map.y(0)), exact_number(dx), exact_number(dy), extent);
  const std::uint64_t bytes = sizeof(double) * static_cast<std::uint64_t>(map.nx) * static_cast<std::uint64_t>(map.ny);
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
