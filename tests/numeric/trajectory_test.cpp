// Laws of motion, paths, exact derivatives, dynamics and contact losses along trajectories.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "mechanism/read.hpp"
#include "mechanism/trajectory.hpp"
#include "numeric/period_sweep.hpp"
#include "tests/numeric/designs.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::numeric {
namespace {

double between(double low, double high) {
  return low + (high - low) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 100000)) / 100000;
}

std::string fixed(double value) { return std::to_string(value); }

RC_GTEST_PROP(Taylor, HoldsTheDerivatives, ()) {
  // sqrt(2 + sin(t)) cos(t) / (3 + t²) by central differences of the value, the first and the second derivative.
  const auto f = [](double t) {
    Series s(t);
    s.c[1] = 1;
    return sqrt(Series(2.0) + sin(s)) * cos(s) / (Series(3.0) + s * s);
  };
  const double t = between(-2, 2), h = 1e-4;
  const Series here = f(t), before = f(t - h), after = f(t + h);
  for (std::size_t k = 0; k < 3; ++k) {
    const double rate = (after.c[k] - before.c[k]) / (2 * h);
    RC_ASSERT(std::abs(rate - static_cast<double>(k + 1) * here.c[k + 1]) < 1e-7);
  }
}

class Laws : public testing::TestWithParam<mechanism::MotionLaw> {};

