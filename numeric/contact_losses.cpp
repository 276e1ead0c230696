#include "numeric/contact_losses.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "mechanism/guide.hpp"
#include "numeric/peak.hpp"

namespace clearloci::numeric {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A scalar of the cycle with its derivative by τ.
struct Value {
  double value = 0, rate = 0;
};

/// A number w of a joint: the couple or axial force of its actuator, or what an end of its guide bears, twice.
class Scalar {
 public:
  Scalar(const Motion& motion, mechanism::JointIndex joint, core::Quantity quantity) {
    const JointColumns& columns = motion.columns[static_cast<std::size_t>(joint)];
    first_ = columns.couple;
    if (!core::is_guide_end(quantity)) return;
    first_ = columns.normal;
    second_ = columns.tilt;
    lever_ = (quantity == core::Quantity::end_ahead ? 1 : -1) /
             motion.clearances[static_cast<std::size_t>(joint)].half_length;
  }

  double of(const Eigen::VectorXd& w) const { return second_ < 0 ? w(first_) : w(first_) + lever_ * w(second_); }

 private:
  int first_ = -1, second_ = -1;
  double lever_ = 0;
};

/// What is followed along an interval: a number, or the square of a force.
class Watch {
 public:
  Watch(const Motion& motion, double period, mechanism::JointIndex joint, core::Quantity quantity)
      : motion_(motion),
        u_(1 / (period * period)),
        is_number_(quantity != core::Quantity::f),
        number_(motion, joint, quantity),
        joint_(joint) {}

  Value at(const Instant& i) const {
    if (is_number_)
      return {number_.of(i.at_rest) + u_ * number_.of(i.inertial),
              number_.of(i.at_rest_rate) + u_ * number_.of(i.inertial_rate)};
    const PressingForce f = pressing(i);
    return {f.value.squaredNorm(), 2 * f.value.dot(f.rate)};
  }
  Value at(std::size_t interval, double tau) const { return at(instant(motion_, interval, tau)); }

  Vector3d force(const Instant& i) const { return pressing(i).value; }
  PressingForce pressing(const Instant& i) const {
    return pressing_force(motion_, i, joint_, i.at_rest + u_ * i.inertial, i.at_rest_rate + u_ * i.inertial_rate);
  }

 private:
  const Motion& motion_;
  double u_;
  bool is_number_;
  Scalar number_;
  mechanism::JointIndex joint_;
};

/// A root of g between a and b, where g(a) and g(b) differ in sign: bisection, for g may have a kink of rounding only.
double root(const std::function<double(double)>& g, double a, double b, double at_a) {
  while (b - a > located) {
    const double middle = (a + b) / 2;
    if (middle == a || middle == b) break;
    const double there = g(middle);
    if (there == 0) return middle;
    ((there < 0) == (at_a < 0) ? a : b) = middle;
  }
  return (a + b) / 2;
}

class LossSearch {
 public:
  LossSearch(const Motion& motion, const std::vector<std::vector<Instant>>& samples, double period,
             const LossThresholds& thresholds)
      : motion_(motion), samples_(samples), period_(period), threshold_(thresholds.force) {}

  std::vector<ContactLoss> run() {
    for (std::size_t j = 0; j < motion_.columns.size(); ++j) {
      joint_ = static_cast<int>(j);
      for (const core::Quantity quantity : watched_quantities(motion_, j)) follow(quantity);
    }
    std::stable_sort(losses_.begin(), losses_.end(),
                     [](const ContactLoss& a, const ContactLoss& b) { return a.tau < b.tau; });
    return std::move(losses_);
  }

 private:
  void follow(core::Quantity quantity) {
    const Watch watch(motion_, period_, joint_, quantity);
    quantity_ = quantity;
    const bool is_number = quantity != core::Quantity::f;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      if (motion_.timeline.intervals[k].stage >= 0) {
        for (std::size_t i = 0; i + 1 < samples_[k].size(); ++i) {
          if (is_number)
            between(watch, k, samples_[k][i], samples_[k][i + 1]);
          else
            dip(watch, k, samples_[k][i], samples_[k][i + 1]);
        }
      }
      if (k + 1 < samples_.size()) across(watch, samples_[k].back(), samples_[k + 1].front());
    }
    if (motion_.timeline.trajectory.closed) across(watch, samples_.back().back(), samples_.front().front());
    if (!is_number) join_ends(watch);
  }

