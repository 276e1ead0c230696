// Vectors between the points of a sampled posture (posture_sample.hpp), in floating point. Private to mechanism/.
#pragma once

#include <array>
#include <cmath>

namespace clearloci::mechanism::place_vectors {

using Vector = std::array<double, 3>;  ///< z = 0 in the plane

inline Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vector& a) { return std::hypot(a[0], a[1], a[2]); }
inline double distance(const Vector& a, const Vector& b) { return length(minus(a, b)); }
/// What has no length stays as it is.
inline Vector unit(const Vector& a) {
  const double size = length(a);
  return size > 0 ? Vector{a[0] / size, a[1] / size, a[2] / size} : a;
}

}  // namespace clearloci::mechanism::place_vectors
