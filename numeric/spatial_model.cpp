#include "numeric/spatial_model.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/evaluator.hpp"
#include "numeric/named_tape.hpp"

namespace clearloci::numeric {

namespace {

using core::Quantity;
using mechanism::Mechanism;
using Triple = std::array<Register, 3>;
using Wrench = std::array<Register, 6>;

constexpr std::array forces = {Quantity::fx, Quantity::fy, Quantity::fz};
constexpr std::array couples = {Quantity::mx, Quantity::my, Quantity::mz};

/// What an unknown adds to an equation that is not one of a link.
struct SideEquation {
  int row = 0;
  std::map<int, Register> entries;
};

class SpatialModelBuilder {
 public:
  explicit SpatialModelBuilder(const Mechanism& m)
      : m_(m), named_(m), tape_(named_.builder()), zero_(tape_.constant(0.0)), one_(tape_.constant(1.0)) {}

  NumericModel build() {
    NumericModel model;
    model.mechanism = m_;
    for (const auto& c : m_.coordinates) model.box.push_back({core::to_double(c.lower), core::to_double(c.upper)});
    model.dyads = mechanism::dyad_points(m_);
    for (std::size_t i = 0; i < m_.points.size(); ++i) points_.push_back(place(static_cast<int>(i)));
    for (const Triple& p : points_) model.placed.insert(model.placed.end(), p.begin(), p.end());
    for (const auto& joint : m_.joints) {
      raw_axes_.push_back(joint.axes.empty() ? Triple{} : vector(joint.axes.front()));
      model.space_axes.emplace_back();
      if (joint.axes.empty()) continue;
      const Triple u = unit(raw_axes_.back());
      model.space_axes.back() = u;
      model.placed.insert(model.placed.end(), u.begin(), u.end());
    }
    axes_ = model.space_axes;
    for (const mechanism::Limit& limit : m_.limits) add_limit(limit, model);
    model.posture_size = tape_.size();
    for (std::size_t j = 0; j < m_.joints.size(); ++j) add_unknowns(static_cast<int>(j));
    model.unknowns = unknowns_;
    const SparseEquations matrix = equations();
    model.elimination = eliminate(tape_, with_loads(matrix));
    model.reaction_size = tape_.size();
    for (int c = 0; c < 6; ++c) {
      SparseEquations unit_load = matrix;
      add(unit_load, m_.end_effector_link, c, unit_load.unknowns, one_);
      if (m_.relative_to != mechanism::ground)
        add(unit_load, m_.relative_to, c, unit_load.unknowns, tape_.negate(one_));
      model.unit_wrenches.push_back(eliminate(tape_, std::move(unit_load)));
    }
    model.tape = tape_.tape();
    choose_directions_across(model);
    return model;
  }

 private:
  Register compile(const core::Expression& e) { return named_.compile(e); }
  const Triple& point(int index) const { return points_[static_cast<std::size_t>(index)]; }

  Triple components(const std::vector<core::Expression>& expressions) {
    if (expressions.empty()) return {zero_, zero_, zero_};
    const Register x = compile(expressions.at(0)), y = compile(expressions.at(1));
    return {x, y, compile(expressions.at(2))};
  }

  Triple plus(const Triple& a, const Triple& b) {
    return {tape_.add(a[0], b[0]), tape_.add(a[1], b[1]), tape_.add(a[2], b[2])};
  }
  Triple minus(const Triple& a, const Triple& b) {
    return {tape_.subtract(a[0], b[0]), tape_.subtract(a[1], b[1]), tape_.subtract(a[2], b[2])};
  }
  Triple times(Register s, const Triple& a) {
    return {tape_.multiply(s, a[0]), tape_.multiply(s, a[1]), tape_.multiply(s, a[2])};
  }
  Triple cross(const Triple& a, const Triple& b) {
    const auto minor = [&](std::size_t i, std::size_t k) {
      return tape_.subtract(tape_.multiply(a[i], b[k]), tape_.multiply(a[k], b[i]));
    };
    const Register x = minor(1, 2), y = minor(2, 0);
    return {x, y, minor(0, 1)};
  }
  Triple unit(const Triple& a) {
    const Register square = tape_.add(tape_.add(tape_.square(a[0]), tape_.square(a[1])), tape_.square(a[2]));
    const Register length = tape_.sqrt(square);
    return {tape_.divide(a[0], length), tape_.divide(a[1], length), tape_.divide(a[2], length)};
  }

