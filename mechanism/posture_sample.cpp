#include "mechanism/posture_sample.hpp"

#include <cmath>
#include <map>
#include <numbers>

namespace clearloci::mechanism {
namespace {

using Vector = std::array<double, 2>;
using Values = std::map<std::string, double>;
using MaybePoints = std::vector<std::optional<Vector>>;

double value_at(const Expression& expression, const Values& values) {
  using Kind = Expression::Kind;
  const auto argument = [&](std::size_t index) { return value_at(expression.arguments()[index], values); };
  switch (expression.kind()) {
    case Kind::number:
      return core::to_double(expression.value());
    case Kind::symbol:
      return values.at(expression.name());
    case Kind::pi:
      return std::numbers::pi;
    case Kind::add:
      return argument(0) + argument(1);
    case Kind::multiply:
      return argument(0) * argument(1);
    case Kind::divide:
      return argument(0) / argument(1);
    case Kind::power:
      return std::pow(argument(0), argument(1));
    case Kind::negate:
      return -argument(0);
    case Kind::sqrt:
      return std::sqrt(argument(0));
    case Kind::cos:
      return std::cos(argument(0));
    case Kind::sin:
      return std::sin(argument(0));
  }
  return 0;
}

class Placement {
 public:
  Placement(const MaybePoints& points, const Values& values) : points_(points), values_(values) {}

  std::optional<Vector> operator()(const ExplicitPoint& point) const {
    return Vector{value_at(point.coordinates[0], values_), value_at(point.coordinates[1], values_)};
  }

  /// method.md section 1: B = A + (k (P - A) +- s J (P - A)) / (2 D).
  std::optional<Vector> operator()(const DyadPoint& point) const {
    const auto bases = frame(point.from, point.to);
    if (!bases) return std::nullopt;
    const auto& [base, along] = *bases;
    const double a = value_at(point.from_length, values_);
    const double b = value_at(point.to_length, values_);
    const double d = along[0] * along[0] + along[1] * along[1];
    const double k = a * a - b * b + d;
    const double q = 4 * a * a * d - k * k;
    if (!(q > 0)) return std::nullopt;
    const double s = point.side == Side::left ? std::sqrt(q) : -std::sqrt(q);
    return Vector{base[0] + (k * along[0] - s * along[1]) / (2 * d), base[1] + (k * along[1] + s * along[0]) / (2 * d)};
  }

  std::optional<Vector> operator()(const OffsetPoint& point) const {
    const auto bases = frame(point.first, point.second);
    if (!bases) return std::nullopt;
    const auto& [base, along] = *bases;
    const double length = std::hypot(along[0], along[1]);
    if (!(length > 0)) return std::nullopt;
    const double u = value_at(point.along, values_) / length;
    const double v = value_at(point.left, values_) / length;
    return Vector{base[0] + u * along[0] - v * along[1], base[1] + u * along[1] + v * along[0]};
  }

  std::optional<Vector> operator()(const MeanPoint& point) const {
    const auto bases = frame(point.first, point.second);
    if (!bases) return std::nullopt;
    const auto& [base, along] = *bases;
    return Vector{base[0] + along[0] / 2, base[1] + along[1] / 2};
  }

 private:
  /// The first point and the vector to the second.
  std::optional<std::pair<Vector, Vector>> frame(PointIndex first, PointIndex second) const {
    const auto& p = points_[static_cast<std::size_t>(first)];
    const auto& q = points_[static_cast<std::size_t>(second)];
    if (!p || !q) return std::nullopt;
    return std::pair{*p, Vector{(*q)[0] - (*p)[0], (*q)[1] - (*p)[1]}};
  }

  const MaybePoints& points_;
  const Values& values_;
};

/// The i-th number of van der Corput's sequence: the digits of i mirrored at the point, spread evenly over (0, 1).
double van_der_corput(unsigned i, unsigned base) {
  double result = 0;
  for (double place = 1.0 / base; i > 0; i /= base, place /= base) result += place * (i % base);
  return result;
}

}  // namespace

std::vector<std::vector<double>> spread_poses(const Mechanism& mechanism, std::size_t count) {
  constexpr std::array<unsigned, 3> base = {2, 3, 5};
  std::vector<std::vector<double>> poses(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (const Coordinate& coordinate : mechanism.coordinates) {
      const double lower = core::to_double(coordinate.lower);
      const double upper = core::to_double(coordinate.upper);
      const double part = van_der_corput(static_cast<unsigned>(i) + 1, base[poses[i].size()]);
      poses[i].push_back(lower + (upper - lower) * part);
    }
  }
  return poses;
}

MaybePoints sample_points(const Mechanism& mechanism, const std::vector<double>& pose) {
  Values values;
  for (const Parameter& parameter : mechanism.parameters) values[parameter.name] = core::to_double(parameter.value);
  for (std::size_t i = 0; i < pose.size(); ++i) values[mechanism.coordinates[i].name] = pose[i];
  MaybePoints points;
  for (const Point& point : mechanism.points) points.push_back(std::visit(Placement(points, values), point.form));
  return points;
}

std::vector<PosturePoints> sample_postures(const Mechanism& mechanism, std::size_t count) {
  constexpr std::size_t tries = 4096;
  std::vector<PosturePoints> postures;
  for (const std::vector<double>& pose : spread_poses(mechanism, tries)) {
    if (postures.size() == count) break;
    PosturePoints posture;
    for (const std::optional<Vector>& point : sample_points(mechanism, pose))
      if (point) posture.push_back(*point);
    if (posture.size() == mechanism.points.size()) postures.push_back(std::move(posture));
  }
  return postures;
}

}  // namespace clearloci::mechanism
