// Shipped planar mechanisms over their end effector and over their motors agree with themselves: the file is drawn anew
// in one posture, with the motors' angles and strokes as coordinates, so that the points that close together become a
// group. A locus over the motors is, posture by posture, one over the end effector, and the other way round.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/model.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/pose.hpp"
#include "mechanism/joint_traits.hpp"
#include "tests/source_dir.hpp"
#include "tests/texts.hpp"

namespace clearloci::test {
namespace {

using Vector = std::array<double, 2>;
using mechanism::VectorExpression;

Vector place_of(const Pose& pose, const std::string& name) {
  for (const PosePoint& point : pose.points)
    if (point.name == name) return {point.at[0], point.at[1]};
  ADD_FAILURE() << name;
  return {};
}

/// The motors of a mechanism and what they are at a pose.
class Motors {
 public:
  explicit Motors(const Model& model) : m_(model.content().mechanism) {
    for (const mechanism::Joint& joint : m_.joints)
      if (joint.actuated && !joint.effort && !joint.free_effort) joints_.push_back(&joint);
  }

  std::size_t count() const { return joints_.size(); }
  bool slides(std::size_t k) const { return mechanism::traits(*joints_[k]).slides; }

  /// rad and m.
  std::vector<double> at(const Pose& pose) const {
    std::vector<double> all;
    for (std::size_t k = 0; k < count(); ++k) all.push_back(slides(k) ? stroke(*joints_[k], pose) : angle(k, pose));
    return all;
  }

  /// As lines of `workspace`, `half` on either side.
  std::string ranges(const std::vector<double>& middle, const std::vector<double>& half) const {
    std::string text;
    for (std::size_t k = 0; k < count(); ++k)
      text += fmt::format("  q{}: {{{}: ['{:.9f} {}', '{:.9f} {}'], of: {}}}\n", k, slides(k) ? "stroke" : "angle",
                          middle[k] - half[k], slides(k) ? "m" : "rad", middle[k] + half[k], slides(k) ? "m" : "rad",
                          slides(k) ? joints_[k]->name : m_.links[static_cast<std::size_t>(link(k))].name);
    return text;
  }

  std::string drawn(const Pose& pose) const {
    std::string text = "drawn:\n";
    for (const mechanism::Point& point : m_.points) {
      if (point.auxiliary) continue;
      const Vector at = place_of(pose, point.name);
      text += fmt::format("  {}: ['{:.17g} m', '{:.17g} m']\n", point.name, at[0], at[1]);
    }
    return text;
  }

 private:
  mechanism::LinkIndex link(std::size_t k) const {
    return joints_[k]->to == mechanism::ground ? joints_[k]->from : joints_[k]->to;
  }
  Vector point(const Pose& pose, mechanism::PointIndex index) const {
    return place_of(pose, m_.points[static_cast<std::size_t>(index)].name);
  }
  double angle(std::size_t k, const Pose& pose) const {
    const auto& points = m_.links[static_cast<std::size_t>(link(k))].points;
    const Vector a = point(pose, points[0]), b = point(pose, points[1]);
    return std::atan2(b[1] - a[1], b[0] - a[0]);
  }
  Vector value(const VectorExpression& v, const Pose& pose) const {
    using Kind = VectorExpression::Kind;
    if (v.kind == Kind::components) return {v.numbers[0].value().get_d(), v.numbers[1].value().get_d()};
    if (v.kind == Kind::point) return point(pose, v.point);
    const Vector first = value(v.arguments[0], pose);
    if (v.kind == Kind::negate) return {-first[0], -first[1]};
    const Vector second = value(v.arguments.at(1), pose);
    return {first[0] + second[0], first[1] + second[1]};
  }
  double stroke(const mechanism::Joint& joint, const Pose& pose) const {
    const Vector axis = value(joint.axes[0], pose), at = point(pose, joint.at);
    Vector from = {0, 0};
    if (joint.from != mechanism::ground) from = point(pose, m_.links[static_cast<std::size_t>(joint.from)].points[0]);
    return ((at[0] - from[0]) * axis[0] + (at[1] - from[1]) * axis[1]) / std::hypot(axis[0], axis[1]);
  }

