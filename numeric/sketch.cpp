#include "numeric/sketch.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/reactions.hpp"

namespace clearloci::numeric {

namespace {

Point2 point_of(const Posture& posture, int index) { return in_plane(posture.points[static_cast<std::size_t>(index)]); }

/// Turned so that x points to the right, y upwards and z at an eye that looks down a little.
Posture seen(Posture posture) {
  constexpr double azimuth = 0.45, elevation = 0.4;  // rad
  const double c = std::cos(azimuth), s = std::sin(azimuth), up = std::cos(elevation), down = std::sin(elevation);
  Eigen::Matrix3d view;
  view << c, s, 0, -s * down, c * down, up, s * up, -c * up, down;
  for (Vector3d& point : posture.points) point = view * point;
  for (Vector3d& axis : posture.axes) axis = view * axis;
  for (AppliedLoad& load : posture.loads) {
    load.at = view * load.at;
    // As long as it is, and not as long as it is seen: its size stands beside it.
    const Vector3d force = view * load.force;
    const double flat = std::hypot(force.x(), force.y());
    load.force =
        flat > 0 ? Vector3d(Vector3d(force.x(), force.y(), 0) * (force.norm() / flat)) : Vector3d(Vector3d::Zero());
    load.couple.setZero();
  }
  posture.gravity = view * posture.gravity;
  return posture;
}

double cross(const Point2& o, const Point2& p, const Point2& q) {
  return (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
}

double distance(const Point2& p, const Point2& q) { return std::hypot(q[0] - p[0], q[1] - p[1]); }

/// Sine of the smallest angle at a dyad's apex: 1 far from the boundary, 0 on it.
double openness(const NumericModel& model, const Posture& posture) {
  double least = 1;
  for (const int index : model.dyads) {
    const auto& form = model.mechanism.points[static_cast<std::size_t>(index)].form;
    const Point2 apex = point_of(posture, index);
    if (const auto* dyad = std::get_if<mechanism::DyadPoint>(&form)) {
      const Point2 from = point_of(posture, dyad->from), to = point_of(posture, dyad->to);
      least = std::min(least, std::abs(cross(apex, from, to)) / (distance(apex, from) * distance(apex, to)));
      continue;
    }
    // A slider: its rod is far from square to its path.
    const auto& slider = std::get<mechanism::SliderPoint>(form);
    const Point2 base = point_of(posture, slider.base), from = point_of(posture, slider.from);
    const double path = distance(base, apex);
    if (path > 0) {
      const double along = (from[0] - apex[0]) * (base[0] - apex[0]) + (from[1] - apex[1]) * (base[1] - apex[1]);
      least = std::min(least, std::abs(along) / (path * distance(apex, from)));
    }
  }
  return least;
}

/// The smallest distance between joints at different places, in typical lengths, counted up to a third.
double spacing(const NumericModel& model, const Posture& posture) {
  constexpr double enough = 1.0 / 3;
  const double scale = typical_length(model, posture);
  double least = enough;
  const auto& joints = model.mechanism.joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    for (std::size_t j = i + 1; j < joints.size(); ++j) {
      if (joints[i].at == joints[j].at) continue;
      const double apart = distance(point_of(posture, joints[i].at), point_of(posture, joints[j].at));
      const auto on_ground = [](const mechanism::Joint& joint) {
        return joint.from == mechanism::ground || joint.to == mechanism::ground;
      };
      // Motors on one axis are together in every posture.
      if (apart == 0 && on_ground(joints[i]) && on_ground(joints[j])) continue;
      least = std::min(least, apart / scale);
    }
  }
  return least / enough;
}

/// The least sine of the angle between two links at their joint, counted up to that of 30 deg: 1 where no link lies
/// along its neighbour or over it, a fifth where one does.
double bending(const NumericModel& model, const Posture& posture) {
  constexpr double enough = 0.5, least_share = 0.2;
  const auto& m = model.mechanism;
  const auto arm = [&](mechanism::LinkIndex link, int at) {
    Point2 longest{};
    for (const int other : m.links[static_cast<std::size_t>(link)].points) {
      const Point2 from = point_of(posture, at), to = point_of(posture, other);
      if (distance(from, to) > std::hypot(longest[0], longest[1])) longest = {to[0] - from[0], to[1] - from[1]};
    }
    return longest;
  };
  double least = enough;
  for (const mechanism::Joint& joint : m.joints) {
    if (joint.from == mechanism::ground || joint.to == mechanism::ground || !mechanism::traits(joint).pinned ||
        mechanism::traits(joint).slides)
      continue;
    const Point2 a = arm(joint.from, joint.at), b = arm(joint.to, joint.at);
    const double sizes = std::hypot(a[0], a[1]) * std::hypot(b[0], b[1]);
    if (sizes > 0) least = std::min(least, std::abs(a[0] * b[1] - a[1] * b[0]) / sizes);
  }
  return least_share + (1 - least_share) * least / enough;
}

/// Pairs of links whose first segments cross elsewhere than in a shared point.
int crossings(const NumericModel& model, const Posture& posture) {
  int count = 0;
  const auto& links = model.mechanism.links;
  for (std::size_t i = 0; i < links.size(); ++i) {
    for (std::size_t j = i + 1; j < links.size(); ++j) {
      if (links[i].points.size() < 2 || links[j].points.size() < 2) continue;
      const Point2 p = point_of(posture, links[i].points[0]), q = point_of(posture, links[i].points[1]);
      const Point2 r = point_of(posture, links[j].points[0]), s = point_of(posture, links[j].points[1]);
      if (cross(p, q, r) * cross(p, q, s) < 0 && cross(r, s, p) * cross(r, s, q) < 0) ++count;
    }
  }
  return count;
}

/// What a prismatic joint slides in: the leg between a point of either link along the axis, if there are two such; else
/// a rail, where one of the links is the ground.
std::optional<core::SketchSlide> slide(const NumericModel& model, const Posture& posture, std::size_t joint_index) {
  const auto& m = model.mechanism;
  const mechanism::Joint& joint = m.joints[joint_index];
  if (!mechanism::traits(joint).slides || mechanism::is_cable(joint)) return std::nullopt;
  const Vector3d& u = posture.axes[joint_index];
  const Point2 at = point_of(posture, joint.at);
  if (joint.from == mechanism::ground || joint.to == mechanism::ground) {
    const double half = 0.6 * typical_length(model, posture);
    return core::SketchSlide{
        {at[0] - half * u[0], at[1] - half * u[1]}, {at[0] + half * u[0], at[1] + half * u[1]}, true, joint.actuated};
  }
  std::optional<core::SketchSlide> longest;
  double length = 0;
  for (const int i : m.links[static_cast<std::size_t>(joint.from)].points) {
    for (const int k : m.links[static_cast<std::size_t>(joint.to)].points) {
      const Point2 p = point_of(posture, i), q = point_of(posture, k);
      const double across = (q[0] - p[0]) * u[1] - (q[1] - p[1]) * u[0], apart = distance(p, q);
      if (std::abs(across) > 1e-9 * apart || apart <= length) continue;
      length = apart;
      longest = core::SketchSlide{p, q, false, joint.actuated};
    }
  }
  return longest;
}

/// Two pulleys and the spans that touch both, on a line through the pitch point where their sizes differ.
/// `round`: a circle about a centre through a point.
template <class Round>
void draw_belt(const NumericModel& model, const Posture& posture, const mechanism::Joint& belt, const Round& round,
               core::Sketch& sketch) {
  const Point2 a = point_of(posture, belt.meshing->first), b = point_of(posture, *belt.meshing->second);
  const double d = distance(a, b), first = core::to_double(mechanism::value_of(belt.meshing->radius, model.mechanism));
  const Point2 e = {(b[0] - a[0]) / d, (b[1] - a[1]) / d};
  double second = first;
  if (!belt.axes.empty()) {
    const Point2 w = point_of(posture, belt.at);
    const double from = (w[0] - a[0]) * e[0] + (w[1] - a[1]) * e[1];
    second *= (from - d) / from;
  }
  const double along = (first - second) / d, across = std::sqrt(std::max(0.0, 1 - along * along));
  const auto touch = [&](const Point2& centre, double radius, double side) {
    return Point2{centre[0] + radius * (along * e[0] - side * across * e[1]),
                  centre[1] + radius * (along * e[1] + side * across * e[0])};
  };
  for (const double side : {1.0, -1.0})
    sketch.slides.push_back({touch(a, first, side), touch(b, second, side), true, false});
  round(a, touch(a, first, 1));
  round(b, touch(b, second, 1));
}

/// The pitch circles of two wheels, and the line of a rack, in pieces as of a rail.
void draw_pitch_lines(const NumericModel& model, const Posture& posture, const mechanism::Joint& gear,
                      core::Sketch& sketch) {
  constexpr int pieces = 48;
  const Point2 pitch = point_of(posture, gear.at);
  const auto round = [&](const Point2& c, const Point2& through) {
    const double r = distance(c, through), start = std::atan2(through[1] - c[1], through[0] - c[0]);
    const auto at = [&](int k) {
      const double angle = start + 2 * std::numbers::pi * k / pieces;
      return Point2{c[0] + r * std::cos(angle), c[1] + r * std::sin(angle)};
    };
    for (int k = 0; k < pieces; ++k) sketch.slides.push_back({at(k), at(k + 1), true, false});
  };
  const auto circle = [&](mechanism::PointIndex centre) { round(point_of(posture, centre), pitch); };
  if (!gear.meshing->flank) return draw_belt(model, posture, gear, round, sketch);
  circle(gear.meshing->first);
  if (gear.meshing->second) return circle(*gear.meshing->second);
  const Point2 c = point_of(posture, gear.meshing->first);
  const Point2 along = {2 * (pitch[1] - c[1]), -2 * (pitch[0] - c[0])};
  sketch.slides.push_back(
      {{pitch[0] - along[0], pitch[1] - along[1]}, {pitch[0] + along[0], pitch[1] + along[1]}, true, false});
}

/// 1 in the middle of the box, 0 on its rim.
double centrality(std::span<const double> pose, std::span<const std::array<double, 2>> box) {
  double least = 1;
  for (std::size_t c = 0; c < pose.size(); ++c)
    least = std::min(least, 2 * std::min(pose[c] - box[c][0], box[c][1] - pose[c]) / (box[c][1] - box[c][0]));
  return least;
}

/// Poses of a grid over the box, off its symmetries, about a thousand in all, of groups about fifty, which take twenty
/// times as long each; pose after pose.
std::vector<double> pose_grid(std::span<const std::array<double, 2>> box, bool groups) {
  const std::size_t n = box.size();
  const int steps = groups ? (n == 1 ? 40 : n == 2 ? 8 : 4) : n == 1 ? 400 : n == 2 ? 33 : 10;
  std::vector<double> poses;
  std::vector<int> index(n, 0);
  while (true) {
    for (std::size_t c = 0; c < n; ++c) {
      poses.push_back(box[c][0] + (box[c][1] - box[c][0]) * (index[c] + 0.45) / steps);
    }
    std::size_t c = 0;
    while (c < n && ++index[c] == steps) index[c++] = 0;
    if (c == n) return poses;
  }
}

}  // namespace

core::Sketch sketch(const NumericModel& model, std::span<const double> pose, std::span<const int> mode) {
  Posture p = posture(model, pose, mode);
  core::ensure(p.reachable(), "a sketch is drawn at a reachable pose");
  const auto& m = model.mechanism;
  const bool spatial = m.space == mechanism::Space::spatial;
  if (spatial) p = seen(std::move(p));
  core::Sketch result;
  for (const auto& link : m.links) {
    core::SketchLink drawn{link.name, {}};
    for (const int index : link.points) drawn.points.push_back(point_of(p, index));
    result.links.push_back(std::move(drawn));
  }
  for (const auto& joint : m.joints)
    if (mechanism::is_cable(joint))
      result.links.push_back({joint.name, {point_of(p, joint.other_end), point_of(p, joint.at)}});
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (const auto drawn = slide(model, p, j)) result.slides.push_back(*drawn);
  for (const auto& joint : m.joints) {
    if (mechanism::is_cable(joint)) {
      result.joints.push_back({joint.name, point_of(p, joint.other_end), joint.from == mechanism::ground, true});
      continue;
    }
    // A slider on the ground has its rail.
    if (joint.meshing) {
      draw_pitch_lines(model, p, joint, result);
      continue;
    }
    const bool on_ground =
        !mechanism::traits(joint).slides && (joint.from == mechanism::ground || joint.to == mechanism::ground);
    result.joints.push_back({joint.name, point_of(p, joint.at), on_ground, joint.actuated});
  }
  for (const auto& load : p.loads) {
    if (!load.weight && !load.inner && !(spatial && load.force.isZero()))
      result.loads.push_back({in_plane(load.at), in_plane(load.force), load.couple[2]});
  }
  for (const auto& spring : m.springs) {
    const bool belt = std::any_of(m.joints.begin(), m.joints.end(), [&](const mechanism::Joint& joint) {
      return joint.meshing && joint.name == spring.name;
    });
    if (belt) continue;  // its tension
    if (spring.kind == mechanism::Spring::Kind::torsion)
      result.springs.push_back({point_of(p, m.joints[static_cast<std::size_t>(spring.joint)].at), {}, true});
    else
      result.springs.push_back({point_of(p, spring.from_point), point_of(p, spring.to_point), false,
                                spring.from == mechanism::ground, spring.to == mechanism::ground});
  }
  result.gravity = in_plane(p.gravity);
  const auto& end = m.points[static_cast<std::size_t>(m.end_effector_point)];
  result.end_effector = core::SketchPoint{end.auxiliary ? "" : end.name, point_of(p, m.end_effector_point)};
  return result;
}

std::optional<std::vector<double>> sample_pose(const NumericModel& model, std::span<const int> mode,
                                               std::span<const std::array<double, 2>> box) {
  core::ensure(box.size() == model.box.size(), "a box has a range for each free coordinate");
  const std::vector<double> poses = pose_grid(box, !model.mechanism.groups.empty());
  ReactionField field;
  reaction_field(model, poses, mode, field);
  double largest = 0;
  for (std::size_t k = 0; k < field.poses; ++k) {
    if (field.reachable(k)) largest = std::max(largest, std::abs(field.determinants[k]));
  }
  std::optional<std::vector<double>> best;
  double best_score = -1;
  for (std::size_t k = 0; k < field.poses; ++k) {
    if (!field.reachable(k)) continue;
    const std::span<const double> pose(poses.data() + k * box.size(), box.size());
    const Posture p = posture(model, pose, mode);
    const double conditioning = largest > 0 ? std::sqrt(std::abs(field.determinants[k]) / largest) : 1;
    // Where nothing folds, such as telescopic legs, a pose amid the box says more than one in its corner.
    const double open = model.dyads.empty() ? centrality(pose, box) : openness(model, p);
    // In space what lies over something else in the plane need not be near it.
    const bool spatial = model.mechanism.space == mechanism::Space::spatial;
    const double apart = spatial ? 1 : spacing(model, p) * bending(model, p) / (1 + crossings(model, p));
    const double score = (spatial ? centrality(pose, box) : open) * conditioning * apart;
    if (score > best_score) {
      best_score = score;
      best.emplace(pose.begin(), pose.end());
    }
  }
  return best;
}

}  // namespace clearloci::numeric
