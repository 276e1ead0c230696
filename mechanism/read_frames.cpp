// Frames of platforms and the points in them: p = p_origin + R p', with R = Rz(γ) Ry(β) Rx(α) in space for
// `turned: [α, β, γ]`, and the rotation by `turned: φ` in the plane.
#include <algorithm>
#include <array>

#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using Kind = Expression::Kind;

bool is_number(const Expression& e, int value) { return e.kind() == Kind::number && e.value() == value; }

/// Products and sums without the terms that are not there: most platforms turn about one axis or not at all.
Expression product(const Expression& a, const Expression& b) {
  if (is_number(a, 0) || is_number(b, 0)) return {};
  if (is_number(a, 1)) return b;
  if (is_number(b, 1)) return a;
  return Expression::apply(Kind::multiply, {a, b});
}

Expression negated(const Expression& a) { return is_number(a, 0) ? a : Expression::apply(Kind::negate, {a}); }

Expression sum(const Expression& a, const Expression& b) {
  if (is_number(a, 0)) return b;
  if (is_number(b, 0)) return a;
  return Expression::apply(Kind::add, {a, b});
}

/// cos and sin of an angle.
struct Turn {
  Expression cosine, sine;
};

Turn turn_by(const Expression& angle) {
  if (is_number(angle, 0)) return {Expression::number(1), Expression()};
  return {Expression::apply(Kind::cos, {angle}), Expression::apply(Kind::sin, {angle})};
}

using Matrix = std::vector<Expression>;  // rows of a square one

Matrix times(const Matrix& a, const Matrix& b) {
  Matrix result(9);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        result[3 * i + j] = sum(result[3 * i + j], product(a[3 * i + k], b[3 * k + j]));
  return result;
}

Matrix about(std::size_t axis, const Turn& turn) {
  Matrix result(9);
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  result[3 * axis + axis] = Expression::number(1);
  result[3 * u + u] = result[3 * v + v] = turn.cosine;
  result[3 * u + v] = negated(turn.sine);
  result[3 * v + u] = turn.sine;
  return result;
}

Turn read_turn(const Mechanism& mechanism, const Value& value) {
  return turn_by(read_expression(mechanism, value, Scope::parameters_and_coordinates));
}

/// In the plane.
Expression read_angle(const Mechanism& mechanism, const Mapping& mapping) {
  const std::optional<Value> turned = mapping.find("turned");
  if (!turned) return {};
  return read_expression(mechanism, turned->is_sequence() ? elements(*turned, 1)[0] : *turned,
                         Scope::parameters_and_coordinates);
}

/// `zyx`: R = Rz Ry Rx, so that the last letter's rotation comes first. Any order of the three.
Matrix read_rotation(const Mechanism& mechanism, const Mapping& mapping) {
  const std::optional<Value> turned = mapping.find("turned"), order = mapping.find("order");
  if (mechanism.space == Space::planar) {
    if (order) throw InputError(order->where, order->what + " has no meaning in the plane", "remove it");
    const Turn turn = turn_by(read_angle(mechanism, mapping));
    return {turn.cosine, negated(turn.sine), turn.sine, turn.cosine};
  }
  std::string letters = order ? text_of(*order) : "zyx";
  std::string sorted = letters;
  std::sort(sorted.begin(), sorted.end());
  if (sorted != "xyz")
    throw InputError(order->where, order->what + " is '" + letters + "'",
                     "write zyx for R = Rz Ry Rx, or another order of the three letters");
  Matrix result = about(0, turn_by({}));
  if (!turned) return result;
  std::vector<Turn> turns;
  for (const Value& angle : elements(*turned, 3)) turns.push_back(read_turn(mechanism, angle));
  for (const char letter : letters) {
    const auto axis = static_cast<std::size_t>(letter - 'x');
    result = times(result, about(axis, turns[axis]));
  }
  return result;
}