TEST_P(Laws, GoFromRestToRest) {
  const CompiledLaw law = compile(GetParam());
  const auto at = [&](std::size_t piece, double sigma) {
    Series s(sigma);
    s.c[1] = 1;
    return covered(law, piece, s);
  };
  const std::size_t last = law.pieces.size() - 1;
  EXPECT_NEAR(at(0, 0).c[0], 0, 1e-15);
  EXPECT_NEAR(at(0, 0).c[1], 0, 1e-15);
  EXPECT_NEAR(at(last, 1).c[0], 1, 1e-14);
  EXPECT_NEAR(at(last, 1).c[1], 0, 1e-13);
  for (std::size_t k = 0; k < last; ++k) {  // place and velocity are continuous
    EXPECT_NEAR(at(k, law.pieces[k].end).c[0], at(k + 1, law.pieces[k].end).c[0], 1e-14);
    EXPECT_NEAR(at(k, law.pieces[k].end).c[1], at(k + 1, law.pieces[k].end).c[1], 1e-13);
    if (law.kind == mechanism::LawKind::s_curve) {
      EXPECT_NEAR(at(k, law.pieces[k].end).c[2], at(k + 1, law.pieces[k].end).c[2], 1e-12);
    }
  }
  for (const double s : {0.0, 0.1, 0.5, 0.77, 1.0}) {
    const double sigma = time_of(law, s);
    std::size_t piece = 0;
    while (piece < last && law.pieces[piece].end < sigma) ++piece;
    EXPECT_NEAR(at(piece, sigma).c[0], s, 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Laws,
    testing::Values(mechanism::MotionLaw{mechanism::LawKind::cycloidal},
                    mechanism::MotionLaw{mechanism::LawKind::polynomial_345},
                    mechanism::MotionLaw{mechanism::LawKind::trapezoidal, core::Rational(1, 4)},
                    mechanism::MotionLaw{mechanism::LawKind::trapezoidal, core::Rational(1, 2)},
                    mechanism::MotionLaw{mechanism::LawKind::s_curve, core::Rational(2, 5), core::Rational(1, 3)},
                    mechanism::MotionLaw{mechanism::LawKind::s_curve, core::Rational(1, 2), core::Rational(1, 2)}));

mechanism::Trajectory trajectory(const mechanism::Mechanism& m, const std::string& path, const std::string& rest = "") {
  return mechanism::parse_trajectory(
      "format: 1\npath: " + path + "\n" + (rest.empty() ? "motion: cycloidal\nperiod: 1\n" : rest), "path.yaml", m);
}

TEST(Path, RoundsCornersByArcsOfTheirRadius) {
  const auto m = test::five_bar();
  const CompiledPath path = compile(trajectory(m, "{waypoints: [[0, 0], {at: [3, 0], corner: 1}, [3, 4]]}"));
  ASSERT_EQ(path.pieces.size(), 3u);
  EXPECT_NEAR(path.length(), 2 + std::numbers::pi / 2 + 3, 1e-14);
  for (double s = 0.05; s < path.length(); s += 0.1) {
    std::size_t piece = 0;
    while (piece + 1 < path.pieces.size() && path.pieces[piece + 1].start <= s) ++piece;
    Series length(s);
    length.c[1] = 1;
    const auto p = place_at(path, piece, length);
    EXPECT_NEAR(std::hypot(p[0].c[1], p[1].c[1]), 1, 1e-14);  // by its length
    if (piece == 1) {
      EXPECT_NEAR(std::hypot(p[0].c[0] - 2, p[1].c[0] - 1), 1, 1e-14);
      EXPECT_NEAR(std::hypot(2 * p[0].c[2], 2 * p[1].c[2]), 1, 1e-14);  // curvature
    }
  }
}

TEST(Path, SmoothCurvesPassThroughTheirPointsByTheirLength) {
  const auto m = test::five_bar();
  const CompiledPath path =
      compile(trajectory(m, "{points: [[0, 0], [1, 0.5], [1.5, -0.5], {at: [3, 0], stop: true}, [3, 2], [2, 2]]}"));
  ASSERT_EQ(path.pieces.size(), 5u);
  EXPECT_EQ(path.stops.size(), 3u);
  double s = 0;
  for (std::size_t piece = 0; piece < path.pieces.size(); ++piece) {
    for (const double part : {0.0, 0.3, 0.999}) {
      Series length(s + part * path.pieces[piece].length);
      length.c[1] = 1;
      const auto p = place_at(path, piece, length);
      EXPECT_NEAR(std::hypot(p[0].c[1], p[1].c[1]), 1, 1e-12);
      EXPECT_NEAR(p[0].c[1] * p[0].c[2] + p[1].c[1] * p[1].c[2], 0, 1e-10);  // no acceleration along the curve
    }
    s += path.pieces[piece].length;
    if (piece == 2 || piece == 4) continue;  // a stop
    const auto before = place_at(path, piece, [&] {
      Series l(s);
      l.c[1] = 1;
      return l;
    }());
    const auto after = place_at(path, piece + 1, [&] {
      Series l(s);
      l.c[1] = 1;
      return l;
    }());
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(before[c].c[k], after[c].c[k], 1e-10);
  }
  const auto third = place_at(path, 1, Series(path.pieces[1].start + path.pieces[1].length));
  EXPECT_NEAR(third[0].value(), 1.5, 1e-12);
  EXPECT_NEAR(third[1].value(), -0.5, 1e-12);
}

TEST(Path, RefusesCornersThatDoNotFit) {
  const auto m = test::five_bar();
  EXPECT_THROW(compile(trajectory(m, "{waypoints: [[0, 0], [1, 0], [1, 1]]}")), core::InputError);
  EXPECT_THROW(compile(trajectory(m, "{waypoints: [[0, 0], {at: [1, 0], corner: 1.1}, [1, 1]]}")), core::InputError);
  EXPECT_THROW(compile(trajectory(m, "{waypoints: [[0, 0], {at: [1, 0], corner: 0.1}, [0, 0]]}")), core::InputError);
  EXPECT_NO_THROW(compile(trajectory(m, "{waypoints: [[0, 0], [0.5, 0], {at: [1, 0], corner: 0.5}, [1, 1]]}")));
}

const std::string laws[] = {"cycloidal", "3-4-5", "trapezoidal", "{law: s-curve, accelerating: 2/5}"};

struct Case {
  mechanism::Mechanism mechanism;
  mechanism::Trajectory path;
};

/// Random mechanisms on random paths with a payload.
Case random_case() {
  const int kind = *rc::gen::element(0, 1, 2);
  mechanism::Mechanism m;
  std::string link = "PB2", at = "P";
  double x = 0.1, y = -0.7;
  if (kind == 0) {
    m = test::five_bar(
        {.a1 = between(0.45, 0.6), .b2 = between(0.5, 0.6), .fx = between(-20, 20), .mass = 1.5, .weighs = true});
  } else if (kind == 1) {
    m = test::three_rrr(between(-0.3, 0.3), 2, -3, 0.2, true);
    link = "platform", x = -0.15, y = -0.1;
  } else {
    m = test::driven_five_bar(3, -5, true);
    at = "E", x = 0.2, y = -1.0;
  }
  m = test::with_clearances(m, 1e-3, 1e-3);
  const double w = between(0.1, 0.3), h = between(0.05, 0.15), r = between(0.01, 0.04);
  const auto point = [](double px, double py) { return "[" + fixed(px) + ", " + fixed(py) + "]"; };
  const std::string path = "{closed: true, waypoints: [{name: a, at: " + point(x, y) +
                           ", dwell: 0.05}, {at: " + point(x, y + h) + ", corner: " + fixed(r) +
                           "}, {name: b, at: " + point(x + w, y + h) + ", stop: true}]}";
  const std::string rest = "motion: " + laws[*rc::gen::inRange(0, 4)] + "\nperiod: 1\npayload: [{link: " + link +
                           ", at: " + at + ", mass: " + fixed(between(0, 8)) +
                           ", inertia: 0.02, picked: a, placed: b}]\n";
  return {m, trajectory(m, path, rest)};
}

RC_GTEST_PROP(Dynamics, AccelerationsAreThoseOfTheClosure, ()) {
  const Case c = random_case();
  const Motion motion = compile_motion(c.mechanism, c.path, mechanism::working_mode(c.mechanism));
  const auto interval =
      static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(motion.timeline.intervals.size())));
  const Interval& stretch = motion.timeline.intervals[interval];
  const double tau = stretch.begin + between(0.2, 0.8) * (stretch.end - stretch.begin), h = 1e-5;
  const Instant here = instant(motion, interval, tau);
  RC_PRE(here.reachable && std::abs(here.determinant) > 1e-2);
  const Instant before = instant(motion, interval, tau - h), after = instant(motion, interval, tau + h);
  for (std::size_t p = 0; p < here.points.size(); ++p)
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const double rate = (after.points[p][i].c[k] - before.points[p][i].c[k]) / (2 * h);
        RC_ASSERT(std::abs(rate - static_cast<double>(k + 1) * here.points[p][i].c[k + 1]) <
                  1e-4 * (1 + std::abs(rate)));
      }
  // The reactions' own rates, which tell a jump of β from a fast turn.
  for (Eigen::Index k = 0; k < here.at_rest.size(); ++k) {
    const double rest = (after.at_rest(k) - before.at_rest(k)) / (2 * h);
    const double inertial = (after.inertial(k) - before.inertial(k)) / (2 * h);
    RC_ASSERT(std::abs(rest - here.at_rest_rate(k)) < 1e-5 * (1 + here.at_rest_rate.cwiseAbs().maxCoeff()));
    RC_ASSERT(std::abs(inertial - here.inertial_rate(k)) < 1e-5 * (1 + here.inertial_rate.cwiseAbs().maxCoeff()));
  }
}

