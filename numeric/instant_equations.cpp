#include "numeric/instant_equations.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/errors.hpp"
#include "numeric/wrench_rows.hpp"

namespace clearloci::numeric {

namespace {

using Rate = Taylor<1>;  ///< a value and its derivative by τ
using RateVector = std::array<Rate, 3>;

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
        inertial_(size_),
        cancelled_(Eigen::VectorXd::Zero(size_)) {}

  /// To be asked before `solve` where `roundings` are wanted.
  void know_sizes() {
    largest_acceleration_ = 0;
    for (mechanism::PointIndex p = 0; p < static_cast<int>(model_.points.size()); ++p) {
      const RateVector a = acceleration_of(point(p));
      largest_acceleration_ = std::max(*largest_acceleration_, std::hypot(a[0].value(), a[1].value(), a[2].value()));
    }
  }

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
    for (std::size_t k = 0; k < motion_.idle.unknowns.size(); ++k)
      if (motion_.idle.unknowns[k])
        for (Eigen::VectorXd* part :
             {&instant.at_rest, &instant.inertial, &instant.at_rest_rate, &instant.inertial_rate})
          (*part)(static_cast<Eigen::Index>(k)) = 0;
  }

  /// |A^-1| (|L| |U| |w| + |b|), times so much: elimination fills places where A is zero. Terms of b that cancel count
  /// with their sizes.
  Roundings roundings(const Instant& instant) const {
    constexpr double rounding = 1e-13;
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(A_);
    const Eigen::MatrixXd inverse = lu.inverse().cwiseAbs();
    const Eigen::MatrixXd lower = lu.matrixLU().triangularView<Eigen::UnitLower>(),
                          upper = lu.matrixLU().triangularView<Eigen::Upper>();
    const Eigen::MatrixXd size = lu.permutationP().transpose() * (lower.cwiseAbs() * upper.cwiseAbs());
    const auto of = [&](const Eigen::VectorXd& values, const Eigen::VectorXd& right) -> Eigen::VectorXd {
      return rounding * (inverse * (size * values.cwiseAbs() + right));
    };
    return {of(instant.at_rest, rest_.value.cwiseAbs()), of(instant.inertial, inertial_.value.cwiseAbs() + cancelled_)};
  }

 private:
  const mechanism::Link& link_at(mechanism::LinkIndex link) const {
    return model_.mechanism.links[static_cast<std::size_t>(link)];
  }
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
      add_inertia(link, links[i].centre_of_mass, m, inertia);
    }
    for (const PlacedMass& body : motion_.point_masses) add_inertia(body.link, body.at, body.mass, 0);
  }

  void assemble_payloads() {
    for (const int number : interval_.carried) {
      const mechanism::Payload& payload = motion_.timeline.trajectory.payloads[static_cast<std::size_t>(number)];
      const double m = core::to_double(payload.mass);
      add_inertia(payload.link, payload.at, m, core::to_double(payload.inertia));
      if (!model_.gravity) continue;
      add(rest_, payload.link, payload.at, times(m, truncated<1>(vector(*model_.gravity))), {}, -1);
    }
  }

  /// `inertia`: about the centre, or that of a slender rod.
  void add_inertia(mechanism::LinkIndex link, mechanism::PointIndex centre, double m, double inertia) {
    const RateVector turning = inertia == slender_rod ? rod(link_at(link), m) : turned(link, inertia);
    add(inertial_, link, centre, times(m, acceleration_of(point(centre))), turning, 1);
    if (largest_acceleration_) add_size(link, centre, m, size_of_turning(link, m, inertia));
  }

  /// With the largest acceleration of all points: that of one may be the sum of terms of that size.
  void add_size(mechanism::LinkIndex link, mechanism::PointIndex centre, double m, double turning) {
    const double force = m * *largest_acceleration_;
    const double moment = force * values_of(between(model_.mechanism.end_effector_point, centre)).norm();
    for (std::size_t c = 0; c < rows_of_wrench_.size(); ++c)
      cancelled_(row_of(link, c)) += rows_of_wrench_[c] < 3 ? force : turning + moment;
  }

  double size_of_turning(mechanism::LinkIndex link, double m, double inertia) const {
    if (inertia == slender_rod) {
      const auto& points = link_at(link).points;
      return m / 12 * *largest_acceleration_ * values_of(between(points.at(0), points.at(1))).norm();
    }
    if (inertia == 0) return 0;
    // Along an axis: its own derivatives. Between points: theirs, which may cancel.
    const auto size = [&](const PointSeries& r, bool is_axis) {
      const double length = values_of(r).norm(), rate = Vector3d(r[0].c[1], r[1].c[1], r[2].c[1]).norm() / length;
      const RateVector second = acceleration_of(r);
      const Vector3d own(second[0].value(), second[1].value(), second[2].value());
      return (is_axis ? own.norm() : *largest_acceleration_) / length + rate * rate;
    };
    if (model_.mechanism.space == mechanism::Space::planar)
      return inertia * size(direction_in_plane(link), motion_.guide[static_cast<std::size_t>(link)] >= 0);
    if (motion_.still[static_cast<std::size_t>(link)]) return 0;
    double most = 0;
    for (const BodyDirection& direction : motion_.directions[static_cast<std::size_t>(link)])
      most = std::max(most, size(series_of(direction), direction.axis.has_value()));
    return inertia * most;
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
  std::optional<double> largest_acceleration_;  ///< of the points; where sizes are asked for
  Eigen::VectorXd cancelled_;                   ///< sizes of the terms of the inertial column
};
}  // namespace

void refuse_rotation(const mechanism::Link& link) {
  throw core::InputError(link.where, "link " + link.name + " has inertia, but its points do not show its rotation",
                         "name more points of it, or write its mass as point masses");
}

void solve_equations(const Motion& motion, const Interval& stretch, const std::vector<Series>& registers,
                     Instant& instant, Roundings* roundings) {
  InstantEquations equations(motion, stretch, registers);
  if (roundings != nullptr) equations.know_sizes();
  equations.solve(instant);
  if (roundings != nullptr) *roundings = equations.roundings(instant);
}

}  // namespace clearloci::numeric
