#include "mechanism/assembly/construction.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

/// A coordinate as it is written, as a factor of sums.
WrittenVector as_written(const Node& form) {
  WrittenVector place;
  for (std::size_t i = 0; i < form.items().size() && i < 3; ++i) {
    const std::string& text = form.items()[i].Scalar();
    const bool word = text.find_first_of("+-*/ ") == std::string::npos;
    place.components[i].push_back({Amount(core::Rational(1)), word ? text : "(" + text + ")"});
  }
  return place;
}

/// A vector in the drawn posture, exactly; nothing where a point of it is not.
std::optional<Amounts> amounts_of(const Drawing& d, const VectorExpression& v) {
  using VectorKind = VectorExpression::Kind;
  std::vector<Amounts> arguments;
  for (const VectorExpression& argument : v.arguments) {
    const auto amounts = amounts_of(d, argument);
    if (!amounts) return std::nullopt;
    arguments.push_back(*amounts);
  }
  const auto number = [&](const Expression& e) {
    const ExactValue value = evaluate(e, d.mechanism.parameters);
    return value.exact && symbols(e).empty() ? Amount(value.value)
                                             : Amount::expression(to_string(e), core::to_double(value.value));
  };
  switch (v.kind) {
    case VectorKind::components: {
      Amounts result;
      for (std::size_t i = 0; i < v.numbers.size(); ++i) result[i] = number(v.numbers[i]);
      return result;
    }
    case VectorKind::point:
      return d.at(v.point).is_exact ? std::optional(d.at(v.point).at) : std::nullopt;
    case VectorKind::add:
      return arguments[0] + arguments[1];
    case VectorKind::negate:
      return Amount(core::Rational(-1)) * arguments[0];
    case VectorKind::scale:
      return number(v.numbers[0]) * arguments[0];
    case VectorKind::cross:
      return mechanism::cross(arguments[0], arguments[1]);
  }
  return std::nullopt;
}

}  // namespace

Construction::Construction(const Drawing& drawing) : d_(drawing), fixed_(fixed_points(drawing)) {
  for (std::size_t l = 0; l < drawing.mechanism.links.size(); ++l)
    shapes_.emplace_back(drawing, static_cast<LinkIndex>(l));
  for (const Point& point : drawing.mechanism.points) names_.insert(point.name);
  for (const Parameter& parameter : drawing.mechanism.parameters) names_.insert(parameter.name);
  for (const Coordinate& coordinate : drawing.mechanism.coordinates) names_.insert(coordinate.name);
}

std::string Construction::new_name(const std::string& wanted) {
  std::string name = wanted;
  for (int k = 2; !names_.insert(name).second; ++k) name = wanted + std::to_string(k);
  return name;
}

Construction::Handle Construction::put(PointIndex point, const Node& form, const std::string& comment,
                                       std::optional<WrittenVector> place) {
  found_.points.push_back({d_.name(point), form, comment});
  known_.push_back({d_.name(point), std::move(place), d_.place(point), d_.at(point).has_place});
  const Handle handle = static_cast<Handle>(known_.size()) - 1;
  handles_.emplace(point, handle);
  return handle;
}

Construction::Handle Construction::put_extra(const std::string& name, const Node& form,
                                             const std::array<double, 3>& posture, const std::string& comment,
                                             std::optional<WrittenVector> place) {
  const std::string point_name = new_name(name);
  found_.points.push_back({point_name, form, comment});
  known_.push_back({point_name, std::move(place), posture, true});
  return static_cast<Handle>(known_.size()) - 1;
}

void Construction::put_together(const std::string& name, const Node& form, const std::string& comment,
                                const std::vector<PointIndex>& points) {
  found_.points.push_back({new_name(name), form, comment});
  for (const PointIndex point : points) {
    known_.push_back({d_.name(point), std::nullopt, d_.place(point), d_.at(point).has_place});
    handles_.emplace(point, static_cast<Handle>(known_.size()) - 1);
  }
}

Construction::Handle Construction::know(const std::string& name, const std::array<double, 3>& posture) {
  known_.push_back({name, std::nullopt, posture, true});
  return static_cast<Handle>(known_.size()) - 1;
}