  Register dot(const Triple& a, const Triple& b) {
    return tape_.add(tape_.add(tape_.multiply(a[0], b[0]), tape_.multiply(a[1], b[1])), tape_.multiply(a[2], b[2]));
  }

  Triple place(int index) {
    const mechanism::PointForm& form = m_.points[static_cast<std::size_t>(index)].form;
    if (const auto* dyad = std::get_if<mechanism::DyadPoint>(&form)) return elbow(*dyad, named_.sign_of(index));
    if (const auto* slider = std::get_if<mechanism::SliderPoint>(&form)) return slide(*slider, named_.sign_of(index));
    if (const auto* e = std::get_if<mechanism::ExplicitPoint>(&form)) return components(e->coordinates);
    if (const auto* mean = std::get_if<mechanism::MeanPoint>(&form))
      return times(tape_.constant(0.5), plus(point(mean->first), point(mean->second)));
    const auto* offset = std::get_if<mechanism::OffsetPoint>(&form);
    core::ensure(offset != nullptr, "a construction of space");
    const Triple direction = unit(minus(point(offset->second), point(offset->first)));
    return plus(point(offset->first), times(compile(offset->along), direction));
  }

  /// In the plane across the axis P is seen p m off A, in the direction e, and b' m off the elbow, b'^2 = b^2 - h^2
  /// where P stands h m above the plane. Then B is a c e + a s (n x e), c the cosine of the angle at A.
  Triple elbow(const mechanism::DyadPoint& form, Register sign) {
    auto& t = tape_;
    const Triple way = minus(point(form.to), point(form.from));
    const Triple n = unit(vector(*form.axis));
    const Register h = dot(n, way);
    const Triple in_plane = minus(way, times(h, n));
    const Register p2 = dot(in_plane, in_plane), p = t.sqrt(p2);
    const Triple e = {t.divide(in_plane[0], p), t.divide(in_plane[1], p), t.divide(in_plane[2], p)};
    const Register a = compile(form.from_length), b = compile(form.to_length);
    const Register seen2 = t.subtract(t.square(b), t.square(h));
    const Register c = t.divide(t.subtract(t.add(t.square(a), p2), seen2), t.add(p, p));  // times a
    const Register s = t.sqrt(t.multiply(t.subtract(a, c), t.add(a, c)));                 // likewise
    return plus(point(form.from), plus(times(c, e), times(t.multiply(sign, s), cross(n, e))));
  }

  /// Q + (u . r +- sqrt(l^2 - |u x r|^2)) u,  r = C - Q, u of length one.
  Triple slide(const mechanism::SliderPoint& form, Register sign) {
    auto& t = tape_;
    const Triple u = unit(vector(form.along));
    const Triple r = minus(point(form.from), point(form.base));
    const Triple across = cross(u, r);
    const Register s = t.sqrt(t.subtract(t.square(compile(form.length)), dot(across, across)));
    return plus(point(form.base), times(t.add(dot(u, r), t.multiply(sign, s)), u));
  }

  Triple vector(const mechanism::VectorExpression& v) {
    using Kind = mechanism::VectorExpression::Kind;
    std::vector<Triple> a;
    for (const auto& argument : v.arguments) a.push_back(vector(argument));
    switch (v.kind) {
      case Kind::components:
        return components(v.numbers);
      case Kind::point:
        return point(v.point);
      case Kind::add:
        return plus(a[0], a[1]);
      case Kind::negate:
        return {tape_.negate(a[0][0]), tape_.negate(a[0][1]), tape_.negate(a[0][2])};
      case Kind::scale:
        return times(compile(v.numbers.at(0)), a[0]);
      case Kind::cross:
        return cross(a[0], a[1]);
    }
    return {};
  }

