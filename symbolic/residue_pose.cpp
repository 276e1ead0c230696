#include "symbolic/residue_pose.hpp"

namespace clearloci::symbolic {
namespace {

Residue without_pattern(unsigned long seed) {
  seed += 0x9E3779B97F4A7C15UL;
  seed = (seed ^ (seed >> 30)) * 0xBF58476D1CE4E5B9UL;
  seed = (seed ^ (seed >> 27)) * 0x94D049BB133111EBUL;
  return {(seed ^ (seed >> 31)) % Residue::prime, 0};
}

}  // namespace

ResiduePose::ResiduePose(const Geometry& geometry, std::size_t number) {
  const Ring& ring = geometry.ring();
  const auto variables = static_cast<std::size_t>(ring.size());
  for (std::size_t v = 0; v < variables; ++v) at_.push_back(without_pattern(number * variables + v + 1));
  // Cosine and sine are a point of the unit circle: (1 - t^2, 2 t) / (1 + t^2).
  for (const mechanism::Coordinate& coordinate : geometry.mechanism().coordinates) {
    const int cosine = ring.index("cos(" + coordinate.name + ")"), sine = ring.index("sin(" + coordinate.name + ")");
    if (cosine < 0 || sine < 0) continue;
    const Residue t = at_[static_cast<std::size_t>(cosine)], one{1, 0}, below = inverse(one + t * t);
    at_[static_cast<std::size_t>(cosine)] = (one + -(t * t)) * below;
    at_[static_cast<std::size_t>(sine)] = (t + t) * below;
  }
}

Residue ResiduePose::value(const core::Polynomial& polynomial) const {
  Residue result;
  for (const core::Term& term : polynomial.terms) {
    Residue product{residue(term.coefficient), 0};
    for (std::size_t v = 0; v < term.exponents.size(); ++v)
      if (term.exponents[v] > 0) product = product * power(at_[v], term.exponents[v]);
    result = result + product;
  }
  return result;
}

}  // namespace clearloci::symbolic
