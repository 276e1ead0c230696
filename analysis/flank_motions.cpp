#include "analysis/flank_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/flanks.hpp"
#include "core/errors.hpp"
#include "core/shown_units.hpp"

namespace clearloci {
namespace {

using numeric::Instant;
using numeric::Motion;

constexpr double infinity = std::numeric_limits<double>::infinity();

double effort(const Motion& motion, mechanism::JointIndex joint, const Eigen::VectorXd& reactions) {
  return reactions(motion.columns[static_cast<std::size_t>(joint)].couple);
}

/// How much the teeth of `gears` would have to pull, N; 0 where all push.
double pull(const Motion& motion, const std::vector<mechanism::JointIndex>& gears, const Instant& at, double period) {
  const Eigen::VectorXd reactions = at.reactions(period);
  double most = 0;
  for (const mechanism::JointIndex gear : gears) most = std::max(most, -effort(motion, gear, reactions));
  return most;
}

/// Whether the motion holds at a time, on one side of it at least; `gears`: those that it depends on.
bool bears(const Motion& motion, const std::vector<mechanism::JointIndex>& gears, double tau, double period) {
  constexpr double rounding = 1e-9;  // of all forces there
  for (std::size_t k = 0; k < motion.timeline.intervals.size(); ++k) {
    const numeric::Interval& interval = motion.timeline.intervals[k];
    if (tau < interval.begin || tau > interval.end) continue;
    const Instant at = numeric::instant(motion, k, tau);
    if (pull(motion, gears, at, period) <= rounding * at.reactions(period).cwiseAbs().maxCoeff()) return true;
  }
  return false;
}

bool is_same(const numeric::ContactLoss& a, const numeric::ContactLoss& b) {
  constexpr double at_once = 1e-9;  // s, as they are located
  return a.joint == b.joint && a.quantity == b.quantity && a.kind == b.kind && std::abs(a.time - b.time) <= at_once;
}

}  // namespace

FlankMotions::FlankMotions(const mechanism::Mechanism& mechanism, const mechanism::Trajectory& trajectory,
                           const DyadSides& sides, int count) {
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    if (has_teeth(mechanism.joints[j])) gears_.push_back(static_cast<mechanism::JointIndex>(j));
  constexpr std::size_t most_gears = 3;
  if (gears_.size() > most_gears)
    throw core::InputError(
        {mechanism.file},
        "trajectories are followed for at most three gears, and the mechanism has " + std::to_string(gears_.size()),
        "ask for pose at places of the path");
  for (const DyadSides& dyad_sides : modes_of_flanks(mechanism, sides)) {
    motions_.push_back(numeric::compile_motion(mechanism, trajectory, dyad_sides));
    samples_.push_back(numeric::sample(motions_.back(), count));
  }
}

InstantSamples FlankMotions::samples(double period) const {
  InstantSamples chosen = samples_.front();
  for (std::size_t m = 1; m < motions_.size(); ++m)
    for (std::size_t k = 0; k < chosen.size(); ++k)
      for (std::size_t i = 0; i < chosen[k].size(); ++i)
        if (pull(motions_[m], gears_, samples_[m][k][i], period) < pull(motion(), gears_, chosen[k][i], period))
          chosen[k][i] = samples_[m][k][i];
  return chosen;
}

std::vector<numeric::ContactLoss> FlankMotions::contact_losses(double period,
                                                               const numeric::LossThresholds& thresholds) const {
  if (!has_flanks()) return numeric::contact_losses(motion(), samples_.front(), period, thresholds);
  std::vector<numeric::ContactLoss> all;
  for (std::size_t m = 0; m < motions_.size(); ++m)
    for (const numeric::ContactLoss& loss : numeric::contact_losses(motions_[m], samples_[m], period, thresholds)) {
      std::vector<mechanism::JointIndex> others = gears_;
      std::erase(others, loss.joint);
      const bool is_present =
          std::any_of(all.begin(), all.end(), [&](const auto& candidate) { return is_same(candidate, loss); });
      if (!is_present && bears(motions_[m], others, loss.tau, period)) all.push_back(loss);
    }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.tau < b.tau; });
  return all;
}

