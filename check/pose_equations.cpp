#include "check/pose_equations.hpp"

#include <algorithm>
#include <set>

#include "core/errors.hpp"
#include "core/interpret.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::check {
namespace {

using core::Expression;
using core::Quantity;
using mechanism::Mechanism;
using Vector = std::array<Jet, 3>;

Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator*(const Jet& s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
Jet dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Jet square_of(const Vector& a) { return squared(a[0]) + squared(a[1]) + squared(a[2]); }

/// Expressions and vectors of the model over the cell (core/interpret.hpp).
class Values {
 public:
  Values(const Mechanism& m, const PoseVariables& variables) : m_(m), variables_(variables) {
    for (const mechanism::Parameter& own : m.parameters)
      if (varies(own.expression) && !is_variable(own.name)) dependent_.insert(own.name);
  }

  using Value = Jet;
  std::optional<Jet> known(const Expression& e) const {
    return varies(e) ? std::nullopt : std::optional(Jet(Interval(mechanism::value_of(e, m_), cell_bits)));
  }
  static Jet number(double value) { return Jet(Interval(value, cell_bits)); }
  static Jet number(const core::Rational& own) { return Jet(Interval(own, cell_bits)); }
  Jet symbol(const std::string& name) const {
    for (std::size_t v = 0; v < variables_.names.size(); ++v)
      if (variables_.names[v] == name) return variables_.values[v];
    const auto own = std::find_if(m_.parameters.begin(), m_.parameters.end(),
                                  [&](const mechanism::Parameter& parameter) { return parameter.name == name; });
    if (own == m_.parameters.end()) throw core::InputError({m_.file}, "a name that check does not know", "");
    return value(own->expression);
  }
  static Jet negate(const Jet& a) { return -a; }
  static Jet add(const Jet& a, const Jet& b) { return a + b; }
  static Jet multiply(const Jet& a, const Jet& b) { return a * b; }
  static Jet divide(const Jet& a, const Jet& b, const Expression&) { return a / b; }
  Jet power(const Jet& base, const Expression& e) const {
    const core::Rational exponent = mechanism::value_of(e.arguments()[1], m_);
    constexpr long most = 64;
    if (exponent.get_den() != 1 || abs(exponent) > most)
      throw core::InputError({m_.file}, "a power that check does not know", "");
    Jet result = number(1.0);
    const long times = exponent.get_num().get_si();
    for (long i = 0; i < std::abs(times); ++i) result = result * base;
    return times < 0 ? inverse(result) : result;
  }
  static Jet pi() {
    Interval own(cell_bits);
    mpfi_const_pi(own.get());
    return Jet(own);
  }
  static Jet sqrt(const Jet& a, const Expression&) { return root_of(a); }
  static Jet cos(const Jet& a, const Expression&) { return cosine_of(a); }
  static Jet sin(const Jet& a, const Expression&) { return sine_of(a); }
  static Jet atan(const Jet& a, const Expression&) { return angle_of(a, number(1.0)); }

  Jet value(const Expression& e) const { return core::interpret(e, *this); }

  Vector components(const std::vector<Expression>& numbers) const {
    Vector own;
    for (std::size_t c = 0; c < numbers.size(); ++c) own[c] = value(numbers[c]);
    return own;
  }

  Vector vector(const mechanism::VectorExpression& v, const std::vector<Vector>& points) const {
    using Kind = mechanism::VectorExpression::Kind;
    const auto argument = [&](std::size_t i) { return vector(v.arguments.at(i), points); };
    switch (v.kind) {
      case Kind::components:
        return components(v.numbers);
      case Kind::point:
        return points.at(static_cast<std::size_t>(v.point));
      case Kind::add:
        return argument(0) + argument(1);
      case Kind::negate:
        return number(-1.0) * argument(0);
      case Kind::scale:
        return value(v.numbers.at(0)) * argument(0);
      case Kind::cross:
        break;
    }
    return cross(argument(0), argument(1));
  }

 private:
  bool is_variable(const std::string& name) const {
    return std::find(variables_.names.begin(), variables_.names.end(), name) != variables_.names.end();
  }
  /// Parameters stand behind those that they are made of.
  bool varies(const Expression& e) const {
    const std::set<std::string> names = core::symbols(e);
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return is_variable(name) || dependent_.contains(name); });
  }

  const Mechanism& m_;
  const PoseVariables& variables_;
  std::set<std::string> dependent_;
};

Vector unit_along(std::size_t c) {
  Vector own;
  own[c] = Values::number(1.0);
  return own;
}

