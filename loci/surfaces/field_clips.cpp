#include "loci/surfaces/field.hpp"

#include <algorithm>

namespace clearloci::loci::surface {
namespace {

using core::Interval;

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

void Field::enter_with_beyond(Chart& chart, Lanes& lanes) {
  begin(chart, lanes);
  const auto root_at = [](double square) {
    const Interval size = square_root(Interval(std::abs(square)));
    return square < 0 ? -size : size;
  };
  for (int j = 0; j < roots(); ++j) {
    const auto root_index = static_cast<std::size_t>(j);
    chart.over.run_square(j);
    sheet::IntervalBatch root;
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      const Interval& square = chart.over.square(j).lanes[l];
      lanes[l].rising[root_index] = square.lower() <= 0;
      const Interval reached = hull(root_at(square.lower()), root_at(square.upper()));
      root.lanes[l] = mode_[root_index] > 0 ? reached : -reached;
      // Slopes are taken on the way from 0.
      const Interval from_none = lanes[l].rising[root_index] ? hull(reached, Interval(0.0)) : reached;
      lanes[l].roots[root_index] = mode_[root_index] > 0 ? from_none : -from_none;
    }
    chart.over.set(3 + j, root);
  }
}

void Field::set_roots(Chart& chart, const Lanes& lanes, bool held) {
  for (int j = 0; j < roots(); ++j) {
    const auto root_index = static_cast<std::size_t>(j);
    chart.over.run_square(j);
    sheet::IntervalBatch root;
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      const Lane& lane = lanes[l];
      if (held && j == lane.steep)
        root.lanes[l] = Interval(0.0);
      else if (lane.rising[root_index])
        root.lanes[l] = lane.roots[root_index];
      else
        root.lanes[l] = mode_[root_index] > 0 ? square_root(chart.over.square(j).lanes[l])
                                              : -square_root(chart.over.square(j).lanes[l]);
    }
    chart.over.set(3 + j, root);
  }
}

std::optional<Vector> Field::square_slopes(const Chart& chart, const Lanes& lanes, std::size_t lane, int root) const {
  std::vector<Interval> slopes;
  for (int v = 0; v < 3 + root; ++v) slopes.push_back(chart.over.square_partial(root, v).lanes[lane]);
  reduce(chart, lanes[lane], lane, slopes);
  for (int j = 0; j < root; ++j)
    if (lanes[lane].rising[static_cast<std::size_t>(j)] && !sheet::is_zero(slopes[static_cast<std::size_t>(j) + 3]))
      return std::nullopt;
  return Vector{slopes[0], slopes[1], slopes[2]};
}

void Field::take_slopes(const Chart& chart, Lanes& lanes, std::size_t lane, Over& over) const {
  Lane& at = lanes[lane];
  for (int j = 0; j < roots(); ++j) {
    const auto root = static_cast<std::size_t>(j);
    if (!at.rising[root] || sheet::is_zero(at.slopes[3 + root])) continue;
    over.known = over.known && at.steep < 0;
    at.steep = j;
  }
  if (!over.known) return;
  over.gradient = by_unit({at.slopes[0], at.slopes[1], at.slopes[2]}, at.variables, chart.sign);
  if (at.steep >= 0) {
    const auto j = static_cast<std::size_t>(at.steep);
    const std::optional<Vector> square = square_slopes(chart, lanes, lane, at.steep);
    // The sign by which its clip is multiplied has to be known.
    over.known = square.has_value() && at.slopes[3 + j].sign() != 0;
    if (!over.known) return;
    over.steep = by_unit(*square, at.variables, chart.sign * mode_[j]);
    for (Interval& slope : *over.steep) slope = slope * at.slopes[3 + j];
    over.reach = at.roots[j].magnitude();
  }
  for (int j = 0; j < roots(); ++j) {
    if (!at.rising[static_cast<std::size_t>(j)] || j == lies_on_ || j == at.steep) continue;
    const std::optional<Vector> square = square_slopes(chart, lanes, lane, j);
    over.known = over.known && square.has_value();
    if (!over.known) return;
    at.clip_slopes.push_back(*square);
    over.clips.push_back({j, false, chart.over.square(j).lanes[lane], by_unit(*square, at.variables, 1)});
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
      const auto root_index = static_cast<std::size_t>(j);
      if (j != lane.steep && lane.rising[root_index] && !sheet::is_zero(lane.slopes[3 + root_index]))
        overs[l].known = false;
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
  const auto has_clips = [](const Over& over) { return over.known && !over.clips.empty(); };
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
  const auto is_open = [](const Over& over) { return over.value.sign() == 0; };
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

}  // namespace clearloci::loci::surface
