#include "symbolic/sheet_writer.hpp"

namespace clearloci::symbolic {

void SheetWriter::write_length(const InverseLength& length, Lines& lines) const {
  if (length.root < 0 || length.name.rfind("limit", 0) == 0) return;  // no force acts along the arms of a limit
  const FormulaWriter w(language_);
  const FormulaText one = as_text(Poly(geometry_.ring(), 1));
  lines.emplace_back(symbols_[static_cast<std::size_t>(length.variable)],
                     w.quotient(one, w.root(as_text(squared(length.along)))).text);
}

void SheetWriter::write_angle(const TorsionAngle& angle, Lines& lines) const {
  const auto part = [&](std::size_t i) { return as_text(geometry_.poly(angle.way[i])); };
  lines.emplace_back(symbols_[static_cast<std::size_t>(angle.variable)],
                     FormulaWriter(language_).angle(part(1), part(0)).text);
}

void SheetWriter::write_closure(const ConstructedPoint& c, Lines& lines) {
  const mechanism::Point& point = mechanism_.points[static_cast<std::size_t>(c.point)];
  if (const auto* dyad = std::get_if<mechanism::DyadPoint>(&point.form)) {
    write_dyad(c, point.name, *dyad, lines);
  } else if (const auto* slider = std::get_if<mechanism::SliderPoint>(&point.form)) {
    write_slider(c, point.name, *slider, lines);
  } else if (const auto* offset = std::get_if<mechanism::OffsetPoint>(&point.form)) {
    // Otherwise linear in the two other points.
    if (geometry_.poly(geometry_.natural(c.point)[0]).depends_on(c.x)) write_offset(c, point.name, *offset, lines);
  } else if (const auto* crossing = std::get_if<mechanism::CrossingPoint>(&point.form)) {
    write_crossing(c, point.name, *crossing, lines);
  }
}

void SheetWriter::write_closing(const mechanism::Group& group, std::vector<std::string>& polynomials) const {
  const auto way = [&](mechanism::PointIndex from, mechanism::PointIndex to, std::size_t axis) {
    return coordinate(to, axis) - coordinate(from, axis);
  };
  for (const mechanism::Group::Distance& distance : group.distances) {
    Poly sum = -geometry_.squared_length(distance.length);
    for (std::size_t axis = 0; axis < mechanism::dimension(mechanism_); ++axis)
      sum += way(distance.first, distance.second, axis).pow(2);
    polynomials.push_back(text(sum));
  }
  for (const mechanism::Group::Line& line : group.lines) {
    const std::vector<GiNaC::ex> along = geometry_.vector(line.along);
    polynomials.push_back(text(way(line.base, line.point, 0) * geometry_.poly(along[1]) -
                               way(line.base, line.point, 1) * geometry_.poly(along[0])));
  }
}

void SheetWriter::write_dyad(const ConstructedPoint& c, const std::string& name, const mechanism::DyadPoint& dyad,
                             Lines& lines) {
  const FormulaWriter w(language_);
  const FormulaText D = symbol_text("D" + name), k = symbol_text("k" + name), s = symbol_text("s" + name);
  const Vector way = difference(dyad.from, dyad.to);
  const Poly a2 = geometry_.squared_length(dyad.from_length), b2 = geometry_.squared_length(dyad.to_length);
  const FormulaText way2 = squared(way), reach = as_text(a2.scaled(4)), excess = as_text(a2 - b2);
  const auto add_root = [&](const FormulaText& square) {
    const FormulaText root = w.root(square);
    lines.emplace_back(s.text, (dyad.side == mechanism::Side::left ? root : w.negated(root)).text);
  };
  const auto over_twice_D = [&](const FormulaText& along, const FormulaText& left) {
    return w.quotient(w.sum(w.product(k, along), w.product(s, left)), w.twice(D));
  };
  if (!dyad.axis) {
    lines.emplace_back(D.text, way2.text);
    lines.emplace_back(k.text, dyad.right_angle ? as_text(a2.scaled(2)).text : w.sum(excess, D).text);
    add_root(w.difference(w.product(reach, D), w.squared(k)));
    const FormulaText x = w.quotient(w.difference(w.product(k, way[0]), w.product(s, way[1])), w.twice(D));
    write_place(c, dyad.from, {x, over_twice_D(way[1], way[0]), {}}, lines);
    return;
  }
  const FormulaText h = symbol_text("h" + name);
  const Vector n = direction(*dyad.axis);
  const FormulaText n2 = as_text(squared(*dyad.axis));
  lines.emplace_back(h.text, dot(n, way).text);
  lines.emplace_back(D.text, w.difference(w.product(n2, way2), w.squared(h)).text);
  lines.emplace_back(k.text, w.sum(excess, way2).text);
  add_root(w.difference(w.product(reach, D), w.product(n2, w.squared(k))));
  const Vector left = cross(n, way);
  Vector step;
  for (std::size_t i = 0; i < 3; ++i)
    step[i] = over_twice_D(w.difference(w.product(n2, way[i]), w.product(h, n[i])), left[i]);
  write_place(c, dyad.from, step, lines);
}

void SheetWriter::write_slider(const ConstructedPoint& c, const std::string& name, const mechanism::SliderPoint& slider,
                               Lines& lines) {
  const FormulaWriter w(language_);
  const FormulaText p = symbol_text("p" + name), s = symbol_text("s" + name);
  const Vector u = direction(slider.along), way = difference(slider.base, slider.from), across = cross(u, way);
  lines.emplace_back(p.text, dot(u, way).text);
  FormulaText q = across[2];
  if (mechanism_.space == mechanism::Space::planar) {
    q = symbol_text("q" + name);
    lines.emplace_back(q.text, across[2].text);
  }
  const FormulaText across2 = mechanism_.space == mechanism::Space::planar ? w.squared(q) : squared(across);
  const FormulaText size = as_text(squared(slider.along));
  const Poly l2 = geometry_.squared_length(slider.length);
  const FormulaText root = w.root(w.difference(w.product(as_text(l2), size), across2));
  lines.emplace_back(s.text, (slider.ahead ? root : w.negated(root)).text);
  const FormulaText step = w.quotient(w.sum(p, s), size);
  write_place(c, slider.base, {w.product(step, u[0]), w.product(step, u[1]), w.product(step, u[2])}, lines);
}

void SheetWriter::write_crossing(const ConstructedPoint& c, const std::string& name,
                                 const mechanism::CrossingPoint& crossing, Lines& lines) {
  const FormulaWriter w(language_);
  const FormulaText p = symbol_text("p" + name);
  const Vector u = direction(crossing.along_first), v = direction(crossing.along_second);
  const Vector way = difference(crossing.first, crossing.second);
  lines.emplace_back(p.text, w.quotient(cross(way, v)[2], cross(u, v)[2]).text);
  write_place(c, crossing.first, {w.product(p, u[0]), w.product(p, u[1]), {}}, lines);
}

void SheetWriter::write_offset(const ConstructedPoint& c, const std::string& name, const mechanism::OffsetPoint& offset,
                               Lines& lines) {
  const FormulaWriter w(language_);
  const FormulaText l = symbol_text("l" + name);
  const Vector way = difference(offset.first, offset.second);
  const FormulaText along = as_text(length(offset.along)), left = as_text(length(offset.left));
  lines.emplace_back(l.text, w.root(squared(way)).text);
  write_place(c, offset.first,
              {w.quotient(w.difference(w.product(along, way[0]), w.product(left, way[1])), l),
               w.quotient(w.sum(w.product(along, way[1]), w.product(left, way[0])), l),
               w.quotient(w.product(along, way[2]), l)},
              lines);
}

void SheetWriter::write_place(const ConstructedPoint& c, mechanism::PointIndex from, const Vector& step,
                              Lines& lines) const {
  const FormulaWriter w(language_);
  const std::array<int, 3> variables = {c.x, c.y, c.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (variables[i] < 0) continue;
    lines.emplace_back(symbols_[static_cast<std::size_t>(variables[i])],
                       w.sum(as_text(coordinate(from, i)), step[i]).text);
  }
}

FormulaText SheetWriter::dot(const Vector& a, const Vector& b) const {
  const FormulaWriter w(language_);
  return w.sum(w.sum(w.product(a[0], b[0]), w.product(a[1], b[1])), w.product(a[2], b[2]));
}

FormulaText SheetWriter::squared(const Vector& a) const {
  const FormulaWriter w(language_);
  return w.sum(w.sum(w.squared(a[0]), w.squared(a[1])), w.squared(a[2]));
}

SheetWriter::Vector SheetWriter::cross(const Vector& a, const Vector& b) const {
  const FormulaWriter w(language_);
  const auto minor = [&](std::size_t i, std::size_t k) {
    return w.difference(w.product(a[i], b[k]), w.product(a[k], b[i]));
  };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

SheetWriter::Vector SheetWriter::direction(const mechanism::VectorExpression& vector) const {
  Vector u = {as_text(Poly(geometry_.ring())), as_text(Poly(geometry_.ring())), as_text(Poly(geometry_.ring()))};
  const std::vector<GiNaC::ex> natural = geometry_.vector(vector);
  for (std::size_t i = 0; i < natural.size(); ++i) u[i] = as_text(geometry_.poly(natural[i]));
  return u;
}

Poly SheetWriter::squared(const mechanism::VectorExpression& vector) const {
  Poly sum(geometry_.ring());
  for (const GiNaC::ex& u : geometry_.vector(vector)) sum += geometry_.poly(u) * geometry_.poly(u);
  return sum;
}

SheetWriter::Vector SheetWriter::difference(mechanism::PointIndex from, mechanism::PointIndex to) const {
  const auto along = [&](std::size_t axis) { return as_text(coordinate(to, axis) - coordinate(from, axis)); };
  return {along(0), along(1), along(2)};
}

}  // namespace clearloci::symbolic
