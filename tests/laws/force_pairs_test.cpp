// Lower pairs of functions in the place of the components of a force have the same common zeros.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "loci/curves/force_zeros.hpp"
#include "loci/curves/isolated_points.hpp"
#include "mechanism/read.hpp"
#include "numeric/reactions.hpp"
#include "symbolic/locus_problem.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

std::vector<core::IsolatedPoint> points_of(const core::LocusProblem& problem) {
  core::LocusMap map;
  loci::add_contact_loss_points(problem, problem.modes.front(), map, {}, 4096, nullptr);
  EXPECT_TRUE(map.open.empty());
  return map.isolated_points;
}

/// Points of one list, with a joint that loses contact there, that the other one has not.
int missing(const std::vector<core::IsolatedPoint>& list, const std::vector<core::IsolatedPoint>& other) {
  int count = 0;
  for (const core::IsolatedPoint& point : list)
    for (const core::Vanishing& v : point.vanishing)
      count += std::none_of(other.begin(), other.end(), [&](const core::IsolatedPoint& same) {
        return same.kind == point.kind && std::hypot(same.at[0] - point.at[0], same.at[1] - point.at[1]) < 1e-9 &&
               std::find(same.vanishing.begin(), same.vanishing.end(), v) != same.vanishing.end();
      });
  return count;
}

/// Of the two functions that are searched together, at most.
std::size_t terms_of(const core::LocusProblem& problem, const std::string& joint) {
  std::size_t most = 0;
  for (const loci::ForceZeros& zeros : loci::zeros_of_force(problem, joint))
    most = std::max(most, zeros.system[0]->sheet.terms.size() + zeros.system[1]->sheet.terms.size());
  return most;
}

/// The normal of three functions is that component of the way between two points of a link which the second of them is
/// of the force, but for a positive factor: their signs are the same at all poses. How many there are.
int expect_normals_of_components(const mechanism::Mechanism& m, const core::LocusProblem& problem) {
  const numeric::NumericModel model = numeric::compile(m);
  const core::WorkingMode& mode = problem.modes.front();
  std::vector<std::vector<double>> poses;
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 20; ++k) poses.push_back({-0.8 + 0.095 * i, -0.9 + 0.09 * k});
  const auto value = [&](const core::Polynomial& p, const std::vector<double>& pose) {
    std::vector<double> at = pose;
    at.resize(static_cast<std::size_t>(problem.tower.variables()), 0.0);
    for (std::size_t j = 0; j < problem.tower.roots.size(); ++j)
      at[2 + j] = core::root_value(problem.tower.roots[j], mode[j], at).value_or(NAN);
    return core::evaluate(p, std::span<const double>(at));
  };
  int count = 0;
  for (const core::ForcePairs& pairs : problem.force_pairs)
    for (const core::ForcePair& pair : pairs.pairs) {
      if (!pair.third) continue;
      ++count;
      const auto factor = std::find_if(problem.factors.begin(), problem.factors.end(), [&](const auto& one) {
        return one.sheet == problem.pair_functions[pair.system[1]].sheet;
      });
      if (factor == problem.factors.end()) {
        ADD_FAILURE() << "no component of " << pairs.joint;
        continue;
      }
      const bool is_x = std::any_of(factor->vanishing.begin(), factor->vanishing.end(), [&](const core::Vanishing& v) {
        return v.joint == pairs.joint && v.quantity == core::Quantity::fx;
      });
      bool found = false;
      for (const mechanism::Link& link : m.links)
        for (const auto a : link.points)
          for (const auto b : link.points) {
            std::array<int, 2> alike{};  // poses at which signs are the same, and not
            for (const std::vector<double>& pose : poses) {
              const double normal = value(pair.normal, pose);
              const auto points = numeric::posture(model, pose, mechanism::working_mode(m)).points;
              const auto way = points[static_cast<std::size_t>(a)] - points[static_cast<std::size_t>(b)];
              if (std::isfinite(normal) && way.allFinite()) ++alike[normal * way[is_x ? 0 : 1] > 0 ? 0 : 1];
            }
            found = found || (alike[0] > 20 && alike[1] == 0);
          }
      EXPECT_TRUE(found) << pairs.joint;
    }
  return count;
}

/// `loads`: of the file; `joints`: how many have lower pairs.
void expect_same_points(const std::string& loads, std::size_t joints, std::size_t points) {
  const std::string text = R"(
format: 1
name: 5R with a dyad on one leg
space: planar
workspace: {x: [-0.8, 1.1], y: [-0.9, 0.9]}
points:
  A1: [0, 0]
  A2: [0.7, 0.1]
  A3: [1.2, 0.1]
  P: [x, y]
  B1: {dyad: [A1, P], lengths: [0.5, 0.45], side: right}
  B2: {dyad: [A2, P], lengths: [0.55, 0.5], side: left}
  Q: {on: [A2, B2], offset: [0.2, 0.1]}
  C: {dyad: [A3, Q], lengths: [0.6, 0.5], side: left}
links:
  A1B1: {points: [A1, B1], mass: 1/2}
  B1P: {points: [B1, P], mass: 1}
  PB2: {points: [P, B2], mass: 1}
  crank: {points: [A2, B2, Q], mass: 1}
  QC: {points: [Q, C], mass: 1/2}
  CA3: {points: [C, A3], mass: 1/4}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true}
  B1: {revolute: [A1B1, B1P], at: B1}
  P: {revolute: [B1P, PB2], at: P}
  B2: {revolute: [crank, PB2], at: B2}
  A2: {revolute: [ground, crank], at: A2}
  Q: {revolute: [crank, QC], at: Q}
  C: {revolute: [QC, CA3], at: C}
  A3: {revolute: [ground, CA3], at: A3, actuated: true}
end_effector: {link: PB2, at: P}
gravity: [0, -9.81]
loads:
)" + loads;
  const mechanism::Mechanism m = mechanism::parse_mechanism(text, "model.yaml");
  symbolic::Selection selection;
  selection.quantities = {core::Quantity::f};
  const core::LocusProblem lower = symbolic::locus_problem(m, selection).problem;
  core::LocusProblem plain = lower;
  plain.force_pairs.clear();
  EXPECT_EQ(lower.force_pairs.size(), joints);
  EXPECT_GT(expect_normals_of_components(m, lower), 0);
  for (const core::ForcePairs& pairs : lower.force_pairs)
    EXPECT_LT(terms_of(lower, pairs.joint), terms_of(plain, pairs.joint)) << pairs.joint;
  const std::vector<core::IsolatedPoint> found = points_of(lower), expected = points_of(plain);
  EXPECT_EQ(missing(found, expected), 0);
  EXPECT_EQ(missing(expected, found), 0);
  EXPECT_EQ(found.size(), points);
  for (const core::IsolatedPoint& point : found) EXPECT_TRUE(point.certified) << point.at[0] << ", " << point.at[1];
}

TEST(ForcePairs, OfVerticalLoads) { expect_same_points("  - {link: PB2, at: P, force: [0, -60]}\n", 8, 9); }

TEST(ForcePairs, OfLoadsInGeneralDirections) {
  expect_same_points("  - {link: PB2, at: P, force: [60, -30]}\n", 8, 16);
}

}  // namespace
}  // namespace clearloci
