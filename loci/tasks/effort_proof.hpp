// Whether every pose of a task is good with efforts that are chosen for it. Reactions are affine in the free efforts
// lambda and in what a load may differ by, p (docs/background/method.md section 15):
//     w = a(q) + B(q) lambda + C(q) p
// with one A for all, so that a cell encloses each column once, whatever is chosen in it. A chooser proposes efforts
// from the values at the middle of each cell; the cell is proven where every demand n . f is certainly above its least.
// Cells are cut until each is proven with what was chosen for it.
//
// Of a ball |p| <= R the least is  n . (a + B lambda) - R |n . C|.
//
// At one pose demands of one component keep half spaces of lambda. Of more components each cell has a direction n of
// its own, and every two cells that touch are proven with the efforts of either along the directions of both: where
// they meet all efforts between are good, so that some vary continuously with the pose.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/pose_statics.hpp"
#include "loci/tasks/pose_proof.hpp"

namespace clearloci::loci::pose {

/// The columns of a, B and C.
struct EffortStatics {
  core::PoseStatics statics;               ///< without demands; its loads are the columns, in this order
  std::vector<core::PoseDemand> demands;   ///< bounds of efforts are demands as any other
  std::vector<double> leasts;              ///< one a demand, N or N m; of a bound side * at
  std::size_t bases = 1, efforts = 0;      ///< what follows are directions of loads
  std::vector<core::LoadBall> balls = {};  ///< of the directions

  std::size_t directions() const { return statics.loads - bases - efforts; }
};

/// At one pose, of one design: demand, component, column; N, N m, and what an effort of 1 or a load of 1 makes of them.
using EffortColumns = std::vector<std::vector<std::vector<double>>>;

struct EffortChoice {
  std::vector<std::vector<double>> efforts;     ///< of each base the free efforts
  std::vector<std::vector<double>> gains = {};  ///< of each direction what it adds to them a unit; empty: nothing
  std::vector<std::vector<double>> ways = {};   ///< of each demand a unit vector: a sign, of one component

  bool operator==(const EffortChoice&) const = default;
};

/// A cell that is proven, and what was chosen in it.
struct EffortCell {
  PoseBox poses;
  const EffortStatics* statics = nullptr;
  EffortChoice choice;
};

class EffortChooser {
 public:
  EffortChooser() = default;
  virtual ~EffortChooser() = default;
  EffortChooser(const EffortChooser&) = delete;
  EffortChooser& operator=(const EffortChooser&) = delete;

  /// Statics that are regular at a pose; they live as long as the chooser. Null where none are.
  virtual const EffortStatics* statics_at(const Pose& pose) = 0;
  /// What may be good at a pose, for all of these designs; nothing where no choice seems to be.
  virtual std::optional<EffortChoice> choose(const EffortStatics& statics,
                                             const std::vector<EffortColumns>& designs) = 0;
  /// The same efforts with the ways that forces have under them at a pose.
  virtual EffortChoice turned(const EffortStatics& statics, const std::vector<EffortColumns>& designs,
                              const EffortChoice& choice) = 0;
  /// Whether a pose without a choice fails for certain.
  virtual bool refutes(const Pose& pose) = 0;
};

struct EffortProof {
  CoverProof proof;
  std::vector<EffortCell> cells;  ///< that cover the task, where it is verified
};

/// `designs`: coordinates of the statics behind those of the task, over which a choice is the same.
EffortProof prove_with_efforts(EffortChooser& chooser, const PoseRegion& region, const PoseBox& designs, double margin,
                               const SearchBudget& budget = budget_of_poses);

}  // namespace clearloci::loci::pose
