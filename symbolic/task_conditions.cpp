#include "symbolic/task_conditions.hpp"

#include <algorithm>
#include <list>
#include <map>

#include "core/append_roots.hpp"
#include "core/errors.hpp"
#include "core/fold.hpp"
#include "core/powers_of_two.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"
#include "symbolic/algebra_turn.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/effort_limits.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/guide_ends.hpp"
#include "symbolic/limits.hpp"
#include "symbolic/margins.hpp"
#include "symbolic/reactions.hpp"
#include "symbolic/straight_lines.hpp"

namespace clearloci::symbolic {
namespace {

using core::Quantity;
using core::Rational;
using core::TaskCondition;
using core::TaskDemand;

class Conditions {
 public:
  Conditions(const std::vector<const mechanism::Mechanism*>& loads,
             const std::vector<const mechanism::Mechanism*>& directions,
             const std::vector<const mechanism::Mechanism*>& forces)
      : mechanism_(*loads.front()),
        geometry_(mechanism_, false, {}, {.all_sheets = true}),
        elimination_(geometry_),
        lines_(geometry_) {
    result_.loads = loads.size();
    result_.directions = directions.size();
    result_.tower = lines_.tower();
    for (const LimitCondition& limit : bounding_limits(geometry_, elimination_)) add_limit(limit);
    std::vector<const mechanism::Mechanism*> all = loads;
    all.insert(all.end(), directions.begin(), directions.end());
    all.insert(all.end(), forces.begin(), forces.end());
    for (const mechanism::Mechanism* load : all) {
      mechanism::require_preload(*load);
      const FactoredDeterminants determinants = load == &mechanism_ ? factored_determinants(geometry_) : under(*load);
      lines_.know(determinants.forms);
      reactions_.push_back(reactions(geometry_, determinants));
      for (const Guide& guide : guides(geometry_, elimination_, reactions_.back())) add_ends(guide, determinants);
      if (load == &mechanism_) determinant_ = determinants.determinant;
      if (loads.end() != std::find(loads.begin(), loads.end(), load))
        for (const LimitCondition& limit : effort_limits(geometry_, reactions_.back(), determinants.determinant))
          if (!vanishes(factored(limit.natural, {}))) add_limit(limit);
    }
    if (vanishes(determinant_))
      throw core::InputError({mechanism_.file}, "the equations are singular in every pose: |A| = 0 on the closure",
                             "check the lengths, the joints and which of them are actuated");
    for (const PolyFactor& factor : determinant_.factors) result_.determinant.push_back(factor_function(factor.poly));
    for (const Poly& denominator : elimination_.denominator_factors()) {
      result_.denominators.push_back(static_cast<int>(result_.functions.size()));
      result_.functions.push_back(lines_.over_roots(denominator));
    }
  }

  /// `always`: of a reaction that is zero in every pose, too.
  void add(const TaskDemand& demand, bool always) {
    const Demanded demanded = parts_of(demand, result_.loads + result_.directions);
    const Parts& parts = demanded.parts;
    TaskCondition condition;
    condition.reactions = {{demand.joint, demand.quantity, 1}};
    condition.least = demand.least;
    if (parts.front().empty()) {
      if (demand.least == 0 && !always) {
        result_.never_loaded.push_back(demand);
        return;
      }
      for (std::size_t i = 0; i < result_.loads; ++i) condition.unloaded.push_back(static_cast<int>(i));
    }
    for (std::size_t i = 0; i < result_.loads && !parts.front().empty(); ++i)
      if (std::all_of(parts[i].begin(), parts[i].end(), [](const FactoredPoly& p) { return p.is_zero(); }))
        condition.unloaded.push_back(static_cast<int>(i));
    if (condition.unloaded.empty()) fill(condition, demanded);
    put(std::move(condition), result_.conditions);
  }

