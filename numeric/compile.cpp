#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/idle_limits.hpp"
#include "mechanism/rigidity.hpp"
#include "numeric/equations.hpp"
#include "numeric/evaluator.hpp"
#include "numeric/group_solution.hpp"

namespace clearloci::numeric {

namespace {

using mechanism::Action;
using mechanism::Mechanism;

class ModelBuilder {
 public:
  explicit ModelBuilder(const Mechanism& m) : m_(m), geometry_(m), tape_(geometry_.tape()) {}

  NumericModel build() {
    NumericModel model;
    model.mechanism = m_;
    model.dyads = mechanism::dyad_points(m_);
    for (const auto& c : m_.coordinates) model.box.push_back({core::to_double(c.lower), core::to_double(c.upper)});
    model.points = geometry_.points();
    model.groups = geometry_.groups();
    if (!model.groups.empty()) model.group_starts = std::make_shared<GroupStarts>(m_);
    model.axes = geometry_.axes();
    model.couple_axes = geometry_.couple_axes();
    for (const Triple& p : model.points) add_placed(p, model);
    for (const auto& u : model.axes)
      if (u) add_placed(*u, model);
    const std::vector<bool> idle = mechanism::idle_limits(m_);
    for (std::size_t i = 0; i < idle.size(); ++i)
      if (idle[i])
        keep({}, model);
      else
        add_limit(m_.limits[i], model);
    for (const Action& action : mechanism::actions(m_))
      if (action.law == Action::Law::torsion) add_reach(action, model);
    hold_links(model);
    for (const mechanism::JointIndex joint : mechanism::bounded_laws(m_)) add_law(joint, model);
    if (!m_.gravity.empty()) model.gravity = geometry_.components(m_.gravity);
    model.loads = loads(model);
    model.posture_size = tape_.size();
    Equations equations(geometry_, m_);
    model.unknowns = equations.unknowns();
    for (const mechanism::Joint& joint : m_.joints) {
      const bool has_second = joint.axes.size() > 1;
      model.second_axes.push_back(has_second ? std::optional(geometry_.unit(geometry_.vector(joint.axes[1])))
                                             : std::nullopt);
    }
    model.equations = equations.under(model.loads);
    model.equations_size = tape_.size();
    model.link_rows = equations.link_rows();
    model.elimination = eliminate(tape_, model.equations);
    model.reaction_size = tape_.size();
    for (std::size_t c = 0; c < equations.components(); ++c)
      model.unit_wrenches.push_back(eliminate(tape_, equations.under_unit(c)));
    model.tape = tape_.tape();
    if (m_.space == mechanism::Space::spatial) choose_directions_across(model);
    return model;
  }

 private:
  Register compile(const core::Expression& e) { return geometry_.compile(e); }
  Triple none() const { return {geometry_.zero(), geometry_.zero(), geometry_.zero()}; }
  /// About k, of the plane.
  Triple about_z(Register couple) const { return {geometry_.zero(), geometry_.zero(), couple}; }

  /// What may be infinite or NaN at some pose.
  void add_placed(const Triple& v, NumericModel& model) const {
    for (const Register r : v)
      if (!tape_.is_constant(r) || !std::isfinite(tape_.constant_value(r).value)) model.placed.push_back(r);
  }

  std::vector<LoadRegisters> loads(const NumericModel& model) {
    std::vector<LoadRegisters> all;
    for (const mechanism::Load& load : m_.loads) {
      const Triple couple = m_.space == mechanism::Space::planar ? about_z(compile(load.couple))
                                                                 : geometry_.components(load.couple_vector);
      const Triple force = load.force_vector ? geometry_.vector(*load.force_vector) : geometry_.components(load.force);
      all.push_back({load.link, load.at, force, couple});
    }
    mechanism::require_preload(m_);
    for (const Action& action : mechanism::actions(m_)) add_action(action, all);
    if (!model.gravity) return all;
    for (const mechanism::Mass& body : mechanism::masses(m_)) {
      const Register mass = compile(body.mass);
      if (tape_.is_exactly(mass, 0)) continue;
      all.push_back({body.link, body.at, geometry_.times(mass, *model.gravity), none(), true});
    }
    return all;
  }

