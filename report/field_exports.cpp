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

std::string vti_of(const std::array<int, 3>& points, const std::array<double, 3>& first,
                   const std::array<double, 3>& step, const std::vector<core::Field>& fields) {
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
  std::uint64_t bytes = sizeof(double);
  for (const int n : points) bytes *= static_cast<std::uint64_t>(n);
  std::uint64_t offset = 0;
  for (const core::Field& field : fields) {
    fmt::format_to(std::back_inserter(out),
                   "        <DataArray type=\"Float64\" Name=\"{}\" format=\"appended\" offset=\"{}\"/>\n", field.name,
                   offset);
    offset += sizeof bytes + bytes;
  }
  out += "      </PointData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_";
  out.reserve(out.size() + offset + 64);
  for (const core::Field& field : fields) {
    append_little_endian(out, bytes);
    for (const double value : field.values) append_little_endian(out, value);
  }
  return out + "\n  </AppendedData>\n</VTKFile>\n";
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

std::string field_csv(const core::FieldVolume& volume, const core::Units& units) {
  std::string out;
  std::array<double, 3> per_si{};
  for (std::size_t c = 0; c < 3; ++c) {
    const char* const si = volume.angles[c] ? "rad" : "m";
    per_si[c] = shown_unit(si, units).per_si;
    out += (c == 0 ? "" : ",") + column_head(volume.coordinates[c], si, units);
  }
  for (const core::Field& field : volume.fields)
    out += "," + (units.declared ? field.name + " (" + field.unit + ")" : field.name);
  out += '\n';
  std::array<int, 3> cell{};
  for (cell[2] = 0; cell[2] < volume.cells[2]; ++cell[2])
    for (cell[1] = 0; cell[1] < volume.cells[1]; ++cell[1])
      for (cell[0] = 0; cell[0] < volume.cells[0]; ++cell[0]) {
        const std::size_t index = volume.index(cell);
        const auto there = [&](const core::Field& field) { return !std::isnan(field.values[index]); };
        if (std::none_of(volume.fields.begin(), volume.fields.end(), there)) continue;
        for (std::size_t c = 0; c < 3; ++c) {
          if (c > 0) out += ',';
          append_number(out, volume.at(c, cell[c]) * per_si[c]);
        }
        for (const core::Field& field : volume.fields) {
          out += ',';
          if (there(field)) append_number(out, field.values[index]);
        }
        out += '\n';
      }
  return out;
}

std::string vti(const core::FieldMap& map) {
  // One layer of points, at 0.
  return vti_of({map.nx, map.ny, 1}, {map.x(0), map.y(0), 0},
                {(map.upper[0] - map.lower[0]) / map.nx, (map.upper[1] - map.lower[1]) / map.ny, 1}, map.fields);
}

std::string vti(const core::FieldVolume& volume) {
  std::array<double, 3> first{}, step{};
  for (std::size_t c = 0; c < 3; ++c) {
    first[c] = volume.at(c, 0);
    step[c] = (volume.upper[c] - volume.lower[c]) / volume.cells[c];
  }
  return vti_of(volume.cells, first, step, volume.fields);
}

}  // namespace clearloci::report
