#include "numeric/turns.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "mechanism/joint_traits.hpp"

namespace clearloci::numeric {
namespace {

using core::LocusMap;
using core::Quantity;

/// Two directions that differ by less are taken for neighbours without a turn between them.
constexpr double least_turn = 0.6;
/// Halvings of an edge along which a direction is followed.
constexpr int most_halvings = 12;
/// Of the box: how far a zero is from the rim of a face for certain to lie in it; and chords are off by the tolerance.
constexpr double least_clear = 1e-9, chords = 4;

/// What |A| times a force points to, in two directions; and which sign |A| has.
struct Direction {
  bool reachable = false, decided = false;
  int determinant = 0;
  double first = 0, second = 0;

  bool known() const { return reachable && decided && determinant != 0; }
};

/// The directions of a joint's force at the nodes of a grid, and how far it turns along the edges between them.
class TurnGrid {
 public:
  TurnGrid(const NumericModel& model, std::span<const int> sides, std::span<const GridAxis> axes,
           const WitnessColumns& columns)
      : model_(model), sides_(sides), axes_(axes), columns_(columns) {
    std::size_t count = 1;
    for (const GridAxis& axis : axes) {
      strides_.push_back(count);
      count *= static_cast<std::size_t>(axis.nodes);
    }
    nodes_.resize(count);
    choose_reference();
  }

  /// Of a node. Nodes may be entered side by side.
  void enter(std::size_t node, const BoundedNumerators& there) { nodes_[node] = direction(there); }

  /// Once all nodes are known.
  void follow_edges() {
    turns_.assign(axes_.size(), std::vector<double>(count(), std::numeric_limits<double>::quiet_NaN()));
    for (std::size_t c = 0; c < axes_.size(); ++c)
      tbb::parallel_for(std::size_t{0}, count(), [&](std::size_t node) {
        if (index(node, c) + 1 >= axes_[c].nodes) return;
        const std::size_t next = node + strides_[c];
        turns_[c][node] = turn(place(node), place(next), nodes_[node], nodes_[next], 0);
      });
  }

  std::size_t count() const { return nodes_.size(); }
  std::size_t stride(std::size_t axis) const { return strides_[axis]; }
  int index(std::size_t node, std::size_t axis) const {
    return static_cast<int>(node / strides_[axis]) % axes_[axis].nodes;
  }
  const Direction& at(std::size_t node) const { return nodes_[node]; }
  std::vector<double> place(std::size_t node) const {
    std::vector<double> pose;
    for (std::size_t c = 0; c < axes_.size(); ++c) pose.push_back(axes_[c].at(index(node, c)));
    return pose;
  }
  bool any_decided() const {
    return std::any_of(nodes_.begin(), nodes_.end(), [](const Direction& direction) { return direction.decided; });
  }

  /// Full turns round the face from a node on along two axes; NaN where they cannot be counted.
  double turns_round(std::size_t node, std::size_t p, std::size_t q) const {
    const double sum =
        turns_[p][node] + turns_[q][node + strides_[p]] - turns_[p][node + strides_[q]] - turns_[q][node];
    return std::round(sum / (2 * std::numbers::pi));
  }

 private:
  /// The Cartesian direction that the axis of a pin is farthest from: its part across the axis is one of the two.
  void choose_reference() {
    if (columns_.pin < 0) return;
    std::array<double, 3> most{};
    constexpr std::size_t samples = 64;
    for (std::size_t k = 0; k < samples; ++k) {
      const BoundedNumerators numerators = bounded_numerators(model_, place(k * nodes_.size() / samples), sides_);
      if (numerators.axes.empty()) continue;
      for (std::size_t c = 0; c < 3; ++c)
        most[c] = std::max(most[c], std::abs(numerators.axes[static_cast<std::size_t>(columns_.pin)][c].value));
    }
    reference_ = static_cast<std::size_t>(std::min_element(most.begin(), most.end()) - most.begin());
  }