  /// What a spring or an actuator of known effort exerts on its two links.
  void add_action(const Action& action, std::vector<LoadRegisters>& all) {
    const int spring = action.source == Action::Source::spring ? static_cast<int>(action.index) : -1;
    const auto put = [&](mechanism::LinkIndex link, mechanism::PointIndex at, const Triple& v) {
      if (link == mechanism::ground) return;
      if (action.couple)
        all.push_back({link, std::nullopt, none(), v, false, true, spring});
      else
        all.push_back({link, at, v, none(), false, true, spring});
    };
    const Triple exerted = effort(action);
    put(action.on, action.on_point, exerted);
    put(action.by, action.by_point, geometry_.negative(exerted));
  }

  /// The force or the couple on the link `on`.
  Triple effort(const Action& action) {
    auto& t = tape_;
    if (action.law == Action::Law::torsion) {
      const Triple u = axis_of(action);
      const Register off = off_rest(action, u);
      return geometry_.times(t.negate(t.multiply(compile(action.stiffness), off)), u);
    }
    if (!action.along) return about_z(compile(action.effort));
    const Triple v = geometry_.vector(*action.along);
    const Register length = geometry_.length(v);
    Register per_length = t.divide(compile(action.effort), length);
    if (action.law == Action::Law::linear) {
      const Register stiffness = compile(action.stiffness);
      // Without a free length no length is divided by: it may be zero.
      per_length = action.needs_length(m_)
                       ? t.subtract(stiffness, t.divide(t.multiply(stiffness, compile(action.free_length)), length))
                       : stiffness;
    }
    return geometry_.times(per_length, v);
  }

  /// That a torsion spring turns about.
  Triple axis_of(const Action& action) const {
    if (m_.space == mechanism::Space::planar) return geometry_.direction(2);
    return *geometry_.axes()[static_cast<std::size_t>(m_.springs[action.index].joint)];
  }

  /// angle - rest about the unit vector u, of the directions as seen along it; turned back by rest, so that its
  /// branch is cut half a turn off it.
  Register off_rest(const Action& action, const Triple& u) {
    auto& t = tape_;
    Geometry& g = geometry_;
    const Triple a = g.direction_of(action.by), b = g.direction_of(action.on);
    const Register sine = g.dot(u, g.cross(a, b));
    const Register cosine = t.subtract(g.dot(a, b), t.multiply(g.dot(u, a), g.dot(u, b)));
    const Register rest = compile(action.rest);
    const Register c = t.cos(rest), s = t.sin(rest);
    const Register y = t.subtract(t.multiply(c, sine), t.multiply(s, cosine));
    const Register x = t.add(t.multiply(c, cosine), t.multiply(s, sine));
    return t.atan2(y, x);
  }

  /// Slack to both ends, of the size of a number: distances over the end, cosines of angles.
  void add_limit(const mechanism::Limit& limit, NumericModel& model) {
    auto& t = tape_;
    Geometry& g = geometry_;
    const auto way = [&](std::size_t from, std::size_t to) {
      return g.minus(g.point(limit.points[to]), g.point(limit.points[from]));
    };
    const Register lower = compile(limit.lower), upper = compile(limit.upper);
    std::array<std::optional<Register>, 2> slack;
    if (limit.is_angle()) {
      const Register cosine = g.dot(g.unit(way(1, 0)), g.unit(way(1, 2)));
      if (limit.keeps_lower()) slack[0] = t.subtract(t.cos(lower), cosine);
      if (limit.keeps_upper()) slack[1] = t.subtract(cosine, t.cos(upper));
    } else {
      const Triple between = way(1, 0);
      const Register square = g.dot(between, between), unit2 = t.square(upper);
      if (limit.keeps_lower()) slack[0] = t.divide(t.subtract(square, t.square(lower)), unit2);
      if (limit.keeps_upper()) slack[1] = t.divide(t.subtract(unit2, square), unit2);
    }
    keep(slack, model);
  }

  /// Slack to half a turn off the rest of a torsion spring, in the cosine.
  void add_reach(const Action& action, NumericModel& model) {
    const Register least = tape_.constant(core::to_double(mechanism::least_torsion_cosine()));
    keep({tape_.subtract(tape_.cos(off_rest(action, axis_of(action))), least), std::nullopt}, model);
  }

  /// Slack to the bounds of an effort that follows a law, over its range.
  void add_law(mechanism::JointIndex index, NumericModel& model) {
    const mechanism::Joint& joint = m_.joints[static_cast<std::size_t>(index)];
    const double least = core::to_double(joint.law_within->first), most = core::to_double(joint.law_within->second);
    const Register effort = compile(*joint.effort), range = tape_.constant(most - least);
    keep({tape_.divide(tape_.subtract(effort, tape_.constant(least)), range),
          tape_.divide(tape_.subtract(tape_.constant(most), effort), range)},
         model);
  }

