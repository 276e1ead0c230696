#include "numeric/dynamics.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "core/shown_units.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/bounded.hpp"
#include "numeric/group_solution.hpp"
#include "numeric/instant_equations.hpp"
#include "numeric/peak.hpp"

namespace clearloci::numeric {
namespace {

std::string place_words(const Motion& motion, const Instant& at) {
  std::string text;
  for (std::size_t c = 0; c < at.coordinates.size(); ++c) {
    const mechanism::Coordinate& coordinate = motion.model.mechanism.coordinates[c];
    text += (c == 0 ? "" : ", ") + coordinate.name + " = " +
            core::told(at.coordinates[c].value(), coordinate.angle ? "rad" : "m", motion.model.mechanism.units);
  }
  return text;
}

/// Of points that are no numbers, the group that the first of them is in.
const mechanism::Group* lost_group(const Motion& motion, const Instant& at) {
  const auto is_lost = [](const PointSeries& point) {
    return std::any_of(point.begin(), point.end(), [](const Series& s) { return !std::isfinite(s.value()); });
  };
  const auto first = std::find_if(at.points.begin(), at.points.end(), is_lost) - at.points.begin();
  for (const mechanism::Group& group : motion.model.mechanism.groups)
    if (first >= group.first && first <= group.last) return &group;
  return nullptr;
}

[[noreturn]] void throw_singular(const Motion& motion, const Instant& at) {
  throw core::InputError({motion.timeline.trajectory.file, 0, 0},
                         "the path meets a direct singularity near " + place_words(motion, at),
                         "move the waypoints, or choose another working mode");
}

/// A motion that is given in time may have no value there, or no velocity, ...
void require_motion(const Motion& motion, const Instant& at) {
  for (std::size_t c = 0; c < at.coordinates.size(); ++c) {
    const auto& orders = at.coordinates[c].c;
    std::size_t lost = 0;
    while (lost < orders.size() && std::isfinite(orders[lost])) ++lost;
    if (lost == orders.size()) continue;
    constexpr std::array names = {"value", "velocity", "acceleration", "jerk"};
    const double time = at.tau * core::to_double(motion.timeline.trajectory.period);
    throw core::InputError({motion.timeline.trajectory.file, 0, 0},
                           "coordinate " + motion.model.mechanism.coordinates[c].name + " has no " + names[lost] + " " +
                               core::told(time, "s", motion.model.mechanism.units) + " after the start",
                           "write an expression that is smooth over the whole period");
  }
}

void require_regular(const Motion& motion, const Instant& at) {
  const std::string& file = motion.timeline.trajectory.file;
  require_motion(motion, at);
  if (at.broken) {
    const mechanism::Mechanism& m = motion.model.mechanism;
    throw core::InputError({file, 0, 0},
                           "the path is beyond the limit of the " +
                               mechanism::words_of_end(m, at.broken->limit, at.broken->upper) + ", at " +
                               place_words(motion, at),
                           "move the waypoints, or choose another working mode");
  }
  const mechanism::Group* const group = at.reachable ? nullptr : lost_group(motion, at);
  if (group != nullptr)
    throw core::InputError({file, 0, 0},
                           "group " + group->name + " does not close at " + place_words(motion, at) +
                               ": between its posture and there it comes to a dead centre",
                           "move the waypoints, or give another posture ('near')");
  if (!at.reachable)
    throw core::InputError({file, 0, 0},
                           "the path leaves the workspace, or touches its boundary, at " + place_words(motion, at),
                           "move the waypoints, or choose another working mode");
  if (at.determinant == 0 || !at.at_rest.allFinite() || !at.inertial.allFinite()) throw_singular(motion, at);
}

/// Places, and the equations there, of coordinates that are known.
void solve_at(const Motion& motion, const Interval& stretch, Instant& result, Roundings* roundings = nullptr) {
  const NumericModel& model = motion.model;
  std::vector<Series> inputs = result.coordinates;
  for (const int sign : motion.mode) inputs.emplace_back(sign);
  inputs.resize(static_cast<std::size_t>(model.inputs()));
  place_groups(model, motion.mode, inputs);
  std::vector<Series> registers(static_cast<std::size_t>(model.equations_size));
  run<Series, 1>(model.tape, 0, model.equations_size, inputs.data(), registers.data());
  const auto vector = [&](const Triple& v) {
    const auto at = [&](std::size_t c) { return registers[static_cast<std::size_t>(v[c])]; };
    return PointSeries{at(0), at(1), at(2)};
  };
  result.reachable = true;
  for (int i = 0; i < model.equations_size; ++i)
    if (const Instruction& code = model.tape.code[static_cast<std::size_t>(i)]; code.op == Op::sqrt)
      result.rooms.push_back(registers[static_cast<std::size_t>(code.a)].value());
  for (const Triple& point : model.points) {
    result.points.push_back(vector(point));
    for (const Series& s : result.points.back())
      for (const double c : s.c) result.reachable = result.reachable && std::isfinite(c);
  }
  for (std::size_t i = 0; i < model.slack.size() && result.reachable; ++i)
    for (const bool upper : {false, true})
      if (const auto& end = model.slack[i][upper ? 1 : 0]) {
        const double left = registers[static_cast<std::size_t>(*end)].value();
        result.rooms.push_back(left);
        if (!(left >= 0) && !result.broken) result.broken = LimitEnd{i, upper, left};
      }
  result.reachable = result.reachable && !result.broken;
  for (const auto& axis : model.axes) {
    const PointSeries u = axis ? vector(*axis) : PointSeries{};
    result.axes.push_back(values_of(u));
    result.axes_rate.emplace_back(u[0].c[1], u[1].c[1], u[2].c[1]);
  }
  for (const auto& axis : model.couple_axes)
    result.couple_axes.push_back(axis ? values_of(vector(*axis)) : Vector3d::Zero());
  if (result.reachable) solve_equations(motion, stretch, registers, result, roundings);
}

}  // namespace

Instant instant_of(const Motion& motion, const std::vector<Series>& coordinates) {
  Instant result;
  result.coordinates = coordinates;
  solve_at(motion, {}, result);
  return result;
}

namespace {

Instant instant(const Motion& motion, std::size_t interval, double tau, Roundings* roundings) {
  const Interval& stretch = motion.timeline.intervals[interval];
  Instant result;
  result.tau = tau;
  result.interval = interval;
  result.distance = distance_at(motion.timeline, stretch, tau);
  result.coordinates = coordinates_at(motion.timeline, stretch, tau);
  solve_at(motion, stretch, result, roundings);
  return result;
}

}  // namespace

Instant instant(const Motion& motion, std::size_t interval, double tau) {
  Instant at = instant(motion, interval, tau, nullptr);
  require_regular(motion, at);
  return at;
}

bool bears_across(const Motion& motion, std::size_t joint) {
  const JointColumns& c = motion.columns[joint];
  return c.fx >= 0 && c.fy >= 0 && c.fz >= 0 &&
         mechanism::presses_across_axis(motion.model.mechanism, motion.model.mechanism.joints[joint]);
}

bool is_idle_across(const Motion& motion, std::size_t joint) {
  return !motion.idle.ends.empty() && bears_across(motion, joint) && motion.idle.ends[joint][0];
}

namespace {

/// Whether the part of a joint's force across its axis is zero, to the rounding of the solution and of that part.
bool is_zero_across(const Motion& motion, const Instant& at, std::size_t joint, const Eigen::VectorXd& values,
                    const Eigen::VectorXd& bounds) {
  const JointColumns& c = motion.columns[joint];
  constexpr double roundings = 16;  // of u (u . f), and of u itself
  const double whole = Vector3d(values(c.fx), values(c.fy), values(c.fz)).norm();
  const double bound = Vector3d(bounds(c.fx), bounds(c.fy), bounds(c.fz)).norm() + roundings * unit_roundoff * whole;
  const auto index = static_cast<mechanism::JointIndex>(joint);
  return pressing_force(motion, at, index, values, Eigen::VectorXd::Zero(values.size())).value.norm() <= bound;
}

}  // namespace

Idle idle_parts(const Motion& motion) {
  constexpr std::array shares = {0.2361, 0.5858, 0.8284};  // off the middle, where symmetric designs have zeros
  Idle idle{std::vector<bool>(motion.model.unknowns.size(), true),
            std::vector<std::array<bool, 2>>(motion.columns.size(), {true, true})};
  bool told = false;
  for (std::size_t k = 0; k < motion.timeline.intervals.size(); ++k) {
    const Interval& stretch = motion.timeline.intervals[k];
    for (const double share : shares) {
      Roundings roundings;
      const Instant at = instant(motion, k, stretch.begin + share * (stretch.end - stretch.begin), &roundings);
      if (roundings.at_rest.size() == 0) continue;
      told = true;
      const std::array<std::pair<const Eigen::VectorXd*, const Eigen::VectorXd*>, 2> parts = {
          {{&at.at_rest, &roundings.at_rest}, {&at.inertial, &roundings.inertial}}};
      for (const auto& [values, bounds] : parts) {
        for (std::size_t u = 0; u < idle.unknowns.size(); ++u) {
          const auto row = static_cast<Eigen::Index>(u);
          idle.unknowns[u] = idle.unknowns[u] && std::abs((*values)(row)) <= (*bounds)(row);
        }
        for (std::size_t j = 0; j < idle.ends.size(); ++j) {
          const JointColumns& columns = motion.columns[j];
          if (bears_across(motion, j)) {
            if (!is_zero_across(motion, at, j, *values, *bounds)) idle.ends[j] = {false, false};
            continue;
          }
          const double h = motion.clearances[j].half_length;
          if (columns.normal < 0 || columns.tilt < 0 || !(h > 0)) {
            idle.ends[j] = {false, false};
            continue;
          }
          const std::array<double, 2> ends = guide_ends((*values)(columns.normal), (*values)(columns.tilt), h);
          const double bound = (*bounds)(columns.normal) + (*bounds)(columns.tilt) / h;
          for (const std::size_t end : {0, 1}) idle.ends[j][end] = idle.ends[j][end] && std::abs(ends[end]) <= bound;
        }
      }
    }
  }
  return told ? idle : Idle{};
}

std::vector<JointReaction> joint_reactions(const Motion& motion, const Instant& at, const Eigen::VectorXd& values) {
  const NumericModel& model = motion.model;
  std::vector<JointReaction> all =
      joint_reactions(at.axes.size(), unknown_columns(model, at.axes, at.couple_axes), values);
  if (model.mechanism.space == mechanism::Space::planar) return all;
  // The whole force and couple of equations.hpp hold the actuator's share.
  for (std::size_t j = 0; j < all.size(); ++j) {
    Vector3d& whole = mechanism::traits(model.mechanism.joints[j]).slides ? all[j].force : all[j].couple;
    whole -= all[j].actuator * at.axes[j];
    if (is_idle_across(motion, j)) all[j].force.setZero();
  }
  return all;
}

PressingForce pressing_force(const Motion& motion, const Instant& at, mechanism::JointIndex joint,
                             const Eigen::VectorXd& values, const Eigen::VectorXd& rates) {
  const auto j = static_cast<std::size_t>(joint);
  const JointColumns& c = motion.columns[j];
  if (c.fx < 0) {  // a slot: N k × u
    const Vector3d &u = at.axes[j], &turn = at.axes_rate[j];
    const Vector3d across(-u.y(), u.x(), 0), across_rate(-turn.y(), turn.x(), 0);
    return {values(c.normal) * across, rates(c.normal) * across + values(c.normal) * across_rate};
  }
  const auto force = [&](const Eigen::VectorXd& w) { return Vector3d(w(c.fx), w(c.fy), c.fz < 0 ? 0.0 : w(c.fz)); };
  PressingForce pressing_force{force(values), force(rates)};
  if (c.fz < 0 || !mechanism::traits(motion.model.mechanism.joints[j]).turns_about_axis()) return pressing_force;
  // f - u (u·f), differentiated
  const Vector3d &u = at.axes[j], &turn = at.axes_rate[j];
  const double along = u.dot(pressing_force.value);
  pressing_force.rate -= turn * along + u * (turn.dot(pressing_force.value) + u.dot(pressing_force.rate));
  pressing_force.value -= u * along;
  return pressing_force;
}

InstantError instant_error(const Motion& motion, const Instant& at, double period) {
  InstantError result;
  const mechanism::Mechanism& m = motion.model.mechanism;
  result.contacts = joint_contacts(m, at.axes);
  result.take_up = take_up(result.contacts, joint_reactions(motion, at, at.reactions(period)));
  if (undefined_take_up(m, result.contacts, result.take_up).empty()) {
    const std::vector<ReactionColumn> columns = unknown_columns(motion.model, at.axes, at.couple_axes);
    result.error = pose_error(m.space, at.influence, clearance_displacements(columns, result.take_up));
  } else {
    const Vector3d none = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    result.error = {none, none};
  }
  return result;
}

namespace {

/// Where the path comes nearer to the end of its workspace, or to a singularity, than at any sample: what is left of
/// limits, the squares of roots, and |A|, followed to their minima between the samples of an interval.
class BetweenSamples {
 public:
  BetweenSamples(const Motion& motion, const std::vector<Instant>& instants) : motion_(motion), instants_(instants) {}