/// The actuators' power is the rate of the kinetic energy less the power of weights and loads: nothing in it repeats
/// how the equations were put together.
RC_GTEST_PROP(Dynamics, ActuatorsDeliverThePowerThatTheMotionTakes, ()) {
  const Case c = random_case();
  const Motion motion = compile_motion(c.mechanism, c.path, mechanism::working_mode(c.mechanism));
  const auto interval =
      static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(motion.timeline.intervals.size())));
  const Interval& stretch = motion.timeline.intervals[interval];
  const Instant at = instant(motion, interval, stretch.begin + between(0.1, 0.9) * (stretch.end - stretch.begin));
  RC_PRE(at.reachable && std::abs(at.determinant) > 1e-2);
  const double period = between(0.5, 3);
  const auto& m = motion.model.mechanism;
  const auto series = [&](int p) { return at.points[static_cast<std::size_t>(p)]; };
  const auto turning = [&](int link) {  // angle's series but for its constant: ω, ω'
    const auto& points = m.links[static_cast<std::size_t>(link)].points;
    const PointSeries p = series(points[0]), q = series(points[1]);
    const auto rx = q[0] - p[0], ry = q[1] - p[1];
    const auto vx = rx.derivative(), vy = ry.derivative();
    return (rx.truncated<2>() * vy - ry.truncated<2>() * vx) /
           (rx.truncated<2>() * rx.truncated<2>() + ry.truncated<2>() * ry.truncated<2>());
  };
  double power = 0;  // by τ: W · period, with accelerations by time
  const double per_second2 = 1 / (period * period);
  const auto body = [&](int link, int centre, double mass, double inertia) {
    const PointSeries g = series(centre);
    const auto omega = turning(link);
    power += mass * per_second2 * (2 * g[0].c[2] * g[0].c[1] + 2 * g[1].c[2] * g[1].c[1]);
    power += inertia * per_second2 * omega.c[0] * omega.c[1];
    power += mass * 9.81 * g[1].c[1];
  };
  for (std::size_t i = 0; i < m.links.size(); ++i) {
    const auto& link = m.links[i];
    const PointSeries p = series(link.points[0]), q = series(link.points[1]);
    const double l = std::hypot(q[0].value() - p[0].value(), q[1].value() - p[1].value());
    body(static_cast<int>(i), link.centre_of_mass, motion.mass[i], motion.mass[i] * l * l / 12);
  }
  for (const int k : stretch.carried) {
    const auto& payload = c.path.payloads[static_cast<std::size_t>(k)];
    body(payload.link, payload.at, core::to_double(payload.mass), core::to_double(payload.inertia));
  }
  const auto p =
      posture(motion.model, std::vector<double>{at.coordinates[0].value(), at.coordinates[1].value()}, motion.mode);
  for (const auto& load : p.loads) {
    if (load.weight) continue;
    const PointSeries where = series(*m.loads[0].at);
    power -= load.force[0] * where[0].c[1] + load.force[1] * where[1].c[1] + load.couple[2] * turning(load.link).c[0];
  }
  const Eigen::VectorXd w = at.reactions(period);
  double delivered = 0;
  for (std::size_t k = 0; k < motion.model.unknowns.size(); ++k) {
    if (motion.model.unknowns[k].quantity != core::Quantity::M) continue;
    const auto& joint = m.joints[static_cast<std::size_t>(motion.model.unknowns[k].joint)];
    const double from = joint.from == mechanism::ground ? 0 : turning(joint.from).c[0];
    delivered += w(static_cast<Eigen::Index>(k)) * (turning(joint.to).c[0] - from);
  }
  RC_ASSERT(std::abs(delivered - power) <= 1e-9 * (1 + std::abs(power)));
}