  Direction direction(const BoundedNumerators& numerators) const {
    Direction result;
    result.reachable = numerators.reachable;
    if (!numerators.reachable) return result;
    const double d = numerators.determinant.value;
    result.determinant = std::abs(d) > numerators.determinant.error ? (d > 0 ? 1 : -1) : 0;
    result.decided = is_decided(numerators, columns_);
    const std::array<Bounded, 3> force = components(numerators, columns_);
    if (columns_.pin < 0) {
      result.first = force[0].value;
      result.second = force[1].value;
      return result;
    }
    // u x f, along e x u and u x (e x u) = e - u (u . e).
    const auto& axis = numerators.axes[static_cast<std::size_t>(columns_.pin)];
    const Vector3d u(axis[0].value, axis[1].value, axis[2].value);
    const Vector3d f(force[0].value, force[1].value, force[2].value);
    const Vector3d e = Vector3d::Unit(static_cast<Eigen::Index>(reference_));
    result.first = f.dot(e.cross(u));
    result.second = f.dot(e - u.dot(e) * u);
    return result;
  }

  double turn(const std::vector<double>& from, const std::vector<double>& to, const Direction& a, const Direction& b,
              int halvings) const {
    if (!a.known() || !b.known() || a.determinant != b.determinant || halvings > most_halvings)
      return std::numeric_limits<double>::quiet_NaN();
    const double angle = std::atan2(a.first * b.second - a.second * b.first, a.first * b.first + a.second * b.second);
    if (std::abs(angle) < least_turn) return angle;
    std::vector<double> middle;
    for (std::size_t c = 0; c < from.size(); ++c) middle.push_back((from[c] + to[c]) / 2);
    const Direction between = direction(bounded_numerators(model_, middle, sides_));
    return turn(from, middle, a, between, halvings + 1) + turn(middle, to, between, b, halvings + 1);
  }

  const NumericModel& model_;
  std::span<const int> sides_;
  std::span<const GridAxis> axes_;
  WitnessColumns columns_;
  std::size_t reference_ = 0;
  std::vector<std::size_t> strides_;
  std::vector<Direction> nodes_;
  std::vector<std::vector<double>> turns_;  ///< by axis, from every node to the next
};

bool loses_contact(const std::vector<core::Vanishing>& vanishing, const std::string& joint) {
  return std::any_of(vanishing.begin(), vanishing.end(),
                     [&](const core::Vanishing& v) { return v.joint == joint && v.quantity == Quantity::f; });
}

/// The traced zeros on the faces of the grid.
class ClaimedZeros {
 public:
  struct Claim {
    int crossings = 0;
    bool doubtful = false;  ///< some zero is next to the rim
  };

  ClaimedZeros(const TurnGrid& grid, std::span<const GridAxis> axes, const LocusMap& map) : grid_(grid), axes_(axes) {
    for (const GridAxis& axis : axes) clear_.push_back(least_clear * axis.step * axis.nodes + chords * map.tolerance);
  }

  void add(const core::SpaceArc& arc) {
    for (std::size_t i = 1; i < arc.points.size(); ++i)
      for (std::size_t normal = 0; normal < 3; ++normal) add(arc.points[i - 1], arc.points[i], normal);
  }

  /// On the faces along axes p and q through node `plane` of the third.
  void add(std::span<const double> at, std::size_t p, std::size_t q, std::size_t plane) {
    const auto cell = [&](std::size_t c, double value) {
      return static_cast<int>(std::floor((value - axes_[c].origin) / axes_[c].step));
    };
    const int i = cell(p, at[p]), j = cell(q, at[q]);
    bool alone = true;
    for (const int a : {-1, 1})
      for (const int b : {-1, 1}) {
        const int own_i = cell(p, at[p] + a * clear_[p]), own_j = cell(q, at[q] + b * clear_[q]);
        if (own_i == i && own_j == j) continue;
        alone = false;
        if (Claim* made = claim(own_i, own_j, p, q, plane)) made->doubtful = true;
      }
    if (Claim* made = claim(i, j, p, q, plane)) {
      ++made->crossings;
      made->doubtful = made->doubtful || !alone;
    }
  }

