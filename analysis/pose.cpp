#include "analysis/pose.hpp"

#include "analysis/loci.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "analysis/flanks.hpp"
#include "analysis/framed.hpp"
#include "analysis/model.hpp"
#include "analysis/pose_efforts.hpp"
#include "analysis/pose_tensions.hpp"
#include "analysis/singular_modes.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "core/shown_units.hpp"
#include "loci/sheet/sheet.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/fits.hpp"
#include "mechanism/free_cables.hpp"
#include "mechanism/group_closing.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/notes.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/rigidity.hpp"
#include "mechanism/written_unit.hpp"
#include "numeric/displaced.hpp"
#include "numeric/dynamics.hpp"
#include "numeric/pose_error.hpp"

namespace clearloci {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A pose that was written in decimals stands for its exact value, which is no double: a pose on a locus is one.
std::vector<numeric::Bounded> with_rounding(const std::vector<core::Rational>& exact) {
  std::vector<numeric::Bounded> pose;
  for (const core::Rational& value : exact) {
    const double nearest = core::to_double(value);
    pose.emplace_back(nearest, core::Rational(nearest) == value ? 0.0 : numeric::unit_roundoff * std::abs(nearest));
  }
  return pose;
}

/// The shortest decimal that reads back as the same double.
core::Rational written(double value) {
  if (!std::isfinite(value)) throw core::InputError({}, "a value of the pose is no finite number", "give m and rad");
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return core::rational_from_decimal({text.data(), static_cast<std::size_t>(end - text.data())});
}

std::vector<PosePoint> named_points(const mechanism::Mechanism& mechanism, const auto& places) {
  std::vector<PosePoint> points;
  for (std::size_t i = 0; i < mechanism.points.size(); ++i)
    if (!mechanism.points[i].auxiliary)
      points.push_back({mechanism.points[i].name, std::vector<double>(places[i].begin(), places[i].end())});
  return points;
}

std::string name_of(const mechanism::Mechanism& mechanism, mechanism::PointIndex point) {
  return mechanism.points[static_cast<std::size_t>(point)].name;
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

std::vector<double> components(mechanism::Space space, const Eigen::Vector3d& v) {
  return space == mechanism::Space::planar ? std::vector<double>{v(0), v(1)} : std::vector<double>{v(0), v(1), v(2)};
}

std::vector<double> rotations(mechanism::Space space, const Eigen::Vector3d& v) {
  return space == mechanism::Space::planar ? std::vector<double>{v(2)} : std::vector<double>{v(0), v(1), v(2)};
}

/// Of the joints with a clearance.
std::vector<JointTakeUp> take_up_of(const mechanism::Mechanism& mechanism,
                                    const std::vector<numeric::JointContact>& contacts,
                                    const std::vector<numeric::TakeUp>& take_up) {
  const bool planar = mechanism.space == mechanism::Space::planar;
  std::vector<JointTakeUp> list;
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    const numeric::JointContact& joint = contacts[j];
    const numeric::TakeUp& t = take_up[j];
    if (!joint.clearance.any()) continue;
    JointTakeUp own;
    own.joint = mechanism.joints[j].name;
    const bool lost = t.force_vanishes && joint.presses();
    // A pin in the plane that has play but no radial clearance is displaced by nothing, in a direction.
    const bool pin = planar && mechanism::traits(joint.type).pinned && !mechanism::traits(joint.type).slides;
    if (joint.presses() || pin)
      own.displacement = components(mechanism.space, lost ? Eigen::Vector3d::Constant(nan) : t.displacement);
    if (pin) own.beta = t.beta.value_or(nan);
    if (joint.clearance.angular > 0) own.rotation = t.actuator_vanishes ? nan : t.turn;
    if (joint.clearance.axial > 0) own.axial = t.actuator_vanishes ? nan : t.travel;
    if (joint.is_guided()) {
      own.normal = t.guide_vanishes() ? nan : t.normal;
      own.tilt = t.guide_vanishes() ? nan : t.tilt;
    }
    list.push_back(std::move(own));
  }
  return list;
}

/// Of a cable: solved for, or given.
double tension_of(const mechanism::Mechanism& mechanism, const mechanism::Joint& joint, double solved) {
  return joint.free_effort ? core::to_double(mechanism::value_of(*joint.effort, mechanism)) : solved;
}

/// A joint of space: its force and couple in Cartesian components, the actuator's share apart.
JointReaction reaction_in_space(const mechanism::Mechanism& mechanism, std::size_t j, const numeric::JointReaction& r) {
  const mechanism::Joint& joint = mechanism.joints[j];
  if (mechanism::is_cable(joint) && joint.effort && !joint.free_effort) return {joint.name, {}};  // a law
  if (mechanism::is_cable(joint)) return {joint.name, {{core::Quantity::F, tension_of(mechanism, joint, r.actuator)}}};

  constexpr std::array forces = {core::Quantity::fx, core::Quantity::fy, core::Quantity::fz};
  constexpr std::array couples = {core::Quantity::mx, core::Quantity::my, core::Quantity::mz};
  JointReaction own{joint.name, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    own.components.push_back({forces[c], r.force(static_cast<Eigen::Index>(c))});
    if (mechanism::traits(joint).couple != mechanism::BorneCouple::none)
      own.components.push_back({couples[c], r.couple(static_cast<Eigen::Index>(c))});
  }
  if (joint.actuated) own.components.push_back({mechanism::actuator_quantity(joint), r.actuator});
  return own;
}

/// The couple that holds a link without extent, which is zero.
bool is_held_turning(const mechanism::Mechanism& mechanism, const mechanism::Unknown& unknown) {
  return mechanism::is_cable(mechanism.joints[static_cast<std::size_t>(unknown.joint)]) &&
         unknown.quantity != core::Quantity::F;
}

/// In the plane by the unknowns, of which `values` has one each.
std::vector<JointReaction> reactions_of(const numeric::NumericModel& model, const Eigen::VectorXd& values,
                                        const std::vector<numeric::JointReaction>& of_joints) {
  const std::vector<mechanism::Joint>& joints = model.mechanism.joints;
  std::vector<JointReaction> list;
  if (model.mechanism.space == mechanism::Space::spatial) {
    for (std::size_t j = 0; j < joints.size(); ++j) list.push_back(reaction_in_space(model.mechanism, j, of_joints[j]));
    return list;
  }
  for (const mechanism::Joint& joint : joints) list.push_back({joint.name, {}});
  for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
    const mechanism::Unknown& unknown = model.unknowns[k];
    if (is_held_turning(model.mechanism, unknown)) continue;
    list[static_cast<std::size_t>(unknown.joint)].components.push_back(
        {unknown.quantity, values[static_cast<Eigen::Index>(k)]});
  }
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (mechanism::is_cable(joints[j]) && joints[j].free_effort)
      list[j].components.push_back({core::Quantity::F, tension_of(model.mechanism, joints[j], 0)});
  return list;
}

