#include "check/group_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "check/certificate.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::check {
namespace {

std::vector<double> middle_of(const Cell& cell) {
  std::vector<double> middle;
  for (const auto& [low, high] : cell) middle.push_back(low + 0.5 * (high - low));
  return middle;
}

bool lie_in(const std::vector<Interval>& solution, const std::vector<Interval>& box) {
  for (std::size_t k = 0; k < box.size(); ++k)
    if (!contains(box[k], solution[k])) return false;
  return true;
}

/// Where they meet; nothing where they do not.
std::optional<Cell> common(const Cell& a, const Cell& b) {
  Cell both;
  for (std::size_t c = 0; c < a.size(); ++c) {
    both.push_back({std::max(a[c][0], b[c][0]), std::min(a[c][1], b[c][1])});
    if (both.back()[0] > both.back()[1]) return std::nullopt;
  }
  return both;
}

std::vector<double> doubles_of(const std::vector<Interval>& solution) {
  std::vector<double> all;
  for (const Interval& interval : solution) all.push_back(interval.middle());
  return all;
}

}  // namespace

PoseVariables variables_over(const std::vector<std::string>& names, const Cell& cell, Jet::Offsets& offsets) {
  PoseVariables variables{names, {}};
  std::vector<Interval> ranges;
  offsets.clear();
  for (const auto& side : cell) {
    ranges.emplace_back(side[0], side[1], cell_bits);
    offsets.push_back(ranges.back() - middle_of(ranges.back()));
  }
  for (std::size_t c = 0; c < cell.size(); ++c) variables.values.emplace_back(ranges[c], offsets, c);
  return variables;
}

GroupSheet::GroupSheet(const mechanism::Mechanism& m, const std::vector<int>& sides, std::vector<std::string> names,
                       const Cell& whole, const std::vector<double>& pose,
                       const std::function<bool(const Cell&)>& is_apart, const Deadline& deadline)
    : m_(m), sides_(sides), names_(std::move(names)) {
  for (const auto& [low, high] : whole) widths_.push_back(std::max(high - low, 1e-12));
  follow(pose);
  std::vector<double> at = middle_of(whole);
  std::copy(pose.begin(), pose.end(), at.begin());
  known_.emplace_back(std::move(at), doubles_of(at_pose_));
  cover(whole, is_apart, deadline);
  reach(pose);
  join(is_apart);
}

/// Along the straight way from the pose of the postures, t from 0 to 1.
void GroupSheet::follow(const std::vector<double>& pose) {
  std::vector<double> start;
  for (const mechanism::Group& group : m_.groups)
    for (const auto& place : group.near)
      for (std::size_t c = 0; c < mechanism::dimension(m_); ++c) start.push_back(place[c].get_d());
  const std::vector<std::string> names(names_.begin(), names_.begin() + static_cast<std::ptrdiff_t>(pose.size()));
  const auto over = [&](double from, double to, const std::vector<double>& near) {
    Jet::Offsets offsets;
    const Jet t = variables_over({"t"}, {{from, to}}, offsets).values.front();
    PoseVariables variables{names, {}};
    for (std::size_t c = 0; c < pose.size(); ++c) {
      const Interval first(m_.near.at(c), cell_bits), last(pose[c], cell_bits);
      variables.values.push_back(Jet(first) + t * Jet(last - first));
    }
    std::vector<double> spreads(1);
    std::optional<GroupCell> found = closed_over(m_, sides_, variables, offsets, near, spreads);
    if (found) found->places.clear();  // they point to the offsets
    return found;
  };
  const std::optional<GroupCell> first = over(0, 0, start);
  if (!first) throw FalseClaim("groups: that they close in their postures is not shown");
  std::vector<Interval> here = first->at_middle;
  double t = 0, step = 1;
  constexpr double least = 0x1p-30;
  while (t < 1) {
    const double next = std::min(1.0, t + step);
    const std::vector<double> near = doubles_of(here);
    const std::optional<GroupCell> cell = over(t, next, near);
    const std::optional<GroupCell> end =
        cell && lie_in(here, cell->alone) ? over(next, next, cell->middle) : std::nullopt;
    if (end && lie_in(end->at_middle, cell->alone)) {
      here = end->at_middle;
      t = next;
      step *= 2;
    } else if ((step *= 0.5) < least) {
      throw FalseClaim(
          "groups: that the straight way from the pose of their postures to the task has no dead centre is "
          "not shown");
    }
  }
  at_pose_ = std::move(here);
}

