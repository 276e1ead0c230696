#include "loci/curves/plane_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace clearloci::loci {

namespace {

using core::Interval;

/// A number as the unevaluated sum of two doubles, the second at most half a spacing of the first: T. J. Dekker, "A
/// floating-point technique for extending the available precision", Numerische Mathematik 18 (1971).
struct TwoDoubles {
  TwoDoubles() = default;
  TwoDoubles(double value) : high(value) {}  // NOLINT: a double is one of them
  TwoDoubles(double first, double second) : high(first), low(second) {}
  double high = 0, low = 0;
};

/// Required: |a| >= |b|, or a = 0.
TwoDoubles quick_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

TwoDoubles operator+(const TwoDoubles& a, const TwoDoubles& b) {
  const double sum = a.high + b.high, part = sum - a.high;
  const double error = (a.high - (sum - part)) + (b.high - part);
  return quick_sum(sum, error + a.low + b.low);
}

TwoDoubles operator*(const TwoDoubles& a, const TwoDoubles& b) {
  const double product = a.high * b.high;
  const double error = std::fma(a.high, b.high, -product);
  return quick_sum(product, error + (a.high * b.low + a.low * b.high));
}

/// 1, base, base^2, ... up to a degree; of low degrees without memory from the heap.
template <typename Number>
class Powers {
 public:
  Powers(const Number& base, int degree) {
    const auto size = static_cast<std::size_t>(degree) + 1;
    if (size > near_.size()) far_.resize(size);
    table_ = size > near_.size() ? far_.data() : near_.data();
    table_[0] = Number(1.0);
    for (std::size_t k = 1; k < size; ++k) table_[k] = table_[k - 1] * base;
  }
  Powers(const Powers&) = delete;
  Powers& operator=(const Powers&) = delete;
  const Number& operator[](int k) const { return table_[k]; }

 private:
  std::array<Number, 12> near_;
  std::vector<Number> far_;
  Number* table_;
};

}  // namespace

PlaneCurve::PlaneCurve(const core::Polynomial& implicit) {
  // A common scale keeps huge integer coefficients within the range of doubles.
  core::Rational scale = 1;
  for (const core::Term& term : implicit.terms) scale = std::max(scale, core::Rational(abs(term.coefficient)));
  for (const core::Term& term : implicit.terms) {
    const int i = term.exponents[0], j = term.exponents[1];
    const core::Rational exact = term.coefficient / scale;
    const double c = core::to_double(exact), rest = core::to_double(exact - core::Rational(c));
    terms_.push_back(
        {i, j, c, rest, Interval(c - std::abs(c) * 0x1p-52, c + std::abs(c) * 0x1p-52), sheet::DoubleDouble(exact)});
    degree_x_ = std::max(degree_x_, i);
    degree_y_ = std::max(degree_y_, j);
  }
}

template <typename Number>
PlaneCurve::Derivatives<Number> PlaneCurve::derivatives(const Number& x, const Number& y) const {
  const Powers<Number> xs(x, degree_x_), ys(y, degree_y_);
  Derivatives<Number> d;
  for (const Term& term : terms_) {
    const int i = term.i, j = term.j;
    const Number c = term.as<Number>();
    const Number zero(0.0);
    const Number x1 = i > 0 ? xs[i - 1] * Number(term.i) : zero, y1 = j > 0 ? ys[j - 1] * Number(term.j) : zero;
    const Number cy = c * ys[j], cx = c * xs[i];
    d.f = d.f + cy * xs[i];
    d.fx = d.fx + cy * x1;
    d.fy = d.fy + cx * y1;
    d.fxy = d.fxy + c * x1 * y1;
    if (i > 1) d.fxx = d.fxx + cy * (xs[i - 2] * Number(static_cast<double>(term.i) * (term.i - 1)));
    if (j > 1) d.fyy = d.fyy + cx * (ys[j - 2] * Number(static_cast<double>(term.j) * (term.j - 1)));
  }
  return d;
}

template <typename Number>
Number PlaneCurve::Term::as() const {
  if constexpr (std::is_same_v<Number, double>) return coefficient;
  if constexpr (std::is_same_v<Number, TwoDoubles>) return {coefficient, rest};
  if constexpr (std::is_same_v<Number, Interval>) return enclosure;
  if constexpr (std::is_same_v<Number, sheet::DoubleDouble>) return precise;
}

PlaneCurve::Jet PlaneCurve::jet(const core::Point2& at) const {
  const Jet quick{derivatives<double>(at[0], at[1])};
  constexpr double known_within = 1e-10;  // how well the distance from the curve is, relative to the coordinates
  if (rounding(at) <= known_within * std::max(std::abs(at[0]), std::abs(at[1])) * quick.slope()) return quick;
  const Derivatives<TwoDoubles> fine = derivatives<TwoDoubles>(at[0], at[1]);
  return {{fine.f.high, fine.fx.high, fine.fy.high, fine.fxx.high, fine.fxy.high, fine.fyy.high}};
}