  void check() const {
    for (std::size_t i = 1; i < instants_.size(); ++i)
      if ((instants_[i - 1].determinant < 0) != (instants_[i].determinant < 0)) throw_singular(motion_, instants_[i]);
    for (std::size_t room = 0; room <= instants_.front().rooms.size(); ++room)
      for (std::size_t i = 0; i < instants_.size(); ++i) check_around(room, i);
  }

 private:
  /// `room`: its place; behind the last of them |A|.
  double left(std::size_t room, const Instant& at) const {
    if (room < at.rooms.size()) return at.rooms[room];
    return instants_.front().determinant < 0 ? -at.determinant : at.determinant;
  }

  /// Around a sample at which it is least, unless a parabola through three samples keeps half of it.
  void check_around(std::size_t room, std::size_t i) const {
    const std::size_t last = instants_.size() - 1, middle = std::clamp<std::size_t>(i, 1, last - 1);
    const Instant &before = instants_[middle - 1], &at = instants_[middle], &behind = instants_[middle + 1];
    const double f[] = {left(room, before), left(room, at), left(room, behind)};
    const double here = left(room, instants_[i]);
    if ((i > 0 && left(room, instants_[i - 1]) < here) || (i < last && left(room, instants_[i + 1]) < here)) return;
    const double slope = (f[2] - f[0]) / 2, bend = f[2] - 2 * f[1] + f[0];
    if (!(bend > 0) || std::abs(slope) > 2 * bend) return;
    if (f[1] - slope * slope / (2 * bend) > here / 2) return;
    const double least = least_between(room, before.tau, behind.tau);
    constexpr double touches = 1e-9;
    if (least > touches * std::max(f[0], f[2])) return;
    throw core::InputError({motion_.timeline.trajectory.file, 0, 0},
                           "the path touches the end of the workspace, or a direct singularity, near " +
                               place_words(motion_, instants_[i]),
                           "move the waypoints, or choose another working mode");
  }

