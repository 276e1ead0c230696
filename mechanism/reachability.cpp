// A dyad with lengths a, b closes where |a - b| <= |AP| <= a + b. A dyad that closes nowhere in the box is wrong input:
// proven by interval arithmetic on |AP| over the box, cut into smaller and smaller boxes. Each interval is rounded
// outwards, so that no dyad that closes is refused; one that closes nowhere by less than the cutting resolves passes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/enclosure.hpp"
#include "core/shown_units.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::Interval;
using core::squared;
using Box = core::Ranges;

/// Of lengths: rounding takes their squares below 0.
Interval root(const Interval& square) {
  return square_root(Interval(std::max(0.0, square.lower()), std::max(0.0, square.upper())));
}

/// What both contain, which may be nothing.
Interval common(const Interval& a, const Interval& b) {
  return {std::max(a.lower(), b.lower()), std::min(a.upper(), b.upper())};
}

Interval bound(const Expression& expression, const Box& box) { return core::enclosure(expression, box); }

const PointForm& form_of(const Mechanism& mechanism, PointIndex index) {
  return mechanism.points[static_cast<std::size_t>(index)].form;
}

Interval distance(const Mechanism& mechanism, PointIndex p, PointIndex q, const Box& box);

/// |PQ| for a point P at a known distance r from a base R: between ||RQ| - r| and |RQ| + r.
Interval around(const Mechanism& mechanism, PointIndex base, const Interval& r, PointIndex q, const Box& box) {
  const Interval to_base = distance(mechanism, base, q, box);
  const double least = std::max({0.0, (to_base - r).lower(), (r - to_base).lower()});
  return {least, (to_base + r).upper()};
}

/// Bounds of |PQ| over a box: of the polynomials where both are explicit, by the triangle inequality otherwise.
Interval distance(const Mechanism& mechanism, PointIndex p, PointIndex q, const Box& box) {
  if (p == q) return 0.0;
  const auto is_built = [&](PointIndex i) { return !std::holds_alternative<ExplicitPoint>(form_of(mechanism, i)); };
  // p: the one to trace back to its bases, which stand above it; the later one where both are built.
  if (is_built(q) && (!is_built(p) || p < q)) std::swap(p, q);
  const auto* dyad = std::get_if<DyadPoint>(&form_of(mechanism, p));
  if (dyad != nullptr && dyad->right_angle) return around(mechanism, dyad->from, bound(dyad->from_length, box), q, box);
  if (dyad != nullptr)
    return common(around(mechanism, dyad->from, bound(dyad->from_length, box), q, box),
                  around(mechanism, dyad->to, bound(dyad->to_length, box), q, box));
  if (const auto* offset = std::get_if<OffsetPoint>(&form_of(mechanism, p))) {
    const Interval r = root(squared(bound(offset->along, box)) + squared(bound(offset->left, box)));
    return around(mechanism, offset->first, r, q, box);
  }
  if (const auto* mean = std::get_if<MeanPoint>(&form_of(mechanism, p))) {
    const Interval whole = distance(mechanism, mean->first, mean->second, box);
    return around(mechanism, mean->first, Interval(0.5) * whole, q, box);
  }
  if (const auto* slider = std::get_if<SliderPoint>(&form_of(mechanism, p)))
    return around(mechanism, slider->from, bound(slider->length, box), q, box);
  if (is_built(p)) return {0.0, std::numeric_limits<double>::max()};  // shifted and crossing points: anywhere
  const ExplicitPoint& first = std::get<ExplicitPoint>(form_of(mechanism, p));
  const ExplicitPoint& second = std::get<ExplicitPoint>(form_of(mechanism, q));
  Interval sum;
  for (std::size_t i = 0; i < first.coordinates.size(); ++i)
    sum = sum + squared(bound(first.coordinates[i], box) - bound(second.coordinates[i], box));
  return root(sum);
}

/// The widest coordinate in halves, in parts of its range.
std::array<Box, 2> halves(const Mechanism& mechanism, const Box& box) {
  std::string widest;
  double widest_part = -1;
  for (const Coordinate& coordinate : mechanism.coordinates) {
    const Interval& range = box.at(coordinate.name);
    const double part = range.width() / (core::to_double(coordinate.upper) - core::to_double(coordinate.lower));
    if (part > widest_part) {
      widest_part = part;
      widest = coordinate.name;
    }
  }
  std::array<Box, 2> result = {box, box};
  const Interval range = box.at(widest);
  result[0][widest] = {range.lower(), range.middle()};
  result[1][widest] = {range.middle(), range.upper()};
  return result;
}

Box whole_box(const Mechanism& mechanism) {
  Box box;
  for (const Parameter& parameter : mechanism.parameters) box[parameter.name] = core::enclosed(parameter.value);
  for (const Coordinate& coordinate : mechanism.coordinates)
    box[coordinate.name] = core::range_of(coordinate.lower, coordinate.upper);
  return box;
}

