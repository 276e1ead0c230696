#include "numeric/error_samples.hpp"

#include <algorithm>
#include <limits>

#include "core/errors.hpp"
#include "numeric/pose_batch.hpp"
#include "numeric/reactions.hpp"

namespace clearloci::numeric {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Of every pose whether the teeth push and no span is slack; empty without gears and belts.
std::vector<bool> within_efforts(const NumericModel& model, std::span<const double> poses, std::span<const int> mode) {
  const auto& joints = model.mechanism.joints;
  std::vector<bool> within;
  if (std::none_of(joints.begin(), joints.end(), [](const auto& joint) { return joint.meshing.has_value(); }))
    return within;
  ReactionField field;
  reaction_field(model, poses, mode, field);
  for (std::size_t i = 0; i < field.poses; ++i) within.push_back(field.reachable(i));
  return within;
}

}  // namespace

ErrorSamples error_samples(const NumericModel& model, std::span<const double> poses, std::span<const int> mode,
                           bool under_load, bool worst_case, double worst_case_accuracy) {
  const std::size_t coordinates = model.box.size();
  core::ensure(coordinates > 0 && poses.size() % coordinates == 0, "a pose has one value for each free coordinate");
  const std::size_t count = poses.size() / coordinates;
  const Vector3d none = Vector3d::Constant(nan);
  ErrorSamples samples;
  samples.error.assign(under_load ? count : 0, {none, none});
  samples.worst.assign(worst_case ? count : 0, {none, none, nan, nan});
  samples.reachable.assign(count, false);
  const std::vector<bool> within = within_efforts(model, poses, mode);
  PoseBatch batch(model, mode);
  constexpr int lanes = PoseBatch::lanes;
  for (std::size_t first = 0; first < count; first += lanes) {
    const int used = static_cast<int>(std::min<std::size_t>(lanes, count - first));
    for (int l = 0; l < lanes; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(std::min(l, used - 1));
      for (std::size_t c = 0; c < coordinates; ++c) batch.input(c, l) = poses[pose * coordinates + c];
    }
    batch.run_tape();
    bool any = false;
    for (int l = 0; l < used; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(l);
      const bool here = batch.reachable(l) && (within.empty() || within[pose]);
      samples.reachable[pose] = here;
      any = any || here;
    }
    if (!any) continue;
    batch.find_influence();
    if (under_load) batch.find_errors_under_load();
    if (worst_case) batch.find_reaches();
    for (int l = 0; l < used; ++l) {
      const std::size_t pose = first + static_cast<std::size_t>(l);
      if (!samples.reachable[pose]) continue;
      if (under_load) samples.error[pose] = batch.error(l);
      if (worst_case) samples.worst[pose] = batch.worst(l, worst_case_accuracy);
    }
  }
  return samples;
}

}  // namespace clearloci::numeric
