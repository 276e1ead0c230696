#include "numeric/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "numeric/evaluator.hpp"
#include "numeric/named_tape.hpp"
#include "numeric/spatial_model.hpp"

namespace clearloci::numeric {

namespace {

using mechanism::Mechanism;

class ModelBuilder {
 public:
  explicit ModelBuilder(const Mechanism& m) : m_(m), named_(m), tape_(named_.builder()) {}

  NumericModel build() {
    NumericModel model;
    model.mechanism = m_;
    model.unknowns = mechanism::unknowns(m_);
    model.dyads = mechanism::dyad_points(m_);
    for (const auto& c : m_.coordinates) model.box.push_back({core::to_double(c.lower), core::to_double(c.upper)});
    for (std::size_t i = 0; i < m_.points.size(); ++i) points_.push_back(place(static_cast<int>(i)));
    model.points = points_;
    for (const auto& p : points_) model.placed.insert(model.placed.end(), p.begin(), p.end());
    model.loads = loads();
    for (const mechanism::Limit& limit : m_.limits) add_limit(limit, model);
    for (const auto& joint : m_.joints) axes_.push_back(axis(joint));
    model.axes = axes_;
    if (!m_.gravity.empty()) {
      const Register gx = compile(m_.gravity.at(0));
      model.gravity = {gx, compile(m_.gravity.at(1))};
    }
    model.posture_size = tape_.size();
    const SparseEquations matrix = matrix_rows(model);
    model.elimination = eliminate(tape_, with_loads(matrix, model));
    model.reaction_size = tape_.size();
    for (int c = 0; c < 3; ++c) {
      SparseEquations unit = matrix;
      add(unit, m_.end_effector_link, c, unit.unknowns, tape_.constant(1.0));
      if (m_.relative_to != mechanism::ground) add(unit, m_.relative_to, c, unit.unknowns, tape_.constant(-1.0));
      model.unit_wrenches.push_back(eliminate(tape_, std::move(unit)));
    }
    model.tape = tape_.tape();
    return model;
  }

 private:
  using Pair = std::array<Register, 2>;

  Register compile(const core::Expression& e) { return named_.compile(e); }
  Pair point(int index) const { return points_[static_cast<std::size_t>(index)]; }
  Pair minus(Pair p, Pair q) { return {tape_.subtract(p[0], q[0]), tape_.subtract(p[1], q[1])}; }
  Register squared_length(Pair v) { return tape_.add(tape_.square(v[0]), tape_.square(v[1])); }

  /// origin + along u + left J u,  J = [[0, -1], [1, 0]].
  Pair offset(Pair origin, Pair u, Register along, Register left) {
    auto& t = tape_;
    return {t.add(origin[0], t.subtract(t.multiply(along, u[0]), t.multiply(left, u[1]))),
            t.add(origin[1], t.add(t.multiply(along, u[1]), t.multiply(left, u[0])))};
  }

  Pair place(int index) {
    const auto& form = m_.points[static_cast<std::size_t>(index)].form;
    if (const auto* e = std::get_if<mechanism::ExplicitPoint>(&form)) {
      const Register x = compile(e->coordinates.at(0));
      return {x, compile(e->coordinates.at(1))};
    }
    if (const auto* d = std::get_if<mechanism::DyadPoint>(&form)) return dyad(*d, named_.sign_of(index));
    if (const auto* o = std::get_if<mechanism::OffsetPoint>(&form)) {
      const Pair r = minus(point(o->second), point(o->first));
      const Register length = tape_.sqrt(squared_length(r));
      const Register along = compile(o->along);
      return offset(point(o->first), {tape_.divide(r[0], length), tape_.divide(r[1], length)}, along, compile(o->left));
    }
    if (const auto* s = std::get_if<mechanism::SliderPoint>(&form)) return slider(*s, named_.sign_of(index));
    const auto& mean = std::get<mechanism::MeanPoint>(form);
    const Pair p = point(mean.first), q = point(mean.second);
    const Register half = tape_.constant(0.5);
    return {tape_.multiply(half, tape_.add(p[0], q[0])), tape_.multiply(half, tape_.add(p[1], q[1]))};
  }

