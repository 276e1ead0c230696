// Spatial mechanisms: exact equations against the numeric route, which resolves reactions along other vectors, and the
// direct singularity of the Gough-Stewart platform against the Plücker lines of its legs.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <set>

#include "mechanism/read.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/locus_problem.hpp"
#include "tests/numeric/solved.hpp"
#include "tests/texts.hpp"

namespace clearloci::symbolic {
namespace {

using core::Quantity;
using mechanism::Mechanism;

Mechanism parsed(const std::string& text) { return mechanism::parse_mechanism(text, "spatial.yaml"); }

double evaluated(const Poly& p, const std::vector<double>& at) {
  return core::evaluate(p.plain(), std::span<const double>(at));
}

double evaluated(const FactoredPoly& product, const std::vector<double>& at) {
  double value = core::to_double(product.constant);
  for (const PolyFactor& factor : product.factors) value *= std::pow(evaluated(factor.poly, at), factor.multiplicity);
  return value;
}

/// The coordinates and the places of constructed points, as the numeric route finds them.
std::vector<double> ring_values(const Geometry& geometry, const std::vector<double>& pose,
                                const test::Solved& witness) {
  std::vector<double> values(static_cast<std::size_t>(geometry.ring().size()), 0.0);
  std::copy(pose.begin(), pose.end(), values.begin());
  for (const ConstructedPoint& point : geometry.constructed()) {
    const Eigen::Vector3d& place = witness.points[static_cast<std::size_t>(point.point)];
    values[static_cast<std::size_t>(point.x)] = place.x();
    values[static_cast<std::size_t>(point.y)] = place.y();
    values[static_cast<std::size_t>(point.z)] = place.z();
  }
  return values;
}

/// Every reaction, in Cartesian components with the actuator's share, from the exact numerators.
void hold(const Mechanism& m) {
  const Geometry geometry(m, false);
  const FactoredDeterminants exact = factored_determinants(geometry);
  std::mt19937 random(4);
  int held = 0;
  for (int sample = 0; sample < 50 && held < 5; ++sample) {
    std::vector<double> pose;
    for (const auto& c : m.coordinates)
      pose.push_back(
          std::uniform_real_distribution<double>(core::to_double(c.lower), core::to_double(c.upper))(random));
    const test::Solved witness = test::solved(m, pose);
    if (witness.unreachable) continue;
    ++held;
    EXPECT_LT(witness.residual, 1e-12);
    const std::vector<double> at = ring_values(geometry, pose, witness);
    const double determinant = evaluated(exact.determinant, at);
    double largest = 0;
    for (const auto& r : witness.reactions) largest = std::max({largest, r.force.norm(), std::abs(r.actuator)});
    const double tolerance = 1e-13 * witness.condition * (1 + largest);
    for (std::size_t k = 0; k < exact.numerators.size(); ++k) {
      const mechanism::Unknown& unknown = exact.equations.unknowns[k];
      const auto& joint = m.joints[static_cast<std::size_t>(unknown.joint)];
      const numeric::JointReaction& r = witness.reactions[static_cast<std::size_t>(unknown.joint)];
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
  EXPECT_EQ(held, 5);
}

TEST(Spatial, GoughStewartAgreesWithTheNumericRoute) { hold(parsed(example_text("gough_stewart"))); }

TEST(Spatial, ThreeUpuAgreesWithTheNumericRoute) { hold(parsed(example_text("three_upu"))); }

TEST(Spatial, ThreeRuuAgreesWithTheNumericRoute) { hold(parsed(example_text("three_ruu"))); }

/// The same with carriages on rails in the place of cranks.
TEST(Spatial, ThreePuuAgreesWithTheNumericRoute) {
  std::string text = example_text("three_ruu");
  for (const std::string k : {"1", "2", "3"}) {
    const std::string axis = k == "1" ? "[0, 1, 0]" : k == "2" ? "[-s, -1/2, 0]" : "[s, -1/2, 0]";
    text =
        replaced(text, "{dyad: [A" + k + ", C" + k + "], lengths: [crank, forearm], axis: " + axis + ", side: right}",
                 "{slider: [A" + k + ", [1/10, 0, 1]], from: C" + k + ", length: forearm, side: ahead}");
    text = replaced(text, "points: [A" + k + ", B" + k + "]", "points: [B" + k + "]");
    text = replaced(text, "{revolute: [ground, crank" + k + "], at: A" + k + ", axis: " + axis,
                    "{prismatic: [ground, crank" + k + "], at: B" + k + ", axis: [1/10, 0, 1]");
    text = replaced(text, "radial: 10e-6, angular: 0.1e-3", "axial: 5e-6");
  }
  hold(parsed(text));
}

/// A forearm between universal joints whose outer axes stay parallel bears a force along it alone: A_i carries none
/// where the load lies in the plane of the other two forearms. The platform is free where all three lie in a plane, or
/// where the couples across them do; a forearm turns about itself where it lies along the outer axes.
TEST(Spatial, ThreeRuuLegsAreUnloadedWhereTheOtherTwoSpanTheLoad) {
  const Mechanism m = parsed(example_text("three_ruu"));
  const Geometry geometry(m, false);
  const FactoredDeterminants exact = factored_determinants(geometry);
  const Eigen::Vector3d load(30, 10, -100);
  std::mt19937 random(5);
  std::vector<double> singular, unloaded;  // ratios that are to be the same in every pose
  for (int sample = 0; sample < 20; ++sample) {
    std::vector<double> pose;
    for (const auto& c : m.coordinates)
      pose.push_back(
          std::uniform_real_distribution<double>(core::to_double(c.lower), core::to_double(c.upper))(random));
    const double s = std::sqrt(3) / 2, R = 0.2, r = 0.05, crank = 0.25, forearm = 0.6;
    const std::array<std::array<double, 2>, 3> turn = {{{1, 0}, {-0.5, s}, {-0.5, -s}}};
    Eigen::Matrix3d arms, couples;
    test::Solved places;
    places.points.assign(m.points.size(), Eigen::Vector3d::Zero());
    bool reached = true;
    for (int leg = 0; leg < 3; ++leg) {
      // In the leg's own plane, w outward and z up: the crank's angle from a half-angle formula.
      const auto [cosine, sine] = turn[static_cast<std::size_t>(leg)];
      const Eigen::Vector3d outward(cosine, sine, 0), along(-sine, cosine, 0);
      const Eigen::Vector3d c(pose[0] + r * cosine, pose[1] + r * sine, pose[2]);
      const double w = c.dot(outward) - R, v = c.dot(along), z = c.z();
      const double e = (w * w + v * v + z * z + crank * crank - forearm * forearm) / (2 * crank);
      const double root = w * w + z * z - e * e;
      reached = reached && root > 0;
      if (!reached) break;
      const double angle = 2 * std::atan2(z + std::sqrt(root), e + w);  // w cos + z sin = e
      const Eigen::Vector3d elbow =
          (R + crank * std::cos(angle)) * outward + crank * std::sin(angle) * Eigen::Vector3d::UnitZ();
      arms.col(leg) = c - elbow;
      couples.col(leg) = along.cross(along.cross(arms.col(leg)));
      for (std::size_t i = 0; i < m.points.size(); ++i)
        if (m.points[i].name == "B" + std::to_string(leg + 1)) places.points[i] = elbow;
    }
    if (!reached) continue;
    const std::vector<double> at = ring_values(geometry, pose, places);
    double folded = 1;  // a forearm along the axes of its universal joints
    for (int leg = 0; leg < 3; ++leg) folded *= couples.col(leg).dot(arms.col(leg));
    singular.push_back(evaluated(exact.determinant, at) / (arms.determinant() * couples.determinant() * folded));
    for (std::size_t k = 0; k < exact.numerators.size(); ++k) {
      if (exact.equations.unknown_names[k] != "fA1x") continue;
      const double fraction = evaluated(exact.numerators[k], at) / evaluated(exact.determinant, at);
      Eigen::Matrix3d others = arms;
      others.col(0) = -load;
      unloaded.push_back(fraction / (-others.determinant() / arms.determinant() * arms(0, 0)));
    }
  }
  ASSERT_GT(singular.size(), 5u);
  for (const double ratio : singular) EXPECT_NEAR(ratio / singular.front(), 1, 1e-6);
  for (const double ratio : unloaded) EXPECT_NEAR(std::abs(ratio), 1, 1e-6);
}

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
    for (const PolyFactor& factor : factored_determinants(geometry).determinant.factors)
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
  EXPECT_TRUE(std::any_of(exact.determinant.factors.begin(), exact.determinant.factors.end(),
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

/// What each leg can bear, a force along its forearm and a couple, is told by its own equations: what is left are three
/// forces, and then three couples. Taken as one there were products of 100 000 terms.
TEST(Spatial, ForcesOfThreeRuuAreSolvedBeforeItsCouples) {
  const Mechanism m = parsed(example_text("three_ruu_slice"));
  EXPECT_TRUE(factored_determinants_within(8000, Geometry(m, false)));
}

TEST(Spatial, ThreeUpuHas42Unknowns) { EXPECT_EQ(mechanism::unknowns(parsed(example_text("three_upu"))).size(), 42u); }

}  // namespace
}  // namespace clearloci::symbolic