  const mechanism::Mechanism& m_;
  std::vector<const mechanism::Joint*> joints_;
};

/// The point whose place the coordinates are.
std::string end_point(const Model& model) {
  const mechanism::Mechanism& m = model.content().mechanism;
  for (const mechanism::Point& point : m.points) {
    const auto* const form = std::get_if<mechanism::ExplicitPoint>(&point.form);
    if (form != nullptr && form->coordinates[0].kind() == core::Expression::Kind::symbol &&
        form->coordinates[1].kind() == core::Expression::Kind::symbol &&
        form->coordinates[0].name() == m.coordinates[0].name && form->coordinates[1].name() == m.coordinates[1].name)
      return point.name;
  }
  ADD_FAILURE() << "the coordinates are not those of a point";
  return "";
}

/// On a locus of reactions, where it is best conditioned.
Pose best_posture(const Model& model, const LocusMap& map) {
  std::optional<Pose> best;
  for (const LocusCurve& curve : map.curves) {
    if (curve.vanishing.empty()) continue;
    for (const Arc& arc : curve.arcs)
      for (std::size_t i = 0; i < arc.points.size(); i += 16) {
        Pose pose = solve_pose(model, {arc.points[i][0], arc.points[i][1]});
        if (!pose.unreachable.empty() || !pose.beyond_limit.empty()) continue;
        if (!best || pose.condition < best->condition) best = std::move(pose);
      }
  }
  return *best;
}

/// The file with its points drawn in a posture, over the motors.
std::string over_motors(const std::string& text, const Motors& motors, const Pose& posture,
                        const std::vector<double>& half) {
  std::string left;
  bool skips = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && std::isalpha(static_cast<unsigned char>(line[0])) != 0)
      skips = line.starts_with("points:") || line.starts_with("workspace:") || line.starts_with("frames:");
    if (!skips) left += line + "\n";
  }
  return left + motors.drawn(posture) + "workspace:\n" + motors.ranges(motors.at(posture), half);
}

std::set<std::string> names_in(const std::vector<Vanishing>& all) {
  std::set<std::string> names;
  for (const Vanishing& vanishing : all) names.insert(to_string(vanishing.quantity) + vanishing.joint);
  return names;
}

/// From the curves on which a reaction vanishes, measured in `half`, so that coordinates compare.
double distance_to(const Vector& at, const std::string& name, const LocusMap& map, const std::vector<double>& half) {
  double least = std::numeric_limits<double>::infinity();
  const auto scaled = [&](const Point2& p) -> Vector { return {(p[0] - at[0]) / half[0], (p[1] - at[1]) / half[1]}; };
  for (const LocusCurve& curve : map.curves) {
    if (names_in(curve.vanishing).count(name) == 0) continue;
    for (const Arc& arc : curve.arcs)
      for (std::size_t i = 1; i < arc.points.size(); ++i) {
        const Vector a = scaled(arc.points[i - 1]), b = scaled(arc.points[i]), way = {b[0] - a[0], b[1] - a[1]};
        const double square = way[0] * way[0] + way[1] * way[1];
        const double part = square > 0 ? std::clamp(-(a[0] * way[0] + a[1] * way[1]) / square, 0.0, 1.0) : 0;
        least = std::min(least, std::hypot(a[0] + part * way[0], a[1] + part * way[1]));
      }
  }
  return least;
}

/// The same places of all points of the drawing.
bool is_same(const Pose& one, const Pose& other, double within) {
  return std::all_of(one.points.begin(), one.points.end(), [&](const PosePoint& pose_point) {
    const auto same = std::find_if(other.points.begin(), other.points.end(),
                                   [&](const PosePoint& point) { return point.name == pose_point.name; });
    return same == other.points.end() ||
           std::hypot(same->at[0] - pose_point.at[0], same->at[1] - pose_point.at[1]) < within;
  });
}

struct Sample {
  std::string name;  ///< of what vanishes
  Vector at{};
};

/// Some `wanted`, of all curves on which reactions vanish; `size`: of the box.
std::vector<Sample> samples_of(const LocusMap& map, double size, std::size_t wanted) {
  std::vector<Sample> all, some;
  for (const LocusCurve& curve : map.curves)
    for (const std::string& name : names_in(curve.vanishing))
      for (const Arc& arc : curve.arcs)
        for (std::size_t i = 1; i < arc.points.size(); ++i) {
          const Point2 &a = arc.points[i - 1], &b = arc.points[i];
          const int parts = 1 + static_cast<int>(std::hypot(b[0] - a[0], b[1] - a[1]) / (0.02 * size));
          for (int k = 0; k < parts; ++k) {
            const double part = (k + 0.5) / parts;
            all.push_back({name, {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])}});
          }
        }
  const std::size_t step = 1 + all.size() / wanted;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

