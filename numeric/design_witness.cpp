#include "numeric/design_witness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "numeric/demand_failure.hpp"
#include "numeric/witness_rounding.hpp"

namespace clearloci::numeric {
namespace {

using Kind = TaskFailure::Kind;

using Vector = std::vector<double>;

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void add(Vector& to, double part, const Vector& what) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += part * what[i];
}

/// The (x, y) with x^2 + y^2 <= r^2 for which |rest + x a + y b| is least.
std::array<double, 2> least_in_disc(const Vector& rest, const Vector& a, const Vector& b, double r) {
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), ar = dot(a, rest), br = dot(b, rest);
  // (GtG + lambda) u = -Gt rest, |u| falling with lambda.
  const auto at = [&](double lambda) {
    const double p = aa + lambda, q = bb + lambda, det = p * q - ab * ab;
    return std::array{-(q * ar - ab * br) / det, -(p * br - ab * ar) / det};
  };
  const double scale = aa + bb;
  if (!(scale > 0)) return {0, 0};
  const double hair = 1e-14 * scale;  // so that it can be solved where one direction says nothing
  if (const auto free = at(hair); std::hypot(free[0], free[1]) <= r) return free;
  double low = hair, high = std::hypot(ar, br) / r + scale;
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    const auto u = at(middle);
    (std::hypot(u[0], u[1]) > r ? low : high) = middle;
  }
  const auto u = at(high);
  const double shrink = std::min(1.0, r / std::hypot(u[0], u[1])) * (1 - 4 * unit_roundoff);
  return {shrink * u[0], shrink * u[1]};
}

}  // namespace

/// Components of a demanded reaction times |A|: of every load and direction.
struct DesignWitness::Parts {
  std::vector<std::vector<Bounded>> loads, directions;

  static Vector values(const std::vector<Bounded>& parts) {
    Vector list;
    for (const Bounded& own : parts) list.push_back(own.value);
    return list;
  }
};

DesignWitness::DesignWitness(std::vector<const NumericModel*> loads, std::vector<const NumericModel*> directions,
                             std::vector<core::LoadBall> balls, std::vector<int> mode,
                             std::vector<core::TaskDemand> demands, const std::vector<std::vector<double>>& usual)
    : loads_(std::move(loads)),
      directions_(std::move(directions)),
      balls_(std::move(balls)),
      mode_(std::move(mode)),
      demands_(std::move(demands)) {
  for (const std::vector<double>& at : usual) extent_ = std::max({extent_, std::abs(at[0]), std::abs(at[1])});
  usual_determinant_ = usual_determinant(*loads_.front(), mode_, usual);
}

std::vector<DesignFailureAt> DesignWitness::failures(std::span<const Bounded> at) const {
  const auto alone = [](Kind kind) { return std::vector{DesignFailureAt{{kind, {}, 0, 0}, {}}}; };
  const double extent = std::max({extent_, std::abs(at[0].value), std::abs(at[1].value)});
  const auto reached = [&](double dx, double dy) {
    std::vector<double> pose;
    for (const Bounded& own : at) pose.push_back(own.value);
    pose[0] += dx;
    pose[1] += dy;
    return reachable(*loads_.front(), pose, mode_);
  };
  const auto around = [&](double many) {
    int count = 0;
    for (const int i : {-1, 0, 1})
      for (const int j : {-1, 0, 1})
        if (reached(many * spacing(extent) * i, many * spacing(extent) * j)) ++count;
    return count;
  };
  if (around(spacings) == 0) return alone(Kind::unreachable);
  if (around(boundary_spacings) < 9) return alone(Kind::boundary);
  std::vector<Bounded> pose(at.begin(), at.end());
  for (std::size_t c = 0; c < 2; ++c) pose[c].error = std::max(pose[c].error, spacings * spacing(extent));
  std::vector<BoundedNumerators> loads, directions;
  for (const NumericModel* own : loads_) loads.push_back(bounded_numerators(*own, pose, mode_));
  for (const NumericModel* own : directions_) directions.push_back(bounded_numerators(*own, pose, mode_));
  if (!loads.front().reachable) return {};
  const Bounded& determinant = loads.front().determinant;
  if (is_zero(determinant)) {
    if (determinant.error <= known_zero * usual_determinant_) return alone(Kind::singular);
    return {};
  }
  std::vector<DesignFailureAt> all;
  for (const core::TaskDemand& demand : demands_)
    if (auto found = failure_of(demand, loads, directions)) all.push_back(std::move(*found));
  return all;
}

