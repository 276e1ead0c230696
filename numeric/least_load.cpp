#include "numeric/least_load.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "numeric/witness_rounding.hpp"

namespace clearloci::numeric {
namespace {

using Vector = Eigen::VectorXd;

Vector vector_of(const std::vector<double>& list) {
  return Eigen::Map<const Vector>(list.data(), static_cast<Eigen::Index>(list.size()));
}

/// The u within a ball for which |rest + G u| is least; the columns of G are its directions.
class Ball {
 public:
  Ball(const core::LoadBall& ball, const std::vector<std::vector<double>>& directions) : radius_(ball.radius) {
    g_.resize(static_cast<Eigen::Index>(directions[ball.first].size()), static_cast<Eigen::Index>(ball.count));
    for (std::size_t k = 0; k < ball.count; ++k)
      g_.col(static_cast<Eigen::Index>(k)) = vector_of(directions[ball.first + k]);
    svd_.compute(g_, Eigen::ComputeThinU | Eigen::ComputeThinV);
    change = Vector::Zero(g_.cols());
  }

  Vector part() const { return g_ * change; }

  void change_for(const Vector& rest) {
    change = solved(rest, 0);
    if (change.norm() <= radius_) return;
    // Its length falls with lambda.
    const double most = svd_.singularValues()[0];
    double low = 1e-30 * most * most, high = most * (rest.norm() / radius_ + most);
    for (int i = 0; i < 200; ++i) {
      const double middle = std::sqrt(low * high);
      (solved(rest, middle).norm() > radius_ ? low : high) = middle;
    }
    change = solved(rest, high);
    change *= std::min(1.0, radius_ / change.norm()) * (1 - 4 * unit_roundoff);
  }

  Vector change;

 private:
  /// (GtG + lambda) u = -Gt rest; the shortest, where some directions say nothing.
  Vector solved(const Vector& rest, double lambda) const {
    Vector along = svd_.matrixU().transpose() * rest;
    const Vector& sizes = svd_.singularValues();
    constexpr double nothing = 1e-12;
    for (Eigen::Index i = 0; i < along.size(); ++i)
      along[i] *= sizes[i] > nothing * sizes[0] ? -sizes[i] / (sizes[i] * sizes[i] + lambda) : 0.0;
    return svd_.matrixV() * along;
  }

  double radius_;
  Eigen::MatrixXd g_;
  Eigen::JacobiSVD<Eigen::MatrixXd> svd_;
};

/// A demanded reaction at a load that is known to be one, `at_load`, and at all loads within a rounding of it,
/// `about_load`: components times |A|.
std::optional<TaskFailure> judged(const core::TaskDemand& demand, double load, const std::vector<Bounded>& at_load,
                                  const std::vector<Bounded>& about_load, const Bounded& determinant, double usual) {
  double size2 = 0, most2 = 0;
  for (const Bounded& value : at_load) {
    size2 += value.value * value.value;
    most2 += std::pow(std::abs(value.value) + value.error, 2);
  }
  TaskFailure failure{TaskFailure::Kind::too_small, demand, load, std::sqrt(size2) / std::abs(determinant.value)};
  const double least_determinant = std::abs(determinant.value) - determinant.error;
  // A few roundings of this very sum, root and quotient.
  const double most = std::sqrt(most2) / least_determinant * (1 + 16 * unit_roundoff);
  if (demand.least > 0 && most < core::to_double(demand.least) * (1 - 2 * unit_roundoff)) return failure;
  failure.kind = TaskFailure::Kind::vanishing;
  const bool zero = std::all_of(about_load.begin(), about_load.end(), [&](const Bounded& value) {
    return is_zero(value) && value.error <= known_zero * usual;
  });
  return zero ? std::optional(failure) : std::nullopt;
}

std::vector<double> values(const std::vector<Bounded>& parts) {
  std::vector<double> list;
  for (const Bounded& part : parts) list.push_back(part.value);
  return list;
}

std::vector<std::vector<double>> values(const std::vector<std::vector<Bounded>>& all) {
  std::vector<std::vector<double>> lists;
  for (const std::vector<Bounded>& parts : all) lists.push_back(values(parts));
  return lists;
}

/// A reaction where loads are what doubles say they are; or `roundly`: the load at which it vanishes is no double,
/// neither is it known better than to a rounding.
std::vector<Bounded> reaction(const LoadedParts& parts, const LeastLoad& load, bool roundly) {
  const auto about = [&](double value, double size) {
    return Bounded(value, roundly ? spacings * unit_roundoff * size : 0.0);
  };
  const Bounded along = load.t > 0 && load.t < 1 ? about(load.t, 1) : Bounded(load.t);
  std::vector<Bounded> w;
  for (std::size_t k = 0; k < parts.ends.front().size(); ++k) {
    Bounded& sum = w.emplace_back(parts.ends.front()[k]);
    if (parts.ends.size() > 1) sum = sum + along * (parts.ends.back()[k] - sum);
    for (std::size_t d = 0; d < parts.directions.size(); ++d)
      sum = sum + about(load.changes[d], std::abs(load.changes[d])) * parts.directions[d][k];
  }
  return w;
}

}  // namespace

LeastLoad least_load(const std::vector<std::vector<double>>& ends, const std::vector<std::vector<double>>& directions,
                     const std::vector<core::LoadBall>& balls) {
  LeastLoad least{0, std::vector<double>(directions.size(), 0.0)};
  const Vector first = vector_of(ends.front()), way = vector_of(ends.back()) - first;
  std::vector<Ball> changes;
  for (const core::LoadBall& ball : balls) changes.emplace_back(ball, directions);
  // In turn along the range of loads and in each ball, until it changes no more.
  constexpr int rounds = 60;
  for (int round = 0; round < (balls.empty() ? 1 : rounds); ++round) {
    Vector rest = first;
    for (const Ball& ball : changes) rest += ball.part();
    const double length2 = way.squaredNorm();
    least.t = length2 > 0 ? std::clamp(-rest.dot(way) / length2, 0.0, 1.0) : 0.0;
    for (Ball& ball : changes) {
      Vector others = first + least.t * way;
      for (const Ball& other : changes)
        if (&other != &ball) others += other.part();
      ball.change_for(others);
    }
  }
  for (std::size_t b = 0; b < balls.size(); ++b)
    std::copy(changes[b].change.begin(), changes[b].change.end(),
              least.changes.begin() + static_cast<std::ptrdiff_t>(balls[b].first));
  return least;
}

double usual_numerator(const std::vector<BoundedNumerators>& under_loads) {
  double usual = 0;
  for (const BoundedNumerators& load : under_loads)
    for (const Bounded& value : load.values) usual = std::max(usual, std::abs(value.value));
  return usual;
}

std::optional<TaskFailure> failure_under_least_load(const core::TaskDemand& demand, const LoadedParts& parts,
                                                    const std::vector<core::LoadBall>& balls,
                                                    const Bounded& determinant, double usual) {
  const LeastLoad least = least_load(values(parts.ends), values(parts.directions), balls);
  auto failure =
      judged(demand, least.t, reaction(parts, least, false), reaction(parts, least, true), determinant, usual);
  if (failure) failure->changes = least.changes;
  return failure;
}

}  // namespace clearloci::numeric
