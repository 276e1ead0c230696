#include "numeric/dynamics.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/wrench_rows.hpp"

namespace clearloci::numeric {

namespace {

using Rate = Taylor<1>;  ///< a value and its derivative by τ
using RatePoint = std::array<Rate, 2>;

constexpr double slender_rod = -1;

RatePoint rate_of(const PointSeries& p) { return {p[0].truncated<1>(), p[1].truncated<1>()}; }

RatePoint acceleration_of(const PointSeries& p) {
  return {p[0].derivative().derivative(), p[1].derivative().derivative()};
}

Rate cross(const RatePoint& a, const RatePoint& b) { return a[0] * b[1] - a[1] * b[0]; }

/// ω = r × r' / r² of a vector that turns with a link, differentiated once more.
Rate angular_acceleration(const PointSeries& r) {
  const std::array<Taylor<2>, 2> v = {r[0].derivative(), r[1].derivative()};
  const std::array<Taylor<2>, 2> arm = {r[0].truncated<2>(), r[1].truncated<2>()};
  const Taylor<2> turning = (arm[0] * v[1] - arm[1] * v[0]) / (arm[0] * arm[0] + arm[1] * arm[1]);
  return turning.derivative();
}

/// A column of right-hand sides with its derivative.
struct Column {
  Eigen::VectorXd value, rate;

  explicit Column(Eigen::Index size) : value(Eigen::VectorXd::Zero(size)), rate(Eigen::VectorXd::Zero(size)) {}
  void add(Eigen::Index row, const Rate& entry, double sign = 1) {
    value(row) += sign * entry.c[0];
    rate(row) += sign * entry.c[1];
  }
  /// A force at a point and a couple on a link; the moment is about the end-effector point.
  void add(mechanism::LinkIndex link, const RatePoint& arm, const RatePoint& force, const Rate& couple, double sign) {
    add(3 * link, force[0], sign);
    add(3 * link + 1, force[1], sign);
    add(3 * link + 2, couple + cross(arm, force), sign);
  }
};

/// The equations of one instant, put together from series.
class InstantEquations {
 public:
  InstantEquations(const Motion& motion, const Interval& interval, const std::vector<Series>& registers)
      : motion_(motion),
        interval_(interval),
        registers_(registers),
        size_(static_cast<Eigen::Index>(motion.model.unknowns.size())),
        A_(Eigen::MatrixXd::Zero(size_, size_)),
        A_rate_(A_),
        rest_(size_),
        inertial_(size_) {}

  void solve(Instant& instant) {
    assemble_matrix();
    assemble_loads();
    assemble_links();
    assemble_payloads();
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(A_);
    instant.determinant = lu.determinant();
    instant.at_rest = lu.solve(rest_.value);
    instant.inertial = lu.solve(inertial_.value);
    // A w = b  =>  A w' = b' - A' w
    instant.at_rest_rate = lu.solve(rest_.rate - A_rate_ * instant.at_rest);
    instant.inertial_rate = lu.solve(inertial_.rate - A_rate_ * instant.inertial);
    instant.influence = lu.solve(unit_wrenches(motion_.model.mechanism, size_)).transpose();
  }

 private:
  Series at(Register r) const { return registers_[static_cast<std::size_t>(r)]; }
  PointSeries point(mechanism::PointIndex p) const {
    const auto& [x, y, z] = motion_.model.points[static_cast<std::size_t>(p)];
    return {at(x), at(y)};
  }
  RatePoint arm(mechanism::PointIndex p) const {
    const RatePoint a = rate_of(point(p)), e = rate_of(point(motion_.model.mechanism.end_effector_point));
    return {a[0] - e[0], a[1] - e[1]};
  }

