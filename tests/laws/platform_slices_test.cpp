// Slices of 6-UPS platforms with irrational places, with an angle among the free coordinates, and with a least force:
// their loci hold against reactions solved numerically.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "analysis/loci.hpp"
#include "analysis/zones.hpp"
#include "numeric/reactions.hpp"

namespace clearloci {
namespace {

struct Platform {
  std::string workspace, parameters = "{}", place = "[x, y, 0.6]";
  std::array<std::string, 6> base, joints;  ///< points; legs of equal joints share it
};

std::string text_of(const Platform& platform) {
  std::string points = "  P: " + platform.place + "\n", links = "  platform: {points: [P", rods, joints;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string k = std::to_string(i), a = "A" + k, b = "B" + k;
    points += "  " + a + ": " + platform.base[i] + "\n  " + b + ": " + platform.joints[i] + "\n";
    links += ", " + b;
    rods += "  cylinder" + k + ": {points: [" + a + "]}\n  rod" + k + ": {points: [" + b + "]}\n";
    joints += "  U" + k + ": {universal: [ground, cylinder" + k + "], at: " + a;
    joints += ", axes: [[1, 0, 0], 'cross([1, 0, 0], " + b + " - " + a + ")']}\n";
    joints += "  S" + k + ": {prismatic: [cylinder" + k + ", rod" + k + "], at: " + b;
    joints += ", axis: " + b + " - " + a + ", actuated: true}\n";
    joints += "  J" + k + ": {spherical: [rod" + k + ", platform], at: " + b + "}\n";
  }
  return "format: 1\nname: platform\nspace: spatial\nparameters: " + platform.parameters +
         "\nworkspace: " + platform.workspace + "\npoints:\n" + points + "links:\n" + links + "]}\n" + rods +
         "joints:\n" + joints +
         "end_effector: {link: platform, at: P}\nloads:\n"
         "  - {link: platform, at: P, force: [30, -45, -250], couple: [4, -7, 3]}\n";
}

/// A 6-3 platform whose places are all irrational, each within 1e-30: the coefficients of its curves are integers of
/// hundreds of digits, beyond the range of doubles.
Platform six_three_on_circles() {
  Platform result;
  result.workspace = "{x: [-0.35, 0.35], y: [-0.35, 0.35]}";
  result.parameters = "{a: 8 deg, b: -5 deg}";
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string a = "(" + std::to_string(30 + 120 * (i / 2)) + " deg)";
    const std::string angle = std::to_string(10 + 120 * (i / 2) + 40 * (i % 2)) + " deg";
    const std::string c = "0.25*cos" + a, s = "0.25*sin" + a;
    result.base[i] = "[0.5*cos(" + angle + "), 0.5*sin(" + angle + "), 0]";
    result.joints[i] = "[x + cos(b)*" + c + ", y + sin(a)*sin(b)*" + c + " + cos(a)*" + s + ", 0.6 - cos(a)*sin(b)*" +
                       c + " + sin(a)*" + s + "]";
  }
  return result;
}

const std::array<std::array<const char*, 3>, 6> bases = {{{"0.52", "0.03", "0.02"},
                                                          {"0.31", "0.47", "-0.05"},
                                                          {"-0.26", "0.44", "0.03"},
                                                          {"-0.55", "-0.08", "0"},
                                                          {"-0.22", "-0.49", "0.06"},
                                                          {"0.29", "-0.41", "-0.01"}}};
const std::array<std::array<const char*, 3>, 6> corners = {{{"0.21", "0.09", "0"},
                                                            {"0.05", "0.24", "0.03"},
                                                            {"-0.11", "0.2", "-0.02"},
                                                            {"-0.25", "-0.04", "0.01"},
                                                            {"-0.09", "-0.21", "0.02"},
                                                            {"0.13", "-0.19", "-0.01"}}};

std::string vector(const std::string& x, const std::string& y, const std::string& z) {
  return "[" + x + ", " + y + ", " + z + "]";
}

/// Over x and the turn t about the vertical.
Platform turning(const std::string& range) {
  Platform result;
  result.workspace = "{x: [-0.35, 0.35], t: {angle: " + range + "}}";
  result.place = "[x, 0.07, 0.6]";
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& b = corners[i];
    const std::string bx = std::string("(") + b[0] + ")", by = std::string("(") + b[1] + ")";
    result.base[i] = vector(bases[i][0], bases[i][1], bases[i][2]);
    result.joints[i] = vector("x + " + bx + "*cos(t) - " + by + "*sin(t)",
                              "0.07 + " + bx + "*sin(t) + " + by + "*cos(t)", std::string("0.6 + ") + b[2]);
  }
  return result;
}

/// Over two tilts: the matrix has two angles in it.
Platform tilting() {
  Platform result;
  result.workspace = "{a: {angle: [-50 deg, 50 deg]}, b: {angle: [-50 deg, 50 deg]}}";
  result.place = "[0.02, -0.03, 0.6]";
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string x = std::string("(") + corners[i][0] + ")", y = std::string("(") + corners[i][1] + ")";
    result.base[i] = vector(bases[i][0], bases[i][1], bases[i][2]);
    result.joints[i] = vector("0.02 + cos(b)*" + x, "-0.03 + sin(a)*sin(b)*" + x + " + cos(a)*" + y,
                              "0.6 - cos(a)*sin(b)*" + x + " + sin(a)*" + y);
  }
  return result;
}

mechanism::Mechanism read(const Platform& platform) {
  return mechanism::parse_mechanism(text_of(platform), "platform.yaml");
}

