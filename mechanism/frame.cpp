#include "mechanism/frame.hpp"

#include <algorithm>
#include <utility>

#include "mechanism/free_polynomial.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::mechanism {
namespace {

class Change {
 public:
  Change(const Mechanism& mechanism, const Frame& frame, Parameters parameters)
      : mechanism_(mechanism), frame_(frame), parameters_(parameters) {}

  Mechanism run() const {
    Mechanism result = mechanism_;
    for (std::size_t i = 0; i < result.coordinates.size(); ++i) {
      Coordinate& coordinate = result.coordinates[i];
      if (coordinate.angle) continue;
      coordinate.lower = (coordinate.lower - frame_.from[i]) / frame_.scale;
      coordinate.upper = (coordinate.upper - frame_.from[i]) / frame_.scale;
      coordinate.lower_expression = Expression::number(coordinate.lower);
      coordinate.upper_expression = Expression::number(coordinate.upper);
    }
    for (Point& point : result.points) change(point.form);
    for (Group& group : result.groups) change(group);
    for (std::size_t i = 0; i < result.near.size(); ++i)
      if (!result.coordinates[i].angle) result.near[i] = (result.near[i] - frame_.from[i]) / frame_.scale;
    for (Link& link : result.links)
      if (link.inertia) link.inertia = scaled(*link.inertia, 2);
    for (Joint& joint : result.joints) {
      for (VectorExpression& axis : joint.axes) change(axis);
      // Of a couple, else of a force.
      if (joint.effort) joint.effort = scaled(*joint.effort, traits(joint).slides ? 0 : 1);
      if (joint.meshing) {
        if (actuator_quantity(joint) == core::Quantity::M) joint.meshing->most = scaled(joint.meshing->most, 1);
        joint.meshing->radius = scaled(joint.meshing->radius, 1);
        if (joint.meshing->distance) joint.meshing->distance = scaled(*joint.meshing->distance, 1);
      }
      for (auto* within : {&joint.within, &joint.law_within})
        if (*within && !traits(joint).slides) {
          (*within)->first /= frame_.scale;
          (*within)->second /= frame_.scale;
        }
      if (!joint.clearance) continue;
      for (Expression* length :
           {&joint.clearance->radial, &joint.clearance->gap, &joint.clearance->half_length, &joint.clearance->axial})
        *length = scaled(*length, 1);
    }
    // Forces stay as they are: N over a length that is `scale` m.
    const auto scale = [this](Expression& number, int power) { number = scaled(number, power); };
    for (Load& load : result.loads) {
      load.each_number(scale);
      if (load.force_vector) change(*load.force_vector);
    }
    for (Spring& spring : result.springs)
      spring.each_number([&scale](Expression& constant, int power) {
        if (power != 0) scale(constant, power);
      });
    for (Limit& limit : result.limits) {
      if (limit.is_angle()) continue;
      limit.lower = scaled(limit.lower, 1);
      limit.upper = scaled(limit.upper, 1);
      limit.lower_value /= frame_.scale;
      limit.upper_value /= frame_.scale;
    }
    return result;
  }

 private:
  FreePolynomial sum(const Expression& e) const { return free_polynomial(e, mechanism_, frame_, parameters_); }

  /// Over the scale's power.
  Expression scaled(const Expression& e, int power) const {
    Rational factor = 1;
    for (int i = 0; i < power; ++i) factor /= frame_.scale;
    for (int i = power; i < 0; ++i) factor *= frame_.scale;
    return (FreePolynomial(factor) * sum(e)).expression();
  }