double PlaneCurve::rounding(const core::Point2& at) const {
  double terms = 0;
  const Powers<double> xs(at[0], degree_x_), ys(at[1], degree_y_);
  for (const Term& term : terms_) terms += std::abs(term.coefficient * xs[term.i] * ys[term.j]);
  return (degree_x_ + degree_y_) * std::numeric_limits<double>::epsilon() * terms;
}

double PlaneCurve::precise_value(const core::Point2& at) const {
  const Powers<TwoDoubles> xs(at[0], degree_x_), ys(at[1], degree_y_);
  TwoDoubles sum;
  for (const Term& term : terms_) sum = sum + TwoDoubles(term.coefficient, term.rest) * (xs[term.i] * ys[term.j]);
  return sum.high;
}

core::Point2 PlaneCurve::project(core::Point2 near) const {
  const core::Point2 start = near;
  double last = std::numeric_limits<double>::infinity(), slope = 0;
  for (int i = 0; i < 8; ++i) {
    const Jet at = jet(near);
    const double g2 = at.fx * at.fx + at.fy * at.fy;
    if (g2 == 0) return start;
    const double step = std::abs(at.f) / std::sqrt(g2);
    if (step >= last) break;  // rounding
    last = step;
    slope = std::sqrt(g2);
    near = {near[0] - at.f * at.fx / g2, near[1] - at.f * at.fy / g2};
  }
  // Next to a double point the rounding errors of the terms, over the small gradient, are more than the coordinates
  // resolve: the value is taken with twice the digits there. Twice, because the first step may still be a long one.
  constexpr double spacings = 16;  // where a few spacings are at stake, doubles will do
  const double resolved =
      spacings * std::numeric_limits<double>::epsilon() * std::max(std::abs(near[0]), std::abs(near[1]));
  const bool is_fine = rounding(near) <= resolved * slope;
  for (int i = 0; i < 2 && !is_fine; ++i) {
    const Jet at = jet(near);
    const double g2 = at.fx * at.fx + at.fy * at.fy;
    const double f = precise_value(near);
    if (g2 == 0 || f == 0) break;
    near = {near[0] - f * at.fx / g2, near[1] - f * at.fy / g2};
  }
  return near;
}

namespace {

Interval enclosure_of(const Interval& number) { return number; }
Interval enclosure_of(const sheet::DoubleDouble& number) { return number.enclosure(); }

/// Signs on the long sides of a box that differ: the branch cannot leave through them.
bool differ(const std::array<int, 2>& sign) { return sign[0] != 0 && sign[0] == -sign[1]; }

}  // namespace

bool PlaneCurve::joined(const core::Point2& a, const core::Point2& b, double off) const {
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  constexpr double wide = 0.25;  // of the chord's length: what does where no other branch is near
  constexpr double spare = 4;    // times how far the branch strays from its chord: what it must do where one is
  constexpr double least = 1e-14;
  const double margin = wide * length + least, thin = spare * off + least;
  const double close = std::min(margin, thin);
  if (joined_within(a, b, margin) || joined_closely<Interval>(a, b, close)) return true;
  constexpr double tells = 1e-3;  // of what decides
  const core::Point2 middle = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  return rounding(middle) > tells * close * jet(middle).slope() && joined_closely<sheet::DoubleDouble>(a, b, close);
}

bool PlaneCurve::joined_within(const core::Point2& a, const core::Point2& b, double margin) const {
  // A box around the chord, wider by `margin`; across it runs the coordinate in which f is monotone.
  const bool flat = std::abs(b[0] - a[0]) >= std::abs(b[1] - a[1]);
  const std::size_t along = flat ? 0 : 1, across = 1 - along;
  std::array<Interval, 2> box, side;
  box[along] = Interval(std::min(a[along], b[along]), std::max(a[along], b[along]));
  box[across] = Interval(std::min(a[across], b[across]) - margin, std::max(a[across], b[across]) + margin);
  const Derivatives<Interval> over = derivatives<Interval>(box[0], box[1]);
  const std::array<double, 2> middle = {box[0].middle(), box[1].middle()};
  const Derivatives<Interval> at = derivatives<Interval>(Interval(middle[0]), Interval(middle[1]));
  const Interval dx = box[0] - Interval(middle[0]), dy = box[1] - Interval(middle[1]);
  const std::array<Interval, 2> slope = {at.fx + over.fxx * dx + over.fxy * dy, at.fy + over.fxy * dx + over.fyy * dy};
  if (slope[across].contains_zero()) return false;
  std::array<int, 2> sign{};
  for (const int end : {0, 1}) {
    side[across] = Interval(end == 0 ? box[across].lower() : box[across].upper());
    side[along] = Interval(middle[along]);
    const Interval value = derivatives<Interval>(side[0], side[1]).f;
    const Interval range = value + slope[along] * (box[along] - Interval(middle[along]));
    sign[static_cast<std::size_t>(end)] = range.sign();
  }
  return differ(sign);
}

