#include "mechanism/assembly/shape.hpp"

#include <algorithm>
#include <cmath>

namespace clearloci::mechanism {
namespace {

const GivenLength* given_between(const std::vector<GivenLength>& given, PointIndex a, PointIndex b) {
  const auto found = std::find_if(given.begin(), given.end(), [&](const GivenLength& own) {
    return std::minmax(own.first, own.second) == std::minmax(a, b);
  });
  return found == given.end() ? nullptr : &*found;
}

/// Twice the signed area of a triangle in the posture, in the plane of z.
double turn_of(const Drawing& d, PointIndex a, PointIndex b, PointIndex c) {
  const auto &p = d.place(a), &q = d.place(b), &r = d.place(c);
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

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
  const auto refuse = [&](const std::string& problem) {
    throw core::InputError(
        given_.front().where, "the lengths of link " + link.name + " " + problem,
        "give the distances of every point from two others, as of a triangle after the other, or none");
  };
  const PointIndex first = given_.front().first, second = given_.front().second;
  at_.emplace(first, Amounts{});
  at_.emplace(second, Amounts{given_.front().length, {}, {}});
  if (d.is_spatial() && link.points.size() > 3) refuse("are of more than three points, which fix no shape in space");
  for (bool more = true; more;) {
    more = false;
    for (const PointIndex point : link.points) {
      if (at_.contains(point)) continue;
      std::vector<const GivenLength*> to;
      std::vector<PointIndex> base;
      for (const auto& [known, place] : at_)
        if (const GivenLength* own = given_between(given_, known, point); own != nullptr && to.size() < 2) {
          to.push_back(own);
          base.push_back(known);
        }
      if (to.size() < 2) continue;
      // From base 0 along u to base 1, at a from the one and b from the other.
      const Amounts u = at_.at(base[1]) - at_.at(base[0]);
      const Amount c = mechanism::length(u), a = to[0]->length, b = to[1]->length;
      const Amount along = (a * a + c * c - b * b) / (Amount(core::Rational(2)) * c);
      const Amount square = a * a - along * along;
      if (square.value() < -1e-12 * a.value() * a.value())
        refuse("make no triangle of " + d.name(base[0]) + ", " + d.name(base[1]) + " and " + d.name(point));
      Amount beside = square.value() <= 0 ? Amount() : square_root(square);
      if (turn_of(d, base[0], base[1], point) < 0) beside = -beside;
      const Amounts unit = (Amount(core::Rational(1)) / c) * u, left = {-unit[1], unit[0], {}};
      at_.emplace(point, at_.at(base[0]) + along * unit + beside * left);
      more = true;
    }
  }
  for (const PointIndex point : link.points)
    if (!at_.contains(point) && !d.at(point).built) refuse("leave " + d.name(point) + " without a place in it");
}

Amount Shape::distance(PointIndex a, PointIndex b) const {
  if (const GivenLength* own = given_between(given_, a, b)) return own->length;
  return mechanism::length(way(a, b));
}

}  // namespace clearloci::mechanism