  void change(PointForm& form) const {
    if (auto* explicit_point = std::get_if<ExplicitPoint>(&form))
      for (std::size_t i = 0; i < explicit_point->coordinates.size(); ++i)
        explicit_point->coordinates[i] = (FreePolynomial(1 / frame_.scale) *
                                          (sum(explicit_point->coordinates[i]) + FreePolynomial(-frame_.origin[i])))
                                             .expression();
    if (auto* dyad = std::get_if<DyadPoint>(&form)) {
      dyad->from_length = scaled(dyad->from_length, 1);
      dyad->to_length = scaled(dyad->to_length, 1);
      if (dyad->axis) change(*dyad->axis);
    }
    if (auto* offset = std::get_if<OffsetPoint>(&form)) {
      offset->along = scaled(offset->along, 1);
      offset->left = scaled(offset->left, 1);
    }
    if (auto* slider = std::get_if<SliderPoint>(&form)) {
      slider->length = scaled(slider->length, 1);
      change(slider->along);
    }
    if (auto* shifted = std::get_if<ShiftedPoint>(&form)) {
      change(shifted->by);
      VectorExpression inside;
      inside.kind = VectorExpression::Kind::scale;
      inside.numbers = {Expression::number(1 / frame_.scale)};
      inside.arguments = {std::move(shifted->by)};
      shifted->by = std::move(inside);
    }
    if (auto* crossing = std::get_if<CrossingPoint>(&form)) {
      change(crossing->along_first);
      change(crossing->along_second);
    }
  }

  void change(Group& group) const {
    for (Group::Distance& distance : group.distances) distance.length = scaled(distance.length, 1);
    for (Group::Line& line : group.lines) change(line.along);
    for (auto& place : group.near)
      for (std::size_t i = 0; i < dimension(mechanism_); ++i) place[i] = (place[i] - frame_.origin[i]) / frame_.scale;
  }

  /// The same vector: places in it are put back; of a difference of places their scale alone.
  void change(VectorExpression& vector) const {
    const std::optional<Rational> weight = weight_of(vector);
    change(vector, !weight || *weight != 0);
  }

  void change(VectorExpression& vector, bool with_origin) const {
    using Kind = VectorExpression::Kind;
    for (Expression& number : vector.numbers) number = scaled(number, 0);
    if (vector.kind != Kind::point) {
      for (VectorExpression& argument : vector.arguments)
        if (vector.kind == Kind::cross)
          change(argument);
        else
          change(argument, with_origin);
      return;
    }
    VectorExpression way;
    way.kind = Kind::scale;
    way.numbers = {Expression::number(frame_.scale)};
    way.arguments = {vector};
    if (!with_origin) {
      vector = std::move(way);
      return;
    }
    VectorExpression origin;
    for (std::size_t i = 0; i < dimension(mechanism_); ++i)
      origin.numbers.push_back(Expression::number(frame_.origin[i]));
    vector = {};
    vector.kind = Kind::add;
    vector.arguments = {std::move(way), std::move(origin)};
  }

  /// How often the origin of places is in the vector; nothing where that depends on the pose.
  std::optional<Rational> weight_of(const VectorExpression& vector) const {
    using Kind = VectorExpression::Kind;
    if (vector.kind == Kind::point) return Rational(1);
    if (vector.kind == Kind::components || vector.kind == Kind::cross) return Rational(0);
    Rational weight = 0;
    for (const VectorExpression& argument : vector.arguments) {
      const std::optional<Rational> value = weight_of(argument);
      if (!value) return std::nullopt;
      weight += *value;
    }
    if (vector.kind == Kind::negate) return Rational(-weight);
    if (vector.kind == Kind::add || weight == 0) return weight;
    const FreePolynomial factor = free_polynomial(vector.numbers.front(), mechanism_, frame_, Parameters::valued);
    return factor.is_constant() ? std::optional(Rational(weight * factor.constant())) : std::nullopt;
  }

  const Mechanism& mechanism_;
  const Frame& frame_;
  Parameters parameters_;
};

}  // namespace

bool Frame::is_usual() const {
  const auto zero = [](const Rational& value) { return value == 0; };
  return scale == 1 && std::all_of(origin.begin(), origin.end(), zero) && std::all_of(from.begin(), from.end(), zero);
}

std::optional<Mechanism> in_frame(const Mechanism& mechanism, const Frame& frame, Parameters parameters) {
  try {
    Mechanism inside = Change(mechanism, frame, parameters).run();
    inside.frame = frame;
    return inside;
  } catch (const NotPolynomial&) {
    return std::nullopt;
  }
}

}  // namespace clearloci::mechanism
