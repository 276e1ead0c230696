#include "check/zones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/identity.hpp"
#include "check/plane.hpp"

namespace clearloci::check {
namespace {

using core::Point2;
using core::Polyline;

// Relative to the box: corners of zones are ends and crossings of arcs, computed apart from them.
constexpr double on_border = 1e-7;

double area_of(const Polyline& ring) {
  double twice = 0;
  for (std::size_t i = 1; i < ring.size(); ++i)
    twice += (ring[i - 1][0] - ring[0][0]) * (ring[i][1] - ring[0][1]) -
             (ring[i][0] - ring[0][0]) * (ring[i - 1][1] - ring[0][1]);
  return 0.5 * twice;
}

double length_of(const Polyline& ring) {
  double sum = 0;
  for (std::size_t i = 1; i < ring.size(); ++i)
    sum += std::hypot(ring[i][0] - ring[i - 1][0], ring[i][1] - ring[i - 1][1]);
  return sum;
}

bool is_inside(const Polyline& ring, const Point2& at) {
  bool in = false;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const Point2 &a = ring[i - 1], &b = ring[i];
    if ((a[1] > at[1]) != (b[1] > at[1]) && at[0] < a[0] + (at[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) in = !in;
  }
  return in;
}

}  // namespace

void check_zone(const mechanism::Mechanism& m, const CertificateFile& c, const ZoneClaim& zone) {
  const auto fail = [&](const std::string& what) { throw FalseClaim("zone " + zone.id.substr(0, 40) + ": " + what); };
  const Interval x(zone.sample[0], cell_bits), y(zone.sample[1], cell_bits);
  const auto here = posture(m, sides_of(c, zone.mode), x, y);
  const auto solved = here ? solve(m, *here, x, y) : std::nullopt;
  if (!solved) fail("its sample is no pose of the mode");
  if (solved->determinant.sign() != zone.assembly_mode) fail("|A| has another sign at its sample");
  const std::vector<mechanism::Unknown> unknowns = reactions_of(m);
  for (const auto& [reaction, sign] : zone.signs) {
    bool known = false;
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const mechanism::Joint& joint = m.joints[static_cast<std::size_t>(unknowns[k].joint)];
      if (joint.name != reaction.first || unknowns[k].quantity != reaction.second) continue;
      known = true;
      if (solved->reactions[k].sign() != sign)
        fail(core::to_string(reaction.second) + "_" + joint.name + " has another sign");
    }
    if (!known) fail("it has the sign of no reaction");
  }
  if (zone.outer.size() < 4 || !is_inside(zone.outer, zone.sample)) fail("its sample is not inside");
  double area = area_of(zone.outer), length = length_of(zone.outer);
  for (const Polyline& hole : zone.holes) {
    if (is_inside(hole, zone.sample)) fail("its sample is in a hole");
    area -= std::abs(area_of(hole));
    length += length_of(hole);
  }
  if (!(std::abs(area - zone.area) <= 2 * c.tolerance * length)) fail("its area is another");

  std::array<double, 4> box{};
  for (std::size_t i = 0; i < 4; ++i) box[i] = c.box[i].get_d();
  const double reach = on_border * std::max(box[1] - box[0], box[3] - box[2]) + 2 * c.tolerance;
  const auto on_arc = [&](const Point2& at) {
    for (const CurveClaim& curve : c.curves)
      if (curve.mode == zone.mode)
        for (const core::Arc& arc : curve.arcs)
          if (passes_near(arc.points, at, reach)) return true;
    return false;
  };
  const auto check_border = [&](const Polyline& ring) {
    const std::size_t stride = std::max<std::size_t>(1, ring.size() / 64);
    for (std::size_t i = 1; i < ring.size(); i += stride) {
      const Point2 at = {0.5 * (ring[i][0] + ring[i - 1][0]), 0.5 * (ring[i][1] + ring[i - 1][1])};
      const bool on_box = std::min({std::abs(at[0] - box[0]), std::abs(at[0] - box[1]), std::abs(at[1] - box[2]),
                                    std::abs(at[1] - box[3])}) <= reach;
      if (!on_box && !on_arc(at)) fail(fmt::format("its border leaves the arcs at ({}, {})", at[0], at[1]));
    }
  };
  check_border(zone.outer);
  for (const Polyline& hole : zone.holes) check_border(hole);
}

}  // namespace clearloci::check