  /// Zeros of a couple between two samples, also two of them around an extremum.
  void between(const Watch& watch, std::size_t interval, const Instant& a, const Instant& b) {
    const Value p = watch.at(a), q = watch.at(b);
    const auto value = [&](double tau) { return watch.at(interval, tau).value; };
    const auto rate = [&](double tau) { return watch.at(interval, tau).rate; };
    if ((p.value < 0) != (q.value < 0)) {
      add_zero(interval, root(value, a.tau, b.tau, p.value));
    } else if (p.value * p.rate < 0 && q.value * q.rate > 0) {
      const double extremum = root(rate, a.tau, b.tau, p.rate);
      const double there = value(extremum);
      if ((there < 0) == (p.value < 0) && there != 0) return;
      add_zero(interval, root(value, a.tau, extremum, p.value));
      add_zero(interval, root(value, extremum, b.tau, there));
    }
  }

  void add_zero(std::size_t interval, double tau) {
    add(LossKind::zero, interval, tau).effect =
        effect_of_zero(motion_, instant(motion_, interval, tau), joint_, quantity_);
  }

  /// A minimum of |f|² between two samples.
  void dip(const Watch& watch, std::size_t interval, const Instant& a, const Instant& b) {
    const Value p = watch.at(a), q = watch.at(b);
    if (!(p.rate < 0 && q.rate >= 0)) return;
    const double lowest = root([&](double tau) { return watch.at(interval, tau).rate; }, a.tau, b.tau, p.rate);
    add_minimum(watch, interval, lowest, watch.at(interval, lowest).value);
  }

  /// Minima at the seams of intervals: falling before, rising (or lower) after.
  void join_ends(const Watch& watch) {
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      if (motion_.timeline.intervals[k].stage < 0) continue;
      const Instant &begin = samples_[k].front(), &end = samples_[k].back();
      const Value b = watch.at(begin), e = watch.at(end);
      const bool falls_into = k > 0 && watch.at(samples_[k - 1].back()).value > b.value;
      if (b.rate > 0 && (k == 0 || falls_into || watch.at(samples_[k - 1].back()).rate < 0))
        add_minimum(watch, k, begin.tau, b.value);
      const bool rises_after = k + 1 < samples_.size() && watch.at(samples_[k + 1].front()).value > e.value;
      if (e.rate < 0 && (k + 1 == samples_.size() || rises_after)) add_minimum(watch, k, end.tau, e.value);
    }
  }

  /// From one interval to the next everything may jump.
  void across(const Watch& watch, const Instant& before, const Instant& after) {
    bool flipped = false;
    if (quantity_ != core::Quantity::f) {
      flipped = watch.at(before).value * watch.at(after).value < 0;
    } else {
      flipped = watch.force(before).dot(watch.force(after)) < 0;
    }
    if (!flipped) return;
    ContactLoss& loss = add(LossKind::jump, after.interval, after.tau);
    loss.payload =
        motion_.timeline.intervals[before.interval].carried != motion_.timeline.intervals[after.interval].carried;
    loss.effect = quantity_ == core::Quantity::f
                      ? effect_of_turn(motion_, after, joint_, watch.force(before), watch.force(after))
                      : effect_of_zero(motion_, after, joint_, quantity_);
  }

  void add_minimum(const Watch& watch, std::size_t interval, double tau, double squared) {
    const double force = std::sqrt(std::max(0.0, squared));
    if (force > threshold_) return;
    ContactLoss& loss = add(LossKind::minimum, interval, tau);
    loss.force = force;
    const auto excess = [&](double t) { return watch.at(interval, t).value - threshold_ * threshold_; };
    // Outwards over the interval's own samples until the force is above the threshold again.
    const auto& sample = samples_[interval];
    double left = sample.front().tau, right = sample.back().tau;
    for (auto i = sample.rbegin(); i != sample.rend(); ++i) {
      if (i->tau >= tau || watch.at(*i).value <= threshold_ * threshold_) continue;
      left = root(excess, i->tau, tau, 1);
      break;
    }
    for (const Instant& i : sample) {
      if (i.tau <= tau || watch.at(i).value <= threshold_ * threshold_) continue;
      right = root(excess, tau, i.tau, -1);
      break;
    }
    loss.from = left * period_;
    loss.to = right * period_;
    const Instant lowest = instant(motion_, interval, tau);
    loss.effect = effect_of_turn(motion_, lowest, joint_, watch.force(instant(motion_, interval, left)),
                                 watch.force(instant(motion_, interval, right)));
    PressingForce least = watch.pressing(lowest);
    least.rate /= period_;
    // A force that passes through zero turns by half a turn there, at no rate; what is left of it is rounding.
    constexpr double nothing = 1e-8;  // of the threshold
    loss.earles_wu = force <= nothing * threshold_ ? HUGE_VAL : earles_wu(least);
  }

  ContactLoss& add(LossKind kind, std::size_t interval, double tau) {
    const Interval& stretch = motion_.timeline.intervals[interval];
    ContactLoss loss;
    loss.kind = kind;
    loss.joint = joint_;
    loss.quantity = quantity_;
    loss.tau = tau;
    loss.time = tau * period_;
    loss.distance = distance_at(motion_.timeline, stretch, tau).value();
    loss.stage = stretch.stage;
    return losses_.emplace_back(loss);
  }

  const Motion& motion_;
  const std::vector<std::vector<Instant>>& samples_;
  double period_, threshold_;
  mechanism::JointIndex joint_ = 0;
  core::Quantity quantity_ = core::Quantity::f;
  std::vector<ContactLoss> losses_;
};

