// Whether every pose of a task is good with a choice of its own: values behind the coordinates, such as efforts that
// are free, which a chooser proposes at the middle of each cell, and the statics that they are values of. Cells are cut
// until each is proven with what was chosen for it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "loci/tasks/pose_proof.hpp"

namespace clearloci::loci::pose {

/// Values that follow the coordinates of the task in those of the statics.
struct PoseChoice {
  const core::PoseStatics* statics = nullptr;  ///< lives as long as the chooser
  std::vector<double> values;
};

class PoseChooser {
 public:
  PoseChooser() = default;
  virtual ~PoseChooser() = default;
  PoseChooser(const PoseChooser&) = delete;
  PoseChooser& operator=(const PoseChooser&) = delete;

  /// What may be good at a pose; nothing where no choice seems to be.
  virtual std::optional<PoseChoice> choose(const Pose& pose) = 0;
  /// Whether a pose without a choice fails for certain.
  virtual bool refutes(const Pose& pose) = 0;
};

PoseProof prove_with_choice(PoseChooser& chooser, const PoseRegion& region, double margin,
                            const PoseEffort& effort = {});

}  // namespace clearloci::loci::pose