  Triple arm(int p) { return minus(point(p), point(m_.end_effector_point)); }

  int add_unknown(int joint, Quantity quantity, const Wrench& wrench) {
    unknowns_.push_back({joint, quantity});
    wrenches_.push_back(wrench);
    return static_cast<int>(unknowns_.size()) - 1;
  }

  Wrench force_at(const Triple& r, const Triple& f) {
    const Triple moment = cross(r, f);
    return {f[0], f[1], f[2], moment[0], moment[1], moment[2]};
  }

  Triple direction(std::size_t i) const {
    Triple e = {zero_, zero_, zero_};
    e[i] = one_;
    return e;
  }

  /// u · (three columns from `first` on) = 0, at the row of the last of them; where actuated the unknown F or M is that
  /// product, at the row of its own column.
  void add_side_equation(int joint, int first, Quantity actuator, bool actuated) {
    const Triple& u = *axes_[static_cast<std::size_t>(joint)];
    SideEquation equation;
    for (int c = 0; c < 3; ++c)
      equation.entries[first + c] =
          actuated ? tape_.negate(u[static_cast<std::size_t>(c)]) : u[static_cast<std::size_t>(c)];
    equation.row = first + 2;
    if (actuated) {
      equation.row = add_unknown(joint, actuator, {zero_, zero_, zero_, zero_, zero_, zero_});
      equation.entries[equation.row] = one_;
    }
    std::erase_if(equation.entries, [&](const auto& entry) { return tape_.is_exactly(entry.second, 0); });
    side_equations_.push_back(std::move(equation));
  }

  void add_unknowns(int j) {
    const auto& joint = m_.joints[static_cast<std::size_t>(j)];
    const Triple r = arm(joint.at);
    const auto first = static_cast<int>(unknowns_.size());
    for (std::size_t c = 0; c < 3; ++c) add_unknown(j, forces[c], force_at(r, direction(c)));
    const mechanism::JointTraits& own = mechanism::traits(joint);
    if (own.slides) add_side_equation(j, first, Quantity::F, joint.actuated);
    if (own.couple == mechanism::BorneCouple::none) return;
    if (own.couple == mechanism::BorneCouple::cross) {
      const Triple n = mechanism::holds_idle_freedom(joint)
                           ? unit(vector(joint.axes.front()))
                           : unit(cross(vector(joint.axes.at(0)), vector(joint.axes.at(1))));
      add_unknown(j, Quantity::T, {zero_, zero_, zero_, n[0], n[1], n[2]});
      return;
    }
    const auto couple = static_cast<int>(unknowns_.size());
    for (std::size_t c = 0; c < 3; ++c) {
      const Triple e = direction(c);
      add_unknown(j, couples[c], {zero_, zero_, zero_, e[0], e[1], e[2]});
    }
    if (own.turns_about_axis()) add_side_equation(j, couple, Quantity::M, joint.actuated && !own.slides);
  }

  void add(SparseEquations& e, int link, int component, int column, Register value) {
    if (tape_.is_exactly(value, 0)) return;
    auto& entries = e.rows[link_rows_[6 * static_cast<std::size_t>(link) + static_cast<std::size_t>(component)]];
    const auto [place, fresh] = entries.try_emplace(column, value);
    if (!fresh) place->second = tape_.add(place->second, value);
    if (tape_.is_exactly(place->second, 0)) entries.erase(place);
  }

