#include "symbolic/pose_statics.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/idle_limits.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/known_lines.hpp"
#include "mechanism/pose_steps.hpp"
#include "symbolic/linear_elimination.hpp"

namespace clearloci::symbolic {
namespace {

using core::Quantity;
using core::Rational;
using mechanism::LinkIndex;
using mechanism::Mechanism;
using mechanism::PosePoints;
using mechanism::PoseSteps;
using Vector = PosePoints::Vector;
/// Force, then moment about the end-effector point.
using Wrench = std::array<int, 6>;

/// Fill that a pivot may make: a leg's forces go, its closing equations stay.
constexpr std::size_t most_fill = 40;

class StaticsBuilder {
 public:
  StaticsBuilder(const std::vector<const Mechanism*>& loads, const std::vector<int>& sides, ForceParts parts)
      : loads_(loads),
        m_(*loads.front()),
        parts_(parts),
        points_(m_, sides, PoseSteps(m_)),
        b_(points_.algebra().builder()) {
    if (m_.space == mechanism::Space::planar)
      components_ = {0, 1, 5};
    else
      components_ = {0, 1, 2, 3, 4, 5};
    rows_.resize(m_.links.size() * components_.size());
    for (SymbolicRow& row : rows_) row.free.assign(loads_.size(), b_.zero());
    for (const mechanism::Joint& joint : m_.joints) add_joint(joint);
    for (std::size_t i = 0; i < loads_.size(); ++i) add_loads(*loads_[i], i);
    core::ensure(rows_.size() == static_cast<std::size_t>(unknowns_), "the equations are square");
  }

  core::PoseStatics build(const std::vector<core::TaskDemand>& demands) {
    LinearElimination elimination(b_, unknowns_, rows_);
    elimination.reduce(most_fill);
    const std::vector<int> places = elimination.places();
    core::PoseStatics result;
    for (const mechanism::Coordinate& coordinate : m_.coordinates) result.coordinates.push_back(coordinate.name);
    result.loads = loads_.size();
    for (const SymbolicRow& row : elimination.equations()) result.equations.push_back(placed(row, places));
    result.unknowns = static_cast<int>(result.equations.size());
    for (const core::TaskDemand& demand : demands) {
      core::PoseDemand pose_demand{demand, {}};
      for (const SymbolicRow& row : components(demand))
        pose_demand.components.push_back(placed(elimination.substituted(row), places));
      result.demands.push_back(std::move(pose_demand));
    }
    const std::vector<bool> idle = mechanism::idle_limits(m_);
    for (std::size_t i = 0; i < idle.size(); ++i)
      if (!idle[i]) add_limit(m_.limits[i], result.positive);
    for (const mechanism::JointIndex joint : mechanism::bounded_laws(m_)) add_law(joint, result.positive);
    for (const mechanism::Spring& spring : m_.springs)
      if (spring.kind == mechanism::Spring::Kind::torsion) add_reach(spring, result.positive);
    std::vector<int*> steps;
    const auto keep = [&](core::LinearRow& row) {
      for (core::LinearRow::Term& term : row.terms) steps.push_back(&term.step);
      for (int& step : row.free) steps.push_back(&step);
    };
    for (core::LinearRow& row : result.equations) keep(row);
    for (core::PoseDemand& demand : result.demands)
      for (core::LinearRow& row : demand.components) keep(row);
    for (int& step : result.positive) steps.push_back(&step);
    // Every point has to be placed, whether a reaction asks for it or not.
    std::vector<int> places_of_points;
    for (std::size_t i = 0; i < m_.points.size(); ++i)
      for (const int step : points_.point(static_cast<int>(i))) places_of_points.push_back(step);
    for (int& step : places_of_points) steps.push_back(&step);
    result.program = mechanism::program_of(m_, b_, steps);
    return result;
  }

