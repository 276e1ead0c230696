#include "numeric/motion_law.hpp"

#include <numbers>

namespace clearloci::numeric {

namespace {

/// Appends a piece of the given length and jerk that continues the last one with acceleration `a`.
void extend(std::vector<LawPiece>& pieces, double length, double a, double j) {
  if (!(length > 0)) return;
  LawPiece next;
  if (!pieces.empty()) {
    const LawPiece& last = pieces.back();
    const double h = last.end - last.start;
    next.start = last.end;
    next.s0 = last.s0 + h * (last.v + h * (last.a / 2 + h * last.j / 6));
    next.v = last.v + h * (last.a + h * last.j / 2);
  }
  next.end = next.start + length;
  next.a = a;
  next.j = j;
  pieces.push_back(next);
}

std::vector<LawPiece> ramps(double accelerating, double jerking) {
  const double ramp = jerking * accelerating, hold = accelerating - 2 * ramp, cruise = 1 - 2 * accelerating;
  const double speed = 1 / (1 - accelerating);        // of the cruise: the distance is 1
  const double most = speed / (accelerating - ramp);  // acceleration
  const double jerk = ramp > 0 ? most / ramp : 0;
  std::vector<LawPiece> pieces;
  extend(pieces, ramp, 0, jerk);
  extend(pieces, hold, most, 0);
  extend(pieces, ramp, most, -jerk);
  extend(pieces, cruise, 0, 0);
  extend(pieces, ramp, 0, -jerk);
  extend(pieces, hold, -most, 0);
  extend(pieces, ramp, -most, jerk);
  pieces.back().end = 1;
  return pieces;
}

}  // namespace

CompiledLaw compile(const mechanism::MotionLaw& law) {
  using Kind = mechanism::LawKind;
  if (law.kind == Kind::trapezoidal) return {law.kind, ramps(core::to_double(law.accelerating), 0)};
  if (law.kind == Kind::s_curve)
    return {law.kind, ramps(core::to_double(law.accelerating), core::to_double(law.jerking))};
  if (law.kind == Kind::constant) return {law.kind, {LawPiece{.v = 1}}};
  return {law.kind, {LawPiece{}}};
}

Series covered(const CompiledLaw& law, std::size_t piece, const Series& sigma) {
  if (law.kind == mechanism::LawKind::cycloidal) {
    constexpr double turn = 2 * std::numbers::pi;
    return sigma - (1 / turn) * sin(turn * sigma);
  }
  if (law.kind == mechanism::LawKind::polynomial_345)
    return sigma * sigma * sigma * (Series(10.0) - sigma * (Series(15.0) - 6.0 * sigma));
  const LawPiece& p = law.pieces[piece];
  const Series h = sigma - Series(p.start);
  return Series(p.s0) + h * (Series(p.v) + h * (Series(p.a / 2) + (p.j / 6) * h));
}

double time_of(const CompiledLaw& law, double s) {
  if (s <= 0) return 0;
  if (s >= 1) return 1;
  double low = 0, high = 1;  // s rises throughout
  for (int i = 0; i < 100 && high > low; ++i) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    std::size_t piece = 0;
    while (piece + 1 < law.pieces.size() && law.pieces[piece].end < middle) ++piece;
    (covered(law, piece, middle).value() < s ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace clearloci::numeric