  /// method.md section 1:  B = A + (k (P - A) ± s J (P - A)) / (2 D),  s² = Q = 4 a² D - k², written here as
  /// Q = ((a + b)² - D)(D - (a - b)²), which loses no digits at either end of the reach.
  Pair dyad(const mechanism::DyadPoint& form, Register sign) {
    auto& t = tape_;
    const Pair r = minus(point(form.to), point(form.from));
    const Register a = compile(form.from_length), b = compile(form.to_length);
    const Register D = squared_length(r);
    const Register sum = t.add(a, b), difference = t.subtract(a, b);
    const Register Q = t.multiply(t.subtract(t.square(sum), D), t.subtract(D, t.square(difference)));
    const Register k = t.add(t.multiply(sum, difference), D);
    const Register s = t.multiply(sign, t.sqrt(Q));
    const Register twice_D = t.add(D, D);
    return offset(point(form.from), r, t.divide(k, twice_D), t.divide(s, twice_D));
  }

  Pair unit(Pair v) {
    const Register length = tape_.sqrt(squared_length(v));
    return {tape_.divide(v[0], length), tape_.divide(v[1], length)};
  }

  Pair vector(const mechanism::VectorExpression& v) {
    using Kind = mechanism::VectorExpression::Kind;
    auto& t = tape_;
    std::vector<Pair> a;
    for (const auto& argument : v.arguments) a.push_back(vector(argument));
    switch (v.kind) {
      case Kind::components: {
        const Register x = compile(v.numbers.at(0));
        return {x, compile(v.numbers.at(1))};
      }
      case Kind::point:
        return point(v.point);
      case Kind::add:
        return {t.add(a[0][0], a[1][0]), t.add(a[0][1], a[1][1])};
      case Kind::negate:
        return {t.negate(a[0][0]), t.negate(a[0][1])};
      case Kind::scale: {
        const Register factor = compile(v.numbers.at(0));
        return {t.multiply(factor, a[0][0]), t.multiply(factor, a[0][1])};
      }
      case Kind::cross:
        break;
    }
    core::ensure(false, "a vector of the plane");
    return {};
  }

  /// With the unit vector u of the line, r = C - Q and its parts along and across the line:
  ///     S = Q + (r · u ± sqrt((l - |r × u|) (l + |r × u|))) u
  Pair slider(const mechanism::SliderPoint& form, Register sign) {
    auto& t = tape_;
    const Pair u = unit(vector(form.along));
    const Pair r = minus(point(form.from), point(form.base));
    const Register along = t.add(t.multiply(r[0], u[0]), t.multiply(r[1], u[1]));
    const Register across = t.subtract(t.multiply(r[0], u[1]), t.multiply(r[1], u[0]));
    const Register l = compile(form.length);
    const Register s = t.sqrt(t.multiply(t.subtract(l, across), t.add(l, across)));
    return offset(point(form.base), u, t.add(along, t.multiply(sign, s)), t.constant(0.0));
  }

  std::optional<Pair> axis(const mechanism::Joint& joint) {
    if (joint.axes.empty()) return std::nullopt;
    return unit(vector(joint.axes.front()));
  }

  /// Force x, y and moment about the end-effector point of a unit of an unknown.
  std::array<Register, 3> wrench(const mechanism::Unknown& unknown) {
    using core::Quantity;
    auto& t = tape_;
    const auto& joint = m_.joints[static_cast<std::size_t>(unknown.joint)];
    const Register zero = t.constant(0.0), one = t.constant(1.0);
    const Pair arm = lever(joint.at);
    const auto& u = axes_[static_cast<std::size_t>(unknown.joint)];
    const auto force = [&](Register x, Register y) {
      return std::array{x, y, t.add(t.multiply(arm[0], x), t.multiply(arm[1], y))};
    };
    if (unknown.quantity == Quantity::fx) return {one, zero, arm[0]};
    if (unknown.quantity == Quantity::fy) return {zero, one, arm[1]};
    if (unknown.quantity == Quantity::N) return force(t.negate((*u)[1]), (*u)[0]);
    if (unknown.quantity == Quantity::F) return force((*u)[0], (*u)[1]);
    return {zero, zero, one};
  }