/// At rest the dynamic analysis is the kinetostatic one, payload as a load; and slow cycles approach it as 1/T².
RC_GTEST_PROP(Dynamics, SlowCyclesApproachTheStaticLimit, ()) {
  Case c = random_case();
  const Motion motion = compile_motion(c.mechanism, c.path, mechanism::working_mode(c.mechanism));
  const auto interval =
      static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(motion.timeline.intervals.size())));
  const Interval& stretch = motion.timeline.intervals[interval];
  const Instant at = instant(motion, interval, (stretch.begin + stretch.end) / 2);
  RC_PRE(at.reachable && std::abs(at.determinant) > 1e-2);
  for (const int k : stretch.carried) {
    const auto& payload = c.path.payloads[static_cast<std::size_t>(k)];
    mechanism::Load weight;
    weight.link = payload.link, weight.at = payload.at;
    weight.force = {test::number(0.0), test::number(core::to_double(payload.mass) * -9.81)};
    c.mechanism.loads.push_back(weight);
  }
  const NumericModel model = compile(c.mechanism);
  const auto p = posture(model, std::vector<double>{at.coordinates[0].value(), at.coordinates[1].value()}, motion.mode);
  const Accuracy still = pose_accuracy(model, p);
  const double scale = still.reactions.values.cwiseAbs().maxCoeff();
  RC_ASSERT((still.reactions.values - at.at_rest).cwiseAbs().maxCoeff() <= 1e-10 * scale);
  const double first = (at.reactions(100) - still.reactions.values).norm();
  const double second = (at.reactions(200) - still.reactions.values).norm();
  RC_PRE(first > 1e-9 * scale);
  RC_ASSERT(std::abs(first / second - 4) < 1e-2);
  const PoseError slow = instant_error(motion, at, 1e5).error;
  RC_ASSERT(std::abs(slow.dp[0] - still.error.dp[0]) + std::abs(slow.dp[1] - still.error.dp[1]) <
            1e-6 * still.worst.distance);
}

