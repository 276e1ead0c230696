#include "loci/surfaces/field.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace clearloci::loci::surface {
namespace {

using core::Interval;
using core::LocusProblem;

/// Beyond rounding of tan and of multiples of pi.
constexpr double angle_rounding = 1e-14;
/// Two ends of charts are one seam: they are the same angle but for rounding.
constexpr double same_angle = 1e-9;

const std::optional<core::AngleChart>* chart_of(const LocusProblem& problem, std::size_t i) {
  return problem.charts.empty() || !problem.charts[i] ? nullptr : &problem.charts[i];
}

double coordinate_at(const LocusProblem& problem, std::size_t i, const core::Rational& variable) {
  const double value = core::to_double(variable);
  const auto* chart = chart_of(problem, i);
  return chart == nullptr ? value : core::angle_at(**chart, value);
}

/// The variable of the polynomials, and how much it moves with the coordinate.
double variable_at(const LocusProblem& problem, std::size_t i, double coordinate, double& slope) {
  slope = 1;
  const auto* chart = chart_of(problem, i);
  if (chart == nullptr) return coordinate;
  const double t = core::parameter_at(**chart, coordinate);
  slope = (1 + t * t) / 2;
  return t;
}

/// Of a square; beyond the boundary as the root goes on there.
double root_of(double square) { return std::copysign(std::sqrt(std::abs(square)), square); }

using sheet::is_zero;

}  // namespace

Point Frame::place(const Point& unit) const {
  Point result{};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = unit[i] == 0 ? lower[i] : unit[i] == 1 ? upper[i] : lower[i] + unit[i] * width(i);
  return result;
}

Frame frame_of(const std::vector<const LocusProblem*>& charts) {
  Frame frame;
  for (std::size_t i = 0; i < 3; ++i) {
    frame.angle[i] = chart_of(*charts.front(), i) != nullptr;
    frame.lower[i] = coordinate_at(*charts.front(), i, charts.front()->lower[i]);
    frame.upper[i] = coordinate_at(*charts.front(), i, charts.front()->upper[i]);
    for (const LocusProblem* chart : charts) {
      frame.lower[i] = std::min(frame.lower[i], coordinate_at(*chart, i, chart->lower[i]));
      frame.upper[i] = std::max(frame.upper[i], coordinate_at(*chart, i, chart->upper[i]));
    }
  }
  return frame;
}

bool are_neighbours(const LocusProblem& a, const LocusProblem& b) {
  int seams = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (chart_of(a, i) == nullptr) continue;
    const double from_a = coordinate_at(a, i, a.lower[i]), to_a = coordinate_at(a, i, a.upper[i]);
    const double from_b = coordinate_at(b, i, b.lower[i]), to_b = coordinate_at(b, i, b.upper[i]);
    if (std::abs(from_a - from_b) < same_angle) continue;
    if (std::abs(to_a - from_b) > same_angle && std::abs(to_b - from_a) > same_angle) return false;
    ++seams;
  }
  return seams == 1;
}

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

Interval Field::Chart::variable_over(std::size_t i, const Interval& coordinate) const {
  const auto* chart = chart_of(*problem, i);
  if (chart == nullptr) return coordinate;
  // Beyond a half turn the tangent starts anew: the cell is cut to the chart first.
  const double from = core::parameter_at(**chart, std::max(coordinate.lower(), lower[i]));
  const double to = core::parameter_at(**chart, std::min(coordinate.upper(), upper[i]));
  return meet(Interval(from - angle_rounding, std::max(from, to) + angle_rounding),
              Interval(least[i] - angle_rounding, most[i] + angle_rounding));
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
      const std::size_t own = std::min(l, places.size() - 1);
      variables[l] = variable_at(*chart.problem, i, places[own][i], scales[own][i]);
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
  std::vector<std::size_t> own;
  std::vector<Point> places, scales;
  for (const auto& chart : charts_) {
    for (std::size_t k = 0; k < units.size(); ++k) {
      if (chart_of[k] == chart.get()) own.push_back(k);
      if (own.size() < sheet::Batch::size && (own.empty() || k + 1 < units.size())) continue;
      places.clear();
      for (const std::size_t point : own) places.push_back(frame_.place(units[point]));
      enter(*chart, places, scales);
      visit(*chart, own, scales);
      own.clear();
    }
  }
}

