// Whether a pose of one to six coordinates fails a task, for certain: as numeric/task_witness.hpp does over two
// lengths, and by signs. A reaction's numerator and |A| vary continuously with the pose wherever the mechanism is
// assembled: if the sign of either is certain at both ends of a way and differs, then on that way it vanishes or the
// mechanism does not follow.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "numeric/task_witness.hpp"

namespace clearloci::numeric {

class PoseWitness {
 public:
  /// As of TaskWitness.
  PoseWitness(std::vector<const NumericModel*> loads, std::vector<int> mode, std::vector<core::TaskDemand> demands,
              const std::vector<std::vector<double>>& usual);

  /// What fails at a pose of these demands, `-1` for |A| and the workspace alone; nothing where it is good, or doubles
  /// cannot tell. It stands for every pose within a few roundings of it.
  std::optional<TaskFailure> failure(std::span<const double> at, int demand) const;

  /// Whether a sign differs, for certain, at two poses: of |A| with demand -1, else of the one component of a reaction
  /// or of |A|.
  bool differs(std::span<const double> a, std::span<const double> b, int demand) const;

  /// Whether a reaction is zero, to rounding, at every pose.
  bool is_never_loaded(int demand, const std::vector<std::vector<double>>& poses) const;

  const std::vector<core::TaskDemand>& demands() const { return demands_; }

 private:
  std::vector<BoundedNumerators> numerators(std::span<const double> at, double many) const;

  std::vector<const NumericModel*> loads_;
  std::vector<int> mode_;
  std::vector<core::TaskDemand> demands_;
  double usual_determinant_ = 0;
  std::vector<double> extents_;  ///< of every coordinate the largest among the usual poses
};

}  // namespace clearloci::numeric