template <typename Number>
PlaneCurve::Sheared PlaneCurve::along_chord(const core::Point2& middle, std::size_t along, double rise) const {
  const std::array<int, 2> degree = {along == 0 ? degree_x_ : degree_y_, along == 0 ? degree_y_ : degree_x_};
  Sheared result{degree[0] + degree[1], degree[1], {}};
  std::vector<Number> coefficients(static_cast<std::size_t>(result.along + 1) *
                                   static_cast<std::size_t>(result.across + 1));
  const auto entry = [&](int i, int j) -> Number& { return coefficients[result.place(i, j)]; };
  for (const Term& term : terms_) entry(along == 0 ? term.i : term.j, along == 0 ? term.j : term.i) = term.as<Number>();
  // Horner's scheme, once a power: a -> middle + a, b -> middle + b, and last b -> rise a + b.
  const Number a(middle[along]), b(middle[1 - along]), s(rise);
  for (int from = 0; from < degree[0]; ++from)
    for (int i = degree[0] - 1; i >= from; --i)
      for (int j = 0; j <= degree[1]; ++j) entry(i, j) = entry(i, j) + a * entry(i + 1, j);
  for (int from = 0; from < degree[1]; ++from)
    for (int j = degree[1] - 1; j >= from; --j)
      for (int i = 0; i <= degree[0]; ++i) entry(i, j) = entry(i, j) + b * entry(i, j + 1);
  for (int from = 0; from < degree[1]; ++from)
    for (int j = degree[1] - 1; j >= from; --j)
      for (int i = result.along; i > 0; --i) entry(i, j) = entry(i, j) + s * entry(i - 1, j + 1);
  for (const Number& coefficient : coefficients) result.coefficients.push_back(enclosure_of(coefficient));
  return result;
}

template <typename Number>
bool PlaneCurve::joined_closely(const core::Point2& a, const core::Point2& b, double margin) const {
  const std::size_t along = std::abs(b[0] - a[0]) >= std::abs(b[1] - a[1]) ? 0 : 1, across = 1 - along;
  const core::Point2 middle = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  const Sheared f = along_chord<Number>(middle, along, (b[across] - a[across]) / (b[along] - a[along]));
  const Interval d = Interval(std::min(a[along], b[along]), std::max(a[along], b[along])) - Interval(middle[along]);
  const Powers<Interval> ds(d, f.along), ws(Interval(-margin, margin), f.across);
  Interval slope(0.0);
  for (int i = 0; i <= f.along; ++i)
    for (int j = 1; j <= f.across; ++j)
      slope = slope + Interval(static_cast<double>(j)) * f.at(i, j) * ds[i] * ws[j - 1];
  if (slope.contains_zero()) return false;
  std::array<int, 2> sign{};
  for (const int end : {0, 1}) {
    const Powers<Interval> side(Interval(end == 0 ? -margin : margin), f.across);
    Interval value(0.0);
    for (int i = 0; i <= f.along; ++i) {
      Interval part(0.0);
      for (int j = 0; j <= f.across; ++j) part = part + f.at(i, j) * side[j];
      value = value + part * ds[i];
    }
    sign[static_cast<std::size_t>(end)] = value.sign();
  }
  return differ(sign);
}

double PlaneCurve::Jet::slope() const { return std::hypot(fx, fy); }

double PlaneCurve::Jet::curvature() const {
  const double g = slope();
  if (g == 0) return 0;
  const double tx = -fy / g, ty = fx / g;  // scaled before multiplying: g^3 may underflow
  return std::abs(fxx * tx * tx + 2 * fxy * tx * ty + fyy * ty * ty) / g;
}

double PlaneCurve::Jet::distance() const {
  const double g = slope();
  const double bend = std::sqrt(fxx * fxx + 2 * fxy * fxy + fyy * fyy);
  // Newton's step is trustworthy where it changes the gradient by little.
  return g > 0 && std::abs(f) * bend <= 0.1 * g * g ? std::abs(f) / g : -1;
}

int curve_through(const std::vector<core::Polynomial>& curves, const core::Point2& at) {
  const std::vector<core::Rational> exact = {core::Rational(at[0]), core::Rational(at[1])};
  const auto square = [&](const core::Polynomial& p) {
    const core::Rational value = core::evaluate(p, exact);
    return core::Rational(value * value);
  };
  int best = 0;
  core::Rational least;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const core::Rational slope = square(core::derivative(curves[i], 0)) + square(core::derivative(curves[i], 1));
    core::Rational off = square(curves[i]);
    if (slope != 0) off /= slope;
    if (i > 0 && off >= least) continue;
    least = std::move(off);
    best = static_cast<int>(i);
  }
  return best;
}

}  // namespace clearloci::loci
