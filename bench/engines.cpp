// The engines against plain grids on one curve: M_A1 of the 5R with 1 kg links, of degree 24. Prints JSON;
// bench/engines turns it into a table and a plot.
//
// Accuracy is measured alike for all: the distance of points on the chords from the curve, by one Newton step on the
// compiled factor; of the curve's length the 99 % that are drawn best count, for a grid is at its worst next to the
// workspace boundary, where a root's slope is unbounded.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "loci/curves/curve_graph.hpp"
#include "loci/numbers/sheet_program.hpp"
#include "loci/sheet/patch.hpp"
#include "loci/sheet/sheet_cell.hpp"
#include "loci/sheet/subtower.hpp"

namespace {

using clearloci::core::Interval;
using clearloci::core::Point2;
using clearloci::loci::sheet::Batch;
using clearloci::loci::sheet::SheetProgram;
using Clock = std::chrono::steady_clock;
using Segments = std::vector<std::array<Point2, 2>>;

double milliseconds(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Least time of a few runs, in ms.
template <class F>
double best_of(int runs, const F& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < runs; ++i) {
    const Clock::time_point start = Clock::now();
    work();
    best = std::min(best, milliseconds(start));
  }
  return best;
}

/// The compiled factor of M_A1 at points of the working mode's sheet.
class Factor {
 public:
  Factor(const clearloci::core::LocusProblem& problem, const clearloci::core::LocusFactor& factor)
      : part_(clearloci::loci::sheet::subtower(problem.tower, problem.modes.front(), {factor.sheet})),
        program_(part_.tower, std::vector<clearloci::loci::sheet::SheetFunction>{clearloci::loci::sheet::narrowed(
                                  clearloci::loci::sheet::SheetFunction{factor.sheet, factor.line}, part_)}),
        batch_(program_.registers<Batch>()) {}

  /// Eight points at a time; not a number outside the workspace.
  Batch operator()(const Batch& x, const Batch& y) {
    batch_.set(0, x);
    batch_.set(1, y);
    for (int j = 0; j < program_.roots(); ++j) {
      batch_.run_square(j);
      const Batch root = square_root(batch_.square(j));
      batch_.set(2 + j, Batch(part_.mode[static_cast<std::size_t>(j)]) * root);
    }
    batch_.run_values();
    return batch_.value(0);
  }

  const SheetProgram& program() const { return program_; }
  const clearloci::core::WorkingMode& mode() const { return part_.mode; }
  const clearloci::core::RootTower& tower() const { return part_.tower; }

  /// First-order distance from the curve; none outside the workspace.
  std::optional<double> distance(const Point2& p) {
    constexpr double h = 1e-7;
    Batch x(p[0]), y(p[1]);
    x[1] += h, x[2] -= h, y[3] += h, y[4] -= h;
    const Batch f = (*this)(x, y);
    const double slope = std::hypot(f[1] - f[2], f[3] - f[4]) / (2 * h);
    if (!std::isfinite(slope) || slope == 0) return std::nullopt;
    return std::abs(f[0]) / slope;
  }

