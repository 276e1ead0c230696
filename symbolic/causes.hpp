// Physical names for factors: "link PB2 parallel to the load", "A1, B1, P aligned". Private to symbolic/.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/geometry.hpp"
#include "symbolic/lines_of_action.hpp"

namespace clearloci::symbolic {

/// Geometric conditions of the mechanism as polynomials in natural coordinates, each with its wording.
class Causes {
 public:
  /// With the equations, conditions on the lines that reactions and loads act along besides.
  explicit Causes(const Geometry& geometry, const NewtonEulerEquations* equations = nullptr);

  /// The wording of the condition that a factor states, up to a constant; empty where it states none of them.
  std::string of(const Poly& factor) const;
  /// The same of a determinant's factor, which no load enters: conditions on the load's direction are left out.
  std::string of_determinant(const Poly& factor) const;

  /// The condition that the line of two points is perpendicular to a vector.
  Poly perpendicular(mechanism::PointIndex a, mechanism::PointIndex b, const mechanism::VectorExpression& along) const;

  /// The condition that three points of the plane lie on a line.
  Poly aligned(mechanism::PointIndex a, mechanism::PointIndex b, mechanism::PointIndex c) const;

  /// The condition that both lengths of a dyad point the same way, in space as seen along its axis; and its wording.
  Poly stretched(mechanism::PointIndex elbow, const mechanism::DyadPoint& dyad) const;
  std::string stretched_wording(mechanism::PointIndex elbow, const mechanism::DyadPoint& dyad) const;

 private:
  struct Edge;
  struct Direction;
  void add(const Poly& condition, std::string wording);
  std::array<Poly, 3> vector(const mechanism::VectorExpression& vector) const;
  void add_load_conditions(const std::vector<Edge>& edges, const std::vector<Direction>& directions);
  /// The shared point of two links in the middle, "A1, B1, P aligned": all, or those with the given one.
  void add_alignments_along_chains(std::optional<mechanism::PointIndex> at);
  void add_alignments();
  void add_link_pairs(const std::vector<Edge>& edges);
  std::string of_lines(const Poly& factor, bool loads) const;

  const Geometry* geometry_;
  const NewtonEulerEquations* equations_;
  mutable std::optional<LinesOfAction> lines_;  ///< made where no other condition holds
  std::vector<std::array<Poly, 3>> points_;     ///< z = 0 in the plane
  std::vector<std::pair<Poly, std::string>> conditions_;
  std::size_t first_of_loads_ = 0, last_of_loads_ = 0, first_of_springs_ = 0;  ///< among conditions_
};

}  // namespace clearloci::symbolic
