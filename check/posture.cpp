#include "check/pose_values.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::check {
namespace {

/// Whether a pose may be where the number under a root is this: a cell is proven only where all of it is.
bool may_be(const Interval& square) { return !square.below(); }
bool may_be(const Jet& square) { return square.sign() > 0; }

/// Places the points one by one.
template <class Number>
class Placing {
 public:
  using Vector = VectorOf<Number>;

  Placing(const Mechanism& m, const std::vector<int>& sides, const VariablesOf<Number>& variables,
          const std::vector<Vector>& groups)
      : m_(m), sides_(sides), values_(m, variables), groups_(groups) {}

  PostureOf<Number> first(std::size_t count) {
    for (std::size_t i = 0; i < count && !result_.stopped_by; ++i)
      result_.points.push_back(std::visit([&](const auto& form) { return place(form); }, m_.points[i].form));
    return std::move(result_);
  }

  PostureOf<Number> run() {
    result_ = first(m_.points.size());
    for (const mechanism::Limit& limit : m_.limits)
      if (!result_.stopped_by) hold(limit);
    for (const mechanism::JointIndex joint : mechanism::bounded_laws(m_))
      if (!result_.stopped_by) hold(m_.joints[static_cast<std::size_t>(joint)]);
    for (const mechanism::Spring& spring : m_.springs)
      if (!result_.stopped_by) hold(spring);
    for (const mechanism::Joint& joint : m_.joints)
      if (!result_.stopped_by && mechanism::traits(joint).slides && !joint.axes.empty())
        divisor(square_of(values_.vector(joint.axes.front(), result_.points)));
    return std::move(result_);
  }

 private:
  const Vector& at(mechanism::PointIndex point) const { return result_.points.at(static_cast<std::size_t>(point)); }
  Number value(const Expression& e) const { return values_.value(e); }

  Number square(const Number& number) { return noted(number, may_be(number), result_.squares); }
  Number divisor(const Number& number) { return noted(number, number.sign() > 0, result_.divisors); }
  Number noted(const Number& number, bool holds, std::vector<Number>& list) {
    if (result_.stopped_by) return number;
    list.push_back(number);
    if (!holds) result_.stopped_by = number;
    return number;
  }
  Vector unit(const Vector& v) { return inverse(root_of(divisor(square_of(v)))) * v; }
  Number branch(const Number& q) {
    const Number root = root_of(square(q));
    return sides_.at(next_side_++) > 0 ? root : -root;
  }

  Vector place(const mechanism::ExplicitPoint& form) const { return values_.components(form.coordinates); }
  Vector place(const mechanism::MeanPoint& form) const {
    return Values<Number>::number(0.5) * (at(form.first) + at(form.second));
  }
  Vector place(const mechanism::ShiftedPoint& form) const {
    return at(form.from) + values_.vector(form.by, result_.points);
  }
  Vector place(const mechanism::GroupPoint&) {
    if (next_of_groups_ >= groups_.size())
      throw core::InputError({m_.file},
                             "a certificate of loci is of points with closed forms, and some of these "
                             "close together",
                             "");
    return groups_[next_of_groups_++];
  }

  Vector place(const mechanism::DyadPoint& form) {
    const Vector way = at(form.to) - at(form.from);
    const Vector n = form.axis ? unit(values_.vector(*form.axis, result_.points)) : unit_along<Number>(2);
    const Number h = dot(n, way);
    const Vector r = way - h * n;
    const Number d = divisor(square_of(r));
    const Number a2 = squared(value(form.from_length));
    const Number k =
        form.right_angle ? Values<Number>::number(2.0) * a2 : a2 - (squared(value(form.to_length)) - squared(h)) + d;
    const Number s = branch(Values<Number>::number(4.0) * a2 * d - squared(k));
    const Number half = Values<Number>::number(0.5) * inverse(d);
    return at(form.from) + (k * half) * r + (s * half) * cross(n, r);
  }