/// Places the points one by one.
class Placing {
 public:
  Placing(const Mechanism& m, const std::vector<int>& sides, const PoseVariables& variables)
      : m_(m), sides_(sides), values_(m, variables) {}

  PosePosture run() {
    for (const mechanism::Point& point : m_.points) {
      if (!result_.is_proven) break;
      result_.points.push_back(std::visit([&](const auto& form) { return place(form); }, point.form));
    }
    for (const mechanism::Limit& limit : m_.limits)
      if (result_.is_proven) hold(limit);
    for (const mechanism::Spring& spring : m_.springs)
      if (result_.is_proven) hold(spring);
    return std::move(result_);
  }

 private:
  const Vector& at(mechanism::PointIndex point) const { return result_.points.at(static_cast<std::size_t>(point)); }
  Jet value(const Expression& e) const { return values_.value(e); }

  /// It has to be above zero.
  Jet positive(const Jet& own) {
    if (result_.is_proven) result_.positive.push_back(own);
    result_.is_proven = result_.is_proven && own.sign() > 0;
    return own;
  }
  Vector unit(const Vector& v) { return inverse(root_of(positive(square_of(v)))) * v; }
  Jet branch(const Jet& square) {
    const Jet root = root_of(positive(square));
    return sides_.at(next_side_++) > 0 ? root : -root;
  }

  Vector place(const mechanism::ExplicitPoint& form) const { return values_.components(form.coordinates); }
  Vector place(const mechanism::MeanPoint& form) const {
    return Values::number(0.5) * (at(form.first) + at(form.second));
  }
  Vector place(const mechanism::ShiftedPoint& form) const {
    return at(form.from) + values_.vector(form.by, result_.points);
  }
  Vector place(const mechanism::GroupPoint&) const {
    throw core::InputError({m_.file}, "a certificate is of points with closed forms, and some of these close together",
                           "");
  }

  Vector place(const mechanism::DyadPoint& form) {
    const Vector way = at(form.to) - at(form.from);
    const Vector n = form.axis ? unit(values_.vector(*form.axis, result_.points)) : unit_along(2);
    const Jet h = dot(n, way);
    const Vector r = way - h * n;
    const Jet d = positive(square_of(r));
    const Jet a2 = squared(value(form.from_length));
    const Jet seen2 = form.right_angle ? d - a2 : squared(value(form.to_length)) - squared(h);
    const Jet k = a2 - seen2 + d;
    const Jet s = branch(Values::number(4.0) * a2 * d - squared(k));
    const Jet half = Values::number(0.5) * inverse(d);
    return at(form.from) + (k * half) * r + (s * half) * cross(n, r);
  }

  Vector place(const mechanism::SliderPoint& form) {
    const Vector u = unit(values_.vector(form.along, result_.points)), r = at(form.from) - at(form.base);
    const Jet s = branch(squared(value(form.length)) - square_of(cross(u, r)));
    return at(form.base) + (dot(u, r) + s) * u;
  }

  Vector place(const mechanism::CrossingPoint& form) {
    const Vector u = values_.vector(form.along_first, result_.points);
    const Vector v = values_.vector(form.along_second, result_.points);
    const Jet turn = cross(u, v)[2];
    positive(squared(turn));
    return at(form.first) + (cross(at(form.second) - at(form.first), v)[2] / turn) * u;
  }

  Vector place(const mechanism::OffsetPoint& form) {
    const Vector u = unit(at(form.second) - at(form.first));
    Vector place = at(form.first) + value(form.along) * u;
    if (m_.space == mechanism::Space::planar) place = place + value(form.left) * cross(unit_along(2), u);
    return place;
  }

  void hold(const mechanism::Limit& limit) {
    const auto own = [&](std::size_t i) { return at(limit.points.at(i)); };
    if (!limit.is_angle()) {
      const Jet square = square_of(own(1) - own(0));
      if (limit.keeps_lower()) positive(square - squared(value(limit.lower)));
      positive(squared(value(limit.upper)) - square);
      return;
    }
    const Jet cosine = dot(unit(own(0) - own(1)), unit(own(2) - own(1)));
    if (limit.keeps_lower()) positive(cosine_of(value(limit.lower)) - cosine);
    if (limit.keeps_upper()) positive(cosine - cosine_of(value(limit.upper)));
  }

  void hold(const mechanism::Spring& spring);

  const Mechanism& m_;
  const std::vector<int>& sides_;
  Values values_;
  PosePosture result_;
  std::size_t next_side_ = 0;
};

