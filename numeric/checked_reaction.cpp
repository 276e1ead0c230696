#include "numeric/checked_reaction.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/take_up.hpp"

namespace clearloci::numeric {
namespace {

using core::Quantity;

int joint_of(const NumericModel& model, const TracedReaction& reaction) {
  const auto& joints = model.mechanism.joints;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].name == reaction.joint) return static_cast<int>(j);
  return -1;
}

WitnessColumns columns_of(const NumericModel& model, const TracedReaction& reaction) {
  const int joint = joint_of(model, reaction);
  const auto column = [&](Quantity quantity) {
    const int found = joint < 0 ? -1 : column_of(model, joint, quantity);
    if (found >= 0) return found;
    throw core::InputError({model.mechanism.file, 0, 0},
                           "joint " + reaction.joint + " has no reaction " + core::to_string(reaction.quantity),
                           "name a joint of the mechanism, and M only where it is actuated");
  };
  if (core::is_guide_end(reaction.quantity)) {
    const double h = joint_clearances(model.mechanism)[static_cast<std::size_t>(joint)].half_length;
    if (!(h > 0))
      throw core::InputError({model.mechanism.file, 0, 0}, "the ends of the guide " + reaction.joint + " are not known",
                             "give its clearance a half_length");
    const double lever = (reaction.quantity == Quantity::end_ahead ? 1 : -1) / h;
    return {column(Quantity::N), column(Quantity::T), -1, lever};
  }
  if (reaction.quantity != Quantity::f) return {column(reaction.quantity)};
  if (joint >= 0 && mechanism::is_slot(model.mechanism, model.mechanism.joints[static_cast<std::size_t>(joint)]))
    return {column(Quantity::N)};
  if (model.mechanism.space == mechanism::Space::planar) return {column(Quantity::fx), column(Quantity::fy)};
  const bool pin =
      mechanism::presses_across_axis(model.mechanism, model.mechanism.joints[static_cast<std::size_t>(joint)]);
  return {column(Quantity::fx), column(Quantity::fy), column(Quantity::fz), 0, pin ? joint : -1};
}

std::vector<Quantity> force_parts(const NumericModel& model, const TracedReaction& reaction) {
  const mechanism::Joint& joint = model.mechanism.joints[static_cast<std::size_t>(joint_of(model, reaction))];
  // A guide whose ends are not known loses its contact where it bears nothing at all.
  if (mechanism::is_guide(model.mechanism, joint)) return mechanism::reaction_components(model.mechanism, joint);
  return mechanism::force_components(model.mechanism, joint);
}

}  // namespace

CheckedReaction checked_reaction(const NumericModel& model, const TracedReaction& reaction) {
  return {reaction, columns_of(model, reaction), force_parts(model, reaction), {}};
}

bool tells_zeros(core::LocusKind kind) { return kind != core::LocusKind::margin && kind != core::LocusKind::preload; }

int times_vanishing(core::LocusKind kind, const std::vector<core::Vanishing>& vanishing,
                    const CheckedReaction& checked) {
  if (!tells_zeros(kind)) return 0;
  const TracedReaction& reaction = checked.reaction;
  const std::vector<Quantity>& parts = checked.force;
  const auto multiplicity = [&](Quantity quantity) {
    const auto found = std::find_if(vanishing.begin(), vanishing.end(), [&](const core::Vanishing& v) {
      return v.joint == reaction.joint && v.quantity == quantity;
    });
    return found == vanishing.end() ? 0 : found->multiplicity;
  };
  if (const int order = multiplicity(reaction.quantity)) return order;
  const bool is_part = std::find(parts.begin(), parts.end(), reaction.quantity) != parts.end();
  if (is_part) return multiplicity(Quantity::f);
  if (reaction.quantity != Quantity::f || parts.empty()) return 0;
  int least = multiplicity(parts.front());
  for (const Quantity part : parts) least = std::min(least, multiplicity(part));
  return least;
}

EdgeNodes edge_nodes(const ReactionField& of_first, std::size_t first, const ReactionField& of_second,
                     std::size_t second, const WitnessColumns& columns) {
  EdgeNodes nodes{of_first.reachable(first), of_second.reachable(second), Parity::unknown};
  if (!nodes.first_reachable || !nodes.second_reachable || columns.pin >= 0) return nodes;
  const auto force = [&](const ReactionField& field, std::size_t pose) {
    const auto numerator = [&](int column) { return column < 0 ? 0.0 : field.numerator(column)[pose]; };
    if (columns.lever != 0)
      return ForceNumerators{numerator(columns.first) + columns.lever * numerator(columns.second), 0, 0};
    return ForceNumerators{numerator(columns.first), numerator(columns.second), numerator(columns.third)};
  };
  // One component: the cosine is a sign. Across which axis a field does not tell.
  const double cosine = turn_cosine(force(of_first, first), force(of_second, second));
  if (std::abs(cosine) > least_cosine) nodes.change = cosine > 0 ? Parity::even : Parity::odd;
  return nodes;
}

void add_tally(ValidationReport& report, const core::WorkingMode& mode, const TracedReaction& reaction,
               const std::array<std::size_t, 4>& counts, bool identically_zero) {
  const auto count = [&](Outcome v) { return counts[static_cast<std::size_t>(v)]; };
  report.tallies.push_back({mode, reaction, count(Outcome::held), count(Outcome::disputed), count(Outcome::undecided),
                            count(Outcome::outside), identically_zero});
  report.held += count(Outcome::held);
  report.disputed += count(Outcome::disputed);
  report.undecided += count(Outcome::undecided);
  report.outside += count(Outcome::outside);
}

TendencyTally tally_of(const std::vector<Approach>& ways, const WitnessColumns& columns) {
  TendencyTally tally;
  for (const Approach& way : ways) {
    const std::optional<Tendency> found = tendency(way, columns);
    if (!found) continue;
    ++(*found == Tendency::zero ? tally.zero : tally.other);
    if (*found == Tendency::unbounded) ++tally.unbounded;
  }
  return tally;
}

}  // namespace clearloci::numeric