ActualPose actual_of(const numeric::NumericModel& model, const std::vector<numeric::JointContact>& contacts,
                     const numeric::ActualPose& found) {
  ActualPose actual;
  actual.converged = found.converged;
  actual.reason = found.reason;
  if (!found.converged) return actual;
  actual.error = error_of(model.mechanism.space, found.error);
  actual.beyond_linear = error_of(model.mechanism.space, found.beyond_linear);
  actual.take_up = take_up_of(model.mechanism, contacts, found.take_up);
  actual.iterations = found.iterations;
  actual.residual = found.residual;
  for (std::size_t i = 0; i < model.mechanism.links.size(); ++i) {
    const mechanism::Link& link = model.mechanism.links[i];
    DisplacedLink own{link.name, {}};
    for (std::size_t k = 0; k < link.points.size(); ++k) {
      own.points.push_back(
          {name_of(model.mechanism, link.points[k]), components(model.mechanism.space, found.link_points[i][k])});
    }
    actual.links.push_back(std::move(own));
  }
  return actual;
}

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
    numeric::Series& own = coordinates.emplace_back(pose.at[c]);
    if (!request.velocity.empty()) own.c[1] = request.velocity[c];
    if (!request.acceleration.empty()) own.c[2] = request.acceleration[c] / 2;
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