  /// A reaction that takes up a clearance; of one that nothing loads nothing is asked.
  void add_take_up(TaskDemand demand) {
    demand.least = 1;  // so that D is known
    const Demanded demanded = parts_of(demand, reactions_.size());
    if (demanded.parts.front().empty()) return;
    TaskCondition condition;
    condition.reactions = {{demand.joint, demand.quantity, 1}};
    condition.least = demand.least;
    fill(condition, demanded);
    put(std::move(condition), result_.take_ups);
  }

  core::TaskConditions take() { return std::move(result_); }

 private:
  void add_limit(const LimitCondition& limit) {
    const Poly sheet = elimination_.over_tower(limit.natural);
    core::Root root;
    root.name = core::limit_name;
    root.role = core::RootRole::length;
    root.square = sheet.plain(geometry_.tower_variables());
    root.line = lines_.of(limit.natural);
    root.bounds = limit.bounds;
    core::append_roots(result_.tower, {std::move(root)});
  }

  using Parts = std::vector<std::vector<FactoredPoly>>;

  /// What is demanded of, load by load: w D |u| in components, with |u|^2 where it is not 1.
  struct Demanded {
    Parts parts;
    std::optional<Poly> squared_axis = {};
  };

  /// Of every load, then of every direction: the first `many` of these.
  Demanded parts_of(const TaskDemand& demand, std::size_t many) {
    const mechanism::Joint& joint = mechanism::joint_named(mechanism_, demand.joint);
    const bool guide = mechanism::is_guide(mechanism_, joint);
    if (core::is_guide_end(demand.quantity)) know_length(demand.joint);
    Demanded result;
    std::vector<std::vector<FactoredPoly>> found;  // load by load
    for (std::size_t i = 0; i < many; ++i) {
      std::vector<FactoredPoly>& functions = found.emplace_back();
      if (demand.quantity == Quantity::f && !guide) {
        PressingForce pressing = pressing_force(geometry_, reactions_[i], joint, determinant_);
        functions = std::move(pressing.parts);
        result.squared_axis = std::move(pressing.squared);
      } else {
        const std::vector<Quantity> quantities = demand.quantity == Quantity::f
                                                     ? mechanism::reaction_components(mechanism_, joint)
                                                     : std::vector{demand.quantity};
        for (const Quantity quantity : quantities) {
          const FactoredPoly* const part = numerator(reactions_[i], demand.joint, quantity);
          functions.push_back(part == nullptr ? FactoredPoly{} : *part);
        }
      }
      for (FactoredPoly& part : functions)
        if (vanishes(part)) part = {};
    }
    const bool planar = mechanism_.space == mechanism::Space::planar;
    if (demand.least > 0 && (demand.quantity == Quantity::F || (demand.quantity == Quantity::M && !planar)))
      add_axis(squared_axis(geometry_, joint), demand.quantity == Quantity::F && is_force_over_axis(mechanism_, joint),
               found, result);
    // Components that are zero whatever the pose and the load say nothing.
    result.parts.resize(many);
    for (std::size_t c = 0; c < found.front().size(); ++c) {
      if (std::all_of(found.begin(), found.end(), [&](const auto& candidate) { return candidate[c].is_zero(); }))
        continue;
      for (std::size_t i = 0; i < many; ++i) result.parts[i].push_back(std::move(found[i][c]));
    }
    return result;
  }

  /// What an actuator exerts along an axis u that is no unit vector: in space u . w is known, in the plane (`per_axis`)
  /// the unknown is w over |u|. Both become w |u|, or w itself where |u| is a rational number.
  void add_axis(Poly square, bool per_axis, std::vector<std::vector<FactoredPoly>>& found, Demanded& result) const {
    const std::optional<Rational> constant = elimination_.constant_over_tower(square);
    if (constant) square = Poly(geometry_.ring(), *constant);
    const std::optional<Rational> length = constant ? rational_root(*constant) : std::nullopt;
    const FactoredPoly by = length ? FactoredPoly{per_axis ? *length : 1 / *length, {}}
                                   : (per_axis ? factored(square, determinant_.factors) : FactoredPoly{1, {}});
    for (std::vector<FactoredPoly>& polynomials : found)
      for (FactoredPoly& part : polynomials)
        if (!part.is_zero()) multiply(part, by);
    if (!length) result.squared_axis = std::move(square);
  }