/// f_s and f_i.
struct ForceParts {
  Vector3d at_rest, inertial;
};

ForceParts force_parts(const Motion& motion, const Instant& at, mechanism::JointIndex joint) {
  return {pressing_force(motion, at, joint, at.at_rest, at.at_rest_rate).value,
          pressing_force(motion, at, joint, at.inertial, at.inertial_rate).value};
}

/// The largest period at which f_J turns by more than a right angle from one side of a seam to the other:
/// (f_s + u f_i)·(f_s' + u f_i') = 0.
double turn_period(const Motion& motion, const Instant& before, const Instant& after, mechanism::JointIndex joint) {
  const ForceParts b = force_parts(motion, before, joint), a = force_parts(motion, after, joint);
  const double constant = b.at_rest.dot(a.at_rest);
  const double half = (b.at_rest.dot(a.inertial) + b.inertial.dot(a.at_rest)) / 2;
  const double square = b.inertial.dot(a.inertial);
  const double discriminant = half * half - square * constant;
  if (constant <= 0) return infinity;
  if (discriminant < 0) return 0;
  // 1/u of the smallest u > 0: the largest root of constant v² + 2 half v + square.
  const double v = (-half + std::sqrt(discriminant)) / constant;
  return v > 0 ? std::sqrt(v) : 0;
}

void consider_seams(const Motion& motion, const std::vector<std::vector<Instant>>& samples,
                    std::vector<CriticalPeriod>& critical) {
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (k == 0 && !motion.timeline.trajectory.closed) continue;
    const Instant &before = samples[(k + samples.size() - 1) % samples.size()].back(), &after = samples[k].front();
    const Interval &left = motion.timeline.intervals[before.interval],
                   &right = motion.timeline.intervals[after.interval];
    if (right.stage < 0 || left.carried != right.carried) continue;
    for (std::size_t j = 0; j < motion.columns.size(); ++j) {
      if (!(motion.clearances[j].radial > 0)) continue;
      const double period = turn_period(motion, before, after, static_cast<mechanism::JointIndex>(j));
      CriticalPeriod& stage = critical[static_cast<std::size_t>(right.stage)];
      if (period > stage.period)
        stage = {period, static_cast<int>(j), core::Quantity::f, after.tau, after.distance.value()};
    }
  }
}

/// The largest loss_period of one joint over an interval.
class LastLoss {
 public:
  LastLoss(const Motion& motion, mechanism::JointIndex joint, core::Quantity quantity, const LossThresholds& thresholds)
      : motion_(motion),
        joint_(joint),
        quantity_(quantity),
        is_number_(quantity != core::Quantity::f),
        number_(motion, joint, quantity),
        thresholds_(thresholds) {}

