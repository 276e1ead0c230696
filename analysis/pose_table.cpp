// Reactions at many poses, as a table (clearloci/pose.hpp).
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/model.hpp"
#include "analysis/pose.hpp"
#include "analysis/pose_answer.hpp"
#include "analysis/singular_modes.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "numeric/reactions.hpp"

namespace clearloci {
namespace {

void add_column(const mechanism::Mechanism& mechanism, const mechanism::Unknown& unknown, std::vector<double> values,
                Reactions& all) {
  all.table.names.push_back(mechanism::unknown_name(mechanism, unknown));
  all.table.units.push_back(core::unit_of(unknown.quantity));
  all.table.columns.push_back(std::move(values));
  all.joints.push_back(mechanism.joints[static_cast<std::size_t>(unknown.joint)].name);
  all.quantities.push_back(unknown.quantity);
}

Reactions reactions_in_plane(const mechanism::Mechanism& mechanism, std::span<const double> poses,
                             const DyadSides& sides) {
  const numeric::NumericModel model = numeric::compile(mechanism);
  numeric::ReactionField field;
  numeric::reaction_field(model, poses, sides, field);
  Reactions all;
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    if (is_held_turning(mechanism, model.unknowns[k])) continue;
    std::vector<double> values(field.poses);
    for (std::size_t i = 0; i < field.poses; ++i) values[i] = field.reaction(static_cast<int>(k), i);
    add_column(mechanism, model.unknowns[k], std::move(values), all);
  }
  return all;
}

/// Pose by pose: the compiled equations of space have the actuator's share in the joint's force and couple.
Reactions reactions_in_space(const mechanism::Mechanism& mechanism, std::span<const double> poses,
                             const DyadSides& sides) {
  const numeric::NumericModel model = numeric::compile(mechanism);
  const std::size_t width = mechanism.coordinates.size(), count = poses.size() / width;
  Reactions all;
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (const ReactionComponent& component : reaction_in_space(mechanism, j, {}).components)
      add_column(mechanism, {static_cast<mechanism::JointIndex>(j), component.quantity},
                 std::vector<double>(count, std::numeric_limits<double>::quiet_NaN()), all);
  for (std::size_t i = 0; i < count; ++i) {
    const numeric::Posture posture = posture_at(model, poses.subspan(i * width, width), sides);
    if (!posture.reachable()) continue;
    const Eigen::VectorXd values = numeric::solve_reactions(model, posture).values;
    std::size_t column = 0;
    for (const JointReaction& joint : reactions_of(
             model, values,
             numeric::joint_reactions(mechanism.joints.size(), numeric::reaction_columns(model, posture), values)))
      for (const ReactionComponent& component : joint.components) all.table.columns[column++][i] = component.value;
  }
  return all;
}

}  // namespace

Reactions reactions(const Model& model, std::span<const double> poses, const DyadSides& working_mode) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  const std::size_t width = mechanism.coordinates.size();
  if (width == 0 || poses.size() % width != 0)
    require_values(mechanism, width == 0 ? poses.size() : poses.size() % width);
  if (!std::all_of(poses.begin(), poses.end(), [](double value) { return std::isfinite(value); }))
    throw core::InputError({}, "a value of a pose is no number", "give finite numbers");
  const DyadSides sides = sides_of(mechanism, working_mode);
  require_regular(mechanism, sides);
  return mechanism.space == mechanism::Space::spatial ? reactions_in_space(mechanism, poses, sides)
                                                      : reactions_in_plane(mechanism, poses, sides);
}

}  // namespace clearloci
