#include "symbolic/locus_problem.hpp"

#include <algorithm>
#include <chrono>
#include <map>

#include "core/errors.hpp"
#include "symbolic/angle_range.hpp"
#include "symbolic/causes.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/family.hpp"
#include "symbolic/margins.hpp"
#include "symbolic/reactions.hpp"
#include "symbolic/straight_lines.hpp"

namespace clearloci::symbolic {
namespace {

using core::FactorRole;
using core::LocusFactor;
using core::Quantity;
using core::Vanishing;
using mechanism::Mechanism;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<std::string> selected_joints(const Mechanism& m, const Selection& selection) {
  std::vector<std::string> known, with_clearance;
  for (const mechanism::Joint& joint : m.joints) {
    known.push_back(joint.name);
    if (joint.clearance) with_clearance.push_back(joint.name);
  }
  for (const std::string& name : selection.joints) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::string list;
    for (const std::string& k : known) list += (list.empty() ? "" : ", ") + k;
    throw core::InputError({m.file}, "there is no joint '" + name + "'", "choose among " + list);
  }
  if (!selection.joints.empty()) return selection.joints;
  return with_clearance.empty() ? known : with_clearance;
}

/// Where contact losses are wanted, so are the zeros of the normal force and the couple of a prismatic joint, at which
/// its contact changes; where backlash is, so is that of an actuator along its axis.
std::vector<Quantity> expanded(const Mechanism& m, std::vector<Quantity> wanted) {
  const auto add = [&wanted](Quantity quantity) {
    if (std::find(wanted.begin(), wanted.end(), quantity) == wanted.end()) wanted.push_back(quantity);
  };
  const std::vector<Quantity> named = wanted;
  for (const Quantity quantity : named) {
    if (quantity == Quantity::f && m.space == mechanism::Space::planar) {
      add(Quantity::N);
      add(Quantity::T);
    }
    if (quantity == Quantity::M) add(Quantity::F);
  }
  return wanted;
}

/// A natural factor that occurs in numerators, with what vanishes on it.
struct SharedFactor {
  Poly natural;
  std::vector<Vanishing> vanishing;
  bool wanted_curve = false;  ///< its curves are to be traced
  bool wanted_point = false;  ///< it takes part in an isolated contact loss
};

/// `pieces`: one an angle, in the order of the coordinates.
Charts charts_of(const Mechanism& m, const std::vector<ChartRange>& pieces) {
  Charts charts(m.coordinates.size());
  auto piece = pieces.begin();
  for (std::size_t i = 0; i < charts.size(); ++i)
    if (m.coordinates[i].angle) charts[i] = (piece++)->chart;
  return charts;
}

/// Every choice of one piece an angle, the last angle's fastest.
std::vector<std::vector<ChartRange>> all_pieces(const Mechanism& m) {
  std::vector<std::vector<ChartRange>> all(1);
  for (const auto& coordinate : m.coordinates) {
    if (!coordinate.angle) continue;
    std::vector<std::vector<ChartRange>> longer;
    for (const auto& chosen : all) {
      for (const ChartRange& range : chart_ranges(m, coordinate)) {
        longer.push_back(chosen);
        longer.back().push_back(range);
      }
    }
    all = std::move(longer);
  }
  return all;
}

FactoredDeterminants determinants_of(const Geometry& geometry, const Family* family) {
  if (family != nullptr)
    if (std::optional<FactoredDeterminants> known = family->at(geometry)) return std::move(*known);
  return factored_determinants(geometry);
}

class Derivation {
 public:
  /// `family`: of which the mechanism is a member; may be null.
  Derivation(const Mechanism& m, const Selection& selection, const std::vector<ChartRange>& pieces,
             const Family* family)
      : mechanism_(m),
        selection_(selection),
        geometry_(m, false, charts_of(m, pieces)),
        determinants_(determinants_of(geometry_, family)),
        elimination_(geometry_),
        causes_(geometry_),
        reactions_(reactions(geometry_, determinants_)),
        lines_(geometry_) {
    result_.problem.tower = lines_.tower();
    result_.problem.joints = selected_joints(m, selection);
    result_.problem.quantities = expanded(m, selection.quantities);
    result_.problem.modes = {file_mode()};
    for (const mechanism::Joint& joint : m.joints) {
      result_.problem.joint_order.push_back(joint.name);
      result_.problem.force_components.push_back(mechanism::force_components(m, joint));
    }
    auto piece = pieces.begin();
    for (const auto& coordinate : m.coordinates) {
      result_.problem.lower.push_back(coordinate.angle ? piece->lower : coordinate.lower);
      result_.problem.upper.push_back(coordinate.angle ? piece->upper : coordinate.upper);
      if (coordinate.angle) ++piece;
    }
    if (!pieces.empty()) result_.problem.charts = geometry_.charts();
  }

