#include "report/study_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/rational.hpp"
#include "core/task.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::StudyDesign;
using core::StudyResult;

double volume(const core::StudyCell& cell) {
  double product = 1;
  for (std::size_t i = 0; i < cell.lower.size(); ++i) product *= cell.upper[i] - cell.lower[i];
  return product;
}

std::string number(const core::Rational& value) { return exact_number(core::to_double(value)); }

std::string place(const core::RationalPose& at) { return "(" + number(at[0]) + ", " + number(at[1]) + ")"; }

std::string shape_words(const core::TaskShape& shape) {
  if (const auto* box = std::get_if<core::TaskBox>(&shape))
    return fmt::format("every pose of the box from {} to {} m", place(box->lower), place(box->upper));
  if (const auto* circle = std::get_if<core::TaskBall>(&shape))
    return fmt::format("every pose of the circle of radius {} m about {} m", number(circle->radius),
                       place(circle->centre));
  const bool path = std::holds_alternative<core::TaskPath>(shape);
  const auto& points = path ? std::get<core::TaskPath>(shape).points : std::get<core::TaskPolygon>(shape).corners;
  std::string words = path ? "every pose of the path" : "every pose of the polygon";
  constexpr std::size_t most = 12;
  for (std::size_t i = 0; i < std::min(points.size(), most); ++i) words += (i == 0 ? " " : ", ") + place(points[i]);
  return words + (points.size() > most ? ", ..." : "") + " m";
}

template <class Value>
std::vector<std::pair<std::string, Value>> most_first(const std::map<std::string, Value>& all) {
  std::vector<std::pair<std::string, Value>> list(all.begin(), all.end());
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return list;
}

}  // namespace

std::string unit_of(core::Figure figure) {
  switch (figure) {
    case core::Figure::margin:
    case core::Figure::pose_error:
    case core::Figure::largest_circle:
      return "m";
    case core::Figure::min_force:
      return "N";
    case core::Figure::effort:
      return "N m or N";
    case core::Figure::zone_area:
      return "m^2";
  }
  return {};
}

std::string method_words(const core::StudyMethod& method) {
  using Kind = core::StudyMethod::Kind;
  switch (method.kind) {
    case Kind::grid: {
      std::string words;
      for (const int count : method.counts) words += (words.empty() ? "grid of " : " x ") + std::to_string(count);
      return words;
    }
    case Kind::sample:
      return fmt::format("Sobol sample of {}", method.count);
    case Kind::search:
      return fmt::format("search with {} evaluations", method.count);
    case Kind::prove:
      return "proof down to " + core::to_string(method.finest) + " of each range";
  }
  return {};
}

std::string goal_words(const core::StudyGoal& goal) {
  return std::string(goal.maximise ? "maximise " : "minimise ") +
         (goal.figure ? core::to_string(*goal.figure) : printable(goal.expression));
}

std::string requirement_words(const core::StudyRequirement& requirement) {
  const bool at_most = requirement.figure == core::Figure::effort || requirement.figure == core::Figure::pose_error;
  return fmt::format("{} at {} {} {}", core::to_string(requirement.figure), at_most ? "most" : "least",
                     number(requirement.bound), unit_of(requirement.figure));
}

std::vector<std::string> task_words(const core::Task& task) {
  std::vector<std::string> words = {shape_words(task.shape)};
  if (task.margin > 0) words.push_back(fmt::format("and {} m around it", number(task.margin)));
  if (task.min_force) words.push_back(fmt::format("every joint bears {} N at least", number(*task.min_force)));
  if (task.min_couple) words.push_back(fmt::format("every actuator exerts {} N m at least", number(*task.min_couple)));
  if (task.pose_error)
    words.push_back(fmt::format("the clearances displace the end effector by {} m at most", number(*task.pose_error)));
  if (task.loads)
    words.push_back(
        fmt::format("under every load from {} to {} N", place(task.loads->first), place(task.loads->second)));
  for (const core::LoadWithin& load_range : task.loads_within)
    words.push_back(fmt::format("with load {} off by up to {} N in any direction and {} N m", load_range.load + 1,
                                number(load_range.force), number(load_range.couple)));
  for (const core::Tolerance& tolerance : task.tolerances)
    words.push_back(
        fmt::format("with {} off by {} to {}", tolerance.parameter, number(tolerance.below), number(tolerance.above)));
  return words;
}

std::string meaning_of(const std::string& reason) {
  constexpr std::string_view margin = "margin: ";
  if (reason.starts_with(margin)) return meaning_of(reason.substr(margin.size())) + ", around the task";
  if (reason == "workspace") return "a pose is out of reach, or at its very limit";
  if (reason == "singularity") return "a direct singularity lies in the task: reactions grow without bound there";
  if (reason == "keep") return "left out: a comparison of keep does not hold";
  if (reason == "pose_error") return "the clearances displace the end effector farther than is allowed";
  if (reason.starts_with("contact lost")) return "the pins lose contact at a pose: they cross their clearance";
  if (reason.starts_with("backlash")) return "the actuator's couple or force changes its sign: its play is crossed";
  if (reason.starts_with("min_")) return "it bears less than is required at a pose";
  return {};
}

std::size_t count(const StudyResult& result, StudyDesign::Status status) {
  return static_cast<std::size_t>(std::count_if(result.designs.begin(), result.designs.end(),
                                                [&](const StudyDesign& d) { return d.status == status; }));
}

double share(const StudyResult& result, StudyDesign::Status status) {
  double of_status = 0, all = 0;
  for (const core::StudyCell& cell : result.cells) {
    all += volume(cell);
    if (cell.status == status) of_status += volume(cell);
  }
  return all > 0 ? of_status / all : 0;
}

std::vector<std::pair<std::string, std::size_t>> study_reasons(const StudyResult& result) {
  std::map<std::string, std::size_t> counts;
  for (const StudyDesign& count : result.designs)
    if (count.status != StudyDesign::Status::feasible) ++counts[count.reason];
  return most_first(counts);
}

std::vector<std::pair<std::string, double>> cell_reasons(const StudyResult& result) {
  std::map<std::string, double> parts;
  double all = 0;
  for (const core::StudyCell& cell : result.cells) {
    all += volume(cell);
    if (cell.status != StudyDesign::Status::feasible && cell.status != StudyDesign::Status::undecided)
      parts[cell.reason] += volume(cell);
  }
  for (auto& [reason, part] : parts) part /= all;
  return most_first(parts);
}

std::vector<std::string> edge_words(const core::StudyResult& result) {
  constexpr double at_end = 1e-3;  // of the range: a search ends that near to it
  std::vector<std::string> sentences;
  if (!result.best) return sentences;
  const std::vector<double>& values = result.designs[*result.best].values;
  for (std::size_t i = 0; i < result.study.vary.size() && i < values.size(); ++i) {
    const core::StudyParameter& parameter = result.study.vary[i];
    const double lower = core::to_double(parameter.lower), upper = core::to_double(parameter.upper),
                 near = at_end * (upper - lower);
    const bool low = values[i] <= lower + near;
    if (!low && values[i] < upper - near) continue;
    sentences.push_back(parameter.name + " is at the " + (low ? "lower" : "upper") + " end of its range, " +
                        exact_number(low ? lower : upper) + ": designs beyond it may be better");
  }
  return sentences;
}

}  // namespace clearloci::report
