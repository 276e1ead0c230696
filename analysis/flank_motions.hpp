// A mechanism with gears along a trajectory. Teeth push: at each instant one flank of each gear bears, and the motions
// on the other flanks say nothing there. All of them are followed, and what holds is taken from the one that bears.
// Where its force vanishes both agree, and the teeth change flanks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clearloci/pose.hpp"
#include "numeric/contact_losses.hpp"
#include "numeric/period_sweep.hpp"

namespace clearloci {

using InstantSamples = std::vector<std::vector<numeric::Instant>>;  ///< by interval

class FlankMotions {
 public:
  /// `count`: of instants, as of numeric::sample. Throws core::InputError as that does, and for more than three gears.
  FlankMotions(const mechanism::Mechanism& mechanism, const mechanism::Trajectory& trajectory, const DyadSides& sides,
               int count);

  /// One of them: whatever does not depend on the flanks.
  const numeric::Motion& motion() const { return motions_.front(); }
  bool has_flanks() const { return motions_.size() > 1; }

  /// At each instant that of the flanks that bear at this period, s; infinite: at rest.
  InstantSamples samples(double period) const;

  std::vector<numeric::ContactLoss> contact_losses(double period, const numeric::LossThresholds& thresholds) const;
  /// Infinite for a stage in which teeth change flanks at rest.
  std::vector<numeric::CriticalPeriod> critical_periods(const numeric::LossThresholds& thresholds) const;
  numeric::PeriodSweep sweep(const std::vector<double>& periods) const;
  /// With several flanks those of the gears' forces alone.
  std::vector<numeric::LossCurve> loss_curves(const numeric::LossThresholds& thresholds, double shortest,
                                              double longest) const;

  /// "a span of belt T is slack at 0.31 s, ...": of each belt the first instant at which one would have to push.
  std::vector<std::string> slack_notes(const InstantSamples& samples, double period) const;

 private:
  /// Where teeth would first have to pull at rest.
  std::optional<numeric::CriticalPeriod> change_at_rest(std::size_t motion, int stage) const;

  std::vector<mechanism::JointIndex> gears_;
  std::vector<numeric::Motion> motions_;
  std::vector<InstantSamples> samples_;  ///< of each motion
};

}  // namespace clearloci
