#include "check/group_cell.hpp"

#include <algorithm>
#include <cmath>

#include "check/elimination.hpp"
#include "check/pose_values.hpp"

namespace clearloci::check {
namespace {

using mechanism::Group;

double size_of(const Interval& a) { return std::max(std::abs(a.lower()), std::abs(a.upper())); }

Interval between(double radius) { return {-radius, radius, cell_bits}; }

using Matrix = std::vector<std::vector<Interval>>;

/// g with its slopes, those by the pose first.
struct Equations {
  std::vector<Interval> middle;
  Matrix by_pose, by_unknown;
};

/// One group, over a cell of poses or at a pose.
class GroupAt {
 public:
  GroupAt(const Mechanism& m, const Group& group, const std::vector<int>& sides, const PoseVariables& variables,
          const Jet::Offsets& offsets, const std::vector<VectorOf<Jet>>& before)
      : m_(m), group_(group), sides_(sides), variables_(variables), offsets_(offsets), before_(before) {}

  std::size_t unknowns() const { return group_.count * mechanism::dimension(m_); }

  /// Over boxes of the unknowns, around `u`; nothing where a point before them cannot be placed.
  std::optional<Equations> at(const std::vector<Interval>& u, const std::vector<Interval>& around) const {
    Jet::Offsets longer = offsets_;
    longer.insert(longer.end(), around.begin(), around.end());
    PoseVariables variables = variables_;
    for (Jet& value : variables.values) value = value.over(longer);
    std::vector<VectorOf<Jet>> places;
    for (const VectorOf<Jet>& jet : before_)
      places.push_back({jet[0].over(longer), jet[1].over(longer), jet[2].over(longer)});
    std::size_t k = 0;
    for (std::size_t i = 0; i < group_.count; ++i) {
      places.emplace_back();
      for (std::size_t c = 0; c < mechanism::dimension(m_); ++c, ++k) {
        std::vector<Interval> slopes(longer.size(), Interval(cell_bits));
        slopes[offsets_.size() + k] = Interval(1.0, cell_bits);
        places.back()[c] = Jet(u[k] + around[k], u[k], std::move(slopes), longer);
      }
    }
    const PosePosture posture =
        first_points_over(m_, static_cast<std::size_t>(group_.last) + 1, sides_, variables, places);
    if (posture.stopped_by) return std::nullopt;
    return told(posture.points, Values<Jet>(m_, variables), longer.size());
  }

 private:
  Equations told(const std::vector<VectorOf<Jet>>& points, const Values<Jet>& values, std::size_t coordinates) const {
    const auto way = [&](mechanism::PointIndex to, mechanism::PointIndex from) {
      return points.at(static_cast<std::size_t>(to)) - points.at(static_cast<std::size_t>(from));
    };
    Equations result;
    const auto add = [&](const Jet& jet) {
      result.middle.push_back(jet.middle());
      std::vector<Interval> slopes = jet.slopes();
      slopes.resize(coordinates, Interval(cell_bits));
      const auto end = slopes.begin() + static_cast<std::ptrdiff_t>(offsets_.size());
      result.by_pose.emplace_back(slopes.begin(), end);
      result.by_unknown.emplace_back(end, slopes.end());
    };
    for (const Group::Distance& distance : group_.distances)
      add(square_of(way(distance.second, distance.first)) - squared(values.value(distance.length)));
    for (const Group::Line& line : group_.lines)
      add(cross(way(line.point, line.base), values.vector(line.along, points))[2]);
    return result;
  }

