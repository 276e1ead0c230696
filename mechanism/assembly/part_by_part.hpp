// The run that plane and space share: links are turned and points are placed one after the other, from the ground and
// the coordinates outwards. Private to mechanism/.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/assembly/construction.hpp"

namespace clearloci::mechanism {

class PartByPart : public Construction {
 public:
  using Construction::Construction;
  virtual ~PartByPart() = default;

  /// Throws core::InputError where some links close together in a group.
  FoundConstruction run();

 protected:
  // --- what plane and space do each in its own way

  virtual bool is_turned(LinkIndex link) const = 0;
  /// Finds how a link is turned; false where it cannot be told yet.
  virtual bool turn(LinkIndex link) = 0;
  /// By a way between links, one of whose two sides it takes: where nothing else tells how any link is turned.
  virtual bool turn_by_way(LinkIndex) { return false; }
  /// Where a vector of the drawing is that turns with a link; required: is_turned(link).
  virtual WrittenVector image(LinkIndex link, const Amounts& drawn) = 0;
  virtual bool put_on_link(PointIndex point) = 0;
  virtual bool put_where_loci_meet(PointIndex point) = 0;
  virtual void write_axes(JointIndex joint) = 0;
  /// Of centres of gears, which other files have to give.
  virtual void write_distances() {}
  /// Points that close together; false where none do.
  virtual bool put_group() { return false; }

  // --- what they have in common

  static LinkIndex other_of(const Joint& joint, LinkIndex link) { return joint.from == link ? joint.to : joint.from; }
  static bool joins(const Joint& joint, LinkIndex link) { return joint.from == link || joint.to == link; }
  bool has_point(LinkIndex link, PointIndex point) const;
  /// Turned, and with a point that has its construction.
  bool is_placed(LinkIndex link) const;

  const DrawnCoordinate* place_coordinate(PointIndex point, std::size_t axis) const;

  /// The link that carries the point of a sliding joint along, the other one, and where that is measured from.
  struct Stroke {
    const DrawnCoordinate* coordinate = nullptr;
    JointIndex joint = 0;
    LinkIndex carried = ground, base = ground;
    std::optional<PointIndex> origin;  ///< none: of the ground
    Amounts axis;
  };
  /// Strokes of joints at a point whose origin has its construction.
  std::vector<Stroke> strokes_at(PointIndex point) const;

  /// Puts a point at a way from one of those of its link, from one of explicit coordinates where there is one.
  void put_from(const std::vector<PointIndex>& bases, PointIndex point, const std::string& comment,
                const std::function<WrittenVector(PointIndex)>& way);
  /// An axis of a joint in the file's words.
  std::string written_axis(JointIndex joint, std::size_t which = 0) const;
  /// A known point of the guide on the line through a point along an axis, or else one in the drawn place.
  Handle base_of_line(LinkIndex guide, PointIndex point, const Amounts& axis, const std::string& joint);
  [[noreturn]] void refuse_stretched(PointIndex point, const std::string& one, const std::string& other) const;

  Amount one_ = Amount(core::Rational(1));
  std::map<std::string, std::string> extras_;  ///< points that stand for directions, by what they stand for

 private:
  bool turn_one();
  bool place_one();
  bool place(PointIndex point);
  bool put_by_coordinates(PointIndex point);
  bool put_by_stroke(PointIndex point);
};

}  // namespace clearloci::mechanism
