// The pose error over the workspace jumps on the loci, and nowhere else: the error maps and the exact loci know nothing
// of one another.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "analysis/loci.hpp"
#include "numeric/error_samples.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using core::LocusKind;
using core::Point2;

mechanism::Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
}

struct Jump {
  Point2 at{};
  double dx = 0, dy = 0, dalpha = 0;  ///< sizes
  double error = 0;                   ///< of the pose itself
  double size() const { return std::hypot(dx, dy) + dalpha; }
};

struct Edge {
  Point2 a{}, b{};
  std::array<double, 3> at_a{}, at_b{};
};

double difference(const std::array<double, 3>& p, const std::array<double, 3>& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1]) + std::abs(p[2] - q[2]);
}

/// Errors at many poses; absent where unreachable or undefined.
std::vector<std::optional<std::array<double, 3>>> errors(const numeric::NumericModel& model,
                                                         const std::vector<int>& mode,
                                                         const std::vector<double>& poses) {
  const numeric::ErrorSamples s = numeric::error_samples(model, poses, mode, true, false);
  std::vector<std::optional<std::array<double, 3>>> result(s.error.size());
  for (std::size_t i = 0; i < s.error.size(); ++i)
    if (s.reachable[i] && !std::isnan(s.error[i].dp[0]))
      result[i] = {s.error[i].dp[0], s.error[i].dp[1], s.error[i].dalpha[2]};
  return result;
}

/// What is left of the differences between neighbouring nodes of a grid when each edge is halved, always into the half
/// with the greater difference, until it is a billionth of the box: a continuous error leaves nothing, a jump all.
std::vector<Jump> remaining_differences(const numeric::NumericModel& model, const std::vector<int>& mode, int nodes) {
  const auto& box = model.box;
  const auto node = [&](int i, int j) {
    return Point2{box[0][0] + (i + 0.414) * (box[0][1] - box[0][0]) / nodes,
                  box[1][0] + (j + 0.618) * (box[1][1] - box[1][0]) / nodes};
  };
  std::vector<double> poses;
  for (int j = 0; j < nodes; ++j)
    for (int i = 0; i < nodes; ++i) poses.insert(poses.end(), {node(i, j)[0], node(i, j)[1]});
  const auto this_errors = errors(model, mode, poses);
  std::vector<Edge> edges;
  for (int j = 0; j < nodes; ++j)
    for (int i = 0; i < nodes; ++i)
      for (const auto& [k, l] : {std::pair{i + 1, j}, std::pair{i, j + 1}}) {
        if (k >= nodes || l >= nodes) continue;
        const auto &p = this_errors[static_cast<std::size_t>(j * nodes + i)],
                   &q = this_errors[static_cast<std::size_t>(l * nodes + k)];
        if (p && q) edges.push_back({node(i, j), node(k, l), *p, *q});
      }
  constexpr int halvings = 26;
  for (int step = 0; step < halvings; ++step) {
    std::vector<double> middles;
    for (const Edge& e : edges) middles.insert(middles.end(), {(e.a[0] + e.b[0]) / 2, (e.a[1] + e.b[1]) / 2});
    const auto there = errors(model, mode, middles);
    std::vector<Edge> next;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (!there[k]) continue;  // the edge leaves the workspace, or hit a locus to the last bit
      Edge e = edges[k];
      const Point2 middle = {middles[2 * k], middles[2 * k + 1]};
      if (difference(e.at_a, *there[k]) >= difference(*there[k], e.at_b)) {
        e.b = middle;
        e.at_b = *there[k];
      } else {
        e.a = middle;
        e.at_a = *there[k];
      }
      next.push_back(e);
    }
    edges = std::move(next);
  }
  std::vector<Jump> jumps;
  for (const Edge& e : edges)
    jumps.push_back({e.a, std::abs(e.at_a[0] - e.at_b[0]), std::abs(e.at_a[1] - e.at_b[1]),
                     std::abs(e.at_a[2] - e.at_b[2]), difference(e.at_a, {})});
  return jumps;
}

double distance_to(const Point2& p, const core::Polyline& line) {
  double least = 1e9;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double ux = line[i + 1][0] - line[i][0], uy = line[i + 1][1] - line[i][1], D = ux * ux + uy * uy;
    const double t = D > 0 ? std::clamp(((p[0] - line[i][0]) * ux + (p[1] - line[i][1]) * uy) / D, 0.0, 1.0) : 0.0;
    least = std::min(least, std::hypot(p[0] - line[i][0] - t * ux, p[1] - line[i][1] - t * uy));
  }
  return least;
}