  DerivedProblem run() {
    const auto start = Clock::now();
    collect_factors();
    mark_wanted();
    result_.symbolic_seconds = seconds_since(start);
    const auto elimination_start = Clock::now();
    add_reactions();
    if (selection_.min_force || selection_.min_couple) add_margins();
    add_direct_singularities();
    add_boundaries();
    append_roots();
    result_.elimination_seconds = seconds_since(elimination_start);
    return std::move(result_);
  }

 private:
  core::WorkingMode file_mode() const {
    core::WorkingMode mode;
    const std::vector<int> sides = mechanism::working_mode(mechanism_);
    std::size_t next = 0;
    for (const TowerRoot& root : geometry_.roots()) {
      mode.push_back(root.role == core::RootRole::working_mode ? sides[next++] : 1);
    }
    return mode;
  }

  bool wanted(Quantity quantity) const {
    const auto& list = result_.problem.quantities;
    return std::find(list.begin(), list.end(), quantity) != list.end();
  }

  bool selected(const std::string& joint) const {
    const auto& joints = result_.problem.joints;
    return std::find(joints.begin(), joints.end(), joint) != joints.end();
  }

  const std::string& point_name(mechanism::PointIndex point) const {
    return mechanism_.points[static_cast<std::size_t>(point)].name;
  }

  /// How often a factor divides |A|: there the reaction w = N / |A| does not vanish.
  int in_determinant(const Poly& natural) const { return determinants_.determinant.multiplicity(natural); }

  bool vanishes_everywhere(const FactoredPoly& p) const {
    return p.is_zero() || std::any_of(p.factors.begin(), p.factors.end(), [&](const PolyFactor& factor) {
             return elimination_.vanishes_everywhere(factor.poly);
           });
  }

  /// Wanted by itself or as a part of f.
  bool is_asked_for(const std::string& joint, Quantity quantity) const {
    const std::vector<Quantity> parts = core::force_components(result_.problem, joint);
    return wanted(quantity) || (wanted(Quantity::f) && std::find(parts.begin(), parts.end(), quantity) != parts.end());
  }

  void collect_factors() {
    if (vanishes_everywhere(determinants_.determinant)) {
      throw core::InputError({mechanism_.file}, "the equations are singular in every pose: |A| = 0 on the closure",
                             "check the lengths, the joints and which of them are actuated");
    }
    for (const Reaction& reaction : reactions_) {
      const std::string& joint = reaction.joint;
      const FactoredPoly& numerator = reaction.numerator;
      if (vanishes_everywhere(numerator)) {
        if (selected(joint) && is_asked_for(joint, reaction.quantity)) {
          result_.notes.push_back(reaction.name + " is zero in every pose: no load reaches it");
        }
        result_.problem.always_zero.push_back({joint, reaction.quantity});
        continue;
      }
      for (const PolyFactor& factor : numerator.factors) {
        const int multiplicity = factor.multiplicity - in_determinant(factor.poly);
        if (multiplicity <= 0) continue;
        auto known = std::find_if(factors_.begin(), factors_.end(),
                                  [&](const SharedFactor& f) { return f.natural == factor.poly; });
        if (known == factors_.end()) known = factors_.insert(known, {factor.poly, {}});
        known->vanishing.push_back({joint, reaction.quantity, multiplicity});
      }
    }
  }

