#include "loci/tasks/pose_nearest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace clearloci::loci::pose {
namespace {

constexpr std::size_t starts = 24;
constexpr int steps = 12;
/// Poses looked at along a coordinate on either side of the task, and rounds of them, each within what was met before.
constexpr int looks = 32, rounds = 2;
/// A reaction that is left at a zero of one of its components or along one direction, as a part of what it was: more
/// is no zero.
constexpr double left_over = 1e-6;
/// Of the task's size, the steps of differences.
constexpr double difference = 1e-6;

/// The functions of a pose whose zeros are loci.
struct Functions {
  struct Name {
    Doubt kind = Doubt::workspace;
    int demand = -1;
    std::size_t load = 0, closure = 0;
    std::vector<double> direction;  ///< of a reaction
  };
  std::vector<Name> names;
  double logarithm = 0;

  Functions(const core::PoseStatics& statics, const PosePoint::At& start) : logarithm(start.logarithm) {
    names.push_back({Doubt::singularity, -1, 0, 0, {}});
    for (std::size_t i = 0; i < start.closures.size(); ++i) names.push_back({Doubt::workspace, -1, 0, i, {}});
    for (std::size_t d = 0; d < statics.demands.size(); ++d)
      for (std::size_t load = 0; load < statics.loads; ++load) {
        std::vector<double> n = start.components[d][load];
        const double size = PoseCell::size_of({n, n});
        if (!(size > 0)) continue;
        for (double& component : n) component /= size;
        names.push_back({Doubt::demand, static_cast<int>(d), load, 0, std::move(n)});
      }
  }

  double value(const core::PoseStatics& statics, const Name& name, const PosePoint::At& at) const {
    if (name.kind == Doubt::singularity) return at.determinant * std::exp(at.logarithm - logarithm);
    if (name.kind == Doubt::workspace) return at.closures[name.closure];
    const auto d = static_cast<std::size_t>(name.demand);
    const std::vector<double>& f = at.components[d][name.load];
    double along = 0;
    for (std::size_t k = 0; k < f.size(); ++k) along += name.direction[k] * f[k];
    return along - core::to_double(statics.demands[d].demand.least);
  }
};

class Finder {
 public:
  Finder(const core::PoseStatics& statics, const PoseRegion& region)
      : statics_(statics), region_(region), point_(statics) {}

  std::vector<NearPose> find(double far) {
    std::vector<Pose> poses = region_.samples();
    if (poses.size() > starts) poses.resize(starts);
    for (const Pose& pose : poses) from(pose);
    // Newton's steps may leap over what is near: along the coordinates signs are looked at one by one.
    for (int round = 0; round < rounds; ++round) {
      const double within = std::min(far, least_distance());
      for (std::size_t c = 0; c < region_.coordinates(); ++c)
        if (region_.metric().grows[c])
          for (const double way : {1.0, -1.0}) march(c, way, within);
      if (!(least_distance() < within)) break;
    }
    std::vector<NearPose> list;
    for (auto& [key, node] : found_) list.push_back(std::move(node));
    std::sort(list.begin(), list.end(), [](const NearPose& a, const NearPose& b) { return a.distance < b.distance; });
    return list;
  }

 private:
  struct Slope {
    double value = 0;
    std::vector<double> gradient;
  };

  /// Values and gradients of all functions at a pose; nothing where it or its neighbours are out of reach.
  std::optional<std::vector<Slope>> slopes(const Functions& functions, const Pose& pose) {
    const auto here = point_.at(pose);
    if (!here) return std::nullopt;
    std::vector<Slope> all;
    for (const Functions::Name& name : functions.names)
      all.push_back({functions.value(statics_, name, *here), std::vector<double>(pose.size(), 0.0)});
    for (std::size_t c = 0; c < pose.size(); ++c) {
      const double h = difference / region_.metric().weights[c];
      Pose beside = pose;
      beside[c] += h;
      auto there = point_.at(beside);
      double step = h;
      if (!there) {
        beside[c] = pose[c] - h;
        there = point_.at(beside);
        step = -h;
      }
      if (!there) return std::nullopt;
      for (std::size_t f = 0; f < all.size(); ++f)
        all[f].gradient[c] = (functions.value(statics_, functions.names[f], *there) - all[f].value) / step;
    }
    return all;
  }

