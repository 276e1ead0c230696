// The stages of reading a mechanism file, in the order in which they run. Each throws core::InputError for wrong input.
// Private to mechanism/.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/task.hpp"
#include "mechanism/handed_files.hpp"
#include "mechanism/mechanism.hpp"
#include "mechanism/read.hpp"
#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism {

/// What a file calls its mechanism or trajectory, or the file's name without folder and ending where it gives none: one
/// printable line, since it stands in headings, titles and comments.
std::string name_of(const std::optional<Value>& value, const std::string& file);

/// A constant expression and its value.
struct Number {
  Expression expression;
  Rational value;
  bool plain = false;  ///< without any unit
};

enum class Sign { any, not_negative, positive };

/// What an expression may speak of.
enum class Scope { parameters, parameters_and_coordinates };

// --- expression_parser.cpp
/// As parse_expression, with its units as symbols (mechanism/units.hpp). `names`: of the file, which after * and / are
/// no units.
Expression parse_with_units(const std::string& text, const core::SourcePosition& where,
                            const std::set<std::string>& names);

// --- read_values.cpp: numbers, parameters, workspace
Expression read_expression(const Mechanism& mechanism, const Value& value, Scope scope);
Number read_number(const Mechanism& mechanism, const Value& value, Sign sign);
/// A number, or a polynomial in the free coordinates: what varies with the pose.
Expression read_varying(const Mechanism& mechanism, const Value& value);
/// The value as one of a coordinate: a length or an angle.
Value of_coordinate(Value value, const Coordinate& coordinate);
void check_identifier(const std::string& name, const core::SourcePosition& where, const std::string& what);
void check_label(const std::string& name, const core::SourcePosition& where, const std::string& what);
/// A value of a parameter, or a difference of two, in the file's own numbers. Throws for a plain number where the
/// parameter carries a unit.
Rational read_parameter_value(const Mechanism& mechanism, const Parameter& parameter, const Value& value);
/// `further`: parameters that the file does not name as such.
void read_parameters(Mechanism& mechanism, const std::optional<Value>& value, const std::vector<Entry>& further,
                     const std::vector<Override>& overrides);
void read_workspace(Mechanism& mechanism, const Value& value);

// --- read_points.cpp
PointIndex read_point_name(const Mechanism& mechanism, const Value& value);
/// One point form; `what` of the value names the point. Points it uses must be in the mechanism already.
PointForm read_point_form(const Mechanism& mechanism, const Value& value);
/// Throws unless an expression is a polynomial in the lengths among the free coordinates and in cos, sin of the angles.
/// `mend`: what to write instead.
void check_polynomial(const Mechanism& mechanism, const Value& value, const Expression& expression,
                      const std::string& mend);
/// The same of what a load may be: with arc tangents of such polynomials besides.
void check_load(const Mechanism& mechanism, const Value& value, const Expression& expression);
/// The length of a rod, or a polynomial in the coordinates: that of a leg which a motor makes longer.
Expression read_length(const Mechanism& mechanism, const Value& value);
/// `frames`: those of the file, each read as soon as its origin is known. `links`: as they are written, for messages.
/// `joints`: among them gears, whose wheels have frames.
void read_points(Mechanism& mechanism, const Value& value, const std::optional<Value>& frames,
                 const std::optional<Value>& links, const std::optional<Value>& joints);

// --- read_group.cpp
/// {group: [C, E], lengths: ...}, in the place of a point.
bool is_group(const Value& value);
/// Adds its points. Throws where it does not close from its posture.
void read_group(Mechanism& mechanism, const Entry& entry);

// --- read_frames.cpp
/// A point {in: frame, place: [u, v, w]} as its coordinates.
ExplicitPoint read_point_in_frame(const Mechanism& mechanism, const Value& value);
/// Components in a frame, named by `in`, as those in the ground. `by`: where they are written, for messages.
VectorExpression in_directions_of(const Mechanism& mechanism, const Value& in, const Value& by,
                                  const VectorExpression& vector);
/// The frames that stand at points known so far, and are not among `mechanism.body_frames` yet.
void read_known_frames(Mechanism& mechanism, const std::optional<Value>& frames);
/// Throws where a frame of the file is still unknown.
void check_all_frames_read(const Mechanism& mechanism, const std::optional<Value>& frames);