std::vector<double> Field::values(const std::vector<Point>& units) {
  std::vector<double> result(units.size());
  each_batch(units, [&](Chart& chart, const std::vector<std::size_t>& own, const std::vector<Point>&) {
    chart.beside.run_values();
    for (std::size_t l = 0; l < own.size(); ++l) result[own[l]] = chart.sign * chart.beside.value(0)[l];
  });
  return result;
}

std::vector<double> Field::squares(const std::vector<Point>& units, int root) {
  std::vector<double> result(units.size());
  each_batch(units, [&](const Chart& chart, const std::vector<std::size_t>& own, const std::vector<Point>&) {
    for (std::size_t l = 0; l < own.size(); ++l) result[own[l]] = chart.beside.square(root)[l];
  });
  return result;
}

std::vector<Field::Sight> Field::look_at(const std::vector<Point>& units) {
  std::vector<Sight> result(units.size());
  gradient_.resize(static_cast<std::size_t>(charts_.front()->program.variables()));
  each_batch(units, [&](Chart& chart, const std::vector<std::size_t>& own, const std::vector<Point>& scales) {
    chart.beside.run_values();
    chart.beside.run_gradients();
    for (std::size_t l = 0; l < own.size(); ++l) {
      Sight& sight = result[own[l]];
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

Box Field::place_of(const Box& unit) const {
  Box place;
  for (std::size_t i = 0; i < 3; ++i)
    place[i] = Interval(frame_.lower[i]) + unit[i] * (Interval(frame_.upper[i]) - Interval(frame_.lower[i]));
  return place;
}

bool Field::meets(const Chart& chart, const Box& place) {
  for (std::size_t i = 0; i < 3; ++i)
    if (place[i].upper() < chart.lower[i] || place[i].lower() > chart.upper[i]) return false;
  return true;
}

std::vector<Field::Lanes> Field::lanes_of(const Chart& chart, const std::vector<Box>& places) const {
  std::vector<Lanes> result;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!meets(chart, places[k])) continue;
    if (result.empty() || result.back().size() == sheet::IntervalBatch::size) result.emplace_back();
    Lane& lane = result.back().emplace_back(Lane{.box = k});
    for (std::size_t i = 0; i < 3; ++i) lane.variables[i] = chart.variable_over(i, places[k][i]);
  }
  return result;
}

void Field::set_variables(Chart& chart, const Lanes& lanes, bool middles) {
  chart.over.use_lanes(lanes.size());
  for (std::size_t i = 0; i < 3; ++i) {
    sheet::IntervalBatch variables;
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      const Interval& own = lanes[l].variables[i];
      variables.lanes[l] = middles ? Interval(own.middle()) : own;
    }
    chart.over.set(static_cast<int>(i), variables);
  }
}

void Field::enter(Chart& chart, Lanes& lanes) {
  set_variables(chart, lanes);
  for (Lane& lane : lanes) {
    lane.rising.assign(mode_.size(), false);
    lane.roots.resize(mode_.size());
  }
  for (int j = 0; j < roots(); ++j) {
    const auto own = static_cast<std::size_t>(j);
    chart.over.run_square(j);
    sheet::IntervalBatch root;
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      const Interval& square = chart.over.square(j).lanes[l];
      lanes[l].outside = lanes[l].outside || square.upper() < 0;
      lanes[l].rising[own] = square.lower() <= 0;
      const Interval positive = square.upper() < 0 ? Interval(0.0) : square_root(square);
      lanes[l].roots[own] = root.lanes[l] = mode_[own] > 0 ? positive : -positive;
    }
    chart.over.set(3 + j, root);
  }
}

/// Leaves roots that may be 0 in the cell as variables.
void Field::reduce(const Chart& chart, const Lane& own, std::size_t lane, std::vector<Interval>& slopes) {
  Interval half;
  const auto half_inverse = [&](int j) -> const Interval* {
    if (own.rising[static_cast<std::size_t>(j)]) return nullptr;
    half = inverse(Interval(2.0) * chart.over.root(j).lanes[lane]);
    return &half;
  };
  sheet::eliminate_roots(slopes, 3, half_inverse,
                         [&](int j, int v) { return chart.over.square_partial(j, v).lanes[lane]; });
}

