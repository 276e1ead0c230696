#include "loci/surfaces/field.hpp"

#include <algorithm>

namespace clearloci::loci::surface {
namespace {

using core::Interval;

/// Beyond rounding of tan and of multiples of pi.
constexpr double angle_rounding = 1e-14;

}  // namespace

Interval Field::Chart::variable_over(std::size_t i, const Interval& coordinate) const {
  const auto* chart = chart_of(*problem, i);
  if (chart == nullptr) return coordinate;
  // Beyond a half turn the tangent starts anew: the cell is cut to the chart first.
  const double from = core::parameter_at(**chart, std::max(coordinate.lower(), lower[i]));
  const double to = core::parameter_at(**chart, std::min(coordinate.upper(), upper[i]));
  return meet(Interval(from - angle_rounding, std::max(from, to) + angle_rounding),
              Interval(least[i] - angle_rounding, most[i] + angle_rounding));
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
      const Interval& variable = lanes[l].variables[i];
      variables.lanes[l] = middles ? Interval(variable.middle()) : variable;
    }
    chart.over.set(static_cast<int>(i), variables);
  }
}

void Field::begin(Chart& chart, Lanes& lanes) const {
  set_variables(chart, lanes);
  for (Lane& lane : lanes) {
    lane.rising.assign(mode_.size(), false);
    lane.roots.resize(mode_.size());
  }
}

void Field::enter(Chart& chart, Lanes& lanes) {
  begin(chart, lanes);
  for (int j = 0; j < roots(); ++j) {
    const auto root_index = static_cast<std::size_t>(j);
    chart.over.run_square(j);
    sheet::IntervalBatch root;
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      const Interval& square = chart.over.square(j).lanes[l];
      lanes[l].outside = lanes[l].outside || square.upper() < 0;
      lanes[l].rising[root_index] = square.lower() <= 0;
      const Interval positive = square.upper() < 0 ? Interval(0.0) : square_root(square);
      lanes[l].roots[root_index] = root.lanes[l] = mode_[root_index] > 0 ? positive : -positive;
    }
    chart.over.set(3 + j, root);
  }
}

/// Leaves roots that may be 0 in the cell as variables.
void Field::reduce(const Chart& chart, const Lane& lane_values, std::size_t lane, std::vector<Interval>& slopes) {
  Interval half;
  const auto half_inverse = [&](int j) -> const Interval* {
    if (lane_values.rising[static_cast<std::size_t>(j)]) return nullptr;
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
    const auto root_index = static_cast<std::size_t>(j);
    chart.over.run_square(j);
    sheet::IntervalBatch root;
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      const Lane& lane = lanes[l];
      if (lane.rising[root_index]) {
        const Interval middle = lane.roots[root_index].middle();
        away[l] = away[l] + lane.slopes[3 + root_index] * (lane.roots[root_index] - middle);
        root.lanes[l] = middle;
        continue;
      }
      const Interval& square = chart.over.square(j).lanes[l];
      const Interval positive = square.upper() < 0 ? Interval(0.0) : square_root(square);
      root.lanes[l] = mode_[root_index] > 0 ? positive : -positive;
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
      proofs[l].rim = proofs[l].rim || (lane.rising[j] && !sheet::is_zero(slope));
    }
    proofs[l].one_sheet = !proofs[l].rim && product.lower() > 0;
    signs[l] = chart.sign * lane.mean_value.sign();
    proofs[l].zero_free = signs[l] != 0;
  }
  return proofs;
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

std::vector<bool> Field::keeps_signs(const std::vector<Box>& units, const std::vector<int>& signs) {
  std::vector<Box> places;
  for (const Box& unit : units) places.push_back(place_of(unit));
  std::vector<bool> result(units.size(), true);
  for (const auto& chart : charts_)
    for (Lanes& lanes : lanes_of(*chart, places)) {
      enter_with_beyond(*chart, lanes);
      chart->over.run_values();
      for (std::size_t l = 0; l < lanes.size(); ++l) {
        const int sign = chart->sign * chart->over.value(0).lanes[l].sign();
        if (sign != signs[lanes[l].box]) result[lanes[l].box] = false;
      }
    }
  return result;
}

std::vector<Interval> Field::squares_over(const std::vector<Box>& units, int root) {
  std::vector<Box> places;
  for (const Box& unit : units) places.push_back(place_of(unit));
  std::vector<std::optional<Interval>> values(units.size());
  for (const auto& chart : charts_)
    for (Lanes& lanes : lanes_of(*chart, places)) {
      enter_with_beyond(*chart, lanes);
      for (std::size_t l = 0; l < lanes.size(); ++l) {
        std::optional<Interval>& whole = values[lanes[l].box];
        const Interval& lane = chart->over.square(root).lanes[l];
        whole = whole ? hull(*whole, lane) : lane;
      }
    }
  std::vector<Interval> result;
  for (const std::optional<Interval>& interval : values) {
    core::ensure(interval.has_value(), "a box of the cube meets a chart");
    result.push_back(*interval);
  }
  return result;
}

}  // namespace clearloci::loci::surface
