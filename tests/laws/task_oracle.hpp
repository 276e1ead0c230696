// What verify says of a task against dense sampling of all that it speaks of: poses of the task, its boundary and its
// margin, and loads between the ends of a range. A proof is contradicted by no sample, and the witness of a refutation
// fails by reactions that are solved another way.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "numeric/reactions.hpp"
#include "numeric/take_up.hpp"
#include "tests/laws/judged.hpp"

namespace clearloci::test {

using core::Point2;
using core::Quantity;

/// Ends of a guide: N + T/h and N - T/h, twice what they bear.
struct GuideEnds {
  Eigen::Index normal = 0, tilt = 0;
  double half_length = 0;
  std::string joint;

  std::array<double, 2> of(const Eigen::VectorXd& w) const {
    return {w(normal) + w(tilt) / half_length, w(normal) - w(tilt) / half_length};
  }
};

inline std::vector<GuideEnds> guides_of(const numeric::NumericModel& model) {
  std::vector<GuideEnds> guides;
  const auto clearances = numeric::joint_clearances(model.mechanism);
  for (std::size_t j = 0; j < clearances.size(); ++j)
    if (clearances[j].half_length > 0)
      guides.push_back({numeric::column_of(model, static_cast<int>(j), Quantity::N),
                        numeric::column_of(model, static_cast<int>(j), Quantity::T), clearances[j].half_length,
                        model.mechanism.joints[j].name});
  return guides;
}

/// Reactions at poses and loads by LU of all equations: nothing that verify uses.
class Oracle {
 public:
  Oracle(const mechanism::Mechanism& mechanism, const core::Task& task)
      : mode_(mechanism::working_mode(mechanism)), task_(task) {
    if (!task.loads) models_.push_back(numeric::compile(mechanism));
    for (int end = 0; task.loads && end < 2; ++end) {
      mechanism::Mechanism loaded = mechanism;
      for (std::size_t c = 0; c < 2; ++c)
        loaded.loads.front().force[c] =
            core::Expression::number((end == 0 ? task.loads->first : task.loads->second)[c]);
      models_.push_back(numeric::compile(loaded));
    }
  }

  bool range() const { return models_.size() > 1; }
  const numeric::NumericModel& model() const { return models_.front(); }
  bool reachable(const Point2& at) const { return numeric::reachable(model(), at, mode_); }

  struct Solved {
    std::vector<Eigen::VectorXd> ends;
    double determinant = 0;
    Eigen::VectorXd at(double t) const { return (1 - t) * ends.front() + t * ends.back(); }
  };
  std::optional<Solved> solve(const Point2& at) const {
    Solved solved;
    for (const numeric::NumericModel& model : models_) {
      const numeric::Posture posture = numeric::posture(model, at, mode_);
      if (!posture.reachable()) return std::nullopt;
      const numeric::Reactions reactions = numeric::solve_reactions(model, posture);
      solved.ends.push_back(reactions.values);
      solved.determinant = reactions.determinant;
    }
    return solved;
  }

  int column(const std::string& joint, Quantity quantity) const {
    for (std::size_t j = 0; j < model().mechanism.joints.size(); ++j)
      if (model().mechanism.joints[j].name == joint) return numeric::column_of(model(), static_cast<int>(j), quantity);
    return -1;
  }
  double size(const Eigen::VectorXd& w, const core::Vanishing& reaction) const {
    for (const GuideEnds& guide : guides_of(model()))
      if (guide.joint == reaction.joint && core::is_guide_end(reaction.quantity))
        return std::abs(guide.of(w)[reaction.quantity == Quantity::end_ahead ? 0 : 1]) / 2;
    if (reaction.quantity != Quantity::f) return std::abs(w(column(reaction.joint, reaction.quantity)));
    return std::hypot(w(column(reaction.joint, Quantity::fx)), w(column(reaction.joint, Quantity::fy)));
  }
  double load_of(const Point2& load) const {
    const core::LoadRange& range = *task_.loads;
    const double fx = core::to_double(range.first[0]), fy = core::to_double(range.first[1]);
    const double dx = core::to_double(range.second[0]) - fx, dy = core::to_double(range.second[1]) - fy;
    const double length2 = dx * dx + dy * dy;
    return length2 > 0 ? ((load[0] - fx) * dx + (load[1] - fy) * dy) / length2 : 0;
  }

 private:
  std::vector<int> mode_;
  const core::Task& task_;
  std::vector<numeric::NumericModel> models_;
};

/// Told of what has to hold, and what it is called where it does not.
using Say = std::function<void(bool holds, const std::string& what)>;

/// A verified task: no sample of its poses, its margin and its loads contradicts it.
void hold_verified(std::mt19937& random, const Oracle& oracle, const core::Task& task, const Verification& result,
                   int poses, const Say& say);

/// A refuted one: its witness fails.
void hold_refuted(const Oracle& oracle, const core::Task& task, const TaskWitness& witness, const Say& say);

}  // namespace clearloci::test