  double least_between(std::size_t room, double a, double b) const {
    const auto at = [&](double tau) {
      const Instant between = instant(motion_, instants_.front().interval, tau);
      const double value = left(room, between);
      if (room == between.rooms.size() && value < 0) throw_singular(motion_, between);
      return value;
    };
    return at(peak([&](double tau) { return -at(tau); }, a, b));
  }

  const Motion& motion_;
  const std::vector<Instant>& instants_;
};

}  // namespace

std::vector<std::vector<Instant>> sample(const Motion& motion, int count) {
  const auto& intervals = motion.timeline.intervals;
  std::vector<std::vector<Instant>> all(intervals.size());
  std::vector<std::array<std::size_t, 2>> jobs;
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    const double share = (intervals[k].end - intervals[k].begin) * count;
    all[k].resize(std::max<std::size_t>(3, static_cast<std::size_t>(std::lround(share)) + 1));
    for (std::size_t i = 0; i < all[k].size(); ++i) jobs.push_back({k, i});
  }
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t job) {
    const auto [k, i] = jobs[job];
    const double part = static_cast<double>(i) / static_cast<double>(all[k].size() - 1);
    all[k][i] = instant(motion, k, intervals[k].begin + part * (intervals[k].end - intervals[k].begin), nullptr);
  });
  for (const std::vector<Instant>& instants : all)
    for (const Instant& at : instants) require_regular(motion, at);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k > 0 && (all[k].front().determinant < 0) != (all[k - 1].back().determinant < 0))
      throw_singular(motion, all[k].front());
    BetweenSamples(motion, all[k]).check();
  }
  return all;
}

