// Lines and conics among implicit polynomials.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/circle_pair.hpp"
#include "core/locus_map.hpp"

namespace clearloci::inline core {
namespace {

/// a x^2 + b x y + c y^2 + d x + e y + f.
struct Conic {
  Rational a, b, c, d, e, f;
};

/// Determinant of [[2a, b, d], [b, 2c, e], [d, e, 2f]]: zero for a pair of lines, a double line or a point.
Rational determinant(const Conic& q) {
  return 2 * q.a * (4 * q.c * q.f - q.e * q.e) - q.b * (2 * q.b * q.f - q.e * q.d) + q.d * (q.b * q.e - 2 * q.c * q.d);
}

ClosedForm circle(const Conic& q) {
  CircleForm form;
  form.centre = {-q.d / (2 * q.a), -q.e / (2 * q.a)};
  form.radius_squared = form.centre[0] * form.centre[0] + form.centre[1] * form.centre[1] - q.f / q.a;
  if (sgn(form.radius_squared) <= 0) return {};
  form.radius = square_root(form.radius_squared);
  return form;
}

/// Into (-pi/2, pi/2]: an axis has no direction.
double axis_angle(double angle) {
  constexpr double pi = std::numbers::pi;
  if (angle > pi / 2) return angle - pi;
  if (angle <= -pi / 2) return angle + pi;
  return angle;
}

/// Ellipse or hyperbola. In the frame of its axes: l1 u^2 + l2 v^2 + h = 0, l1 and l2 the eigenvalues of
/// [[a, b/2], [b/2, c]], u along the eigenvector of l1, h the value at the centre.
ConicForm central_conic(const Conic& q, const Rational& discriminant) {
  ConicForm form;
  const Rational x = (2 * q.c * q.d - q.b * q.e) / discriminant;
  const Rational y = (2 * q.a * q.e - q.b * q.d) / discriminant;
  form.centre = Point2{to_double(x), to_double(y)};
  const double h = to_double(q.f + (q.d * x + q.e * y) / 2);
  const double mean = to_double(q.a + q.c) / 2;
  const double radius = std::hypot(to_double(q.a - q.c), to_double(q.b)) / 2;
  const double angle_of_larger = std::atan2(to_double(q.b), to_double(q.a - q.c)) / 2;
  // The product of the eigenvalues is -discriminant / 4 exactly: no cancellation in the smaller one.
  const double sign = mean < 0 ? -1 : 1;
  const double outer = mean + sign * radius;
  const double inner = -to_double(discriminant) / 4 / outer;
  const double angle_of_outer = sign > 0 ? angle_of_larger : angle_of_larger + std::numbers::pi / 2;
  const bool ellipse = sgn(discriminant) < 0;
  form.type = ellipse ? "ellipse" : "hyperbola";
  // First axis: an ellipse's major one (the smaller eigenvalue), the one that meets the hyperbola.
  const bool first_is_inner = ellipse || -h / inner > 0;
  const double first = first_is_inner ? inner : outer;
  const double second = first_is_inner ? outer : inner;
  form.semi_axes = {std::sqrt(std::abs(h / first)), std::sqrt(std::abs(h / second))};
  form.angle = axis_angle(first_is_inner ? angle_of_outer + std::numbers::pi / 2 : angle_of_outer);
  return form;
}

/// (p x + r y)^2 + ... = 0 up to a factor: the axis is along (-r, p), and it opens where the linear part is negative.
ConicForm parabola(const Conic& q) {
  ConicForm form;
  form.type = "parabola";
  const int sign = sgn(Rational(q.a + q.c));
  const Rational axis_x = sgn(q.a) != 0 ? Rational(-q.b) : Rational(1);
  const Rational axis_y = sgn(q.a) != 0 ? Rational(2 * q.a) : Rational(0);
  const Rational slope = sign * (q.d * axis_x + q.e * axis_y);
  const double towards = sgn(slope) > 0 ? -1 : 1;
  form.angle = std::atan2(towards * to_double(axis_y), towards * to_double(axis_x));
  return form;
}

ClosedForm conic(const Conic& q) {
  const Rational delta = determinant(q);
  if (sgn(delta) == 0) return {};
  if (sgn(q.b) == 0 && q.a == q.c) return circle(q);
  const Rational discriminant = q.b * q.b - 4 * q.a * q.c;
  // An ellipse has real points where the determinant and the quadratic part have opposite signs.
  if (sgn(discriminant) < 0 && sgn(delta) == sgn(q.a)) return {};
  ConicForm form = sgn(discriminant) == 0 ? parabola(q) : central_conic(q, discriminant);
  form.coefficients = {q.a, q.b, q.c, q.d, q.e, q.f};
  return form;
}

}  // namespace

ClosedForm recognise_closed_form(const Polynomial& implicit) {
  const int degree = total_degree(implicit);
  if (implicit.variables < 2 || degree < 1 || degree == 3 || degree > 4) return {};
  for (int v = 2; v < implicit.variables; ++v)
    if (depends_on(implicit, v)) return {};
  const Polynomial p = primitive_part(with_variables(implicit, 2));
  if (degree == 4) {
    const std::optional<CirclePairForm> pair = recognise_circle_pair(p);
    return pair ? ClosedForm(*pair) : ClosedForm();
  }
  const Conic q{coefficient(p, {2, 0}), coefficient(p, {1, 1}), coefficient(p, {0, 2}),
                coefficient(p, {1, 0}), coefficient(p, {0, 1}), coefficient(p, {0, 0})};
  if (degree == 1) return LineForm{q.d, q.e, q.f};
  return conic(q);
}

std::vector<Circle> circles_of(const ClosedForm& form) {
  if (const auto* circle = std::get_if<CircleForm>(&form)) {
    return {
        {{to_double(circle->centre[0]), to_double(circle->centre[1])}, std::sqrt(to_double(circle->radius_squared))}};
  }
  std::vector<Circle> circles;
  if (const auto* pair = std::get_if<CirclePairForm>(&form)) {
    for (const int sign : {1, -1}) {
      circles.push_back({{to_double(pair->centre[0], pair->n, sign), to_double(pair->centre[1], pair->n, sign)},
                         std::sqrt(to_double(pair->radius_squared, pair->n, sign))});
    }
  }
  return circles;
}

std::optional<Circle> circle_through(const ClosedForm& form, const Polyline& points) {
  constexpr double rounding = 1e-9;
  // Circles of a pair may nearly coincide: the nearest one.
  std::optional<Circle> nearest;
  double least = rounding;
  for (const Circle& circle : circles_of(form)) {
    double off = 0;
    for (const Point2& p : points)
      off = std::max(off, std::abs(std::hypot(p[0] - circle.centre[0], p[1] - circle.centre[1]) / circle.radius - 1));
    if (off > least) continue;
    least = off;
    nearest = circle;
  }
  return nearest;
}

}  // namespace clearloci::inline core