  void search(const std::vector<Instant>& instants, CriticalPeriod& stage) const {
    for (std::size_t i = 0; i < instants.size(); ++i) {
      consider(instants[i], period_at(instants[i]), stage);
      const bool first = i == 0, last = i + 1 == instants.size();
      const double product =
          is_number_ && !first ? number_.of(instants[i - 1].at_rest) * number_.of(instants[i].at_rest) : 1;
      if (product < 0) consider(instants[i], infinity, stage);  // it passes through zero at rest too
      const auto is_peak = [&](const auto& g) {
        const double here = g(instants[i]);
        return (first || here >= g(instants[i - 1])) && (last || here >= g(instants[i + 1]));
      };
      const double a = instants[first ? i : i - 1].tau, b = instants[last ? i : i + 1].tau;
      const double here = period_at(instants[i]);
      const std::size_t interval = instants[i].interval;
      if (here > 0 && std::isfinite(here) && is_peak([&](const Instant& at) { return period_at(at); })) {
        if (is_number_)
          refine(interval, a, b, stage);
        else
          refine_around(interval, a, instants[i].tau, b, stage);
      } else if (here == 0 && !is_number_ && is_peak([&](const Instant& at) { return -nearest(at); })) {
        search_between(interval, a, b, stage);
      }
    }
  }

 private:
  double period_at(const Instant& at) const { return loss_period(motion_, at, joint_, quantity_, thresholds_); }

  /// The least |f_s + u f_i| over u >= 0: whether some period loses contact here.
  double nearest(const Instant& at) const {
    const auto [rest, inertial] = force_parts(motion_, at, joint_);
    if (rest.dot(inertial) >= 0) return rest.norm();
    return rest.cross(inertial).norm() / inertial.norm();
  }

  void refine(std::size_t interval, double a, double b, CriticalPeriod& stage) const {
    const auto at = [&](double tau) { return period_at(instant(motion_, interval, tau)); };
    const Instant top = instant(motion_, interval, peak(at, a, b));
    consider(top, period_at(top), stage);
  }

  /// A force that is lost between two samples only.
  void search_between(std::size_t interval, double a, double b, CriticalPeriod& stage) const {
    const double lowest = peak([&](double tau) { return -excess(interval, tau); }, a, b);
    if (excess(interval, lowest) <= 0) refine_around(interval, a, lowest, b, stage);
  }

  /// Where contact is lost at `inside` at some period: only as far to both sides as that holds.
  void refine_around(std::size_t interval, double a, double inside, double b, CriticalPeriod& stage) const {
    const auto g = [&](double tau) { return excess(interval, tau); };
    const double left = g(a) > 0 ? root(g, a, inside, 1) : a, right = g(b) > 0 ? root(g, inside, b, -1) : b;
    refine(interval, left, right, stage);
  }

  double excess(std::size_t interval, double tau) const {
    return nearest(instant(motion_, interval, tau)) - thresholds_.force;
  }

  void consider(const Instant& at, double period, CriticalPeriod& stage) const {
    if (period > stage.period) stage = {period, joint_, quantity_, at.tau, at.distance.value()};
  }

  const Motion& motion_;
  mechanism::JointIndex joint_;
  core::Quantity quantity_;
  bool is_number_;
  Scalar number_;
  const LossThresholds& thresholds_;
};

}  // namespace

bool is_idle(const Motion& motion, std::size_t joint, core::Quantity quantity) {
  const JointColumns& columns = motion.columns[joint];
  const auto zero = [&](int column) {
    return column < 0 || (!motion.idle.unknowns.empty() && motion.idle.unknowns[static_cast<std::size_t>(column)]);
  };
  if (core::is_guide_end(quantity))
    return !motion.idle.ends.empty() && motion.idle.ends[joint][quantity == core::Quantity::end_ahead ? 0 : 1];
  if (quantity != core::Quantity::f) return zero(columns.couple);
  if (is_idle_across(motion, joint)) return true;
  return columns.fx < 0 ? zero(columns.normal) : zero(columns.fx) && zero(columns.fy) && zero(columns.fz);
}

