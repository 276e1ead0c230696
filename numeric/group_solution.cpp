#include "numeric/group_solution.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace clearloci::numeric {
namespace {

/// Newton's steps that a good start may need.
constexpr int most_steps = 8;
/// Of the unknowns' size: what rounding leaves of a step.
constexpr double rounding = 1e-15;

}  // namespace

std::optional<std::vector<double>> GroupStarts::at(std::span<const double> pose, std::span<const int> sides) {
  constexpr std::size_t most_known = 1 << 14;
  std::pair<std::vector<int>, std::vector<double>> key{{sides.begin(), sides.end()}, {pose.begin(), pose.end()}};
  const std::lock_guard lock(mutex_);
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  auto closing = closings_.find(key.first);
  if (closing == closings_.end())
    closing = closings_.emplace(key.first, mechanism::GroupClosing(mechanism_, key.first)).first;
  std::optional<std::vector<double>> found = closing->second.at(pose);
  if (known_.size() >= most_known) known_.clear();
  known_.emplace(std::move(key), found);
  return found;
}

std::vector<double> inverse_of(std::vector<double> a, std::size_t n) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto size = static_cast<Eigen::Index>(n);
  const Eigen::PartialPivLU<RowMajor> lu(Eigen::Map<RowMajor>(a.data(), size, size));
  const RowMajor inverse = lu.inverse();
  if (!inverse.allFinite()) return {};
  return {inverse.data(), inverse.data() + n * n};
}

bool solve_block(const NumericModel& model, const GroupBlock& block, double* inputs, double* registers) {
  const std::size_t n = block.unknowns.size();
  double before = std::numeric_limits<double>::infinity();
  for (int count = 0; count < most_steps; ++count) {
    run<double, 1>(model.tape, block.begin, block.end, inputs, registers);
    std::vector<double> jacobian;
    for (const Register register_index : block.jacobian) jacobian.push_back(registers[register_index]);
    const std::vector<double> inverse = inverse_of(std::move(jacobian), n);
    if (inverse.empty()) return false;
    double most = 0, size = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double move = 0;
      for (std::size_t j = 0; j < n; ++j) move += inverse[i * n + j] * registers[block.equations[j]];
      double& input = inputs[block.first_input + static_cast<int>(i)];
      input -= move;
      most = std::max(most, std::abs(move));
      size = std::max(size, std::abs(input));
    }
    if (!std::isfinite(most)) return false;
    if (most <= rounding * size || (most < 1e-9 * size && most >= 0.5 * before)) return true;
    before = most;
  }
  return before < 1e-9;
}

bool solve_block(const NumericModel& model, const GroupBlock& block, Bounded* inputs, Bounded* registers) {
  constexpr int tries = 12;
  const std::size_t n = block.unknowns.size();
  run<Bounded, 1>(model.tape, block.begin, block.end, inputs, registers);
  std::vector<double> jacobian;
  for (const Register register_index : block.jacobian) jacobian.push_back(registers[register_index].value);
  const std::vector<double> inverse = inverse_of(std::move(jacobian), n);
  if (inverse.empty()) return false;
  const auto up = [&](double sum) { return sum * (1 + static_cast<double>(4 * n + 8) * unit_roundoff) + 1e-300; };
  std::vector<double> moved(n), radius(n);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const Bounded& g = registers[block.equations[j]];
      sum += std::abs(inverse[i * n + j]) * (std::abs(g.value) + g.error);
    }
    moved[i] = up(sum);
    radius[i] = 1.5 * moved[i];
  }
  const auto input = [&](std::size_t i) -> Bounded& { return inputs[block.first_input + static_cast<int>(i)]; };
  for (int count = 0; count < tries; ++count) {
    for (std::size_t i = 0; i < n; ++i) input(i).error = radius[i];
    run<Bounded, 1>(model.tape, block.begin, block.end, inputs, registers);
    bool inside = true;
    std::vector<double> needed(n);
    for (std::size_t i = 0; i < n; ++i) {
      double sum = moved[i];
      for (std::size_t k = 0; k < n; ++k) {
        // An entry of 1 - Y J: what it is in the middle, with the roundings of that sum, and by how much J varies.
        double middle = i == k ? 1 : 0, size = middle, error = 0;
        for (std::size_t j = 0; j < n; ++j) {
          const Bounded& entry = registers[block.jacobian[j * n + k]];
          const double part = inverse[i * n + j] * entry.value;
          middle -= part;
          size += std::abs(part);
          error += std::abs(inverse[i * n + j]) * entry.error;
        }
        sum += up(std::abs(middle) + error + size * static_cast<double>(n + 4) * unit_roundoff) * radius[k];
      }
      needed[i] = up(sum);
      inside = inside && needed[i] < radius[i];
    }
    if (inside) return true;
    for (std::size_t i = 0; i < n; ++i) {
      if (!std::isfinite(needed[i])) return false;
      radius[i] = std::max(2 * radius[i], 1.5 * needed[i]);
    }
  }
  return false;
}

}  // namespace clearloci::numeric
