// From a mechanism to the factors whose zeros are its discontinuity loci (method.md sections 1 to 5).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/locus_factor.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::symbolic {

/// What to trace.
struct Selection {
  std::vector<std::string> joints;  ///< empty: every joint with a clearance, or all where none has one
  std::vector<core::Quantity> quantities = {core::Quantity::f, core::Quantity::M};
  std::optional<core::Rational> min_force;   ///< N: adds the margin curves |f_J|, |F_J| = min_force
  std::optional<core::Rational> min_couple;  ///< N m: adds the margin curves |M_J| = min_couple
  /// Signs of the dyads and sliders, +1 left or ahead, in the order of mechanism::dyad_points; empty: the file's mode.
  std::vector<std::vector<int>> working_modes = {};
  bool controlled = false;  ///< free efforts without a value vary with the pose
};

struct DerivedProblem {
  core::LocusProblem problem;
  std::vector<std::string> notes;  ///< reactions that vanish in every pose, and the like
  /// Factors of wanted numerators on which nothing wanted vanishes, as they are computed: with them a certificate makes
  /// up every numerator. Over two coordinates only.
  std::vector<core::LocusFactor> rest;
  /// Expressions of factors and how the file's coordinates write them, of a mechanism in a frame: curves are sorted by
  /// what does not depend on where the file puts them.
  std::map<std::string, std::string> in_file = {};
  double symbolic_seconds = 0;     ///< matrix, numerators, factors
  double elimination_seconds = 0;  ///< roots eliminated, factored
  int piece = 0;                   ///< of the coordinates' ranges: problems with the same charts have the same
};

/// The factors of every wanted numerator, of |A| and of every Qj, over the root tower, with their implicit
/// polynomials. Throws core::InputError for an unknown joint, a non-square system or a determinant that vanishes in
/// every pose.
///
/// Every angle among the coordinates is cut into charts (core/angle_chart.hpp): one problem for each choice of charts,
/// in the order of the angles; a single problem where no coordinate is an angle.
///
/// Where roots of the tower depend on one another (method.md section 10), as of two equal legs on one base point, the
/// modes are not alike: there is one problem for each kind of them, and for each side of every fold, r = 0 in s = |r|.
/// Their towers have a root more for every fold, whose square is positive on its side. Modes in which |A| vanishes in
/// every pose are left out with a note; core::InputError where no mode is left.
std::vector<DerivedProblem> locus_problems(const mechanism::Mechanism& mechanism, const Selection& selection);

/// The same for the members of a family of designs that differ in the values of parameters: what does not depend on
/// the values is derived once. The problems are those that locus_problems gives for the member alone.
class LocusFamily {
 public:
  /// `member`: any design of the family. Throws as locus_problems does where the equations themselves are wrong.
  explicit LocusFamily(const mechanism::Mechanism& member);
  ~LocusFamily();
  LocusFamily(LocusFamily&&) noexcept;
  LocusFamily& operator=(LocusFamily&&) noexcept;

  std::vector<DerivedProblem> problems(const mechanism::Mechanism& member, const Selection& selection) const;

 private:
  std::unique_ptr<const class Family> family_;
};

/// The one problem of a mechanism without angles. Throws core::InputError where there are several.
DerivedProblem locus_problem(const mechanism::Mechanism& mechanism, const Selection& selection);
DerivedProblem locus_problem(const mechanism::Mechanism& member, const Selection& selection, const LocusFamily& family);

}  // namespace clearloci::symbolic
