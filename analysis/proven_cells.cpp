#include "analysis/proven_cells.hpp"

#include <algorithm>

namespace clearloci {

std::vector<core::ProvenRange> joined_ranges(std::vector<core::StudyCell> cells) {
  std::sort(cells.begin(), cells.end(),
            [](const core::StudyCell& a, const core::StudyCell& b) { return a.lower[0] < b.lower[0]; });
  const auto is = [&](std::size_t i, core::StudyDesign::Status status) {
    return i < cells.size() && cells[i].status == status;
  };
  std::vector<core::ProvenRange> ranges;
  for (std::size_t first = 0; first < cells.size(); ++first) {
    if (!is(first, core::StudyDesign::Status::feasible)) continue;
    std::size_t last = first, before = first - 1;  // before the first cell: past all of them
    while (is(last + 1, core::StudyDesign::Status::feasible)) ++last;
    std::size_t after = last + 1;
    while (is(before, core::StudyDesign::Status::undecided)) --before;
    while (is(after, core::StudyDesign::Status::undecided)) ++after;
    core::ProvenRange& range = ranges.emplace_back();
    range.from = {before < cells.size() ? cells[before].upper[0] : cells.front().lower[0], cells[first].lower[0]};
    range.to = {cells[last].upper[0], after < cells.size() ? cells[after].lower[0] : cells.back().upper[0]};
    if (before < cells.size()) range.below = cells[before].reason;
    if (after < cells.size()) range.above = cells[after].reason;
    first = last;
  }
  return ranges;
}

}  // namespace clearloci
