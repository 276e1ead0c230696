#include "symbolic/preload_constraints.hpp"

#include <algorithm>

#include "core/shown_units.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"
#include "symbolic/guide_ends.hpp"

namespace clearloci::symbolic {
namespace {

using core::Quantity;
using core::Rational;
using mechanism::Mechanism;

std::vector<Reaction> all_reactions(const Geometry& geometry, const Elimination& elimination,
                                    const FactoredDeterminants& determinants, std::vector<std::string>& notes) {
  std::vector<Reaction> all = reactions(geometry, determinants);
  for (const Guide& guide : guides(geometry, elimination, all)) {
    if (guide.length) {
      for (Reaction& end : end_reactions(guide, determinants.determinant)) all.push_back(std::move(end));
      continue;
    }
    std::string note = "the ends of guide " + guide.joint + ", whose axis changes its length, bound no preload here";
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(std::move(note));
  }
  for (Reaction& part : pressing_reactions(geometry, determinants)) all.push_back(std::move(part));
  return all;
}

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

class Demands {
 public:
  Demands(const Geometry& geometry, const Elimination& elimination, const PreloadColumns& columns,
          const FactoredPoly& determinant, const core::LocusProblem& demanded, const Selection& selection,
          std::vector<std::string>& notes)
      : geometry_(geometry),
        elimination_(elimination),
        mechanism_(geometry.mechanism()),
        columns_(columns),
        determinant_(determinant),
        demanded_(demanded),
        selection_(selection),
        notes_(notes) {}

  std::vector<PreloadConstraint> run() {
    if (efforts() > 0)
      for (const std::string& joint : demanded_.joints)
        for (const Quantity quantity : core::all_quantities)
          if (wanted(quantity)) add(joint, quantity);
    for (const mechanism::Joint& joint : mechanism_.joints)
      if (joint.actuated && joint.within) add_bounds(joint);
    for (std::size_t e = 0; e < columns_.joints.size(); ++e) add_own(e);
    return std::move(result_);
  }

 private:
  /// In space numerators are over the length of an axis.
  bool is_planar() const { return mechanism_.space == mechanism::Space::planar; }

  std::size_t efforts() const { return columns_.joints.size(); }

  bool wanted(Quantity quantity) const {
    return std::find(demanded_.quantities.begin(), demanded_.quantities.end(), quantity) != demanded_.quantities.end();
  }

  std::optional<std::size_t> place_of(const std::string& joint, Quantity quantity) const {
    const std::vector<Reaction>& all = columns_.reactions.front();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].joint == joint && all[i].quantity == quantity) return i;
    return std::nullopt;
  }

  std::vector<const FactoredPoly*> numerators(std::size_t reaction) const {
    std::vector<const FactoredPoly*> list;
    for (const std::vector<Reaction>& column : columns_.reactions) list.push_back(&column[reaction].numerator);
    return list;
  }

  void add(const std::string& joint, Quantity quantity) {
    PreloadConstraint constraint;
    constraint.vanishing = {{joint, quantity, 1}};
    const std::vector<Quantity> parts =
        quantity == Quantity::f ? core::force_components(demanded_, joint) : std::vector<Quantity>{quantity};
    bool chosen = false;  // some effort changes it
    for (const Quantity part : parts) {
      const std::optional<std::size_t> at = place_of(joint, part);
      if (!at) return;
      if (const auto least = least_of(joint, quantity)) return add_at(*at, *least, {joint, quantity, 1});
      constraint.rows.push_back(preload_row(numerators(*at)));
      chosen = chosen || changes(constraint.rows.back());
    }
    if (chosen) result_.push_back(std::move(constraint));
  }

  static bool changes(const PreloadRow& row) {
    return std::any_of(row.efforts.begin(), row.efforts.end(), [](const FactoredPoly& p) { return !p.is_zero(); });
  }

