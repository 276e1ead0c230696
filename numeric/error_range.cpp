#include "numeric/error_range.hpp"

#include <algorithm>
#include <limits>

#include "core/errors.hpp"
#include "numeric/reactions.hpp"

namespace clearloci::numeric {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Where one side's error is measured, as a part of the smooth stretch there: twice, so that what is linear is taken
// out.
constexpr double nearest = 1e-5;

RangePose pose_at(const NumericModel& model, std::span<const int> mode, double at) {
  RangePose pose{at, false, {}};
  const Posture there = posture(model, std::span(&at, 1), mode);
  pose.reachable = there.reachable() && reachable(model, std::span(&at, 1), mode);
  if (!pose.reachable) return pose;
  const std::vector<Bounded> exactly = {Bounded(at)};
  pose.accuracy = pose_accuracy(model, there, lost_contacts(model, exactly, mode));
  return pose;
}

/// The limit of the error at `at` from the side of `step`, to the second order.
PoseError one_sided(const NumericModel& model, std::span<const int> mode, double at, double step) {
  const RangePose near = pose_at(model, mode, at + step), far = pose_at(model, mode, at + 2 * step);
  if (!near.reachable || !far.reachable) return {Vector3d::Constant(nan), Vector3d::Constant(nan)};
  const PoseError &a = near.accuracy.error, &b = far.accuracy.error;
  return {2 * a.dalpha - b.dalpha, 2 * a.dp - b.dp};
}

}  // namespace

std::vector<RangePose> error_range(const NumericModel& model, std::span<const int> mode, std::span<const double> at,
                                   std::optional<std::chrono::steady_clock::time_point> deadline) {
  core::ensure(model.box.size() == 1, "a range is that of a single coordinate");
  std::vector<RangePose> poses;
  for (const double value : at) {
    if (deadline && std::chrono::steady_clock::now() >= *deadline)
      throw core::LimitReached("the errors could not be computed within the time limit; ask for fewer steps");
    poses.push_back(pose_at(model, mode, value));
  }
  return poses;
}

std::vector<std::string> never_loaded(const NumericModel& model, const std::vector<RangePose>& poses) {
  std::vector<std::string> names;
  const auto reached = [](const RangePose& pose) { return pose.reachable; };
  if (std::none_of(poses.begin(), poses.end(), reached)) return names;
  for (const mechanism::Joint& joint : model.mechanism.joints) {
    const bool always = std::all_of(poses.begin(), poses.end(), [&](const RangePose& pose) {
      const std::vector<std::string>& undefined = pose.accuracy.undefined;
      return !pose.reachable || std::find(undefined.begin(), undefined.end(), joint.name) != undefined.end();
    });
    if (always) names.push_back(joint.name);
  }
  return names;
}

PoseError error_jump(const NumericModel& model, std::span<const int> mode, double at, double free) {
  const PoseError before = one_sided(model, mode, at, -nearest * free);
  const PoseError after = one_sided(model, mode, at, nearest * free);
  return {after.dalpha - before.dalpha, after.dp - before.dp};
}

}  // namespace clearloci::numeric
