#include "numeric/pose_witness.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/witness_rounding.hpp"

namespace clearloci::numeric {

PoseWitness::PoseWitness(std::vector<const NumericModel*> loads, std::vector<int> mode,
                         std::vector<core::TaskDemand> demands, const std::vector<std::vector<double>>& usual)
    : loads_(std::move(loads)), mode_(std::move(mode)), demands_(std::move(demands)) {
  extents_.assign(loads_.front()->box.size(), 0.0);
  for (const std::vector<double>& at : usual) {
    for (std::size_t c = 0; c < at.size(); ++c) extents_[c] = std::max(extents_[c], std::abs(at[c]));
    const BoundedNumerators n = bounded_numerators(*loads_.front(), at, mode_);
    if (n.reachable && std::isfinite(n.determinant.value))
      usual_determinant_ = std::max(usual_determinant_, std::abs(n.determinant.value));
  }
}

/// Under every load, at the poses within so many spacings of one.
std::vector<BoundedNumerators> PoseWitness::numerators(std::span<const double> at, double many) const {
  std::vector<Bounded> pose;
  for (std::size_t c = 0; c < at.size(); ++c)
    pose.emplace_back(at[c], many * spacing(std::max(extents_[c], std::abs(at[c]))));
  std::vector<BoundedNumerators> all;
  for (const NumericModel* load : loads_) all.push_back(bounded_numerators(*load, pose, mode_));
  return all;
}

std::optional<TaskFailure> PoseWitness::failure(std::span<const double> at, int demand) const {
  using Kind = TaskFailure::Kind;
  if (!reachable(*loads_.front(), at, mode_)) {
    // Not by a rounding: nor is any neighbour along a coordinate.
    std::vector<double> near(at.begin(), at.end());
    for (std::size_t c = 0; c < near.size(); ++c)
      for (const int way : {-1, 1}) {
        near[c] = at[c] + way * spacings * spacing(std::max(extents_[c], std::abs(at[c])));
        if (reachable(*loads_.front(), near, mode_)) return std::nullopt;
        near[c] = at[c];
      }
    return TaskFailure{Kind::unreachable, {}, 0, 0};
  }
  const std::vector<BoundedNumerators> all = numerators(at, spacings);
  if (!all.front().reachable) return std::nullopt;
  const Bounded& determinant = all.front().determinant;
  if (is_zero(determinant)) {
    if (determinant.error <= known_zero * usual_determinant_) return TaskFailure{Kind::singular, {}, 0, 0};
    return std::nullopt;
  }
  return demand < 0 ? std::nullopt : failure_of(demands_[static_cast<std::size_t>(demand)], all);
}

std::optional<TaskFailure> PoseWitness::failure_of(const core::TaskDemand& demand,
                                                   const std::vector<BoundedNumerators>& numerators) const {
  const std::vector<Bounded> first = demanded_parts(*loads_.front(), demand, numerators.front()),
                             last = demanded_parts(*loads_.front(), demand, numerators.back());
  double along = 0, length2 = 0;
  for (std::size_t k = 0; k < first.size(); ++k) {
    const double way = last[k].value - first[k].value;
    along -= first[k].value * way;
    length2 += way * way;
  }
  TaskFailure failure{TaskFailure::Kind::too_small, demand, length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0,
                      0};
  // The load at which it vanishes is no double: neither is it known better than to a rounding.
  const bool between = failure.load > 0 && failure.load < 1;
  const Bounded t(failure.load, between ? spacings * unit_roundoff : 0.0);
  double usual = 0, size2 = 0, most2 = 0;
  for (const BoundedNumerators& load : numerators)
    for (const Bounded& value : load.values) usual = std::max(usual, std::abs(value.value));
  bool zero = true;
  for (std::size_t k = 0; k < first.size(); ++k) {
    const Bounded own = numerators.size() == 1 ? first[k] : first[k] + t * (last[k] - first[k]);
    size2 += own.value * own.value;
    most2 += std::pow(std::abs(own.value) + own.error, 2);
    zero = zero && is_zero(own) && own.error <= known_zero * usual;
  }
  const Bounded& determinant = numerators.front().determinant;
  failure.size = std::sqrt(size2) / std::abs(determinant.value);
  const double most = std::sqrt(most2) / (std::abs(determinant.value) - determinant.error) * (1 + 16 * unit_roundoff);
  if (demand.least > 0 && most < core::to_double(demand.least) * (1 - 2 * unit_roundoff)) return failure;
  failure.kind = TaskFailure::Kind::vanishing;
  return zero ? std::optional(failure) : std::nullopt;
}

bool PoseWitness::differs(std::span<const double> a, std::span<const double> b, int demand) const {
  const std::vector<BoundedNumerators> one = numerators(a, 0), two = numerators(b, 0);
  if (!one.front().reachable || !two.front().reachable) return false;
  const auto opposite = [](const Bounded& x, const Bounded& y) {
    return !is_zero(x) && !is_zero(y) && (x.value > 0) != (y.value > 0);
  };
  if (demand < 0) return opposite(one.front().determinant, two.front().determinant);
  for (std::size_t load = 0; load < one.size(); ++load) {
    const auto& own = demands_[static_cast<std::size_t>(demand)];
    const std::vector<Bounded> x = demanded_parts(*loads_.front(), own, one[load]),
                               y = demanded_parts(*loads_.front(), own, two[load]);
    if (x.size() == 1 && opposite(x[0], y[0])) return true;
  }
  return false;
}

bool PoseWitness::is_never_loaded(int demand, const std::vector<std::vector<double>>& poses) const {
  std::size_t seen = 0;
  for (const std::vector<double>& pose : poses) {
    const std::vector<BoundedNumerators> all = numerators(pose, 0);
    if (!all.front().reachable || is_zero(all.front().determinant)) continue;
    ++seen;
    for (const BoundedNumerators& load : all) {
      double usual = 0;
      for (const Bounded& value : load.values) usual = std::max(usual, std::abs(value.value));
      for (const Bounded& part : demanded_parts(*loads_.front(), demands_[static_cast<std::size_t>(demand)], load))
        if (!is_zero(part) || part.error > known_zero * usual) return false;
    }
  }
  return seen > 0;
}

}  // namespace clearloci::numeric