BodyFrame read_frame(const Mechanism& mechanism, const Entry& entry) {
  Value described = entry.value;
  described.what = "frame " + entry.key;
  const Mapping mapping(described, {"at", "turned", "order"});
  BodyFrame frame;
  frame.name = entry.key;
  const Value at = mapping.at("at");
  frame.origin = read_point_name(mechanism, at);
  if (!std::holds_alternative<ExplicitPoint>(mechanism.points[static_cast<std::size_t>(frame.origin)].form))
    throw InputError(
        at.where, described.what + " stands at " + text_of(at) + ", which is no point with coordinates",
        "name one that is written as coordinates; on a link whose points are constructed, write {on: ...}");
  frame.rotation = read_rotation(mechanism, mapping);
  if (mechanism.space == Space::planar) frame.angle = read_angle(mechanism, mapping);
  return frame;
}

bool is_read(const Mechanism& mechanism, const std::string& name) {
  return std::any_of(mechanism.body_frames.begin(), mechanism.body_frames.end(),
                     [&](const BodyFrame& frame) { return frame.name == name; });
}

/// The name of the point that a frame stands at, as far as it is written well enough to tell.
std::optional<std::string> origin_of(const Value& frame) {
  if (!frame.is_map()) return std::nullopt;
  for (const Entry& part : entries(frame))
    if (part.key == "at" && part.value.is_scalar()) return part.value.node.Scalar();
  return std::nullopt;
}

}  // namespace

void read_known_frames(Mechanism& mechanism, const std::optional<Value>& frames) {
  if (!frames || frames->node.IsNull()) return;
  for (const Entry& entry : entries(*frames)) {
    const std::optional<std::string> origin = origin_of(entry.value);
    if (is_read(mechanism, entry.key) || !origin || mechanism.points.back().name != *origin) continue;
    check_label(entry.key, entry.where, "a frame");
    mechanism.body_frames.push_back(read_frame(mechanism, entry));
  }
}

void check_all_frames_read(const Mechanism& mechanism, const std::optional<Value>& frames) {
  if (!frames || frames->node.IsNull()) return;
  for (const Entry& entry : entries(*frames))
    if (!is_read(mechanism, entry.key)) (void)read_frame(mechanism, entry);  // says what is wrong with it
}

namespace {

const BodyFrame& frame_named(const Mechanism& mechanism, const Value& in, const std::string& what) {
  const std::string name = text_of(in);
  const auto frame = std::find_if(mechanism.body_frames.begin(), mechanism.body_frames.end(),
                                  [&](const BodyFrame& one) { return one.name == name; });
  if (frame != mechanism.body_frames.end()) return *frame;
  std::vector<std::string> allowed;
  for (const BodyFrame& one : mechanism.body_frames) allowed.push_back(one.name);
  throw InputError(in.where, what + ": there is no frame '" + name + "' above it",
                   allowed.empty() ? "describe it under frames, at a point that is written above this one"
                                   : suggest(name, allowed, "frames whose points are known here"));
}

/// R v.
std::vector<Expression> turned(const BodyFrame& frame, const std::vector<Expression>& v) {
  const std::size_t n = v.size();
  std::vector<Expression> result(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) result[i] = sum(result[i], product(frame.rotation[n * i + j], v[j]));
  return result;
}

}  // namespace

ExplicitPoint read_point_in_frame(const Mechanism& mechanism, const Value& value) {
  const Mapping mapping(value, {"in", "place"});
  const BodyFrame& frame = frame_named(mechanism, mapping.at("in"), value.what);
  std::vector<Expression> place;
  for (const Value& part : components(mechanism, mapping.at("place")))
    place.push_back(read_number(mechanism, part, Sign::any).expression);
  ExplicitPoint point = std::get<ExplicitPoint>(mechanism.points[static_cast<std::size_t>(frame.origin)].form);
  const std::vector<Expression> way = turned(frame, place);
  for (std::size_t i = 0; i < way.size(); ++i) point.coordinates[i] = sum(point.coordinates[i], way[i]);
  return point;
}

VectorExpression in_directions_of(const Mechanism& mechanism, const Value& in, const Value& by,
                                  const VectorExpression& vector) {
  const BodyFrame& frame = frame_named(mechanism, in, by.what);
  if (vector.kind != VectorExpression::Kind::components)
    throw InputError(by.where, by.what + " is made of points, whose directions are those of the ground",
                     "write its components in the frame, or leave out in:");
  return {VectorExpression::Kind::components, turned(frame, vector.numbers), 0, {}};
}

}  // namespace clearloci::mechanism
