// Statics by the principle of virtual work, over all shipped planar mechanisms: what the actuators, loads, springs and
// weights do in a displacement of a free coordinate adds up to nothing. Places are the witness's; differences, energies
// and the motion of the actuators are this file's own, and no equation of balance is written.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/rational.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/read.hpp"
#include "numeric/reactions.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using mechanism::Mechanism;
using numeric::Point2;
using numeric::Posture;

class VirtualWork {
 public:
  explicit VirtualWork(const Mechanism& m) : m_(m), model_(numeric::compile(m)), mode_(mechanism::working_mode(m)) {}

  /// The work that all but the reactions of guides and pins does, over a displacement of coordinate c; with its size.
  /// None where the neighbourhood of the pose is out of reach, |A| is nearly zero, or places change too fast for
  /// differences: steps of two lengths tell.
  std::optional<std::array<double, 2>> at(const std::vector<double>& pose, std::size_t c) const {
    const double span = model_.box[c][1] - model_.box[c][0], h = 1e-4 * span;
    // At -4, -2, -1, 0, 1, 2, 4 steps.
    constexpr std::array steps = {-4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0};
    std::array<Posture, 7> near;
    for (std::size_t i = 0; i < 7; ++i) {
      std::vector<double> there = pose;
      there[c] += steps[i] * h;
      near[i] = numeric::posture(model_, there, mode_);
      if (!near[i].reachable()) return std::nullopt;
    }
    const Posture& here = near[3];
    const numeric::Reactions reactions = numeric::solve_reactions(model_, here);
    if (!(reactions.condition < 1e4)) return std::nullopt;
    double sum = 0, size = 0, unresolved = 0;
    const auto add = [&](double force, const auto& place) {
      const double narrow = 8 * (place(near[4]) - place(near[2])) - (place(near[5]) - place(near[1]));
      const double wide = 8 * (place(near[5]) - place(near[1])) - (place(near[6]) - place(near[0]));
      const double rate = narrow / (12 * h);
      sum += force * rate;
      size += std::abs(force * rate);
      unresolved += std::abs(force * (rate - wide / (24 * h)));
    };
    const auto turned = [&](mechanism::LinkIndex link) {
      return [this, link, &here](const Posture& p) {
        return std::remainder(angle(p, link) - angle(here, link), 2 * std::numbers::pi);
      };
    };
    for (std::size_t k = 0; k < model_.unknowns.size(); ++k) {
      const mechanism::Joint& joint = m_.joints[static_cast<std::size_t>(model_.unknowns[k].joint)];
      const double effort = reactions.values(static_cast<Eigen::Index>(k));
      if (model_.unknowns[k].quantity == core::Quantity::M) {
        add(effort, turned(joint.to));
        add(-effort, turned(joint.from));
      }
      if (model_.unknowns[k].quantity == core::Quantity::F)
        add(effort, [&](const Posture& p) { return slid(p, here, joint, model_.unknowns[k].joint); });
    }
    for (const mechanism::Joint& joint : m_.joints)
      if (joint.effort && !mechanism::traits(joint).slides) {
        add(value(*joint.effort), turned(joint.to));
        add(-value(*joint.effort), turned(joint.from));
      }
    for (const numeric::AppliedLoad& load : here.loads) {
      if (load.inner) continue;
      const auto place = point_of(here, load);
      for (Eigen::Index i = 0; i < 2; ++i) add(load.force[i], [&](const Posture& p) { return p.points[place][i]; });
      if (load.couple[2] != 0) add(load.couple[2], turned(load.link));
    }
    for (const mechanism::Spring& spring : m_.springs) add(-1, [&](const Posture& p) { return energy(p, spring); });
    if (!(unresolved < 1e-7 * size)) return std::nullopt;
    return std::array{sum, size};
  }

 private:
  double value(const core::Expression& e) const { return core::to_double(mechanism::value_of(e, m_)); }
  static Point2 point(const Posture& p, int index) {
    return numeric::in_plane(p.points[static_cast<std::size_t>(index)]);
  }

