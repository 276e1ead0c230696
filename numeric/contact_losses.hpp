// Where along a trajectory the parts of a joint lose contact: M_J, F_J or what an end of a guide bears passes through
// zero (for that end N + T/h or N - T/h in the place of M below), or |f_J| has a minimum at or below a threshold, or
// any of them flips at once where the acceleration or the payload changes. And from which period on that no longer
// happens. With w = w_s + u w_i, u = 1/T² (dynamics.hpp), both questions have closed forms in T:
//     M_s + u M_i = 0                                 T = sqrt(-M_i / M_s)
//     |f_s|² + 2 u f_s·f_i + u² |f_i|² = threshold²   T = 1 / sqrt(smallest u >= 0)
//     (f_s + u f_i)·(f_s' + u f_i') = 0              where the acceleration jumps from i to i'
#pragma once

#include <vector>

#include "numeric/loss_effects.hpp"

namespace clearloci::numeric {

struct LossThresholds {
  double force = 0;  ///< N: a contact force at or below it is lost
};

/// 1 % of the largest contact force at rest along the path: the default.
LossThresholds default_thresholds(const Motion& motion, const std::vector<std::vector<Instant>>& samples);

enum class LossKind {
  zero,     ///< a number passes through zero
  minimum,  ///< |f_J| has a minimum at or below the threshold
  jump,     ///< a number changes its sign, or f_J turns by more than a right angle, between the two sides of an instant
};

struct ContactLoss {
  LossKind kind = LossKind::zero;
  mechanism::JointIndex joint = 0;
  core::Quantity quantity = core::Quantity::f;  ///< f, M, F, end_ahead or end_behind
  double tau = 0, time = 0;                     ///< part of the period; s, within 1e-9 s
  double distance = 0;                          ///< along the path, m
  int stage = -1;                               ///< -1: while dwelling
  double force = 0;                             ///< of a minimum: |f_J|, N
  double from = 0, to = 0;  ///< of a minimum: times between which |f_J| is at or below the threshold, s
  bool payload = false;     ///< of a jump: a body is picked or placed there
  LossEffect effect;
  double earles_wu = 0;  ///< of a minimum, rad/(N s); infinite where the force vanishes
};

/// A joint's quantity is zero all along the path (Motion::idle).
bool is_idle(const Motion& motion, std::size_t joint, core::Quantity quantity);

/// What is watched of a joint: f with a radial clearance, M or F with play in its actuator, the force of a gear, the
/// ends of a guide's contact with a gap; but for what is idle.
std::vector<core::Quantity> watched_quantities(const Motion& motion, std::size_t joint);
/// Those that are idle: contact is never made there, and the take-up is undefined.
std::vector<core::Quantity> idle_quantities(const Motion& motion, std::size_t joint);

/// Of the joints with a clearance, in order of time.
std::vector<ContactLoss> contact_losses(const Motion& motion, const std::vector<std::vector<Instant>>& samples,
                                        double period, const LossThresholds& thresholds);

/// The largest period at which a joint loses contact at an instant: 0 if at none, infinite if also at rest.
double loss_period(const Motion& motion, const Instant& at, mechanism::JointIndex joint, core::Quantity quantity,
                   const LossThresholds& thresholds);

/// The least period above which a stage is free of contact losses, jumps by payloads aside; 0 where it always is,
/// infinite where contact is lost at rest too. With what is lost last and where.
struct CriticalPeriod {
  double period = 0;  ///< s
  mechanism::JointIndex joint = -1;
  core::Quantity quantity = core::Quantity::f;
  double tau = 0, distance = 0;
};
std::vector<CriticalPeriod> critical_periods(const Motion& motion, const std::vector<std::vector<Instant>>& samples,
                                             const LossThresholds& thresholds);

}  // namespace clearloci::numeric
