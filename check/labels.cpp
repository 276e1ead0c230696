#include "check/labels.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/guide.hpp"

namespace clearloci::check {
namespace {

using core::Quantity;

// The latter: distances as powers of 1/2. Rationals that stand for irrational lengths are off by less than 2^-99.
constexpr int newton_steps = 14, near = 50, nearer = 80;
// Orders are halves of integers; those of 1/2 and more are told from 0 by this.
constexpr double no_order = 0.25;
constexpr double nothing = 0x1p-300;

/// log2 |a|.
double size_of(const Interval& a) {
  mpfr_t m;
  mpfr_init2(m, a.bits());
  mpfi_mid(m, a.get());
  long exponent = 0;
  const double mantissa = mpfr_get_d_2exp(&exponent, m, MPFR_RNDN);
  mpfr_clear(m);
  return static_cast<double>(exponent) + std::log2(std::abs(mantissa));
}

/// To what order each reaction vanishes at a place; infinite: it is zero in every pose.
std::optional<std::vector<double>> orders_at(const mechanism::Mechanism& m, const Sides& sides,
                                             const PrecisePlace& place) {
  const auto beside = [&](int direction, int power) -> std::optional<Solution> {
    std::array<Interval, 2> there = place.at;
    there[place.axis] = there[place.axis] + Interval(direction * std::ldexp(1.0, -power), identity_bits);
    const std::optional<Posture> here = posture(m, sides, there[0], there[1]);
    if (!here || !std::all_of(here->squares.begin(), here->squares.end(), [](const auto& q) { return q.sign() > 0; }))
      return std::nullopt;
    return solve(m, *here, there[0], there[1]);
  };
  for (const int direction : {1, -1}) {
    const std::optional<Solution> a = beside(direction, near), b = beside(direction, nearer);
    if (!a || !b) continue;
    std::vector<double> orders;
    for (std::size_t k = 0; k < a->reactions.size(); ++k)
      orders.push_back(a->reactions[k].sign() == 0
                           ? HUGE_VAL
                           : (size_of(a->reactions[k]) - size_of(b->reactions[k])) / (nearer - near));
    return orders;
  }
  return std::nullopt;
}

}  // namespace

std::optional<PrecisePlace> place_near(const CertificateFile& c, const SheetCells& sheet, const core::Point2& at) {
  Sheet function(parts_of(c, sheet.mode, sheet.at_zero),
                 {&c.functions[static_cast<std::size_t>(sheet.function)].program}, identity_bits);
  PrecisePlace place = {{Interval(at[0], identity_bits), Interval(at[1], identity_bits)}, 0};
  for (int i = 0; i < newton_steps; ++i) {
    if (!function.enter(place.at[0], place.at[1]) || !function.is_inner()) return std::nullopt;
    function.differentiate();
    if (i == 0) place.axis = std::abs(function.slope(0, 0).middle()) > std::abs(function.slope(0, 1).middle()) ? 0 : 1;
    const Interval step = function.value(0) / function.slope(0, static_cast<int>(place.axis));
    if (!step.is_finite()) return std::nullopt;
    place.at[place.axis] = middle_of(place.at[place.axis] - step);
  }
  return place;
}

bool vanishes_at(const CertificateFile& c, const SheetCells& sheet, const core::StraightLine& program,
                 const PrecisePlace& place) {
  Sheet function(parts_of(c, sheet.mode, sheet.at_zero), {&program}, identity_bits);
  return function.enter(place.at[0], place.at[1]) &&
         std::max(std::abs(function.value(0).lower()), std::abs(function.value(0).upper())) < nothing;
}

std::optional<std::set<Reaction>> label_at(const mechanism::Mechanism& m, const CertificateFile& c,
                                           const SheetCells& sheet, const core::Point2& at) {
  const std::optional<PrecisePlace> place = place_near(c, sheet, at);
  if (!place) return std::nullopt;
  const auto orders = orders_at(m, sides_of(c, sheet.mode), *place);
  if (!orders) return std::nullopt;
  const std::vector<mechanism::Unknown> unknowns = reactions_of(m);
  const auto wants = [&](Quantity q) {
    return std::find(c.quantities.begin(), c.quantities.end(), q) != c.quantities.end();
  };
  std::set<Reaction> label;
  bool any = false;
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    const mechanism::Joint& joint = m.joints[j];
    const std::vector<Quantity> parts = mechanism::contact_components(m, joint);
    const auto is_part = [&](Quantity q) { return std::find(parts.begin(), parts.end(), q) != parts.end(); };
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      if (unknowns[k].joint == static_cast<int>(j) && is_part(unknowns[k].quantity))
        least = std::min(least, (*orders)[k]);
    const bool force = least > no_order && least != HUGE_VAL;
    const bool asked = std::find(c.joints.begin(), c.joints.end(), joint.name) != c.joints.end();
    std::set<Quantity> quantities;
    if (force) quantities.insert(Quantity::f);
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const Quantity quantity = unknowns[k].quantity;
      const double order = (*orders)[k];
      if (unknowns[k].joint != static_cast<int>(j) || order == HUGE_VAL || order <= no_order) continue;
      const bool guide = quantity == Quantity::N || quantity == Quantity::T;
      // Components are named where they are asked for, and vanish beyond what the force itself does.
      if ((guide || is_part(quantity)) && !wants(quantity)) continue;
      any = any || (asked && wants(quantity));
      if (is_part(quantity) && force && order < least + no_order) continue;
      quantities.insert(quantity);
    }
    for (const Quantity quantity : quantities) {
      label.insert({joint.name, quantity});
      any = any || (asked && wants(quantity));
    }
  }
  return any ? label : std::set<Reaction>{};
}

std::string names(const std::set<Reaction>& reactions) {
  std::string text;
  for (const auto& [joint, quantity] : reactions)
    text += (text.empty() ? "" : ", ") + core::to_string(quantity) + "_" + joint;
  return text.empty() ? "nothing" : text;
}

}  // namespace clearloci::check
