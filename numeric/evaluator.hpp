// The compiled equations at `Lanes` poses at once: scratch that lives as long as a call. T: double or Bounded.
// Private to numeric/.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/errors.hpp"
#include "numeric/group_solution.hpp"
#include "numeric/model.hpp"

namespace clearloci::numeric {

template <class T, int Lanes>
class Evaluator {
 public:
  /// `instructions`: how much of the tape is run.
  Evaluator(const NumericModel& model, std::span<const int> mode, int instructions)
      : model_(model),
        instructions_(instructions),
        inputs_(static_cast<std::size_t>(model.inputs()) * Lanes),
        registers_(static_cast<std::size_t>(instructions) * Lanes) {
    core::ensure(mode.size() == model.dyads.size(), "a working mode has one sign for each dyad");
    for (std::size_t i = 0; i < mode.size(); ++i) {
      std::fill_n(inputs_.begin() + static_cast<std::ptrdiff_t>((model.box.size() + i) * Lanes), Lanes, T(mode[i]));
    }
  }

  T& input(std::size_t coordinate, int lane) { return inputs_[coordinate * Lanes + static_cast<std::size_t>(lane)]; }

  void run_tape() {
    if (!model_.groups.empty()) place_unknowns();
    run<T, Lanes>(model_.tape, 0, instructions_, inputs_.data(), registers_.data());
  }

  /// All points finite. Only after run_tape().
  bool reachable(int lane) const {
    double witness = 0;  // stays 0 unless something is infinite or NaN
    for (const Register r : model_.placed) witness += 0 * nominal(*at(r, lane));
    return witness == 0;
  }

  const T& value(Register r, int lane) const { return *at(r, lane); }

  /// N_k = w_k |A| of every unknown, then |A|: Lanes values each. Only after run_tape().
  void solve(const Elimination& e, T* numerators) {
    solve_core(e, numerators);
    for (const BackSubstitution& step : e.steps) substitute(e, step, numerators);
  }

 private:
  /// Lane after lane; lanes that stand for the same pose often follow each other.
  void place_unknowns() {
    const auto inputs = static_cast<std::size_t>(model_.inputs()), given = model_.box.size() + model_.dyads.size();
    std::vector<int> sides;
    for (std::size_t i = model_.box.size(); i < given; ++i)
      sides.push_back(static_cast<int>(value_of(inputs_[i * Lanes])));
    std::vector<T> lane_inputs(inputs);
    for (std::size_t l = 0; l < Lanes; ++l) {
      for (std::size_t i = 0; i < given; ++i) lane_inputs[i] = inputs_[i * Lanes + l];
      place_groups(model_, sides, lane_inputs);
      for (std::size_t i = given; i < inputs; ++i) inputs_[i * Lanes + l] = lane_inputs[i];
    }
  }

  const T* at(Register r, int lane = 0) const {
    return registers_.data() + static_cast<std::ptrdiff_t>(r) * Lanes + lane;
  }
  static T* out(T* numerators, int unknown) { return numerators + static_cast<std::ptrdiff_t>(unknown) * Lanes; }

  void solve_core(const Elimination& e, T* numerators) {
    const std::size_t size = e.core_unknowns.size();
    T* const determinant = out(numerators, e.unknowns);
    const T sign(e.sign);
    if (size == 2) {  // the cross product of the two rows, the same over all lanes
      const T *m00 = at(e.core[0]), *m01 = at(e.core[1]), *b0 = at(e.core[2]);
      const T *m10 = at(e.core[3]), *m11 = at(e.core[4]), *b1 = at(e.core[5]);
      T *n0 = out(numerators, e.core_unknowns[0]), *n1 = out(numerators, e.core_unknowns[1]);
      for (int l = 0; l < Lanes; ++l) {
        n0[l] = sign * (b0[l] * m11[l] - m01[l] * b1[l]);
        n1[l] = sign * (m00[l] * b1[l] - b0[l] * m10[l]);
        determinant[l] = sign * (m00[l] * m11[l] - m01[l] * m10[l]);
      }
      return;
    }
    core_.resize(size * (size + 1));
    kernel_.resize(size + 1);
    for (int l = 0; l < Lanes; ++l) {
      for (std::size_t i = 0; i < e.core.size(); ++i) core_[i] = *at(e.core[i], l);
      kernel_vector<T>(static_cast<int>(size), core_.data(), kernel_.data());
      for (std::size_t i = 0; i < size; ++i) out(numerators, e.core_unknowns[i])[l] = sign * kernel_[i];
      determinant[l] = -(sign * kernel_[size]);
    }
  }

  void substitute(const Elimination& e, const BackSubstitution& step, T* numerators) {
    const T* const determinant = out(numerators, e.unknowns);
    T* const result = out(numerators, step.unknown);
    if (step.load >= 0) {
      const T* const load = at(step.load);
      for (int l = 0; l < Lanes; ++l) result[l] = load[l] * determinant[l];
    } else {
      std::fill(result, result + Lanes, T(0.0));
    }
    for (const auto& [factor, unknown] : step.terms) {
      const T* const a = at(factor);
      const T* const n = out(numerators, unknown);
      for (int l = 0; l < Lanes; ++l) result[l] = result[l] - a[l] * n[l];
    }
    const T pivot(step.pivot);
    for (int l = 0; l < Lanes; ++l) result[l] = pivot * result[l];
  }

  const NumericModel& model_;
  int instructions_;
  std::vector<T> inputs_, registers_, core_, kernel_;
};

}  // namespace clearloci::numeric
