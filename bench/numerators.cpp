// |A| and every Cramer numerator, factored: of the 5R with symbolic parameters, against GiNaC's own determinant() of
// the full matrix, once for |A| and once a column; of the spatial platforms with their numbers.
#include <benchmark/benchmark.h>
#include <ginac/ginac.h>

#include "mechanism/read.hpp"
#include "symbolic/determinants.hpp"

namespace {

using clearloci::symbolic::Geometry;
using clearloci::symbolic::NewtonEulerEquations;

constexpr bool keep_parameters = true;

clearloci::mechanism::Mechanism example(const char* name) {
  return clearloci::mechanism::read_mechanism(std::string(CLEARLOCI_SOURCE_DIR "/examples/") + name);
}

const clearloci::mechanism::Mechanism& five_bar() {
  static const clearloci::mechanism::Mechanism mechanism = example("five_bar.yaml");
  return mechanism;
}

/// From a mechanism to its numerators, closure and matrix included.
void numerators_of(benchmark::State& state, const clearloci::mechanism::Mechanism& mechanism, bool keep) {
  for (auto _ : state) {
    const Geometry geometry(mechanism, keep);
    benchmark::DoNotOptimize(clearloci::symbolic::factored_determinants(geometry));
  }
}

void numerators(benchmark::State& state) { numerators_of(state, five_bar(), keep_parameters); }

/// 78 unknowns: six legs of two links, universal, prismatic and spherical joints.
void numerators_gough_stewart(benchmark::State& state) { numerators_of(state, example("gough_stewart.yaml"), false); }

/// 42 unknowns.
void numerators_three_upu(benchmark::State& state) { numerators_of(state, example("three_upu.yaml"), false); }

/// From the mechanism to the same numerators by GiNaC alone.
void numerators_ginac_determinant(benchmark::State& state) {
  for (auto _ : state) {
    const Geometry geometry(five_bar(), keep_parameters);
    const NewtonEulerEquations equations = newton_euler_equations(geometry);
    benchmark::DoNotOptimize(equations.matrix.determinant());
    for (unsigned column = 0; column < equations.matrix.cols(); ++column) {
      GiNaC::matrix replaced = equations.matrix;
      for (unsigned row = 0; row < replaced.rows(); ++row) replaced(row, column) = equations.loads(row, 0);
      benchmark::DoNotOptimize(replaced.determinant());
    }
  }
}

BENCHMARK(numerators)->Unit(benchmark::kMillisecond);
BENCHMARK(numerators_gough_stewart)->Unit(benchmark::kMillisecond);
BENCHMARK(numerators_three_upu)->Unit(benchmark::kMillisecond);
BENCHMARK(numerators_ginac_determinant)->Unit(benchmark::kMillisecond);

}  // namespace
