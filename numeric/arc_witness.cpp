#include "numeric/arc_witness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace clearloci::numeric {

namespace {

/// Distances from an arc, as parts of the box: vertices of arcs are within 1e-12 of it of their curves, and beyond 1e-5
/// other zeros may be nearer than the arc.
constexpr std::array<double, 3> distances = {1e-5, 1e-5 * approach_step, 1e-5 * approach_step* approach_step};

/// An arc is approached from no farther than this part of its length, lest the zeros be others'. Where that is below
/// `least_distance` of the box, rounding errors of vertices would tell: the arc is left undecided.
constexpr double share_of_length = 1e-3, least_distance = 1e-6;

/// Beyond the rounding of vertices: an arc whose other side is reached this close to it, and no farther, is no
/// boundary, but one is so near that nothing tends to anything before it.
constexpr double beside_vertices = 1e-11;

/// Exponents of t are multiples of a half: nearer than this to one they are taken for it.
constexpr double exponent_doubt = 0.2;

/// A point of an arc that is on its curve, with the direction of the arc there.
struct ArcPlace {
  core::Point2 at{}, along{};
};

ArcPlace place_between(const core::Point2& a, const core::Point2& b, const core::Point2& at) {
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  return {at, {(b[0] - a[0]) / length, (b[1] - a[1]) / length}};
}

/// Inside of a single chord the curve is known to the map's tolerance only, where it is neither a line nor a circle.
std::vector<ArcPlace> places_on_chord(const core::LocusCurve& curve, const core::Point2& a, const core::Point2& b,
                                      std::span<const double> shares) {
  const bool line = std::holds_alternative<core::LineForm>(curve.closed_form);
  const std::optional<core::Circle> circle = core::circle_through(curve.closed_form, {a, b});
  std::vector<ArcPlace> places;
  for (const double share : shares) {
    const core::Point2 at = {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
    if (line) places.push_back(place_between(a, b, at));
    if (!circle) continue;
    const double x = at[0] - circle->centre[0], y = at[1] - circle->centre[1], r = std::hypot(x, y);
    places.push_back(
        {{circle->centre[0] + circle->radius * x / r, circle->centre[1] + circle->radius * y / r}, {-y / r, x / r}});
  }
  return places;
}

/// Inner vertices, which are on the curve; or points of a single chord.
std::vector<ArcPlace> places_of(const core::LocusCurve& curve, const core::Polyline& points) {
  // Off the middle, where symmetric designs have special poses.
  constexpr std::array shares = {0.237, 0.419, 0.683};
  if (points.size() < 2) return {};
  if (points.size() == 2) return places_on_chord(curve, points[0], points[1], shares);
  std::vector<ArcPlace> places;
  const auto last = points.size() - 2;
  for (const double share : shares) {
    const auto i =
        std::clamp<std::size_t>(static_cast<std::size_t>(share * static_cast<double>(points.size())), 1, last);
    places.push_back(place_between(points[i - 1], points[i + 1], points[i]));
  }
  return places;
}

BoundedNumerators numerators_on(const NumericModel& model, std::span<const int> mode, const Approach& way, double t) {
  const std::array pose = {way.towards[0] + t * way.across[0], way.towards[1] + t * way.across[1]};
  return bounded_numerators(model, pose, mode);
}

/// Bounds of |w|.
struct Size {
  double least = 0, most = 0;
};

Size size_of(const BoundedNumerators& at, const WitnessColumns& columns) {
  double least = 0, most = 0;
  for (const Bounded& n : components(at, columns)) {
    least = std::hypot(least, std::max(0.0, std::abs(n.value) - n.error));
    most = std::hypot(most, std::abs(n.value) + n.error);
  }
  const double d = std::abs(at.determinant.value), doubt = at.determinant.error;
  return {least / (d + doubt), d > doubt ? most / (d - doubt) : std::numeric_limits<double>::infinity()};
}

}  // namespace

std::vector<Approach> approaches(const NumericModel& model, std::span<const int> mode, const core::LocusCurve& curve,
                                 const core::Arc& arc, double size) {
  std::vector<Approach> ways;
  double length = 0;
  for (std::size_t i = 1; i < arc.points.size(); ++i)
    length += std::hypot(arc.points[i][0] - arc.points[i - 1][0], arc.points[i][1] - arc.points[i - 1][1]);
  const double nearer = std::min(1.0, share_of_length * length / (distances.front() * size));
  if (nearer * distances.front() < least_distance) return ways;
  bool near_boundary = false;
  for (const ArcPlace& place : places_of(curve, arc.points)) {
    const auto beside = [&](double t) {
      const std::array pose = {place.at[0] - t * place.along[1], place.at[1] + t * place.along[0]};
      return bounded_numerators(model, pose, mode);
    };
    for (const double side : {1.0, -1.0}) {
      Approach way{place.at, {-place.along[1], place.along[0]}, side * nearer * distances.front() * size, {}};
      for (const double distance : distances) way.at.push_back(beside(side * nearer * distance * size));
      if (std::all_of(way.at.begin(), way.at.end(), [](const BoundedNumerators& n) { return n.reachable; }))
        ways.push_back(std::move(way));
      else
        near_boundary = near_boundary || beside(side * beside_vertices * size).reachable;
    }
  }
  if (near_boundary) ways.clear();
  return ways;
}

std::optional<Approach> brought_nearer(const NumericModel& model, std::span<const int> mode, const Approach& way) {
  Approach nearer = way;
  nearer.from *= approach_step;
  nearer.at.erase(nearer.at.begin());
  nearer.at.push_back(numerators_on(model, mode, way, nearer.from * approach_step * approach_step));
  return nearer.at.back().reachable ? std::optional(std::move(nearer)) : std::nullopt;
}

bool turns_round(const NumericModel& model, std::span<const int> mode, const Approach& way,
                 const WitnessColumns& columns, double reach) {
  std::array<ForceNumerators, 2> sides{};
  double sign = 1;
  for (const std::size_t side : {0u, 1u}) {
    const BoundedNumerators at = numerators_on(model, mode, way, side == 0 ? reach : -reach);
    if (!at.reachable || std::abs(at.determinant.value) <= at.determinant.error) return false;
    if (at.determinant.value < 0) sign = -sign;
    const auto values = components(at, columns);
    for (std::size_t c = 0; c < values.size(); ++c) sides[side][c] = values[c].value;
  }
  return sign * turn_cosine(sides[0], sides[1]) < -least_cosine;
}

std::optional<Tendency> tendency(const Approach& approach, const WitnessColumns& columns) {
  // The exponent of t between two distances, from below and from above.
  const auto exponent = [&](std::size_t from) -> std::optional<std::array<double, 2>> {
    const Size far = size_of(approach.at[from], columns), near = size_of(approach.at[from + 1], columns);
    if (far.most == 0 || near.most == 0 || std::isinf(far.most) || std::isinf(near.most)) return std::nullopt;
    const double scale = std::log(approach_step);
    return std::array{std::log(near.most / far.least) / scale, std::log(near.least / far.most) / scale};
  };
  std::optional<Tendency> found;
  for (const std::size_t from : {std::size_t{1}, std::size_t{0}}) {
    const auto e = exponent(from);
    if (!e) return std::nullopt;
    const auto [low, high] = *e;
    std::optional<Tendency> here;
    if (low > 0.5 - exponent_doubt) here = Tendency::zero;
    if (low > -exponent_doubt && high < exponent_doubt) here = Tendency::finite;
    if (high < -0.5 + exponent_doubt) here = Tendency::unbounded;
    if (!here || (found && *found != *here)) return std::nullopt;
    found = here;
  }
  return found;
}

}  // namespace clearloci::numeric