// --- read_vectors.cpp
/// The two components of a vector or a place in the plane, the three in space.
std::vector<Value> components(const Mechanism& mechanism, const Value& value);
/// [ux, uy], [ux, uy, uz], [A, B] for B - A, or an expression such as cross([1, 0, 0], B - A).
/// Its numbers may vary with the pose where `scope` says so.
VectorExpression read_vector_expression(const Mechanism& mechanism, const Value& value,
                                        Scope scope = Scope::parameters);
/// The points that a vector is made from.
std::set<PointIndex> points_of(const VectorExpression& vector);

// --- read_links.cpp
LinkIndex read_link_name(const Mechanism& mechanism, const Value& value, bool or_ground);
/// "link AB", "the ground".
std::string link_text(const Mechanism& mechanism, LinkIndex link);
/// from and to: two different links, one of which may be the ground. `what` joins them, for errors: "spring S".
std::pair<LinkIndex, LinkIndex> read_two_links(const Mechanism& mechanism, const Value& links, const std::string& what);
void read_links(Mechanism& mechanism, const Value& value);
/// A link with one point has no length to make its inertia from: with a mass it must say that, unless it slides along
/// the ground, where it cannot turn. After the joints are read.
void fill_inertia(Mechanism& mechanism);

// --- free_efforts.cpp
/// The word `free`.
bool is_free_effort(const Value& effort);
std::string free_effort_parameter(const std::string& joint);
/// Of a parameter that is named so.
std::optional<std::string> joint_of_free_effort(const std::string& parameter);
[[noreturn]] void refuse_effort(const Mechanism& mechanism, const Joint& joint, const Rational& value,
                                const std::pair<Rational, Rational>& within, const core::SourcePosition& where);
/// Of joints as they are written: the word `free` of every effort that is, by the name of its parameter.
std::vector<Entry> written_free_efforts(const Value& joints);
/// Overrides: efforts that vary with the pose, by the names of their parameters, and all else.
struct GivenEfforts {
  std::vector<Override> laws, values;
};
GivenEfforts given_efforts(const Value& workspace, const std::vector<Override>& overrides);
/// The others.
std::vector<Override> without_efforts(std::vector<Override> overrides);
/// Throws for one of a joint whose effort is not free. `parameters`: of the file, which may have such a name.
void check_given_efforts(const Value& joints, const std::optional<Value>& parameters, const GivenEfforts& efforts);
/// The parameters that they name.
std::vector<std::string> names_of_efforts(const GivenEfforts& efforts);
/// A parameter for each free effort that has no law, and for each cable whose tension is given.
std::vector<Entry> free_effort_parameters(const Value& joints, const GivenEfforts& efforts);
/// Those that have a value, which is within what the motor can exert, or a law.
void give_free_efforts(Mechanism& mechanism, const GivenEfforts& efforts);

// --- read_joints.cpp: joints, end effector, loads
void read_joints(Mechanism& mechanism, const Value& value);
void read_end_effector(Mechanism& mechanism, const Value& value);
void read_loads(Mechanism& mechanism, const std::optional<Value>& value);
void read_gravity(Mechanism& mechanism, const std::optional<Value>& value);

// --- read_springs.cpp: springs and limits
void read_springs(Mechanism& mechanism, const std::optional<Value>& value);
void read_limits(Mechanism& mechanism, const std::optional<Value>& value);

// --- read_task.cpp
/// A task from the mapping of its keys, whatever it says of its format.
core::Task task_of(const Value& document, const Mechanism& mechanism, const HandedFiles* handed = nullptr);

// --- read_task_shape.cpp
/// The one shape that a task has; it lies in the mechanism's box.
core::TaskShape read_task_shape(const Mechanism& mechanism, const Value& document, const Mapping& root,
                                const std::optional<Rational>& angle_length, const HandedFiles* handed);
/// A number of the task's metric: a length, or an angle where there is nothing else.
Value in_metric(Value value, const Mechanism& mechanism, bool weighted);