  /// What several joints bear alike is one condition.
  static void put(TaskCondition condition, std::vector<TaskCondition>& list) {
    const auto found = std::find_if(list.begin(), list.end(), [&](const TaskCondition& c) {
      return condition.unloaded.empty() && c.unloaded.empty() && c.least == condition.least &&
             c.factors == condition.factors && c.parts == condition.parts && c.directions == condition.directions &&
             c.denominator == condition.denominator && c.squared_axis == condition.squared_axis;
    });
    if (found == list.end())
      list.push_back(std::move(condition));
    else
      found->reactions.push_back(condition.reactions.front());
  }

  /// What the ends of a guide bear, of the last load's reactions. Where the axis has no constant length |u| the ring's
  /// auxiliary variable stands for it.
  void add_ends(const Guide& guide, const FactoredDeterminants& determinants) {
    std::vector<Reaction> ends = end_reactions(guide, determinants.determinant);
    if (!guide.length && !guide.bears.is_zero()) {
      const Poly bears = guide.bears * Poly::variable(geometry_.ring(), geometry_.auxiliary());
      for (Reaction& end : ends) {
        end.numerator = factored(end.quantity == Quantity::end_ahead ? bears + guide.turns : bears - guide.turns, {});
        multiply(end.numerator, guide.common);
        end.numerator.constant /= 2 * guide.half_length;
      }
      lengths_.try_emplace(guide.joint, GuideLength{sum_of_squares(guide.axis)});
    }
    for (Reaction& end : ends) reactions_.back().push_back(std::move(end));
  }

  /// From now on the auxiliary variable is the length of this guide's axis, over a root of the tower of its own.
  void know_length(const std::string& joint) {
    const auto found = lengths_.find(joint);
    if (found == lengths_.end() || joint == known_length_) return;
    known_.clear();  // what was written with the length of another guide
    known_length_ = joint;
    // Coefficients of t^0 and t^1 over the tower have one denominator; |u| = root / divisor.
    const Poly t = Poly::variable(geometry_.ring(), geometry_.auxiliary());
    const std::vector<Poly> length =
        elimination_.over_tower(found->second.square + t).coefficients(geometry_.auxiliary());
    core::ensure(length.size() == 2, "a squared length over its denominator");
    if (found->second.variable < 0) {
      found->second.variable = result_.tower.variables();
      core::Root root;
      root.name = "s" + std::to_string(result_.tower.roots.size() + 1);
      root.role = core::RootRole::length;
      root.square = geometry_.reduce(length[0] * length[1]).plain(geometry_.tower_variables());
      core::append_roots(result_.tower, {std::move(root)});
    }
    lines_.let(geometry_.auxiliary(), found->second.variable, length[1]);
  }

  FactoredDeterminants under(const mechanism::Mechanism& load) const {
    const Geometry loaded(load, false);
    return factored_determinants(geometry_, &loaded);
  }

  bool vanishes(const FactoredPoly& p) const {
    return p.is_zero() || std::any_of(p.factors.begin(), p.factors.end(), [&](const PolyFactor& factor) {
             return elimination_.vanishes_everywhere(factor.poly);
           });
  }

  /// What a factor is but for a positive number: all that its sign is asked of.
  int factor_function(const Poly& natural) {
    return function_of({1, {PolyFactor{natural, 1}}}, magnitude({1, {PolyFactor{natural, 1}}}));
  }

  /// The power of two next to a product of the largest coefficients: with it for a unit the values are numbers that
  /// doubles hold, whatever the integers that the factors are made of.
  static Rational magnitude(const FactoredPoly& product) {
    long exponent = 0;
    for (const PolyFactor& factor : product.factors) {
      const core::Polynomial plain = factor.poly.plain();
      const Rational gained =
          core::scaled_for_doubles(plain).terms.front().coefficient / plain.terms.front().coefficient;
      exponent -= factor.multiplicity * core::binary_exponent(gained);
    }
    return core::times_power_of_two(1, exponent);
  }

