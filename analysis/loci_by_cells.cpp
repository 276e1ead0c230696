#include "analysis/loci_by_cells.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "analysis/framed.hpp"
#include "analysis/group_sheets.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/request_limits.hpp"
#include "analysis/singular_modes.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/zones_by_cells.hpp"
#include "core/errors.hpp"
#include "loci/curves/curves.hpp"
#include "loci/surfaces/surfaces.hpp"
#include "mechanism/group_closing.hpp"
#include "mechanism/notes.hpp"
#include "mechanism/posture_sample.hpp"
#include "numeric/model.hpp"
#include "symbolic/pose_statics.hpp"

namespace clearloci {
namespace {

using core::LocusKind;
using core::Zone;
using core::ZoneEnd;
using loci::pose::Doubt;
using mechanism::Mechanism;

/// Of the range: ends of zones that are nearer have one point between them.
constexpr double one_point = 1e-7;

void require_traceable(const Mechanism& mechanism, const LociRequest& request) {
  require_coordinates(mechanism, 1, 3, "loci are traced");
  for (const core::Quantity quantity : request.quantities)
    if (quantity != core::Quantity::f && quantity != core::Quantity::M && quantity != core::Quantity::F)
      mechanism::require_closed_forms(mechanism, "loci of the component " + core::to_string(quantity) + " are traced",
                                      "ask for f, M and F");
}

class Points {
 public:
  Points(const Mechanism& mechanism, core::Zones found) : mechanism_(mechanism), found_(std::move(found)) {}

  core::LocusMap collect() {
    core::LocusMap& map = found_.loci;
    range_ = {core::to_double(map.lower.front()), core::to_double(map.upper.front())};
    for (const core::ZonedMode& mode : found_.modes) {
      in_doubt_ = mode.in_doubt;
      add_mode(mode.mode);
    }
    return std::move(map);
  }

 private:
  double width() const { return range_[1] - range_[0]; }

