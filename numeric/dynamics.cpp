#include "numeric/dynamics.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/shown_units.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/group_solution.hpp"
#include "numeric/wrench_rows.hpp"

namespace clearloci::numeric {

namespace {

using Rate = Taylor<1>;  ///< a value and its derivative by τ
using RateVector = std::array<Rate, 3>;

constexpr double slender_rod = -1;

[[noreturn]] void refuse_rotation(const mechanism::Link& link) {
  throw core::InputError(link.where, "link " + link.name + " has inertia, but its points do not show its rotation",
                         "name more points of it, or write its mass as point masses");
}

template <int N>
std::array<Taylor<N>, 3> cross(const std::array<Taylor<N>, 3>& a, const std::array<Taylor<N>, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <int N>
std::array<Taylor<N>, 3> unit(const std::array<Taylor<N>, 3>& a) {
  const Taylor<N> length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

template <int M, int N>
std::array<Taylor<M>, 3> truncated(const std::array<Taylor<N>, 3>& a) {
  return {a[0].template truncated<M>(), a[1].template truncated<M>(), a[2].template truncated<M>()};
}

template <int N>
std::array<Taylor<N - 1>, 3> derivative(const std::array<Taylor<N>, 3>& a) {
  return {a[0].derivative(), a[1].derivative(), a[2].derivative()};
}

RateVector acceleration_of(const PointSeries& p) { return derivative(derivative(p)); }

RateVector times(double factor, const RateVector& v) { return {factor * v[0], factor * v[1], factor * v[2]}; }

Vector3d values_of(const PointSeries& v) { return {v[0].value(), v[1].value(), v[2].value()}; }

/// ω = r × r' / r² about z of a vector of the plane that turns with a link, differentiated once more.
Rate angular_acceleration(const PointSeries& r) {
  const std::array<Taylor<2>, 2> v = {r[0].derivative(), r[1].derivative()};
  const std::array<Taylor<2>, 2> arm = {r[0].truncated<2>(), r[1].truncated<2>()};
  const Taylor<2> turning = (arm[0] * v[1] - arm[1] * v[0]) / (arm[0] * arm[0] + arm[1] * arm[1]);
  return turning.derivative();
}

/// ω = ½ Σ e_i × e_i' of a frame that turns with two directions of a link, differentiated once more.
RateVector angular_acceleration(const PointSeries& a, const PointSeries& b) {
  const PointSeries e1 = unit(a), e3 = unit(cross(a, b)), e2 = cross(e3, e1);
  std::array<Taylor<2>, 3> turning{};
  for (const PointSeries& e : {e1, e2, e3}) {
    const std::array<Taylor<2>, 3> part = cross(truncated<2>(e), derivative(e));
    for (std::size_t c = 0; c < 3; ++c) turning[c] = turning[c] + 0.5 * part[c];
  }
  return derivative(turning);
}

/// A column of right-hand sides with its derivative.
struct Column {
  Eigen::VectorXd value, rate;

  explicit Column(Eigen::Index size) : value(Eigen::VectorXd::Zero(size)), rate(Eigen::VectorXd::Zero(size)) {}
  void add(Eigen::Index row, const Rate& entry, double sign = 1) {
    value(row) += sign * entry.c[0];
    rate(row) += sign * entry.c[1];
  }
};

/// The equations of one instant, put together from series.
class InstantEquations {
 public:
  InstantEquations(const Motion& motion, const Interval& interval, const std::vector<Series>& registers)
      : motion_(motion),
        model_(motion.model),
        interval_(interval),
        registers_(registers),
        rows_of_wrench_(wrench_rows(model_.mechanism.space)),
        size_(static_cast<Eigen::Index>(model_.unknowns.size())),
        A_(Eigen::MatrixXd::Zero(size_, size_)),
        A_rate_(A_),
        rest_(size_),
        inertial_(size_) {}

  void solve(Instant& instant) {
    assemble_statics();
    assemble_links();
    assemble_payloads();
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(A_);
    instant.determinant = lu.determinant();
    instant.at_rest = lu.solve(rest_.value);
    instant.inertial = lu.solve(inertial_.value);
    // A w = b  =>  A w' = b' - A' w
    instant.at_rest_rate = lu.solve(rest_.rate - A_rate_ * instant.at_rest);
    instant.inertial_rate = lu.solve(inertial_.rate - A_rate_ * instant.inertial);
    instant.influence = lu.solve(unit_wrenches_on_the_end_effector()).transpose();
  }

 private:
  const Series& at(Register r) const { return registers_[static_cast<std::size_t>(r)]; }
  PointSeries vector(const Triple& v) const { return {at(v[0]), at(v[1]), at(v[2])}; }
  PointSeries point(mechanism::PointIndex p) const { return vector(model_.points[static_cast<std::size_t>(p)]); }
  PointSeries between(mechanism::PointIndex p, mechanism::PointIndex q) const {
    const PointSeries a = point(p), b = point(q);
    return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  }
  RateVector arm(mechanism::PointIndex p) const {
    return truncated<1>(between(model_.mechanism.end_effector_point, p));
  }
  Eigen::Index row_of(mechanism::LinkIndex link, std::size_t component) const {
    const std::size_t first = rows_of_wrench_.size() * static_cast<std::size_t>(link);
    return static_cast<Eigen::Index>(model_.link_rows[first + component]);
  }

  /// A, and the loads in its last column.
  void assemble_statics() {
    const SparseEquations& equations = model_.equations;
    for (std::size_t r = 0; r < equations.rows.size(); ++r) {
      const auto row = static_cast<Eigen::Index>(r);
      for (const auto& [column, value] : equations.rows[r]) {
        const Rate entry = at(value).truncated<1>();
        if (column == equations.unknowns) {
          rest_.add(row, entry);
        } else {
          A_(row, column) = entry.c[0];
          A_rate_(row, column) = entry.c[1];
        }
      }
    }
  }

  Eigen::MatrixXd unit_wrenches_on_the_end_effector() const {
    const mechanism::Mechanism& m = model_.mechanism;
    Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(size_, static_cast<Eigen::Index>(rows_of_wrench_.size()));
    for (std::size_t c = 0; c < rows_of_wrench_.size(); ++c) {
      wrenches(row_of(m.end_effector_link, c), static_cast<Eigen::Index>(c)) += 1;
      if (m.relative_to != mechanism::ground) wrenches(row_of(m.relative_to, c), static_cast<Eigen::Index>(c)) -= 1;
    }
    return wrenches;
  }

  /// A force at a point and a couple on a link; the moment is about the end-effector point.
  void add(Column& column, mechanism::LinkIndex link, mechanism::PointIndex where, const RateVector& force,
           const RateVector& couple, double sign) const {
    const RateVector moment = cross(arm(where), force);
    for (std::size_t c = 0; c < rows_of_wrench_.size(); ++c) {
      const auto k = static_cast<std::size_t>(rows_of_wrench_[c]);
      column.add(row_of(link, c), k < 3 ? force[k] : couple[k - 3] + moment[k - 3], sign);
    }
  }

  void assemble_links() {
    const auto& links = model_.mechanism.links;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const auto link = static_cast<mechanism::LinkIndex>(i);
      const double m = motion_.mass[i], inertia = motion_.inertia[i];
      if (m == 0 && inertia <= 0) continue;
      add_inertia(link, links[i].centre_of_mass, m, inertia == slender_rod ? rod(links[i], m) : turned(link, inertia));
    }
    for (const PlacedMass& body : motion_.point_masses) add_inertia(body.link, body.at, body.mass, {});
  }

  void assemble_payloads() {
    for (const int number : interval_.carried) {
      const mechanism::Payload& payload = motion_.timeline.trajectory.payloads[static_cast<std::size_t>(number)];
      const double m = core::to_double(payload.mass);
      add_inertia(payload.link, payload.at, m, turned(payload.link, core::to_double(payload.inertia)));
      if (!model_.gravity) continue;
      add(rest_, payload.link, payload.at, times(m, truncated<1>(vector(*model_.gravity))), {}, -1);
    }
  }

  void add_inertia(mechanism::LinkIndex link, mechanism::PointIndex centre, double m, const RateVector& turning) {
    add(inertial_, link, centre, times(m, acceleration_of(point(centre))), turning, 1);
  }

  /// m/12 r × r'' of a slender rod between a link's first two points.
  RateVector rod(const mechanism::Link& link, double m) const {
    const PointSeries r = between(link.points.at(0), link.points.at(1));
    return times(m / 12, cross(truncated<1>(r), acceleration_of(r)));
  }

  /// I α.
  RateVector turned(mechanism::LinkIndex link, double inertia) const {
    if (inertia == 0) return {};
    if (model_.mechanism.space == mechanism::Space::planar)
      return {Rate(), Rate(), inertia * angular_acceleration(direction_in_plane(link))};
    if (motion_.still[static_cast<std::size_t>(link)]) return {};
    const auto [a, b] = two_directions(link);
    return times(inertia, angular_acceleration(a, b));
  }

  /// From its first point to its second one, or along the guide that it turns with.
  PointSeries direction_in_plane(mechanism::LinkIndex link) const {
    const mechanism::JointIndex guide = motion_.guide[static_cast<std::size_t>(link)];
    if (guide >= 0) return vector(*model_.axes[static_cast<std::size_t>(guide)]);
    const auto& points = model_.mechanism.links[static_cast<std::size_t>(link)].points;
    return between(points.at(0), points.at(1));
  }

  PointSeries series_of(const BodyDirection& direction) const {
    return direction.axis ? vector(*direction.axis) : between(direction.from, direction.to);
  }

  /// The first two that are well apart, else those that are farthest apart.
  std::array<PointSeries, 2> two_directions(mechanism::LinkIndex link) const {
    constexpr double well = 0.1, hardly = 1e-6;  // sines
    const std::vector<BodyDirection>& all = motion_.directions[static_cast<std::size_t>(link)];
    double best = hardly;
    std::optional<std::array<PointSeries, 2>> found;
    for (std::size_t i = 0; i < all.size() && best < well; ++i)
      for (std::size_t k = i + 1; k < all.size() && best < well; ++k) {
        const PointSeries a = series_of(all[i]), b = series_of(all[k]);
        const Vector3d u = values_of(a), v = values_of(b);
        const double sine = u.cross(v).norm() / (u.norm() * v.norm());
        if (!(sine > best)) continue;
        best = sine;
        found = {a, b};
      }
    if (!found) refuse_rotation(model_.mechanism.links[static_cast<std::size_t>(link)]);
    return *found;
  }

  const Motion& motion_;
  const NumericModel& model_;
  const Interval& interval_;
  const std::vector<Series>& registers_;
  const std::vector<Eigen::Index>& rows_of_wrench_;
  Eigen::Index size_;
  Eigen::MatrixXd A_, A_rate_;
  Column rest_, inertial_;
};

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
  const auto found = std::find_if(mechanism.joints.begin(), mechanism.joints.end(), [&](const mechanism::Joint& joint) {
    return mechanism::traits(joint).slides && !mechanism::is_slot(mechanism, joint) && !mechanism::is_cable(joint) &&
           (joint.from == link || joint.to == link);
  });
  return found == mechanism.joints.end() ? -1 : static_cast<mechanism::JointIndex>(found - mechanism.joints.begin());
}

/// The links that turn with a link, which guides hold to it; itself first.
std::vector<mechanism::LinkIndex> turning_with(const mechanism::Mechanism& m, mechanism::LinkIndex link) {
  std::vector<mechanism::LinkIndex> all = {link};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const mechanism::Joint& joint : m.joints) {
      if (joint.type != mechanism::JointType::prismatic || (joint.from != all[i] && joint.to != all[i])) continue;
      const mechanism::LinkIndex other = joint.from == all[i] ? joint.to : joint.from;
      if (std::find(all.begin(), all.end(), other) == all.end()) all.push_back(other);
    }
  return all;
}

/// Points first, then axes along which it slides, then the others.
std::vector<BodyDirection> directions_of(const NumericModel& model, const std::vector<mechanism::LinkIndex>& links) {
  const mechanism::Mechanism& m = model.mechanism;
  const auto holds = [&](mechanism::LinkIndex link) {
    return std::find(links.begin(), links.end(), link) != links.end();
  };
  std::vector<BodyDirection> all;
  for (const mechanism::LinkIndex link : links) {
    if (link == mechanism::ground) continue;
    const std::vector<mechanism::PointIndex>& points = m.links[static_cast<std::size_t>(link)].points;
    for (std::size_t k = 1; k < points.size(); ++k) all.push_back({points[0], points[k]});
  }
  for (const bool slides : {true, false})
    for (std::size_t j = 0; j < m.joints.size(); ++j) {
      const mechanism::Joint& joint = m.joints[j];
      if (mechanism::traits(joint).slides != slides || mechanism::holds_idle_freedom(joint)) continue;
      // Lines of action and of cables turn by themselves.
      if (mechanism::traits(joint).meshes || mechanism::is_cable(joint)) continue;
      // Not fixed in `to`, which turns against it.
      const bool crossed = joint.type == mechanism::JointType::universal || mechanism::is_slot(m, joint);
      if (model.axes[j] && (holds(joint.from) || (holds(joint.to) && !crossed))) all.push_back({0, 0, model.axes[j]});
      if (crossed && model.second_axes[j] && holds(joint.to)) all.push_back({0, 0, model.second_axes[j]});
    }
  return all;
}

Motion motion_of(const mechanism::Mechanism& mechanism, Timeline timeline, std::vector<int> mode) {
  Motion motion;
  motion.model = compile(mechanism);
  motion.mode = std::move(mode);
  motion.timeline = std::move(timeline);
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
  const bool planar = mechanism.space == mechanism::Space::planar;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const std::vector<mechanism::LinkIndex> links = turning_with(mechanism, static_cast<mechanism::LinkIndex>(i));
    motion.directions.push_back(directions_of(motion.model, links));
    motion.still.push_back(std::find(links.begin(), links.end(), mechanism::ground) != links.end());
    const bool shown = planar ? mechanism.links[i].points.size() > 1 || motion.guide[i] >= 0
                              : motion.still.back() || motion.directions.back().size() > 1;
    if (turns[i] && !shown) refuse_rotation(mechanism.links[i]);
  }
  motion.columns = joint_columns(motion.model);
  motion.clearances = joint_clearances(mechanism);
  return motion;
}