  std::vector<LoadRegisters> loads() {
    std::vector<LoadRegisters> all;
    const Register zero = tape_.constant(0.0);
    for (const auto& load : m_.loads) {
      LoadRegisters l{load.link, load.at, zero, zero, compile(load.couple), false};
      if (load.force_vector) {
        const Pair force = vector(*load.force_vector);
        l.fx = force[0];
        l.fy = force[1];
      } else if (!load.force.empty()) {
        l.fx = compile(load.force.at(0));
        l.fy = compile(load.force.at(1));
      }
      all.push_back(l);
    }
    for (const mechanism::Action& action : mechanism::actions(m_)) add_action(action, all);
    if (m_.gravity.empty()) return all;
    const Pair g = {compile(m_.gravity.at(0)), compile(m_.gravity.at(1))};
    for (const mechanism::Mass& body : mechanism::masses(m_)) {
      const Register mass = compile(body.mass);
      if (tape_.is_exactly(mass, 0)) continue;
      all.push_back({body.link, body.at, tape_.multiply(mass, g[0]), tape_.multiply(mass, g[1]), zero, true});
    }
    return all;
  }

  /// What a spring or an actuator of known effort exerts on its two links.
  void add_action(const mechanism::Action& action, std::vector<LoadRegisters>& all) {
    auto& t = tape_;
    const Register zero = t.constant(0.0);
    const int spring = action.source == mechanism::Action::Source::spring ? static_cast<int>(action.index) : -1;
    const auto put = [&](int link, std::optional<int> at, Pair force, Register couple) {
      if (link != mechanism::ground) all.push_back({link, at, force[0], force[1], couple, false, true, spring});
    };
    if (action.couple) {
      const Register couple = action.law == mechanism::Action::Law::torsion ? torsion(action) : compile(action.effort);
      put(action.on, std::nullopt, {zero, zero}, couple);
      put(action.by, std::nullopt, {zero, zero}, t.negate(couple));
      return;
    }
    const Pair v = vector(*action.along);
    const Register length = t.sqrt(squared_length(v));
    Register per_length = t.divide(compile(action.effort), length);
    if (action.law == mechanism::Action::Law::linear) {
      const Register stiffness = compile(action.stiffness);
      // Without a free length no length is divided by: it may be zero.
      per_length = action.needs_length(m_)
                       ? t.subtract(stiffness, t.divide(t.multiply(stiffness, compile(action.free_length)), length))
                       : stiffness;
    }
    const Pair force = {t.multiply(per_length, v[0]), t.multiply(per_length, v[1])};
    put(action.on, action.on_point, force, zero);
    put(action.by, action.by_point, {t.negate(force[0]), t.negate(force[1])}, zero);
  }

  Pair direction(int link) {
    if (link == mechanism::ground) return {tape_.constant(1.0), tape_.constant(0.0)};
    const auto& points = m_.links[static_cast<std::size_t>(link)].points;
    return minus(point(points.at(1)), point(points.at(0)));
  }

  /// -c (angle - rest), the angle from `by` to `on` turned back by rest, so that its branch is cut half a turn off it.
  Register torsion(const mechanism::Action& action) {
    auto& t = tape_;
    const Pair a = direction(action.by), b = direction(action.on);
    const Register rest = compile(action.rest);
    const Register c = t.cos(rest), s = t.sin(rest);
    const Pair turned = {t.subtract(t.multiply(c, a[0]), t.multiply(s, a[1])),
                         t.add(t.multiply(s, a[0]), t.multiply(c, a[1]))};
    const Register across = t.subtract(t.multiply(turned[0], b[1]), t.multiply(turned[1], b[0]));
    const Register along = t.add(t.multiply(turned[0], b[0]), t.multiply(turned[1], b[1]));
    return t.negate(t.multiply(compile(action.stiffness), t.atan2(across, along)));
  }

  /// Slack to both ends, of the size of a number: distances over the end, cosines of angles.
  void add_limit(const mechanism::Limit& limit, NumericModel& model) {
    auto& t = tape_;
    const auto at = [&](std::size_t i) { return point(limit.points[i]); };
    const Register lower = compile(limit.lower), upper = compile(limit.upper);
    std::array<std::optional<Register>, 2> slack;
    if (limit.is_angle()) {
      const Pair a = unit(minus(at(0), at(1))), b = unit(minus(at(2), at(1)));
      const Register cosine = t.add(t.multiply(a[0], b[0]), t.multiply(a[1], b[1]));
      if (limit.keeps_lower()) slack[0] = t.subtract(t.cos(lower), cosine);
      if (limit.keeps_upper()) slack[1] = t.subtract(cosine, t.cos(upper));
    } else {
      const Register square = squared_length(minus(at(0), at(1)));
      const Register unit2 = t.square(upper);
      if (limit.keeps_lower()) slack[0] = t.divide(t.subtract(square, t.square(lower)), unit2);
      slack[1] = t.divide(t.subtract(unit2, square), unit2);
    }
    for (const auto& end : slack)
      if (end) model.placed.push_back(t.sqrt(*end));
    model.slack.push_back(slack);
  }

