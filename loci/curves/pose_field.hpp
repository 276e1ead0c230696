// What may vanish over a pose, as numbers: |A|, the numerators of the reactions that are asked for (N = g |A|, finite
// where |A| vanishes), and what margins leave of them, |N|^2 - least^2 |A|^2. In floating point; nothing is proven
// here.
#pragma once

#include <optional>
#include <vector>

#include "core/pose_statics.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::pose {

struct FieldQuantity {
  Doubt doubt = Doubt::singularity;  ///< that, or `demand`
  int demand = -1;                   ///< of core::PoseStatics
  std::size_t first = 0, count = 1;  ///< its components among the values
};

struct FieldSample {
  std::vector<double> values;
  core::BlockUnknowns unknowns;  ///< of groups
  int orientation = 1;           ///< the sign of their det J
  double least_closure = 0;      ///< of the squares and limits that end the workspace; without any infinite

  /// Of a quantity at two poses: its components, multiplied and added.
  static double product(const FieldQuantity& quantity, const FieldSample& a, const FieldSample& b);
  double size(const FieldQuantity& quantity) const;
};

class PoseField {
 public:
  /// `statics` must outlive it. One a thread. `scale`: log |A| of a pose of the box, which values are measured by.
  explicit PoseField(const core::PoseStatics& statics, double scale = 0);

  const std::vector<FieldQuantity>& quantities() const { return quantities_; }

  /// Nothing where the pose cannot be assembled, groups are not proven to, or A cannot be inverted.
  std::optional<FieldSample> at(const Pose& pose);
  /// By Newton's iteration from a sample nearby; as above where it does not converge quickly.
  std::optional<FieldSample> at(const Pose& pose, const FieldSample& nearby);
  /// log |A| where it was looked at last.
  double logarithm() const { return logarithm_; }

 private:
  std::optional<FieldSample> solved(const Pose& pose, core::BlockUnknowns unknowns);

  const core::PoseStatics& statics_;
  double scale_, logarithm_ = 0;
  PosePoint point_;
  std::vector<FieldQuantity> quantities_;
  std::vector<double> leasts_;  ///< of the demands
};

/// A zero of a quantity on the way between two poses at which it has opposite signs, or directions. Nothing where it
/// does not vanish there, but turns.
std::optional<Pose> zero_between(PoseField& field, const FieldQuantity& quantity, const Pose& a,
                                 const FieldSample& at_a, const Pose& b, const FieldSample& at_b);

/// Where the workspace ends on the way from a pose in it to one that is not.
struct FieldEnd {
  Pose at;
  FieldSample sample;
  bool closure = false;  ///< a square or a limit vanishes there; else groups come to a dead centre
};
FieldEnd end_between(PoseField& field, const Pose& inside, const FieldSample& at_inside, const Pose& outside);

}  // namespace clearloci::loci::pose
