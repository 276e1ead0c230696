// Proposes efforts for a cell, of one pattern of signs, and refutes the pattern at a pose. Private to analysis/.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/effort_patterns.hpp"
#include "analysis/effort_system.hpp"
#include "loci/tasks/tasks.hpp"

namespace clearloci {

/// The systems of a mechanism: one of motors, of cables one of each choice of those that are free.
class EffortSystems {
 public:
  /// Everything that is given must outlive them.
  EffortSystems(const mechanism::Mechanism& mechanism, const std::vector<WantedEffort>& wanted, const core::Task& task,
                DyadSides sides, const LociRequest& request);

  /// That of a pose; null where no choice of cables holds it.
  EffortSystem* at(const loci::pose::Pose& pose);
  /// The system that statics are of.
  const EffortSystem& of(const loci::pose::EffortStatics& statics) const { return *by_statics_.at(&statics); }
  /// Why a pose fails whatever the efforts: it is out of reach.
  std::optional<core::TaskWitness> unreachable(const loci::pose::Pose& pose) const;
  const DyadSides& sides() const { return sides_; }
  const mechanism::Mechanism& mechanism() const { return mechanism_; }
  const core::Task& task() const { return task_; }

 private:
  const mechanism::Mechanism& mechanism_;
  const std::vector<WantedEffort>& wanted_;
  const core::Task& task_;
  DyadSides sides_;
  const LociRequest& request_;
  std::map<std::vector<mechanism::JointIndex>, std::unique_ptr<EffortSystem>> all_;
  std::map<const loci::pose::EffortStatics*, const EffortSystem*> by_statics_;
};

/// Efforts of one pattern and of a size at most, deep within all that is asked for at some places; nothing where none
/// were found.
std::optional<loci::pose::EffortChoice> deep_choice(const EffortSystem& system,
                                                    const std::vector<loci::pose::EffortColumns>& places,
                                                    const SignPattern& signs, bool knows_load, double most_size);

class PatternChooser : public loci::pose::EffortChooser {
 public:
  PatternChooser(EffortSystems& systems, SignPattern signs) : systems_(systems), signs_(std::move(signs)) {}

  const loci::pose::EffortStatics* statics_at(const loci::pose::Pose& pose) override;
  std::optional<loci::pose::EffortChoice> choose(const loci::pose::EffortStatics& statics,
                                                 const std::vector<loci::pose::EffortColumns>& designs) override;
  loci::pose::EffortChoice turned(const loci::pose::EffortStatics& statics,
                                  const std::vector<loci::pose::EffortColumns>& designs,
                                  const loci::pose::EffortChoice& choice) override;
  bool refutes(const loci::pose::Pose& pose) override;

  /// Efforts of a larger size are not chosen, and a pose that asks for them ends the proof.
  void keep_within(double size) { most_ = size; }
  const SignPattern& signs() const { return signs_; }

  /// Where the pattern fails for certain: its rows, and the system that they are of.
  std::optional<EffortExclusion> exclusion;
  const EffortSystem* excluding = nullptr;
  /// A pose that fails whatever the efforts.
  std::optional<core::TaskWitness> unreachable;
  /// What poses ask for that were looked at: sizes below it fail, for certain.
  double needed = 0;
  EffortExclusion below_needed;
  const EffortSystem* needing = nullptr;

 private:
  bool is_refuted_by(const EffortSystem& system, const std::vector<EffortInequality>& rows);

  EffortSystems& systems_;
  SignPattern signs_;
  double most_ = std::numeric_limits<double>::infinity();
};

}  // namespace clearloci
