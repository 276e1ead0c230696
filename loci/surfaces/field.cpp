#include "loci/surfaces/field.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace clearloci::loci::surface {
namespace {

using core::LocusProblem;

/// Of a square; beyond the boundary as the root goes on there.
double root_of(double square) { return std::copysign(std::sqrt(std::abs(square)), square); }

}  // namespace

std::optional<int> sign_across_seam(const LocusProblem& a, const sheet::SheetFunction& of_a, const LocusProblem& b,
                                    const sheet::SheetFunction& of_b, const core::WorkingMode& mode) {
  constexpr int compared = 200;
  Point from{}, to{};
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = std::max(coordinate_at(a, i, a.lower[i]), coordinate_at(b, i, b.lower[i]));
    to[i] = std::min(coordinate_at(a, i, a.upper[i]), coordinate_at(b, i, b.upper[i]));
  }
  Field one({{&a, of_a, 1}}, mode), other({{&b, of_b, 1}}, mode);
  const auto unit_in = [](const Frame& frame, const Point& place) {
    Point unit{};
    for (std::size_t i = 0; i < 3; ++i) unit[i] = (place[i] - frame.lower[i]) / frame.width(i);
    return unit;
  };
  int same = 0, opposite = 0;
  double sequence[3] = {0.5, 0.5, 0.5};
  for (int k = 0; k < compared; ++k) {
    Point place{};
    for (std::size_t i = 0; i < 3; ++i) {
      // Weyl's sequence of the roots of x^4 = x + 1: places spread evenly over the seam.
      constexpr double steps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
      sequence[i] = std::fmod(sequence[i] + steps[i], 1.0);
      place[i] = from[i] + sequence[i] * (to[i] - from[i]);
    }
    const Point in_one = unit_in(one.frame(), place), in_other = unit_in(other.frame(), place);
    if (!one.inside(in_one) || !other.inside(in_other)) continue;
    const double product = one.value(in_one) * other.value(in_other);
    if (product > 0) ++same;
    if (product < 0) ++opposite;
  }
  if (opposite == 0) return 1;
  if (same == 0) return -1;
  return std::nullopt;
}

Field::Chart::Chart(const ChartPart& part, const core::WorkingMode& mode)
    : problem(part.problem),
      program(part.problem->tower, std::vector<sheet::SheetFunction>{part.function}),
      at(program.registers<double>()),
      beside(program.registers<sheet::Batch>()),
      over(program.registers<sheet::IntervalBatch>()),
      sign(part.sign) {
  core::ensure(static_cast<int>(mode.size()) == program.roots(), "a working mode has a sign for every root");
  for (std::size_t i = 0; i < 3; ++i) {
    lower[i] = coordinate_at(*problem, i, problem->lower[i]);
    upper[i] = coordinate_at(*problem, i, problem->upper[i]);
    least[i] = core::to_double(problem->lower[i]);
    most[i] = core::to_double(problem->upper[i]);
  }
}

Field::Field(const std::vector<ChartPart>& parts, core::WorkingMode mode) : mode_(std::move(mode)) {
  std::vector<const LocusProblem*> problems;
  for (const ChartPart& part : parts) {
    problems.push_back(part.problem);
    charts_.push_back(std::make_unique<Chart>(part, mode_));
  }
  frame_ = frame_of(problems);
}

Field::Chart& Field::chart_at(const Point& place) {
  Chart* chart = charts_.front().get();
  double least = std::numeric_limits<double>::infinity();
  for (const auto& candidate : charts_) {
    double off = 0;
    for (std::size_t i = 0; i < 3; ++i)
      off = std::max({off, candidate->lower[i] - place[i], place[i] - candidate->upper[i]});
    if (off < least) {
      least = off;
      chart = candidate.get();
    }
    if (off == 0) break;
  }
  return *chart;
}

Field::Chart& Field::enter(const Point& unit, int held) {
  const Point place = frame_.place(unit);
  Chart* const chart = &chart_at(place);
  for (std::size_t i = 0; i < 3; ++i) {
    chart->at.set(static_cast<int>(i), variable_at(*chart->problem, i, place[i], scale_[i]));
    scale_[i] *= frame_.width(i);
  }
  for (int j = 0; j < roots(); ++j) {
    chart->at.run_square(j);
    const double root = j == held ? 0 : root_of(chart->at.square(j));
    chart->at.set(3 + j, mode_[static_cast<std::size_t>(j)] * root);
  }
  return *chart;
}

void Field::enter(Chart& chart, const std::vector<Point>& places, std::vector<Point>& scales) {
  scales.resize(places.size());
  for (std::size_t i = 0; i < 3; ++i) {
    sheet::Batch variables;
    for (std::size_t l = 0; l < sheet::Batch::size; ++l) {
      const std::size_t place = std::min(l, places.size() - 1);
      variables[l] = variable_at(*chart.problem, i, places[place][i], scales[place][i]);
    }
    for (Point& scale : scales) scale[i] *= frame_.width(i);
    chart.beside.set(static_cast<int>(i), variables);
  }
  for (int j = 0; j < roots(); ++j) {
    chart.beside.run_square(j);
    sheet::Batch root;
    for (std::size_t l = 0; l < sheet::Batch::size; ++l)
      root[l] = mode_[static_cast<std::size_t>(j)] * root_of(chart.beside.square(j)[l]);
    chart.beside.set(3 + j, root);
  }
}