double Construction::drawn_value(std::size_t coordinate) const {
  using Kind = DrawnCoordinate::Kind;
  const DrawnCoordinate& drawn_coordinate = d_.coordinates[coordinate];
  const auto way = [&](LinkIndex link) -> std::array<double, 3> {
    if (link == ground) return {1, 0, 0};
    const auto &p = d_.place(d_.link(link).points.at(0)), &q = d_.place(d_.link(link).points.at(1));
    return {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  };
  if (drawn_coordinate.kind == Kind::place) return d_.place(drawn_coordinate.point)[drawn_coordinate.axis];
  if (drawn_coordinate.kind == Kind::direction) {
    const auto a = way(drawn_coordinate.other), b = way(drawn_coordinate.link);
    return std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
  }
  if (drawn_coordinate.kind == Kind::stroke) {
    const Joint& joint = d_.joint(drawn_coordinate.joint);
    const bool to_holds = joint.to != ground && is_on_link(d_.mechanism, joint.at, joint.to);
    const LinkIndex base = to_holds ? joint.from : joint.to;
    const auto axis = drawn_axis(drawn_coordinate.joint);
    const auto& at = d_.place(joint.at);
    const std::array<double, 3> from =
        base == ground ? std::array<double, 3>{} : d_.place(d_.link(base).points.front());
    double along = 0, square = 0;
    for (std::size_t i = 0; axis && i < 3; ++i) {
      along += (at[i] - from[i]) * (*axis)[i].value();
      square += (*axis)[i].value() * (*axis)[i].value();
    }
    return square > 0 ? along / std::sqrt(square) : 0;
  }
  return d_.pose.at(coordinate);
}

Node Construction::list(const std::vector<std::string>& texts) const {
  std::vector<Node> items;
  for (const std::string& part : texts) items.push_back(text(part));
  return Node::sequence(std::move(items), {});
}

Node Construction::map(const std::vector<std::pair<std::string, Node>>& pairs) const {
  std::vector<Node::Pair> all;
  for (const auto& [key, content] : pairs) all.emplace_back(text(key), content);
  return Node::map(std::move(all), {});
}

Node Construction::explicit_form(const WrittenVector& place) const {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < dimension(); ++i) texts.push_back(text_of(place.components[i]));
  return list(texts);
}

Node Construction::vector_node(const std::string& written) const {
  const bool whole = written.size() > 2 && written.front() == '[' && written.back() == ']' &&
                     written.find_first_of("([])", 1) == written.size() - 1;
  if (!whole) return text(written);
  std::vector<std::string> parts(1);
  for (const char c : written.substr(1, written.size() - 2)) {
    if (c == ',')
      parts.emplace_back();
    else if (c != ' ' || !parts.back().empty())
      parts.back() += c;
  }
  return list(parts);
}

Node Construction::form_at(Handle base, const WrittenVector& by, std::optional<WrittenVector>& place) const {
  const KnownPoint& from = known(base);
  if (from.place && by.ways.empty()) {
    place = *from.place + by;
    return explicit_form(*place);
  }
  place.reset();
  if (by.ways.empty()) return map({{"from", text(from.name)}, {"by", explicit_form(by)}});
  return map({{"from", text(from.name)}, {"by", text(text_of(by, dimension()))}});
}

void Construction::require_place(Handle handle) const {
  const KnownPoint& known_point = known(handle);
  if (known_point.has_place) return;
  for (const Point& point : d_.mechanism.points)
    if (point.name == known_point.name)
      throw core::InputError(
          point.where,
          "point " + known_point.name + " has a construction over the coordinates, and no place in the drawing",
          "write where it is in the drawn posture, under drawn too");
}

bool Construction::put_given(PointIndex point) {
  const DrawnPoint& drawn_point = d_.at(point);
  if (drawn_point.built) {
    if (!std::all_of(drawn_point.uses.begin(), drawn_point.uses.end(), [&](PointIndex base) { return is_known(base); }))
      return false;
    std::optional<WrittenVector> place;
    if (drawn_point.form.IsSequence())
      place =
          drawn_point.is_exact && !drawn_point.moves ? constant_vector(drawn_point.at) : as_written(drawn_point.form);
    put(point, drawn_point.form, "", std::move(place));
    return true;
  }
  if (!fixed_[static_cast<std::size_t>(point)]) return false;
  put(point, drawn_point.form, "", constant_vector(drawn_point.at));
  return true;
}

bool Construction::is_apart(PointIndex a, PointIndex b) const {
  constexpr double near = 1e-9;  // of the drawing: points drawn so close are meant to be in one place
  const auto &p = d_.place(a), &q = d_.place(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) > near * d_.size;
}

std::vector<PointIndex> Construction::known_points(LinkIndex link) const {
  std::vector<PointIndex> points;
  for (const PointIndex point : d_.link(link).points)
    if (is_known(point) && shape(link).has(point) &&
        std::all_of(points.begin(), points.end(), [&](PointIndex other) { return is_apart(point, other); }))
      points.push_back(point);
  return points;
}

std::optional<Amounts> Construction::drawn_axis(JointIndex joint, std::size_t which) const {
  return amounts_of(d_, d_.joint(joint).axes.at(which));
}

bool Construction::axis_stays(JointIndex joint, std::size_t which) const {
  const Joint& drawn_joint = d_.joint(joint);
  const bool stands = drawn_joint.from == ground || (drawn_joint.to == ground && !is_slot(d_.mechanism, drawn_joint));
  return stands || !points_of(drawn_joint.axes.at(which)).empty();
}

std::vector<LinkIndex> Construction::open_links() const {
  std::vector<LinkIndex> open;
  for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l) {
    const auto& points = d_.mechanism.links[l].points;
    if (!std::all_of(points.begin(), points.end(), [&](PointIndex point) { return is_known(point); }))
      open.push_back(static_cast<LinkIndex>(l));
  }
  return open;
}

}  // namespace clearloci::mechanism
