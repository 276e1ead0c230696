#include "check/zone_borders.hpp"

#include <fmt/format.h>

#include "core/parts.hpp"

namespace clearloci::check {

std::vector<const core::Polyline*> rings_of(const ZoneClaim& zone) {
  std::vector<const core::Polyline*> rings = {&zone.outer};
  for (const core::Polyline& hole : zone.holes) rings.push_back(&hole);
  return rings;
}

ZoneBorders::ZoneBorders(const std::vector<const ZoneClaim*>& zones) {
  const auto fail = [](const ZoneClaim& zone, const char* what, const core::Point2& at) {
    throw FalseClaim(fmt::format("zone {}: {} at ({}, {})", zone.id.substr(0, 40), what, at[0], at[1]));
  };
  for (const ZoneClaim* zone : zones)
    for (const core::Polyline* ring : rings_of(*zone))
      for (std::size_t i = 1; i < ring->size(); ++i) {
        const Piece piece((*ring)[i - 1], (*ring)[i]);
        if (piece.first == piece.second) continue;
        if (!left_.emplace(piece, zone).second) fail(*zone, "one side of its border is in two zones,", piece.first);
        for (const core::Point2& vertex : {piece.first, piece.second})
          numbers_.try_emplace(vertex, static_cast<int>(numbers_.size()));
      }
  // What has a zone on both sides ends in it: it closes no way round.
  core::Parts parts(numbers_.size());
  std::vector<const Piece*> within;
  for (const auto& [piece, zone] : left_) {
    const auto other = left_.find({piece.second, piece.first});
    if (other == left_.end() || other->second != zone)
      parts.join(numbers_.at(piece.first), numbers_.at(piece.second));
    else if (piece.first < piece.second)
      within.push_back(&piece);
  }
  for (const Piece* piece : within)
    if (!parts.join(numbers_.at(piece->first), numbers_.at(piece->second)))
      fail(*left_.at(*piece), "what divides it is in it,", piece->first);
}

std::vector<ZoneBorders::Piece> ZoneBorders::one_sided() const {
  std::vector<Piece> pieces;
  for (const auto& [piece, zone] : left_)
    if (!left_.contains({piece.second, piece.first})) pieces.push_back(piece);
  return pieces;
}

}  // namespace clearloci::check
