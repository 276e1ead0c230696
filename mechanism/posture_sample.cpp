#include "mechanism/posture_sample.hpp"

#include <cmath>
#include <map>
#include <numbers>

namespace clearloci::mechanism {
namespace {

using Vector = std::array<double, 3>;
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

Vector difference(const Vector& p, const Vector& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
Vector cross(const Vector& p, const Vector& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
double dot(const Vector& p, const Vector& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
Vector operator*(double a, const Vector& p) { return {a * p[0], a * p[1], a * p[2]}; }
Vector operator+(const Vector& p, const Vector& q) { return {p[0] + q[0], p[1] + q[1], p[2] + q[2]}; }
/// p + a q + b J q, J turning the plane a quarter to the left.
Vector moved(const Vector& p, const Vector& q, double a, double b) {
  return {p[0] + a * q[0] - b * q[1], p[1] + a * q[1] + b * q[0], p[2] + a * q[2]};
}

std::optional<Vector> value_at(const VectorExpression& vector, const MaybePoints& points, const Values& values) {
  using Kind = VectorExpression::Kind;
  std::vector<Vector> arguments;
  for (const VectorExpression& argument : vector.arguments) {
    const auto value = value_at(argument, points, values);
    if (!value) return std::nullopt;
    arguments.push_back(*value);
  }
  const Vector zero{};
  switch (vector.kind) {
    case Kind::components: {
      Vector result{};
      for (std::size_t i = 0; i < vector.numbers.size(); ++i) result[i] = value_at(vector.numbers[i], values);
      return result;
    }
    case Kind::point:
      return points[static_cast<std::size_t>(vector.point)];
    case Kind::add:
      return moved(arguments[0], arguments[1], 1, 0);
    case Kind::negate:
      return moved(zero, arguments[0], -1, 0);
    case Kind::scale:
      return moved(zero, arguments[0], value_at(vector.numbers[0], values), 0);
    case Kind::cross:
      return cross(arguments[0], arguments[1]);
  }
  return std::nullopt;
}

class Placement {
 public:
  Placement(const MaybePoints& points, const Values& values) : points_(points), values_(values) {}

  std::optional<Vector> operator()(const ExplicitPoint& point) const {
    Vector place{};
    for (std::size_t i = 0; i < point.coordinates.size(); ++i) place[i] = value_at(point.coordinates[i], values_);
    return place;
  }

  /// method.md section 1: B = A + (k (P - A) +- s J (P - A)) / (2 D); in space P is brought into the plane across the
  /// axis first.
  std::optional<Vector> operator()(const DyadPoint& point) const {
    const auto bases = frame(point.from, point.to);
    const std::optional<Vector> axis =
        point.axis ? value_at(*point.axis, points_, values_) : std::optional<Vector>({0, 0, 1});
    if (!bases || !axis || !(dot(*axis, *axis) > 0)) return std::nullopt;
    const auto& [base, way] = *bases;
    const Vector n = 1 / std::sqrt(dot(*axis, *axis)) * *axis;
    const double h = dot(n, way);
    const Vector along = difference(way, h * n);
    const double a = value_at(point.from_length, values_);
    const double b = value_at(point.to_length, values_);
    const double d = dot(along, along);
    const double k = a * a - b * b + h * h + d;
    const double q = 4 * a * a * d - k * k;
    if (!(q > 0)) return std::nullopt;
    const double s = point.side == Side::left ? std::sqrt(q) : -std::sqrt(q);
    return base + k / (2 * d) * along + s / (2 * d) * cross(n, along);
  }

  std::optional<Vector> operator()(const OffsetPoint& point) const {
    const auto bases = frame(point.first, point.second);
    if (!bases) return std::nullopt;
    const auto& [base, along] = *bases;
    const double length = std::sqrt(dot(along, along));
    if (!(length > 0)) return std::nullopt;
    return moved(base, along, value_at(point.along, values_) / length, value_at(point.left, values_) / length);
  }

  std::optional<Vector> operator()(const MeanPoint& point) const {
    const auto bases = frame(point.first, point.second);
    if (!bases) return std::nullopt;
    return moved(bases->first, bases->second, 0.5, 0);
  }

  /// S = Q + (p +- s) u / U,  p = u . (C - Q), U = u . u, s^2 = l^2 U - (u x (C - Q))^2.
  std::optional<Vector> operator()(const SliderPoint& point) const {
    const auto bases = frame(point.base, point.from);
    const auto along = value_at(point.along, points_, values_);
    if (!bases || !along) return std::nullopt;
    const double u = dot(*along, *along);
    const double l = value_at(point.length, values_);
    const Vector across = cross(*along, bases->second);
    const double q = l * l * u - dot(across, across);
    if (!(u > 0) || !(q > 0)) return std::nullopt;
    const double s = point.ahead ? std::sqrt(q) : -std::sqrt(q);
    return moved(bases->first, *along, (dot(*along, bases->second) + s) / u, 0);
  }

 private:
  /// The first point and the vector to the second.
  std::optional<std::pair<Vector, Vector>> frame(PointIndex first, PointIndex second) const {
    const auto& p = points_[static_cast<std::size_t>(first)];
    const auto& q = points_[static_cast<std::size_t>(second)];
    if (!p || !q) return std::nullopt;
    return std::pair{*p, difference(*q, *p)};
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

std::vector<std::vector<double>> spread_poses(const Mechanism& mechanism, std::size_t count, std::size_t first) {
  // Open designs (open_design.hpp) have more coordinates than poses; beyond these bases they share them.
  constexpr std::array<unsigned, 12> base = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
  std::vector<std::vector<double>> poses(count);
  for (const Coordinate& coordinate : mechanism.coordinates) {
    const double lower = core::to_double(coordinate.lower), upper = core::to_double(coordinate.upper);
    for (std::size_t i = 0; i < count; ++i) {
      const double part = van_der_corput(static_cast<unsigned>(first + i) + 1, base[poses[i].size() % base.size()]);
      poses[i].push_back(lower + (upper - lower) * part);
    }
  }
  return poses;
}

namespace {

Values values_of(const Mechanism& mechanism, const std::vector<double>& pose) {
  Values values;
  for (const Parameter& parameter : mechanism.parameters) values[parameter.name] = core::to_double(parameter.value);
  for (std::size_t i = 0; i < pose.size(); ++i) values[mechanism.coordinates[i].name] = pose[i];
  return values;
}

}  // namespace

std::optional<std::array<double, 3>> sample_vector(const Mechanism& mechanism, const VectorExpression& vector,
                                                   const std::vector<double>& pose) {
  return value_at(vector, sample_points(mechanism, pose), values_of(mechanism, pose));
}

MaybePoints sample_points(const Mechanism& mechanism, const std::vector<double>& pose) {
  const Values values = values_of(mechanism, pose);
  MaybePoints points;
  for (const Point& point : mechanism.points) points.push_back(std::visit(Placement(points, values), point.form));
  return points;
}

std::vector<PosturePoints> sample_postures(const Mechanism& mechanism, std::size_t count) {
  constexpr std::size_t tries = 4096, at_once = 64;
  std::vector<PosturePoints> postures;
  for (std::size_t first = 0; first < tries; first += at_once) {
    for (const std::vector<double>& pose : spread_poses(mechanism, at_once, first)) {
      if (postures.size() == count) return postures;
      PosturePoints posture;
      for (const std::optional<Vector>& point : sample_points(mechanism, pose))
        if (point) posture.push_back(*point);
      if (posture.size() == mechanism.points.size()) postures.push_back(std::move(posture));
    }
  }
  return postures;
}

}  // namespace clearloci::mechanism