  SparseEquations equations() {
    SparseEquations e;
    e.unknowns = static_cast<int>(unknowns_.size());
    e.rows.resize(unknowns_.size());
    core::ensure(6 * m_.links.size() + side_equations_.size() == e.rows.size(), "the equations are square");
    for (std::size_t row = 0; row < e.rows.size(); ++row) {
      const auto side = std::find_if(side_equations_.begin(), side_equations_.end(),
                                     [&](const SideEquation& s) { return s.row == static_cast<int>(row); });
      if (side == side_equations_.end())
        link_rows_.push_back(row);
      else
        e.rows[row] = side->entries;
    }
    for (int column = 0; column < e.unknowns; ++column) {
      const auto& joint = m_.joints[static_cast<std::size_t>(unknowns_[static_cast<std::size_t>(column)].joint)];
      const Wrench& wrench = wrenches_[static_cast<std::size_t>(column)];
      for (int c = 0; c < 6; ++c) {
        const Register value = wrench[static_cast<std::size_t>(c)];
        if (joint.to != mechanism::ground) add(e, joint.to, c, column, value);
        if (joint.from != mechanism::ground && !tape_.is_exactly(value, 0))
          add(e, joint.from, c, column, tape_.negate(value));
      }
    }
    return e;
  }

  void add_load(SparseEquations& e, int link, const Wrench& load) {
    for (int c = 0; c < 6; ++c)
      if (const Register value = load[static_cast<std::size_t>(c)]; !tape_.is_exactly(value, 0))
        add(e, link, c, e.unknowns, tape_.negate(value));
  }

  SparseEquations with_loads(SparseEquations e) {
    for (const auto& load : m_.loads) {
      const Triple couple = components(load.couple_vector);
      add_load(e, load.link, {zero_, zero_, zero_, couple[0], couple[1], couple[2]});
      if (load.at && load.has_force())
        add_load(e, load.link,
                 force_at(arm(*load.at), load.force_vector ? vector(*load.force_vector) : components(load.force)));
    }
    for (const mechanism::Action& action : mechanism::actions(m_)) add_action(e, action);
    if (m_.gravity.empty()) return e;
    const Triple g = components(m_.gravity);
    for (const mechanism::Mass& body : mechanism::masses(m_)) {
      const Register mass = compile(body.mass);
      if (tape_.is_exactly(mass, 0)) continue;
      add_load(e, body.link, force_at(arm(body.at), times(mass, g)));
    }
    return e;
  }

  /// What a spring or an actuator of known effort exerts on its two links.
  void add_action(SparseEquations& e, const mechanism::Action& action) {
    const auto both = [&](const Wrench& on, const Wrench& by) {
      if (action.on != mechanism::ground) add_load(e, action.on, on);
      Wrench opposite = by;
      for (Register& component : opposite) component = tape_.negate(component);
      if (action.by != mechanism::ground) add_load(e, action.by, opposite);
    };
    if (action.law == mechanism::Action::Law::torsion) {
      const Triple u = *axes_[static_cast<std::size_t>(m_.springs[action.index].joint)];
      const Triple c = times(torsion(action, u), u);
      const Wrench couple = {zero_, zero_, zero_, c[0], c[1], c[2]};
      return both(couple, couple);
    }
    const Triple v = vector(*action.along);
    const Register length = tape_.sqrt(dot(v, v));
    Register per_length = tape_.divide(compile(action.effort), length);
    if (action.law == mechanism::Action::Law::linear) {
      const Register stiffness = compile(action.stiffness);
      per_length =
          action.needs_length(m_)
              ? tape_.subtract(stiffness, tape_.divide(tape_.multiply(stiffness, compile(action.free_length)), length))
              : stiffness;
    }
    const Triple force = times(per_length, v);
    if (!action.couple) return both(force_at(arm(action.on_point), force), force_at(arm(action.by_point), force));
    const Wrench couple = {zero_, zero_, zero_, force[0], force[1], force[2]};
    both(couple, couple);
  }

  Triple link_direction(int link) {
    if (link == mechanism::ground) return direction(0);
    const auto& points = m_.links[static_cast<std::size_t>(link)].points;
    return minus(point(points.at(1)), point(points.at(0)));
  }