 private:
  clearloci::loci::sheet::Subtower part_;
  SheetProgram program_;
  SheetProgram::Registers<Batch> batch_;
};

/// Deviation within which 99 % of the length lie.
double deviation(Factor& factor, const Segments& segments) {
  std::vector<std::pair<double, double>> samples;  // deviation, length
  double whole = 0;
  for (const auto& [a, b] : segments) {
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    double worst = 0;
    bool inside = length > 0;
    for (const double t : {0.0, 0.25, 0.5, 0.75}) {
      const std::optional<double> off = factor.distance({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
      inside = inside && off;
      worst = std::max(worst, off.value_or(0));
    }
    if (!inside) continue;
    samples.emplace_back(worst, length);
    whole += length;
  }
  std::sort(samples.begin(), samples.end());
  double sum = 0;
  for (const auto& [off, length] : samples)
    if ((sum += length) >= 0.99 * whole) return off;
  return 0;
}

/// Marching squares on n x n cells; the saddle is resolved by the mean of the corners.
Segments marching_squares(Factor& factor, const clearloci::core::LocusProblem& problem, int n) {
  double low[2], step[2];
  for (const std::size_t i : {0u, 1u}) {
    low[i] = clearloci::core::to_double(problem.lower[i]) + 1e-7;
    step[i] = (clearloci::core::to_double(problem.upper[i]) - low[i]) / n;
  }
  const auto row = [&](int k, std::vector<double>& values) {
    values.resize(static_cast<std::size_t>(n) + 1 + Batch::size);
    for (std::size_t i = 0; i <= static_cast<std::size_t>(n); i += Batch::size) {
      Batch x;
      for (std::size_t lane = 0; lane < Batch::size; ++lane) x[lane] = low[0] + step[0] * static_cast<double>(i + lane);
      const Batch f = factor(x, Batch(low[1] + step[1] * k));
      for (std::size_t lane = 0; lane < Batch::size; ++lane) values[i + lane] = f[lane];
    }
  };
  Segments segments;
  std::vector<double> below, above;
  row(0, below);
  for (int k = 0; k < n; ++k, std::swap(below, above)) {
    row(k + 1, above);
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
      const double f[4] = {below[i], below[i + 1], above[i + 1], above[i]};
      if (!std::isfinite(f[0] + f[1] + f[2] + f[3])) continue;
      static constexpr double corner_x[] = {0, 1, 1, 0}, corner_y[] = {0, 0, 1, 1};
      std::vector<Point2> crossings;
      for (std::size_t e = 0; e < 4; ++e) {
        const std::size_t next = (e + 1) % 4;
        if ((f[e] < 0) == (f[next] < 0)) continue;
        const double t = f[e] / (f[e] - f[next]);
        const double u = corner_x[e] + t * (corner_x[next] - corner_x[e]);
        const double v = corner_y[e] + t * (corner_y[next] - corner_y[e]);
        crossings.push_back({low[0] + step[0] * (static_cast<double>(i) + u), low[1] + step[1] * (k + v)});
      }
      if (crossings.size() == 2) segments.push_back({crossings[0], crossings[1]});
      if (crossings.size() == 4) {
        const std::size_t shift = (f[0] + f[1] + f[2] + f[3] < 0) == (f[0] < 0) ? 0 : 1;
        segments.push_back({crossings[shift], crossings[shift + 1]});
        segments.push_back({crossings[shift + 2], crossings[(shift + 3) % 4]});
      }
    }
  }
  return segments;
}

struct Box {
  Interval x, y;
};

Box box_of(const clearloci::core::LocusProblem& problem) {
  using clearloci::core::to_double;
  return {{to_double(problem.lower[0]), to_double(problem.upper[0])},
          {to_double(problem.lower[1]), to_double(problem.upper[1])}};
}

/// What the engine does without its tricks: cells whose plain enclosure of the value excludes 0 go, others are halved
/// down to a width. What is left covers the curve; nothing is said of its topology.
struct Covering {
  std::size_t examined = 0;
  std::vector<Point2> middles;
};

Covering branch_and_prune(const SheetProgram& program, const clearloci::core::WorkingMode& mode, const Box& box,
                          double width) {
  clearloci::loci::sheet::SheetCell cell(program, mode);
  Covering covering;
  std::vector<Box> open = {box};
  while (!open.empty()) {
    const Box next_box = open.back();
    open.pop_back();
    ++covering.examined;
    if (!cell.enter(next_box.x, next_box.y) || !cell.value(0).contains_zero()) continue;
    if (std::max(next_box.x.width(), next_box.y.width()) <= width) {
      covering.middles.push_back({next_box.x.middle(), next_box.y.middle()});
      continue;
    }
    Box halves[2] = {next_box, next_box};
    const bool across = next_box.x.width() >= next_box.y.width();
    for (const bool upper : {false, true}) {
      const Interval& whole = across ? next_box.x : next_box.y;
      Interval& part = across ? halves[upper].x : halves[upper].y;
      part = upper ? Interval(whole.middle(), whole.upper()) : Interval(whole.lower(), whole.middle());
    }
    open.insert(open.end(), halves, halves + 2);
  }
  return covering;
}

/// Distance within which 99 % of the cells left have their middles.
double deviation(Factor& factor, const Covering& covering) {
  std::vector<double> off;
  for (const Point2& middle : covering.middles)
    if (const std::optional<double> distance = factor.distance(middle)) off.push_back(*distance);
  if (off.empty()) return std::numeric_limits<double>::infinity();
  const auto last = off.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(off.size() - 1));
  std::nth_element(off.begin(), last, off.end());
  return *last;
}

/// At ever smaller widths until the accuracy is met, or it takes too long.
nlohmann::ordered_json branch_and_prune(Factor& factor, const SheetProgram& program, const Box& box, double accuracy) {
  constexpr double longest = 4e3;  // ms
  nlohmann::ordered_json rows;
  for (double width = 1e-2; width > 1e-7; width /= 2) {
    Covering covering;
    const double time = best_of(1, [&] { covering = branch_and_prune(program, factor.mode(), box, width); });
    const double off = deviation(factor, covering);
    rows.push_back({{"width", width}, {"cells", covering.examined}, {"milliseconds", time}, {"deviation", off}});
    if (off <= accuracy || time > longest) break;
  }
  return rows;
}

/// What cannot be done without: a Newton step a vertex, a plain enclosure of the value a cell that the proof looks at.
nlohmann::ordered_json limit(const Factor& factor, const Box& box, std::size_t vertices) {
  const auto parts =
      clearloci::loci::sheet::partition(factor.tower(), {box.x.lower(), box.x.upper(), box.y.lower(), box.y.upper()});
  const clearloci::loci::sheet::SheetFunction& function = factor.program().function(0);
  const auto graph = clearloci::loci::sheet::curve_graph(factor.tower(), function, factor.mode(), parts, {});
  std::size_t cells = 0;
  for (const auto& patch : graph.patches) cells += 2 * patch.tree->leaves().size() - 1;
  constexpr int repeated = 20000;
  auto point = factor.program().registers<double>();
  auto over = factor.program().registers<Interval>();
  const auto enter = [&](auto& registers, const auto& x, const auto& y) {
    registers.set(0, x);
    registers.set(1, y);
    for (int j = 0; j < factor.program().roots(); ++j) {
      registers.run_square(j);
      registers.set(2 + j, x);
    }
    registers.run_values();
  };
  const double newton = best_of(3, [&] {
    for (int i = 0; i < repeated; ++i) {
      enter(point, 0.2 + 1e-6 * i, -0.6);
      point.run_gradients();
    }
  });
  const double enclosure = best_of(3, [&] {
    for (int i = 0; i < repeated; ++i) enter(over, Interval(0.2 + 1e-6 * i, 0.21 + 1e-6 * i), Interval(-0.6, -0.59));
  });
  return {
      {"cells", cells},
      {"newton_microseconds", 1e3 * newton / repeated},
      {"enclosure_microseconds", 1e3 * enclosure / repeated},
      {"milliseconds", (static_cast<double>(vertices) * newton + static_cast<double>(cells) * enclosure) / repeated}};
}

bool is_moment_A1(const clearloci::core::LocusCurve& curve) {
  return std::any_of(curve.vanishing.begin(), curve.vanishing.end(),
                     [](const auto& v) { return v.joint == "A1" && v.quantity == clearloci::core::Quantity::M; });
}

Segments segments_of(const clearloci::core::LocusMap& map) {
  Segments segments;
  for (const auto& curve : map.curves) {
    if (!is_moment_A1(curve)) continue;
    for (const auto& arc : curve.arcs)
      for (std::size_t i = 1; i < arc.points.size(); ++i) segments.push_back({arc.points[i - 1], arc.points[i]});
  }
  return segments;
}

nlohmann::ordered_json drag(int designs) {
  const clearloci::Model model = clearloci::Model::read(CLEARLOCI_SOURCE_DIR "/examples/five_bar.yaml");
  std::vector<double> derive, whole;
  for (int i = 0; i < designs; ++i) {
    const Clock::time_point start = Clock::now();
    const clearloci::LocusMap map = trace_loci(model.with({{"L", std::to_string(500 + i) + "/1000"}}));
    whole.push_back(milliseconds(start));
    double seconds = 0;
    for (const auto& [stage, time] : map.timing)
      if (stage != "tracing") seconds += time;
    derive.push_back(1e3 * seconds);
  }
  std::sort(derive.begin(), derive.end());
  std::sort(whole.begin(), whole.end());
  return {{"designs", designs}, {"equations", derive[derive.size() / 2]}, {"file_to_loci", whole[whole.size() / 2]}};
}

}  // namespace

