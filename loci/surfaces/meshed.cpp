#include "loci/surfaces/meshed.hpp"

#include <algorithm>
#include <map>

#include "core/errors.hpp"
#include "loci/surfaces/isotopy.hpp"
#include "loci/surfaces/march.hpp"
#include "loci/surfaces/measure.hpp"
#include "loci/surfaces/rim.hpp"

namespace clearloci::loci::surface {
namespace {

/// Cells smaller than the mesh asks for, by so many halvings, where the surface
/// may pass through more than once.
constexpr int extra_levels = 4;
/// And smaller yet where the mesh does not account for a zero that may be
/// there.
constexpr int closer_levels = 2;
/// Rounds in which cells are halved where the topology of their triangles is
/// not proven.
constexpr int proof_rounds = 6;
/// More than this part of the cells that the surface may pass are not halved in a round, where they are many.
constexpr double most_halved = 0.125;
constexpr double many = 1000;
/// Halvings of a cell in the proof that no zero is in it.
constexpr int cuts_of_a_cell = 5;

/// A mesh, whole and cut off at the workspace boundary.
struct Drawn {
  Drawn(Field& field, const Cells& cells, const std::function<bool()>& stop)
      : marched(march(field, cells)),
        boundary(boundary_of(field, marched.mesh)),
        clipping(field, marched.mesh, boundary) {
    if (stop && stop()) throw core::LimitReached("the time limit was reached");
    field.lie_on(boundary);
  }

  Marched marched;
  std::optional<int> boundary;
  Clipping clipping;
};

/// The leaves in which the topology of a mesh is not proven, ascending. Takes the mesh's complex.
std::vector<int> open_leaves(Field& field, const Cells& cells, Drawn& drawn, const std::function<bool()>& stop) {
  std::vector<int> open = unproven(field, cells, std::move(drawn.marched.complex), stop);
  for (const Point& at : drawn.clipping.unproven()) open.push_back(cells.at(place_below(at), deepest));
  std::sort(open.begin(), open.end());
  open.erase(std::unique(open.begin(), open.end()), open.end());
  return open;
}

/// Those that the surface may pass, or that such cells' moved corners reach
/// into: then the former beside them. Where much is open, it is for the
/// enclosures, not for the mesh: none.
std::vector<int> worth_halving(const Cells& cells, const std::vector<int>& open) {
  const auto is_active = [&](int leaf) { return cells.cells()[static_cast<std::size_t>(leaf)].active(); };
  std::vector<int> result;
  for (const int leaf : open)
    if (is_active(leaf))
      result.push_back(leaf);
    else
      cells.each_neighbour(leaf, [&](int beside) {
        if (is_active(beside)) result.push_back(beside);
      });
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  const auto active =
      std::count_if(cells.cells().begin(), cells.cells().end(), [](const OctreeCell& cell) { return cell.active(); });
  if (static_cast<double>(result.size()) > std::max(many, most_halved * static_cast<double>(active))) result.clear();
  return result;
}

void add_open(const Cells& cells, const std::vector<int>& open, Meshed& meshed) {
  if (open.empty()) return;
  const std::vector<std::vector<int>> groups = groups_of(cells, open);
  std::map<int, std::vector<std::size_t>> near;  // the groups in or beside a leaf
  for (std::size_t g = 0; g < groups.size(); ++g) {
    OpenCells open_cells{.count = static_cast<int>(groups[g].size()), .lower = {1, 1, 1}, .upper = {}, .triangles = {}};
    for (const int leaf : groups[g]) {
      const Box box = cells.cells()[static_cast<std::size_t>(leaf)].box();
      for (std::size_t i = 0; i < 3; ++i) {
        open_cells.lower[i] = std::min(open_cells.lower[i], box[i].lower());
        open_cells.upper[i] = std::max(open_cells.upper[i], box[i].upper());
      }
      cells.each_neighbour(leaf, [&](int beside) {
        std::vector<std::size_t>& boxes = near[beside];
        if (boxes.empty() || boxes.back() != g) boxes.push_back(g);
      });
    }
    meshed.open.push_back(std::move(open_cells));
  }
  for (std::size_t t = 0; t < meshed.mesh.triangles.size(); ++t) {
    const Point middle = middle_of(meshed.mesh, meshed.mesh.triangles[t]);
    const auto found = near.find(cells.at(place_below(middle), deepest));
    if (found == near.end()) continue;
    for (const std::size_t g : found->second) meshed.open[g].triangles.push_back(static_cast<int>(t));
  }
}

}  // namespace

Meshed mesh_of(Field& field, int level, const std::function<bool()>& stop) {
  const int finest = std::min(level + extra_levels, deepest);
  Cells cells(field, {.level = level, .finest = finest, .stop = stop});
  Drawn now(field, cells, stop);
  const auto cells_away = [&] { return unexplained(field, cells, level, now.clipping.mesh(), cuts_of_a_cell, stop); };
  std::vector<int> away = cells_away();
  bool cut = !away.empty();
  if (cut) {
    cells.look_closer(away, finest + closer_levels);
    now = Drawn(field, cells, stop);
  }
  if (away.empty() && now.clipping.mesh().triangles.empty()) return {};  // no cell of the workspace holds a zero
  std::vector<int> open = open_leaves(field, cells, now, stop);
  for (int round = 0; round < proof_rounds && cells.halve(worth_halving(cells, open), finest); ++round) {
    cut = true;
    now = Drawn(field, cells, stop);
    open = open_leaves(field, cells, now, stop);
  }
  if (cut) away = cells_away();
  if (cut && !away.empty()) {
    cells.look_closer(away, finest + closer_levels);
    now = Drawn(field, cells, stop);
    open = open_leaves(field, cells, now, stop);
    away = cells_away();
  }
  Meshed result{.mesh = now.clipping.mesh(), .boundary = now.boundary, .open = {}};
  result.unexplained = static_cast<int>(away.size());
  if (!away.empty()) result.at = unit_of(cells.cells()[static_cast<std::size_t>(away.front())].middle());
  add_open(cells, open, result);
  return result;
}

}  // namespace clearloci::loci::surface