void require_rates(const mechanism::Mechanism& mechanism, const PoseRequest& request) {
  const bool moves = !request.velocity.empty() || !request.acceleration.empty();
  if (request.iterate && !mechanism::cables_of(mechanism).empty())
    throw core::InputError({mechanism.file}, "the pose error of mechanisms with cables is linear",
                           "ask for it without iteration");
  if (moves && request.iterate)
    throw core::InputError({mechanism.file}, "the pose error is iterated at rest only",
                           "ask for the linear error, or leave velocity and acceleration out");
  for (const std::vector<double>* const rates : {&request.velocity, &request.acceleration}) {
    if (!rates->empty()) require_values(mechanism, rates->size());
    for (const double rate : *rates)
      if (!std::isfinite(rate)) throw core::InputError({}, "a rate of the pose is no finite number", "give a number");
  }
}

/// Throws where an axis has no direction.
numeric::Posture posture_at(const numeric::NumericModel& model, std::span<const double> at, const DyadSides& sides) {
  numeric::Posture posture = numeric::posture(model, at, sides);
  if (posture.undirected && !posture.unreachable)
    throw core::InputError({model.mechanism.file},
                           "an axis of joint " +
                               model.mechanism.joints[static_cast<std::size_t>(*posture.undirected)].name +
                               " has no direction at this pose",
                           "choose another pose");
  return posture;
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
  std::vector<std::vector<double>> places;
  for (const Eigen::Vector3d& point : posture.points) places.push_back(components(m.space, point));
  pose.points = named_points(m, places);
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

// ---- Many poses

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
                 std::vector<double>(count, nan), all);
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

/// Coordinates outside the range that is searched, as of degrees that were meant and taken for rad.
void note_outside(const mechanism::Mechanism& mechanism, Pose& pose) {
  for (std::size_t c = 0; c < pose.at.size(); ++c) {
    const mechanism::Coordinate& own = mechanism.coordinates[c];
    const double lower = core::to_double(own.lower), upper = core::to_double(own.upper);
    if (lower <= pose.at[c] && pose.at[c] <= upper) continue;
    const auto told = [&](double value) { return core::told(value, own.angle ? "rad" : "m", mechanism.units); };
    pose.notes.push_back(own.name + " = " + told(pose.at[c]) + " is outside its range, " + told(lower) + " to " +
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
    for (const ReactionComponent& own : pose.reactions[j].components) {
      if (own.quantity != mechanism::actuator_quantity(joint) ||
          (least - hair <= own.value && own.value <= most + hair))
        continue;
      const auto told = [&](double value) {
        return core::told(value, core::unit_of(own.quantity), mechanism.units, 4);
      };
      pose.notes.push_back(core::to_string(own.quantity) + "_" + joint.name + " = " + told(own.value) +
                           " is beyond its bounds, " + told(least) + " to " + told(most));
    }
  }
}

}  // namespace

PoseError error_of(mechanism::Space space, const numeric::PoseError& error) {
  return {components(space, error.dp), rotations(space, error.dalpha)};
}

void require_values(const mechanism::Mechanism& mechanism, std::size_t count) {
  const std::size_t wanted = mechanism.coordinates.size();
  if (count == wanted) return;
  std::string names;
  for (const mechanism::Coordinate& own : mechanism.coordinates) names += (names.empty() ? "" : ", ") + own.name;
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
  DyadSides own = mechanism::working_mode(mechanism);
  if (sides.empty()) return own;
  const bool signs = std::all_of(sides.begin(), sides.end(), [](int side) { return side == 1 || side == -1; });
  if (sides.size() != own.size() || !signs)
    throw core::InputError({mechanism.file}, "the working mode is none of this mechanism",
                           "give +1 or -1 for each of its " + std::to_string(own.size()) + " dyads and sliders");
  return sides;
}