  /// Moment about the end-effector point of a force at p: its factors of fx and fy, (-(y - yE), x - xE).
  Pair lever(int p) {
    const Pair r = minus(point(p), point(m_.end_effector_point));
    return {tape_.negate(r[1]), r[0]};
  }

  void add(SparseEquations& e, int link, int row, int column, Register value) {
    auto& entries = e.rows[3 * static_cast<std::size_t>(link) + static_cast<std::size_t>(row)];
    const auto [place, fresh] = entries.try_emplace(column, value);
    if (!fresh) place->second = tape_.add(place->second, value);
    if (tape_.is_exactly(place->second, 0)) entries.erase(place);
  }

  /// A of method.md section 2, sparse; no right-hand side yet.
  SparseEquations matrix_rows(const NumericModel& model) {
    auto& t = tape_;
    SparseEquations e;
    e.unknowns = static_cast<int>(model.unknowns.size());
    e.rows.resize(3 * m_.links.size());
    const auto accumulate = [&](int link, int row, int column, Register value) { add(e, link, row, column, value); };
    for (int column = 0; column < e.unknowns; ++column) {
      const auto& unknown = model.unknowns[static_cast<std::size_t>(column)];
      const auto& joint = m_.joints[static_cast<std::size_t>(unknown.joint)];
      const std::array<Register, 3> unit = wrench(unknown);
      for (const bool receives : {true, false}) {
        const int link = receives ? joint.to : joint.from;
        if (link == mechanism::ground) continue;
        for (int row = 0; row < 3; ++row) {
          const Register value = unit[static_cast<std::size_t>(row)];
          if (!t.is_exactly(value, 0)) accumulate(link, row, column, receives ? value : t.negate(value));
        }
      }
    }
    return e;
  }

  /// The augmented equations [A | -w_e].
  SparseEquations with_loads(SparseEquations e, const NumericModel& model) {
    auto& t = tape_;
    for (const auto& load : model.loads) {
      Register moment = load.couple;
      if (load.at) {
        const Pair arm = lever(*load.at);
        moment = t.add(moment, t.add(t.multiply(arm[0], load.fx), t.multiply(arm[1], load.fy)));
      }
      add(e, load.link, 0, e.unknowns, t.negate(load.fx));
      add(e, load.link, 1, e.unknowns, t.negate(load.fy));
      add(e, load.link, 2, e.unknowns, t.negate(moment));
    }
    return e;
  }

  const Mechanism& m_;
  NamedTape named_;
  TapeBuilder& tape_;
  std::vector<Pair> points_;
  std::vector<std::optional<Pair>> axes_;  ///< of every joint
};

}  // namespace

NumericModel compile(const Mechanism& m) {
  const auto refuse = [&](const std::string& problem, const std::string& mend) {
    throw core::InputError({m.file, 0, 0}, problem, mend);
  };
  const std::size_t rows = mechanism::equations_per_link(m) * m.links.size(), columns = mechanism::unknowns(m).size();
  if (rows != columns) {
    refuse(std::to_string(rows) + " equations for " + std::to_string(columns) + " unknowns",
           columns > rows ? "remove a joint or an actuator" : "add a joint or an actuator");
  }
  return m.space == mechanism::Space::spatial ? compile_spatial(m) : ModelBuilder(m).build();
}

Posture posture(const NumericModel& model, std::span<const double> pose, std::span<const int> mode) {
  core::ensure(pose.size() == model.box.size(), "a pose has one value for each free coordinate");
  core::ensure(mode.size() == model.dyads.size(), "a working mode has one sign for each dyad");
  std::vector<double> inputs(pose.begin(), pose.end());
  inputs.insert(inputs.end(), mode.begin(), mode.end());
  std::vector<double> registers(static_cast<std::size_t>(model.posture_size));
  run<double, 1>(model.tape, 0, model.posture_size, inputs.data(), registers.data());

  const auto at = [&](Register r) { return registers[static_cast<std::size_t>(r)]; };
  Posture result;
  if (model.gravity) result.gravity = {at((*model.gravity)[0]), at((*model.gravity)[1])};
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const auto& [x, y] = model.points[i];
    result.points.push_back({at(x), at(y)});
    const bool placed = std::isfinite(at(x)) && std::isfinite(at(y));
    if (!placed && !result.unreachable) result.unreachable = static_cast<int>(i);
  }
  for (std::size_t i = 0; i < model.slack.size() && !result.unreachable; ++i)
    for (const bool upper : {false, true})
      if (const auto& end = model.slack[i][upper ? 1 : 0]; end && !(at(*end) >= 0) && !result.broken)
        result.broken = LimitEnd{i, upper, at(*end)};
  for (const auto& axis : model.axes) result.axes.push_back(axis ? Point2{at((*axis)[0]), at((*axis)[1])} : Point2{});
  for (const auto& load : model.loads) {
    const auto& link = model.mechanism.links[static_cast<std::size_t>(load.link)];
    const int place = load.at ? *load.at : link.centre_of_mass;  // a couple acts nowhere: any point of its link will do
    result.loads.push_back({load.link,
                            result.points[static_cast<std::size_t>(place)],
                            {at(load.fx), at(load.fy)},
                            at(load.couple),
                            load.weight,
                            load.inner,
                            load.spring});
  }
  return result;
}