/// The joint's axis, of length one; in the plane that of a joint that turns is z.
Vector axis_of(const Mechanism& m, const Values& values, const std::vector<Vector>& points,
               const mechanism::Joint& joint) {
  if (joint.axes.empty()) return unit_along(m.space == mechanism::Space::planar ? 2 : 0);
  const Vector v = values.vector(joint.axes.front(), points);
  return inverse(root_of(square_of(v))) * v;
}

/// A way (x, y) at angle - rest of a torsion spring.
std::array<Jet, 2> off_rest(const Mechanism& m, const Values& values, const std::vector<Vector>& points,
                            const mechanism::Spring& spring) {
  const auto direction = [&](mechanism::LinkIndex link) {
    if (link == mechanism::ground) return unit_along(0);
    const auto& own = m.links.at(static_cast<std::size_t>(link)).points;
    return points.at(static_cast<std::size_t>(own.at(1))) - points.at(static_cast<std::size_t>(own.at(0)));
  };
  const Vector u = axis_of(m, values, points, m.joints.at(static_cast<std::size_t>(spring.joint)));
  const Vector a = direction(spring.from), b = direction(spring.to);
  const Jet sine = dot(u, cross(a, b)), cosine = dot(a, b) - dot(u, a) * dot(u, b);
  const Jet rest = values.value(spring.rest), c = cosine_of(rest), s = sine_of(rest);
  return {c * cosine + s * sine, c * sine - s * cosine};
}

void Placing::hold(const mechanism::Spring& spring) {
  if (spring.kind != mechanism::Spring::Kind::torsion) {
    const Jet free = value(spring.free_length);
    if (spring.kind == mechanism::Spring::Kind::linear && free.is_zero()) return;
    positive(square_of(at(spring.to_point) - at(spring.from_point)));
    return;
  }
  const auto [x, y] = off_rest(m_, values_, result_.points, spring);
  const Jet size = root_of(positive(squared(x) + squared(y)));
  positive(x / size - Values::number(mechanism::least_torsion_cosine()));
}

using Wrench = std::array<Jet, 6>;

class Assembly {
 public:
  Assembly(const Mechanism& m, const PosePosture& posture, const PoseVariables& variables)
      : m_(m), points_(posture.points), values_(m, variables) {
    rows_of_wrench_ = is_planar() ? std::vector<std::size_t>{0, 1, 5} : std::vector<std::size_t>{0, 1, 2, 3, 4, 5};
    result_.right.resize(rows_of_wrench_.size() * m.links.size());
    for (const mechanism::Joint& joint : m.joints) add_joint(joint);
    core::ensure(result_.right.size() == result_.unknowns, "the equations are square");
    add_loads();
  }

  PoseEquations run(const std::vector<core::TaskDemand>& demands) {
    for (const core::TaskDemand& demand : demands) add_demand(demand);
    return std::move(result_);
  }

 private:
  /// Columns of one joint; of a force or couple that may have any direction three, along x, y, z.
  struct Columns {
    std::vector<std::size_t> force, couple;
    std::optional<std::size_t> normal, along;  ///< of a planar guide
    Vector axis;
  };

  bool is_planar() const { return m_.space == mechanism::Space::planar; }
  Vector arm(mechanism::PointIndex point) const {
    return points_.at(static_cast<std::size_t>(point)) - points_.at(static_cast<std::size_t>(m_.end_effector_point));
  }
  Wrench force_at(mechanism::PointIndex point, const Vector& force) const {
    const Vector moment = cross(arm(point), force);
    return {force[0], force[1], force[2], moment[0], moment[1], moment[2]};
  }
  static Wrench couple(const Vector& own) { return {Jet(), Jet(), Jet(), own[0], own[1], own[2]}; }

  void each_row(mechanism::LinkIndex link, const Wrench& wrench, const auto& visit) const {
    if (link == mechanism::ground) return;
    for (std::size_t i = 0; i < rows_of_wrench_.size(); ++i)
      if (const Jet& own = wrench[rows_of_wrench_[i]]; !own.is_zero())
        visit(rows_of_wrench_.size() * static_cast<std::size_t>(link) + i, own);
  }

  std::size_t add_unknown(const mechanism::Joint& joint, const Wrench& wrench) {
    const std::size_t unknown = result_.unknowns++;
    each_row(joint.to, wrench, [&](std::size_t row, const Jet& own) { result_.matrix.push_back({row, unknown, own}); });
    each_row(joint.from, wrench, [&](std::size_t row, const Jet& own) {
      result_.matrix.push_back({row, unknown, -own});
    });
    return unknown;
  }