namespace {

/// What may lose contact.
std::vector<core::Quantity> with_clearance(const Motion& motion, std::size_t joint) {
  const JointClearance& clearance = motion.clearances[joint];
  const JointColumns& columns = motion.columns[joint];
  std::vector<core::Quantity> watched;
  const mechanism::Joint& lost_joint = motion.model.mechanism.joints[joint];
  // Teeth change flanks, with or without play.
  const bool teeth = lost_joint.meshing && lost_joint.meshing->flank;
  if (clearance.angular > 0 || clearance.axial > 0 || teeth)
    watched.push_back(mechanism::actuator_quantity(lost_joint));
  if (clearance.radial > 0) watched.push_back(core::Quantity::f);
  if (clearance.gap > 0 && columns.normal >= 0)
    for (const auto& [end, sign] : mechanism::guide_end_signs) watched.push_back(end);
  return watched;
}

}  // namespace

std::vector<core::Quantity> watched_quantities(const Motion& motion, std::size_t joint) {
  std::vector<core::Quantity> watched = with_clearance(motion, joint);
  std::erase_if(watched, [&](core::Quantity quantity) { return is_idle(motion, joint, quantity); });
  return watched;
}

std::vector<core::Quantity> idle_quantities(const Motion& motion, std::size_t joint) {
  std::vector<core::Quantity> idle = with_clearance(motion, joint);
  std::erase_if(idle, [&](core::Quantity quantity) { return !is_idle(motion, joint, quantity); });
  return idle;
}

LossThresholds default_thresholds(const Motion& motion, const std::vector<std::vector<Instant>>& samples) {
  constexpr double part = 0.01;
  double most = 0;
  for (const auto& instants : samples)
    for (const Instant& i : instants)
      for (const JointColumns& c : motion.columns)
        if (c.fx >= 0 && c.fy >= 0)
          most = std::max(most, std::hypot(i.at_rest(c.fx), i.at_rest(c.fy), c.fz < 0 ? 0.0 : i.at_rest(c.fz)));
  return {part * most};
}

std::vector<ContactLoss> contact_losses(const Motion& motion, const std::vector<std::vector<Instant>>& samples,
                                        double period, const LossThresholds& thresholds) {
  return LossSearch(motion, samples, period, thresholds).run();
}

double loss_period(const Motion& motion, const Instant& at, mechanism::JointIndex joint, core::Quantity quantity,
                   const LossThresholds& thresholds) {
  if (quantity != core::Quantity::f) {
    const Scalar number(motion, joint, quantity);
    const double rest = number.of(at.at_rest), inertial = number.of(at.inertial);
    if (rest == 0) return infinity;
    return rest * inertial < 0 ? std::sqrt(-inertial / rest) : 0;
  }
  const auto [rest, inertial] = force_parts(motion, at, joint);
  const double excess = rest.squaredNorm() - thresholds.force * thresholds.force;
  if (excess <= 0) return infinity;
  const double half = rest.dot(inertial), square = inertial.squaredNorm();
  const double discriminant = half * half - square * excess;
  if (half >= 0 || discriminant < 0) return 0;
  // The smaller root of square u² + 2 half u + excess, without cancellation.
  return std::sqrt((-half + std::sqrt(discriminant)) / excess);
}

std::vector<CriticalPeriod> critical_periods(const Motion& motion, const std::vector<std::vector<Instant>>& samples,
                                             const LossThresholds& thresholds) {
  std::vector<CriticalPeriod> critical(motion.timeline.stages.size());
  consider_seams(motion, samples, critical);
  for (std::size_t j = 0; j < motion.columns.size(); ++j) {
    for (const core::Quantity quantity : watched_quantities(motion, j)) {
      const LastLoss last(motion, static_cast<mechanism::JointIndex>(j), quantity, thresholds);
      for (const auto& instants : samples) {
        const int stage = motion.timeline.intervals[instants.front().interval].stage;
        if (stage >= 0) last.search(instants, critical[static_cast<std::size_t>(stage)]);
      }
    }
  }
  return critical;
}

}  // namespace clearloci::numeric