  /// product / unit.
  int function_of(const FactoredPoly& product, const Rational& unit) {
    FactoredPoly polynomial = product;
    polynomial.constant /= unit;
    const auto same = [&](const Known& function) {
      return function.product.constant == polynomial.constant &&
             std::equal(function.product.factors.begin(), function.product.factors.end(), polynomial.factors.begin(),
                        polynomial.factors.end(), [](const PolyFactor& a, const PolyFactor& b) {
                          return a.multiplicity == b.multiplicity && a.poly == b.poly;
                        });
    };
    const auto found = std::find_if(known_.begin(), known_.end(), same);
    if (found != known_.end()) return found->function;
    const int index = static_cast<int>(result_.functions.size());
    result_.functions.push_back(lines_.of(polynomial.constant, polynomial.factors));
    known_.push_back({std::move(polynomial), index});
    return index;
  }

  void fill(TaskCondition& condition, const Demanded& demanded) {
    const Parts& parts = demanded.parts;
    std::vector<FactoredPoly> all;
    for (const auto& load : parts)
      for (const FactoredPoly& part : load)
        if (!part.is_zero()) all.push_back(part);
    const FactoredPoly shared = shared_factors(all), of_determinant = common_factors(shared, determinant_);
    // Where |A| does not vanish its factors do not; with them divided out there is less to enclose.
    const bool size = condition.least > 0;
    if (!size)
      for (const PolyFactor& factor : shared.factors)
        if (determinant_.multiplicity(factor.poly) == 0) condition.factors.push_back(factor_function(factor.poly));
    FactoredPoly denominator = determinant_;
    multiply(denominator, of_determinant, -1);
    FactoredPoly first = size ? denominator : all.front();
    if (!size) multiply(first, shared, -1);
    const Rational unit = (size ? denominator.constant : all.front().constant) * magnitude(first);
    if (size) condition.denominator = function_of(denominator, unit);
    bool constant = true;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto& load = parts[i];
      std::vector<int>& functions = (i < result_.loads ? condition.parts : condition.directions).emplace_back();
      for (FactoredPoly part : load) {
        if (!part.is_zero()) multiply(part, size ? of_determinant : shared, -1);
        constant = constant && part.factors.empty();
        functions.push_back(function_of(part, unit));
      }
    }
    // Of one component under one load nothing is left but its factors.
    if (!size && constant && parts.size() == 1) condition.parts.clear();
    if (size && demanded.squared_axis) condition.squared_axis = function_of(factored(*demanded.squared_axis, {}), 1);
  }

  struct GuideLength {
    Poly square;
    int variable = -1;  ///< of the tower; -1: nothing has been asked for
  };

  struct Known {
    FactoredPoly product;
    int function = 0;
  };

  const mechanism::Mechanism& mechanism_;
  Geometry geometry_;
  Elimination elimination_;
  StraightLines lines_;
  FactoredPoly determinant_;
  std::vector<std::vector<Reaction>> reactions_;  ///< load by load, then direction by direction
  std::list<Known> known_;
  std::map<std::string, GuideLength> lengths_;
  std::string known_length_;  ///< of which guide the auxiliary variable is the length
  core::TaskConditions result_;
};

}  // namespace

core::TaskConditions task_conditions(const std::vector<const mechanism::Mechanism*>& loads,
                                     const std::vector<TaskDemand>& demands,
                                     const std::vector<const mechanism::Mechanism*>& directions,
                                     const TakeUps& take_ups, const std::vector<bool>& always) {
  const auto turn = algebra_turn();
  Conditions conditions(loads, directions, take_ups.forces);
  for (std::size_t d = 0; d < demands.size(); ++d) conditions.add(demands[d], !always.empty() && always[d]);
  for (const TaskDemand& take_up : take_ups.reactions) conditions.add_take_up(take_up);
  return conditions.take();
}

}  // namespace clearloci::symbolic