namespace {

/// With an effort of every free actuator.
Pose solve_given(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                 const PoseRequest& request) {
  const std::vector<numeric::Bounded> values = with_rounding(at);
  if (const std::optional<Framed> own = framed_where_far(mechanism)) {
    std::vector<core::Rational> inside = at;
    for (std::size_t i = 0; i < inside.size(); ++i) inside[i] -= own->frame.from[i];
    Pose pose = from_frame(solve_given(own->mechanism, inside, request), mechanism, own->frame);
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

}  // namespace

namespace {

/// Where no working mode is asked for, on the flanks that the load presses.
Pose solve_on_flanks(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                     const PoseRequest& request) {
  Pose pose = solve_given(mechanism, at, request);
  for (const std::string& belt : slack_belts(mechanism, pose))
    pose.notes.push_back("a span of belt " + belt + " is slack");
  const std::vector<std::string> pulled = pulled_gears(mechanism, pose);
  if (pulled.empty()) return pose;
  PoseRequest own = request;
  if (request.working_mode.empty())
    for (const DyadSides& sides : modes_of_flanks(mechanism, mechanism::working_mode(mechanism))) {
      own.working_mode = sides;
      if (Pose other = solve_given(mechanism, at, own); pulled_gears(mechanism, other).empty()) return other;
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

namespace {

ModePose solve_in(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                  const PoseRequest& request) {
  ModePose own{named_mode(mechanism, request.working_mode), {}};
  try {
    Pose pose = solve_pose(mechanism, at, request);
    if (!pose.unreachable.empty())
      own.why_not = "point " + pose.unreachable + " cannot be placed";
    else if (!pose.beyond_limit.empty())
      own.why_not = "beyond the limit of the " + pose.beyond_limit;
    else if (pose.actual && !pose.actual->converged)
      own.why_not = "the pose error cannot be iterated: " + pose.actual->reason;
    else if (const std::vector<std::string> pulled = pulled_gears(mechanism, pose); !pulled.empty())
      own.why_not = words_of_pulled(pulled);
    else
      own.pose = std::move(pose);
  } catch (const core::InputError& error) {  // singular in every pose of this mode
    own.why_not = error.problem();
  }
  return own;
}

std::vector<core::Rational> exact(const std::vector<double>& at) {
  std::vector<core::Rational> values;
  for (const double value : at) values.push_back(written(value));
  return values;
}

}  // namespace

namespace {

/// How many assemblies a group has at most. Of three points of a body at given distances from each other, with six
/// further distances from points of the body to known ones: a Stewart-Gough platform, which has 40 (F. Ronga, T. Vust,
/// Stewart platforms without computer?, Real Analytic and Algebraic Geometry, 1995).
std::optional<std::size_t> most_assemblies(const mechanism::Mechanism& mechanism, const mechanism::Group& group) {
  constexpr std::size_t sides = 3, legs = 6, of_a_platform = 40;
  if (mechanism.space != mechanism::Space::spatial || group.count != 3 || group.distances.size() != sides + legs ||
      !group.lines.empty())
    return std::nullopt;
  const auto moves = [&](mechanism::PointIndex point) { return point >= group.first && point <= group.last; };
  std::set<mechanism::PointIndex> of_body;
  std::size_t within = 0;
  for (const mechanism::Group::Distance& distance : group.distances) {
    within += moves(distance.first) && moves(distance.second) ? 1 : 0;
    for (const mechanism::PointIndex point : {distance.first, distance.second})
      if (moves(point)) of_body.insert(point);
  }
  const bool rigid = std::any_of(mechanism.links.begin(), mechanism.links.end(), [&](const mechanism::Link& link) {
    const std::set<mechanism::PointIndex> points(link.points.begin(), link.points.end());
    return std::includes(points.begin(), points.end(), of_body.begin(), of_body.end());
  });
  return rigid && within == sides ? std::optional(of_a_platform) : std::nullopt;
}

/// One assembly of the groups so far, or all of them.
struct Assembly {
  core::BlockUnknowns unknowns;
  loci::pose::UnknownsBox enclosed;
};

void put_assembly(mechanism::Mechanism& mechanism, const core::BlockUnknowns& unknowns) {
  std::size_t k = 0;
  for (mechanism::Group& group : mechanism.groups)
    for (auto& place : group.near)
      for (std::size_t c = 0; c < mechanism::dimension(mechanism) && k < unknowns.size(); ++c)
        place[c] = core::Rational(unknowns[k++]);
}

/// Group by group at a pose, each over the assemblies of those before it. `complete`: none is missing.
std::vector<Assembly> assemblies_at(const mechanism::Mechanism& mechanism, const std::vector<double>& pose,
                                    const DyadSides& sides, bool& complete) {
  std::vector<Assembly> all = {{}};
  for (std::size_t g = 0; g < mechanism.groups.size(); ++g) {
    std::vector<Assembly> longer;
    for (const Assembly& own : all) {
      mechanism::Mechanism until = mechanism::up_to_group(mechanism, g);
      put_assembly(until, own.unknowns);
      const auto box = mechanism::group_reach(until, pose, sides);
      loci::pose::AllSolutions found;
      if (box)
        found = loci::pose::all_solutions(mechanism::group_program(until, sides), pose, own.enclosed, *box,
                                          most_assemblies(mechanism, mechanism.groups[g]));
      complete = complete && found.complete;
      for (std::size_t i = 0; i < found.found.size(); ++i) {
        Assembly next{std::move(found.found[i]), own.enclosed};
        const loci::pose::UnknownsBox& here = found.enclosed[i];
        next.enclosed.insert(next.enclosed.end(), here.begin(), here.end());
        // Of one that meets another nothing is proven of what stands on it.
        if (!here.empty() || g + 1 == mechanism.groups.size())
          longer.push_back(std::move(next));
        else
          complete = false;
      }
    }
    all = std::move(longer);
  }
  return all;
}

/// Of every assembly of the groups in a working mode: it is that of a posture at this very pose.
void add_assemblies(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                    const PoseRequest& request, std::vector<ModePose>& modes) {
  std::vector<double> pose;
  for (const core::Rational& value : at) pose.push_back(core::to_double(value));
  mechanism::Mechanism own = mechanism;
  own.near = at;
  // Nothing is asked of other poses.
  for (std::size_t c = 0; c < at.size(); ++c) {
    mechanism::Coordinate& coordinate = own.coordinates[c];
    const core::Rational near = (coordinate.upper - coordinate.lower) / 1'000'000;
    coordinate.lower = at[c] - near;
    coordinate.upper = at[c] + near;
  }
  bool complete = true;
  std::vector<Assembly> all = assemblies_at(own, pose, request.working_mode, complete);
  // No link is bent or turned over.
  const mechanism::HeldByLinks held = mechanism::held_by_links(mechanism);
  std::erase_if(all, [&](const Assembly& assembly) {
    put_assembly(own, assembly.unknowns);
    const auto posture = mechanism::sample_posture(own, pose, request.working_mode);
    return posture && !mechanism::keeps(held, *posture);
  });
  std::string names;
  for (const mechanism::Group& group : mechanism.groups) names += (names.empty() ? "" : ", ") + group.name;
  if (all.empty()) {
    modes.push_back(solve_in(mechanism, at, request));
    if (!complete) modes.back().working_mode.emplace_back(names, "that of its posture, others are not told");
    return;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    put_assembly(own, all[i].unknowns);
    modes.push_back(solve_in(own, at, request));
    modes.back().working_mode.emplace_back(names, "assembly " + std::to_string(i + 1) + " of " +
                                                      std::to_string(all.size()) + (complete ? "" : " or more"));
  }
}

}  // namespace

PoseInModes solve_pose_in_modes(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                                const PoseRequest& request) {
  require_values(mechanism, at.size());
  require_rates(mechanism, request);
  PoseInModes all{mechanism.name, mechanism::told_parameters(mechanism), {}};
  PoseRequest own = request;
  for (const DyadSides& sides : requested_modes(mechanism, {.all_working_modes = true})) {
    own.working_mode = sides;
    if (mechanism.groups.empty())
      all.modes.push_back(solve_in(mechanism, at, own));
    else
      add_assemblies(mechanism, at, own, all.modes);
  }
  return all;
}

Pose solve_pose(const Model& model, const std::vector<double>& at, const PoseRequest& request) {
  return solve_pose(model.content().mechanism, exact(at), request);
}

PoseInModes solve_pose_in_modes(const Model& model, const std::vector<double>& at, const PoseRequest& request) {
  return solve_pose_in_modes(model.content().mechanism, exact(at), request);
}

Reactions reactions(const Model& model, std::span<const double> poses, const DyadSides& working_mode) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  const std::size_t width = mechanism.coordinates.size();
  if (width == 0 || poses.size() % width != 0)
    require_values(mechanism, width == 0 ? poses.size() : poses.size() % width);
  const DyadSides sides = sides_of(mechanism, working_mode);
  require_regular(mechanism, sides);
  return mechanism.space == mechanism::Space::spatial ? reactions_in_space(mechanism, poses, sides)
                                                      : reactions_in_plane(mechanism, poses, sides);
}

}  // namespace clearloci
