#include "analysis/effort_corridors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "analysis/loci.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/pose_efforts.hpp"
#include "analysis/task_demands.hpp"
#include "core/rational.hpp"

namespace clearloci {
namespace {

using mechanism::Mechanism;
using numeric::EffortGap;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// By the joint and the quantity, as M_A1: of one component its sign, of several on which side of its gap the effort
/// is.
using Sides = std::map<std::string, int>;

std::string name_of(const EffortGap& gap) { return core::to_string(gap.demand.quantity) + "_" + gap.demand.joint; }

/// Bounds of an effort are apart from its sign.
std::string key_of(const EffortGap& gap) { return name_of(gap) + (gap.demand.bound ? " within" : ""); }

/// The side of a gap on which an effort is; 0 within.
int side_of(const EffortGap& gap, double effort) {
  const int above = effort >= gap.to ? 1 : effort <= gap.from ? -1 : 0;
  return gap.sign_above == 0 ? above : above * gap.sign_above;
}

/// Whether the efforts on this side are those above the gap.
bool is_above(const EffortGap& gap, int side) { return gap.sign_above == 0 ? side > 0 : side == gap.sign_above; }

class PatternSearch {
 public:
  PatternSearch(const Mechanism& mechanism, const WantedEffort& wanted, const Task& task, const LociRequest& request,
                const std::vector<std::vector<double>>& poses)
      : wanted_(wanted), sides_(requested_modes(mechanism, request).front()) {
    std::vector<numeric::NumericModel> none, one;
    for (const Mechanism& loaded : under_larger_loads(mechanism, task)) {
      none.push_back(model_with(loaded, 0));
      one.push_back(model_with(loaded, 1));
    }
    std::vector<std::string> notes;  // those of verify()
    const std::vector<core::TaskDemand> demands =
        loaded_demands(one, sides_, demands_of(mechanism, request), poses, notes);
    for (const std::vector<double>& pose : poses) {
      std::vector<numeric::Bounded> at;
      for (const double value : pose) at.emplace_back(value, 4 * numeric::unit_roundoff * std::abs(value));
      std::vector<EffortGap> gaps;
      bool regular = true;
      for (std::size_t i = 0; i < none.size() && regular; ++i) {
        const numeric::Bounded determinant = numeric::bounded_numerators(none[i], at, sides_).determinant;
        regular = std::abs(determinant.value) > determinant.error;
        for (EffortGap& gap : numeric::effort_gaps(none[i], one[i], at, sides_, demands))
          gaps.push_back(std::move(gap));
      }
      if (const auto gap = own_gap(mechanism, wanted.joint, request)) gaps.push_back(*gap);
      if (regular) seen_.push_back({pose, std::move(gaps)});
    }
  }

  std::vector<EffortPattern> run() const {
    std::vector<EffortPattern> patterns;
    if (seen_.empty()) return patterns;
    for (const double effort : first_efforts())
      if (const auto sides = sides_at(effort)) patterns.push_back(pattern_of(*sides));
    return patterns;
  }

 private:
  struct Seen {
    std::vector<double> at;
    std::vector<EffortGap> gaps;
  };

  numeric::NumericModel model_with(Mechanism mechanism, int effort) const {
    for (const mechanism::JointIndex j : mechanism::preloaded_joints(mechanism))
      if (mechanism.joints[static_cast<std::size_t>(j)].name == wanted_.joint)
        mechanism::give_effort(mechanism, j, effort);
    return numeric::compile(mechanism);
  }

  /// One between any two neighbouring ends of gaps at the first pose, and one beyond either last; the smallest first.
  std::vector<double> first_efforts() const {
    std::vector<double> ends;
    for (const EffortGap& gap : seen_.front().gaps)
      for (const double end : {gap.from, gap.to})
        if (std::isfinite(end)) ends.push_back(end);
    std::sort(ends.begin(), ends.end());
    if (ends.empty()) return {0};
    std::vector<double> efforts = {ends.front() - 1, ends.back() + 1};
    for (std::size_t i = 1; i < ends.size(); ++i)
      if (ends[i] > ends[i - 1]) efforts.push_back(0.5 * (ends[i] + ends[i - 1]));
    std::sort(efforts.begin(), efforts.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    return efforts;
  }

  /// Nothing where the effort is within a gap, or loads between two would cross one.
  std::optional<Sides> sides_at(double effort) const {
    Sides sides;
    for (const EffortGap& gap : seen_.front().gaps) {
      const int side = side_of(gap, effort);
      const auto [entry, first] = sides.emplace(key_of(gap), side);
      if (side == 0 || entry->second != side) return std::nullopt;
    }
    return sides;
  }

  EffortPattern pattern_of(Sides sides) const {
    EffortPattern pattern;
    for (const Seen& seen : seen_) {
      EffortCorridor all = free_at(seen);
      EffortCorridor certain = free_at(seen);
      for (const EffortGap& gap : seen.gaps) {
        const auto found = sides.find(key_of(gap));
        const int side = found != sides.end() ? found->second : roomier_side(all, gap);
        sides.emplace(key_of(gap), side);
        narrow(all, gap, side);
        if (gap.sign_above != 0) narrow(certain, gap, side);
      }
      const double rounding = certain.lower.rounding + certain.upper.rounding;
      if (!pattern.excluded && certain.lower.effort - certain.upper.effort > rounding) pattern.excluded = certain;
      pattern.least = std::max({pattern.least, certain.lower.effort - certain.lower.rounding,
                                -certain.upper.effort - certain.upper.rounding});
      pattern.corridors.push_back(std::move(all));
    }
    return pattern;
  }

  static EffortCorridor free_at(const Seen& seen) { return {seen.at, {-infinity}, {infinity}}; }

  /// Of a force of several components that is large enough at the first pose, whatever the effort.
  static int roomier_side(const EffortCorridor& corridor, const EffortGap& gap) {
    return corridor.upper.effort - gap.to >= gap.from - corridor.lower.effort ? 1 : -1;
  }

  static void narrow(EffortCorridor& corridor, const EffortGap& gap, int side) {
    if (is_above(gap, side)) {
      if (gap.to > corridor.lower.effort) corridor.lower = {gap.to, name_of(gap), gap.rounding};
    } else if (gap.from < corridor.upper.effort) {
      corridor.upper = {gap.from, name_of(gap), gap.rounding};
    }
  }

  const WantedEffort& wanted_;
  DyadSides sides_;
  std::vector<Seen> seen_;
};

}  // namespace

std::vector<EffortPattern> effort_patterns(const Mechanism& mechanism, const WantedEffort& wanted, const Task& task,
                                           const LociRequest& request, const std::vector<std::vector<double>>& poses) {
  return PatternSearch(mechanism, wanted, task, request, poses).run();
}

}  // namespace clearloci
