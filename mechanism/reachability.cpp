// A dyad with lengths a, b closes where |a - b| <= |AP| <= a + b. A dyad that closes nowhere in the box is wrong input:
// proven by interval arithmetic on |AP| over the box, cut into smaller and smaller boxes. Each interval is rounded
// outwards, so that no dyad that closes is refused; one that closes nowhere by less than the cutting resolves passes.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "mechanism/posture_sample.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

struct Interval {
  double low = 0, high = 0;
};

/// Wider than any rounding of one operation.
Interval outward(double low, double high) { return {std::nextafter(low, -INFINITY), std::nextafter(high, INFINITY)}; }

Interval operator+(const Interval& a, const Interval& b) { return outward(a.low + b.low, a.high + b.high); }
Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
Interval operator-(const Interval& a, const Interval& b) { return a + -b; }

Interval operator*(const Interval& a, const Interval& b) {
  const std::array<double, 4> products = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  const auto [low, high] = std::minmax_element(products.begin(), products.end());
  return outward(*low, *high);
}

Interval square(const Interval& a) {
  const double far = std::max(std::abs(a.low), std::abs(a.high));
  const double near = a.low <= 0 && a.high >= 0 ? 0 : std::min(std::abs(a.low), std::abs(a.high));
  const Interval result = outward(near * near, far * far);
  return {std::max(0.0, result.low), result.high};
}

Interval root(const Interval& a) {
  const Interval result = outward(std::sqrt(std::max(0.0, a.low)), std::sqrt(std::max(0.0, a.high)));
  return {std::max(0.0, result.low), result.high};
}

Interval meet(const Interval& a, const Interval& b) { return {std::max(a.low, b.low), std::min(a.high, b.high)}; }

using Box = std::map<std::string, Interval>;

/// A function that changes no faster than its argument (cos, sin): its value at the middle, give or take half a width.
template <class Function>
Interval slow_function(const Interval& argument, Function function) {
  const double middle = (argument.low + argument.high) / 2;
  const double reach = (argument.high - argument.low) / 2 + 1e-12 * (1 + std::abs(middle));
  const double value = function(middle);
  return meet({value - reach, value + reach}, {-1, 1});
}

Interval bound(const Expression& expression, const Box& box) {
  using Kind = Expression::Kind;
  const auto argument = [&](std::size_t index) { return bound(expression.arguments()[index], box); };
  switch (expression.kind()) {
    case Kind::number: {
      const double value = core::to_double(expression.value());
      return outward(value, value);
    }
    case Kind::symbol:
      return box.at(expression.name());
    case Kind::pi:
      return outward(std::numbers::pi, std::numbers::pi);
    case Kind::add:
      return argument(0) + argument(1);
    case Kind::multiply:
      return argument(0) * argument(1);
    case Kind::divide: {
      const Interval divisor = argument(1);
      if (divisor.low <= 0 && divisor.high >= 0) return {-INFINITY, INFINITY};
      return argument(0) * outward(1 / divisor.high, 1 / divisor.low);
    }
    case Kind::power: {
      const Interval base = argument(0);
      const Interval exponent = argument(1);
      const double steps = std::round(exponent.low);
      if (exponent.high - exponent.low > 1e-9 || std::abs(exponent.low - steps) > 1e-9 || steps < 0 || steps > 100)
        return {-INFINITY, INFINITY};
      Interval result{1, 1};
      for (int k = 0; k + 1 < static_cast<int>(steps); k += 2) result = result * square(base);
      return static_cast<int>(steps) % 2 == 1 ? result * base : result;
    }
    case Kind::negate:
      return -argument(0);
    case Kind::sqrt:
      return root(argument(0));
    case Kind::cos:
      return slow_function(argument(0), [](double x) { return std::cos(x); });
    case Kind::sin:
      return slow_function(argument(0), [](double x) { return std::sin(x); });
  }
  return {-INFINITY, INFINITY};
}

const PointForm& form_of(const Mechanism& mechanism, PointIndex index) {
  return mechanism.points[static_cast<std::size_t>(index)].form;
}

Interval distance(const Mechanism& mechanism, PointIndex p, PointIndex q, const Box& box);