// --- checks.cpp: what only the whole mechanism shows
/// The free coordinates that a point depends on, through the points it is built from.
std::set<std::string> coordinates_of(const Mechanism& mechanism, PointIndex point);
/// Listed among the link's points, or built by `on` or `mean` from points of the link. Ground holds every fixed point.
bool is_on_link(const Mechanism& mechanism, PointIndex point, LinkIndex link);
/// As many unknowns as equations. `joints`: the place of the joints in the file.
void check_square(const Mechanism& mechanism, const core::SourcePosition& joints);
/// The symbols xB, yB of a constructed point B name nothing else.
void check_names(const Mechanism& mechanism);
/// Every free coordinate moves some point.
void check_coordinates_used(const Mechanism& mechanism, const core::SourcePosition& workspace);
/// The two points that a dyad or `on` builds on do not coincide in every pose.
void check_distinct_bases(const Mechanism& mechanism);
/// No axis is zero, and none that the ground holds turns.
void check_axes(const Mechanism& mechanism);
/// No spring is without length in every pose, and no limit without a direction.
void check_springs(const Mechanism& mechanism);

// --- rigidity.cpp
/// The points of a link keep their distances in sampled postures, or may on one side of a fold.
void check_rigidity(const Mechanism& mechanism);
/// "x = 0.25 m, phi = 30 deg".
std::string words_of_pose(const Mechanism& mechanism, const std::vector<double>& pose);

// --- read_gears.cpp
/// Of every gear among the joints: the pitch point, which has the gear's name, and K, `flank_` and its name.
void read_gear_points(Mechanism& mechanism, const Value& joints);
/// An entry {gear: [wheel, wheel], ...} of the joints.
bool is_gear(const Value& value);
/// The joint of a gear whose points are read.
Joint read_gear(const Mechanism& mechanism, const Entry& entry);
/// What the turns of both wheels, from their carrier, sum up to 0 with; of a belt over two radii; none of a rack.
std::optional<std::array<Rational, 2>> teeth_of(const Mechanism& mechanism, const Entry& mesh);
/// Throws where the keys or numbers of a gear or a belt are wrong, before points need its wheels' frames.
void check_wheels(const Mechanism& mechanism, const std::optional<Value>& joints);
/// Throws where a point is in the frame of a wheel, which its gear or belt gives no frame yet.
void explain_missing_wheel(const Mechanism& mechanism, const Value& point, const std::optional<Value>& joints);
/// Frames of wheels and pulleys that turn with another one, whose frame is known: frames have the names of the links.
void read_known_wheels(Mechanism& mechanism, const std::optional<Value>& joints);
/// A point of a gear or a belt, which has the joint's name or is made of it. Throws where another one has the name.
void add_pitch_point(Mechanism& mechanism, const Entry& joint, const std::string& name, PointForm form);
/// A point that was added so.
PointIndex pitch_point(const Mechanism& mechanism, const std::string& name);
/// The key `distance` of a gear or a belt, m.
std::optional<Expression> given_distance(const Mechanism& mechanism, const Mapping& mapping, const std::string& what);
/// Between the `centres` of a gear or a belt, m: `distance`, else that of two fixed points.
Number centre_distance(const Mechanism& mechanism, const Mapping& mapping, const std::string& what);

// --- read_belts.cpp
/// Of every belt over pulleys of two sizes among the joints: the pitch point, which has the belt's name, and a point
/// beside it, `beside_` and its name.
void read_belt_points(Mechanism& mechanism, const Value& joints);
/// By how much of the angle of the first pulley of a belt the second one turns.
Rational belt_ratio(const Mechanism& mechanism, const Entry& entry);
/// An entry {belt: [pulley, pulley], ...} of the joints.
bool is_belt(const Value& value);
/// Adds the spring of the belt's tension to the mechanism.
Joint read_belt(Mechanism& mechanism, const Entry& entry);

// --- check_gears.cpp
/// The wheels of a gear and the pulleys of a belt are pinned to one carrier, and their teeth move alike, in sampled
/// postures.
void check_gears(const Mechanism& mechanism);

// --- joint_marks.cpp
/// Pins, balls and crosses stay at one point of their links, and axes on one line, in sampled postures.
void check_joint_marks(const Mechanism& mechanism);

// --- reachability.cpp
/// Every dyad can be closed somewhere in the box.
void check_reachability(const Mechanism& mechanism);

}  // namespace clearloci::mechanism
