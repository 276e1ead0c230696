#include "analysis/pose.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/flanks.hpp"
#include "analysis/framed.hpp"
#include "analysis/model.hpp"
#include "analysis/pose_answer.hpp"
#include "analysis/pose_efforts.hpp"
#include "analysis/pose_tensions.hpp"
#include "analysis/request_limits.hpp"
#include "analysis/singular_modes.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "core/shown_units.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/fits.hpp"
#include "mechanism/free_cables.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/notes.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/written_unit.hpp"
#include "numeric/dynamics.hpp"
#include "numeric/pose_error.hpp"

namespace clearloci {
namespace {

/// A pose that was written in decimals stands for its exact value, which is no double: a pose on a locus is one.
std::vector<numeric::Bounded> with_rounding(const std::vector<core::Rational>& exact) {
  std::vector<numeric::Bounded> pose;
  for (const core::Rational& value : exact) {
    const double nearest = core::to_double(value);
    pose.emplace_back(nearest, core::Rational(nearest) == value ? 0.0 : numeric::unit_roundoff * std::abs(nearest));
  }
  return pose;
}

/// Of the limits that a pose is beyond the one that it is farthest beyond.
std::string words_beyond(const numeric::NumericModel& model, const DyadSides& sides, const numeric::Posture& posture,
                         std::span<const double> at) {
  numeric::LimitEnd end = *posture.broken;
  // An angle between points that coincide keeps no limit, and is beyond it by nothing that has a size.
  if (const auto tightest = numeric::tightest_limit(model, at, sides); tightest && tightest->slack < 0) end = *tightest;
  const mechanism::Mechanism& m = model.mechanism;
  return mechanism::words_of_end(m, end.limit, end.upper);
}

}  // namespace

std::string words_of_no_pose(const mechanism::Mechanism& mechanism, const std::string& what) {
  const numeric::NumericModel model = numeric::compile(mechanism);
  const DyadSides sides = mechanism::working_mode(mechanism);
  std::vector<double> middle;
  for (const mechanism::Coordinate& c : mechanism.coordinates)
    middle.push_back(core::to_double(core::Rational((c.lower + c.upper) / 2)));
  const numeric::Posture posture = posture_at(model, middle, sides);
  if (posture.unreachable || !posture.broken) return what + ": the mechanism does not close in the workspace";
  return what + ": the middle of the workspace is beyond the limit of the " +
         words_beyond(model, sides, posture, middle);
}

namespace {

/// Cables whose tension follows a law have no unknown.
void add_tensions_by_law(const mechanism::Mechanism& mechanism, Pose& pose) {
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    const mechanism::Joint& joint = mechanism.joints[j];
    if (mechanism::is_cable(joint) && joint.effort && !joint.free_effort)
      pose.reactions[j].components.push_back(
          {core::Quantity::F, mechanism::sample_number(mechanism, *joint.effort, pose.at)});
  }
}

/// Reactions and what follows from them, with the links' inertia.
void put_in_motion(const mechanism::Mechanism& mechanism, const DyadSides& sides, const PoseRequest& request,
                   Pose& pose) {
  const numeric::Motion motion = numeric::compile_motion(mechanism, sides);
  std::vector<numeric::Series> coordinates;
  for (std::size_t c = 0; c < pose.at.size(); ++c) {
    numeric::Series& series = coordinates.emplace_back(pose.at[c]);
    if (!request.velocity.empty()) series.c[1] = request.velocity[c];
    if (!request.acceleration.empty()) series.c[2] = request.acceleration[c] / 2;
  }
  const numeric::Instant instant = numeric::instant_of(motion, coordinates);
  constexpr double second = 1;  // the period of a single instant
  const Eigen::VectorXd values = instant.reactions(second);
  pose.reactions = reactions_of(motion.model, values, numeric::joint_reactions(motion, instant, values));
  add_tensions_by_law(mechanism, pose);
  const numeric::InstantError accuracy = numeric::instant_error(motion, instant, second);
  pose.take_up = take_up_of(mechanism, accuracy.contacts, accuracy.take_up);
  pose.undefined = numeric::undefined_take_up(mechanism, accuracy.contacts, accuracy.take_up);
  pose.vanishing = numeric::lost_reactions(mechanism, accuracy.contacts, accuracy.take_up);
  pose.error.reset();
  if (pose.undefined.empty()) pose.error = error_of(mechanism.space, accuracy.error);
}

void solve_at(const numeric::NumericModel& model, const std::vector<numeric::Bounded>& at, const DyadSides& sides,
              const PoseRequest& request, Pose& pose) {
  const mechanism::Mechanism& m = model.mechanism;
  const numeric::Posture posture = posture_at(model, pose.at, sides);
  if (posture.unreachable) {
    pose.unreachable = name_of(m, *posture.unreachable);
    return;
  }
  if (posture.broken) {
    pose.beyond_limit = words_beyond(model, sides, posture, pose.at);
    return;
  }
  const numeric::Accuracy accuracy = numeric::pose_accuracy(model, posture, numeric::lost_contacts(model, at, sides));
  const numeric::Bounded determinant = numeric::bounded_numerators(model, at, sides).determinant;
  pose.points = named_points(m, posture.points);
  pose.reactions = reactions_of(model, accuracy.reactions.values, accuracy.of_joints);
  add_tensions_by_law(m, pose);
  pose.determinant = accuracy.reactions.determinant;
  pose.condition = accuracy.reactions.condition;
  pose.singular = !(std::abs(determinant.value) > determinant.error);
  pose.take_up = take_up_of(m, accuracy.contacts, accuracy.take_up);
  if (accuracy.undefined.empty()) pose.error = error_of(m.space, accuracy.error);
  const numeric::WorstCase& worst = accuracy.worst;
  pose.worst = {components(m.space, worst.dp), rotations(m.space, worst.dalpha), worst.distance, worst.rotation};
  pose.undefined = accuracy.undefined;
  pose.vanishing = numeric::lost_reactions(m, accuracy.contacts, accuracy.take_up);
  if (request.iterate)
    pose.actual = actual_of(model, accuracy.contacts, numeric::actual_pose(model, posture, accuracy));
  if (!request.velocity.empty() || !request.acceleration.empty()) put_in_motion(m, sides, request, pose);
}

/// Coordinates outside the range that is searched, as of degrees that were meant and taken for rad.
void note_outside(const mechanism::Mechanism& mechanism, Pose& pose) {
  for (std::size_t c = 0; c < pose.at.size(); ++c) {
    const mechanism::Coordinate& coordinate = mechanism.coordinates[c];
    const double lower = core::to_double(coordinate.lower), upper = core::to_double(coordinate.upper);
    if (lower <= pose.at[c] && pose.at[c] <= upper) continue;
    const auto told = [&](double value) { return core::told(value, coordinate.angle ? "rad" : "m", mechanism.units); };
    pose.notes.push_back(coordinate.name + " = " + told(pose.at[c]) + " is outside its range, " + told(lower) + " to " +
                         told(upper));
  }
}

/// Determined efforts that their actuators do not exert.
void note_beyond_bounds(const mechanism::Mechanism& mechanism, Pose& pose) {
  for (std::size_t j = 0; j < pose.reactions.size(); ++j) {
    const mechanism::Joint& joint = mechanism.joints[j];
    if (!joint.actuated || !joint.within) continue;
    const double least = core::to_double(joint.within->first), most = core::to_double(joint.within->second);
    const double hair = 1e-9 * (most - least);  // of rounding, where a choice is at a bound
    for (const ReactionComponent& component : pose.reactions[j].components) {
      if (component.quantity != mechanism::actuator_quantity(joint) ||
          (least - hair <= component.value && component.value <= most + hair))
        continue;
      const auto told = [&](double value) {
        return core::told(value, core::unit_of(component.quantity), mechanism.units, 4);
      };
      pose.notes.push_back(core::to_string(component.quantity) + "_" + joint.name + " = " + told(component.value) +
                           " is beyond its bounds, " + told(least) + " to " + told(most));
    }
  }
}

}  // namespace