  /// u . (three unknowns) = 0.
  void add_side_equation(const Vector& u, const std::vector<std::size_t>& unknowns) {
    for (std::size_t c = 0; c < 3; ++c)
      if (!u[c].is_zero()) result_.matrix.push_back({result_.right.size(), unknowns[c], u[c]});
    result_.right.emplace_back();
  }

  std::vector<std::size_t> add_forces(const mechanism::Joint& joint, std::size_t count) {
    std::vector<std::size_t> own;
    for (std::size_t c = 0; c < count; ++c) own.push_back(add_unknown(joint, force_at(joint.at, unit_along(c))));
    return own;
  }

  void add_joint(const mechanism::Joint& joint) {
    using mechanism::BorneCouple;
    const mechanism::JointTraits& traits = mechanism::traits(joint);
    Columns own;
    own.axis = axis_of(m_, values_, points_, joint);
    if (is_planar() && traits.slides) {
      own.normal = add_unknown(joint, force_at(joint.at, cross(unit_along(2), own.axis)));
      if (!traits.pinned) own.couple = {add_unknown(joint, couple(unit_along(2)))};
      if (joint.actuated) own.along = add_unknown(joint, force_at(joint.at, own.axis));
    } else if (traits.meshes && joint.axes.empty()) {
      own.couple = {add_unknown(joint, couple(unit_along(2)))};
    } else if (traits.meshes) {
      own.along = add_unknown(joint, force_at(joint.at, own.axis));
    } else if (is_planar()) {
      own.force = add_forces(joint, 2);
      if (joint.actuated) own.couple = {add_unknown(joint, couple(unit_along(2)))};
    } else {
      own.force = add_forces(joint, 3);
      if (traits.slides && !joint.actuated) add_side_equation(own.axis, own.force);
      if (traits.couple == BorneCouple::cross) {
        add_unknown(joint, couple(across_both(joint, own.axis)));
      } else if (traits.couple != BorneCouple::none) {
        for (std::size_t c = 0; c < 3; ++c) own.couple.push_back(add_unknown(joint, couple(unit_along(c))));
        if (traits.turns_about_axis() && (traits.slides || !joint.actuated)) add_side_equation(own.axis, own.couple);
      }
    }
    columns_.push_back(std::move(own));
  }

  /// About what a universal joint bears its couple.
  Vector across_both(const mechanism::Joint& joint, const Vector& axis) const {
    if (mechanism::holds_idle_freedom(joint)) return axis;
    const Vector v = cross(axis, values_.vector(joint.axes.at(1), points_));
    return inverse(root_of(square_of(v))) * v;
  }

  void load(mechanism::LinkIndex link, const Wrench& wrench, int sign = 1) {
    each_row(link, wrench, [&](std::size_t row, const Jet& own) {
      result_.right[row] = sign > 0 ? result_.right[row] - own : result_.right[row] + own;
    });
  }

  void add_loads() {
    for (const mechanism::Load& own : m_.loads) {
      Vector c = values_.components(own.couple_vector);
      if (is_planar()) c[2] = values_.value(own.couple);
      load(own.link, couple(c));
      if (own.force_vector)
        load(own.link, force_at(*own.at, values_.vector(*own.force_vector, points_)));
      else if (!own.force.empty())
        load(own.link, force_at(*own.at, values_.components(own.force)));
    }
    for (const mechanism::Spring& spring : m_.springs) add_spring(spring);
    for (const mechanism::Joint& joint : m_.joints)
      if (joint.effort) add_effort(joint);
    if (m_.gravity.empty()) return;
    const Vector g = values_.components(m_.gravity);
    for (std::size_t i = 0; i < m_.links.size(); ++i) {
      const mechanism::Link& link = m_.links[i];
      const auto index = static_cast<mechanism::LinkIndex>(i);
      load(index, force_at(link.centre_of_mass, values_.value(link.mass) * g));
      for (const mechanism::PointMass& point : link.masses)
        load(index, force_at(point.at, values_.value(point.mass) * g));
    }
  }

