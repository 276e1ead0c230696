#include "numeric/pose_witness.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/demand_failure.hpp"
#include "numeric/witness_rounding.hpp"

namespace clearloci::numeric {

PoseWitness::PoseWitness(std::vector<const NumericModel*> loads, std::vector<int> mode,
                         std::vector<core::TaskDemand> demands, const std::vector<std::vector<double>>& usual)
    : loads_(std::move(loads)), mode_(std::move(mode)), demands_(std::move(demands)) {
  extents_.assign(loads_.front()->box.size(), 0.0);
  for (const std::vector<double>& at : usual)
    for (std::size_t c = 0; c < at.size(); ++c) extents_[c] = std::max(extents_[c], std::abs(at[c]));
  usual_determinant_ = usual_determinant(*loads_.front(), mode_, usual);
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
    // Where continuation of a group ends nothing is certain.
    const auto& groups = loads_.front()->mechanism.groups;
    const Posture here = posture(*loads_.front(), at, mode_);
    if (!groups.empty() && here.unreachable && *here.unreachable >= groups.front().first) return std::nullopt;
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
  return demand < 0 ? std::nullopt : failure_of(*loads_.front(), demands_[static_cast<std::size_t>(demand)], all);
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
  // Of all poses: at one where nearly all reactions vanish, none is large beside its rounding.
  double usual = 0, error = 0;
  std::size_t seen = 0;
  for (const std::vector<double>& pose : poses) {
    const std::vector<BoundedNumerators> all = numerators(pose, 0);
    if (!all.front().reachable || is_zero(all.front().determinant)) continue;
    ++seen;
    usual = std::max(usual, usual_numerator(all));
    for (const BoundedNumerators& load : all)
      for (const Bounded& part : demanded_parts(*loads_.front(), demands_[static_cast<std::size_t>(demand)], load)) {
        if (!is_zero(part)) return false;
        error = std::max(error, part.error);
      }
  }
  return seen > 0 && error <= known_zero * usual;
}

}  // namespace clearloci::numeric