  void assemble_matrix() {
    for (Eigen::Index column = 0; column < size_; ++column) {
      const mechanism::Unknown& unknown = motion_.model.unknowns[static_cast<std::size_t>(column)];
      const mechanism::Joint& joint = motion_.model.mechanism.joints[static_cast<std::size_t>(unknown.joint)];
      const std::optional<RatePoint> force = unit_force(unknown);
      const Rate moment = force ? cross(arm(joint.at), *force) : Rate(1);
      for (const int sign : {1, -1}) {
        const mechanism::LinkIndex link = sign > 0 ? joint.to : joint.from;
        if (link == mechanism::ground) continue;
        const std::array<Rate, 3> wrench = {force ? (*force)[0] : Rate(), force ? (*force)[1] : Rate(), moment};
        for (Eigen::Index row = 0; row < 3; ++row) {
          A_(3 * link + row, column) += sign * wrench[static_cast<std::size_t>(row)].c[0];
          A_rate_(3 * link + row, column) += sign * wrench[static_cast<std::size_t>(row)].c[1];
        }
      }
    }
  }

  /// The force of a unit of an unknown; none of a couple.
  std::optional<RatePoint> unit_force(const mechanism::Unknown& unknown) const {
    const auto axis = [&] {
      const auto& [x, y, z] = *motion_.model.axes[static_cast<std::size_t>(unknown.joint)];
      return RatePoint{at(x).truncated<1>(), at(y).truncated<1>()};
    };
    switch (unknown.quantity) {
      case core::Quantity::fx:
        return RatePoint{Rate(1), Rate()};
      case core::Quantity::fy:
        return RatePoint{Rate(), Rate(1)};
      case core::Quantity::N:
        return RatePoint{-axis()[1], axis()[0]};
      case core::Quantity::F:
        return axis();
      default:
        return std::nullopt;
    }
  }

  void assemble_loads() {
    for (const LoadRegisters& load : motion_.model.loads) {
      const RatePoint force = {at(load.force[0]).truncated<1>(), at(load.force[1]).truncated<1>()};
      rest_.add(load.link, load.at ? arm(*load.at) : RatePoint{}, force, at(load.couple[2]).truncated<1>(), -1);
    }
  }

  void assemble_links() {
    const auto& links = motion_.model.mechanism.links;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const double m = motion_.mass[i];
      double inertia = motion_.inertia[i];
      if (inertia == slender_rod) {
        const PointSeries p = point(links[i].points[0]), q = point(links[i].points[1]);
        const double x = q[0].value() - p[0].value(), y = q[1].value() - p[1].value();
        inertia = m * (x * x + y * y) / 12;
      }
      add_inertia(static_cast<int>(i), links[i].centre_of_mass, m, inertia);
    }
    for (const PlacedMass& body : motion_.point_masses) add_inertia(body.link, body.at, body.mass, 0);
  }

  void assemble_payloads() {
    for (const int number : interval_.carried) {
      const mechanism::Payload& payload = motion_.timeline.trajectory.payloads[static_cast<std::size_t>(number)];
      const double m = core::to_double(payload.mass);
      add_inertia(payload.link, payload.at, m, core::to_double(payload.inertia));
      if (!motion_.model.gravity) continue;
      const auto& [gx, gy, gz] = *motion_.model.gravity;
      const RatePoint weight = {m * at(gx).truncated<1>(), m * at(gy).truncated<1>()};
      rest_.add(payload.link, arm(payload.at), weight, Rate(), -1);
    }
  }

  void add_inertia(mechanism::LinkIndex link, mechanism::PointIndex centre, double m, double inertia) {
    if (m == 0 && inertia == 0) return;
    const RatePoint a = acceleration_of(point(centre));
    const Rate turning = inertia == 0 ? Rate() : inertia * angular_acceleration(direction(link));
    inertial_.add(link, arm(centre), {m * a[0], m * a[1]}, turning, 1);
  }

  /// From its first point to its second one, or along the guide that it turns with.
  PointSeries direction(mechanism::LinkIndex link) const {
    const mechanism::JointIndex guide = motion_.guide[static_cast<std::size_t>(link)];
    if (guide >= 0) {
      const auto& [x, y, z] = *motion_.model.axes[static_cast<std::size_t>(guide)];
      return {at(x), at(y)};
    }
    const auto& points = motion_.model.mechanism.links[static_cast<std::size_t>(link)].points;
    const PointSeries p = point(points.at(0)), q = point(points.at(1));
    return {q[0] - p[0], q[1] - p[1]};
  }

