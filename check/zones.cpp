#include "check/zones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/identity.hpp"
#include "check/plane.hpp"
#include "check/zone_borders.hpp"

namespace clearloci::check {
namespace {

using core::Point2;
using core::Polyline;

// Relative to the box: corners of zones are ends and crossings of arcs, computed apart from them.
constexpr double on_border = 1e-7;
// Poses of the box that are looked at in every mode: a lattice of so many either way, askew to what designs like.
constexpr int poses_a_side = 23;
// As many times as far from an arc as what is said to be on it, a pose is beside it.
constexpr double off_arcs = 4;

double area_of(const Polyline& ring) {
  double twice = 0;
  for (std::size_t i = 1; i < ring.size(); ++i)
    twice += (ring[i - 1][0] - ring[0][0]) * (ring[i][1] - ring[0][1]) -
             (ring[i][0] - ring[0][0]) * (ring[i - 1][1] - ring[0][1]);
  return 0.5 * std::abs(twice);
}

double length_of(const Polyline& ring) {
  double sum = 0;
  for (std::size_t i = 1; i < ring.size(); ++i)
    sum += std::hypot(ring[i][0] - ring[i - 1][0], ring[i][1] - ring[i - 1][1]);
  return sum;
}

/// By how many rings the place is surrounded, odd or even.
bool is_inside(const ZoneClaim& zone, const Point2& at) {
  bool in = false;
  for (const Polyline* ring : rings_of(zone))
    for (std::size_t i = 1; i < ring->size(); ++i) {
      const Point2 &a = (*ring)[i - 1], &b = (*ring)[i];
      if ((a[1] > at[1]) != (b[1] > at[1]) && at[0] < a[0] + (at[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) in = !in;
    }
  return in;
}

bool is_near_border(const ZoneClaim& zone, const Point2& at, double reach) {
  const auto rings = rings_of(zone);
  return std::any_of(rings.begin(), rings.end(), [&](const Polyline* ring) { return passes_near(*ring, at, reach); });
}

class ZoneCheck {
 public:
  ZoneCheck(const mechanism::Mechanism& m, const CertificateFile& c, Examination& examination)
      : m_(m), c_(c), examination_(examination), unknowns_(reactions_of(m)) {
    for (std::size_t i = 0; i < 4; ++i) box_[i] = c.box[i].get_d();
    reach_ = near() + 2 * c.tolerance;
  }

  void run() {
    for (const ZoneClaim& zone : c_.zones) {
      if (!zone.certified) {
        examination_.unchecked.push_back("zone " + zone.id.substr(0, 40) + ": not claimed to be certain");
        continue;
      }
      if (zone.outer.size() < 4 || !is_inside(zone, zone.sample)) fail(zone, "its sample is not inside");
      if (!has_signs_of(zone, zone.sample)) fail(zone, "its sample is no pose of the mode");
      check_border(zone);
      check_arcs_within(zone);
      ++examination_.zones;
    }
    for (int mode = 0; mode < static_cast<int>(c_.modes.size()); ++mode) {
      const std::vector<const ZoneClaim*> zones = zones_of(mode);
      const bool all = c_.in_doubt[static_cast<std::size_t>(mode)] == 0 &&
                       std::all_of(zones.begin(), zones.end(), [](const auto* zone) { return zone->certified; });
      check_poses(mode, zones, all);
      if (all)
        check_cover(mode, zones);
      else
        examination_.unchecked.push_back(
            fmt::format("mode {}: whether the zones are all of the workspace, which is said to be in doubt", mode + 1));
    }
  }

 private:
  [[noreturn]] static void fail(const ZoneClaim& zone, const std::string& what) {
    throw FalseClaim("zone " + zone.id.substr(0, 40) + ": " + what);
  }

  std::optional<Solution> solve_at(int mode, const Point2& at) const {
    const Interval x(at[0], cell_bits), y(at[1], cell_bits);
    const auto here = posture(m_, sides_of(c_, mode), x, y);
    return here ? solve(m_, *here, x, y) : std::nullopt;
  }

  /// Throws where a sign is another; false: no pose of the mode.
  bool has_signs_of(const ZoneClaim& zone, const Point2& at) const {
    const auto solved = solve_at(zone.mode, at);
    if (!solved) return false;
    const std::string place = fmt::format(" at ({}, {})", at[0], at[1]);
    if (solved->determinant.sign() != zone.assembly_mode) fail(zone, "|A| has another sign" + place);
    for (const auto& [reaction, sign] : zone.signs) {
      bool decided = false;
      for (std::size_t k = 0; k < unknowns_.size(); ++k) {
        if (m_.joints[static_cast<std::size_t>(unknowns_[k].joint)].name != reaction.first ||
            unknowns_[k].quantity != reaction.second)
          continue;
        decided = true;
        if (solved->reactions[k].sign() != sign)
          fail(zone,
               core::to_string(reaction.second) + "_" + reaction.first.substr(0, 40) + " has another sign" + place);
      }
      if (!decided) fail(zone, "it has the sign of no reaction");
    }
    return true;
  }

  bool is_on_arc(int mode, const Point2& at) const {
    return std::any_of(c_.curves.begin(), c_.curves.end(), [&](const CurveClaim& curve) {
      return curve.mode == mode && std::any_of(curve.arcs.begin(), curve.arcs.end(), [&](const core::Arc& arc) {
               return passes_near(arc.points, at, reach_);
             });
    });
  }

  void check_border(const ZoneClaim& zone) const {
    double area = 2 * area_of(zone.outer), length = 0;
    for (const Polyline* ring : rings_of(zone)) {
      area -= area_of(*ring);
      length += length_of(*ring);
      if (ring->front() != ring->back()) fail(zone, "a ring is not closed");
      for (std::size_t i = 1; i < ring->size(); ++i) {
        const Point2 &a = (*ring)[i - 1], &b = (*ring)[i];
        for (const Point2& at : {b, Point2{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}}) {
          const bool on_box = std::min({std::abs(at[0] - box_[0]), std::abs(at[0] - box_[1]), std::abs(at[1] - box_[2]),
                                        std::abs(at[1] - box_[3])}) <= reach_;
          if (!on_box && !is_on_arc(zone.mode, at))
            fail(zone, fmt::format("its border leaves the arcs at ({}, {})", at[0], at[1]));
        }
      }
    }
    if (!(std::abs(area - zone.area) <= 2 * c_.tolerance * length)) fail(zone, "its area is another");
  }

  /// One that ends within does not divide the zone.
  void check_arcs_within(const ZoneClaim& zone) const {
    const auto within = [&](const Point2& at) { return is_inside(zone, at) && !is_near_border(zone, at, reach_); };
    for (const CurveClaim& curve : c_.curves) {
      const bool bounds = curve.kind <= core::LocusKind::backlash || curve.kind == core::LocusKind::direct_singularity;
      if (curve.mode != zone.mode || !bounds || !curve.certified) continue;
      for (const core::Arc& arc : curve.arcs) {
        const Point2& middle = arc.points[arc.points.size() / 2];
        if (arc.points.size() > 2 && within(middle) &&
            (arc.closed || (!within(arc.points.front()) && !within(arc.points.back()))))
          fail(zone, fmt::format("an arc passes through it at ({}, {})", middle[0], middle[1]));
      }
    }
  }

  std::vector<const ZoneClaim*> zones_of(int mode) const {
    std::vector<const ZoneClaim*> zones;
    for (const ZoneClaim& zone : c_.zones)
      if (zone.mode == mode) zones.push_back(&zone);
    return zones;
  }

  /// A pose off the arcs is in one of the mode's zones, and has its signs. `all`: not in none.
  void check_pose(int mode, const std::vector<const ZoneClaim*>& zones, bool all, const Point2& at) const {
    const bool in_box = box_[0] < at[0] && at[0] < box_[1] && box_[2] < at[1] && at[1] < box_[3];
    if (!in_box || !solve_at(mode, at) || is_on_arc(mode, at)) return;
    int count = 0;
    for (const ZoneClaim* zone : zones) {
      if (!is_inside(*zone, at)) continue;
      ++count;
      if (zone->certified) (void)has_signs_of(*zone, at);
    }
    if (count > 1 || (count == 0 && all))
      throw FalseClaim(fmt::format("zones: the pose ({}, {}) is in {} of them", at[0], at[1], count));
  }

  void check_poses(int mode, const std::vector<const ZoneClaim*>& zones, bool all) const {
    for (const ZoneClaim* zone : zones) check_pose(mode, zones, all, zone->sample);
    for (int i = 0; i < poses_a_side; ++i)
      for (int k = 0; k < poses_a_side; ++k)
        check_pose(mode, zones, all,
                   {box_[0] + (i + 0.3719) / poses_a_side * (box_[1] - box_[0]),
                    box_[2] + (k + 0.6173) / poses_a_side * (box_[3] - box_[2])});
  }

  /// Beyond its border each zone has another one, or the workspace ends there; so it is zones as far as it hangs
  /// together. Every part of it that is not the box alone has an arc, both sides of which are looked at.
  void check_cover(int mode, const std::vector<const ZoneClaim*>& zones) const {
    const ZoneBorders borders(zones);
    for (const auto& [a, b] : borders.one_sided())
      if (!is_on_box(a, b) && !(may_be_boundary(mode, a) && may_be_boundary(mode, b)))
        throw FalseClaim(fmt::format("zones: none is on the other side of a border at ({}, {})", a[0], a[1]));
    for (const CurveClaim& curve : c_.curves) {
      if (curve.mode != mode || !curve.certified || curve.kind == core::LocusKind::component) continue;
      for (const core::Arc& arc : curve.arcs) {
        for (const double side : {-1.0, 1.0}) check_pose(mode, zones, true, beside(arc.points, side));
        if (curve.kind == core::LocusKind::workspace_boundary) continue;
        for (const Point2& at : arc.points)
          if (!borders.has_vertex(at) && std::none_of(zones.begin(), zones.end(), [&](const ZoneClaim* zone) {
                return is_near_border(*zone, at, reach_);
              }))
            throw FalseClaim(fmt::format("zones: an arc at ({}, {}) is no border of one", at[0], at[1]));
      }
    }
  }

  bool is_on_box(const Point2& a, const Point2& b) const {
    for (std::size_t side = 0; side < 4; ++side) {
      const std::size_t axis = side / 2;
      if (std::max(std::abs(a[axis] - box_[side]), std::abs(b[axis] - box_[side])) <= near()) return true;
    }
    return false;
  }

  /// Whether a root may be zero there.
  bool may_be_boundary(int mode, const Point2& at) const {
    const auto around = [&](double middle) { return Interval(middle - near(), middle + near(), cell_bits); };
    return may_be_on_boundary(m_, c_, mode, around(at[0]), around(at[1]));
  }

  /// A little off the middle of an arc.
  Point2 beside(const Polyline& points, double side) const {
    const Point2 &a = points[points.size() / 2 - 1], &b = points[points.size() / 2];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]),
                 off = length > 0 ? side * off_arcs * reach_ / length : 0;
    return {0.5 * (a[0] + b[0]) - off * (b[1] - a[1]), 0.5 * (a[1] + b[1]) + off * (b[0] - a[0])};
  }

  double near() const { return on_border * std::max(box_[1] - box_[0], box_[3] - box_[2]); }

  const mechanism::Mechanism& m_;
  const CertificateFile& c_;
  Examination& examination_;
  std::vector<mechanism::Unknown> unknowns_;
  std::array<double, 4> box_{};
  double reach_ = 0;
};

}  // namespace

void check_zones(const mechanism::Mechanism& m, const CertificateFile& certificate, Examination& examination) {
  if (certificate.command == "zones" || !certificate.zones.empty()) ZoneCheck(m, certificate, examination).run();
}

}  // namespace clearloci::check
