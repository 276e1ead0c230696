#include "numeric/demand_failure.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/witness_rounding.hpp"

namespace clearloci::numeric {

double usual_determinant(const NumericModel& model, std::span<const int> mode,
                         const std::vector<std::vector<double>>& poses) {
  double usual = 0;
  for (const std::vector<double>& at : poses) {
    const BoundedNumerators n = bounded_numerators(model, at, mode);
    if (n.reachable && std::isfinite(n.determinant.value)) usual = std::max(usual, std::abs(n.determinant.value));
  }
  return usual;
}

double usual_numerator(const std::vector<BoundedNumerators>& under_loads) {
  double usual = 0;
  for (const BoundedNumerators& load : under_loads)
    for (const Bounded& value : load.values) usual = std::max(usual, std::abs(value.value));
  return usual;
}

std::optional<TaskFailure> judged(const core::TaskDemand& demand, double load, const std::vector<Bounded>& at_load,
                                  const std::vector<Bounded>& about_load, const Bounded& determinant, double usual) {
  double size2 = 0, most2 = 0;
  for (const Bounded& own : at_load) {
    size2 += own.value * own.value;
    most2 += std::pow(std::abs(own.value) + own.error, 2);
  }
  TaskFailure failure{TaskFailure::Kind::too_small, demand, load, std::sqrt(size2) / std::abs(determinant.value)};
  const double least_determinant = std::abs(determinant.value) - determinant.error;
  // A few roundings of this very sum, root and quotient.
  const double most = std::sqrt(most2) / least_determinant * (1 + 16 * unit_roundoff);
  if (demand.least > 0 && most < core::to_double(demand.least) * (1 - 2 * unit_roundoff)) return failure;
  failure.kind = TaskFailure::Kind::vanishing;
  const bool zero = std::all_of(about_load.begin(), about_load.end(),
                                [&](const Bounded& own) { return is_zero(own) && own.error <= known_zero * usual; });
  return zero ? std::optional(failure) : std::nullopt;
}

std::optional<TaskFailure> failure_of(const NumericModel& model, const core::TaskDemand& demand,
                                      const std::vector<BoundedNumerators>& under_loads) {
  const std::vector<Bounded> first = demanded_parts(model, demand, under_loads.front()),
                             last = demanded_parts(model, demand, under_loads.back());
  double along = 0, length2 = 0;
  for (std::size_t k = 0; k < first.size(); ++k) {
    const double way = last[k].value - first[k].value;
    along -= first[k].value * way;
    length2 += way * way;
  }
  const double nearest = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  // (1 - t) a + t b.
  const auto between = [&](const Bounded& t) {
    std::vector<Bounded> parts = first;
    for (std::size_t k = 0; k < parts.size() && under_loads.size() > 1; ++k)
      parts[k] = first[k] + t * (last[k] - first[k]);
    return parts;
  };
  // The load at which it vanishes is no double: neither is it known better than to a rounding.
  const Bounded about(nearest, nearest > 0 && nearest < 1 ? spacings * unit_roundoff : 0.0);
  return judged(demand, nearest, between(Bounded(nearest)), between(about), under_loads.front().determinant,
                usual_numerator(under_loads));
}

}  // namespace clearloci::numeric
