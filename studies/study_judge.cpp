#include "studies/study_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/model.hpp"
#include "analysis/zones.hpp"
#include "clearloci/zones.hpp"
#include "core/enclosure.hpp"
#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/open_design.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_task.hpp"
#include "mechanism/written_unit.hpp"

namespace clearloci {
namespace {

using core::Figure;
using core::Interval;
using core::Rational;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Figures are proven bounds, this close to the true values, relatively.
constexpr double figure_accuracy = 1e-3;
/// Cells a design may take to be judged, and a figure of it.
constexpr loci::SearchBudget design_budget = {.most_cells = 20'000, .most_cells_in_vain = 4'000};
constexpr loci::SearchBudget figure_budget = {.most_cells = 20'000};

std::vector<mechanism::ParameterRange> ranges_of(const core::Study& study) {
  std::vector<mechanism::ParameterRange> ranges;
  for (const core::StudyParameter& parameter : study.vary)
    ranges.push_back({parameter.name, parameter.lower, parameter.upper});
  return ranges;
}

/// What is required of these tasks ask for themselves.
bool asked_of_tasks(Figure figure) {
  return figure == Figure::margin || figure == Figure::min_force || figure == Figure::pose_error;
}
bool of_zones(Figure figure) { return figure == Figure::zone_area || figure == Figure::largest_circle; }
bool wants_less(Figure figure) { return figure == Figure::effort || figure == Figure::pose_error; }

}  // namespace

StudyProblem::StudyProblem(const Model& model, const core::Study& study) : model_(model), study_(study) {
  const mechanism::Mechanism& current = model_.content().mechanism;
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
          mechanism::in_varied(mechanism::parse_expression(goal.expression, {study_.file}), current, varied_));
  }
  for (const core::StudyRequirement& require : study_.require)
    if (!asked_of_tasks(require.figure)) want(require.figure);
  if (std::find(figures_.begin(), figures_.end(), Figure::pose_error) != figures_.end() &&
      current.space == mechanism::Space::spatial)
    throw core::InputError({study_.file}, "pose_error is proven in the plane, and " + current.file + " is spatial",
                           "choose another figure");
  for (const std::string& text : study_.keep) {
    const mechanism::Keep keep = mechanism::parse_keep(text, {study_.file}, current);
    keep_.push_back(keep);
    keep_in_varied_.push_back({mechanism::in_varied(keep.left, current, varied_),
                               mechanism::in_varied(keep.right, current, varied_), keep.strict});
  }
  for (const core::Task& task : core::required_tasks(study_))
    tasks_.push_back(std::make_unique<DesignTask>(current, ranges_of(study_), task));
}