/// Slopes over the cell, of the three coordinates and of the roots that may be 0 in it: these count as coordinates of
/// their own, for as functions of the others they rise without bound. Mean-value form over all of them:
///     f(X, S) within f(m, s_m) + sum f_x (X - m) + sum f_s (S - s_m)
void Field::differentiate(Chart& chart, Lanes& lanes) {
  chart.over.run_gradients();
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    std::vector<Interval>& slopes = lanes[l].slopes;
    slopes.resize(static_cast<std::size_t>(chart.program.variables()));
    for (std::size_t v = 0; v < slopes.size(); ++v) slopes[v] = chart.over.partial(0, static_cast<int>(v)).lanes[l];
    reduce(chart, lanes[l], l, slopes);
  }
}

/// Mean-value form over the coordinates and the roots that may be 0: see differentiate.
void Field::take_mean_values(Chart& chart, Lanes& lanes) {
  std::vector<Interval> away(lanes.size(), Interval(0.0));
  for (std::size_t l = 0; l < lanes.size(); ++l)
    for (std::size_t i = 0; i < 3; ++i) {
      const Interval& variable = lanes[l].variables[i];
      away[l] = away[l] + lanes[l].slopes[i] * (variable - Interval(variable.middle()));
    }
  set_variables(chart, lanes, true);
  for (int j = 0; j < roots(); ++j) {
    const auto own = static_cast<std::size_t>(j);
    chart.over.run_square(j);
    sheet::IntervalBatch root;
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      const Lane& lane = lanes[l];
      if (lane.rising[own]) {
        const Interval middle = lane.roots[own].middle();
        away[l] = away[l] + lane.slopes[3 + own] * (lane.roots[own] - middle);
        root.lanes[l] = middle;
        continue;
      }
      const Interval& square = chart.over.square(j).lanes[l];
      const Interval positive = square.upper() < 0 ? Interval(0.0) : square_root(square);
      root.lanes[l] = mode_[own] > 0 ? positive : -positive;
    }
    chart.over.set(3 + j, root);
  }
  chart.over.run_values();
  for (std::size_t l = 0; l < lanes.size(); ++l) lanes[l].mean_value = chart.over.value(0).lanes[l] + away[l];
}

std::vector<Proof> Field::examine(const std::vector<Box>& units) {
  std::vector<Box> places;
  for (const Box& unit : units) places.push_back(place_of(unit));
  std::vector<Proof> result(units.size(), Proof{.outside = true, .zero_free = true, .one_sheet = true, .rim = false});
  std::vector<int> common(units.size(), 0);  // sign that the function is proven to have in the charts so far
  for (const auto& chart : charts_) {
    for (Lanes& lanes : lanes_of(*chart, places)) {
      std::vector<int> signs;
      const std::vector<Proof> proofs = examine(*chart, lanes, signs);
      for (std::size_t l = 0; l < lanes.size(); ++l) {
        if (proofs[l].outside) continue;
        const std::size_t box = lanes[l].box;
        Proof& whole = result[box];
        whole.outside = false;
        whole.zero_free = whole.zero_free && proofs[l].zero_free && (common[box] == 0 || signs[l] == common[box]);
        whole.one_sheet = whole.one_sheet && proofs[l].one_sheet;
        whole.rim = whole.rim || proofs[l].rim;
        if (signs[l] != 0) common[box] = signs[l];
      }
    }
  }
  return result;
}