double distance_to(const Point2& p, const core::LocusMap& map, const std::vector<LocusKind>& kinds) {
  double least = 1e9;
  for (const core::LocusCurve& curve : map.curves)
    if (std::find(kinds.begin(), kinds.end(), curve.kind) != kinds.end())
      for (const core::Arc& arc : curve.arcs) least = std::min(least, distance_to(p, arc.points));
  return least;
}

constexpr double tolerance = 1e-5;      // of the arcs, m
constexpr double jump_at_least = 1e-6;  // m or rad; the clearances of the examples are 10 μm and 0.5 mrad
// Near a singularity the error itself grows as 1/distance: steep, but not by this part of it in 2e-10 m.
constexpr double jump_of_error = 1e-3;

struct Found {
  core::LocusMap map;
  std::vector<Jump> jumps;
};

Found search(const std::string& name, int nodes) {
  const mechanism::Mechanism mechanism = example(name);
  const numeric::NumericModel model = numeric::compile(mechanism);
  LociRequest request;
  request.tolerance = tolerance;
  Found found{trace_loci(mechanism, request), {}};
  for (const Jump& jump : remaining_differences(model, mechanism::working_mode(mechanism), nodes))
    if (jump.size() > std::max(jump_at_least, jump_of_error * jump.error)) found.jumps.push_back(jump);
  return found;
}

class ErrorJumps : public testing::TestWithParam<std::string> {};

TEST_P(ErrorJumps, LieOnTheLoci) {
  const Found found = search(GetParam(), 100);
  const std::vector<LocusKind> kinds = {LocusKind::contact_loss, LocusKind::backlash, LocusKind::direct_singularity};
  EXPECT_GT(found.jumps.size(), 50u);
  for (const Jump& jump : found.jumps)
    EXPECT_LT(distance_to(jump.at, found.map, kinds), 2 * tolerance)
        << "jump of " << jump.dx << ", " << jump.dy << " m, " << jump.dalpha << " rad at " << jump.at[0] << ", "
        << jump.at[1];
}

TEST_P(ErrorJumps, AreThereWhereverAnArcIsCrossed) {
  const mechanism::Mechanism mechanism = example(GetParam());
  const numeric::NumericModel model = numeric::compile(mechanism);
  const core::LocusMap map = trace_loci(mechanism);
  int crossed = 0, jumped = 0;
  for (const core::LocusCurve& curve : map.curves) {
    if (curve.kind != LocusKind::contact_loss && curve.kind != LocusKind::backlash) continue;
    for (const core::Arc& arc : curve.arcs) {
      const std::size_t stride = std::max<std::size_t>(1, arc.points.size() / 12);
      for (std::size_t i = 0; i + 1 < arc.points.size(); i += stride) {
        const Point2 &p = arc.points[i], &q = arc.points[i + 1];
        const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
        if (length < 1e-6) continue;
        const double h = 2 * tolerance, nx = -(q[1] - p[1]) / length * h, ny = (q[0] - p[0]) / length * h;
        const double mx = (p[0] + q[0]) / 2, my = (p[1] + q[1]) / 2;
        const auto sides = errors(model, mechanism::working_mode(mechanism), {mx + nx, my + ny, mx - nx, my - ny});
        if (!sides[0] || !sides[1]) continue;
        ++crossed;
        if (difference(*sides[0], *sides[1]) > jump_at_least) ++jumped;
      }
    }
  }
  EXPECT_GT(crossed, 20);
  EXPECT_EQ(jumped, crossed);
}

INSTANTIATE_TEST_SUITE_P(Examples, ErrorJumps,
                         testing::Values("five_bar", "five_bar_generic", "five_bar_horizontal", "five_bar_inclined",
                                         "five_bar_weights"),
                         [](const auto& test) { return test.param; });

/// The paper's findings on Figs. 9 and 11: "discontinuities appear only in the x coordinate error" under the vertical
/// load, and only in that of y under the horizontal one.
TEST(PaperErrorMaps, JumpAcrossTheLoadOnly) {
  for (const bool vertical : {true, false}) {
    const Found found = search(vertical ? "five_bar" : "five_bar_horizontal", 100);
    int jumps = 0;
    for (const Jump& jump : found.jumps) {
      if (distance_to(jump.at, found.map, {LocusKind::contact_loss}) > 2 * tolerance) continue;
      // Where a singularity crosses the locus both components grow without bound.
      if (distance_to(jump.at, found.map, {LocusKind::direct_singularity}) < 1e-2) continue;
      ++jumps;
      const double across = vertical ? jump.dx : jump.dy, along = vertical ? jump.dy : jump.dx;
      EXPECT_GT(across, 1e-6);
      EXPECT_LT(along, 1e-6 * across) << jump.at[0] << ", " << jump.at[1];
    }
    EXPECT_GT(jumps, 50);
  }
}

}  // namespace
}  // namespace clearloci
