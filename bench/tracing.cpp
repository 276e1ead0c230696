// From a mechanism to its loci, zones and verdicts, in one process: what a program that calls the library waits for.
// `drag_...`: a Model with another length each time, as while a hand drags it.
#include <benchmark/benchmark.h>

#include <string>

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"

namespace {

using clearloci::Model;

std::string example(const std::string& name) { return std::string(CLEARLOCI_SOURCE_DIR "/examples/") + name; }

void fresh_loci(benchmark::State& state, const std::string& name, bool all_modes) {
  for (auto _ : state)
    benchmark::DoNotOptimize(
        clearloci::trace_loci(Model::read(example(name)), {.all_working_modes = all_modes}).curves.size());
}

/// The length takes a thousand values of four digits in turn.
template <class Ask>
void drag(benchmark::State& state, const std::string& name, Ask ask) {
  const Model model = Model::read(example(name));
  int move = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(ask(model.with({{"L", "0." + std::to_string(4500 + 37 * ++move % 1000)}})));
}

std::size_t loci(const Model& model) { return clearloci::trace_loci(model).curves.size(); }
std::size_t loci_of_all_modes(const Model& model) {
  return clearloci::trace_loci(model, {.all_working_modes = true}).curves.size();
}
std::size_t zones(const Model& model) { return clearloci::find_zones(model).zones.size(); }
/// A box inside a zone of either example for all these lengths.
bool verdict(const Model& model) {
  const clearloci::Task task = clearloci::parse_task("format: 1\nbox: {x: [0.15, 0.2], y: [-0.62, -0.58]}\n", model);
  return clearloci::verify(model, task, {.depth = clearloci::VerifyDepth::margin}).verified();
}

BENCHMARK_CAPTURE(fresh_loci, five_bar, "five_bar.yaml", false)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(fresh_loci, five_bar_all_modes, "five_bar.yaml", true)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(drag, loci, "five_bar.yaml", loci)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(drag, loci_all_modes, "five_bar.yaml", loci_of_all_modes)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(drag, zones, "five_bar.yaml", zones)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(drag, verdict, "five_bar.yaml", verdict)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(drag, degree_24_loci, "five_bar_weights.yaml", loci)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(drag, degree_24_zones, "five_bar_weights.yaml", zones)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(drag, degree_24_verdict, "five_bar_weights.yaml", verdict)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