 private:
  struct JointUnknowns {
    std::vector<int> force, couple;  ///< Cartesian; of the plane fx, fy and the couple about z
    Vector axis{};                   ///< of length one
    int normal = -1;                 ///< of a guide or a slot in the plane
    int along = -1;                  ///< of a planar guide: its actuator; of a gear, of a cable
    int across = -1;                 ///< of a universal joint
  };

  static core::LinearRow placed(const SymbolicRow& row, const std::vector<int>& places) {
    core::LinearRow linear_row{{}, row.free};
    for (const auto& [unknown, step] : row.entries)
      linear_row.terms.push_back({places[static_cast<std::size_t>(unknown)], step});
    return linear_row;
  }

  Vector arm(mechanism::PointIndex point) {
    return points_.minus(points_.point(point), points_.point(m_.end_effector_point));
  }
  Wrench force_at(const Vector& r, const Vector& f) {
    const Vector moment = points_.cross(r, f);
    return {f[0], f[1], f[2], moment[0], moment[1], moment[2]};
  }
  Wrench couple(const Vector& c) const { return {b_.zero(), b_.zero(), b_.zero(), c[0], c[1], c[2]}; }
  Vector direction(std::size_t i) const {
    Vector e = {b_.zero(), b_.zero(), b_.zero()};
    e[i] = b_.one();
    return e;
  }

  SymbolicRow& row_of(LinkIndex link, std::size_t component) {
    return rows_[static_cast<std::size_t>(link) * components_.size() + component];
  }

  int add_unknown(const mechanism::Joint& joint, const Wrench& wrench) {
    const int unknown = unknowns_++;
    const auto add = [&](LinkIndex link, bool negative) {
      if (link == mechanism::ground) return;
      for (std::size_t c = 0; c < components_.size(); ++c) {
        const int component = wrench[components_[c]], value = negative ? b_.negate(component) : component;
        auto& entries = row_of(link, c).entries;
        const auto [place, fresh] = entries.try_emplace(unknown, b_.zero());
        place->second = b_.add(place->second, value);
        if (place->second == b_.zero()) entries.erase(place);
      }
    };
    add(joint.to, false);
    add(joint.from, true);
    return unknown;
  }

  /// u . (three unknowns) = 0.
  void add_side_equation(const Vector& u, const std::vector<int>& unknowns) {
    SymbolicRow row;
    row.free.assign(loads_.size(), b_.zero());
    for (std::size_t c = 0; c < 3; ++c)
      if (u[c] != b_.zero()) row.entries[unknowns[c]] = u[c];
    side_rows_.push_back(std::move(row));
  }

  void add_joint(const mechanism::Joint& joint) {
    const mechanism::JointTraits& traits = mechanism::traits(joint);
    const Vector r = arm(joint.at);
    JointUnknowns unknowns;
    const bool planar = m_.space == mechanism::Space::planar;
    if (!joint.axes.empty()) unknowns.axis = points_.unit(points_.vector(joint.axes.front()));
    if (mechanism::is_cable(joint)) {
      for (std::size_t c = planar ? 2 : 0; c < 3 && joint.holds_turning; ++c) add_unknown(joint, couple(direction(c)));
      if (joint.actuated) unknowns.along = add_unknown(joint, force_at(r, unknowns.axis));
    } else if (planar && traits.slides) {
      const Vector& u = unknowns.axis;
      unknowns.normal = add_unknown(joint, force_at(r, {b_.negate(u[1]), u[0], b_.zero()}));
      if (mechanism::is_guide(m_, joint)) unknowns.couple = {add_unknown(joint, couple(direction(2)))};
      if (joint.actuated) unknowns.along = add_unknown(joint, force_at(r, u));
    } else if (traits.meshes && joint.axes.empty()) {
      unknowns.couple = {add_unknown(joint, couple(direction(2)))};
    } else if (traits.meshes) {
      unknowns.along = add_unknown(joint, force_at(r, unknowns.axis));
    } else if (planar) {
      for (std::size_t c = 0; c < 2; ++c) unknowns.force.push_back(add_unknown(joint, force_at(r, direction(c))));
      if (joint.actuated) unknowns.couple = {add_unknown(joint, couple(direction(2)))};
    } else {
      add_spatial(joint, traits, r, unknowns);
    }
    joints_.push_back(std::move(unknowns));
    for (SymbolicRow& row : side_rows_) rows_.push_back(std::move(row));
    side_rows_.clear();
  }