int main(int argc, char** argv) {
  const bool with_exact = argc > 1 && std::string_view(argv[1]) == "--exact";
  const auto mechanism = clearloci::mechanism::read_mechanism(CLEARLOCI_SOURCE_DIR "/examples/five_bar_weights.yaml");
  clearloci::LociRequest request;
  request.joints = {"A1"};
  request.quantities = {clearloci::core::Quantity::M};
  request.engine = clearloci::Engine::adaptive;
  const clearloci::core::LocusProblem problem = clearloci::trace_problem(mechanism, request).problem;
  const auto found = std::find_if(problem.factors.begin(), problem.factors.end(), [](const auto& factor) {
    return factor.role == clearloci::core::FactorRole::reaction;
  });
  Factor factor(problem, *found);

  nlohmann::ordered_json result;
  double accuracy = 0;
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    clearloci::core::LocusProblem with = problem;
    with.tolerance = tolerance;
    clearloci::core::LocusMap map;
    const double time = best_of(3, [&] { map = clearloci::loci::trace(with, {.engine = request.engine}); });
    double length = 0;
    std::size_t vertices = 0;
    for (const auto& curve : map.curves)
      for (const auto& arc : curve.arcs) length += arc.length, vertices += arc.points.size();
    result["cost"].push_back({{"tolerance", tolerance},
                              {"length", length},
                              {"vertices", vertices},
                              {"milliseconds", time},
                              {"deviation", deviation(factor, segments_of(map))}});
    if (tolerance != 1e-5) continue;
    accuracy = result["cost"].back()["deviation"];
    result["limit"] = limit(factor, box_of(problem), vertices);
  }
  clearloci::core::LocusFactor expanded = *found;
  expanded.line = {};
  Factor by_polynomial(problem, expanded);
  result["branch_and_prune"] = {
      {"program", branch_and_prune(factor, factor.program(), box_of(problem), accuracy)},
      {"polynomial", branch_and_prune(factor, by_polynomial.program(), box_of(problem), accuracy)}};
  for (const int n : {400, 800, 1600, 3200, 6400, 12800}) {
    Segments segments;
    const double time = best_of(n > 2000 ? 1 : 3, [&] { segments = marching_squares(factor, problem, n); });
    result["grid"].push_back({{"cells", n}, {"milliseconds", time}, {"deviation", deviation(factor, segments)}});
  }
  if (with_exact) {
    const double time = best_of(1, [&] { clearloci::loci::trace(problem, {.engine = clearloci::Engine::exact}); });
    result["exact"] = {{"milliseconds", time}};
  }
  result["drag"] = drag(60);
  std::printf("%s\n", result.dump(2).c_str());
  return EXIT_SUCCESS;
}
