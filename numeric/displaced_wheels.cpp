#include "numeric/displaced_wheels.hpp"

#include <cmath>

namespace clearloci::numeric {
namespace {

using Eigen::Vector3d;

Vector3d across(const Vector3d& v) { return {-v.y(), v.x(), 0}; }
double turn(const Vector3d& a, const Vector3d& b) { return a.x() * b.y() - a.y() * b.x(); }

Vector3d turned(const Vector3d& v, double angle) { return std::cos(angle) * v + std::sin(angle) * across(v); }

/// Without the digits that a difference of angles would lose.
double angle_between(const Vector3d& from, const Vector3d& to) {
  return std::atan2(turn(from, to - from), from.dot(to));
}

}  // namespace

Wheels::Wheels(const Vector3d& first, const Vector3d& second, const Vector3d& pitch, const Vector3d& axis)
    : first_(first), way_(second - first), pitch_(pitch), axis_(axis) {}

Meshed Wheels::teeth(const Vector3d& first, const Vector3d& second, double t1, double t2) const {
  // To where the line touches the first base circle.
  const Vector3d touch = (pitch_ - first_) - axis_.dot(pitch_ - first_) * axis_;
  const double r1 = touch.norm(), difference = touch.dot(way_) / r1;  // r1 - r2
  const double r2 = r1 - difference, side = turn(way_, touch) > 0 ? 1 : -1;
  const Vector3d way = second - first, more = way - way_;
  const double d = way_.norm(), now = way.norm();
  const double span = std::sqrt(d * d - difference * difference);
  const double span_now = std::sqrt(now * now - difference * difference);
  const double longer = more.dot(way_ + way) / (span_now + span);
  // Of beta: its sine and cosine are (span, difference) / d.
  const double beta = std::atan2(span, difference);
  const double opened = std::atan2(difference * longer, difference * difference + span * span_now);
  const double phi = angle_between(way_, way) + side * opened;
  const Vector3d n = turned(way / now, side * (beta + opened)), line = -side * across(n);
  // The line leads from the first tangent point to the second, the force from the first to the pitch point.
  const double sense = axis_.dot(way_) > 0 ? 1 : -1;
  return {first + r1 * n, sense * line, sense * (side * (r1 * (t1 - phi) - r2 * (t2 - phi)) + longer), 1};
}

Meshed Wheels::belt(const Vector3d& first, const Vector3d& second, double radius, double t1, double t2) const {
  const double d2 = way_.squaredNorm(), share = (pitch_ - first_).dot(way_) / d2;  // r1 / (r1 - r2)
  const Vector3d way = second - first;
  const double d = std::sqrt(d2), now = way.norm(), side = turn(way_, axis_) > 0 ? 1 : -1;
  const double difference = radius / share;
  const double along = std::sqrt((1 - std::pow(difference / now, 2)) / (1 - std::pow(difference / d, 2)));
  // In units of r1 - r2, which is d times the sine of the spans' inclination.
  const double given = share * t1 - (share - 1) * t2 - angle_between(way_, way);
  return {first + share * way, side * d / now * across(way / now), -side * d * given, along};
}

Meshed Wheels::rack(const Vector3d& first, const Vector3d& pitch, const Eigen::Quaterniond& by, double t1,
                    double t2) const {
  const Vector3d touch = (pitch_ - first_) - axis_.dot(pitch_ - first_) * axis_;
  const Vector3d axis = by * axis_, before = pitch_ - first_, after = pitch - first;
  const double along = (axis - axis_).dot(before) + axis.dot(after - before);
  return {first + by * touch, axis, along - axis_.dot(across(touch)) * (t1 - t2), 1};
}

}  // namespace clearloci::numeric
