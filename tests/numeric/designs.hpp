// Mechanisms written as structs, for tests of the numeric folder: no reader is needed to doubt the arithmetic.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::test {

using core::Expression;
using mechanism::Side;

Expression number(const std::string& decimal);
/// The double's exact value.
Expression number(double value);
Expression symbol(const std::string& name);
Expression sum(const Expression& a, const Expression& b);
Expression product(const Expression& a, const Expression& b);

/// Points, links and joints by name; `finish` adds default centres of mass.
class MechanismBuilder {
 public:
  MechanismBuilder();  ///< free coordinates x and y in [-2, 2]

  MechanismBuilder& box(double x0, double x1, double y0, double y1);
  MechanismBuilder& coordinates(std::vector<mechanism::Coordinate> coordinates);
  MechanismBuilder& parameter(const std::string& name, const std::string& decimal);
  MechanismBuilder& point(const std::string& name, const Expression& x, const Expression& y);
  MechanismBuilder& point(const std::string& name, double x, double y) { return point(name, number(x), number(y)); }
  MechanismBuilder& dyad(const std::string& name, const std::string& from, const std::string& to, double a, double b,
                         Side side);
  MechanismBuilder& offset(const std::string& name, const std::string& first, const std::string& second, double along,
                           double left);
  MechanismBuilder& mean(const std::string& name, const std::string& first, const std::string& second);
  MechanismBuilder& link(const std::string& name, const std::vector<std::string>& points, double mass = 0);
  MechanismBuilder& joint(const std::string& name, const std::string& from, const std::string& to,
                          const std::string& at, bool actuated = false);
  MechanismBuilder& end_effector(const std::string& link, const std::string& at);
  MechanismBuilder& load(const std::string& link, const std::string& at, double fx, double fy, double couple = 0);
  MechanismBuilder& load(const std::string& link, const std::string& at, const Expression& fx, const Expression& fy);
  MechanismBuilder& gravity(double gx, double gy);
  /// `angular`: for the actuated joints.
  MechanismBuilder& clearance(const std::string& joint, double radial, double angular = 0);

  mechanism::Mechanism finish();

 private:
  int point_index(const std::string& name) const;
  int link_index(const std::string& name) const;
  MechanismBuilder& add_point(const std::string& name, mechanism::PointForm form);

  mechanism::Mechanism m_;
};

/// A planar 5R: A1 at the origin. The defaults are the paper's example under its vertical load.
struct FiveBar {
  double base_x = 0.5, base_y = 0;                ///< A2
  double a1 = 0.5, b1 = 0.5, a2 = 0.5, b2 = 0.5;  ///< |A1B1|, |B1P|, |A2B2|, |B2P|
  Side side1 = Side::right, side2 = Side::left;
  double fx = 0, fy = -100, couple = 0;  ///< at P, on PB2
  double mass = 1;
  bool weighs = false;  ///< gravity (0, -9.81)
  std::array<double, 4> box = {-0.5, 1.0, -1.0, 1.0};
};

mechanism::Mechanism five_bar(const FiveBar& design = {});

/// The same clearances in every joint, m, and in every actuator, rad.
mechanism::Mechanism with_clearances(mechanism::Mechanism mechanism, double radial, double angular);

/// 3-RRR platform held at orientation `turn` (rad): 21 equations, a core of three.
mechanism::Mechanism three_rrr(double turn, double fx, double fy, double couple, bool weighs);

/// A 5R whose second crank is driven through two more links from a third pivot: a dyad upon a dyad, an `on` point,
/// a `mean` centre, 18 equations.
mechanism::Mechanism driven_five_bar(double fx, double fy, bool weighs);

}  // namespace clearloci::test