template <class Visit>
void Field::each_batch(const std::vector<Point>& units, const Visit& visit) {
  std::vector<Chart*> chart_of;
  for (const Point& unit : units) chart_of.push_back(&chart_at(frame_.place(unit)));
  std::vector<std::size_t> batch;
  std::vector<Point> places, scales;
  for (const auto& chart : charts_) {
    for (std::size_t k = 0; k < units.size(); ++k) {
      if (chart_of[k] == chart.get()) batch.push_back(k);
      if (batch.size() < sheet::Batch::size && (batch.empty() || k + 1 < units.size())) continue;
      places.clear();
      for (const std::size_t point : batch) places.push_back(frame_.place(units[point]));
      enter(*chart, places, scales);
      visit(*chart, batch, scales);
      batch.clear();
    }
  }
}

std::vector<double> Field::values(const std::vector<Point>& units) {
  std::vector<double> result(units.size());
  each_batch(units, [&](Chart& chart, const std::vector<std::size_t>& batch, const std::vector<Point>&) {
    chart.beside.run_values();
    for (std::size_t l = 0; l < batch.size(); ++l) result[batch[l]] = chart.sign * chart.beside.value(0)[l];
  });
  return result;
}

std::vector<double> Field::squares(const std::vector<Point>& units, int root) {
  std::vector<double> result(units.size());
  each_batch(units, [&](const Chart& chart, const std::vector<std::size_t>& batch, const std::vector<Point>&) {
    for (std::size_t l = 0; l < batch.size(); ++l) result[batch[l]] = chart.beside.square(root)[l];
  });
  return result;
}

std::vector<Field::Sight> Field::look_at(const std::vector<Point>& units) {
  std::vector<Sight> result(units.size());
  gradient_.resize(static_cast<std::size_t>(charts_.front()->program.variables()));
  each_batch(units, [&](Chart& chart, const std::vector<std::size_t>& batch, const std::vector<Point>& scales) {
    chart.beside.run_values();
    chart.beside.run_gradients();
    for (std::size_t l = 0; l < batch.size(); ++l) {
      Sight& sight = result[batch[l]];
      sight.value = chart.sign * chart.beside.value(0)[l];
      sight.inside = true;
      chart.at.take_gradients(chart.beside, l);
      for (int j = 0; j < roots(); ++j) {
        sight.inside = sight.inside && !(chart.beside.square(j)[l] < 0);
        chart.at.set(3 + j, chart.beside.root(j)[l]);
      }
      for (std::size_t v = 0; v < gradient_.size(); ++v)
        gradient_[v] = chart.sign * chart.at.partial(0, static_cast<int>(v));
      scale_ = scales[l];
      sight.slopes = reduced(chart, -1);
    }
  });
  return result;
}

double Field::value(const Point& unit) {
  Chart& chart = enter(unit);
  chart.at.run_values();
  return chart.sign * chart.at.value(0);
}

double Field::square(const Point& unit, int root) { return enter(unit).at.square(root); }

bool Field::inside(const Point& unit) {
  const Chart& chart = enter(unit);
  for (int j = 0; j < roots(); ++j)
    if (chart.at.square(j) < 0) return false;
  return true;
}

/// Chain rule through the roots, the last first; `gradient_` holds the derivatives by the program's variables.
Point Field::reduced(Chart& chart, int held) {
  double half = 0;
  const auto half_inverse = [&](int j) -> const double* {
    const double root = chart.at.root(j);
    // Of s = ±√Q and, beyond the boundary, of s = ∓√-Q alike.
    half = mode_[static_cast<std::size_t>(j)] / (2 * std::abs(root));
    return root == 0 || j == held ? nullptr : &half;
  };
  sheet::eliminate_roots(gradient_, 3, half_inverse, [&](int j, int v) { return chart.at.square_partial(j, v); });
  return {gradient_[0] * scale_[0], gradient_[1] * scale_[1], gradient_[2] * scale_[2]};
}

double Field::gradient(const Point& unit, Point& slopes) { return gradient_on_rim(unit, -1, slopes); }

double Field::gradient_on_rim(const Point& unit, int root, Point& slopes) {
  Chart& chart = enter(unit, root);
  chart.at.run_values();
  chart.at.run_gradients();
  gradient_.resize(static_cast<std::size_t>(chart.program.variables()));
  for (std::size_t v = 0; v < gradient_.size(); ++v)
    gradient_[v] = chart.sign * chart.at.partial(0, static_cast<int>(v));
  slopes = reduced(chart, root);
  return chart.sign * chart.at.value(0);
}

double Field::square_gradient(const Point& unit, int root, Point& slopes) {
  Chart& chart = enter(unit);
  chart.at.run_values();
  chart.at.run_gradients();
  gradient_.resize(static_cast<std::size_t>(chart.program.variables()));
  for (std::size_t v = 0; v < gradient_.size(); ++v) gradient_[v] = chart.at.square_partial(root, static_cast<int>(v));
  slopes = reduced(chart, root);
  return chart.at.square(root);
}

}  // namespace clearloci::loci::surface
