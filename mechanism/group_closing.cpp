#include "mechanism/group_closing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pose_values.hpp"
#include "mechanism/dependence.hpp"
#include "mechanism/pose_steps.hpp"
#include "mechanism/posture_sample.hpp"

namespace clearloci::mechanism {

struct GroupClosing::Program {
  core::PoseProgram program;
  std::size_t unknowns = 0;
  std::vector<int> wanted;  ///< the lengths of the last group's distances
  std::optional<core::PoseValues> values;
};

GroupClosing::GroupClosing(GroupClosing&&) noexcept = default;
GroupClosing& GroupClosing::operator=(GroupClosing&&) noexcept = default;
GroupClosing::~GroupClosing() = default;

GroupClosing::GroupClosing(const Mechanism& mechanism, const std::vector<int>& sides)
    : program_(std::make_unique<Program>()) {
  if (mechanism.groups.empty()) return;
  PosePoints points(mechanism, sides, PoseSteps(mechanism));
  for (const Group::Distance& step : mechanism.groups.back().distances)
    program_->wanted.push_back(points.expression(step.length));
  std::vector<int*> results;
  for (int& step : program_->wanted) results.push_back(&step);
  program_->program = program_of(mechanism, points.algebra().builder(), results);
  program_->unknowns = group_unknowns(mechanism);
  program_->values.emplace(program_->program);
}

std::optional<std::vector<double>> GroupClosing::at(std::span<const double> pose) {
  if (!program_->values) return std::vector<double>{};
  return program_->values->followed(pose);
}

std::optional<std::vector<double>> GroupClosing::lengths(std::span<const double> pose) {
  core::PoseValues& values = *program_->values;
  (void)values.put(pose, std::vector<double>(program_->unknowns, 1.0));
  std::vector<double> lengths;
  for (const int step : program_->wanted) lengths.push_back(std::abs(values[step]));
  return lengths;
}

GroupClosing::Posture GroupClosing::posture() {
  Posture result;
  core::PoseValues& values = *program_->values;
  const core::PoseProgram& program = program_->program;
  std::vector<double> near;
  for (const core::PoseProgram::Block& block : program.blocks)
    near.insert(near.end(), block.near.begin(), block.near.end());
  if (!values.put(program.near, near)) return result;
  result.built = true;
  const std::vector<int>& equations = program.blocks.back().equations;
  for (std::size_t i = 0; i < program_->wanted.size(); ++i) {
    const double wanted = values[program_->wanted[i]];
    result.wanted.push_back(wanted);
    result.lengths.push_back(std::sqrt(std::max(0.0, values[equations[i]] + wanted * wanted)));
  }
  std::vector<double> closed = near;
  if (values.close(program.near, closed)) {
    for (std::size_t k = 0; k < near.size(); ++k) result.moved = std::max(result.moved, std::abs(closed[k] - near[k]));
    result.closed = closed;
  } else if (!values.put(program.near, near)) {
    return result;
  }
  // Rows of J in the size of the points.
  double size = 0;
  for (const double length : result.wanted) size = std::max(size, std::abs(length));
  const core::PoseProgram::Block& last = program.blocks.back();
  const std::size_t n = last.unknowns.size();
  Matrix by_unknown(n, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      by_unknown[k][i] = values[last.jacobian[i * n + k]] / (i < result.wanted.size() && size > 0 ? size : 1);
  const Dependence dependence = dependence_of(by_unknown);
  if (dependence.rank < n) result.dependent.assign(dependence.columns.begin(), dependence.columns.end());
  return result;
}

core::PoseProgram group_program(const Mechanism& mechanism, const std::vector<int>& sides) {
  PosePoints points(mechanism, sides, PoseSteps(mechanism));
  return program_of(mechanism, points.algebra().builder(), {});
}

std::optional<std::vector<std::array<double, 2>>> group_reach(const Mechanism& mechanism,
                                                              const std::vector<double>& pose,
                                                              const std::vector<int>& sides) {
  const Group& group = mechanism.groups.back();
  // Those before the group have their places, whatever it does.
  Mechanism before = mechanism;
  before.groups.pop_back();
  before.points.resize(static_cast<std::size_t>(group.first));
  const auto sampled = sample_points(before, pose, sides);
  GroupClosing closing(mechanism, sides);
  const std::optional<std::vector<double>> lengths = closing.lengths(pose);
  if (!lengths) return std::nullopt;
  const std::size_t count = static_cast<std::size_t>(group.last - group.first) + 1;
  std::vector<std::array<double, 2>> box;
  const double far = std::numeric_limits<double>::infinity();
  // From every known point the shortest ways along lengths; what has no length of its own has no bound.
  std::vector<std::vector<double>> low(count, std::vector<double>(3, -far)), high(count, std::vector<double>(3, far));
  const auto narrow = [&](PointIndex to, PointIndex from, double length) {
    const auto t = static_cast<std::size_t>(to - group.first);
    bool changed = false;
    for (std::size_t c = 0; c < dimension(mechanism); ++c) {
      double a, b;
      if (from >= group.first && from <= group.last) {
        a = low[static_cast<std::size_t>(from - group.first)][c];
        b = high[static_cast<std::size_t>(from - group.first)][c];
      } else {
        const auto& at = sampled[static_cast<std::size_t>(from)];
        if (!at) return false;
        a = b = (*at)[c];
      }
      const double slack = 1e-9 * (length + std::abs(a) + std::abs(b));
      if (std::isfinite(a) && a - length - slack > low[t][c] + slack) low[t][c] = a - length - slack, changed = true;
      if (std::isfinite(b) && b + length + slack < high[t][c] - slack) high[t][c] = b + length + slack, changed = true;
    }
    return changed;
  };
  bool again = true;
  for (int round = 0; again && round < 64; ++round) {
    again = false;
    for (std::size_t i = 0; i < group.distances.size(); ++i) {
      const Group::Distance& distance = group.distances[i];
      for (const auto& [to, from] :
           {std::pair(distance.first, distance.second), std::pair(distance.second, distance.first)})
        if (to >= group.first && to <= group.last) again = narrow(to, from, (*lengths)[i]) || again;
    }
  }
  for (std::size_t k = 0; k < group.count; ++k)
    for (std::size_t c = 0; c < dimension(mechanism); ++c) {
      if (!std::isfinite(low[k][c]) || !std::isfinite(high[k][c])) return std::nullopt;
      box.push_back({low[k][c], high[k][c]});
    }
  return box;
}

Mechanism up_to_group(Mechanism mechanism, std::size_t group) {
  const PointIndex last = mechanism.groups.at(group).last;
  mechanism.groups.resize(group + 1);
  mechanism.points.resize(static_cast<std::size_t>(last) + 1);
  return mechanism;
}

std::size_t group_unknowns(const Mechanism& mechanism) {
  std::size_t count = 0;
  for (const Group& group : mechanism.groups) count += group.count * dimension(mechanism);
  return count;
}

namespace {

/// No coordinate, parameter or point is called so.
std::string free_name(const Mechanism& mechanism, std::string name) {
  const auto is_taken = [&](const auto& list) {
    return std::any_of(list.begin(), list.end(), [&](const auto& candidate) { return candidate.name == name; });
  };
  while (is_taken(mechanism.coordinates) || is_taken(mechanism.parameters)) name += "_";
  return name;
}

}  // namespace

Mechanism with_open_groups(Mechanism mechanism) {
  constexpr std::array<char, 3> axes = {'x', 'y', 'z'};
  for (const Group& group : mechanism.groups)
    for (std::size_t k = 0; k < group.count; ++k) {
      Point& point = mechanism.points[static_cast<std::size_t>(group.first) + k];
      ExplicitPoint form;
      for (std::size_t c = 0; c < dimension(mechanism); ++c) {
        Coordinate coordinate;
        coordinate.name = free_name(mechanism, axes[c] + point.name);
        coordinate.lower = group.near[k][c] - 1;
        coordinate.upper = group.near[k][c] + 1;
        coordinate.lower_expression = Expression::number(coordinate.lower);
        coordinate.upper_expression = Expression::number(coordinate.upper);
        form.coordinates.push_back(Expression::symbol(coordinate.name));
        mechanism.coordinates.push_back(std::move(coordinate));
      }
      point.form = std::move(form);
    }
  mechanism.groups.clear();
  return mechanism;
}

void require_closed_forms(const Mechanism& mechanism, const std::string& what, const std::string& mend) {
  if (mechanism.groups.empty()) return;
  const Group& group = mechanism.groups.front();
  throw core::InputError({mechanism.file, group.where.line, group.where.column},
                         what + " from closed forms, and the points of group " + group.name + " close together", mend);
}

}  // namespace clearloci::mechanism
