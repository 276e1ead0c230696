// From a mechanism file to its traced loci, in one process: what a program that calls the library waits for.
#include <benchmark/benchmark.h>

#include "analysis/loci.hpp"

namespace {

void five_bar(benchmark::State& state) {
  for (auto _ : state) {
    const auto mechanism = clearloci::mechanism::read_mechanism(CLEARLOCI_SOURCE_DIR "/examples/five_bar.yaml");
    benchmark::DoNotOptimize(clearloci::trace_loci(mechanism));
  }
}

void five_bar_all_modes(benchmark::State& state) {
  for (auto _ : state) {
    const auto mechanism = clearloci::mechanism::read_mechanism(CLEARLOCI_SOURCE_DIR "/examples/five_bar.yaml");
    benchmark::DoNotOptimize(clearloci::trace_loci(mechanism, {.all_working_modes = true}));
  }
}

BENCHMARK(five_bar)->Unit(benchmark::kMillisecond);
BENCHMARK(five_bar_all_modes)->Unit(benchmark::kMillisecond);

}  // namespace
