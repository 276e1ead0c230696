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
    for (const HalfSpace& own : *parts) share -= share_of(own);
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
  ZoneCell own;
  own.box = std::move(box);
  const PoseCell::State state = cell.enter(chart_, own.box);
  if (state == PoseCell::State::outside) {
    own.kind = ZoneCell::Kind::outside;
    return own;
  }
  own.kind = ZoneCell::Kind::free;
  if (state == PoseCell::State::proven) return own;
  PoseCell::Known known = cell.known();
  if (known.free) return own;
  if (known.outside) {
    own.kind = ZoneCell::Kind::outside;
    return own;
  }
  own.beyond = known.beyond;
  own.kind = ZoneCell::Kind::in_doubt;
  own.signs = std::move(known.signs);
  own.open = std::move(known.open);
  if (!known.parts[0].empty() || !known.parts[1].empty()) {
    own.parts = std::make_unique<std::array<HalfSpace, 2>>(known.parts);
    own.of = std::make_unique<std::array<PoseCell::Signs, 2>>(std::move(known.of_parts));
  }
  // Along what moves it most, but no cell gets thin: its size says where to cut next, and bounds the zones.
  constexpr double thin = 8;
  double total = 0, most = -1, widest = 0;
  for (const double spread : cell.spreads()) total += spread;
  const auto part = [&](std::size_t c) { return (own.box[c][1] - own.box[c][0]) / (box_[c][1] - box_[c][0]); };
  for (std::size_t c = 0; c < own.box.size(); ++c) widest = std::max(widest, part(c));
  for (std::size_t c = 0; c < own.box.size(); ++c) {
    if (part(c) <= effort_.finest || part(c) * thin < widest) continue;
    const double score = (total > 0 ? cell.spreads()[c] / total : 0) + 0.1 * part(c) / widest;
    if (score > most) {
      most = score;
      own.axis = static_cast<int>(c);
    }
  }
  return own;
}

void ZoneCells::enter(const std::vector<std::size_t>& list) {
  std::vector<ZoneCell> looked_at(list.size());
  look_in_parts(list.size(), at_a_time, workers_,
                [&](PoseCell& cell, std::size_t i) { looked_at[i] = looked(cell, std::move(cells_[list[i]].box)); });
  looked_at_ += static_cast<long>(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    ZoneCell& own = cells_[list[i]] = std::move(looked_at[i]);
    const double doubt = own.doubt();
    in_doubt_ += doubt;
    if (own.kind != ZoneCell::Kind::in_doubt || own.axis < 0) continue;
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
  ZoneCell& own = cells_[index];
  own.kind = ZoneCell::Kind::cut;
  own.beyond = false;
  own.parts.reset();
  own.of.reset();
  own.open = {};
  own.signs = {};
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
    const ZoneCell& own = cells_[at];
    const auto axis = static_cast<std::size_t>(own.axis);
    at = own.halves[pose[axis] < cells_[own.halves[0]].box[axis][1] ? 0 : 1];
  }
  return at;
}

PoseCell::Signs ZoneCells::signs_at(const Pose& pose) {
  PoseCell::Signs signs;
  const auto at = workers_.local().at(pose);
  if (!at) return signs;
  for (const auto& own : at->components) signs.push_back(own.front().size() != 1 ? 0 : own.front()[0] > 0 ? 1 : -1);
  signs.push_back(at->determinant);
  return signs;
}

}  // namespace clearloci::loci::pose
