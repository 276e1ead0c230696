// Pose errors of many poses: the map of a million cells on every core, and the sweep of 126 periods by 2000 instants of
// the pick-and-place cycle, from the compiled motion to the table of errors.
#include <benchmark/benchmark.h>

#include "mechanism/read.hpp"
#include "mechanism/trajectory.hpp"
#include "numeric/error_map.hpp"
#include "numeric/period_sweep.hpp"

namespace {

namespace mechanism = clearloci::mechanism;
namespace numeric = clearloci::numeric;

void error_map(benchmark::State& state) {
  const auto model = numeric::compile(mechanism::read_mechanism(CLEARLOCI_SOURCE_DIR "/examples/five_bar.yaml"));
  const std::vector<int> mode = mechanism::working_mode(model.mechanism);
  const bool worst_case = state.range(0) != 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(numeric::error_map(model, mode, {.cells = {1000, 1000}, .worst_case = worst_case}));
}

void period_sweep(benchmark::State& state) {
  const auto manipulator = mechanism::read_mechanism(CLEARLOCI_SOURCE_DIR "/examples/pick_and_place/manipulator.yaml");
  const auto path = mechanism::read_trajectory(CLEARLOCI_SOURCE_DIR "/examples/pick_and_place/path.yaml", manipulator);
  std::vector<double> periods;
  for (int i = 0; i < 126; ++i) periods.push_back(0.5 + 0.02 * i);
  for (auto _ : state) {
    const numeric::Motion motion = numeric::compile_motion(manipulator, path, mechanism::working_mode(manipulator));
    benchmark::DoNotOptimize(numeric::period_sweep(motion, numeric::sample(motion, 2000), periods));
  }
}

BENCHMARK(error_map)->Name("error_map_with_worst_case")->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(error_map)->Name("error_map")->Arg(0)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(period_sweep)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
