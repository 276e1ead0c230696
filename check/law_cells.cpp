#include "check/law_cells.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "check/certificate.hpp"

namespace clearloci::check {
namespace {

constexpr std::size_t most_places = 200'000;

std::optional<Cell> intersection(const Cell& a, const Cell& b) {
  Cell both = a;
  for (std::size_t c = 0; c < a.size(); ++c) {
    both[c] = {std::max(a[c][0], b[c][0]), std::min(a[c][1], b[c][1])};
    if (both[c][0] > both[c][1]) return std::nullopt;
  }
  return both;
}

bool contains(const Cell& cell, const Cell& part) {
  for (std::size_t c = 0; c < cell.size(); ++c)
    if (cell[c][0] > part[c][0] || part[c][1] > cell[c][1]) return false;
  return true;
}

/// Where a cell ends strictly inside of a part: a coordinate and a value.
std::optional<std::pair<std::size_t, double>> end_inside(const Cell& part, const Cell& cell) {
  for (std::size_t c = 0; c < part.size(); ++c)
    for (const double end : cell[c])
      if (part[c][0] < end && end < part[c][1]) return std::pair(c, end);
  return std::nullopt;
}

}  // namespace

std::vector<CommonPlace> common_places(const std::vector<Cell>& cells) {
  std::map<Cell, std::vector<std::size_t>> places;
  std::vector<Cell> open;
  const auto look_at = [&](const Cell& place) {
    if (!places.try_emplace(place).second) return;
    if (places.size() > most_places) throw FalseClaim("law: too many cells meet");
    open.push_back(place);
  };
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const auto both = intersection(cells[i], cells[j])) look_at(*both);
  while (!open.empty()) {
    const Cell place = std::move(open.back());
    open.pop_back();
    std::vector<std::size_t> holding;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (contains(cells[k], place))
        holding.push_back(k);
      else if (const auto both = intersection(cells[k], place))
        look_at(*both);
    }
    places[place] = std::move(holding);
  }
  std::vector<CommonPlace> all;
  for (auto& [place, holding] : places) all.push_back({place, std::move(holding)});
  return all;
}

void require_cover(const Cell& whole, const std::vector<Cell>& cells, const std::vector<std::string>& names,
                   const std::function<bool(const Cell&)>& is_apart) {
  std::vector<Cell> open = {whole};
  for (std::size_t count = 0; !open.empty(); ++count) {
    Cell part = std::move(open.back());
    open.pop_back();
    if (is_apart(part)) continue;
    std::optional<std::pair<std::size_t, double>> cut;
    bool held = false;
    for (std::size_t k = 0; k < cells.size() && !held; ++k) {
      held = contains(cells[k], part);
      if (!held && !cut && intersection(cells[k], part)) cut = end_inside(part, cells[k]);
    }
    if (held) continue;
    if (!cut || count > most_places) throw FalseClaim("law: no cell has the poses " + described(part, names));
    Cell rest = part;
    part[cut->first][1] = rest[cut->first][0] = cut->second;
    open.push_back(std::move(part));
    open.push_back(std::move(rest));
  }
}

}  // namespace clearloci::check
