#include "check/pose_equations.hpp"

#include <algorithm>

#include "check/pose_values.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::check {
namespace {

using core::Quantity;

template <class Number>
class Assembly {
 public:
  using Vector = VectorOf<Number>;
  using Wrench = std::array<Number, 6>;

  Assembly(const Mechanism& m, const PostureOf<Number>& posture, const VariablesOf<Number>& variables)
      : m_(m), points_(posture.points), values_(m, variables) {
    rows_of_wrench_ = is_planar() ? std::vector<std::size_t>{0, 1, 5} : std::vector<std::size_t>{0, 1, 2, 3, 4, 5};
    result_.right.resize(rows_of_wrench_.size() * m.links.size());
    for (const mechanism::Joint& joint : m.joints) add_joint(joint);
    for (std::size_t j = 0; j < m.joints.size(); ++j)
      if (m.joints[j].actuated && (is_planar() || mechanism::is_cable(m.joints[j])))
        add_actuator(m.joints[j], columns_[j]);
    core::ensure(result_.right.size() == result_.unknowns, "the equations are square");
    add_loads();
  }

  EquationsOf<Number> run(const std::vector<core::TaskDemand>& demands) {
    for (const core::TaskDemand& demand : demands) result_.demands.push_back(entries_of(demand.joint, demand.quantity));
    for (const mechanism::Joint& joint : m_.joints) add_bounds(joint);
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
  static Wrench couple(const Vector& vector) { return {Number(), Number(), Number(), vector[0], vector[1], vector[2]}; }

  void each_row(mechanism::LinkIndex link, const Wrench& wrench, const auto& visit) const {
    if (link == mechanism::ground) return;
    for (std::size_t i = 0; i < rows_of_wrench_.size(); ++i)
      if (const Number& number = wrench[rows_of_wrench_[i]]; !number.is_zero())
        visit(rows_of_wrench_.size() * static_cast<std::size_t>(link) + i, number);
  }

  std::size_t add_unknown(const mechanism::Joint& joint, const Wrench& wrench) {
    const std::size_t unknown = result_.unknowns++;
    each_row(joint.to, wrench, [&](std::size_t row, const Number& number) {
      result_.matrix.push_back({row, unknown, number});
    });
    each_row(joint.from, wrench, [&](std::size_t row, const Number& number) {
      result_.matrix.push_back({row, unknown, -number});
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
    std::vector<std::size_t> unknowns;
    for (std::size_t c = 0; c < count; ++c)
      unknowns.push_back(add_unknown(joint, force_at(joint.at, unit_along<Number>(c))));
    return unknowns;
  }

  void add_joint(const mechanism::Joint& joint) {
    using mechanism::BorneCouple;
    const mechanism::JointTraits& traits = mechanism::traits(joint);
    Columns columns;
    columns.axis = axis_of(m_, values_, points_, joint);
    if (mechanism::is_cable(joint)) {
      if (joint.holds_turning)
        for (std::size_t c = is_planar() ? 2 : 0; c < 3; ++c)
          columns.couple.push_back(add_unknown(joint, couple(unit_along<Number>(c))));
    } else if (traits.meshes) {
      // Nothing but what its actuator exerts.
    } else if (is_planar() && traits.slides) {
      columns.normal = add_unknown(joint, force_at(joint.at, cross(unit_along<Number>(2), columns.axis)));
      if (!traits.pinned) columns.couple = {add_unknown(joint, couple(unit_along<Number>(2)))};
    } else if (is_planar()) {
      columns.force = add_forces(joint, 2);
    } else {
      columns.force = add_forces(joint, 3);
      if (traits.slides && !joint.actuated) add_side_equation(columns.axis, columns.force);
      if (traits.couple == BorneCouple::cross) {
        add_unknown(joint, couple(across_both(joint, columns.axis)));
      } else if (traits.couple != BorneCouple::none) {
        for (std::size_t c = 0; c < 3; ++c) columns.couple.push_back(add_unknown(joint, couple(unit_along<Number>(c))));
        if (traits.turns_about_axis() && (traits.slides || !joint.actuated))
          add_side_equation(columns.axis, columns.couple);
      }
    }
    columns_.push_back(std::move(columns));
  }

  void add_actuator(const mechanism::Joint& joint, Columns& columns) {
    if (mechanism::actuator_quantity(joint) == Quantity::F)
      columns.along = add_unknown(joint, force_at(joint.at, columns.axis));
    else
      columns.couple = {add_unknown(joint, couple(unit_along<Number>(2)))};
  }

  /// About what a universal joint bears its couple.
  Vector across_both(const mechanism::Joint& joint, const Vector& axis) const {
    if (mechanism::holds_idle_freedom(joint)) return axis;
    const Vector v = cross(axis, values_.vector(joint.axes.at(1), points_));
    return inverse(root_of(square_of(v))) * v;
  }

  void load(mechanism::LinkIndex link, const Wrench& wrench, int sign = 1) {
    each_row(link, wrench, [&](std::size_t row, const Number& number) {
      result_.right[row] = sign > 0 ? result_.right[row] - number : result_.right[row] + number;
    });
  }

  void add_loads() {
    for (const mechanism::Load& entry : m_.loads) {
      Vector c = values_.components(entry.couple_vector);
      if (is_planar()) c[2] = values_.value(entry.couple);
      load(entry.link, couple(c));
      if (entry.force_vector)
        load(entry.link, force_at(*entry.at, values_.vector(*entry.force_vector, points_)));
      else if (!entry.force.empty())
        load(entry.link, force_at(*entry.at, values_.components(entry.force)));
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
    const Number k = values_.value(spring.stiffness), l0 = values_.value(spring.free_length);
    Number per_length = k;
    if (spring.kind != mechanism::Spring::Kind::linear)
      per_length = values_.value(spring.force) * inverse(root_of(square_of(v)));
    else if (!l0.is_zero())
      per_length = k - k * l0 * inverse(root_of(square_of(v)));
    load(spring.from, force_at(spring.from_point, per_length * v));
    load(spring.to, force_at(spring.to_point, per_length * v), -1);
  }

  void add_effort(const mechanism::Joint& joint) {
    const Vector along = values_.value(*joint.effort) * axis_of(m_, values_, points_, joint);
    const Wrench wrench = mechanism::traits(joint).slides ? force_at(joint.at, along) : couple(along);
    load(joint.to, wrench);
    load(joint.from, wrench, -1);
  }

  std::vector<EntryOf<Number>> entries_of(const std::string& joint, Quantity quantity) {
    const auto found = std::find_if(m_.joints.begin(), m_.joints.end(),
                                    [&](const mechanism::Joint& other) { return other.name == joint; });
    const auto refuse = [&]() -> core::InputError {
      return {{m_.file}, core::to_string(quantity) + "_" + joint + " is borne by no joint of the model", ""};
    };
    if (found == m_.joints.end()) throw refuse();
    const Columns& columns = columns_[static_cast<std::size_t>(found - m_.joints.begin())];
    std::vector<EntryOf<Number>> entries;
    const auto add = [&](std::size_t row, std::size_t unknown, const Number& value) {
      if (!value.is_zero()) entries.push_back({row, unknown, value});
    };
    const auto along_axis = [&](const std::vector<std::size_t>& unknowns) {
      for (std::size_t c = 0; c < 3; ++c) add(0, unknowns[c], columns.axis[c]);
    };
    const auto whole = [&](const std::vector<std::size_t>& unknowns) {
      for (std::size_t c = 0; c < unknowns.size(); ++c) add(c, unknowns[c], Values<Number>::number(1.0));
    };
    if (is_guide_end(quantity) && mechanism::has_guide_ends(m_, *found)) {
      const Number half = Values<Number>::number(0.5);
      const Number tilt = half / values_.value(found->clearance->half_length);
      add(0, *columns.normal, half);
      add(0, columns.couple.front(), quantity == Quantity::end_ahead ? tilt : -tilt);
    } else if (quantity == Quantity::F && found->actuated && mechanism::actuator_quantity(*found) == Quantity::F) {
      if (columns.along)
        add(0, *columns.along, Values<Number>::number(1.0));
      else
        along_axis(columns.force);
    } else if (quantity == Quantity::M && found->actuated && !columns.couple.empty() && !columns.normal) {
      if (is_planar())
        add(0, columns.couple.front(), Values<Number>::number(1.0));
      else
        along_axis(columns.couple);
    } else if (quantity == Quantity::f && columns.normal) {
      add(0, *columns.normal, Values<Number>::number(1.0));
      if (!columns.couple.empty()) add(1, columns.couple.front(), Values<Number>::number(1.0));
    } else if (quantity == Quantity::f && mechanism::presses_across_axis(m_, *found)) {
      // u x f is as large as the part of f across u.
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        add(i, columns.force[k], columns.axis[j]);
        add(i, columns.force[j], -columns.axis[k]);
      }
    } else if (quantity == Quantity::f && mechanism::traits(*found).pinned) {
      whole(columns.force);
    } else {
      throw refuse();
    }
    return entries;
  }

  /// constant + sign w > 0.
  void add_positive(const mechanism::Joint& joint, const Number& constant, bool negative) {
    std::vector<EntryOf<Number>> entries = entries_of(joint.name, mechanism::actuator_quantity(joint));
    for (EntryOf<Number>& entry : entries)
      if (negative) entry.value = -entry.value;
    result_.positive.push_back({std::move(entries), constant});
  }

  void add_bounds(const mechanism::Joint& joint) {
    if (joint.meshing && joint.meshing->flank) add_positive(joint, Number(), false);
    if (joint.meshing && !joint.meshing->flank) {
      const Number most = values_.value(joint.meshing->most);
      add_positive(joint, most, false);
      add_positive(joint, most, true);
    }
    if (!joint.actuated || !joint.within) return;
    add_positive(joint, -values_.number(joint.within->first), false);
    add_positive(joint, values_.number(joint.within->second), true);
  }

  const Mechanism& m_;
  const std::vector<Vector>& points_;
  Values<Number> values_;
  std::vector<std::size_t> rows_of_wrench_;
  std::vector<Columns> columns_;
  EquationsOf<Number> result_;
};

}  // namespace

template <class Number>
EquationsOf<Number> equations_over(const Mechanism& m, const PostureOf<Number>& posture,
                                   const VariablesOf<Number>& variables, const std::vector<core::TaskDemand>& demands) {
  return Assembly<Number>(m, posture, variables).run(demands);
}

template PoseEquations equations_over(const Mechanism&, const PosePosture&, const PoseVariables&,
                                      const std::vector<core::TaskDemand>&);
template EquationsOf<Interval> equations_over(const Mechanism&, const PostureOf<Interval>&,
                                              const VariablesOf<Interval>&, const std::vector<core::TaskDemand>&);

}  // namespace clearloci::check
