#include "core/field_map.hpp"

#include <utility>

#include "core/errors.hpp"

namespace clearloci::inline core {

std::size_t FieldMap::size() const {
  std::size_t all = 1;
  for (const std::vector<double>& axis : axes) all *= axis.size();
  return all;
}

std::size_t FieldMap::index(const std::array<std::size_t, 3>& cell) const {
  std::size_t index = 0;
  for (std::size_t c = axes.size(); c-- > 0;) index = index * axes[c].size() + cell[c];
  return index;
}

std::array<std::size_t, 3> FieldMap::cell(std::size_t index) const {
  std::array<std::size_t, 3> cell{};
  for (std::size_t c = 0; c < axes.size(); ++c) {
    cell[c] = index % axes[c].size();
    index /= axes[c].size();
  }
  return cell;
}

std::vector<double> FieldMap::place(std::size_t index) const {
  const std::array<std::size_t, 3> at = cell(index);
  std::vector<double> place;
  for (std::size_t c = 0; c < axes.size(); ++c) place.push_back(axes[c][at[c]]);
  return place;
}

FieldMap slice_of(const FieldMap& map, const FieldSlice& slice) {
  const auto [across, layer] = slice;
  ensure(across < map.dimension() && layer < map.axes[across].size(), "a layer of the map's cells");
  FieldMap over_others;
  std::size_t inside = 1;  // cells in a row along the coordinates before `across`
  for (std::size_t c = 0; c < map.dimension(); ++c) {
    if (c < across) inside *= map.axes[c].size();
    if (c == across) continue;
    over_others.coordinates.push_back(map.coordinates[c]);
    over_others.angles.push_back(map.angles[c]);
    over_others.lower.push_back(map.lower[c]);
    over_others.upper.push_back(map.upper[c]);
    over_others.axes.push_back(map.axes[c]);
  }
  const std::size_t apart = inside * map.axes[across].size();
  for (const Field& field : map.fields) {
    Field sliced{field.name, field.label, field.unit, field.is_signed, {}};
    for (std::size_t first = layer * inside; first < field.values.size(); first += apart) {
      const auto row = field.values.begin() + static_cast<std::ptrdiff_t>(first);
      sliced.values.insert(sliced.values.end(), row, row + static_cast<std::ptrdiff_t>(inside));
    }
    over_others.fields.push_back(std::move(sliced));
  }
  return over_others;
}

Table samples_of(const ModeErrors& errors) {
  const FieldMap& map = errors.map;
  ensure(map.dimension() == 1, "samples over a single coordinate");
  Table table{{map.coordinates.front()}, {map.angles.front() ? "rad" : "m"}, {map.axes.front()}};
  const Table& joints = errors.take_up;
  table.names.insert(table.names.end(), joints.names.begin(), joints.names.end());
  table.units.insert(table.units.end(), joints.units.begin(), joints.units.end());
  table.columns.insert(table.columns.end(), joints.columns.begin(), joints.columns.end());
  for (const Field& field : map.fields) {
    table.names.push_back(field.name);
    table.units.push_back(field.unit);
    table.columns.push_back(field.values);
  }
  return table;
}

}  // namespace clearloci::inline core