  void add_spatial(const mechanism::Joint& joint, const mechanism::JointTraits& traits, const Vector& r,
                   JointUnknowns& unknowns) {
    using mechanism::BorneCouple;
    for (std::size_t c = 0; c < 3; ++c) unknowns.force.push_back(add_unknown(joint, force_at(r, direction(c))));
    if (traits.slides && !joint.actuated) add_side_equation(unknowns.axis, unknowns.force);
    if (traits.couple == BorneCouple::none) return;
    if (traits.couple == BorneCouple::cross) {
      const Vector along = mechanism::holds_idle_freedom(joint)
                               ? unknowns.axis
                               : points_.unit(points_.cross(unknowns.axis, points_.vector(joint.axes.at(1))));
      unknowns.across = add_unknown(joint, couple(along));
      return;
    }
    for (std::size_t c = 0; c < 3; ++c) unknowns.couple.push_back(add_unknown(joint, couple(direction(c))));
    if (traits.turns_about_axis() && (traits.slides || !joint.actuated))
      add_side_equation(unknowns.axis, unknowns.couple);
  }

  void add_load(LinkIndex link, const Wrench& wrench, std::size_t load, bool opposite = false) {
    if (link == mechanism::ground) return;
    for (std::size_t c = 0; c < components_.size(); ++c) {
      int& free = row_of(link, c).free[load];  // A w = -w_e
      free = opposite ? b_.add(free, wrench[components_[c]]) : b_.subtract(free, wrench[components_[c]]);
    }
  }

  void add_loads(const Mechanism& loaded, std::size_t i) {
    for (const mechanism::Load& load : loaded.loads) {
      Vector c = points_.components(load.couple_vector);
      if (m_.space == mechanism::Space::planar) c[2] = points_.expression(load.couple);
      add_load(load.link, couple(c), i);
      if (load.at && load.has_force())
        add_load(load.link, force_at(arm(*load.at), points_.vector(mechanism::force_of(load))), i);
    }
    mechanism::require_preload(loaded);
    for (const mechanism::Action& action : mechanism::actions(loaded)) add_action(action, i);
    if (loaded.gravity.empty()) return;
    const Vector g = points_.components(loaded.gravity);
    for (const mechanism::Mass& body : mechanism::masses(loaded))
      add_load(body.link, force_at(arm(body.at), points_.times(points_.expression(body.mass), g)), i);
  }

  /// What a spring or an actuator of known effort exerts on its two links (method.md section 11).
  void add_action(const mechanism::Action& action, std::size_t load) {
    using Law = mechanism::Action::Law;
    const auto both = [&](const Wrench& on, const Wrench& by) {
      add_load(action.on, on, load);
      add_load(action.by, by, load, true);
    };
    if (action.law == Law::torsion) {
      const auto [x, y] = off_rest(m_.springs[action.index]);
      const int back = b_.negate(b_.multiply(points_.expression(action.stiffness), b_.angle(y, x)));
      const Wrench wrench = couple(points_.times(back, axis_of(m_.springs[action.index])));
      return both(wrench, wrench);
    }
    if (!action.along) {
      const Wrench wrench = couple({b_.zero(), b_.zero(), points_.expression(action.effort)});
      return both(wrench, wrench);
    }
    const Vector v = points_.vector(*action.along);
    int per_length = b_.zero();
    if (action.law == Law::constant) {
      per_length = b_.divide(points_.expression(action.effort), points_.length(v));
    } else {
      const int stiffness = points_.expression(action.stiffness);
      per_length = stiffness;
      if (action.needs_length(m_)) {
        const int part = b_.divide(points_.expression(action.free_length), points_.length(v));
        per_length = b_.subtract(stiffness, b_.multiply(stiffness, part));
      }
    }
    const Vector force = points_.times(per_length, v);
    if (action.couple) return both(couple(force), couple(force));
    both(force_at(arm(action.on_point), force), force_at(arm(action.by_point), force));
  }