  std::vector<std::size_t> factors_of(const std::string& joint, Quantity quantity) const {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < factors_.size(); ++i) {
      const auto& v = factors_[i].vanishing;
      if (std::any_of(v.begin(), v.end(),
                      [&](const Vanishing& w) { return w.joint == joint && w.quantity == quantity; })) {
        list.push_back(i);
      }
    }
    return list;
  }

  bool is_always_zero(const std::string& joint, Quantity quantity) const {
    const auto& list = result_.problem.always_zero;
    return std::any_of(list.begin(), list.end(),
                       [&](const Vanishing& v) { return v.joint == joint && v.quantity == quantity; });
  }

  void want(const std::vector<std::size_t>& list) {
    for (const std::size_t i : list) factors_[i].wanted_curve = true;
  }

  void mark_wanted() {
    for (const std::string& joint : result_.problem.joints) {
      for (const Quantity component : core::all_quantities) {
        if (component != Quantity::f && wanted(component)) want(factors_of(joint, component));
      }
      if (wanted(Quantity::f)) mark_contact_loss(joint);
    }
  }

  /// f_J = 0 is two equations, or three in space: its curves lie where factors of all of them share a curve.
  void mark_contact_loss(const std::string& joint) {
    std::vector<std::vector<std::size_t>> components;
    for (const Quantity component : core::force_components(result_.problem, joint))
      if (!is_always_zero(joint, component)) components.push_back(factors_of(joint, component));
    if (components.size() == 1) want(components.front());
    if (components.size() < 2) return;
    for (const std::size_t i : components.front()) {
      std::vector<std::size_t> sharing = {i};
      bool everywhere = true;
      for (std::size_t c = 1; c < components.size(); ++c) {
        const std::size_t before = sharing.size();
        for (const std::size_t k : components[c])
          if (i == k || (!never_both(i, k) && may_share_curve(i, k))) sharing.push_back(k);
        everywhere = everywhere && sharing.size() > before;
      }
      if (everywhere) want(sharing);
    }
    // Two equations in the plane have isolated zeros besides.
    if (mechanism_.space == mechanism::Space::spatial) return;
    const auto in = [](const std::vector<std::size_t>& list, std::size_t f) {
      return std::find(list.begin(), list.end(), f) != list.end();
    };
    for (const std::size_t i : components[0]) {
      for (const std::size_t k : components[1]) {
        // Where a factor of both vanishes there is a curve of contact loss anyway.
        if (in(components[1], i) || in(components[0], k) || never_both(i, k)) continue;
        factors_[i].wanted_point = factors_[k].wanted_point = true;
      }
    }
  }

  /// Components of a vector of constant length, such as a link's, do not vanish together.
  bool never_both(std::size_t i, std::size_t k) {
    const auto [known, fresh] = never_both_.try_emplace({i, k}, false);
    if (!fresh) return known->second;
    const Poly &a = factors_[i].natural, &b = factors_[k].natural;
    if (a.total_degree() > 1 || b.total_degree() > 1) return false;
    const std::optional<core::Rational> length2 = elimination_.constant_over_tower(a * a + b * b);
    return known->second = length2 && *length2 != 0;
  }

  bool may_share_curve(std::size_t i, std::size_t k) {
    const auto [known, fresh] = may_share_.try_emplace({i, k}, false);
    // Curves are told to be the same by their polynomials: where one is too large to be had, norms say nothing of use.
    if (fresh && !is_heavy(i) && !is_heavy(k)) known->second = elimination_.may_share_curve(on_line(i), on_line(k));
    return known->second;
  }

  bool is_heavy(std::size_t factor) {
    const auto [known, fresh] = heavy_.try_emplace(factor, false);
    if (fresh) known->second = elimination_.is_too_heavy(sheet_of(factor));
    return known->second;
  }

  const Poly& sheet_of(std::size_t factor) {
    const auto known = sheets_.find(factor);
    if (known != sheets_.end()) return known->second;
    return sheets_.emplace(factor, elimination_.over_tower(factors_[factor].natural)).first->second;
  }

