#include "symbolic/locus_problem.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <map>

#include "core/errors.hpp"
#include "core/fold.hpp"
#include "core/shown_units.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"
#include "symbolic/algebra_turn.hpp"
#include "symbolic/angle_range.hpp"
#include "symbolic/causes.hpp"
#include "symbolic/demands.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/effort_limits.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/family.hpp"
#include "symbolic/guide_ends.hpp"
#include "symbolic/limits.hpp"
#include "symbolic/margin_nodes.hpp"
#include "symbolic/margins.hpp"
#include "symbolic/newton_euler.hpp"
#include "symbolic/preload.hpp"
#include "symbolic/preload_constraints.hpp"
#include "symbolic/reactions.hpp"
#include "symbolic/shared_curves.hpp"
#include "symbolic/sheets.hpp"
#include "symbolic/singular_modes.hpp"
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

/// A natural factor that occurs in numerators, with what vanishes on it.
struct SharedFactor {
  Poly natural;
  std::vector<Vanishing> vanishing;
  bool wanted_curve = false;  ///< its curves are to be traced
  bool wanted_point = false;  ///< it takes part in an isolated contact loss
  bool wanted_order = false;  ///< its order tells what a reaction does where |A| vanishes too
};

/// A factor of |A| over the tower.
struct DeterminantPart {
  const PolyFactor* natural = nullptr;
  SheetFactor sheet;
  int multiplicity = 1;              ///< in |A|
  bool alone = true;                 ///< the natural factor is this, once, but for denominators
  std::vector<Vanishing> cancelled;  ///< LocusFactor::cancelled
  bool may_be_idle = false;
  bool chosen = false;  ///< other efforts free, A is regular there
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
             const Family* family, SheetGeometry sheet)
      : mechanism_(m),
        selection_(selection),
        modes_(std::move(sheet.modes)),
        geometry_(std::move(sheet.geometry)),
        determinants_(determinants_of(geometry_, family)),
        elimination_(geometry_),
        causes_(geometry_, &determinants_.equations),
        lines_(geometry_) {
    write_reactions();
    lines_.know(determinants_.forms);
    result_.problem.tower = lines_.tower();
    state_demands(m, selection, result_.problem);
    for (const Sides& sides : modes_) result_.problem.modes.push_back(mode_of(sides));
    auto piece = pieces.begin();
    for (const auto& coordinate : m.coordinates) {
      result_.problem.lower.push_back(coordinate.angle ? piece->lower : coordinate.lower);
      result_.problem.upper.push_back(coordinate.angle ? piece->upper : coordinate.upper);
      if (coordinate.angle) ++piece;
    }
    if (!pieces.empty()) result_.problem.charts = geometry_.charts();
  }

  /// What makes |A| vanish in every pose of the modes; nothing where it does not.
  std::optional<std::string> singular() const {
    return vanishing_factor(determinants_.determinant, geometry_, elimination_, causes_);
  }

  /// "B1 right, B2 right where x > 0".
  std::string words(const Sides& sides) const {
    std::string list = mode_words(mechanism_, sides);
    for (std::size_t k = 0; k < geometry_.folds().size(); ++k)
      list += (k == 0 ? " where " : " and ") + text(geometry_.folds()[k].where) + " > 0";
    return list;
  }
  const std::vector<Sides>& modes() const { return modes_; }
  DerivedProblem without_modes() const {
    DerivedProblem empty;
    empty.problem.tower = result_.problem.tower;
    empty.problem.charts = result_.problem.charts;
    empty.problem.lower = result_.problem.lower;
    empty.problem.upper = result_.problem.upper;
    return empty;
  }
  bool has_dependent_roots() const { return geometry_.has_dependent_roots(); }

  DerivedProblem run() {
    const auto start = Clock::now();
    collect_factors();
    mark_wanted();
    result_.symbolic_seconds = seconds_since(start);
    const auto elimination_start = Clock::now();
    take_determinant_apart();
    mark_orders();
    add_reactions();
    add_moving_guides();
    if (preload_.joints.empty() && (selection_.min_force || selection_.min_couple)) add_margins();
    if (!preload_.joints.empty() || mechanism::has_effort_bounds(mechanism_)) add_preload();
    add_direct_singularities();
    add_boundaries();
    add_undirected();
    append_roots();
    result_.elimination_seconds = seconds_since(elimination_start);
    result_.in_file = std::move(in_file_);
    return std::move(result_);
  }

 private:
  core::WorkingMode mode_of(const Sides& sides) const {
    core::WorkingMode mode;
    std::size_t next = 0;
    for (const TowerRoot& root : geometry_.roots()) {
      mode.push_back(root.role == core::RootRole::working_mode ? sides[next++] : 1);
    }
    return mode;
  }

  /// Of free efforts without a value what vanishes at all of them takes the place of what vanishes.
  void write_reactions() {
    if (!determinants_.equations.free_joints.empty()) {
      preload_ = preload_columns(geometry_, elimination_, determinants_);
      reactions_ = at_every_effort(preload_);
      return;
    }
    reactions_ = reactions(geometry_, determinants_);
    preload_.reactions = {reactions_};
    guides_ = guides(geometry_, elimination_, reactions_);
    add_pressing_reactions();
    for (const Guide& guide : guides_)
      for (Reaction& end : end_reactions(guide, determinants_.determinant)) reactions_.push_back(std::move(end));
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

  /// Of pins in space, where contact losses or what they are made of are asked for.
  void add_pressing_reactions() {
    const auto asked = [&](Quantity quantity) {
      return std::find(selection_.quantities.begin(), selection_.quantities.end(), quantity) !=
             selection_.quantities.end();
    };
    if (!asked(Quantity::f) && !asked(Quantity::f1) && !asked(Quantity::f2)) return;
    for (Reaction& part : pressing_reactions(geometry_, determinants_)) reactions_.push_back(std::move(part));
  }

  /// Where f1 and f2 of a joint say nothing of its force.
  void add_undirected() {
    for (const mechanism::Joint& joint : mechanism_.joints) {
      if (!mechanism::presses_across_axis(mechanism_, joint) || !selected(joint.name)) continue;
      GiNaC::ex where;
      if (has_pressing_parts(mechanism_, joint)) {
        where = across_pin(geometry_, joint).squared;
      } else {
        const std::vector<GiNaC::ex> u = geometry_.vector(joint.axes.at(0));
        where = u[across_component(geometry_, u)];
      }
      const Poly natural = geometry_.poly(where);
      const Poly sheet = elimination_.over_tower(natural);
      if (sheet.is_constant()) continue;
      LocusFactor factor;
      factor.role = FactorRole::construction;
      factor.vanishing = {{joint.name, Quantity::f, 1}};
      factor.sheet = core::scaled_for_doubles(sheet.plain(geometry_.tower_variables()));
      factor.line = lines_.of(natural);
      result_.problem.factors.push_back(std::move(factor));
    }
  }

  /// How often a factor divides |A|: so often it is divided out of w = N / |A|.
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
    for (const Reaction& reaction : reactions_) {
      const std::string& joint = reaction.joint;
      const FactoredPoly& numerator = reaction.numerator;
      if (vanishes_everywhere(numerator)) {
        if (selected(joint) && is_asked_for(joint, reaction.quantity)) {
          result_.notes.push_back(reaction.name + " is zero in every pose under these loads");
        }
        result_.problem.always_zero.push_back({joint, reaction.quantity});
        continue;
      }
      result_.problem.reactions.push_back({joint, reaction.quantity});
      for (const PolyFactor& factor : numerator.factors) {
        const int shared = std::min(factor.multiplicity, in_determinant(factor.poly));
        if (shared > 0) cancelled_.push_back({factor.poly, {joint, reaction.quantity, shared}});
        const int multiplicity = factor.multiplicity - shared;
        if (multiplicity == 0) continue;
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
    // Over three coordinates they vanish together along curves and at points besides.
    if (result_.problem.tower.coordinates.size() == 3 && components.size() > 2)
      for (const std::vector<std::size_t>& own : components)
        for (const std::size_t i : own) factors_[i].wanted_point = true;
    // Two equations over a plane have isolated zeros besides, three in general none.
    if (components.size() > 2) return;
    const auto in = [](const std::vector<std::size_t>& list, std::size_t f) {
      return std::find(list.begin(), list.end(), f) != list.end();
    };
    for (const std::size_t i : components[0]) {
      for (const std::size_t k : components[1]) {
        // Where a factor of both vanishes there is a curve of contact loss anyway.
        if (in(components[1], i) || in(components[0], k) || never_both(i, k) || meet_nowhere(i, k)) continue;
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
    if (elimination_.are_components_of_link(a, b)) return known->second = true;
    const Poly squared = a * a + b * b;
    if (!shared_.may_be_constant(squared)) return false;
    const std::optional<core::Rational> length2 = elimination_.constant_over_tower(squared);
    return known->second = length2 && *length2 != 0;
  }

  bool may_share_curve(std::size_t i, std::size_t k) {
    const auto [known, fresh] = may_share_.try_emplace({i, k}, false);
    // Curves are told to be the same by their polynomials: where one is too large to be had, norms say nothing of use.
    if (fresh && !is_heavy(i) && !is_heavy(k)) known->second = Elimination::may_share_curve(on_line(i), on_line(k));
    return known->second;
  }

  /// With one coordinate a curve is a point: what shares none is never zero together.
  bool meet_nowhere(std::size_t i, std::size_t k) {
    return geometry_.coordinates() == 1 && !elimination_.has_angle_over_tower(factors_[i].natural) &&
           !elimination_.has_angle_over_tower(factors_[k].natural) &&
           !Elimination::may_share_curve(on_line(i), on_line(k));
  }

  bool is_heavy(std::size_t factor) {
    const auto [known, fresh] = heavy_.try_emplace(factor, false);
    if (fresh) known->second = elimination_.is_too_heavy_over_tower(factors_[factor].natural);
    return known->second;
  }

  const Poly& sheet_of(std::size_t factor) {
    const auto known = sheets_.find(factor);
    if (known != sheets_.end()) return known->second;
    return sheets_.emplace(factor, elimination_.over_tower(factors_[factor].natural)).first->second;
  }

  const ResiduePoly& on_line(std::size_t factor) {
    const auto known = on_line_.find(factor);
    if (known != on_line_.end()) return known->second;
    return on_line_.emplace(factor, elimination_.norm_on_line(factors_[factor].natural)).first->second;
  }

  /// In the coordinates of the frame, noted with those of the file.
  std::string text(const Poly& p) const {
    std::string inside = core::to_string(p.plain(), geometry_.ring().names());
    if (!mechanism_.frame) return inside;
    if (std::string outside = text_in_file(p); outside != inside) in_file_.emplace(inside, std::move(outside));
    return inside;
  }

  std::string text_in_file(const Poly& p) const {
    const mechanism::Frame& frame = *mechanism_.frame;
    Poly outside = p;
    for (int i = 0; i < geometry_.coordinates(); ++i)
      if (!geometry_.charts()[static_cast<std::size_t>(i)])
        outside = shifted(outside, i, frame.from[static_cast<std::size_t>(i)], frame.scale);
    for (const InverseLength& length : geometry_.inverse_lengths())
      outside = shifted(outside, length.variable, 0, 1 / frame.scale);
    for (const ConstructedPoint& point : geometry_.constructed()) {
      outside = shifted(outside, point.x, frame.origin[0], frame.scale);
      outside = shifted(outside, point.y, frame.origin[1], frame.scale);
      if (point.z >= 0) outside = shifted(outside, point.z, frame.origin[2], frame.scale);
    }
    if (p.primitive() == p) outside = outside.primitive();
    return core::to_string(outside.plain(), geometry_.ring().names());
  }

  /// p with (v - from) / scale in the place of v.
  static Poly shifted(const Poly& p, int variable, const core::Rational& from, const core::Rational& scale) {
    const std::vector<Poly> powers = p.coefficients(variable);
    if (powers.size() <= 1) return p;
    const Poly way = (Poly::variable(p.ring(), variable) - Poly(p.ring(), from)).scaled(1 / scale);
    Poly sum(p.ring());
    for (auto power = powers.rbegin(); power != powers.rend(); ++power) sum = sum * way + *power;
    return sum;
  }

  /// Of |A| and of what is asked for; a certificate claims that they have no zeros. They alone of `rest` have sheets.
  void keep_without_zeros(FactorRole role, const std::string& expression, const std::vector<Poly>& sheets) {
    if (result_.problem.tower.coordinates.size() != 2) return;
    for (const Poly& sheet : sheets) {
      LocusFactor factor;
      factor.role = role;
      factor.expression = expression;
      factor.sheet = core::scaled_for_doubles(sheet.plain(geometry_.tower_variables()));
      result_.rest.push_back(std::move(factor));
    }
  }

  void take_determinant_apart() {
    for (const PolyFactor& factor : determinants_.determinant.factors) {
      std::vector<Poly> without_zeros;
      std::vector<SheetFactor> sheets =
          elimination_.sheet_factors(elimination_.over_tower(factor.poly), true, &without_zeros);
      keep_without_zeros(FactorRole::direct_singularity, text(factor.poly), without_zeros);
      const bool alone = sheets.size() == 1 && sheets.front().multiplicity == 1;
      const bool chosen = is_singular_by_choice(preload_, mechanism_, factor.poly, selection_.controlled);
      for (SheetFactor& sheet : sheets) {
        const int times = sheet.multiplicity;
        DeterminantPart part{&factor, std::move(sheet), factor.multiplicity * times, alone, {}};
        part.chosen = chosen;
        for (const auto& [natural, vanishing] : cancelled_)
          if (natural == factor.poly)
            part.cancelled.push_back({vanishing.joint, vanishing.quantity, vanishing.multiplicity * times});
        determinant_parts_.push_back(std::move(part));
      }
    }
  }

  /// What a reaction does on a curve of |A| = 0 is told by the orders of its factors there (method.md section 10):
  /// those that may vanish on such a curve are wanted, of the reactions asked for; and of all of them where it may be
  /// that none grows without bound.
  void mark_orders() {
    for (DeterminantPart& part : determinant_parts_) {
      if (part.sheet.too_heavy) continue;
      std::vector<std::size_t> involved;
      for (std::size_t i = 0; i < factors_.size(); ++i)
        if (shared_.may_vanish_along(part.sheet.implicit, part.sheet.sheet, factors_[i].natural)) involved.push_back(i);
      const auto among = [](const std::vector<Vanishing>& list, const Vanishing& reaction) {
        return std::any_of(list.begin(), list.end(), [&](const Vanishing& v) {
          return v.joint == reaction.joint && v.quantity == reaction.quantity;
        });
      };
      const auto is_finite_perhaps = [&](const Vanishing& reaction) {
        return among(part.cancelled, reaction) || std::any_of(involved.begin(), involved.end(), [&](std::size_t i) {
                 return among(factors_[i].vanishing, reaction);
               });
      };
      const auto& all = result_.problem.reactions;
      part.may_be_idle = std::all_of(all.begin(), all.end(), [&](const Vanishing& reaction) {
        return core::is_guide_end(reaction.quantity) || is_finite_perhaps(reaction);  // ends are made of N and T
      });
      for (const std::size_t i : involved) {
        const auto& own = factors_[i].vanishing;
        factors_[i].wanted_order = factors_[i].wanted_order || part.may_be_idle ||
                                   std::any_of(own.begin(), own.end(), [&](const Vanishing& v) {
                                     return selected(v.joint) && is_asked_for(v.joint, v.quantity);
                                   });
      }
    }
  }

  /// Takes what divides |A| too out of what vanishes on a factor over the tower: reactions are quotients.
  std::vector<Vanishing> without_determinant(const Poly& sheet, std::vector<Vanishing> vanishing) {
    for (DeterminantPart& part : determinant_parts_) {
      if (!(part.sheet.sheet == sheet)) continue;
      for (Vanishing& v : vanishing) {
        auto known = std::find_if(part.cancelled.begin(), part.cancelled.end(), [&](const Vanishing& own) {
          return own.joint == v.joint && own.quantity == v.quantity;
        });
        if (known == part.cancelled.end()) known = part.cancelled.insert(known, {v.joint, v.quantity, 0});
        const int shared = std::min(v.multiplicity, part.multiplicity - known->multiplicity);
        known->multiplicity += shared;
        v.multiplicity -= shared;
        if (known->multiplicity == 0) part.cancelled.erase(known);
      }
    }
    std::erase_if(vanishing, [](const Vanishing& v) { return v.multiplicity == 0; });
    return vanishing;
  }

  /// `natural`: the polynomial that gave the sheet; null where there is none.
  void add(FactorRole role, const Poly* natural, const Poly& sheet, bool with_implicit, LocusFactor common) {
    common.role = role;
    const std::vector<int> variables = geometry_.tower_variables();
    std::vector<Poly> without_zeros;
    const std::vector<SheetFactor> parts = elimination_.sheet_factors(sheet, with_implicit, &without_zeros);
    if (role == FactorRole::reaction) keep_without_zeros(role, common.expression, without_zeros);
    // Where the sheet splits, the natural form has the zeros of all parts.
    if (natural != nullptr && parts.size() == 1 && parts.front().multiplicity == 1) common.line = lines_.of(*natural);
    for (const SheetFactor& part : parts) {
      LocusFactor factor = common;
      for (Vanishing& v : factor.vanishing) v.multiplicity *= part.multiplicity;
      if (role == FactorRole::reaction) {
        factor.vanishing = without_determinant(part.sheet, std::move(factor.vanishing));
        if (factor.vanishing.empty()) continue;
      }
      factor.sheet = core::scaled_for_doubles(part.sheet.plain(variables));
      put_implicit(part, factor);
      result_.problem.factors.push_back(std::move(factor));
    }
  }

  void put_implicit(const SheetFactor& part, LocusFactor& factor) const {
    const std::vector<int> variables = geometry_.tower_variables();
    const std::vector<int> free(variables.begin(), variables.begin() + geometry_.coordinates());
    for (const Poly& curve : part.implicit) factor.implicit.push_back(curve.plain(free));
    factor.implicit_too_heavy = factor.implicit_too_heavy || part.too_heavy;
  }

  void add_reactions() {
    for (const SharedFactor& shared : factors_) {
      LocusFactor factor;
      if (!shared.wanted_curve && !shared.wanted_point && !shared.wanted_order) {
        const bool asked_for = std::any_of(shared.vanishing.begin(), shared.vanishing.end(), [&](const Vanishing& v) {
          return selected(v.joint) && is_asked_for(v.joint, v.quantity);
        });
        if (!asked_for || result_.problem.tower.coordinates.size() != 2) continue;
        factor.expression = text(shared.natural);
        factor.line = lines_.of(shared.natural);
        result_.rest.push_back(std::move(factor));
        continue;
      }
      factor.expression = text(shared.natural);
      factor.cause = causes_.of(shared.natural);
      factor.vanishing = shared.vanishing;
      add(FactorRole::reaction, &shared.natural, sheet_of(static_cast<std::size_t>(&shared - factors_.data())),
          shared.wanted_curve, factor);
    }
  }

  /// Where r + 1 constraints on r free efforts hold together. Curves on which |A| or a reaction vanishes at every
  /// effort are there already.
  void add_preload() {
    std::vector<std::string>& notes = result_.notes;
    notes.insert(notes.end(), preload_.notes.begin(), preload_.notes.end());
    if (!preload_.joints.empty() &&
        (selection_.min_force || (selection_.min_couple && mechanism_.space == mechanism::Space::spatial)))
      notes.emplace_back(
          "with free efforts no curves are traced on which a contact force, or in space a couple, has its least size: "
          "the efforts of a zone are those at its sample");
    if (!preload_.joints.empty() && std::any_of(mechanism_.joints.begin(), mechanism_.joints.end(),
                                                [](const mechanism::Joint& own) { return own.meshing.has_value(); }))
      notes.emplace_back("flanks of gears and spans of belts bound no preload here");
    const std::size_t efforts = preload_.joints.size();
    const std::string motors = preload_.motors(mechanism_);
    const PreloadDeterminants all = preload_determinants(
        geometry_.ring(), determinants_.determinant, efforts,
        preload_constraints(geometry_, preload_, determinants_.determinant, result_.problem, selection_.min_couple));
    for (const std::string& names : all.left_out)
      notes.push_back("where " + names + " vanish together is too long a determinant to be derived");
    for (const PreloadFactor& own : all.factors) {
      const Poly sheet = elimination_.over_tower(own.natural);
      if (sheet.is_zero() || is_inverse_length(own.natural)) continue;
      LocusFactor factor;
      factor.expression = text(own.natural);
      for (const PreloadEvent& event : own.events) {
        factor.cause += (factor.cause.empty() ? "" : "; ") + words_of(event, motors, efforts);
        for (const std::vector<Vanishing>* list : {&event.vanishing, &event.bounded})
          for (const Vanishing& one : *list)
            if (std::find(factor.vanishing.begin(), factor.vanishing.end(), one) == factor.vanishing.end())
              factor.vanishing.push_back(one);
      }
      const std::size_t before = result_.problem.factors.size();
      add(FactorRole::preload, &own.natural, sheet, true, factor);
      drop_known(before);
    }
  }

  /// Which has no zeros.
  bool is_inverse_length(const Poly& p) const {
    const std::vector<InverseLength>& all = geometry_.inverse_lengths();
    return std::any_of(all.begin(), all.end(), [&](const InverseLength& own) {
      return own.variable >= 0 && p == Poly::variable(geometry_.ring(), own.variable);
    });
  }

  /// Of the factors from `first` on those with the curves of |A| or of a reaction before.
  void drop_known(std::size_t first) {
    std::vector<LocusFactor>& factors = result_.problem.factors;
    const auto is_known = [&](const LocusFactor& own) {
      const bool singular =
          std::any_of(determinant_parts_.begin(), determinant_parts_.end(), [&](const DeterminantPart& part) {
            return !part.chosen &&
                   core::scaled_for_doubles(part.sheet.sheet.plain(geometry_.tower_variables())) == own.sheet;
          });
      return singular ||
             std::any_of(
                 factors.begin(), factors.begin() + static_cast<std::ptrdiff_t>(first), [&](const LocusFactor& other) {
                   return other.role == FactorRole::reaction && other.sheet == own.sheet && !other.implicit.empty();
                 });
    };
    factors.erase(std::remove_if(factors.begin() + static_cast<std::ptrdiff_t>(first), factors.end(), is_known),
                  factors.end());
  }

  /// Bounds of all tensions hold them on either side.
  bool is_passed_by_tensions(const DeterminantPart& part) const {
    return part.chosen && std::all_of(preload_.joints.begin(), preload_.joints.end(), [&](mechanism::JointIndex joint) {
             return mechanism::is_cable(mechanism_.joints[static_cast<std::size_t>(joint)]);
           });
  }

  /// Where only one value of the free efforts leaves the others finite, which are then open: what is chosen goes
  /// through infinity along the line of the unknowns.
  void name_motors(LocusFactor& factor) const {
    for (const mechanism::JointIndex joint : preload_.joints) {
      const mechanism::Joint& own = mechanism_.joints[static_cast<std::size_t>(joint)];
      factor.vanishing.push_back({own.name, mechanism::actuator_quantity(own), 1});
    }
    factor.cause += (factor.cause.empty() ? "" : "; ") + std::string("singular with a constant effort of ") +
                    preload_.motors(mechanism_);
  }

  void add_direct_singularities() {
    const std::vector<int> variables = geometry_.tower_variables();
    for (const DeterminantPart& part : determinant_parts_) {
      if (is_passed_by_tensions(part)) continue;
      LocusFactor factor;
      factor.role = part.chosen ? FactorRole::preload : FactorRole::direct_singularity;
      factor.expression = text(part.natural->poly);
      factor.cause = causes_.of_determinant(part.natural->poly);
      if (part.chosen) name_motors(factor);
      factor.sheet = core::scaled_for_doubles(part.sheet.sheet.plain(variables));
      put_implicit(part.sheet, factor);
      if (part.alone) factor.line = lines_.of(part.natural->poly);
      factor.multiplicity = part.multiplicity;
      factor.cancelled = part.cancelled;
      factor.may_be_idle = part.may_be_idle;
      result_.problem.factors.push_back(std::move(factor));
    }
  }

  /// What is said of the places where the root of a point is zero.
  LocusFactor stretched(const TowerRoot& root) const {
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
    return factor;
  }

  /// The fold of a length that a point's place is divided by: where one of the two points of `on` passes through the
  /// other, the way between them turns round, and what stands beside it changes sides.
  void add_flip(const TowerRoot& root, const Fold& fold, LocusFactor factor) {
    factor.role = FactorRole::workspace_boundary;
    if (root.point >= 0)
      if (const auto* offset =
              std::get_if<mechanism::OffsetPoint>(&mechanism_.points[static_cast<std::size_t>(root.point)].form))
        factor.cause = point_name(offset->second) + " on " + point_name(offset->first) + ", where " +
                       point_name(root.point) + " has no place";
    core::Rational constant;
    for (const PolyFactor& part : fold.where.factors(constant)) {
      LocusFactor own = factor;
      own.sheet = core::scaled_for_doubles(part.poly.plain(geometry_.tower_variables()));
      put_implicit({part.poly, 1, elimination_.implicit_of_divisor(part.poly)}, own);
      result_.problem.factors.push_back(std::move(own));
    }
  }

  /// A side of a fold ends where its square root does: f >= 0 there.
  void add_fold(const Fold& fold) {
    const TowerRoot& root = geometry_.roots()[fold.root];
    LocusFactor factor = root.role == core::RootRole::working_mode ? stretched(root) : LocusFactor{};
    if (root.role != core::RootRole::working_mode) factor.expression = text(fold.where);
    if (elimination_.sheet_factors(fold.where, true).empty())
      add_flip(root, fold, factor);
    else
      add(FactorRole::workspace_boundary, nullptr, fold.where, true, factor);
    more_roots_.push_back({core::fold_name, "", core::RootRole::length,
                           core::scaled_for_doubles(fold.where.plain(geometry_.tower_variables()))});
  }

  /// A sheet ends where a limit does, as at a fold: one more root, of what is left to the limit.
  void add_limits() {
    for (const LimitCondition& limit : bounding_limits(geometry_, elimination_)) add_limit(limit);
    if (!preload_.joints.empty()) return;  // what gears bear depends on the efforts
    for (const LimitCondition& limit : effort_limits(geometry_, reactions_, determinants_.determinant))
      if (!elimination_.vanishes_everywhere(limit.natural)) add_limit(limit);
  }

  void add_limit(const LimitCondition& limit) {
    const Poly sheet = elimination_.over_tower(limit.natural);
    LocusFactor factor;
    factor.expression = text(limit.natural);
    factor.cause = std::string(mechanism::limit_cause) + limit.words;
    if (!limit.natural.is_constant()) add(FactorRole::workspace_boundary, &limit.natural, sheet, true, factor);
    more_roots_.push_back({core::limit_name, "", core::RootRole::length,
                           core::scaled_for_doubles(sheet.plain(geometry_.tower_variables()))});
    core::StraightLine line = lines_.of(limit.natural);
    if (!is_divided_in_vain(more_roots_.back().square, line)) more_roots_.back().line = std::move(line);
    more_roots_.back().bounds = limit.bounds;
  }

  /// The cosine of an angle between the links of a dyad is a polynomial in the coordinates. Computed from the elbow it
  /// is divided by the squared distance of the dyad's ends, and nothing is known of it where they meet.
  bool is_divided_in_vain(const core::Polynomial& square, const core::StraightLine& line) const {
    const bool has_roots = std::any_of(square.terms.begin(), square.terms.end(), [&](const core::Term& term) {
      return std::any_of(term.exponents.begin() + geometry_.coordinates(), term.exponents.end(),
                         [](int exponent) { return exponent != 0; });
    });
    return !has_roots && std::any_of(line.steps.begin(), line.steps.end(), [](const core::StraightLine::Step& step) {
      return step.operation == core::StraightLine::Operation::inverse;
    });
  }

  /// Where a dyad on others is stretched and where it is folded, each by itself: the product of both, which the square
  /// of its root is, has many more terms, and a norm of twice the degree. False where the square will do.
  bool add_rims(std::size_t index) {
    const TowerRoot& root = geometry_.roots()[index];
    if (geometry_.coordinates() != 2) return false;
    const auto own = std::find_if(geometry_.dyad_ways().begin(), geometry_.dyad_ways().end(),
                                  [&](const Geometry::Way& way) { return way.point == root.point; });
    if (own == geometry_.dyad_ways().end() || !elimination_.is_too_heavy(root.square)) return false;
    const auto lines = lines_.rims(root.point);
    if (!lines) return false;
    const auto& dyad = std::get<mechanism::DyadPoint>(mechanism_.points[static_cast<std::size_t>(root.point)].form);
    const auto squared = [](const Poly& length) { return length * length; };
    // Rims are of a length itself, of which the square alone may be rational.
    if (dyad.right_angle) return false;
    const Poly a = geometry_.poly(geometry_.expression(dyad.from_length).expand());
    const Poly b = geometry_.poly(geometry_.expression(dyad.to_length).expand());
    if (!(geometry_.squared_length(dyad.from_length) == squared(a)) ||
        !(geometry_.squared_length(dyad.to_length) == squared(b)))
      return false;
    const std::array<Poly, 2> rims = {geometry_.reduce(squared(a + b) * own->w2 - own->d),
                                      geometry_.reduce(own->d - squared(a - b) * own->w2)};
    for (std::size_t k = 0; k < rims.size(); ++k) {
      const std::size_t first = result_.problem.factors.size();
      add(FactorRole::workspace_boundary, nullptr, rims[k], true, stretched(root));
      const bool alone = result_.problem.factors.size() == first + 1;
      for (std::size_t f = first; f < result_.problem.factors.size(); ++f) {
        LocusFactor& factor = result_.problem.factors[f];
        if (alone) factor.line = (*lines)[k];
        result_.problem.tower.roots[index].rims.push_back({factor.sheet, factor.line});
      }
    }
    return true;
  }

  void add_boundaries() {
    for (std::size_t i = 0; i < geometry_.roots().size(); ++i) {
      const TowerRoot& root = geometry_.roots()[i];
      if (root.role == core::RootRole::working_mode && !root.value && !add_rims(i))
        add(FactorRole::workspace_boundary, nullptr, root.square, true, stretched(root));
    }
    for (const Fold& fold : geometry_.folds()) add_fold(fold);
    add_limits();
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
    common.role = FactorRole::margin;
    for (auto& [sheet, times] : common.cleared) times /= 2;  // unsquared
    return add_both_senses(senses, parts, {common, common}).has_value();
  }

  /// How often `divisor` divides p.
  static int times_in(Poly p, const Poly& divisor) {
    int times = 0;
    for (Poly quotient = p; p.divides(divisor, quotient); p = quotient) ++times;
    return times;
  }

  /// The factors size |w| - bound and size |w| + bound over one more root, |w|, without what they share, which is
  /// returned. `parts`: of the product of the two. Nothing where |w| is constant or a side is zero.
  std::optional<Poly> add_both_senses(const TwoSenses& senses, std::vector<SheetFactor> parts,
                                      std::array<LocusFactor, 2> factors) {
    const Poly t = Poly::variable(geometry_.ring(), geometry_.auxiliary());
    const auto parts_of = [&](const Poly& natural) {
      return elimination_.over_tower(natural).coefficients(geometry_.auxiliary());
    };
    // Coefficients of t^0 and t^1 over the tower have one denominator.
    const std::vector<Poly> sides = parts_of(senses.size * t + senses.bound), length = parts_of(senses.square + t);
    if (sides.size() != 2 || length.size() != 2 || length[0].is_constant()) return std::nullopt;
    // |w| = root / length[1], root^2 = length[0] length[1].
    Poly left = sides[1], right = sides[0] * length[1];
    const Poly shared = gcd(left, right);
    left = left.exact_quotient(shared);
    right = right.exact_quotient(shared);
    std::erase_if(parts, [&](const SheetFactor& part) {
      return part.multiplicity <= 2 * times_in(shared, part.sheet);  // of the product, the square is shared
    });

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
    for (const int sense : {1, -1}) {
      LocusFactor& factor = factors[sense > 0 ? 0 : 1];
      for (const SheetFactor& part : parts) put_implicit(part, factor);
      const core::Polynomial root = core::variable_polynomial(index + 1, index);
      const auto widened = [&](const Poly& p) { return core::with_variables(p.plain(variables), index + 1); };
      factor.sheet = core::scaled_for_doubles(sense > 0 ? widened(left) * root - widened(right)
                                                        : widened(left) * root + widened(right));
      const auto words = [&](const auto& write) {
        return "(" + write(senses.size) + ")*sqrt(" + write(senses.square) + (sense > 0 ? ") - (" : ") + (") +
               write(senses.bound) + ")";
      };
      factor.expression = words([this](const Poly& p) { return text(p); });
      if (mechanism_.frame)
        in_file_.emplace(factor.expression, words([this](const Poly& p) { return text_in_file(p); }));
      result_.problem.factors.push_back(std::move(factor));
    }
    return shared;
  }

  /// Both senses of size |w| = +-bound, or a note where they are not two curves. What size and bound share, perhaps
  /// over the tower alone, is a curve on which both ends are at theirs.
  void add_ends(const TwoSenses& senses, const std::array<LocusFactor, 2>& ends, const std::string& joint) {
    const Poly squared =
        elimination_.over_tower(senses.size * senses.size * senses.square - senses.bound * senses.bound);
    const std::optional<Poly> shared =
        squared.is_zero() ? std::nullopt : add_both_senses(senses, elimination_.sheet_factors(squared, true), ends);
    if (!shared) {
      result_.notes.push_back("where the ends of the guide " + joint + " lift is not traced in full");
      return;
    }
    LocusFactor both = ends[0];
    both.vanishing.insert(both.vanishing.end(), ends[1].vanishing.begin(), ends[1].vanishing.end());
    if (both.role == FactorRole::reaction) both.cause = "guide " + joint + " bears nothing";
    both.expression = text(*shared);
    add(both.role, nullptr, *shared, true, both);
  }

  /// The ends of guides along axes of changing length: h N |u| = T behind, h N |u| = -T ahead.
  void add_moving_guides() {
    for (const Guide& guide : guides_) {
      if (guide.is_polynomial() || !selected(guide.joint)) continue;
      if (!wanted(Quantity::end_ahead) && !wanted(Quantity::end_behind)) continue;
      std::array<LocusFactor, 2> ends;
      for (const bool ahead : {false, true}) {
        LocusFactor& end = ends[ahead ? 1 : 0];
        end.role = FactorRole::reaction;
        end.vanishing = {{guide.joint, ahead ? Quantity::end_ahead : Quantity::end_behind, 1}};
        end.cause = std::string("end ") + (ahead ? "ahead" : "behind") + " of guide " + guide.joint + " without load";
      }
      add_ends({guide.bears, guide.square, guide.turns}, ends, guide.joint);
    }
  }

  /// Where an end bears f_min to either side: h N |u| +- T = +-2 h f_min |A|.
  void add_guide_margins() {
    for (const Guide& guide : guides_) {
      if (!selected(guide.joint)) continue;
      const Ring& ring = geometry_.ring();
      const FactoredPoly shared = common_factors(guide.common, determinants_.determinant);
      const Poly common = without(guide.common, shared, ring);
      const Poly limit =
          without(determinants_.determinant, shared, ring).scaled(2 * guide.half_length * *selection_.min_force);
      const Poly bears = guide.bears * common, turns = guide.turns * common;
      if (bears.is_zero() && turns.is_zero()) continue;
      FactoredPoly below = determinants_.determinant;
      multiply(below, shared, -1);
      LocusFactor margin;
      margin.role = FactorRole::margin;
      margin.cleared = cleared_by(below, 1);
      const auto of_end = [&](Quantity end) {
        LocusFactor own = margin;
        own.vanishing = {{guide.joint, end, 1}};
        own.cause =
            "end of guide " + guide.joint + " at " + core::told(core::to_double(*selection_.min_force), "N", {});
        return own;
      };
      if (!guide.length && !bears.is_zero()) {
        for (const Poly& bound : {turns - limit, turns + limit})
          add_ends({bears, guide.square, bound}, {of_end(Quantity::end_behind), of_end(Quantity::end_ahead)},
                   guide.joint);
        continue;
      }
      std::vector<std::pair<Poly, LocusFactor>> curves;
      for (const Quantity end : {Quantity::end_ahead, Quantity::end_behind})
        for (const Poly& bound : {limit, -limit}) {
          const Poly natural = (end_numerator(guide, end) * common - bound).primitive();
          const auto known =
              std::find_if(curves.begin(), curves.end(), [&](const auto& c) { return c.first == natural; });
          if (known == curves.end())
            curves.emplace_back(natural, of_end(end));
          else
            known->second.vanishing.push_back({guide.joint, end, 1});
        }
      for (auto& [natural, factor] : curves) {
        factor.expression = text(natural);
        const Poly sheet = elimination_.over_tower(natural);
        if (sheet.is_zero())
          result_.notes.push_back(factor.cause + " in every pose");
        else
          add(FactorRole::margin, &natural, sheet, true, factor);
      }
    }
  }

  /// The parts over the tower of what a margin's equation was multiplied by, a divisor of |A|, to a power.
  std::vector<std::pair<core::Polynomial, int>> cleared_by(const FactoredPoly& below, int power) const {
    std::vector<std::pair<core::Polynomial, int>> parts;
    for (const DeterminantPart& part : determinant_parts_)
      if (const int times = below.multiplicity(part.natural->poly); times > 0)
        parts.emplace_back(core::scaled_for_doubles(part.sheet.sheet.plain(geometry_.tower_variables())),
                           times * part.sheet.multiplicity * power);
    return parts;
  }

  /// The roots that margins brought, into the tower and everything that is written over it.
  void append_roots() {
    if (more_roots_.empty()) return;
    core::LocusProblem& problem = result_.problem;
    core::RootTower& tower = problem.tower;
    tower.roots.insert(tower.roots.end(), more_roots_.begin(), more_roots_.end());
    const auto widen = [&](core::Polynomial& p) { p = core::with_variables(p, tower.variables()); };
    for (core::Root& root : tower.roots) core::rewrite(root, [&](core::Polynomial p) { return widen(p), p; });
    for (core::Polynomial& denominator : tower.denominators) widen(denominator);
    for (core::DyadBase& base : tower.bases) {
      widen(base.x);
      widen(base.y);
    }
    for (LocusFactor& factor : problem.factors) {
      widen(factor.sheet);
      for (auto& [sheet, times] : factor.cleared) widen(sheet);
      if (factor.nodes)
        for (core::NodeForm::Part& part : factor.nodes->parts) widen(part.sheet);
    }
    for (core::WorkingMode& mode : problem.modes) mode.resize(tower.roots.size(), 1);
  }

  /// With what is known of its nodes, where it is one curve.
  void add_squared_margin(const Margin& margin, const Poly& sheet, const LocusFactor& factor) {
    std::vector<LocusFactor>& factors = result_.problem.factors;
    const std::size_t before = factors.size();
    add(FactorRole::margin, &margin.natural, sheet, true, factor);
    if (factors.size() != before + 1 || factors.back().line.empty() || geometry_.coordinates() != 2) return;
    if (std::optional<MarginNodes::Form> form = margin_nodes_.of(margin)) {
      factors.back().line = std::move(form->line);
      factors.back().nodes = std::move(form->nodes);
    }
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
      const core::Rational unit = mechanism_.frame && !force ? mechanism_.frame->scale : core::Rational(1);
      const std::string bound =
          core::told(core::to_double(core::Rational(margin.bound * unit)), force ? "N" : "N m", {});
      factor.cleared = cleared_by(margin.below, margin.power);
      factor.expression = text(margin.natural);
      factor.cause = (force ? "contact force of " : "couple of ") + names + " at " + bound;
      const Poly sheet = elimination_.over_tower(margin.natural);
      if (sheet.is_zero())
        result_.notes.push_back(factor.cause + " in every pose");
      else if (!margin.senses || !add_senses(*margin.senses, sheet, factor))
        add_squared_margin(margin, sheet, factor);
    }
    if (selection_.min_force) add_guide_margins();
  }

  const Mechanism& mechanism_;
  const Selection& selection_;
  std::vector<Sides> modes_;
  Geometry geometry_;
  FactoredDeterminants determinants_;
  Elimination elimination_;
  SharedCurves shared_{geometry_};
  Causes causes_;
  PreloadColumns preload_;  ///< of free efforts without a value
  std::vector<Reaction> reactions_;
  std::vector<Guide> guides_;
  StraightLines lines_;
  MarginNodes margin_nodes_{geometry_, elimination_, lines_};
  std::vector<SharedFactor> factors_;
  std::vector<std::pair<Poly, Vanishing>> cancelled_;  ///< natural factors of |A| and a numerator, and how often
  std::vector<DeterminantPart> determinant_parts_;
  std::map<std::pair<std::size_t, std::size_t>, bool> never_both_, may_share_;  ///< by factors
  std::map<std::size_t, Poly> sheets_;                                          ///< by factor
  std::map<std::size_t, ResiduePoly> on_line_;                                  ///< likewise
  std::map<std::size_t, bool> heavy_;
  std::vector<core::Root> more_roots_;  ///< written in the coordinates and the roots of the geometry
  DerivedProblem result_;
  mutable std::map<std::string, std::string> in_file_;  ///< DerivedProblem::in_file
};

/// The problems of one choice of charts.
struct Piece {
  std::vector<DerivedProblem> problems;
  DerivedProblem without_modes;      ///< in their place where none is left
  std::vector<std::string> refused;  ///< sheets on which |A| vanishes everywhere, and why
  std::vector<BentMode> bent;        ///< modes none of whose sheets is left
};

Piece problems_of(const Mechanism& mechanism, const Selection& selection, const std::vector<ChartRange>& charts,
                  const Family* family, const std::vector<Sides>& modes) {
  auto start = Clock::now();
  Piece piece;
  const Charts own = charts_of(mechanism, charts);
  std::vector<SheetGeometry> sheets = sheet_geometries(mechanism, own, modes, &piece.bent);
  if (sheets.empty())
    piece.without_modes =
        Derivation(mechanism, selection, charts, family, {Geometry(mechanism, false, own, {modes.front()}), {}})
            .without_modes();
  for (SheetGeometry& sheet : sheets) {
    Derivation derivation(mechanism, selection, charts, family, std::move(sheet));
    if (const std::optional<std::string> why = derivation.singular()) {
      if (!derivation.has_dependent_roots())
        throw core::InputError({mechanism.file}, "the equations are singular in every pose: |A| = 0 on the closure",
                               "check the lengths, the joints and which of them are actuated");
      for (const Sides& sides : derivation.modes())
        piece.refused.push_back("the working mode " + derivation.words(sides) +
                                " is singular in every pose: |A| = 0, for " + *why);
      piece.without_modes = derivation.without_modes();
      continue;
    }
    const double preparation = seconds_since(start);
    piece.problems.push_back(derivation.run());
    piece.problems.back().symbolic_seconds += preparation;
    start = Clock::now();
  }
  return piece;
}

/// Of the modes that are bent whatever the charts.
std::vector<std::string> words_of_bent(const Mechanism& mechanism, const std::vector<Piece>& pieces) {
  std::vector<std::string> list;
  for (const BentMode& own : pieces.front().bent) {
    const auto is_bent = [&](const Piece& piece) {
      return std::any_of(piece.bent.begin(), piece.bent.end(),
                         [&](const BentMode& other) { return other.sides == own.sides; });
    };
    if (std::all_of(pieces.begin(), pieces.end(), is_bent))
      list.push_back("the working mode " + mode_words(mechanism, own.sides) + " bends a link: " + own.what);
  }
  return list;
}

std::vector<DerivedProblem> problems_of(const Mechanism& mechanism, const Selection& selection, const Family* family) {
  std::vector<Sides> modes = selection.working_modes;
  if (modes.empty()) modes.push_back(mechanism::working_mode(mechanism));
  std::vector<Piece> pieces;
  for (const std::vector<ChartRange>& charts : all_pieces(mechanism))
    pieces.push_back(problems_of(mechanism, selection, charts, family, modes));
  const std::vector<std::string> bent = words_of_bent(mechanism, pieces);
  if (std::all_of(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.problems.empty(); })) {
    const auto refused =
        std::find_if(pieces.begin(), pieces.end(), [](const Piece& piece) { return !piece.refused.empty(); });
    throw core::InputError({mechanism.file}, refused != pieces.end() ? refused->refused.front() : bent.front(),
                           "choose another working mode, or change the lengths, the joints or which are actuated");
  }
  for (const std::string& words : bent) pieces.front().refused.push_back(words);
  std::vector<DerivedProblem> problems;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    std::vector<DerivedProblem>& own = pieces[i].problems;
    if (own.empty()) own.push_back(std::move(pieces[i].without_modes));
    for (const std::string& note : pieces[i].refused) own.front().notes.push_back(note + "; left out");
    for (DerivedProblem& problem : own) {
      problem.piece = static_cast<int>(i);
      problems.push_back(std::move(problem));
    }
  }
  return problems;
}

}  // namespace

std::vector<DerivedProblem> locus_problems(const Mechanism& mechanism, const Selection& selection) {
  const auto turn = algebra_turn();
  return problems_of(mechanism, selection, nullptr);
}

LocusFamily::LocusFamily(const Mechanism& member) {
  const auto turn = algebra_turn();
  family_ = std::make_unique<const Family>(member);
}
LocusFamily::~LocusFamily() {
  const auto turn = algebra_turn();
  family_.reset();
}
LocusFamily::LocusFamily(LocusFamily&&) noexcept = default;
LocusFamily& LocusFamily::operator=(LocusFamily&& other) noexcept {
  const auto turn = algebra_turn();
  family_ = std::move(other.family_);
  return *this;
}

std::vector<DerivedProblem> LocusFamily::problems(const Mechanism& member, const Selection& selection) const {
  const auto turn = algebra_turn();
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