std::vector<Proof> Field::examine(Chart& chart, Lanes& lanes, std::vector<int>& signs) {
  enter(chart, lanes);
  chart.over.run_values();
  std::vector<Proof> proofs(lanes.size());
  signs.assign(lanes.size(), 0);
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    if (!lanes[l].outside) signs[l] = chart.sign * chart.over.value(0).lanes[l].sign();
    proofs[l].outside = lanes[l].outside;
    proofs[l].zero_free = lanes[l].outside || signs[l] != 0;
  }
  if (std::all_of(proofs.begin(), proofs.end(), [](const Proof& proof) { return proof.zero_free; })) return proofs;

  differentiate(chart, lanes);
  take_mean_values(chart, lanes);
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    if (proofs[l].zero_free) continue;
    const Lane& lane = lanes[l];
    Interval product = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Interval scaled = by_unit(i, lane.slopes[i], lane.variables[i]);
      product = product + scaled * scaled;
    }
    for (std::size_t j = 0; j < mode_.size(); ++j) {
      const Interval& slope = lane.slopes[3 + j];
      proofs[l].rim = proofs[l].rim || (lane.rising[j] && !is_zero(slope));
    }
    proofs[l].one_sheet = !proofs[l].rim && product.lower() > 0;
    signs[l] = chart.sign * lane.mean_value.sign();
    proofs[l].zero_free = signs[l] != 0;
  }
  return proofs;
}

void Field::enter_with_beyond(Chart& chart, Lanes& lanes) {
  set_variables(chart, lanes);
  for (Lane& lane : lanes) {
    lane.rising.assign(mode_.size(), false);
    lane.roots.resize(mode_.size());
  }
  const auto root_at = [](double square) {
    const Interval size = square_root(Interval(std::abs(square)));
    return square < 0 ? -size : size;
  };
  for (int j = 0; j < roots(); ++j) {
    const auto own = static_cast<std::size_t>(j);
    chart.over.run_square(j);
    sheet::IntervalBatch root;
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      const Interval& square = chart.over.square(j).lanes[l];
      lanes[l].rising[own] = square.lower() <= 0;
      const Interval reached = hull(root_at(square.lower()), root_at(square.upper()));
      root.lanes[l] = mode_[own] > 0 ? reached : -reached;
      // Slopes are taken on the way from 0.
      const Interval from_none = lanes[l].rising[own] ? hull(reached, Interval(0.0)) : reached;
      lanes[l].roots[own] = mode_[own] > 0 ? from_none : -from_none;
    }
    chart.over.set(3 + j, root);
  }
}

Interval Field::by_unit(std::size_t i, const Interval& slope, const Interval& variable) const {
  const Interval scaled = slope * (Interval(frame_.upper[i]) - Interval(frame_.lower[i]));
  return frame_.angle[i] ? scaled * (Interval(1.0) + squared(variable)) * Interval(0.5) : scaled;
}

Vector Field::by_unit(const Vector& slopes, const Box& variables, double times) const {
  Vector result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = Interval(times) * by_unit(i, slopes[i], variables[i]);
  return result;
}

namespace {

/// `along`: of slopes, their part along a vector.
template <class Along>
bool is_rising(const Field::Over& f, const Along& along) {
  if (!f.known) return false;
  const Interval even = along(f.gradient);
  if (!f.steep) return even.lower() > 0;
  const double least = along(*f.steep).lower();
  return least > 0 && (even + Interval(least) * inverse(Interval(2.0) * Interval(f.reach))).lower() > 0;
}

}  // namespace

bool Field::Over::rises(const Vector& way) const {
  return is_rising(*this, [&](const Vector& slopes) { return product(slopes, way); });
}

bool Field::Over::rises_across(const Vector& normal, const Vector& way) const {
  const Vector turn = cross_product(way, normal);
  return is_rising(*this, [&](const Vector& slopes) { return product(cross_product(slopes, normal), turn); });
}

std::vector<std::vector<Field::Over>> Field::over(const std::vector<Box>& units, const std::vector<int>& signs) {
  std::vector<Box> places;
  for (const Box& unit : units) places.push_back(place_of(unit));
  std::vector<std::vector<Over>> result(units.size());
  for (const auto& chart : charts_)
    for (Lanes& lanes : lanes_of(*chart, places)) {
      for (Lane& lane : lanes) lane.sign = signs.empty() ? 0 : signs[lane.box];
      std::vector<Over> overs = over(*chart, lanes);
      for (std::size_t l = 0; l < lanes.size(); ++l) result[lanes[l].box].push_back(std::move(overs[l]));
    }
  return result;
}

