// Points of a planar drawing that close together, none before the others: they become a group of the file
// (docs/reference/mechanism-file.md). Private to mechanism/.
//
//   link of its own direction    two points of it hold it, a distance apart; the others are built on them
//   link of known direction      one point of it holds it; the others are at known ways from it
//   links that turn together     (a slide on a link turns with it) two points of one link, the frame, say how they are
//                                turned; one point holds each of the others
//   slide, pin in a slot         a point of one link is on a line that the other one carries
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/assembly/planar_loci.hpp"
#include "mechanism/assembly/smallest_group.hpp"

namespace clearloci::mechanism {

class PlanarGroups : public PlanarLoci {
 public:
  using PlanarLoci::PlanarLoci;

 private:
  /// Of an unknown point: held by equations of its own, or built on others.
  enum class Use { free, base, derived };
  /// Links that turn together, their direction not known yet: two points of one of them say how.
  struct Frame {
    std::vector<LinkIndex> links;
    LinkIndex link = ground;
    PointIndex from = 0, to = 0;
    Amounts way;  ///< from the one to the other, as drawn
  };
  /// A line that a link carries, through a point at this way from one of its points.
  struct Carried {
    LinkIndex link = ground;
    PointIndex point = 0;
    Amounts way;
    std::string stroke;        ///< a coordinate: further on by it along `unit`
    Amounts unit;              ///< of `stroke`
    Amounts axis;              ///< turns with the link
    std::string along;         ///< in place of `axis`
    bool is_of_shape = false;  ///< `way` is one of the link's shape, not of the drawing
    bool is_on_point() const;  ///< goes through `point`
    std::string text() const;  ///< where it begins: equal texts, equal points
  };
  /// A distance or a line that holds unknown points.
  struct Held {
    std::vector<PointIndex> points;
    std::string first, second;     ///< of a distance, by names; no second: points.back()
    std::string length;            ///< of a distance
    const Locus* locus = nullptr;  ///< what a point is held by that is known; else a distance or a line between points
    std::string along;             ///< of a line between points
    std::optional<Carried> line = {};  ///< of points.front()
  };
  struct Derived {
    PointIndex point = 0;
    std::vector<PointIndex> bases;
    Node form;
    std::optional<Carried> at = {};  ///< in place of `form`
  };
  /// A point that the drawing has not, for the direction of links that have but one point each.
  struct Pointer {
    std::string name;
    std::array<double, 3> posture{};
  };
  struct Parts {
    std::map<PointIndex, Use> use;  ///< of the points that matter
    std::vector<Derived> derived;
    std::vector<Held> held;
    std::vector<std::vector<Locus>> loci;
    std::set<LinkIndex> drawn;  ///< links that turn together with none of given lengths
    std::vector<Frame> frames;
    std::vector<Pointer> pointers;  ///< numbered after the points of the drawing
  };
  /// What is written of a group as it is met.
  struct Writing {
    std::vector<std::pair<std::string, Node>> with;
    std::map<std::string, std::string> points;  ///< names by what they stand for
    std::map<std::string, std::string> lefts;   ///< the same, to the left of a frame
  };

  bool put_group() override;
  const std::string& name_of(PointIndex point) const;
  const std::string& name_of(PointIndex point, const Parts& parts) const;
  /// Unknown points that more than one link has, or that something else holds.
  bool is_shared(PointIndex point, const Parts& parts) const;
  std::vector<LinkIndex> links_with_shared_points(const Parts& parts) const;
  std::vector<LinkIndex>::const_iterator next_link(const std::vector<LinkIndex>& links, const Parts& parts) const;
  std::vector<PointIndex> shared_of(LinkIndex link, const Parts& parts) const;
  void add_distance(LinkIndex link, PointIndex a, PointIndex b, Parts& parts) const;
  bool is_held_by_lengths(LinkIndex link, PointIndex a, PointIndex b, PointIndex point) const;
  void add_link(LinkIndex link, Parts& parts);
  void add_turned_link(LinkIndex link, std::vector<PointIndex> points, Parts& parts) const;
  void add_known_guides(Parts& parts);
  void add_moving_guide(JointIndex index, Parts& parts) const;
  /// The points with equations of their own that a point is built on.
  void expand(PointIndex point, const Parts& parts, std::vector<PointIndex>& into) const;
  bool put_smallest(Parts& parts);
  void write_group(const std::vector<PointIndex>& points, const std::vector<std::size_t>& equations, Parts& parts);
  Node near_of(const std::vector<PointIndex>& points, const Parts& parts) const;
  static std::string number_text(double value);

  // --- slides (planar_group_slides.cpp)

  /// Of the stroke of a joint; nothing where the drawing is not exact.
  std::optional<Stroke> moving_stroke(const DrawnCoordinate& coordinate) const;
  bool is_leg(const Stroke& stroke) const;
  void use_points_of_slides(Parts& parts) const;
  bool is_drawn_exactly(LinkIndex link) const;
  std::vector<PointIndex> points_in_use(LinkIndex link, const Parts& parts) const;
  std::vector<std::vector<LinkIndex>> links_that_turn_together() const;
  std::size_t lines_between(const std::vector<LinkIndex>& links) const;
  void find_frames(Parts& parts) const;
  bool give_second_point(const std::vector<LinkIndex>& links, Frame& frame, Parts& parts) const;
  void add_pointer(LinkIndex link, Frame& frame, Parts& parts) const;
  void name_pointer(PointIndex pointer, Parts& parts);
  /// Of a group that is placed: links that a pointer turns.
  void turn_frames(const std::vector<PointIndex>& points, const Parts& parts, const Writing& writing);
  const Frame* frame_of(LinkIndex link, const Parts& parts) const;
  /// Before others: links of known direction, frames, what turns with these.
  int rank(LinkIndex link, const Parts& parts) const;
  void add_moving_guides(Parts& parts) const;
  void add_strokes(Parts& parts) const;
  std::optional<Carried> line_on(LinkIndex carrier, PointIndex point, const Amounts& axis, const Parts& parts) const;
  void hold(PointIndex point, Carried line, Parts& parts) const;
  WrittenVector turned_with(LinkIndex link, const Amounts& v, bool is_of_shape, const Parts& parts, Writing& writing);
  std::string begin_of(const Carried& line, const Parts& parts, Writing& writing);
  Node from_point(const Carried& line, const Parts& parts, Writing& writing);
  void add_line(const Held& held, const Parts& parts, Writing& writing,
                std::vector<std::pair<std::string, Node>>& lines);
};

}  // namespace clearloci::mechanism