  /// The least size of what has one component.
  std::optional<Rational> least_of(const std::string& joint, Quantity quantity) const {
    if (quantity == Quantity::M) return is_planar() ? selection_.min_couple : std::nullopt;
    const bool one =
        quantity == Quantity::F ||
        (quantity == Quantity::f && mechanism::is_slot(mechanism_, mechanism::joint_named(mechanism_, joint)));
    return one ? selection_.min_force : std::nullopt;
  }

  /// At its least size, to either side: N -+ least |A|, of a force along an axis u over |u|.
  void add_at(std::size_t reaction, const Rational& least, const core::Vanishing& what) {
    for (const Rational& size : {least, Rational(-least)}) {
      const std::optional<PreloadRow> row = row_at(reaction, size);
      if (!row) return leave_out(what);
      const Rational shown = size * (what.quantity == Quantity::M ? scale_of(Quantity::M) : Rational(1));
      if (changes(*row)) result_.push_back({{*row}, {}, words_at(what, shown), false, what});
    }
  }

  void leave_out(const core::Vanishing& what) const {
    notes_.push_back("where " + core::to_string(what.quantity) + "_" + what.joint +
                     " has its least size is left out: its axis changes its length");
  }

  /// 1 / |u| of the axis that a force is in units of; none where it is not among the lengths of the equations.
  std::optional<Poly> inverse_axis(const mechanism::Joint& joint) const {
    if (geometry_.has_inverse_length(joint.name + ".axis"))
      return geometry_.poly(geometry_.inverse_length(joint.name + ".axis").natural);
    const std::optional<Rational> square = elimination_.constant_over_tower(squared_axis(geometry_, joint));
    if (!square) return std::nullopt;
    return Poly(geometry_.ring(), 1 / mechanism::near_root(*square));
  }

  std::optional<PreloadRow> row_at(std::size_t reaction, const Rational& size) const {
    const std::vector<const FactoredPoly*> polynomials = numerators(reaction);
    const Ring& ring = geometry_.ring();
    const Reaction& what = columns_.reactions.front()[reaction];
    const Poly load = polynomials.front()->is_zero() ? Poly(ring) : expanded(*polynomials.front(), ring);
    Poly unit = expanded(determinant_, ring);
    if (what.quantity != Quantity::M) {
      const mechanism::Joint& joint = mechanism::joint_named(mechanism_, what.joint);
      const std::optional<Poly> inverse = inverse_axis(joint);
      if (!inverse) return std::nullopt;
      unit = unit * *inverse;
      if (what.quantity == Quantity::F && !is_force_over_axis(mechanism_, joint))
        unit = unit * squared_axis(geometry_, joint);
    }
    const FactoredPoly beyond = factored(load - unit.scaled(size), determinant_.factors);
    std::vector<const FactoredPoly*> columns = polynomials;
    columns.front() = &beyond;
    return preload_row(columns);
  }

  /// Of the scale of lengths that couples are written in.
  Rational scale_of(Quantity quantity) const {
    return mechanism_.frame && quantity != Quantity::F ? mechanism_.frame->scale : Rational(1);
  }

  static std::string words_at(const core::Vanishing& what, const Rational& size) {
    return core::to_string(what.quantity) + "_" + what.joint + " at " +
           core::told(core::to_double(size), what.quantity == Quantity::M ? "N m" : "N", {});
  }

  /// An effort that follows from the free ones at its bounds.
  void add_bounds(const mechanism::Joint& joint) {
    const Quantity quantity = mechanism::actuator_quantity(joint);
    const std::optional<std::size_t> at = place_of(joint.name, quantity);
    if (!at) return;
    for (const Rational& bound : {joint.within->first, joint.within->second})
      result_.push_back({{row_at(*at, bound / scale_of(quantity)).value()},
                         {},
                         mechanism::words_of_bound(joint, bound),
                         false,
                         core::Vanishing{joint.name, quantity, 1}});
  }