  void add_mode(const core::WorkingMode& mode) {
    std::vector<const Zone*> zones;
    for (const Zone& zone : found_.zones)
      if (zone.mode == mode) zones.push_back(&zone);
    std::sort(zones.begin(), zones.end(), [](const Zone* a, const Zone* b) { return a->lower[0] < b->lower[0]; });
    if (zones.empty()) return;
    double from = zones.front()->lower[0];
    add_side(nullptr, zones.front());
    for (std::size_t i = 0; i + 1 < zones.size(); ++i) {
      const Zone &before = *zones[i], &behind = *zones[i + 1];
      const bool one = behind.lower[0] - before.upper[0] <= one_point * width();
      const ZoneEnd* const end = end_of(before, true);
      // The end of the reach at a flank is told of beside its zone.
      if (one || (is_proven(end) && end->limit.empty())) add_between(before, behind);
      if (one) continue;
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
    for (const ZoneEnd& end : zone.ends)
      if (end.at == at) return &end;
    return nullptr;
  }

  /// Something wide between two zones, or between a zone and the end of the range: it ends both, or is in doubt.
  void add_side(const Zone* before, const Zone* behind) {
    const ZoneEnd* const first = before != nullptr ? end_of(*before, true) : nullptr;
    const ZoneEnd* const last = behind != nullptr ? end_of(*behind, false) : nullptr;
    for (const ZoneEnd* const end : {first, last}) {
      if (end == nullptr) continue;
      const core::WorkingMode& mode = (end == first ? before : behind)->mode;
      if (end->kind == LocusKind::workspace_boundary) {
        add_point(*end, end->at, mode, end->certified);
        continue;
      }
      if (!end->limit.empty()) {
        add_flank(*end, mode);
        if (in_doubt_ <= one_point * width()) continue;
      }
      const double low = before != nullptr ? before->upper[0] : range_[0],
                   high = behind != nullptr ? behind->lower[0] : range_[1];
      core::OpenRegion open;
      open.kind = end->kind;
      open.vanishing = end->vanishing;
      open.mode = (before != nullptr ? before : behind)->mode;
      open.lower = {low};
      open.upper = {high};
      found_.loci.open.push_back(std::move(open));
      found_.loci.complete = false;
      return;
    }
  }

  void add_between(const Zone& before, const Zone& behind) {
    const ZoneEnd *end = end_of(before, true), *other = end_of(behind, false);
    if (end == nullptr) end = other;
    if (end == nullptr) return;
    const double at = end->zero.value_or(0.5 * (before.upper[0] + behind.lower[0]));
    if (end->kind == LocusKind::direct_singularity)
      return add_point(*end, at, before.mode, before.assembly_mode * behind.assembly_mode < 0);
    if (end->kind == LocusKind::workspace_boundary) return add_point(*end, at, before.mode, false);
    add_point(*end, at, before.mode, is_proven(end));
  }

  /// Whether all that vanishes at an end does so for certain.
  bool is_proven(const ZoneEnd* end) const {
    return end != nullptr && end->turns && !end->vanishing.empty() &&
           std::all_of(end->vanishing.begin(), end->vanishing.end(),
                       [&](const core::Vanishing& what) { return changes_through_zero(mechanism_, what); });
  }

  /// Beyond which teeth would have to pull: what vanishes there, and the boundary.
  void add_flank(const ZoneEnd& end, const core::WorkingMode& mode) {
    const double at = end.zero.value_or(end.at);
    add_point(end, at, mode, is_proven(&end));
    ZoneEnd boundary;
    boundary.kind = LocusKind::workspace_boundary;
    boundary.cause = "limit: " + end.limit;
    add_point(boundary, at, mode, end.turns);
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
  double in_doubt_ = 0;  ///< of the mode
};

/// Curves and surfaces of every mode.
class Followed {
 public:
  Followed(const Mechanism& mechanism, const LociRequest& request)
      : mechanism_(mechanism), request_(request), model_(numeric::compile(mechanism)), map_(empty_map(mechanism)) {
    for (const mechanism::Coordinate& coordinate : mechanism.coordinates) {
      lower_.push_back(core::to_double(coordinate.lower));
      upper_.push_back(core::to_double(coordinate.upper));
    }
  }

  core::LocusMap follow() {
    map_.complete = false;
    map_.tolerance = request_.tolerance;
    map_.notes = mechanism::notes_of(mechanism_);
    std::vector<DyadSides> modes = requested_modes(mechanism_, request_);
    if (modes.size() > 1) modes = regular_modes(mechanism_, modes, map_.notes);
    int cells = 0;
    for (std::size_t m = 0; m < modes.size(); ++m) {
      if (request_.progress) request_.progress(static_cast<double>(m) / static_cast<double>(modes.size()), "poses");
      cells = add_mode(modes[m]);
    }
    add_notes(cells);
    name();
    return std::move(map_);
  }

 private:
  bool over_two() const { return lower_.size() == 2; }

  int add_mode(const DyadSides& sides) {
    constexpr std::size_t poses = 24;
    const std::vector<numeric::NumericModel> models{model_};
    core::PoseStatics statics = symbolic::pose_statics(
        {&mechanism_}, sides,
        loaded_demands(models, sides, demands_of(mechanism_, request_), mechanism::spread_poses(mechanism_, poses),
                       map_.notes, LeastSizes::are_left_out));
    const auto covered = cover_groups(mechanism_, lower_, upper_, request_.deadline, statics, map_.notes);
    loci::pose::PoseZerosEffort effort;
    effort.deadline = request_.deadline;
    double extent = 0;
    for (std::size_t c = 0; c < lower_.size(); ++c) extent = std::max(extent, upper_[c] - lower_[c]);
    effort.tolerance = request_.tolerance / extent;
    if (!over_two()) effort.cells = static_cast<int>(std::clamp(std::ceil(1 / request_.mesh_size), 4.0, 96.0));
    const loci::pose::PoseZeros found = loci::pose::pose_zeros(statics, lower_, upper_, effort);
    map_.out_of_time = map_.out_of_time || found.out_of_time || (covered && covered->out_of_effort);
    const Mode mode{sides, mode_of(sides, map_.tower), statics};
    for (const loci::pose::PoseLocus& locus : found.loci) add(locus, mode);
    for (const loci::pose::PoseZeroPoint& zero_point : found.points) {
      core::IsolatedPoint point;
      describe(point, {.doubt = Doubt::demand, .demand = zero_point.demand}, mode);
      point.at = {zero_point.at[0], zero_point.at[1]};
      add(map_.isolated_points, std::move(point));
    }
    for (const loci::pose::OpenPoses& open_poses : found.open) {
      core::OpenRegion& region = map_.open.emplace_back();
      describe(region, open_poses.zero, mode);
      region.lower = open_poses.lower;
      region.upper = open_poses.upper;
    }
    if (over_two()) map_.workspace.push_back({mode.mode, found.rings});
    return found.cells;
  }

  struct Mode {
    const DyadSides& sides;
    core::WorkingMode mode;
    const core::PoseStatics& statics;
  };

  /// Of curves, surfaces, points and open regions.
  template <class Place>
  void describe(Place& place, const loci::pose::PoseZero& zero, const Mode& mode) const {
    place.mode = mode.mode;
    if (zero.doubt == Doubt::workspace) {
      place.kind = LocusKind::workspace_boundary;
      if (zero.dead_centre) place.cause = "dead centre of " + names_of_groups(mechanism_);
    } else if (zero.doubt == Doubt::singularity) {
      place.kind = LocusKind::direct_singularity;
    } else {
      const core::TaskDemand& demand = mode.statics.demands[static_cast<std::size_t>(zero.demand)].demand;
      place.kind = locus_kind_of(demand);
      place.vanishing = {{demand.joint, demand.quantity, 1}};
    }
  }

  /// Sides of a fold on which a link bends are out of reach.
  bool is_rigid(const std::vector<double>& pose, const DyadSides& sides) const {
    return !numeric::posture(model_, pose, sides).broken;
  }

  void add(const loci::pose::PoseLocus& locus, const Mode& mode) {
    if (over_two())
      add_curve(locus, mode);
    else
      add_surface(locus, mode);
  }

  void add_curve(const loci::pose::PoseLocus& locus, const Mode& mode) {
    core::LocusCurve curve;
    describe(curve, locus.zero, mode);
    for (const core::Polyline& points : locus.arcs) {
      const core::Point2& middle = points[points.size() / 2];
      if (!is_rigid({middle[0], middle[1]}, mode.sides)) continue;
      core::Arc& arc = curve.arcs.emplace_back();
      arc.closed = points.size() > 2 && points.front() == points.back();
      arc.points = points;
      for (std::size_t i = 1; i < points.size(); ++i)
        arc.length += std::hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
    }
    if (!curve.arcs.empty()) add(map_.curves, std::move(curve));
  }

  template <class Place>
  bool meet(const Place& p, const Place& q) const {
    constexpr double same = 1e-9;  // of the box
    for (std::size_t c = 0; c < lower_.size(); ++c)
      if (std::abs(p[c] - q[c]) > same * (upper_[c] - lower_[c])) return false;
    return true;
  }
  /// Whether two loci are one, on which several reactions vanish: vertex by vertex.
  bool is_same(const core::IsolatedPoint& a, const core::IsolatedPoint& b) const { return meet(a.at, b.at); }
  bool is_same(const core::LocusCurve& a, const core::LocusCurve& b) const {
    const auto meets = [&](const core::Point2& p, const core::Point2& q) { return meet(p, q); };
    return std::equal(
        a.arcs.begin(), a.arcs.end(), b.arcs.begin(), b.arcs.end(), [&](const core::Arc& one, const core::Arc& other) {
          return std::equal(one.points.begin(), one.points.end(), other.points.begin(), other.points.end(), meets);
        });
  }
  bool is_same(const core::LocusSurface& a, const core::LocusSurface& b) const {
    return std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(),
                      [&](const core::Point3& p, const core::Point3& q) { return meet(p, q); });
  }

  template <class Locus>
  void add(std::vector<Locus>& all, Locus locus) const {
    for (Locus& other : all) {
      if (other.mode != locus.mode || !is_same(other, locus)) continue;
      other.kind = std::min(other.kind, locus.kind);
      other.vanishing.insert(other.vanishing.end(), locus.vanishing.begin(), locus.vanishing.end());
      return;
    }
    all.push_back(std::move(locus));
  }

  void add_surface(const loci::pose::PoseLocus& locus, const Mode& mode) {
    const core::Point3& first = locus.vertices.front();
    if (!is_rigid({first.begin(), first.end()}, mode.sides)) return;
    core::LocusSurface surface;
    describe(surface, locus.zero, mode);
    surface.vertices = locus.vertices;
    surface.triangles = locus.triangles;
    loci::measure(surface);
    add(map_.surfaces, std::move(surface));
  }

  void add_notes(int cells) {
    const std::string lattice = std::to_string(cells) + " cells along each coordinate";
    map_.notes.push_back("the points of " + names_of_groups(mechanism_) + " have no formulas: loci are computed in " +
                         "floating point from " + lattice + ", and are not certified; parts of a locus that are " +
                         "smaller than a cell may be missing");
    if (!over_two())
      map_.notes.emplace_back("curves along which a contact force of several components vanishes are not computed");
  }

  void name() {
    const auto before = [](const auto& a, const auto& b) { return a.kind < b.kind; };
    std::stable_sort(map_.curves.begin(), map_.curves.end(), before);
    std::stable_sort(map_.surfaces.begin(), map_.surfaces.end(), before);
    int number = 0;
    for (core::LocusCurve& curve : map_.curves) curve.id = "c" + std::to_string(++number);
    number = 0;
    for (core::LocusSurface& surface : map_.surfaces) surface.id = "s" + std::to_string(++number);
  }

  const Mechanism& mechanism_;
  const LociRequest& request_;
  numeric::NumericModel model_;
  std::vector<double> lower_, upper_;
  core::LocusMap map_;
};

core::LocusMap followed(const Mechanism& mechanism, const LociRequest& request) {
  if (const std::optional<Framed> scaled = framed(mechanism, Scaling::none))
    return from_frame(followed(scaled->mechanism, in_frame(request, scaled->frame)), mechanism, scaled->frame);
  return Followed(mechanism, request).follow();
}

}  // namespace

core::LocusMap ends_of_zones(const Mechanism& mechanism, core::Zones zones) {
  return Points(mechanism, std::move(zones)).collect();
}

core::LocusMap loci_by_cells(const Mechanism& mechanism, const LociRequest& request) {
  require_traceable(mechanism, request);
  const auto start = std::chrono::steady_clock::now();
  core::LocusMap map = mechanism.coordinates.size() == 1
                           ? ends_of_zones(mechanism, zones_by_cells(mechanism, {.loci = request}))
                           : followed(mechanism, request);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  map.timing.emplace_back("cells", taken.count());
  return map;
}

}  // namespace clearloci
