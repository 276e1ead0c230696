// Newton-Euler equations, LU reactions and the batched route against each other and against the paper.
#include "numeric/reactions.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/numeric/designs.hpp"
#include "tests/numeric/random_five_bar.hpp"

namespace clearloci::numeric {
namespace {

using test::between;
using test::five_bar;
using test::FiveBar;
using test::random_five_bar;
using test::Side;

const std::vector<int> paper_mode = {-1, 1};  // B1 right, B2 left

/// Matrix (13) of the paper, copied entry by entry.
Eigen::MatrixXd paper_matrix(const Posture& posture) {
  const auto& [A1, A2, P, B1, B2] =
      std::tie(posture.points[0], posture.points[1], posture.points[2], posture.points[3], posture.points[4]);
  const double yA1 = A1[1] - P[1], xA1 = A1[0] - P[0], yB1 = B1[1] - P[1], xB1 = B1[0] - P[0];
  const double yB2 = B2[1] - P[1], xB2 = B2[0] - P[0], yA2 = A2[1] - P[1], xA2 = A2[0] - P[0];
  Eigen::MatrixXd A(12, 12);
  A << 1, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0,          //
      0, 1, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0,           //
      -yA1, xA1, yB1, -xB1, 0, 0, 0, 0, 0, 0, 1, 0,  //
      0, 0, 1, 0, -1, 0, 0, 0, 0, 0, 0, 0,           //
      0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0, 0,           //
      0, 0, -yB1, xB1, 0, 0, 0, 0, 0, 0, 0, 0,       //
      0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0,            //
      0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0,            //
      0, 0, 0, 0, 0, 0, -yB2, xB2, 0, 0, 0, 0,       //
      0, 0, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0,           //
      0, 0, 0, 0, 0, 0, 0, -1, 0, 1, 0, 0,           //
      0, 0, 0, 0, 0, 0, yB2, -xB2, -yA2, xA2, 0, 1;
  return A;
}

TEST(Posture, PlacesTheDyadsOfTheExample) {
  const NumericModel model = compile(five_bar());
  const auto p = posture(model, std::array{0.25, -0.7}, paper_mode);
  ASSERT_TRUE(p.reachable());
  const auto distance = [&](int i, int j) {
    const auto &a = p.points[static_cast<std::size_t>(i)], &b = p.points[static_cast<std::size_t>(j)];
    return std::hypot(a[0] - b[0], a[1] - b[1]);
  };
  EXPECT_NEAR(distance(0, 3), 0.5, 1e-15);  // A1 B1
  EXPECT_NEAR(distance(3, 2), 0.5, 1e-15);  // B1 P
  EXPECT_NEAR(distance(1, 4), 0.5, 1e-15);  // A2 B2
  EXPECT_NEAR(distance(4, 2), 0.5, 1e-15);  // B2 P
  // B1 to the right of A1 -> P: (P - A1) × (B1 - A1) < 0; B2 to the left of A2 -> P.
  EXPECT_LT(0.25 * p.points[3][1] + 0.7 * p.points[3][0], 0);
  EXPECT_GT((0.25 - 0.5) * p.points[4][1] + 0.7 * (p.points[4][0] - 0.5), 0);
}

TEST(Posture, NamesTheFirstPointOutOfReach) {
  const NumericModel model = compile(five_bar());
  const auto far_from_both = posture(model, std::array{5.0, 0.0}, paper_mode);
  ASSERT_TRUE(far_from_both.unreachable.has_value());
  EXPECT_EQ(model.mechanism.points[static_cast<std::size_t>(*far_from_both.unreachable)].name, "B1");
  const auto far_from_second = posture(model, std::array{-0.6, 0.0}, paper_mode);
  ASSERT_TRUE(far_from_second.unreachable.has_value());
  EXPECT_EQ(model.mechanism.points[static_cast<std::size_t>(*far_from_second.unreachable)].name, "B2");
}

TEST(Posture, BoundaryIsReachableAndACollapsedDyadIsNot) {
  const NumericModel model = compile(five_bar());
  EXPECT_TRUE(posture(model, std::array{-0.5, 0.0}, paper_mode).reachable());  // |A2 P| = a2 + b2
  EXPECT_FALSE(posture(model, std::array{0.0, 0.0}, paper_mode).reachable());  // P on A1
  EXPECT_EQ(std::size_t{5} + 4, model.points.size());
}

TEST(Posture, FollowsOffsetsMeansAndNestedDyads) {
  const NumericModel model = compile(test::driven_five_bar(1, 0, false));
  const auto p = posture(model, std::array{0.4, -1.0}, std::array{-1, 1, 1});
  ASSERT_TRUE(p.reachable());
  const auto point = [&](const std::string& name) {
    for (std::size_t i = 0; i < p.points.size(); ++i) {
      if (model.mechanism.points[i].name == name) return in_plane(p.points[i]);
    }
    throw std::out_of_range(name);
  };
  const Point2 A2 = point("A2"), B2 = point("B2"), Q = point("Q"), A3 = point("A3"), C = point("C"), E = point("E");
  const Point2 u = {(B2[0] - A2[0]) / 0.75, (B2[1] - A2[1]) / 0.75};
  EXPECT_NEAR(Q[0], A2[0] + 0.4 * u[0] + 0.15 * u[1], 1e-14);
  EXPECT_NEAR(Q[1], A2[1] + 0.4 * u[1] - 0.15 * u[0], 1e-14);
  EXPECT_NEAR(std::hypot(C[0] - A3[0], C[1] - A3[1]), 0.6, 1e-14);
  EXPECT_NEAR(std::hypot(C[0] - Q[0], C[1] - Q[1]), 0.9, 1e-14);
  EXPECT_GT((Q[0] - A3[0]) * (C[1] - A3[1]) - (Q[1] - A3[1]) * (C[0] - A3[0]), 0);
  EXPECT_NEAR(E[0], (0.4 + B2[0]) / 2, 1e-15);
}

TEST(Posture, AcceptsAngleCoordinatesAndParameters) {
  // One crank of length L turned by theta under a couple: M = -couple.
  using core::Expression;
  test::MechanismBuilder b;
  mechanism::Coordinate theta{"theta", true, test::number(0.0), test::number(6.0), 0, 6};
  b.coordinates({theta}).parameter("L", "0.3").point("O", 0, 0);
  b.point("P", test::product(test::symbol("L"), Expression::apply(Expression::Kind::cos, {test::symbol("theta")})),
          test::product(test::symbol("L"), Expression::apply(Expression::Kind::sin, {test::symbol("theta")})));
  b.link("crank", {"O", "P"}).joint("O", "ground", "crank", "O", true).end_effector("crank", "P");
  b.load("crank", "P", 0, -10, 2);
  const NumericModel model = compile(b.finish());
  const auto p = posture(model, std::array{0.7}, {});
  EXPECT_NEAR(p.points[1][0], 0.3 * std::cos(0.7), 1e-16);
  const auto r = solve_reactions(model, p);
  EXPECT_NEAR(r.values(0), 0, 1e-14);
  EXPECT_NEAR(r.values(1), 10, 1e-13);
  EXPECT_NEAR(r.values(2), -2 + 10 * 0.3 * std::cos(0.7), 1e-13);
}

TEST(NewtonEulerMatrix, IsEquation13OfThePaper) {
  const NumericModel model = compile(five_bar());
  for (const auto& pose : {std::array{0.25, -0.7}, std::array{0.1, 0.4}, std::array{0.6, -0.3}}) {
    const auto p = posture(model, pose, paper_mode);
    ASSERT_TRUE(p.reachable());
    EXPECT_EQ(newton_euler_matrix(model, p), paper_matrix(p));
  }
}

TEST(LoadColumn, HoldsForceCoupleAndWeights) {
  FiveBar design;
  design.fx = 3, design.fy = -7, design.couple = 2;
  design.weighs = true;
  design.mass = 2;
  const NumericModel model = compile(five_bar(design));
  const auto p = posture(model, std::array{0.25, -0.7}, paper_mode);
  const Eigen::VectorXd w = load_column(model, p);
  EXPECT_NEAR(w(1), 2 * 9.81, 1e-13);  // link A1B1 hangs on nothing but its joints
  EXPECT_NEAR(w(2), (p.points[3][0] / 2 - 0.25) * 2 * 9.81, 1e-13);
  EXPECT_NEAR(w(6), -3, 1e-15);  // PB2: the force at P has no moment about P, the weight has
  EXPECT_NEAR(w(7), 7 + 2 * 9.81, 1e-13);
  EXPECT_NEAR(w(8), -2 + (p.points[4][0] - 0.25) / 2 * 2 * 9.81, 1e-13);
}

TEST(Reactions, LegOneIsUnloadedWhereTheLinkIsParallelToTheForce) {
  // tests/reference/reference-cases.md: F = (3, 4)/5, lengths 6/5 and 1, A = (±1/2, 0): leg 1 unloaded on the circles
  // of radius L_B2A2 about A2 ± L_PB2 F/|F|.
  FiveBar design{.a1 = 1.2, .b1 = 1, .a2 = 1.2, .b2 = 1, .fx = 3, .fy = 4};
  design.base_x = 1;  // the same mechanism moved by 1/2 along x
  const NumericModel model = compile(five_bar(design));
  int seen = 0;
  for (int k = 0; k < 60; ++k) {
    const double angle = 0.1 + k * 0.1;
    const std::array pose = {1 + 0.6 + 1.2 * std::cos(angle), 0.8 + 1.2 * std::sin(angle)};
    for (const int sign : {-1, 1}) {
      const auto p = posture(model, pose, std::array{-1, sign});
      if (!p.reachable()) continue;
      // PB2 is parallel to F in one of the two assemblies of leg 2.
      const Point2 link = {p.points[4][0] - pose[0], p.points[4][1] - pose[1]};
      if (std::abs(link[0] * 4 - link[1] * 3) > 1e-9) continue;
      ++seen;
      const auto r = solve_reactions(model, p);
      const double scale = 1e-12 * (1 + r.values.cwiseAbs().maxCoeff());
      for (const int k_unloaded : {0, 1, 2, 3, 4, 5, 10}) EXPECT_NEAR(r.values(k_unloaded), 0, scale);
      const double x = pose[0] - 0.5, y = pose[1];  // their published equation
      EXPECT_NEAR(100 * x * x + 100 * y * y - 220 * x - 160 * y + 41, 0, 1e-10);
    }
  }
  EXPECT_GT(seen, 20);
}

struct Sample {
  NumericModel model;
  std::vector<double> pose;
  std::vector<int> mode;
};

mechanism::Mechanism random_mechanism() {
  switch (*rc::gen::element(0, 1, 2)) {
    case 0:
      return five_bar(random_five_bar());
    case 1:
      return test::three_rrr(between(-1, 1), between(-9, 9), between(-9, 9), between(-1, 1),
                             *rc::gen::arbitrary<bool>());
    default:
      return test::driven_five_bar(between(-9, 9), between(-9, 9), *rc::gen::arbitrary<bool>());
  }
}

Sample random_sample() {
  Sample s{compile(random_mechanism()), {}, {}};
  for (std::size_t i = 0; i < s.model.dyads.size(); ++i) s.mode.push_back(*rc::gen::element(-1, 1));
  // Mostly reachable poses, but not only.
  for (int attempt = 0; attempt < 20; ++attempt) {
    s.pose = {between(-1, 1.3), between(-1.3, 1.3)};
    if (posture(s.model, s.pose, s.mode).reachable()) break;
  }
  return s;
}

RC_GTEST_PROP(Reactions, BalanceAndAgreeByBothRoutes, ()) {
  const Sample s = random_sample();
  const auto p = posture(s.model, s.pose, s.mode);
  ReactionField field;
  reaction_field(s.model, s.pose, s.mode, field);
  RC_ASSERT(field.reachable(0) == p.reachable());
  RC_PRE(p.reachable());
  const auto lu = solve_reactions(s.model, p);
  const auto bounded = bounded_numerators(s.model, s.pose, s.mode);
  RC_ASSERT(lu.residual < 1e-14);
  RC_ASSERT(bounded.reachable);

  const Eigen::MatrixXd A = newton_euler_matrix(s.model, p);
  const double determinant = A.determinant();
  RC_ASSERT(std::abs(field.determinants[0] - determinant) <= 1e-12 * (1 + std::abs(determinant)));
  RC_ASSERT(std::abs(field.determinants[0] - bounded.determinant.value) <= 2 * bounded.determinant.error);
  for (int k = 0; k < field.unknowns; ++k) {
    // |A_J^k|, by its definition (paper (28)).
    Eigen::MatrixXd replaced = A;
    replaced.col(k) = load_column(s.model, p);
    const double cramer = replaced.determinant();
    const auto& b = bounded.values[static_cast<std::size_t>(k)];
    RC_ASSERT(std::abs(field.numerator(k)[0] - cramer) <= 1e-11 * (1 + std::abs(cramer)));
    RC_ASSERT(std::abs(field.numerator(k)[0] - b.value) <= 2 * b.error);
    RC_ASSERT(b.error <= 1e-10 * (1 + lu.values.cwiseAbs().maxCoeff() * std::abs(determinant)));
    if (lu.condition < 1e8) {
      RC_ASSERT(std::abs(field.reaction(k, 0) - lu.values(k)) <=
                1e-15 * lu.condition * (1 + lu.values.cwiseAbs().maxCoeff()));
    }
  }
}

/// Rotating and scaling a 5R with its load: forces turn along, couples scale with the lengths.
RC_GTEST_PROP(Reactions, FollowRotationAndScaling, ()) {
  FiveBar d = random_five_bar();
  d.weighs = false;
  const double angle = between(-3, 3), scale = between(0.5, 3);
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](double x, double y) { return Point2{c * x - s * y, s * x + c * y}; };
  FiveBar e = d;
  const Point2 base = turned(scale * d.base_x, scale * d.base_y), force = turned(d.fx, d.fy);
  e.base_x = base[0], e.base_y = base[1], e.fx = force[0], e.fy = force[1], e.couple = d.couple * scale;
  e.a1 *= scale, e.b1 *= scale, e.a2 *= scale, e.b2 *= scale;
  const Point2 pose = {between(0, d.base_x), between(-0.8, 0.8)};
  const Point2 moved = turned(scale * pose[0], scale * pose[1]);
  const NumericModel first = compile(five_bar(d)), second = compile(five_bar(e));
  const auto mode = mechanism::working_mode(first.mechanism);
  const auto p = posture(first, pose, mode), q = posture(second, moved, mode);
  RC_PRE(p.reachable() && q.reachable());
  const auto r = solve_reactions(first, p), t = solve_reactions(second, q);
  RC_PRE(r.condition < 1e5);
  const double tolerance = 1e-8 * (1 + r.values.cwiseAbs().maxCoeff());
  for (int joint = 0; joint < 5; ++joint) {
    const Point2 expected = turned(r.values(2 * joint), r.values(2 * joint + 1));
    RC_ASSERT(std::abs(t.values(2 * joint) - expected[0]) < tolerance);
    RC_ASSERT(std::abs(t.values(2 * joint + 1) - expected[1]) < tolerance);
  }
  for (const int couple : {10, 11})
    RC_ASSERT(std::abs(t.values(couple) - scale * r.values(couple)) < scale * tolerance);
}

TEST(Reactions, SwappingFromAndToNegatesAReaction) {
  auto m = five_bar({.weighs = true});
  const NumericModel model = compile(m);
  std::swap(m.joints[2].from, m.joints[2].to);
  const NumericModel swapped = compile(m);
  const std::array pose = {0.25, -0.7};
  const auto r = solve_reactions(model, posture(model, pose, paper_mode));
  const auto t = solve_reactions(swapped, posture(swapped, pose, paper_mode));
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(t.values(k), k == 4 || k == 5 ? -r.values(k) : r.values(k), 1e-11);
}

TEST(Reactions, OrderOfLinksDoesNotMatter) {
  auto m = five_bar({.fx = 20, .couple = 1, .weighs = true});
  const NumericModel model = compile(m);
  std::swap(m.links[0], m.links[2]);
  const auto renamed = [](int link) { return link == 0 ? 2 : link == 2 ? 0 : link; };
  for (auto& joint : m.joints) joint.from = renamed(joint.from), joint.to = renamed(joint.to);
  for (auto& load : m.loads) load.link = renamed(load.link);
  m.end_effector_link = renamed(m.end_effector_link);
  const NumericModel other = compile(m);
  const std::array pose = {0.25, -0.7};
  const auto r = solve_reactions(model, posture(model, pose, paper_mode));
  const auto t = solve_reactions(other, posture(other, pose, paper_mode));
  EXPECT_LT((r.values - t.values).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(Reactions, NumeratorsStayFiniteThroughADirectSingularity) {
  // The example is singular where B1, P, B2 are aligned; along x = 1/4 the symmetric mode meets it between these poses.
  const NumericModel model = compile(five_bar());
  double low = -0.8, high = -0.1;
  const auto determinant = [&](double y) {
    ReactionField f;
    reaction_field(model, std::array{0.25, y}, std::array{-1, 1}, f);
    return f.determinants[0];
  };
  ASSERT_LT(determinant(low) * determinant(high), 0);
  while (high - low > 1e-15) {
    const double middle = (low + high) / 2;
    (determinant(low) * determinant(middle) <= 0 ? high : low) = middle;
  }
  ReactionField f;
  reaction_field(model, std::array{0.25, low}, std::array{-1, 1}, f);
  EXPECT_NEAR(f.determinants[0], 0, 1e-14);
  EXPECT_GT(std::abs(f.numerator(0)[0]), 1);
}

TEST(Compile, RefusesAMechanismThatIsNotSquare) {
  auto m = five_bar();
  m.joints[0].actuated = false;
  EXPECT_THROW(compile(m), core::InputError);
}

TEST(KernelVector, HoldsForAnyRank) {
  // Rank two of three rows: every numerator and the determinant vanish.
  std::vector<double> g = {1, 2, 3, 4, 2, 4, 6, 8, 0, 1, 1, 1};
  std::vector<double> kernel(4, 7.0);
  kernel_vector<double>(3, g.data(), kernel.data());
  EXPECT_EQ(kernel, std::vector<double>(4, 0.0));
  // No core at all: |M| = 1.
  kernel_vector<double>(0, g.data(), kernel.data());
  EXPECT_EQ(kernel[0], -1.0);
}

TEST(KernelVector, BoundsErrorsOfAnyRank) {
  // |M| = 1e-17 +- 1e-15, and the column of the loads is pivoted: neither is known from the quotient of the two.
  const Bounded tiny(1e-17, 1e-15);
  std::vector<Bounded> g = {2.0, 1.0, 9.0, 2.0, Bounded(1.0) + tiny, 9.0};
  std::vector<Bounded> kernel(3);
  kernel_vector<Bounded>(2, g.data(), kernel.data());
  for (const Bounded& one : kernel) EXPECT_LT(one.error, 1e-13);
  EXPECT_LE(std::abs(kernel[2].value), kernel[2].error);
  // Of rank one as far as values tell: a determinant that may be 1e-3 * 1e-3 is not told to be zero.
  const Bounded doubtful(0.0, 1e-3);
  g = {1.0, 2.0, 3.0, 1.0, 0.0, doubtful, doubtful, 0.0, 0.0, doubtful, doubtful, 0.0};
  kernel.resize(4);
  kernel_vector<Bounded>(3, g.data(), kernel.data());
  EXPECT_GE(kernel[3].error, 1e-6);
  EXPECT_LT(kernel[3].error, 1e-4);
}

RC_GTEST_PROP(KernelVector, IsCramersRule, ()) {
  const int n = *rc::gen::inRange(1, 6);
  Eigen::MatrixXd g(n, n + 1);
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c <= n; ++c) g(r, c) = *rc::gen::inRange(-3, 4);  // small integers: often singular
  }
  std::vector<double> flat, kernel(static_cast<std::size_t>(n + 1));
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c <= n; ++c) flat.push_back(g(r, c));
  }
  kernel_vector<double>(n, flat.data(), kernel.data());
  for (int k = 0; k < n; ++k) {
    Eigen::MatrixXd replaced = g.leftCols(n);
    replaced.col(k) = g.col(n);
    RC_ASSERT(std::abs(kernel[static_cast<std::size_t>(k)] - replaced.determinant()) < 1e-9);
  }
  RC_ASSERT(std::abs(kernel[static_cast<std::size_t>(n)] + g.leftCols(n).determinant()) < 1e-9);
}

}  // namespace
}  // namespace clearloci::numeric
