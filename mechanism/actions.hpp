// What springs and actuators of known effort exert, as forces and couples between two links (method.md section 11):
// which links, where and along which vector. How large it is, each folder computes for itself.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// A force along a vector v on link `on` at `on_point`, and its opposite on link `by` at `by_point`. Its size:
///     constant   effort, along v / |v|
///     linear     stiffness (|v| - free length), along v / |v|
/// A couple about v, with effort along v / |v|; counter-clockwise in the plane, where v is empty. Of a torsion spring:
///     torsion    -stiffness (angle - rest) on `on`, the angle from the frame of `by` to that of `on`
struct Action {
  enum class Law { constant, linear, torsion };
  enum class Source { spring, actuator };
  Source source = Source::spring;
  std::size_t index = 0;  ///< of the spring or the joint
  Law law = Law::constant;
  bool couple = false;
  LinkIndex on = ground, by = ground;
  PointIndex on_point = 0, by_point = 0;
  std::optional<VectorExpression> along = {};
  Expression effort = {}, stiffness = {}, free_length = {}, rest = {};
  std::string name = {};

  /// Whether 1 / |v| enters its equations.
  bool needs_length(const Mechanism& mechanism) const;
  /// Of the vector v, among those of all actions: no spring, joint or point has such a name as that of an axis.
  std::string length_name() const { return source == Source::spring ? name : name + ".axis"; }
};

/// For whoever writes equations of forces: throws core::InputError where a free effort has no value.
void require_preload(const Mechanism& mechanism);

/// The springs in the file's order, then the actuators.
std::vector<Action> actions(const Mechanism& mechanism);

/// A torsion spring is known within half a turn of its rest less a tenth of a degree: where its couple jumps the
/// workspace ends as at a limit. The cosine of the angle is at least this. Both ends of the range have this cosine and
/// a rational sine: this one and its opposite.
core::Rational least_torsion_cosine();
core::Rational torsion_sine_at_end();
/// "torsion spring T half a turn off its rest".
std::string words_of_reach(const Spring& spring);

/// "effort of joint B2 at 30 N m": of a law, at a bound.
std::string words_of_law(const Mechanism& mechanism, const Joint& joint, const Rational& value);

/// "tension of K1 at 60 N", "B2 at 30 N m": of an effort that is determined, in N and N m.
std::string words_of_bound(const Joint& joint, const Rational& bound);

/// "flank of gear G" or "span of belt T": of a mesh that bears one way only.
std::string words_of_mesh(const Joint& joint);

/// Efforts that follow a law with bounds.
std::vector<JointIndex> bounded_laws(const Mechanism& mechanism);

/// What a pose may be beyond: the file's limits, its torsion springs, then what rigid links hold (rigidity.hpp).
std::string words_of_end(const Mechanism& mechanism, std::size_t limit, bool upper);

/// Of a link's first two points, the way from one to the other; the x axis of the ground: what torsion springs measure.
VectorExpression direction_of(const Mechanism& mechanism, LinkIndex link);

/// The way from one point to another.
VectorExpression way(PointIndex from, PointIndex to);

/// A force as a vector over points. Requires a force.
VectorExpression force_of(const Load& load);

/// "angle A1-B1-P", "distance A1-P".
std::string name_of(const Mechanism& mechanism, const Limit& limit);

/// What the cause of a boundary that a limit makes begins with; then the words of the limit.
inline constexpr std::string_view limit_cause = "limit: ";

/// "distance A1-P at 0.52 m". `upper`: its upper end.
std::string words_of(const Mechanism& mechanism, const Limit& limit, bool upper);

}  // namespace clearloci::mechanism
