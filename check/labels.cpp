#include "check/labels.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::check {
namespace {

using core::Quantity;

constexpr int newton_steps = 14, near = 200, nearer = 260;  // the latter: distances as powers of 1/2

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

}  // namespace

std::optional<std::set<Reaction>> label_at(const mechanism::Mechanism& m, const CertificateFile& c,
                                           const SheetCells& sheet, const core::Point2& at) {
  Sheet function(parts_of(c, sheet.mode, sheet.at_zero),
                 {&c.functions[static_cast<std::size_t>(sheet.function)].program}, identity_bits);
  std::array<Interval, 2> place = {Interval(at[0], identity_bits), Interval(at[1], identity_bits)};
  int axis = -1;
  for (int i = 0; i < newton_steps; ++i) {
    if (!function.enter(place[0], place[1]) || !function.is_inner()) return std::nullopt;
    function.differentiate();
    if (axis < 0) axis = std::abs(function.slope(0, 0).middle()) > std::abs(function.slope(0, 1).middle()) ? 0 : 1;
    const Interval step = function.value(0) / function.slope(0, axis);
    if (!step.is_finite()) return std::nullopt;
    place[static_cast<std::size_t>(axis)] = middle_of(place[static_cast<std::size_t>(axis)] - step);
  }
  const std::vector<mechanism::Unknown> unknowns = reactions_of(m);
  const Sides sides = sides_of(c, sheet.mode);
  const auto beside = [&](int direction, int power) -> std::optional<Solution> {
    std::array<Interval, 2> there = place;
    Interval& moved = there[static_cast<std::size_t>(axis)];
    moved = moved + Interval(direction * std::ldexp(1.0, -power), identity_bits);
    const std::optional<Posture> here = posture(m, sides, there[0], there[1]);
    if (!here || !std::all_of(here->squares.begin(), here->squares.end(), [](const auto& q) { return q.sign() > 0; }))
      return std::nullopt;
    return solve(m, *here, there[0], there[1]);
  };
  for (const int direction : {1, -1}) {
    const std::optional<Solution> a = beside(direction, near), b = beside(direction, nearer);
    if (!a || !b) continue;
    std::vector<double> order(unknowns.size(), 0.0);  // infinite: zero in every pose
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      order[k] = a->reactions[k].sign() == 0 ? HUGE_VAL
                                             : (size_of(a->reactions[k]) - size_of(b->reactions[k])) / (nearer - near);
    const auto wanted = [&](const std::string& joint, Quantity quantity) {
      return std::find(c.joints.begin(), c.joints.end(), joint) != c.joints.end() &&
             std::find(c.quantities.begin(), c.quantities.end(), quantity) != c.quantities.end();
    };
    std::set<Reaction> label;
    bool any = false;
    for (std::size_t j = 0; j < m.joints.size(); ++j) {
      const mechanism::Joint& joint = m.joints[j];
      const std::vector<Quantity> parts = mechanism::force_components(m, joint);
      double least = HUGE_VAL;
      bool borne = false;
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        if (unknowns[k].joint != static_cast<int>(j)) continue;
        const Quantity quantity = unknowns[k].quantity;
        if (std::find(parts.begin(), parts.end(), quantity) != parts.end()) {
          least = std::min(least, order[k]);
          borne = borne || order[k] != HUGE_VAL;
        } else if (quantity != Quantity::N && quantity != Quantity::T && order[k] > 0.25 && order[k] != HUGE_VAL) {
          label.insert({joint.name, quantity});
          any = any || wanted(joint.name, quantity);
        }
      }
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        if (unknowns[k].joint != static_cast<int>(j) || order[k] == HUGE_VAL || order[k] <= 0.25) continue;
        const bool guide = unknowns[k].quantity == Quantity::N || unknowns[k].quantity == Quantity::T;
        if (!guide && std::find(parts.begin(), parts.end(), unknowns[k].quantity) == parts.end()) continue;
        const bool component =
            std::find(c.quantities.begin(), c.quantities.end(), unknowns[k].quantity) != c.quantities.end();
        if (!component || (!guide && least > 0.25 && order[k] < least + 0.25)) continue;
        label.insert({joint.name, unknowns[k].quantity});
        any = any || wanted(joint.name, unknowns[k].quantity);
      }
      if (!borne || least <= 0.25) continue;
      label.insert({joint.name, Quantity::f});
      any = any || wanted(joint.name, Quantity::f);
    }
    return any ? label : std::set<Reaction>{};
  }
  return std::nullopt;
}

}  // namespace clearloci::check
