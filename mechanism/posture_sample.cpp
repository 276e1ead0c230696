#include "mechanism/posture_sample.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "mechanism/group_closing.hpp"
#include "mechanism/placement.hpp"

namespace clearloci::mechanism {
namespace {

using Vector = std::array<double, 3>;
using Values = std::map<std::string, double>;
using MaybePoints = std::vector<std::optional<Vector>>;

/// Doubles as an algebra (mechanism/placement.hpp): no number where a root or a quotient has no value.
struct Doubles {
  using Value = double;
  const Values& values;
  const std::vector<double>& of_groups;  ///< the unknowns of the groups; empty where they do not close
  std::size_t asked = 0;

  double unknown(std::size_t, std::size_t) { return of_groups.empty() ? NAN : of_groups.at(asked++); }
  void close(std::size_t, const std::vector<double>&) {}
  double number(const Rational& value) const { return core::to_double(value); }
  double symbol(const std::string& name) const { return values.at(name); }
  double pi() const { return std::numbers::pi; }
  double negate(double a) const { return -a; }
  double add(double a, double b) const { return a + b; }
  double subtract(double a, double b) const { return a - b; }
  double multiply(double a, double b) const { return a * b; }
  double square(double a) const { return a * a; }
  double inverse(double a) const { return a == 0 ? NAN : 1 / a; }
  /// The end of the reach is no posture to take samples of.
  double square_root(double a) const { return a > 0 ? std::sqrt(a) : NAN; }
  double divide(double a, double b, const Expression&) const { return a / b; }
  double power(double a, const Expression& e) const { return std::pow(a, core::interpret(e.arguments()[1], *this)); }
  double sqrt(double a, const Expression&) const { return std::sqrt(a); }
  double cos(double a, const Expression&) const { return std::cos(a); }
  double sin(double a, const Expression&) const { return std::sin(a); }
  double atan(double a, const Expression&) const { return std::atan(a); }
};

std::optional<Vector> if_finite(const Vector& v) {
  const bool finite = std::all_of(v.begin(), v.end(), [](double c) { return std::isfinite(c); });
  return finite ? std::optional(v) : std::nullopt;
}

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

void put_pose(Values& values, const Mechanism& mechanism, const std::vector<double>& pose) {
  for (std::size_t i = 0; i < pose.size(); ++i) values[mechanism.coordinates[i].name] = pose[i];
}

Values values_of(const Mechanism& mechanism, const std::vector<double>& pose) {
  Values values;
  for (const Parameter& parameter : mechanism.parameters) values[parameter.name] = core::to_double(parameter.value);
  put_pose(values, mechanism, pose);
  return values;
}

MaybePoints points_at(const Mechanism& mechanism, const Values& values, const std::vector<double>& of_groups,
                      const std::vector<int>& sides) {
  const Placement<Doubles> placed(mechanism, sides, {values, of_groups});
  MaybePoints points;
  for (const Vector& point : placed.points()) points.push_back(if_finite(point));
  return points;
}

std::optional<PosturePoints> complete(const MaybePoints& points) {
  PosturePoints posture;
  for (const std::optional<Vector>& point : points) {
    if (!point) return std::nullopt;
    posture.push_back(*point);
  }
  return posture;
}

}  // namespace

double sample_number(const Mechanism& mechanism, const Expression& number, const std::vector<double>& pose) {
  const Values values = values_of(mechanism, pose);
  const std::vector<double> none;
  return core::interpret(number, Doubles{values, none});
}

std::optional<std::array<double, 3>> sample_vector(const Mechanism& mechanism, const VectorExpression& vector,
                                                   const std::vector<double>& pose) {
  const Values values = values_of(mechanism, pose);
  const std::vector<int> sides = working_mode(mechanism);
  const std::vector<double> of_groups = GroupClosing(mechanism, sides).at(pose).value_or(std::vector<double>{});
  return if_finite(Placement<Doubles>(mechanism, sides, {values, of_groups}).vector(vector));
}

namespace {

MaybePoints points_at(const Mechanism& mechanism, const std::vector<double>& pose, const std::vector<int>& sides) {
  const std::vector<double> of_groups = GroupClosing(mechanism, sides).at(pose).value_or(std::vector<double>{});
  return points_at(mechanism, values_of(mechanism, pose), of_groups, sides);
}

}  // namespace

MaybePoints sample_points(const Mechanism& mechanism, const std::vector<double>& pose, const std::vector<int>& sides) {
  return points_at(mechanism, pose, sides);
}

MaybePoints sample_points(const Mechanism& mechanism, const std::vector<double>& pose) {
  return points_at(mechanism, pose, working_mode(mechanism));
}

std::optional<PosturePoints> sample_posture(const Mechanism& mechanism, const std::vector<double>& pose,
                                            const std::vector<int>& sides) {
  return complete(points_at(mechanism, pose, sides));
}

std::vector<SampledPosture> sample_poses(const Mechanism& mechanism, const std::vector<int>& sides, std::size_t count) {
  // Groups take a thousand times as long as what has closed forms.
  const std::size_t tries = mechanism.groups.empty() ? 4096 : 256, at_once = 64;
  GroupClosing closing(mechanism, sides);
  std::vector<SampledPosture> postures;
  Values values = values_of(mechanism, {});
  for (std::size_t first = 0; first < tries; first += at_once) {
    for (std::vector<double>& pose : spread_poses(mechanism, at_once, first)) {
      if (postures.size() == count) return postures;
      put_pose(values, mechanism, pose);
      const std::optional<std::vector<double>> of_groups = closing.at(pose);
      if (!of_groups) continue;
      if (std::optional<PosturePoints> posture = complete(points_at(mechanism, values, *of_groups, sides)))
        postures.push_back({std::move(pose), std::move(*posture)});
    }
  }
  return postures;
}

std::vector<PosturePoints> sample_postures(const Mechanism& mechanism, std::size_t count) {
  std::vector<PosturePoints> all;
  for (SampledPosture& posture : sample_poses(mechanism, working_mode(mechanism), count))
    all.push_back(std::move(posture.points));
  return all;
}

}  // namespace clearloci::mechanism
