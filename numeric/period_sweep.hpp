// The pose error over distance and period: the paper's Fig. 8. One pass over the path serves all periods.
#pragma once

#include <array>
#include <vector>

#include "numeric/contact_losses.hpp"

namespace clearloci::numeric {

struct PeriodSweep {
  std::vector<double> periods;   ///< s
  std::vector<double> tau;       ///< of the samples, in order; two at a seam of intervals
  std::vector<double> distance;  ///< of the samples, m
  /// By period, then sample: m, rad. NaN where a take-up is undefined. In space `dalpha` is the size of the rotation;
  /// in the plane there is no dz.
  std::vector<double> dx, dy, dz, dalpha;

  std::size_t index(std::size_t period, std::size_t sample) const { return period * distance.size() + sample; }
};

/// In parallel.
PeriodSweep period_sweep(const Motion& motion, const std::vector<std::vector<Instant>>& samples,
                         const std::vector<double>& periods);

/// Where, over distance and period, a joint loses contact: lines of (distance, period).
struct LossCurve {
  mechanism::JointIndex joint = 0;
  core::Quantity quantity = core::Quantity::f;
  std::vector<std::vector<Point2>> lines;
};

/// w = 0 for couples, axial forces and ends of guides, and the largest period at which |f_J| is at the threshold for
/// the forces, within the range.
std::vector<LossCurve> loss_curves(const Motion& motion, const std::vector<std::vector<Instant>>& samples,
                                   const LossThresholds& thresholds, double shortest, double longest);

}  // namespace clearloci::numeric
