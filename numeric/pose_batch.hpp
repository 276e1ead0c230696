// Reactions, take-up and pose errors (pose_error.hpp) of a few poses at once: the same steps for every pose, so that
// each is a loop over lanes of doubles that lie side by side. Private to numeric/.
#pragma once

#include <Eigen/LU>
#include <array>
#include <vector>

#include "numeric/evaluator.hpp"
#include "numeric/pose_error.hpp"
#include "numeric/reach.hpp"

namespace clearloci::numeric {

class PoseBatch {
 public:
  static constexpr int lanes = 16;  // a few hundred registers of 16 doubles stay within the second-level cache
  using Lane = std::array<double, lanes>;
  using Lanes3 = std::array<Lane, 3>;  ///< a vector's components

  /// `mode`: a sign a dyad.
  PoseBatch(const NumericModel& model, std::span<const int> mode);

  double& input(std::size_t coordinate, int lane) { return evaluator_.input(coordinate, lane); }

  /// All of these need the one before, and the errors under loads or the reaches only where they are asked for.
  void run_tape() { evaluator_.run_tape(); }
  void find_influence();
  void find_errors_under_load();
  void find_reaches();

  bool reachable(int lane) const { return evaluator_.reachable(lane); }
  /// |A| but for its sign. Needs the influence.
  double determinant(int lane) const { return determinant_[static_cast<std::size_t>(lane)]; }
  /// NaN where some take-up is undefined.
  PoseError error(int lane) const;
  /// Without the rotation's size. `accuracy`: relative, of the largest |Δp|.
  WorstCase worst(int lane, double accuracy);

 private:
  /// A component of what a unit of an unknown exerts: `sign` times a register, or alone.
  struct Part {
    std::size_t component = 0;
    double sign = 1;
    Register value = -1;
  };
  struct Way {
    bool couple = false;  ///< a couple; else a force
    bool effort = false;  ///< the actuator's
    std::vector<Part> parts;
  };
  /// Right sides of one matrix.
  struct System {
    std::vector<std::size_t> sides;
  };

  Way way_of(const mechanism::Unknown& unknown) const;
  void add_system(std::size_t side);
  const Elimination& elimination(std::size_t side) const;
  const double* at(Register r) const { return &evaluator_.value(r, 0); }
  const double* axis(std::size_t joint, std::size_t component) const;

  void solve(const System& system);
  void solve_small_core(std::size_t side);
  void solve_core(const System& system);
  void substitute(std::size_t side);

  void add(const Part& part, const Lane& by, Lanes3& sum) const;
  Lanes3 across_axis(std::size_t joint, const Lanes3& v) const;
  Lanes3 guide_normal(std::size_t joint) const;
  struct TakenUp {
    Lanes3 displacement{}, rotation{};
  };
  TakenUp taken_up(std::size_t joint);
  void take_up_actuator(std::size_t joint, const Lane& effort, TakenUp& result);
  void take_up_guide(std::size_t joint, const Lanes3& force, const Lane& couple, TakenUp& result);
  void move_by(std::size_t joint, const TakenUp& taken_up);

  /// One clearance in every pose: how far it leads in each row, for each of its `width` directions.
  struct LaneReach {
    std::size_t width = 0;
    std::array<Lanes3, 6> rows{};
  };
  LaneReach& next_reach(std::size_t width);
  void add_reaches(std::size_t joint);
  void add_reach_along(std::size_t joint, double size, const std::array<Lanes3, 6>& influence);

  const NumericModel& model_;
  bool spatial_;
  std::vector<JointContact> contacts_;                 ///< axes are not followed
  std::vector<Way> ways_;                              ///< of every unknown
  std::vector<std::vector<std::size_t>> unknowns_of_;  ///< of every joint
  Evaluator<double, lanes> evaluator_;
  Lane determinant_{};
  std::vector<std::vector<Lane>> values_;  ///< of every unknown: to the unit wrenches, then to the loads
  std::vector<System> systems_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::MatrixXd matrix_, right_, solved_;
  std::array<Lane, 6> error_{};  ///< dp, dα
  Lane lost_{};                  ///< not 0 where some take-up is undefined
  std::vector<LaneReach> reaches_;
  std::size_t reaches_used_ = 0;
  std::vector<Reach> of_one_;
};

}  // namespace clearloci::numeric
