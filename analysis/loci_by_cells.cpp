#include "analysis/loci_by_cells.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "analysis/zones_by_cells.hpp"
#include "core/errors.hpp"
#include "mechanism/group_closing.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci {
namespace {

using core::LocusKind;
using core::Zone;
using core::ZoneEnd;
using mechanism::Mechanism;

/// Of the range: ends of zones that are nearer have one point between them.
constexpr double one_point = 1e-7;

void require_traceable(const Mechanism& mechanism, const LociRequest& request) {
  if (mechanism.coordinates.size() != 1)
    mechanism::require_closed_forms(mechanism, "loci over more than one coordinate are traced",
                                    "ask for its zones, or make all coordinates but one parameters");
  for (const core::Quantity own : request.quantities)
    if (own != core::Quantity::f && own != core::Quantity::M && own != core::Quantity::F)
      mechanism::require_closed_forms(mechanism, "loci of the component " + core::to_string(own) + " are traced",
                                      "ask for f, M and F");
}

/// Whether all that acts on a link acts at two pins: its forces are along the line between them.
bool bears_along_its_pins(const Mechanism& mechanism, mechanism::LinkIndex link) {
  std::size_t pins = 0;
  for (const mechanism::Joint& joint : mechanism.joints) {
    if (joint.from != link && joint.to != link) continue;
    const bool plain = joint.type == mechanism::JointType::revolute || joint.type == mechanism::JointType::spherical;
    if (!plain || joint.actuated || joint.effort) return false;
    ++pins;
  }
  const auto is_loaded = [&](const auto& list, const auto& of) { return std::any_of(list.begin(), list.end(), of); };
  if (is_loaded(mechanism.loads, [&](const mechanism::Load& own) { return own.link == link; })) return false;
  if (is_loaded(mechanism.springs, [&](const mechanism::Spring& own) { return own.from == link || own.to == link; }))
    return false;
  const std::vector<mechanism::Mass> masses = mechanism::masses(mechanism);
  const bool heavy = is_loaded(masses, [&](const mechanism::Mass& own) { return own.link == link; });
  return pins == 2 && (mechanism.gravity.empty() || !heavy);
}

/// Whether a change of sign tells a zero: in the plane, of a force of one component or along a known line.
bool changes_through_zero(const Mechanism& mechanism, const core::Vanishing& what) {
  if (what.quantity != core::Quantity::f) return true;
  for (const mechanism::Joint& joint : mechanism.joints) {
    if (joint.name != what.joint) continue;
    if (mechanism::is_slot(mechanism, joint)) return true;
    for (const mechanism::LinkIndex link : {joint.from, joint.to})
      if (link != mechanism::ground && mechanism::traits(joint).pinned && bears_along_its_pins(mechanism, link))
        return true;
  }
  return false;
}

class Points {
 public:
  Points(const Mechanism& mechanism, core::Zones found) : mechanism_(mechanism), found_(std::move(found)) {}

  core::LocusMap collect() {
    core::LocusMap& map = found_.loci;
    range_ = {core::to_double(map.lower.front()), core::to_double(map.upper.front())};
    for (const core::ZonedMode& mode : found_.modes) add_mode(mode.mode);
    return std::move(map);
  }

 private:
  double width() const { return range_[1] - range_[0]; }

  void add_mode(const core::WorkingMode& mode) {
    std::vector<const Zone*> zones;
    for (const Zone& own : found_.zones)
      if (own.mode == mode) zones.push_back(&own);
    std::sort(zones.begin(), zones.end(), [](const Zone* a, const Zone* b) { return a->lower[0] < b->lower[0]; });
    if (zones.empty()) return;
    double from = zones.front()->lower[0];
    add_side(nullptr, zones.front());
    for (std::size_t i = 0; i + 1 < zones.size(); ++i) {
      const Zone &before = *zones[i], &behind = *zones[i + 1];
      if (behind.lower[0] - before.upper[0] <= one_point * width()) {
        add_between(before, behind);
        continue;
      }
      found_.loci.reachable.push_back({mode, from, before.upper[0]});
      from = behind.lower[0];
      add_side(&before, &behind);
    }
    found_.loci.reachable.push_back({mode, from, zones.back()->upper[0]});
    add_side(zones.back(), nullptr);
  }

  /// The end of a zone, the lower (0) or the upper one.
  static const ZoneEnd* end_of(const Zone& zone, bool upper) {
    const double at = upper ? zone.upper[0] : zone.lower[0];
    for (const ZoneEnd& own : zone.ends)
      if (own.at == at) return &own;
    return nullptr;
  }

  /// Something wide between two zones, or between a zone and the end of the range: it ends both, or is in doubt.
  void add_side(const Zone* before, const Zone* behind) {
    const ZoneEnd* const first = before != nullptr ? end_of(*before, true) : nullptr;
    const ZoneEnd* const last = behind != nullptr ? end_of(*behind, false) : nullptr;
    for (const ZoneEnd* const own : {first, last}) {
      if (own == nullptr) continue;
      if (own->kind == LocusKind::workspace_boundary) {
        add_point(*own, own->at, (own == first ? before : behind)->mode, own->certified);
        continue;
      }
      const double low = before != nullptr ? before->upper[0] : range_[0],
                   high = behind != nullptr ? behind->lower[0] : range_[1];
      core::OpenRegion open;
      open.kind = own->kind;
      open.vanishing = own->vanishing;
      open.mode = (before != nullptr ? before : behind)->mode;
      open.lower = {low};
      open.upper = {high};
      found_.loci.open.push_back(std::move(open));
      found_.loci.complete = false;
      return;
    }
  }

  void add_between(const Zone& before, const Zone& behind) {
    const ZoneEnd *own = end_of(before, true), *other = end_of(behind, false);
    if (own == nullptr) own = other;
    if (own == nullptr) return;
    const double at = 0.5 * (before.upper[0] + behind.lower[0]);
    if (own->kind == LocusKind::direct_singularity)
      return add_point(*own, at, before.mode, before.assembly_mode * behind.assembly_mode < 0);
    if (own->kind == LocusKind::workspace_boundary) return add_point(*own, at, before.mode, false);
    bool all = !own->vanishing.empty();
    for (const core::Vanishing& what : own->vanishing)
      all = all && own->turns && changes_through_zero(mechanism_, what);
    add_point(*own, at, before.mode, all);
  }

  void add_point(const ZoneEnd& end, double at, const core::WorkingMode& mode, bool certified) {
    core::IsolatedPoint point;
    point.kind = end.kind;
    point.vanishing = end.vanishing;
    point.at = {at};
    point.mode = mode;
    point.certified = certified;
    point.cause = end.cause;
    found_.loci.isolated_points.push_back(std::move(point));
  }

  const Mechanism& mechanism_;
  core::Zones found_;
  std::array<double, 2> range_{};
};

}  // namespace

core::LocusMap loci_by_cells(const Mechanism& mechanism, const LociRequest& request) {
  require_traceable(mechanism, request);
  const auto start = std::chrono::steady_clock::now();
  core::LocusMap map = Points(mechanism, zones_by_cells(mechanism, {.loci = request})).collect();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  map.timing.emplace_back("cells", taken.count());
  return map;
}

}  // namespace clearloci