std::vector<bool> Field::keeps_signs(const std::vector<Box>& units, const std::vector<int>& signs) {
  std::vector<Box> places;
  for (const Box& unit : units) places.push_back(place_of(unit));
  std::vector<bool> result(units.size(), true);
  for (const auto& chart : charts_)
    for (Lanes& lanes : lanes_of(*chart, places)) {
      enter_with_beyond(*chart, lanes);
      chart->over.run_values();
      for (std::size_t l = 0; l < lanes.size(); ++l) {
        const int own = chart->sign * chart->over.value(0).lanes[l].sign();
        if (own != signs[lanes[l].box]) result[lanes[l].box] = false;
      }
    }
  return result;
}

std::vector<Interval> Field::squares_over(const std::vector<Box>& units, int root) {
  std::vector<Box> places;
  for (const Box& unit : units) places.push_back(place_of(unit));
  std::vector<std::optional<Interval>> known(units.size());
  for (const auto& chart : charts_)
    for (Lanes& lanes : lanes_of(*chart, places)) {
      enter_with_beyond(*chart, lanes);
      for (std::size_t l = 0; l < lanes.size(); ++l) {
        std::optional<Interval>& whole = known[lanes[l].box];
        const Interval& own = chart->over.square(root).lanes[l];
        whole = whole ? hull(*whole, own) : own;
      }
    }
  std::vector<Interval> result;
  for (const std::optional<Interval>& own : known) {
    core::ensure(own.has_value(), "a box of the cube meets a chart");
    result.push_back(*own);
  }
  return result;
}

std::vector<Field::Over> Field::over(Chart& chart, Lanes& lanes) {
  const auto any_rising = [](const Lane& lane) {
    return std::find(lane.rising.begin(), lane.rising.end(), true) != lane.rising.end();
  };
  enter_with_beyond(chart, lanes);
  chart.over.run_values();
  std::vector<Over> overs(lanes.size());
  for (std::size_t l = 0; l < lanes.size(); ++l) overs[l].value = Interval(chart.sign) * chart.over.value(0).lanes[l];
  if (std::any_of(lanes.begin(), lanes.end(), any_rising)) {
    set_roots(chart, lanes, false);
    chart.over.run_values();
  }
  differentiate(chart, lanes);
  for (std::size_t l = 0; l < lanes.size(); ++l) take_slopes(chart, lanes, l, overs[l]);
  const auto is_open = [](const Over& own) { return own.value.sign() == 0; };
  if (std::any_of(overs.begin(), overs.end(), is_open)) {
    take_mean_values(chart, lanes);
    for (std::size_t l = 0; l < lanes.size(); ++l)
      if (is_open(overs[l])) overs[l].value = meet(overs[l].value, Interval(chart.sign) * lanes[l].mean_value);
  }
  for (std::size_t l = 0; l < lanes.size(); ++l)
    if (lanes[l].sign != 0 && overs[l].value.sign() == lanes[l].sign && any_rising(lanes[l])) overs[l].known = false;
  add_held_clips(chart, lanes, overs);
  narrow_clips(chart, lanes, overs);
  return overs;
}

void Field::set_roots(Chart& chart, const Lanes& lanes, bool held) {
  for (int j = 0; j < roots(); ++j) {
    const auto own = static_cast<std::size_t>(j);
    chart.over.run_square(j);
    sheet::IntervalBatch root;
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      const Lane& lane = lanes[l];
      if (held && j == lane.steep)
        root.lanes[l] = Interval(0.0);
      else if (lane.rising[own])
        root.lanes[l] = lane.roots[own];
      else
        root.lanes[l] =
            mode_[own] > 0 ? square_root(chart.over.square(j).lanes[l]) : -square_root(chart.over.square(j).lanes[l]);
    }
    chart.over.set(3 + j, root);
  }
}

