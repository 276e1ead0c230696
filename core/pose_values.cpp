#include "core/pose_values.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/errors.hpp"

namespace clearloci::inline core {
namespace {

using Operation = PoseProgram::Operation;

/// Newton's steps until they no longer get smaller; more than that lead nowhere.
constexpr int most_steps = 24;
/// Of the unknowns' size: what rounding leaves of a step.
constexpr double rounding = 1e-14;
/// A move of at most this part of the size is one of rounding, where J is nearly singular: it need not get smaller.
constexpr double settled = 1e-9;

}  // namespace

bool solve_dense(std::vector<double>& a, std::span<double> b, int* sign) {
  const std::size_t n = b.size();
  int own_sign = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k])) pivot = i;
    const double value = a[pivot * n + k];
    if (value == 0 || !std::isfinite(value)) return false;
    if (value < 0) own_sign = -own_sign;
    if (pivot != k) {
      own_sign = -own_sign;
      for (std::size_t j = 0; j < n; ++j) std::swap(a[pivot * n + j], a[k * n + j]);
      std::swap(b[pivot], b[k]);
    }
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] / value;
      if (factor == 0) continue;
      for (std::size_t j = k + 1; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) b[i] -= a[i * n + j] * b[j];
    b[i] /= a[i * n + i];
    if (!std::isfinite(b[i])) return false;
  }
  if (sign != nullptr) *sign = own_sign;
  return true;
}

double size_of(const PoseProgram& program, std::span<const double> unknowns) {
  double size = 0;
  for (const PoseProgram::Block& block : program.blocks) size = std::max(size, block.size);
  for (const double unknown : unknowns) size = std::max(size, std::abs(unknown));
  return size;
}

PoseValues::PoseValues(const PoseProgram& program) : program_(program), registers_(program.steps.size(), 0.0) {
  for (std::size_t i = 0; i < registers_.size(); ++i) {
    const PoseProgram::Step& step = program.steps[i];
    if (step.operation == Operation::constant) registers_[i] = to_double(step.value);
    if (step.operation == Operation::pi) registers_[i] = std::numbers::pi;
  }
}

bool PoseValues::run_steps(std::size_t from, std::size_t to, std::span<const double> pose) {
  for (std::size_t i = from; i < to; ++i) {
    const PoseProgram::Step& step = program_.steps[i];
    const double x = registers_[static_cast<std::size_t>(step.first)],
                 y = registers_[static_cast<std::size_t>(step.second)];
    double& result = registers_[i];
    switch (step.operation) {
      case Operation::constant:
      case Operation::pi:
      case Operation::unknown:
        break;
      case Operation::coordinate:
        result = pose[static_cast<std::size_t>(step.first)];
        break;
      case Operation::add:
        result = x + y;
        break;
      case Operation::subtract:
        result = x - y;
        break;
      case Operation::multiply:
        result = x * y;
        break;
      case Operation::square:
        result = x * x;
        break;
      case Operation::inverse:
        if (x == 0) return false;
        result = 1 / x;
        break;
      case Operation::square_root:
        if (!(x > 0)) return false;
        result = std::sqrt(x);
        break;
      case Operation::cosine:
        result = std::cos(x);
        break;
      case Operation::sine:
        result = std::sin(x);
        break;
      case Operation::angle:
        result = std::atan2(x, y);
        if (!(std::abs(result) < std::numbers::pi)) return false;
        break;
    }
  }
  return true;
}

bool PoseValues::close(std::size_t block, std::span<const double> pose, std::span<double> unknowns) {
  const PoseProgram::Block& block_data = program_.blocks[block];
  const std::size_t n = unknowns.size();
  std::vector<double> matrix(n * n), step(n);
  double size = 1e-300, before = 0, first = 0;
  for (int count = 0; count < most_steps; ++count) {
    for (std::size_t k = 0; k < n; ++k) registers_[static_cast<std::size_t>(block_data.unknowns[k])] = unknowns[k];
    if (!run_steps(static_cast<std::size_t>(block_data.begin), static_cast<std::size_t>(block_data.end), pose))
      return false;
    for (std::size_t i = 0; i < n * n; ++i) matrix[i] = (*this)[block_data.jacobian[i]];
    for (std::size_t i = 0; i < n; ++i) step[i] = (*this)[block_data.equations[i]];
    int sign = 1;
    if (!solve_dense(matrix, step, &sign)) return false;
    double most = 0;
    for (std::size_t k = 0; k < n; ++k) {
      unknowns[k] -= step[k];
      most = std::max(most, std::abs(step[k]));
      size = std::max(size, std::abs(unknowns[k]));
    }
    if (count == 0) first = most;
    if (count == 1 && before > settled * size) contraction_ = std::max(contraction_, most / before);
    if (most <= rounding * size || (count > 2 && most < settled * size && most >= 0.5 * before)) {
      moved_ = std::max(moved_, first);
      orientation_ *= sign;
      for (std::size_t k = 0; k < n; ++k) registers_[static_cast<std::size_t>(block_data.unknowns[k])] = unknowns[k];
      return run_steps(static_cast<std::size_t>(block_data.begin), static_cast<std::size_t>(block_data.end), pose);
    }
    before = most;
  }
  return false;
}