/// |PQ| for a point P at a known distance r from a base R: between ||RQ| - r| and |RQ| + r.
Interval around(const Mechanism& mechanism, PointIndex base, const Interval& r, PointIndex q, const Box& box) {
  const Interval to_base = distance(mechanism, base, q, box);
  const double least = std::max({0.0, to_base.low - r.high, r.low - to_base.high});
  const Interval result = outward(least, to_base.high + r.high);
  return {std::max(0.0, result.low), result.high};
}

/// Bounds of |PQ| over a box: of the polynomials where both are explicit, by the triangle inequality otherwise.
Interval distance(const Mechanism& mechanism, PointIndex p, PointIndex q, const Box& box) {
  if (p == q) return {0, 0};
  const auto is_built = [&](PointIndex i) { return !std::holds_alternative<ExplicitPoint>(form_of(mechanism, i)); };
  // p: the one to trace back to its bases, which stand above it; the later one where both are built.
  if (is_built(q) && (!is_built(p) || p < q)) std::swap(p, q);
  if (const auto* dyad = std::get_if<DyadPoint>(&form_of(mechanism, p)))
    return meet(around(mechanism, dyad->from, bound(dyad->from_length, box), q, box),
                around(mechanism, dyad->to, bound(dyad->to_length, box), q, box));
  if (const auto* offset = std::get_if<OffsetPoint>(&form_of(mechanism, p))) {
    const Interval r = root(square(bound(offset->along, box)) + square(bound(offset->left, box)));
    return around(mechanism, offset->first, r, q, box);
  }
  if (const auto* mean = std::get_if<MeanPoint>(&form_of(mechanism, p))) {
    const Interval whole = distance(mechanism, mean->first, mean->second, box);
    return around(mechanism, mean->first, outward(whole.low / 2, whole.high / 2), q, box);
  }
  if (const auto* slider = std::get_if<SliderPoint>(&form_of(mechanism, p)))
    return around(mechanism, slider->from, bound(slider->length, box), q, box);
  const ExplicitPoint& first = std::get<ExplicitPoint>(form_of(mechanism, p));
  const ExplicitPoint& second = std::get<ExplicitPoint>(form_of(mechanism, q));
  Interval sum{0, 0};
  for (std::size_t i = 0; i < first.coordinates.size(); ++i)
    sum = sum + square(bound(first.coordinates[i], box) - bound(second.coordinates[i], box));
  return root(sum);
}

/// The widest coordinate in halves, in parts of its range.
std::array<Box, 2> halves(const Mechanism& mechanism, const Box& box) {
  std::string widest;
  double widest_part = -1;
  for (const Coordinate& coordinate : mechanism.coordinates) {
    const Interval& range = box.at(coordinate.name);
    const double part =
        (range.high - range.low) / (core::to_double(coordinate.upper) - core::to_double(coordinate.lower));
    if (part > widest_part) {
      widest_part = part;
      widest = coordinate.name;
    }
  }
  std::array<Box, 2> result = {box, box};
  const double middle = (box.at(widest).low + box.at(widest).high) / 2;
  result[0][widest].high = middle;
  result[1][widest].low = middle;
  return result;
}

Box whole_box(const Mechanism& mechanism) {
  Box box;
  for (const Parameter& parameter : mechanism.parameters) {
    const double value = core::to_double(parameter.value);
    box[parameter.name] = outward(value, value);
  }
  for (const Coordinate& coordinate : mechanism.coordinates)
    box[coordinate.name] = outward(core::to_double(coordinate.lower), core::to_double(coordinate.upper));
  return box;
}

/// The values of a measure over the whole box where all of them are proven to miss `reach`; nothing where that is not
/// so.
template <class Measure>
std::optional<Interval> proven_outside(const Mechanism& mechanism, const Interval& reach, Measure measure) {
  constexpr int most_boxes = 4096;
  Interval found{INFINITY, 0};
  std::vector<Box> open = {whole_box(mechanism)};
  for (int count = 0; !open.empty(); ++count) {
    if (count == most_boxes) return std::nullopt;
    const Box box = open.back();
    open.pop_back();
    const Interval d = measure(box);
    if (d.low > reach.high || d.high < reach.low) {
      found = {std::min(found.low, d.low), std::max(found.high, d.high)};
      continue;
    }
    // All of the box within reach: nothing to prove.
    if (d.low >= reach.low && d.high <= reach.high) return std::nullopt;
    for (Box& half : halves(mechanism, box)) open.push_back(std::move(half));
  }
  return found;
}

