// The Newton-Euler equations of a mechanism as registers of a tape (paper (9), (10); method.md section 2):
//     A w = -w_e          of every link force (N), then moment about the end-effector point (N m)
// A link of the plane has the rows fx, fy, mz of one in space. Private to numeric/.
//
// In the plane the unknowns are those of mechanism::unknowns. In space every joint bears a force and a couple written
// in Cartesian components, which vary smoothly with the pose; what it does not bear is an equation of its own:
//     free along an axis u:    u · f = 0          prismatic and cylindrical joints that are not actuated
//     free about an axis u:    u · m = 0          cylindrical joints, and revolute ones that are not actuated
//     actuated along, about u: F = u · f, M = u · m
// A universal joint bears the one couple T (u × v)/|u × v|. The determinant is that of A alone in the orthonormal form
// of reactions.hpp: each equation stands at the row of the unknown that it disposes of, and contributes the factor one.
#pragma once

#include <vector>

#include "numeric/geometry.hpp"

namespace clearloci::numeric {

/// Force and couple.
using WrenchRegisters = std::array<Register, 6>;

class Equations {
 public:
  explicit Equations(Geometry& geometry, const mechanism::Mechanism& mechanism);

  const std::vector<mechanism::Unknown>& unknowns() const { return unknowns_; }
  /// Under loads, and under a unit of a component of a wrench on the end effector.
  SparseEquations under(const std::vector<LoadRegisters>& loads);
  SparseEquations under_unit(std::size_t component);
  /// Where the equations of the links stand: of every component of every link, link after link.
  const std::vector<std::size_t>& link_rows() const { return link_rows_; }
  /// Of a wrench on a link: 3 or 6.
  std::size_t components() const { return rows_of_wrench_.size(); }

 private:
  WrenchRegisters force_at(mechanism::PointIndex at, const Triple& force);
  WrenchRegisters couple(const Triple& couple) const;
  int add_unknown(mechanism::JointIndex joint, core::Quantity quantity, const WrenchRegisters& wrench);
  void add_planar_unknowns();
  void add_spatial_unknowns(mechanism::JointIndex joint);
  void add_side_equation(mechanism::JointIndex joint, int first, core::Quantity actuator, bool actuated);
  void add(SparseEquations& e, mechanism::LinkIndex link, int column, const WrenchRegisters& wrench, bool negative);
  void write_matrix();

  Geometry& geometry_;
  TapeBuilder& tape_;
  const mechanism::Mechanism& m_;
  std::vector<std::size_t> rows_of_wrench_;  ///< which components of a wrench are rows
  std::vector<mechanism::Unknown> unknowns_;
  std::vector<WrenchRegisters> wrenches_;                ///< of a unit of each unknown
  std::vector<std::map<int, Register>> side_equations_;  ///< by row; empty: the row of a link
  std::vector<std::size_t> link_rows_;                   ///< of every component of every link
  SparseEquations matrix_;
};

}  // namespace clearloci::numeric