void require_values(const mechanism::Mechanism& mechanism, std::size_t count) {
  const std::size_t wanted = mechanism.coordinates.size();
  if (count == wanted) return;
  std::string names;
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates)
    names += (names.empty() ? "" : ", ") + coordinate.name;
  throw core::InputError({mechanism.file},
                         "a pose has " + std::to_string(wanted) + " values, not " + std::to_string(count),
                         "give one for each free coordinate: " + names);
}

std::vector<std::pair<std::string, std::string>> named_mode(const mechanism::Mechanism& mechanism,
                                                            const DyadSides& sides) {
  const std::vector<mechanism::PointIndex> points = mechanism::dyad_points(mechanism);
  std::vector<std::pair<std::string, std::string>> mode;
  for (std::size_t j = 0; j < points.size(); ++j)
    mode.emplace_back(name_of(mechanism, points[j]), mechanism::side_name(mechanism, points[j], sides[j]));
  return mode;
}

DyadSides sides_of(const mechanism::Mechanism& mechanism, const DyadSides& sides) {
  DyadSides dyad_sides = mechanism::working_mode(mechanism);
  if (sides.empty()) return dyad_sides;
  const bool signs = std::all_of(sides.begin(), sides.end(), [](int side) { return side == 1 || side == -1; });
  if (sides.size() != dyad_sides.size() || !signs)
    throw core::InputError({mechanism.file}, "the working mode is none of this mechanism",
                           "give +1 or -1 for each of its " + std::to_string(dyad_sides.size()) + " dyads and sliders");
  return sides;
}

