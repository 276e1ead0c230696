#include "symbolic/factor_text.hpp"

#include "core/text.hpp"

namespace clearloci::symbolic {
namespace {

/// p with (v - from) / scale in the place of v.
Poly shifted(const Poly& p, int variable, const core::Rational& from, const core::Rational& scale) {
  const std::vector<Poly> powers = p.coefficients(variable);
  if (powers.size() <= 1) return p;
  const Poly way = (Poly::variable(p.ring(), variable) - Poly(p.ring(), from)).scaled(1 / scale);
  Poly sum(p.ring());
  for (auto power = powers.rbegin(); power != powers.rend(); ++power) sum = sum * way + *power;
  return sum;
}

}  // namespace

std::string FactorText::of(const Poly& p) const {
  std::string inside = core::to_string(p.plain(), geometry_.ring().names());
  if (!mechanism_.frame) return inside;
  if (std::string outside = in_file(p); outside != inside) noted_.emplace(inside, std::move(outside));
  return inside;
}

void FactorText::note(const std::string& in_frame, std::string in_file) const {
  noted_.emplace(in_frame, std::move(in_file));
}

std::string FactorText::in_file(const Poly& p) const {
  const mechanism::Frame& frame = *mechanism_.frame;
  Poly outside = p;
  for (int i = 0; i < geometry_.coordinates(); ++i)
    if (!geometry_.charts()[static_cast<std::size_t>(i)])
      outside = shifted(outside, i, frame.from[static_cast<std::size_t>(i)], frame.scale);
  for (const InverseLength& length : geometry_.inverse_lengths())
    outside = shifted(outside, length.variable, 0, 1 / frame.scale);
  for (const ConstructedPoint& point : geometry_.constructed()) {
    outside = shifted(outside, point.x, frame.origin[0], frame.scale);
    outside = shifted(outside, point.y, frame.origin[1], frame.scale);
    if (point.z >= 0) outside = shifted(outside, point.z, frame.origin[2], frame.scale);
  }
  if (p.primitive() == p) outside = outside.primitive();
  return core::to_string(outside.plain(), geometry_.ring().names());
}

}  // namespace clearloci::symbolic
