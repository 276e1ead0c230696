#include "numeric/period_sweep.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>

#include "mechanism/guide.hpp"

namespace clearloci::numeric {

namespace {

/// What a period changes: the reactions of one joint at one instant, and what the error makes of its take-up.
struct JointTerms {
  JointClearance clearance;  ///< 0 where the joint has no such reaction
  JointColumns columns;
  std::array<bool, 2> idle;  ///< ends of its guide
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
  if (motion.model.mechanism.space == mechanism::Space::spatial) {
    sweep.dz.resize(periods.size() * all.size());
    tbb::parallel_for(std::size_t{0}, periods.size(), [&](std::size_t p) {
      for (std::size_t s = 0; s < all.size(); ++s) {
        const PoseError error = instant_error(motion, *all[s], periods[p]).error;
        const std::size_t place = sweep.index(p, s);
        sweep.dx[place] = error.dp(0);
        sweep.dy[place] = error.dp(1);
        sweep.dz[place] = error.dp(2);
        sweep.dalpha[place] = error.dalpha.norm();
      }
    });
    return sweep;
  }
  std::vector<JointTerms> joints;
  for (std::size_t j = 0; j < motion.columns.size(); ++j) {
    const JointColumns& columns = motion.columns[j];
    JointClearance clearance = motion.clearances[j];
    if (columns.normal < 0) clearance.gap = 0;
    std::array<bool, 2> idle{};
    for (const auto& [end, sign] : mechanism::guide_end_signs) idle[sign > 0 ? 0 : 1] = is_idle(motion, j, end);
    joints.push_back({clearance, columns, idle});
  }
  tbb::parallel_for(std::size_t{0}, periods.size(), [&](std::size_t p) {
    const double u = 1 / (periods[p] * periods[p]);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t s = 0; s < all.size(); ++s) {
      const Instant& at = *all[s];
      Eigen::Vector3d error = Eigen::Vector3d::Zero();
      for (const JointTerms& joint : joints) {
        const auto& [clearance, columns, idle] = joint;
        const auto reaction = [&](int column) { return at.at_rest(column) + u * at.inertial(column); };
        if (clearance.radial > 0) {  // 0/0 where the force vanishes
          const double x = reaction(columns.fx), y = reaction(columns.fy);
          const double scale = -clearance.radial / std::sqrt(x * x + y * y);
          error += scale * (x * at.influence.col(columns.fx) + y * at.influence.col(columns.fy));
        }
        for (const double play : {clearance.angular, clearance.axial}) {
          if (!(play > 0)) continue;
          const double m = reaction(columns.couple);
          error += (m == 0 ? nan : -std::copysign(play, m)) * at.influence.col(columns.couple);
        }
        if (clearance.gap > 0) {
          const double h = clearance.half_length;
          std::array<double, 2> way = guide_ends(reaction(columns.normal), reaction(columns.tilt), h);
          for (const std::size_t end : {0, 1})
            way[end] = idle[end] || way[end] == 0 ? nan : -std::copysign(clearance.gap, way[end]);
          error += (way[0] + way[1]) / 2 * at.influence.col(columns.normal) +
                   (way[0] - way[1]) / (2 * h) * at.influence.col(columns.tilt);
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
    for (const core::Quantity quantity : watched_quantities(motion, j)) {
      LossCurve curve{static_cast<int>(j), quantity, {}};
      for (const auto& instants : samples) {
        if (motion.timeline.intervals[instants.front().interval].stage < 0) continue;
        bool on = false;
        for (const Instant& i : instants) {
          const double period = loss_period(motion, i, curve.joint, quantity, thresholds);
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