  /// The point that a load acts at, by its place.
  std::size_t point_of(const Posture& p, const numeric::AppliedLoad& load) const {
    for (std::size_t i = 0; i < p.points.size(); ++i)
      if (p.points[i] == load.at && mechanism_has(load.link, static_cast<int>(i))) return i;
    ADD_FAILURE() << "a load acts at no point";
    return 0;
  }
  bool mechanism_has(mechanism::LinkIndex link, int index) const {
    const mechanism::Link& body = m_.links[static_cast<std::size_t>(link)];
    return body.centre_of_mass == index ||
           std::find(body.points.begin(), body.points.end(), index) != body.points.end();
  }

  /// Of a link's first two points, or of the guide that a block turns with.
  double angle(const Posture& p, mechanism::LinkIndex link) const {
    if (link == mechanism::ground) return 0;
    const auto& points = m_.links[static_cast<std::size_t>(link)].points;
    if (points.size() > 1) {
      const Point2 a = point(p, points[0]), b = point(p, points[1]);
      return std::atan2(b[1] - a[1], b[0] - a[0]);
    }
    for (std::size_t j = 0; j < m_.joints.size(); ++j)
      if (mechanism::traits(m_.joints[j]).slides && (m_.joints[j].from == link || m_.joints[j].to == link))
        return std::atan2(p.axes[j][1], p.axes[j][0]);
    ADD_FAILURE() << "a link without a direction is turned";
    return 0;
  }

  /// How far `to` slides along the axis of the pose `here`: of the ground's, or out of a cylinder whose point lies on
  /// it.
  double slid(const Posture& p, const Posture& here, const mechanism::Joint& joint, int index) const {
    const Point2 u = numeric::in_plane(here.axes[static_cast<std::size_t>(index)]), q = point(p, joint.at);
    if (joint.from == mechanism::ground) return u[0] * q[0] + u[1] * q[1];
    const Point2 a = point(p, m_.links[static_cast<std::size_t>(joint.from)].points.front());
    return std::hypot(q[0] - a[0], q[1] - a[1]);
  }

  double energy(const Posture& p, const mechanism::Spring& spring) const {
    const Point2 a = point(p, spring.from_point), b = point(p, spring.to_point);
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (spring.kind == mechanism::Spring::Kind::constant_force) return value(spring.force) * length;
    return value(spring.stiffness) / 2 * std::pow(length - value(spring.free_length), 2);
  }

  const Mechanism& m_;
  numeric::NumericModel model_;
  std::vector<int> mode_;
};

class Examples : public testing::TestWithParam<const char*> {};

TEST_P(Examples, DoNoWorkInAnyDisplacement) {
  const Mechanism m = mechanism::read_mechanism(source_dir() + "/examples/" + GetParam() + ".yaml");
  const VirtualWork work(m);
  constexpr std::size_t poses = 200;
  int compared = 0;
  for (const std::vector<double>& pose : mechanism::spread_poses(m, poses))
    for (std::size_t c = 0; c < m.coordinates.size(); ++c)
      if (const auto sum = work.at(pose, c)) {
        // Of the work of each: rounding over the step, and what the two steps leave open.
        EXPECT_NEAR((*sum)[0], 0, 1e-6 * (*sum)[1]) << m.coordinates[c].name << " at " << pose.front();
        ++compared;
      }
  EXPECT_GT(compared, 20);
}

INSTANTIATE_TEST_SUITE_P(Shipped, Examples,
                         testing::Values("five_bar", "five_bar_antagonistic", "five_bar_coupler", "five_bar_generic",
                                         "five_bar_horizontal", "five_bar_inclined", "five_bar_isolated",
                                         "five_bar_preloaded", "five_bar_weights", "excavator", "four_bar",
                                         "geared_five_bar", "gripper", "jansen_leg", "klann_leg", "minitaur_leg",
                                         "planar_delta", "prrrp", "rprpr", "scara_belt", "slider_crank", "squeezer",
                                         "stephenson_six_bar", "three_rpr", "three_rrr", "toggle_press",
                                         "watt_six_bar"),
                         [](const auto& candidate) { return std::string(candidate.param); });

}  // namespace
}  // namespace clearloci
