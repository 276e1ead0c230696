#include <algorithm>
#include <array>

#include "clearloci/pose_tasks.hpp"
#include "core/pose_shape.hpp"

namespace clearloci::inline core {
namespace {

/// Every place of a shape by `place(value, coordinate)`, of numbers exact and of a mesh's corners rounded.
template <class Place>
PoseShape placed(PoseShape shape, const Place& place) {
  const auto pose = [&](RationalPose& own) {
    for (std::size_t c = 0; c < own.size(); ++c) own[c] = place(own[c], c);
  };
  if (auto* box = std::get_if<PoseBoxShape>(&shape)) {
    pose(box->lower);
    pose(box->upper);
  } else if (auto* ball = std::get_if<PoseBallShape>(&shape)) {
    pose(ball->centre);
  } else if (auto* path = std::get_if<PosePathShape>(&shape)) {
    for (RationalPose& point : path->points) pose(point);
  } else {
    for (std::array<double, 3>& corner : std::get<PoseMeshShape>(shape).corners)
      for (std::size_t c = 0; c < 3; ++c) corner[c] = to_double(place(Rational(corner[c]), c));
  }
  return shape;
}

}  // namespace

std::string kind_of(const PoseShape& shape) {
  constexpr std::array<const char*, 4> names = {"box", "ball", "path", "mesh"};
  return names[shape.index()];
}

std::array<RationalPose, 2> bounds(const PoseShape& shape, const std::vector<Rational>& weights) {
  if (const auto* box = std::get_if<PoseBoxShape>(&shape)) return {box->lower, box->upper};
  std::array<RationalPose, 2> own;
  if (const auto* ball = std::get_if<PoseBallShape>(&shape)) {
    for (std::size_t c = 0; c < ball->centre.size(); ++c) {
      own[0].push_back(ball->centre[c] - ball->radius / weights[c]);
      own[1].push_back(ball->centre[c] + ball->radius / weights[c]);
    }
    return own;
  }
  const auto include = [&](const RationalPose& pose) {
    if (own[0].empty()) own = {pose, pose};
    for (std::size_t c = 0; c < pose.size(); ++c) {
      own[0][c] = std::min(own[0][c], pose[c]);
      own[1][c] = std::max(own[1][c], pose[c]);
    }
  };
  if (const auto* path = std::get_if<PosePathShape>(&shape)) {
    for (const RationalPose& point : path->points) include(point);
    return own;
  }
  for (const std::array<double, 3>& corner : std::get<PoseMeshShape>(shape).corners)
    include({Rational(corner[0]), Rational(corner[1]), Rational(corner[2])});
  return own;
}

PoseShape moved(const PoseShape& shape, const RationalPose& by) {
  return placed(shape, [&](const Rational& value, std::size_t c) { return Rational(value + by[c]); });
}

PoseShape scaled(const PoseShape& shape, const RationalPose& middle, const Rational& factor) {
  PoseShape own = placed(
      shape, [&](const Rational& value, std::size_t c) { return Rational(middle[c] + factor * (value - middle[c])); });
  if (auto* ball = std::get_if<PoseBallShape>(&own)) ball->radius *= factor;
  return own;
}

}  // namespace clearloci::inline core