  /// Of the joint that a torsion spring turns about.
  Vector axis_of(const mechanism::Spring& spring) {
    if (m_.space == mechanism::Space::planar) return {b_.zero(), b_.zero(), b_.one()};
    return points_.unit(points_.vector(m_.joints[static_cast<std::size_t>(spring.joint)].axes.at(0)));
  }

  /// A way (x, y) at angle - rest about the axis.
  std::array<int, 2> off_rest(const mechanism::Spring& spring) {
    const Vector a = points_.vector(mechanism::direction_of(m_, spring.from)), u = axis_of(spring);
    const Vector b = points_.vector(mechanism::direction_of(m_, spring.to));
    const int sine = points_.dot(u, points_.cross(a, b));
    const int cosine = b_.subtract(points_.dot(a, b), b_.multiply(points_.dot(u, a), points_.dot(u, b)));
    const int rest = points_.expression(spring.rest), c = b_.cosine(rest), s = b_.sine(rest);
    return {b_.add(b_.multiply(c, cosine), b_.multiply(s, sine)),
            b_.subtract(b_.multiply(c, sine), b_.multiply(s, cosine))};
  }

  SymbolicRow scalar(int unknown) const { return {{{unknown, b_.one()}}, std::vector<int>(loads_.size(), b_.zero())}; }
  /// u . (unknowns).
  SymbolicRow along(const Vector& u, const std::vector<int>& unknowns) const {
    SymbolicRow row{{}, std::vector<int>(loads_.size(), b_.zero())};
    for (std::size_t c = 0; c < 3; ++c)
      if (u[c] != b_.zero()) row.entries[unknowns[c]] = u[c];
    return row;
  }

  /// Component i of u x (unknowns): as large as their part across the unit vector u.
  SymbolicRow across(const Vector& u, const std::vector<int>& unknowns, std::size_t i) const {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    SymbolicRow row{{}, std::vector<int>(loads_.size(), b_.zero())};
    if (u[j] != b_.zero()) row.entries[unknowns[k]] = u[j];
    if (u[k] != b_.zero()) row.entries[unknowns[j]] = b_.negate(u[k]);
    return row;
  }

  /// side (w - at) of an effort w that has a bound.
  SymbolicRow within_bound(const core::TaskDemand& demand, SymbolicRow effort) const {
    if (!demand.bound) return effort;
    const int at = b_.constant(demand.bound->at);
    for (int& free : effort.free) free = b_.subtract(free, at);
    if (demand.bound->side > 0) return effort;
    for (int& free : effort.free) free = b_.negate(free);
    for (auto& [unknown, step] : effort.entries) step = b_.negate(step);
    return effort;
  }