bool PoseValues::close(std::span<const double> pose, BlockUnknowns& unknowns) {
  orientation_ = 1;
  moved_ = contraction_ = 0;
  std::size_t done = 0, first = 0;
  for (std::size_t b = 0; b < program_.blocks.size(); ++b) {
    const PoseProgram::Block& block_data = program_.blocks[b];
    if (!run_steps(done, static_cast<std::size_t>(block_data.begin), pose)) return false;
    if (!close(b, pose, {unknowns.data() + first, block_data.unknowns.size()})) return false;
    done = static_cast<std::size_t>(block_data.end);
    first += block_data.unknowns.size();
  }
  return run_steps(done, registers_.size(), pose);
}

bool PoseValues::put(std::span<const double> pose, const BlockUnknowns& unknowns) {
  std::size_t k = 0;
  for (const PoseProgram::Block& block : program_.blocks)
    for (const int step : block.unknowns) registers_[static_cast<std::size_t>(step)] = unknowns[k++];
  return run_steps(0, registers_.size(), pose);
}

bool PoseValues::run(std::span<const double> pose, const BlockStart& start) {
  if (program_.blocks.empty()) return run_steps(0, registers_.size(), pose);
  std::optional<BlockUnknowns> unknowns = start ? start(pose) : followed(pose);
  return unknowns && close(pose, *unknowns);
}

/// Steps along the way are halved until Newton's iteration converges quickly from the values that go on as before, and
/// det J keeps its sign.
std::optional<BlockUnknowns> PoseValues::followed(std::span<const double> from, BlockUnknowns unknowns,
                                                  std::span<const double> to) {
  constexpr double largest = 0.125, smallest = 1e-12, quick = 0.1, far = 0.1;
  if (!close(from, unknowns)) return std::nullopt;
  const int sign = orientation_;
  double size = 0;
  for (const double unknown : unknowns) size = std::max(size, std::abs(unknown));
  BlockUnknowns rates(unknowns.size(), 0.0), next;
  std::vector<double> pose(to.size());
  double at = 0, step = largest;
  while (at < 1) {
    step = std::min(step, 1 - at);
    const double ahead = step == 1 - at ? 1 : at + step;
    for (std::size_t c = 0; c < to.size(); ++c) pose[c] = ahead == 1 ? to[c] : from[c] + ahead * (to[c] - from[c]);
    next = unknowns;
    for (std::size_t k = 0; k < next.size(); ++k) next[k] += step * rates[k];
    if (close(pose, next) && orientation_ == sign && contraction_ < quick && moved_ < far * size) {
      for (std::size_t k = 0; k < next.size(); ++k) rates[k] = (next[k] - unknowns[k]) / step;
      unknowns = next;
      at = ahead;
      step = std::min(2 * step, largest);
    } else if ((step /= 2) < smallest) {
      return std::nullopt;
    }
  }
  return unknowns;
}

/// The same from the posture a turn before or behind: of an angle that is the same posture, of a length it is none.
std::optional<BlockUnknowns> PoseValues::followed_round(BlockUnknowns near, std::span<const double> pose) {
  constexpr double turn = 2 * std::numbers::pi, same = 1e-9;
  if (!close(program_.near, near)) return std::nullopt;
  for (std::size_t c = 0; c < pose.size(); ++c)
    for (const double by : {-turn, turn}) {
      std::vector<double> from = program_.near;
      from[c] += by;
      BlockUnknowns unknowns = near;
      if (!close(from, unknowns) || !(moved_ <= same * size_of(program_, near))) continue;
      if (auto found = followed(from, near, pose)) return found;
    }
  return std::nullopt;
}

std::optional<BlockUnknowns> PoseValues::followed(std::span<const double> pose) {
  BlockUnknowns near;
  for (const PoseProgram::Block& block : program_.blocks) near.insert(near.end(), block.near.begin(), block.near.end());
  if (auto found = followed(program_.near, near, pose)) return found;
  if (auto found = followed_round(near, pose)) return found;
  if (pose.size() < 2) return std::nullopt;
  for (const bool backwards : {false, true}) {
    std::vector<double> at = program_.near;
    std::optional<BlockUnknowns> unknowns = near;
    for (std::size_t i = 0; i < pose.size() && unknowns; ++i) {
      const std::size_t c = backwards ? pose.size() - 1 - i : i;
      std::vector<double> next = at;
      next[c] = pose[c];
      unknowns = followed(at, *unknowns, next);
      at = next;
    }
    if (unknowns) return unknowns;
  }
  return std::nullopt;
}

}  // namespace clearloci::inline core
