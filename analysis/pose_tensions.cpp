#include "analysis/pose_tensions.hpp"

#include <algorithm>
#include <utility>

#include "analysis/effort_polytope.hpp"
#include "core/rational.hpp"
#include "mechanism/free_cables.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci {
namespace {

using core::Rational;
using mechanism::JointIndex;
using mechanism::Mechanism;

/// A tension as it depends on the free efforts: of the row that holds it above its lower bound.
struct Tension {
  std::size_t row = 0;
  JointIndex joint = 0;
  Rational least, most;
};

class PoseTensions {
 public:
  PoseTensions(const Mechanism& mechanism, const std::vector<numeric::Bounded>& at, const DyadSides& sides)
      : all_{mechanism, {}, {}} {
    std::vector<double> pose;
    for (const numeric::Bounded& value : at) pose.push_back(value.value);
    if (const auto free = mechanism::best_free_cables(mechanism, pose))
      mechanism::set_free_cables(all_.mechanism, *free);
    if (auto rows = effort_rows(all_.mechanism, at, sides)) rows_ = std::move(*rows);
    polytope_ = polytope_of(rows_);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const mechanism::Joint& joint = joint_of(rows_[i].joint);
      if (rows_[i].side > 0 && mechanism::is_cable(joint))
        tensions_.push_back({i, rows_[i].joint, joint.within->first, joint.within->second});
    }
    std::sort(tensions_.begin(), tensions_.end(), [](const Tension& a, const Tension& b) { return a.joint < b.joint; });
  }

  PoseEfforts run() {
    const std::vector<JointIndex> free = mechanism::joints_without_preload(all_.mechanism);
    std::vector<Rational> efforts;
    for (const JointIndex j : free) efforts.push_back(joint_of(j).within->first);
    const auto deepest = polytope_.deepest(widths_of(rows_));
    const bool feasible = deepest && deepest->depth > 0;
    if (deepest) efforts = deepest->at;
    if (feasible) {
      if (auto smallest = smallest_tensions()) efforts = std::move(*smallest);
      all_.notes.emplace_back(
          "tensions are a choice: of those within their bounds the ones whose largest part of its upper bound is "
          "smallest; others are given by --preload CABLE=VALUE");
      const auto& joints = all_.mechanism.joints;
      if (std::any_of(joints.begin(), joints.end(),
                      [](const auto& joint) { return joint.clearance && !mechanism::is_cable(joint); }))
        all_.notes.emplace_back(
            "the ranges of tensions hold their bounds alone: with some of them other joints may be without contact, or "
            "in their backlash; verify tells");
    }
    for (std::size_t i = 0; i < free.size(); ++i) mechanism::give_effort(all_.mechanism, free[i], efforts[i]);
    for (const Tension& tension : tensions_) {
      FeasibleEfforts& told = all_.efforts.emplace_back(told_of(tension, efforts));
      if (feasible)
        add_range(tension, told);
      else if (deepest)
        told.never = reactions_of(deepest->binding);
    }
    return std::move(all_);
  }

 private:
  const mechanism::Joint& joint_of(JointIndex j) const { return all_.mechanism.joints[static_cast<std::size_t>(j)]; }

  Rational tension_at(const Tension& tension, const std::vector<Rational>& efforts) const {
    const EffortPolytope::Row& row = polytope_.rows[tension.row];
    Rational value = row.offset + tension.least;
    for (std::size_t k = 0; k < efforts.size(); ++k) value += row.slope[k] * efforts[k];
    return value;
  }

  /// min s of tension <= s most.
  std::optional<std::vector<Rational>> smallest_tensions() const {
    EffortPolytope sized = polytope_;
    ++sized.efforts;
    for (EffortPolytope::Row& row : sized.rows) row.slope.emplace_back(0);
    for (const Tension& tension : tensions_) {
      EffortPolytope::Row row = sized.rows[tension.row];
      row.offset = -row.offset - tension.least;
      for (Rational& slope : row.slope) slope = -slope;
      row.slope.back() = tension.most;
      sized.rows.push_back(std::move(row));
    }
    std::vector<Rational> size(sized.efforts);
    size.back() = 1;
    auto found = sized.least(size);
    if (!found) return std::nullopt;
    found->at.pop_back();
    return std::move(found->at);
  }

  FeasibleEfforts told_of(const Tension& tension, const std::vector<Rational>& efforts) const {
    FeasibleEfforts told;
    told.joint = joint_of(tension.joint).name;
    told.force = told.cable = true;
    told.effort = core::to_double(tension_at(tension, efforts));
    told.within = {core::to_double(tension.least), core::to_double(tension.most)};
    return told;
  }

  void add_range(const Tension& tension, FeasibleEfforts& told) const {
    const EffortPolytope::Row& row = polytope_.rows[tension.row];
    std::vector<Rational> opposite;
    for (const Rational& slope : row.slope) opposite.emplace_back(-slope);
    const auto low = polytope_.least(row.slope), high = polytope_.least(opposite);
    if (!low || !high) return;
    const auto end = [&](const EffortPolytope::Deepest& at) { return core::to_double(tension_at(tension, at.at)); };
    told.ranges.push_back({end(*low), end(*high), others(tension, low->binding), others(tension, high->binding)});
  }

  std::vector<core::Vanishing> reactions_of(const std::vector<std::size_t>& rows) const {
    std::vector<core::Vanishing> all;
    for (const std::size_t row : rows)
      all.push_back({joint_of(rows_[row].joint).name, mechanism::actuator_quantity(joint_of(rows_[row].joint)), 1});
    return all;
  }

  /// Without the cable's own bound, which ends its range by itself.
  std::vector<core::Vanishing> others(const Tension& tension, const std::vector<std::size_t>& rows) const {
    std::vector<core::Vanishing> all = reactions_of(rows);
    std::erase_if(all, [&](const core::Vanishing& each) { return each.joint == joint_of(tension.joint).name; });
    return all;
  }

  PoseEfforts all_;
  std::vector<EffortRow> rows_;
  EffortPolytope polytope_;
  std::vector<Tension> tensions_;
};

}  // namespace

bool only_tensions_are_free(const Mechanism& mechanism) {
  const std::vector<JointIndex> free = mechanism::joints_without_preload(mechanism);
  return !free.empty() && std::all_of(free.begin(), free.end(), [&](JointIndex j) {
    return mechanism::is_cable(mechanism.joints[static_cast<std::size_t>(j)]);
  });
}

PoseEfforts pose_tensions(const Mechanism& mechanism, const std::vector<numeric::Bounded>& at, const DyadSides& sides) {
  return PoseTensions(mechanism, at, sides).run();
}

}  // namespace clearloci
