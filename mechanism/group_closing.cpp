#include "mechanism/group_closing.hpp"

#include <algorithm>
#include <cmath>

#include "core/pose_values.hpp"
#include "mechanism/dependence.hpp"
#include "mechanism/pose_steps.hpp"

namespace clearloci::mechanism {

struct GroupClosing::Program {
  core::PoseProgram program;
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
  for (const Group::Distance& own : mechanism.groups.back().distances)
    program_->wanted.push_back(points.expression(own.length));
  std::vector<int*> results;
  for (int& own : program_->wanted) results.push_back(&own);
  program_->program = program_of(mechanism, points.algebra().builder(), results);
  program_->values.emplace(program_->program);
}

std::optional<std::vector<double>> GroupClosing::at(std::span<const double> pose) {
  if (!program_->values) return std::vector<double>{};
  return program_->values->followed(pose);
}

GroupClosing::Posture GroupClosing::posture() {
  Posture result;
  core::PoseValues& values = *program_->values;
  const core::PoseProgram& program = program_->program;
  std::vector<double> near;
  for (const core::PoseProgram::Block& own : program.blocks) near.insert(near.end(), own.near.begin(), own.near.end());
  if (!values.put(program.near, near)) return result;
  const std::vector<int>& equations = program.blocks.back().equations;
  for (std::size_t i = 0; i < program_->wanted.size(); ++i) {
    const double wanted = std::abs(values[program_->wanted[i]]);
    result.wanted.push_back(wanted);
    result.lengths.push_back(std::sqrt(std::max(0.0, values[equations[i]] + wanted * wanted)));
  }
  std::vector<double> closed = near;
  if (!values.close(program.near, closed)) return result;
  for (std::size_t k = 0; k < near.size(); ++k) result.moved = std::max(result.moved, std::abs(closed[k] - near[k]));
  result.closed = closed;
  // Rows of J in the size of the points.
  double size = 0;
  for (const double own : result.wanted) size = std::max(size, own);
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

std::size_t group_unknowns(const Mechanism& mechanism) {
  std::size_t count = 0;
  for (const Group& own : mechanism.groups) count += own.count * dimension(mechanism);
  return count;
}

void require_closed_forms(const Mechanism& mechanism, const std::string& what, const std::string& mend) {
  if (mechanism.groups.empty()) return;
  const Group& group = mechanism.groups.front();
  throw core::InputError({mechanism.file, group.where.line, group.where.column},
                         what + " from closed forms, and the points of group " + group.name + " close together", mend);
}

}  // namespace clearloci::mechanism
