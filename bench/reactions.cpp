// The reactions of the 5R at a million poses, on one core: all unknowns at once by the compiled elimination, and pose
// by pose by LU of the full matrix, condition number included (what `clearloci pose` does).
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "mechanism/read.hpp"
#include "numeric/reactions.hpp"

namespace {

const clearloci::numeric::NumericModel& five_bar() {
  static const clearloci::numeric::NumericModel model =
      clearloci::numeric::compile(clearloci::mechanism::read_mechanism(CLEARLOCI_SOURCE_DIR "/examples/five_bar.yaml"));
  return model;
}

/// `side`^2 poses over the part of the box where most are reachable.
std::vector<double> poses(int side) {
  std::vector<double> all;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      all.push_back(-0.4 + 1.3 * (i + 0.5) / side);
      all.push_back(-0.9 + 0.85 * (j + 0.5) / side);
    }
  return all;
}

void reactions_by_elimination(benchmark::State& state) {
  const std::vector<double> all = poses(static_cast<int>(std::lround(std::sqrt(state.range(0)))));
  const std::vector<int> mode = clearloci::mechanism::working_mode(five_bar().mechanism);
  clearloci::numeric::ReactionField field;
  for (auto _ : state) {
    clearloci::numeric::reaction_field(five_bar(), all, mode, field);
    benchmark::DoNotOptimize(field.numerators.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void reactions_by_lu(benchmark::State& state) {
  const std::vector<double> all = poses(static_cast<int>(std::lround(std::sqrt(state.range(0)))));
  const std::vector<int> mode = clearloci::mechanism::working_mode(five_bar().mechanism);
  for (auto _ : state)
    for (std::size_t i = 0; i < all.size(); i += 2) {
      const auto posture = clearloci::numeric::posture(five_bar(), std::span(all).subspan(i, 2), mode);
      if (posture.reachable()) benchmark::DoNotOptimize(solve_reactions(five_bar(), posture));
    }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

BENCHMARK(reactions_by_elimination)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(reactions_by_lu)->Arg(10'000)->Unit(benchmark::kMillisecond);

}  // namespace
