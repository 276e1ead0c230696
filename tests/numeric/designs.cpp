#include "tests/numeric/designs.hpp"

#include <cmath>

namespace clearloci::test {

using mechanism::Mechanism;

Expression number(const std::string& decimal) { return Expression::number(core::rational_from_decimal(decimal)); }
Expression number(double value) { return Expression::number(core::Rational(value)); }
Expression symbol(const std::string& name) { return Expression::symbol(name); }
Expression sum(const Expression& a, const Expression& b) { return Expression::apply(Expression::Kind::add, {a, b}); }
Expression product(const Expression& a, const Expression& b) {
  return Expression::apply(Expression::Kind::multiply, {a, b});
}

MechanismBuilder::MechanismBuilder() {
  m_.name = "test";
  m_.file = "test.yaml";
  box(-2, 2, -2, 2);
}

MechanismBuilder& MechanismBuilder::box(double x0, double x1, double y0, double y1) {
  const auto coordinate = [](const std::string& name, double low, double high) {
    return mechanism::Coordinate{name, false, number(low), number(high), core::Rational(low), core::Rational(high)};
  };
  m_.coordinates = {coordinate("x", x0, x1), coordinate("y", y0, y1)};
  return *this;
}

MechanismBuilder& MechanismBuilder::coordinates(std::vector<mechanism::Coordinate> coordinates) {
  m_.coordinates = std::move(coordinates);
  return *this;
}

MechanismBuilder& MechanismBuilder::parameter(const std::string& name, const std::string& decimal) {
  m_.parameters.push_back({name, number(decimal), core::rational_from_decimal(decimal), true});
  return *this;
}

int MechanismBuilder::point_index(const std::string& name) const {
  for (std::size_t i = 0; i < m_.points.size(); ++i) {
    if (m_.points[i].name == name) return static_cast<int>(i);
  }
  throw std::out_of_range("no point " + name);
}

int MechanismBuilder::link_index(const std::string& name) const {
  if (name == "ground") return mechanism::ground;
  for (std::size_t i = 0; i < m_.links.size(); ++i) {
    if (m_.links[i].name == name) return static_cast<int>(i);
  }
  throw std::out_of_range("no link " + name);
}

MechanismBuilder& MechanismBuilder::add_point(const std::string& name, mechanism::PointForm form) {
  m_.points.push_back({name, std::move(form), false, {}});
  return *this;
}

MechanismBuilder& MechanismBuilder::point(const std::string& name, const Expression& x, const Expression& y) {
  return add_point(name, mechanism::ExplicitPoint{{x, y}});
}

MechanismBuilder& MechanismBuilder::dyad(const std::string& name, const std::string& from, const std::string& to,
                                         double a, double b, Side side) {
  return add_point(name, mechanism::DyadPoint{point_index(from), point_index(to), number(a), number(b), side});
}

MechanismBuilder& MechanismBuilder::offset(const std::string& name, const std::string& first, const std::string& second,
                                           double along, double left) {
  return add_point(name, mechanism::OffsetPoint{point_index(first), point_index(second), number(along), number(left)});
}

MechanismBuilder& MechanismBuilder::mean(const std::string& name, const std::string& first, const std::string& second) {
  return add_point(name, mechanism::MeanPoint{point_index(first), point_index(second)});
}

MechanismBuilder& MechanismBuilder::link(const std::string& name, const std::vector<std::string>& points, double mass) {
  mechanism::Link link;
  link.name = name;
  for (const auto& p : points) link.points.push_back(point_index(p));
  link.mass = number(mass);
  m_.links.push_back(link);
  return *this;
}

MechanismBuilder& MechanismBuilder::joint(const std::string& name, const std::string& from, const std::string& to,
                                          const std::string& at, bool actuated) {
  mechanism::Joint joint;
  joint.name = name;
  joint.from = link_index(from);
  joint.to = link_index(to);
  joint.at = point_index(at);
  joint.actuated = actuated;
  m_.joints.push_back(joint);
  return *this;
}

MechanismBuilder& MechanismBuilder::end_effector(const std::string& link, const std::string& at) {
  m_.end_effector_link = link_index(link);
  m_.end_effector_point = point_index(at);
  return *this;
}

MechanismBuilder& MechanismBuilder::load(const std::string& link, const std::string& at, double fx, double fy,
                                         double couple) {
  load(link, at, number(fx), number(fy));
  m_.loads.back().couple = number(couple);
  return *this;
}

MechanismBuilder& MechanismBuilder::load(const std::string& link, const std::string& at, const Expression& fx,
                                         const Expression& fy) {
  m_.loads.push_back({link_index(link), point_index(at), {fx, fy}, Expression(), {}});
  return *this;
}

MechanismBuilder& MechanismBuilder::gravity(double gx, double gy) {
  m_.gravity = {number(gx), number(gy)};
  return *this;
}

MechanismBuilder& MechanismBuilder::clearance(const std::string& joint, double radial, double angular) {
  for (auto& j : m_.joints) {
    if (j.name == joint) j.clearance = mechanism::Clearance{number(radial), number(angular)};
  }
  return *this;
}

Mechanism MechanismBuilder::finish() {
  for (auto& link : m_.links) {
    link.centre_of_mass = static_cast<int>(m_.points.size());
    m_.points.push_back({"com " + link.name, mechanism::MeanPoint{link.points[0], link.points[1]}, true, {}});
  }
  return m_;
}

Mechanism five_bar(const FiveBar& d) {
  MechanismBuilder b;
  b.box(d.box[0], d.box[1], d.box[2], d.box[3]);
  b.point("A1", 0, 0).point("A2", d.base_x, d.base_y).point("P", symbol("x"), symbol("y"));
  b.dyad("B1", "A1", "P", d.a1, d.b1, d.side1).dyad("B2", "A2", "P", d.a2, d.b2, d.side2);
  b.link("A1B1", {"A1", "B1"}, d.mass).link("B1P", {"B1", "P"}, d.mass);
  b.link("PB2", {"P", "B2"}, d.mass).link("B2A2", {"B2", "A2"}, d.mass);
  b.joint("A1", "ground", "A1B1", "A1", true).joint("B1", "A1B1", "B1P", "B1").joint("P", "B1P", "PB2", "P");
  b.joint("B2", "B2A2", "PB2", "B2").joint("A2", "ground", "B2A2", "A2", true);
  b.end_effector("PB2", "P").load("PB2", "P", d.fx, d.fy, d.couple);
  if (d.weighs) b.gravity(0, -9.81);
  return b.finish();
}

Mechanism with_clearances(Mechanism m, double radial, double angular) {
  for (auto& joint : m.joints)
    joint.clearance = mechanism::Clearance{number(radial), number(joint.actuated ? angular : 0.0)};
  return m;
}

Mechanism three_rrr(double turn, double fx, double fy, double couple, bool weighs) {
  MechanismBuilder b;
  b.point("P", symbol("x"), symbol("y"));
  const double pi = std::acos(-1.0);
  for (int leg = 0; leg < 3; ++leg) {
    const std::string i = std::to_string(leg + 1);
    const double direction = 2 * pi * leg / 3 + 0.1 * leg;
    b.point("A" + i, 1.2 * std::cos(direction), 1.2 * std::sin(direction));
    const auto shifted = [&](const char* name, double by) { return sum(symbol(name), number(by)); };
    b.point("C" + i, shifted("x", 0.3 * std::cos(direction + turn)), shifted("y", 0.3 * std::sin(direction + turn)));
    b.dyad("B" + i, "A" + i, "C" + i, 0.9 + 0.05 * leg, 0.8, leg == 1 ? Side::right : Side::left);
  }
  b.link("platform", {"C1", "C2", "C3", "P"}, 2);
  for (const char* i : {"1", "2", "3"}) {
    const std::string A = std::string("A") + i, B = std::string("B") + i, C = std::string("C") + i;
    b.link(A + B, {A, B}, 0.5).link(B + C, {B, C}, 0.25);
    b.joint(A, "ground", A + B, A, true).joint(B, A + B, B + C, B).joint(C, B + C, "platform", C);
  }
  b.end_effector("platform", "P").load("platform", "P", fx, fy, couple);
  if (weighs) b.gravity(0, -9.81);
  return b.finish();
}

Mechanism driven_five_bar(double fx, double fy, bool weighs) {
  MechanismBuilder b;
  b.point("A1", 0, 0).point("A2", 0.6, 0.1).point("A3", 1.3, -0.2).point("P", symbol("x"), symbol("y"));
  b.dyad("B1", "A1", "P", 0.7, 0.8, Side::right).dyad("B2", "A2", "P", 0.75, 0.9, Side::left);
  b.offset("Q", "A2", "B2", 0.4, -0.15).dyad("C", "A3", "Q", 0.6, 0.9, Side::left).mean("E", "P", "B2");
  b.link("A1B1", {"A1", "B1"}, 1).link("B1P", {"B1", "P"}, 1).link("PB2", {"P", "B2", "E"}, 1);
  b.link("crank", {"A2", "B2", "Q"}, 1).link("A3C", {"A3", "C"}, 0.5).link("CQ", {"C", "Q"}, 0.5);
  b.joint("A1", "ground", "A1B1", "A1", true).joint("B1", "A1B1", "B1P", "B1").joint("P", "B1P", "PB2", "P");
  b.joint("B2", "crank", "PB2", "B2").joint("A2", "ground", "crank", "A2");
  b.joint("Q", "CQ", "crank", "Q").joint("C", "A3C", "CQ", "C").joint("A3", "ground", "A3C", "A3", true);
  b.end_effector("PB2", "P").load("PB2", "E", fx, fy);
  if (weighs) b.gravity(0, -9.81);
  return b.finish();
}

}  // namespace clearloci::test