void Field::take_slopes(const Chart& chart, Lanes& lanes, std::size_t lane, Over& own) const {
  Lane& at = lanes[lane];
  for (int j = 0; j < roots(); ++j) {
    const auto root = static_cast<std::size_t>(j);
    if (!at.rising[root] || is_zero(at.slopes[3 + root])) continue;
    own.known = own.known && at.steep < 0;
    at.steep = j;
  }
  if (!own.known) return;
  own.gradient = by_unit({at.slopes[0], at.slopes[1], at.slopes[2]}, at.variables, chart.sign);
  if (at.steep >= 0) {
    const auto j = static_cast<std::size_t>(at.steep);
    const std::optional<Vector> square = square_slopes(chart, lanes, lane, at.steep);
    // The sign by which its clip is multiplied has to be known.
    own.known = square.has_value() && at.slopes[3 + j].sign() != 0;
    if (!own.known) return;
    own.steep = by_unit(*square, at.variables, chart.sign * mode_[j]);
    for (Interval& slope : *own.steep) slope = slope * at.slopes[3 + j];
    own.reach = at.roots[j].magnitude();
  }
  for (int j = 0; j < roots(); ++j) {
    if (!at.rising[static_cast<std::size_t>(j)] || j == lies_on_ || j == at.steep) continue;
    const std::optional<Vector> square = square_slopes(chart, lanes, lane, j);
    own.known = own.known && square.has_value();
    if (!own.known) return;
    at.clip_slopes.push_back(*square);
    own.clips.push_back({j, false, chart.over.square(j).lanes[lane], by_unit(*square, at.variables, 1)});
  }
}

void Field::add_held_clips(Chart& chart, Lanes& lanes, std::vector<Over>& overs) {
  std::vector<std::size_t> steep;
  std::vector<int> times(lanes.size(), 0);
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    if (!overs[l].known || lanes[l].steep < 0) continue;
    const auto j = static_cast<std::size_t>(lanes[l].steep);
    times[l] = -mode_[j] * lanes[l].slopes[3 + j].sign();
    steep.push_back(l);
  }
  if (steep.empty()) return;
  set_variables(chart, lanes);
  set_roots(chart, lanes, true);
  chart.over.run_values();
  differentiate(chart, lanes);
  for (const std::size_t l : steep) {
    Lane& lane = lanes[l];
    for (int j = 0; j < roots(); ++j) {
      const auto own = static_cast<std::size_t>(j);
      if (j != lane.steep && lane.rising[own] && !is_zero(lane.slopes[3 + own])) overs[l].known = false;
    }
    if (!overs[l].known) continue;
    lane.clip_slopes.push_back({lane.slopes[0], lane.slopes[1], lane.slopes[2]});
    overs[l].clips.push_back({lane.steep, true, Interval(times[l]) * chart.over.value(0).lanes[l],
                              by_unit(lane.clip_slopes.back(), lane.variables, times[l])});
    overs[l].clips.back().times = times[l];
  }
}

/// By mean-value forms.
void Field::narrow_clips(Chart& chart, const Lanes& lanes, std::vector<Over>& overs) {
  const auto has_clips = [](const Over& own) { return own.known && !own.clips.empty(); };
  if (std::none_of(overs.begin(), overs.end(), has_clips)) return;
  set_variables(chart, lanes, true);
  set_roots(chart, lanes, true);
  chart.over.run_values();
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    if (!has_clips(overs[l])) continue;
    for (std::size_t c = 0; c < overs[l].clips.size(); ++c) {
      Clip& clip = overs[l].clips[c];
      Interval value = clip.held ? chart.over.value(0).lanes[l] : chart.over.square(clip.root).lanes[l];
      for (std::size_t i = 0; i < 3; ++i) {
        const Interval& variable = lanes[l].variables[i];
        value = value + lanes[l].clip_slopes[c][i] * (variable - Interval(variable.middle()));
      }
      clip.value = meet(clip.value, Interval(clip.times) * value);
    }
  }
}

std::optional<Vector> Field::square_slopes(const Chart& chart, const Lanes& lanes, std::size_t lane, int root) const {
  std::vector<Interval> slopes;
  for (int v = 0; v < 3 + root; ++v) slopes.push_back(chart.over.square_partial(root, v).lanes[lane]);
  reduce(chart, lanes[lane], lane, slopes);
  for (int j = 0; j < root; ++j)
    if (lanes[lane].rising[static_cast<std::size_t>(j)] && !is_zero(slopes[static_cast<std::size_t>(j) + 3]))
      return std::nullopt;
  return Vector{slopes[0], slopes[1], slopes[2]};
}

}  // namespace clearloci::loci::surface