namespace {

/// With an effort of every free actuator.
Pose solve_given(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                 const PoseRequest& request) {
  const std::vector<numeric::Bounded> values = with_rounding(at);
  if (const std::optional<Framed> framed = framed_where_far(mechanism)) {
    std::vector<core::Rational> inside = at;
    for (std::size_t i = 0; i < inside.size(); ++i) inside[i] -= framed->frame.from[i];
    Pose pose = from_frame(solve_given(framed->mechanism, inside, request), mechanism, framed->frame);
    for (std::size_t i = 0; i < values.size(); ++i) pose.at[i] = values[i].value;
    note_outside(mechanism, pose);
    return pose;
  }
  const DyadSides sides = sides_of(mechanism, request.working_mode);
  require_regular(mechanism, sides);
  Pose pose;
  pose.mechanism = mechanism.name;
  pose.parameters = mechanism::told_parameters(mechanism);
  pose.units = mechanism.units;
  pose.notes = mechanism::fit_notes(mechanism);
  for (std::string& note : mechanism::notes_of(mechanism)) pose.notes.push_back(std::move(note));
  if (mechanism.relative_to != mechanism::ground)
    pose.relative_to = mechanism.links[static_cast<std::size_t>(mechanism.relative_to)].name;
  for (const numeric::Bounded& value : values) pose.at.push_back(value.value);
  for (const mechanism::Coordinate& coordinate : mechanism.coordinates) pose.angles.push_back(coordinate.angle);
  pose.working_mode = named_mode(mechanism, sides);
  if (!mechanism.frame) note_outside(mechanism, pose);  // else in the coordinates of the file, by the caller
  solve_at(numeric::compile(mechanism), values, sides, request, pose);
  note_beyond_bounds(mechanism, pose);
  return pose;
}

/// Where no working mode is asked for, on the flanks that the load presses.
Pose solve_on_flanks(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                     const PoseRequest& request) {
  Pose pose = solve_given(mechanism, at, request);
  for (const std::string& belt : slack_belts(mechanism, pose))
    pose.notes.push_back("a span of belt " + belt + " is slack");
  const std::vector<std::string> pulled = pulled_gears(mechanism, pose);
  if (pulled.empty()) return pose;
  PoseRequest pose_request = request;
  if (request.working_mode.empty())
    for (const DyadSides& sides : modes_of_flanks(mechanism, mechanism::working_mode(mechanism))) {
      pose_request.working_mode = sides;
      if (Pose other = solve_given(mechanism, at, pose_request); pulled_gears(mechanism, other).empty()) return other;
    }
  pose.notes.push_back(words_of_pulled(pulled) + ": in this working mode its teeth would have to pull");
  return pose;
}

}  // namespace

Pose solve_pose(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                const PoseRequest& request) {
  require_values(mechanism, at.size());
  require_rates(mechanism, request);
  if (mechanism::preloaded_joints(mechanism).empty()) return solve_on_flanks(mechanism, at, request);
  const std::vector<numeric::Bounded> values = with_rounding(at);
  const DyadSides sides = sides_of(mechanism, request.working_mode);
  PoseEfforts chosen = only_tensions_are_free(mechanism) ? pose_tensions(mechanism, values, sides)
                                                         : pose_efforts(mechanism, values, sides, request);
  Pose pose = solve_given(chosen.mechanism, at, request);
  for (std::string& note : chosen.notes) pose.notes.push_back(std::move(note));
  const bool at_rest = request.velocity.empty() && request.acceleration.empty();
  if (at_rest && pose.unreachable.empty() && pose.beyond_limit.empty()) pose.efforts = std::move(chosen.efforts);
  return pose;
}

Pose solve_pose(const Model& model, const std::vector<double>& at, const PoseRequest& request) {
  check_least(request.min_force, request.min_couple);
  return solve_pose(model.content().mechanism, exact_values(at), request);
}

void require_iterated(const Pose& pose, const std::string& option) {
  if (pose.actual && !pose.actual->converged)
    throw core::InputError({.file = option}, "the pose error cannot be iterated: " + pose.actual->reason,
                           "do without, choose another pose or smaller clearances");
}

}  // namespace clearloci