  /// k v - k l0 v / |v| on the first end, v the way to the second one; F v / |v| of a constant force.
  void add_spring(const mechanism::Spring& spring) {
    if (spring.kind == mechanism::Spring::Kind::torsion) {
      const auto [x, y] = off_rest(m_, values_, points_, spring);
      const Vector u = axis_of(m_, values_, points_, m_.joints.at(static_cast<std::size_t>(spring.joint)));
      const Wrench back = couple((values_.value(spring.stiffness) * angle_of(y, x)) * u);
      load(spring.to, back, -1);
      return load(spring.from, back);
    }
    const Vector v = arm(spring.to_point) - arm(spring.from_point);
    const Jet k = values_.value(spring.stiffness), l0 = values_.value(spring.free_length);
    Jet per_length = k;
    if (spring.kind != mechanism::Spring::Kind::linear)
      per_length = values_.value(spring.force) * inverse(root_of(square_of(v)));
    else if (!l0.is_zero())
      per_length = k - k * l0 * inverse(root_of(square_of(v)));
    load(spring.from, force_at(spring.from_point, per_length * v));
    load(spring.to, force_at(spring.to_point, per_length * v), -1);
  }

  void add_effort(const mechanism::Joint& joint) {
    const Vector along = values_.value(*joint.effort) * axis_of(m_, values_, points_, joint);
    const Wrench own = mechanism::traits(joint).slides ? force_at(joint.at, along) : couple(along);
    load(joint.to, own);
    load(joint.from, own, -1);
  }

  void add_demand(const core::TaskDemand& demand) {
    const auto found = std::find_if(m_.joints.begin(), m_.joints.end(),
                                    [&](const mechanism::Joint& joint) { return joint.name == demand.joint; });
    const auto refuse = [&]() -> core::InputError {
      return {
          {m_.file}, core::to_string(demand.quantity) + "_" + demand.joint + " is borne by no joint of the model", ""};
    };
    if (found == m_.joints.end()) throw refuse();
    const Columns& own = columns_[static_cast<std::size_t>(found - m_.joints.begin())];
    std::vector<PoseEntry> entries;
    const auto add = [&](std::size_t row, std::size_t unknown, const Jet& value) {
      if (!value.is_zero()) entries.push_back({row, unknown, value});
    };
    const auto along_axis = [&](const std::vector<std::size_t>& unknowns) {
      for (std::size_t c = 0; c < 3; ++c) add(0, unknowns[c], own.axis[c]);
    };
    const auto whole = [&](const std::vector<std::size_t>& unknowns) {
      for (std::size_t c = 0; c < unknowns.size(); ++c) add(c, unknowns[c], Values::number(1.0));
    };
    if (is_guide_end(demand.quantity) && mechanism::has_guide_ends(m_, *found)) {
      const Jet half = Values::number(0.5);
      const Jet tilt = half / values_.value(found->clearance->half_length);
      add(0, *own.normal, half);
      add(0, own.couple.front(), demand.quantity == Quantity::end_ahead ? tilt : -tilt);
    } else if (demand.quantity == Quantity::F && found->actuated &&
               mechanism::actuator_quantity(*found) == Quantity::F) {
      if (own.along)
        add(0, *own.along, Values::number(1.0));
      else
        along_axis(own.force);
    } else if (demand.quantity == Quantity::M && found->actuated && !own.couple.empty() && !own.normal) {
      if (is_planar())
        add(0, own.couple.front(), Values::number(1.0));
      else
        along_axis(own.couple);
    } else if (demand.quantity == Quantity::f && own.normal) {
      add(0, *own.normal, Values::number(1.0));
      if (!own.couple.empty()) add(1, own.couple.front(), Values::number(1.0));
    } else if (demand.quantity == Quantity::f && mechanism::presses_across_axis(m_, *found)) {
      // u x f is as large as the part of f across u.
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        add(i, own.force[k], own.axis[j]);
        add(i, own.force[j], -own.axis[k]);
      }
    } else if (demand.quantity == Quantity::f && mechanism::traits(*found).pinned) {
      whole(own.force);
    } else {
      throw refuse();
    }
    result_.demands.push_back(std::move(entries));
  }

  const Mechanism& m_;
  const std::vector<Vector>& points_;
  Values values_;
  std::vector<std::size_t> rows_of_wrench_;
  std::vector<Columns> columns_;
  PoseEquations result_;
};

}  // namespace

PosePosture posture_over(const Mechanism& m, const std::vector<int>& sides, const PoseVariables& variables) {
  return Placing(m, sides, variables).run();
}

PoseEquations equations_over(const Mechanism& m, const PosePosture& posture, const PoseVariables& variables,
                             const std::vector<core::TaskDemand>& demands) {
  return Assembly(m, posture, variables).run(demands);
}

}  // namespace clearloci::check