  const Poly& on_line(std::size_t factor) {
    const auto known = on_line_.find(factor);
    if (known != on_line_.end()) return known->second;
    return on_line_.emplace(factor, elimination_.norm_on_line(sheet_of(factor))).first->second;
  }

  std::string text(const Poly& p) const { return core::to_string(p.plain(), geometry_.ring().names()); }

  /// Whether a factor over the tower is one of |A|: where both vanish the reaction stays finite and is no zero.
  bool divides_determinant(const Poly& sheet) {
    if (determinant_sheets_.empty()) {
      for (const PolyFactor& factor : determinants_.determinant.factors)
        for (const SheetFactor& part : elimination_.sheet_factors(elimination_.over_tower(factor.poly), false))
          determinant_sheets_.push_back(part.sheet);
    }
    return std::find(determinant_sheets_.begin(), determinant_sheets_.end(), sheet) != determinant_sheets_.end();
  }

  /// `natural`: the polynomial that gave the sheet; null where there is none.
  void add(FactorRole role, const Poly* natural, const Poly& sheet, bool with_implicit, LocusFactor common,
           bool without_determinant = false) {
    common.role = role;
    const std::vector<int> variables = geometry_.tower_variables();
    const std::vector<int> free(variables.begin(), variables.begin() + geometry_.coordinates());
    const std::vector<SheetFactor> parts = elimination_.sheet_factors(sheet, with_implicit);
    // Where the sheet splits, the natural form has the zeros of all parts.
    if (natural != nullptr && parts.size() == 1 && parts.front().multiplicity == 1) common.line = lines_.of(*natural);
    for (const SheetFactor& part : parts) {
      if (without_determinant && divides_determinant(part.sheet)) continue;
      LocusFactor factor = common;
      factor.sheet = core::scaled_for_doubles(part.sheet.plain(variables));
      for (Vanishing& v : factor.vanishing) v.multiplicity *= part.multiplicity;
      for (const Poly& curve : part.implicit) factor.implicit.push_back(curve.plain(free));
      factor.implicit_too_heavy = part.too_heavy;
      result_.problem.factors.push_back(std::move(factor));
    }
  }

  void add_reactions() {
    for (const SharedFactor& shared : factors_) {
      if (!shared.wanted_curve && !shared.wanted_point) continue;
      LocusFactor factor;
      factor.expression = text(shared.natural);
      factor.cause = causes_.of(shared.natural);
      factor.vanishing = shared.vanishing;
      // A natural factor of |A| has been counted against it already.
      add(FactorRole::reaction, &shared.natural, sheet_of(static_cast<std::size_t>(&shared - factors_.data())),
          shared.wanted_curve, factor, in_determinant(shared.natural) == 0);
    }
  }

  void add_direct_singularities() {
    for (const PolyFactor& part : determinants_.determinant.factors) {
      LocusFactor factor;
      factor.expression = text(part.poly);
      factor.cause = causes_.of(part.poly);
      add(FactorRole::direct_singularity, &part.poly, elimination_.over_tower(part.poly), true, factor);
    }
  }

  void add_boundaries() {
    for (const TowerRoot& root : geometry_.roots()) {
      if (root.role != core::RootRole::working_mode) continue;
      LocusFactor factor;
      const auto& form = mechanism_.points[static_cast<std::size_t>(root.point)].form;
      if (const auto* dyad = std::get_if<mechanism::DyadPoint>(&form)) {
        factor.expression = text(causes_.stretched(root.point, *dyad));
        factor.cause = causes_.stretched_wording(root.point, *dyad);
      } else {
        const auto& slider = std::get<mechanism::SliderPoint>(form);
        const Poly across = causes_.perpendicular(slider.from, root.point, slider.along);
        factor.expression = text(across);
        factor.cause = "line " + point_name(slider.from) + "-" + point_name(root.point) +
                       " perpendicular to the path of " + point_name(root.point);
      }
      add(FactorRole::workspace_boundary, nullptr, root.square, true, factor);
    }
    const std::vector<int> variables = geometry_.tower_variables();
    const std::vector<int> free(variables.begin(), variables.begin() + geometry_.coordinates());
    for (const Poly& denominator : elimination_.denominator_factors()) {
      LocusFactor factor;
      factor.role = FactorRole::construction;
      factor.sheet = core::scaled_for_doubles(denominator.plain(variables));
      factor.implicit = {denominator.plain(free)};
      result_.problem.factors.push_back(std::move(factor));
    }
  }