bool are_dense(const Motion& motion, const std::vector<std::vector<Instant>>& samples) {
  constexpr double near = 0.1;                         // of the largest acceleration of the interval
  constexpr double rounding = 1e-9;                    // of the largest of all
  constexpr std::array shares = {0.190983, 0.618034};  // of the way: whatever the frequency, some are off its zeros
  const std::size_t size = motion.model.mechanism.coordinates.size();
  std::vector<std::vector<std::array<double, 2>>> found;  // of the intervals and coordinates: largest, farthest
  std::vector<double> largest_of_all(size, 0.0);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    auto& of_interval = found.emplace_back(size);
    for (std::size_t i = 0; i + 1 < samples[k].size(); ++i) {
      const Instant &a = samples[k][i], &b = samples[k][i + 1];
      for (const double share : shares) {
        const std::vector<Series> between =
            coordinates_at(motion.timeline, motion.timeline.intervals[k], a.tau + share * (b.tau - a.tau));
        for (std::size_t q = 0; q < size; ++q) {
          const double at_a = a.coordinates[q].c[2], at_b = b.coordinates[q].c[2], there = between[q].c[2];
          auto& [largest, farthest] = of_interval[q];
          largest = std::max({largest, std::abs(at_a), std::abs(at_b), std::abs(there)});
          farthest = std::max(farthest, std::abs(there - (1 - share) * at_a - share * at_b));
          largest_of_all[q] = std::max(largest_of_all[q], largest);
        }
      }
    }
  }
  return std::all_of(found.begin(), found.end(), [&](const auto& of_interval) {
    for (std::size_t q = 0; q < size; ++q)
      if (of_interval[q][1] > std::max(near * of_interval[q][0], rounding * largest_of_all[q])) return false;
    return true;
  });
}

}  // namespace clearloci::numeric
