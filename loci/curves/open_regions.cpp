#include "loci/curves/open_regions.hpp"

#include <algorithm>
#include <map>

namespace clearloci::loci {
namespace {

using core::LocusMap;
using core::OpenRegion;

/// More places of one locus than this are told together, by the cells of a grid that their middles lie in.
constexpr std::size_t most_places = 200;
constexpr int cells_across = 16;

bool is_of_same(const OpenRegion& a, const OpenRegion& b) {
  return a.kind == b.kind && a.factor == b.factor && a.mode == b.mode && a.vanishing == b.vanishing &&
         a.point == b.point;
}

bool is_within(const OpenRegion& inner, const OpenRegion& outer) {
  for (std::size_t c = 0; c < inner.lower.size(); ++c)
    if (inner.lower[c] < outer.lower[c] || inner.upper[c] > outer.upper[c]) return false;
  return true;
}

void hull_with(OpenRegion& region, const OpenRegion& other) {
  for (std::size_t c = 0; c < region.lower.size(); ++c) {
    region.lower[c] = std::min(region.lower[c], other.lower[c]);
    region.upper[c] = std::max(region.upper[c], other.upper[c]);
  }
}

/// Of one locus.
std::vector<OpenRegion> told_together(std::vector<OpenRegion> regions) {
  if (regions.size() <= most_places) {
    std::vector<OpenRegion> places;
    for (OpenRegion& region : regions)
      if (std::none_of(places.begin(), places.end(), [&](const auto& other) { return is_within(region, other); }))
        places.push_back(std::move(region));
    return places;
  }
  OpenRegion all = regions.front();
  for (const OpenRegion& region : regions) hull_with(all, region);
  std::map<std::vector<int>, OpenRegion> cells;
  for (OpenRegion& region : regions) {
    std::vector<int> cell;
    for (std::size_t c = 0; c < region.lower.size(); ++c) {
      const double width = all.upper[c] - all.lower[c], middle = (region.lower[c] + region.upper[c]) / 2;
      cell.push_back(width > 0 ? static_cast<int>(cells_across * ((middle - all.lower[c]) / width)) : 0);
    }
    const auto [place, fresh] = cells.try_emplace(cell, region);
    if (!fresh) hull_with(place->second, region);
  }
  regions.clear();
  for (auto& [cell, region] : cells) regions.push_back(std::move(region));
  return regions;
}

}  // namespace

PlaneBox extent_of(const core::Polyline& points) {
  PlaneBox box = {points.front()[0], points.front()[0], points.front()[1], points.front()[1]};
  for (const core::Point2& at : points) {
    box[0] = std::min(box[0], at[0]);
    box[1] = std::max(box[1], at[0]);
    box[2] = std::min(box[2], at[1]);
    box[3] = std::max(box[3], at[1]);
  }
  return box;
}

void leave_open(const EdgeLabel& label, const core::WorkingMode& mode, const PlaneBox& box, LocusMap& map) {
  map.open.push_back(
      {label.kind, label.vanishing, label.factor, label.cause, mode, {box[0], box[2]}, {box[1], box[3]}});
}

void leave_point_open(const std::string& joint, const core::WorkingMode& mode, const PlaneBox& box, LocusMap& map) {
  core::OpenRegion region;
  region.kind = core::LocusKind::contact_loss;
  region.vanishing = {{joint, core::Quantity::f, 1}};
  region.mode = mode;
  region.lower = {box[0], box[2]};
  region.upper = {box[1], box[3]};
  region.point = true;
  map.open.push_back(std::move(region));
}

EdgeLabel label_of(const core::LocusCurve& curve) {
  EdgeLabel label;
  label.kind = curve.kind;
  label.vanishing = curve.vanishing;
  label.factor = curve.factor;
  label.cause = curve.cause;
  return label;
}

void finish_open_regions(LocusMap& map) {
  std::vector<std::vector<OpenRegion>> by_locus;
  for (OpenRegion& region : map.open) {
    auto list_of_locus = std::find_if(by_locus.begin(), by_locus.end(),
                                      [&](const auto& list) { return is_of_same(list.front(), region); });
    if (list_of_locus == by_locus.end()) list_of_locus = by_locus.emplace(list_of_locus);
    list_of_locus->push_back(std::move(region));
  }
  map.open.clear();
  for (std::vector<OpenRegion>& list : by_locus)
    for (OpenRegion& region : told_together(std::move(list))) map.open.push_back(std::move(region));
  map.complete = map.complete && !map.out_of_time && map.open.empty();
}

}  // namespace clearloci::loci