  const Mechanism& m_;
  const Group& group_;
  const std::vector<int>& sides_;
  const PoseVariables& variables_;
  const Jet::Offsets& offsets_;
  const std::vector<VectorOf<Jet>>& before_;
};

std::optional<Dense> inverse_of_middle(const Matrix& jacobian) {
  Dense middle;
  for (const std::vector<Interval>& row : jacobian) {
    middle.emplace_back();
    for (const Interval& interval : row) middle.back().push_back(interval.middle());
  }
  return inverse_of(std::move(middle));
}

Interval product(const std::vector<double>& row, const std::vector<Interval>& column) {
  Interval sum(cell_bits);
  for (std::size_t i = 0; i < row.size(); ++i) sum = sum + Interval(row[i], cell_bits) * column[i];
  return sum;
}

std::vector<Interval> column_of(const Matrix& matrix, std::size_t c) {
  std::vector<Interval> column;
  for (const std::vector<Interval>& row : matrix) column.push_back(row[c]);
  return column;
}

/// A zero of g at a pose, to the last bits; nothing where Newton's iteration leads nowhere.
std::optional<std::vector<Interval>> refined(const GroupAt& pose, std::span<const double> start) {
  std::vector<Interval> u;
  for (const double component : start) u.emplace_back(component, cell_bits);
  const std::vector<Interval> nothing(u.size(), Interval(cell_bits));
  double last = HUGE_VAL;
  constexpr int most = 60;
  constexpr double done = 0x1p-110;
  for (int i = 0; i < most; ++i) {
    const std::optional<Equations> equations = pose.at(u, nothing);
    const std::optional<Dense> inverse = equations ? inverse_of_middle(equations->by_unknown) : std::nullopt;
    if (!inverse) return std::nullopt;
    double step = 0, size = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      const Interval way = product((*inverse)[k], equations->middle);
      step = std::max(step, size_of(way));
      u[k] = middle_of(u[k] - way);
      size = std::max(size, size_of(u[k]));
    }
    if (!std::isfinite(step)) return std::nullopt;
    if (step <= done * size || (i > 8 && step >= 0.5 * last && step < 1e-24 * size)) return u;
    last = step;
  }
  return std::nullopt;
}

/// K and U - u_m by Krawczyk's operator, and the slopes of u.
struct Closed {
  std::vector<Interval> within, alone;
  Matrix slopes;
};

/// |u| of every solution of u = b + E u: d with |b| + |E| d <= d.
std::optional<std::vector<double>> bound_of(const std::vector<Interval>& b, const Matrix& e) {
  const std::size_t n = b.size();
  double most = 0;
  for (const Interval& interval : b) most = std::max(most, size_of(interval));
  std::vector<double> d(n, 0.0);
  constexpr int attempts = 200;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    bool holds = true;
    std::vector<double> next(n);
    for (std::size_t k = 0; k < n; ++k) {
      Interval sum(size_of(b[k]), cell_bits);
      for (std::size_t j = 0; j < n; ++j) sum = sum + Interval(size_of(e[k][j]), cell_bits) * Interval(d[j], cell_bits);
      if (!sum.is_finite()) return std::nullopt;
      holds = holds && sum.upper() <= d[k];
      next[k] = std::max(d[k], 1.001 * sum.upper() + 1e-6 * most);
    }
    if (holds) return d;
    d = std::move(next);
  }
  return std::nullopt;
}

/// b + E u.
std::vector<Interval> sum_of(const std::vector<Interval>& b, const Matrix& e, const std::vector<Interval>& u) {
  std::vector<Interval> sum = b;
  for (std::size_t k = 0; k < b.size(); ++k)
    for (std::size_t j = 0; j < u.size(); ++j) sum[k] = sum[k] + e[k][j] * u[j];
  return sum;
}

class Krawczyk {
 public:
  Krawczyk(const GroupAt& cell, const Jet::Offsets& offsets, const std::vector<Interval>& u, const Dense& inverse)
      : cell_(cell), offsets_(offsets), u_(u), inverse_(inverse), n_(u.size()) {}

  std::optional<Closed> run(std::vector<double>& spreads) {
    double size = 0;
    for (const Interval& interval : u_) size = std::max(size, size_of(interval));
    std::vector<double> radius(n_, 0x1p-105 * size);
    constexpr int attempts = 8;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      std::vector<Interval> around;
      for (const double component : radius) around.push_back(between(component));
      const std::optional<Equations> equations = cell_.at(u_, around);
      if (!equations) return std::nullopt;
      std::optional<Closed> result = step(*equations, around, spreads);
      if (result) return result;
      for (std::size_t k = 0; k < n_; ++k) {
        if (!(size_of(k_[k]) < size)) return std::nullopt;
        radius[k] = std::max(1.5 * size_of(k_[k]), radius[k]);
      }
    }
    return std::nullopt;
  }

 private:
  std::optional<Closed> step(const Equations& equations, const std::vector<Interval>& around,
                             std::vector<double>& spreads) {
    Matrix rest;
    for (std::size_t k = 0; k < n_; ++k) {
      rest.emplace_back();
      for (std::size_t j = 0; j < n_; ++j)
        rest.back().push_back(Interval(k == j ? 1.0 : 0.0, cell_bits) -
                              product(inverse_[k], column_of(equations.by_unknown, j)));
    }
    Matrix slopes(n_);
    k_.clear();
    bool inside_all = true;
    std::fill(spreads.begin(), spreads.end(), 0.0);
    for (std::size_t k = 0; k < n_; ++k) {
      Interval sum = -product(inverse_[k], equations.middle);
      for (std::size_t c = 0; c < offsets_.size(); ++c) {
        slopes[k].push_back(-product(inverse_[k], column_of(equations.by_pose, c)));
        const Interval way = slopes[k].back() * offsets_[c];
        sum = sum + way;
        spreads[c] += size_of(way);
      }
      for (std::size_t j = 0; j < n_; ++j) sum = sum + rest[k][j] * around[j];
      if (!sum.is_finite()) sum = between(HUGE_VAL);
      inside_all = inside_all && inside(sum, around[k]);
      k_.push_back(sum);
    }
    if (!inside_all) return std::nullopt;
    Closed closed{k_, around, Matrix(n_)};
    for (std::size_t c = 0; c < offsets_.size(); ++c) {
      const std::vector<Interval> first = column_of(slopes, c);
      const std::optional<std::vector<double>> d = bound_of(first, rest);
      if (!d) return std::nullopt;
      std::vector<Interval> by_c;
      for (const double most : *d) by_c.push_back(between(most));
      constexpr int times = 3;  // Y is an inverse to sixteen digits, so that each leaves a small part of the last
      for (int i = 0; i < times; ++i) by_c = sum_of(first, rest, by_c);
      for (std::size_t k = 0; k < n_; ++k) closed.slopes[k].push_back(by_c[k]);
    }
    return closed;
  }

  const GroupAt& cell_;
  const Jet::Offsets& offsets_;
  const std::vector<Interval>& u_;
  const Dense& inverse_;
  std::size_t n_;
  std::vector<Interval> k_;
};

