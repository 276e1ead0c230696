// Teeth and belts whose wheels have moved by clearances (displaced.hpp). Involute teeth push along the common tangent
// of the base circles, a belt pulls along those of its pulleys; what a line that is wound on both wheels gives between
// them is the way that its force moves (virtual work). With radii of base circles or pulleys r1, r2 (r2 < 0 where the
// line crosses the way w of the centres, of length d and direction psi), n at the angle beta to w with cos beta = (r1 -
// r2)/d on the side s = +-1, and the wheels turned by t1, t2:
//     teeth  s (r1 t1 - r2 t2 - (r1 - r2)(psi + s beta)) + d sin beta
//     belt   r1 t1 - r2 t2 - (r1 - r2) psi, of the difference of both spans
// In the plane; places are from one common origin, m.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace clearloci::numeric {

struct Meshed {
  Eigen::Vector3d at;     ///< on the line of action, now
  Eigen::Vector3d force;  ///< of the unknown 1, on the second wheel
  double apart = 0;       ///< what the wheels have moved from each other along it, m
  double along = 1;       ///< of a belt: the cosine of its spans' inclination to w, over what it was
};

/// As they were: the centres, the pitch point and the direction of the force.
class Wheels {
 public:
  Wheels(const Eigen::Vector3d& first, const Eigen::Vector3d& second, const Eigen::Vector3d& pitch,
         const Eigen::Vector3d& axis);

  /// The same with the centres `first` and `second`, and the wheels turned, rad.
  Meshed teeth(const Eigen::Vector3d& first, const Eigen::Vector3d& second, double t1, double t2) const;
  /// `radius`: of the first pulley.
  Meshed belt(const Eigen::Vector3d& first, const Eigen::Vector3d& second, double radius, double t1, double t2) const;
  /// `pitch`: the place of the rack that was at the pitch point.
  Meshed rack(const Eigen::Vector3d& first, const Eigen::Vector3d& pitch, const Eigen::Quaterniond& turned, double t1,
              double t2) const;

 private:
  Eigen::Vector3d first_, way_, pitch_, axis_;
};

}  // namespace clearloci::numeric