RC_GTEST_PROP(ContactLosses, AreWhereTheReactionsVanish, ()) {
  const Case c = random_case();
  const Motion motion = compile_motion(c.mechanism, c.path, mechanism::working_mode(c.mechanism));
  std::vector<std::vector<Instant>> samples;
  try {
    samples = sample(motion, 150);
  } catch (const core::InputError&) {
    RC_DISCARD("out of the workspace");
  }
  const double period = between(0.3, 1.5);
  const LossThresholds thresholds = default_thresholds(motion, samples);
  const auto losses = contact_losses(motion, samples, period, thresholds);
  double last = 0;
  for (const ContactLoss& loss : losses) {
    RC_ASSERT(loss.time >= last);
    last = loss.time;
    if (loss.kind == LossKind::jump) continue;
    const auto reaction_in = [&](std::size_t interval, double tau, int column) {
      return instant(motion, interval, tau).reactions(period)(column);
    };
    const auto size_in = [&](std::size_t interval, double tau) {
      const JointColumns& columns = motion.columns[static_cast<std::size_t>(loss.joint)];
      return std::hypot(reaction_in(interval, tau, columns.fx), reaction_in(interval, tau, columns.fy));
    };
    std::size_t interval = 0;
    while (motion.timeline.intervals[interval].end < loss.tau) ++interval;
    // The acceleration may jump where one interval ends and the next begins: the least force may be that of the next.
    const bool begins_next =
        motion.timeline.intervals[interval].end - loss.tau < 1e-12 && interval + 1 < motion.timeline.intervals.size();
    if (loss.kind == LossKind::minimum && begins_next &&
        std::abs(size_in(interval, loss.tau) - loss.force) > std::abs(size_in(interval + 1, loss.tau) - loss.force))
      ++interval;
    const auto reaction = [&](double tau, int column) { return reaction_in(interval, tau, column); };
    const JointColumns& col = motion.columns[static_cast<std::size_t>(loss.joint)];
    if (loss.kind == LossKind::zero) {
      // The sign changes within 1e-9 s.
      const double h = 1e-9 / period;
      RC_ASSERT(reaction(loss.tau - h, col.couple) * reaction(loss.tau + h, col.couple) < 0);
    } else {
      const auto size = [&](double tau) { return size_in(interval, tau); };
      RC_ASSERT(std::abs(size(loss.tau) - loss.force) < 1e-9 * (1 + loss.force));
      RC_ASSERT(loss.force <= thresholds.force);
      RC_ASSERT(loss.from <= loss.time + 1e-12 && loss.to >= loss.time - 1e-12);
      RC_ASSERT(size((loss.from + loss.to) / 2 / period) <= thresholds.force * (1 + 1e-6));
    }
  }
  // Nothing is missed: dense sampling sees every change of sign of the couples.
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (motion.timeline.intervals[k].stage < 0) continue;
    for (std::size_t j = 0; j < motion.columns.size(); ++j) {
      const int couple = motion.columns[j].couple;
      if (couple < 0) continue;
      int changes = 0, found = 0;
      double before = 0;
      const Interval& stretch = motion.timeline.intervals[k];
      for (int i = 0; i <= 150; ++i) {
        const double tau = stretch.begin + i * (stretch.end - stretch.begin) / 150;
        const double now = instant(motion, k, tau).reactions(period)(couple);
        if (i > 0 && before * now < 0) ++changes;
        before = now;
      }
      for (const ContactLoss& loss : losses)
        if (loss.quantity == core::Quantity::M && loss.kind == LossKind::zero && loss.joint == static_cast<int>(j) &&
            loss.tau > stretch.begin && loss.tau < stretch.end)
          ++found;
      RC_ASSERT(found >= changes);
    }
  }
}

