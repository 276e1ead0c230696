#include "core/field_map.hpp"

#include "core/errors.hpp"

namespace clearloci::inline core {

FieldMap slice_of(const FieldVolume& volume, std::size_t across, int layer) {
  ensure(across < 3 && layer >= 0 && layer < volume.cells[across], "a layer of the volume's cells");
  // The other two in their order.
  const std::size_t u = across == 0 ? 1 : 0, v = across == 2 ? 1 : 2;
  FieldMap map;
  map.mechanism = volume.mechanism;
  map.coordinates = {volume.coordinates[u], volume.coordinates[v]};
  map.lower = {volume.lower[u], volume.lower[v]};
  map.upper = {volume.upper[u], volume.upper[v]};
  map.nx = volume.cells[u];
  map.ny = volume.cells[v];
  for (const Field& field : volume.fields) {
    Field own{field.name, field.label, field.unit, field.is_signed, {}};
    own.values.reserve(static_cast<std::size_t>(map.nx) * static_cast<std::size_t>(map.ny));
    std::array<int, 3> cell{};
    cell[across] = layer;
    for (cell[v] = 0; cell[v] < map.ny; ++cell[v])
      for (cell[u] = 0; cell[u] < map.nx; ++cell[u]) own.values.push_back(field.values[volume.index(cell)]);
    map.fields.push_back(std::move(own));
  }
  return map;
}

}  // namespace clearloci::inline core