  /// Over two coordinates: zeros may be anywhere in the box.
  void leave_open(std::span<const double> lower, std::span<const double> upper) {
    std::array<int, 2> first{}, last{};
    for (std::size_t c = 0; c < 2; ++c) {
      first[c] = static_cast<int>(std::floor((lower[c] - clear_[c] - axes_[c].origin) / axes_[c].step));
      last[c] = static_cast<int>(std::floor((upper[c] + clear_[c] - axes_[c].origin) / axes_[c].step));
      first[c] = std::max(first[c], 0);
      last[c] = std::min(last[c], axes_[c].nodes - 2);
    }
    for (int i = first[0]; i <= last[0]; ++i)
      for (int j = first[1]; j <= last[1]; ++j)
        if (Claim* made = claim(i, j, 0, 1, 0)) made->doubtful = true;
  }

  Claim of(std::size_t node, std::size_t p, std::size_t q) const {
    const auto found = claims_.find({p, q, node});
    return found == claims_.end() ? Claim{} : found->second;
  }

 private:
  void add(const core::Point3& a, const core::Point3& b, std::size_t normal) {
    const GridAxis& axis = axes_[normal];
    const auto [low, high] = std::minmax(a[normal], b[normal]);
    const int first = std::max(0, static_cast<int>(std::ceil((low - axis.origin) / axis.step)));
    for (int node = first; node < axis.nodes && axis.at(node) < high; ++node) {
      const double part = (axis.at(node) - a[normal]) / (b[normal] - a[normal]);
      core::Point3 at{};
      for (std::size_t c = 0; c < 3; ++c) at[c] = a[c] + part * (b[c] - a[c]);
      const std::size_t p = normal == 0 ? 1 : 0, q = normal == 2 ? 1 : 2;
      add(at, p, q, static_cast<std::size_t>(node) * grid_.stride(normal));
    }
  }

  Claim* claim(int i, int j, std::size_t p, std::size_t q, std::size_t plane) {
    if (i < 0 || j < 0 || i + 1 >= axes_[p].nodes || j + 1 >= axes_[q].nodes) return nullptr;
    const std::size_t node =
        plane + static_cast<std::size_t>(i) * grid_.stride(p) + static_cast<std::size_t>(j) * grid_.stride(q);
    return &claims_[{p, q, node}];
  }