int column_of(const NumericModel& model, mechanism::JointIndex joint, core::Quantity quantity) {
  using core::Quantity;
  if (model.mechanism.space == mechanism::Space::spatial) {
    const auto& across = model.across[static_cast<std::size_t>(joint)];
    const auto component = [](Quantity x, int direction) {
      return static_cast<Quantity>(static_cast<int>(x) + direction);
    };
    if (quantity == Quantity::f1 || quantity == Quantity::f2)
      quantity = component(Quantity::fx, across[quantity == Quantity::f1 ? 0 : 1]);
    if (quantity == Quantity::m1 || quantity == Quantity::m2)
      quantity = component(Quantity::mx, across[quantity == Quantity::m1 ? 0 : 1]);
  }
  for (std::size_t k = 0; k < model.unknowns.size(); ++k)
    if (model.unknowns[k].joint == joint && model.unknowns[k].quantity == quantity) return static_cast<int>(k);
  return -1;
}

std::optional<LimitEnd> tightest_limit(const NumericModel& model, std::span<const double> pose,
                                       std::span<const int> mode) {
  Evaluator<double, 1> evaluator(model, mode, model.posture_size);
  for (std::size_t c = 0; c < pose.size(); ++c) evaluator.input(c, 0) = pose[c];
  evaluator.run_tape();
  std::optional<LimitEnd> tightest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < model.slack.size(); ++i)
    for (const bool upper : {false, true}) {
      const auto& end = model.slack[i][upper ? 1 : 0];
      if (!end || !(evaluator.value(*end, 0) < least)) continue;
      least = evaluator.value(*end, 0);
      tightest = LimitEnd{i, upper, least};
    }
  return tightest;
}

double typical_length(const NumericModel& model, const Posture& p) {
  std::vector<double> lengths;
  for (const auto& link : model.mechanism.links) {
    if (link.points.size() < 2) continue;
    const auto& a = p.points[static_cast<std::size_t>(link.points[0])];
    const auto& b = p.points[static_cast<std::size_t>(link.points[1])];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (std::isfinite(length) && length > 0) lengths.push_back(length);
  }
  if (lengths.empty()) return 1;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

std::vector<int> dyad_signs(const NumericModel& model, const core::TowerNames& tower, const core::WorkingMode& mode) {
  if (tower.roots.empty()) {
    core::ensure(mode.size() == model.dyads.size(), "a working mode has one sign for each dyad");
    return mode;
  }
  core::ensure(mode.size() == tower.roots.size(), "a working mode has one sign for each root of its tower");
  std::vector<int> signs;
  for (const int dyad : model.dyads) {
    const auto& name = model.mechanism.points[static_cast<std::size_t>(dyad)].name;
    const auto root = std::find_if(tower.roots.begin(), tower.roots.end(), [&](const core::RootNames& r) {
      return r.point == name && r.role == core::RootRole::working_mode;
    });
    if (root == tower.roots.end()) {
      throw core::InputError({model.mechanism.file, 0, 0}, "the loci know no working mode of point " + name,
                             "trace the loci of the same mechanism");
    }
    signs.push_back(mode[static_cast<std::size_t>(root - tower.roots.begin())]);
  }
  return signs;
}

}  // namespace clearloci::numeric