  /// -c (angle - rest) about the unit vector u, of the directions as seen along it.
  Register torsion(const mechanism::Action& action, const Triple& u) {
    const Triple a = link_direction(action.by), b = link_direction(action.on);
    const Register sine = dot(u, cross(a, b)), cosine = tape_.subtract(dot(a, b), tape_.multiply(dot(u, a), dot(u, b)));
    const Register rest = compile(action.rest);
    const Register c = tape_.cos(rest), s = tape_.sin(rest);
    const Register y = tape_.subtract(tape_.multiply(c, sine), tape_.multiply(s, cosine));
    const Register x = tape_.add(tape_.multiply(c, cosine), tape_.multiply(s, sine));
    return tape_.negate(tape_.multiply(compile(action.stiffness), tape_.atan2(y, x)));
  }

  void add_limit(const mechanism::Limit& limit, NumericModel& model) {
    auto& t = tape_;
    const Register lower = compile(limit.lower), upper = compile(limit.upper);
    const auto at = [&](std::size_t i) { return point(limit.points[i]); };
    std::array<std::optional<Register>, 2> slack;
    if (limit.is_angle()) {
      const Register cosine = dot(unit(minus(at(0), at(1))), unit(minus(at(2), at(1))));
      if (limit.keeps_lower()) slack[0] = t.subtract(t.cos(lower), cosine);
      if (limit.keeps_upper()) slack[1] = t.subtract(cosine, t.cos(upper));
    } else {
      const Triple between = minus(at(0), at(1));
      const Register square = dot(between, between), unit2 = t.square(upper);
      if (limit.keeps_lower()) slack[0] = t.divide(t.subtract(square, t.square(lower)), unit2);
      slack[1] = t.divide(t.subtract(unit2, square), unit2);
    }
    for (const auto& end : slack)
      if (end) model.placed.push_back(t.sqrt(*end));
    model.slack.push_back(slack);
  }

  /// The components 1 and 2 across an axis u are the Cartesian ones other than k, the first direction in which u is
  /// constant and not zero, else the first in which it is not zero everywhere: told from poses all over the box.
  void choose_directions_across(NumericModel& model) const {
    const std::vector<int> mode = mechanism::working_mode(m_);
    const int samples = mode.empty() ? 7 : 64;  // some of them out of reach
    std::vector<std::vector<Bounded>> seen(3 * raw_axes_.size());
    for (int s = 0; s < samples; ++s) {
      Evaluator<Bounded, 1> evaluator(model, mode, model.posture_size);
      for (std::size_t c = 0; c < model.box.size(); ++c) {
        // Off every symmetry, and otherwise for every coordinate.
        const double part = std::fmod((s + 1) * std::sqrt(static_cast<double>(2 + 3 * c)), 1.0);
        evaluator.input(c, 0) = model.box[c][0] + part * (model.box[c][1] - model.box[c][0]);
      }
      evaluator.run_tape();
      for (std::size_t j = 0; j < raw_axes_.size(); ++j)
        for (std::size_t c = 0; !m_.joints[j].axes.empty() && c < 3; ++c)
          if (const Bounded value = evaluator.value(raw_axes_[j][c], 0); std::isfinite(value.value + value.error))
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
    for (std::size_t j = 0; j < raw_axes_.size(); ++j) {
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
  NamedTape named_;
  TapeBuilder& tape_;
  Register zero_, one_;
  std::vector<Triple> points_, raw_axes_;
  std::vector<std::optional<Triple>> axes_;
  std::vector<mechanism::Unknown> unknowns_;
  std::vector<Wrench> wrenches_;  ///< of a unit of each unknown
  std::vector<SideEquation> side_equations_;
  std::vector<std::size_t> link_rows_;  ///< of every component of every link
};

}  // namespace

NumericModel compile_spatial(const Mechanism& m) { return SpatialModelBuilder(m).build(); }

}  // namespace clearloci::numeric
