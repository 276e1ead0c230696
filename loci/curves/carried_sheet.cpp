#include "loci/curves/carried_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clearloci::loci {

using core::FactorRole;
using core::LocusFactor;
using core::LocusKind;
using core::LocusProblem;
using core::Vanishing;
using Place = CarriedSheet::Place;

namespace {

/// What lies beyond a seam of charts or a side of the box by this part of its size lies on it.
constexpr double on_seam = 1e-9;
/// In parts of the box: by more a pole does not move while a hand drags.
constexpr double farthest_pole = 0.03;
/// Of a chart's t: a place that is so far beyond its seam may come back into it.
constexpr double farthest_in_chart = 1 + sheet::SheetNewton::farthest;

FactorRole role_of(LocusKind kind) {
  switch (kind) {
    case LocusKind::margin:
      return FactorRole::margin;
    case LocusKind::direct_singularity:
      return FactorRole::direct_singularity;
    case LocusKind::workspace_boundary:
      return FactorRole::workspace_boundary;
    default:
      return FactorRole::reaction;
  }
}

/// Whether something of what vanishes on a locus vanishes with a factor.
bool vanishes_with(const LocusProblem& problem, const LocusFactor& factor, const std::vector<Vanishing>& all) {
  if (all.empty() || factor.vanishing.empty()) return true;
  return std::any_of(all.begin(), all.end(), [&](const Vanishing& v) {
    const std::vector<core::Quantity> parts = core::force_components(problem, v.joint);
    return std::any_of(factor.vanishing.begin(), factor.vanishing.end(), [&](const Vanishing& vanishing) {
      return vanishing.joint == v.joint && (vanishing.quantity == v.quantity ||
                                            (v.quantity == core::Quantity::f &&
                                             std::find(parts.begin(), parts.end(), vanishing.quantity) != parts.end()));
    });
  });
}

}  // namespace

CarriedSheet::CarriedSheet(const LocusProblem& problem, core::WorkingMode mode)
    : problem_(&problem), mode_(std::move(mode)) {
  for (std::size_t v = 0; v < problem.lower.size(); ++v) {
    lower_.push_back(core::to_double(problem.lower[v]));
    upper_.push_back(core::to_double(problem.upper[v]));
    sizes_.push_back(upper_.back() - lower_.back());
  }
}

const core::AngleChart* CarriedSheet::chart_of(std::size_t v) const {
  return v < problem_->charts.size() && problem_->charts[v] ? &*problem_->charts[v] : nullptr;
}

std::optional<Place> CarriedSheet::inside(Place place) const {
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (const auto* const chart = chart_of(v)) {
      place[v] = core::parameter_at(*chart, place[v]);
      if (!(std::abs(place[v]) <= farthest_in_chart)) return std::nullopt;
    }
    if (!std::isfinite(place[v])) return std::nullopt;
  }
  return place;
}

Place CarriedSheet::outside(Place place) const {
  for (std::size_t v = 0; v < place.size(); ++v)
    if (const auto* const chart = chart_of(v)) place[v] = core::angle_at(*chart, place[v]);
  return place;
}

sheet::SheetNewton& CarriedSheet::newton_for(const std::vector<int>& factors) {
  std::unique_ptr<sheet::SheetNewton>& newton = newtons_[factors];
  if (newton) return *newton;
  std::vector<sheet::SheetFunction> functions;
  for (const int f : factors) {
    const LocusFactor& factor = problem_->factors[static_cast<std::size_t>(f)];
    functions.push_back({factor.sheet, factor.line});
  }
  newton = std::make_unique<sheet::SheetNewton>(problem_->tower, mode_, functions, sizes_);
  return *newton;
}

std::optional<Place> CarriedSheet::moved(Place place, const std::vector<int>& factors, std::span<const Held> held) {
  sheet::SheetNewton& newton = newton_for(factors);
  if (!newton.move(place, held)) return std::nullopt;
  for (std::size_t v = 0; v < place.size(); ++v) {
    const double beyond = on_seam * sizes_[v];
    if (!(place[v] >= lower_[v] - beyond && place[v] <= upper_[v] + beyond)) return std::nullopt;
  }
  if (!newton.is_on_sheet(place)) return std::nullopt;
  return place;
}

std::optional<CarriedSheet::Held> CarriedSheet::rim_near(const Place& place, int factor) {
  const int root = newton_for({factor}).nearest_root(place).root;
  if (root < 0) return std::nullopt;
  return Held{static_cast<int>(place.size()) + root, 0};
}

std::optional<Place> CarriedSheet::pole_near(const Place& place) {
  if (!poles_known_) {
    poles_known_ = true;
    const int n = static_cast<int>(lower_.size());
    core::RootTower plane;
    plane.coordinates = problem_->tower.coordinates;
    for (const core::Polynomial& denominator : problem_->tower.denominators) {
      std::vector<sheet::SheetFunction> slopes;
      bool fixed = true;
      for (int v = 0; v < denominator.variables; ++v) fixed = fixed && (v < n || !core::depends_on(denominator, v));
      for (int v = 0; v < n && fixed; ++v)
        slopes.push_back({core::with_variables(core::derivative(denominator, v), n)});
      if (fixed) poles_.push_back(std::make_unique<sheet::SheetNewton>(plane, core::WorkingMode{}, slopes, sizes_));
    }
  }
  std::optional<Place> nearest;
  double least = farthest_pole * farthest_pole;
  for (const auto& pole : poles_) {
    Place at = place;
    if (!pole->move(at)) continue;
    double distance = 0;
    for (std::size_t v = 0; v < at.size(); ++v) distance += std::pow((at[v] - place[v]) / sizes_[v], 2);
    if (distance >= least) continue;
    least = distance;
    nearest = std::move(at);
  }
  return nearest;
}

CarriedSheet::Held CarriedSheet::side_near(const Place& place) const {
  Held nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < place.size(); ++v)
    for (const double side : {lower_[v], upper_[v]})
      if (const double distance = std::abs(place[v] - side) / sizes_[v]; distance < least) {
        least = distance;
        nearest = {static_cast<int>(v), side};
      }
  return nearest;
}

std::vector<int> CarriedSheet::candidates(const LocusName& name) const {
  std::vector<int> all, same;
  for (std::size_t f = 0; f < problem_->factors.size(); ++f) {
    const LocusFactor& factor = problem_->factors[f];
    if (factor.role != role_of(name.kind) || !vanishes_with(*problem_, factor, name.vanishing)) continue;
    all.push_back(static_cast<int>(f));
    if (factor.expression == name.factor && !name.factor.empty()) same.push_back(static_cast<int>(f));
  }
  return same.empty() ? all : same;
}

int CarriedSheet::factor_of(const LocusName& name, const std::vector<Place>& places) {
  const std::vector<int> factors = candidates(name);
  if (factors.size() <= 1) return factors.empty() ? -1 : factors.front();
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const int f : factors) {
    std::vector<double> distances;
    for (const Place& place : places)
      if (const auto at = inside(place)) distances.push_back(newton_for({f}).distance(*at));
    if (distances.empty()) continue;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    if (*middle < least) {
      least = *middle;
      best = f;
    }
  }
  return best;
}

}  // namespace clearloci::loci