/// By bisection over the period: a stage has losses just below its critical period and none above.
RC_GTEST_PROP(CriticalPeriods, DivideLossFromNone, ()) {
  const Case c = random_case();
  const Motion motion = compile_motion(c.mechanism, c.path, mechanism::working_mode(c.mechanism));
  std::vector<std::vector<Instant>> samples;
  try {
    samples = sample(motion, 120);
  } catch (const core::InputError&) {
    RC_DISCARD("out of the workspace");
  }
  const LossThresholds thresholds = default_thresholds(motion, samples);
  const auto critical = critical_periods(motion, samples, thresholds);
  for (std::size_t k = 0; k < critical.size(); ++k) {
    if (critical[k].period == 0 || !std::isfinite(critical[k].period)) continue;
    const auto lost = [&](double period) {
      for (const ContactLoss& loss : contact_losses(motion, samples, period, thresholds))
        if (loss.stage == static_cast<int>(k) && !loss.payload) return true;
      return false;
    };
    // Regions of loss in distance and period may be thin: bisection starts close by.
    double low = critical[k].period * (1 - 1e-4), high = critical[k].period * 1.01;
    RC_ASSERT(lost(low));
    RC_ASSERT(!lost(high));
    for (int i = 0; i < 5; ++i) {
      const double middle = (low + high) / 2;
      (lost(middle) ? low : high) = middle;
    }
    RC_ASSERT(std::abs(low - critical[k].period) < 4e-4 * critical[k].period);
    RC_ASSERT(!lost(1.5 * critical[k].period));
  }
}

TEST(PeriodSweep, IsTheErrorAtEveryPeriod) {
  const auto m = test::with_clearances(test::five_bar({.fy = 0, .weighs = true}), 1e-2, 5e-3);
  const Motion motion = compile_motion(
      m, trajectory(m, "{closed: true, waypoints: [[0, -0.8], {at: [0.4, -0.7], stop: true}]}"), {-1, 1});
  const auto samples = sample(motion, 60);
  const PeriodSweep sweep = period_sweep(motion, samples, {0.5, 0.9, 2});
  std::size_t s = 0;
  for (const auto& instants : samples)
    for (const Instant& at : instants) {
      for (std::size_t p = 0; p < 3; ++p) {
        const PoseError e = instant_error(motion, at, sweep.periods[p]).error;
        EXPECT_NEAR(sweep.dx[sweep.index(p, s)], e.dp[0], 1e-14);
        EXPECT_NEAR(sweep.dy[sweep.index(p, s)], e.dp[1], 1e-14);
        EXPECT_NEAR(sweep.dalpha[sweep.index(p, s)], e.dalpha[2], 1e-14);
      }
      ++s;
    }
}

/// The findings of the paper's section 3 about its own example, as far as it says where the path lies.
TEST(PickAndPlace, LosesContactNearTheEndsOfTheStagesAtShortPeriodsOnly) {
  const std::string folder = source_dir() + "/examples/pick_and_place/";
  const auto m = mechanism::read_mechanism(folder + "manipulator.yaml");
  const Motion motion =
      compile_motion(m, mechanism::read_trajectory(folder + "path.yaml", m), mechanism::working_mode(m));
  const auto samples = sample(motion, 2000);
  const LossThresholds thresholds = default_thresholds(motion, samples);
  ASSERT_EQ(motion.timeline.stages.size(), 2u);
  EXPECT_EQ(motion.timeline.stages[0].carried.size(), 1u);
  EXPECT_TRUE(motion.timeline.stages[1].carried.empty());
  // "cycles which last more than 2.2 s avoid discontinuities", and those of the loaded stage go first.
  const auto critical = critical_periods(motion, samples, thresholds);
  EXPECT_LT(critical[0].period, critical[1].period);
  EXPECT_NEAR(critical[1].period, 2.2, 0.1);
  const double length = motion.timeline.stages[0].to;
  for (const ContactLoss& loss : contact_losses(motion, samples, 1.5, thresholds)) {
    const double into = loss.distance - (loss.stage == 1 ? length : 0);
    EXPECT_LT(std::min(into, length - into), 0.08 * length);
  }
  EXPECT_FALSE(contact_losses(motion, samples, 0.76, thresholds).empty());
  EXPECT_TRUE(contact_losses(motion, samples, 2.3, thresholds).empty());
}

