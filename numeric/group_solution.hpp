// The unknowns of groups as inputs of the tape (method.md section 14): from a nearby posture
// (mechanism/group_closing.hpp) by Newton's iteration on equations of this folder's own, whose derivatives are
// instructions of the tape.
//     double:   u <- u - J^-1 g
//     Bounded:  u +- r with  |Y g| + |1 - Y J(u +- r)| r < r,  Y = J^-1 to rounding: there is one solution in it
//     (Krawczyk) Series:   u <- u - J_0^-1 g, one order of time a step
// Where a group does not close they are no numbers. Private to numeric/.
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "mechanism/group_closing.hpp"
#include "numeric/model.hpp"

namespace clearloci::numeric {

/// Postures to begin with, remembered for the poses asked for last. Safe to use from many threads.
class GroupStarts {
 public:
  explicit GroupStarts(mechanism::Mechanism mechanism) : mechanism_(std::move(mechanism)) {}

  std::optional<std::vector<double>> at(std::span<const double> pose, std::span<const int> sides);

 private:
  mechanism::Mechanism mechanism_;
  std::mutex mutex_;
  std::map<std::vector<int>, mechanism::GroupClosing> closings_;
  std::map<std::pair<std::vector<int>, std::vector<double>>, std::optional<std::vector<double>>> known_;
};

/// Y with Y A ≈ 1, row after row; empty where A is singular.
std::vector<double> inverse_of(std::vector<double> a, std::size_t n);

/// The unknowns of the block at `u` (improved), from inputs and registers that are known before it.
bool solve_block(const NumericModel& model, const GroupBlock& block, double* inputs, double* registers);
bool solve_block(const NumericModel& model, const GroupBlock& block, Bounded* inputs, Bounded* registers);

/// Of series: any type with value() and arithmetic.
template <class T>
bool solve_block(const NumericModel& model, const GroupBlock& block, T* inputs, T* registers) {
  constexpr int orders = 6;  // more than any series here has
  const std::size_t n = block.unknowns.size();
  std::vector<double> inverse;
  for (int step = 0; step < orders; ++step) {
    run<T, 1>(model.tape, block.begin, block.end, inputs, registers);
    if (inverse.empty()) {
      std::vector<double> jacobian;
      for (const Register register_index : block.jacobian) jacobian.push_back(registers[register_index].value());
      inverse = inverse_of(std::move(jacobian), n);
      if (inverse.empty()) return false;
    }
    for (std::size_t i = 0; i < n; ++i) {
      T move(0.0);
      for (std::size_t j = 0; j < n; ++j) move = move + inverse[i * n + j] * registers[block.equations[j]];
      T& input = inputs[block.first_input + static_cast<int>(i)];
      input = input - move;
    }
  }
  return true;
}

inline double value_of(double x) { return x; }
inline double value_of(const Bounded& x) { return x.value; }
template <class T>
double value_of(const T& x) {
  return x.value();
}

/// Fills the inputs of the unknowns in, behind coordinates and signs. False where the groups do not close.
template <class T>
bool place_groups(const NumericModel& model, std::span<const int> mode, std::vector<T>& inputs) {
  if (model.groups.empty()) return true;
  std::vector<double> pose;
  for (std::size_t c = 0; c < model.box.size(); ++c) pose.push_back(value_of(inputs[c]));
  const auto first = static_cast<std::size_t>(model.groups.front().first_input);
  const auto lost = [&] {
    for (std::size_t i = first; i < inputs.size(); ++i) inputs[i] = T(std::numeric_limits<double>::quiet_NaN());
    return false;
  };
  const auto start = model.group_starts->at(pose, mode);
  if (!start) return lost();
  std::vector<double> nominal = pose;
  nominal.insert(nominal.end(), mode.begin(), mode.end());
  nominal.insert(nominal.end(), start->begin(), start->end());
  std::vector<double> at_pose(static_cast<std::size_t>(model.groups.back().end));
  std::vector<T> registers(at_pose.size());
  int done = 0;
  for (const GroupBlock& block : model.groups) {
    run<double, 1>(model.tape, done, block.begin, nominal.data(), at_pose.data());
    if (!solve_block(model, block, nominal.data(), at_pose.data())) return lost();
    run<double, 1>(model.tape, block.begin, block.end, nominal.data(), at_pose.data());
    for (std::size_t k = 0; k < block.unknowns.size(); ++k) {
      const std::size_t input = static_cast<std::size_t>(block.first_input) + k;
      inputs[input] = T(nominal[input]);
    }
    if constexpr (!std::is_same_v<T, double>) {
      run<T, 1>(model.tape, done, block.begin, inputs.data(), registers.data());
      if (!solve_block(model, block, inputs.data(), registers.data())) return lost();
      run<T, 1>(model.tape, block.begin, block.end, inputs.data(), registers.data());
    }
    done = block.end;
  }
  return true;
}

}  // namespace clearloci::numeric
