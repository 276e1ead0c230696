#include "numeric/period_sweep.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

namespace clearloci::numeric {

namespace {

/// What a period changes: the reactions of one joint at one instant, and what the error makes of its take-up.
struct JointTerms {
  double radial = 0, angular = 0;
  int fx = -1, fy = -1, couple = -1;
};

}  // namespace

PeriodSweep period_sweep(const Motion& motion, const std::vector<std::vector<Instant>>& samples,
                         const std::vector<double>& periods) {
  PeriodSweep sweep;
  sweep.periods = periods;
  std::vector<const Instant*> all;
  for (const auto& instants : samples)
    for (const Instant& i : instants) {
      all.push_back(&i);
      sweep.tau.push_back(i.tau);
      sweep.distance.push_back(i.distance.value());
    }
  for (auto* values : {&sweep.dx, &sweep.dy, &sweep.dalpha}) values->resize(periods.size() * all.size());
  std::vector<JointTerms> joints;
  for (std::size_t j = 0; j < motion.columns.size(); ++j) {
    const auto& [fx, fy, couple] = motion.columns[j];
    joints.push_back({motion.clearances[j].radial, couple >= 0 ? motion.clearances[j].angular : 0, fx, fy, couple});
  }
  tbb::parallel_for(std::size_t{0}, periods.size(), [&](std::size_t p) {
    const double u = 1 / (periods[p] * periods[p]);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t s = 0; s < all.size(); ++s) {
      const Instant& at = *all[s];
      Eigen::Vector3d error = Eigen::Vector3d::Zero();
      for (const JointTerms& joint : joints) {
        if (joint.radial > 0) {  // 0/0 where the force vanishes
          const double x = at.at_rest(joint.fx) + u * at.inertial(joint.fx);
          const double y = at.at_rest(joint.fy) + u * at.inertial(joint.fy);
          const double scale = -joint.radial / std::sqrt(x * x + y * y);
          error += scale * (x * at.influence.col(joint.fx) + y * at.influence.col(joint.fy));
        }
        if (joint.angular > 0) {
          const double m = at.at_rest(joint.couple) + u * at.inertial(joint.couple);
          error += (m == 0 ? nan : -std::copysign(joint.angular, m)) * at.influence.col(joint.couple);
        }
      }
      sweep.dx[sweep.index(p, s)] = error(0);
      sweep.dy[sweep.index(p, s)] = error(1);
      sweep.dalpha[sweep.index(p, s)] = error(2);
    }
  });
  return sweep;
}

std::vector<LossCurve> loss_curves(const Motion& motion, const std::vector<std::vector<Instant>>& samples,
                                   const LossThresholds& thresholds, double shortest, double longest) {
  std::vector<LossCurve> curves;
  for (std::size_t j = 0; j < motion.columns.size(); ++j) {
    for (const bool couple : {true, false}) {
      if (couple ? !(motion.clearances[j].angular > 0 && motion.columns[j].couple >= 0)
                 : !(motion.clearances[j].radial > 0))
        continue;
      LossCurve curve{static_cast<int>(j), couple, {}};
      for (const auto& instants : samples) {
        if (motion.timeline.intervals[instants.front().interval].stage < 0) continue;
        bool on = false;
        for (const Instant& i : instants) {
          const double period = loss_period(motion, i, curve.joint, couple, thresholds);
          const bool shown = period >= shortest && period <= longest;
          if (shown && !on) curve.lines.emplace_back();
          if (shown) curve.lines.back().push_back({i.distance.value(), period});
          on = shown;
        }
      }
      if (!curve.lines.empty()) curves.push_back(std::move(curve));
    }
  }
  return curves;
}

}  // namespace clearloci::numeric