/// Why a motion is refused; empty where it is followed.
std::string refusal(const std::string& mechanism, const std::string& law, int count) {
  const auto m = mechanism::parse_mechanism(mechanism, "m.yaml");
  const auto path = mechanism::parse_trajectory(
      "format: 1\nmotion: {law: expression, coordinate: '" + law + "'}\nperiod: 1\n", "t.yaml", m);
  try {
    const Motion motion = compile_motion(m, path, mechanism::working_mode(m));
    const auto samples = sample(motion, count);
    (void)contact_losses(motion, samples, 1, default_thresholds(motion, samples));
    return {};
  } catch (const core::InputError& error) {
    return error.problem();
  }
}

/// Half a turn off the rest of its torsion spring a crank passes a slit of 0.2 deg between two instants.
TEST(Samples, SkipNoLimitBetweenThem) {
  const std::string four_bar = R"(format: 1
workspace: {q: {angle: [-720 deg, 720 deg]}}
points: {A: [0, 0], D: [0.5, 0], B: [0.1*cos(q), 0.1*sin(q)], C: {dyad: [B, D], lengths: [0.45, 0.3], side: left}}
links: {AB: {points: [A, B]}, BC: {points: [B, C]}, CD: {points: [C, D], mass: 1}}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true}
  B: {revolute: [AB, BC], at: B, clearance: {radial: 1e-5}}
  C: {revolute: [BC, CD], at: C}
  D: {revolute: [ground, CD], at: D}
springs: [{joint: A, stiffness: 1, rest: 0}]
end_effector: {link: CD, at: C}
loads: [{link: CD, at: C, force: [0, -20]}]
)";
  for (const int count : {300, 500, 1500, 2000})
    EXPECT_THAT(refusal(four_bar, "4*pi*t + 0.304", count), testing::HasSubstr("torsion spring")) << count;
  EXPECT_EQ(refusal(four_bar, "1 + sin(2*pi*t)", 300), "");
}

/// The crank is stretched at x = 1: the path comes there between two instants, goes beyond, or keeps away.
TEST(Samples, SkipNoBoundaryBetweenThem) {
  const std::string slider_crank = R"(format: 1
workspace: {x: [0.5, 1.1]}
points: {A: [0, 0], P: [x, 0], B: {dyad: [A, P], lengths: [0.4, 0.6], side: left}}
links: {AB: {points: [A, B]}, BP: {points: [B, P], mass: 1}, block: {points: [P]}}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true}
  B: {revolute: [AB, BP], at: B, clearance: {radial: 1e-5}}
  P: {revolute: [BP, block], at: P}
  G: {prismatic: [ground, block], at: P, axis: [1, 0]}
end_effector: {link: block, at: P}
loads: [{link: block, at: P, force: [-20, -5]}]
)";
  EXPECT_NE(refusal(slider_crank, "1.00000001 - (t - 0.50013)^2", 1000), "");
  EXPECT_NE(refusal(slider_crank, "1 - (t - 0.50013)^2", 1000), "");
  EXPECT_EQ(refusal(slider_crank, "0.9999 - (t - 0.50013)^2", 1000), "");
  EXPECT_EQ(refusal(slider_crank, "0.9 + 0.05*sin(1/t)", 100), "coordinate x has no value 0 s after the start");
  EXPECT_EQ(refusal(slider_crank, "0.9 + 0.05*sqrt(t)", 100), "coordinate x has no velocity 0 s after the start");
  EXPECT_EQ(refusal(slider_crank, "0.9 + 0.05*t^1000", 100),
            "the exponent in `t^1000` is no integer or half of one up to 64");
}

}  // namespace
}  // namespace clearloci::numeric