  /// False: the squared margin is not a single curve, or |w| is constant.
  bool add_senses(const TwoSenses& senses, const Poly& squared, LocusFactor common) {
    const std::vector<SheetFactor> parts = elimination_.sheet_factors(squared, true);
    if (parts.size() != 1 || parts.front().multiplicity != 1) return false;
    const Poly t = Poly::variable(geometry_.ring(), geometry_.auxiliary());
    const auto parts_of = [&](const Poly& natural) {
      return elimination_.over_tower(natural).coefficients(geometry_.auxiliary());
    };
    // Coefficients of t^0 and t^1 over the tower have one denominator.
    const std::vector<Poly> sides = parts_of(senses.size * t + senses.bound), length = parts_of(senses.square + t);
    if (sides.size() != 2 || length.size() != 2 || length[0].is_constant()) return false;
    // |w| = root / length[1], root^2 = length[0] length[1].
    Poly left = sides[1], right = sides[0] * length[1];
    const Poly shared = gcd(left, right);
    left = left.exact_quotient(shared);
    right = right.exact_quotient(shared);

    const std::vector<int> variables = geometry_.tower_variables();
    // A root of about the size of the coordinates: numerical steps along the curve weigh it against them.
    const core::Polynomial unscaled = (length[0] * length[1]).plain(variables);
    core::Polynomial square = core::scaled_for_doubles(unscaled);
    core::Rational gained = square.terms.front().coefficient / unscaled.terms.front().coefficient;
    if (!rational_root(gained)) {
      square = square + square;
      gained *= 2;
    }
    left = left.scaled(1 / *rational_root(gained));
    const auto known = std::find_if(more_roots_.begin(), more_roots_.end(),
                                    [&](const core::Root& root) { return root.square == square; });
    const auto index = static_cast<int>(variables.size() + static_cast<std::size_t>(known - more_roots_.begin()));
    if (known == more_roots_.end())
      more_roots_.push_back({"s" + std::to_string(result_.problem.tower.roots.size() + more_roots_.size() + 1), "",
                             core::RootRole::length, square});
    common.role = FactorRole::margin;
    for (const Poly& curve : parts.front().implicit)
      common.implicit.push_back(
          curve.plain(std::vector<int>(variables.begin(), variables.begin() + geometry_.coordinates())));
    common.implicit_too_heavy = parts.front().too_heavy;
    for (const int sense : {1, -1}) {
      LocusFactor factor = common;
      const core::Polynomial root = core::variable_polynomial(index + 1, index);
      const auto widened = [&](const Poly& p) { return core::with_variables(p.plain(variables), index + 1); };
      factor.sheet = core::scaled_for_doubles(sense > 0 ? widened(left) * root - widened(right)
                                                        : widened(left) * root + widened(right));
      factor.expression = "(" + text(senses.size) + ")*sqrt(" + text(senses.square) + (sense > 0 ? ") - (" : ") + (") +
                          text(senses.bound) + ")";
      result_.problem.factors.push_back(std::move(factor));
    }
    return true;
  }

  /// The roots that margins brought, into the tower and everything that is written over it.
  void append_roots() {
    if (more_roots_.empty()) return;
    core::LocusProblem& problem = result_.problem;
    core::RootTower& tower = problem.tower;
    tower.roots.insert(tower.roots.end(), more_roots_.begin(), more_roots_.end());
    const auto widen = [&](core::Polynomial& p) { p = core::with_variables(p, tower.variables()); };
    for (core::Root& root : tower.roots) widen(root.square);
    for (core::Polynomial& denominator : tower.denominators) widen(denominator);
    for (core::DyadBase& base : tower.bases) {
      widen(base.x);
      widen(base.y);
    }
    for (LocusFactor& factor : problem.factors) widen(factor.sheet);
    for (core::WorkingMode& mode : problem.modes) mode.resize(tower.roots.size(), 1);
  }

