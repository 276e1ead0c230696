// Vectors, rotations and poses in doubles, as other programs' files give them. Private to mechanism/.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace clearloci::mechanism::imports {

using Vec = std::array<double, 3>;

inline Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec operator-(const Vec& a) { return {-a[0], -a[1], -a[2]}; }
inline Vec operator*(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Vec& a) { return std::sqrt(dot(a, a)); }
inline double distance(const Vec& a, const Vec& b) { return norm(a - b); }
/// Of length 1; x where there is no direction.
inline Vec unit(const Vec& a) {
  const double size = norm(a);
  return size > 0 ? (1 / size) * a : Vec{1, 0, 0};
}
/// Some direction at a right angle to the unit vector a.
inline Vec across(const Vec& a) {
  std::size_t least = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(a[i]) < std::abs(a[least])) least = i;
  Vec e{};
  e[least] = 1;
  return unit(cross(a, e));
}

/// Columns: the axes of a frame.
struct Rotation {
  Vec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Vec operator*(const Vec& v) const { return v[0] * x + v[1] * y + v[2] * z; }
  Rotation operator*(const Rotation& other) const { return {*this * other.x, *this * other.y, *this * other.z}; }
  Rotation transposed() const { return {{x[0], y[0], z[0]}, {x[1], y[1], z[1]}, {x[2], y[2], z[2]}}; }
};

/// A frame whose z is the unit vector a.
inline Rotation frame_along(const Vec& a) {
  const Vec x = across(a);
  return {x, cross(a, x), a};
}

/// By an angle, rad, about a unit vector (Rodrigues).
inline Rotation turn(const Vec& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](const Vec& v) { return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis; };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
}

/// Rz(yaw) Ry(pitch) Rx(roll): URDF and SDF.
inline Rotation roll_pitch_yaw(double roll, double pitch, double yaw) {
  return turn({0, 0, 1}, yaw) * turn({0, 1, 0}, pitch) * turn({1, 0, 0}, roll);
}

/// (w, x, y, z), of any length but 0.
inline Rotation quaternion(double w, double x, double y, double z) {
  const double n = std::sqrt(w * w + x * x + y * y + z * z);
  const double sine = std::sqrt(x * x + y * y + z * z);
  if (!(sine > 0) || !(n > 0)) return {};
  return turn((1 / sine) * Vec{x, y, z}, 2 * std::atan2(sine, w));
}

struct Pose {
  Rotation turned;
  Vec at{};

  Vec operator*(const Vec& point) const { return at + turned * point; }
  Pose operator*(const Pose& other) const { return {turned * other.turned, *this * other.at}; }
  Pose inverse() const {
    const Rotation back = turned.transposed();
    return {back, -(back * at)};
  }
};

/// A symmetric matrix: an inertia tensor.
struct Tensor {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

  Tensor operator+(const Tensor& o) const { return {xx + o.xx, yy + o.yy, zz + o.zz, xy + o.xy, xz + o.xz, yz + o.yz}; }
  Vec operator*(const Vec& v) const {
    return {xx * v[0] + xy * v[1] + xz * v[2], xy * v[0] + yy * v[1] + yz * v[2], xz * v[0] + yz * v[1] + zz * v[2]};
  }
};

/// R I R^T.
inline Tensor turned(const Rotation& r, const Tensor& inertia) {
  const Rotation rows = r.transposed();
  const Vec ix = inertia * rows.x, iy = inertia * rows.y, iz = inertia * rows.z;
  return {dot(rows.x, ix), dot(rows.y, iy), dot(rows.z, iz), dot(rows.x, iy), dot(rows.x, iz), dot(rows.y, iz)};
}

/// Of a point mass at the way d from what the moments are about (Steiner).
inline Tensor point_inertia(double mass, const Vec& d) {
  return {mass * (d[1] * d[1] + d[2] * d[2]),
          mass * (d[0] * d[0] + d[2] * d[2]),
          mass * (d[0] * d[0] + d[1] * d[1]),
          -mass * d[0] * d[1],
          -mass * d[0] * d[2],
          -mass * d[1] * d[2]};
}

}  // namespace clearloci::mechanism::imports
