// What symbolic/ hands to loci/: factors of Cramer determinants over the root tower, each with its cause and the
// reactions that vanish with it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clearloci/quantity.hpp"
#include "core/angle_chart.hpp"
#include "core/polynomial.hpp"
#include "core/root_tower.hpp"

namespace clearloci::inline core {

/// `preload`: where the choice of free efforts changes (docs/background/method.md section 15).
/// `construction`: a squared distance that the closure divides by; a point where the mode may change. With f of a joint
/// in space: zero where two directions across its axis may fall together, so that f1 and f2 of a force vanish that does
/// not.
enum class FactorRole { reaction, margin, preload, direct_singularity, workspace_boundary, construction };

/// Of a function that is a quadratic form in others, its parts: where all of these vanish it has a node. That is three
/// equations or more, of which two imply the others:
///     probes[i] parts[k] = probes[k] parts[i] + (a multiple of parts.back())   for i, k < parts.size() - 1
/// so that where parts[i] and parts.back() vanish and probes[i] does not, all parts do. The same holds between the
/// parts and probes of all forms of a problem that have one last part.
struct NodeForm {
  struct Part {
    Polynomial sheet;
    StraightLine line;  ///< occurs in the function's line
  };
  std::vector<Part> parts;
  std::vector<StraightLine> probes;  ///< one a part but for the last
};

/// Of a numerator or of |A|, and of nothing else.
inline bool is_of_determinants(FactorRole role) {
  return role == FactorRole::reaction || role == FactorRole::direct_singularity;
}

/// One factor of a numerator, of |A|, or of a Qj.
struct LocusFactor {
  FactorRole role = FactorRole::reaction;
  std::string expression;            ///< over the points' coordinates: "x - xB2"
  std::string cause;                 ///< "link PB2 parallel to the load"; empty where it has no such reading
  std::vector<Vanishing> vanishing;  ///< components (fx, fy, M) that vanish with it; margins: the quantity held;
                                     ///< preload: what vanishes at one choice
  Polynomial sheet;                  ///< in (x, y, s1...sm), multilinear in the roots; zero exactly where the factor is
  StraightLine line;                 ///< a multiple of `sheet`, zero besides only where denominators are; may be empty
  /// Irreducible over Z in (x, y): together they contain its zeros in every mode. Empty where its curves are not
  /// wanted and it only takes part in isolated points.
  std::vector<Polynomial> implicit;
  /// Its implicit polynomials were wanted but would be too large to be of use: `implicit` is empty, and the curves are
  /// to be traced on the sheets.
  bool implicit_too_heavy = false;

  // Of a direct singularity, w = N / |A|:
  int multiplicity = 1;              ///< how often it divides |A|
  std::vector<Vanishing> cancelled;  ///< numerators that it divides too, and how often w is without it for that
  /// Every reaction may stay finite on some curve of it. False is certain: some reaction grows without bound on all.
  bool may_be_idle = false;
  /// Of a margin: what its equation was multiplied by to be a polynomial, and how often. Where that vanishes too,
  /// orders of vanishing decide.
  std::vector<std::pair<Polynomial, int>> cleared;
  /// Where it is known how its nodes arise.
  std::optional<NodeForm> nodes = {};
};

/// A force in space that keeps to a plane in every pose: normal . (fx, fy, fz) = 0. Where two of its components vanish
/// the third does, too, if its part of the normal does not.
struct ForcePlane {
  std::string joint;
  std::array<Polynomial, 3> normal;  ///< over the tower, up to positive factors
};

/// Of a force in the plane, (Nx, Ny)/|A|: its numerators under the loads and under others, Mx and My. By Cramer's rule
/// Nx My - Ny Mx is a multiple of |A|, so that where Nx and |A| vanish and Mx does not, Ny vanishes, too.
struct ForceProbe {
  std::string joint;
  std::array<StraightLine, 2> numerators;
  std::array<StraightLine, 2> probes;
};

/// Functions that stand for the components of a joint's force in the plane, by their places among the problem's
/// `pair_functions`.
struct ForcePair {
  std::array<std::size_t, 2> system = {};
  /// Has to vanish, too, as it does where the system does and `normal` does not.
  std::optional<std::size_t> third;
  Polynomial normal;  ///< over the tower

  bool operator==(const ForcePair&) const = default;
};

/// Where the components are zero together the functions of one of the pairs are, and the other way round, but for
/// contact-loss curves.
struct ForcePairs {
  std::string joint;
  std::vector<ForcePair> pairs;
};

/// Everything needed to trace: no mechanism any more, only curves. Where a coordinate is an angle, the variable of the
/// polynomials, of the box and of `tower.coordinates` is the t of its chart, and the problem covers that chart alone.
struct LocusProblem {
  RootTower tower;
  /// One a coordinate: nothing for a length. Empty where no coordinate is an angle.
  std::vector<std::optional<AngleChart>> charts;
  std::vector<Rational> lower;  ///< box, one per coordinate
  std::vector<Rational> upper;
  std::vector<WorkingMode> modes;        ///< the modes to trace
  std::vector<LocusFactor> factors;      ///< reactions, margins, |A| and every Qj
  std::vector<Quantity> quantities;      ///< kinds of reaction loci wanted: f (from fx and fy), M, fx, fy
  std::vector<std::string> joints;       ///< joints wanted
  std::vector<std::string> joint_order;  ///< every joint, in the file's order
  /// Of every joint in that order: the components that vanish together where f does. Empty: fx and fy of each.
  std::vector<std::vector<Quantity>> force_components;
  std::vector<ForcePlane> force_planes;  ///< of joints whose force has three components
  std::vector<ForceProbe> force_probes;  ///< of joints whose force is (fx, fy), over two coordinates
  /// Of the joints for which lower functions are known than the factors of their forces' components.
  std::vector<ForcePairs> force_pairs;
  std::vector<LocusFactor> pair_functions;  ///< by their sheets and lines alone
  std::vector<Vanishing> always_zero;       ///< components that vanish in every pose
  std::vector<Vanishing> reactions;         ///< every other scalar reaction of the mechanism
  double tolerance = 1e-5;                  ///< chord deviation, m
};

/// The components of a joint's f.
std::vector<Quantity> force_components(const LocusProblem& problem, const std::string& joint);

}  // namespace clearloci::inline core
