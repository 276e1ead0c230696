// A task as it is asked of every design of a family (method.md section 12): equations with the varied parameters left
// open, derived once, and what proves or refutes the task for any of them.
//     Mechanism, ranges, Task -> mechanism::open_design -> symbolic::task_conditions -> loci::DesignJudge
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/loci.hpp"
#include "core/task.hpp"
#include "loci/tasks/tasks.hpp"
#include "mechanism/open_design.hpp"

namespace clearloci {

/// From, to: the values of one varied parameter.
using ExactRange = std::pair<core::Rational, core::Rational>;

/// Throws core::InputError for a task of which many designs or loads are not judged at once.
void require_asked_of_designs(const mechanism::Mechanism& mechanism, const core::Task& task);

class DesignTask {
 public:
  /// `vary`: parameters that designs differ in. Those that the task gives a tolerance to may differ besides.
  /// Throws core::InputError as verify(), and for parameters that cannot be left open.
  DesignTask(const mechanism::Mechanism& mechanism, const std::vector<mechanism::ParameterRange>& vary,
             const core::Task& task, const LociRequest& request = {});
  DesignTask(const DesignTask&) = delete;
  DesignTask& operator=(const DesignTask&) = delete;

  const core::Task& task() const { return task_; }
  const loci::TaskRegion& region() const { return region_; }
  const mechanism::OpenDesign& design() const { return open_; }
  const core::TaskConditions& conditions() const { return conditions_; }
  const core::WorkingMode& mode() const { return mode_; }
  const std::vector<core::LoadBall>& balls() const { return balls_; }
  double margin() const { return margin_; }
  /// The open mechanism under the first and the last load, and under the unit loads of the balls.
  const std::vector<mechanism::Mechanism>& loads() const { return loads_; }
  const std::vector<mechanism::Mechanism>& directions() const { return directions_; }
  /// Without those that no pose, design or load can fail to meet.
  std::vector<core::TaskDemand> demands() const;
  const DyadSides& sides() const { return sides_; }

  /// The designs whose parameters, in the order of `vary`, are in these ranges, with the task's tolerances around them:
  /// a range for each of design().varied. Nothing where a link has a length that is not above zero in one of them.
  std::optional<loci::DesignBox> box(const std::vector<ExactRange>& values) const;

  /// A judge of one's own: one a thread. This must outlive it.
  std::unique_ptr<loci::DesignJudge> judge() const;

  /// For figures: a judge whose conditions say what forces, efforts and displacements are. Derived when first asked
  /// for.
  std::unique_ptr<loci::DesignJudge> measure() const;
  std::vector<int> forces() const;   ///< conditions of measure()
  std::vector<int> efforts() const;  ///< likewise, of actuators

  /// "workspace", "singularity", "contact lost in A1, B1", "backlash in A1", "min_force in P"; where only the task's
  /// margin is met "margin: workspace", ...
  std::string reason(const loci::DesignFailure& failure) const;

 private:
  loci::DesignVariables variables() const;
  core::TaskConditions conditions_for(const std::vector<core::TaskDemand>& demands, bool take_ups,
                                      const std::vector<bool>& always = {}) const;

  const mechanism::Mechanism& mechanism_;
  std::vector<mechanism::ParameterRange> vary_;
  core::Task task_;
  LociRequest request_;
  mechanism::OpenDesign open_;
  std::vector<core::LoadBall> balls_;
  std::vector<mechanism::Mechanism> loads_, directions_;
  DyadSides sides_;
  std::vector<core::TaskDemand> demands_;
  core::TaskConditions conditions_;
  core::WorkingMode mode_;
  loci::TaskRegion region_;
  double margin_ = 0;
  struct Measured {
    core::TaskConditions conditions;
    core::WorkingMode mode;
    std::vector<int> forces, efforts;
  };
  const Measured& measured() const;
  mutable std::mutex mutex_;
  mutable std::optional<Measured> measured_;
};

}  // namespace clearloci
