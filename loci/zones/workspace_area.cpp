#include "loci/zones/workspace_area.hpp"

#include <algorithm>
#include <array>
#include <span>
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

namespace {

/// Whether a mode reaches cells, told of several side by side.
class CellVerdicts {
 public:
  static constexpr std::size_t size = sheet::IntervalBatch::size;

  CellVerdicts(const core::RootTower& tower, const core::WorkingMode& mode)
      : program_(tower, std::vector<core::Polynomial>{}),
        mode_(mode),
        registers_(program_.registers<sheet::IntervalBatch>()),
        bears_(tower.roots.size(), false) {
    for (std::size_t j = 0; j < bears_.size(); ++j)
      for (const core::Root& root : tower.roots)
        bears_[j] = bears_[j] || core::depends_on(root.square, 2 + static_cast<int>(j)) ||
                    core::depends_on(root.line, 2 + static_cast<int>(j));
  }

  /// +1: all of the cell is reached, -1: none of it; of at most `size` cells.
  std::array<int, size> of(std::span<const sheet::PlaneCell> cells) {
    registers_.use_lanes(cells.size());
    sheet::IntervalBatch x, y;
    std::array<int, size> verdicts{};
    for (std::size_t lane = 0; lane < cells.size(); ++lane) {
      x.lanes[lane] = cells[lane].x;
      y.lanes[lane] = cells[lane].y;
      verdicts[lane] = 1;
    }
    registers_.set(0, x);
    registers_.set(1, y);
    for (int j = 0; j < program_.roots(); ++j) {
      registers_.run_square(j);
      sheet::IntervalBatch roots;
      for (std::size_t lane = 0; lane < cells.size(); ++lane) {
        if (verdicts[lane] < 0) continue;
        const core::Interval& square = registers_.square(j).lanes[lane];
        verdicts[lane] = square.upper() < 0 ? -1 : square.lower() < 0 ? 0 : verdicts[lane];
        if (verdicts[lane] < 0 || !bears_[static_cast<std::size_t>(j)]) continue;
        const core::Interval root = square_root(square);
        roots.lanes[lane] = mode_[static_cast<std::size_t>(j)] > 0 ? root : -root;
      }
      registers_.set(2 + j, roots);
    }
    return verdicts;
  }

 private:
  sheet::SheetProgram program_;
  const core::WorkingMode& mode_;
  sheet::SheetProgram::Registers<sheet::IntervalBatch> registers_;
  std::vector<bool> bears_;  ///< roots that squares of others are computed from
};

}  // namespace

AreaBounds workspace_area(const core::LocusProblem& problem, const core::WorkingMode& mode) {
  using sheet::PlaneCell, core::Interval;
  CellVerdicts verdicts(problem.tower, mode);
  const auto area = [](const PlaneCell& cell) { return cell.x.width() * cell.y.width(); };
  AreaBounds bounds;
  std::vector<PlaneCell> open = {{{core::to_double(problem.lower[0]), core::to_double(problem.upper[0])},
                                  {core::to_double(problem.lower[1]), core::to_double(problem.upper[1])}}};
  for (std::size_t seen = 0; !open.empty() && seen + open.size() <= most_cells;) {
    std::vector<PlaneCell> next;
    seen += open.size();
    for (std::size_t first = 0; first < open.size(); first += CellVerdicts::size) {
      const std::span cells = std::span(open).subspan(first, std::min(CellVerdicts::size, open.size() - first));
      const std::array<int, CellVerdicts::size> of_cells = verdicts.of(cells);
      for (std::size_t lane = 0; lane < cells.size(); ++lane) {
        const PlaneCell& cell = cells[lane];
        if (of_cells[lane] > 0) bounds.least += area(cell);
        if (of_cells[lane] != 0) continue;
        const double x = cell.x.middle(), y = cell.y.middle();
        for (const Interval& part_x : {Interval(cell.x.lower(), x), Interval(x, cell.x.upper())})
          for (const Interval& part_y : {Interval(cell.y.lower(), y), Interval(y, cell.y.upper())})
            next.push_back({part_x, part_y});
      }
    }
    open = std::move(next);
  }
  bounds.most = bounds.least;
  for (const PlaneCell& cell : open) bounds.most += area(cell);
  return bounds;
}

}  // namespace clearloci::loci
