#include "numeric/least_load.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "numeric/witness_rounding.hpp"

namespace clearloci::numeric {
namespace {

using Vector = std::vector<double>;

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void add(Vector& to, double part, const Vector& what) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += part * what[i];
}

/// (a x b).(c x d), in any dimension: (a.c)(b.d) - (a.d)(b.c), without its cancellation where vectors are parallel.
double cross_dot(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = i + 1; j < a.size(); ++j) sum += (a[i] * b[j] - a[j] * b[i]) * (c[i] * d[j] - c[j] * d[i]);
  return sum;
}

/// The (x, y) with x^2 + y^2 <= r^2 for which |rest + x a + y b| is least.
std::array<double, 2> least_in_disc(const Vector& rest, const Vector& a, const Vector& b, double r) {
  const double scale = dot(a, a) + dot(b, b), across = cross_dot(a, b, a, b);
  if (!(scale > 0)) return {0, 0};
  // (GtG + lambda) u = -Gt of, |u| falling with lambda.
  const auto solved = [&](const Vector& of, double lambda) {
    const double det = across + lambda * (scale + lambda);
    return std::array{-(cross_dot(a, b, of, b) + lambda * dot(a, of)) / det,
                      -(cross_dot(b, a, of, a) + lambda * dot(b, of)) / det};
  };
  const auto size = [](const std::array<double, 2>& u) { return std::hypot(u[0], u[1]); };
  const double hair = 1e-14 * scale;  // so that it can be solved where one direction says nothing
  if (std::array<double, 2> free = solved(rest, hair); size(free) <= r) {
    // The hair leaves that part of the rest, which is more than rounding: once more for what is left.
    Vector left = rest;
    add(left, free[0], a);
    add(left, free[1], b);
    const auto more = solved(left, hair);
    const std::array<double, 2> better = {free[0] + more[0], free[1] + more[1]};
    return size(better) <= r ? better : free;
  }
  double low = hair, high = std::hypot(dot(a, rest), dot(b, rest)) / r + scale;
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    (size(solved(rest, middle)) > r ? low : high) = middle;
  }
  const auto u = solved(rest, high);
  const double shrink = std::min(1.0, r / size(u)) * (1 - 4 * unit_roundoff);
  return {shrink * u[0], shrink * u[1]};
}

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

/// The load between the ends and within the balls under which a reaction is least.
class LeastLoad {
 public:
  LeastLoad(const LoadedParts& parts, const std::vector<core::LoadBall>& balls)
      : parts_(parts), balls_(balls), first_(values(parts.ends.front())), way_(values(parts.ends.back())) {
    add(way_, -1, first_);
    for (const std::vector<Bounded>& direction : parts.directions) unit_.push_back(values(direction));
    changes.resize(balls.size());
    // In turn along the range of loads and in each ball, until it changes no more.
    constexpr int rounds = 60;
    for (int round = 0; round < (balls.empty() ? 1 : rounds); ++round) {
      const double length2 = dot(way_, way_);
      t = length2 > 0 ? std::clamp(-dot(total(0), way_) / length2, 0.0, 1.0) : 0.0;
      for (std::size_t b = 0; b < balls.size(); ++b) improve(b);
    }
  }

  /// Where loads are what doubles say they are; or `roundly`: the load at which it vanishes is no double, neither is it
  /// known better than to a rounding.
  std::vector<Bounded> reaction(bool roundly) const {
    const auto about = [&](double value, double size) {
      return Bounded(value, roundly ? spacings * unit_roundoff * size : 0.0);
    };
    const Bounded along = t > 0 && t < 1 ? about(t, 1) : Bounded(t);
    std::vector<Bounded> w;
    for (std::size_t k = 0; k < first_.size(); ++k) {
      Bounded end = parts_.ends.front()[k];
      if (parts_.ends.size() > 1) end = end + along * (parts_.ends.back()[k] - end);
      for (std::size_t b = 0; b < balls_.size(); ++b) {
        const auto put = [&](int which, double value) {
          if (which >= 0)
            end = end + about(value, std::abs(value)) * parts_.directions[static_cast<std::size_t>(which)][k];
        };
        put(balls_[b].fx, changes[b].fx);
        put(balls_[b].fy, changes[b].fy);
        put(balls_[b].couple, changes[b].couple);
      }
      w.push_back(end);
    }
    return w;
  }

  double t = 0;
  std::vector<LoadChange> changes;

 private:
  static Vector values(const std::vector<Bounded>& parts) {
    Vector list;
    for (const Bounded& part : parts) list.push_back(part.value);
    return list;
  }

  Vector direction(int which) const {
    return which < 0 ? Vector(first_.size(), 0.0) : unit_[static_cast<std::size_t>(which)];
  }

  /// So far from the first end of the range, with all balls.
  Vector total(double along) const {
    Vector w = first_;
    add(w, along, way_);
    for (std::size_t b = 0; b < balls_.size(); ++b) add_ball(w, b, true, true);
    return w;
  }

  void add_ball(Vector& w, std::size_t b, bool force, bool couple) const {
    if (force) {
      add(w, changes[b].fx, direction(balls_[b].fx));
      add(w, changes[b].fy, direction(balls_[b].fy));
    }
    if (couple) add(w, changes[b].couple, direction(balls_[b].couple));
  }

  void improve(std::size_t b) {
    const auto rest_of = [&](bool force, bool couple) {
      Vector w = first_;
      add(w, t, way_);
      for (std::size_t other = 0; other < balls_.size(); ++other)
        if (other != b) add_ball(w, other, true, true);
      add_ball(w, b, force, couple);
      return w;
    };
    if (balls_[b].force > 0) {
      const auto u =
          least_in_disc(rest_of(false, true), direction(balls_[b].fx), direction(balls_[b].fy), balls_[b].force);
      changes[b].fx = u[0];
      changes[b].fy = u[1];
    }
    if (balls_[b].couple_size <= 0) return;
    const Vector c = direction(balls_[b].couple);
    const double c2 = dot(c, c), most = balls_[b].couple_size;
    changes[b].couple = c2 > 0 ? std::clamp(-dot(rest_of(true, false), c) / c2, -most, most) : 0.0;
  }

  const LoadedParts& parts_;
  const std::vector<core::LoadBall>& balls_;
  Vector first_, way_;
  std::vector<Vector> unit_;
};

}  // namespace

double usual_numerator(const std::vector<BoundedNumerators>& under_loads) {
  double usual = 0;
  for (const BoundedNumerators& load : under_loads)
    for (const Bounded& value : load.values) usual = std::max(usual, std::abs(value.value));
  return usual;
}

std::optional<TaskFailure> failure_under_least_load(const core::TaskDemand& demand, const LoadedParts& parts,
                                                    const std::vector<core::LoadBall>& balls,
                                                    const Bounded& determinant, double usual) {
  const LeastLoad least(parts, balls);
  auto failure = judged(demand, least.t, least.reaction(false), least.reaction(true), determinant, usual);
  if (failure) failure->changes = least.changes;
  return failure;
}

}  // namespace clearloci::numeric