Validation hold(const mechanism::Mechanism& mechanism, int nodes) {
  Validation validation = validate_loci(mechanism, {}, {nodes, nodes});
  EXPECT_TRUE(validation.map.complete);
  EXPECT_FALSE(validation.map.curves.empty());
  EXPECT_EQ(validation.report.disputed, 0u);
  EXPECT_GT(validation.report.held, 100u * validation.report.undecided);
  for (const core::LocusCurve& curve : validation.map.curves) EXPECT_TRUE(curve.certified) << curve.id;
  return validation;
}

TEST(PlatformSlices, PlacesOnCirclesHoldAgainstTheWitness) { hold(read(six_three_on_circles()), 30); }

TEST(PlatformSlices, AnAngleOfOneChartHoldsAgainstTheWitness) {
  const Validation validation = hold(read(turning("[-60 deg, 60 deg]")), 40);
  EXPECT_EQ(validation.map.tower.coordinates, (std::vector<std::string>{"x", "t"}));
  EXPECT_EQ(validation.map.angles, (std::vector<bool>{false, true}));
  for (const core::LocusCurve& curve : validation.map.curves) {
    EXPECT_EQ(curve.variables, (std::vector<std::string>{"x", "tan(t/2)"}));
    for (const core::Arc& arc : curve.arcs)
      for (const core::Point2& at : arc.points) EXPECT_LE(std::abs(at[1]), std::numbers::pi / 3 + 1e-12);
  }
}

TEST(PlatformSlices, CurvesRunOnOverTheSeamsOfAnAngle) {
  const mechanism::Mechanism m = read(turning("[-100 deg, 250 deg]"));
  hold(m, 50);
  const core::LocusMap map = trace_loci(m);
  int across = 0;
  for (const core::LocusCurve& curve : map.curves) {
    for (const core::Arc& arc : curve.arcs) {
      for (std::size_t k = 1; k < arc.points.size(); ++k) {
        const core::Point2 &p = arc.points[k - 1], &q = arc.points[k];
        EXPECT_LT(std::hypot(p[0] - q[0], p[1] - q[1]), 0.2);
        for (const double seam : {-1, 1, 3}) {
          const double at = seam * std::numbers::pi / 2;
          if (k > 1 && std::abs(p[1] - at) < 1e-9) ++across;
        }
      }
      for (const auto& [end, at] : {std::pair(arc.ends[0], arc.points.front()), {arc.ends[1], arc.points.back()}}) {
        if (end != core::ArcEnd::box) continue;
        const bool on_box = std::abs(std::abs(at[0]) - 0.35) < 1e-9 ||
                            std::abs(at[1] + 100 * std::numbers::pi / 180) < 1e-9 ||
                            std::abs(at[1] - 250 * std::numbers::pi / 180) < 1e-9;
        EXPECT_TRUE(on_box) << curve.id << " ends inside at " << at[0] << ", " << at[1];
      }
    }
  }
  EXPECT_GE(across, 3);
}

TEST(PlatformSlices, TwoAnglesHoldAgainstTheWitness) { hold(read(tilting()), 30); }

TEST(PlatformSlices, ZonesOverAnAngleAreByCells) {
  const core::Zones map = find_zones(read(turning("[0, 40 deg]")), {.cells = 2000});
  ASSERT_TRUE(map.by_cells);
  const core::ZonedMode& mode = map.modes.front();
  double sum = mode.outside + mode.in_doubt, box = 1;
  for (const core::Zone& zone : map.zones) sum += zone.at_least;
  for (std::size_t c = 0; c < 2; ++c) box *= core::to_double(map.loci.upper[c] - map.loci.lower[c]);
  EXPECT_NEAR(sum, box, 1e-9 * box);
}

/// The two senses of a leg's least force cross where the force and |A| vanish together.
TEST(PlatformSlices, ALeastForceIsTracedToTheDirectSingularity) {
  Platform platform = turning("[0, 1]");
  platform.workspace = "{x: [-0.35, 0.35], y: [-0.35, 0.35]}";
  platform.place = "[x, y, 0.6]";
  for (std::size_t i = 0; i < 6; ++i)
    platform.joints[i] = vector(std::string("x + ") + corners[i][0], std::string("y + ") + corners[i][1],
                                std::string("0.6 + ") + corners[i][2]);
  const mechanism::Mechanism m = read(platform);
  LociRequest request;
  request.joints = {"J2", "U4"};
  request.min_force = 40;
  const core::LocusMap map = trace_loci(m, request);
  const numeric::NumericModel model = numeric::compile(m);
  int senses = 0;
  for (const core::LocusCurve& curve : map.curves) {
    EXPECT_TRUE(curve.certified) << curve.id;
    if (curve.kind != core::LocusKind::margin) continue;
    ++senses;
    const std::string& joint = curve.vanishing.front().joint;
    for (const core::Arc& arc : curve.arcs) {
      const core::Point2& at = arc.points[arc.points.size() / 2];
      const numeric::BoundedNumerators n = numeric::bounded_numerators(model, at, {});
      double square = 0;
      for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
        const auto& unknown = model.unknowns[k];
        if (m.joints[static_cast<std::size_t>(unknown.joint)].name != joint) continue;
        if (unknown.quantity != core::Quantity::fx && unknown.quantity != core::Quantity::fy &&
            unknown.quantity != core::Quantity::fz)
          continue;
        square += std::pow(n.values[k].value / n.determinant.value, 2);
      }
      EXPECT_NEAR(std::sqrt(square), 40, 1e-3) << curve.id;
    }
  }
  EXPECT_EQ(senses, 4);  // either joint, pushed and pulled
}

}  // namespace
}  // namespace clearloci
