// A mechanism as it is drawn: every point where it is in one posture, links, joints, and what the coordinates measure.
// Private to mechanism/.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/assembly/amount.hpp"
#include "mechanism/mechanism.hpp"
#include "mechanism/read.hpp"
#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism {

/// What is known of a point besides its place in the posture.
struct DrawnPoint {
  bool built = false;            ///< has a construction of its own, which it keeps
  bool moves = false;            ///< by its construction: it uses free coordinates
  bool held = false;             ///< by its construction: it stands still while the coordinates do
  bool has_place = true;         ///< its place in the posture is known; SI, in Drawing::posture
  bool is_exact = false;         ///< `at` is known
  Amounts at;                    ///< as drawn, in the file's units
  Node form;                     ///< as written: the list of its coordinates, or its construction
  std::vector<PointIndex> uses;  ///< by a construction, as far as its words tell
};

/// Lengths that beat the drawing: of two points of a link.
struct GivenLength {
  PointIndex first = 0, second = 0;
  Amount length;
  double metres = 0;
  core::SourcePosition where;
};

/// What a free coordinate measures.
struct DrawnCoordinate {
  enum class Kind {
    plain,      ///< what constructions use
    direction,  ///< the angle of a link, from x or from another link
    place,      ///< x, y or z of a point
    stroke,     ///< how far a prismatic joint is out
    turn        ///< the first, second or third angle of a link's orientation
  };
  Kind kind = Kind::plain;
  std::string name;
  core::SourcePosition where;
  LinkIndex link = ground, other = ground;  ///< of a direction: of `link` from `other`
  PointIndex point = 0;
  std::size_t axis = 0;  ///< of a place and a turn: 0, 1, 2
  JointIndex joint = 0;
  std::string order;  ///< of a turn: "zyx"
};

/// Two wheels, a wheel and a rack, or two pulleys: with `teeth`,
///     teeth[0] (turn of from - turn of carrier) + teeth[1] (turn of to - turn of carrier) = 0.
struct DrawnMesh {
  Joint joint;
  std::size_t written = 0;                            ///< its place in the file
  std::optional<std::array<Rational, 2>> teeth = {};  ///< none of a rack; of a belt its ratio and -1
  LinkIndex carrier = ground;                         ///< has both centres
};

struct Drawing {
  /// The posture: every point has its coordinates there, and every joint the axes that are drawn.
  Mechanism mechanism;
  std::vector<DrawnPoint> points;                 ///< as many as points that are no centres of mass
  std::vector<std::array<double, 3>> posture;     ///< SI
  std::vector<std::vector<GivenLength>> lengths;  ///< one a link
  std::vector<DrawnCoordinate> coordinates;
  std::vector<double> pose;             ///< of what is drawn, as far as constructions are over plain coordinates
  std::vector<std::vector<Node>> axes;  ///< as written, one list a joint
  std::vector<std::size_t> written;     ///< of each joint its place in the file: cables hold nothing, and are left out
  std::vector<bool> cabled;             ///< of each link whether a cable pulls at it
  std::size_t cables = 0;               ///< each may do what a motor does
  std::vector<DrawnMesh> meshes;        ///< gears and belts, which are no joints of `mechanism` here
  Rational unit = 1;                    ///< of the file's lengths, m
  double size = 1;                      ///< of the drawing, m

  const std::string& name(PointIndex point) const { return mechanism.points[static_cast<std::size_t>(point)].name; }
  const DrawnPoint& at(PointIndex point) const { return points[static_cast<std::size_t>(point)]; }
  const std::array<double, 3>& place(PointIndex point) const { return posture[static_cast<std::size_t>(point)]; }
  const Link& link(LinkIndex link) const { return mechanism.links[static_cast<std::size_t>(link)]; }
  const Joint& joint(JointIndex joint) const { return mechanism.joints[static_cast<std::size_t>(joint)]; }
  std::string name_of(LinkIndex link) const { return link == ground ? "ground" : this->link(link).name; }
  bool is_spatial() const { return mechanism.space == Space::spatial; }
};

/// The workspace and the links as the other readers know them: without what only a drawing says.
struct PlainSections {
  Node workspace, links;
};

/// `document`: with its repetitions written out and its points named. Throws core::InputError where it is wrong.
Drawing read_drawing(const Value& document, const std::vector<Override>& overrides, PlainSections& plain);

/// Points that stand still whatever moves.
std::vector<bool> fixed_points(const Drawing& drawing);

/// The link, or the ground, that has both centres of a gear or belt; of a rack the ground. Throws core::InputError
/// where none has.
LinkIndex carrier_of(const Drawing& drawing, const Joint& mesh);

/// "AB, BC and CD".
std::string listed(const std::vector<std::string>& names);

/// What a link, joint or point in the wrong place is refused for: links without joints, joints in one place, links and
/// motors too many or too few. Throws core::InputError that names them.
void check_drawing(const Drawing& drawing);

/// Closes the loops anew where lengths are given: Newton from the drawn posture, in which points move least. Puts a
/// note into the mechanism's. Throws core::InputError that names the loop that does not close.
void close_loops(Drawing& drawing);

/// A freedom that is left when the coordinates stand still, or a rod or motor too many: throws core::InputError that
/// names the links concerned, or those that close together in a group that has no construction yet.
[[noreturn]] void refuse_rest(const Drawing& drawing, const std::vector<LinkIndex>& open);

}  // namespace clearloci::mechanism