  /// The bounds of an effort, and its own backlash.
  void add_own(std::size_t effort) {
    const mechanism::Joint& joint = mechanism_.joints[static_cast<std::size_t>(columns_.joints[effort])];
    const Quantity quantity = mechanism::actuator_quantity(joint);
    const bool force = quantity == Quantity::F;
    const Rational scale = scale_of(quantity);
    const auto at = [&](const Rational& value) { return bound_row(efforts(), effort, value / scale, determinant_); };
    if (const auto& within = joint.free_effort->within) {
      for (const Rational& bound : {within->first, within->second})
        result_.push_back({{at(bound)},
                           {},
                           mechanism::words_of_bound(joint, bound),
                           false,
                           core::Vanishing{joint.name, quantity, 1}});
    } else if (std::none_of(result_.begin(), result_.end(), [](const auto& candidate) { return candidate.infinite; })) {
      result_.push_back({{infinite_row(efforts(), determinant_)}, {}, "", true});
    }
    if (!joint.clearance || !contains(demanded_.joints, joint.name) || !wanted(quantity)) return;
    if (mechanism::value_of(force ? joint.clearance->axial : joint.clearance->angular, mechanism_) == 0) return;
    const core::Vanishing vanishing{joint.name, quantity, 1};
    const std::optional<Rational> least = least_of(joint.name, quantity);
    if (!least || *least == 0) {
      result_.push_back({{at(0)}, {vanishing}});
      return;
    }
    const Rational size = *least * (force ? Rational(1) : scale);
    for (const Rational& end : {size, Rational(-size)})
      result_.push_back({{at(end)}, {}, words_at(vanishing, end), false, vanishing});
  }

  const Geometry& geometry_;
  const Elimination& elimination_;
  const Mechanism& mechanism_;
  const PreloadColumns& columns_;
  const FactoredPoly& determinant_;
  const core::LocusProblem& demanded_;
  const Selection& selection_;
  std::vector<std::string>& notes_;
  std::vector<PreloadConstraint> result_;
};

}  // namespace

std::string PreloadColumns::motors(const Mechanism& mechanism) const {
  std::string names;
  for (const mechanism::JointIndex joint : joints)
    names += (names.empty() ? "" : ", ") + mechanism.joints[static_cast<std::size_t>(joint)].name;
  return names;
}

PreloadColumns preload_columns(const Geometry& geometry, const Elimination& elimination,
                               const FactoredDeterminants& loads) {
  PreloadColumns columns{loads.equations.free_joints, {}};
  columns.reactions.push_back(all_reactions(geometry, elimination, loads, columns.notes));
  for (std::size_t e = 0; e < columns.joints.size(); ++e)
    columns.reactions.push_back(all_reactions(geometry, elimination, effort_determinants(geometry, e), columns.notes));
  return columns;
}

std::vector<Reaction> at_every_effort(const PreloadColumns& columns) {
  std::vector<Reaction> contents = columns.reactions.front();
  for (std::size_t i = 0; i < contents.size(); ++i) {
    std::vector<const FactoredPoly*> polynomials;
    for (const std::vector<Reaction>& column : columns.reactions) polynomials.push_back(&column[i].numerator);
    contents[i].numerator = preload_row(polynomials).content;
  }
  return contents;
}

bool is_singular_by_choice(const PreloadColumns& columns, const Mechanism& mechanism, const Poly& factor,
                           bool controlled) {
  for (std::size_t e = 0; e < columns.joints.size(); ++e) {
    if (!controlled && !mechanism::is_cable(mechanism.joints[static_cast<std::size_t>(columns.joints[e])])) continue;
    for (const Reaction& reaction : columns.reactions[e + 1])
      if (!reaction.numerator.is_zero() && reaction.numerator.multiplicity(factor) == 0) return true;
  }
  return false;
}

std::vector<PreloadConstraint> preload_constraints(const Geometry& geometry, const Elimination& elimination,
                                                   const PreloadColumns& columns, const FactoredPoly& determinant,
                                                   const core::LocusProblem& demanded, const Selection& selection,
                                                   std::vector<std::string>& notes) {
  return Demands(geometry, elimination, columns, determinant, demanded, selection, notes).run();
}

}  // namespace clearloci::symbolic
