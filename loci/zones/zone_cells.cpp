#include "loci/zones/zone_cells.hpp"

#include <algorithm>
#include <utility>

namespace clearloci::loci::pose {
namespace {

/// Cells that are cut at once, and those of them that a thread takes at a time.
constexpr std::size_t at_once = 4096, at_a_time = 64;

}  // namespace

double ZoneCell::size() const {
  double size = 1;
  for (const auto& [low, high] : box) size *= high - low;
  return size;
}

double ZoneCell::doubt() const {
  if (kind != Kind::in_doubt) return 0;
  double share = 1;
  if (parts)
    for (const HalfSpace& space : *parts) share -= share_of(space);
  return std::max(share, 0.0) * size();
}

ZoneCells::ZoneCells(const core::PoseStatics& statics, const Pose& lower, const Pose& upper,
                     const CellZoneEffort& effort)
    : effort_(effort), workers_([&statics] { return PoseCell(statics); }) {
  const std::size_t n = lower.size();
  chart_.base.assign(n, 0.0);
  ZoneCell whole;
  for (std::size_t c = 0; c < n; ++c) {
    Pose way(n, 0.0);
    way[c] = 1;
    chart_.ways.push_back(std::move(way));
    whole.box.push_back({lower[c], upper[c]});
  }
  box_ = whole.box;
  cells_.push_back(std::move(whole));
}

/// What a cell is, and along which coordinate it is cut best.
ZoneCell ZoneCells::looked(PoseCell& cell, PoseBox box) const {
  ZoneCell zone_cell;
  zone_cell.box = std::move(box);
  const PoseCell::State state = cell.enter(chart_, zone_cell.box);
  if (state == PoseCell::State::outside) {
    zone_cell.kind = ZoneCell::Kind::outside;
    return zone_cell;
  }
  zone_cell.kind = ZoneCell::Kind::free;
  if (state == PoseCell::State::proven) return zone_cell;
  PoseCell::Known sides_known = cell.known();
  if (sides_known.free) return zone_cell;
  if (sides_known.outside) {
    zone_cell.kind = ZoneCell::Kind::outside;
    return zone_cell;
  }
  zone_cell.beyond = sides_known.beyond;
  zone_cell.kind = ZoneCell::Kind::in_doubt;
  zone_cell.signs = std::move(sides_known.signs);
  zone_cell.open = std::move(sides_known.open);
  if (!sides_known.parts[0].empty() || !sides_known.parts[1].empty()) {
    zone_cell.parts = std::make_unique<std::array<HalfSpace, 2>>(sides_known.parts);
    zone_cell.of = std::make_unique<std::array<PoseCell::Signs, 2>>(std::move(sides_known.of_parts));
  }
  // Along what moves it most, but no cell gets thin: its size says where to cut next, and bounds the zones.
  constexpr double thin = 8;
  double total = 0, most = -1, widest = 0;
  for (const double spread : cell.spreads()) total += spread;
  const auto part = [&](std::size_t c) {
    return (zone_cell.box[c][1] - zone_cell.box[c][0]) / (box_[c][1] - box_[c][0]);
  };
  for (std::size_t c = 0; c < zone_cell.box.size(); ++c) widest = std::max(widest, part(c));
  for (std::size_t c = 0; c < zone_cell.box.size(); ++c) {
    if (part(c) <= effort_.finest || part(c) * thin < widest) continue;
    const double score = (total > 0 ? cell.spreads()[c] / total : 0) + 0.1 * part(c) / widest;
    if (score > most) {
      most = score;
      zone_cell.axis = static_cast<int>(c);
    }
  }
  return zone_cell;
}

void ZoneCells::enter(const std::vector<std::size_t>& list) {
  std::vector<ZoneCell> looked_at(list.size());
  look_in_parts(list.size(), at_a_time, workers_,
                [&](PoseCell& cell, std::size_t i) { looked_at[i] = looked(cell, std::move(cells_[list[i]].box)); });
  looked_at_ += static_cast<long>(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    ZoneCell& cell = cells_[list[i]] = std::move(looked_at[i]);
    const double doubt = cell.doubt();
    in_doubt_ += doubt;
    if (cell.kind != ZoneCell::Kind::in_doubt || cell.axis < 0) continue;
    open_.push(list[i], {-doubt, -static_cast<long>(list[i])});
  }
}

bool ZoneCells::cut(std::size_t index, std::vector<std::size_t>& fresh) {
  const auto axis = static_cast<std::size_t>(cells_[index].axis);
  const PoseBox box = cells_[index].box;
  const double middle = 0.5 * (box[axis][0] + box[axis][1]);
  if (!(box[axis][0] < middle && middle < box[axis][1])) return false;
  for (std::size_t half = 0; half < 2; ++half) {
    ZoneCell child;
    child.box = box;
    child.box[axis][half == 0 ? 1 : 0] = middle;
    cells_[index].halves[half] = cells_.size();
    fresh.push_back(cells_.size());
    cells_.push_back(std::move(child));
  }
  ZoneCell& cell = cells_[index];
  cell.kind = ZoneCell::Kind::cut;
  cell.beyond = false;
  cell.parts.reset();
  cell.of.reset();
  cell.open = {};
  cell.signs = {};
  return true;
}

void ZoneCells::subdivide() {
  enter({0});
  const double enough = effort_.enough_doubt * cells_.front().size();
  while (!open_.empty() && looked_at_ < effort_.most_cells && in_doubt_ > enough) {
    if (effort_.deadline && std::chrono::steady_clock::now() >= *effort_.deadline) {
      out_of_time_ = true;
      break;
    }
    std::vector<std::size_t> fresh;
    for (std::size_t k = 0; k < at_once && !open_.empty(); ++k) {
      const double doubt = -open_.next().key.first;
      if (cut(open_.take(), fresh)) in_doubt_ -= doubt;
    }
    enter(fresh);
  }
}

std::size_t ZoneCells::leaf_at(const Pose& pose) const {
  std::size_t at = 0;
  while (cells_[at].kind == ZoneCell::Kind::cut) {
    const ZoneCell& cell = cells_[at];
    const auto axis = static_cast<std::size_t>(cell.axis);
    at = cell.halves[pose[axis] < cells_[cell.halves[0]].box[axis][1] ? 0 : 1];
  }
  return at;
}

PoseCell::Signs ZoneCells::signs_at(const Pose& pose) {
  PoseCell& cell = workers_.local();
  const auto at = cell.at(pose);
  return at ? PoseCell::signs_of(cell.statics(), *at) : PoseCell::Signs{};
}

}  // namespace clearloci::loci::pose
