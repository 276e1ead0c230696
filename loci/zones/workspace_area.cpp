#include "loci/zones/workspace_area.hpp"

#include <vector>

#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {
namespace {

std::vector<core::Polynomial> squares(const core::RootTower& tower) {
  std::vector<core::Polynomial> list;
  for (const core::Root& root : tower.roots) list.push_back(root.square);
  return list;
}

constexpr std::size_t most_cells = 40000;

}  // namespace

ModeWorkspace::ModeWorkspace(const core::RootTower& tower, const core::WorkingMode& mode)
    : program_(tower, squares(tower)), sign_(program_, mode), roots_(static_cast<int>(tower.roots.size())) {}

std::optional<bool> ModeWorkspace::holds(const core::Point2& at) {
  bool clear = true;
  for (int j = 0; j < roots_; ++j) {
    const auto sign = sign_(at[0], at[1], j);
    if (!sign || *sign < 0) return false;
    clear = clear && *sign > 0;
  }
  if (!clear) return std::nullopt;
  return true;
}

bool ModeWorkspace::holds_one_of(const core::Polyline& points) {
  for (const core::Point2& at : points)
    if (const std::optional<bool> answer = holds(at)) return *answer;
  return false;
}

AreaBounds workspace_area(const core::LocusProblem& problem, const core::WorkingMode& mode) {
  using sheet::PlaneCell, core::Interval;
  const sheet::SheetProgram program(problem.tower, std::vector<core::Polynomial>{});
  auto registers = program.registers<Interval>();
  // +1: all of the cell is reached, -1: none of it.
  const auto judge = [&](const PlaneCell& cell) {
    registers.set(0, cell.x);
    registers.set(1, cell.y);
    bool all = true;
    for (int j = 0; j < program.roots(); ++j) {
      registers.run_square(j);
      const Interval& square = registers.square(j);
      if (square.upper() < 0) return -1;
      all = all && square.lower() >= 0;
      const Interval root = square_root(square);
      registers.set(2 + j, mode[static_cast<std::size_t>(j)] > 0 ? root : -root);
    }
    return all ? 1 : 0;
  };
  const auto area = [](const PlaneCell& cell) { return cell.x.width() * cell.y.width(); };
  AreaBounds bounds;
  std::vector<PlaneCell> open = {{{core::to_double(problem.lower[0]), core::to_double(problem.upper[0])},
                                  {core::to_double(problem.lower[1]), core::to_double(problem.upper[1])}}};
  for (std::size_t seen = 0; !open.empty() && seen + open.size() <= most_cells;) {
    std::vector<PlaneCell> next;
    for (const PlaneCell& cell : open) {
      ++seen;
      const int verdict = judge(cell);
      if (verdict > 0) bounds.least += area(cell);
      if (verdict != 0) continue;
      const double x = cell.x.middle(), y = cell.y.middle();
      for (const Interval& part_x : {Interval(cell.x.lower(), x), Interval(x, cell.x.upper())})
        for (const Interval& part_y : {Interval(cell.y.lower(), y), Interval(y, cell.y.upper())})
          next.push_back({part_x, part_y});
    }
    open = std::move(next);
  }
  bounds.most = bounds.least;
  for (const PlaneCell& cell : open) bounds.most += area(cell);
  return bounds;
}

}  // namespace clearloci::loci