  void add_margins() {
    for (const Margin& margin :
         margins(geometry_, elimination_, determinants_.determinant, reactions_, selection_, result_.problem.joints)) {
      const bool force = margin.quantity == Quantity::f;
      std::string names;
      LocusFactor factor;
      for (const std::string& joint : margin.joints) {
        if (!names.empty()) names += ", ";
        names += joint;
        factor.vanishing.push_back({joint, margin.quantity, 1});
      }
      const std::string bound = core::to_string(margin.bound);
      factor.expression = text(margin.natural);
      factor.cause = (force ? "contact force of " : "couple of ") + names + " at " + bound + (force ? " N" : " N m");
      const Poly sheet = elimination_.over_tower(margin.natural);
      if (sheet.is_zero())
        result_.notes.push_back(factor.cause + " in every pose");
      else if (!margin.senses || !add_senses(*margin.senses, sheet, factor))
        add(FactorRole::margin, &margin.natural, sheet, true, factor);
    }
  }

  const Mechanism& mechanism_;
  const Selection& selection_;
  Geometry geometry_;
  FactoredDeterminants determinants_;
  Elimination elimination_;
  Causes causes_;
  std::vector<Reaction> reactions_;
  StraightLines lines_;
  std::vector<SharedFactor> factors_;
  std::vector<Poly> determinant_sheets_;
  std::map<std::pair<std::size_t, std::size_t>, bool> never_both_, may_share_;  ///< by factors
  std::map<std::size_t, Poly> sheets_, on_line_;                                ///< by factor
  std::map<std::size_t, bool> heavy_;
  std::vector<core::Root> more_roots_;  ///< written in the coordinates and the roots of the geometry
  DerivedProblem result_;
};

std::vector<DerivedProblem> problems_of(const Mechanism& mechanism, const Selection& selection, const Family* family) {
  std::vector<DerivedProblem> problems;
  for (const std::vector<ChartRange>& pieces : all_pieces(mechanism)) {
    const auto start = Clock::now();
    Derivation derivation(mechanism, selection, pieces, family);
    const double preparation = seconds_since(start);
    problems.push_back(derivation.run());
    problems.back().symbolic_seconds += preparation;
  }
  return problems;
}

}  // namespace

std::vector<DerivedProblem> locus_problems(const Mechanism& mechanism, const Selection& selection) {
  return problems_of(mechanism, selection, nullptr);
}

LocusFamily::LocusFamily(const Mechanism& member) : family_(std::make_unique<const Family>(member)) {}
LocusFamily::~LocusFamily() = default;
LocusFamily::LocusFamily(LocusFamily&&) noexcept = default;
LocusFamily& LocusFamily::operator=(LocusFamily&&) noexcept = default;

std::vector<DerivedProblem> LocusFamily::problems(const Mechanism& member, const Selection& selection) const {
  return problems_of(member, selection, family_.get());
}

namespace {

void ensure_one_chart(const Mechanism& mechanism) {
  for (const auto& coordinate : mechanism.coordinates) {
    if (coordinate.angle && chart_ranges(mechanism, coordinate).size() > 1)
      throw core::InputError({mechanism.file},
                             "the range of the angle '" + coordinate.name + "' needs more than one chart",
                             "keep it between two odd multiples of 90 deg");
  }
}

}  // namespace

DerivedProblem locus_problem(const Mechanism& mechanism, const Selection& selection) {
  ensure_one_chart(mechanism);
  return std::move(locus_problems(mechanism, selection).front());
}

DerivedProblem locus_problem(const Mechanism& member, const Selection& selection, const LocusFamily& family) {
  ensure_one_chart(member);
  return std::move(family.problems(member, selection).front());
}

}  // namespace clearloci::symbolic
