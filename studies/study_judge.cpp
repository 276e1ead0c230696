#include "studies/study_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/enclosure.hpp"
#include "analysis/model.hpp"
#include "analysis/zones.hpp"
#include "clearloci/zones.hpp"
#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/read.hpp"

namespace clearloci {
namespace {

using core::Figure;
using core::Rational;
using loci::sheet::Interval;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Figures are proven bounds, this close to the true values, relatively.
constexpr double figure_accuracy = 1e-3;
/// Cells a design may take to be judged, and a figure of it.
constexpr loci::DesignEffort design_effort = {.most_cells = 20'000, .most_cells_in_vain = 4'000};
constexpr loci::DesignEffort figure_effort = {.most_cells = 20'000};

std::vector<mechanism::ParameterRange> ranges_of(const core::Study& study) {
  std::vector<mechanism::ParameterRange> ranges;
  for (const core::StudyParameter& own : study.vary) ranges.push_back({own.name, own.lower, own.upper});
  return ranges;
}

/// What is required of a figure that tasks ask for themselves is asked of them.
core::Task with_requirements(core::Task task, const core::Study& study) {
  for (const core::StudyRequirement& own : study.require) {
    if (own.figure == Figure::margin) task.margin = std::max(task.margin, own.bound);
    if (own.figure == Figure::min_force && own.bound > 0)
      task.min_force = std::max(task.min_force.value_or(0), own.bound);
  }
  return task;
}

bool of_zones(Figure figure) { return figure == Figure::zone_area || figure == Figure::largest_circle; }
bool wants_less(Figure figure) { return figure == Figure::effort || figure == Figure::pose_error; }

}  // namespace

StudyProblem::StudyProblem(const Model& model, const core::Study& study) : model_(model), study_(study) {
  const mechanism::Mechanism& own = model_.content().mechanism;
  for (const core::StudyParameter& parameter : study_.vary) varied_.push_back(parameter.name);
  const auto want = [&](Figure figure) {
    if (std::find(figures_.begin(), figures_.end(), figure) == figures_.end()) figures_.push_back(figure);
  };
  for (const core::StudyGoal& goal : study_.goals) {
    if (goal.figure)
      want(*goal.figure);
    else
      goal_expressions_.try_emplace(
          goal.expression,
          mechanism::in_varied(mechanism::parse_expression(goal.expression, {study_.file}), own, varied_));
  }
  for (const core::StudyRequirement& require : study_.require)
    if (require.figure != Figure::margin && require.figure != Figure::min_force) want(require.figure);
  for (const Figure figure : figures_) {
    if (figure == Figure::pose_error)
      throw core::InputError({study_.file}, "pose_error is not measured over a task yet", "choose another figure");
    const bool size = figure == Figure::min_force || figure == Figure::effort;
    if (size &&
        std::any_of(study_.tasks.begin(), study_.tasks.end(), [](const auto& t) { return !t.loads_within.empty(); }))
      throw core::InputError({study_.file}, core::to_string(figure) + " is not measured under loads_within",
                             "choose margin, or require min_force without making it a goal");
  }
  for (const std::string& text : study_.keep) {
    const mechanism::Keep keep = mechanism::parse_keep(text, {study_.file});
    keep_.push_back(keep);
    keep_in_varied_.push_back(
        {mechanism::in_varied(keep.left, own, varied_), mechanism::in_varied(keep.right, own, varied_), keep.strict});
  }
  for (const core::Task& task : study_.tasks)
    tasks_.push_back(std::make_unique<DesignTask>(own, ranges_of(study_), with_requirements(task, study_)));
}

bool StudyProblem::kept_exactly(const mechanism::Keep& keep, const std::vector<Rational>& values) const {
  std::vector<mechanism::Parameter> parameters = model_.content().mechanism.parameters;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (mechanism::Parameter& own : parameters)
      if (own.name == varied_[i]) own.expression = core::Expression::number(values[i]);
  const Rational left = mechanism::evaluate(keep.left, parameters).value;
  const Rational right = mechanism::evaluate(keep.right, parameters).value;
  return keep.strict ? left > right : left >= right;
}

StudyProblem::Kept StudyProblem::kept(const std::vector<ExactRange>& values) const {
  if (keep_.empty()) return Kept::all;
  Ranges ranges;
  bool single = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    ranges[varied_[i]] = range_of(values[i].first, values[i].second);
    single = single && values[i].first == values[i].second;
  }
  bool all = true;
  for (std::size_t i = 0; i < keep_.size(); ++i) {
    const mechanism::Keep& keep = keep_in_varied_[i];
    const Interval gap = enclosure(keep.left, ranges) - enclosure(keep.right, ranges);
    if (gap.lower() > 0) continue;
    if (gap.upper() < 0) return Kept::none;
    if (!single) {
      all = false;
      continue;
    }
    std::vector<Rational> exact;
    for (const ExactRange& range : values) exact.push_back(range.first);
    try {
      if (!kept_exactly(keep_[i], exact)) return Kept::none;
    } catch (const std::domain_error&) {  // a division by zero there
      return Kept::none;
    }
  }
  return all ? Kept::all : Kept::unknown;
}

double StudyProblem::goal(const core::StudyGoal& goal, const StudyDesign& design) const {
  if (goal.figure) {
    const auto place = std::find(figures_.begin(), figures_.end(), *goal.figure) - figures_.begin();
    return design.figures.empty() ? nan : design.figures[static_cast<std::size_t>(place)];
  }
  Ranges ranges;
  for (std::size_t i = 0; i < varied_.size(); ++i) ranges[varied_[i]] = Interval(design.values[i]);
  return enclosure(goal_expressions_.at(goal.expression), ranges).middle();
}

StudyJudge::StudyJudge(const StudyProblem& problem) : problem_(problem) {
  for (const auto& task : problem.tasks()) {
    judges_.push_back(task->judge());
    const bool sizes = std::any_of(problem.figures().begin(), problem.figures().end(),
                                   [](Figure f) { return f == Figure::min_force || f == Figure::effort; });
    measures_.push_back(sizes ? task->measure() : nullptr);
  }
}

StudyDesign StudyJudge::judge(std::uint64_t index, const std::vector<Rational>& values) {
  StudyDesign design;
  design.index = index;
  std::vector<ExactRange> ranges;
  for (const Rational& value : values) {
    design.values.push_back(core::to_double(value));
    ranges.emplace_back(value, value);
  }
  design.figures.assign(problem_.figures().size(), nan);
  if (problem_.kept(ranges) == StudyProblem::Kept::none) {
    design.status = StudyDesign::Status::left_out;
    design.reason = "keep";
    return design;
  }
  std::vector<loci::DesignBox> boxes;
  bool open = false;
  for (std::size_t t = 0; t < judges_.size(); ++t) {
    const DesignTask& task = *problem_.tasks()[t];
    auto box = task.box(ranges);
    if (!box) {
      design.status = StudyDesign::Status::infeasible;
      design.reason = "a length is not above zero";
      design.task = t;
      return design;
    }
    // Without tolerances the box is but the rounding of one design's numbers: what refutes it refutes all of it.
    const auto refuting = task.task().tolerances.empty() ? loci::Refuting::all : loci::Refuting::one;
    const loci::DesignProof proof = judges_[t]->judge(*box, task.margin(), refuting, design_effort);
    if (proof.verdict == core::Verdict::refuted) {
      design.status = StudyDesign::Status::infeasible;
      design.reason = task.reason(*proof.failure);
      design.task = t;
      design.at = proof.failure->at;
      return design;
    }
    if (proof.verdict == core::Verdict::undecided && !open) {
      open = true;
      design.status = StudyDesign::Status::undecided;
      design.reason = "not decided with the cells that a design may take";
      design.task = t;
      design.at = core::Point2{(proof.lower[0] + proof.upper[0]) / 2, (proof.lower[1] + proof.upper[1]) / 2};
    }
    boxes.push_back(std::move(*box));
  }
  if (open) return design;
  design.status = StudyDesign::Status::feasible;
  measure(design, values, boxes);
  require(design);
  return design;
}

double StudyJudge::violation(const std::vector<Rational>& values) {
  std::vector<ExactRange> ranges;
  for (const Rational& value : values) ranges.emplace_back(value, value);
  if (problem_.kept(ranges) == StudyProblem::Kept::none) return 1;
  double sum = 0;
  for (std::size_t t = 0; t < judges_.size(); ++t) {
    const auto box = problem_.tasks()[t]->box(ranges);
    sum += box ? judges_[t]->violation(*box) : 1;
  }
  return sum / static_cast<double>(judges_.size());
}

double StudyJudge::measured(Figure figure, std::size_t t, const loci::DesignBox& box) {
  const DesignTask& task = *problem_.tasks()[t];
  if (figure == Figure::margin) {
    const core::Point2 lower = task.region().lower(), upper = task.region().upper();
    const mechanism::Mechanism& own = problem_.model().content().mechanism;
    double limit = task.margin();
    for (std::size_t c = 0; c < 2; ++c)
      limit += core::to_double(own.coordinates[c].upper - own.coordinates[c].lower) + upper[c] - lower[c];
    return judges_[t]->clearance(box, task.margin(), limit, figure_accuracy, figure_effort);
  }
  if (!measures_[t]) return nan;
  if (figure == Figure::min_force) {
    const std::vector<int> forces = task.forces();
    return forces.empty() ? nan : measures_[t]->least_size(box, forces, figure_accuracy, figure_effort).lower();
  }
  if (figure == Figure::effort) {
    const std::vector<int> efforts = task.efforts();
    return efforts.empty() ? nan : measures_[t]->greatest_size(box, efforts, figure_accuracy, figure_effort).upper();
  }
  return nan;
}

void StudyJudge::measure(StudyDesign& design, const std::vector<Rational>& values,
                         const std::vector<loci::DesignBox>& boxes) {
  const std::vector<Figure>& figures = problem_.figures();
  for (std::size_t f = 0; f < figures.size(); ++f) {
    if (of_zones(figures[f])) continue;
    double worst = nan;
    for (std::size_t t = 0; t < judges_.size(); ++t) {
      const double own = measured(figures[f], t, boxes[t]);
      if (std::isnan(worst) || (wants_less(figures[f]) ? own > worst : own < worst)) worst = own;
    }
    design.figures[f] = worst;
  }
  if (std::any_of(figures.begin(), figures.end(), of_zones)) measure_zones(design, values);
}

void StudyJudge::measure_zones(StudyDesign& design, const std::vector<Rational>& values) {
  std::vector<Model::Value> own;
  for (std::size_t i = 0; i < values.size(); ++i)
    own.emplace_back(problem_.study().vary[i].name, core::to_string(values[i]));
  double area = 0, circle = 0;
  try {
    const core::ZoneMap map = find_zones(problem_.model().with(own));
    for (const core::Zone& zone : map.zones) {
      area = std::max(area, zone.area);
      circle = std::max(circle, zone.inscribed.radius);
    }
  } catch (const core::InputError&) {  // singular everywhere, or not to be built: it has no zone
  }
  const std::vector<Figure>& figures = problem_.figures();
  for (std::size_t f = 0; f < figures.size(); ++f) {
    if (figures[f] == Figure::zone_area) design.figures[f] = area;
    if (figures[f] == Figure::largest_circle) design.figures[f] = circle;
  }
}

void StudyJudge::require(StudyDesign& design) const {
  const std::vector<Figure>& figures = problem_.figures();
  for (const core::StudyRequirement& own : problem_.study().require) {
    const auto place = std::find(figures.begin(), figures.end(), own.figure);
    if (place == figures.end()) continue;  // the tasks ask for it
    const double value = design.figures[static_cast<std::size_t>(place - figures.begin())];
    const double bound = core::to_double(own.bound);
    if (std::isnan(value)) {
      design.status = StudyDesign::Status::undecided;
      design.reason = core::to_string(own.figure) + " is not known";
    } else if (wants_less(own.figure) ? value > bound : value < bound) {
      design.status = StudyDesign::Status::infeasible;
      design.reason = core::to_string(own.figure);
    }
  }
}

}  // namespace clearloci
