#include "mechanism/assembly/shape.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::mechanism {
namespace {

const GivenLength* given_between(const std::vector<GivenLength>& given, PointIndex a, PointIndex b) {
  const auto found = std::find_if(given.begin(), given.end(), [&](const GivenLength& length) {
    return std::minmax(length.first, length.second) == std::minmax(a, b);
  });
  return found == given.end() ? nullptr : &*found;
}

/// Twice the signed area of a triangle in the posture, in the plane of z.
double turn_of(const Drawing& d, PointIndex a, PointIndex b, PointIndex c) {
  const auto &p = d.place(a), &q = d.place(b), &r = d.place(c);
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/// Six times the signed volume of a tetrahedron in the posture.
double corner_of(const Drawing& d, PointIndex a, PointIndex b, PointIndex c, PointIndex e) {
  const auto way = [&](PointIndex to) {
    const auto &p = d.place(a), &q = d.place(to);
    return std::array<double, 3>{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  };
  const auto u = way(b), v = way(c), w = way(e);
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

Amount two() { return Amount(core::Rational(2)); }

}  // namespace

Shape::Shape(const Drawing& drawing, LinkIndex link) : given_(drawing.lengths[static_cast<std::size_t>(link)]) {
  if (!given_.empty()) {
    place_by_lengths(drawing, link);
    return;
  }
  for (const PointIndex point : drawing.link(link).points)
    if (drawing.at(point).is_exact) at_.emplace(point, drawing.at(point).at);
}

void Shape::place_by_lengths(const Drawing& d, LinkIndex index) {
  const Link& link = d.link(index);
  drawn_ = false;
  const PointIndex first = given_.front().first, second = given_.front().second;
  at_.emplace(first, Amounts{});
  at_.emplace(second, Amounts{given_.front().length, {}, {}});
  for (bool more = true; more;) {
    more = false;
    for (const PointIndex point : link.points) {
      if (at_.contains(point)) continue;
      std::vector<PointIndex> bases;
      for (const PointIndex other : link.points)
        if (at_.contains(other) && given_between(given_, other, point) != nullptr) bases.push_back(other);
      if (const auto place = place_from(d, link, point, bases)) {
        at_.emplace(point, *place);
        more = true;
      }
    }
  }
  for (const PointIndex point : link.points)
    if (!at_.contains(point) && !d.at(point).built)
      refuse(d, link, "leave " + d.name(point) + " without a place in it");
}

/// By two points in the plane; in space by three, but for the first that is off the line of two.
std::optional<Amounts> Shape::place_from(const Drawing& d, const Link& link, PointIndex point,
                                         std::vector<PointIndex> bases) const {
  const bool is_first = !d.is_spatial() || std::all_of(at_.begin(), at_.end(), [](const auto& candidate) {
    return std::hypot(candidate.second[1].value(), candidate.second[2].value()) <=
           1e-9 * std::abs(candidate.second[0].value());
  });
  if (bases.size() < (is_first ? 2U : 3U)) return std::nullopt;
  if (is_first) bases.resize(2);
  const auto length_to = [&](PointIndex base) { return given_between(given_, base, point)->length; };
  // From base 0 along u to base 1, at a from the one and b from the other.
  const Amounts& origin = at_.at(bases[0]);
  const Amounts u = at_.at(bases[1]) - origin;
  const Amount c = mechanism::length(u), a = length_to(bases[0]), b = length_to(bases[1]);
  const Amount along = (a * a + c * c - b * b) / (two() * c);
  const Amount rest = a * a - along * along;
  const auto root = [&](const Amount& square) {
    if (square.value() < -1e-12 * a.value() * a.value()) {
      std::vector<std::string> names;
      for (const PointIndex base : bases) names.push_back(d.name(base));
      names.push_back(d.name(point));
      refuse(d, link, "make no " + std::string(is_first ? "triangle" : "corner") + " of " + listed(names));
    }
    return square.value() <= 0 ? Amount() : square_root(square);
  };
  const Amounts unit = (Amount(core::Rational(1)) / c) * u;
  if (is_first) {
    const bool is_right = !d.is_spatial() && turn_of(d, bases[0], bases[1], point) < 0;
    const Amount beside = is_right ? -root(rest) : root(rest);
    return origin + along * unit + beside * Amounts{-unit[1], unit[0], {}};
  }
  // Off the line of the first two the third, at f along it and g beside it; then v beside and w above their plane.
  const auto third = std::find_if(bases.begin() + 2, bases.end(), [&](PointIndex base) {
    const Amounts way = at_.at(base) - origin;
    return size_of(mechanism::cross(u, way)) > 1e-9 * size_of(u) * size_of(way);
  });
  if (third == bases.end()) return std::nullopt;
  std::iter_swap(bases.begin() + 2, third);
  bases.resize(3);
  const Amounts way = at_.at(bases[2]) - origin;
  const Amount f = dot(way, unit);
  const Amounts off = way - f * unit;
  const Amount g = mechanism::length(off), e = length_to(bases[2]);
  const Amounts v = (Amount(core::Rational(1)) / g) * off, w = mechanism::cross(unit, v);
  const Amount beside = (a * a + f * f + g * g - e * e - two() * along * f) / (two() * g);
  const Amount height = root(rest - beside * beside);
  const bool is_below = corner_of(d, bases[0], bases[1], bases[2], point) < 0;
  return origin + along * unit + beside * v + (is_below ? -height : height) * w;
}

void Shape::refuse(const Drawing& d, const Link& link, const std::string& problem) const {
  throw core::InputError(
      given_.front().where, "the lengths of link " + link.name + " " + problem,
      d.is_spatial() ? "give the distances of three points from each other and of every other from three, or none"
                     : "give the distances of every point from two others, as of a triangle after the other, or "
                       "none");
}

Amount Shape::distance(PointIndex a, PointIndex b) const {
  if (const GivenLength* length = given_between(given_, a, b)) return length->length;
  return mechanism::length(way(a, b));
}

}  // namespace clearloci::mechanism
