// Spatial mechanisms: exact equations against the numeric route, which resolves reactions along other vectors, and the
// direct singularity of the Gough-Stewart platform against the Plücker lines of its legs.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "mechanism/read.hpp"
#include "numeric/spatial.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/locus_problem.hpp"

namespace clearloci::symbolic {
namespace {

using core::Quantity;
using mechanism::Mechanism;

std::string example_text(const std::string& name) {
  std::ifstream file(std::string(CLEARLOCI_SOURCE_DIR) + "/examples/" + name + ".yaml");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

Mechanism parsed(const std::string& text) { return mechanism::parse_mechanism(text, "spatial.yaml"); }

double evaluated(const Poly& p, const std::vector<double>& at) {
  return core::evaluate(p.plain(), std::span<const double>(at));
}

/// Coordinates first; constructed points, of which these mechanisms have none, would follow.
std::vector<double> ring_values(const Geometry& geometry, const std::vector<double>& pose) {
  EXPECT_TRUE(geometry.constructed().empty());
  std::vector<double> values(static_cast<std::size_t>(geometry.ring().size()), 0.0);
  std::copy(pose.begin(), pose.end(), values.begin());
  return values;
}

/// Every reaction, in Cartesian components with the actuator's share, from the exact numerators.
void hold(const Mechanism& m) {
  const Geometry geometry(m, false);
  const FactoredDeterminants exact = factored_determinants(geometry);
  std::mt19937 random(4);
  for (int sample = 0; sample < 5; ++sample) {
    std::vector<double> pose;
    for (const auto& c : m.coordinates)
      pose.push_back(
          std::uniform_real_distribution<double>(core::to_double(c.lower), core::to_double(c.upper))(random));
    const numeric::SpatialPosture witness = numeric::spatial_posture(m, pose);
    EXPECT_LT(witness.residual, 1e-12);
    const std::vector<double> at = ring_values(geometry, pose);
    const double determinant = evaluated(exact.determinant, at);
    double largest = 0;
    for (const auto& r : witness.reactions) largest = std::max({largest, r.force.norm(), std::abs(r.actuator)});
    const double tolerance = 1e-13 * witness.condition * (1 + largest);
    for (std::size_t k = 0; k < exact.numerators.size(); ++k) {
      const mechanism::Unknown& unknown = exact.equations.unknowns[k];
      const auto& joint = m.joints[static_cast<std::size_t>(unknown.joint)];
      const numeric::SpatialReaction& r = witness.reactions[static_cast<std::size_t>(unknown.joint)];
      const auto axis = [&](std::size_t i) {
        Eigen::Vector3d u;
        const auto components = geometry.vector(joint.axes.at(i));
        for (std::size_t c = 0; c < 3; ++c)
          u(static_cast<Eigen::Index>(c)) = evaluated(geometry.poly(components[c]), at);
        return u;
      };
      const bool slides = joint.type == mechanism::JointType::prismatic;
      Eigen::Vector3d force = r.force, couple = r.couple;
      if (joint.actuated) (slides ? force : couple) += r.actuator * axis(0).normalized();
      const double value = evaluated(exact.numerators[k], at) / determinant;
      const std::string name = exact.equations.unknown_names[k];
      switch (unknown.quantity) {
        case Quantity::fx:
        case Quantity::fy:
        case Quantity::fz:
          EXPECT_NEAR(value, force(static_cast<int>(unknown.quantity) - static_cast<int>(Quantity::fx)), tolerance)
              << name;
          break;
        case Quantity::mx:
        case Quantity::my:
        case Quantity::mz:
          EXPECT_NEAR(value, couple(static_cast<int>(unknown.quantity) - static_cast<int>(Quantity::mx)), tolerance)
              << name;
          break;
        case Quantity::T:
          EXPECT_NEAR((value * axis(0).cross(axis(1)) - couple).norm(), 0, tolerance) << name;
          break;
        default:
          // One of two components of a couple or force across a varying axis: it is one of the Cartesian ones.
          EXPECT_LT((couple.array() - value).abs().minCoeff(), tolerance) << name;
      }
    }
  }
}

TEST(Spatial, GoughStewartAgreesWithTheNumericRoute) { hold(parsed(example_text("gough_stewart"))); }

TEST(Spatial, ThreeUpuAgreesWithTheNumericRoute) { hold(parsed(example_text("three_upu"))); }

/// A spherical joint as a revolute one about the leg and a universal one: an axis that no component of is constant.
Mechanism with_a_revolute_in_a_leg() {
  std::string text = example_text("gough_stewart");
  text = replaced(text, "  rod1: {points: [B1]}\n", "  rod1: {points: [B1]}\n  collar1: {points: [B1]}\n");
  text = replaced(text, "  B1: {spherical: [rod1, platform], at: B1, clearance: {radial: 10e-6}}\n",
                  "  R1: {revolute: [rod1, collar1], at: B1, axis: [A1, B1]}\n"
                  "  W1: {universal: [collar1, platform], at: B1, axes: ['cross([1, 0, 0], B1 - A1)', [0, 1, 0]]}\n");
  return parsed(text);
}

TEST(Spatial, AVaryingAxisLeavesNoFactorBehind) {
  const Mechanism m = with_a_revolute_in_a_leg();
  hold(m);
  // The direct singularities are those of the platform with the spherical joint, and where the universal joint folds.
  const auto cubic = [](const Mechanism& mechanism) {
    const Geometry geometry(mechanism, false);
    for (const PolyFactor& factor : factored_determinants(geometry).determinant_factors.factors)
      if (factor.poly.total_degree() == 3) return core::to_string(factor.poly.plain(), geometry.ring().names());
    return std::string();
  };
  EXPECT_EQ(cubic(m), cubic(parsed(example_text("gough_stewart"))));
}

TEST(Spatial, GoughStewartIsSingularWhereItsLinesAre) {
  const Mechanism m = parsed(example_text("gough_stewart"));
  EXPECT_EQ(mechanism::unknowns(m).size(), 78u);
  const Geometry geometry(m, false);
  // The six legs' Plücker coordinates (B - A, (B - P) x (B - A)).
  GiNaC::matrix lines(6, 6);
  const auto point = [&](const std::string& name) {
    for (std::size_t i = 0; i < m.points.size(); ++i)
      if (m.points[i].name == name) return geometry.natural(static_cast<int>(i));
    return geometry.natural(0);
  };
  const auto p = point("P");
  for (unsigned leg = 0; leg < 6; ++leg) {
    const auto a = point("A" + std::to_string(leg + 1)), b = point("B" + std::to_string(leg + 1));
    std::array<GiNaC::ex, 3> u, r;
    for (std::size_t c = 0; c < 3; ++c) {
      u[c] = b[c] - a[c];
      r[c] = b[c] - p[c];
    }
    for (unsigned c = 0; c < 3; ++c) {
      lines(leg, c) = u[c];
      lines(leg, 3 + c) = r[(c + 1) % 3] * u[(c + 2) % 3] - r[(c + 2) % 3] * u[(c + 1) % 3];
    }
  }
  const Poly jacobian = geometry.poly(lines.determinant().expand()).primitive();
  EXPECT_EQ(jacobian.total_degree(), 3);
  const FactoredDeterminants exact = factored_determinants(geometry);
  EXPECT_TRUE(std::any_of(exact.determinant_factors.factors.begin(), exact.determinant_factors.factors.end(),
                          [&](const PolyFactor& factor) { return factor.poly == jacobian; }));
}

TEST(Spatial, GoughStewartLegsChangeFromTensionToCompressionOnCubics) {
  const auto derived = locus_problem(parsed(example_text("gough_stewart")), {});
  std::set<std::string> legs;
  int singularities = 0;
  for (const core::LocusFactor& factor : derived.problem.factors) {
    if (factor.role == core::FactorRole::direct_singularity) {
      ++singularities;
      EXPECT_EQ(core::total_degree(factor.implicit.at(0)), 3);
    }
    for (const core::Vanishing& v : factor.vanishing) {
      if (v.quantity != Quantity::F) continue;
      legs.insert(v.joint);
      for (const core::Polynomial& surface : factor.implicit) EXPECT_LE(core::total_degree(surface), 3);
    }
  }
  EXPECT_EQ(singularities, 1);
  EXPECT_EQ(legs, (std::set<std::string>{"S1", "S2", "S3", "S4", "S5", "S6"}));
}

TEST(Spatial, ThreeUpuHas42Unknowns) { EXPECT_EQ(mechanism::unknowns(parsed(example_text("three_upu"))).size(), 42u); }

}  // namespace
}  // namespace clearloci::symbolic