/// The groups of a mechanism one after another, each over the places of those before.
class Closing {
 public:
  Closing(const Mechanism& m, const std::vector<int>& sides, const PoseVariables& variables,
          const Jet::Offsets& offsets)
      : m_(m), sides_(sides), variables_(variables), offsets_(offsets) {
    for (const Jet& value : variables.values) at_middle_.values.emplace_back(value.middle());
    at_middle_.names = variables.names;
  }

  bool add(const Group& group, std::span<const double> start, std::vector<double>& spreads) {
    const Jet::Offsets none;
    const GroupAt pose(m_, group, sides_, at_middle_, none, middles_),
        cell(m_, group, sides_, variables_, offsets_, result_.places);
    const std::optional<std::vector<Interval>> u = refined(pose, start);
    const std::vector<Interval> nothing(start.size(), Interval(cell_bits));
    const std::optional<Equations> there = u ? pose.at(*u, nothing) : std::nullopt;
    const std::optional<Dense> inverse = there ? inverse_of_middle(there->by_unknown) : std::nullopt;
    if (!inverse) return false;
    std::vector<double> no_spreads;
    const std::optional<Closed> middle = Krawczyk(pose, none, *u, *inverse).run(no_spreads);
    if (!middle) return false;
    const std::optional<Closed> all = Krawczyk(cell, offsets_, *u, *inverse).run(spreads);
    if (!all) return false;
    put(group, *u, *middle, *all);
    return true;
  }

  GroupCell result() { return std::move(result_); }

 private:
  void put(const Group& group, const std::vector<Interval>& u, const Closed& middle, const Closed& all) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < group.count; ++i) {
      result_.places.emplace_back();
      middles_.emplace_back();
      for (std::size_t c = 0; c < mechanism::dimension(m_); ++c, ++k) {
        result_.at_middle.push_back(u[k] + middle.within[k]);
        result_.alone.push_back(u[k] + all.alone[k]);
        result_.middle.push_back(u[k].middle());
        middles_.back()[c] = Jet(result_.at_middle.back());
        result_.places.back()[c] = offsets_.empty()
                                       ? Jet(result_.at_middle.back())
                                       : Jet(u[k] + all.within[k], result_.at_middle.back(), all.slopes[k], offsets_);
      }
    }
  }

  const Mechanism& m_;
  const std::vector<int>& sides_;
  const PoseVariables& variables_;
  const Jet::Offsets& offsets_;
  PoseVariables at_middle_;
  std::vector<VectorOf<Jet>> middles_;
  GroupCell result_;
};

}  // namespace

std::optional<GroupCell> closed_over(const mechanism::Mechanism& m, const std::vector<int>& sides,
                                     const PoseVariables& variables, const Jet::Offsets& offsets,
                                     std::vector<double> start, std::vector<double>& spreads) {
  Closing closing(m, sides, variables, offsets);
  std::span<const double> rest(start);
  for (const Group& group : m.groups) {
    const std::size_t count = group.count * mechanism::dimension(m);
    if (!closing.add(group, rest.first(count), spreads)) return std::nullopt;
    rest = rest.subspan(count);
  }
  return closing.result();
}

}  // namespace clearloci::check