/// The values of a measure over the whole box where all of them are proven to miss `reach`; nothing where that is not
/// so.
template <class Measure>
std::optional<Interval> proven_outside(const Mechanism& mechanism, const Interval& reach, Measure measure) {
  constexpr int most_boxes = 4096;
  Interval found(INFINITY, 0);
  std::vector<Box> open = {whole_box(mechanism)};
  for (int count = 0; !open.empty(); ++count) {
    if (count == most_boxes) return std::nullopt;
    const Box box = open.back();
    open.pop_back();
    const Interval d = measure(box);
    if (d.lower() > reach.upper() || d.upper() < reach.lower()) {
      found = {std::min(found.lower(), d.lower()), std::max(found.upper(), d.upper())};
      continue;
    }
    // All of the box within reach: nothing to prove.
    if (d.lower() >= reach.lower() && d.upper() <= reach.upper()) return std::nullopt;
    for (Box& half : halves(mechanism, box)) open.push_back(std::move(half));
  }
  return found;
}

/// The distances |AP| over a box in which the dyad closes nowhere; nothing where that is not proven.
std::optional<Interval> proven_unreachable(const Mechanism& mechanism, const DyadPoint& dyad) {
  if (dyad.right_angle) return std::nullopt;
  const Box whole = whole_box(mechanism);
  const Interval a = bound(dyad.from_length, whole);
  const Interval b = bound(dyad.to_length, whole);
  const Interval reach(std::max({0.0, (a - b).lower(), (b - a).lower()}), (a + b).upper());
  return proven_outside(mechanism, reach, [&](const Box& box) { return distance(mechanism, dyad.from, dyad.to, box); });
}

/// The distances of `from` to the slider's line where they are all too long; nothing where that is not proven.
std::optional<Interval> proven_unreachable(const Mechanism& mechanism, const SliderPoint& slider) {
  const auto* base = std::get_if<ExplicitPoint>(&form_of(mechanism, slider.base));
  const auto* from = std::get_if<ExplicitPoint>(&form_of(mechanism, slider.from));
  if (!base || !from || slider.along.kind != VectorExpression::Kind::components) return std::nullopt;
  const Box whole = whole_box(mechanism);
  std::array<Interval, 3> u;
  Interval squared_size;
  for (std::size_t i = 0; i < slider.along.numbers.size(); ++i) {
    u[i] = bound(slider.along.numbers[i], whole);
    squared_size = squared_size + squared(u[i]);
  }
  const Interval size = root(squared_size);
  if (!(size.lower() > 0)) return std::nullopt;
  const Interval per_length = inverse(size);
  const auto to_line = [&](const Box& box) {
    std::array<Interval, 3> way;
    for (std::size_t i = 0; i < from->coordinates.size(); ++i)
      way[i] = bound(from->coordinates[i], box) - bound(base->coordinates[i], box);
    Interval sum;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      sum = sum + squared((u[j] * way[k] - u[k] * way[j]) * per_length);
    }
    return root(sum);
  };
  return proven_outside(mechanism, {0, bound(slider.length, whole).upper()}, to_line);
}

[[noreturn]] void refuse(const Mechanism& mechanism, const Point& point, const Interval& distances) {
  const auto length = [&](double value) { return core::told(value, "m", mechanism.units, 4); };
  const DyadPoint& dyad = std::get<DyadPoint>(point.form);
  const std::string& from = mechanism.points[static_cast<std::size_t>(dyad.from)].name;
  const std::string& to = mechanism.points[static_cast<std::size_t>(dyad.to)].name;
  const Box whole = whole_box(mechanism);
  const double a = bound(dyad.from_length, whole).upper();
  const double b = bound(dyad.to_length, whole).upper();
  throw core::InputError(point.where,
                         "point " + point.name + " is unreachable in the whole box: |" + from + " " + to +
                             "| runs from about " + length(distances.lower()) + " to " + length(distances.upper()) +
                             ", but the lengths " + length(a) + " and " + length(b) + " reach from " +
                             length(std::abs(a - b)) + " to " + length(a + b),
                         "change the lengths, the points " + from + " and " + to + ", or the workspace");
}

[[noreturn]] void refuse_slider(const Mechanism& mechanism, const Point& point, const Interval& distances) {
  const auto length = [&](double value) { return core::told(value, "m", mechanism.units, 4); };
  const SliderPoint& slider = std::get<SliderPoint>(point.form);
  const std::string& from = mechanism.points[static_cast<std::size_t>(slider.from)].name;
  throw core::InputError(point.where,
                         "point " + point.name + " is unreachable in the whole box: " + from + " is from about " +
                             length(distances.lower()) + " to " + length(distances.upper()) +
                             " off its line, but the length is " +
                             length(bound(slider.length, whole_box(mechanism)).upper()),
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