bool StudyProblem::kept_exactly(const mechanism::Keep& keep, const std::vector<Rational>& values) const {
  std::vector<mechanism::Parameter> parameters = model_.content().mechanism.parameters;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (mechanism::Parameter& parameter : parameters)
      if (parameter.name == varied_[i]) parameter.expression = core::Expression::number(values[i]);
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

core::Interval StudyProblem::goal_over(const core::StudyGoal& goal, const std::vector<ExactRange>& values) const {
  Ranges ranges;
  for (std::size_t i = 0; i < varied_.size(); ++i) ranges[varied_[i]] = range_of(values[i].first, values[i].second);
  return enclosure(goal_expressions_.at(goal.expression), ranges);
}

StudyJudge::StudyJudge(const StudyProblem& problem) : problem_(problem) {
  for (const auto& task : problem.tasks()) {
    judges_.push_back(task->judge());
    const bool sizes = std::any_of(problem.figures().begin(), problem.figures().end(),
                                   [](Figure f) { return f != Figure::margin && !of_zones(f); });
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
    const loci::DesignProof proof = judges_[t]->judge(*box, task.margin(), refuting, design_budget);
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
      design.reason = "not decided within the number of cells for one design";
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

std::optional<Interval> StudyJudge::measured(Figure figure, std::size_t t, const loci::DesignBox& box) {
  const DesignTask& task = *problem_.tasks()[t];
  if (figure == Figure::margin) {
    const core::Point2 lower = task.region().lower(), upper = task.region().upper();
    const mechanism::Mechanism& current = problem_.model().content().mechanism;
    double limit = task.margin();
    for (std::size_t c = 0; c < 2; ++c)
      limit += core::to_double(current.coordinates[c].upper - current.coordinates[c].lower) + upper[c] - lower[c];
    return Interval(judges_[t]->clearance(box, task.margin(), limit, figure_accuracy, figure_budget));
  }
  if (!measures_[t]) return std::nullopt;
  const core::Task& asked = task.task();
  if (figure == Figure::min_force) {
    const std::vector<int> forces = task.forces();
    if (forces.empty()) return std::nullopt;
    const Interval size = measures_[t]->least_size(box, forces, figure_accuracy, figure_budget);
    // The verdict has proven as much.
    const double least = asked.min_force ? core::to_double(*asked.min_force) : 0.0;
    return Interval(std::max(size.lower(), least), std::max(size.upper(), least));
  }
  if (figure == Figure::effort) {
    const std::vector<int> efforts = task.efforts();
    if (efforts.empty()) return std::nullopt;
    return measures_[t]->greatest_size(box, efforts, figure_accuracy, figure_budget);
  }
  if (figure == Figure::pose_error) {
    const Interval size = measures_[t]->greatest_displacement(box, figure_accuracy, figure_budget);
    const double most = asked.pose_error ? core::to_double(*asked.pose_error) : size.upper();
    return Interval(std::min(size.lower(), most), std::min(size.upper(), most));
  }
  return std::nullopt;
}

void StudyJudge::measure(StudyDesign& design, const std::vector<Rational>& values,
                         const std::vector<loci::DesignBox>& boxes) {
  const std::vector<Figure>& figures = problem_.figures();
  at_best_.assign(figures.size(), nan);
  for (std::size_t f = 0; f < figures.size(); ++f) {
    if (of_zones(figures[f])) continue;
    // Of several tasks that of the worst.
    std::optional<Interval> all;
    const bool less = wants_less(figures[f]);
    for (std::size_t t = 0; t < judges_.size(); ++t) {
      const std::optional<Interval> interval = measured(figures[f], t, boxes[t]);
      if (!interval || !all)
        all = interval ? interval : all;
      else
        all = less ? Interval(std::max(all->lower(), interval->lower()), std::max(all->upper(), interval->upper()))
                   : Interval(std::min(all->lower(), interval->lower()), std::min(all->upper(), interval->upper()));
    }
    if (!all) continue;
    design.figures[f] = less ? all->upper() : all->lower();
    at_best_[f] = less ? all->lower() : all->upper();
  }
  if (std::any_of(figures.begin(), figures.end(), of_zones)) measure_zones(design, values);
}

void StudyJudge::measure_zones(StudyDesign& design, const std::vector<Rational>& values) {
  std::vector<Model::Value> settings;
  const mechanism::Mechanism& mechanism = problem_.model().content().mechanism;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& name = problem_.study().vary[i].name;
    settings.emplace_back(
        name, mechanism::value_words(*mechanism::parameter_named(mechanism, name), values[i], mechanism.units));
  }
  double area = 0, circle = 0;
  try {
    const Model model = problem_.model().with(settings);
    // Figures of zones are those over two lengths.
    const core::Zones map = mechanism::is_plane(model.content().mechanism) ? find_zones(model) : core::Zones{};
    for (const core::Zone& zone : map.zones) {
      area = std::max(area, zone.size);
      circle = std::max(circle, zone.ball.radius);
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
  for (const core::StudyRequirement& requirement : problem_.study().require) {
    const auto place = std::find(figures.begin(), figures.end(), requirement.figure);
    if (place == figures.end() || asked_of_tasks(requirement.figure)) continue;
    const auto f = static_cast<std::size_t>(place - figures.begin());
    const double value = design.figures[f], best = std::isnan(at_best_[f]) ? value : at_best_[f];
    const double bound = core::to_double(requirement.bound);
    if (std::isnan(value)) {
      design.status = StudyDesign::Status::undecided;
      design.reason = core::to_string(requirement.figure) + " is not known";
    } else if (wants_less(requirement.figure) ? best > bound : best < bound) {
      design.status = StudyDesign::Status::infeasible;
      design.reason = core::to_string(requirement.figure);
    } else if (wants_less(requirement.figure) ? value > bound : value < bound) {
      design.status = StudyDesign::Status::undecided;
      design.reason = core::to_string(requirement.figure) + " is too near to what is required";
    }
  }
}

}  // namespace clearloci