  const TurnGrid& grid_;
  std::span<const GridAxis> axes_;
  std::vector<double> clear_;
  std::map<std::array<std::size_t, 3>, Claim> claims_;  ///< by axes and first node
};

/// Of one face.
Outcome judged(const TurnGrid& grid, std::size_t node, std::size_t p, std::size_t q, const ClaimedZeros::Claim& claim) {
  const std::array<std::size_t, 4> corners = {node, node + grid.stride(p), node + grid.stride(q),
                                              node + grid.stride(p) + grid.stride(q)};
  if (claim.crossings == 0 &&
      std::none_of(corners.begin(), corners.end(), [&](std::size_t corner) { return grid.at(corner).reachable; }))
    return Outcome::outside;
  const double turns = grid.turns_round(node, p, q);
  if (claim.doubtful || std::isnan(turns)) return Outcome::undecided;
  return (std::lround(std::abs(turns)) % 2 == 1) == (claim.crossings % 2 == 1) ? Outcome::held : Outcome::disputed;
}

void judge_joint(const TurnGrid& grid, std::span<const GridAxis> axes, const LocusMap& map,
                 const core::WorkingMode& mode, const std::string& joint, std::size_t listed,
                 ValidationReport& report) {
  const TracedReaction reaction{joint, Quantity::f};
  ClaimedZeros claims(grid, axes, map);
  for (const core::SpaceCurve& curve : map.space_curves)
    if (curve.mode == mode && loses_contact(curve.vanishing, joint))
      for (const core::SpaceArc& arc : curve.arcs) claims.add(arc);
  if (axes.size() == 2) {
    for (const core::IsolatedPoint& point : map.isolated_points)
      if (point.mode == mode && loses_contact(point.vanishing, joint)) claims.add(point.at, 0, 1, 0);
    for (const core::OpenRegion& region : map.open)
      if (region.point && region.mode == mode && loses_contact(region.vanishing, joint))
        claims.leave_open(region.lower, region.upper);
  }
  std::array<std::size_t, 4> counts{};
  for (std::size_t p = 0; p < axes.size(); ++p)
    for (std::size_t q = p + 1; q < axes.size(); ++q)
      for (std::size_t node = 0; node < grid.count(); ++node) {
        if (grid.index(node, p) + 1 >= axes[p].nodes || grid.index(node, q) + 1 >= axes[q].nodes) continue;
        const ClaimedZeros::Claim claim = claims.of(node, p, q);
        const Outcome outcome = judged(grid, node, p, q, claim);
        ++counts[static_cast<std::size_t>(outcome)];
        if (outcome == Outcome::disputed && report.disputed_edges.size() < listed)
          report.disputed_edges.push_back({grid.place(node), grid.place(node + grid.stride(p) + grid.stride(q)), mode,
                                           reaction, claim.crossings, claim.crossings % 2 == 0});
      }
  add_tally(report, mode, reaction, counts, false);
}

/// The joint has a force of two components, each of which was traced. Over two coordinates only where f itself was
/// asked for: in the plane the components' edges tell.
bool may_be_judged(const NumericModel& model, const std::vector<TracedReaction>& traced,
                   const mechanism::Joint& joint) {
  const std::vector<Quantity> parts = mechanism::force_components(model.mechanism, joint);
  const auto is_traced = [&](Quantity quantity) {
    return std::find(traced.begin(), traced.end(), TracedReaction{joint.name, quantity}) != traced.end();
  };
  if (parts.size() != 2 || model.box.size() < 2) return false;
  return is_traced(Quantity::f) || (model.box.size() == 3 && std::all_of(parts.begin(), parts.end(), is_traced));
}

}  // namespace

std::vector<std::string> joints_of_turns(const NumericModel& model, const LocusMap& map, const core::WorkingMode& mode,
                                         const std::vector<TracedReaction>& traced) {
  const auto lost_along = [&](const std::string& joint, const auto& loci) {
    return std::any_of(loci.begin(), loci.end(),
                       [&](const auto& locus) { return locus.mode == mode && loses_contact(locus.vanishing, joint); });
  };
  std::vector<std::string> joints;
  for (const mechanism::Joint& joint : model.mechanism.joints)
    if (may_be_judged(model, traced, joint) && !lost_along(joint.name, map.curves) &&
        !lost_along(joint.name, map.surfaces))
      joints.push_back(joint.name);
  return joints;
}

void judge_turns(const NumericModel& model, std::span<const int> sides, const LocusMap& map,
                 const core::WorkingMode& mode, std::span<const GridAxis> axes, const std::vector<std::string>& joints,
                 std::size_t listed, ValidationReport& report) {
  std::vector<TurnGrid> grids;
  grids.reserve(joints.size());
  for (const std::string& joint : joints)
    grids.emplace_back(model, sides, axes, checked_reaction(model, {joint, Quantity::f}).columns);
  if (grids.empty()) return;
  tbb::parallel_for(std::size_t{0}, grids.front().count(), [&](std::size_t node) {
    const BoundedNumerators there = bounded_numerators(model, grids.front().place(node), sides);
    for (TurnGrid& grid : grids) grid.enter(node, there);
  });
  for (std::size_t i = 0; i < grids.size(); ++i) {
    TurnGrid& grid = grids[i];
    if (!grid.any_decided()) continue;
    grid.follow_edges();
    judge_joint(grid, axes, map, mode, joints[i], listed, report);
  }
}

}  // namespace clearloci::numeric
