#include "symbolic/factor_emission.hpp"

#include <algorithm>

#include "core/shown_units.hpp"

namespace clearloci::symbolic {

using core::FactorRole;
using core::LocusFactor;
using core::Quantity;

int FactorEmission::times_in(Poly p, const Poly& divisor) {
  int times = 0;
  for (Poly quotient = p; p.divides(divisor, quotient); p = quotient) ++times;
  return times;
}

bool FactorEmission::is_product_of_denominators(Poly p) const {
  for (const Poly& denominator : d_.elimination.denominator_factors())
    for (Poly quotient = p; p.divides(denominator, quotient);) p = quotient;
  return p.is_constant();
}

std::optional<Poly> FactorEmission::add_both_senses(const TwoSenses& senses, std::vector<SheetFactor> parts,
                                                    std::array<LocusFactor, 2> factors) {
  const Poly t = Poly::variable(d_.geometry.ring(), d_.geometry.auxiliary());
  const Poly square_of_w = senses.square();
  const auto parts_of = [&](const Poly& natural) {
    return d_.elimination.over_tower(natural).coefficients(d_.geometry.auxiliary());
  };
  // Coefficients of t^0 and t^1 over the tower have one denominator.
  const std::vector<Poly> sides = parts_of(senses.size * t + senses.bound), length = parts_of(square_of_w + t);
  if (sides.size() != 2 || length.size() != 2 || length[0].is_constant()) return std::nullopt;
  // |w| = root / length[1], root^2 = length[0] length[1].
  Poly left = sides[1], right = d_.geometry.reduce(sides[0] * length[1]);
  const Poly shared = gcd(left, right);
  left = left.exact_quotient(shared);
  right = right.exact_quotient(shared);
  std::erase_if(parts, [&](const SheetFactor& part) {
    return part.multiplicity <= 2 * times_in(shared, part.sheet);  // of the product, the square is shared
  });

  const std::vector<int> variables = d_.geometry.tower_variables();
  // A root of about the size of the coordinates: numerical steps along the curve weigh it against them.
  const core::Polynomial unscaled = d_.geometry.reduce(length[0] * length[1]).plain(variables);
  core::Polynomial square = core::scaled_for_doubles(unscaled);
  core::Rational gained = square.terms.front().coefficient / unscaled.terms.front().coefficient;
  if (!rational_root(gained)) {
    square = square + square;
    gained *= 2;
  }
  const core::Rational root_of_gained = *rational_root(gained);
  const core::Polynomial divisor = length[1].plain();
  const core::Rational gained_below =
      core::scaled_for_doubles(divisor).terms.front().coefficient / divisor.terms.front().coefficient;
  const Poly below = length[1].scaled(gained_below);
  const auto found = std::find_if(more_roots_.begin(), more_roots_.end(),
                                  [&](const core::Root& root) { return root.square == square; });
  const auto index = static_cast<int>(variables.size() + static_cast<std::size_t>(found - more_roots_.begin()));
  if (found == more_roots_.end())
    more_roots_.push_back(
        {.name = "s" + std::to_string(d_.result.problem.tower.roots.size() + more_roots_.size() + 1),
         .point = "",
         .role = core::RootRole::length,
         .square = square,
         .line = d_.lines.square(gained / (gained_below * gained_below * senses.over), senses.w, below)});
  d_.lines.let(d_.geometry.auxiliary(), index, below);
  const core::Rational length_of_t = gained_below / root_of_gained;
  const bool same_zeros = is_product_of_denominators(shared);
  left = left.scaled(1 / root_of_gained);
  for (const int sense : {1, -1}) {
    LocusFactor& factor = factors[sense > 0 ? 0 : 1];
    if (same_zeros) factor.line = d_.lines.of((senses.size * t).scaled(length_of_t) - senses.bound.scaled(sense));
    for (const SheetFactor& part : parts) put_implicit(part, factor);
    const core::Polynomial root = core::variable_polynomial(index + 1, index);
    const auto widened = [&](const Poly& p) { return core::with_variables(p.plain(variables), index + 1); };
    factor.sheet = core::scaled_for_doubles(sense > 0 ? widened(left) * root - widened(right)
                                                      : widened(left) * root + widened(right));
    const auto words = [&](const auto& write) {
      return "(" + write(senses.size) + ")*sqrt(" + write(square_of_w) + (sense > 0 ? ") - (" : ") + (") +
             write(senses.bound) + ")";
    };
    factor.expression = words([this](const Poly& p) { return d_.words.of(p); });
    if (d_.mechanism.frame)
      d_.words.note(factor.expression, words([this](const Poly& p) { return d_.words.in_file(p); }));
    d_.result.problem.factors.push_back(std::move(factor));
  }
  return shared;
}

std::vector<SheetFactor> FactorEmission::parts_of_margin(const Poly& squared) const {
  std::vector<SheetFactor> parts = d_.elimination.sheet_factors(squared, true);
  std::erase_if(parts, [](const SheetFactor& part) { return part.of_divided; });
  return parts;
}

bool FactorEmission::add_senses(const TwoSenses& senses, const Poly& squared, LocusFactor common) {
  const std::vector<SheetFactor> parts = parts_of_margin(squared);
  if (parts.size() != 1 || parts.front().multiplicity != 1) return false;
  common.role = FactorRole::margin;
  for (auto& [sheet, times] : common.cleared) times /= 2;  // unsquared
  return add_both_senses(senses, parts, {common, common}).has_value();
}

void FactorEmission::add_ends(const TwoSenses& senses, const std::array<LocusFactor, 2>& ends,
                              const std::string& joint) {
  const Poly squared =
      d_.elimination.over_tower(senses.size * senses.size * senses.square() - senses.bound * senses.bound);
  const std::optional<Poly> shared =
      squared.is_zero() ? std::nullopt : add_both_senses(senses, parts_of_margin(squared), ends);
  if (!shared) {
    d_.result.notes.push_back("where the ends of the guide " + joint + " lift is not traced in full");
    return;
  }
  LocusFactor both = ends[0];
  both.vanishing.insert(both.vanishing.end(), ends[1].vanishing.begin(), ends[1].vanishing.end());
  if (both.role == FactorRole::reaction) both.cause = "guide " + joint + " bears nothing";
  both.expression = d_.words.of(*shared);
  add(both.role, nullptr, *shared, true, both);
}

std::vector<std::pair<core::Polynomial, int>> FactorEmission::cleared_by(const FactoredPoly& below, int power) const {
  std::vector<std::pair<core::Polynomial, int>> parts;
  for (const DeterminantPart& part : d_.determinant_parts)
    if (const int times = below.multiplicity(part.natural->poly); times > 0)
      parts.emplace_back(core::scaled_for_doubles(part.sheet.sheet.plain(d_.geometry.tower_variables())),
                         times * part.sheet.multiplicity * power);
  return parts;
}

void FactorEmission::add_guide_margins() {
  for (const Guide& guide : d_.guides) {
    if (!d_.selected(guide.joint)) continue;
    const Ring& ring = d_.geometry.ring();
    const FactoredPoly shared = common_factors(guide.common, d_.determinants.determinant);
    const Poly common = without(guide.common, shared, ring);
    const Poly limit =
        without(d_.determinants.determinant, shared, ring).scaled(2 * guide.half_length * *d_.selection.min_force);
    const Poly bears = guide.bears * common, turns = guide.turns * common;
    if (bears.is_zero() && turns.is_zero()) continue;
    FactoredPoly below = d_.determinants.determinant;
    multiply(below, shared, -1);
    LocusFactor margin;
    margin.role = FactorRole::margin;
    margin.cleared = cleared_by(below, 1);
    const auto of_end = [&](Quantity end) {
      LocusFactor factor = margin;
      factor.vanishing = {{guide.joint, end, 1}};
      factor.cause =
          "end of guide " + guide.joint + " at " + core::told(core::to_double(*d_.selection.min_force), "N", {});
      return factor;
    };
    if (!guide.length && turns.is_zero()) {  // both ends bear alike
      LocusFactor both = of_end(Quantity::end_ahead);
      both.vanishing.push_back({guide.joint, Quantity::end_behind, 1});
      add_ends({bears, guide.axis, limit}, {both, both}, guide.joint);
      continue;
    }
    if (!guide.length && !bears.is_zero()) {
      for (const Poly& bound : {turns - limit, turns + limit})
        add_ends({bears, guide.axis, bound}, {of_end(Quantity::end_behind), of_end(Quantity::end_ahead)}, guide.joint);
      continue;
    }
    std::vector<std::pair<Poly, LocusFactor>> curves;
    for (const Quantity end : {Quantity::end_ahead, Quantity::end_behind})
      for (const Poly& bound : {limit, -limit}) {
        const Poly natural = (end_numerator(guide, end) * common - bound).primitive();
        const auto found =
            std::find_if(curves.begin(), curves.end(), [&](const auto& c) { return c.first == natural; });
        if (found == curves.end())
          curves.emplace_back(natural, of_end(end));
        else
          found->second.vanishing.push_back({guide.joint, end, 1});
      }
    for (auto& [natural, factor] : curves) {
      factor.expression = d_.words.of(natural);
      const Poly sheet = d_.elimination.over_tower(natural);
      if (sheet.is_zero())
        d_.result.notes.push_back(factor.cause + " in every pose");
      else
        add(FactorRole::margin, &natural, sheet, true, factor);
    }
  }
}

void FactorEmission::add_squared_margin(const Margin& margin, const Poly& sheet, const LocusFactor& factor) {
  std::vector<LocusFactor>& factors = d_.result.problem.factors;
  const std::size_t before = factors.size();
  add(FactorRole::margin, &margin.natural, sheet, true, factor);
  if (factors.size() != before + 1 || factors.back().line.empty() || d_.geometry.coordinates() != 2) return;
  if (std::optional<MarginNodes::Form> form = margin_nodes_.of(margin)) {
    factors.back().line = std::move(form->line);
    factors.back().nodes = std::move(form->nodes);
  }
}

void FactorEmission::moving_guides() {
  for (const Guide& guide : d_.guides) {
    if (guide.is_polynomial() || !d_.selected(guide.joint)) continue;
    if (!d_.wanted(Quantity::end_ahead) && !d_.wanted(Quantity::end_behind)) continue;
    std::array<LocusFactor, 2> ends;
    for (const bool ahead : {false, true}) {
      LocusFactor& end = ends[ahead ? 1 : 0];
      end.role = FactorRole::reaction;
      end.vanishing = {{guide.joint, ahead ? Quantity::end_ahead : Quantity::end_behind, 1}};
      end.cause = std::string("end ") + (ahead ? "ahead" : "behind") + " of guide " + guide.joint + " without load";
    }
    add_ends({guide.bears, guide.axis, guide.turns}, ends, guide.joint);
  }
}

namespace {

/// "contact force of A, B and force of S".
std::string words_of_sizes(const std::vector<core::Vanishing>& reactions) {
  std::string words;
  for (const auto& [quantity, name] :
       {std::pair{Quantity::f, "contact force of "}, {Quantity::F, "force of "}, {Quantity::M, "couple of "}}) {
    std::string names;
    for (const core::Vanishing& vanishing : reactions)
      if (vanishing.quantity == quantity) names += (names.empty() ? "" : ", ") + vanishing.joint;
    if (!names.empty()) words += (words.empty() ? "" : " and ") + (name + names);
  }
  return words;
}

}  // namespace

void FactorEmission::margins() {
  for (const Margin& margin : symbolic::margins(d_.geometry, d_.elimination, d_.determinants.determinant, d_.reactions,
                                                d_.selection, d_.result.problem.joints)) {
    LocusFactor factor;
    factor.vanishing = margin.reactions;
    const bool force = margin.reactions.front().quantity != Quantity::M;
    const core::Rational unit = d_.mechanism.frame && !force ? d_.mechanism.frame->scale : core::Rational(1);
    const std::string bound = core::told(core::to_double(core::Rational(margin.bound * unit)), force ? "N" : "N m", {});
    factor.cleared = cleared_by(margin.below, margin.power);
    factor.expression = d_.words.of(margin.natural);
    factor.cause = words_of_sizes(margin.reactions) + " at " + bound;
    const Poly sheet = d_.elimination.over_tower(margin.natural);
    if (sheet.is_zero())
      d_.result.notes.push_back(factor.cause + " in every pose");
    else if (!margin.senses || !add_senses(*margin.senses, sheet, factor))
      add_squared_margin(margin, sheet, factor);
  }
  if (d_.selection.min_force) add_guide_margins();
}

}  // namespace clearloci::symbolic
