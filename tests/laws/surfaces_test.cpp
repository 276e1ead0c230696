// Surfaces over three free coordinates: sections of their meshes against the curves of the slices, vertices against the
// witness in floating point, and the meshes themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>

#include "analysis/loci.hpp"
#include "tests/numeric/solved.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using core::LocusSurface;
using core::Point2;
using core::Point3;

std::string text_of(const std::string& name) {
  std::ifstream file(source_dir() + "/examples/" + name + ".yaml");
  return {std::istreambuf_iterator<char>(file), {}};
}

mechanism::Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
}

/// Everything is named alike over two coordinates and over three.
std::string name_of(core::LocusKind kind, const std::vector<core::Vanishing>& vanishing) {
  std::string name = core::to_string(kind);
  for (const core::Vanishing& v : vanishing) name += " " + core::to_string(v.quantity) + "_" + v.joint;
  return name;
}

using Segment = std::array<Point2, 2>;

/// Where the third coordinate has the value.
std::vector<Segment> section(const LocusSurface& surface, double value) {
  std::vector<Segment> segments;
  for (const auto& t : surface.triangles) {
    std::vector<Point2> ends;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point3& a = surface.vertices[static_cast<std::size_t>(t[i])];
      const Point3& b = surface.vertices[static_cast<std::size_t>(t[(i + 1) % 3])];
      if ((a[2] < value) == (b[2] < value)) continue;
      const double part = (value - a[2]) / (b[2] - a[2]);
      ends.push_back({a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])});
    }
    if (ends.size() == 2) segments.push_back({ends[0], ends[1]});
  }
  return segments;
}

double distance(const Point2& p, const Segment& segment) {
  const double dx = segment[1][0] - segment[0][0], dy = segment[1][1] - segment[0][1];
  const double square = dx * dx + dy * dy;
  const double part =
      square > 0 ? std::clamp(((p[0] - segment[0][0]) * dx + (p[1] - segment[0][1]) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(p[0] - segment[0][0] - part * dx, p[1] - segment[0][1] - part * dy);
}

double distance(const Point2& p, const std::vector<Segment>& segments) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& segment : segments) least = std::min(least, distance(p, segment));
  return least;
}

/// Largest distance of points along the segments of one from the other.
double farthest(const std::vector<Segment>& from, const std::vector<Segment>& to, double& length_beyond,
                double within) {
  double most = 0;
  for (const Segment& segment : from) {
    const Point2 middle = {(segment[0][0] + segment[1][0]) / 2, (segment[0][1] + segment[1][1]) / 2};
    const double off = distance(middle, to);
    most = std::max(most, off);
    if (off > within) length_beyond += std::hypot(segment[1][0] - segment[0][0], segment[1][1] - segment[0][1]);
  }
  return most;
}

/// The sections of all surfaces at a value of the third coordinate against the curves traced there, both ways.
void expect_sections_agree(const core::LocusMap& surfaces, double value, const core::LocusMap& slice, double within) {
  std::map<std::string, std::vector<Segment>> meshed, traced;
  for (const LocusSurface& surface : surfaces.surfaces)
    for (const Segment& segment : section(surface, value))
      meshed[name_of(surface.kind, surface.vanishing)].push_back(segment);
  for (const core::LocusCurve& curve : slice.curves) {
    for (const core::Arc& arc : curve.arcs)
      for (std::size_t i = 1; i < arc.points.size(); ++i)
        traced[name_of(curve.kind, curve.vanishing)].push_back({arc.points[i - 1], arc.points[i]});
  }
  for (const auto& [name, segments] : meshed) EXPECT_TRUE(traced.contains(name)) << name;
  for (const auto& [name, segments] : traced) {
    SCOPED_TRACE(name);
    double missing = 0, invented = 0;
    const double to_mesh = farthest(segments, meshed[name], missing, within);
    const double from_mesh = farthest(meshed[name], segments, invented, within);
    EXPECT_LE(from_mesh, within) << invented << " m of the mesh are off the curve";
    // An arc shorter than the triangles are may be missing.
    if (missing < 0.04) continue;
    EXPECT_LE(to_mesh, within) << missing << " m of the curve are off the mesh";
  }
}

TEST(SurfaceSections, GoughStewart) {
  const core::LocusMap surfaces = trace_loci(example("gough_stewart"));
  ASSERT_EQ(surfaces.surfaces.size(), 7U);
  for (const char* height : {"0.47", "0.6", "0.83"})
    expect_sections_agree(
        surfaces, std::stod(height),
        trace_loci(mechanism::parse_mechanism(text_of("gough_stewart_slice"), "slice.yaml", {{"z", height}})), 0.002);
}

TEST(SurfaceVertices, GoughStewartAgainstTheWitness) {
  const mechanism::Mechanism mechanism = example("gough_stewart");
  const core::LocusMap map = trace_loci(mechanism);
  const auto joint = [&](const std::string& name) {
    for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
      if (mechanism.joints[j].name == name) return j;
    return mechanism.joints.size();
  };
  double largest = 0;  // |A| somewhere in the box
  for (const double x : {-0.3, 0.0, 0.3})
    for (const double z : {0.45, 0.85})
      largest = std::max(largest, std::abs(test::solved(mechanism, Point3{x, 0.1, z}).determinant));
  int legs = 0;
  for (const LocusSurface& surface : map.surfaces) {
    const std::string leg =
        surface.vanishing.empty() ? "" : "S" + surface.vanishing.front().joint.substr(1);  // U1, B1 and S1
    legs += leg.empty() ? 0 : 1;
    double most = 0;
    for (std::size_t v = 0; v < surface.vertices.size(); v += 31) {
      const test::Solved posture = test::solved(mechanism, surface.vertices[v]);
      if (leg.empty()) {
        most = std::max(most, std::abs(posture.determinant) / largest);
        continue;
      }
      double any = 0;
      for (int i = 1; i <= 6; ++i)
        any = std::max(any, std::abs(posture.reactions[joint("S" + std::to_string(i))].actuator));
      most = std::max(most, std::abs(posture.reactions[joint(leg)].actuator) / any);
    }
    EXPECT_LT(most, 1e-7) << surface.id;
    EXPECT_TRUE(surface.certified) << surface.id;
  }
  EXPECT_EQ(legs, 6);
}

TEST(SurfaceVertices, TheSameEachTime) {
  for (const std::string name : {"three_upu", "three_rpr_orientation"}) {
    const core::LocusMap a = trace_loci(example(name)), b = trace_loci(example(name));
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    EXPECT_FALSE(a.surfaces.empty());
    for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
      EXPECT_TRUE(a.surfaces[i].certified) << name << " " << a.surfaces[i].id;
      EXPECT_EQ(a.surfaces[i].vertices, b.surfaces[i].vertices);
      EXPECT_EQ(a.surfaces[i].triangles, b.surfaces[i].triangles);
    }
  }
}

TEST(SurfaceSections, PlatformsOverTheirOrientation) {
  for (const std::string name : {"three_rpr", "three_rrr"}) {
    SCOPED_TRACE(name);
    const core::LocusMap surfaces = trace_loci(example(name + "_orientation"));
    for (const char* angle : {"-37 deg", "52 deg"}) {
      SCOPED_TRACE(angle);
      const double value = std::stod(angle) * std::numbers::pi / 180;
      expect_sections_agree(surfaces, value,
                            trace_loci(mechanism::parse_mechanism(text_of(name), "slice.yaml", {{"phi", angle}})),
                            0.006);
    }
  }
}

}  // namespace
}  // namespace clearloci
