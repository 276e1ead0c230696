// One design of a study: verdict and figures. Private to studies/.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/design_task.hpp"
#include "clearloci/study.hpp"
#include "mechanism/read_study.hpp"

namespace clearloci {

/// What all designs of a study share: the equations with the parameters left open, derived once.
class StudyProblem {
 public:
  /// Throws core::InputError where the study asks for what the mechanism has not.
  StudyProblem(const Model& model, const core::Study& study);

  const Model& model() const { return model_; }
  const core::Study& study() const { return study_; }
  const std::vector<core::Figure>& figures() const { return figures_; }
  const std::vector<std::unique_ptr<DesignTask>>& tasks() const { return tasks_; }
  /// Whether `keep` holds of a design; of none of some designs, of all, or it is not known.
  enum class Kept { none, all, unknown };
  Kept kept(const std::vector<ExactRange>& values) const;
  /// The value of a goal for a design: a figure or an expression.
  double goal(const core::StudyGoal& goal, const core::StudyDesign& design) const;
  /// The values that an expression takes over some designs.
  core::Interval goal_over(const core::StudyGoal& goal, const std::vector<ExactRange>& values) const;

 private:
  bool kept_exactly(const mechanism::Keep& keep, const std::vector<core::Rational>& values) const;

  Model model_;
  core::Study study_;
  std::vector<std::string> varied_;
  std::vector<core::Figure> figures_;
  std::vector<mechanism::Keep> keep_;
  std::vector<mechanism::Keep> keep_in_varied_;
  std::map<std::string, core::Expression> goal_expressions_;  ///< in what varies, by their texts
  std::vector<std::unique_ptr<DesignTask>> tasks_;
};

/// One a thread.
class StudyJudge {
 public:
  explicit StudyJudge(const StudyProblem& problem);

  core::StudyDesign judge(std::uint64_t index, const std::vector<core::Rational>& values);

  /// Of a design that is not feasible: how much of the tasks it fails, 0 to 1; 1 where it is left out. By samples, for
  /// a search to be led by.
  double violation(const std::vector<core::Rational>& values);

 private:
  void measure(core::StudyDesign& design, const std::vector<core::Rational>& values,
               const std::vector<loci::DesignBox>& boxes);
  /// Where the figure lies; nothing where it is not known.
  std::optional<core::Interval> measured(core::Figure figure, std::size_t task, const loci::DesignBox& box);
  void measure_zones(core::StudyDesign& design, const std::vector<core::Rational>& values);
  void require(core::StudyDesign& design) const;

  const StudyProblem& problem_;
  std::vector<std::unique_ptr<loci::DesignJudge>> judges_, measures_;
  std::vector<double> at_best_;  ///< what each figure of the design last measured is at best; the figure is at worst
};

}  // namespace clearloci
