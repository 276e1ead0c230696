// What all formats have in common on the way from a source to the drawn form. Private to mechanism/.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/rational.hpp"
#include "mechanism/import/import.hpp"
#include "mechanism/import/source.hpp"

namespace clearloci::mechanism::imports {

/// A row a constraint, six columns a link (velocity of its centre, angular velocity), lengths in sizes of the source.
using Rows = std::vector<std::vector<double>>;

/// What the joints forbid, linearised in the posture.
Rows constraint_rows(const Source& source);
/// How a joint moves by its own freedom, as such a row: what its motor holds.
std::vector<double> motor_row(const Source& source, const SourceJoint& joint);

/// The span of rows, one after the other.
class RowSpace {
 public:
  /// False where the row is in the span already.
  bool add(std::vector<double> row);
  std::size_t rank() const { return rows_.size(); }

 private:
  Rows rows_;  ///< each 1 at its pivot
  std::vector<std::size_t> pivots_;
};

/// Moves the links by as little as makes all joints meet (Levenberg-Marquardt from the posture; of an open posture from
/// spread ones), and says how far. Throws core::InputError that names the joint that does not meet.
void close_posture(Source& source, const std::string& file);

/// A link and what is on it, turned about a centre and shifted.
void move_link(Source& source, int link, const Vec& centre, const Vec& shift, const Rotation& turned);

/// One link of two: masses, joints, points and loads of `from` become those of `into`, which may be the ground.
void merge_links(Source& source, int into, int from);
/// Links that are welded together where both sides of the weld meet.
void merge_welds(Source& source);
/// Doubled pins, pins written as two balls, and links that two pins or a triangle of pins make one.
void merge_rigid(Source& source);

/// Where all links move in parallel planes: turns the source into a planar one, x and y in the plane.
void go_planar(Source& source);

/// The link, or the ground, that has both centres of two wheels; nothing where none has.
std::optional<int> carrier_of(const Source& source, const SourceMesh& mesh);
/// Whole numbers in this ratio, the smaller 20 at least. Throws core::InputError, which calls it `what`, where none
/// below 1000 come near.
std::array<long, 2> teeth_of(double first, double second, const std::string& what, const std::string& file, int line);
/// Joints that follow others become gears, or belts where both turn alike. Throws core::InputError that names the joint
/// where the axes are not parallel, or no link has both.
void mesh_followers(Source& source, const std::string& file);
/// Throws core::InputError that names wheels without a carrier, or of one link.
void check_meshes(const Source& source, const std::string& file);

/// Motors for a source that names none: guides with a range, joints of the ground, others, until nothing moves with all
/// of them held.
void choose_motors(Source& source);

/// The mechanism file. Adds to the source's notes.
std::string write_drawn(Source& source, const std::string& file, const std::string& clearance);

/// The shortest decimal within `tolerance` of a value: "0.25", "-3".
std::string shortest_decimal(double value, double tolerance);
/// A rational number as a decimal where it is one.
std::string exact_decimal(const core::Rational& value);

/// "A, B and C"; of many the first ones and how many more.
std::string enumerated(const std::vector<std::string>& names);

/// "link BCE", "the ground".
std::string link_words(const Source& source, int link);

}  // namespace clearloci::mechanism::imports