  /// What is left of the rounding by which a distance or a turn of a rigid link may be off.
  void hold_links(NumericModel& model) {
    auto& t = tape_;
    Geometry& g = geometry_;
    const auto within = [&](Register ratio) {
      const Register off = t.divide(t.subtract(ratio, g.one()), t.constant(mechanism::bending));
      keep({t.subtract(g.one(), t.square(off)), std::nullopt}, model);
    };
    const mechanism::HeldByLinks held = mechanism::held_by_links(m_);
    for (const mechanism::HeldDistance& distance : held.distances) {
      const Triple way = g.minus(g.point(distance.second), g.point(distance.first));
      within(t.divide(g.dot(way, way), t.constant(distance.length * distance.length)));
    }
    for (const mechanism::HeldTurn& held_turn : held.turns) {
      const auto way = [&](std::size_t i) {
        return g.minus(g.point(held_turn.points[i]), g.point(held_turn.points[0]));
      };
      const Triple across = g.cross(way(1), way(2));
      const Register turn = held_turn.points.size() == 3 ? across[2] : g.dot(across, way(3));
      keep({t.divide(turn, t.constant(held_turn.size)), std::nullopt}, model);
    }
  }

  void keep(const std::array<std::optional<Register>, 2>& slack, NumericModel& model) {
    for (const auto& end : slack)
      if (end) model.placed.push_back(tape_.sqrt(*end));
    model.slack.push_back(slack);
  }

  /// The components 1 and 2 across an axis u are the Cartesian ones other than k, the first direction in which u is
  /// constant and not zero, else the first in which it is not zero everywhere: told from poses all over the box.
  void choose_directions_across(NumericModel& model) const {
    const std::vector<int> mode = mechanism::working_mode(m_);
    const std::vector<Triple>& ways = geometry_.ways();
    const int samples = mode.empty() ? 7 : 64;  // some of them out of reach
    std::vector<std::vector<Bounded>> seen(3 * ways.size());
    for (int s = 0; s < samples; ++s) {
      Evaluator<Bounded, 1> evaluator(model, mode, model.posture_size);
      for (std::size_t c = 0; c < model.box.size(); ++c) {
        // Off every symmetry, and otherwise for every coordinate.
        const double part = std::fmod((s + 1) * std::sqrt(static_cast<double>(2 + 3 * c)), 1.0);
        evaluator.input(c, 0) = model.box[c][0] + part * (model.box[c][1] - model.box[c][0]);
      }
      evaluator.run_tape();
      for (std::size_t j = 0; j < ways.size(); ++j)
        for (std::size_t c = 0; !m_.joints[j].axes.empty() && c < 3; ++c)
          if (const Bounded value = evaluator.value(ways[j][c], 0); std::isfinite(value.value + value.error))
            seen[3 * j + c].push_back(value);
    }
    const auto zero = [](const std::vector<Bounded>& values) {
      return std::all_of(values.begin(), values.end(), [](const Bounded& v) { return !(std::abs(v.value) > v.error); });
    };
    const auto constant = [](const std::vector<Bounded>& values) {
      return std::all_of(values.begin(), values.end(), [&](const Bounded& v) {
        return std::abs(v.value - values.front().value) <= v.error + values.front().error;
      });
    };
    for (std::size_t j = 0; j < ways.size(); ++j) {
      model.across.push_back({0, 1});
      if (m_.joints[j].axes.empty()) continue;
      int k = 3;
      for (int c = 2; c >= 0; --c)
        if (!zero(seen[3 * j + static_cast<std::size_t>(c)])) k = c;
      for (int c = 2; c >= 0; --c) {
        const auto& values = seen[3 * j + static_cast<std::size_t>(c)];
        if (!zero(values) && constant(values)) k = c;
      }
      model.across.back() = {k == 0 ? 1 : 0, k == 2 ? 1 : 2};
    }
  }

  const Mechanism& m_;
  Geometry geometry_;
  TapeBuilder& tape_;
};

}  // namespace

NumericModel compile(const Mechanism& m) {
  const std::size_t rows = mechanism::equations_per_link(m) * m.links.size(), columns = mechanism::unknowns(m).size();
  if (rows != columns)
    throw core::InputError({m.file, 0, 0},
                           std::to_string(rows) + " equations for " + std::to_string(columns) + " unknowns",
                           columns > rows ? "remove a joint or an actuator" : "add a joint or an actuator");
  return ModelBuilder(m).build();
}

}  // namespace clearloci::numeric