std::optional<numeric::CriticalPeriod> FlankMotions::change_at_rest(std::size_t motion, int stage) const {
  const Motion& motion_data = motions_[motion];
  for (std::size_t k = 0; k < motion_data.timeline.intervals.size(); ++k) {
    if (motion_data.timeline.intervals[k].stage != stage) continue;
    for (const Instant& at : samples_[motion][k])
      for (const mechanism::JointIndex gear : gears_)
        if (effort(motion_data, gear, at.at_rest) < 0)
          return numeric::CriticalPeriod{infinity, gear, Quantity::F, at.tau, at.distance.value()};
  }
  return std::nullopt;
}

std::vector<numeric::CriticalPeriod> FlankMotions::critical_periods(const numeric::LossThresholds& thresholds) const {
  if (!has_flanks()) return numeric::critical_periods(motion(), samples_.front(), thresholds);
  std::vector<std::vector<numeric::CriticalPeriod>> of_motions;
  for (std::size_t m = 0; m < motions_.size(); ++m)
    of_motions.push_back(numeric::critical_periods(motions_[m], samples_[m], thresholds));
  std::vector<numeric::CriticalPeriod> critical;
  for (std::size_t stage = 0; stage < motion().timeline.stages.size(); ++stage) {
    // Of the motion that bears longest.
    std::optional<numeric::CriticalPeriod> last;
    for (std::size_t m = 0; m < motions_.size(); ++m) {
      const auto change = change_at_rest(m, static_cast<int>(stage));
      if (!change) {
        last = of_motions[m][stage];
        break;
      }
      if (!last || change->tau > last->tau) last = change;
    }
    critical.push_back(*last);
  }
  return critical;
}

numeric::PeriodSweep FlankMotions::sweep(const std::vector<double>& periods) const {
  if (!has_flanks()) return numeric::period_sweep(motion(), samples_.front(), periods);
  numeric::PeriodSweep all;
  for (const double period : periods) {
    const numeric::PeriodSweep sweep = numeric::period_sweep(motion(), samples(period), {period});
    all.periods.push_back(period);
    all.tau = sweep.tau;
    all.distance = sweep.distance;
    for (const auto part : {&numeric::PeriodSweep::dx, &numeric::PeriodSweep::dy, &numeric::PeriodSweep::dz,
                            &numeric::PeriodSweep::dalpha})
      (all.*part).insert((all.*part).end(), (sweep.*part).begin(), (sweep.*part).end());
  }
  return all;
}

std::vector<numeric::LossCurve> FlankMotions::loss_curves(const numeric::LossThresholds& thresholds, double shortest,
                                                          double longest) const {
  std::vector<numeric::LossCurve> curves =
      numeric::loss_curves(motion(), samples_.front(), thresholds, shortest, longest);
  if (has_flanks())
    std::erase_if(curves, [&](const numeric::LossCurve& curve) {
      return std::find(gears_.begin(), gears_.end(), curve.joint) == gears_.end();
    });
  return curves;
}

std::vector<std::string> FlankMotions::slack_notes(const InstantSamples& samples, double period) const {
  const mechanism::Mechanism& m = motion().model.mechanism;
  std::vector<std::string> notes;
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    const std::optional<double> most = most_of_belt(m, m.joints[j]);
    if (!most) continue;
    for (const auto& instants : samples) {
      const auto slack = std::find_if(instants.begin(), instants.end(), [&](const Instant& at) {
        return std::abs(effort(motion(), static_cast<mechanism::JointIndex>(j), at.reactions(period))) > *most;
      });
      if (slack == instants.end()) continue;
      notes.push_back("a span of belt " + m.joints[j].name + " is slack at " +
                      core::told(slack->tau * period, "s", m.units) + ": the reactions do not hold there");
      break;
    }
  }
  return notes;
}

}  // namespace clearloci