std::optional<DesignFailureAt> DesignWitness::failure_of(const core::TaskDemand& demand,
                                                         const std::vector<BoundedNumerators>& loads,
                                                         const std::vector<BoundedNumerators>& directions) const {
  Parts parts;
  for (const BoundedNumerators& own : loads) parts.loads.push_back(demanded_parts(*loads_.front(), demand, own));
  for (const BoundedNumerators& own : directions)
    parts.directions.push_back(demanded_parts(*loads_.front(), demand, own));
  const Vector first = Parts::values(parts.loads.front()), last = Parts::values(parts.loads.back());
  Vector way = last;
  add(way, -1, first);
  std::vector<Vector> unit;
  for (const auto& own : parts.directions) unit.push_back(Parts::values(own));
  const auto direction = [&](int which) {
    return which < 0 ? Vector(first.size(), 0.0) : unit[static_cast<std::size_t>(which)];
  };

  // In turn along the range of loads and in each ball, until it changes no more.
  double t = 0;
  std::vector<LoadChange> changes(balls_.size());
  const auto total = [&](std::size_t without, bool without_way) {
    Vector w = first;
    if (!without_way) add(w, t, way);
    for (std::size_t b = 0; b < balls_.size(); ++b) {
      if (b == without) continue;
      add(w, changes[b].fx, direction(balls_[b].fx));
      add(w, changes[b].fy, direction(balls_[b].fy));
      add(w, changes[b].couple, direction(balls_[b].couple));
    }
    return w;
  };
  const std::size_t none = balls_.size();
  constexpr int rounds = 60;
  for (int round = 0; round < (balls_.empty() ? 1 : rounds); ++round) {
    const double length2 = dot(way, way);
    t = length2 > 0 ? std::clamp(-dot(total(none, true), way) / length2, 0.0, 1.0) : 0.0;
    for (std::size_t b = 0; b < balls_.size(); ++b) {
      Vector rest = total(b, false);
      add(rest, changes[b].couple, direction(balls_[b].couple));
      if (balls_[b].force > 0) {
        const auto u = least_in_disc(rest, direction(balls_[b].fx), direction(balls_[b].fy), balls_[b].force);
        changes[b].fx = u[0];
        changes[b].fy = u[1];
      }
      if (balls_[b].couple_size <= 0) continue;
      const Vector c = direction(balls_[b].couple);
      rest = total(b, false);
      add(rest, changes[b].fx, direction(balls_[b].fx));
      add(rest, changes[b].fy, direction(balls_[b].fy));
      const double c2 = dot(c, c), most = balls_[b].couple_size;
      changes[b].couple = c2 > 0 ? std::clamp(-dot(rest, c) / c2, -most, most) : 0.0;
    }
  }

  // The load at which it vanishes is no double: neither is it known better than to a rounding.
  const auto about = [](double value) { return Bounded(value, spacings * unit_roundoff * std::abs(value)); };
  std::vector<Bounded> w;
  const Bounded along = t > 0 && t < 1 ? about(t) : Bounded(t);
  for (std::size_t k = 0; k < first.size(); ++k) {
    Bounded own = parts.loads.front()[k];
    if (loads.size() > 1) own = own + along * (parts.loads.back()[k] - own);
    for (std::size_t b = 0; b < balls_.size(); ++b) {
      const auto put = [&](int which, double value) {
        if (which >= 0) own = own + about(value) * parts.directions[static_cast<std::size_t>(which)][k];
      };
      put(balls_[b].fx, changes[b].fx);
      put(balls_[b].fy, changes[b].fy);
      put(balls_[b].couple, changes[b].couple);
    }
    w.push_back(own);
  }
  const auto failure = judged(demand, t, w, w, loads.front().determinant, usual_numerator(loads));
  if (!failure) return std::nullopt;
  return DesignFailureAt{*failure, changes};
}

}  // namespace clearloci::numeric