/// Points that are apart in a posture coincide: a leg may turn about them, so that the place does not tell the posture.
bool is_folded(const Pose& pose, const Pose& posture, double size) {
  const auto apart = [](const Pose& candidate, std::size_t i, std::size_t k) {
    return std::hypot(candidate.points[i].at[0] - candidate.points[k].at[0],
                      candidate.points[i].at[1] - candidate.points[k].at[1]);
  };
  for (std::size_t i = 0; i < pose.points.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (apart(pose, i, k) < 1e-4 * size && apart(posture, i, k) > 1e-3 * size) return true;
  return false;
}

bool is_in_box(const Model& model, const Vector& at) {
  const auto coordinates = model.coordinates();
  for (std::size_t c = 0; c < 2; ++c)
    if (at[c] < coordinates[c].lower || at[c] > coordinates[c].upper) return false;
  return true;
}

class MotorImages : public ::testing::TestWithParam<const char*> {};

TEST_P(MotorImages, LociAreThoseOverTheEndEffector) {
  std::string text = example_text(GetParam());
  // A drawing moves the points of links alone.
  for (const char* const leg : {"1", "2"}) {
    const std::string format = fmt::format("points: [A{0}], mass: 1, com: G{0}", leg);
    if (text.find(format) != std::string::npos)
      text = replaced(text, format, fmt::format("points: [A{0}, G{0}], mass: 1, com: G{0}", leg));
  }
  const Model model = Model::parse(text, "place.yaml");
  const Motors motors(model);
  ASSERT_EQ(motors.count(), 2U);
  const LocusMap by_place = trace_loci(model);
  const Pose first = best_posture(model, by_place);
  const std::string end = end_point(model);
  std::vector<double> half, places;
  double size = 0;
  for (const auto& coordinate : model.coordinates()) {
    places.push_back((coordinate.upper - coordinate.lower) / 2);
    size = std::max(size, places.back());
  }
  for (std::size_t k = 0; k < 2; ++k) half.push_back(motors.slides(k) ? 0.5 * size : 0.8);
  const std::string other = over_motors(text, motors, first, half);
  SCOPED_TRACE(other);
  const Model driven = Model::parse(other, "motors.yaml");
  const LocusMap by_motors = trace_loci(driven);
  const std::vector<double> middle = motors.at(first);
  int followed = 0, images = 0, away = 0;
  for (const auto& [name, q] : samples_of(by_motors, 2 * *std::max_element(half.begin(), half.end()), 150)) {
    const Pose pose = solve_pose(driven, {q[0], q[1]});
    if (!pose.unreachable.empty()) continue;
    const Vector at = place_of(pose, end);
    if (!is_in_box(model, at)) continue;
    const Pose same = solve_pose(model, {at[0], at[1]});
    if (!same.unreachable.empty() || !same.beyond_limit.empty() || !is_same(same, pose, 1e-5 * size) ||
        is_folded(same, first, size))
      continue;
    ++followed;
    EXPECT_LT(distance_to(at, name, by_place, places), 1e-3) << name << " at " << at[0] << ", " << at[1];
  }
  // And the other way round, where the same assembly is reached; strands nearer than a cell are not followed.
  for (const auto& [name, at] : samples_of(by_place, size, 700)) {
    const Pose pose = solve_pose(model, {at[0], at[1]});
    if (!pose.unreachable.empty() || !pose.beyond_limit.empty() || is_folded(pose, first, size)) continue;
    std::vector<double> q = motors.at(pose);
    bool is_inside = true;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!motors.slides(k)) q[k] = middle[k] + std::remainder(q[k] - middle[k], 2 * std::numbers::pi);
      is_inside = is_inside && std::abs(q[k] - middle[k]) < 0.98 * half[k];
    }
    if (!is_inside) continue;
    const Pose same = solve_pose(driven, q);
    if (!same.unreachable.empty() || !is_same(same, pose, 1e-5 * size)) continue;
    ++images;
    away += distance_to({q[0], q[1]}, name, by_motors, half) < 2.0 * 2 / 96 ? 0 : 1;
  }
  fmt::print("{}: {} places over the motors, {} images, {} away\n", GetParam(), followed, images, away);
  EXPECT_GT(followed, 10);
  // Places of loci that run along the workspace boundary are within reach, or not, by rounding.
  EXPECT_GT(followed + images, 20);
  EXPECT_LE(50 * away, images + 100);
}

INSTANTIATE_TEST_SUITE_P(Shipped, MotorImages,
                         ::testing::Values("five_bar", "five_bar_antagonistic", "five_bar_coupler", "five_bar_generic",
                                           "five_bar_horizontal", "five_bar_inclined", "five_bar_isolated",
                                           "five_bar_preloaded", "five_bar_weights", "minitaur_leg", "planar_delta",
                                           "prrrp", "rprpr"),
                         [](const auto& candidate) { return std::string(candidate.param); });

}  // namespace
}  // namespace clearloci::test
