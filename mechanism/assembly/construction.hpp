// Points in the order in which they are constructed, from the ground and the coordinates outwards, and the axes of
// joints in every pose: what plane and space have in common. Private to mechanism/.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mechanism/assembly/shape.hpp"
#include "mechanism/assembly/written_vector.hpp"

namespace clearloci::mechanism {

/// A construction as it goes into the file.
struct WrittenPoint {
  std::string name;
  Node form;
  std::string comment;
};

/// What is found: points, and what has to be written anew in other sections.
struct FoundConstruction {
  std::vector<WrittenPoint> points;
  std::map<JointIndex, std::vector<std::string>> axes;  ///< of joints whose axes are written anew
  std::vector<WrittenPoint> frames;
  std::map<std::size_t, std::string> distances;  ///< of gears on links that move, by their places in the file
};

/// A point that has its construction.
struct KnownPoint {
  std::string name;
  std::optional<WrittenVector> place;  ///< of explicit coordinates
  std::array<double, 3> posture{};     ///< SI
  bool has_place = true;               ///< `posture` is known
};

class Construction {
 public:
  explicit Construction(const Drawing& drawing);

 protected:
  using Handle = int;  ///< of a known point

  bool is_known(PointIndex point) const { return handles_.contains(point); }
  Handle handle(PointIndex point) const { return handles_.at(point); }
  const KnownPoint& known(Handle handle) const { return known_[static_cast<std::size_t>(handle)]; }

  Handle put(PointIndex point, const Node& form, const std::string& comment, std::optional<WrittenVector> place = {});
  /// A point that the drawing has not: the foot of a way, a direction. `name` is changed where it is taken.
  Handle put_extra(const std::string& name, const Node& form, const std::array<double, 3>& posture,
                   const std::string& comment, std::optional<WrittenVector> place = {});
  /// Points that close together: they have one form.
  void put_together(const std::string& name, const Node& form, const std::string& comment,
                    const std::vector<PointIndex>& points);
  /// A point that has its construction by others, such as a group.
  Handle know(const std::string& name, const std::array<double, 3>& posture);
  /// Of a coordinate in the drawn posture, m or rad.
  double drawn_value(std::size_t coordinate) const;
  /// The form of a point at a way from another one.
  Node form_at(Handle base, const WrittenVector& by, std::optional<WrittenVector>& place) const;

  /// Throws where it is not known where a point is in the drawn posture: no side can be told from it.
  void require_place(Handle handle) const;

  /// A point that stands still, or keeps its own construction and has all that this uses. False where it is neither.
  bool put_given(PointIndex point);

  Node list(const std::vector<std::string>& texts) const;
  Node map(const std::vector<std::pair<std::string, Node>>& pairs) const;
  Node text(const std::string& text) const { return Node::scalar(text, {}); }
  Node explicit_form(const WrittenVector& place) const;
  /// A vector as a list where it is one: [1, 0].
  Node vector_node(const std::string& written) const;

  /// The points of a link that have a construction and a place in its shape, far enough apart to tell them.
  std::vector<PointIndex> known_points(LinkIndex link) const;
  bool is_apart(PointIndex a, PointIndex b) const;
  /// The drawn axis of a joint, as far as it is exact.
  std::optional<Amounts> drawn_axis(JointIndex joint, std::size_t which = 0) const;
  /// Whether an axis holds in every pose as it is written.
  bool axis_stays(JointIndex joint, std::size_t which = 0) const;

  const Shape& shape(LinkIndex link) const { return shapes_[static_cast<std::size_t>(link)]; }
  std::size_t dimension() const { return mechanism::dimension(d_.mechanism); }
  std::string new_name(const std::string& wanted);
  /// Links with a point that has no construction.
  std::vector<LinkIndex> open_links() const;
  bool is_complete() const { return handles_.size() == d_.points.size(); }

  const Drawing& d_;
  std::vector<bool> fixed_;
  FoundConstruction found_;

 private:
  std::vector<Shape> shapes_;
  std::vector<KnownPoint> known_;
  std::map<PointIndex, Handle> handles_;
  std::set<std::string> names_;
};

/// Throws core::InputError where some links close together in a group.
FoundConstruction construct_in_plane(const Drawing& drawing);
FoundConstruction construct_in_space(const Drawing& drawing);

}  // namespace clearloci::mechanism