  const Motion& motion_;
  const Interval& interval_;
  const std::vector<Series>& registers_;
  Eigen::Index size_;
  Eigen::MatrixXd A_, A_rate_;
  Column rest_, inertial_;
};

std::string place_words(const Motion& motion, const Instant& at) {
  std::string text;
  for (std::size_t c = 0; c < at.coordinates.size(); ++c) {
    char value[40];
    std::snprintf(value, sizeof value, "%.6g", at.coordinates[c].value());
    text += (c == 0 ? "" : ", ") + motion.model.mechanism.coordinates[c].name + " = " + value;
  }
  return text;
}

void check_instants(const Motion& motion, const std::vector<std::vector<Instant>>& all) {
  const std::string& file = motion.timeline.trajectory.file;
  const Instant* before = nullptr;
  for (const auto& instants : all) {
    for (const Instant& at : instants) {
      if (at.broken) {
        const mechanism::Mechanism& m = motion.model.mechanism;
        throw core::InputError({file, 0, 0},
                               "the path is beyond the limit of the " +
                                   mechanism::words_of_end(m, at.broken->limit, at.broken->upper) + ", at " +
                                   place_words(motion, at),
                               "move the waypoints, or choose another working mode");
      }
      if (!at.reachable)
        throw core::InputError({file, 0, 0},
                               "the path leaves the workspace, or touches its boundary, at " + place_words(motion, at),
                               "move the waypoints, or choose another working mode");
      const bool crossed = before != nullptr && (before->determinant < 0) != (at.determinant < 0);
      if (crossed || at.determinant == 0 || !at.at_rest.allFinite() || !at.inertial.allFinite())
        throw core::InputError({file, 0, 0}, "the path meets a direct singularity near " + place_words(motion, at),
                               "move the waypoints, or choose another working mode");
      before = &at;
    }
  }
}

}  // namespace

namespace {

/// The guide in which a link with a single point turns: an axis of a prismatic joint is fixed in both of its links.
mechanism::JointIndex guide_of(const mechanism::Mechanism& mechanism, mechanism::LinkIndex link) {
  if (mechanism.links[static_cast<std::size_t>(link)].points.size() > 1) return -1;
  const auto own = std::find_if(mechanism.joints.begin(), mechanism.joints.end(), [&](const mechanism::Joint& joint) {
    return mechanism::traits(joint).slides && (joint.from == link || joint.to == link);
  });
  return own == mechanism.joints.end() ? -1 : static_cast<mechanism::JointIndex>(own - mechanism.joints.begin());
}

Motion motion_of(const mechanism::Mechanism& mechanism, Timeline timeline, std::vector<int> mode) {
  if (mechanism.space != mechanism::Space::planar)
    throw core::InputError({mechanism.file, 0, 0}, "the mechanism is spatial, and trajectories are those of the plane",
                           "solve single poses of it with clearloci pose");
  Motion motion{compile(mechanism), std::move(mode), std::move(timeline), {}, {}, {}, {}, {}, {}};
  core::ensure(motion.mode.size() == motion.model.dyads.size(), "a working mode has one sign for each dyad");
  std::vector<bool> turns(mechanism.links.size(), false);
  for (const mechanism::Link& link : mechanism.links) {
    motion.mass.push_back(core::to_double(mechanism::value_of(link.mass, mechanism)));
    motion.inertia.push_back(link.inertia ? core::to_double(mechanism::value_of(*link.inertia, mechanism))
                                          : slender_rod);
    motion.guide.push_back(guide_of(mechanism, static_cast<int>(motion.guide.size())));
    turns[motion.mass.size() - 1] = link.inertia ? motion.inertia.back() > 0 : false;
  }
  for (std::size_t i = 0; i < mechanism.links.size(); ++i)
    for (const mechanism::PointMass& point : mechanism.links[i].masses)
      motion.point_masses.push_back({static_cast<mechanism::LinkIndex>(i), point.at,
                                     core::to_double(mechanism::value_of(point.mass, mechanism))});
  for (const mechanism::Payload& payload : motion.timeline.trajectory.payloads)
    if (payload.inertia > 0) turns[static_cast<std::size_t>(payload.link)] = true;
  for (std::size_t i = 0; i < turns.size(); ++i)
    if (turns[i] && mechanism.links[i].points.size() < 2 && motion.guide[i] < 0)
      throw core::InputError(
          mechanism.links[i].where,
          "link " + mechanism.links[i].name + " has inertia but a single point, so its rotation is unknown",
          "name a second point of it");
  motion.columns = joint_columns(motion.model);
  motion.clearances = joint_clearances(mechanism);
  return motion;
}

/// Places, and the equations there, of coordinates that are known.
void solve_at(const Motion& motion, const Interval& stretch, Instant& result) {
  const NumericModel& model = motion.model;
  std::vector<Series> inputs = result.coordinates;
  for (const int sign : motion.mode) inputs.emplace_back(sign);
  std::vector<Series> registers(static_cast<std::size_t>(model.posture_size));
  run<Series, 1>(model.tape, 0, model.posture_size, inputs.data(), registers.data());
  result.reachable = true;
  for (const auto& [x, y, z] : model.points) {
    result.points.push_back({registers[static_cast<std::size_t>(x)], registers[static_cast<std::size_t>(y)]});
    for (const Series& s : result.points.back())
      for (const double c : s.c) result.reachable = result.reachable && std::isfinite(c);
  }
  for (std::size_t i = 0; i < model.slack.size(); ++i)
    for (const bool upper : {false, true})
      if (const auto& end = model.slack[i][upper ? 1 : 0];
          end && !(registers[static_cast<std::size_t>(*end)].value() >= 0) && !result.broken)
        result.broken = LimitEnd{i, upper, registers[static_cast<std::size_t>(*end)].value()};
  result.reachable = result.reachable && !result.broken;
  for (const auto& axis : model.axes) {
    Vector3d& u = result.axes.emplace_back(Vector3d::Zero());
    for (std::size_t c = 0; axis && c < 3; ++c)
      u[static_cast<Eigen::Index>(c)] = registers[static_cast<std::size_t>((*axis)[c])].value();
  }
  if (result.reachable) InstantEquations(motion, stretch, registers).solve(result);
}

}  // namespace