  std::vector<SymbolicRow> components(const core::TaskDemand& demand) {
    const auto found = std::find_if(m_.joints.begin(), m_.joints.end(),
                                    [&](const mechanism::Joint& joint) { return joint.name == demand.joint; });
    core::ensure(found != m_.joints.end(), "a demand is of a joint of the mechanism");
    const JointUnknowns& unknowns = joints_[static_cast<std::size_t>(found - m_.joints.begin())];
    const bool planar = m_.space == mechanism::Space::planar;
    for (const auto& [end, sign] : mechanism::guide_end_signs)
      if (demand.quantity == end) {
        const Rational h = mechanism::value_of(found->clearance->half_length, m_);
        SymbolicRow row = scalar(unknowns.normal);
        row.entries[unknowns.normal] = b_.constant(Rational(1, 2));
        row.entries[unknowns.couple.front()] = b_.constant(Rational(sign) / (2 * h));
        return {row};
      }
    if (demand.quantity == Quantity::F)
      return {
          within_bound(demand, unknowns.along >= 0 ? scalar(unknowns.along) : along(unknowns.axis, unknowns.force))};
    if (demand.quantity == Quantity::M)
      return {within_bound(demand, planar ? scalar(unknowns.couple.front()) : along(unknowns.axis, unknowns.couple))};
    core::ensure(demand.quantity == Quantity::f, "a task asks for forces, ends of guides and efforts");
    std::vector<SymbolicRow> rows;
    if (unknowns.normal >= 0) {
      rows.push_back(scalar(unknowns.normal));
      for (const int unknown : unknowns.couple) rows.push_back(scalar(unknown));
      return rows;
    }
    if (mechanism::presses_across_axis(m_, *found)) {
      for (std::size_t i = 0; i < 3; ++i)
        if (SymbolicRow row = across(unknowns.axis, unknowns.force, i); !row.entries.empty())
          rows.push_back(std::move(row));
      return rows;
    }
    if (parts_ == ForceParts::along_known_lines)
      if (const auto line = mechanism::pins_along_force(m_, *found)) {
        const Vector way = points_.minus(points_.point((*line)[1]), points_.point((*line)[0]));
        return {along(points_.unit(way), unknowns.force)};
      }
    for (const int unknown : unknowns.force) rows.push_back(scalar(unknown));
    return rows;
  }

  void add_reach(const mechanism::Spring& spring, std::vector<int>& positive) {
    const auto [x, y] = off_rest(spring);
    const int size = b_.square_root(b_.add(b_.square(x), b_.square(y)));
    positive.push_back(b_.subtract(b_.divide(x, size), b_.constant(mechanism::least_torsion_cosine())));
  }

  void add_law(mechanism::JointIndex index, std::vector<int>& positive) {
    const mechanism::Joint& joint = m_.joints[static_cast<std::size_t>(index)];
    const int effort = points_.expression(*joint.effort);
    positive.push_back(b_.subtract(effort, b_.constant(joint.law_within->first)));
    positive.push_back(b_.subtract(b_.constant(joint.law_within->second), effort));
  }

  void add_limit(const mechanism::Limit& limit, std::vector<int>& positive) {
    const int lower = points_.expression(limit.lower), upper = points_.expression(limit.upper);
    const auto way = [&](std::size_t from, std::size_t to) {
      return points_.minus(points_.point(limit.points[to]), points_.point(limit.points[from]));
    };
    if (limit.is_angle()) {
      const int cosine = points_.dot(points_.unit(way(1, 0)), points_.unit(way(1, 2)));
      if (limit.keeps_lower()) positive.push_back(b_.subtract(b_.cosine(lower), cosine));
      if (limit.keeps_upper()) positive.push_back(b_.subtract(cosine, b_.cosine(upper)));
      return;
    }
    const Vector between = way(0, 1);
    const int square = points_.dot(between, between);
    if (limit.keeps_lower()) positive.push_back(b_.subtract(square, b_.square(lower)));
    if (limit.keeps_upper()) positive.push_back(b_.subtract(b_.square(upper), square));
  }

  const std::vector<const Mechanism*>& loads_;
  const Mechanism& m_;
  ForceParts parts_;
  PosePoints points_;
  core::PoseProgramBuilder& b_;
  std::vector<std::size_t> components_;
  int unknowns_ = 0;
  std::vector<SymbolicRow> rows_, side_rows_;
  std::vector<JointUnknowns> joints_;
};

}  // namespace

core::PoseStatics pose_statics(const std::vector<const Mechanism*>& loads, const std::vector<int>& sides,
                               const std::vector<core::TaskDemand>& demands, ForceParts parts) {
  return StaticsBuilder(loads, sides, parts).build(demands);
}

}  // namespace clearloci::symbolic