/// The distances |AP| over a box in which the dyad closes nowhere; nothing where that is not proven.
std::optional<Interval> proven_unreachable(const Mechanism& mechanism, const DyadPoint& dyad) {
  const Box whole = whole_box(mechanism);
  const Interval a = bound(dyad.from_length, whole);
  const Interval b = bound(dyad.to_length, whole);
  const Interval reach{std::max({0.0, a.low - b.high, b.low - a.high}), (a + b).high};
  return proven_outside(mechanism, reach, [&](const Box& box) { return distance(mechanism, dyad.from, dyad.to, box); });
}

/// The distances of `from` to the slider's line where they are all too long; nothing where that is not proven.
std::optional<Interval> proven_unreachable(const Mechanism& mechanism, const SliderPoint& slider) {
  const auto* base = std::get_if<ExplicitPoint>(&form_of(mechanism, slider.base));
  const auto* from = std::get_if<ExplicitPoint>(&form_of(mechanism, slider.from));
  if (!base || !from || slider.along.kind != VectorExpression::Kind::components) return std::nullopt;
  const Box whole = whole_box(mechanism);
  std::array<Interval, 3> u;
  Interval squared_size{0, 0};
  for (std::size_t i = 0; i < slider.along.numbers.size(); ++i) {
    u[i] = bound(slider.along.numbers[i], whole);
    squared_size = squared_size + square(u[i]);
  }
  const Interval size = root(squared_size);
  if (!(size.low > 0)) return std::nullopt;
  const Interval per_length = outward(1 / size.high, 1 / size.low);
  const auto to_line = [&](const Box& box) {
    std::array<Interval, 3> way;
    for (std::size_t i = 0; i < from->coordinates.size(); ++i)
      way[i] = bound(from->coordinates[i], box) - bound(base->coordinates[i], box);
    Interval squared{0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      squared = squared + square((u[j] * way[k] - u[k] * way[j]) * per_length);
    }
    return root(squared);
  };
  return proven_outside(mechanism, {0, bound(slider.length, whole).high}, to_line);
}

std::string metres(double value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

[[noreturn]] void refuse(const Mechanism& mechanism, const Point& point, const Interval& distances) {
  const DyadPoint& dyad = std::get<DyadPoint>(point.form);
  const std::string& from = mechanism.points[static_cast<std::size_t>(dyad.from)].name;
  const std::string& to = mechanism.points[static_cast<std::size_t>(dyad.to)].name;
  const Box whole = whole_box(mechanism);
  const double a = bound(dyad.from_length, whole).high;
  const double b = bound(dyad.to_length, whole).high;
  throw core::InputError(point.where,
                         "point " + point.name + " is unreachable in the whole box: |" + from + " " + to +
                             "| runs from about " + metres(distances.low) + " to " + metres(distances.high) +
                             " m, but the lengths " + metres(a) + " and " + metres(b) + " m reach from " +
                             metres(std::abs(a - b)) + " to " + metres(a + b) + " m",
                         "change the lengths, the points " + from + " and " + to + ", or the workspace");
}

[[noreturn]] void refuse_slider(const Mechanism& mechanism, const Point& point, const Interval& distances) {
  const SliderPoint& slider = std::get<SliderPoint>(point.form);
  const std::string& from = mechanism.points[static_cast<std::size_t>(slider.from)].name;
  throw core::InputError(point.where,
                         "point " + point.name + " is unreachable in the whole box: " + from + " is from about " +
                             metres(distances.low) + " to " + metres(distances.high) +
                             " m off its line, but the length is " +
                             metres(bound(slider.length, whole_box(mechanism)).high) + " m",
                         "change the length, the line, the point " + from + ", or the workspace");
}

}  // namespace

void check_reachability(const Mechanism& mechanism) {
  if (!sample_postures(mechanism, 1).empty()) return;  // it closes: so does every dyad of it
  for (const Point& point : mechanism.points) {
    if (const auto* dyad = std::get_if<DyadPoint>(&point.form))
      if (const auto distances = proven_unreachable(mechanism, *dyad)) refuse(mechanism, point, *distances);
    if (const auto* slider = std::get_if<SliderPoint>(&point.form))
      if (const auto distances = proven_unreachable(mechanism, *slider)) refuse_slider(mechanism, point, *distances);
  }
}

}  // namespace clearloci::mechanism