Motion compile_motion(const mechanism::Mechanism& mechanism, const mechanism::Trajectory& trajectory,
                      std::vector<int> mode) {
  return motion_of(mechanism, compile_timeline(trajectory, mechanism), std::move(mode));
}

Motion compile_motion(const mechanism::Mechanism& mechanism, std::vector<int> mode) {
  return motion_of(mechanism, {}, std::move(mode));
}

Instant instant_of(const Motion& motion, const std::vector<Series>& coordinates) {
  Instant result;
  result.coordinates = coordinates;
  solve_at(motion, {}, result);
  return result;
}

Instant instant(const Motion& motion, std::size_t interval, double tau) {
  const Interval& stretch = motion.timeline.intervals[interval];
  Instant result;
  result.tau = tau;
  result.interval = interval;
  result.distance = distance_at(motion.timeline, stretch, tau);
  result.coordinates = coordinates_at(motion.timeline, stretch, tau);
  solve_at(motion, stretch, result);
  return result;
}

InstantError instant_error(const Motion& motion, const Instant& at, double period) {
  InstantError result;
  const mechanism::Mechanism& m = motion.model.mechanism;
  const std::vector<ReactionColumn> columns =
      reaction_columns(m, at.axes, std::vector<Vector3d>(at.axes.size(), Vector3d::Zero()));
  result.contacts = joint_contacts(m, at.axes);
  result.take_up = take_up(result.contacts, joint_reactions(at.axes.size(), columns, at.reactions(period)));
  if (undefined_take_up(m, result.contacts, result.take_up).empty()) {
    result.error = pose_error(m.space, at.influence, clearance_displacements(columns, result.take_up));
  } else {
    const Vector3d none = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    result.error = {none, none};
  }
  return result;
}

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
    all[k][i] = instant(motion, k, intervals[k].begin + part * (intervals[k].end - intervals[k].begin));
  });
  check_instants(motion, all);
  return all;
}

}  // namespace clearloci::numeric