  Vector place(const mechanism::SliderPoint& form) {
    const Vector u = unit(values_.vector(form.along, result_.points)), r = at(form.from) - at(form.base);
    const Number s = branch(squared(value(form.length)) - square_of(cross(u, r)));
    return at(form.base) + (dot(u, r) + s) * u;
  }

  Vector place(const mechanism::CrossingPoint& form) {
    const Vector u = values_.vector(form.along_first, result_.points);
    const Vector v = values_.vector(form.along_second, result_.points);
    const Number turn = cross(u, v)[2];
    divisor(squared(turn));
    return at(form.first) + (cross(at(form.second) - at(form.first), v)[2] / turn) * u;
  }

  Vector place(const mechanism::OffsetPoint& form) {
    const Vector u = unit(at(form.second) - at(form.first));
    Vector place = at(form.first) + value(form.along) * u;
    if (m_.space == mechanism::Space::planar) place = place + value(form.left) * cross(unit_along<Number>(2), u);
    return place;
  }

  void hold(const mechanism::Limit& limit) {
    const auto point = [&](std::size_t i) { return at(limit.points.at(i)); };
    if (!limit.is_angle()) {
      const Number length2 = square_of(point(1) - point(0));
      if (limit.keeps_lower()) square(length2 - squared(value(limit.lower)));
      if (limit.keeps_upper()) square(squared(value(limit.upper)) - length2);
      return;
    }
    const Number cosine = dot(unit(point(0) - point(1)), unit(point(2) - point(1)));
    if (limit.keeps_lower()) square(values_.function(Expression::Kind::cos, limit.lower) - cosine);
    if (limit.keeps_upper()) square(cosine - values_.function(Expression::Kind::cos, limit.upper));
  }

  /// The bounds of an effort that follows a law.
  void hold(const mechanism::Joint& joint) {
    const Number effort = value(*joint.effort);
    square(effort - values_.number(joint.law_within->first));
    square(values_.number(joint.law_within->second) - effort);
  }

  void hold(const mechanism::Spring& spring);

  const Mechanism& m_;
  const std::vector<int>& sides_;
  Values<Number> values_;
  PostureOf<Number> result_;
  const std::vector<Vector>& groups_;
  std::size_t next_side_ = 0, next_of_groups_ = 0;
};

template <class Number>
void Placing<Number>::hold(const mechanism::Spring& spring) {
  if (spring.kind != mechanism::Spring::Kind::torsion) {
    const Number free = value(spring.free_length);
    if (spring.kind == mechanism::Spring::Kind::linear && free.is_zero()) return;
    divisor(square_of(at(spring.to_point) - at(spring.from_point)));
    return;
  }
  const auto [x, y] = off_rest(m_, values_, result_.points, spring);
  const Number size = root_of(divisor(squared(x) + squared(y)));
  square(x / size - values_.number(mechanism::least_torsion_cosine()));
}

}  // namespace

template <class Number>
PostureOf<Number> posture_over(const Mechanism& m, const std::vector<int>& sides, const VariablesOf<Number>& variables,
                               const std::vector<VectorOf<Number>>& groups) {
  return Placing<Number>(m, sides, variables, groups).run();
}

template <class Number>
PostureOf<Number> first_points_over(const Mechanism& m, std::size_t count, const std::vector<int>& sides,
                                    const VariablesOf<Number>& variables, const std::vector<VectorOf<Number>>& groups) {
  return Placing<Number>(m, sides, variables, groups).first(count);
}

template PosePosture posture_over(const Mechanism&, const std::vector<int>&, const PoseVariables&,
                                  const std::vector<VectorOf<Jet>>&);
template PosePosture first_points_over(const Mechanism&, std::size_t, const std::vector<int>&, const PoseVariables&,
                                       const std::vector<VectorOf<Jet>>&);
template PostureOf<Interval> posture_over(const Mechanism&, const std::vector<int>&, const VariablesOf<Interval>&,
                                          const std::vector<VectorOf<Interval>>&);

}  // namespace clearloci::check
