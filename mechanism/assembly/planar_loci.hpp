// What keeps a point of a planar drawing that is not placed yet: circles about known points of its links and lines
// along known guides. Private to mechanism/.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/assembly/planar_turning.hpp"

namespace clearloci::mechanism {

/// Where a link lets a point be.
struct Locus {
  bool is_circle = false;
  std::function<int()> base;  ///< the centre, or a point of the line
  Amount radius;
  std::string radius_text;                   ///< of a motor's stroke; else empty
  std::string along;                         ///< direction of a line
  std::optional<WrittenVector> turned = {};  ///< in place of `along`: that of a guide, with which it may turn
  std::array<double, 2> way{};
  LinkIndex link = ground;  ///< that it is of, if any
  std::string source;       ///< the link, guide or coordinate that it is of, for words and to tell two of them apart
};

class PlanarLoci : public PlanarTurning {
 public:
  using PlanarTurning::PlanarTurning;

 protected:
  // --- circles and lines
  std::vector<Locus> loci(PointIndex point, int depth = 0);
  void add_circle(LinkIndex link, PointIndex point, std::vector<Locus>& all);
  /// A leg whose motor says how long it is.
  void add_leg(const Stroke& stroke, PointIndex point, std::vector<Locus>& all);
  void add_coordinate_line(PointIndex point, std::size_t axis, const DrawnCoordinate& coordinate,
                           std::vector<Locus>& all);
  /// Lines along the guides of a link that turns as a known one does.
  void add_lines(LinkIndex link, PointIndex point, std::vector<Locus>& all);
  /// The line of a slot: of its pin in a known link, or of a point of a link that a known pin guides.
  void add_slots(PointIndex point, std::vector<Locus>& all);
  std::optional<Locus> line_of_slot(JointIndex index, PointIndex point);
  /// A point of a carrier that is at this way from a pin.
  Handle beside_pin(LinkIndex carrier, PointIndex pin, const Amounts& beside, PointIndex point);
  std::array<double, 2> turned_in_posture(LinkIndex guide, const Amounts& axis) const;
  void set_direction(Locus& line, JointIndex joint, LinkIndex guide, const Amounts& axis);
  /// What keeps a point of a link that does not turn on its own, for another one.
  Handle carried_along(LinkIndex link, Handle from, PointIndex other, PointIndex point);
  /// A link that does not turn on its own carries what keeps its other points over to this one.
  void add_translated(LinkIndex link, PointIndex point, std::vector<Locus>& all);
  static std::string radius_of(const Locus& circle);
  /// As a file writes it, from a point: where it turns with a coordinate to another point that does.
  std::string direction_from(Handle base, const WrittenVector& direction, const std::array<double, 2>& way,
                             const std::string& source);
  Node line(Handle base, const Locus& locus);

 private:
  std::map<std::string, std::string> directions_;  ///< that go to points, by where they begin and how they turn
};

}  // namespace clearloci::mechanism