std::vector<double> GroupSheet::nearest(const std::vector<double>& at) const {
  const auto off = [&](const auto& candidate) {
    double sum = 0;
    for (std::size_t c = 0; c < at.size(); ++c) sum += std::pow((candidate.first[c] - at[c]) / widths_[c], 2);
    return sum;
  };
  return std::min_element(known_.begin(), known_.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); })
      ->second;
}

void GroupSheet::cover(const Cell& whole, const std::function<bool(const Cell&)>& is_apart, const Deadline& deadline) {
  constexpr std::size_t most = 20'000;
  covered(
      whole, names_, is_apart,
      [&](const Cell& cell, std::vector<double>& spreads) {
        Jet::Offsets offsets;
        const PoseVariables variables = variables_over(names_, cell, offsets);
        const std::vector<double> at = middle_of(cell);
        std::optional<GroupCell> groups = closed_over(m_, sides_, variables, offsets, nearest(at), spreads);
        if (!groups) return false;
        if (parts_.size() >= most) throw FalseClaim("groups: they are not shown to close with so few cells");
        groups->places.clear();
        known_.emplace_back(at, groups->middle);
        parts_.push_back({cell, std::move(*groups)});
        return true;
      },
      deadline);
}

/// The end of the way is a place of the parts that hold its pose.
void GroupSheet::reach(const std::vector<double>& pose) const {
  const bool found = std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) {
    for (std::size_t c = 0; c < names_.size(); ++c) {
      std::array<double, 2> range;
      if (c < pose.size()) {
        range = {pose[c], pose[c]};
      } else {
        range = around(std::find_if(m_.parameters.begin(), m_.parameters.end(), [&](const auto& parameter) {
                         return parameter.name == names_[c];
                       })->value);
      }
      if (range[0] < part.cell[c][0] || range[1] > part.cell[c][1]) return false;
    }
    return lie_in(at_pose_, part.groups.alone);
  });
  if (!found) throw FalseClaim("groups: that their assembly in the task is the one of their postures is not shown");
}

void GroupSheet::join(const std::function<bool(const Cell&)>& is_apart) const {
  for (std::size_t j = 0; j < parts_.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const std::optional<Cell> both = common(parts_[i].cell, parts_[j].cell);
      if (!both || is_apart(*both)) continue;
      Cell place;
      for (const double component : middle_of(*both)) place.push_back({component, component});
      Jet::Offsets offsets;
      const PoseVariables variables = variables_over(names_, place, offsets);
      std::vector<double> spreads(names_.size());
      const auto there = closed_over(m_, sides_, variables, offsets, parts_[i].groups.middle, spreads);
      if (!there || !lie_in(there->at_middle, parts_[i].groups.alone) ||
          !lie_in(there->at_middle, parts_[j].groups.alone))
        throw FalseClaim("groups: that their assembly is one all over the task is not shown");
    }
}

std::optional<GroupCell> GroupSheet::over(const Part& part, const PoseVariables& variables, const Jet::Offsets& offsets,
                                          std::vector<double>& spreads) const {
  std::optional<GroupCell> cell = closed_over(m_, sides_, variables, offsets, part.groups.middle, spreads);
  if (cell && !lie_in(cell->at_middle, part.groups.alone)) return std::nullopt;
  return cell;
}

}  // namespace clearloci::check