/// Places, and the equations there, of coordinates that are known.
void solve_at(const Motion& motion, const Interval& stretch, Instant& result) {
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
  for (const Triple& point : model.points) {
    result.points.push_back(vector(point));
    for (const Series& s : result.points.back())
      for (const double c : s.c) result.reachable = result.reachable && std::isfinite(c);
  }
  for (std::size_t i = 0; i < model.slack.size() && result.reachable; ++i)
    for (const bool upper : {false, true})
      if (const auto& end = model.slack[i][upper ? 1 : 0];
          end && !(registers[static_cast<std::size_t>(*end)].value() >= 0) && !result.broken)
        result.broken = LimitEnd{i, upper, registers[static_cast<std::size_t>(*end)].value()};
  result.reachable = result.reachable && !result.broken;
  for (const auto& axis : model.axes) {
    const PointSeries u = axis ? vector(*axis) : PointSeries{};
    result.axes.push_back(values_of(u));
    result.axes_rate.emplace_back(u[0].c[1], u[1].c[1], u[2].c[1]);
  }
  for (const auto& axis : model.couple_axes)
    result.couple_axes.push_back(axis ? values_of(vector(*axis)) : Vector3d::Zero());
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

std::vector<JointReaction> joint_reactions(const Motion& motion, const Instant& at, const Eigen::VectorXd& values) {
  const NumericModel& model = motion.model;
  std::vector<JointReaction> all =
      joint_reactions(at.axes.size(), unknown_columns(model, at.axes, at.couple_axes), values);
  if (model.mechanism.space == mechanism::Space::planar) return all;
  // The whole force and couple of equations.hpp hold the actuator's share.
  for (std::size_t j = 0; j < all.size(); ++j) {
    Vector3d& whole = mechanism::traits(model.mechanism.joints[j]).slides ? all[j].force : all[j].couple;
    whole -= all[j].actuator * at.axes[j];
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