  /// The pose nearest to `base` at which a function vanishes that has this value and gradient at `at`.
  std::optional<Pose> linear_zero(const Slope& slope, const Pose& at, const Pose& base) const {
    double rate = 0, value = slope.value;
    for (std::size_t c = 0; c < at.size(); ++c) {
      const double g = region_.metric().grows[c] ? slope.gradient[c] / region_.metric().weights[c] : 0.0;
      rate += g * g;
      value += slope.gradient[c] * (base[c] - at[c]);
    }
    if (!(rate > 0)) return std::nullopt;
    Pose zero = base;
    for (std::size_t c = 0; c < at.size(); ++c) {
      const double w = region_.metric().weights[c];
      if (region_.metric().grows[c]) zero[c] -= value / rate * slope.gradient[c] / (w * w);
    }
    return zero;
  }

  double least_distance() const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [key, node] : found_) least = std::min(least, node.distance);
    return least;
  }

  /// From the task's side along a coordinate, up to a distance, in even steps: what changes its sign is followed from
  /// there.
  void march(std::size_t c, double way, double within) {
    if (!std::isfinite(within)) return;
    const double step = way * within / looks / region_.metric().weights[c];
    Pose pose = region_.farthest_along(c, way);
    auto last = point_.at(pose);
    if (!last) return;
    const Functions functions(statics_, *last);
    const auto values = [&](const PosePoint::At& at) {
      std::vector<double> all;
      for (const Functions::Name& name : functions.names) all.push_back(functions.value(statics_, name, at));
      return all;
    };
    std::vector<double> before = values(*last);
    for (int k = 0; k < looks; ++k) {
      const Pose from = pose;
      pose[c] += step;
      const auto now = point_.at(pose);
      if (!now) return;  // out of reach: its boundary is what Newton's method looks for
      std::vector<double> here = values(*now);
      for (std::size_t f = 0; f < here.size(); ++f)
        if (before[f] * here[f] < 0) follow(functions, f, std::abs(before[f]) < std::abs(here[f]) ? from : pose);
      before = std::move(here);
    }
  }

  void from(const Pose& start) {
    const auto first = point_.at(start);
    if (!first) return;
    const Functions functions(statics_, *first);
    const auto all = slopes(functions, start);
    if (!all) return;
    // The few that look nearest are followed.
    constexpr std::size_t followed = 6;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t f = 0; f < all->size(); ++f)
      if (const auto zero = linear_zero((*all)[f], start, start)) order.emplace_back(region_.distance(*zero), f);
    std::sort(order.begin(), order.end());
    if (order.size() > followed) order.resize(followed);
    for (const auto& [distance, f] : order) follow(functions, f, start);
  }

  void follow(const Functions& functions, std::size_t f, const Pose& start) {
    const Functions::Name& name = functions.names[f];
    Pose at = start;
    double usual = 0;
    for (int step = 0; step < steps; ++step) {
      const auto all = slopes(functions, at);
      if (!all) return;
      const Slope& slope = (*all)[f];
      usual = std::max(usual, std::abs(slope.value));
      const Pose base = region_.closest(at);
      const auto zero = linear_zero(slope, at, base);
      if (!zero) return;
      const double moved = apart(*zero, at);
      // Into reach, by halves.
      Pose next = *zero;
      for (int halving = 0; halving < 8 && !point_.at(next); ++halving)
        for (std::size_t c = 0; c < next.size(); ++c) next[c] = 0.5 * (next[c] + at[c]);
      at = next;
      if (moved < 1e-9 * (1 + apart(at, base))) break;
    }
    const auto last = point_.at(at);
    if (!last || !(std::abs(functions.value(statics_, name, *last)) < left_over * usual)) return;
    if (name.kind == Doubt::demand) {
      const auto d = static_cast<std::size_t>(name.demand);
      const double least = core::to_double(statics_.demands[d].demand.least);
      const std::vector<double>& left = last->components[d][name.load];
      if (PoseCell::size_of({left, left}) > least + left_over * usual) return;
    }
    NearPose near{name.kind, name.demand, at, region_.distance(at)};
    if (!std::isfinite(near.distance)) return;
    const auto [place, fresh] = found_.try_emplace({name.kind, name.demand}, near);
    if (!fresh && near.distance < place->second.distance) place->second = near;
  }

  double apart(const Pose& a, const Pose& b) const {
    double square = 0;
    for (std::size_t c = 0; c < a.size(); ++c) square += std::pow(region_.metric().weights[c] * (a[c] - b[c]), 2);
    return std::sqrt(square);
  }

  const core::PoseStatics& statics_;
  const PoseRegion& region_;
  PosePoint point_;
  std::map<std::pair<Doubt, int>, NearPose> found_;
};

}  // namespace

std::vector<NearPose> near_loci(const core::PoseStatics& statics, const PoseRegion& region, double far) {
  return Finder(statics, region).find(far);
}

}  // namespace clearloci::loci::pose
