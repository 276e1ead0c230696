// What the joints of a source ask of the motions of its links, six numbers each: that points are one, axes parallel, or
// frames turned alike. Private to mechanism/import.
#pragma once

#include <cstddef>
#include <vector>

#include "mechanism/import/common.hpp"

namespace clearloci::mechanism::imports {

constexpr std::size_t freedoms = 6;  ///< of a link: the velocity of its centre, its angular velocity

/// Of a source as it stands, in sizes of the source and rad.
class Constraints {
 public:
  explicit Constraints(const Source& source);

  std::size_t columns() const { return freedoms * source_.links.size(); }
  /// Of a link: the middle of its joints.
  const Vec& centre(int link) const { return centres_[index(link)]; }
  /// 1 / the size of the source.
  double scale() const { return scale_; }

  /// Appends the values of one joint, all zero where it meets, and their slopes where `rows` is not null.
  void add(const SourceJoint& j, std::vector<double>& values, Rows* rows) const;

  /// d/dt of the place of a side and of a direction of it, per unit of each freedom of its link.
  Vec moved(int link, const Vec& at, std::size_t freedom) const;
  static Vec turned(const Vec& direction, std::size_t freedom);

 private:
  static std::size_t index(int link) { return static_cast<std::size_t>(link); }
  Rows* start(Rows* rows, std::size_t count) const;
  void add_meeting(const SourceJoint& j, std::vector<double>& values, Rows* rows) const;
  void add_line(const SourceJoint& j, std::vector<double>& values, Rows* rows) const;
  void add_parallel(const SourceJoint& j, const std::vector<const Vec*>& of_from, const std::vector<const Vec*>& of_to,
                    std::vector<double>& values, Rows* rows) const;
  void add_square(const SourceJoint& j, std::vector<double>& values, Rows* rows) const;
  template <typename Do>
  void each_freedom(const SourceJoint& j, const Do& one) const;

  const Source& source_;
  double scale_;
  std::vector<Vec> centres_;
};

/// The angle of `to` from `from` about the axis of a pin, rad, or its travel along that of a guide or cylindrical
/// joint, in the source's length; 0 where their frames are one, and of other joints.
double amount_of(const SourceJoint& joint);

/// The same by which a joint went from one posture to another, less than half a turn.
double way_between(const SourceJoint& before, const SourceJoint& after);

/// The largest absolute value; infinite where one is no number.
double largest(const std::vector<double>& values);

}  // namespace clearloci::mechanism::imports
